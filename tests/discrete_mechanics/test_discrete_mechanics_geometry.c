/* tests/discrete_mechanics/test_discrete_mechanics_geometry.c -- H 2: areas and energy.
 * Run alone: make test-discrete_mechanics_geometry */
#include <fvi/discrete_mechanics.h>
#include "run/whole_run.h"
#include <fvi/error.h>
#include "harness/energy.h"
#include "harness/fvi_runs.h"
#include "harness/ulp.h"

#include <gsl/gsl_fit.h>
#include <gsl/gsl_math.h>

static const double none[3], one[] = { 1, 1, 1 };
static const double quartic[] = { 1, 2 }, mass3[] = { 1, 2, 0.5 };
static const double start_x[] = { 0.5, -0.75, 1 },
                    start_p[] = { 1, 0.25, -0.5 };

/* ---- areas ---- */

/* M = the derivative of one step at (x, p) in R^d x R^d, times 12 delta, from
 * five points a column: exact for polynomials up to degree 4, up to rounding. */
static void differentiate(const fvi_method *method, const fvi_system *system,
                          double kappa, double h, double delta, double *M)
{
    const size_t d = system->d, n = 2 * d;
    const double weight[] = { 1, -8, 0, 8, -1 };
    const setup a = { .alpha = 0.5, .kappa = kappa, .h = h, .steps = 1 };
    memset(M, 0, n * n * sizeof *M);
    for (size_t column = 0; column < n; column++)
        for (size_t j = 0; j < LEN(weight); j++) {
            double z[6], x[6], p[6];
            memcpy(z, start_x, d * sizeof *z);
            memcpy(z + d, start_p, d * sizeof *z);
            z[column] += ((double)j - 2) * delta;
            run(method, &a, system, z, z + d, x, p);
            for (size_t i = 0; i < d; i++) {
                M[i * n + column] += weight[j] * x[d + i];
                M[(d + i) * n + column] += weight[j] * p[d + i];
            }
        }
}

/* kappa in {0, 1} makes the map of a Duffing oscillator a polynomial of degree 3
 * in each variable, and short binary fractions make all its values exact: the
 * determinant is what (2.12) says, with no rounding at all. */
//> areas
START_TEST(eq_2_12_areas_of_explicit_steps_exactly)
{
    const double h = 0.25, delta = 0.25, rho[] = { 0, 0.5 };
    for (int kappa = 0; kappa <= 1; kappa++)
        for (size_t i = 0; i < LEN(rho); i++) {
            const fvi_system system = { 1,       one,
                                        rho + i, fvi_potential_duffing(quartic),
                                        { 0 },   NULL, NULL };
            double M[4];
            differentiate(&fvi_lagrange_dalembert, &system, kappa, h, delta, M);
            ck_assert_ulp((M[0] * M[3] - M[1] * M[2]) / 9, 1 - h * rho[i], 0,
                          "kappa = %d, rho = %g", kappa, rho[i]);
        }
}
END_TEST
//< areas

/* Any kappa. The five-point quotient is off by C delta^4, so what halving delta
 * changes is 15 times the error that is left; the values, of size 1, have less
 * than 16 u each, 18 of them weigh on a column, and a 2 x 2 determinant has two
 * products of two entries of size up to 2. Seen: 0.011 of the bound. */
START_TEST(eq_2_12_areas_of_implicit_steps)
{
    const double h = 0.25, rho[] = { 0, 0.5 }, delta = 0x1p-8;
    for (double kappa = 0.25; kappa < 1; kappa += 0.25)
        for (size_t i = 0; i < LEN(rho); i++) {
            const fvi_system system = { 1,       one,
                                        rho + i, fvi_potential_duffing(quartic),
                                        { 0 },   NULL, NULL };
            const setup a = {
                .alpha = 0.5, .kappa = kappa, .h = h, .steps = 1
            };
            double det[2], x[2], H;
            for (size_t j = 0; j < 2; j++) {
                double scale = 12 * delta / (j ? 2 : 1), M[4];
                differentiate(&fvi_lagrange_dalembert, &system, kappa, h,
                              delta / (j ? 2 : 1), M);
                det[j] = (M[0] * M[3] - M[1] * M[2]) / (scale * scale);
            }
            run(&fvi_lagrange_dalembert, &a, &system, start_x, start_p, x,
                NULL);
            x[0] = kappa * x[0] + (1 - kappa) * x[1];
            system.potential.hessian(1, x, system.potential.params, &H);
            const double want =
                1 - h * rho[i] / (1 + kappa * (1 - kappa) * h * h * H);
            ck_assert_near(det[1], want,
                           fabs(det[1] - det[0])
                               + 4 * 2 * 18 * 16 * U / (12 * delta / 2),
                           "kappa = %g, rho = %g", kappa, rho[i]);
        }
}
END_TEST

