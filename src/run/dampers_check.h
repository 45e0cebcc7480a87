/* src/run/dampers_check.h -- Are these dampers that a structure can have?  [H 27] */
#ifndef FVI_DAMPERS_CHECK_H
#define FVI_DAMPERS_CHECK_H

#include <fvi/error.h>
#include <fvi/trajectory.h>

/* fvi_check_dampers_of_matrices -- the mechanism of a system with matrices, which may be none: are
 * there as many dampers as matrices, each with a kernel and a past that it can have? The start x0
 * of the run is finite.
 *
 * Riemann-Liouville's past is that of one power up to alpha = 1/2, and of every kernel where x0 does
 * not stretch the damper, C_j x0 = 0, or the method is the paper's. Caputo's is that of one power,
 * or of a kernel with no order above 1. Returns FVI_SUCCESS; FVI_EINVAL for a kernel that is
 * none, and where the dampers are not those of the matrices; FVI_EUNSUP for a past, and where
 * the run has a law or a past of its own, which nobody would read. */
int fvi_check_dampers_of_matrices(const fvi_method *method, const fvi_run *run, fvi_error *error);

#endif
