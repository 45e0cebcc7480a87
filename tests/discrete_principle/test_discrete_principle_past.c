/* tests/discrete_principle/test_discrete_principle_past.c -- H 6: an action with a given past.
 * Run alone: make test-discrete_principle_past */
#include <fvi/fvi.h>
#include "run/whole_run.h"
#include <fvi/paper/discrete_principle.h>
#include "harness/ulp.h"

#include <math.h>

enum { MOST = 61 };

static const double mass = 2, damping = 1.5, nothing = 0;

static fvi_system system_with(const double *rho, fvi_potential u)
{
    return (
        fvi_system){ .d = 1, .mass = &mass, .damping = rho, .potential = u };
}

/* zeta_k = x_0 + t_k v and bar_k = y_N - (t_N - t_k) w; v = w = 0 if held. */
static void references(double h, size_t N, const double *x, const double *y,
                       double v, double w, double *zeta, double *bar)
{
    for (size_t k = 0; k <= N; k++) {
        zeta[k] = x[0] + (double)k * h * v;
        bar[k] = y[N] - (double)(N - k) * h * w;
    }
}

/* g_k = the restricted derivative of (6.10): that of the two curves without
 * damping, and that of the coupling at x - zeta and y - bar, which is what the
 * damping changes in an action without potential. */
typedef struct {
    double alpha, kappa, h;
    size_t N, first, last;
} setting;

static void derivative(const setting *p, const double cg[2], const double *x,
                       const double *y, const double *zeta, const double *bar,
                       double *g)
{
    const fvi_potential duffing = fvi_potential_duffing(cg), none = { 0 };
    const fvi_system system[] = { system_with(&nothing, duffing),
                                  system_with(&damping, none),
                                  system_with(&nothing, none) };
    double z[MOST], s[MOST], gx[3][MOST], gy[3][MOST];
    for (size_t k = 0; k <= p->N; k++) {
        z[k] = x[k] - zeta[k];
        s[k] = y[k] - bar[k];
    }
    for (size_t i = 0; i < 3; i++)
        ck_assert_int_eq(
            fvi_discrete_action_gradient(&system[i], p->alpha, p->kappa, p->h,
                                         p->N, p->first, p->last, i ? z : x,
                                         i ? s : y, gx[i], gy[i]),
            FVI_SUCCESS);
    for (size_t k = 0; k <= p->N; k++)
        g[k] =
            gx[0][k] + gy[0][k] + (gx[1][k] - gx[2][k]) + (gy[1][k] - gy[2][k]);
}

/* D1 L_d(z_k, z_{k+1}) + D2 L_d(z_{k-1}, z_k), written out, kappa = 1/4. */
static double slopes(const double *z, size_t k, double h, const double cg[2])
{
    double a = z[k] / 4 + 3 * z[k + 1] / 4, b = z[k - 1] / 4 + 3 * z[k] / 4;
    return mass * (2 * z[k] - z[k - 1] - z[k + 1]) / h
           - h / 4 * (cg[0] + cg[1] * a * a) * a
           - 3 * h / 4 * (cg[0] + cg[1] * b * b) * b;
}

/* (6.11), for the four ranges of the sum, without any rounding: alpha = 1/2,
 * h = 1/4 and alpha = 3/4, h = 1/16 make h^-alpha = 2 and 8, h rho h^(-2 alpha) =
 * rho and 4 rho, and the memory is the sum with the weights w of order 2 alpha, 1
 * and 3/2. kappa = 1/4, and U' = z + z^3/2 at multiples of 1/16. The body is held,
 * or comes along a line. Tolerance 0. */
