/* tests/methods/test_methods.c -- The methods have the properties that they state.
 * Run alone: make test-methods */
#include "methods_runs.h"
#include "run/whole_run.h"
#include "system/larger.h"

/* ---- the table ---- */

START_TEST(a_method_is_found_by_its_name)
{
    size_t count = 0;
    FOR_EACH(m)
    {
        ck_assert_ptr_eq(fvi_method_find(m->name),
                         m); /* no name stands twice */
        ck_assert(m->order && m->memory && m->step);
        count++;
    }
    ck_assert_uint_eq(count, 22);
    ck_assert_ptr_null(fvi_method_find("variational"));
    ck_assert_ptr_null(fvi_method_find("fv"));
    ck_assert_ptr_null(fvi_method_find(""));
    ck_assert_ptr_null(fvi_method_find(NULL));
}
END_TEST

/* The program says "is not 0.5, all that it knows". */
START_TEST(a_method_knows_all_alpha_or_one)
{
    FOR_EACH(m)
    {
        ck_assert((m->alpha_least == 0 && m->alpha_most == 1)
                  || (m->alpha_least == m->alpha_most && m->alpha_most > 0
                      && m->alpha_most < 1));
        ck_assert(m->stability_number || !m->stability_number_grows);
        ck_assert((m->memories == 0) == (strcmp(m->memory, "none") == 0));
    }
}
END_TEST

/* ---- each field, by what the method does ---- */

START_TEST(a_method_runs_at_its_alpha_and_not_outside)
{
    const fvi_system system = spring();
    FOR_EACH(m)
    {
        const double inside[] = { m->alpha_least, middle(m), m->alpha_most },
                     outside[] = { nextafter(m->alpha_least, -1),
                                   nextafter(m->alpha_most, 2), GSL_NAN };
        double x[STEPS + 1], kept = 7;
        for (size_t j = 0; j < LEN(inside); j++) {
            const fvi_run run = run_of(&system, inside[j]);
            ck_assert_int_eq(fvi_trajectory(m, &run, x, NULL, NULL),
                             FVI_SUCCESS);
        }
        for (size_t j = 0; j < LEN(outside); j++) {
            const fvi_run run = run_of(&system, outside[j]);
            ck_assert_int_eq(fvi_trajectory(m, &run, x, NULL, NULL), FVI_EDOM);
            if (m->stability_number)
                ck_assert_int_eq(fvi_stability_number(m, &run, &kept), FVI_EDOM);
        }
        ck_assert(kept == 7);
    }
}
END_TEST

START_TEST(kappa_changes_the_numbers_of_those_that_take_it)
{
    const fvi_system system = pendulum();
    FOR_EACH(m)
    {
        fvi_run run = run_of(&system, middle(m));
        double x[STEPS + 1], other[STEPS + 1];
        ck_assert_int_eq(fvi_trajectory(m, &run, x, NULL, NULL), FVI_SUCCESS);
        run.kappa = 0.25;
        ck_assert_int_eq(fvi_trajectory(m, &run, other, NULL, NULL),
                         FVI_SUCCESS);
        ck_assert_msg((memcmp(x, other, sizeof x) != 0)
                          == (m->takes_kappa != 0),
                      "%s", m->name);
    }
}
END_TEST

/* The Hessian of a pendulum, and how often it is asked for: once a step at least, but of a
 * method that chooses its steps, which keeps factors while they serve. */
static size_t asked;
static int counted_hessian(size_t d, const double *x, void *params, double *H)
{
    asked++;
    return fvi_potential_pendulum(&c).hessian(d, x, params, H);
}

START_TEST(an_implicit_step_asks_for_the_hessian)
{
    fvi_system system = pendulum();
    system.potential.hessian = counted_hessian;
    FOR_EACH(m)
    {
        const fvi_run run = run_of(&system, middle(m));
        fvi_stepper *s;
        ck_assert_int_eq(fvi_stepper_start(m, &run, &s, NULL), FVI_SUCCESS);
        asked = 0;
        while (s->k < run.steps)
            ck_assert_int_eq(fvi_stepper_step(s), FVI_SUCCESS);
        fvi_stepper_free(s);
        const size_t least = m->dense ? 1 : STEPS;
        ck_assert_msg(m->implicit ? asked >= least : asked == 0, "%s: %zu",
                      m->name, asked);
    }
}
END_TEST

/* The kinds that a method has give the same rows, but for 1e-13 of D^{2 alpha} x, which
 * is below 2: over the time 5 that is 5^2/2 rho 2e-13 < 2e-12. The others are refused.
 * A method without a history does not look. Seen: 2e-4 of that. */
START_TEST(a_memory_is_used_or_refused)
{
    const fvi_system system = spring();
    FOR_EACH(m)
    {
        double x[STEPS + 1], other[STEPS + 1];
        fvi_run run = run_of(&system, middle(m));
        ck_assert_int_eq(fvi_trajectory(m, &run, x, NULL, NULL), FVI_SUCCESS);
        for (int kind = FVI_HISTORY_AUTO; kind <= FVI_HISTORY_MODES;
             kind++) {
            const int has = m->memories == 0 || (m->memories >> kind & 1);
            run.memory = (fvi_history_kind)kind;
            ck_assert(!fvi_method_takes_history(m, run.memory) == !has);
            ck_assert_int_eq(fvi_trajectory(m, &run, other, NULL, NULL),
                             has ? FVI_SUCCESS : FVI_EUNSUP);
            for (size_t k = 0; has && k <= STEPS; k++)
                ck_assert_near(other[k], x[k],
                               m->memories ? 2e-12 : GSL_DBL_MIN,
                               "%s, memory %d, k=%zu", m->name, kind, k);
        }
    }
}
END_TEST

