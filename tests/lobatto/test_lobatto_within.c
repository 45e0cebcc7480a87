/* tests/lobatto/test_lobatto_within.c -- H 17: the path within a step is the polynomial of its stages.
 * Run alone: make test-lobatto_within */
#include "harness/ulp.h"

#include <fvi/fvi.h>
#include <fvi/lobatto.h>

enum { STEPS = 5 };
static const double one = 1, zero = 0, x0 = 0.5, p0 = -0.25, h = 0.25;

/* A free mass, and F = (s - 1) (s - 2) t^(s - 3): x = 1/2 - t/4 + t^(s - 1), of degree s - 1. With s stages
 * the velocities of form M have degree s - 2, and F x degree 2 s - 4: Lobatto's rule integrates both
 * exactly, so this motion is the path. In form D the stages of V have it, as V has degree s - 2. */
static int push(double t, size_t d, void *params, double *F)
{
    const double s = (double)*(const size_t *)params;
    (void)d;
    *F = s < 3 ? 0 : (s - 1) * (s - 2) * pow(t, s - 3);
    return 0;
}

static int push_twice(double t, size_t d, void *params, double *F)
{
    const int status = push(t, d, params, F);
    *F *= 2;
    return status;
}

static double motion(size_t s, double t)
{
    return x0 + p0 * t + (s < 3 ? 0 : pow(t, (double)s - 1));
}

static const fvi_method *const methods[] = {
    &fvi_lobatto_m2, &fvi_lobatto_m3, &fvi_lobatto_m4, &fvi_lobatto_m5, &fvi_lobatto_m6, &fvi_lobatto_m7,
    &fvi_lobatto_m8, &fvi_lobatto_d2, &fvi_lobatto_d3, &fvi_lobatto_d4, &fvi_lobatto_d5, &fvi_lobatto_d6,
    &fvi_lobatto_d7, &fvi_lobatto_d8
};

static double velocity(size_t s, double t)
{
    return p0 + (s < 3 ? 0 : ((double)s - 1) * pow(t, (double)s - 2));
}

/* The slope of the path: its weights are up to s (s - 1)/2 = 28 in units of a step of 1/4. */
static void follow(fvi_stepper *s, double m, size_t stages, const char *name, const char *kind)
{
    double x, p;
    while (s->k < STEPS) {
        ck_assert_int_eq(fvi_stepper_step(s), 0);
        for (size_t i = 0; i <= 8; i++) {
            const double t = s->t - h + (double)i / 8 * h;
            ck_assert_int_eq(fvi_lobatto_within(s, t, &x), 0);
            ck_assert_near(x, motion(stages, t), 2000 * U, "%s, %s, t = %g", name, kind, t); /* seen: 700 U */
            ck_assert_int_eq(fvi_lobatto_momentum_within(s, t, &p), 0);
            ck_assert_near(p, m * velocity(stages, t), m * 28 * 4 * 2000 * U, "%s, %s, p at t = %g", name, kind, t);
        }
        ck_assert(fvi_lobatto_within(s, s->t, &x) == 0 && x == s->x[0]);
    }
}

START_TEST(a_polynomial_of_the_stages_degree_is_met_between_the_steps)
{
    fvi_typed_mechanism *typed;
    const fvi_mechanism_texts texts = { .lagrangian = "v^2/2" };
    ck_assert_int_eq(fvi_parse_mechanism(&texts, 1, NULL, &typed, NULL), 0);
    for (size_t i = 0; i < LEN(methods); i++)
        for (int is_mechanism = 0; is_mechanism < 2; is_mechanism++) {
            size_t stages = (size_t)methods[i]->stages;
            fvi_system system = { .d = 1, .mass = &one, .damping = &zero, .force = { .value = push, .params = &stages } };
            if (is_mechanism)
                system.mechanism = fvi_mechanism_typed(typed);
            const fvi_run run = fvi_run_default(&system, &x0, &p0, h, STEPS);
            fvi_stepper *s;
            ck_assert_int_eq(fvi_stepper_start(methods[i], &run, &s, NULL), 0);
            follow(s, 1, stages, methods[i]->name, is_mechanism ? "a Lagrangian" : "a mass");
            fvi_stepper_free(s);
        }
    fvi_typed_mechanism_free(typed);
}
END_TEST

/* M = 2, K = 0, and twice that force: form D alone takes matrices. */
START_TEST(a_structure_has_a_path_between_the_steps_too)
{
    const fvi_triplet two = { 0, 0, 2 }, none = { 0, 0, 0 };
    const double p = 2 * p0;
    fvi_sparse M, K;
    fvi_structure *structure;
    char fault;
    ck_assert(!fvi_sparse_assemble(1, 1, &two, &M) && !fvi_sparse_assemble(1, 1, &none, &K));
    ck_assert_int_eq(fvi_structure_alloc(&M, &K, NULL, &structure, &fault), 0);
    fvi_system system = fvi_structure_system(structure);
    for (size_t i = 7; i < LEN(methods); i++) {
        size_t stages = (size_t)methods[i]->stages;
        fvi_stepper *s;
        system.force = (fvi_force){ .value = push_twice, .params = &stages };
        const fvi_run run = fvi_run_default(&system, &x0, &p, h, STEPS);
        ck_assert_int_eq(fvi_stepper_start(methods[i], &run, &s, NULL), 0);
        follow(s, 2, stages, methods[i]->name, "a matrix");
        fvi_stepper_free(s);
    }
    fvi_structure_free(structure);
    fvi_sparse_free(&M);
    fvi_sparse_free(&K);
}
END_TEST

START_TEST(a_time_beside_the_step_is_refused)
{
    const fvi_system system = { .d = 1, .mass = &one, .damping = &one };
    const fvi_run run = fvi_run_default(&system, &x0, &p0, h, STEPS);
    fvi_stepper *s;
    double x;
    ck_assert_int_eq(fvi_stepper_start(&fvi_lobatto_m3, &run, &s, NULL), 0);
    ck_assert_int_eq(fvi_lobatto_within(s, 0, &x), FVI_EDOM); /* before the first */
    ck_assert(!fvi_stepper_step(s) && !fvi_stepper_step(s));
    ck_assert_int_eq(fvi_lobatto_within(s, 0.2, &x), FVI_EDOM);
    ck_assert_int_eq(fvi_lobatto_within(s, 0.51, &x), FVI_EDOM);
    ck_assert_int_eq(fvi_lobatto_within(s, NAN, &x), FVI_EDOM);
    ck_assert_int_eq(fvi_lobatto_within(s, 0.3, NULL), FVI_EFAULT);
    ck_assert_int_eq(fvi_lobatto_within(NULL, 0.3, &x), FVI_EFAULT);
    ck_assert_int_eq(fvi_lobatto_momentum_within(s, 0.2, &x), FVI_EDOM);
    ck_assert_int_eq(fvi_lobatto_momentum_within(s, 0.3, NULL), FVI_EFAULT);
    fvi_stepper_free(s);
    ck_assert_int_eq(fvi_stepper_start(&fvi_fractional, &run, &s, NULL), 0);
    ck_assert(!fvi_stepper_step(s) && fvi_lobatto_within(s, 0.1, &x) == FVI_EUNSUP);
    fvi_stepper_free(s);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("Lobatto methods: within a step");
    ADD_CASE(suite, "within", a_polynomial_of_the_stages_degree_is_met_between_the_steps,
             a_structure_has_a_path_between_the_steps_too, a_time_beside_the_step_is_refused);
    return run_suite(suite);
}
