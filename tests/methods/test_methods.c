/* tests/methods/test_methods.c -- What the methods say of themselves is so.
 * Run alone: make test-methods */
#include <fvi/fvi.h>
#include "harness/ulp.h"

#include <gsl/gsl_math.h>
#include <gsl/gsl_rng.h>

enum { STEPS = 40 };
static const double one = 1, rho = 0.5, start = 1, push = 0.25;
static double c = 1;

/* One mass on a spring or a pendulum, with damping; the direct sum. */
static fvi_run run_of(const fvi_system *system, double alpha)
{
    fvi_run run = fvi_run_default(system, &start, &push, 0.125, STEPS);
    run.alpha = alpha;
    run.memory = FVI_MEMORY_DIRECT;
    return run;
}

static fvi_system spring(void)
{
    return (fvi_system){ 1, &one, &rho, fvi_potential_harmonic(&c), { 0 } };
}

static fvi_system pendulum(void)
{
    return (fvi_system){ 1, &one, &rho, fvi_potential_pendulum(&c), { 0 } };
}

static double middle(const fvi_method *m)
{
    return m->alpha_least + 0.3 * (m->alpha_most - m->alpha_least);
}

#define FOR_EACH(m)                                                            \
    for (size_t i_ = 0; fvi_methods[i_]; i_++)                                 \
        for (const fvi_method *m = fvi_methods[i_]; m; m = NULL)

/* ---- the table ---- */

START_TEST(a_method_is_found_by_its_name)
{
    size_t count = 0;
    FOR_EACH(m)
    {
        ck_assert_ptr_eq(fvi_method_named(m->name),
                         m); /* no name stands twice */
        ck_assert(m->order && m->memory && m->step);
        count++;
    }
    ck_assert_uint_eq(count, 9);
    ck_assert_ptr_null(fvi_method_named("variational"));
    ck_assert_ptr_null(fvi_method_named("fv"));
    ck_assert_ptr_null(fvi_method_named(""));
    ck_assert_ptr_null(fvi_method_named(NULL));
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
        ck_assert(m->load || !m->load_grows);
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
            if (m->load)
                ck_assert_int_eq(fvi_stability_load(m, &run, &kept), FVI_EDOM);
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

/* The Hessian of a pendulum, and how often it is asked for. */
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
        ck_assert_int_eq(fvi_start(m, &run, &s), FVI_SUCCESS);
        asked = 0;
        while (s->k < run.steps)
            ck_assert_int_eq(fvi_step(s), FVI_SUCCESS);
        fvi_stop(s);
        ck_assert_msg(m->implicit ? asked >= STEPS : asked == 0, "%s: %zu",
                      m->name, asked);
    }
}
END_TEST

/* The kinds that a method has give the same rows, but for 1e-13 of D^{2 alpha} x, which
 * is below 2: over the time 5 that is 5^2/2 rho 2e-13 < 2e-12. The others are refused.
 * What remembers nothing does not look. Seen: 2e-4 of that. */