/* The equation (13.7) of a free mass, where the damping is all there is: with D_k from
 * the weights that the method names, and theta = 0 or alpha, nothing is left. 40 sums
 * of 40 terms, x below 2 and a second difference: 40 (40 + 4) 2 u. Seen: 6e-4 of that. */
START_TEST(eq_13_7_the_quadrature_is_the_one_named)
{
    size_t ran = 0;
    const double alpha = 0.3, R = rho * pow(0.125, 2 - 2 * alpha);
    const fvi_system free_mass = { 1, &one, &rho, { 0 }, { 0 }, NULL, NULL };
    FOR_EACH(m)
    {
        double w[STEPS + 1], x[STEPS + 1], left[2] = { 0, 0 };
        const fvi_run run = run_of(&free_mass, alpha);
        if (!m->memories || m->stages || m->dense)
            continue;
        ran++;
        ck_assert_int_eq(fvi_trajectory(m, &run, x, NULL, NULL), FVI_SUCCESS);
        ck_assert_int_eq(
            fvi_cq_weights(m->quadrature, 2 * alpha, STEPS + 1, w),
            FVI_SUCCESS);
        const int is_stable = m == &fvi_cq2_midpoint; /* the mean of two, (13.16) */
        for (size_t n = STEPS; is_stable && n > 0; n--)
            w[n] = (0.5 + alpha) * w[n] + (0.5 - alpha) * w[n - 1];
        w[0] *= is_stable ? 0.5 + alpha : 1;
        for (size_t k = 1; k < STEPS; k++) {
            double D[2] = { 0, 0 };
            for (size_t end = 0; end < 2; end++)
                for (size_t n = 0; n <= k + end; n++)
                    D[end] += w[n] * (x[k + end - n] - x[0]);
            for (size_t t = 0; t < 2; t++) {
                const double theta = t == 0 ? 0 : is_stable ? 0.5 : alpha;
                left[t] = larger(
                    left[t], fabs(x[k + 1] - 2 * x[k] + x[k - 1]
                                  + R * ((1 - theta) * D[0] + theta * D[1])));
            }
        }
        ck_assert_near(smaller(left[0], left[1]), 0, 40 * 44 * 2 * U, "%s",
                       m->name);
    }
    ck_assert_uint_eq(ran, 4); /* fvi, -shifted, -bdf2, -stable */
}
END_TEST

/* What has no solution is run by those that do what is printed, and by no other; where
 * there is one, the distance of two runs at t = 1, ..., 5 shrinks by 2^(1 - 2 alpha) a
 * halving, 1.41, and in the others by more than 2. Seen: 0.46, and from 1.98 on. */
START_TEST(eq_9_5_a_past_as_printed_is_a_kick)
{
    size_t ran = 0;
    const fvi_system system = spring();
    FOR_EACH(m)
    {
        fvi_run run = run_of(&system, 0.75);
        double last[5] = { 0 }, D[3] = { 0 }, x[641];
        if (m->alpha_most < 1 || m->dense) /* h is no step of the latter */
            continue;
        ran++;
        run.past = FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE;
        ck_assert_int_eq(fvi_trajectory(m, &run, x, NULL, NULL),
                         m->paper_convention ? FVI_SUCCESS : FVI_EDOM);
        run.alpha = 0.25;
        for (size_t j = 0; j < 3; j++) {
            run.steps = (size_t)160 << j;
            run.h = 5. / (double)run.steps;
            ck_assert_int_eq(fvi_trajectory(m, &run, x, NULL, NULL),
                             FVI_SUCCESS);
            for (size_t t = 0; t < 5; t++) {
                const double now = x[run.steps / 5 * (t + 1)];
                D[j] = larger(D[j], fabs(now - last[t]));
                last[t] = now;
            }
        }
        if (D[1] < 1e-11) /* rounding is all that is left */
            continue;
        const double rate = log2(D[1] / D[2]);
        seen(rate, m->paper_convention ? "as printed" : "exact impulses");
        ck_assert_msg((rate < 0.75) == (m->paper_convention != 0), "%s: %g",
                      m->name, rate);
    }
    ck_assert_uint_eq(ran, 18); /* without the three of alpha = 1/2 */
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("methods: what they say of themselves");
    ADD_CASE(suite, "table", a_method_is_found_by_its_name,
             a_method_knows_all_alpha_or_one);
    ADD_CASE(suite, "fields", a_method_runs_at_its_alpha_and_not_outside,
             kappa_changes_the_numbers_of_those_that_take_it,
             an_implicit_step_asks_for_the_hessian, a_memory_is_used_or_refused,
             eq_13_7_the_quadrature_is_the_one_named,
             eq_9_5_a_past_as_printed_is_a_kick);
    return run_suite(suite);
}
