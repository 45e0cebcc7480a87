/* tests/adjoint/test_adjoint_matrices.c -- H 23: derivatives of systems with matrices.
 * Run alone: make test-adjoint_matrices */
#include "structures/structures_runs.h"
#include "run/whole_run.h"
#include "system/larger.h"

enum { D = 7, N = 70 };

static const double h = 1. / 16;

/* A bar of seven masses; M, K and C all have neighbours. */
static void bar(matrices *m)
{
    tridiagonal(D, 1, 0.2, &m->M);
    tridiagonal(D, 3, -1.4, &m->K);
    tridiagonal(D, 0.5, 0.15, &m->C);
    make(m);
}

static void kick(double *x0, double *p0)
{
    for (size_t i = 0; i < D; i++) {
        x0[i] = sin((double)(i + 1));
        p0[i] = cos((double)(2 * i));
    }
}

/* What J weighs x_k and p_N by: numbers of no order. */
static double weigh(size_t k, size_t i)
{
    return cos((double)(3 * k + 5 * i + 1)) / (k == N ? 1 : 8);
}

static int linear(size_t k, size_t d, const double *x, const double *p,
                  void *params, double *Jx, double *Jp)
{
    (void)x;
    (void)params;
    for (size_t i = 0; i < d; i++) {
        Jx[i] += weigh(k, i);
        if (p)
            Jp[i] += weigh(N + 2, i);
    }
    return 0;
}

static double linear_of(const double *x, const double *p)
{
    double J = 0;
    for (size_t k = 0; k <= N; k++)
        for (size_t i = 0; i < D; i++)
            J += weigh(k, i) * x[k * D + i];
    for (size_t i = 0; i < D; i++)
        J += weigh(N + 2, i) * p[N * D + i];
    return J;
}

/* J = |x_N|^2 / 2 + p_N,1^2, for which an adjoint run needs the path. */
static int square(size_t k, size_t d, const double *x, const double *p,
                  void *params, double *Jx, double *Jp)
{
    (void)params;
    for (size_t i = 0; p && k == N && i < d; i++)
        Jx[i] += x[i];
    if (p)
        Jp[0] += 2 * p[0];
    return 0;
}

static double square_of(const double *x, const double *p)
{
    double J = p[N * D] * p[N * D];
    for (size_t i = 0; i < D; i++)
        J += x[N * D + i] * x[N * D + i] / 2;
    return J;
}

/* One unit of force on one mass at one node. */
static int hit(double t, size_t d, void *params, double *F)
{
    const size_t *at = params;
    memset(F, 0, d * sizeof *F);
    if ((size_t)(t / h + 0.5) == at[0])
        F[at[1]] = 1;
    return 0;
}

/* How J answers to one number more or less: what is linear or quadratic has no error in a
 * central difference, whose step is 1. number < 2 D: x0 and p0; else the force `at`. */
static double difference(const fvi_method *method, const fvi_run *of,
                         double (*J)(const double *, const double *),
                         size_t number, size_t *at)
{
    static double x[(N + 1) * D], p[(N + 1) * D];
    double value[2];
    for (int side = 0; side < 2; side++) {
        double start[2 * D];
        fvi_run run = *of;
        fvi_system system = *of->system;
        memcpy(start, of->x0, D * sizeof *start);
        memcpy(start + D, of->p0, D * sizeof *start);
        run.x0 = start;
        run.p0 = start + D;
        run.system = &system;
        if (number < 2 * D)
            start[number] += side ? 1 : -1;
        else if (side)
            system.force = (fvi_force){ .value = hit, .params = at };
        OK(fvi_trajectory(method, &run, x, p, NULL));
        value[side] = J(x, p);
    }
    return number < 2 * D ? (value[1] - value[0]) / 2 : value[1] - value[0];
}

/* Every past, three memories, five orders, two kappa: x0, p0 and some forces, of a linear J
 * with terms at all nodes and of a square. Rounding of N sums of terms of order 1, where
 * Riemann-Liouville with alpha > 1/2 has terms of order h^(1 - 2 alpha). Seen: 1e-14. */
START_TEST(eq_23_6_matrices_are_their_own_adjoint)
{
    const double alphas[] = { 0, 0.3, 0.5, 0.75, 1 };
    const fvi_initial_history pasts[] = { FVI_INITIAL_HISTORY_HELD, FVI_INITIAL_HISTORY_CAPUTO,
                               FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE };
    const fvi_history_kind kinds[] = { FVI_HISTORY_DIRECT,
                                      FVI_HISTORY_MODES };
    double x0[D], p0[D];
    matrices m;
    bar(&m);
    kick(x0, p0);
    for (size_t n = 0; n < LEN(alphas) * LEN(pasts) * LEN(kinds) * 2; n++) {
        fvi_run run = run_of(&m.system, alphas[n % LEN(alphas)], h, N, x0, p0);
        run.past = pasts[n / LEN(alphas) % LEN(pasts)];
        run.memory = kinds[n / LEN(alphas) / LEN(pasts) % LEN(kinds)];
        const int is_square = n / LEN(alphas) / LEN(pasts) / LEN(kinds) == 1;
        run.kappa = is_square ? 0.3 : 0.5;
        static double by[2 * D], force[(N + 1) * D];
        const fvi_objective J = { .slopes = is_square ? square : linear, .params = NULL };
        const fvi_sensitivities want = { .x0 = by, .p0 = by + D, .force = force };
        OK(fvi_adjoint(&fvi_fractional, &run, NULL, NULL, &J, &want));
        double largest = 1;
        for (size_t i = 0; i < 2 * D; i++)
            largest = larger(largest, fabs(by[i]));
        for (size_t i = 0; i < 2 * D; i++) {
            const double slope =
                difference(&fvi_fractional, &run,
                           is_square ? square_of : linear_of, i, NULL);
            seen(fabs(by[i] - slope) / largest, "off");
            ck_assert_near(by[i], slope, 1e-12 * largest,
                           "alpha %g past %d number %zu", run.alpha, run.past,
                           i);
        }
        for (size_t k = 0; k <= N && !is_square; k += 35) {
            size_t at[] = { k, k % D };
            ck_assert_near(
                force[k * D + k % D],
                difference(&fvi_fractional, &run, linear_of, 2 * D, at),
                1e-12 * largest, "force %zu", k);
        }
    }
    drop(&m);
}
END_TEST

