/* src/adjoint_forces/adjoint_forces_start.h -- The derivatives of the forces of dampers through the start and the law.
 * [H 23]
 *
 * Internal to the room. In the first rows a force depends on impulses, and also on the jump and the line with which its
 * elongation begins (23.32). The coefficients of all three depend on the numbers of the law. */
#ifndef FVI_ADJOINT_FORCES_START_H
#define FVI_ADJOINT_FORCES_START_H

#include <fvi/adjoint.h>

/* The derivatives of L by the impulses of all rows, N + 1 times n numbers, and by the jump and the line of each of the
 * n numbers. L is the part of J that the forces and impulses of the dampers make. */
typedef struct {
    size_t n;
    double *impulse, *jump, *line;
} fvi_force_shares;

/* fvi_force_start -- add the derivatives through jumps and lines: by x0, p0, masses and dampings, and for a mechanism
 * by parameters and names.
 *
 *   s  a stepper at k = 0
 *
 * Returns FVI_SUCCESS, FVI_ENOMEM, FVI_ESING or what a function of the system returned. */
int fvi_force_start(const fvi_stepper *s, const fvi_force_shares *shares, const fvi_sensitivities *want);
int fvi_force_start_of_mechanism(const fvi_stepper *s, const fvi_force_shares *shares, const fvi_sensitivities *want);

/* fvi_force_numbers -- add the derivatives by alpha, terms, orders, times and ends, if they are wanted, through the
 * coefficients of the first rows and through the lead of (13.18). They are difference quotients of seven points, exact
 * to 1e-9 of the first rows (test_adjoint_force_values.c).
 *
 *   force  dL/df as fvi_adjoint_forces has it, or NULL
 *
 * Cost: a run with an observer, and for each number six or seven starts of a stepper and an observer. For methods of
 * order 2 without a mechanism each start also computes the leads of a damper in all rows, which is a run of one
 * body. */
int fvi_force_numbers(const fvi_method *method, const fvi_run *run, const double *force, const fvi_force_shares *shares,
                      const fvi_sensitivities *want);

#endif
