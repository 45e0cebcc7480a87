/* src/variable_step/variable_steps.c -- The method fvi_variable_step, with steps of any length. [H 22]
 *
 * In a step from t_k to t_k + h let v_k = p_k / m and V be the velocities at the s stages of one coordinate. The
 * unknown is delta = V - v_k 1:
 *
 *     [m A^{-1} + rho h^{1-beta} W0] delta + h grad U(X)
 *         = h (F - rho H) - [beta <= 0] rho h^{1-beta} W0 1 v_k,            (22.14)
 *     X = x_k 1 + h c v_k + h A delta,
 *     x_{k+1} = X_s,   v_{k+1} = V_s.
 *
 * H is the history (22.10). x'' at the stages is A^{-1} delta / h, whatever the forces are. The last of its Legendre
 * coefficients estimates the error of the step, and all of them give x and p within the step. For rho = 0, form M has
 * another matrix in place of A (22.15).
 *
 * This file takes a step in two parts. fvi_variable_step_try solves (22.14) for a length that the control
 * proposes (variable_step_control.c), and estimates the error. accept_step makes the last trial the step. In
 * the code v_k is o->v, x_k is o->y, and the sums o->y and o->v keep their rounding errors in o->y_compensation
 * and o->v_compensation. */
#include <fvi/variable_steps.h>

#include "variable_step_events.h"
#include "variable_structure.h"
#include "system/fail.h"
#include "system/larger.h"
#include "system/vectors.h"

#include <gsl/gsl_machine.h>
#include <gsl/gsl_math.h>
#include <string.h>

/* ---- the equation ---- */

static double stage_time(const fvi_variable_step_state *o, size_t i)
{
    return fvi_variable_step_stage_time(o->rule, o->t, o->length.h, i);
}

/* The stages of a coordinate, FVI_LANES numbers, as two vectors of four. The numbers behind the s-th have
 * no meaning. */
#define FOURS(x) ((fvi_four *)(x))

/* In a singular start x is y + G (22.19). So the stages of x begin at base + G, and y feels the residual force. */
static void add_singular_start(fvi_variable_step_state *o)
{
    for (size_t i = 0; i < o->rule->s; i++) {
        const double t = stage_time(o, i);
        for (size_t j = 0; j < o->d; j++) {
            double G, residual_force;
            fvi_singular_at(&o->singular, j, t, &G, NULL, &residual_force);
            o->base[j * FVI_LANES + i] += G;
            o->R[j * FVI_LANES + i] -= o->length.h * residual_force;
        }
    }
}

/* Compute base = x_k + h c v_k. */
FVI_VECTORS static void set_free_motion(fvi_variable_step_state *o)
{
    const fvi_four *c = FOURS(o->rule->c);
    for (size_t j = 0; j < o->d; j++) {
        const double x = o->y[j], move = o->length.h * o->v[j];
        fvi_four *base = FOURS(o->base + j * FVI_LANES);
        base[0] = x + move * c[0];
        base[1] = x + move * c[1];
    }
}

/* Compute base and R = h F, with the terms of a singular start. */
//> apply-forces
static int set_known_forces(fvi_stepper *s, fvi_variable_step_state *o)
{
    const double h = o->length.h;
    set_free_motion(o);
    if (!s->run.system->force.value)
        memset(o->R, 0, o->d * FVI_LANES * sizeof *o->R);
    for (size_t i = 0; i < o->rule->s && s->run.system->force.value; i++) {
        int status = fvi_force_value(s, stage_time(o, i));
        if (status)
            return status;
        for (size_t j = 0; j < o->d; j++)
            o->R[j * FVI_LANES + i] = h * s->F[j];
    }
    if (fvi_singular_is(o, o->t))
        add_singular_start(o);
    return FVI_SUCCESS;
}
//< apply-forces

/* Subtract h rho H of one set of modes from R; modes = NULL: there are none. */
static void subtract_modes(fvi_variable_step_state *o, const fvi_modes *modes)
{
    const double h = o->length.h;
    for (size_t l = 0; modes && l < o->damped; l++) {
        const size_t j = o->index[l];
        const double factor = h * o->group[o->group_of[j]].damping;
        double H[FVI_LANES];
        fvi_modes_history(modes, l, H);
        fvi_four *R = FOURS(o->R + j * FVI_LANES);
        R[0] -= factor * FOURS(H)[0];
        R[1] -= factor * FOURS(H)[1];
    }
}

/* Return the constant part of the velocities of coordinate j in this step, as its memory sees them; delta is the rest.
 * For beta <= 0 the memory takes in v itself, so this is v_k. For beta > 0 it takes in v minus the last velocity of the
 * step before, so this is the jump of v by the impulses at t_k (22.22). */
