/* tests/damping_laws/test_damping_laws_havriliak.c -- H 26: the law of Havriliak and Negami, and the numbers that
 * the library derives from the symbol of a kind.
 * Run alone: make test-damping_laws_havriliak */
#include <fvi/fvi.h>
#include <fvi/formulas.h>
#include <fvi/rheology.h>
#include "harness/ulp.h"
#include "kernel/kernel_classes.h"
#include "kernel/symbol_poles.h"
#include "run/whole_run.h"
#include "system/larger.h"

#include "damping_laws_havriliak_ref.h"

#include <complex.h>
#include <string.h>

static const fvi_kernel_term manual = { FVI_KERNEL_HAVRILIAK, 0.4, 0.3, 2, 0.6 };

/* One term of each kind with numbers, away from the borders of its numbers. */
static const fvi_kernel_term of_each_kind[] = {
    { FVI_KERNEL_POWER, 1, 0.3, 0, 0 },           { FVI_KERNEL_ZENER, 1, 0.3, 2, 0 },
    { FVI_KERNEL_MAXWELL, 1, 0, 2, 0 },           { FVI_KERNEL_DISTRIBUTED, 1, 0.1, 0, 0.4 },
    { FVI_KERNEL_MAXWELL2, 1, 0.4, 1.5, 0.1 },    { FVI_KERNEL_DAVIDSON, 1, 0.3, 2, 0 },
    { FVI_KERNEL_HAVRILIAK, 1, 0.3, 2, 0.6 },
};

/* ---- the law ---- */

/* Relative to the largest weight, as for the other laws. */
START_TEST(eq_26_3_weights_of_havriliak_and_negami)
{
    double w[151];
    for (size_t i = 0; i < LEN(ref_weights); i++) {
        const fvi_kernel law = { 1, &ref_havriliak[ref_weights[i].law] };
        ck_assert_int_eq(fvi_kernel_weights(&law, ref_weights[i].kind, ref_weights[i].h, LEN(w), w), FVI_SUCCESS);
        for (size_t j = 0; j < REF_INDICES; j++)
            ck_assert_near(w[ref_index[j]], ref_weights[i].w[j], 60 * U * fabs(ref_weights[i].w[0]), "row %zu, n = %zu",
                           i, ref_index[j]);
    }
}
END_TEST

/* The exact motion as its header promises, and three integrators to their errors: order 2 with 4000 steps (seen:
 * 1.6e-5), four stages with 200 steps (1.5e-10), and up to 100 steps of any length, each with the error 1e-14 (8e-16). */
START_TEST(eq_26_9_motions_of_havriliak_and_negami)
{
    static const double one = 1;
    for (size_t i = 0; i < LEN(ref_motions); i++) {
        const fvi_kernel law = { 1, &ref_havriliak[ref_motions[i].law] };
        const double t = ref_motions[i].t, F = ref_motions[i].F;
        const fvi_linear_oscillator exact = { .m = 1,
                                              .c = 1,
                                              .rho = 1,
                                              .x0 = ref_motions[i].x0,
                                              .v0 = ref_motions[i].p0,
                                              .law = &law,
                                              .forcing = F > 0 ? FVI_FORCING_STEP : FVI_FORCING_NONE,
                                              .A = F,
                                              .T = 100 };
        double x;
        ck_assert_int_eq(fvi_exact_at(&exact, 1, &t, &x, NULL, NULL), FVI_SUCCESS);
        ck_assert_near(x, ref_motions[i].x, 1e-14, "row %zu", i);
        const struct {
            const fvi_method *method;
            size_t steps;
            double most;
        } runs[] = { { &fvi_cq_bdf2, 4000, 3e-5 }, { &fvi_lobatto_d4, 200, 1e-9 }, { &fvi_variable_step, 10, 1e-12 } };
        for (size_t k = 0; k < LEN(runs) && F == 0; k++) {
            static double at[4001];
            const fvi_system system = { 1, &one, &one, fvi_potential_harmonic(&one), { 0 }, NULL, NULL };
            fvi_run run = fvi_run_default(&system, &ref_motions[i].x0, &ref_motions[i].p0, t / (double)runs[k].steps,
                                          runs[k].steps);
            run.law = &law;
            run.step_error = 1e-14;
            ck_assert_int_eq(fvi_trajectory(runs[k].method, &run, at, NULL, NULL), FVI_SUCCESS);
            seen(fabs(at[runs[k].steps] - ref_motions[i].x), runs[k].method->name);
            ck_assert_near(at[runs[k].steps], ref_motions[i].x, runs[k].most, "row %zu by %s", i, runs[k].method->name);
        }
    }
}
END_TEST

