/* tests/discrete_mechanics/test_discrete_mechanics_newton.c -- H 2: the equation of a step.
 * Run alone: make test-discrete_mechanics_newton */
#include <fvi/lobatto.h>
#include "run/whole_run.h"
#include "newton_solver.h"
#include "system/larger.h"

/* ---- a Duffing spring that writes down what it is asked ---- */

typedef struct {
    size_t gradients, hessians;
    double point[64]; /* of each gradient, d == 1 */
} diary;

static double spring[] = { 1, 1 };

static int told_value(size_t d, const double *x, void *params, double *value)
{
    (void)params;
    return fvi_potential_duffing(spring).value(d, x, spring, value);
}

static int told_gradient(size_t d, const double *x, void *params, double *g)
{
    diary *told = *(diary *const *)params;
    told->point[told->gradients++ % 64] = x[0];
    return fvi_potential_duffing(spring).gradient(d, x, spring, g);
}

static int told_hessian(size_t d, const double *x, void *params, double *H)
{
    (*(diary *const *)params)->hessians++;
    return fvi_potential_duffing(spring).hessian(d, x, spring, H);
}

static fvi_system telling(diary *const *told)
{
    const fvi_potential u = { .value = told_value,
                              .gradient = told_gradient,
                              .hessian = told_hessian,
                              .params = (void *)told };
    return (fvi_system){ 1, one, none, u, { 0 }, NULL, NULL };
}

/* ---- values ---- */

/* Short binary fractions: A d + s c (x + theta d) = r, 0 ulp. In two dimensions
 * the chain's matrix is [[4, -1], [-1, 4]] here, whose LU factors are not
 * short: 16/15. Two units of rounding each for the factors and the solution. */
START_TEST(eq_2_10_linear_equations)
{
    const double c[] = { 2, 0 }, x[] = { 1, -3 }, r[] = { 8, 2 };
    const double A[] = { 1, 3 }, two[] = { 2, 2 };
    double d[2] = { 7, 7 }, g[2];
    fvi_system system = {
        2, one, none, fvi_potential_harmonic(c), { 0 }, NULL, NULL
    };
    fvi_newton *newton = solver(&system, A, 1, 0.5);
    ck_assert_int_eq(fvi_newton_solve(newton, x, r, d, g), FVI_SUCCESS);
    ck_assert(d[0] == 3 && d[1] == 2 && g[0] == 5 && g[1] == -4);
    fvi_newton_free(newton);

    const double stiff[] = { 1, 0 };
    system.potential = fvi_potential_chain(stiff);
    newton = solver(&system, two, 1, 1);
    ck_assert_int_eq(fvi_newton_solve(newton, x, r, d, g), FVI_SUCCESS);
    /* J d = r - H x = (8 - 5, 2 + 7) = (3, 9), d = (21, 39) / 15 */
    ck_assert_near(d[0], 1.4, 8 * U * 2.6, "chain, first");
    ck_assert_near(d[1], 2.6, 8 * U * 2.6, "chain, second");
    fvi_newton_free(newton);
}
END_TEST

/* s theta = 0: nothing is solved, and no Hessian is asked for. g belongs to
 * x + theta d all the same. */
