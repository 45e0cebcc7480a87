/* tests/exact_solution/test_exact_solution_rows.c -- H 11: all rows at once.
 * Run alone: make test-exact_solution_rows */
#include "reference/exact_window.h"
#include "exact_rows.h"
#include "harness/bagley_torvik.h"

#include "reference_problem.h"
#include "system/larger.h"

enum { PROBLEMS = 600 };

/* Any past, order and force; without spring or damping now and then; forces near
 * resonance; strong and weak damping. *h n is from 1/100 to 10^4 swings of the spring. */
static fvi_linear_oscillator any(uint64_t *seed, size_t n, double *h)
{
    const double whole[] = { 0, 0.5, 1 }, kind = chance(seed);
    fvi_linear_oscillator p = { .m = between(seed, 1e-3, 1e3),
                     .c = between(seed, 1e-3, 1e3),
                     .alpha =
                         kind < 0.3 ? whole[(int)(10 * kind)] : chance(seed),
                     .past = (fvi_initial_history)(3 * chance(seed)),
                     .x0 = chance(seed) < 0.3 ? 0 : chance(seed) - 0.5,
                     .v0 = chance(seed) < 0.3 ? 0 : chance(seed) - 0.5,
                     .forcing = (fvi_forcing)(3 * chance(seed)),
                     .A = chance(seed) - 0.5 };
    const double w = sqrt(p.c / p.m), end = between(seed, 1e-2, 1e4) / w;
    double re = 0;
    p.v0 *= w;
    p.A *= p.c;
    p.w = w * between(seed, 1e-2, 1e2);
    p.T = end * between(seed, 1e-6, 2);
    *h = end / (double)n;
    p.rho = p.c * between(seed, 1e-6, 1e3) * pow(w, -2 * p.alpha);
    if (chance(seed) < 0.1)
        p.rho = 0;
    if (chance(seed) < 0.1)
        p.c = 0;
    if (p.past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE && p.alpha > 0.5)
        p.x0 = 0;
    if (chance(seed) < 0.3 && fvi_exact_pole(&p, &re, &p.w,
                                             NULL) == FVI_SUCCESS)
        p.w *= 1 + between(seed, 1e-9, 1e-1);
    return p;
}

START_TEST(eq_11_15_rows_are_the_solution)
{
    uint64_t seed = 1;
    for (int i = 0; i < PROBLEMS; i++) {
        char what[300];
        double h;
        const size_t n = (size_t)between(&seed, 1, i % 20 ? 1e3 : 1e5);
        const double tolerance = i % 4 ? between(&seed, 1e-14, 0.3) : 0;
        const fvi_linear_oscillator p = any(&seed, n, &h);
        snprintf(
            what, sizeof what,
            "%d: m=%a c=%a rho=%a alpha=%a past=%d x0=%a v0=%a force=%d A=%a "
            "T=%a w=%a h=%a tolerance=%g",
            i, p.m, p.c, p.rho, p.alpha, p.past, p.x0, p.v0, p.forcing, p.A,
            p.T, p.w, h, tolerance);
        ck_assert_rows(&p, h, n, tolerance, what);
    }
}
END_TEST

/* The last of 1, 2 and 64 rows is at the time of a reference value. */
START_TEST(eq_11_15_rows_match_talbot_and_the_cut)
{
    for (size_t i = 0; i < LEN(ref_solutions); i++)
        for (size_t n = 1; n <= 64; n = n == 1 ? 2 : 32 * n) {
            const fvi_linear_oscillator p = reference_problem(i);
            double t = ref_solutions[i].t, x[65], v[65],
                   X = ref_solutions[i].size_x;
            ck_assert_int_eq(fvi_exact_grid(&p, t / (double)n, n, 0, x, v,
                                            NULL),
                             FVI_SUCCESS);
            ck_assert_near(x[n], ref_solutions[i].x, TOL * X,
                           "x, %zu rows, reference %zu", n, i);
            ck_assert_near(v[n], ref_solutions[i].v,
                           TOL * (ref_solutions[i].size_v + X / t),
                           "x', %zu rows, reference %zu", n, i);
        }
}
END_TEST

/* A body that nothing holds, pushed and pulled, and one that creeps: of the transforms of
 * (11.17) those that grow most towards 0. Here the tolerance is the bound. */
START_TEST(eq_11_17_motions_that_grow)
{
    const fvi_linear_oscillator grow[] = { { .m = 1,
                                  .rho = 1e-9,
                                  .alpha = 0.8,
                                  .forcing = FVI_FORCING_STEP,
                                  .A = 1,
                                  .T = 99 },
                                { .m = 1, .rho = 1e-9, .alpha = 0.8, .v0 = 1 },
                                { .m = 1e-6,
                                  .c = 1e-6,
                                  .rho = 1,
                                  .alpha = 0.9,
                                  .forcing = FVI_FORCING_STEP,
                                  .A = 1,
                                  .T = 99 } };
    for (size_t i = 0; i < LEN(grow); i++)
        for (double tolerance = 0.1; tolerance > 1e-13; tolerance /= 10) {
            double x[51], want[51], t[51];
            for (size_t k = 0; k <= 50; k++)
                t[k] = (double)k;
            ck_assert_int_eq(fvi_exact_at(&grow[i], 51, t, want, NULL,
                                          NULL), 0);
            ck_assert_int_eq(
                fvi_exact_grid(&grow[i], 1, 50, tolerance, x, NULL, NULL), 0);
            for (size_t k = 0; k <= 50; k++)
                ck_assert_near(x[k], want[k], tolerance * fabs(want[50]),
                               "%zu, row %zu, %g", i, k, tolerance);
        }
}
END_TEST

