/* src/error_control/variable_step_search.c -- Two runs with variable steps, and the distance between them. [H 22] */
#include "variable_step_search.h"

#include "search_bound.h"

#include "variable_step/variable_step.h"
#include "system/arrays.h"
#include "system/fail.h"
#include "system/larger.h"

#include <gsl/gsl_machine.h>
#include <gsl/gsl_math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { LEAST_STEPS = 128, MOST_RUNS = 16, SAME_END = 5 };

/* The times at which runs are compared: the rows of the caller divided into `first` parts each, so that few rows do not
 * hide what happens between them, and the times that are wanted. */
typedef struct {
    const fvi_run *run;
    size_t first, count; /* of the times */
    double *t;
    size_t most;            /* no run takes more steps */
    int fine;               /* nonzero: only the finest modes are exact enough */
    double end;             /* the time that the last run reached */
    double *x, *before, *p; /* this run and the run before */
    size_t reached, reached_before;   /* how many of the times; an event may end a run */
    fvi_event_list events, events_before;
    fvi_step_statistics counts;
    fvi_variable_step_found as; /* the parameters of this run */
} pair;

int fvi_variable_step_again(const fvi_run *of, size_t most,
                            const fvi_variable_step_found *found,
                            fvi_stepper **stepper)
{
    fvi_run run = *of;
    run.h /= (double)found->first; /* division by a power of two is exact */
    run.steps *= found->first;
    run.step_error = found->step_error;
    run.most_steps = most;
    run.tolerance = found->fine ? FVI_FINE_MODES : FVI_MODES_BY_TOLERANCE;
    const int status =
        fvi_stepper_start(&fvi_variable_step, &run, stepper, NULL);
    if (!status) {
        fvi_variable_step_limit(*stepper, found->longest, found->growth);
        fvi_variable_step_rest_below(*stepper, found->rest);
    }
    return status;
}

/* Take steps until the time number k is passed, or an event ends the run. */
static int advance_to(pair *o, fvi_stepper *s, size_t k)
{
    int status = FVI_SUCCESS;
    while (s->t < o->t[k] && !status && !fvi_stepper_is_over(s)) {
        status = fvi_stepper_step(s);
        fvi_stepper_statistics(s, &o->counts);
        if (status == FVI_ERUNAWAY)
            status = FVI_ETOL;
        if (!status)
            status = fvi_event_list_add(&o->events, s);
    }
    return status;
}

//> trial
/* Make a run with this tolerance. No step is longer than `longest`, and `growth` limits how fast steps grow. */
static int run_trial(pair *o, double step_error, double longest, int growth)
{
    const size_t d = o->run->system->d;
    o->as.step_error = step_error;
    o->as.longest = longest;
    o->as.growth = growth;
    o->as.fine = o->fine;
    o->as.common = (fvi_event_agreement){ 0 };
    o->events.count = o->reached = 0;
    fvi_stepper *s;
    int status = fvi_variable_step_again(o->run, o->most, &o->as, &s);
    if (status)
        return status;
    status = fvi_event_list_add(&o->events, s);
    for (size_t k = 0, rows; k < o->count && !status; k = o->reached += rows) {
        status = advance_to(o, s, k);
        rows = 0;
        while (k + rows < o->count && o->t[k + rows] <= s->t)
            rows++;
        if (status || rows == 0)
            break;
        status = fvi_stepper_advance_through(s, rows, o->t + k, o->x + k * d,
                                             o->p + k * d);
    }
    o->end = s->t;
    fvi_stepper_free(s);
    return status;
}
//< trial

/* How many of the times both runs have reached. */
static size_t count_common_times(const pair *o)
{
    return o->reached < o->reached_before ? o->reached : o->reached_before;
}

/* max |x - before|, plus what rounding can contribute, plus the error of coarse modes, which were chosen for the size
 * at the start and may be too coarse if the motion has grown. *largest: max |x|. */
