/* tests/adjoint/test_adjoint_law_numbers.c -- H 23: derivatives by the exponents and times of a law.
 * Run alone: make test-adjoint_law_numbers */
#include "adjoint_runs.h"
#include "harness/seen.h"

#include "adjoint_laws_ref.h"
#include "run/whole_run.h"
#include "system/larger.h"

enum { TERMS = 3, NUMBERS_OF_A_LAW = 4 * TERMS };

static const fvi_history_kind kinds[] = { FVI_HISTORY_DIRECT,
                                         FVI_HISTORY_MODES };

/* Of a law of three terms: by rho, alpha, time and end. */
typedef struct {
    double by[NUMBERS_OF_A_LAW];
    fvi_sensitivities want;
} answers;

static void ask(answers *a)
{
    for (size_t i = 0; i < NUMBERS_OF_A_LAW; i++)
        a->by[i] = NAN;
    a->want = (fvi_sensitivities){ .terms = a->by,
                               .orders = a->by + TERMS,
                               .times = a->by + 2 * TERMS,
                               .ends = a->by + 3 * TERMS };
}

/* Some laws have no modes with some steps: the compressed memory then says so. */
static int adjoint_by(const fvi_method *method, fvi_run *run,
                      fvi_history_kind memory, answers *a)
{
    const fvi_objective J = { .slopes = to_sine, .params = run };
    run->memory = memory;
    ask(a);
    return fvi_adjoint(method, run, NULL, NULL, &J, &a->want);
}

static double aw[] = { 0.2, 1.25 };

/* Row i of those without stages. law stays the caller's. */
static fvi_run run_of_row(size_t i, fvi_system *system, fvi_kernel *law)
{
    *law = (fvi_kernel){ TERMS, ref_law_numbers[i].term };
    *system =
        (fvi_system){ .d = 2,
                      .mass = ref_law_numbers[i].mass,
                      .damping = ref_law_numbers[i].rho,
                      .potential = fvi_potential_duffing(ref_law_numbers[i].cg),
                      .force = fvi_force_cosine(aw) };
    fvi_run run = fvi_run_default(system, ref_law_numbers[i].x0,
                                  ref_law_numbers[i].p0, 1. / 16, 12);
    run.law = law;
    run.kappa = ref_law_numbers[i].kappa;
    return run;
}

/* Twelve steps, weights to 60 u of the largest, h^-2 at most; the square of a law with a
 * short time has h^-4. Each of itself, or of 1 where that is more. Seen: 2.9e-14. */
START_TEST(eq_23_21_every_number_of_a_law_to_40_digits)
{
    size_t compressed = 0;
    for (size_t n = 0; n < LEN(ref_law_numbers) * LEN(kinds); n++) {
        const size_t i = n / LEN(kinds);
        fvi_system system;
        fvi_kernel law;
        answers a;
        fvi_run run = run_of_row(i, &system, &law);
        const int status = adjoint_by(ref_law_numbers[i].method, &run,
                                      kinds[n % LEN(kinds)], &a);
        if (kinds[n % LEN(kinds)] == FVI_HISTORY_MODES
            && status == FVI_EUNSUP)
            continue;
        ck_assert_int_eq(status, FVI_SUCCESS);
        compressed += n % LEN(kinds);
        for (size_t j = 0; j < NUMBERS_OF_A_LAW; j++) {
            const double want = ref_law_numbers[i].want[j];
            seen_worst(fabs(a.by[j] - want) / larger(1, fabs(want)), "worst");
            ck_assert_near(a.by[j], want, 2e-13 * larger(1, fabs(want)),
                           "%s law %zu memory %zu number %zu",
                           ref_law_numbers[i].method->name, i, n % LEN(kinds),
                           j);
        }
    }
    ck_assert_uint_ge(compressed, LEN(ref_law_numbers) / 2);
}
END_TEST

/* Five masses, form D, six steps. Seen: 3.2e-15. The derivatives of two springpots in series are symbols,
 * whose weights on stages are right to some 1e-12 of the largest. Seen: 1.3e-12. */
