/* src/sensitivity/adjoint_dampers.h -- The run of a structure with several dampers, backwards.
 *                                                                     [H 23, 27]
 * Internal: as adjoint_multistep.h, which has one damping, and derivatives by its numbers. Here is a
 * list of dampers, and a derivative by a factor of each. The mirrored run has the same matrices and
 * kernels, and what each memory remembers of it is N_j of (23.5). */
#ifndef FVI_ADJOINT_DAMPERS_H
#define FVI_ADJOINT_DAMPERS_H

#include <fvi/adjoint.h>
#include <fvi/dampers.h>

#include "adjoint_constant.h"
#include "methods/initial_history_force.h"
#include "system/linearised.h"

/* Of one damper; where the comment says "each", d numbers. */
typedef struct {
    fvi_run_damper of;          /* of the run that is derived */
    const fvi_damping *damping; /* of the mirrored run; NULL: it remembers nothing */
    double theta, unit;
    int has_drift;              /* the memory of the run knows v_0 */
    fvi_adjoint_constant constant;
    double impulse_size;        /* of a past that acts, else 0 */
    fvi_initial_history_force history_force; /* its impulses for an amplitude of 1 */
    double sum;                 /* sum_k z_k . C N_k */
    double *by_drift;           /* each: sum_k t_k C N_k */
    double *pull;               /* each: impulses of the past times lambda */
    double *CJ;                 /* each: C J_p */
} fvi_adjoint_damper;

typedef struct {
    const fvi_run *run;
    const fvi_sensitivities *want;
    size_t d, count;
    int paper_convention;
    double kappa;
    fvi_damper *held; /* the dampers of the mirrored run; owned */
    fvi_mechanism mechanism;
    fvi_linearised linearised;
    fvi_system system;
    fvi_stepper *stepper;
    fvi_adjoint_damper *each;   /* owned */
    double *Jp, *v0, *right, *by_start, *z, *work, *column; /* each */
    double *block;              /* all of these and of the dampers; owned */
    double by_M, by_K;
} fvi_adjoint_dampers;

/* fvi_adjoint_dampers_check -- FVI_EUNSUP for what is not known of several dampers. */
int fvi_adjoint_dampers_check(const fvi_method *method, const fvi_run *run,
                              const fvi_objective *objective,
                              const fvi_sensitivities *want);

/* fvi_adjoint_dampers_start, _step, _end, _free -- as those of adjoint_multistep.h. */
int fvi_adjoint_dampers_start(const fvi_method *method, const fvi_run *run,
                              const fvi_sensitivities *want, const double *rows,
                              const double *Jp, fvi_adjoint_dampers *m);
int fvi_adjoint_dampers_step(fvi_adjoint_dampers *m, size_t k, const double *rows,
                             const double *Jx);
int fvi_adjoint_dampers_end(fvi_adjoint_dampers *m, const double *Jx);
void fvi_adjoint_dampers_free(fvi_adjoint_dampers *m);

#endif