static inline double constant_velocity(const fvi_variable_step_state *o, size_t j)
{
    return o->beta <= 0 ? o->v[j] : o->impulse_dv[j];
}

//> subtract-history
/* Subtract from R the known part of the damping: h rho H, and rho h^{1-beta} W0 1 times the constant velocity. For
 * beta = -1 the damping is a spring, whose force at x_k takes the place of H. */
FVI_VECTORS static void subtract_history(fvi_variable_step_state *o)
{
    const double h = o->length.h;
    const fvi_four *W1 = FOURS(o->W1);
    for (size_t j = 0; j < o->d; j++) {
        const fvi_coordinate_group *group = &o->group[o->group_of[j]];
        const double present = group->damping_coeff * constant_velocity(o, j),
                     spring = o->beta == -1
                                  ? h * group->damping * (o->y[j] - o->centre[j])
                                  : 0;
        fvi_four *R = FOURS(o->R + j * FVI_LANES);
        R[0] -= present * W1[0] + spring;
        R[1] -= present * W1[1] + spring;
    }
    subtract_modes(o, o->modes);
    subtract_modes(o, o->rising);
}
//< subtract-history

/* ---- trial of a step, and its error ---- */

/* Write the Legendre coefficients of x'' of all coordinates, and estimate the error of the step. If the last
 * coefficient a is small, the polynomial has followed the motion. So the effects of a are taken as the error (22.16):
 *
 *     on X at the stages        h^2 stage a at most
 *     on v, by the memory       h memory_leakage (damping_coeff/m) a
 *     on v, by its quadrature   h alias a, a bound for the coefficients of twice the degree
 *
 * A velocity of 1 moves x by its compliance. Return the largest sum of these effects over all coordinates, or NaN if a
 * coefficient is not finite. */
//> estimate
static double estimate_error(fvi_variable_step_state *o)
{
    const fvi_variable_rule *rule = o->rule;
    const size_t s = rule->s;
    double worst = 0;
    for (size_t j = 0; j < o->d; j++) {
        const fvi_coordinate_group *group = &o->group[o->group_of[j]];
        double *accel_legendre = o->accel_legendre + j * FVI_LANES; /* h times the coefficients */
        fvi_square_apply(s, &rule->legendre, o->delta + j * FVI_LANES, accel_legendre);
        if (!isfinite(accel_legendre[s - 1]))
            return GSL_NAN;
        const double compliance = fvi_variable_step_compliance(o, group),
                     of_x = rule->stage * o->length.h,
                     of_v = o->memory_leakage * group->damping_coeff / group->mass + rule->alias;
        worst = larger(worst, (of_x + compliance * of_v) * fabs(accel_legendre[s - 1]));
    }
    return worst;
}
//< estimate

int fvi_variable_step_try(fvi_stepper *s, fvi_variable_step_state *o, fvi_length length,
                          double *error)
{
    if (o->mechanism)
        return fvi_mesh_try(s, o, length, error);
    if (o->structure)
        return fvi_structure_mesh_try(s, o, length, error);
    int status = fvi_variable_step_matrices(o, length);
    if (status)
        return status;
    if (o->modes)
        fvi_modes_begin(o->modes, length);
    if (o->rising)
        fvi_modes_begin(o->rising, length);
    status = set_known_forces(s, o);
    if (status)
        return status;
    subtract_history(o);
    status = fvi_variable_step_solve(s, o);
    if (!status)
        *error = estimate_error(o);
    return status;
}

/* ---- a step ---- */

/* Write x, p and t of the stepper from y, v and t of the state. */
static int update_stepper(fvi_stepper *s, fvi_variable_step_state *o)
{
    const fvi_matrices *matrices = s->run.system->matrices;
    for (size_t j = 0; j < o->d; j++) {
        double G = 0, slope = 0;
        if (fvi_singular_is(o, o->t))
            fvi_singular_at(&o->singular, j, o->t, &G, &slope, NULL);
        s->x[j] = o->y[j] + G;
        if (!o->mechanism && !o->structure) /* a mechanism has set p, and matrices set it below */
            s->p[j] = s->run.system->mass[j] * (o->v[j] + slope);
        o->scale = larger(o->scale, fabs(s->x[j]));
    }
    s->t = o->t;
    return matrices ? matrices->inertia(o->d, o->v, matrices->params, s->p) : FVI_SUCCESS;
}

/* Compute the velocities v of coordinate j at the stages, as its memory takes them in. */
FVI_VECTORS static void stage_velocities(const fvi_variable_step_state *o, size_t j,
                                         double *v)
{
    const double constant = constant_velocity(o, j);
    const fvi_four *delta = FOURS(o->delta + j * FVI_LANES);
    FOURS(v)[0] = delta[0] + constant;
    FOURS(v)[1] = delta[1] + constant;
}