START_TEST(eq_23_21_every_number_of_a_law_with_stages)
{
    for (size_t n = 0; n < LEN(ref_stage_law_numbers) * LEN(kinds); n++) {
        const size_t i = n / LEN(kinds);
        const fvi_method *method = ref_stage_law_numbers[i].method;
        const fvi_kernel law = { TERMS, ref_stage_law_numbers[i].term };
        const fvi_system system = { .d = 5,
                                    .mass = ref_stage_law_numbers[i].mass,
                                    .damping = ref_stage_law_numbers[i].rho,
                                    .potential = fvi_potential_chain(
                                        ref_stage_law_numbers[i].cg),
                                    .force = fvi_force_cosine(aw) };
        fvi_run run = fvi_run_default(&system, ref_stage_law_numbers[i].x0,
                                      ref_stage_law_numbers[i].p0, 1. / 16, 6);
        answers a;
        const int has_symbols = law.term[0].kind == FVI_KERNEL_MAXWELL2;
        run.law = &law;
        const int status = adjoint_by(method, &run, kinds[n % LEN(kinds)], &a);
        if (kinds[n % LEN(kinds)] == FVI_HISTORY_MODES
            && status == FVI_EUNSUP)
            continue;
        ck_assert_int_eq(status, FVI_SUCCESS);
        for (size_t j = 0; j < NUMBERS_OF_A_LAW; j++) {
            const double want = ref_stage_law_numbers[i].want[j],
                         off = fabs(a.by[j] - want) / larger(1, fabs(want));
            if (has_symbols)
                seen_worst(off, "symbols");
            else
                seen_worst(off, "worst");
            ck_assert_near(a.by[j], want, (has_symbols ? 4e-12 : 2e-13) * larger(1, fabs(want)),
                           "%s law %zu memory %zu number %zu", method->name, i,
                           n % LEN(kinds), j);
        }
    }
}
END_TEST

/* A thousand steps, all weights or modes, which keep 1e-14 of each weight, three of them one
 * behind another: of the largest. Seen: 4.6e-14. */
START_TEST(eq_23_21_modes_give_the_numbers_of_all_weights)
{
    size_t compressed = 0;
    for (size_t i = 0; i < LEN(ref_law_numbers); i++) {
        const fvi_method *method = ref_law_numbers[i].method;
        fvi_system system;
        fvi_kernel law;
        answers direct, modes;
        double most = 1;
        fvi_run run = run_of_row(i, &system, &law);
        run.h = 1. / 64;
        run.steps = 1000;
        const int status = adjoint_by(method, &run, kinds[0], &direct);
        if (status == FVI_EOVRFLW) /* too stiff for what is explicit */
            continue;
        ck_assert_int_eq(status, FVI_SUCCESS);
        if (adjoint_by(method, &run, kinds[1], &modes) == FVI_EUNSUP)
            continue;
        compressed++; /* of each method some */
        for (size_t j = 0; j < NUMBERS_OF_A_LAW; j++)
            most = larger(most, fabs(direct.by[j]));
        for (size_t j = 0; j < NUMBERS_OF_A_LAW; j++) {
            seen_worst(fabs(direct.by[j] - modes.by[j]) / most, "off");
            ck_assert_near(modes.by[j], direct.by[j], 1e-11 * most,
                           "%s law %zu number %zu", method->name, i, j);
        }
    }
    ck_assert_uint_ge(compressed, LEN(ref_law_numbers) / 2);
}
END_TEST

/* Each alone: the digits that it has among the others, and nothing else is written. */
START_TEST(a_number_of_a_law_may_be_asked_for_alone)
{
    static const fvi_method *const methods[] = { &fvi_cq2_midpoint, &fvi_lobatto_d3 };
    for (size_t i = 0; i < 4 * LEN(methods) * 4; i++) {
        const size_t number = i % 4;
        fvi_system system;
        fvi_kernel law;
        answers all, one;
        fvi_run run = run_of_row(3 * (i / 4 % 4) + 2, &system, &law);
        const fvi_method *method = methods[i / 16];
        const fvi_objective J = { .slopes = to_sine, .params = &run };
        ck_assert_int_eq(adjoint_by(method, &run, FVI_HISTORY_AUTO, &all),
                         FVI_SUCCESS);
        ask(&one);
        const fvi_sensitivities want = {
            .terms = number == 0 ? one.want.terms : NULL,
            .orders = number == 1 ? one.want.orders : NULL,
            .times = number == 2 ? one.want.times : NULL,
            .ends = number == 3 ? one.want.ends : NULL
        };
        ck_assert_int_eq(fvi_adjoint(method, &run, NULL, NULL, &J, &want),
                         FVI_SUCCESS);
        for (size_t j = 0; j < NUMBERS_OF_A_LAW; j++)
            if (j / TERMS == number)
                ck_assert_near(one.by[j], all.by[j], 0, "number %zu", j);
            else
                ck_assert(isnan(one.by[j]));
    }
}
END_TEST

