/* tests/variable_steps/test_variable_steps_use.c -- H 22: many masses, undeclared jumps, a wanted error.
 * Run alone: make test-variable_steps_use */
#include <fvi/fvi.h>
#include "run/whole_run.h"
#include "error_control/variable_step_search.h"
#include "error_control/step_search.h"
#include "harness/ulp.h"
#include "variable_step/variable_step.h"

#include "adaptive_problems.h"
#include "five_masses.h"

static double x[(N + 1) * D], y[(N + 1) * D], p[(N + 1) * D], q[(N + 1) * D];

/* ---- many masses ---- */

static double distance(size_t n, const double *a, const double *b)
{
    double most = 0;
    for (size_t i = 0; i < n; i++)
        most = larger(most, fabs(a[i] - b[i]));
    return most;
}

/* The springs of a chain, with a full Hessian, or as if each mass was alone. */
static const double cg[2] = { 2, 0.7 };
static int full_hessian(size_t d, const double *at, void *params, double *H)
{
    double band[2 * D];
    int status = fvi_potential_chain(params).hessian(d, at, params, band);
    for (size_t i = 0; i < d; i++)
        for (size_t j = 0; j < d; j++)
            H[i * d + j] = i == j       ? band[2 * i]
                           : i + 1 == j ? band[2 * i + 1]
                           : j + 1 == i ? band[2 * j + 1]
                                        : 0;
    return status;
}

//> ways
/* One equation, solved with one Hessian for all stages, by Newton's method for a band
 * matrix and for a full one, and by the fixed-point iteration: the same motion to 20 times
 * the tolerance of a step; and against
 * fvi_lobatto_m4, whose order is 4 at least, its last 30 rows to the square of its distance
 * from a run with steps twice as long. Seen: 6e-5 of the first. */
START_TEST(many_masses_by_four_ways_and_by_lobatto)
{
    fvi_system system = {
        D, mass, rho, fvi_potential_chain(cg), fvi_force_cosine(cg), NULL, NULL
    };
    fvi_run run = run_of(&system, 1e-11);
    ck_assert_int_eq(fvi_trajectory(&fvi_variable_step, &run, x, p, NULL), 0);
    fvi_stepper *s;
    ck_assert_int_eq(fvi_stepper_start(&fvi_variable_step, &run, &s, NULL), 0);
    ((fvi_variable_step_state *)s->method_state)->solve = FVI_SOLVE_TOGETHER;
    for (size_t k = 0; k <= N; k++)
        ck_assert_int_eq(fvi_stepper_advance_to(s, (double)k * run.h, y + k * D, q + k * D),
                         0);
    ck_assert_ptr_nonnull(s->newton);
    fvi_stepper_free(s);
    ck_assert_near(distance((N + 1) * D, x, y), 0, 20e-11, "band");
    ck_assert_near(distance((N + 1) * D, p, q), 0, 200e-11, "band, p");
    system.potential.hessian = full_hessian;
    system.potential.diagonals = 0;
    for (int together = 0; together < 2; together++) {
        ck_assert_int_eq(fvi_stepper_start(&fvi_variable_step, &run, &s,
                                           NULL), 0);
        fvi_variable_step_state *o = s->method_state;
        ck_assert(o->solve == FVI_SOLVE_COUPLED && !o->band);
        o->solve = together ? FVI_SOLVE_TOGETHER : o->solve;
        ck_assert_int_eq(fvi_stepper_advance_to(s, N * run.h, y, NULL), 0);
        fvi_stepper_free(s);
        ck_assert_near(distance(D, x + N * D, y), 0, 20e-11, "full");
    }
    system.potential = fvi_potential_chain(cg);
    double far[2];
    for (size_t j = 0; j < 2; j++) {
        run.h = 0.125 / (double)(4 << j);
        run.steps = N * ((size_t)4 << j);
        double *rows = malloc((run.steps + 1) * D * sizeof *rows);
        ck_assert_int_eq(fvi_trajectory(&fvi_lobatto_m4, &run, rows, NULL, NULL),
                         0);
        far[j] = distance(D, x + N * D, rows + run.steps * D);
        free(rows);
    }
    ck_assert_msg(far[1] < 1e-7 && far[1] < far[0] / 12, "%g %g", far[0],
                  far[1]);
}
END_TEST
//< ways

