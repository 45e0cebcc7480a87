/* tests/discrete_principle/test_discrete_principle.c -- H 6: the discrete action and its variations.
 * Run alone: make test-discrete_principle */
#include <fvi/fvi.h>
#include "run/whole_run.h"
#include <fvi/paper/discrete_principle.h>
#include "harness/ulp.h"

#include "discrete_principle_ref.h"

#include <math.h>

/* ---- potentials with cubic and quartic terms ---- */

/* d = 1: U = c2 z^2/2 + c3 z^3 + c4 z^4. */
static int cubic_value(size_t d, const double *z, void *params, double *value)
{
    const double *c = params;
    (void)d;
    *value = ((c[2] * z[0] + c[1]) * z[0] + c[0] / 2) * z[0] * z[0];
    return 0;
}

static int cubic_gradient(size_t d, const double *z, void *params, double *g)
{
    const double *c = params;
    (void)d;
    g[0] = ((4 * c[2] * z[0] + 3 * c[1]) * z[0] + c[0]) * z[0];
    return 0;
}

static int cubic_hessian(size_t d, const double *z, void *params, double *H)
{
    const double *c = params;
    (void)d;
    H[0] = (12 * c[2] * z[0] + 6 * c[1]) * z[0] + c[0];
    return 0;
}

/* d = 2: U = a^2/2 + 3 b^2/2 + a^2 b/2 + (a b)^2/4. */
static int coupled_value(size_t d, const double *z, void *params, double *value)
{
    double a = z[0], b = z[1];
    (void)d, (void)params;
    *value = a * a / 2 + 3 * b * b / 2 + a * a * b / 2 + a * b * a * b / 4;
    return 0;
}

static int coupled_gradient(size_t d, const double *z, void *params, double *g)
{
    double a = z[0], b = z[1];
    (void)d, (void)params;
    g[0] = a + a * b + a * b * b / 2;
    g[1] = 3 * b + a * a / 2 + a * a * b / 2;
    return 0;
}

static int coupled_hessian(size_t d, const double *z, void *params, double *H)
{
    double a = z[0], b = z[1];
    (void)d, (void)params;
    H[0] = 1 + b + b * b / 2;
    H[1] = H[2] = a + a * b;
    H[3] = 3 + a * a / 2;
    return 0;
}

static const double mass2[] = { 1, 2 }, damping2[] = { 0.5, 0.75 };
static const fvi_system coupled = { 2,
                                    mass2,
                                    damping2,
                                    { .value = coupled_value,
                                      .gradient = coupled_gradient,
                                      .hessian = coupled_hessian },
                                    { 0 },
                                    NULL, NULL };

/* Mass 2, damping 3/2, and the potential of the reference values. */
static fvi_system cubic(const double c[3])
{
    static const double mass = 2, damping = 1.5;
    return (fvi_system){ 1,
                         &mass,
                         &damping,
                         { .value = cubic_value,
                           .gradient = cubic_gradient,
                           .hessian = cubic_hessian,
                           .params = (void *)c },
                         { 0 },
                         NULL, NULL };
}

enum { MOST = 130 }; /* room for N + 1 <= 65 vectors of R^2 */

static double gx[MOST], gy[MOST];

/* ---- values ---- */

/* One row of a table: the action and all its derivatives. (2 N + 16) u times
 * the sizes of the terms: a weight (1 ulp) times a Delta (k + 4, H 5)
 * in a sum of at most N + 1 terms, h^-alpha twice, and less for L_d. Rows
 * marked exact have data so short that nothing is rounded: 0.
 * Seen: exact 0, else 0.09 of the bound. */
#define ck_assert_row(row, system, N, x, y, want)                              \
    do {                                                                       \
        size_t n_ = ((N) + 1) * (system)->d;                                   \
        double S_, u_ = (row).exact ? 0 : (2 * (double)(N) + 16) * U;          \
        ck_assert_int_eq(fvi_discrete_action(system, (row).alpha, (row).kappa, \
                                             (row).h, N, (row).first,          \
                                             (row).last, x, y, &S_),           \
                         FVI_SUCCESS);                                         \
        ck_assert_near(S_, (row).S, u_ *(row).size_S, "S, alpha=%g",           \
                       (row).alpha);                                           \
        ck_assert_int_eq(fvi_discrete_action_gradient(                         \
                             system, (row).alpha, (row).kappa, (row).h, N,     \
                             (row).first, (row).last, x, y, gx, gy),           \
                         FVI_SUCCESS);                                         \
        for (size_t i_ = 0; i_ < n_; i_++) {                                   \
            ck_assert_near(gx[i_], (want)[i_], u_ *(row).size_gradient,        \
                           "gx[%zu], alpha=%g", i_, (row).alpha);              \
            ck_assert_near(gy[i_], (want)[n_ + i_], u_ *(row).size_gradient,   \
                           "gy[%zu], alpha=%g", i_, (row).alpha);              \
        }                                                                      \
    } while (0)

