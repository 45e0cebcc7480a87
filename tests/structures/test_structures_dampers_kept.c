/* tests/structures/test_structures_dampers_kept.c -- H 27: the histories of several dampers, and the impulses and
 * the work of each.
 * Run alone: make test-structures_dampers_kept */
#include "building.h"
#include "harness/saved.h"
#include "system/larger.h"

enum { N = 300 };

/* ---- copies and files ---- */

static const fvi_method *const kept[] = { &fvi_fractional,   &fvi_cq2_shifted, &fvi_cq_bdf2,
                                          &fvi_cq2_midpoint, &fvi_lobatto_d3,  &fvi_lobatto_d6,
                                          &fvi_variable_step };

/* A copy, and a run from what was saved, go on with the same bits: of several dampers each has
 * a history, and one the impulses of an order above 1. fvi-adaptive does not know what each damper did. */
START_TEST(a_run_with_several_dampers_is_copied_and_saved)
{
    building b;
    build(&b);
    for (size_t i = 0; i < LEN(kept); i++) {
        fvi_stepper *s, *fork, *again;
        double x[D];
        const int tells = !kept[i]->dense;
        const fvi_run run = run_of(&b.system, 0.5, 0.02, N, shape, push);
        OK(fvi_stepper_start(kept[i], &run, &s, NULL));
        OK(fvi_stepper_start(kept[i], &run, &again, NULL));
        ck_assert_int_eq(fvi_stepper_keep_dampers(s), tells ? FVI_SUCCESS : FVI_EUNSUP);
        ck_assert_int_eq(fvi_stepper_keep_dampers(again), tells ? FVI_SUCCESS : FVI_EUNSUP);
        while (s->k < 130)
            OK(fvi_stepper_step(s));
        OK(fvi_stepper_copy(s, &fork));
        save_and_restore(s, again);
        while (s->k < N)
            OK(fvi_stepper_step(s));
        memcpy(x, s->x, sizeof x);
        while (fork->k < N)
            OK(fvi_stepper_step(fork));
        while (again->k < N)
            OK(fvi_stepper_step(again));
        ck_assert_int_eq(memcmp(x, fork->x, sizeof x), 0);
        ck_assert_int_eq(memcmp(x, again->x, sizeof x), 0);
        for (size_t j = 0; tells && j < 3; j++) {
            double J, W, other[2][2];
            OK(fvi_stepper_damper(s, j, &J, &W));
            OK(fvi_stepper_damper(fork, j, other[0], other[0] + 1));
            OK(fvi_stepper_damper(again, j, other[1], other[1] + 1));
            ck_assert(J == other[0][0] && W == other[0][1]);
            ck_assert(J == other[1][0] && W == other[1][1]);
        }
        fvi_stepper_free(s);
        fvi_stepper_free(fork);
        fvi_stepper_free(again);
    }
    free_building(&b);
}
END_TEST

/* ---- energy ---- */

/* The building with orders up to 1, and a matrix for the second damper, so that its impulse is a
 * vector. E of the start is 1. */
static void soften(building *b, fvi_sparse *matrix)
{
    build(b);
    fvi_structure_free(b->structure);
    b->term[1].alpha = 0.4;
    tridiagonal(D, 0.2, -0.1, matrix);
    b->damper[1].matrix = matrix;
    OK(fvi_structure_alloc_dampers(&b->M, &b->K, 3, b->damper, &b->structure, NULL));
    b->system = fvi_structure_system(b->structure);
}

/* p_0 - p_N less what springs and dampers gave. */
static double momentum_left(const fvi_stepper *s, const double *springs)
{
    double J[D], worst = 0, left[D];
    for (size_t i = 0; i < D; i++)
        left[i] = push[i] - s->p[i] - springs[i];
    for (size_t j = 0; j < 3; j++) {
        OK(fvi_stepper_damper(s, j, J, NULL));
        for (size_t i = 0; i < D; i++)
            left[i] -= j == 1                                   ? J[i]
                       : s->run.system->mechanism->damper[j].of.row[i] * J[0];
    }
    for (size_t i = 0; i < D; i++)
        worst = larger(worst, fabs(left[i]));
    return worst;
}

/* Of fvi-stable E + W is what it was at the start, to rounding, with every step: 300 steps of 0.3
 * are beyond the highest frequency. A step rounds E by some u of K x^2, which is E. Of every
 * method springs and dampers give what p loses. Seen: 3e-15 of 300 steps 8 u, 4e-15. */
START_TEST(eq_27_12_energy_and_work_are_what_they_were)
{
    enum { STEPS = 300 };
    fvi_sparse matrix;
    building b;
    soften(&b, &matrix);
    for (size_t i = 0; i < LEN(takers); i++) {
        const int is_stable = takers[i] == &fvi_cq2_midpoint;
        fvi_stepper *s;
        fvi_run run = run_of(&b.system, 0.5, is_stable ? 0.3 : 0.02, STEPS, shape, push);
        double E0, E, W, springs[D] = { 0 }, x[D], worst = 0;
        OK(fvi_stepper_start(takers[i], &run, &s, NULL));
        ck_assert_int_eq(fvi_stepper_damper(s, 0, &W, NULL), FVI_EUNSUP);
        OK(fvi_stepper_keep_dampers(s));
        OK(fvi_energy(&b.system, s->x, s->p, &E0));
        while (s->k < STEPS) {
            double total = 0, g[D];
            memcpy(x, s->x, sizeof x);
            OK(fvi_stepper_step(s));
            for (size_t l = 0; l < D; l++)
                x[l] = (x[l] + s->x[l]) / 2;
            fvi_sparse_multiply(&b.K, x, g);
            for (size_t l = 0; l < D; l++)
                springs[l] += run.h * g[l];
            for (size_t j = 0; j < 3; j++) {
                OK(fvi_stepper_damper(s, j, NULL, &W));
                total += W;
            }
            OK(fvi_energy(&b.system, s->x, s->p, &E));
            worst = larger(worst, fabs(E + total - E0) / E0);
        }
        ck_assert_msg(!is_stable || worst <= STEPS * 8 * U, "%g", worst);
        if (is_stable)
            seen(worst, "of the energy");
        const double left = momentum_left(s, springs);
        seen(left, "of the momentum");
        ck_assert_msg(left <= STEPS * 8 * U, "%s: %g", takers[i]->name, left);
        ck_assert_int_eq(fvi_stepper_damper(s, 3, NULL, &W), FVI_EINVAL);
        ck_assert_int_eq(fvi_stepper_keep_dampers(s), FVI_EINVAL);
        fvi_stepper_free(s);
    }
    fvi_sparse_free(&matrix);
    free_building(&b);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("structures_dampers_kept");
    ADD_CASE(suite, "kept", a_run_with_several_dampers_is_copied_and_saved,
             eq_27_12_energy_and_work_are_what_they_were);
    return run_suite(suite);
}
