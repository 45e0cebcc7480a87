/* tests/memory/test_memory_warning.c -- H 12: a memory or a tolerance that a run does not read is warned of. The
 * reference is the run itself: what has no effect leaves every bit of its rows.
 * Run alone: make test-memory_warning */
#include <fvi/fvi.h>
#include "run/whole_run.h"
#include "harness/ulp.h"

#include <string.h>

enum { N = 400 }; /* more than 256 steps: below them AUTO sums directly */

static const double one = 1, rho = 0.5, looser = 1e-3;

static fvi_run run_of(const fvi_method *method, fvi_system *system)
{
    *system = (fvi_system){ .d = 1, .mass = &one, .damping = &rho, .potential = fvi_potential_harmonic(&one) };
    fvi_run run = fvi_run_default(system, &one, &rho, 0.05, N);
    run.alpha = method->alpha_least < method->alpha_most ? 0.3 : 0.5;
    return run;
}

/* Are the rows of two runs equal, each bit of them? */
static int are_equal(const fvi_method *method, const fvi_run *a, const fvi_run *b)
{
    static double x[N + 1], y[N + 1];
    ck_assert_int_eq(fvi_trajectory(method, a, x, NULL, NULL), FVI_SUCCESS);
    ck_assert_int_eq(fvi_trajectory(method, b, y, NULL, NULL), FVI_SUCCESS);
    return memcmp(x, y, sizeof x) == 0;
}

static int is_warned_of(const fvi_method *method, const fvi_run *run)
{
    char text[FVI_WARNING_ROOM] = "left";
    const int warned = fvi_warning_of_memory(method, run, sizeof text, text);
    ck_assert_int_eq(warned, *text != '\0');
    return warned;
}

/* The warning of the tolerance of a run against the rows with the tolerance and without. */
static void check_tolerance(const fvi_method *method, const fvi_run *run)
{
    fvi_run without = *run;
    without.tolerance = 0;
    ck_assert_msg(is_warned_of(method, run) == are_equal(method, run, &without), "%s, memory %d", method->name,
                  (int)run->memory);
}

START_TEST(a_tolerance_that_changes_no_bit_is_warned_of)
{
    for (size_t i = 0; fvi_methods[i]; i++)
        for (fvi_history_kind kind = FVI_HISTORY_AUTO; kind <= FVI_HISTORY_MODES; kind++) {
            fvi_system system;
            fvi_run run = run_of(fvi_methods[i], &system);
            run.memory = kind;
            if (!fvi_method_takes_history(fvi_methods[i], kind))
                continue;
            if (fvi_methods[i]->memories)
                ck_assert(!is_warned_of(fvi_methods[i], &run));
            run.tolerance = looser;
            check_tolerance(fvi_methods[i], &run);
        }
}
END_TEST

START_TEST(modes_that_change_no_bit_are_warned_of)
{
    size_t without_memory = 0;
    for (size_t i = 0; fvi_methods[i]; i++) {
        fvi_system system;
        fvi_run direct = run_of(fvi_methods[i], &system), modes = direct;
        direct.memory = FVI_HISTORY_DIRECT;
        modes.memory = FVI_HISTORY_MODES;
        if (!fvi_method_takes_history(fvi_methods[i], FVI_HISTORY_DIRECT))
            continue;
        ck_assert(!is_warned_of(fvi_methods[i], &direct));
        ck_assert_msg(is_warned_of(fvi_methods[i], &modes) == are_equal(fvi_methods[i], &direct, &modes), "%s",
                      fvi_methods[i]->name);
        without_memory += fvi_methods[i]->memories == 0;
    }
    ck_assert_uint_eq(without_memory, 3); /* lda and the two of Euler */
}
END_TEST

/* 2A near 1 puts the pole of a zener beside the cut: then there are no modes, and AUTO sums directly. */
START_TEST(a_tolerance_is_warned_of_if_no_law_has_modes)
{
    static const fvi_kernel_term with = { .kind = FVI_KERNEL_ZENER, .rho = 0.5, .alpha = 0.3, .time = 2 },
                                 bare = { .kind = FVI_KERNEL_ZENER, .rho = 0.5, .alpha = 0.48, .time = 2 };
    static const fvi_kernel laws[2] = { { 1, &with }, { 1, &bare } };
    static const fvi_method *const methods[] = { &fvi_fractional, &fvi_cq_bdf2, &fvi_cq2_midpoint, &fvi_lobatto_m3 };
    for (size_t i = 0; i < LEN(methods); i++)
        for (size_t l = 0; l < LEN(laws); l++) {
            fvi_system system;
            fvi_run run = run_of(methods[i], &system);
            run.law = &laws[l];
            run.tolerance = looser;
            int has;
            ck_assert_int_eq(fvi_method_has_modes(methods[i], &run, &has), FVI_SUCCESS);
            if (methods[i]->stages && !has)
                continue; /* it takes no such law */
            ck_assert_int_eq(has, l == 0);
            check_tolerance(methods[i], &run);
        }
}
END_TEST

/* The text has the name of the method, and the room for it is the caller's. */
START_TEST(the_text_names_what_has_no_effect)
{
    fvi_system system;
    fvi_run run = run_of(&fvi_lagrange_dalembert, &system);
    char text[FVI_WARNING_ROOM], few[8];
    run.memory = FVI_HISTORY_MODES;
    ck_assert_int_eq(fvi_warning_of_memory(&fvi_lagrange_dalembert, &run, sizeof text, text), 1);
    ck_assert_str_eq(text, "memory exponentials has no effect: lda keeps no memory of the past");
    run.tolerance = 1e-6;
    ck_assert_int_eq(fvi_warning_of_memory(&fvi_lagrange_dalembert, &run, sizeof text, text), 1);
    ck_assert_str_eq(text, "memory exponentials and tolerance 1e-06 have no effect: lda keeps no memory of the past");
    run.memory = FVI_HISTORY_AUTO;
    ck_assert_int_eq(fvi_warning_of_memory(&fvi_variable_step, &run, sizeof text, text), 1);
    ck_assert_str_eq(text, "tolerance 1e-06 has no effect: fvi-adaptive keeps its memory to the error of its steps");
    fvi_method unnamed = fvi_fractional;
    unnamed.name = NULL;
    run.memory = FVI_HISTORY_DIRECT;
    ck_assert_int_eq(fvi_warning_of_memory(&unnamed, &run, sizeof few, few), 1);
    ck_assert_str_eq(few, "toleran");
    ck_assert_int_eq(fvi_warning_of_memory(&unnamed, &run, sizeof text, text), 1);
    ck_assert_str_eq(text, "tolerance 1e-06 has no effect: this method sums the whole past directly here, with "
                           "rounding errors alone");
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("12 memory, what is not read");
    ADD_CASE(suite, "values", a_tolerance_that_changes_no_bit_is_warned_of, modes_that_change_no_bit_are_warned_of,
             a_tolerance_is_warned_of_if_no_law_has_modes, the_text_names_what_has_no_effect);
    return run_suite(suite);
}
