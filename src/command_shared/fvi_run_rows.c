/* src/command_shared/fvi_run_rows.c -- Print the rows of a run, with the columns that an observer provides. */
#include "fvi_run_rows.h"

#include "output/fvi_format.h"
#include "options/fvi_option_columns.h"

#include <fvi/lagrangian.h>
#include <fvi/methods.h>

#include <math.h>
#include <stdlib.h>

static int has_reductions(const fvi_table *t)
{
    return fvi_reductions_count(t->o->typed) > 0;
}

int fvi_run_reduce(const fvi_options *o, const fvi_observation *now)
{
    const int status = fvi_typed_columns_values(o->typed, now, o->typed_row);
    return status ? status : fvi_reductions_add(o->typed, now->t);
}

/* Add the values at a time to the reductions. The time is that of the stepper, or lies within its last step. */
static int reduce_at(fvi_table *t, const fvi_stepper *s, double time)
{
    fvi_observation now;
    const int status = fvi_observer_read(t->observer, s, time, &now);
    return status ? status : fvi_run_reduce(t->o, &now);
}

/* Add the last step to the reductions. It began at the time `begin` with s->k = row. A method that chooses its steps
 * may pass many rows in one step, with a peak among them. Therefore the rows within the step are added, too, except
 * where a row falls on an end of the step. */
static int reduce(fvi_table *t, const fvi_stepper *s, double begin, size_t row)
{
    const double h = t->o->h, least = 1e-6 * h;
    int status = FVI_SUCCESS;
    if (s->method->dense)
        for (size_t k = row + 1; !status && k <= s->k; k++)
            if ((double)k * h > begin + least && (double)k * h < s->t - least)
                status = reduce_at(t, s, (double)k * h);
    return status ? status : reduce_at(t, s, s->t);
}

int fvi_run_observe(fvi_table *t, const fvi_stepper *s, fvi_error *error)
{
    fvi_observer_free(t->observer);
    t->observer = NULL;
    if (fvi_typed_columns_count(t->o->typed) == 0 && !has_reductions(t))
        return FVI_SUCCESS;
    int status = fvi_observer_start(s, fvi_typed_columns_wanted(t->o->typed),
                                    &t->observer, error);
    if (status || !has_reductions(t))
        return status;
    status = reduce_at(t, s, s->t);
    return status ? fvi_fail(error, status, NULL, NAN, "%s", fvi_error_name(status)) : status;
}

int fvi_run_step(fvi_table *t, fvi_stepper *s)
{
    if (!t->observer)
        return fvi_stepper_step(s);
    const double begin = s->t;
    const size_t row = s->k;
    const int status = fvi_observer_step(t->observer, s);
    return !status && has_reductions(t) ? reduce(t, s, begin, row) : status;
}

static int write_row_between_steps(fvi_table *t, fvi_stepper *s, size_t k,
                                   double time)
{
    const size_t d = t->o->d;
    double *x = malloc(2 * d * sizeof *x);
    int status = x ? fvi_stepper_advance_to(s, time, x, x + d) : FVI_ENOMEM;
    if (!status)
        status = fvi_table_take(t, k, x, x + d);
    free(x);
    return status;
}

int fvi_run_row(fvi_table *t, fvi_stepper *s, size_t k)
{
    const double time = (double)k * t->o->h;
    fvi_observation now;
    if (has_reductions(t))
        return FVI_SUCCESS;
    if (!t->observer)
        return s->t == time ? fvi_table_take(t, k, s->x, s->p)
                            : write_row_between_steps(t, s, k, time);
    int status = fvi_observer_read(t->observer, s, time, &now);
    t->now = &now;
    if (!status)
        status = fvi_table_take(t, k, now.x, now.p);
    t->now = NULL;
    return status;
}

int fvi_run_reductions(fvi_table *t)
{
    if (!has_reductions(t))
        return FVI_SUCCESS;
    fvi_table_mark_last(t); /* a longer run has another row of reductions */
    fvi_reductions_values(t->o->typed, t->rows);
    if (!fvi_all_finite(t->width, t->rows))
        return FVI_EOVRFLW;
    fvi_format_row(t->out, t->o->format, 0, t->width, t->rows);
    return FVI_SUCCESS;
}

/* ---- without a stepper ---- */

int fvi_run_state_row(fvi_table *t, size_t k, const double *x, const double *p)
{
    const fvi_observation given = { .x = x, .p = p };
    return fvi_run_observed_row(t, k, &given);
}

int fvi_run_observed_row(fvi_table *t, size_t k, const fvi_observation *given)
{
    const double *x = given->x, *p = given->p;
    const fvi_system *system = t->system;
    const fvi_force *force = &system->force;
    const double time = (double)k * t->o->h;
    if (fvi_typed_columns_count(t->o->typed) == 0 && !has_reductions(t))
        return fvi_table_take(t, k, x, p);
    double *v = calloc(2 * system->d, sizeof *v), *F = v ? v + system->d : NULL;
    fvi_observation now = *given;
    now.t = time;
    now.v = v;
    now.F = F;
    const unsigned wanted = fvi_typed_columns_wanted(t->o->typed);
    int status = v ? FVI_SUCCESS : FVI_ENOMEM;
    if (!status && wanted & FVI_OBSERVE_VELOCITY)
        status = fvi_velocity(system, p, v);
    if (!status && wanted & FVI_OBSERVE_APPLIED && force->value)
        status = force->value(time, system->d, force->params, F);
    if (!status && wanted & FVI_OBSERVE_ENERGY)
        status = fvi_energy_at(system, time, x, p, &now.energy);
    t->now = &now;
    if (!status)
        status = has_reductions(t) ? fvi_run_reduce(t->o, &now) : fvi_table_take(t, k, x, p);
    t->now = NULL;
    free(v);
    return status;
}

int fvi_run_found_row(fvi_table *t, size_t k, const double *x, const double *p,
                      const double *typed)
{
    const size_t d = t->o->d;
    if (has_reductions(t)) /* the reductions were taken during the search */
        return FVI_SUCCESS;
    if (!fvi_options_needs_stepper(t->o))
        return fvi_run_state_row(t, k, x + k * d, p + k * d);
    t->typed = typed + k * fvi_typed_columns_count(t->o->typed);
    const int status = fvi_table_take(t, k, x + k * d, p + k * d);
    t->typed = NULL;
    return status;
}
