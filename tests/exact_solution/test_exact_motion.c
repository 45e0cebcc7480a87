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
    free_building(&b);
}
END_TEST

/* Accelerations, forces and impulses of the building, against the same inversion; max |a| = 27, of the
 * forces 5. At t = 0 the powers are 0 and infinite, and the dashpot of 0.5 has 0.5 times its rate 0.5. */
START_TEST(eq_11_21_accelerations_and_forces_of_the_building)
{
    building b;
    build(&b);
    fvi_exact_motion *motion;
    const fvi_exact_problem problem = { .motion = { .system = &b.system },
                                        .x0 = shape,
                                        .p0 = push };
    OK(fvi_exact_motion_alloc(&problem, &motion, NULL));
    ck_assert_uint_eq(fvi_exact_motion_forces(motion), 3);
    double x[D], v[D], X[D], V[D], a[D], force[3], impulse[3];
    const fvi_exact_outputs out = { x, v, a, force, impulse };
    for (size_t i = 0; i < LEN(ref_building_forces); i++) {
        const double t = ref_building_forces[i].t;
        OK(fvi_exact_motion_forces_at(motion, t, 1, &out, NULL));
        OK(fvi_exact_motion_at(motion, 1, &t, X, V, NULL));
        ck_assert(memcmp(x, X, sizeof x) == 0 && memcmp(v, V, sizeof v) == 0);
        for (size_t l = 0; l < D; l++) {
            seen_worst(fabs(a[l] - ref_building_forces[i].a[l]), "of a");
            ck_assert_near(a[l], ref_building_forces[i].a[l], 1e-12, "a at %g", t);
        }
        for (size_t j = 0; j < 3; j++) {
            seen_worst(fabs(force[j] - ref_building_forces[i].force[j]), "of forces");
            seen_worst(fabs(impulse[j] - ref_building_forces[i].impulse[j]), "of impulses");
            ck_assert_near(force[j], ref_building_forces[i].force[j], 1e-12, "force at %g", t);
            ck_assert_near(impulse[j], ref_building_forces[i].impulse[j], 1e-13, "impulse at %g", t);
        }
    }
    const double first = 0.125;
    OK(fvi_exact_motion_forces_at(motion, first, 1, &out, NULL));
    const double mean = impulse[1] / first;
    OK(fvi_exact_motion_forces_at(motion, 0, first, &out, NULL));
    ck_assert(force[0] == 0 && impulse[1] == 0);
    ck_assert_near(force[1], mean, 8 * U, "the mean of what is infinite");
    ck_assert_near(force[2], 0.5 * 0.5, 2 * U, "the dashpot");
    ck_assert_near(a[4], -100. / 16 - force[2], 64 * U * 10, "a at 0");
    fvi_exact_motion_free(motion);
    free_building(&b);
}
END_TEST

/* One mass, all forces of the oscillator: a is the slope of v, m a + c x + f = F, and J is the slope's integral. As
 * a damping of the masses and as a damper along an elongation that is no row. */
static int tilted(double t, size_t d, const double *x, void *params, double *g)
{
    (void)t, (void)d, (void)params;
    *g = 2 * x[0];
    return 0;
}

static int tilt(double t, size_t d, const double *x, void *params, double *G)
{
    (void)t, (void)d, (void)x, (void)params;
    *G = 2;
    return 0;
}

