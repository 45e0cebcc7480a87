/* src/parameter_derivatives/wanted_check.h -- Which derivatives by dampers and their laws are not known. [H 23]
 *
 * Internal, for runs that go backwards and for tangents. */
#ifndef FVI_WANTED_CHECK_H
#define FVI_WANTED_CHECK_H

#include <fvi/sensitivity.h>
#include <fvi/trajectory.h>

/* fvi_wanted_check_dampers -- FVI_EUNSUP for what is not known of several dampers. */
int fvi_wanted_check_dampers(const fvi_method *method, const fvi_run *run,
                             const fvi_sensitivities *want);

/* fvi_wanted_check_stage_laws -- FVI_EUNSUP for numbers of the laws of a run, of a chain or a structure, which
 * have no derivative through stages. */
int fvi_wanted_check_stage_laws(const fvi_run *run, const fvi_sensitivities *want);

#endif
