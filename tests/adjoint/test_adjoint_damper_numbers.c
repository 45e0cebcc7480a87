/* tests/adjoint/test_adjoint_damper_numbers.c -- H 23, 27: derivatives of structures with several dampers by the
 * numbers of their laws.
 * Run alone: make test-adjoint_damper_numbers */
#include "../structures/structures_runs.h"
#include <fvi/adjoint.h>
#include <fvi/dampers.h>
#include "run/whole_run.h"
#include "system/larger.h"

#include "adjoint_dampers_ref.h"
#include "sine_and_momenta.h"

enum { D = 3, N = 12, DAMPERS = 3, TERMS = 2, NUMBERS = 4 };

static const fvi_history_kind kinds[] = { FVI_HISTORY_DIRECT, FVI_HISTORY_MODES };

static int cosine(double t, size_t d, void *params, double *F)
{
    (void)params;
    for (size_t i = 0; i < d; i++)
        F[i] = (double)(i + 1) * cos(1.25 * t) / 5;
    return 0;
}

/* J = x_N of one body. */
static int last_place(size_t k, size_t d, const double *x, const double *p, void *params,
                      double *Jx, double *Jp)
{
    (void)d, (void)x, (void)params, (void)Jp, (void)p;
    *Jx += k == N;
    return 0;
}

/* ---- the structure of a row ---- */

typedef struct {
    fvi_sparse M, K, C;
    fvi_kernel kernel[DAMPERS];
    fvi_damper damper[DAMPERS];
    fvi_structure *structure;
    fvi_system system;
    fvi_run run;
} structure;

static void full(const double *entries, fvi_sparse *A)
{
    fvi_triplet list[D * D];
    for (int i = 0; i < D * D; i++)
        list[i] = (fvi_triplet){ i / D, i % D, entries[i] };
    OK(fvi_sparse_assemble(D, D * D, list, A));
}

static void make_structure(size_t i, const fvi_kernel_term term[DAMPERS][TERMS],
                           structure *s)
{
    full(ref_dampers[i].M, &s->M);
    full(ref_dampers[i].K, &s->K);
    full(ref_dampers[i].C, &s->C);
    for (size_t j = 0; j < DAMPERS; j++) {
        s->kernel[j] = (fvi_kernel){ ref_dampers[i].terms[j], term[j] };
        s->damper[j] = (fvi_damper){ .kernel = s->kernel + j, .past = ref_dampers[i].past[j] };
        if (j < 2)
            s->damper[j].of = fvi_elongation_row(ref_dampers[i].row + j * D);
        else
            s->damper[j].matrix = &s->C;
    }
    OK(fvi_structure_alloc_dampers(&s->M, &s->K, DAMPERS, s->damper, &s->structure, NULL));
    s->system = fvi_structure_system(s->structure);
    s->system.force.value = cosine;
    s->run = run_of(&s->system, 0.5, h, N, ref_dampers[i].x0, ref_dampers[i].p0);
    s->run.kappa = ref_dampers[i].kappa;
}

static void drop_structure(structure *s)
{
    fvi_structure_free(s->structure);
    fvi_sparse_free(&s->M);
    fvi_sparse_free(&s->K);
    fvi_sparse_free(&s->C);
}

/* By rho, alpha, time and end of all terms, one behind another; by factors, x0 and p0. */
typedef struct {
    double by[NUMBERS][DAMPERS * TERMS], damping[DAMPERS], start[2 * D];
    fvi_sensitivities want;
} answers;

static void ask(answers *a)
{
    for (size_t number = 0; number < NUMBERS; number++)
        for (size_t i = 0; i < DAMPERS * TERMS; i++)
            a->by[number][i] = NAN;
    a->want = (fvi_sensitivities){ .x0 = a->start,
                                   .p0 = a->start + D,
                                   .damping = a->damping,
                                   .terms = a->by[0],
                                   .orders = a->by[1],
                                   .times = a->by[2],
                                   .ends = a->by[3] };
}

static double number_of(size_t i, const answers *a, size_t j, size_t l, size_t number)
{
    size_t place = l;
    for (size_t n = 0; n < j; n++)
        place += ref_dampers[i].terms[n];
    return a->by[number][place];
}

/* Twelve steps; weights to 60 u of the largest, which is h^-2 at most, and those of a symbol to some 1e-14
 * of the largest. Seen: 2.7e-15. */