START_TEST(eq_6_2_and_6_5_action_and_gradient_in_one_dimension)
{
    const fvi_system system = cubic(d1_potential);
    for (size_t r = 0; r < LEN(ref_d1); r++)
        ck_assert_row(ref_d1[r], &system, 4, d1_x, d1_y,
                      ref_d1_gradient + 10 * r);
}
END_TEST

START_TEST(eq_6_2_and_6_5_action_and_gradient_in_two_dimensions)
{
    for (size_t r = 0; r < LEN(ref_d2); r++)
        ck_assert_row(ref_d2[r], &coupled, 2, d2_x, d2_y,
                      ref_d2_gradient + 12 * r);
}
END_TEST

/* ---- identities ---- */

/* A trajectory of the integrator, and the reversal of another. */
static void run_fvi(const fvi_system *system, double alpha, double kappa,
                    double h, size_t N, const double *x0, const double *p0,
                    double *x)
{
    const fvi_run run = { .system = system,
                          .x0 = x0,
                          .p0 = p0,
                          .h = h,
                          .steps = N,
                          .kappa = kappa,
                          .alpha = alpha,
                          .past = FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE,
                          .memory = FVI_HISTORY_DIRECT };
    ck_assert_int_eq(fvi_trajectory(&fvi_fractional, &run, x, NULL, NULL),
                     FVI_SUCCESS);
}

static void reverse(size_t N, size_t d, const double *x, double *y)
{
    for (size_t k = 0; k <= N; k++)
        for (size_t i = 0; i < d; i++)
            y[k * d + i] = x[(N - k) * d + i];
}

static double largest(size_t n, const double *z)
{
    double most = 0;
    for (size_t i = 0; i < n; i++)
        most = larger(most, fabs(z[i]));
    return most;
}

/* The sizes that are added up in one equation of (6.6): 4 m |x| / h,
 * h |grad U|, and h rho h^(-2 alpha) times (sum |alpha_n|)^2 <= 4 times |x|. */
static double size(const fvi_system *system, double alpha, double h, size_t N,
                   const double *x)
{
    const size_t d = system->d;
    double most = largest((N + 1) * d, x), slope = 0, g[2];
    for (size_t k = 0; k <= N; k++) {
        system->potential.gradient(d, x + k * d, system->potential.params, g);
        slope = larger(slope, largest(d, g));
    }
    return 4 * most
               * (largest(d, system->mass) / h
                  + largest(d, system->damping) * pow(h, 1 - 2 * alpha))
           + 2 * h * slope;
}

/* gx + gy between the ends, and the largest of gx, gy and of their sum. */
typedef struct {
    double restricted, unrestricted;
} stationarity;

static stationarity between_the_ends(size_t N, size_t d)
{
    stationarity s = { 0, 0 };
    for (size_t i = d; i < N * d; i++) {
        s.restricted = larger(s.restricted, fabs(gx[i] + gy[i]));
        s.unrestricted =
            larger(s.unrestricted, larger(fabs(gx[i]), fabs(gy[i])));
    }
    return s;
}

/* (6.6), (6.8). x solves (6.6a) with kappa, and y, the reversal of a solution
 * with 1 - kappa that starts elsewhere, solves (6.6b): the restricted gradient
 * vanishes to rounding, the unrestricted does not. Gradient: (2 N + 16) u times
 * the sizes; the solver's own sums N + 4 more, its Newton iteration and the
 * rounding of x and p some 16: (3 N + 36) u for each curve.
 * Seen: 0.0012 of it. */
