/* tests/adjoint/test_adjoint_identities.c -- H 23: identities of the adjoint run (reciprocity, Taylor's remainder),
 * and its errors.
 * Run alone: make test-adjoint_identities */
#include "adjoint_runs.h"
#include "run/whole_run.h"

#include "adjoint_simple.h"
#include "system/larger.h"

#include <gsl/gsl_math.h>

static const fvi_method *const methods[] = { &fvi_fractional, &fvi_cq2_shifted,
                                             &fvi_cq_bdf2 };
static const fvi_initial_history pasts[] = { FVI_INITIAL_HISTORY_HELD, FVI_INITIAL_HISTORY_CAPUTO,
                                  FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE };

/* J = x_N, or J = p_N: *params is 0 or 1. */
static int last_row(size_t k, size_t d, const double *x, const double *p,
                    void *params, double *Jx, double *Jp)
{
    (void)k, (void)d, (void)x;
    if (p)
        *(*(const int *)params ? Jp : Jx) += 1;
    return 0;
}

static fvi_system oscillator(const double *m, const double *rho,
                             fvi_potential potential)
{
    return (fvi_system){ 1, m, rho, potential, { 0 }, NULL, NULL };
}

/* ---- the mirror is the adjoint ---- */

/* (23.5) For a quadratic U the run that is kicked at 0 and read backwards says what a
 * kick at k does to x_N: x_{N-k} of x0 = 0, p0 = 1 is dx_N/dp_k = (dx_N/dF_k)/h. The
 * kick is one more row of the same linear equations, so only roundings differ: N of
 * them, each below u max|x| and carried along by a damped oscillator. Seen: 0.01 of it. */
START_TEST(eq_23_5_a_run_read_backwards_is_the_adjoint)
{
    enum { N = 300 };
    static double x[N + 1], force[N + 1];
    const double one = 1, rho = 0.375, zero = 0;
    const fvi_system system =
        oscillator(&one, &rho, fvi_potential_harmonic(&one));
    int momentum = 0;
    const fvi_objective J = { .slopes = last_row, .params = &momentum };
    for (size_t i = 0; i < 3; i++) {
        fvi_run run = fvi_run_default(&system, &zero, &one, 1. / 16, N);
        run.alpha = 0.3125 + 0.25 * (double)i;
        run.past = FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE; /* no drift of p0 */
        run.kappa = 0.25 + 0.25 * (double)i;
        const fvi_sensitivities want = { .force = force };
        ck_assert_int_eq(
            fvi_adjoint(&fvi_fractional, &run, NULL, NULL, &J, &want),
            FVI_SUCCESS);
        fvi_run mirror = run;
        mirror.kappa = 1 - run.kappa;
        ck_assert_int_eq(
            fvi_trajectory(&fvi_fractional, &mirror, x, NULL, NULL),
            FVI_SUCCESS);
        for (size_t k = 1; k <= N; k++)
            ck_assert_near(force[k] / run.h, x[N - k], N * U, "alpha=%g k=%zu",
                           run.alpha, k);
    }
}
END_TEST

/* If U is not quadratic, the mirror is another motion. */
START_TEST(eq_23_5_the_mirror_of_a_pendulum_is_not_its_adjoint)
{
    enum { N = 300 };
    static double x[N + 1], force[N + 1];
    const double one = 1, rho = 0.375, zero = 0;
    const fvi_system system =
        oscillator(&one, &rho, fvi_potential_pendulum(&one));
    int momentum = 0;
    const fvi_objective J = { .slopes = last_row, .params = &momentum };
    fvi_run run = fvi_run_default(&system, &zero, &one, 1. / 16, N);
    const fvi_sensitivities want = { .force = force };
    ck_assert_int_eq(fvi_adjoint(&fvi_fractional, &run, NULL, NULL, &J, &want),
                     FVI_SUCCESS);
    ck_assert_int_eq(fvi_trajectory(&fvi_fractional, &run, x, NULL, NULL),
                     FVI_SUCCESS);
    double away = 0;
    for (size_t k = 1; k <= N; k++)
        away = larger(away, fabs(force[k] / run.h - x[N - k]));
    seen(away, "the difference");
    ck_assert(away > 0.05);
}
END_TEST