/* M' Omega M = Omega in R^3: every pair of changes keeps its area. Bound as
 * above, for sums of 2 d = 6 products of entries of size up to 4. Seen: 0.02 of
 * the bound. */
START_TEST(eq_2_12_areas_in_three_dimensions)
{
    const fvi_system system = { 3,     mass3,
                                none,  fvi_potential_chain(quartic),
                                { 0 }, NULL, NULL };
    const double delta = 0x1p-8;
    for (double kappa = 0; kappa <= 1; kappa += 0.25) {
        double M[2][36];
        for (size_t j = 0; j < 2; j++)
            differentiate(&fvi_midpoint_variational, &system, kappa, 0.25,
                          delta / (j ? 2 : 1), M[j]);
        for (size_t r = 0; r < 36; r++) {
            double area[2] = { 0 };
            for (size_t j = 0; j < 2; j++)
                for (size_t i = 0; i < 3; i++) {
                    const double *x = M[j] + 6 * i, *p = M[j] + 6 * (i + 3);
                    double scale = 12 * delta / (j ? 2 : 1);
                    area[j] += (x[r / 6] * p[r % 6] - x[r % 6] * p[r / 6])
                               / (scale * scale);
                }
            double want =
                (double)(r / 6 + 3 == r % 6) - (double)(r % 6 + 3 == r / 6);
            ck_assert_near(area[1], want,
                           fabs(area[1] - area[0])
                               + 6 * 2 * 4 * 18 * 16 * U / (12 * delta / 2),
                           "kappa = %g, %zu", kappa, r);
        }
    }
}
END_TEST

/* The determinants with damping: the maps are linear, their columns are the
 * images of (1, 0) and (0, 1). Explicit: exact. Implicit: 16 roundings. */
START_TEST(eq_2_13_what_euler_does_to_areas)
{
    const double c = 3, m = 2, rho = 0.5, h = 0.25, e[] = { 1, 0, 1 };
    const fvi_system system = { 1,     &m,  &rho, fvi_potential_harmonic(&c),
                                { 0 }, NULL, NULL };
    const fvi_method *const both[] = { &fvi_euler_explicit,
                                       &fvi_euler_implicit };
    for (size_t i = 0; i < 2; i++) {
        double x[2][2], p[2][2];
        const setup a = { .alpha = 0.5, .h = h, .steps = 1 };
        for (size_t j = 0; j < 2; j++)
            run(both[i], &a, &system, e + j, e + j + 1, x[j], p[j]);
        double det = x[0][1] * p[1][1] - x[1][1] * p[0][1];
        if (i == 0)
            ck_assert_double_eq(det, 1 - h * rho / m + h * h * c / m);
        else
            ck_assert_near(det, 1 / (1 + h * rho / m + h * h * c / m), 16 * U,
                           "implicit");
    }
}
END_TEST

/* ---- energy ---- */

/* U = c x^2/2, rho = 0: E is multiplied by 1 + h^2 c/m, by its inverse, by 1, in
 * each step. Less than 16 u a step; halved momenta and all, E within 8 u.
 * Seen: 0.083 of the bound. */