START_TEST(eq_2_10_is_explicit_at_both_ends_of_kappa)
{
    diary page = { 0 }, *told = &page;
    const fvi_system system = telling(&told);
    const double x = 0.5, r = 3, A = 2;
    double d = 7, g = 7;
    fvi_newton *newton = solver(&system, &A, 0, 1); /* kappa = 0 */
    ck_assert_int_eq(fvi_newton_solve(newton, &x, &r, &d, &g), FVI_SUCCESS);
    ck_assert(d == 1.5 && g == 2 + 8 && page.gradients == 1);
    fvi_newton_free(newton);
    newton = solver(&system, &A, 0.5, 0); /* kappa = 1 */
    ck_assert_int_eq(fvi_newton_solve(newton, &x, &r, &d, &g), FVI_SUCCESS);
    ck_assert(d == (3 - 0.5 * 0.625) / 2 && g == 0.625);
    fvi_newton_free(newton);
    g = 7;
    newton = solver(&system, &A, 0, 0);
    ck_assert_int_eq(fvi_newton_solve(newton, &x, &r, &d, &g), FVI_SUCCESS);
    ck_assert(d == 1.5 && g == 0.625);
    ck_assert_uint_eq(page.hessians, 0);
    fvi_newton_free(newton);

    const fvi_system freely = { 2, one, none, { 0 }, { 0 }, NULL, NULL };
    const double r2[] = { 3, -1 }, x2[] = { 1, 1 };
    double d2[2], g2[2] = { 7, 7 };
    newton = solver(&freely, one, 1, 1);
    ck_assert_int_eq(fvi_newton_solve(newton, x2, r2, d2, g2), FVI_SUCCESS);
    ck_assert(d2[0] == 3 && d2[1] == -1 && g2[0] == 0 && g2[1] == 0);
    fvi_newton_free(newton);
}
END_TEST

/* ---- identities ---- */

/* The residual of what comes back, put into (2.10) by hand. Rounding makes an
 * error of at most (4 + d) u in each of r, A d, s grad U and in the point
 * x + theta d, which the Jacobian multiplies; solving with LU factors adds d u
 * of the Jacobian times d, and so does the rounding of d. Together at most
 * 4 (4 + d) u |J| (|x| + |d| + |r| / A). Seen: 0.03 of it. */
START_TEST(eq_2_10_solutions_satisfy_it)
{
    const double cg[] = { 1, 2 }, A[] = { 10, 7, 12, 9, 20 };
    const double x[] = { 0.3, -1.2, 2.1, 0.7, -0.4 };
    const double s[] = { 0.03, 0.1, 1, 8 }, theta[] = { 0.2, 0.5, 1 };
    for (int kind = HARMONIC; kind <= PENDULUM; kind++) {
        const size_t dim = kind == CUBIC ? 1 : 5;
        const fvi_system system = { dim,   one, none, potential(kind, cg),
                                    { 0 }, NULL, NULL };
        for (size_t i = 0; i < LEN(s) * LEN(theta); i++) {
            const double si = s[i % LEN(s)], ti = theta[i / LEN(s)];
            double r[] = { 5, -3, 0.1, 7, 2 }, d[5] = { 0 }, g[5], z[5];
            double H[25], norm = 0, size = 0;
            fvi_newton *newton = solver(&system, A, si, ti);
            ck_assert_int_eq(fvi_newton_solve(newton, x, r, d, g), 0);
            fvi_newton_free(newton);
            for (size_t j = 0; j < dim; j++)
                z[j] = x[j] + ti * d[j];
            fvi_potential_hessian(&system, z, H);
            for (size_t j = 0; j < dim; j++) {
                double sum = A[j];
                for (size_t k = 0; k < dim; k++)
                    sum += si * ti * fabs(H[j * dim + k]);
                norm = larger(norm, sum);
                size =
                    larger(size, fabs(x[j]) + fabs(d[j]) + fabs(r[j]) / A[j]);
            }
            for (size_t j = 0; j < dim; j++)
                ck_assert_near(A[j] * d[j] + si * g[j], r[j],
                               4 * (4 + (double)dim) * U * norm * size,
                               "kind %d, s %g, theta %g", kind, si, ti);
            fvi_potential_gradient(&system, z, H); /* g is of this point */
            for (size_t j = 0; j < dim; j++)
                ck_assert_near(g[j], H[j],
                               4 * (4 + (double)dim) * U * norm * size / si,
                               "gradient, kind %d", kind);
        }
    }
}
END_TEST

/* (2.11) is exact: with f the left side of (2.10), f'' = 6 s theta^2 z and
 * f' >= A + s theta, Newton's errors obey e_{j+1} <= max |f''| / (2 min f') e_j^2,
 * and at the end 16 u. The diary has every iterate: z_j = x + theta d_j.
 * Seen: from 1.7 in 7 gradients; a Jacobian that is 1 % off needs 10. */