static double distance(const pair *o, double *largest)
{
    const size_t n = count_common_times(o) * o->run->system->d;
    const double D = largest_difference(n, o->x, o->before);
    *largest = largest_abs(n, o->x);
    return D + (3e-14 + o->counts.memory) * *largest;
}

/* The last of the times up to which two runs differ by no more than `error`. */
static double agreed_until(const pair *o, double error)
{
    const size_t k = fvi_search_agreed(count_common_times(o), o->run->system->d, o->x, o->before, error);
    return k > 0 ? o->t[k - 1] : 0;
}

/* The largest speed of a coordinate, as a mean over half a row at least. */
static double largest_speed(const pair *o)
{
    const size_t d = o->run->system->d;
    const double least = o->run->h / (double)(2 * o->first);
    double speed = 0;
    for (size_t k = 1, from = 0; k < o->reached; k++) {
        const double time = o->t[k] - o->t[from];
        if (time < least)
            continue;
        for (size_t i = 0; i < d; i++)
            speed = larger(speed, fabs(o->x[k * d + i] - o->x[from * d + i]) / time);
        from = k;
    }
    return speed;
}

/* The estimate from two runs that have come to their ends. */
static int compare(pair *o, double error, double *estimate, double *largest)
{
    double of_events;
    *estimate = distance(o, largest);
    if (o->run->event_count == 0)
        return FVI_SUCCESS;
    const int status = fvi_event_list_distance(
        &o->events, &o->events_before, o->run->system->d, o->run->event_count, largest_speed(o),
        o->run->h * (double)o->run->steps, error, &of_events, &o->as.common);
    *estimate = larger(*estimate, of_events);
    return status;
}

/* Make this run the one before the next. */
static void keep_as_previous(pair *o)
{
    double *x = o->x;
    o->x = o->before;
    o->before = x;
    const fvi_event_list events = o->events;
    o->events = o->events_before;
    o->events_before = events;
    o->reached_before = o->reached;
}

//> search
/* Compare runs until an estimate is small enough. Every second run has limited steps, so that no two neighbours have
 * the same steps. The search gives up in three cases. Estimates that do not fall count against it only if they may be
 * rounding. Lists of events that differ though the steps are right to rounding will never agree. And if SAME_END runs
 * in a row, each with a tenth of the tolerance, end within a thousandth of one time, the motion itself ends there,
 * because it runs away in a finite time. If the coarse modes are too coarse for the size of the motion, the next runs
 * take the finest ones. */
static int search(pair *o, double error, fvi_variable_step_found *found)
{
    const double T = o->run->h * (double)o->run->steps;
    double step_error = error, longest = T, last = GSL_POSINF;
    double largest = 0, end = 0, until = 0;
    int failed_before = 1, status = FVI_SUCCESS, worse = 0, same_end = 0;
    found->estimate = GSL_POSINF;
    o->as = (fvi_variable_step_found){ .first = o->first, .rest = o->run->event_count ? error : 0 };
    for (int i = 0; i < MOST_RUNS && worse < 3 && same_end < SAME_END - 1;
         i++, step_error /= 10) {
        status = i % 2 ? run_trial(o, step_error, longest / 2, 3)
                       : run_trial(o, step_error, T, 4);
        if (status && !fvi_search_is_too_long(status))
            return status;
        same_end = status && fabs(o->end - end) < 1e-3 * end ? same_end + 1 : 0;
        end = o->end;
        double estimate = GSL_POSINF;
        if (!status && !failed_before && compare(o, error, &estimate, &largest))
            return FVI_ENOMEM;
        if (estimate < found->estimate) {
            *found = o->as;
            found->estimate = estimate;
            found->counts = o->counts;
        }
        if (!failed_before && !status) {
            found->common = o->as.common;
            until = larger(until, agreed_until(o, error));
        }
        if (estimate <= error)
            return FVI_SUCCESS;
        o->fine |= o->counts.memory * largest > error / 4;
        worse += estimate > last / 2 && o->counts.memory == 0
                 && estimate <= GSL_SQRT_DBL_EPSILON * largest;
        worse += o->as.common.differ && step_error <= GSL_DBL_EPSILON * largest;
        last = estimate;
        failed_before = status != 0;
        longest = status ? T : o->counts.longest;
        keep_as_previous(o);
    }
    const int is_compared = !status || gsl_finite(found->estimate) || found->common.differ;
    found->until = is_compared ? until : o->end;
    return is_compared ? FVI_ETOL : status;
}
//< search

