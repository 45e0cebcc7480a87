/* tests/adjoint/loss_of_forces.h -- A number that knows every force and every impulse of the dampers of a run. */
#ifndef LOSS_OF_FORCES_H
#define LOSS_OF_FORCES_H

#include "adjoint_runs.h"

/* a_ki of forces, `of` 0, and b_ki of impulses, `of` 1; as verify/adjoint/adjoint_forces.py has them. */
static inline double weight(size_t k, size_t i, size_t of)
{
    return ((double)((3 * k + 5 * i + 4 * of) % 7) - 3) / 8;
}

/* sum_ki a_ki f_ki + b_ki I_ki^2/2, where all dampers together have `count` forces. Its derivatives by forces and impulses,
 * count numbers a row, go to arrays that may be NULL. */
static inline double loss_of_forces(const fvi_method *method, const fvi_run *run, size_t count, double *force,
                                    double *impulse)
{
    fvi_stepper *s;
    fvi_observer *o;
    fvi_observation now;
    double sum = 0;
    ck_assert_int_eq(fvi_stepper_start(method, run, &s, NULL), FVI_SUCCESS);
    ck_assert_int_eq(fvi_observer_start(s, FVI_OBSERVE_FORCE | FVI_OBSERVE_IMPULSE | FVI_OBSERVE_OWN_STEPS, &o, NULL),
                     FVI_SUCCESS);
    for (size_t k = 0; k <= run->steps; k++) {
        ck_assert_int_eq(fvi_observer_read(o, s, s->t, &now), FVI_SUCCESS);
        for (size_t i = 0; i < count; i++) {
            const double a = weight(k, i, 0), b = weight(k, i, 1);
            sum += a * now.force[i] + b * now.impulse[i] * now.impulse[i] / 2;
            if (force)
                force[k * count + i] = a;
            if (impulse)
                impulse[k * count + i] = b * now.impulse[i];
        }
        if (k < run->steps)
            ck_assert_int_eq(fvi_observer_step(o, s), FVI_SUCCESS);
    }
    fvi_observer_free(o);
    fvi_stepper_free(s);
    return sum;
}

/* Of x and p it knows nothing. */
static inline int nothing(size_t k, size_t d, const double *x, const double *p, void *params, double *Jx, double *Jp)
{
    (void)k, (void)d, (void)x, (void)p, (void)params, (void)Jx, (void)Jp;
    return 0;
}

#endif
