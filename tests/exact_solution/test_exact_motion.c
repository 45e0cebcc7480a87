/* tests/exact_solution/test_exact_motion.c -- H 11: the exact motion of many masses.
 * Run alone: make test-exact_motion */
#include "../structures/building.h"
#include <fvi/exact_motion.h>
#include "../structures/structures_ref.h"
#include "system/larger.h"

#include <complex.h>

/* Three kinds of dampers, against Talbot's inversion in 35 digits; at all times in one call, each alone,
 * and in falling order. max |x| = 0.3, max |v| = 1. Seen: 5e-15. */
START_TEST(eq_11_20_the_building_to_all_digits)
{
    building b;
    build(&b);
    fvi_exact_motion *motion;
    const fvi_exact_problem problem = { .motion = { .system = &b.system },
                                        .x0 = shape,
                                        .p0 = push };
    OK(fvi_exact_motion_alloc(&problem, &motion, NULL));
    double t[LEN(ref_building)], x[LEN(ref_building)][D], v[LEN(ref_building)][D];
    for (size_t i = 0; i < LEN(ref_building); i++)
        t[i] = ref_building[i].t;
    OK(fvi_exact_motion_at(motion, LEN(ref_building), t, *x, *v, NULL));
    for (size_t i = LEN(ref_building); i-- > 0;) {
        double alone[D];
        OK(fvi_exact_motion_at(motion, 1, &t[i], alone, NULL, NULL));
        ck_assert_int_eq(memcmp(alone, x[i], sizeof alone), 0);
        for (size_t l = 0; l < D; l++) {
            seen_worst(fabs(x[i][l] - ref_building[i].x[l]), "of x");
            seen_worst(fabs(v[i][l] - ref_building[i].v[l]), "of v");
            ck_assert_near(x[i][l], ref_building[i].x[l], 1e-13, "x at %g", t[i]);
            ck_assert_near(v[i][l], ref_building[i].v[l], 1e-12, "v at %g", t[i]);
        }
    }
    const double zero = 0;
    OK(fvi_exact_motion_at(motion, 1, &zero, *x, *v, NULL));
    ck_assert(memcmp(*x, shape, sizeof shape) == 0 && memcmp(*v, push, sizeof push) == 0);
    fvi_exact_motion_free(motion);
    pull_down(&b);
}
END_TEST

/* One mass as a system, by alpha and by laws, is the oscillator of fvi_exact_at, with all its forces,
 * to 1e-12 of max |x|, as exact_motion.h says. Seen: 1e-13. */
START_TEST(eq_11_20_one_mass_is_one_oscillator)
{
    static const double alphas[] = { 0.05, 0.3, 0.5, 0.7, 0.95 };
    const double c = 2, m = 1.5, rho = 0.4, x0 = 1, p0 = -0.75;
    const fvi_system system = { .d = 1,
                                .mass = &m,
                                .damping = &rho,
                                .potential = fvi_potential_harmonic(&c) };
    const fvi_kernel_term terms[] = { { FVI_KERNEL_ZENER, 1, 0.3, 2, 0 },
                                      { FVI_KERNEL_MAXWELL, 1, 0, 0.5, 0 } };
    const fvi_kernel law = { 2, terms };
    for (size_t i = 0; i < (LEN(alphas) + 1) * 3; i++) {
        const size_t which = i / 3;
        const fvi_forcing forcing = (fvi_forcing)(i % 3);
        const fvi_kernel *by_law = which == LEN(alphas) ? &law : NULL;
        const double alpha = by_law ? 0.5 : alphas[which];
        const fvi_linear_oscillator one = { .m = m,
                                            .c = c,
                                            .rho = rho,
                                            .alpha = alpha,
                                            .x0 = x0,
                                            .v0 = p0 / m,
                                            .forcing = forcing,
                                            .A = 0.5,
                                            .T = 3,
                                            .w = 1.25,
                                            .law = by_law };
        const fvi_exact_problem problem = {
            .motion = { .system = &system, .alpha = alpha, .law = by_law },
            .x0 = &x0,
            .p0 = &p0,
            .forcing = forcing,
            .A = 0.5,
            .T = 3,
            .w = 1.25
        };
        fvi_exact_motion *motion;
        OK(fvi_exact_motion_alloc(&problem, &motion, NULL));
        for (double t = 1. / 64; t < 300; t *= 1.375) {
            double x, v, X, V;
            OK(fvi_exact_motion_at(motion, 1, &t, &x, &v, NULL));
            OK(fvi_exact_at(&one, 1, &t, &X, &V, NULL));
            seen_worst(fabs(x - X), "of x");
            ck_assert_near(x, X, 1e-12, "case %zu t %g", i, t);
            ck_assert_near(v, V, 1e-12 * (1 + 1 / t), "case %zu v at %g", i, t);
        }
        fvi_exact_motion_free(motion);
    }
}
END_TEST