/* Check the arguments. A start of the run finds what fvi_stepper_start refuses. The start gets the wanted error as its
 * tolerance, because the default tolerance is finer than some wanted errors and would be refused more often. */
static int check(const fvi_run *run, double error, const double *x,
                 const fvi_variable_step_found *found)
{
    if (!run || !x || !found)
        FVI_FAIL("null pointer", FVI_EFAULT);
    if (!(gsl_finite(error) && error > 0))
        FVI_FAIL("error must be finite and positive", FVI_EDOM);
    fvi_run wanted = *run;
    wanted.step_error = error;
    wanted.tolerance = FVI_ANY_TOLERANCE;
    fvi_stepper *s;
    int status = fvi_stepper_start(&fvi_variable_step, &wanted, &s, NULL);
    if (!status)
        fvi_stepper_free(s);
    return status;
}

/* Merge the rows of the run and the wanted times into one increasing list. */
static void merge_times(pair *o, size_t count, const double *t)
{
    const size_t rows = o->run->steps * o->first;
    const double h = o->run->h / (double)o->first; /* exact */
    size_t i = 0;
    o->count = 0;
    for (size_t k = 0; k <= rows; k++) {
        const double row = (double)k * h;
        for (; i < count && t[i] <= row; i++)
            if (t[i] < row)
                o->t[o->count++] = t[i];
        o->t[o->count++] = row;
    }
}

/* Copy the rows of the last run at the wanted times to x and p: `count` rows at t, or its own rows if t is NULL.
 * Returns how many of them the run has reached. */
static size_t copy_rows(const pair *o, size_t count, const double *t, double *x,
                        double *p)
{
    const size_t d = o->run->system->d;
    size_t k = 0;
    for (size_t at = 0; k < count; k++, at++) {
        while (t && o->t[at] < t[k])
            at++;
        if (!t)
            at = k * o->first;
        if (at >= o->reached)
            break;
        memcpy(x + k * d, o->x + at * d, d * sizeof *x);
        if (p)
            memcpy(p + k * d, o->p + at * d, d * sizeof *p);
    }
    return k;
}

int fvi_variable_step_search(const fvi_run *run, size_t count, const double *t,
                             double error, size_t most, double *x, double *p,
                             fvi_variable_step_found *found)
{
    int status = check(run, error, x, found);
    if (status)
        return status;
    const size_t d = run->system->d;
    pair o = { .run = run, .first = 1, .most = most };
    while (run->steps * o.first < LEAST_STEPS)
        o.first *= 2;
    if (run->steps >= SIZE_MAX / sizeof(double) / 8 / d / o.first
        || (t && count >= SIZE_MAX / sizeof(double) / 8 / d))
        FVI_FAIL("rows must be addressable", FVI_EINVAL);
    const size_t length = run->steps * o.first + 1 + (t ? count : 0);
    double *block = FVI_ARRAYS({ &o.x, length * d }, { &o.before, length * d }, { &o.p, length * d },
                               { &o.t, length });
    if (!block)
        FVI_FAIL("no memory for the rows", FVI_ENOMEM);
    merge_times(&o, t ? count : 0, t);
    fvi_variable_step_found best = { 0 };
    status = search(&o, error, &best);
    if (!status)
        best.rows = copy_rows(&o, t ? count : run->steps + 1, t, x, p);
    if (!status)
        best.events = o.events;
    else
        fvi_event_list_free(&o.events);
    fvi_event_list_free(&o.events_before);
    free(block);
    if (!status || status == FVI_ETOL)
        *found = best;
    found->until = best.until;
    return status;
}
