/* tests/adjoint/test_adjoint_stage_values.c -- H 23: methods with stages, compared with derivatives of 40 digits.
 * Run alone: make test-adjoint_stage_values */
#include "adjoint_runs.h"
#include "stages/lobatto_history.h"

#include "adjoint_stages_ref.h"
#include "system/larger.h"

/* ---- the rates of the weights ---- */

static double largest(const double *v, size_t n)
{
    double most = 0;
    for (size_t i = 0; i < n; i++)
        most = larger(most, fabs(v[i]));
    return most;
}

/* (23.14), of the largest of W_0, ..., W_4 and their rates. No proof. Seen: 2.7e-14 of the
 * matrices from the series (n < 4); 5.8e-15 of those from the nodes. */
START_TEST(eq_23_14_the_rates_of_the_matrices)
{
    enum { LAGS = 41, MOST_OF = LAGS * FVI_STAGES * FVI_STAGES };
    static double W[MOST_OF], rate[MOST_OF];
    for (size_t i = 0; i < LEN(ref_stage_rates); i++) {
        const size_t s = ref_stage_rates[i].s, n = ref_stage_rates[i].n;
        ck_assert_int_eq(
            fvi_lobatto_weights(s, ref_stage_rates[i].beta, LAGS, W, rate),
            FVI_SUCCESS);
        const double unit = largest(rate, 5 * s * s);
        for (size_t j = 0; j < s * s; j++) {
            const double got = rate[n * s * s + j];
            const double want = ref_stage_rates[i].want[j];
            seen_worst(fabs(got - want) / unit, n < 4 ? "series" : "nodes");
            ck_assert_near(got, want, (n < 4 ? 2e-13 : 1e-13) * unit,
                           "s=%zu beta=%g n=%zu entry %zu", s,
                           ref_stage_rates[i].beta, n, j);
        }
    }
}
END_TEST

/* Modes, read a second time, against all matrices: of max|v| max(1, k^-beta) (1 + ln k),
 * as the rate of k^-beta is. The tolerance is that of the memory. Seen: 0.14 of it. */
START_TEST(eq_23_14_modes_read_a_second_time_give_the_rates_of_stages)
{
    enum { S = 3, STEPS = 2000 };
    static const double betas[] = { -1, -1 + 1e-9, -0.95, -0.5, -0.01,
                                    0,  0.3,       0.8,   1 };
    static const double tolerances[] = { 1e-13, 1e-8 };
    for (size_t i = 0; i < LEN(betas) * LEN(tolerances); i++) {
        const double beta = betas[i % LEN(betas)],
                     tolerance = tolerances[i / LEN(betas)];
        fvi_lobatto_history *modes, *all;
        ck_assert_int_eq(fvi_lobatto_history_alloc(S, beta, 1, STEPS,
                                                       FVI_HISTORY_MODES, 1,
                                                       tolerance, &modes),
                         FVI_SUCCESS);
        ck_assert_int_eq(fvi_lobatto_history_alloc(
                             S, beta, 1, STEPS, FVI_HISTORY_DIRECT, 1, 0, &all),
                         FVI_SUCCESS);
        for (size_t k = 1; k <= STEPS; k++) {
            double v[S], H[2][S], rate[2][S];
            for (size_t l = 0; l < S; l++)
                v[l] = cos(0.01 * (double)(k * S + l));
            ck_assert_int_eq(
                fvi_lobatto_history_push(modes, v, H[0], rate[0]),
                FVI_SUCCESS);
            ck_assert_int_eq(
                fvi_lobatto_history_push(all, v, H[1], rate[1]),
                FVI_SUCCESS);
            const double time = (double)k,
                         unit = larger(1, pow(time, -beta)) * (1 + log(time));
            for (size_t l = 0; l < S; l++) {
                const double off = fabs(rate[0][l] - rate[1][l]) / unit;
                seen_worst(off / tolerance, "of the tolerance");
                ck_assert_near(rate[0][l], rate[1][l], 2 * tolerance * unit,
                               "beta=%g k=%zu", beta, k);
                ck_assert_near(H[0][l], H[1][l], 6 * tolerance * unit,
                               "beta=%g k=%zu", beta, k);
            }
        }
        fvi_lobatto_history_free(modes);
        fvi_lobatto_history_free(all);
    }
}
END_TEST

START_TEST(a_memory_without_rates_has_none_to_give)
{
    fvi_lobatto_history *m;
    double v[2] = { 1, 2 }, H[2], rate[2];
    ck_assert_int_eq(
        fvi_lobatto_history_alloc(2, 0.3, 1, 9, FVI_HISTORY_AUTO, 0, 0, &m),
        FVI_SUCCESS);
    ck_assert_int_eq(fvi_lobatto_history_push(m, v, H, rate), FVI_EUNSUP);
    fvi_lobatto_history_free(m);
}
END_TEST

/* ---- chains ---- */

enum { D = 5, N = 6, SLOPES = 26 };

