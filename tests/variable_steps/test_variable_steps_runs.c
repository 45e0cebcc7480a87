/* tests/variable_steps/test_variable_steps_runs.c -- H 22: runs.
 * Run alone: make test-variable_steps_runs */
#include <fvi/fvi.h>
#include "run/whole_run.h"
#include "harness/ulp.h"
#include "variable_step/variable_step.h"

#include "variable_steps_runs_ref.h"

#include <gsl/gsl_fit.h>
#include <gsl/gsl_math.h>
#include <stdlib.h>

enum { N = 200 };
static double T[N + 1], X[N + 1], V[N + 1], x[N + 1], p[N + 1];

/* One mass 1 on a spring 1, damping 1. */
static const double one = 1;
static fvi_system spring(const double *aT)
{
    return (fvi_system){ 1,
                         &one,
                         &one,
                         fvi_potential_harmonic(&one),
                         aT ? fvi_force_step(aT) : (fvi_force){ 0 },
                         NULL, NULL };
}

static fvi_run run_of(const fvi_system *system, double alpha, const double *x0,
                      const double *p0, double step_error)
{
    fvi_run run = fvi_run_default(system, x0, p0, 20. / N, N);
    run.alpha = alpha;
    run.step_error = step_error;
    return run;
}

/* ---- a step ---- */

//> fixed
/* Steps of given lengths: a tolerance so large that they all pass, and jumps where they
 * end. (22.14) with a linear spring: x and p after steps that grow and fall by 8, none
 * of them on the lattice. Both are below 5; 1e-12 for the inverse of L and four steps.
 * Seen: 0.007 of that. */
START_TEST(eq_22_14_steps_of_given_lengths)
{
    static const double ends[] = { 0.5, 1.3, 1.3 + 0.1 };
    const double aT[] = { 8, 9 }, x0 = 0.25, p0 = 0.5;
    size_t ran = 0;
    for (size_t r = 0; r < LEN(ref_runs); r++) {
        ran++;
        fvi_system system = spring(aT);
        system.force.jumps = ends;
        system.force.jump_count = LEN(ends);
        fvi_run run = run_of(&system, ref_runs[r].alpha, &x0, &p0,
                             ref_runs[r].s == 6 ? 1e-3 : 1e-8);
        run.past = FVI_INITIAL_HISTORY_CAPUTO;
        run.h = 1.5;
        run.steps = 1;
        fvi_stepper *s;
        ck_assert_int_eq(fvi_stepper_start(&fvi_variable_step, &run, &s,
                                           NULL), 0);
        s->run.step_error = 1e9; /* of the stages it has been asked before */
        fvi_variable_step_state *o = s->method_state;
        o->next_exponent = o->first_exponent = 3;
        fvi_modes_free(o->modes);
        o->modes = NULL;
        if (o->beta != 0) /* which are coarse for 6 stages */
            ck_assert_int_eq(fvi_modes_alloc(o->rule, FVI_MODES_FINE, o->beta,
                                             1, o->T, o->least, &o->modes),
                             0);
        for (size_t k = 0; k < 4; k++) {
            ck_assert_int_eq(fvi_stepper_step(s), 0);
            const double *want = ref_runs[r].want + (k < 2 ? 0 : 2 * k - 2);
            if (k == 1)
                continue;
            ck_assert_near(s->x[0], want[0], 1e-12, "s=%zu alpha=%g step %zu",
                           ref_runs[r].s, ref_runs[r].alpha, k);
            ck_assert_near(s->p[0], want[1], 1e-12, "s=%zu alpha=%g step %zu",
                           ref_runs[r].s, ref_runs[r].alpha, k);
        }
        ck_assert(s->t == 1.5 && s->k == 1);
        fvi_step_statistics counts;
        ck_assert_int_eq(fvi_stepper_statistics(s, &counts), 0);
        ck_assert(counts.steps == 4 && counts.rejected == 0
                  && counts.form == 'D' && counts.stages == (int)ref_runs[r].s);
        fvi_stepper_free(s);
    }
    ck_assert_uint_ge(ran, 10);
}
END_TEST
//< fixed

/* ---- against the exact solution ---- */

