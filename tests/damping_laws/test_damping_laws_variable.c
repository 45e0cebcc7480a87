/* tests/damping_laws/test_damping_laws_variable.c -- H 26: steps of any length with every
 * kernel.
 * Run alone: make test-damping_laws_variable */
#include <fvi/dampers.h>
#include <fvi/fvi.h>
#include "run/whole_run.h"
#include "damping_laws_ref.h"
#include "function_of_law.h"
#include "harness/ulp.h"

#include <stdlib.h>
#include <string.h>

static const double one = 1;

static int push(double t, size_t d, void *params, double *F)
{
    (void)t;
    for (size_t j = 0; j < d; j++)
        F[j] = *(const double *)params;
    return 0;
}

/* x of row i of the motions with this law in its place; or the status. */
static int motion(const fvi_kernel *law, size_t i, double *x)
{
    double F = ref_motions[i].force, rows[2];
    const fvi_system system = { 1,      &one,
                                &one,   fvi_potential_harmonic(&one),
                                { .value = push, .params = &F }, NULL, NULL };
    fvi_run run = fvi_run_default(&system, &ref_motions[i].x0,
                                  &ref_motions[i].p0, ref_motions[i].t, 1);
    run.step_error = 1e-14;
    run.law = law;
    const int status =
        fvi_trajectory(&fvi_variable_step, &run, rows, NULL, NULL);
    *x = rows[1];
    return status;
}

/* All laws of the references, from three starts, against the inversion of (26.9) in 40 digits,
 * by their own modes and, where the cut tells all, as functions of s. Where a law grows faster
 * than s a velocity must not jump, and a function has no modes. Seen: see make seen. */
START_TEST(eq_26_18_motions)
{
    size_t ran = 0, refused = 0, functions = 0;
    for (size_t i = 0; i < LEN(ref_motions); i++) {
        const fvi_kernel *law = &ref_laws[ref_motions[i].law];
        const fvi_kernel_function f = function_of_law(law);
        const fvi_kernel by = fvi_kernel_of_function(&f);
        const int steep = fvi_kernel_growth(law) > 1;
        double x;
        if (steep && ref_motions[i].p0 != 0) {
            ck_assert_int_eq(motion(law, i, &x), FVI_EUNSUP);
            refused++;
            continue;
        }
        ck_assert_int_eq(motion(law, i, &x), 0);
        seen(fabs(x - ref_motions[i].x), "of x");
        ck_assert_near(x, ref_motions[i].x, 2e-14, "row %zu", i);
        ran++;
        const int status = motion(&by, i, &x);
        ck_assert_int_eq(status == 0, !steep && !has_a_second_singularity(law)
                                          && law->term->kind
                                                 != FVI_KERNEL_DISTRIBUTED);
        if (status)
            continue;
        ck_assert_near(x, ref_motions[i].x, 1e-11, "row %zu, function", i);
        functions++;
    }
    ck_assert_uint_ge(ran, 60);
    ck_assert_uint_ge(refused, 6);
    ck_assert_uint_ge(functions, 18);
}
END_TEST

/* A chain of three with a Duffing spring, two of its masses damped: against eight stages in
 * 1600 steps. Seen: see make seen. */
START_TEST(eq_26_18_a_chain_that_is_not_linear)
{
    const double mass[] = { 1, 1.5, 0.8 }, rho[] = { 0.5, 0, 1 },
                 x0[] = { 1, -0.5, 0.2 }, p0[] = { 0.3, 0, -0.4 },
                 spring[] = { 3, 1, 0.7 };
    for (size_t l = 0; l < LEN(ref_laws); l++) {
        if (fvi_kernel_growth(&ref_laws[l]) > 1)
            continue;
        const fvi_system system = { 3,   mass, rho, fvi_potential_chain(spring + 1),
                                    { 0 }, NULL, NULL };
        fvi_run run = fvi_run_default(&system, x0, p0, 4. / 1600, 1600);
        double *x = malloc(1601 * 3 * sizeof *x), few[6];
        run.law = &ref_laws[l];
        ck_assert_int_eq(fvi_trajectory(&fvi_lobatto_d8, &run, x, NULL, NULL), 0);
        run.h = 4;
        run.steps = 1;
        run.step_error = 1e-12;
        ck_assert_int_eq(fvi_trajectory(&fvi_variable_step, &run, few, NULL, NULL),
                         0);
        for (size_t j = 0; j < 3; j++) {
            seen(fabs(few[3 + j] - x[4800 + j]), "of x");
            ck_assert_near(few[3 + j], x[4800 + j], 1e-11, "law %zu, %zu", l, j);
        }
        free(x);
    }
}
END_TEST