/* A chain of many masses takes one Hessian a step, mostly: 1.3 of them at most, and
 * nothing is done for all stages together. Seen: 1. It is that of the middle stage, not
 * half a step off: the gradients of all stages are evaluated 4.25 times at most, in the
 * mean of a run. Seen: 3.9; 4.6 with the Hessian at the beginning of the step. */
static size_t hessians, gradients;
static int counted_hessian(size_t d, const double *at, void *params, double *H)
{
    hessians++;
    return fvi_potential_chain(params).hessian(d, at, params, H);
}
static int counted_gradient(size_t d, const double *at, void *params, double *grad)
{
    gradients++;
    return fvi_potential_chain(params).gradient(d, at, params, grad);
}
START_TEST(a_chain_takes_one_hessian_a_step)
{
    fvi_system system = {
        D, mass, rho, fvi_potential_chain(cg), fvi_force_cosine(cg), NULL, NULL
    };
    system.potential.hessian = counted_hessian;
    system.potential.gradient = counted_gradient;
    for (double tolerance = 1e-3; tolerance > 1e-11; tolerance /= 100) {
        fvi_run run = run_of(&system, tolerance);
        fvi_stepper *s;
        fvi_step_statistics counts;
        hessians = gradients = 0;
        ck_assert_int_eq(fvi_stepper_start(&fvi_variable_step, &run, &s,
                                           NULL), 0);
        ck_assert_int_eq(fvi_stepper_advance_to(s, N * run.h, NULL, NULL), 0);
        ck_assert_int_eq(fvi_stepper_statistics(s, &counts), 0);
        ck_assert_ptr_null(s->newton);
        const double steps = (double)(counts.steps + counts.rejected),
                     each = (double)hessians / steps,
                     gradients_per_step = (double)gradients / steps
                             / (double)((fvi_variable_step_state *)s->method_state)->rule->s;
        fvi_stepper_free(s);
        ck_assert_msg(each <= 1.3, "%g Hessians a step", each);
        ck_assert_msg(gradients_per_step <= 4.25, "%g gradients a step", gradients_per_step);
        seen(each, "Hessians a step");
        seen(gradients_per_step, "gradients a step");
    }
}
END_TEST

/* Stiff springs, without damping, form M: the energy is kept to 100 times the tolerance.
 * Seen: 8e-4 of that. */
START_TEST(stiff_chains_keep_their_energy)
{
    const double stiff[2] = { 1e4, 1e4 }, none[D] = { 0 };
    const fvi_system system = { D,     mass, none, fvi_potential_chain(stiff),
                                { 0 }, NULL, NULL };
    fvi_run run = run_of(&system, 1e-10);
    double E[N + 1];
    run.h = 0.02;
    ck_assert_int_eq(fvi_trajectory(&fvi_variable_step, &run, NULL, NULL, E), 0);
    for (size_t k = 1; k <= N; k++)
        ck_assert_near(E[k], E[0], 1e-8 * E[0], "k=%zu", k);
    fvi_stepper *s;
    fvi_step_statistics counts;
    ck_assert_int_eq(fvi_stepper_start(&fvi_variable_step, &run, &s, NULL), 0);
    ck_assert_int_eq(fvi_stepper_statistics(s, &counts), 0);
    ck_assert(counts.form == 'M' && counts.stages == 8 && counts.steps == 0);
    fvi_stepper_free(s);
}
END_TEST

/* Masses that do not know of each other, run together and alone: Newton's method for each
 * coordinate, and one linear solution; kinds of coordinates are not mixed up. 20 times the
 * tolerance of a step. Seen: 7e-4 of that. */