START_TEST(eq_11_21_forces_keep_the_equation_of_motion)
{
    const double c = 2, m = 1.5, rho = 0.4, none = 0, x0 = 1, p0 = -0.75;
    const fvi_kernel_term term = { FVI_KERNEL_POWER, 0.1, 0.375, 0, 0 };
    const fvi_kernel law = { 1, &term };
    const fvi_damper damper = { .of = { .value = tilted, .gradient = tilt }, .kernel = &law };
    const fvi_mechanism mechanism = { .damper = &damper, .damper_count = 1 };
    for (int i = 0; i < 6; i++) {
        const int is_damper = i % 2;
        const fvi_system system = { .d = 1,
                                    .mass = &m,
                                    .damping = is_damper ? &none : &rho,
                                    .potential = fvi_potential_harmonic(&c),
                                    .mechanism = is_damper ? &mechanism : NULL };
        const fvi_exact_problem problem = {
            .motion = { .system = &system, .alpha = 0.375 }, /* 4 times 0.1 along 2 x is 0.4 along x */
            .x0 = &x0, .p0 = &p0, .forcing = (fvi_forcing)(i / 2), .A = 0.5, .T = 3, .w = 1.25
        };
        fvi_exact_motion *motion;
        OK(fvi_exact_motion_alloc(&problem, &motion, NULL));
        for (double t = 1. / 64; t < 30; t *= 1.375) {
            double x, v, a, force, impulse, late, before, late_x, early_x, J, L;
            const fvi_exact_outputs out = { &x, &v, &a, &force, &impulse },
                                    later = { &late_x, &late, NULL, NULL, &J },
                                    earlier = { &early_x, &before, NULL, NULL, &L };
            const double e = 1e-4 * (t < 1 ? t : 1), factor = is_damper ? 2 : 1;
            OK(fvi_exact_motion_forces_at(motion, t, 1, &out, NULL));
            OK(fvi_exact_motion_forces_at(motion, t + e, 1, &later, NULL));
            OK(fvi_exact_motion_forces_at(motion, t - e, 1, &earlier, NULL));
            if (i / 2 == 1 && fabs(t - 3) < 2 * e)
                continue;
            const double F = i / 2 == 0 ? 0 : i / 2 == 1 ? (t <= 3 ? 0.5 : 0) : 0.5 * cos(1.25 * t);
            ck_assert_near(m * a + c * x + factor * force, F, 16 * U * 4, "case %d t %g", i, t);
            ck_assert_near(a, (late - before) / (2 * e), 1e-6, "case %d: slope of v at %g", i, t);
            ck_assert_near(force, (J - L) / (2 * e), 1e-6, "case %d: slope of J at %g", i, t);
        }
        fvi_exact_motion_free(motion);
    }
}
END_TEST

/* At t = 0 a force of an order above 1 is 0 without a velocity. Of the order 2 it is rho a with (m + rho) a = F - c x,
 * as every method tells it: the damping is a mass. Sums of a few products, 4 u. */
START_TEST(the_first_force_is_its_limit)
{
    const double c = 2, m[] = { 1.5, 0.75 }, rho[] = { 0.5, 0 }, x0[] = { 1, -0.5 };
    for (int i = 0; i < 4; i++) {
        const double p0[] = { i % 2 ? -0.75 : 0, i % 2 ? 0.25 : 0 }, alpha = i < 2 ? 1 : 0.75;
        const fvi_system system = {
            .d = 2, .mass = m, .damping = rho, .potential = fvi_potential_harmonic(&c)
        };
        const fvi_exact_problem problem = { .motion = { .system = &system, .alpha = alpha }, .x0 = x0, .p0 = p0,
                                            .forcing = FVI_FORCING_COSINE, .A = 0.5, .w = 1.25 };
        fvi_exact_motion *motion;
        double x[2], v[2], a[2], force[2], impulse[2];
        const fvi_exact_outputs out = { x, v, a, force, impulse };
        OK(fvi_exact_motion_alloc(&problem, &motion, NULL));
        OK(fvi_exact_motion_forces_at(motion, 0, 0.125, &out, NULL));
        for (int j = 0; j < 2; j++) {
            const double total = 0.5 - c * x0[j], want = total / (m[j] + (alpha == 1 ? rho[j] : 0));
            if (i == 3 && j == 0) {
                ck_assert(fabs(force[j]) > 0.1); /* a mean */
                continue;
            }
            ck_assert_near(a[j], want, 4 * U * fabs(total), "%d, a%d", i, j + 1);
            ck_assert_near(force[j], alpha == 1 ? rho[j] * want : 0, 4 * U * fabs(total), "%d, force%d", i, j + 1);
        }
        fvi_exact_motion_free(motion);
    }
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
    free_building(&b);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("exact_motion");
    ADD_CASE(suite, "motion", eq_11_20_the_building_to_all_digits,
             eq_11_21_accelerations_and_forces_of_the_building,
             eq_11_21_forces_keep_the_equation_of_motion, the_first_force_is_its_limit,
             eq_11_20_one_mass_is_one_oscillator, eq_11_20_digits_are_lost_near_a_resonance,
             eq_11_20_runs_come_to_the_exact_motion,
             motions_that_have_no_closed_form_are_refused);
    return run_suite(suite);
}
