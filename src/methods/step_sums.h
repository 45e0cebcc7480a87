/* src/methods/step_sums.h -- What a damper and the force did in one step.
 *
 * Internal to the library: what the observer of a run (fvi/observer.h) adds up. */
#ifndef FVI_STEP_SUMS_H
#define FVI_STEP_SUMS_H

#include "stages/lobatto_weights.h"

#include <fvi/trajectory.h>

/* What stood in a stepper before its step, d numbers each: x_k, p_k, and F(t_k) from above; and of a
 * structure with dampers what each of them gives at the begin of the step, d numbers each. */
typedef struct {
    double *x, *p, *F, *dampers;
} fvi_step_begin;

/* Of one step, from t_k to t_{k+1}:
 *
 *   damper   the impulse of the damping on each coordinate, d numbers; of a structure with dampers of
 *            each of them
 *   work     what each took: its force times the motion, summed as the method sums
 *   by_force what the force gave, without impulses at nodes */
typedef struct {
    double *damper, *work;
    double by_force;
} fvi_step_sums;

/* fvi_step_force -- the force F at a time, d numbers; zeros if there is none. Returns what it returned. */
int fvi_step_force(const fvi_stepper *s, double t, double *F);

/* fvi_step_forces_at_stages -- F at the s stages of step k, d numbers each, from within the step at its
 * ends. Returns what it returned. */
int fvi_step_forces_at_stages(const fvi_stepper *s, size_t k, size_t stages,
                              const fvi_lobatto_rule *rule, double *F);

/* fvi_step_dampers -- how many dampers have a force on each coordinate: those of a structure, or 1. */
size_t fvi_step_dampers(const fvi_system *system);

/* fvi_step_begins -- keep what is asked for later. Returns what the force returned. */
int fvi_step_begins(const fvi_stepper *s, fvi_step_begin *begin);

/* fvi_step_ends -- the sums of the step that has just been taken, by steps of one length.
 *
 *     damper = impulse of F - grad U, as the method sums it, - (p_{k+1} - p_k)
 *
 *   hit   what impulses of the force gave at t_{k+1}, d numbers
 *
 * With stages the sums are of stages (17.8), (17.24). Returns FVI_SUCCESS, or what the force
 * returned. */
int fvi_step_ends(const fvi_stepper *s, const fvi_step_begin *begin,
                  const double *hit, fvi_step_sums *sums);

/* fvi_step_work_is_known -- is `work` of the order of the method? It is not where the initial history has a
 * force that is singular at t = 0, (19.3): there the mean of a force times the mean of a
 * velocity is not their product's. Nor where the damping is a mass, alpha = 1. */
int fvi_step_work_is_known(const fvi_stepper *s);

#endif
