/* tests/structures/test_structures_forces.c -- H 27: the forces of several dampers of matrices, with steps of any
 * length and in the first rows.
 * Run alone: make test-structures_forces */
#include "building.h"
#include "harness/saved.h"
#include "structures_ref.h"
#include "system/larger.h"

#include <fvi/observer.h>

static const unsigned ALL = FVI_OBSERVE_FORCE | FVI_OBSERVE_IMPULSE | FVI_OBSERVE_WORK | FVI_OBSERVE_ACCELERATION;

enum { DAMPERS = 3 };

typedef struct {
    fvi_stepper *s;
    fvi_observer *o;
} observed;

static observed begin(const fvi_method *method, const fvi_run *run)
{
    observed w;
    fvi_error error = { 0 };
    OK(fvi_stepper_start(method, run, &w.s, NULL));
    ck_assert_msg(fvi_observer_start(w.s, ALL, &w.o, &error) == 0, "%s", error.text);
    return w;
}

static fvi_observation at(observed w, double t)
{
    fvi_observation now;
    while (w.s->t < t)
        OK(fvi_observer_step(w.o, w.s));
    OK(fvi_observer_read(w.o, w.s, t, &now));
    return now;
}

static void end(observed w)
{
    fvi_observer_free(w.o);
    fvi_stepper_free(w.s);
}

/* ---- steps of any length ---- */

/* Against 25 digits. A force of the order 11/8 of a polynomial of degree s = 8 in a step of length h is at most some
 * (2 s^2 / h)^(11/8) times its error, 1e-12 by a step of 1/10, which is 2e-8: 1e-8; seen 2e-10. Impulses, and the work with the
 * energy, have the error of p, some s^2 / h times that of x: 1e-9; seen 3e-13. */
START_TEST(eq_27_11_the_forces_of_a_building_by_steps_of_its_own)
{
    building b;
    build(&b);
    fvi_run run = run_of(&b.system, 0.5, 1. / 64, 384, shape, push);
    run.step_error = 1e-12;
    observed w = begin(&fvi_variable_step, &run);
    const double E0 = at(w, 0).energy;
    for (size_t i = 0; i < LEN(ref_building_forces); i++) {
        const fvi_observation now = at(w, ref_building_forces[i].t);
        for (size_t j = 0; j < DAMPERS; j++) {
            seen_worst(fabs(now.force[j] - ref_building_forces[i].force[j]), "of forces");
            seen_worst(fabs(now.impulse[j] - ref_building_forces[i].impulse[j]), "of impulses");
            ck_assert_near(now.force[j], ref_building_forces[i].force[j], 1e-8, "force %zu at %g", j, now.t);
            ck_assert_near(now.impulse[j], ref_building_forces[i].impulse[j], 1e-9, "impulse %zu at %g", j, now.t);
        }
        for (size_t l = 0; l < D; l++)
            ck_assert_near(now.a[l], ref_building_forces[i].a[l], 1e-6, "a %zu at %g", l, now.t);
        seen_worst(fabs(now.energy + now.work[0] + now.work[1] + now.work[2] - E0), "of the energy");
        ck_assert_near(now.energy + now.work[0] + now.work[1] + now.work[2], E0, 1e-9, "energy at %g", now.t);
        ck_assert_near(now.balance, E0, 1e-9, "balance at %g", now.t);
    }
    end(w);
    free_building(&b);
}
END_TEST

/* A dashpot below the first storey, whose force at t = 0 is rho v1; and a damper of an order above 1, whose force is infinite:
 * its mean over the first row, the impulse over h. */
