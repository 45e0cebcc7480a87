/* tests/lobatto/test_lobatto_stages.c -- H 17: from 2 to 8 stages.
 * Run alone: make test-lobatto_stages */
#include "lobatto_runs.h"
#include "run/whole_run.h"
#include "lobatto_stages_ref.h"
#include "stages/lobatto_history.h"
#include "system/larger.h"

#include <fvi/stability.h>

/* The nearest doubles, from five nodes on; the others have sqrt(5) at most. */
START_TEST(eq_17_1_rules_are_the_nearest_doubles)
{
    for (size_t e = 0; e < LEN(ref_rules); e++) {
        const size_t s = ref_rules[e].s;
        const fvi_lobatto_rule *r = fvi_lobatto(s);
        for (size_t i = 0; i < s; i++) {
            ck_assert_ulp(r->c[i], ref_rules[e].c[i], 0, "c, s=%zu", s);
            ck_assert_ulp(r->b[i], ref_rules[e].b[i], 0, "b, s=%zu", s);
            for (size_t j = 0; j < s; j++)
                ck_assert_ulp(r->D[i][j], ref_rules[e].D[i * s + j], 0,
                              "D, s=%zu i=%zu j=%zu", s, i, j);
        }
    }
}
END_TEST

/* As eq_17_5_weights_match_cauchys_integral, with the same bounds, 1000 u for the first
 * four and 100 u. Seen: 313 u and 8 u. */
START_TEST(eq_17_5_weights_of_many_stages_match_cauchys_integral)
{
    static double W[6 * 64];
    double largest = 0;
    for (size_t e = 0; e < LEN(ref_many_stages); e++) {
        const size_t s = ref_many_stages[e].s, n = ref_many_stages[e].n;
        ck_assert_int_eq(fvi_lobatto_weights(s, ref_many_stages[e].beta, 6, W, NULL),
                         FVI_SUCCESS);
        if (n == 0)
            largest = farthest(0, s * s, W, NULL);
        for (size_t i = 0; i < s * s; i++) {
            const double off =
                fabs(W[n * s * s + i] - ref_many_stages[e].want[i]);
            if (n <= FVI_LAGS)
                seen_worst(off / largest / U, "u, first four");
            else
                seen_worst(off / largest / U, "u, the rest");
            ck_assert_msg(off <= (n <= FVI_LAGS ? 1000 : 100) * U * largest,
                          "s=%zu beta=%g n=%zu: %g u", s,
                          ref_many_stages[e].beta, n, off / largest / U);
        }
    }
}
END_TEST

/* The modes of five to eight stages against the direct sum, to the tolerance and the
 * rounding of some hundred terms of size |W_0| < 60. Seen: 0.8 of the bound. */
START_TEST(eq_17_12_modes_of_many_stages_equal_the_direct_sum)
{
    enum { N = 600 };
    const double betas[] = { -0.9, -0.4, 0.3, 0.9 };
    for (size_t s = 5; s <= 8; s++)
        for (size_t t = 0; t < LEN(betas); t++) {
            fvi_lobatto_history *direct, *fast;
            const double beta = betas[t];
            ck_assert_int_eq(fvi_lobatto_history_alloc(
                                 s, beta, 1, N, FVI_HISTORY_DIRECT, 0, 0, &direct),
                             FVI_SUCCESS);
            ck_assert_int_eq(fvi_lobatto_history_alloc(s, beta, 1, N,
                                                      FVI_HISTORY_MODES, 0,
                                                      0, &fast),
                             FVI_SUCCESS);
            for (size_t k = 0; k < N; k++) {
                double v[8], want[8], got[8];
                for (size_t i = 0; i < s; i++)
                    v[i] = cos(0.1 * (double)k + (double)i);
                ck_assert_int_eq(fvi_lobatto_history_push(direct, v, want, NULL),
                                 FVI_SUCCESS);
                ck_assert_int_eq(fvi_lobatto_history_push(fast, v, got, NULL),
                                 FVI_SUCCESS);
                for (size_t i = 0; i < s; i++)
                    ck_assert_near(got[i], want[i],
                                   1e-13 * larger(1, pow((double)k + 1, -beta))
                                       + 4000 * U,
                                   "s=%zu beta=%g k=%zu", s, beta, k);
            }
            fvi_lobatto_history_free(direct);
            fvi_lobatto_history_free(fast);
        }
}
END_TEST

static int drive(double t, size_t d, void *params, double *F)
{
    (void)params;
    for (size_t i = 0; i < d; i++)
        F[i] = cos(1.25 * t);
    return 0;
}

/* Form D of a driven oscillator is the solution of (17.24), all three steps in one
 * system, with any memory. The bound is that of the first four weights, 1000 u; x and p
 * are below 1. Seen: 0.02 of it. */
START_TEST(eq_17_24_form_d_is_the_solution_of_its_equations)
{
    const double m = 1.5, c = 2, rho = 0.75, x0 = 0.25, p0 = 0.5;
    const fvi_system system = {
        1, &m, &rho, fvi_potential_harmonic(&c), { .value = drive }, NULL, NULL
    };
    for (size_t e = 0; e < LEN(ref_damped); e++)
        for (size_t kind = 0; kind < 2; kind++) {
            fvi_run run = fvi_run_default(&system, &x0, &p0, 0.5, 3);
            double x[4], p[4];
            run.alpha = ref_damped[e].alpha;
            run.past = FVI_INITIAL_HISTORY_CAPUTO;
            run.memory = kind ? FVI_HISTORY_MODES : FVI_HISTORY_DIRECT;
            ck_assert_int_eq(
                fvi_trajectory(damped[ref_damped[e].s], &run, x, p, NULL),
                FVI_SUCCESS);
            for (size_t k = 0; k < 3; k++) {
                ck_assert_near(x[k + 1], ref_damped[e].want[2 * k], 1000 * U,
                               "x, s=%zu alpha=%g k=%zu", ref_damped[e].s,
                               run.alpha, k);
                ck_assert_near(p[k + 1], ref_damped[e].want[2 * k + 1],
                               1000 * U, "p, s=%zu alpha=%g k=%zu",
                               ref_damped[e].s, run.alpha, k);
            }
        }
}
END_TEST