/* The residue at the pole s_k is A v^2 s_k / (s_k^2 + w^2). With delta = |s_k - i w| an error u w of s_k
 * is u w / delta of the residue, which is w / delta times as large as the sum. One oscillator has no
 * such error in fvi_exact_at. Seen: 0.1 of the bound. */
START_TEST(eq_11_20_digits_are_lost_near_a_resonance)
{
    static const double rhos[] = { 1e-9, 1e-3 };
    const double one = 1, none = 0;
    for (size_t i = 0; i < LEN(rhos); i++)
        for (double beside = 0.1; beside > 1e-8; beside /= 10) {
            const double w = 1 + beside;
            const fvi_system system = { .d = 1, .mass = &one, .damping = &rhos[i],
                                        .potential = fvi_potential_harmonic(&one) };
            const fvi_linear_oscillator body = { .m = 1, .c = 1, .rho = rhos[i], .alpha = 0.25,
                                                 .forcing = FVI_FORCING_COSINE, .A = 1, .w = w };
            const fvi_exact_problem problem = { .motion = { .system = &system, .alpha = 0.25 },
                                                .x0 = &none, .p0 = &none,
                                                .forcing = FVI_FORCING_COSINE, .A = 1, .w = w };
            fvi_exact_motion *motion;
            double re, im, largest = 0, off = 0;
            OK(fvi_exact_pole(&body, &re, &im, NULL));
            OK(fvi_exact_motion_alloc(&problem, &motion, NULL));
            for (double t = 0.75; t < 32; t += 0.75) {
                double x, X;
                OK(fvi_exact_motion_at(motion, 1, &t, &x, NULL, NULL));
                OK(fvi_exact_at(&body, 1, &t, &X, NULL, NULL));
                largest = larger(largest, fabs(X));
                off = larger(off, fabs(x - X));
            }
            const double ratio = w / hypot(re, im - w);
            ck_assert_near(off / largest, 0, 1e-12 + U * ratio * ratio, "w = 1 + %g", beside);
            fvi_exact_motion_free(motion);
        }
}
END_TEST

/* A chain whose masses are damped alike: a run by fvi-lobatto8d, whose errors with these steps are
 * below 1e-11, is the same motion. */