START_TEST(the_row_at_the_start_has_forces_or_their_means)
{
    building b;
    build(&b);
    b.term[0].alpha = 0.5;
    fvi_run run = run_of(&b.system, 0.5, 1. / 64, 4, shape, push);
    observed w = begin(&fvi_variable_step, &run);
    const fvi_observation first = at(w, 0);
    const double force[] = { first.force[0], first.force[1] };
    ck_assert(first.is_mean);
    ck_assert_near(force[0], 5 * push[0], 8 * U, "a dashpot");
    ck_assert_near(force[1], at(w, run.h).impulse[1] / run.h, 1e-12 * fabs(force[1]), "a mean");
    end(w);
    free_building(&b);
}
END_TEST

/* ---- the first row by other methods ---- */

/* A damper has the order 11/8 and the start a velocity, so the first row is one of shorter steps, each right to 1e-10 of the
 * way of a row or better: 1e-7 of the largest force, 2.1, and of the largest a, 7.2. Seen: 6e-10. */
START_TEST(the_first_row_of_every_method_is_right)
{
    static const fvi_method *const methods[] = { &fvi_fractional, &fvi_cq2_shifted, &fvi_cq_bdf2,    &fvi_cq2_midpoint,
                                                 &fvi_lobatto_d2, &fvi_lobatto_d4,  &fvi_lobatto_d8, &fvi_variable_step };
    building b;
    build(&b);
    for (size_t n = 0; n < LEN(methods); n++) {
        const fvi_run run = run_of(&b.system, 0.5, 1. / 64, 8, shape, push);
        observed w = begin(methods[n], &run);
        const fvi_observation now = at(w, 1. / 64);
        for (size_t j = 0; j < DAMPERS; j++) {
            seen_worst(fabs(now.force[j] - ref_building_forces[0].force[j]) / 2.1, "of the largest force");
            ck_assert_near(now.force[j], ref_building_forces[0].force[j], 2.1e-7, "%s, %zu", methods[n]->name, j);
        }
        for (size_t l = 0; l < D; l++)
            ck_assert_near(now.a[l], ref_building_forces[0].a[l], 7.2e-7, "%s, a %zu", methods[n]->name, l);
        end(w);
    }
    free_building(&b);
}
END_TEST

/* ---- a copy, and what was saved ---- */

/* Within a step and behind it; the second damper has a matrix, so its forces are five numbers. */
START_TEST(a_copy_and_a_saved_run_tell_the_same_forces)
{
    fvi_sparse C;
    building b;
    build(&b);
    fvi_structure_free(b.structure);
    tridiagonal(D, 0.2, -0.1, &C);
    b.damper[1].matrix = &C;
    OK(fvi_structure_alloc_dampers(&b.M, &b.K, DAMPERS, b.damper, &b.structure, NULL));
    b.system = fvi_structure_system(b.structure);
    const fvi_run run = run_of(&b.system, 0.5, 0.01, 80, shape, push);
    observed first = begin(&fvi_variable_step, &run), copy, loaded = begin(&fvi_variable_step, &run);
    (void)at(first, 0.4);
    saved_state file = begin_saving();
    OK(fvi_stepper_archive(first.s, &file.archive));
    OK(fvi_observer_archive(first.o, &file.archive));
    begin_restoring(&file);
    OK(fvi_stepper_archive(loaded.s, &file.archive));
    OK(fvi_observer_archive(loaded.o, &file.archive));
    free(file.room);
    OK(fvi_stepper_copy(first.s, &copy.s));
    OK(fvi_observer_copy(first.o, &copy.o));
    const observed others[] = { copy, loaded };
    for (size_t i = 0; i < 2; i++)
        for (size_t k = 40; k <= 80; k += 40) {
            const fvi_observation here = at(first, 0.01 * (double)k), there = at(others[i], 0.01 * (double)k);
            for (size_t j = 0; j < D + 2; j++) {
                ck_assert_ulp(there.force[j], here.force[j], 0, "force %zu", j);
                ck_assert_ulp(there.impulse[j], here.impulse[j], 0, "impulse %zu", j);
            }
            for (size_t j = 0; j < DAMPERS; j++)
                ck_assert_ulp(there.work[j], here.work[j], 0, "work %zu", j);
            if (i == 0 && k == 80) {
                end(first);
                first = begin(&fvi_variable_step, &run);
            }
        }
    end(first);
    end(copy);
    end(loaded);
    fvi_sparse_free(&C);
    free_building(&b);
}
END_TEST