/* (23.4) as it stands, with direct sums, is what the library does, digit by digit but
 * for the order of the sums: of N products each, N u relative to the largest mu. */
START_TEST(eq_23_4_the_adjoint_run_as_it_stands)
{
    enum { N = 200 };
    static double x[N + 1], p[N + 1], Jx[N + 1], mu[N + 1], force[N + 1];
    const double cg[] = { 1, 0.5 }, m = 1.25, rho = 0.375, x0 = 1, p0 = 0.5;
    const fvi_system system = oscillator(&m, &rho, fvi_potential_duffing(cg));
    fvi_run run = fvi_run_default(&system, &x0, &p0, 1. / 16, N);
    run.alpha = 0.7;
    run.kappa = 0.3;
    const fvi_objective J = { .slopes = to_sine, .params = &run };
    double Jp = 0, q, by_p0, largest = 0;
    const fvi_sensitivities want = { .force = force, .p0 = &by_p0 };
    ck_assert_int_eq(fvi_trajectory(&fvi_fractional, &run, x, p, NULL),
                     FVI_SUCCESS);
    for (size_t k = 0; k <= N; k++) {
        Jx[k] = 0;
        to_sine(k, 1, x + k, p + k, &run, Jx + k, &Jp);
    }
    adjoint_run(N, run.h, run.kappa, run.alpha, m, rho, cg[0], cg[1], x, Jx,
                Jp, mu, &q);
    ck_assert_int_eq(fvi_adjoint(&fvi_fractional, &run, x, p + N, &J, &want),
                     FVI_SUCCESS);
    for (size_t k = 0; k <= N; k++)
        largest = larger(largest, fabs(mu[k]));
    for (size_t k = 1; k <= N; k++)
        ck_assert_near(force[k] / run.h, mu[N - k], N * U * largest, "k=%zu",
                       k);
    ck_assert_near(by_p0, mu[N], N * U * largest, "p0");
}
END_TEST

/* ---- Taylor's test ---- */

enum { KINDS = 4 };

/* Numbers of a run of two coordinates, moved by t along a direction. */
typedef struct {
    double x0[2], p0[2], mass[2], rho[2], alpha, cg[2];
} numbers;

static double moved(const fvi_method *method, fvi_initial_history past, int kind, double t,
                    slopes *s)
{
    enum { N = 80 };
    static double x[2 * (N + 1)], p[2 * (N + 1)];
    const double start = past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE ? 0 : 1;
    numbers n = { { start - 0.3 * t * start, start * (-0.5 + 0.2 * t) },
                  { 0.5 + t, 1 - t },
                  { 1 + 0.2 * t, 1.5 - 0.3 * t },
                  { 0.4 + 0.3 * t, 0.1 + 0.1 * t },
                  0.6 + 0.1 * t,
                  { 1 + 0.5 * t,
                    (kind == 3 ? 0 : 0.5) + 0.4 * t * (kind != 3) } };
    const fvi_potential potentials[KINDS] = { fvi_potential_harmonic(n.cg),
                                              fvi_potential_duffing(n.cg),
                                              fvi_potential_pendulum(n.cg),
                                              fvi_potential_chain(n.cg) };
    const fvi_system system = {
        2, n.mass, n.rho, potentials[kind], { 0 }, NULL, NULL
    };
    fvi_run run = fvi_run_default(&system, n.x0, n.p0, 1. / 16, N);
    run.alpha = n.alpha;
    run.past = past;
    run.kappa = 0.4;
    ck_assert_int_eq(fvi_trajectory(method, &run, x, p, NULL), FVI_SUCCESS);
    double J = 0;
    for (size_t i = 0; i < 2; i++) {
        for (size_t k = 1; k <= N; k++) {
            const double away = x[2 * k + i] - sin((double)k * run.h);
            J += run.h / 2 * away * away;
        }
        J += x[2 * N + i] / 2 + x[2 * N + i] * p[2 * N + i] * p[2 * N + i] / 4;
    }
    if (s) {
        const fvi_objective objective = { .slopes = to_sine, .params = &run };
        s->to.sensitivity = fvi_parameter_gradient_of(&system.potential);
        ck_assert_int_eq(
            fvi_adjoint(method, &run, x, p + 2 * N, &objective, &s->to),
            FVI_SUCCESS);
    }
    return J;
}

