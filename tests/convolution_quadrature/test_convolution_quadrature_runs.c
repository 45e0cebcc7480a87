/* tests/convolution_quadrature/test_convolution_quadrature_runs.c -- H 13: both integrators of order 2, compared
 * with exact values, and their known properties.
 * Run alone: make test-convolution_quadrature_runs */
#include "harness/fvi_runs.h"

#include "convolution_quadrature_ref.h"
#include "convolution_quadrature_runs.h"

#include <gsl/gsl_math.h>

/* As in H 9: what two runs may differ by that are equal but for rounding.
 * A rounding in a step acts like an impulse, a run answers a unit impulse with G;
 * in each step some 20 roundings of the size of p, h grad U (8 h X), h F and
 * m x / h, and (n + 50) u times sum |w_n| |x| <= 16^alpha X in the memory, twice. */
static double rounding(const fvi_method *method, const setup *a,
                       const double *x, const double *p)
{
    double answer[201];
    setup unit = *a;
    unit.x0 = 0;
    unit.p0 = 1;
    unit.potential = HARMONIC;
    unit.force.value = NULL;
    solve(method, &unit, answer, NULL);
    const size_t n = a->steps + 1;
    double G = farthest(n, answer, NULL), X = farthest(n, x, NULL),
           P = farthest(n, p, NULL);
    double step = 20 * (P + 8 * a->h * X + a->mass / a->h * X)
                  + 2 * ((double)n + 50) * a->rho * pow(16, a->alpha)
                        * pow(a->h, 1 - 2 * a->alpha) * X;
    return (a->potential == HARMONIC ? 1 : 10) * (double)n * U * G * step;
}

//> values
/* (13.7), (13.9). In the exact cases every number that occurs is a short binary
 * fraction: 0 ulp. Else the bound above, and m/h times that for p. Seen: 3e-16,
 * 0.0006 of it. */
START_TEST(eq_13_7_trajectories_are_the_exact_ones)
{
    for (size_t r = 0; r < LEN(ref_runs); r++) {
        const int kind = ref_runs[r].cg[1] != 0 ? CUBIC : HARMONIC;
        const fvi_method *method = methods[ref_runs[r].bdf2];
        const setup a = { ref_runs[r].alpha,
                          ref_runs[r].kappa,
                          ref_runs[r].h,
                          ref_runs[r].steps,
                          FVI_INITIAL_HISTORY_CAPUTO,
                          ref_runs[r].mass,
                          ref_runs[r].rho,
                          ref_runs[r].x0,
                          ref_runs[r].p0,
                          kind,
                          { ref_runs[r].cg[0], ref_runs[r].cg[1] },
                          fvi_force_step(ref_runs[r].step) };
        double x[30], p[30];
        solve(method, &a, x, p);
        const double bound = ref_runs[r].exact ? 0 : rounding(method, &a, x, p);
        for (size_t k = 0; k <= a.steps; k++) {
            const size_t row = ref_runs[r].first + k;
            ck_assert_near(x[k], ref_rows[row].x, bound, "%s: x, k=%zu",
                           ref_runs[r].name, k);
            ck_assert_near(p[k], ref_rows[row].p, bound * (a.mass / a.h),
                           "%s: p, k=%zu", ref_runs[r].name, k);
        }
    }
}
END_TEST
//< values

/* (13.10) at alpha = 1/2: f^+ = f^- = -rho (x_{k+1} - x_k)/2, the midpoint rule of
 * Lagrange and d'Alembert. Seen: 1.1e-16, 3e-5 of the bound. */
START_TEST(eq_13_10_the_half_derivative_shifted_is_the_midpoint_rule)
{
    const double kappas[] = { 0, 0.25, 0.5, 1 };
    for (size_t i = 0; i < LEN(kappas); i++) {
        const setup a = {
            0.5, kappas[i], 0.1, 100,      FVI_INITIAL_HISTORY_CAPUTO, 2,
            0.7, 0.5,       0.3, HARMONIC, { 1, 0 },        { 0 }
        };
        double x[101], p[101], want = a.x0, q = a.p0;
        solve(&fvi_cq2_shifted, &a, x, p);
        const double bound = rounding(&fvi_cq2_shifted, &a, x, p), K = a.kappa;
        for (size_t k = 0; k <= a.steps; k++) {
            ck_assert_near(x[k], want, bound, "kappa=%g k=%zu", K, k);
            double dx = (q - K * a.h * want)
                        / (a.mass / a.h + a.rho / 2 + K * (1 - K) * a.h);
            q -= a.rho * dx + a.h * (want + (1 - K) * dx);
            want += dx;
        }
    }
}
END_TEST