/* Row i: its derivatives, in the order of the row. Rows of the force: N (s - 1) + 1. */
static void slopes_by(size_t i, fvi_history_kind memory, double *got)
{
    double aw[] = { 0.2, 1.25 };
    const fvi_method *method = ref_chains[i].method;
    const fvi_system system = { .d = D,
                                .mass = ref_chains[i].mass,
                                .damping = ref_chains[i].rho,
                                .potential = fvi_potential_chain(
                                    (void *)ref_chains[i].cg),
                                .force = fvi_force_cosine(aw) };
    fvi_run run = fvi_run_default(&system, ref_chains[i].x0, ref_chains[i].p0,
                                  1. / 16, N);
    run.alpha = ref_chains[i].alpha;
    run.past = ref_chains[i].past;
    run.memory = memory;
    slopes *s = slopes_of(&run, N * ((size_t)method->stages - 1) + 1);
    const fvi_objective J = { .slopes = to_sine, .params = &run };
    if (isnan(ref_chains[i].want[22]))
        s->to.alpha = NULL;
    ck_assert_int_eq(fvi_adjoint(method, &run, NULL, NULL, &J, &s->to),
                     FVI_SUCCESS);
    got[22] = NAN;
    slopes_in_order(s, D, got);
    for (size_t j = 0; j < 3; j++)
        got[23 + j] = s->force[ref_chains[i].force[j]];
    slopes_free(s);
}

/* (23.13), (23.15): every derivative of five masses, of itself, or of 0.01 where that is
 * more, to 5e-13, with five to eight stages to 1e-11, no proof. Seen: 9.5e-14, 2.9e-12. */
START_TEST(eq_23_15_every_derivative_of_a_chain_with_stages)
{
    static const fvi_history_kind kinds[] = { FVI_HISTORY_DIRECT,
                                             FVI_HISTORY_MODES };
    for (size_t i = 0; i < LEN(kinds) * LEN(ref_chains); i++) {
        const size_t row = i / LEN(kinds);
        double got[SLOPES];
        slopes_by(row, kinds[i % LEN(kinds)], got);
        for (size_t j = 0; j < SLOPES; j++) {
            const double want = ref_chains[row].want[j];
            ck_assert_int_eq(isnan(want), isnan(got[j]));
            if (isnan(want))
                continue;
            const double unit = larger(0.01, fabs(want));
            const int many = ref_chains[row].method->stages > 4;
            if (many)
                seen_worst(fabs(got[j] - want) / unit, "many stages");
            else
                seen_worst(fabs(got[j] - want) / unit, "worst");
            ck_assert_near(got[j], want, (many ? 1e-11 : 5e-13) * unit,
                           "%s past %d alpha=%g, derivative %zu",
                           ref_chains[row].method->name,
                           (int)ref_chains[row].past, ref_chains[row].alpha, j);
        }
    }
}
END_TEST

/* Row i of those with a law. run->alpha is not read. */
static void law_slopes_by(size_t i, fvi_history_kind memory, double alpha,
                          double *got)
{
    double aw[] = { 0.2, 1.25 };
    const fvi_method *method = ref_law_chains[i].method;
    const fvi_kernel law = { 3, ref_law_chains[i].term };
    const fvi_system system = { .d = D,
                                .mass = ref_law_chains[i].mass,
                                .damping = ref_law_chains[i].rho,
                                .potential = fvi_potential_chain(
                                    (void *)ref_law_chains[i].cg),
                                .force = fvi_force_cosine(aw) };
    fvi_run run = fvi_run_default(&system, ref_law_chains[i].x0,
                                  ref_law_chains[i].p0, 1. / 16, N);
    run.law = &law;
    run.alpha = alpha;
    run.memory = memory;
    slopes *s = slopes_of(&run, N * ((size_t)method->stages - 1) + 1);
    const fvi_objective J = { .slopes = to_sine, .params = &run };
    s->to.alpha = NULL;
    s->to.terms = got + 22;
    ck_assert_int_eq(fvi_adjoint(method, &run, NULL, NULL, &J, &s->to),
                     FVI_SUCCESS);
    slopes_in_order(s, D, got);
    for (size_t j = 0; j < 3; j++)
        got[25 + j] = s->force[ref_law_chains[i].force[j]];
    slopes_free(s);
}

/* The same with laws of three terms drawn at random, whose weights have an error of their
 * own, to 2e-13. Seen: 1.4e-14. */
START_TEST(eq_23_15_every_derivative_of_a_chain_with_a_law)
{
    static const fvi_history_kind kinds[] = { FVI_HISTORY_DIRECT,
                                             FVI_HISTORY_MODES };
    static const double alphas[] = { 0.1, 0.5, 1 };
    for (size_t i = 0; i < LEN(kinds) * LEN(ref_law_chains); i++) {
        const size_t row = i / LEN(kinds);
        double got[SLOPES + 2];
        law_slopes_by(row, kinds[i % LEN(kinds)], alphas[i % LEN(alphas)], got);
        for (size_t j = 0; j < LEN(got); j++) {
            const double want = ref_law_chains[row].want[j];
            const double unit = larger(0.01, fabs(want));
            seen_worst(fabs(got[j] - want) / unit, "worst");
            ck_assert_near(got[j], want, 2e-13 * unit, "%s, law %zu, slope %zu",
                           ref_law_chains[row].method->name, row, j);
        }
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("adjoint, values with stages");
    ADD_CASE(suite, "rates", eq_23_14_the_rates_of_the_matrices,
             eq_23_14_modes_read_a_second_time_give_the_rates_of_stages,
             a_memory_without_rates_has_none_to_give);
    ADD_CASE(suite, "values", eq_23_15_every_derivative_of_a_chain_with_stages,
             eq_23_15_every_derivative_of_a_chain_with_a_law);
    return run_suite(suite);
}