/* The largest errors of x and p over the rows of a run of 1 + n rows. */
static double error_of(const fvi_run *run, const fvi_linear_oscillator *problem,
                       double *of_p)
{
    for (size_t k = 0; k <= run->steps; k++)
        T[k] = (double)k * run->h;
    ck_assert_int_eq(fvi_exact_at(problem, run->steps + 1, T, X, V, NULL), 0);
    ck_assert_int_eq(fvi_trajectory(&fvi_variable_step, run, x, p, NULL), 0);
    double worst = 0;
    *of_p = 0;
    for (size_t k = 0; k <= run->steps; k++) {
        worst = larger(worst, fabs(x[k] - X[k]));
        *of_p = larger(*of_p, fabs(p[k] - V[k]));
    }
    return worst;
}

//> alphas
/* Every past, alpha from 0 to 1, a force that ends between all rows: the error over all
 * rows, the first and those behind the jump among them, is below the tolerance of a step,
 * and p within 100 times that; 1e-13 and 3e-12 for the rounding of fvi_exact_at and of the
 * run. Seen: 0.23 of that. */
START_TEST(all_alphas_all_pasts_all_rows)
{
    static const double alphas[] = { 0,    0.02, 0.2,  0.4, 0.499999, 0.5,
                                     0.51, 0.6,  0.75, 0.9, 0.97,     1 };
    static const double errors[] = { 1e-4, 1e-7, 1e-10, 1e-13 };
    const double aT[] = { 8, 0.7310585 };
    const fvi_system system = spring(aT);
    for (size_t a = 0; a < LEN(alphas); a++)
        for (int past = FVI_INITIAL_HISTORY_HELD; past <= FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE;
             past++)
            for (size_t e = 0; e < LEN(errors); e++) {
                const double v0 = 0.5, x0 = past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE
                                                    && alphas[a] > 0.5
                                                ? 0
                                                : 1;
                const fvi_linear_oscillator problem = { .m = 1,
                                             .c = 1,
                                             .rho = 1,
                                             .alpha = alphas[a],
                                             .past = (fvi_initial_history)past,
                                             .x0 = x0,
                                             .v0 = v0,
                                             .forcing = FVI_FORCING_STEP,
                                             .A = aT[0],
                                             .T = aT[1] };
                fvi_run run = run_of(&system, alphas[a], &x0, &v0, errors[e]);
                run.past = (fvi_initial_history)past;
                double of_p, of_x = error_of(&run, &problem, &of_p);
                ck_assert_near(of_x, 0, errors[e] + 1e-13,
                               "alpha %g, past %d, %g", alphas[a], past,
                               errors[e]);
                ck_assert_near(of_p, 0, 100 * errors[e] + 3e-12,
                               "p: alpha %g, past %d, %g", alphas[a], past,
                               errors[e]);
            }
}
END_TEST
//< alphas

/* The same by power series in 60 digits, without fvi_exact_at. 1e-13, 1e-12. Seen: 0.02 of that. */
START_TEST(the_end_of_runs_by_power_series)
{
    for (size_t r = 0; r < LEN(ref_exact); r++) {
        const double aT[] = { ref_exact[r].F, ref_exact[r].t == 20 ? 1 : 9 };
        const fvi_system system = spring(aT);
        fvi_run run = run_of(&system, ref_exact[r].alpha, &ref_exact[r].x0,
                             &ref_exact[r].v0, 1e-12);
        run.past = ref_exact[r].past == 'c' ? FVI_INITIAL_HISTORY_CAPUTO
                                            : FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE;
        run.h = ref_exact[r].t / N;
        if (ref_exact[r].F != 0 && ref_exact[r].t == 20)
            continue; /* a constant force for 20 */
        ck_assert_int_eq(fvi_trajectory(&fvi_variable_step, &run, x, p, NULL), 0);
        ck_assert_near(x[N], ref_exact[r].x, 1e-13, "row %zu", r);
        ck_assert_near(p[N], ref_exact[r].p, 1e-12, "row %zu", r);
    }
}
END_TEST

/* Dampings from rho = 1e6, which is stiff, to 1e-3, and a relaxation of 10^7. The sizes
 * of x are 1 and less. Seen: 0.01 of the bound. */