static int last_place(size_t k, size_t d, const double *x, const double *p, void *params, double *Jx, double *Jp)
{
    (void)k, (void)x, (void)params, (void)Jp;
    for (size_t i = 0; p && i < d; i++)
        Jx[i] += 1;
    return 0;
}

/* Differences of order 4 over four steps of e = 1e-3 of a number: e^4 times a fifth derivative, some 10, and
 * 1e-15 / e of rounding. Each time: above, near and below a step. Seen: 3.7e-12. */
START_TEST(cole_and_davidson_with_stages)
{
    enum { STEPS = 60 };
    static const fvi_method *const methods[] = { &fvi_lobatto_m3, &fvi_lobatto_m8, &fvi_lobatto_d2, &fvi_lobatto_d4 };
    static const double alphas[] = { 0.3, 0.2, 0.45, 0.4 }, times[] = { 0.5, 2, 0.05, 1e-3 },
                        place[] = { -2, -1, 1, 2 };
    const double one = 1, c = 1.3, x0 = 1, p0 = 0.4, e = 1e-3;
    const fvi_system system = { .d = 1, .mass = &one, .damping = &one, .potential = fvi_potential_harmonic(&c) };
    for (size_t n = 0; n < LEN(methods) * LEN(times) * LEN(kinds); n++) {
        const fvi_method *method = methods[n % LEN(methods)];
        const size_t i = n / LEN(methods) % LEN(times);
        fvi_kernel_term term = { FVI_KERNEL_DAVIDSON, 0.8, alphas[i], times[i], 0 };
        const fvi_kernel law = { 1, &term };
        fvi_run run = fvi_run_default(&system, &x0, &p0, 0.1, STEPS);
        const fvi_objective J = { .slopes = last_place };
        double by[2], far[2][LEN(place)], x[STEPS + 1];
        const fvi_sensitivities want = { .orders = by, .times = by + 1 };
        run.law = &law;
        run.memory = kinds[n / LEN(methods) / LEN(times)];
        ck_assert_int_eq(fvi_adjoint(method, &run, NULL, NULL, &J, &want), 0);
        for (size_t l = 0; l < 2 * LEN(place); l++) {
            const double by_e = 1 + e * place[l % LEN(place)];
            term.alpha = alphas[i] * (l < LEN(place) ? by_e : 1);
            term.time = times[i] * (l < LEN(place) ? 1 : by_e);
            ck_assert_int_eq(fvi_trajectory(method, &run, x, NULL, NULL), 0);
            far[l / LEN(place)][l % LEN(place)] = x[STEPS];
        }
        for (size_t l = 0; l < 2; l++) {
            const double *v = far[l], number = l ? times[i] : alphas[i],
                         difference = (8 * (v[2] - v[1]) - v[3] + v[0]) / (12 * e);
            seen_worst(fabs(number * by[l] - difference), "off");
            ck_assert_near(number * by[l], difference, 1e-10, "%s, time %g, number %zu", method->name, times[i], l);
        }
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("adjoint, the numbers of a law");
    ADD_CASE(suite, "values", eq_23_21_every_number_of_a_law_to_40_digits,
             eq_23_21_every_number_of_a_law_with_stages,
             eq_23_21_modes_give_the_numbers_of_all_weights,
             a_number_of_a_law_may_be_asked_for_alone, cole_and_davidson_with_stages);
    return run_suite(suite);
}
