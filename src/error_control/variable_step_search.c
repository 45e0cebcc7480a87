/* src/error_control/variable_step_search.c -- Two runs with variable steps, and how far they are
 * apart.                                                             [H 22] */
#include "variable_step_search.h"

#include "variable_step/variable_step.h"
#include "system/fail.h"
#include "system/larger.h"

#include <gsl/gsl_machine.h>
#include <gsl/gsl_math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { FEWEST = 128, MOST_RUNS = 16, SAME_END = 5 };

/* The times at which runs are compared: the rows of a run, `first` times as many as the caller
 * has, so that few rows do not hide what is between them, and the times that are wanted. */
typedef struct {
    const fvi_run *run;
    size_t first, count, length; /* of the times; of their numbers */
    double *t;
    size_t most;            /* no run of more steps */
    int fine;               /* are only the finest modes good enough? */
    double end;             /* the t that the last run came to */
    double *x, *before, *p; /* this run and the one before */
    fvi_step_statistics counts;
    fvi_variable_step_found as; /* how this run was made */
} pair;

int fvi_variable_step_again(const fvi_run *of, size_t most,
                            const fvi_variable_step_found *found,
                            fvi_stepper **stepper)
{
    fvi_run run = *of;
    run.h /= (double)found->first; /* a power of two: exact */
    run.steps *= found->first;
    run.step_error = found->step_error;
    run.most_steps = most;
    if (found->fine)
        run.tolerance = FVI_FINE_MODES;
    const int status =
        fvi_stepper_start(&fvi_variable_step, &run, stepper, NULL);
    if (!status)
        fvi_variable_step_limit(*stepper, found->longest, found->growth);
    return status;
}

//> trial
/* A run with such a tolerance, no step longer than `longest`, and the growth of steps
 * limited. */
static int trial(pair *o, double step_error, double longest, int growth)
{
    const size_t d = o->run->system->d;
    o->as = (fvi_variable_step_found){ .step_error = step_error,
                                       .longest = longest,
                                       .growth = growth,
                                       .fine = o->fine,
                                       .first = o->first };
    fvi_stepper *s;
    int status = fvi_variable_step_again(o->run, o->most, &o->as, &s);
    if (status)
        return status;
    for (size_t k = 0, rows; k < o->count && !status; k += rows) {
        while (s->t < o->t[k] && !status) {
            status = fvi_stepper_step(s);
            fvi_stepper_statistics(s, &o->counts);
            if (status == FVI_ERUNAWAY)
                status = FVI_ETOL;
        }
        rows = 1;
        while (k + rows < o->count && o->t[k + rows] <= s->t)
            rows++;
        if (!status)
            status = fvi_stepper_advance_through(s, rows, o->t + k, o->x + k * d,
                                                 o->p + k * d);
    }
    o->end = s->t;
    fvi_stepper_free(s);
    return status;
}
//< trial

static int too_long(int status)
{
    return status == FVI_EOVRFLW || status == FVI_EMAXITER
           || status == FVI_ESING;
}

/* max |x - before|, and what rounding may be of it, and modes that were chosen for the size at
 * the start, where the motion became larger; max |x|. */
static double distance(const pair *o, double *largest)
{
    double D = 0;
    *largest = 0;
    for (size_t i = 0; i < o->length; i++) {
        D = larger(D, fabs(o->x[i] - o->before[i]));
        *largest = larger(*largest, fabs(o->x[i]));
    }
    return D + (3e-14 + o->counts.memory) * *largest;
}

//> search
/* Every second run is limited, so that no two neighbours have the same steps. Estimates
 * that do not fall end it only where they may be rounding. Where coarse modes are too coarse for
 * what the motion has become, the next runs take the finest. Where SAME_END runs in a row,
 * each with a tenth of the tolerance, come to no other end than to a thousandth of it, it is
 * the motion that ends there: it runs away in a finite time. */