/* With the exponent 1 it is the law of Zener, without a time a power, and of order 0 a spring: the same weights and the
 * same motions, to the bit. The law of Cole and Davidson of order 1 is a Maxwell element, and of order 0 a spring. */
START_TEST(an_exponent_of_one_is_the_law_of_zener_to_the_bit)
{
    const fvi_kernel_term pairs[][2] = {
        { { FVI_KERNEL_HAVRILIAK, 0.4, 0.3, 2, 1 }, { FVI_KERNEL_ZENER, 0.4, 0.3, 2, 0 } },
        { { FVI_KERNEL_HAVRILIAK, 0.4, 0.3, 0, 0.6 }, { FVI_KERNEL_POWER, 0.4, 0.3, 0, 0 } },
        { { FVI_KERNEL_HAVRILIAK, 0.4, 0, 3, 0.5 }, { FVI_KERNEL_POWER, 0.2, 0, 0, 0 } },
        { { FVI_KERNEL_DAVIDSON, 0.4, 0.5, 2, 0 }, { FVI_KERNEL_MAXWELL, 0.4, 0, 2, 0 } },
        { { FVI_KERNEL_DAVIDSON, 0.4, 0, 2, 0 }, { FVI_KERNEL_POWER, 0.4, 0, 0, 0 } },
    };
    static const double one = 1;
    static const fvi_method *const methods[] = { &fvi_fractional, &fvi_cq2_midpoint, &fvi_lobatto_d3,
                                                &fvi_variable_step };
    for (size_t i = 0; i < LEN(pairs); i++)
        for (size_t m = 0; m < LEN(methods); m++) {
            double x[2][401];
            for (size_t k = 0; k < 2; k++) {
                const fvi_kernel law = { 1, &pairs[i][k] };
                const fvi_system system = { 1, &one, &one, fvi_potential_harmonic(&one), { 0 }, NULL, NULL };
                fvi_run run = fvi_run_default(&system, &one, &one, 0.05, 400);
                run.law = &law;
                ck_assert_int_eq(fvi_trajectory(methods[m], &run, x[k], NULL, NULL), FVI_SUCCESS);
            }
            ck_assert_mem_eq(x[0], x[1], sizeof x[0]);
        }
}
END_TEST

START_TEST(numbers_that_are_no_law_of_havriliak_and_negami_are_refused)
{
    const fvi_kernel_term bad[] = {
        { FVI_KERNEL_HAVRILIAK, 0.4, 0.51, 2, 0.6 }, { FVI_KERNEL_HAVRILIAK, 0.4, 0.3, 2, 0 },
        { FVI_KERNEL_HAVRILIAK, 0.4, 0.3, 2, 1.01 }, { FVI_KERNEL_HAVRILIAK, 0.4, 0.3, -1, 0.6 },
        { FVI_KERNEL_HAVRILIAK, 0.4, -0.1, 2, 0.6 }, { FVI_KERNEL_HAVRILIAK, 0.4, 0.3, 2, NAN },
    };
    for (size_t i = 0; i < LEN(bad); i++)
        ck_assert_int_eq(fvi_kernel_check(&(fvi_kernel){ 1, &bad[i] }), FVI_EDOM);
    const fvi_kernel_term unknown = { (fvi_kernel_kind)fvi_kernel_class_count, 1, 0.3, 1, 0.5 };
    ck_assert_int_eq(fvi_kernel_check(&(fvi_kernel){ 1, &unknown }), FVI_EINVAL);
}
END_TEST

/* ---- the memory ---- */

/* The sums of a memory of modes are those of all weights, alone and in laws of several terms, one of which grows faster
 * than s. */
