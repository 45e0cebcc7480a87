/* src/observer/observer_short_steps.c -- First rows that need steps shorter than the steps of the run. [H 13, 22] */
#include "observer_state.h"

#include "kernel/kernel_terms.h"
#include "run/run_damper.h"
#include "system/larger.h"
#include "variable_step/variable_step.h"

#include <fvi/variable_steps.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_STEPS = 1000, MOST_COUPLED = 12, MOST_UNKNOWNS = 200 };

/* Without a narrow band all stages of all coordinates are solved together, which takes some d^3 operations; and
 * matrices need factors of their own for each length of a step. */
static int is_affordable(const fvi_observer *o, const fvi_system *system)
{
    const size_t band = o->has_mechanism ? 0 : system->potential.diagonals;
    return o->matrices ? o->d <= MOST_UNKNOWNS : o->d <= MOST_COUPLED || (band > 0 && band <= MOST_COUPLED);
}

static int is_possible(const fvi_observer *o, const fvi_stepper *s)
{
    return !s->method->dense && (s->method->takes_mechanism || fvi_ramp_method(s))
           && !o->is_mass && is_affordable(o, s->run.system);
}

static int is_needed(const fvi_observer *o, const fvi_stepper *s)
{
    const unsigned forces = FVI_OBSERVE_FORCE | FVI_OBSERVE_ACCELERATION | FVI_OBSERVE_MULTIPLIER;
    if (o->wanted & FVI_OBSERVE_OWN_STEPS || !is_possible(o, s))
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

/* How far x moves in the first step of the run. */
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

/* The system that the run by short steps has instead of the run's own. */
typedef struct {
    fvi_system system;
    fvi_mechanism mechanism;
    fvi_damper *damper; /* one for each damped coordinate, if its law becomes dampers of a mechanism; else NULL */
    double *row;        /* d times d: the rows of coordinates; then d dampings */
} replacement;

static void free_replacement(replacement *o)
{
    free(o->damper);
    free(o->row);
}

/* Make a law on coordinates into dampers of a mechanism, which allow a start velocity above the order 1. */
static int replace_law_by_dampers(const fvi_kernel *law, replacement *o)
{
    const size_t d = o->system.d;
    if (d > MOST_COUPLED)
        return FVI_EUNSUP;
    o->damper = calloc(d, sizeof *o->damper);
    o->row = calloc(d * d + d, sizeof *o->row);
    if (!o->damper || !o->row)
        return FVI_ENOMEM;
    o->mechanism = (fvi_mechanism){ .damper = o->damper };
    for (size_t i = 0; i < d; i++) {
        if (o->system.damping[i] != 0 && o->system.damping[i] != 1)
            return FVI_EUNSUP;
        o->row[i * d + i] = 1;
        if (o->system.damping[i] != 0)
            o->damper[o->mechanism.damper_count++] = (fvi_damper){ .of.row = o->row + i * d, .kernel = law };
    }
    o->system.mechanism = &o->mechanism;
    o->system.damping = o->row + d * d;
    return FVI_SUCCESS;
}

/* Make a law that is one power into an alpha. */
static int replace_law_by_power(const fvi_kernel_term *power, replacement *o, fvi_run *run)
{
    const size_t d = o->system.d;
    o->row = calloc(d, sizeof *o->row);
    if (!o->row)
        return FVI_ENOMEM;
    for (size_t i = 0; i < d; i++)
        o->row[i] = o->system.damping[i] * power->rho;
    o->system.damping = o->row;
    run->alpha = power->alpha;
    return FVI_SUCCESS;
}

/* Above the order 1 fvi_variable_step accepts a start velocity only for an alpha or for dampers of a mechanism. */
static int change_law(replacement *o, fvi_run *run)
{
    const fvi_kernel *law = run->law;
    if (o->system.matrices || o->system.mechanism || !law)
        return FVI_SUCCESS;
    run->law = NULL;
    return fvi_kernel_is_power(law) ? replace_law_by_power(law->term, o, run) : replace_law_by_dampers(law, o);
}

static int prepare_short_run(const fvi_stepper *s, size_t rows, replacement *o, fvi_run *run)
{
    *run = s->run;
    o->system = *s->run.system;
    run->system = &o->system;
    run->steps = rows;
    run->memory = FVI_HISTORY_AUTO;
    run->most_steps = MOST_STEPS;
    return change_law(o, run);
}

/* Copy the forces of the observer of the short run to the dampers of the run. */
static void copy_forces(const fvi_observer *o, const replacement *other, const double *from, double *force)
{
    if (!other->damper) {
        memcpy(force, from, o->forces * sizeof *force);
        return;
    }
    for (size_t n = 0; n < other->mechanism.damper_count; n++)
        force[(size_t)(other->damper[n].of.row - other->row) / o->d] = from[n];
}

static int read_row(const fvi_observer *o, const replacement *other, fvi_observer *from, const fvi_stepper *s, size_t k)
{
    fvi_observation now;
    const size_t f = o->forces, d = o->d;
    double *row = o->short_rows.numbers + (k - 1) * o->short_rows.width;
    const int status = fvi_observer_read_all(from, s, (double)k * s->run.h, &now);
    if (status)
        return status;
    copy_forces(o, other, now.force, row);
    memcpy(row + f, now.v, d * sizeof *row);
    memcpy(row + f + d, now.a, d * sizeof *row);
    memcpy(row + f + 2 * d, now.multiplier, o->ties * sizeof *row);
    memcpy(row + f + 2 * d + o->ties, now.x, d * sizeof *row);
    return FVI_SUCCESS;
}

static int run_short_steps(fvi_observer *o, const replacement *other, const fvi_run *run)
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
            status = read_row(o, other, from, s, k);
        if (!status)
            o->short_rows.rows = k;
    }
    fvi_observer_free(from);
    fvi_stepper_free(s);
    return status;
}

