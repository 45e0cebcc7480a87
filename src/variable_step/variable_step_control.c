/* src/variable_step/variable_step_control.c -- Choose the length of the next step by the error of the last. [H 22] */
#include "variable_step_events.h"

#include "mechanism/mechanism_state.h"
#include "system/larger.h"

#include <gsl/gsl_math.h>
#include <math.h>

//> control
/* Return how many rungs of the lattice the next step is longer, or shorter if negative. The error is of order
 * h^{s+1}. */
static int step_change(const fvi_variable_step_state *o, double error)
{
    const double L = fvi_variable_spacing(),
                 order = ((double)o->rule->s + 1) * L;
    const double room = log(o->allowed / error) / order;
    if (error <= o->allowed) { /* (22.17) */
        const double more = floor(0.9 * room - 0.3);
        return more < -1 ? -1 : more < o->growth ? (int)more : o->growth;
    }
    const double less = ceil(log(1.5) / order - room);
    return less < 1                    ? -1
           : less <= FVI_VARIABLE_STEP_LESS ? -(int)less
                                       : -FVI_VARIABLE_STEP_LESS; /* also for NaN */
}
//< control

/* Return the error for the control. If x'' is smooth, the error of a shorter step falls like h^s or faster. If it
 * hardly falls, the force may have a jump that was not declared. The Legendre coefficients of such a jump hardly fall,
 * too, and (22.16) sees about a hundredth of its error. So the error is multiplied by a hundred until the steps have
 * passed this place. */
static double assess_error(fvi_variable_step_state *o, double error, double error_before,
                    double h_before)
{
    if (!o->first_after_event && error_before > 0
        && error > error_before * gsl_pow_4(o->length.h / h_before))
        o->undeclared_jump_until = larger(o->undeclared_jump_until, o->t + h_before);
    return o->t < o->undeclared_jump_until ? 100 * error : error;
}

/* Set the exponent of the next step after an accepted step. If this step was a shorter trial, the next one is not
 * longer. again: nonzero if a longer trial was rejected. */
static void grow_step(fvi_variable_step_state *o, double error, int again)
{
    const int more = step_change(o, error),
              k = fvi_variable_step_exponent(o->length) + (again && more > 0 ? 0 : more);
    o->next_exponent = o->length.k == FVI_OFF_LATTICE && !o->first_after_event
                  ? (int)fmax(o->next_exponent, k) /* an event cut this step short */
                  : k;
    o->steps_since_failure = (o->steps_since_failure + 1) % FVI_VARIABLE_STEP_RETRY;
    if (o->steps_since_failure == 0 && o->longest_solvable < o->longest_exponent)
        o->longest_solvable++;
    o->next_exponent = (int)smaller(o->next_exponent, fmin(o->longest_exponent, o->longest_solvable));
    if (o->first_after_event) /* the next start after an event takes this length */
        o->first_exponent = o->next_exponent;
}

/* Set the exponent of the next trial after a rejected trial: the error was too large or NaN, or the equation was not
 * solved (failed). */
static void shrink_step(fvi_variable_step_state *o, fvi_length length, double error,
                    int failed)
{
    const int now = fvi_variable_step_exponent(length);
    if (failed) {
        o->longest_solvable = now - 1;
        o->steps_since_failure = 0;
    }
    o->next_exponent = (int)fmax(now + (failed ? -2 : step_change(o, error)), o->shortest_exponent);
    o->counts.rejected++;
}

/* Even the shortest step has failed, with this status. If a function is not finite near o->t, say so: the force, if it
 * has no finite bound within the next 1000 of the shortest steps, or a function of a mechanism. Return FVI_EBADFUNC, or
 * else status. */
static int explain_failure(fvi_stepper *s, const fvi_variable_step_state *o, int status)
{
    enum { SHORT_STEPS = 1000 }; /* the steps end that near before a pole */
    const fvi_force *force = &s->run.system->force;
    if (force->bound && !force->bound(o->t, o->t + SHORT_STEPS * o->least, 0, o->d, force->params, o->most_of_force)
        && fvi_check_finite(s, "force", "the force", " on coordinate ", o->t, o->d, o->most_of_force))
        return FVI_EBADFUNC;
    return s->mechanism ? fvi_mechanism_explain(s, status) : status;
}

//> find
/* Try lengths until the error is small enough. */
static int find_length(fvi_stepper *s, fvi_variable_step_state *o, double event)
{
    double found = 0, error = 0, found_before = 0, h_before = 0;
    for (;;) {
        if (fvi_variable_step_runs_away(o, s->run.most_steps))
            return FVI_ERUNAWAY;
        fvi_length length;
        int status = fvi_variable_step_choose(s, o, event, &length);
        if (!status)
            status = fvi_variable_step_try(s, o, length, &found);
        const int failed = status == FVI_EMAXITER || status == FVI_ESING;
        if (status && !failed)
            return status;
        if (!failed)
            error = assess_error(o, found, found_before, h_before);
        if (!failed && error <= o->allowed) {
            grow_step(o, error, h_before > 0);
            return FVI_SUCCESS;
        }
        if (length.h <= o->least)
            return explain_failure(s, o, status              ? status
                                         : gsl_finite(error) ? FVI_EMAXITER
                                                             : FVI_EOVRFLW);
        shrink_step(o, length, error, failed);
        found_before = failed ? 0 : found;
        h_before = length.h;
    }
}

/* A contact that opens at the beginning of the step changes the equation, so the step is tried again. */
int fvi_variable_step_find(fvi_stepper *s, fvi_variable_step_state *o, double event)
{
    int status;
    do {
        status = find_length(s, o, event);
        if (!status && o->watch)
            status = fvi_variable_step_end_at_event(s, o);
    } while (!status && o->watch && o->watch->is_released);
    return status;
}
//< find