START_TEST(eq_26_6_modes_from_the_symbol_of_a_kind)
{
    const fvi_kernel_term terms[][3] = {
        { { FVI_KERNEL_HAVRILIAK, 0.4, 0.3, 2, 0.6 } },
        { { FVI_KERNEL_HAVRILIAK, 0.4, 0.3, 2, 0.6 }, { FVI_KERNEL_POWER, 0.2, 0.4, 0, 0 },
          { FVI_KERNEL_DAVIDSON, 0.3, 0.3, 1, 0 } },
        { { FVI_KERNEL_HAVRILIAK, 0.4, 0.2, 0.5, 0.3 }, { FVI_KERNEL_HAVRILIAK, 0.2, 0.4, 3, 0.7 } },
        { { FVI_KERNEL_HAVRILIAK, 0.4, 0.3, 2, 0.6 }, { FVI_KERNEL_POWER, 0.2, 0.8, 0, 0 } },
    };
    const size_t counts[] = { 1, 3, 2, 2 }, steps = 3000;
    for (size_t i = 0; i < LEN(terms); i++)
        for (fvi_delta kind = FVI_DELTA_EULER; kind <= FVI_DELTA_BDF2; kind++) {
            const fvi_kernel law = { counts[i], terms[i] };
            fvi_history *memory[2];
            double first[2], worst = 0;
            for (int how = 0; how < 2; how++)
                ck_assert_int_eq(fvi_kernel_history(&law, kind, 0.02, 1, steps,
                                                    how ? FVI_HISTORY_MODES : FVI_HISTORY_DIRECT, 1e-14, &first[how],
                                                    &memory[how]),
                                 FVI_SUCCESS);
            for (size_t k = 0; k <= steps; k++) {
                const double x = 1 + sin(0.02 * (double)k), dx = k ? x - 1 - sin(0.02 * ((double)k - 1)) : x;
                double sum[2];
                for (int how = 0; how < 2; how++) {
                    ck_assert_int_eq(fvi_history_push(memory[how], &x, &dx, &sum[how]), FVI_SUCCESS);
                    sum[how] *= first[how];
                }
                worst = larger(worst, fabs(sum[0] - sum[1]) / first[0]);
            }
            seen(worst, "modes of a kind, off the weights");
            ck_assert_msg(worst < 1e-12, "law %zu: %g", i, worst);
            fvi_history_free(memory[0]);
            fvi_history_free(memory[1]);
        }
}
END_TEST

/* Where the branch point comes near to the cut, modes are compared with the symbol before they are used: the run is
 * right, or it is refused. */
START_TEST(eq_26_18_variable_steps_near_the_branch_point_are_right_or_refused)
{
    static const double one = 1;
    const double alphas[] = { 0.4, 0.45, 0.47, 0.48, 0.49, 0.495, 0.5 };
    size_t refused = 0;
    for (size_t i = 0; i < LEN(alphas); i++) {
        const fvi_kernel_term term = { FVI_KERNEL_HAVRILIAK, 0.4, alphas[i], 2, 0.6 };
        const fvi_kernel law = { 1, &term };
        const fvi_linear_oscillator exact = { .m = 1, .c = 1, .rho = 1, .x0 = 1, .v0 = 0.5, .law = &law };
        const double t = 20, p0 = 0.5;
        const fvi_system system = { 1, &one, &one, fvi_potential_harmonic(&one), { 0 }, NULL, NULL };
        fvi_run run = fvi_run_default(&system, &one, &p0, 2, 10);
        double want, x[11];
        run.law = &law;
        run.step_error = 1e-12;
        ck_assert_int_eq(fvi_exact_at(&exact, 1, &t, &want, NULL, NULL), FVI_SUCCESS);
        const int status = fvi_trajectory(&fvi_variable_step, &run, x, NULL, NULL);
        refused += status == FVI_EUNSUP;
        ck_assert(status == FVI_SUCCESS || status == FVI_EUNSUP);
        if (!status)
            ck_assert_near(x[10], want, 1e-10, "alpha = %g", alphas[i]);
    }
    ck_assert_uint_le(refused, 3);
}
END_TEST

/* ---- what is derived from the symbol ---- */

/* Of every kind: the derivatives that it gives are the differences of its symbol, and its growth is that of its
 * values. Central differences of order 8 with the step T/64 have the error 9!/(630 64^8) = 2e-12 of C/T if the pole is
 * at the distance T, and less than 1e-11 here. At T = 0 they are of order 6 on one side, with the error 6!/64^6 = 1e-8.
 * The growth of a distributed law is off by 1/ln s, which is 0.0036 at s = 2^400. */
START_TEST(derivatives_and_growth_of_every_kind_are_those_of_its_symbol)
{
    for (size_t i = 0; i < LEN(of_each_kind); i++) {
        const fvi_kernel_term *t = &of_each_kind[i];
        const fvi_kernel law = { 1, t };
        ck_assert_near(fvi_symbol_growth(t), fvi_kernel_growth(&law), 0.004, "growth of kind %d", (int)t->kind);
        for (size_t field = 1; field < FVI_KERNEL_FIELDS; field++) {
            fvi_symbol_function *by = fvi_kernel_derivative_symbol(t, (fvi_slope_by)(field - 1));
            ck_assert(!by == !fvi_kernel_number_of(t, field));
            for (int k = -12; by && k <= 12; k++) {
                const double complex s = pow(10, k / 4.) * cexp(0.17 * k * I),
                                     off = by(t, s) - fvi_symbol_by_differences(t, s, field);
                const double size = cabs(by(t, s)) + cabs(fvi_kernel_at(&law, s, NULL));
                seen(cabs(off) / size, "differences of a symbol");
                ck_assert_msg(cabs(off) < 1e-11 * size, "kind %d, field %zu, k = %d: %g", (int)t->kind, field, k,
                              cabs(off) / size);
            }
        }
    }
    const fvi_kernel_term at_once = { FVI_KERNEL_HAVRILIAK, 1, 0.3, 0, 0.6 };
    fvi_symbol_function *by = fvi_kernel_derivative_symbol(&at_once, FVI_SLOPE_BY_TIME);
    for (int k = -8; k <= 8; k++) {
        const double complex s = pow(10, k / 4.) * (1 + I);
        ck_assert_double_lt(cabs(by(&at_once, s) / fvi_symbol_by_differences(&at_once, s, 2) - 1), 1e-8);
    }
}
END_TEST

