/* src/fvi/methods.h -- The table of all methods, and questions about a method and a run.      [H 2, 9, 13 and 17] */
#ifndef FVI_METHODS_H
#define FVI_METHODS_H

#include "trajectory.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_methods -- the integrators of damped systems, ended by NULL:
 *
 *     fvi_fractional                                                       fvi.h
 *     fvi_lagrange_dalembert, fvi_euler_explicit, fvi_euler_implicit       discrete_mechanics.h
 *     fvi_cq2_shifted, fvi_cq_bdf2, fvi_cq2_midpoint                       convolution_quadrature_methods.h
 *     fvi_lobatto_m2 to fvi_lobatto_m8, fvi_lobatto_d2 to fvi_lobatto_d8   lobatto.h
 *     fvi_variable_step, which chooses its own steps                       variable_steps.h
 *
 * The table does not contain fvi_midpoint_variational, because that method refuses damping. `fvi methods` prints the
 * table, and every part of the library and the program that must know all methods reads it.
 *
 *     for (size_t i = 0; fvi_methods[i]; i++)
 *         puts(fvi_methods[i]->name); */
extern const fvi_method *const fvi_methods[];

/* fvi_method_find -- Return the method of the table with this name; NULL if there is none, or if name is NULL. The
 * names are those of the program's option `run --method`, for example "fvi-shifted". */
const fvi_method *fvi_method_find(const char *name);

/* fvi_method_has_modes -- Find out whether a run of this method can sum its history by decaying modes
 * (FVI_HISTORY_MODES, memory.h). That depends on the laws of damping and on the step.
 *
 *   method, run  a method and a run that fvi_stepper_start takes
 *   has          output: 1 if all laws of the run have modes, also if the run has no law; else 0
 *
 * Returns FVI_SUCCESS; FVI_ENOMEM: *has is then not determined. */
int fvi_method_has_modes(const fvi_method *method, const fvi_run *run, int *has);

/* fvi_run_bytes -- Return a lower bound for the bytes that a run takes for its state and its history. The arguments
 * are a method and a run that fvi_stepper_start takes. Nothing is allocated. */
double fvi_run_bytes(const fvi_method *method, const fvi_run *run);

/* fvi_velocity -- Compute v = M^-1 p, d numbers each.
 *
 * A coordinate without inertia has no such velocity: its v is not finite. Cost O(d); with matrices one factorisation
 * of M and one solution in every call.
 * Returns FVI_SUCCESS; FVI_EUNSUP with a Lagrangian, for which fvi_velocity_of_momentum (lagrangian.h) computes the
 * velocity; or what factorise or solve of the matrices returned. */
int fvi_velocity(const fvi_system *system, const double *p, double *v);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