START_TEST(masses_alone_and_together)
{
    const fvi_potential potentials[] = { fvi_potential_pendulum(cg),
                                         fvi_potential_harmonic(cg) };
    for (size_t u = 0; u < 2; u++) {
        const fvi_system all = { D, mass, rho, potentials[u], { 0 }, NULL, NULL };
        const fvi_run run = run_of(&all, 1e-11);
        ck_assert_int_eq(fvi_trajectory(&fvi_variable_step, &run, x, p, NULL), 0);
        for (size_t j = 0; j < D; j++) {
            const fvi_system alone = { 1,     mass + j, rho + j, potentials[u],
                                       { 0 }, NULL, NULL };
            fvi_run of_one = run;
            of_one.system = &alone;
            of_one.x0 = start + j;
            of_one.p0 = push + j;
            ck_assert_int_eq(fvi_trajectory(&fvi_variable_step, &of_one, y, q, NULL),
                             0);
            for (size_t k = 0; k <= N; k++)
                ck_assert_near(x[k * D + j], y[k], 20e-11, "u=%zu j=%zu k=%zu",
                               u, j, k);
        }
    }
}
END_TEST

/* ---- jumps that nobody declared ---- */

static double jump_at = 0.7310585;
static int jumping(double t, size_t d, void *params, double *F)
{
    (void)params;
    for (size_t i = 0; i < d; i++)
        F[i] = t < jump_at ? 8 : 0;
    return 0;
}

//> undeclared
/* A jump is found by steps that are rejected: 100 times the tolerance, and some more
 * steps. Declared, it is met. Seen: 0.02 of that. */
START_TEST(a_jump_that_is_not_declared_is_found)
{
    const double none = 0, aT[] = { 8, jump_at };
    fvi_system system = {
        1, &one, &one, fvi_potential_harmonic(&one), { .value = jumping }, NULL, NULL
    };
    for (int e = 6; e <= 12; e += 3) {
        fvi_run run = fvi_run_default(&system, &none, &none, 0.25, N);
        fvi_step_statistics counts[2];
        fvi_stepper *s;
        run.alpha = 0.75;
        run.step_error = pow(10, -e);
        for (size_t declared = 0; declared < 2; declared++) {
            system.force =
                declared ? fvi_force_step(aT) : (fvi_force){ .value = jumping };
            ck_assert_int_eq(fvi_stepper_start(&fvi_variable_step, &run, &s,
                                               NULL), 0);
            double *to = declared ? y : x;
            for (size_t k = 0; k <= N; k++)
                ck_assert_int_eq(fvi_stepper_advance_to(s, (double)k * run.h, to + k, NULL),
                                 0);
            ck_assert_int_eq(fvi_stepper_statistics(s, counts + declared), 0);
            fvi_stepper_free(s);
        }
        ck_assert_near(distance(N + 1, x, y), 0, 100 * run.step_error, "%d", e);
        ck_assert(counts[0].rejected > counts[1].rejected);
        ck_assert_uint_le(counts[0].steps, counts[1].steps + 120);
    }
}
END_TEST
//< undeclared

/* ---- a wanted error ---- */

//> promise
/* Sixty random problems, three of four with an exact motion: the true error is at most 1.2
 * times the wanted one; no more than two may say nothing, as used_by has it. Seen: 7e-3,
 * and none. */
START_TEST(a_wanted_error_is_had_or_refused)
{
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    size_t silent = 0;
    for (unsigned long i = 0; i < 60; i++) {
        static adaptive_problem problem;
        char text[600];
        gsl_rng_set(random, 7000 + i);
        draw(random, i % 4 > 0, &problem);
        const double used = used_by(&problem, i % 4 > 0);
        describe_problem(&problem, text, sizeof text);
        ck_assert_msg(used <= 1, "%g of 1.2 E: %s", used, text);
        seen_worst(larger(0, used), "of 1.2 E");
        silent += used < 0;
    }
    seen((double)silent, "say nothing");
    ck_assert_uint_le(silent, 2);
    gsl_rng_free(random);
}
END_TEST

//< promise

