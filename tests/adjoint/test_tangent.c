/* tests/adjoint/test_tangent.c -- H 24: derivatives along directions, computed together with a run.
 * Run alone: make test-tangent
 *
 * J = sum_k a_k . x_k + b_k . p_k has the derivative sum_k a_k . dx_k + b_k . dp_k along a direction. The adjoint
 * run gives the same number as the product of its gradient with the direction. The two solve the same equations in
 * opposite orders, with different memories. Other tests compare the gradient with references of 40 digits. */
#include "runs_of_all_kinds.h"
#include <fvi/adjoint.h>

/* Numbers of no ratio to each other. */
static double share_of_x(size_t k, size_t i)
{
    return cos((double)(3 * k + 5 * i + 1));
}

static double share_of_p(size_t k, size_t i)
{
    return sin((double)(2 * k + 7 * i + 1)) / 2;
}

static int all_rows(size_t k, size_t d, const double *x, const double *p, void *params, double *Jx,
                    double *Jp)
{
    (void)x, (void)p, (void)params;
    for (size_t i = 0; i < d; i++) {
        Jx[i] += share_of_x(k, i);
        Jp[i] += share_of_p(k, i);
    }
    return 0;
}

/* Directions: each number moves by a number of its own; P of them. */
enum { P = 2 };
static double along[P][NUMBERS_IN_ALL];

static void choose_directions(const fvi_run *run, fvi_sensitivities of[P])
{
    for (size_t j = 0; j < P; j++) {
        for (size_t n = 0; n < NUMBERS_IN_ALL; n++)
            along[j][n] = cos((double)(11 * n + 3 * j) + 0.3);
        of[j] = into(along[j], run);
    }
}

static double product(const double *gradient, const double *direction)
{
    double sum = 0;
    for (size_t n = 0; n < NUMBERS_IN_ALL; n++)
        sum += gradient[n] * direction[n];
    return sum;
}

/* What the products are made of: rounding is a part of that. */
static double size_of(const double *gradient, const double *direction)
{
    double sum = 0;
    for (size_t n = 0; n < NUMBERS_IN_ALL; n++)
        sum += fabs(gradient[n] * direction[n]);
    return sum;
}

static double of_rows(const double *dx, const double *dp, size_t j)
{
    double sum = 0;
    for (size_t k = 0; k <= N; k++)
        for (size_t i = 0; i < D; i++)
            sum += share_of_x(k, i) * dx[(k * P + j) * D + i] + share_of_p(k, i) * dp[(k * P + j) * D + i];
    return sum;
}

/* Twelve steps of 100 roundings each, and products of sums of 100 terms: 1e-13 of the terms; with eight stages
 * what adjoint.h says, of both. Seen: 1e-14, with eight stages 8e-13. */
static void ck_assert_same(const fvi_method *method, const fvi_run *run)
{
    static double gradient[NUMBERS_IN_ALL], x[(N + 1) * D], p[(N + 1) * D], dx[(N + 1) * P * D],
        dp[(N + 1) * P * D];
    const fvi_objective J = { .slopes = all_rows, .has_momenta = 1 };
    fvi_sensitivities of[P];
    memset(gradient, 0, sizeof gradient);
    const fvi_sensitivities to = into(gradient, run);
    OK(fvi_adjoint(method, run, NULL, NULL, &J, &to));
    choose_directions(run, of);
    for (size_t n = 0; n < NUMBERS_IN_ALL; n++)
        if (isnan(gradient[n])) /* (19.2): no other start, so no direction either */
            gradient[n] = along[0][n] = along[1][n] = 0;
    OK(fvi_directional_derivatives(method, run, P, of, x, p, dx, dp));
    const double bound = method->stages == 8 ? 2e-12 : 1e-13;
    for (size_t j = 0; j < P; j++) {
        const double want = product(gradient, along[j]), got = of_rows(dx, dp, j),
                     size = size_of(gradient, along[j]);
        seen_worst(fabs(got - want) / size, method->stages == 8 ? "eight stages" : "worst");
        ck_assert_near(got, want, bound * size, "%s, past %d, alpha %g, direction %zu", method->name,
                       (int)run->past, run->alpha, j);
    }
}

START_TEST(a_chain_has_the_same_derivatives_forwards_and_backwards)
{
    check_chains(ck_assert_same);
}
END_TEST

START_TEST(so_has_a_chain_with_a_law)
{
    check_chains_with_a_law(ck_assert_same);
}
END_TEST

START_TEST(so_has_a_structure)
{
    check_structures(ck_assert_same);
}
END_TEST

START_TEST(so_has_a_structure_with_several_dampers)
{
    check_damped_structures(ck_assert_same);
}
END_TEST

/* The code of x(N) and the rest along one direction. */
static int code_of(const fvi_method *method, const fvi_run *run, const fvi_sensitivities *direction)
{
    double x[(N + 1) * D], dx[(N + 1) * D];
    return fvi_directional_derivatives(method, run, 1, direction, x, NULL, dx, NULL);
}

