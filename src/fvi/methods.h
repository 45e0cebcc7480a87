/* src/fvi/methods.h -- The table of the methods.      [H 2, 9, 13 and 17] */
#ifndef FVI_METHODS_H
#define FVI_METHODS_H

#include "trajectory.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_methods -- the integrators of damped systems, ended by NULL: fvi_fractional
 * (fvi.h), fvi_lagrange_dalembert, fvi_euler_explicit, fvi_euler_implicit
 * (discrete_mechanics.h), fvi_cq2_shifted, fvi_cq_bdf2 (convolution_quadrature_methods.h),
 * fvi_lobatto_m2 to 8, fvi_lobatto_d2 to 8d (lobatto.h), fvi_variable_step (variable_steps.h),
 * whose steps are its own. `fvi methods` prints it, and
 * all that has to know the methods reads it. Without fvi_midpoint_variational, which refuses
 * damping.
 *
 *     for (size_t i = 0; fvi_methods[i]; i++)
 *         puts(fvi_methods[i]->name); */
extern const fvi_method *const fvi_methods[];

/* fvi_method_find -- the method of the table with this name, as `run --method` takes
 * it ("fvi-shifted"); NULL if there is none, or name is NULL. */
const fvi_method *fvi_method_find(const char *name);

/* fvi_method_has_modes -- can the law of the run, by this method with this step, be summed by
 * decaying modes (FVI_HISTORY_MODES)?
 *
 *   method, run  that fvi_stepper_start takes
 *   has          output: 1 if it can, also without a law; else 0
 *
 * Returns FVI_SUCCESS; FVI_ENOMEM, and then *has says nothing. */
int fvi_method_has_modes(const fvi_method *method, const fvi_run *run, int *has);

/* fvi_run_bytes -- how much memory a run surely takes: its state and its history. The same
 * arguments; nothing is allocated. */
double fvi_run_bytes(const fvi_method *method, const fvi_run *run);

/* fvi_velocity -- v = M^-1 p, d numbers each. Returns FVI_SUCCESS; FVI_EUNSUP with a Lagrangian, of which
 * fvi_velocity_of_momentum (lagrangian.h) has the velocity; or what factorise or solve of
 * the matrices returned. */
int fvi_velocity(const fvi_system *system, const double *p, double *v);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
