/* tests/adjoint/test_adjoint_factors.c -- H 23: derivatives by factors of matrices.
 *                                        Run alone: make test-adjoint_factors */
#include "structures/structures_runs.h"
#include "run/whole_run.h"

#include "adjoint_matrices_ref.h"
#include "sine_and_momenta.h"
#include "system/larger.h"

enum { D = 3, N = 12 };

static const fvi_history_kind kinds[] = { FVI_HISTORY_DIRECT,
                                         FVI_HISTORY_MODES };

static void full(const double *entries, double factor, fvi_sparse *A)
{
    fvi_triplet list[D * D];
    for (int i = 0; i < D * D; i++)
        list[i] = (fvi_triplet){ i / D, i % D, factor * entries[i] };
    OK(fvi_sparse_assemble(D, D * D, list, A));
}

static int cosine(double t, size_t d, void *params, double *F)
{
    (void)params;
    for (size_t i = 0; i < d; i++)
        F[i] = (double)(i + 1) * cos(1.25 * t) / 5;
    return 0;
}

/* By factors of M and C, by alpha, by a factor of K; then by x0 and p0. */
typedef struct {
    double by[4], start[2 * D], force[(N + 1) * D];
    fvi_sensitivities want;
} answers;

static answers *answers_of(void)
{
    answers *a = calloc(1, sizeof *a);
    ck_assert_ptr_nonnull(a);
    a->want = (fvi_sensitivities){ .x0 = a->start,
                               .p0 = a->start + D,
                               .mass = a->by,
                               .damping = a->by + 1,
                               .alpha = a->by + 2,
                               .parameters = a->by + 3,
                               .force = a->force };
    return a;
}

static fvi_run set_up(size_t i, fvi_history_kind memory, matrices *m)
{
    full(ref_matrices[i].M, 1, &m->M);
    full(ref_matrices[i].C, 1, &m->C);
    full(ref_matrices[i].K, 1, &m->K);
    make(m);
    m->system.force.value = cosine;
    fvi_run run = run_of(&m->system, ref_matrices[i].alpha, h, N,
                         ref_matrices[i].x0, ref_matrices[i].p0);
    run.past = ref_matrices[i].past;
    run.kappa = ref_matrices[i].kappa;
    run.memory = memory;
    return run;
}

/* Twelve steps of terms of order 1 that are at most h^-2 apart, as the weights are; the
 * compressed memory keeps 1e-14 of each weight. Seen: 7.7e-14. */
START_TEST(eq_23_19_every_factor_of_matrices_to_40_digits)
{
    answers *a = answers_of();
    for (size_t i = 0; i < LEN(ref_matrices) * LEN(kinds); i++) {
        const size_t row = i / LEN(kinds);
        const fvi_method *method = ref_matrices[row].method;
        matrices m;
        fvi_run run = set_up(row, kinds[i % LEN(kinds)], &m);
        const fvi_objective J = { .slopes = to_sine, .params = NULL };
        OK(fvi_adjoint(method, &run, NULL, NULL, &J, &a->want));
        for (size_t j = 0; j < 4; j++) {
            const double want = ref_matrices[row].want[j];
            seen(fabs(a->by[j] - want) / larger(1, fabs(want)), "worst");
            ck_assert_near(a->by[j], want, 2e-13 * larger(1, fabs(want)),
                           "%s alpha %g past %d memory %zu number %zu",
                           method->name, run.alpha, run.past, i % LEN(kinds),
                           j);
        }
        drop(&m);
    }
    free(a);
}
END_TEST

/* M, C, K, forces and momenta times one factor: the same x, and p_N times it. So the
 * derivatives by all of these add up to J_p . p_N. */
