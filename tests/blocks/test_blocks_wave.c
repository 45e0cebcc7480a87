/* tests/blocks/test_blocks_wave.c -- H 28: a mode of a string, compared with one oscillator.
 * Run alone: make test-blocks_wave */
#include <fvi/fvi.h>
#include "harness/ulp.h"

#include <stdlib.h>

enum { POINTS = 199, STEPS = 2000 };
static const double step = 0.5, rho = 0.05, zero = 0, one = 1;

/* Algorithm 3 at kappa = 1 for one oscillator: x_0, ..., x_STEPS from 1 at rest. */
static void oscillator(double c, double alpha, double *x)
{
    const fvi_system system = { .d = 1,
                                .mass = &one,
                                .damping = &rho,
                                .potential = fvi_potential_harmonic(&c) };
    fvi_run run = fvi_run_default(&system, &one, &zero, step, STEPS);
    run.kappa = 1;
    run.alpha = alpha;
    run.memory = FVI_HISTORY_MODES;
    fvi_stepper *s;
    ck_assert_int_eq(fvi_stepper_start(&fvi_fractional, &run, &s,
                                       NULL), FVI_SUCCESS);
    for (x[0] = 1; s->k < STEPS; x[s->k] = s->x[0])
        ck_assert_int_eq(fvi_stepper_step(s), FVI_SUCCESS);
    fvi_stepper_free(s);
}

/* u'' + rho D^{2 alpha} u = second difference of u, ends fixed: from an eigenvector each
 * point is one oscillator. The string's step is written out here and knows nothing of
 * steppers. Its roundings make an error of a few u in p a step, and, the wave being stable,
 * one of a few u / omega in u, omega > 0.04 for the slowest: at worst 100 u STEPS.
 * Roundings go both ways, and 4 u STEPS is demanded, 9e-13. Seen: 0.014 of that. */
START_TEST(eq_28_1_every_point_of_a_wave_is_one_oscillator)
{
    static double u[POINTS + 2], p[POINTS + 2], z[POINTS + 2], dz[POINTS + 2];
    static double u0[POINTS + 2], x[STEPS + 1];
    const double pi = acos(-1);
    for (size_t waves = 3; waves < 200; waves += 49) {
        const double alpha = waves % 2 ? 0.25 : 0.75;
        const double half = sin(pi * (double)waves / (2 * (POINTS + 1)));
        oscillator(4 * half * half, alpha, x);
        fvi_history *m;
        ck_assert_int_eq(fvi_history_alloc(2 * alpha, POINTS, STEPS,
                                          FVI_HISTORY_MODES, 0, &m),
                         FVI_SUCCESS);
        for (size_t i = 0; i < POINTS + 2; i++) {
            u0[i] = sin(pi * (double)(waves * i % (2 * (POINTS + 1)))
                        / (POINTS + 1));
            u[i] = i % (POINTS + 1) ? u0[i] : 0;
            p[i] = z[i] = dz[i] = 0;
        }
        fvi_history_push(m, z + 1, dz + 1, z + 1);
        for (size_t k = 1; k <= STEPS; k++) {
            double left = 0;
            for (size_t i = 1; i <= POINTS; i++) {
                const double here = u[i];
                p[i] -= step * ((here - left) - (u[i + 1] - here));
                u[i] += step * p[i];
                z[i] = u[i] - u0[i];
                dz[i] = u[i] - here;
                left = here;
            }
            fvi_history_push(m, z + 1, dz + 1, z + 1);
            for (size_t i = 1; i <= POINTS; i++) {
                p[i] -= rho * pow(step, 1 - 2 * alpha) * z[i];
                ck_assert_near(u[i], x[k] * u0[i], 4 * U * STEPS,
                               "waves %zu, step %zu, point %zu", waves, k, i);
            }
        }
        fvi_history_free(m);
    }
}
END_TEST

enum { LONG = 4 }; /* in steps of this length a force of DBL_MAX makes p infinite */

/* A force on mass `at` of a chain, the third step's. */
typedef struct {
    size_t at;
    double value;
} blow;

static int struck(double t, size_t d, void *params, double *F)
{
    const blow *b = params;
    for (size_t i = 0; i < d; i++)
        F[i] = i == b->at && t == 3 * LONG ? b->value : 0;
    return 0;
}