/* The arguments, the rows, and how far a search goes. */
START_TEST(a_search_checks_and_ends)
{
    const fvi_system system = { 1,     &one, &one, fvi_potential_harmonic(&one),
                                { 0 }, NULL, NULL };
    const fvi_run run = fvi_run_default(&system, &one, &one, 0.25, 8);
    fvi_variable_step_found found = { .estimate = 7 };
    ck_assert_int_eq(fvi_variable_step_search(NULL, 0, NULL, 1, 99, x, p, &found),
                     FVI_EFAULT);
    ck_assert_int_eq(fvi_variable_step_search(&run, 0, NULL, 1, 99, NULL, p, &found),
                     FVI_EFAULT);
    ck_assert_int_eq(fvi_variable_step_search(&run, 0, NULL, 0, 99, x, p, &found), FVI_EDOM);
    ck_assert(found.estimate == 7);
    ck_assert_int_eq(fvi_variable_step_search(&run, 0, NULL, 1e-9, 3, x, p, &found),
                     FVI_ETOL);
    ck_assert(found.estimate == GSL_POSINF);
    ck_assert_int_eq(fvi_variable_step_search(&run, 0, NULL, 1e-18, 1 << 20, x, p, &found),
                     FVI_ETOL);
    ck_assert(found.estimate > 1e-15 && found.estimate < 1e-12);
    ck_assert_int_eq(fvi_variable_step_search(&run, 0, NULL, 1e-9, 1 << 20, x, NULL, &found),
                     0);
    ck_assert(found.estimate <= 1e-9 && found.counts.steps > 8);
    ck_assert_int_eq(fvi_step_search(&fvi_variable_step, &run, 1e-3, 99, x, p,
                                     &(fvi_step_found){ 0 }),
                     FVI_EUNSUP);
}
END_TEST

/* U = x^3, and how often its slope was asked for. */
static int cube(size_t d, const double *at, void *params, double *value)
{
    (void)d, (void)params;
    *value = at[0] * at[0] * at[0];
    return 0;
}

static int slope_of_cube(size_t d, const double *at, void *asked, double *g)
{
    (void)d;
    ++*(size_t *)asked;
    g[0] = 3 * at[0] * at[0];
    return 0;
}

static int bend_of_cube(size_t d, const double *at, void *params, double *H)
{
    (void)d, (void)params;
    H[0] = 6 * at[0];
    return 0;
}

/* It runs away at t = 3.247. Sixteen runs, each by finer steps up to there, take 45 times as
 * long as five, which are enough to know. */
START_TEST(a_motion_that_runs_away_is_given_up)
{
    size_t asked = 0;
    const double damping = 0.2, v0 = 0.5;
    fvi_system system = { .d = 1, .mass = &one, .damping = &damping };
    system.potential = (fvi_potential){ .value = cube,
                                        .gradient = slope_of_cube,
                                        .hessian = bend_of_cube,
                                        .params = &asked };
    fvi_run run = fvi_run_default(&system, &one, &v0, 1.5, 4);
    run.alpha = 0.3;
    fvi_variable_step_found found;
    ck_assert_int_eq(fvi_variable_step_search(&run, 0, NULL, 1e-3, 1 << 24, x, p, &found),
                     FVI_EMAXITER);
    seen((double)asked, "slopes asked for");
    ck_assert_uint_lt(asked, 50000000);
    run.steps = 2; /* to t = 3, where it is on its way */
    ck_assert_int_eq(fvi_variable_step_search(&run, 0, NULL, 1e-3, 1 << 24, x, p, &found), 0);
    ck_assert(found.estimate <= 1e-3);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("variable_steps: use");
    ADD_CASE(suite, "masses", many_masses_by_four_ways_and_by_lobatto,
             a_chain_takes_one_hessian_a_step, stiff_chains_keep_their_energy,
             masses_alone_and_together);
    ADD_CASE(suite, "jumps", a_jump_that_is_not_declared_is_found);
    ADD_CASE(suite, "error", a_wanted_error_is_had_or_refused,
             a_search_checks_and_ends, a_motion_that_runs_away_is_given_up);
    return run_suite(suite);
}