/* alpha = 1: Algorithm 1 with the mass m + rho, and the velocity p_0/m. The same x.
 * Seen: 4e-15; the bound takes the memory at its worst, 10^-8. */
START_TEST(eq_13_14_at_alpha_1_the_damping_is_an_added_mass)
{
    for (int kind = HARMONIC; kind <= PENDULUM; kind++) {
        if (kind == CHAIN)
            continue;
        setup a = { 1,   0.5, 0.1, 200,  FVI_INITIAL_HISTORY_CAPUTO, 2,
                    3.5, 0.5, 0.3, kind, { 1, 0.5 },      { 0 } };
        double x[201], p[201], want[201];
        solve(&fvi_cq2_shifted, &a, x, p);
        const double bound = rounding(&fvi_cq2_shifted, &a, x, p);
        a.p0 *= (a.mass + a.rho) / a.mass;
        a.mass += a.rho;
        a.rho = 0;
        solve(&fvi_midpoint_variational, &a, want, NULL);
        ck_assert_near(farthest(201, x, want), 0, bound, "potential %d", kind);
    }
}
END_TEST

/* rho = 0: those that take kappa are Algorithm 1. Seen: 0.0008 of the bound. */
START_TEST(eq_13_10_without_damping_it_is_algorithm_1)
{
    for (int kind = HARMONIC; kind <= PENDULUM; kind++) {
        if (kind == CHAIN)
            continue;
        const setup a = { 0.3, 0.25, 0.1, 100,  FVI_INITIAL_HISTORY_CAPUTO, 2,
                          0,   0.5,  0.3, kind, { 1, 1 },        { 0 } };
        double x[101], p[101], want[101];
        solve(&fvi_midpoint_variational, &a, want, NULL);
        for (size_t i = 0; i < LEN(methods); i++) {
            if (!methods[i]->takes_kappa)
                continue;
            solve(methods[i], &a, x, p);
            ck_assert_near(farthest(101, x, want), 0,
                           rounding(methods[i], &a, x, p), "potential %d",
                           kind);
        }
    }
}
END_TEST

/* Three masses that do not feel each other, two damped: each does what it does
 * alone, bit for bit. */
START_TEST(eq_13_10_only_damped_coordinates_have_a_history)
{
    const double mass[] = { 2, 1, 3 }, rho[] = { 0, 0.5, 0.2 },
                 x0[] = { -0.5, 1, 0.25 }, p0[] = { 0.7, 0.2, 0 }, c = 1,
                 step[] = { 1, 2 }, alphas[] = { 0.3, 0.5, 0.8 };
    const fvi_system system = {
        3, mass, rho, fvi_potential_harmonic(&c), fvi_force_step(step), NULL, NULL
    };
    for (size_t i = 0; i < LEN(alphas) * LEN(methods); i++) {
        const fvi_method *method = methods[i / LEN(alphas)];
        double both[153], alone[51];
        for (size_t j = 0; j < 3; j++) {
            setup a = { .h = 0.125, .steps = 50, .cg = { c, 0 }, .kappa = 0.5 };
            a.alpha = alphas[i % LEN(alphas)];
            a.mass = mass[j];
            a.rho = rho[j];
            a.x0 = x0[j];
            a.p0 = p0[j];
            a.force = system.force;
            run(method, &a, &system, x0, p0, both, NULL);
            solve(method, &a, alone, NULL);
            for (size_t k = 0; k <= 50; k++)
                ck_assert_ulp(both[3 * k + j], alone[k], 0, "%s mass %zu k=%zu",
                              method->name, j, k);
        }
    }
}
END_TEST

/* As in H 9: each mode of a chain moves as one mass does. Seen: 1.3e-15, 0.00015
 * of the bound. */
START_TEST(eq_13_7_the_modes_of_a_chain_decouple)
{
    enum { D = 5, N = 40 };
    const double mass[D] = { 1.5, 1.5, 1.5, 1.5, 1.5 }, c[] = { 2, 0 },
                 rho[D] = { 0.4, 0.4, 0.4, 0.4, 0.4 },
                 alphas[] = { 0.1, 0.5, 0.8 };
    const fvi_system system = { D,     mass, rho, fvi_potential_chain(c),
                                { 0 }, NULL, NULL };
    for (size_t i = 0; i < LEN(alphas) * D * LEN(methods); i++) {
        const fvi_method *method = methods[i / LEN(alphas) / D];
        const double j = (double)(i % D) + 1, s = sin(M_PI / 2 * j / (D + 1));
        double x0[D], p0[D], x[(N + 1) * D], mode[N + 1], p[N + 1];
        for (size_t n = 0; n < D; n++) {
            x0[n] = sin(M_PI * j * (double)(n + 1) / (D + 1));
            p0[n] = 0.5 * x0[n];
        }
        const setup one = { alphas[i / D % LEN(alphas)],
                            0.25,
                            0.125,
                            N,
                            FVI_INITIAL_HISTORY_CAPUTO,
                            mass[0],
                            rho[0],
                            1,
                            0.5,
                            HARMONIC,
                            { 4 * c[0] * s * s, 0 },
                            { 0 } };
        run(method, &one, &system, x0, p0, x, NULL);
        solve(method, &one, mode, p);
        for (size_t k = 0; k < (N + 1) * D; k++)
            ck_assert_near(x[k], mode[k / D] * x0[k % D],
                           (3 * D + 1) * rounding(method, &one, mode, p),
                           "%s alpha=%g mode %g k=%zu", method->name, one.alpha,
                           j, k / D);
    }
}
END_TEST