/* The derivative along that direction. */
static double slope_along(const slopes *s, fvi_initial_history past, int kind)
{
    const fvi_sensitivities *g = &s->to;
    const double start = past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE ? 0 : 1;
    double sum = g->p0[0] - g->p0[1] + 0.2 * g->mass[0] - 0.3 * g->mass[1]
                 + 0.3 * g->damping[0] + 0.1 * g->damping[1] + 0.1 * *g->alpha
                 + 0.5 * g->parameters[0];
    if (start > 0)
        sum += -0.3 * g->x0[0] + 0.2 * g->x0[1];
    return sum + (kind == 1 ? 0.4 * g->parameters[1] : 0);
}

/* J(t) - J(0) - t J'(0) is C t^2 + O(t^3): a quarter at half of t, within a tenth. What
 * rounding leaves of it, u J / (C t^2), is below 1e-8 here. */
START_TEST(eq_23_6_what_the_gradient_leaves_is_of_order_2)
{
    size_t count = 0;
    for (size_t i = 0; i < LEN(methods) * LEN(pasts) * KINDS; i++, count++) {
        const fvi_method *method = methods[i % LEN(methods)];
        const fvi_initial_history past = pasts[i / LEN(methods) % LEN(pasts)];
        const int kind = (int)(i / LEN(methods) / LEN(pasts));
        fvi_system two = { .d = 2 };
        fvi_run run = { .system = &two };
        slopes *s = slopes_of(&run, 81);
        const double J = moved(method, past, kind, 0, s), t = 1e-3;
        const double slope = slope_along(s, past, kind);
        const double whole = moved(method, past, kind, t, NULL) - J - t * slope,
                     half = moved(method, past, kind, t / 2, NULL) - J
                            - t / 2 * slope;
        ck_assert_near(whole / half, 4, 0.4, "%s past %d potential %d",
                       method->name, (int)past, kind);
        slopes_free(s);
    }
    ck_assert_uint_eq(count, 36);
}
END_TEST

/* ---- what is refused ---- */

static int refuses(size_t k, size_t d, const double *x, const double *p,
                   void *params, double *Jx, double *Jp)
{
    (void)d, (void)x, (void)p, (void)Jx, (void)Jp;
    return k == *(const size_t *)params ? -7 : 0;
}

static int not_a_number(size_t k, size_t d, const double *x, const double *p,
                        void *params, double *Jx, double *Jp)
{
    (void)k, (void)d, (void)x, (void)p, (void)params, (void)Jp;
    Jx[0] = GSL_NAN;
    return 0;
}