//> stationary
static void ck_assert_stationary(const fvi_system *system, double alpha,
                                 double kappa, double h, size_t N)
{
    const double x0[] = { 0.75, -0.5 }, p0[] = { 0.5, 1 };
    const double z0[] = { -0.25, 0.5 }, q0[] = { 1, -0.25 };
    const size_t d = system->d;
    double x[MOST], z[MOST], y[MOST];
    run_fvi(system, alpha, kappa, h, N, x0, p0, x);
    run_fvi(system, alpha, 1 - kappa, h, N, z0, q0, z);
    reverse(N, d, z, y); /* (6.8) */
    ck_assert_int_eq(fvi_discrete_action_gradient(system, alpha, kappa, h, N, 0,
                                                  N, x, y, gx, gy),
                     FVI_SUCCESS);
    stationarity s = between_the_ends(N, d);
    double bound =
        (3 * (double)N + 36) * U
        * (size(system, alpha, h, N, x) + size(system, alpha, h, N, y));
    ck_assert_near(s.restricted, 0, bound, "d=%zu alpha=%g kappa=%g", d, alpha,
                   kappa);
    ck_assert(s.unrestricted > 0.01);
}
//< stationary

START_TEST(eq_6_6_the_integrator_makes_the_action_stationary)
{
    const double c[] = { 1, 0.25, 0.25 };
    const double alphas[] = { 0.1, 0.25, 0.5, 0.8 };
    const double kappas[] = { 0, 0.25, 0.5, 0.75, 1 };
    const fvi_system system = cubic(c);
    for (size_t a = 0; a < LEN(alphas); a++)
        for (size_t k = 0; k < LEN(kappas); k++) {
            ck_assert_stationary(&system, alphas[a], kappas[k], 0.05, 60);
            ck_assert_stationary(&coupled, alphas[a], kappas[k], 0.05, 60);
        }
}
END_TEST

/* (6.7) as derived: what the sum leaves out comes back as an end term. x and y
 * are the solutions above, so that nothing else is left. Bound as above.
 * Seen: 0.0011 of it. */
START_TEST(eq_6_7_the_printed_sum_leaves_a_term_of_each_missing_end)
{
    enum { N = 40 };
    const double c[] = { 1, 0.25, 0.25 }, h = 0.1, alpha = 0.3, kappa = 0.25;
    const fvi_system system = cubic(c);
    const double x0 = 0.75, z0 = -0.5, p0 = 1;
    double x[N + 1], z[N + 1], y[N + 1], w[N + 1];
    run_fvi(&system, alpha, kappa, h, N, &x0, &p0, x);
    run_fvi(&system, alpha, 1 - kappa, h, N, &z0, &p0, z);
    reverse(N, 1, z, y);
    fvi_gl_weights(alpha, N + 1, w);
    const double factor = h * *system.damping * pow(h, -2 * alpha);
    const double bound =
        (3 * N + 36) * U
        * (size(&system, alpha, h, N, x) + size(&system, alpha, h, N, y));
    for (size_t first = 0; first <= 1; first++)
        for (size_t last = N - 1; last <= N; last++) {
            fvi_discrete_action_gradient(&system, alpha, kappa, h, N, first,
                                         last, x, y, gx, gy);
            for (size_t k = 1; k < N; k++) {
                double end = (first == 1 ? w[k] * x[0] : 0)
                             + (last == N - 1 ? w[N - k] * y[N] : 0);
                ck_assert_near(gx[k] + gy[k], factor * end, bound,
                               "sum %zu..%zu, k=%zu", first, last, k);
            }
        }
    ck_assert(fabs(factor * w[1] * y[N]) > 1e10 * bound);
}
END_TEST

/* No rounding at all: alpha = 1/2 and h = 1/4, a quadratic force and kappa = 0
 * or 1, which is explicit, and data of one bit: every number below has less
 * than 53 bits. x and z are made with the backward difference that the memory
 * is for alpha = 1/2. h rho h^(-2 alpha) = rho. Tolerance 0. */
//> exact
START_TEST(eq_6_7_the_end_terms_without_rounding)
{
    enum { N = 4 };
    const double h = 0.25, m = 2, rho = 1.5, c[] = { 0, 0.5, 0 };
    const double w[] = { 1, -0.5, -0.125, -0.0625, -0.0390625 }; /* alpha_n */
    const fvi_system system = cubic(c);
    double x[N + 1] = { 1, 0.5 }, z[N + 1] = { -0.5, 0.5 }, y[N + 1];
    for (size_t k = 1; k < N; k++) {
        x[k + 1] = x[k] + (1 - h * rho / m) * (x[k] - x[k - 1])
                   - h * h / m * (1.5 * x[k] * x[k]);
        z[k + 1] = z[k] + (1 - h * rho / m) * (z[k] - z[k - 1])
                   - h * h / m * (1.5 * z[k] * z[k]);
    }
    reverse(N, 1, z, y);
    for (size_t i = 0; i < 8; i++) {
        size_t first = i & 1, last = i & 2 ? N : N - 1;
        double kappa = i & 4 ? 1 : 0;
        fvi_discrete_action_gradient(&system, 0.5, kappa, h, N, first, last, x,
                                     y, gx, gy);
        for (size_t k = 1; k < N; k++) {
            double end = (first == 1 ? w[k] * x[0] : 0)
                         + (last == N - 1 ? w[N - k] * y[N] : 0);
            ck_assert_near(gx[k] + gy[k], rho * end, 0, "%zu..%zu, k=%zu",
                           first, last, k);
        }
    }
}
END_TEST
//< exact