START_TEST(eq_11_20_runs_come_to_the_exact_motion)
{
    enum { n = 4, STEPS = 400 };
    const double cg[] = { 3, 0 }, mass[n] = { 1, 2, 1, 0.5 }, rho[n] = { 0.3, 0, 0.2, 0.4 },
                 x0[n] = { 1, 0, -0.5, 0.25 }, p0[n] = { 0, 1, 0, 0.5 },
                 aw[] = { 0.5, 1.25 }, T = 8;
    fvi_system system = { .d = n,
                          .mass = mass,
                          .damping = rho,
                          .potential = fvi_potential_chain(cg) };
    const fvi_exact_problem problem = { .motion = { .system = &system, .alpha = 0.3 },
                                        .x0 = x0,
                                        .p0 = p0,
                                        .forcing = FVI_FORCING_COSINE,
                                        .A = aw[0],
                                        .w = aw[1] };
    fvi_exact_motion *motion;
    fvi_stepper *s;
    double x[n], v[n];
    OK(fvi_exact_motion_alloc(&problem, &motion, NULL));
    OK(fvi_exact_motion_at(motion, 1, &T, x, v, NULL));
    fvi_exact_motion_free(motion);
    system.force = fvi_force_cosine(aw);
    const fvi_run run = run_of(&system, 0.3, T / STEPS, STEPS, x0, p0);
    OK(fvi_stepper_start(&fvi_lobatto_d8, &run, &s, NULL));
    while (s->k < STEPS)
        OK(fvi_stepper_step(s));
    for (size_t i = 0; i < n; i++) {
        seen_worst(fabs(s->x[i] - x[i]), "apart");
        ck_assert_near(s->x[i], x[i], 1e-11, "x of mass %zu", i);
        ck_assert_near(s->p[i], mass[i] * v[i], 1e-10, "p of mass %zu", i);
    }
    fvi_stepper_free(s);
}
END_TEST

START_TEST(motions_that_have_no_closed_form_are_refused)
{
    const double cg[] = { 1, 0.5 }, negative = -1, one = 1, bad = NAN;
    fvi_system system = { .d = 1,
                          .mass = &one,
                          .damping = &one,
                          .potential = fvi_potential_duffing(cg) };
    fvi_exact_problem problem = { .motion = { .system = &system, .alpha = 0.3 },
                                  .x0 = &one,
                                  .p0 = &one };
    fvi_exact_motion *motion = NULL;
    fvi_error error;
    ck_assert_int_eq(fvi_exact_motion_alloc(&problem, &motion, &error), FVI_EUNSUP);
    ck_assert_str_eq(error.field, "potential");
    system.potential = fvi_potential_harmonic(&negative);
    ck_assert_int_eq(fvi_exact_motion_alloc(&problem, &motion, &error), FVI_EDOM);
    system.potential = fvi_potential_harmonic(&one);
    problem.x0 = &bad;
    ck_assert_int_eq(fvi_exact_motion_alloc(&problem, &motion, &error), FVI_EDOM);
    ck_assert_str_eq(error.field, "x0");
    problem.x0 = &one;
    problem.forcing = FVI_FORCING_STEP;
    problem.T = -1;
    ck_assert_int_eq(fvi_exact_motion_alloc(&problem, &motion, &error), FVI_EDOM);
    ck_assert_str_eq(error.field, "T");
    ck_assert(!motion);
    building b;
    build(&b);
    const fvi_exact_problem several = { .motion = { .system = &b.system },
                                        .x0 = shape,
                                        .p0 = push };
    b.damper[1].past = FVI_INITIAL_HISTORY_CAPUTO; /* of order 1.375 */
    ck_assert_int_eq(fvi_exact_motion_alloc(&several, &motion, &error), FVI_EUNSUP);
    ck_assert(strcmp(error.field, "damper") == 0 && error.index == 1);
    b.damper[1].past = FVI_INITIAL_HISTORY_HELD;
    OK(fvi_exact_motion_alloc(&several, &motion, &error));
    ck_assert_int_eq(fvi_exact_motion_at(motion, 1, &negative, b.row[0], NULL, &error),
                     FVI_EDOM);
    fvi_exact_motion_free(motion);
    pull_down(&b);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("exact_motion");
    ADD_CASE(suite, "motion", eq_11_20_the_building_to_all_digits,
             eq_11_20_one_mass_is_one_oscillator, eq_11_20_digits_are_lost_near_a_resonance,
             eq_11_20_runs_come_to_the_exact_motion,
             motions_that_have_no_closed_form_are_refused);
    return run_suite(suite);
}
