/* src/methods/initial_history_force.h -- What the past adds to Caputo's damping in a run. [H 19]
 *
 * Internal: what the integrators of H 13 and 17 have in common. */
#ifndef FVI_INITIAL_HISTORY_FORCE_H
#define FVI_INITIAL_HISTORY_FORCE_H

#include "damping.h"
#include "kernel/kernel_impulses.h"

/* Of one damper. */
typedef struct {
    fvi_kernel_impulse initial_impulse;  /* of a power; */
    fvi_impulses_of_kernel *of_law;      /* of a law; NULL: a power. Owned */
    double *size; /* each: what stands before the impulses, rho A h^(1 + e) of a power and A of
                   * a law, (19.3); NULL: no force. Owned */
} fvi_initial_history_force;

/* fvi_initial_history_force_start -- what the past of a damper does at a method's nodes.
 *
 *   s      a stepper at k = 0
 *   n, c   the nodes, as fvi_kernel_impulse_prepare has them; two are the ends of a step
 *   force  output; give it back with fvi_initial_history_force_stop, also after an error
 *
 * Returns FVI_SUCCESS or FVI_ENOMEM, or what a function of matrices returned. */
int fvi_initial_history_force_start(const fvi_stepper *s, const fvi_run_damper *damper,
                                    size_t n, const double *c,
                                    fvi_initial_history_force *force);

/* fvi_initial_history_force_prepare -- the impulses for an amplitude of 1, with no size.
 *
 *   h      length of a step
 *   n, c   as above
 *   force  zeroed before; give it back as above
 *   unit   output: h^(1 + e) of a power, 1 of a law; an impulse is unit rho A times what
 *          fvi_initial_history_force_impulses writes
 *
 * Returns FVI_SUCCESS or FVI_ENOMEM. */
int fvi_initial_history_force_prepare(const fvi_run_damper *damper, double h, size_t n,
                                      const double *c, fvi_initial_history_force *force,
                                      double *unit);

/* fvi_initial_history_amplitudes -- A of (19.3) of all coordinates, d numbers that are 0 before.
 * Returns FVI_SUCCESS, or what a function of matrices returned. */
int fvi_initial_history_amplitudes(const fvi_system *system,
                                   const fvi_run_damper *damper, const double *x0,
                                   const double *p0, double *A);

/* fvi_initial_history_force_impulses -- what stands behind `size` at the nodes of step k. */
void fvi_initial_history_force_impulses(const fvi_initial_history_force *force, size_t k,
                                        double *impulse);

/* fvi_initial_history_force_copy -- the same again, of d coordinates. Errors as above. */
int fvi_initial_history_force_copy(const fvi_initial_history_force *from, size_t d,
                                   fvi_initial_history_force *to);

/* fvi_initial_history_force_stop -- give the arrays back. */
void fvi_initial_history_force_stop(fvi_initial_history_force *force);

#endif