/* (6.7): Remark 4.5 and the printed sum are right if the curves end in zero.
 * Then Delta_- x_0 and Delta_+ y_N vanish, and so do their products: the three
 * sums are the same numbers, to the last bit. */
START_TEST(eq_6_7_the_three_sums_agree_when_the_ends_vanish)
{
    double x[] = { 0, 0, 1.5, -0.25, 0.75, 0.5 };
    double y[] = { 0.25, 1, -0.5, 0.75, 0, 0 }, S[3], fx[6], fy[6];
    const size_t first[] = { 0, 0, 1 }, last[] = { 2, 1, 2 };
    for (size_t r = 0; r < 3; r++) {
        fvi_discrete_action(&coupled, 0.3, 0.25, 0.1, 2, first[r], last[r], x,
                            y, &S[r]);
        fvi_discrete_action_gradient(&coupled, 0.3, 0.25, 0.1, 2, first[r],
                                     last[r], x, y, fx, fy);
        ck_assert_ulp(S[r], S[0], 0, "S, range %zu", r);
        for (size_t i = 2; i < 4; i++) {
            gx[i] = r ? gx[i] : fx[i];
            gy[i] = r ? gy[i] : fy[i];
            ck_assert_ulp(fx[i], gx[i], 0, "gx, range %zu", r);
            ck_assert_ulp(fy[i], gy[i], 0, "gy, range %zu", r);
        }
    }
}
END_TEST

/* (6.9). The reversal of x with the same kappa: x_{N-k} solves (6.6a), so the
 * restricted gradient is h times the difference of the two forces there. It
 * vanishes for kappa = 0, 1/2, 1 or without the cubic term. Bound as above.
 * Seen: 0.0011 of it. */
START_TEST(eq_6_9_the_same_kappa_does_not_mirror)
{
    enum { N = 40 };
    const double alpha = 0.3, h = 0.1, x0 = 0.75, p0 = 1;
    for (size_t i = 0; i < 10; i++) {
        const double kappa = (double)(i % 5) / 4,
                     c[] = { 1, i < 5 ? 0.5 : 0, 0 };
        const fvi_system system = cubic(c);
        double x[N + 1], y[N + 1], most = 0;
        run_fvi(&system, alpha, kappa, h, N, &x0, &p0, x);
        reverse(N, 1, x, y);
        fvi_discrete_action_gradient(&system, alpha, kappa, h, N, 0, N, x, y,
                                     gx, gy);
        double bound = 2 * (3 * N + 36) * U * size(&system, alpha, h, N, x);
        for (size_t k = 1; k < N; k++) {
            const double *at = x + (N - k); /* the nodes at[-1], at[0], at[1] */
            //> defect
            double defect = 3 * c[1] * kappa * (kappa - 1) * (2 * kappa - 1)
                            * (at[-1] - at[1]) * (2 * at[0] - at[-1] - at[1]);
            //< defect
            ck_assert_near(gx[k] + gy[k], h * defect, bound, "kappa=%g k=%zu",
                           kappa, k);
            most = larger(most, fabs(h * defect));
        }
        ck_assert((most > 1e6 * bound)
                  == (c[1] != 0 && (kappa == 0.25 || kappa == 0.75)));
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("discrete_principle");
    ADD_CASE(suite, "values",
             eq_6_2_and_6_5_action_and_gradient_in_one_dimension,
             eq_6_2_and_6_5_action_and_gradient_in_two_dimensions);
    ADD_CASE(suite, "identities",
             eq_6_6_the_integrator_makes_the_action_stationary,
             eq_6_7_the_printed_sum_leaves_a_term_of_each_missing_end,
             eq_6_7_the_end_terms_without_rounding,
             eq_6_7_the_three_sums_agree_when_the_ends_vanish,
             eq_6_9_the_same_kappa_does_not_mirror);
    return run_suite(suite);
}