START_TEST(bad_arguments_of_an_adjoint_are_refused)
{
    const double one = 1, rho = 0.375;
    double x[21] = { 0 }, out[2];
    const fvi_system system =
        oscillator(&one, &rho, fvi_potential_harmonic(&one));
    fvi_run run = fvi_run_default(&system, &one, &one, 0.1, 20);
    const fvi_objective J = { .slopes = to_sine, .params = &run }, none = { 0 };
    const fvi_sensitivities g = { .p0 = out };
    const fvi_method *m = &fvi_fractional;
    ck_assert_int_eq(fvi_adjoint(NULL, &run, x, x, &J, &g), FVI_EFAULT);
    ck_assert_int_eq(fvi_adjoint(m, NULL, x, x, &J, &g), FVI_EFAULT);
    ck_assert_int_eq(fvi_adjoint(m, &run, x, NULL, &J, &g), FVI_EFAULT);
    ck_assert_int_eq(fvi_adjoint(m, &run, NULL, x, &J, &g), FVI_EFAULT);
    ck_assert_int_eq(fvi_adjoint(m, &run, x, x, NULL, &g), FVI_EFAULT);
    ck_assert_int_eq(fvi_adjoint(m, &run, x, x, &none, &g), FVI_EFAULT);
    ck_assert_int_eq(fvi_adjoint(m, &run, x, x, &J, NULL), FVI_EFAULT);
    ck_assert_int_eq(fvi_adjoint(&fvi_lagrange_dalembert, &run, x, x, &J, &g),
                     FVI_EUNSUP);
    const fvi_matrices some = { .damping = { .apply_damping = NULL } };
    fvi_system full = system;
    full.matrices = &some;
    run.system = &full;
    ck_assert_int_eq(fvi_adjoint(&fvi_lobatto_d3, &run, NULL, NULL, &J, &g),
                     FVI_EFAULT); /* matrices without functions */
    run.system = &system;
    const fvi_sensitivities lost = { .parameters = out,
                                 .sensitivity = { 1, NULL } };
    ck_assert_int_eq(fvi_adjoint(m, &run, x, x, &J, &lost), FVI_EINVAL);
    for (size_t k = 0; k <= 20; k += 10) {
        const fvi_objective stops = { .slopes = refuses, .params = &k };
        ck_assert_int_eq(fvi_adjoint(m, &run, x, x, &stops, &g), -7);
    }
    const fvi_objective lame = { .slopes = not_a_number, .params = NULL };
    ck_assert_int_eq(fvi_adjoint(m, &run, x, x, &lame, &g), FVI_EOVRFLW);
    run.steps = 0;
    ck_assert_int_eq(fvi_adjoint(m, &run, x, x, &J, &g), FVI_EINVAL);
}
END_TEST

/* A Hessian that makes the equation of a step backwards singular: m/h + kappa (1 -
 * kappa) h G = 0 with m = h = 1, kappa = 1/2, G = -4, on a path that is given. */
START_TEST(a_singular_step_backwards_is_told)
{
    const double one = 1, none = 0, c = -4;
    const double x[2] = { 0, 0 };
    double out, by_rho;
    const fvi_system system =
        oscillator(&one, &none, fvi_potential_duffing((double[]){ c, 1 }));
    fvi_run run = fvi_run_default(&system, &none, &none, 1, 1);
    const fvi_objective J = { .slopes = to_sine, .params = &run };
    fvi_sensitivities g = { .p0 = &out };
    ck_assert_int_eq(fvi_adjoint(&fvi_fractional, &run, x, x, &J, &g),
                     FVI_ESING);
    g.damping = &by_rho; /* with a memory */
    ck_assert_int_eq(fvi_adjoint(&fvi_fractional, &run, x, x, &J, &g),
                     FVI_ESING);
}
END_TEST

/* Only what is wanted is written, and potentials of one's own have no parameters. */
START_TEST(a_sensitivity_is_known_for_what_is_ready_to_use)
{
    const double cg[] = { 1, 1 };
    const fvi_potential own = { .params = NULL };
    ck_assert_uint_eq(fvi_parameter_gradient_of(&own).count, 0);
    fvi_potential u = fvi_potential_harmonic(cg);
    ck_assert_uint_eq(fvi_parameter_gradient_of(&u).count, 1);
    u = fvi_potential_duffing(cg);
    ck_assert_uint_eq(fvi_parameter_gradient_of(&u).count, 2);
    u = fvi_potential_pendulum(cg);
    ck_assert_uint_eq(fvi_parameter_gradient_of(&u).count, 1);
    u = fvi_potential_chain(cg);
    ck_assert_uint_eq(fvi_parameter_gradient_of(&u).count, 2);
}
END_TEST