START_TEST(eq_23_20_a_factor_of_everything_changes_no_position)
{
    answers *a = answers_of();
    for (size_t i = 0; i < LEN(ref_matrices); i++) {
        const fvi_method *method = ref_matrices[i].method;
        double x[(N + 1) * D], p[(N + 1) * D], size = 1;
        matrices m;
        fvi_run run = set_up(i, FVI_HISTORY_AUTO, &m);
        const fvi_objective J = { .slopes = to_sine, .params = NULL };
        OK(fvi_adjoint(method, &run, NULL, NULL, &J, &a->want));
        OK(fvi_trajectory(method, &run, x, p, NULL));
        double sum = a->by[0] + a->by[1] + a->by[3];
        for (size_t k = 0; k < 4; k++)
            size = larger(size, fabs(a->by[k]));
        for (size_t k = 0; k < (N + 1) * D; k++)
            sum += a->force[k] * (double)(k % D + 1)
                   * cos(1.25 * (double)(k / D) * h) / 5;
        for (size_t k = 0; k < D; k++) {
            sum += a->start[D + k] * run.p0[k];
            sum -= p[N * D + k] * p[N * D + k];
        }
        seen(fabs(sum) / size, "off");
        ck_assert_near(sum, 0, 1e-13 * size, "%s alpha %g past %d",
                       method->name, run.alpha, run.past);
        drop(&m);
    }
    free(a);
}
END_TEST

/* A law that is one power, and that power: the same derivatives, N sums of roundings. */
START_TEST(eq_23_21_a_power_of_matrices_as_a_law)
{
    answers *a = answers_of(), *b = answers_of();
    for (size_t i = 0; i < LEN(ref_matrices); i++) {
        const fvi_method *method = ref_matrices[i].method;
        const fvi_kernel_term term = { FVI_KERNEL_POWER, 1, ref_matrices[i].alpha, 0,
                                    0 };
        const fvi_kernel law = { 1, &term };
        double terms, orders;
        matrices m;
        fvi_run run = set_up(i, FVI_HISTORY_AUTO, &m);
        const fvi_objective J = { .slopes = to_sine, .params = NULL };
        if (method->takes_laws && method != &fvi_cq2_midpoint
            && method != &fvi_cq2_shifted
            && run.past == FVI_INITIAL_HISTORY_HELD
            && (method == &fvi_fractional || run.alpha <= 0.5)) {
            OK(fvi_adjoint(method, &run, NULL, NULL, &J, &a->want));
            run.law = &law;
            b->want.alpha = NULL;
            b->want.terms = &terms;
            b->want.orders = &orders;
            OK(fvi_adjoint(method, &run, NULL, NULL, &J, &b->want));
            b->by[2] = orders;
            for (size_t j = 0; j < 4; j++)
                ck_assert_near(b->by[j], a->by[j],
                               1e-12 * larger(1, fabs(a->by[j])),
                               "%s alpha %g number %zu", method->name,
                               ref_matrices[i].alpha, j);
            ck_assert_near(terms, b->by[1], 1e-12 * larger(1, fabs(terms)),
                           "the factor of the only term");
            for (size_t j = 0; j < 2 * D; j++)
                ck_assert_near(b->start[j], a->start[j],
                               1e-12 * larger(1, fabs(a->start[j])),
                               "start %zu", j);
            for (size_t j = 0; j < (N + 1) * D; j++)
                ck_assert_near(b->force[j], a->force[j], 1e-12, "force %zu", j);
        }
        drop(&m);
    }
    free(a);
    free(b);
}
END_TEST

enum { TERMS = 4 };

/* A law of four terms, moved by t. */
static void law_at(fvi_kernel_term *term, double t)
{
    const fvi_kernel_term at[TERMS] = {
        { FVI_KERNEL_POWER, 0.4 - 0.1 * t, 0.3 + 0.2 * t, 0, 0 },
        { FVI_KERNEL_ZENER, 0.4 + 0.2 * t, 0.35 - 0.3 * t, 0.6 + 0.5 * t, 0 },
        { FVI_KERNEL_MAXWELL, 0.3 + 0.3 * t, 0, 0.5 - 0.4 * t, 0 },
        { FVI_KERNEL_DISTRIBUTED, 0.2 - 0.2 * t, 0.1 + 0.1 * t, 0, 0.45 - 0.2 * t }
    };
    memcpy(term, at, sizeof at);
}

