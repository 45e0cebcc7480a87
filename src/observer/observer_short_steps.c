/* src/observer/observer_short_steps.c -- First rows that need steps shorter than those of the run. [H 13, 22] */
#include "observer_state.h"

#include "kernel/kernel_terms.h"
#include "system/larger.h"

#include <fvi/variable_steps.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_STEPS = 1000, MOST_COUPLED = 12 };

/* Without a narrow band all stages of all coordinates are solved for together, which takes some d^3 operations. */
static int is_affordable(const fvi_observer *o, const fvi_system *system)
{
    const size_t band = o->has_mechanism ? 0 : system->potential.diagonals;
    return o->d <= MOST_COUPLED || (band > 0 && band <= MOST_COUPLED);
}

static int is_needed(const fvi_observer *o, const fvi_stepper *s)
{
    const unsigned forces = FVI_OBSERVE_FORCE | FVI_OBSERVE_ACCELERATION | FVI_OBSERVE_MULTIPLIER;
    if (o->wanted & FVI_OBSERVE_OWN_STEPS || s->method->dense || o->matrices || o->is_mass || !(s->method->takes_mechanism || fvi_ramp_method(s))
        || !is_affordable(o, s->run.system))
        return 0;
    if (o->has_massless)
        return (o->wanted & (forces | FVI_OBSERVE_VELOCITY)) != 0;
    int is = 0;
    for (size_t j = 0; j < o->dampers && o->is_damped; j++)
        is |= o->growth[j] > 1;
    for (size_t j = 0; j < o->forces; j++)
        is |= o->is_jumping[j] != 0;
    return is && o->wanted & forces;
}

/* How far x goes in the first step of the run. */
static int measure_step(const fvi_observer *o, const fvi_stepper *s, double *size)
{
    fvi_stepper *copy = NULL;
    int status = fvi_stepper_copy(s, &copy);
    if (!status)
        status = fvi_stepper_step(copy);
    *size = 0;
    for (size_t i = 0; i < o->d && !status; i++)
        *size = larger(*size, fabs(copy->x[i] - s->x[i]));
    fvi_stepper_free(copy);
    return status;
}

/* What the run by short steps has in place of the run's system. */
typedef struct {
    fvi_system system;
    fvi_mechanism mechanism;
    fvi_damper *damper; /* of each damped coordinate, if a law has become a mechanism */
    double *numbers;    /* d times d: their rows; then d: the dampings */
} stand_in;

static void free_stand_in(stand_in *o)
{
    free(o->damper);
    free(o->numbers);
}

/* A law on coordinates as dampers of a mechanism, which know a start velocity above the order 1. */
static int put_law_on_rows(const fvi_kernel *law, stand_in *o)
{
    const size_t d = o->system.d;
    double *none = o->numbers + d * d;
    size_t count = 0;
    for (size_t i = 0; i < d; i++) {
        if (o->system.damping[i] != 0 && o->system.damping[i] != 1)
            return FVI_EUNSUP;
        if (o->system.damping[i] == 0)
            continue;
        o->numbers[count * d + i] = 1;
        o->damper[count] = (fvi_damper){ .of.row = o->numbers + count * d, .kernel = law };
        count++;
    }
    o->mechanism = (fvi_mechanism){ .damper = o->damper, .damper_count = count };
    o->system.mechanism = &o->mechanism;
    o->system.damping = none;
    return FVI_SUCCESS;
}

/* A law above the order 1 takes a start velocity only as an alpha or as dampers of a mechanism. */
static int change_law(fvi_run *run, stand_in *o)
{
    const fvi_kernel *law = run->law;
    const size_t d = o->system.d;
    double *damping;
    run->law = NULL;
    if (!fvi_kernel_is_power(law) && d > MOST_COUPLED)
        return FVI_EUNSUP;
    o->damper = calloc(d, sizeof *o->damper);
    o->numbers = calloc(d * d + d, sizeof *o->numbers);
    if (!o->damper || !o->numbers)
        return FVI_ENOMEM;
    if (!fvi_kernel_is_power(law))
        return put_law_on_rows(law, o);
    damping = o->numbers + d * d;
    for (size_t i = 0; i < d; i++)
        damping[i] = o->system.damping[i] * law->term->rho;
    o->system.damping = damping;
    run->alpha = law->term->alpha;
    return FVI_SUCCESS;
}