START_TEST(eq_2_13_what_euler_does_to_the_energy)
{
    enum { N = 1000 };
    const double c = 3, m = 2, h = 0.05, x0 = 1, p0 = 0.5;
    const struct {
        const fvi_method *method;
        double factor;
    } rows[] = { { &fvi_euler_explicit, 1 + h * h * c / m },
                 { &fvi_euler_implicit, 1 / (1 + h * h * c / m) },
                 { &fvi_midpoint_variational, 1 } };
    const fvi_system system = { 1,     &m,  none, fvi_potential_harmonic(&c),
                                { 0 }, NULL, NULL };
    for (size_t i = 0; i < LEN(rows); i++) {
        const fvi_run r = { .system = &system,
                            .x0 = &x0,
                            .p0 = &p0,
                            .h = h,
                            .steps = N,
                            .kappa = 0.5,
                            .alpha = 0.5 };
        double E[N + 1];
        ck_assert_int_eq(fvi_trajectory(rows[i].method, &r, NULL, NULL, E), 0);
        for (size_t k = 0; k <= N; k++)
            ck_assert_near(E[k] / E[0] / pow(rows[i].factor, (double)k), 1,
                           (16 * (double)k + 8) * U, "%s, k = %zu",
                           rows[i].method->name, k);
    }
}
END_TEST

/* In each of 100 intervals of 1000 steps the farthest energy from E_0, over E_0;
 * a line through the hundred: where it starts, by how much it rises in all. */
static double band(const fvi_run *r, double *rise)
{
    enum { INTERVALS = 100, STEPS = 1000 };
    double time[INTERVALS], far[INTERVALS] = { 0 }, start, cov[4];
    const double E0 = energy_of(r->system, r->x0, r->p0);
    fvi_stepper *s;
    ck_assert_int_eq(fvi_stepper_start(&fvi_midpoint_variational, r, &s,
                                       NULL), FVI_SUCCESS);
    for (size_t i = 0; i < INTERVALS; i++) {
        time[i] = (double)i / INTERVALS;
        for (size_t k = 0; k < STEPS; k++) {
            ck_assert_int_eq(fvi_stepper_step(s), FVI_SUCCESS);
            double E = energy_of(r->system, s->x, s->p);
            far[i] = larger(far[i], fabs(E / E0 - 1));
        }
    }
    fvi_stepper_free(s);
    gsl_fit_linear(time, 1, far, 1, INTERVALS, &start, rise, &cov[0], &cov[1],
                   &cov[2], &cov[3]);
    return start;
}

/* A pendulum that swings out to two radians. The rise over all 10^5 steps is below
 * 1 % of the band: points are h <= 0.1 apart, so the farthest one misses the
 * extreme of a curve like cos(2 t) by at most h^2 / 2, 0.5 %; a line through
 * numbers that differ by no more rises by at most 1.5 times that; rounding adds
 * 10^5 u. Seen: 2e-4 of the band. Its width is C h^q (1 + c h), q = 2 for
 * kappa = 1/2, else 1: the quotient of two is off by c h / (2 ln 2), 0.1 allows
 * |c| < 1.3. */
START_TEST(eq_2_4_energy_stays_in_a_band)
{
    const double g = 1, x0 = 2, p0 = 0, kappas[] = { 0, 0.25, 0.5 };
    const fvi_system system = { 1,     one, none, fvi_potential_pendulum(&g),
                                { 0 }, NULL, NULL };
    for (size_t i = 0; i < LEN(kappas); i++) {
        fvi_run r = { .system = &system,
                      .x0 = &x0,
                      .p0 = &p0,
                      .h = 0.1,
                      .steps = 100000,
                      .kappa = kappas[i],
                      .alpha = 0.5 };
        double rise[2], width = band(&r, rise);
        r.h /= 2;
        double half = band(&r, rise + 1);
        ck_assert_double_lt(fabs(rise[0]), 0.01 * width);
        ck_assert_double_lt(fabs(rise[1]), 0.01 * half);
        ck_assert_near(log2(width / half), kappas[i] == 0.5 ? 2 : 1, 0.1,
                       "kappa = %g", kappas[i]);
        seen(width, "width, kappa=%g", kappas[i]);
        seen(half, "width, kappa=%g, half the step", kappas[i]);
        seen(fabs(rise[0]) / width, "rise");
        seen(fabs(rise[1]) / half, "rise");
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("02 areas and energy");
    ADD_CASE(suite, "areas", eq_2_12_areas_of_explicit_steps_exactly,
             eq_2_12_areas_of_implicit_steps, eq_2_12_areas_in_three_dimensions,
             eq_2_13_what_euler_does_to_areas);
    ADD_CASE(suite, "energy", eq_2_13_what_euler_does_to_the_energy,
             eq_2_4_energy_stays_in_a_band);
    return run_suite(suite);
}