/* J of the matrices of row i, each times 1 + t, 1 - t, 1 + 2 t, and of that law. */
static double objective_at(const fvi_method *method, size_t i, double t)
{
    double x[(N + 1) * D], p[(N + 1) * D], x0[D], p0[D], J = 0;
    fvi_kernel_term term[TERMS];
    const fvi_kernel law = { TERMS, term };
    matrices m;
    full(ref_matrices[i].M, 1 + t, &m.M);
    full(ref_matrices[i].C, 1 - t, &m.C);
    full(ref_matrices[i].K, 1 + 2 * t, &m.K);
    make(&m);
    m.system.force.value = cosine;
    law_at(term, t);
    for (size_t j = 0; j < D; j++) {
        x0[j] = ref_matrices[i].x0[j] + t;
        p0[j] = ref_matrices[i].p0[j] - t;
    }
    fvi_run run = run_of(&m.system, 0.9, h, N, x0, p0); /* alpha: not read */
    run.kappa = ref_matrices[i].kappa;
    run.law = &law;
    OK(fvi_trajectory(method, &run, x, p, NULL));
    for (size_t k = 1; k <= N; k++)
        for (size_t j = 0; j < D; j++) {
            const double away = x[k * D + j] - sin((double)k * h);
            J += h / 2 * away * away
                 + (k == N ? p[k * D + j] * p[k * D + j] / 2 : 0);
        }
    drop(&m);
    return J;
}

/* Taylor's test, by all numbers of a law and of its matrices. */
START_TEST(eq_23_21_what_the_gradient_of_a_law_of_matrices_leaves)
{
    static const fvi_method *const methods[] = { &fvi_fractional, &fvi_cq_bdf2,
                                                 &fvi_cq2_midpoint };
    answers *a = answers_of();
    const double t = 1e-3;
    for (size_t n = 0; n < 5 * LEN(methods); n++) {
        const size_t i =
            n / LEN(methods); /* alpha at most 1/2, as it was drawn */
        const fvi_method *method = methods[n % LEN(methods)];
        double by[4 * TERMS];
        fvi_kernel_term term[TERMS];
        const fvi_kernel law = { TERMS, term };
        matrices m;
        fvi_run run = set_up(i, FVI_HISTORY_AUTO, &m);
        const fvi_objective J = { .slopes = to_sine, .params = NULL };
        law_at(term, 0);
        run.law = &law;
        run.alpha = 0.9;
        a->want.alpha = NULL;
        a->want.terms = by;
        a->want.orders = by + TERMS;
        a->want.times = by + 2 * TERMS;
        a->want.ends = by + 3 * TERMS;
        OK(fvi_adjoint(method, &run, NULL, NULL, &J, &a->want));
        double slope = a->by[0] - a->by[1] + 2 * a->by[3];
        for (size_t j = 0; j < D; j++)
            slope += a->start[j] - a->start[D + j];
        slope += -0.1 * by[0] + 0.2 * by[1] + 0.3 * by[2] - 0.2 * by[3]
                 + 0.2 * by[4] - 0.3 * by[5] + 0.1 * by[7] + 0.5 * by[9]
                 - 0.4 * by[10] - 0.2 * by[15];
        const double J0 = objective_at(method, i, 0);
        const double whole = objective_at(method, i, t) - J0 - t * slope,
                     half = objective_at(method, i, t / 2) - J0 - t / 2 * slope;
        ck_assert_near(whole / half, 4, 0.1, "%s row %zu", method->name, i);
        drop(&m);
    }
    free(a);
}
END_TEST

/* Six hundred steps, all weights or modes, which keep 1e-14 of each weight: of the largest.
 * Seen: 1.1e-13. */
START_TEST(eq_23_19_modes_give_the_factors_of_all_weights)
{
    answers *a = answers_of();
    double of[2][4];
    size_t compared = 0;
    for (size_t i = 0; i < LEN(ref_matrices); i++) {
        const fvi_method *method = ref_matrices[i].method;
        const fvi_objective J = { .slopes = to_sine, .params = NULL };
        double most = 1;
        int status = FVI_SUCCESS;
        matrices m;
        fvi_run run = set_up(i, FVI_HISTORY_DIRECT, &m);
        run.steps = 600;
        a->want.force = NULL;
        for (int l = 0; !status && l < 2; l++) {
            run.memory = l ? FVI_HISTORY_MODES : FVI_HISTORY_DIRECT;
            status = fvi_adjoint(method, &run, NULL, NULL, &J, &a->want);
            memcpy(of[l], a->by, sizeof of[l]);
        }
        drop(&m);
        if (status == FVI_EOVRFLW || fabs(of[0][2]) > 1e6)
            continue; /* too stiff for what is explicit */
        OK(status);
        compared++;
        for (size_t j = 0; j < 4; j++)
            most = larger(most, fabs(of[0][j]));
        for (size_t j = 0; j < 4; j++) {
            seen_worst(fabs(of[1][j] - of[0][j]) / most, "off");
            ck_assert_near(of[1][j], of[0][j], 1e-11 * most,
                           "%s alpha %g number %zu", method->name, run.alpha,
                           j);
        }
    }
    ck_assert_uint_ge(compared, LEN(ref_matrices) / 2);
    free(a);
}
END_TEST

