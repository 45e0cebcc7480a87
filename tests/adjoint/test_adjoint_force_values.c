/* tests/adjoint/test_adjoint_force_values.c -- H 23: objectives J of the forces and impulses of dampers, compared
 * with derivatives of 40 digits.
 * Run alone: make test-adjoint_force_values */
#include "loss_of_forces.h"

#include "adjoint_forces_ref.h"
#include "system/larger.h"

/* ---- chains, against derivatives of 40 digits ---- */

enum { D = 5, N = 12, SLOPES = 26 };

static void slopes_by(size_t i, fvi_history_kind memory, double *got)
{
    double aw[] = { 0.2, 1.25 }, force[(N + 1) * D], impulse[(N + 1) * D];
    const fvi_system system = { .d = D,
                                .mass = ref_forces[i].mass,
                                .damping = ref_forces[i].rho,
                                .potential = fvi_potential_chain((void *)ref_forces[i].cg),
                                .force = fvi_force_cosine(aw) };
    fvi_run run = fvi_run_default(&system, ref_forces[i].x0, ref_forces[i].p0, 1. / 16, N);
    run.alpha = ref_forces[i].alpha;
    run.past = ref_forces[i].past;
    run.kappa = ref_forces[i].kappa;
    run.memory = memory;
    slopes *s = slopes_of(&run, N + 1);
    const fvi_objective J = { .slopes = to_sine, .params = &run };
    loss_of_forces(ref_forces[i].method, &run, D, force, impulse);
    ck_assert_int_eq(fvi_adjoint_forces(ref_forces[i].method, &run, &J, force, impulse, &s->to), FVI_SUCCESS);
    slopes_in_order(s, D, got);
    for (size_t j = 0; j < LEN(ref_force_entries); j++)
        got[23 + j] = s->force[ref_force_entries[j]];
    slopes_free(s);
}

/* Every derivative of five masses by four methods, three pasts, five orders and two memories, of itself, or of 1 where
 * that is more. A bound of rounding is not proved; forces are differences of impulses divided by h. Seen: 2.1e-15.
 *
 * By alpha the first rows are quotients of seven points. Their error is 1/140 of the step 2^-8 to the power 6 times a
 * seventh derivative, and 20 times as much where the points are on one side. That of t^(2 alpha) with t = h = 1/16 is at
 * most (2 log 16)^7, which gives 4e-12 and 8e-11; the coefficients are quotients of several such powers. Seen: 3.0e-10, at
 * the order 1. */
START_TEST(eq_23_32_every_derivative_of_forces_to_40_digits)
{
    static const fvi_history_kind kinds[] = { FVI_HISTORY_DIRECT, FVI_HISTORY_MODES };
    for (size_t i = 0; i < LEN(kinds) * LEN(ref_forces); i++) {
        const size_t row = i / LEN(kinds);
        double got[SLOPES];
        slopes_by(row, kinds[i % LEN(kinds)], got);
        for (size_t j = 0; j < SLOPES; j++) {
            const int by_alpha = j == 22;
            const double want = ref_forces[row].want[j], unit = larger(1, fabs(want));
            ck_assert_int_eq(isnan(want), isnan(got[j]));
            if (isnan(want))
                continue;
            seen_worst(fabs(got[j] - want) / unit, by_alpha ? "by alpha" : "worst");
            ck_assert_near(got[j], want, (by_alpha ? 1e-9 : 1e-12) * unit, "%s past %d alpha=%g, derivative %zu",
                           ref_forces[row].method->name, (int)ref_forces[row].past, ref_forces[row].alpha, j);
        }
    }
}
END_TEST

/* ---- short steps ---- */

/* The derivatives by alpha and by rho of sum_k a_k s^2 f_k, for one body on a dashpot, alpha = 1/2. In t' = t/s the step
 * is 1/16, the mass 1, rho' = rho s = 0.4, c' = c s^2 = 1, p_0' = p_0 s = 0.3, and the forces are f' = s^2 f. */
static void by_alpha_and_rho(const fvi_method *method, double s, double *by_alpha, double *by_rho)
{
    const double mass = 1, rho = 0.4 / s, x0 = 1, p0 = 0.3 / s;
    double c = 1 / (s * s), force[N + 1] = { 0 }; /* f_0 jumps at this alpha */
    const fvi_system system = { .d = 1, .mass = &mass, .damping = &rho, .potential = fvi_potential_harmonic(&c) };
    fvi_run run = fvi_run_default(&system, &x0, &p0, s / 16, N);
    const fvi_objective J = { .slopes = nothing };
    const fvi_sensitivities to = { .alpha = by_alpha, .damping = by_rho };
    run.alpha = 0.5;
    for (size_t k = 1; k <= N; k++)
        force[k] = s * s * weight(k, 0, 0);
    ck_assert_int_eq(fvi_adjoint_forces(method, &run, &J, force, NULL, &to), FVI_SUCCESS);
}

/* Let t = s t'. Then rho' = rho s^(2 - 2 alpha), and at a fixed rho it changes by -2 log(s) rho' with alpha. So
 *
 *     s^2 dJ/dalpha = dJ'/dalpha - 2 log(s) rho' dJ'/drho'.
 *
 * Both derivatives by alpha are quotients in the first rows, each to 1e-9. Seen: 7.3e-11. */
START_TEST(eq_23_32_by_alpha_of_a_short_step_is_that_of_a_long_one_in_other_units)
{
    static const fvi_method *const methods[] = { &fvi_fractional, &fvi_cq2_shifted, &fvi_cq_bdf2, &fvi_cq2_midpoint,
                                                 &fvi_lobatto_m3, &fvi_lobatto_d3 };
    for (size_t i = 0; i < LEN(methods); i++) {
        double got, unused, by_alpha, by_rho;
        by_alpha_and_rho(methods[i], 0x1p-20, &got, &unused);
        by_alpha_and_rho(methods[i], 1, &by_alpha, &by_rho);
        const double by_units = 2 * 20 * log(2) * 0.4 * by_rho, unit = fabs(by_alpha) + fabs(by_units);
        seen_worst(fabs(got - by_alpha - by_units) / unit, "short steps");
        ck_assert_near(got, by_alpha + by_units, 2e-9 * unit, "%s", methods[i]->name);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("values of an adjoint of forces");
    ADD_CASE(suite, "values", eq_23_32_every_derivative_of_forces_to_40_digits,
             eq_23_32_by_alpha_of_a_short_step_is_that_of_a_long_one_in_other_units);
    return run_suite(suite);
}