/* (23.6) asks nothing of rho: its derivative at rho = 0 is that of Taylor's test, half of
 * the second derivative left at order t. The run has no memory there, the mirror has. */
START_TEST(a_free_coordinate_has_a_derivative_by_its_damping)
{
    enum { N = 80 };
    static double x[N + 1], p[N + 1];
    const double one = 1;
    double rho = 0, by_rho, left[2], J0 = 0;
    const fvi_system system =
        oscillator(&one, &rho, fvi_potential_pendulum(&one));
    fvi_run run = fvi_run_default(&system, &one, &one, 1. / 16, N);
    run.alpha = 0.3;
    int momentum = 0;
    const fvi_objective J = { .slopes = last_row, .params = &momentum };
    const fvi_sensitivities want = { .damping = &by_rho };
    ck_assert_int_eq(fvi_adjoint(&fvi_fractional, &run, NULL, NULL, &J, &want),
                     FVI_SUCCESS);
    for (int i = 0; i < 3; i++) {
        rho = i * 5e-4;
        ck_assert_int_eq(fvi_trajectory(&fvi_fractional, &run, x, p, NULL),
                         FVI_SUCCESS);
        if (i == 0)
            J0 = x[N];
        else
            left[i - 1] = x[N] - J0 - rho * by_rho;
    }
    ck_assert_near(left[1] / left[0], 4, 0.4, "rho");
}
END_TEST

/* What stood in the outputs before is of no consequence. */
START_TEST(outputs_are_written_not_added_to)
{
    enum { N = 20 };
    const double one = 1, rho = 0.375;
    const fvi_system system =
        oscillator(&one, &rho, fvi_potential_harmonic(&one));
    fvi_run run = fvi_run_default(&system, &one, &one, 0.1, N);
    const fvi_objective J = { .slopes = to_sine, .params = &run };
    static const fvi_method *const both[] = { &fvi_cq2_shifted, &fvi_lobatto_m3 };
    for (size_t m = 0; m < LEN(both); m++) {
        slopes *s = slopes_of(&run, 2 * N + 1), *again = slopes_of(&run, 2 * N + 1);
        for (size_t i = 0; i < NUMBERS; i++)
            again->all[i] = 7;
        for (size_t k = 0; k <= 2 * N; k++)
            again->force[k] = 7;
        ck_assert_int_eq(fvi_adjoint(both[m], &run, NULL, NULL, &J, &s->to),
                         FVI_SUCCESS);
        ck_assert_int_eq(
            fvi_adjoint(both[m], &run, NULL, NULL, &J, &again->to),
            FVI_SUCCESS);
        ck_assert(*s->to.x0 == *again->to.x0 && *s->to.p0 == *again->to.p0
                  && *s->to.mass == *again->to.mass
                  && *s->to.damping == *again->to.damping
                  && *s->to.alpha == *again->to.alpha
                  && *s->to.parameters == *again->to.parameters);
        ck_assert_int_eq(memcmp(s->force, again->force, ((m ? 2u : 1u) * N + 1) * sizeof one), 0);
        slopes_free(s);
        slopes_free(again);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("adjoint, identities");
    ADD_CASE(suite, "identities", eq_23_4_the_adjoint_run_as_it_stands,
             eq_23_5_a_run_read_backwards_is_the_adjoint,
             eq_23_5_the_mirror_of_a_pendulum_is_not_its_adjoint,
             eq_23_6_what_the_gradient_leaves_is_of_order_2);
    ADD_CASE(suite, "errors", bad_arguments_of_an_adjoint_are_refused,
             a_singular_step_backwards_is_told,
             a_free_coordinate_has_a_derivative_by_its_damping,
             outputs_are_written_not_added_to,
             a_sensitivity_is_known_for_what_is_ready_to_use);
    return run_suite(suite);
}
