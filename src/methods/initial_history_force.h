/* src/methods/initial_history_force.h -- The force of the initial history in a run.  [H 19]
 *
 * This header is internal. The integrators of H 13 and H 17 use it. The force is the difference between the damping
 * with another past and Caputo's damping, (19.3). */
#ifndef FVI_INITIAL_HISTORY_FORCE_H
#define FVI_INITIAL_HISTORY_FORCE_H

#include "damping.h"
#include "kernel/kernel_impulses.h"

/* The initial-history force of one damper. */
typedef struct {
    fvi_kernel_impulse initial_impulse;  /* the impulses of a power */
    fvi_impulses_of_kernel *of_law;      /* the impulses of a law; NULL for a power; owned */
    /* d factors of the impulses: rho A h^(1 + e) for a power, A for a law (19.3); NULL if there is no force; owned */
    double *size;
} fvi_initial_history_force;

/* fvi_initial_history_force_start -- Prepare the force of the past of a damper at the nodes of a method.
 *
 *   s      a stepper at k = 0
 *   n, c   the nodes of fvi_kernel_impulse_prepare; two nodes are the ends of a step
 *   force  output; free it with fvi_initial_history_force_stop, also after an error
 *
 * Return FVI_SUCCESS; FVI_ENOMEM; or the code of a function of the matrices. */
int fvi_initial_history_force_start(const fvi_stepper *s, const fvi_run_damper *damper,
                                    size_t n, const double *c,
                                    fvi_initial_history_force *force);

/* fvi_initial_history_force_prepare -- Prepare the impulses for the amplitude 1, without `size`.
 *
 *   h      step length
 *   n, c   as for fvi_initial_history_force_start
 *   force  zeroed by the caller; free it with fvi_initial_history_force_stop
 *   unit   output: h^(1 + e) for a power, 1 for a law. An impulse is unit rho A times the output of
 *          fvi_initial_history_force_impulses
 *
 * Return FVI_SUCCESS or FVI_ENOMEM. */
int fvi_initial_history_force_prepare(const fvi_run_damper *damper, double h, size_t n,
                                      const double *c, fvi_initial_history_force *force,
                                      double *unit);

/* fvi_initial_history_amplitudes -- Write A of (19.3) of all coordinates to A, d numbers that the caller has set to
 * zero. Return FVI_SUCCESS, or the code of a function of the matrices. */
int fvi_initial_history_amplitudes(const fvi_system *system,
                                   const fvi_run_damper *damper, const double *x0,
                                   const double *p0, double *A);

/* fvi_initial_history_force_impulses -- Write the impulses at the nodes of step k to impulse,
 * without the factor `size`. */
void fvi_initial_history_force_impulses(const fvi_initial_history_force *force, size_t k,
                                        double *impulse);

/* fvi_initial_history_force_copy -- Copy the force of d coordinates. Return FVI_SUCCESS or FVI_ENOMEM. After an error
 * the caller must free `to`. */
int fvi_initial_history_force_copy(const fvi_initial_history_force *from, size_t d,
                                   fvi_initial_history_force *to);

/* fvi_initial_history_force_stop -- Free the arrays of the force. */
void fvi_initial_history_force_stop(fvi_initial_history_force *force);

#endif