//> exact
START_TEST(eq_6_11_four_sums_one_equation_without_rounding)
{
    enum { N = 4 };
    const double x[] = { 0.75, 1.25, -0.5, 0.25, 1.5 };
    const double y[] = { -0.25, 0.5, 1.75, -0.75, 1 }, cg[] = { 1, 0.5 };
    const double weights[][N + 1] = { { 1, -1, 0, 0, 0 },
                                      { 1, -1.5, 0.375, 0.0625, 0.0234375 } };
    for (size_t i = 0; i < 16; i++) {
        const double *w = weights[i & 1], alpha = i & 1 ? 0.75 : 0.5;
        const double h = i & 1 ? 0.0625 : 0.25, v = i & 2 ? 0.5 : 0;
        const double factor = i & 1 ? 4 * damping : damping;
        const setting p = { alpha, 0.25, h, N, (i & 4) / 4, i & 8 ? N : N - 1 };
        double zeta[N + 1], bar[N + 1], g[N + 1];
        references(h, N, x, y, v, 3 * v, zeta, bar);
        derivative(&p, cg, x, y, zeta, bar, g);
        for (size_t k = 1; k < N; k++) {
            double want = slopes(x, k, h, cg) + slopes(y, k, h, cg);
            for (size_t n = 0; n <= k; n++)
                want -= factor * w[n] * (x[k - n] - zeta[k - n]);
            for (size_t n = 0; n <= N - k; n++)
                want -= factor * w[n] * (y[k + n] - bar[k + n]);
            ck_assert_near(g[k], want, 0, "%zu..%zu, alpha=%g, v=%g, k=%zu",
                           p.first, p.last, alpha, v, k);
        }
    }
}
END_TEST
//< exact

/* The integrator of the program makes it stationary, whatever the range. x is a
 * run, y the reversal of another with 1 - kappa, each with its own past, starts
 * away from the origin. Bound: that of eq_6_6 for x, y, and for x - zeta and
 * y - bar, whose kinetic part comes and goes. Seen: 0.0004 of it. */
static void ck_assert_stationary(const setting *p, fvi_initial_history past)
{
    const double x0 = 0.75, p0 = 0.5, y0 = -0.25, q0 = 1, cg[] = { 1, 0.5 };
    const fvi_system system = system_with(&damping, fvi_potential_duffing(cg));
    double x[MOST], back[MOST], y[MOST], zeta[MOST], bar[MOST], g[MOST];
    fvi_run run = { .system = &system,
                    .x0 = &x0,
                    .p0 = &p0,
                    .h = p->h,
                    .steps = p->N,
                    .kappa = p->kappa,
                    .alpha = p->alpha,
                    .past = past,
                    .memory = FVI_HISTORY_DIRECT };
    ck_assert_int_eq(fvi_trajectory(&fvi_fractional, &run, x, NULL, NULL),
                     FVI_SUCCESS);
    run.x0 = &y0, run.p0 = &q0, run.kappa = 1 - p->kappa;
    ck_assert_int_eq(fvi_trajectory(&fvi_fractional, &run, back, NULL, NULL),
                     FVI_SUCCESS);
    for (size_t k = 0; k <= p->N; k++)
        y[k] = back[p->N - k];
    const int line = past == FVI_INITIAL_HISTORY_CAPUTO && 2 * p->alpha > 1;
    references(p->h, p->N, x, y, line ? p0 / mass : 0, line ? -q0 / mass : 0,
               zeta, bar);
    derivative(p, cg, x, y, zeta, bar, g);
    double most = 0, bound;
    for (size_t k = 0; k <= p->N; k++)
        most = larger(most, larger(larger(fabs(x[k]), fabs(zeta[k])),
                                   larger(fabs(y[k]), fabs(bar[k]))));
    bound = (3 * (double)p->N + 36) * U * 6 * most
            * (4 * mass / p->h + 4 * damping * pow(p->h, 1 - 2 * p->alpha)
               + p->h * (cg[0] + cg[1] * most * most));
    for (size_t k = 1; k < p->N; k++)
        ck_assert_near(g[k], 0, bound, "%zu..%zu, alpha=%g, kappa=%g, k=%zu",
                       p->first, p->last, p->alpha, p->kappa, k);
    ck_assert(bound < 1e-10);
}

START_TEST(eq_6_11_the_integrator_with_a_past_makes_the_action_stationary)
{
    const double alphas[] = { 0.1, 0.25, 0.5, 0.8, 1 };
    for (size_t i = 0; i < LEN(alphas) * 3 * 4; i++) {
        const setting p = { alphas[i / 12], (double)(i / 4 % 3) / 4, 0.05, 60,
                            i & 1,          i & 2 ? 60 : 59 };
        ck_assert_stationary(&p, FVI_INITIAL_HISTORY_HELD);
        ck_assert_stationary(&p, FVI_INITIAL_HISTORY_CAPUTO);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("discrete_principle_past");
    ADD_CASE(suite, "identities",
             eq_6_11_four_sums_one_equation_without_rounding,
             eq_6_11_the_integrator_with_a_past_makes_the_action_stationary);
    return run_suite(suite);
}
