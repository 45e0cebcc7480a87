/* src/run/dampers_check.h -- Check the dampers of a structure before a run. [H 27] */
#ifndef FVI_DAMPERS_CHECK_H
#define FVI_DAMPERS_CHECK_H

#include <fvi/error.h>
#include <fvi/trajectory.h>

/* fvi_check_dampers_of_matrices -- check the mechanism of a system with matrices, which may have no mechanism.
 *
 * The system must have as many dampers as damping matrices, each with a kernel and with a past that the kernel allows.
 * The start x0 of the run is finite.
 *
 * Riemann-Liouville's past is allowed for one power up to alpha = 1/2. It is allowed for every kernel if x0 does not
 * stretch the damper, C_j x0 = 0, or if the method follows the convention of the paper. Caputo's past is allowed for
 * one power, and for a kernel with no order above 1.
 *
 * Returns FVI_SUCCESS; FVI_EINVAL for a kernel or a past that is none, and if the dampers are not those of the
 * matrices; FVI_EUNSUP for a past that the kernel does not allow, for a Lagrangian, a force of velocity or a
 * constraint, and if the run has a law or a past of its own, because no damper would read it; FVI_ENOMEM; what a
 * damping matrix returned. */
int fvi_check_dampers_of_matrices(const fvi_method *method, const fvi_run *run, fvi_error *error);

#endif
