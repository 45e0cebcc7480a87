/* src/methods/initial_history_force.h -- What the past adds to Caputo's damping in a run. [H 19]
 *
 * Internal: what the integrators of H 13 and 17 have in common. */
#ifndef FVI_INITIAL_HISTORY_FORCE_H
#define FVI_INITIAL_HISTORY_FORCE_H

#include <fvi/trajectory.h>

typedef struct {
    fvi_kernel_impulse initial_impulse;
    double
        *size; /* rho A h^(1 + e) of each coordinate, (19.3); NULL: no pull */
} fvi_initial_history_force;

/* fvi_initial_history_force_start -- the pull of a run on a method's nodes.
 *
 *   s     a stepper at k = 0
 *   n, c  the nodes, as fvi_kernel_impulse_prepare has them
 *   pull  output; give pull->size back with free
 *
 * Returns FVI_SUCCESS or FVI_ENOMEM, or what a function of matrices returned; on error
 * pull->size is NULL. */
int fvi_initial_history_force_start(const fvi_stepper *s, size_t n, const double *c,
                   fvi_initial_history_force *history_force);

/* fvi_initial_history_force_of_matrices -- the same with matrices: size is C A h^(1 + e). */
int fvi_initial_history_force_of_matrices(const fvi_stepper *s, size_t n, const double *c,
                         fvi_initial_history_force *history_force);

/* fvi_initial_history_force_copy -- the same again, of d coordinates. Errors as above. */
int fvi_initial_history_force_copy(const fvi_initial_history_force *from, size_t d, fvi_initial_history_force *to);

#endif
