/* tests/structures/test_structures_one_unknown.c -- H 27: a structure with one unknown has dampers of two kinds, and
 * the forces of both are one number.
 * Run alone: make test-structures_one_unknown */
#include "structures_runs.h"

#include "adjoint/loss_of_forces.h"
#include "system/larger.h"

#include <fvi/observer.h>

/* A body with a damper of the matrix (1/2) and one along the row (2). The number of unknowns is 1; or 2, and then the
 * second unknown has a mass and a spring alone, and stays at rest. */
typedef struct {
    fvi_kernel_term term[2];
    fvi_kernel kernel[2];
    fvi_damper damper[2];
    fvi_sparse M, K, C;
    fvi_structure *structure;
    fvi_system system;
    fvi_run run;
} one_body;

enum { ROWS = 12 };

static void diagonal(int unknowns, double first, double second, fvi_sparse *A)
{
    const fvi_triplet list[] = { { 0, 0, first }, { 1, 1, second } };
    OK(fvi_sparse_assemble((size_t)unknowns, (size_t)unknowns, list, A));
}

static void make_body(int unknowns, one_body *b)
{
    static const double row[] = { 2, 0 }, x0[] = { 0.75, 0 }, p0[] = { -0.5, 0 };
    *b = (one_body){ .term = { { FVI_KERNEL_POWER, 0.5, 0.375, 0, 0 }, { FVI_KERNEL_POWER, 0.25, 0.3, 0, 0 } } };
    for (size_t j = 0; j < 2; j++) {
        b->kernel[j] = (fvi_kernel){ 1, b->term + j };
        b->damper[j].kernel = b->kernel + j;
    }
    diagonal(unknowns, 1.5, 1, &b->M);
    diagonal(unknowns, 3, 1, &b->K);
    diagonal(unknowns, 0.5, 0, &b->C);
    b->damper[0].matrix = &b->C;
    b->damper[1].of = fvi_elongation_row(row);
    OK(fvi_structure_alloc_dampers(&b->M, &b->K, 2, b->damper, &b->structure, NULL));
    b->system = fvi_structure_system(b->structure);
    b->run = run_of(&b->system, 0.5, 1. / 16, ROWS, x0, p0);
}

static void free_body(one_body *b)
{
    fvi_structure_free(b->structure);
    fvi_sparse_free(&b->M);
    fvi_sparse_free(&b->K);
    fvi_sparse_free(&b->C);
}

static const fvi_method *const methods[] = { &fvi_fractional, &fvi_cq2_shifted, &fvi_cq_bdf2,      &fvi_cq2_midpoint,
                                             &fvi_lobatto_d2, &fvi_lobatto_d3,  &fvi_variable_step };

/* Write force, impulse and work of both dampers at the last row: six numbers. */
static void observe(const fvi_method *method, int unknowns, double *to)
{
    const size_t row = (size_t)unknowns; /* the place of the second damper's force */
    one_body b;
    fvi_stepper *s;
    fvi_observer *o;
    fvi_observation now;
    make_body(unknowns, &b);
    OK(fvi_stepper_start(method, &b.run, &s, NULL));
    OK(fvi_observer_start(s, FVI_OBSERVE_FORCE | FVI_OBSERVE_IMPULSE | FVI_OBSERVE_WORK, &o, NULL));
    while (s->t < ROWS * b.run.h)
        OK(fvi_observer_step(o, s));
    OK(fvi_observer_read(o, s, ROWS * b.run.h, &now));
    const double told[] = { now.force[0], now.force[row], now.impulse[0], now.impulse[row], now.work[0], now.work[1] };
    memcpy(to, told, sizeof told);
    fvi_observer_free(o);
    fvi_stepper_free(s);
    free_body(&b);
}

/* Compare n numbers of one body with those beside a second body. A number that is nearly 0 would test nothing. */
static void ck_assert_same(const fvi_method *method, size_t n, const double *one, const double *two, double tolerance,
                           const char *what)
{
    for (size_t i = 0; i < n; i++) {
        seen_worst(fabs(one[i] - two[i]), what);
        ck_assert(fabs(two[i]) > 1e-3);
        ck_assert_near(one[i], two[i], tolerance, "%s, %zu", method->name, i);
    }
}

/* The forces of a body are the same beside a second body that rests, up to roundings: 1e-12 of 1. Seen: 1.8e-15. */
START_TEST(a_structure_with_one_unknown_has_the_forces_of_both_kinds_of_dampers)
{
    for (size_t n = 0; n < LEN(methods); n++) {
        double one[6], two[6];
        observe(methods[n], 1, one);
        observe(methods[n], 2, two);
        ck_assert_same(methods[n], 6, one, two, 1e-12, "of a second body");
    }
}
END_TEST

/* The derivatives of a sum of forces by the numbers of the two laws: factors, then orders. */
static void differentiate(const fvi_method *method, int unknowns, double by[4])
{
    const size_t count = 1 + (size_t)unknowns;
    double force[(ROWS + 1) * 3] = { 0 };
    one_body b;
    make_body(unknowns, &b);
    for (size_t k = 0; k <= ROWS; k++) {
        force[k * count] = weight(k, 0, 0);
        force[k * count + count - 1] = weight(k, 1, 0);
    }
    const fvi_objective J = { .slopes = nothing };
    const fvi_sensitivities want = { .terms = by, .orders = by + 2 };
    OK(fvi_adjoint_forces(method, &b.run, &J, force, NULL, &want));
    free_body(&b);
}

/* The same for derivatives of forces. They contain quotients, and roundings of the forces are divided by their steps:
 * 1e-9. Seen: 1.1e-13. */
START_TEST(eq_23_32_the_forces_of_one_unknown_have_the_derivatives_of_both_kinds_of_dampers)
{
    for (size_t n = 0; n + 1 < LEN(methods); n++) { /* fvi-adaptive has no such derivatives */
        double one[4], two[4];
        differentiate(methods[n], 1, one);
        differentiate(methods[n], 2, two);
        ck_assert_same(methods[n], 4, one, two, 1e-9, "of derivatives");
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("structures_one_unknown");
    ADD_CASE(suite, "one_unknown", a_structure_with_one_unknown_has_the_forces_of_both_kinds_of_dampers,
             eq_23_32_the_forces_of_one_unknown_have_the_derivatives_of_both_kinds_of_dampers);
    return run_suite(suite);
}