/* s C'(s) of every kind, by differences of order 4 along a ray, with the step 1e-3 in ln s. Their error is 1e-12/30 of
 * the fifth derivative, and 2e-12 from a rounding error of 10 U in each value of C. */
START_TEST(slopes_of_every_kind_are_those_of_its_symbol)
{
    for (size_t i = 0; i < LEN(of_each_kind); i++)
        for (int k = -12; k <= 12; k++) {
            const fvi_kernel law = { 1, &of_each_kind[i] };
            const double complex s = pow(10, k / 4.) * cexp(0.11 * k * I);
            const double step = 1e-3;
            double complex slope;
            const double complex C = fvi_kernel_at(&law, s, &slope),
                                 near = fvi_kernel_at(&law, s * exp(step), NULL) - fvi_kernel_at(&law, s / exp(step), NULL),
                                 far = fvi_kernel_at(&law, s * exp(2 * step), NULL)
                                       - fvi_kernel_at(&law, s / exp(2 * step), NULL);
            ck_assert_double_lt(cabs((8 * near - far) / (12 * step) - slope), 1e-11 * cabs(C));
        }
}
END_TEST

/* ---- the lists ---- */

/* Each kind has all that nothing can be derived from; each word has its numbers, and is an element that comes back from
 * its term. */
START_TEST(every_kind_and_every_word_is_in_all_lists)
{
    size_t words = 0;
    ck_assert_uint_eq(LEN(of_each_kind) + 1, fvi_kernel_class_count);
    for (size_t i = 0; i < fvi_kernel_class_count; i++)
        ck_assert(fvi_kernel_classes[i] && fvi_kernel_classes[i]->check && fvi_kernel_classes[i]->symbol);
    for (; fvi_element_words[words]; words++) {
        const fvi_element kind = (fvi_element)words;
        size_t numbers = 0, found = 0;
        while (fvi_element_number(kind, numbers, NULL))
            numbers++;
        for (size_t i = 0; fvi_law_formulas[i].form; i++) {
            const size_t length = strcspn(fvi_law_formulas[i].form, ":");
            if (length != strlen(fvi_element_words[words])
                || strncmp(fvi_law_formulas[i].form, fvi_element_words[words], length) != 0)
                continue;
            found++;
            ck_assert_uint_eq(numbers, fvi_kernel_word_numbers(i));
        }
        ck_assert_uint_eq(found, 1);
    }
    ck_assert_uint_eq(words, fvi_kernel_word_count);
    for (size_t i = 0; i < LEN(of_each_kind); i++) {
        const fvi_element kind = fvi_element_of(&of_each_kind[i]);
        ck_assert_int_eq(fvi_kernel_words[(size_t)kind].kind, of_each_kind[i].kind);
        for (size_t j = 0, field; fvi_element_number(kind, j, &field); j++)
            ck_assert_str_eq(fvi_element_number(kind, j, NULL), fvi_kernel_number_of(&of_each_kind[i], field)->name);
    }
    ck_assert_ptr_null(fvi_element_number((fvi_element)words, 0, NULL));
    ck_assert_int_eq(fvi_element_of(&manual), FVI_ELEMENT_HAVRILIAK);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("damping_laws_havriliak");
    ADD_CASE(suite, "law", eq_26_3_weights_of_havriliak_and_negami, eq_26_9_motions_of_havriliak_and_negami,
             an_exponent_of_one_is_the_law_of_zener_to_the_bit,
             numbers_that_are_no_law_of_havriliak_and_negami_are_refused);
    ADD_CASE(suite, "memory", eq_26_6_modes_from_the_symbol_of_a_kind,
             eq_26_18_variable_steps_near_the_branch_point_are_right_or_refused);
    ADD_CASE(suite, "every kind", derivatives_and_growth_of_every_kind_are_those_of_its_symbol,
             slopes_of_every_kind_are_those_of_its_symbol, every_kind_and_every_word_is_in_all_lists);
    return run_suite(suite);
}