START_TEST(a_memory_is_used_or_refused)
{
    const fvi_system system = spring();
    FOR_EACH(m)
    {
        double x[STEPS + 1], other[STEPS + 1];
        fvi_run run = run_of(&system, middle(m));
        ck_assert_int_eq(fvi_trajectory(m, &run, x, NULL, NULL), FVI_SUCCESS);
        for (int kind = FVI_MEMORY_AUTO; kind <= FVI_MEMORY_EXPONENTIALS;
             kind++) {
            const int has = m->memories == 0 || (m->memories >> kind & 1);
            run.memory = (fvi_memory_kind)kind;
            ck_assert(!fvi_method_has_memory(m, run.memory) == !has);
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
    const double alpha = 0.3, R = rho * pow(0.125, 2 - 2 * alpha);
    const fvi_system free_mass = { 1, &one, &rho, { 0 }, { 0 } };
    FOR_EACH(m)
    {
        double w[STEPS + 1], x[STEPS + 1], left[2] = { 0, 0 };
        const fvi_run run = run_of(&free_mass, alpha);
        if (!m->memories || m->stages)
            continue;
        ck_assert_int_eq(fvi_trajectory(m, &run, x, NULL, NULL), FVI_SUCCESS);
        ck_assert_int_eq(
            fvi_quadrature_weights(m->quadrature, 2 * alpha, STEPS + 1, w),
            FVI_SUCCESS);
        for (size_t k = 1; k < STEPS; k++) {
            double D[2] = { 0, 0 };
            for (size_t end = 0; end < 2; end++)
                for (size_t n = 0; n <= k + end; n++)
                    D[end] += w[n] * (x[k + end - n] - x[0]);
            for (size_t t = 0; t < 2; t++) {
                const double theta = t ? alpha : 0;
                left[t] = fmax(left[t],
                               fabs(x[k + 1] - 2 * x[k] + x[k - 1]
                                    + R * ((1 - theta) * D[0] + theta * D[1])));
            }
        }
        ck_assert_near(fmin(left[0], left[1]), 0, 40 * 44 * 2 * U, "%s",
                       m->name);
    }
}
END_TEST

/* What has no solution is run by those that do what is printed, and by no other; where
 * there is one, the distance of two runs at t = 1, ..., 5 shrinks by 2^(1 - 2 alpha) a
 * halving, 1.41, and in the others by more than 2. Seen: 0.46, and from 1.98 on. */
START_TEST(eq_9_5_a_past_as_printed_is_a_kick)
{
    const fvi_system system = spring();
    FOR_EACH(m)
    {
        fvi_run run = run_of(&system, 0.75);
        double last[5] = { 0 }, D[3] = { 0 }, x[641];
        if (m->alpha_most < 1)
            continue;
        run.past = FVI_PAST_RIEMANN_LIOUVILLE;
        ck_assert_int_eq(fvi_trajectory(m, &run, x, NULL, NULL),
                         m->past_as_printed ? FVI_SUCCESS : FVI_EDOM);
        run.alpha = 0.25;
        for (size_t j = 0; j < 3; j++) {
            run.steps = (size_t)160 << j;
            run.h = 5. / (double)run.steps;
            ck_assert_int_eq(fvi_trajectory(m, &run, x, NULL, NULL),
                             FVI_SUCCESS);
            for (size_t t = 0; t < 5; t++) {
                const double now = x[run.steps / 5 * (t + 1)];
                D[j] = fmax(D[j], fabs(now - last[t]));
                last[t] = now;
            }
        }
        const double rate = log2(D[1] / D[2]);
        seen(rate, m->past_as_printed ? "as printed" : "exact impulses");
        ck_assert_msg((rate < 0.75) == (m->past_as_printed != 0), "%s: %g",
                      m->name, rate);
    }
}
END_TEST

/* ---- loads ---- */

/* Does a run of 600 steps grow? What is stable and starts at 1, 1/4 stays below 100 as
 * long as the load is below 0.8; a mode above 1.25 grows by more than 1.05 a step. */
static int grows(const fvi_method *m, const fvi_run *run)
{
    double most = 0;
    fvi_stepper *s;
    ck_assert_int_eq(fvi_start(m, run, &s), FVI_SUCCESS);
    int status = FVI_SUCCESS;
    while (s->k < run->steps && !status && most < 1e6) {
        status = fvi_step(s);
        most = fmax(most, fabs(s->x[0]));
    }
    fvi_stop(s);
    ck_assert(status == FVI_SUCCESS || status == FVI_EOVRFLW);
    ck_assert_msg(status || most > 1e6 || most < 100, "%s alpha=%g: %g",
                  m->name, run->alpha, most);
    return status || most > 1e6;
}

/* 200 random linear runs of each method that has a load; those of a load near 1, where a
 * mode hardly grows, are left out. */
START_TEST(eq_14_3_13_14_17_18_a_run_grows_if_its_load_is_above_1)
{
    gsl_rng *random = gsl_rng_alloc(gsl_rng_taus2);
    FOR_EACH(m)
    {
        size_t above = 0, below = 0;
        for (size_t i = 0; i < 200 && m->load; i++) {
            double stiffness = pow(10, 3 * gsl_rng_uniform(random) - 1),
                   damping = pow(10, 3 * gsl_rng_uniform(random) - 1.5), load;
            const fvi_system system = {
                1, &one, &damping, fvi_potential_harmonic(&stiffness), { 0 }
            };
            fvi_run run = fvi_run_default(&system, &start, &push, 1, 600);
            run.alpha =
                m->alpha_least
                + gsl_rng_uniform(random) * (m->alpha_most - m->alpha_least);
            if (m->takes_kappa)
                run.kappa = gsl_rng_uniform(random);
            ck_assert_int_eq(fvi_stability_load(m, &run, &load), FVI_SUCCESS);
            if (load > 0.8 && load < 1.25)
                continue;
            ck_assert_msg(grows(m, &run) == (load > 1),
                          "%s alpha=%g kappa=%g c=%g rho=%g: load %g", m->name,
                          run.alpha, run.kappa, stiffness, damping, load);
            *(load > 1 ? &above : &below) += 1;
        }
        ck_assert_msg(!m->load || (above >= 5 && below >= 5), "%s: %zu, %zu",
                      m->name, above, below);
    }
    gsl_rng_free(random);
}
END_TEST

/* h of load 1: shorter steps have a load of at most 1, longer ones more; or it is said
 * that there is no such h. */
START_TEST(eq_14_4_the_longest_step_parts_the_loads)
{
    const fvi_system system = spring();
    c = 30; /* at kappa = 1/4, so that each load has two terms */
    FOR_EACH(m)
    {
        fvi_run run = run_of(&system, middle(m));
        double h = 7, load, last = 0;
        run.kappa = 0.25;
        if (!m->load)
            ck_assert_int_eq(fvi_stability_load(m, &run, &h), FVI_EUNSUP);
        if (!m->load_grows) {
            ck_assert_int_eq(fvi_stability_step(m, &run, &h), FVI_EUNSUP);
            ck_assert(h == 7);
            continue;
        }
        ck_assert_int_eq(fvi_stability_step(m, &run, &h), FVI_SUCCESS);
        for (int n = -100; n <= 100; n++) {
            run.h = n == 0 ? h : h * (1 + 1e-11 * n) * exp2(n / 10);
            ck_assert_int_eq(fvi_stability_load(m, &run, &load), FVI_SUCCESS);
            ck_assert_msg((load > 1) == (n > 0) && load >= last,
                          "%s: load %.17g at %.17g h", m->name, load,
                          run.h / h);
            last = load;
        }
    }
}
END_TEST

/* A Hessian that is not finite at any h is an error, no step of length 0. */
START_TEST(a_load_that_overflows_at_every_step_is_reported)
{
    const fvi_system system = spring();
    fvi_run run = run_of(&system, 0.3);
    double h = 7;
    c = GSL_POSINF;
    run.kappa = 0;
    ck_assert_int_eq(fvi_stability_step(&fvi_fractional, &run, &h),
                     FVI_EOVRFLW);
    ck_assert(h == 7);
}
END_TEST

/* ---- copies ---- */

/* Nothing tells a method from a copy under another name and at another address. */
START_TEST(a_copied_method_is_as_good)
{
    const fvi_system system = pendulum();
    FOR_EACH(m)
    {
        fvi_method copy = *m;
        copy.name = "copy";
        fvi_run run = run_of(&system, middle(m));
        double x[2][STEPS + 1], p[2][STEPS + 1], v[2] = { 0, 0 };
        fvi_step_found found[2] = { { 0 } };
        run.past = FVI_PAST_RIEMANN_LIOUVILLE;
        for (size_t j = 0; j < 2; j++) {
            const fvi_method *which = j ? &copy : m;
            ck_assert_int_eq(fvi_trajectory(which, &run, x[j], p[j], NULL),
                             FVI_SUCCESS);
            ck_assert_int_eq(fvi_lobatto_momenta(which, &run, x[j], p[j]),
                             m->stages ? FVI_SUCCESS : FVI_EINVAL);
        }
        ck_assert(memcmp(x[0], x[1], sizeof x[0]) == 0
                  && memcmp(p[0], p[1], sizeof p[0]) == 0);
        ck_assert_int_eq(fvi_stability_load(m, &run, v),
                         fvi_stability_load(&copy, &run, v + 1));
        ck_assert(v[0] == v[1]);
        ck_assert_int_eq(fvi_stability_step(m, &run, v),
                         fvi_stability_step(&copy, &run, v + 1));
        ck_assert(v[0] == v[1]);
        ck_assert_ptr_eq(fvi_step_search_other(m, &run),
                         fvi_step_search_other(&copy, &run));
        ck_assert_int_eq(
            fvi_step_search(m, &run, 1e-2, 4096, x[0], p[0], found),
            fvi_step_search(&copy, &run, 1e-2, 4096, x[1], p[1], found + 1));
        ck_assert(memcmp(found, found + 1, sizeof *found) == 0);
    }
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
    ADD_CASE(suite, "loads",
             eq_14_3_13_14_17_18_a_run_grows_if_its_load_is_above_1,
             eq_14_4_the_longest_step_parts_the_loads,
             a_load_that_overflows_at_every_step_is_reported);
    ADD_CASE(suite, "copies", a_copied_method_is_as_good);
    return run_suite(suite);
}