/* ---- the work of the force ---- */

static int shake(double t, size_t d, void *params, double *F)
{
    (void)params;
    for (size_t i = 0; i < d; i++)
        F[i] = cos(t + (double)i);
    return 0;
}

/* M is not diagonal, so v is not p / m: beside eight stages, whose work has the order 14. Seen: 1e-14. */
START_TEST(the_work_of_a_force_on_matrices_is_that_of_m_inverse_p)
{
    static const fvi_method *const two[] = { &fvi_variable_step, &fvi_lobatto_d8 };
    double work[2];
    matrices m;
    make_consistent(D, &m);
    m.system.force = (fvi_force){ .value = shake };
    for (size_t n = 0; n < 2; n++) {
        const fvi_run run = run_of(&m.system, 0.3, 1. / 64, 128, shape, push);
        observed w = begin(two[n], &run);
        work[n] = at(w, 2).work_of_force;
        end(w);
    }
    seen(fabs(work[0] - work[1]), "of the work");
    ck_assert(fabs(work[1]) > 0.1);
    ck_assert_near(work[0], work[1], 1e-11, "work");
    drop(&m);
}
END_TEST

/* ---- a damper that does nothing ---- */

/* A damper along a row of zeros has no history. Whether it is the first or the second damper, the work and the impulse of
 * the other one are told under its own number, to the bit. With the numbers of the histories they stood under the first. */
START_TEST(a_damper_without_a_history_keeps_its_number)
{
    static const double nothing[D];
    building b;
    build(&b);
    const double *row = b.damper[0].of.row;
    const fvi_kernel *kernel = b.damper[0].kernel;
    const fvi_damper dampers[2][2] = {
        { { .of = fvi_elongation_row(row), .kernel = kernel }, { .of = fvi_elongation_row(nothing), .kernel = kernel } },
        { { .of = fvi_elongation_row(nothing), .kernel = kernel }, { .of = fvi_elongation_row(row), .kernel = kernel } }
    };
    for (size_t i = 0; i < LEN(takers); i++) {
        fvi_structure *structure[2];
        double work[2], impulse[2];
        for (size_t n = 0; n < 2; n++) {
            OK(fvi_structure_alloc_dampers(&b.M, &b.K, 2, dampers[n], &structure[n], NULL));
            const fvi_system system = fvi_structure_system(structure[n]);
            fvi_run run = run_of(&system, 0.5, 1. / 64, 96, shape, push);
            observed w = begin(takers[i], &run);
            const fvi_observation now = at(w, 1.5);
            work[n] = now.work[n];
            impulse[n] = now.impulse[n];
            ck_assert_msg(now.work[1 - n] == 0 && now.impulse[1 - n] == 0, "%s: %g", takers[i]->name, now.work[1 - n]);
            end(w);
            fvi_structure_free(structure[n]);
        }
        ck_assert_msg(work[0] == work[1] && work[0] > 0, "%s: work %g, %g", takers[i]->name, work[0], work[1]);
        ck_assert_msg(impulse[0] == impulse[1] && impulse[0] != 0, "%s: impulse %g, %g", takers[i]->name, impulse[0], impulse[1]);
    }
    free_building(&b);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("structures_forces");
    ADD_CASE(suite, "any_steps", eq_27_11_the_forces_of_a_building_by_steps_of_its_own,
             the_row_at_the_start_has_forces_or_their_means, a_copy_and_a_saved_run_tell_the_same_forces,
             the_work_of_a_force_on_matrices_is_that_of_m_inverse_p,
             a_damper_without_a_history_keeps_its_number);
    ADD_CASE(suite, "first_row", the_first_row_of_every_method_is_right);
    return run_suite(suite);
}
