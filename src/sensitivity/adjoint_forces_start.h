/* src/sensitivity/adjoint_forces_start.h -- What the dampers' forces have of the start, and of a law. [H 23]
 *
 * Internal to the room. The coefficients of (23.32) do not only stand before impulses: a force begins with the jump and the
 * line of its elongation, and the numbers of a law stand in the coefficients. */
#ifndef FVI_ADJOINT_FORCES_START_H
#define FVI_ADJOINT_FORCES_START_H

#include <fvi/adjoint.h>

/* dL by the impulses of all rows, N + 1 times n, and by the jump and the line of each number, n. */
typedef struct {
    size_t n;
    double *impulse, *jump, *line;
} fvi_force_shares;

/* fvi_force_start -- add to the derivatives what comes by jumps and lines: by x0, p0, masses, dampings, and of a
 * mechanism by parameters and names.
 *
 *   s  a stepper at k = 0
 *
 * Returns FVI_SUCCESS, FVI_ENOMEM, FVI_ESING or what a function of the system returned. */
int fvi_force_start(const fvi_stepper *s, const fvi_force_shares *shares, const fvi_sensitivities *want);
int fvi_force_start_of_mechanism(const fvi_stepper *s, const fvi_force_shares *shares, const fvi_sensitivities *want);

/* fvi_force_numbers -- add to the derivatives by alpha, terms, orders, times and ends, as far as they are wanted, what
 * comes by the coefficients of the first rows, and by the lead of (13.18): quotients of seven points, exact to 1e-9 of
 * it (seen: see test_adjoint_forces.c).
 *
 *   force  dL/df as fvi_adjoint_forces has it, or NULL
 *
 * Cost: a run, and 12 starts of observers for each number. */
int fvi_force_numbers(const fvi_method *method, const fvi_run *run, const double *force, const fvi_force_shares *shares,
                      const fvi_sensitivities *want);

#endif