/* Eight numbers are looked at together, and the rest, of which six are all, one by one. */
START_TEST(one_number_that_is_not_finite_ends_a_run)
{
    enum { FEW = 3, MASSES = 19 };
    double ones[MASSES], none[MASSES] = { 0 };
    const double cg[] = { 1, 0 }, bad[] = { DBL_MAX, -DBL_MAX };
    for (size_t i = 0; i < MASSES; i++)
        ones[i] = 1;
    for (size_t i = 0; i < 2 * (FEW + MASSES); i++) {
        const size_t d = i < 2 * FEW ? FEW : MASSES,
                     at = i < 2 * FEW ? i : i - 2 * FEW;
        blow b = { at % d, bad[at / d] };
        const fvi_system system = { .d = d,
                                    .mass = ones,
                                    .damping = ones,
                                    .potential = fvi_potential_chain(cg),
                                    .force = { .value = struck,
                                               .params = &b } };
        fvi_run run = fvi_run_default(&system, ones, none, LONG, 8);
        run.kappa = 1;
        fvi_stepper *s;
        ck_assert_int_eq(fvi_stepper_start(&fvi_fractional, &run, &s,
                                           NULL), FVI_SUCCESS);
        ck_assert_int_eq(fvi_stepper_step(s), FVI_SUCCESS);
        ck_assert_int_eq(fvi_stepper_step(s), FVI_SUCCESS);
        ck_assert_int_eq(fvi_stepper_step(s), FVI_EOVRFLW);
        fvi_stepper_free(s);
    }
}
END_TEST

/* Steps of many coordinates go through everything part by part; with one more coordinate,
 * which is not damped, they do not. The oscillators are each by itself, so the digits are
 * the same; orders below and above 1, each past, three parts of which the last is no whole
 * number of tiles, and a force. */
START_TEST(eq_9_4_parts_have_the_digits_of_the_whole)
{
    enum { MANY = 2 * 2048 + 21, FEW = 70 };
    static double mass[MANY + 1], damping[MANY + 1], x0[MANY + 1], p0[MANY + 1];
    const double c = 1.3, aw[] = { 0.5, 2 };
    for (size_t i = 0; i <= MANY; i++) {
        mass[i] = 1 + 0.1 * (double)(i % 7);
        damping[i] = i < MANY ? 0.2 + 0.1 * (double)(i % 5) : 0;
        x0[i] = cos((double)i);
        p0[i] = sin((double)i);
    }
    const fvi_initial_history pasts[] = { FVI_INITIAL_HISTORY_HELD, FVI_INITIAL_HISTORY_CAPUTO,
                               FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE };
    for (size_t n = 0; n < 7; n++) {
        fvi_stepper *s[2];
        for (size_t whole = 0; whole < 2; whole++) {
            fvi_system *system = malloc(sizeof *system); /* which outlives s */
            *system = (fvi_system){ .d = MANY + whole,
                                    .mass = mass,
                                    .damping = damping,
                                    .potential = fvi_potential_harmonic(&c),
                                    .force = fvi_force_cosine(aw) };
            fvi_run run = fvi_run_default(system, x0, p0, 0.1, FEW);
            run.kappa = n < 6 ? 1 : 0.5; /* that has no parts */
            run.alpha = n < 3 ? 0.3 : 0.6;
            run.memory = FVI_HISTORY_MODES;
            run.past = pasts[n % 3];
            ck_assert_int_eq(fvi_stepper_start(&fvi_fractional, &run, &s[whole],
                                               NULL),
                             FVI_SUCCESS);
        }
        while (s[0]->k < FEW) {
            ck_assert_int_eq(fvi_stepper_step(s[0]), FVI_SUCCESS);
            ck_assert_int_eq(fvi_stepper_step(s[1]), FVI_SUCCESS);
            ck_assert_mem_eq(s[0]->x, s[1]->x, MANY * sizeof *x0);
            ck_assert_mem_eq(s[0]->p, s[1]->p, MANY * sizeof *p0);
        }
        for (size_t whole = 0; whole < 2; whole++) {
            free((void *)s[whole]->run.system);
            fvi_stepper_free(s[whole]);
        }
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("28 blocks: a wave");
    ADD_CASE(suite, "runs", eq_28_1_every_point_of_a_wave_is_one_oscillator,
             eq_9_4_parts_have_the_digits_of_the_whole,
             one_number_that_is_not_finite_ends_a_run);
    return run_suite(suite);
}