/* The methods of order 2 likewise. With Riemann-Liouville's past and alpha > 1/2 they begin
 * at 0 alone. Roundings as above. Seen: 6.6e-14. */
START_TEST(eq_23_7_matrices_are_their_own_adjoint_to_order_2)
{
    const fvi_method *const methods[] = { &fvi_cq2_shifted, &fvi_cq_bdf2,
                                          &fvi_cq2_midpoint };
    const double alphas[] = { 0.05, 0.3, 0.5, 0.75, 0.95 };
    const fvi_initial_history pasts[] = { FVI_INITIAL_HISTORY_HELD, FVI_INITIAL_HISTORY_CAPUTO,
                               FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE };
    static double by[2 * D], force[(N + 1) * D];
    double x0[D], p0[D];
    matrices m;
    bar(&m);
    for (size_t n = 0; n < LEN(alphas) * LEN(pasts) * LEN(methods); n++) {
        const fvi_method *method = methods[n / LEN(alphas) / LEN(pasts)];
        fvi_run run = run_of(&m.system, alphas[n % LEN(alphas)], h, N, x0, p0);
        run.past = pasts[n / LEN(alphas) % LEN(pasts)];
        run.memory = n % 2 ? FVI_HISTORY_DIRECT : FVI_HISTORY_MODES;
        run.kappa = 0.3;
        const int at_0 =
            run.past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE && run.alpha > 0.5;
        kick(x0, p0);
        for (size_t i = 0; at_0 && i < D; i++)
            x0[i] = 0;
        const fvi_objective J = { .slopes = linear, .params = NULL };
        const fvi_sensitivities want = { .x0 = by, .p0 = by + D, .force = force };
        OK(fvi_adjoint(method, &run, NULL, NULL, &J, &want));
        double largest = 1;
        for (size_t i = 0; at_0 && i < D; i++)
            ck_assert(isnan(by[i]));
        for (size_t i = at_0 ? D : 0; i < 2 * D; i++)
            largest = larger(largest, fabs(by[i]));
        for (size_t i = at_0 ? D : 0; i < 2 * D; i++) {
            const double slope = difference(method, &run, linear_of, i, NULL);
            seen(fabs(by[i] - slope) / largest, "off");
            ck_assert_near(by[i], slope, 1e-12 * largest,
                           "%s alpha %g past %d number %zu", method->name,
                           run.alpha, run.past, i);
        }
        for (size_t k = 0; k <= N; k += 35) {
            size_t at[] = { k, k % D };
            ck_assert_near(force[k * D + k % D],
                           difference(method, &run, linear_of, 2 * D, at),
                           1e-12 * largest, "%s force %zu", method->name, k);
        }
    }
    drop(&m);
}
END_TEST

/* A path that is given, and one that is made in pieces: the same digits. */
START_TEST(a_path_of_matrices_given_or_not)
{
    static double x[(N + 1) * D], p[(N + 1) * D], force[2][(N + 1) * D];
    double x0[D] = { 1, 0.5 }, p0[D] = { 0, -1 }, by[2][2 * D];
    matrices m;
    bar(&m);
    fvi_run run = run_of(&m.system, 0.35, h, N, x0, p0);
    const fvi_objective J = { .slopes = square, .params = NULL };
    OK(fvi_trajectory(&fvi_fractional, &run, x, p, NULL));
    for (int i = 0; i < 2; i++) {
        const fvi_sensitivities want = { .x0 = by[i],
                                     .p0 = by[i] + D,
                                     .force = force[i] };
        OK(fvi_adjoint(&fvi_fractional, &run, i ? x : NULL,
                       i ? p + N * D : NULL, &J, &want));
    }
    ck_assert_mem_eq(by[0], by[1], sizeof by[0]);
    ck_assert_mem_eq(force[0], force[1], sizeof force[0]);
    drop(&m);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("adjoint, matrices");
    ADD_CASE(suite, "matrices", eq_23_6_matrices_are_their_own_adjoint,
             eq_23_7_matrices_are_their_own_adjoint_to_order_2,
             a_path_of_matrices_given_or_not);
    return run_suite(suite);
}
