/* tests/lobatto/test_lobatto_energy.c -- H 17: stability and energy of form D.
 * Run alone: make test-lobatto_energy */
#include <fvi/stability.h>
#include "run/whole_run.h"
#include "lobatto_runs.h"
#include "system/larger.h"

#include <gsl/gsl_rng.h>

enum { MOST = 300 }; /* steps of the chain */

//> energy
/* (17.26) and (17.28): 400 linear runs without a force, alpha up to 1/2, or from rest:
 * W and R from 1e-4 to 1e8, and the energy never exceeds that of the start, but for 1000
 * roundings a step of what is exchanged. A damping on the wrong side would add. */
START_TEST(eq_17_26_form_d_never_gains_energy)
{
    gsl_rng *random = gsl_rng_alloc(gsl_rng_taus2);
    for (size_t i = 0; i < 400; i++) {
        enum { N = 60 };
        const double one = 1, c = pow(10, 12 * gsl_rng_uniform(random) - 4),
                     rho = pow(10, 12 * gsl_rng_uniform(random) - 4), x0 = 1,
                     alpha = gsl_rng_uniform(random),
                     p0 = alpha > 0.5 ? 0 : 0.5;
        const fvi_system system = { 1,     &one,
                                    &rho,  fvi_potential_harmonic(&c),
                                    { 0 }, NULL, NULL };
        fvi_run run = fvi_run_default(&system, &x0, &p0, 1, N);
        double E[N + 1];
        run.alpha = alpha;
        run.past = FVI_INITIAL_HISTORY_CAPUTO;
        const size_t s = 2 + i % 7;
        ck_assert_int_eq(fvi_trajectory(damped[s], &run, NULL, NULL, E), 0);
        for (size_t k = 1; k <= N; k++) {
            seen_worst((E[k] / E[0] - 1) / (1000 * U), "above 1, of 1000 u");
            ck_assert_msg(E[k] <= E[0] * (1 + 1000 * U),
                          "s=%zu alpha=%g c=%g rho=%g k=%zu: %g", s, alpha, c,
                          rho, k, E[k] / E[0] - 1);
        }
    }
    gsl_rng_free(random);
}
END_TEST
//< energy

/* Stiff, and a chain: load 0, any step allowed, and the run decays. */
START_TEST(eq_17_28_form_d_is_stable_for_every_step)
{
    enum { D = 5 };
    const double m[D] = { 1, 2, 3, 1, 0.5 }, rho[D] = { 1e8, 0, 1, 3, 1e-3 },
                 x0[D] = { 1, 0, 0, 0, -1 }, p0[D] = { 0 }, cg[] = { 1e4, 0 };
    static double rows[(MOST + 1) * D];
    const fvi_system system = {
        D, m, rho, fvi_potential_chain(cg), { 0 }, NULL, NULL
    };
    for (size_t s = 2; s <= 8; s++)
        for (int a = 1; a <= 9; a += 2) {
            fvi_run run = fvi_run_default(&system, x0, p0, 10, 300);
            double load = 7, h = 0;
            run.alpha = a / 10.;
            ck_assert_int_eq(fvi_stability_number(damped[s], &run, &load), 0);
            ck_assert_int_eq(fvi_stability_longest_step(damped[s], &run, &h), 0);
            ck_assert(load == 0 && h == GSL_POSINF);
            ck_assert_int_eq(fvi_trajectory(damped[s], &run, rows, NULL, NULL),
                             0);
            ck_assert_double_le(farthest(0, 301 * D, rows, NULL), 1 + 1e-9);
        }
}
END_TEST

/* rho = 0, x'' + x^3 = 0: form M keeps the energy in a band, form D loses it, the more
 * the fewer the stages. 2000 steps of length 1/4. */
START_TEST(eq_17_26_form_d_loses_where_form_m_keeps)
{
    enum { N = 2000 };
    static double E[N + 1];
    const double one = 1, zero = 0, cg[] = { 0, 1 }, x0 = 1, p0 = 0;
    const fvi_system system = { 1,     &one, &zero, fvi_potential_duffing(cg),
                                { 0 }, NULL, NULL };
    for (size_t s = 2; s <= 5; s++) {
        const fvi_run run = fvi_run_default(&system, &x0, &p0, 0.25, N);
        double band = 0;
        ck_assert_int_eq(fvi_trajectory(methods[s], &run, NULL, NULL, E), 0);
        for (size_t k = 0; k <= N; k++)
            band = larger(band, fabs(E[k] / E[0] - 1));
        ck_assert_int_eq(fvi_trajectory(damped[s], &run, NULL, NULL, E), 0);
        const double lost = 1 - E[N] / E[0];
        seen(band, "band of form M, s=%zu", s);
        seen(lost, "lost by form D, s=%zu", s);
        ck_assert_msg(lost > 10 * band, "s=%zu: %g, %g", s, lost, band);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("lobatto_energy");
    ADD_CASE(suite, "form_d", eq_17_26_form_d_never_gains_energy,
             eq_17_28_form_d_is_stable_for_every_step,
             eq_17_26_form_d_loses_where_form_m_keeps);
    return run_suite(suite);
}