START_TEST(eq_2_11_newton_converges_quadratically)
{
    diary page = { 0 }, *told = &page;
    const fvi_system system = telling(&told);
    const double x = 1, r = 6, A = 1, s = 0.5, theta = 0.5;
    double d = 0, g, largest = 0;
    fvi_newton *newton = solver(&system, &A, s, theta);
    ck_assert_int_eq(fvi_newton_solve(newton, &x, &r, &d, &g), FVI_SUCCESS);
    fvi_newton_free(newton);
    ck_assert_uint_eq(page.hessians, page.gradients);
    ck_assert_uint_le(page.gradients, 8);
    for (size_t j = 0; j < page.gradients; j++)
        largest = larger(largest, fabs(page.point[j]));
    const double K = 6 * s * theta * theta * largest / (2 * (A + s * theta));
    double last = fabs((page.point[0] - x) / theta - d);
    ck_assert_double_gt(last, 1); /* it began far away */
    for (size_t j = 1; j < page.gradients; j++) {
        double error = fabs((page.point[j] - x) / theta - d);
        ck_assert_msg(error <= K * last * last + 16 * U,
                      "iterate %zu: %g after %g", j, error, last);
        last = error;
    }
}
END_TEST

/* A constant Hessian is asked for once, when the solver is made; one number says what the
 * gradient becomes, too, which is asked for at x alone. */
START_TEST(eq_2_11_a_constant_hessian_is_factorised_once)
{
    diary page = { 0 }, *told = &page;
    fvi_system system = telling(&told);
    /* not true, but counted */
    system.potential.quadratic = fvi_potential_harmonic(NULL).quadratic;
    const double x = 1, r = 1;
    double d = 0, g;
    fvi_newton *newton = solver(&system, one, 0.5, 0.5);
    ck_assert_uint_eq(page.hessians, 1);
    for (size_t i = 0; i < 10; i++)
        ck_assert_int_eq(fvi_newton_solve(newton, &x, &r, &d, &g), 0);
    ck_assert(page.hessians == 1 && page.gradients == 10);
    fvi_newton_free(newton);
}
END_TEST

/* Whether a potential is quadratic is asked when a run starts. */
START_TEST(eq_2_10_parameters_may_change_until_a_run_starts)
{
    enum { N = 20 };
    static const fvi_method *const methods[] = { &fvi_fractional,
                                                 &fvi_lobatto_m3 };
    const double x0[] = { 1, -0.5 }, p0[] = { 0, 0.25 }, final[] = { 1, 2 };
    double x[2 * N + 2], want[2 * N + 2];
    for (int i = 0; i < 4; i++) {
        const int kind = i % 2 ? CHAIN : DUFFING;
        double cg[] = { 1, 0 };
        fvi_system system = { 2, one, one, potential(kind, cg), { 0 }, NULL, NULL };
        fvi_run run = { .system = &system,
                        .x0 = x0,
                        .p0 = p0,
                        .h = 0.25,
                        .steps = N,
                        .kappa = 0.5,
                        .alpha = 0.5 };
        cg[1] = final[1];
        ck_assert_int_eq(fvi_trajectory(methods[i / 2], &run, x, NULL, NULL),
                         0);
        system.potential = potential(kind, final);
        ck_assert_int_eq(fvi_trajectory(methods[i / 2], &run, want, NULL, NULL),
                         0);
        ck_assert_mem_eq(x, want, sizeof x);
    }
}
END_TEST

/* ---- errors ---- */