/* For an order near 2 no step may be short enough for the wanted error. Then ten times as much is allowed. */
static int run_short_rows(fvi_observer *o, const replacement *other, fvi_run *run, double size)
{
    int status = FVI_EUNSUP;
    for (double part = 1e-10; part < 2e-6 && status == FVI_EUNSUP; part *= 10) {
        run->step_error = part * size;
        run->tolerance = FVI_ANY_TOLERANCE;
        status = run_short_steps(o, other, run);
    }
    return status;
}

int fvi_short_rows_start(fvi_observer *o, const fvi_stepper *s)
{
    const size_t first = fvi_observer_first_rows(o), rows = first < s->run.steps ? first : s->run.steps;
    fvi_short_rows *to = &o->short_rows;
    replacement other = { 0 };
    fvi_run run;
    double size;
    if (!is_needed(o, s))
        return FVI_SUCCESS;
    to->width = o->forces + 3 * o->d + o->ties;
    to->numbers = calloc(rows * to->width, sizeof *to->numbers);
    int status = to->numbers ? measure_step(o, s, &size) : FVI_ENOMEM;
    if (!status)
        status = prepare_short_run(s, rows, &other, &run);
    if (!status)
        status = run_short_rows(o, &other, &run, size);
    free_replacement(&other);
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

/* ---- rows of a run that begins at another place ---- */

static int has_jumping_past(const fvi_run *run)
{
    int is = 0;
    for (size_t j = 0; j < fvi_run_damper_count(run); j++)
        is |= fvi_run_damper_of(run, j).past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE;
    return is;
}

int fvi_observer_short_rows_beside(const fvi_method *method, const fvi_run *run, size_t i, size_t *rows)
{
    const size_t d = run->system->d;
    fvi_run beside = *run;
    fvi_stepper *s = NULL;
    fvi_observer *o = NULL;
    *rows = 0;
    if (!has_jumping_past(run))
        return FVI_SUCCESS;
    double *x0 = malloc(d * sizeof *x0);
    if (!x0)
        return FVI_ENOMEM;
    memcpy(x0, run->x0, d * sizeof *x0);
    x0[i] += 1e-6 * larger(1, fabs(x0[i]));
    beside.x0 = x0;
    if (!fvi_stepper_start(method, &beside, &s, NULL) && !fvi_observer_start(s, FVI_OBSERVE_FORCE, &o, NULL))
        *rows = fvi_observer_short_rows(o);
    fvi_observer_free(o);
    fvi_stepper_free(s);
    free(x0);
    return FVI_SUCCESS;
}
