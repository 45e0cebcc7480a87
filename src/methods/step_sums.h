/* src/methods/step_sums.h -- The impulse and the work of the dampers and of the force in one step.
 *
 * This header is internal to the library. The observer of a run (fvi/observer.h) adds up these sums. */
#ifndef FVI_STEP_SUMS_H
#define FVI_STEP_SUMS_H

#include "run/step_force.h"
#include "stages/lobatto_weights.h"

#include <fvi/trajectory.h>

/* The state of a stepper before a step, d numbers each: x_k, p_k, and the limit of F(t_k) from above. For a structure
 * with dampers, `dampers` holds d numbers for each damper: its force at the beginning of the step. */
typedef struct {
    double *x, *p, *F, *dampers;
} fvi_step_begin;

/* fvi_step_sums -- The sums of one step, from t_k to t_{k+1}.
 *
 *   damper    the impulse of the damping on each coordinate, d numbers; for a structure with dampers, d numbers for
 *             each damper
 *   work      the work of each damper: its force times the motion, summed as the method sums
 *   by_force  the work of the force, without impulses at nodes */
typedef struct {
    double *damper, *work;
    double by_force;
} fvi_step_sums;

/* fvi_step_forces_at_stages -- Write F at the s stages of step k, d numbers each. At the ends of the step F is the
 * limit from within the step. Return FVI_SUCCESS, or the codes of fvi_finite_step_force. */
int fvi_step_forces_at_stages(const fvi_stepper *s, size_t k, size_t stages,
                              const fvi_lobatto_rule *rule, double *F);

/* fvi_step_dampers -- Return the number of dampers that have a force on each coordinate: the dampers
 * of a structure, else 1. */
size_t fvi_step_dampers(const fvi_system *system);

/* fvi_step_begins -- Record the state before a step. Return FVI_SUCCESS, or the code of the force. */
int fvi_step_begins(const fvi_stepper *s, fvi_step_begin *begin);

/* fvi_step_ends -- Compute the sums of the step that has just been taken, for steps of one length.
 *
 *     damper = impulse of F - grad U, as the method sums it, - (p_{k+1} - p_k)
 *
 *   hit  impulses of the force at t_{k+1}, d numbers
 *
 * For a method with stages the sums run over the stages (17.8), (17.24). Return FVI_SUCCESS, or the code of the
 * force. */
int fvi_step_ends(const fvi_stepper *s, const fvi_step_begin *begin,
                  const double *hit, fvi_step_sums *sums);

/* fvi_step_work_is_known -- Return nonzero if `work` has the order of the method. It has not if the force of the
 * initial history is singular at t = 0 (19.3), because the mean of a force times the mean of a velocity is not the mean
 * of their product. It has not for alpha = 1 either, where the damping is a mass. */
int fvi_step_work_is_known(const fvi_stepper *s);

#endif
