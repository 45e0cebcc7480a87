/* src/parameter_derivatives/wanted_check.h -- Refuse derivatives by dampers and their laws that are not known. [H 23]
 *
 * Internal, for adjoint runs and for tangents. */
#ifndef FVI_WANTED_CHECK_H
#define FVI_WANTED_CHECK_H

#include <fvi/sensitivity.h>
#include <fvi/trajectory.h>

/* fvi_wanted_check_scheme -- check that the derivatives of a method are known: that a method of the library has its
 * scheme, its start and its step. A copy under another name passes. A step of your own is refused, because its
 * derivatives would be those of other equations. Returns FVI_SUCCESS or FVI_EUNSUP. */
int fvi_wanted_check_scheme(const fvi_method *method);

/* fvi_wanted_check_dampers -- check the wanted derivatives of a run with several dampers of matrices. Returns
 * FVI_SUCCESS; FVI_EINVAL if alpha is wanted; FVI_EUNSUP for a derivative that is not known. */
int fvi_wanted_check_dampers(const fvi_method *method, const fvi_run *run,
                             const fvi_sensitivities *want);

/* fvi_wanted_check_stage_laws -- check the wanted numbers of the laws of a run, of a chain or a structure, with stages.
 * Returns FVI_SUCCESS, or FVI_EUNSUP for a structure with a law that grows faster than s. */
int fvi_wanted_check_stage_laws(const fvi_run *run, const fvi_sensitivities *want);

#endif