static void ck_assert_numbers(size_t i, const answers *a, const char *name)
{
    double factor[DAMPERS] = { 0 };
    for (size_t j = 0; j < DAMPERS; j++)
        for (size_t l = 0; l < ref_dampers[i].terms[j]; l++)
            for (size_t number = 0; number < NUMBERS; number++) {
                const double want = ref_dampers[i].want[8 * j + 4 * l + number],
                             got = number_of(i, a, j, l, number);
                if (number == 0)
                    factor[j] += ref_dampers[i].term[j][l].rho * want;
                seen_worst(fabs(got - want) / larger(1, fabs(want)), "worst");
                ck_assert_near(got, want, 2e-14 * larger(1, fabs(want)),
                               "%s row %zu damper %zu term %zu number %zu", name, i, j, l,
                               number);
            }
    for (size_t j = 0; j < DAMPERS; j++)
        ck_assert_near(a->damping[j], factor[j], 2e-14 * larger(1, fabs(factor[j])),
                       "%s row %zu factor %zu", name, i, j);
    for (size_t l = 0; l < 2 * D; l++)
        ck_assert_near(a->start[l], ref_dampers[i].want[24 + l],
                       2e-14 * larger(1, fabs(ref_dampers[i].want[24 + l])),
                       "%s row %zu start %zu", name, i, l);
}

START_TEST(eq_23_28_every_number_of_several_dampers_to_40_digits)
{
    size_t asked = 0;
    for (size_t n = 0; n < LEN(ref_dampers) * LEN(kinds); n++) {
        const size_t i = n / LEN(kinds);
        const fvi_method *method = ref_dampers[i].method;
        const fvi_objective J = { .slopes = to_sine };
        structure s;
        answers a;
        make_structure(i, ref_dampers[i].term, &s);
        s.run.memory = kinds[n % LEN(kinds)];
        ask(&a);
        const int status = fvi_adjoint(method, &s.run, NULL, NULL, &J, &a.want);
        if (s.run.memory == FVI_HISTORY_DIRECT || status != FVI_EUNSUP) { /* some have no modes */
            OK(status);
            ck_assert_numbers(i, &a, method->name);
            asked++;
        }
        drop_structure(&s);
    }
    ck_assert_uint_gt(asked, LEN(ref_dampers));
}
END_TEST

/* With h = 1 the symbol's derivative by an order begins with ln 1 = 0, which no memory can take out. Off by
 * e^2 times a third derivative, and by rounding over e. Seen: 1.4e-9. Each memory: one of modes needs a first
 * weight that is not 0. */
START_TEST(a_derivative_that_begins_with_zero)
{
    const double e = 0x1p-15, x0[] = { 1 }, p0[] = { 0.5 }, mass[] = { 1 }, rho[] = { 1 },
                 c[] = { 0.3 };
    const fvi_system system = { .d = 1,
                                .mass = mass,
                                .damping = rho,
                                .potential = fvi_potential_harmonic(c) };
    fvi_kernel_term term = { FVI_KERNEL_MAXWELL2, 0.4, 0.4, 1.5, 0.1 };
    const fvi_kernel law = { 1, &term };
    fvi_run run = run_of(&system, 0.5, 1, N, x0, p0);
    run.law = &law;
    double by[NUMBERS], last[2];
    const fvi_sensitivities want = { .terms = by, .orders = by + 1, .times = by + 2,
                                     .ends = by + 3 };
    const fvi_objective J = { .slopes = last_place };
    for (size_t n = 0; n < LEN(kinds) * NUMBERS; n++) {
        double *const number[] = { &term.rho, &term.alpha, &term.time, &term.end };
        const size_t i = n % NUMBERS;
        const double v = *number[i];
        run.memory = kinds[n / NUMBERS];
        OK(fvi_adjoint(&fvi_fractional, &run, NULL, NULL, &J, &want));
        for (int side = 0; side < 2; side++) {
            double x[N + 1], p[N + 1];
            *number[i] = side ? v + e : v - e;
            OK(fvi_trajectory(&fvi_fractional, &run, x, p, NULL));
            last[side] = x[N];
        }
        *number[i] = v;
        seen_worst(fabs(by[i] - (last[1] - last[0]) / (2 * e)), "off");
        ck_assert_near(by[i], (last[1] - last[0]) / (2 * e), 1e-8, "number %zu", i);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("adjoint, numbers of several dampers");
    ADD_CASE(suite, "values", eq_23_28_every_number_of_several_dampers_to_40_digits,
             a_derivative_that_begins_with_zero);
    return run_suite(suite);
}