START_TEST(bad_solvers_are_refused)
{
    const double c = 1, bad[] = { 0, -1, GSL_NAN, GSL_POSINF };
    const fvi_system good = { 2,     one, none, fvi_potential_harmonic(&c),
                              { 0 }, NULL, NULL };
    fvi_system broken = good;
    broken.mass = NULL;
    fvi_newton *const kept = (fvi_newton *)&broken, *n = kept;
    ck_assert_int_eq(fvi_newton_alloc(NULL, one, 1, 1, &n), FVI_EFAULT);
    ck_assert_int_eq(fvi_newton_alloc(&broken, one, 1, 1, &n), FVI_EFAULT);
    ck_assert_int_eq(fvi_newton_alloc(&good, NULL, 1, 1, &n), FVI_EFAULT);
    ck_assert_int_eq(fvi_newton_alloc(&good, one, 1, 1, NULL), FVI_EFAULT);
    for (size_t i = 0; i < LEN(bad); i++) {
        const double A[] = { 1, bad[i] };
        ck_assert_int_eq(fvi_newton_alloc(&good, A, 1, 1, &n), FVI_EDOM);
    }
    ck_assert_int_eq(fvi_newton_alloc(&good, one, GSL_NAN, 1, &n), FVI_EDOM);
    ck_assert_int_eq(fvi_newton_alloc(&good, one, 1, GSL_NEGINF, &n), FVI_EDOM);

    /* A = 1, s theta = 1: 1 - 1 = 0; and [[-1, 1], [1, -1]] in two dimensions. */
    const double soft[] = { -1, 0 };
    fvi_system singular = { 1,     one, none, fvi_potential_duffing(soft),
                            { 0 }, NULL, NULL };
    ck_assert_int_eq(fvi_newton_alloc(&singular, one, 1, 1, &n), FVI_ESING);
    singular.d = 2;
    singular.potential = fvi_potential_chain(soft);
    ck_assert_int_eq(fvi_newton_alloc(&singular, one, 1, 1, &n), FVI_ESING);
    ck_assert_int_eq(fvi_newton_stages_alloc(NULL, 1, one, &n), FVI_EFAULT);
    ck_assert_int_eq(fvi_newton_stages_alloc(&good, 1, NULL, &n), FVI_EFAULT);
    ck_assert_int_eq(fvi_newton_stages_alloc(&good, 1, one, NULL), FVI_EFAULT);
    ck_assert_int_eq(fvi_newton_stages_alloc(&good, 0, one, &n), FVI_EINVAL);
    ck_assert_int_eq(fvi_newton_stages_alloc(&good, 9, one, &n), FVI_EINVAL);
    ck_assert_int_eq(fvi_newton_stages_alloc(&good, 1, bad + 2, &n), FVI_EDOM);
    ck_assert_ptr_eq(n, kept);
    fvi_newton_free(NULL);
}
END_TEST

START_TEST(null_pointers_are_refused_and_infinities_come_back)
{
    const fvi_system duffing = { 1,     one,
                                 none,  fvi_potential_duffing(spring),
                                 { 0 }, NULL, NULL };
    const double x = 1, r = 1, nan = GSL_NAN;
    double d = 0, g = 7;
    fvi_newton *n = solver(&duffing, one, 1, 1);
    ck_assert_int_eq(fvi_newton_solve(NULL, &x, &r, &d, &g), FVI_EFAULT);
    ck_assert_int_eq(fvi_newton_solve(n, NULL, &r, &d, &g), FVI_EFAULT);
    ck_assert_int_eq(fvi_newton_solve(n, &x, NULL, &d, &g), FVI_EFAULT);
    ck_assert_int_eq(fvi_newton_solve(n, &x, &r, NULL, &g), FVI_EFAULT);
    ck_assert_int_eq(fvi_newton_solve(n, &x, &r, &d, NULL), FVI_EFAULT);
    ck_assert(d == 0 && g == 7);
    ck_assert_int_eq(fvi_newton_solve(n, &x, &nan, &d, &g), FVI_SUCCESS);
    ck_assert(gsl_isnan(d));
    fvi_newton_free(n);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("02 the equation of a step");
    ADD_CASE(suite, "values", eq_2_10_linear_equations,
             eq_2_10_is_explicit_at_both_ends_of_kappa);
    ADD_CASE(suite, "identities", eq_2_10_solutions_satisfy_it,
             eq_2_10_parameters_may_change_until_a_run_starts,
             eq_2_11_newton_converges_quadratically,
             eq_2_11_a_constant_hessian_is_factorised_once);
    ADD_CASE(suite, "errors", bad_solvers_are_refused,
             null_pointers_are_refused_and_infinities_come_back);
    return run_suite(suite);
}