static int make_short_run(const fvi_stepper *s, double size, size_t rows, stand_in *o, fvi_run *run)
{
    *run = s->run;
    o->system = *s->run.system;
    run->system = &o->system;
    run->x0 = s->x;
    run->p0 = s->p;
    run->steps = rows;
    run->memory = FVI_HISTORY_AUTO;
    run->step_error = 1e-10 * size;
    run->most_steps = MOST_STEPS;
    run->events = NULL;
    run->event_count = 0;
    return run->law ? change_law(run, o) : FVI_SUCCESS;
}

/* The forces of an observer of the run by short steps. */
static void copy_forces(const fvi_observer *o, const fvi_stepper *s, const double *from, double *force)
{
    const fvi_mechanism *by_row = o->has_mechanism ? NULL : s->run.system->mechanism;
    memcpy(force, from, (by_row ? 0 : o->forces) * sizeof *force);
    for (size_t n = 0; by_row && n < by_row->damper_count; n++)
        for (size_t i = 0; i < o->d; i++)
            force[i] += by_row->damper[n].of.row[i] * from[n];
}

static int read_row(const fvi_observer *o, fvi_observer *from, const fvi_stepper *s, size_t k)
{
    fvi_observation now;
    const size_t f = o->forces, d = o->d;
    double *row = o->short_rows.numbers + (k - 1) * o->short_rows.width;
    const int status = fvi_observer_read(from, s, (double)k * s->run.h, &now);
    if (status)
        return status;
    copy_forces(o, s, now.force, row);
    memcpy(row + f, now.v, d * sizeof *row);
    memcpy(row + f + d, now.a, d * sizeof *row);
    memcpy(row + f + 2 * d, now.multiplier, o->ties * sizeof *row);
    return FVI_SUCCESS;
}

static int take_steps(fvi_observer *o, const fvi_run *run)
{
    const unsigned wanted = FVI_OBSERVE_FORCE | FVI_OBSERVE_VELOCITY | FVI_OBSERVE_ACCELERATION
                            | (o->ties > 0 ? FVI_OBSERVE_MULTIPLIER : 0);
    fvi_stepper *s = NULL;
    fvi_observer *from = NULL;
    int status = fvi_stepper_start(&fvi_variable_step, run, &s, NULL);
    if (!status)
        status = fvi_observer_start(s, wanted, &from, NULL);
    for (size_t k = 1; k <= run->steps && !status; k++) {
        while (!status && s->t < (double)k * run->h)
            status = fvi_observer_step(from, s);
        if (!status)
            status = read_row(o, from, s, k);
        if (!status)
            o->short_rows.rows = k;
    }
    fvi_observer_free(from);
    fvi_stepper_free(s);
    return status;
}

int fvi_short_rows_start(fvi_observer *o, const fvi_stepper *s)
{
    const size_t first = fvi_observer_first_rows(o), rows = first < s->run.steps ? first : s->run.steps;
    fvi_short_rows *to = &o->short_rows;
    stand_in other = { 0 };
    fvi_run run;
    double size;
    if (!is_needed(o, s))
        return FVI_SUCCESS;
    to->width = o->forces + 2 * o->d + o->ties;
    to->numbers = calloc(rows * to->width, sizeof *to->numbers);
    int status = to->numbers ? measure_step(o, s, &size) : FVI_ENOMEM;
    if (!status)
        status = make_short_run(s, size, rows, &other, &run);
    if (!status)
        status = take_steps(o, &run);
    free_stand_in(&other);
    return status == FVI_ENOMEM ? status : FVI_SUCCESS;
}

int fvi_short_rows_copy(const fvi_short_rows *from, fvi_short_rows *to)
{
    const size_t count = from->rows * from->width;
    *to = *from;
    to->numbers = NULL;
    if (!from->numbers)
        return FVI_SUCCESS;
    to->numbers = malloc((count + 1) * sizeof *to->numbers);
    if (!to->numbers)
        return FVI_ENOMEM;
    memcpy(to->numbers, from->numbers, count * sizeof *to->numbers);
    return FVI_SUCCESS;
}

void fvi_short_rows_free(fvi_short_rows *o)
{
    free(o->numbers);
}