/* Each alone, and none at all: the same digits, and nothing else is written. */
START_TEST(a_factor_may_be_asked_for_alone)
{
    answers *all = answers_of(), *one = answers_of();
    matrices m;
    fvi_run run = set_up(LEN(ref_matrices) - 3, FVI_HISTORY_AUTO, &m);
    const fvi_objective J = { .slopes = to_sine, .params = NULL };
    OK(fvi_adjoint(&fvi_cq2_midpoint, &run, NULL, NULL, &J, &all->want));
    for (size_t i = 0; i < 4; i++) {
        const fvi_sensitivities want = { .mass = i == 0 ? one->by : NULL,
                                     .damping = i == 1 ? one->by + 1 : NULL,
                                     .alpha = i == 2 ? one->by + 2 : NULL,
                                     .parameters =
                                         i == 3 ? one->by + 3 : NULL };
        OK(fvi_adjoint(&fvi_cq2_midpoint, &run, NULL, NULL, &J, &want));
        ck_assert_near(one->by[i], all->by[i], 0, "number %zu", i);
    }
    drop(&m);
    free(all);
    free(one);
}
END_TEST

/* Without C there is no history: no derivative by a factor of it, or by alpha. */
START_TEST(a_body_without_damping_has_slopes_of_zero)
{
    answers *a = answers_of();
    matrices m = { .structure = NULL };
    const double *x0 = ref_matrices[0].x0, *p0 = ref_matrices[0].p0;
    full(ref_matrices[0].M, 1, &m.M);
    full(ref_matrices[0].K, 1, &m.K);
    OK(fvi_structure_alloc(&m.M, &m.K, NULL, &m.structure, NULL));
    m.system = fvi_structure_system(m.structure);
    fvi_run run = run_of(&m.system, 0.7, h, N, x0, p0);
    const fvi_objective J = { .slopes = to_sine, .params = NULL };
    a->by[1] = a->by[2] = 1;
    OK(fvi_adjoint(&fvi_cq_bdf2, &run, NULL, NULL, &J, &a->want));
    ck_assert_near(a->by[1], 0, 0, "C");
    ck_assert_near(a->by[2], 0, 0, "alpha");
    drop(&m);
    free(a);
}
END_TEST

START_TEST(no_products_with_M_no_slope_by_its_factor)
{
    answers *a = answers_of();
    matrices m;
    fvi_run run = set_up(0, FVI_HISTORY_AUTO, &m);
    fvi_matrices blind = *m.system.matrices;
    fvi_system system = m.system;
    blind.inertia = NULL;
    system.matrices = &blind;
    run.system = &system;
    const fvi_objective J = { .slopes = to_sine, .params = NULL };
    ck_assert_int_eq(
        fvi_adjoint(&fvi_fractional, &run, NULL, NULL, &J, &a->want),
        FVI_EUNSUP);
    a->want.mass = NULL;
    OK(fvi_adjoint(&fvi_fractional, &run, NULL, NULL, &J, &a->want));
    drop(&m);
    free(a);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("adjoint, factors of matrices");
    ADD_CASE(suite, "values", eq_23_19_every_factor_of_matrices_to_40_digits,
             eq_23_20_a_factor_of_everything_changes_no_position,
             eq_23_19_modes_give_the_factors_of_all_weights,
             eq_23_21_a_power_of_matrices_as_a_law,
             eq_23_21_what_the_gradient_of_a_law_of_matrices_leaves);
    ADD_CASE(suite, "what is asked for", a_factor_may_be_asked_for_alone,
             a_body_without_damping_has_slopes_of_zero,
             no_products_with_M_no_slope_by_its_factor);
    return run_suite(suite);
}