START_TEST(every_strength_and_long_relaxations)
{
    static const struct {
        double alpha, rho, c, end;
        size_t most;
    } cases[] = { { 0.2, 1e6, 1, 20, 60 },  { 0.75, 1e6, 1, 20, 160 },
                  { 0.2, 1e-3, 1, 20, 90 }, { 0.75, 1e-3, 1, 20, 90 },
                  { 0.75, 1, 1, 1e7, 250 }, { 0.3, 1, 1, 1e7, 250 } };
    for (size_t i = 0; i < LEN(cases); i++) {
        const double x0 = 1, p0 = 0.25;
        fvi_system system = spring(NULL);
        system.damping = &cases[i].rho;
        fvi_run run = run_of(&system, cases[i].alpha, &x0, &p0, 1e-11);
        run.h = cases[i].end / N;
        const fvi_linear_oscillator problem = { .m = 1,
                                     .c = cases[i].c,
                                     .rho = cases[i].rho,
                                     .alpha = cases[i].alpha,
                                     .x0 = x0,
                                     .v0 = p0 };
        double of_p;
        ck_assert_near(error_of(&run, &problem, &of_p), 0, 1e-11 + 1e-13,
                       "case %zu", i);
        fvi_stepper *s;
        ck_assert_int_eq(fvi_stepper_start(&fvi_variable_step, &run, &s,
                                           NULL), 0);
        ck_assert_int_eq(fvi_stepper_advance_to(s, (double)N * run.h, NULL, NULL), 0);
        fvi_step_statistics n;
        ck_assert_int_eq(fvi_stepper_statistics(s, &n), 0);
        ck_assert_uint_le(n.steps, cases[i].most);
        fvi_stepper_free(s);
    }
}
END_TEST

/* ---- the order ---- */

enum { DENSE = 4000 };
static double fine[DENSE + 1], coarse[DENSE + 1];

/* The rows of a run, and how many steps it took; 0 if it failed. */
static size_t steps_taken(const fvi_run *run, double *rows)
{
    fvi_stepper *s;
    fvi_step_statistics counts = { 0 };
    int status = fvi_stepper_start(&fvi_variable_step, run, &s, NULL);
    for (size_t k = 0; !status && k <= run->steps; k++)
        status = fvi_stepper_advance_to(s, (double)k * run->h, rows + k, NULL);
    if (!status)
        status = fvi_stepper_statistics(s, &counts);
    fvi_stepper_free(s);
    return status ? 0 : counts.steps;
}

/* The slope of -log error against log steps, tolerances of a step from 1e-4 to 1e-12. The
 * truth is a run with 1e-15. */
static double order_in_steps(fvi_run run)
{
    double log_steps[9], log_error[9], c0, c1, cov00, cov01, cov11, rest;
    run.step_error = 1e-15;
    ck_assert_uint_gt(steps_taken(&run, fine), 0);
    for (int e = 4; e <= 12; e++) {
        run.step_error = pow(10, -e);
        const size_t steps = steps_taken(&run, coarse);
        ck_assert_uint_gt(steps, 0);
        double off = 0;
        for (size_t k = 0; k <= run.steps; k++)
            off = larger(off, fabs(coarse[k] - fine[k]));
        log_steps[e - 4] = log((double)steps);
        log_error[e - 4] = -log(off);
    }
    gsl_fit_linear(log_steps, 1, log_error, 1, 9, &c0, &c1, &cov00, &cov01,
                   &cov11, &rest);
    return c1;
}

/* Eight stages, and the power is about 10 in the number of steps, over all t, with every
 * past, from a start that moves, for springs that are not linear: no 14 = 2 s - 2, which
 * equal steps have far from the start. */
START_TEST(the_order_in_the_number_of_steps)
{
    static const double alphas[] = { 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.75, 0.9 };
    const double half = 0.5, cg[2] = { 1, 1 };
    for (size_t i = 0; i < 6 * LEN(alphas); i++) {
        const fvi_initial_history past = (fvi_initial_history)(i % 3);
        const double alpha = alphas[i / 6];
        const fvi_system system = { 1,
                                    &one,
                                    &half,
                                    i % 6 < 3 ? fvi_potential_duffing(cg)
                                              : fvi_potential_pendulum(&one),
                                    { 0 },
                                    NULL, NULL };
        fvi_run run =
            fvi_run_default(&system, &one, &half, 20. / DENSE, DENSE);
        run.alpha = alpha;
        run.past = past;
        if (!fvi_initial_history_solvable(past, alpha, half, one))
            continue;
        const double order = order_in_steps(run);
        ck_assert_msg(order > fvi_variable_step.lowest
                          && order < fvi_variable_step.highest,
                      "alpha = %g, past %d: %g", alpha, (int)past, order);
        seen(order, "order");
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("variable_steps: runs");
    ADD_CASE(suite, "step", eq_22_14_steps_of_given_lengths);
    ADD_CASE(suite, "order", the_order_in_the_number_of_steps);
    ADD_CASE(suite, "exact", all_alphas_all_pasts_all_rows,
             the_end_of_runs_by_power_series,
             every_strength_and_long_relaxations);
    return run_suite(suite);
}