/* Caputo's damping knows no origin and, for 2 alpha > 1, no uniform motion. Seen: 0.0002 of the bound. */
START_TEST(eq_13_7_the_memory_knows_no_origin_and_no_uniform_motion)
{
    const double alphas[] = { 0.1, 0.25, 0.5, 0.75, 1 };
    for (size_t i = 0; i < LEN(alphas) * LEN(methods); i++) {
        const fvi_method *method = methods[i / LEN(alphas)];
        setup a = { alphas[i % LEN(alphas)],
                    0.5,
                    0.125,
                    60,
                    FVI_INITIAL_HISTORY_CAPUTO,
                    1,
                    0.5,
                    0,
                    0.75,
                    HARMONIC,
                    { 0, 0 },
                    { 0 } };
        double here[61], there[61], p[61];
        solve(method, &a, here, p);
        a.x0 = 8;
        solve(method, &a, there, NULL);
        for (size_t k = 0; k <= 60; k++) {
            ck_assert_near(there[k] - 8, here[k],
                           rounding(method, &a, there, p), "alpha=%g k=%zu",
                           a.alpha, k);
            if (a.alpha > 0.5)
                ck_assert_near(here[k], 0.75 * 0.125 * (double)k,
                               rounding(method, &a, there, p), "alpha=%g k=%zu",
                               a.alpha, k);
        }
    }
}
END_TEST

/* Two eights of springs and three more: the factors of (13.11) and (13.16) go over the coordinates by eights. */
START_TEST(eq_13_11_each_of_nineteen_coordinates_has_the_bits_of_its_own)
{
    enum { D = 19, STEPS = 60 };
    static const fvi_method *const all[] = { &fvi_cq_bdf2, &fvi_cq2_midpoint, &fvi_cq2_shifted };
    const double c = 2;
    double mass[D], rho[D], x0[D], p0[D];
    static double x[(STEPS + 1) * D], own[STEPS + 1];
    for (size_t j = 0; j < D; j++) {
        mass[j] = 1 + 0.1 * (double)j;
        rho[j] = 0.2 + 0.03 * (double)j;
        x0[j] = sin((double)j);
        p0[j] = cos((double)j);
    }
    fvi_system system = { .d = D, .mass = mass, .damping = rho, .potential = fvi_potential_harmonic(&c) };
    for (size_t m = 0; m < LEN(all); m++) {
        fvi_run run = fvi_run_default(&system, x0, p0, 0.1, STEPS);
        run.alpha = 0.3;
        run.memory = FVI_HISTORY_DIRECT;
        OK(fvi_trajectory(all[m], &run, x, NULL, NULL));
        for (size_t j = 0; j < D; j++) {
            const fvi_system one = { .d = 1, .mass = mass + j, .damping = rho + j, .potential = system.potential };
            fvi_run alone = run;
            alone.system = &one;
            alone.x0 = x0 + j;
            alone.p0 = p0 + j;
            OK(fvi_trajectory(all[m], &alone, own, NULL, NULL));
            for (size_t k = 0; k <= STEPS; k++)
                ck_assert_msg(x[k * D + j] == own[k], "%s: x_%zu, k=%zu", all[m]->name, j, k);
        }
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("13 convolution quadrature: runs");
    ADD_CASE(suite, "values", eq_13_7_trajectories_are_the_exact_ones);
    ADD_CASE(suite, "identities",
             eq_13_10_the_half_derivative_shifted_is_the_midpoint_rule,
             eq_13_14_at_alpha_1_the_damping_is_an_added_mass,
             eq_13_10_without_damping_it_is_algorithm_1,
             eq_13_10_only_damped_coordinates_have_a_history,
             eq_13_11_each_of_nineteen_coordinates_has_the_bits_of_its_own,
             eq_13_7_the_modes_of_a_chain_decouple,
             eq_13_7_the_memory_knows_no_origin_and_no_uniform_motion);
    return run_suite(suite);
}