START_TEST(what_has_no_derivatives_along_a_direction)
{
    double one[TERMS] = { 1 }, x[(N + 1) * D], dx[(N + 1) * D];
    const fvi_sensitivities by_x0 = { .x0 = one }, by_alpha = { .alpha = one }, by_terms = { .terms = one },
                            by_parameters = { .parameters = one, .sensitivity = { .count = 1 } };
    chain c;
    chain_at(&c, FVI_INITIAL_HISTORY_HELD, 0.3);
    ck_assert_int_eq(fvi_directional_derivatives(NULL, &c.run, 1, &by_x0, x, NULL, dx, NULL), FVI_EFAULT);
    ck_assert_int_eq(fvi_directional_derivatives(methods[0], NULL, 1, &by_x0, x, NULL, dx, NULL), FVI_EFAULT);
    ck_assert_int_eq(fvi_directional_derivatives(methods[0], &c.run, 1, NULL, x, NULL, dx, NULL), FVI_EFAULT);
    ck_assert_int_eq(fvi_directional_derivatives(methods[0], &c.run, 1, &by_x0, NULL, NULL, dx, NULL), FVI_EFAULT);
    ck_assert_int_eq(fvi_directional_derivatives(methods[0], &c.run, 1, &by_x0, x, NULL, NULL, NULL), FVI_EFAULT);
    ck_assert_int_eq(fvi_directional_derivatives(methods[0], &c.run, 0, &by_x0, x, NULL, dx, NULL), FVI_EINVAL);
    ck_assert_int_eq(code_of(methods[0], &c.run, &by_terms), FVI_EINVAL);
    ck_assert_int_eq(code_of(methods[0], &c.run, &by_parameters), FVI_EINVAL);
    ck_assert_int_eq(code_of(&fvi_variable_step, &c.run, &by_x0), FVI_EUNSUP);
    c.run.law = &c.law;
    ck_assert_int_eq(code_of(methods[0], &c.run, &by_alpha), FVI_EINVAL);
    ck_assert_int_eq(code_of(&fvi_cq2_shifted, &c.run, &by_x0), FVI_EUNSUP);
    c.run.law = NULL;
    c.run.alpha = 1;
    ck_assert_int_eq(code_of(&fvi_lobatto_m3, &c.run, &by_x0), FVI_EUNSUP);
}
END_TEST

/* Several dampers have no alpha, and above the order 1 the past of Riemann and Liouville stretches none of them:
 * (19.2) has no motion from another x0. */
START_TEST(what_several_dampers_have_no_derivatives_along)
{
    double one[TERMS] = { 1 };
    const fvi_sensitivities by_x0 = { .x0 = one }, by_p0 = { .p0 = one }, by_alpha = { .alpha = one };
    const double x0[D] = { 0 }, p0[D] = { 0.5, -0.3, 0.2 }, order[DAMPERS] = { 0.3, 0.8, 0.2 };
    const fvi_initial_history past[DAMPERS] = { FVI_INITIAL_HISTORY_HELD, FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE,
                                                FVI_INITIAL_HISTORY_HELD },
                              held[DAMPERS] = { FVI_INITIAL_HISTORY_HELD };
    damped_structure s;
    make_damped(&s, order, held, 0);
    fvi_run run = run_of(&s.system, 0.5, 1. / 8, N, x0, p0);
    for (size_t i = 0; i < LEN(takers_of_matrices); i++)
        ck_assert_int_eq(code_of(takers_of_matrices[i], &run, &by_alpha), FVI_EINVAL);
    drop_damped(&s);
    make_damped(&s, order, past, 0);
    run = run_of(&s.system, 0.5, 1. / 8, N, x0, p0);
    for (size_t i = 0; i < LEN(takers_of_matrices); i++) {
        ck_assert_int_eq(code_of(takers_of_matrices[i], &run, &by_x0), FVI_EUNSUP);
        ck_assert_int_eq(code_of(takers_of_matrices[i], &run, &by_p0),
                         takers_of_matrices[i]->stages ? FVI_SUCCESS : FVI_EUNSUP);
    }
    drop_damped(&s);
}
END_TEST

/* (19.2): no motion starts beside x0 = 0, so along such a direction nothing is a number, and along p0 all is. */
START_TEST(along_x0_where_no_other_motion_starts_nothing_is_a_number)
{
    double one[D] = { 1 }, x[(N + 1) * D], dx[(N + 1) * P * D];
    const fvi_sensitivities of[P] = { { .x0 = one }, { .p0 = one } };
    chain c;
    chain_at(&c, FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE, 0.7);
    for (size_t i = 0; i < LEN(methods); i++) {
        OK(fvi_directional_derivatives(methods[i], &c.run, P, of, x, NULL, dx, NULL));
        for (size_t n = 0; n < (N + 1) * P * D; n++) {
            const size_t k = n / (P * D), j = n / D % P;
            if (methods[i] == &fvi_fractional || k == 0 || j == 1)
                ck_assert(isfinite(dx[n]));
            else
                ck_assert(isnan(dx[n]));
        }
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("tangents");
    ADD_CASE(suite, "identity", a_chain_has_the_same_derivatives_forwards_and_backwards,
             so_has_a_chain_with_a_law, so_has_a_structure, so_has_a_structure_with_several_dampers);
    ADD_CASE(suite, "refused", what_has_no_derivatives_along_a_direction,
             what_several_dampers_have_no_derivatives_along,
             along_x0_where_no_other_motion_starts_nothing_is_a_number);
    return run_suite(suite);
}