//> accept-step
/* Advance the modes, and x and v of the state, by the trial. */
static void accept_motion(fvi_variable_step_state *o)
{
    const size_t s = o->rule->s;
    const double h = o->length.h;
    for (size_t l = 0; o->modes && l < o->damped; l++) {
        const size_t j = o->index[l];
        double v[FVI_LANES];
        stage_velocities(o, j, v);
        fvi_modes_advance(o->modes, l, v, o->v[j] - o->impulse_dv[j]);
    }
    for (size_t l = 0; o->rising && l < o->damped; l++) {
        const size_t j = o->index[l]; /* a run with these modes has no impulses */
        fvi_modes_advance(o->rising, l, o->delta + j * FVI_LANES, o->v[j]);
    }
    for (size_t j = 0; j < o->d; j++) {
        double *delta = o->delta + j * FVI_LANES, move[FVI_LANES];
        fvi_square_apply(s, o->to_x, delta, move);
        o->y0[j] = o->y[j];
        o->v0[j] = o->v[j];
        fvi_add_compensated(&o->y[j], &o->y_compensation[j], h * (o->v[j] + move[s - 1]));
        fvi_add_compensated(&o->v[j], &o->v_compensation[j], delta[s - 1]);
    }
}

/* Take the trial as the step, and advance the time. `event` is the time at which the step must end at the latest. If
 * only rounding errors separate the new time from the event, the time is set to that of the event. */
static int accept_step(fvi_stepper *s, fvi_variable_step_state *o, double event)
{
    const double h = o->length.h;
    const int status = o->mechanism   ? fvi_mesh_accept(s, o)
                       : o->structure ? fvi_structure_mesh_advance(o)
                                      : FVI_SUCCESS;
    if (!o->mechanism)
        accept_motion(o);
    memcpy(o->accel_legendre0, o->accel_legendre, o->d * FVI_LANES * sizeof *o->accel_legendre);
    o->t0 = o->t;
    fvi_add_compensated(&o->t, &o->t_compensation, h);
    if (fabs(o->t - event) <= 8 * GSL_DBL_EPSILON * event || o->t > event) {
        o->t = event;
        o->t_compensation = 0;
    }
    o->counts.steps++;
    o->counts.longest = larger(o->counts.longest, h);
    return status;
}
//< accept-step

//> step
static int step(fvi_stepper *s)
{
    fvi_variable_step_state *o = s->method_state;
    const double event = fvi_variable_step_next_event(o);
    o->powers_known = 0; /* the trials of this step overwrite the powers */
    int status = fvi_variable_step_find(s, o, event);
    if (!status)
        status = accept_step(s, o, event);
    if (status)
        return status;
    const int is_singular_part_over = fvi_singular_is(o, o->t0) && !fvi_singular_is(o, o->t);
    if (is_singular_part_over)
        fvi_singular_transfer(o);
    status = fvi_variable_step_apply_impulses(s, o);
    if (status)
        return status;
    o->first_after_event = o->t == event && !is_singular_part_over;
    if (o->first_after_event)
        o->next_exponent = o->first_exponent;
    status = update_stepper(s, o);
    return status || !o->watch ? status : fvi_variable_step_handle_events(s, o);
}
//< step

/* ---- the method ---- */

int fvi_stepper_statistics(const fvi_stepper *s, fvi_step_statistics *counts)
{
    if (!s || !counts)
        FVI_FAIL("null pointer", FVI_EFAULT);
    if (s->method->step != step)
        FVI_FAIL("not a stepper of fvi_variable_step", FVI_EINVAL);
    *counts = ((const fvi_variable_step_state *)s->method_state)->counts;
    return FVI_SUCCESS;
}

const fvi_method fvi_variable_step = {
    .name = "fvi-adaptive",
    .order = "about 10",
    .memory = "full",
    .lowest = 9,
    .highest = 12,
    .alpha_most = 1,
    .takes_laws = 1,
    .takes_mechanism = 1,
    .takes_matrices = 1,
    .scheme = FVI_SCHEME_VARIABLE_STEP,
    .memories = 1u << FVI_HISTORY_AUTO | 1u << FVI_HISTORY_MODES,
    .implicit = 1,
    .start = fvi_variable_step_start,
    .step = step,
    .dense = fvi_variable_step_dense,
    .rows = fvi_variable_step_rows,
    .copy = fvi_variable_step_copy,
    .serialize = fvi_variable_step_archive,
    .stop = fvi_variable_step_stop,
};