/* It ends before the first row, so late that this one sees two starts; a window of all rows
 * would cancel a hundredfold. Or at a row, or by little before or after one, whose second
 * start is then a moment ago. The bound is a fifth of TOL. */
START_TEST(eq_11_17_a_force_that_ends_soon)
{
    const double ends[] = { 0.6, 5 - 0x1p-40, 5, 5 + 0x1p-40 };
    for (size_t i = 0; i < LEN(ends); i++)
        for (double c = 1e-4; c < 2; c *= 3) {
            const fvi_linear_oscillator p = { .m = 1,
                                   .c = c,
                                   .rho = 0.01,
                                   .alpha = 0.3,
                                   .forcing = FVI_FORCING_STEP,
                                   .A = 1,
                                   .T = ends[i] };
            double x[101], want[101], t[101], X = 0;
            for (size_t k = 0; k <= 100; k++)
                t[k] = (double)k;
            ck_assert_int_eq(fvi_exact_at(&p, 101, t, want, NULL, NULL), 0);
            ck_assert_int_eq(fvi_exact_grid(&p, 1, 100, 0, x, NULL, NULL), 0);
            for (size_t k = 0; k <= 100; k++)
                X = larger(X, fabs(want[k]));
            for (size_t k = 0; k <= 100; k++)
                ck_assert_near(x[k], want[k], TOL / 5 * X,
                               "T=%g, c=%g, row %zu", ends[i], c, k);
        }
}
END_TEST

/* Bagley and Torvik's plate, 80 rows. The count is the claim of (11.16). */
START_TEST(eq_11_16_nodes_of_a_window)
{
    const fvi_linear_oscillator plate = bagley_torvik();
    const double tolerances[] = { 1e-2, 1e-12 };
    const char *names[] = { "nodes for 1e-2", "nodes for 1e-12" };
    const size_t most[] = { 40, 100 };
    for (size_t i = 0; i < LEN(tolerances); i++) {
        fvi_inverse S;
        fvi_window w;
        ck_assert_int_eq(fvi_inverse_prepare(&plate, &S, NULL), FVI_SUCCESS);
        ck_assert_int_eq(
            fvi_window_open(&S, 0.25, 20, 0.25, tolerances[i], 1, &w, NULL),
            FVI_SUCCESS);
        ck_assert(w.count > 0 && w.count < most[i]);
        ck_assert(w.z.re[w.count - 1] * 0.25 / 20 < -w.folds + 0.2 * w.folds);
        seen((double)w.count, "%s", names[i]);
        fvi_window_close(&w);
    }
}
END_TEST

/* Sums of powers and fractions; the bound is that of fvi_exact_at for laws, twice. */
START_TEST(eq_11_15_rows_with_a_law)
{
    const fvi_kernel_term
        powers[] = { { .kind = FVI_KERNEL_POWER, .rho = 0.3, .alpha = 0.25 },
                     { .kind = FVI_KERNEL_POWER, .rho = 0.2, .alpha = 0.6 } },
        zener[] = {
            { .kind = FVI_KERNEL_ZENER, .rho = 0.7, .alpha = 0.4, .time = 2 }
        };
    const fvi_kernel laws[] = { { .count = 2, .term = powers },
                             { .count = 1, .term = zener },
                             { .count = 1, .term = powers } };
    for (size_t i = 0; i < 3 * LEN(laws); i++) {
        const fvi_linear_oscillator p = { .m = 2,
                               .c = 1,
                               .rho = 1,
                               .x0 = 0.5,
                               .v0 = -1,
                               .forcing = (fvi_forcing)(i / LEN(laws)),
                               .A = 1.5,
                               .T = 3.3,
                               .w = 0.9,
                               .law = &laws[i % LEN(laws)] };
        double t[201], x[201], v[201], want_x[201], want_v[201], X = 0, V = 0;
        for (size_t k = 0; k <= 200; k++)
            t[k] = (double)k * 0.3;
        ck_assert_int_eq(fvi_exact_at(&p, 201, t, want_x, want_v,
                                      NULL), FVI_SUCCESS);
        ck_assert_int_eq(fvi_exact_grid(&p, 0.3, 200, 0, x, v,
                                        NULL), FVI_SUCCESS);
        for (size_t k = 0; k <= 200; k++) {
            X = larger(X, fabs(x[k]));
            V = larger(V, fabs(v[k]));
        }
        for (size_t k = 1; k <= 200; k++) {
            const double bound = 2 * (2e-13 + 4 * U * t[k]);
            ck_assert_near(x[k], want_x[k], bound * X, "x, %zu, %zu", i, k);
            ck_assert_near(v[k], want_v[k], bound * (V + X / t[k]),
                           "x', %zu, %zu", i, k);
        }
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("11 exact solution, rows");
    ADD_CASE(suite, "rows", eq_11_15_rows_are_the_solution,
             eq_11_15_rows_match_talbot_and_the_cut, eq_11_15_rows_with_a_law,
             eq_11_16_nodes_of_a_window, eq_11_17_motions_that_grow,
             eq_11_17_a_force_that_ends_soon);
    return run_suite(suite);
}
