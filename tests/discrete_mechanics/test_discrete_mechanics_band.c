/* tests/discrete_mechanics/test_discrete_mechanics_band.c -- H 2: the matrix of a step.
 * Run alone: make test-discrete_mechanics_band */
#include <fvi/lobatto.h>
#include "run/whole_run.h"
#include "newton_solver.h"
#include "harness/full_chain.h"
#include "newton/band.h"
#include "system/larger.h"

#include <stdlib.h>

/* Zeros on the diagonal, ones beside it: every pivot has to be exchanged. With
 * v = (1, 2, ..., n) the right side is v_{i-1} + v_{i+1}, all exact. */
START_TEST(eq_2_11_pivots_are_exchanged)
{
    enum { N = 8 };
    fvi_band J;
    double v[N];
    ck_assert_int_eq(fvi_band_alloc(N, 1, &J), 0);
    for (size_t i = 0; i < N; i++) {
        v[i] = (i > 0 ? (double)i : 0) + (i + 1 < N ? (double)i + 2 : 0);
        if (i > 0)
            fvi_band_row(&J, i)[i - 1] = fvi_band_row(&J, i - 1)[i] = 1;
    }
    ck_assert_int_eq(fvi_band_factorise(&J), 0);
    fvi_band_solve(&J, v);
    for (size_t i = 0; i < N; i++)
        ck_assert_double_eq(v[i], (double)i + 1);
    fvi_band_clear(&J);
    ck_assert_int_eq(fvi_band_factorise(&J), FVI_ESING);
    fvi_band_free(&J);
}
END_TEST

/* All widths, full ones too: what was solved is put back. With exchanges the factors
 * of a matrix with entries up to 1 are some n times as large at most here, and a
 * product of theirs has n roundings: n^2 u |v|. Seen: 0.1 of it. */
START_TEST(eq_2_11_band_matrices_of_all_widths_are_inverted)
{
    enum { N = 12 };
    for (size_t w = 0; w < N; w++) {
        fvi_band J;
        double entries[N][N] = { { 0 } }, b[N], v[N], largest = 0;
        ck_assert_int_eq(fvi_band_alloc(N, w, &J), 0);
        for (size_t i = 0; i < N; i++) {
            v[i] = b[i] = cos((double)i);
            for (size_t j = i > w ? i - w : 0; j < N && j <= i + w; j++)
                entries[i][j] = fvi_band_row(&J, i)[j] =
                    sin((double)(1 + i * i + 7 * j + 3 * i * j));
        }
        ck_assert_int_eq(fvi_band_factorise(&J), 0);
        fvi_band_solve(&J, v);
        for (size_t i = 0; i < N; i++)
            largest = larger(largest, fabs(v[i]));
        for (size_t i = 0; i < N; i++) {
            double sum = 0;
            for (size_t j = 0; j < N; j++)
                sum += entries[i][j] * v[j];
            ck_assert_near(sum, b[i], N * N * U * largest, "w %zu, row %zu", w,
                           i);
        }
        fvi_band_free(&J);
    }
}
END_TEST

/* A chain with two diagonals, and the same with a full Hessian: one step's rounding
 * each, which N steps add up. Linear springs are solved by the matrix alone; of others
 * Newton's method forgives a wrong one. Seen: the same digits. */
START_TEST(eq_2_11_bands_and_full_matrices_agree)
{
    enum { D = 5, N = 50 };
    static const fvi_method *const methods[] = { &fvi_fractional, &fvi_lobatto_m3,
                                                 &fvi_lobatto_m4 };
    const double cg[][2] = { { 1, 0 }, { 1, 2 } },
                 x0[D] = { 1, -0.5, 0.25, 0, 2 };
    double x[D * (N + 1)], want[D * (N + 1)];
    for (size_t m = 0; m < 2 * LEN(methods); m++) {
        const fvi_method *method = methods[m / 2];
        fvi_system system = { D,     one, one, fvi_potential_chain(cg[m % 2]),
                              { 0 }, NULL, NULL };
        const fvi_run run = { .system = &system,
                              .x0 = x0,
                              .p0 = none,
                              .h = 0.125,
                              .steps = N,
                              .kappa = 0.5,
                              .alpha = 0.75 };
        ck_assert_int_eq(fvi_trajectory(method, &run, x, NULL, NULL), 0);
        system.potential.hessian = full_chain_hessian;
        system.potential.diagonals = 0;
        ck_assert_int_eq(fvi_trajectory(method, &run, want, NULL, NULL), 0);
        ck_assert_near(farthest(LEN(x), x, want), 0, 10 * N * U, "%s, g = %g",
                       method->name, cg[m % 2][1]);
    }
}
END_TEST

/* A full Jacobian has 2^44 numbers; that of a chain 2^24, and without a potential
 * there is none. */
START_TEST(a_jacobian_that_finds_no_room_is_refused)
{
    enum { D = 1 << 22 };
    double *ones = malloc(D * sizeof *ones);
    ck_assert_ptr_nonnull(ones);
    for (size_t i = 0; i < D; i++)
        ones[i] = 1;
    fvi_system system = { D, ones, ones, potential(CUBIC, ones), { 0 }, NULL, NULL };
    fvi_newton *n = NULL;
    ck_assert_int_eq(fvi_newton_alloc(&system, ones, 1, 1, &n), FVI_ENOMEM);
    ck_assert_ptr_null(n);
    const fvi_potential small[] = { { 0 }, fvi_potential_chain(ones) };
    for (size_t i = 0; i < LEN(small); i++) {
        system.potential = small[i];
        ck_assert_int_eq(fvi_newton_alloc(&system, ones, 1, 1, &n), 0);
        fvi_newton_free(n);
    }
    free(ones);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("02 the matrix of a step");
    ADD_CASE(suite, "identities", eq_2_11_pivots_are_exchanged,
             eq_2_11_band_matrices_of_all_widths_are_inverted,
             eq_2_11_bands_and_full_matrices_agree);
    ADD_CASE(suite, "errors", a_jacobian_that_finds_no_room_is_refused);
    return run_suite(suite);
}