static int search(pair *o, double error, fvi_variable_step_found *found)
{
    const double T = o->run->h * (double)o->run->steps;
    double step_error = error, longest = T, last = GSL_POSINF;
    double largest = 0;
    double end = 0;
    int failed_before = 1, status = FVI_SUCCESS, worse = 0, same_end = 0;
    found->estimate = GSL_POSINF;
    for (int i = 0; i < MOST_RUNS && worse < 3 && same_end < SAME_END - 1;
         i++, step_error /= 10) {
        status = i % 2 ? trial(o, step_error, longest / 2, 3)
                       : trial(o, step_error, T, 4);
        if (status && !too_long(status))
            return status;
        same_end = status && fabs(o->end - end) < 1e-3 * end ? same_end + 1 : 0;
        end = o->end;
        const double estimate =
            status || failed_before ? GSL_POSINF : distance(o, &largest);
        if (estimate < found->estimate) {
            *found = o->as;
            found->estimate = estimate;
            found->counts = o->counts;
        }
        if (estimate <= error)
            return FVI_SUCCESS;
        o->fine |= o->counts.memory * largest > error / 4;
        worse += estimate > last / 2 && o->counts.memory == 0
                 && estimate <= GSL_SQRT_DBL_EPSILON * largest;
        last = estimate;
        failed_before = status != 0;
        longest = status ? T : o->counts.longest;
        double *swap = o->x;
        o->x = o->before;
        o->before = swap;
    }
    return status && !gsl_finite(found->estimate) ? status : FVI_ETOL;
}
//< search

/* A start shows what fvi_stepper_start refuses. It is given the wanted error, because for a
 * tolerance of its own, finer than some errors need, it refuses more. */
static int check(const fvi_run *run, double error, const double *x,
                 const fvi_variable_step_found *found)
{
    if (!run || !x || !found)
        FVI_FAIL("null pointer", FVI_EFAULT);
    if (!(gsl_finite(error) && error > 0))
        FVI_FAIL("error must be finite and positive", FVI_EDOM);
    fvi_run wanted = *run;
    wanted.step_error = error;
    fvi_stepper *s;
    int status = fvi_stepper_start(&fvi_variable_step, &wanted, &s, NULL);
    if (!status)
        fvi_stepper_free(s);
    return status;
}

/* The rows of the run and the wanted times, in one increasing list. */
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
    o->length = o->count * o->run->system->d;
}

/* What stands in the last run at the times that are wanted: `count` at t, or its rows. */
static void give_out(const pair *o, size_t count, const double *t, double *x,
                     double *p)
{
    const size_t d = o->run->system->d;
    for (size_t k = 0, at = 0; k < count; k++, at++) {
        while (t && o->t[at] < t[k])
            at++;
        if (!t)
            at = k * o->first;
        memcpy(x + k * d, o->x + at * d, d * sizeof *x);
        if (p)
            memcpy(p + k * d, o->p + at * d, d * sizeof *p);
    }
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
    while (run->steps * o.first < FEWEST)
        o.first *= 2;
    if (run->steps >= SIZE_MAX / sizeof(double) / 8 / d / o.first
        || (t && count >= SIZE_MAX / sizeof(double) / 8 / d))
        FVI_FAIL("rows must be addressable", FVI_EINVAL);
    const size_t length = run->steps * o.first + 1 + (t ? count : 0);
    double *block = malloc((3 * d + 1) * length * sizeof *block);
    if (!block)
        FVI_FAIL("no memory for the rows", FVI_ENOMEM);
    o.x = block;
    o.before = block + length * d;
    o.p = block + 2 * length * d;
    o.t = block + 3 * length * d;
    merge_times(&o, t ? count : 0, t);
    fvi_variable_step_found best = { 0 };
    status = search(&o, error, &best);
    if (!status)
        give_out(&o, t ? count : run->steps + 1, t, x, p);
    free(block);
    if (!status || status == FVI_ETOL)
        *found = best;
    return status;
}