/* A fork goes on with the same digits, and so does a run that begins again. */
START_TEST(a_fork_goes_on_with_the_same_digits)
{
    const double x0 = 1, p0 = 0;
    const fvi_system system = { 1, &one, &one, fvi_potential_harmonic(&one),
                                { 0 }, NULL, NULL };
    for (size_t l = 0; l < LEN(ref_laws); l++) {
        fvi_run run = fvi_run_default(&system, &x0, &p0, 1, 6);
        fvi_stepper *s, *fork;
        double x[4];
        run.law = &ref_laws[l];
        ck_assert_int_eq(fvi_stepper_start(&fvi_variable_step, &run, &s, NULL), 0);
        ck_assert_int_eq(fvi_stepper_advance_to(s, 3, &x[0], NULL), 0);
        ck_assert_int_eq(fvi_stepper_copy(s, &fork), 0);
        ck_assert_int_eq(fvi_stepper_advance_to(s, 6, &x[1], NULL), 0);
        ck_assert_int_eq(fvi_stepper_free(s), 0);
        ck_assert_int_eq(fvi_stepper_advance_to(fork, 6, &x[2], NULL), 0);
        ck_assert_int_eq(fvi_stepper_reset(fork), 0);
        ck_assert_int_eq(fvi_stepper_advance_to(fork, 6, &x[3], NULL), 0);
        ck_assert_int_eq(fvi_stepper_free(fork), 0);
        ck_assert(x[1] == x[2] && x[1] == x[3]);
    }
}
END_TEST

/* Poles beside the cut make the ladder finer; those too near, or off it, are refused. */
START_TEST(eq_26_18_poles_near_the_cut)
{
    const double x0 = 1, p0 = 0.5, t = 4;
    const fvi_system system = { 1, &one, &one, fvi_potential_harmonic(&one),
                                { 0 }, NULL, NULL };
    for (double alpha = 0.3; alpha < 0.7; alpha += 0.03) {
        const fvi_kernel_term term = { FVI_KERNEL_ZENER, 1, alpha, 0.5, 0 };
        const fvi_kernel law = { 1, &term };
        fvi_run run = fvi_run_default(&system, &x0, &p0, t, 1);
        double x[2], want;
        run.law = &law;
        run.step_error = 1e-13;
        const int status =
            fvi_trajectory(&fvi_variable_step, &run, x, NULL, NULL);
        ck_assert_int_eq(status, alpha < 0.49 ? FVI_SUCCESS : FVI_EUNSUP);
        const fvi_linear_oscillator p = {
            .m = 1, .c = 1, .rho = 1, .x0 = 1, .v0 = 0.5, .law = &law
        };
        ck_assert_int_eq(fvi_exact_at(&p, 1, &t, &want, NULL, NULL), 0);
        if (!status)
            ck_assert_near(x[1], want, 2e-13, "alpha %g", alpha);
    }
}
END_TEST

/* A free body on a damper with this law, from a velocity: x at t = 0.1. */
static double free_body(const fvi_kernel *law)
{
    static const double zero = 0, x0 = 1, p0 = 0.5;
    const fvi_damper damper = { .of = fvi_elongation_row(&one), .kernel = law };
    const fvi_mechanism mechanism = { .damper = &damper, .damper_count = 1 };
    const fvi_system system = { .d = 1,
                                .mass = &one,
                                .damping = &zero,
                                .potential = fvi_potential_harmonic(&zero),
                                .mechanism = &mechanism };
    fvi_run run = fvi_run_default(&system, &x0, &p0, 0.1, 1);
    double x[2];
    run.step_error = 1e-8;
    run.most_steps = 2000;
    ck_assert_int_eq(fvi_trajectory(&fvi_variable_step, &run, x, NULL, NULL), 0);
    return x[1];
}

/* Behind a velocity that jumps an order near 2 asks for steps down to 1e-170, and for modes up to the square of their inverse.
 * Beside another term it is as good as alone: against (26.9) by poles and the cut, a hundred steps of 1e-8 at most, whose
 * errors hardly add up. Seen: 9e-16. */
START_TEST(an_order_near_two_is_as_good_beside_another_term)
{
    static const double alphas[] = { 0.8, 0.9, 0.95, 0.97 };
    static const fvi_kernel_term others[] = { { FVI_KERNEL_POWER, 2, 0.2, 0, 0 },
                                              { FVI_KERNEL_POWER, 1, 0.5, 0, 0 },
                                              { FVI_KERNEL_POWER, 1, 0, 0, 0 },
                                              { FVI_KERNEL_ZENER, 2, 0.2, 1, 0 },
                                              { FVI_KERNEL_MAXWELL, 2, 0, 0.01, 0 },
                                              { FVI_KERNEL_POWER, 1, 0.75, 0, 0 } };
    const double t = 0.1;
    for (size_t i = 0; i < LEN(alphas); i++)
        for (size_t j = 0; j < LEN(others); j++) {
            const fvi_kernel_term terms[] = { { FVI_KERNEL_POWER, 1, alphas[i], 0, 0 }, others[j] };
            const fvi_kernel law = { 2, terms };
            const fvi_linear_oscillator p = { .m = 1, .c = 0, .rho = 1, .x0 = 1, .v0 = 0.5, .law = &law };
            double want;
            ck_assert_int_eq(fvi_exact_at(&p, 1, &t, &want, NULL, NULL), 0);
            const double x = free_body(&law);
            seen_worst(fabs(x - want), "of x");
            ck_assert_near(x, want, 1e-8, "alpha %g, %zu", alphas[i], j);
        }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("damping_laws: variable steps");
    ADD_CASE(suite, "runs", eq_26_18_motions, an_order_near_two_is_as_good_beside_another_term, eq_26_18_a_chain_that_is_not_linear,
             a_fork_goes_on_with_the_same_digits, eq_26_18_poles_near_the_cut);
    return run_suite(suite);
}