/* Without damping a step of form M is stationary in the mean, p^2/2 + U goes up and down,
 * and returns; form D is Lobatto IIIC itself, and multiplies the energy of x'' = -w^2 x by
 * |R(i h w)|^2: for s = 2 R = 2/(2 - 2y + y^2), for s = 3 6 (y + 4)/(24 - 18y + 6y^2 -
 * y^3). Seen: 0.1 of 100 u max(1, h^2). */
START_TEST(eq_17_25_form_d_multiplies_the_energy_of_an_oscillator)
{
    const double one = 1, rho = 0, c = 1, x0 = 0.75, p0 = 0.5;
    const fvi_system system = { 1,     &one, &rho, fvi_potential_harmonic(&c),
                                { 0 }, NULL, NULL };
    for (double h = 0.25; h < 20; h *= 2) {
        const double y2 = h * h, /* y = i h */
            two = 4 / ((2 - y2) * (2 - y2) + 4 * y2),
                     three = 36 * (16 + y2)
                             / ((24 - 6 * y2) * (24 - 6 * y2)
                                + (18 * h - h * y2) * (18 * h - h * y2));
        for (size_t s = 2; s <= 3; s++) {
            const fvi_run run = fvi_run_default(&system, &x0, &p0, h, 1);
            double x[2], p[2], E[2];
            ck_assert_int_eq(fvi_trajectory(damped[s], &run, x, p, E),
                             FVI_SUCCESS);
            ck_assert_near(E[1] / E[0] / (s == 2 ? two : three), 1,
                           100 * U * larger(1, y2), "s=%zu h=%g", s, h);
        }
    }
}
END_TEST

/* With one mass more or a coordinate less nothing changes for the others: three masses
 * that do not feel each other, the second without damping, as three runs. */
START_TEST(eq_17_24_uncoupled_masses_go_their_own_ways)
{
    enum { D = 3, N = 30 };
    const double m[D] = { 1, 2, 0.5 }, rho[D] = { 0.5, 0, 2 },
                 x0[D] = { 1, -0.5, 0.25 }, p0[D] = { 0.5, 1, -1 },
                 cg[] = { 1, 1 };
    static double x[(N + 1) * D], p[(N + 1) * D], x1[N + 1], p1[N + 1];
    const fvi_system all = {
        D, m, rho, fvi_potential_duffing(cg), { 0 }, NULL, NULL
    };
    for (size_t s = 2; s <= 8; s++)
        for (int a = 1; a < 4; a++) {
            fvi_run run = fvi_run_default(&all, x0, p0, 0.25, N);
            run.alpha = a / 4.;
            ck_assert_int_eq(fvi_trajectory(damped[s], &run, x, p, NULL),
                             FVI_SUCCESS);
            for (size_t j = 0; j < D; j++) {
                const fvi_system single = { 1,       m + j,
                                            rho + j, all.potential,
                                            { 0 },   NULL, NULL };
                fvi_run alone = run;
                alone.system = &single;
                alone.x0 = x0 + j;
                alone.p0 = p0 + j;
                ck_assert_int_eq(
                    fvi_trajectory(damped[s], &alone, x1, p1, NULL),
                    FVI_SUCCESS);
                for (size_t k = 0; k <= N; k++) {
                    ck_assert_near(x[k * D + j], x1[k], 1e-13, "x, s=%zu", s);
                    ck_assert_near(p[k * D + j], p1[k], 1e-13, "p, s=%zu", s);
                }
            }
        }
}
END_TEST

/* As eq_17_18_load_is_where_the_symbol_vanishes, with the tolerance of the header. Seen:
 * 0.04 of it, for s = 8. */
START_TEST(eq_17_18_loads_of_many_stages)
{
    const double one = 1, zero = 0;
    for (size_t e = 0; e < LEN(ref_many_loads); e++) {
        const double W = ref_many_loads[e].W, R = ref_many_loads[e].R,
                     want = ref_many_loads[e].want;
        const fvi_system system = { 1,     &one, &R, fvi_potential_harmonic(&W),
                                    { 0 }, NULL, NULL };
        const fvi_run run = { .system = &system,
                              .x0 = &zero,
                              .h = 1,
                              .alpha = ref_many_loads[e].alpha };
        double load = -1;
        ck_assert_int_eq(fvi_stability_lobatto(ref_many_loads[e].s, &run, &load),
                         FVI_SUCCESS);
        ck_assert_near(load, want, 1e-12 * larger(1, want), "row %zu", e);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("lobatto_stages");
    ADD_CASE(suite, "weights", eq_17_1_rules_are_the_nearest_doubles,
             eq_17_5_weights_of_many_stages_match_cauchys_integral,
             eq_17_12_modes_of_many_stages_equal_the_direct_sum);
    ADD_CASE(suite, "form_d", eq_17_24_form_d_is_the_solution_of_its_equations,
             eq_17_25_form_d_multiplies_the_energy_of_an_oscillator,
             eq_17_24_uncoupled_masses_go_their_own_ways);
    ADD_CASE(suite, "load", eq_17_18_loads_of_many_stages);
    return run_suite(suite);
}
