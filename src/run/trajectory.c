/* src/run/trajectory.c -- Start, step, copy, save and free a run by any method. [H 2] */
#include <fvi/trajectory.h>

#include <fvi/lagrangian.h>

#include "impulses.h"
#include "run_check.h"
#include "run_damper.h"
#include "step_force.h"
#include "whole_run.h"
#include "system/archive_pieces.h"
#include "system/fail.h"
#include "newton/newton.h"

#include <gsl/gsl_math.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { NUMBERS = 7 }; /* a stepper has so many numbers for each coordinate */

/* During a step, a callback or an archive sees a stepper that is half changed. So these calls are refused there. */
#define REFUSE_CALLBACKS_OF(s)                                                 \
    if ((s)->is_busy)                                                          \
    FVI_FAIL("called by a callback of this stepper", FVI_EINVAL)

fvi_run fvi_run_default(const fvi_system *system, const double *x0,
                        const double *p0, double h, size_t steps)
{
    return (fvi_run){ .system = system,
                      .x0 = x0,
                      .p0 = p0,
                      .h = h,
                      .steps = steps,
                      .kappa = 0.5,
                      .alpha = 0.5,
                      .past = FVI_INITIAL_HISTORY_HELD,
                      .memory = FVI_HISTORY_AUTO };
}

int fvi_method_takes_history(const fvi_method *method, fvi_history_kind kind)
{
    return method->memories == 0 || kind > FVI_HISTORY_MODES
           || method->memories & 1u << kind;
}

/* Make a stepper at k = 0. x, p, dx, g, F and copies of x0 and p0 stand in one block. Returns NULL without memory. */
static fvi_stepper *make_stepper(const fvi_method *method, const fvi_run *run)
{
    const size_t d = run->system->d;
    fvi_stepper *s = calloc(1, sizeof *s);
    double *block = calloc(NUMBERS * d, sizeof *block);
    if (!s || !block) {
        free(s);
        free(block);
        return NULL;
    }
    *s = (fvi_stepper){ .x = block,
                        .p = block + d,
                        .dx = block + 2 * d,
                        .g = block + 3 * d,
                        .F = block + 4 * d,
                        .run = fvi_run_normal(method, run),
                        .method = method,
                        .error = run->failure };
    s->run.x0 = memcpy(block + 5 * d, run->x0, d * sizeof *s->x);
    s->run.p0 = memcpy(block + 6 * d, run->p0, d * sizeof *s->p);
    memcpy(s->x, run->x0, d * sizeof *s->x);
    memcpy(s->p, run->p0, d * sizeof *s->p);
    return s;
}

static int is_finite(const fvi_stepper *s)
{
    return fvi_row_is_finite(2 * s->run.system->d, s->x); /* x, then p */
}

int fvi_stepper_start(const fvi_method *method, const fvi_run *run,
                      fvi_stepper **stepper, fvi_error *error)
{
    if (!stepper)
        return fvi_fail(error, FVI_EFAULT, "stepper", NAN, "stepper is a null pointer");
    int status = fvi_run_check(method, run, error);
    if (status)
        return status;
    fvi_stepper *s = make_stepper(method, run);
    if (!s)
        return fvi_fail(error, FVI_ENOMEM, NULL, NAN, "no memory for the state");
    fvi_error said = { 0 };
    s->error = &said;
    status = method->start ? method->start(s) : FVI_SUCCESS;
    s->error = run->failure;
    if (status) {
        fvi_stepper_free(s);
        if (said.code == status && error)
            *error = said;
        return said.code == status
                   ? status
                   : fvi_fail(error, status, NULL, NAN, "%s", fvi_error_name(status));
    }
    if (!method->dense)
        fvi_impulses_act(s, 0);
    if (!is_finite(s)) {
        fvi_stepper_free(s);
        return fvi_fail(error, FVI_EOVRFLW, "p0", NAN, "an impulse at t = 0 makes p infinite");
    }
    *stepper = s;
    return FVI_SUCCESS;
}

/* Return nonzero if it is time to ask the interrupter: before every step that takes long, and before every 64th of
 * short steps, so that asking costs nothing. */
static int is_time_to_check(const fvi_stepper *s)
{
    enum { UNKNOWNS_OF_SLOW_STEP = 32 /* coordinates, of each stage */, STEPS_PER_CHECK = 64 /* steps */ };
    const size_t unknowns = s->run.system->d * (size_t)(s->method->stages ? s->method->stages : 1);
    return s->k % STEPS_PER_CHECK == 0 || unknowns >= UNKNOWNS_OF_SLOW_STEP || s->method->dense;
}

/* How many rows a method that chooses its steps has passed at s->t. */
static size_t rows_passed(const fvi_stepper *s)
{
    const double h = s->run.h,
                 rows = floor(s->t / h); /* may be one too many or too few by rounding */
    size_t k = rows < (double)s->run.steps ? (size_t)rows : s->run.steps;
    k -= (double)k * h > s->t;
    return k + (k < s->run.steps && (double)(k + 1) * h <= s->t);
}

int fvi_stepper_step(fvi_stepper *s)
{
    if (!s)
        FVI_FAIL("null pointer", FVI_EFAULT);
    REFUSE_CALLBACKS_OF(s);
    if (s->k >= s->run.steps)
        FVI_FAIL("the run is over", FVI_EINVAL);
    s->is_busy = 1;
    int status = is_time_to_check(s) ? fvi_interrupted() : FVI_SUCCESS;
    if (!status) {
        status = s->method->step(s);
        s->has_failed |= status != 0 && status != FVI_EINVAL; /* FVI_EINVAL: an event has ended the run before */
    }
    s->is_busy = 0;
    if (status)
        return status;
    if (s->run.system->force.impulse_count && !s->method->dense)
        fvi_impulses_act(s, s->k + 1);
    if (!is_finite(s)) {
        s->has_failed = 1;
        return FVI_EOVRFLW; /* no mistake of the caller, so no error handler */
    }
    s->k = s->method->dense ? rows_passed(s) : s->k + 1;
    if (!s->method->dense)
        s->t = (double)s->k * s->run.h;
    return FVI_SUCCESS;
}

int fvi_stepper_advance_to(fvi_stepper *s, double t, double *x, double *p)
{
    if (!s)
        FVI_FAIL("null pointer", FVI_EFAULT);
    const size_t d = s->run.system->d, bytes = d * sizeof *s->x;
    if (!(t <= (double)s->run.steps * s->run.h))
        FVI_FAIL("the run is over before", FVI_EDOM);
    int status = FVI_SUCCESS;
    while (s->t < t && !status)
        status = fvi_stepper_step(s);
    if (status)
        return status;
    if (s->t == t) {
        if (x)
            memcpy(x, s->x, bytes);
        if (p)
            memcpy(p, s->p, bytes);
        return FVI_SUCCESS;
    }
    if (!s->method->dense || s->method->dense(s, t, x, p))
        FVI_FAIL("no state at such a time", FVI_EDOM);
    return (x && !fvi_all_finite(d, x)) || (p && !fvi_all_finite(d, p))
               ? FVI_EOVRFLW
               : FVI_SUCCESS;
}

/* How many of the times, as far as they do not fall, lie before the end of the last step. */
static size_t times_within(const fvi_stepper *s, size_t count, const double *t)
{
    size_t n = 0;
    while (n < count && t[n] < s->t && (n == 0 || t[n] >= t[n - 1]))
        n++;
    return n;
}

int fvi_stepper_advance_through(fvi_stepper *s, size_t count, const double *t, double *x,
                                double *p)
{
    if (!s || (!t && count))
        FVI_FAIL("null pointer", FVI_EFAULT);
    const size_t d = s->run.system->d;
    int status = FVI_SUCCESS;
    for (size_t k = 0, n; k < count && !status; k += n) {
        double *to_x = x ? x + k * d : NULL, *to_p = p ? p + k * d : NULL;
        n = s->method->rows ? times_within(s, count - k, t + k) : 0;
        if (n < 2) {
            n = 1;
            status = fvi_stepper_advance_to(s, t[k], to_x, to_p);
            continue;
        }
        if (s->method->rows(s, n, t + k, to_x, to_p))
            FVI_FAIL("no state at such a time", FVI_EDOM);
        if ((x && !fvi_all_finite(n * d, to_x)) || (p && !fvi_all_finite(n * d, to_p)))
            status = FVI_EOVRFLW;
    }
    return status;
}

int fvi_stepper_copy(const fvi_stepper *from, fvi_stepper **to)
{
    if (!from || !to)
        FVI_FAIL("null pointer", FVI_EFAULT);
    REFUSE_CALLBACKS_OF(from);
    if (from->method_state && !from->method->copy)
        FVI_FAIL("the method has no copy", FVI_EUNSUP);
    fvi_stepper *s = make_stepper(from->method, &from->run);
    if (!s)
        FVI_FAIL("no memory for the state", FVI_ENOMEM);
    s->k = from->k;
    s->t = from->t;
    s->has_failed = from->has_failed;
    memcpy(s->x, from->x, NUMBERS * s->run.system->d * sizeof *s->x);
    int status = FVI_SUCCESS;
    if (from->newton)
        status = fvi_newton_copy(from->newton, &s->newton);
    if (!status && from->method_state)
        status = s->method->copy(from, s);
    if (status)
        fvi_stepper_free(s);
    else
        *to = s;
    return status;
}

/* Check that a run could have this k, t, x and p. An archive may have written any numbers there. */
static int check_state(const fvi_stepper *s)
{
    const fvi_run *run = &s->run;
    if (s->k > run->steps)
        FVI_FAIL("the run that was saved is longer", FVI_EINVAL);
    const int in_time = s->method->dense
                            ? s->t >= 0 && s->t <= (double)run->steps * run->h
                                  && s->k == rows_passed(s)
                            : s->t == (double)s->k * run->h;
    if (!in_time || !is_finite(s))
        FVI_FAIL("not a state of this run", FVI_EINVAL);
    return FVI_SUCCESS;
}

static int serialize_all(fvi_stepper *s, fvi_archive *v)
{
    fvi_system system = *s->run.system;
    const size_t d = system.d, own = system.mass && system.damping ? d : 0;
    int status = FVI_SERIALIZE(v, FVI_CONSTANT(system.d), FVI_CONSTANTS(system.mass, own),
                               FVI_CONSTANTS(system.damping, own), FVI_CONSTANTS(s->run.x0, d),
                               FVI_CONSTANTS(s->run.p0, d), FVI_STATE(s->k), FVI_STATE(s->t),
                               FVI_STATES(s->x, (NUMBERS - 2) * d)); /* without x0 and p0, which are constant */
    if (!status)
        status = check_state(s);
    return status || !s->method_state ? status : s->method->serialize(s, v);
}

int fvi_stepper_archive(fvi_stepper *s, fvi_archive *v)
{
    if (!s || !v)
        FVI_FAIL("null pointer", FVI_EFAULT);
    REFUSE_CALLBACKS_OF(s);
    if (s->method_state && !s->method->serialize)
        FVI_FAIL("the method does not show its data", FVI_EUNSUP);
    if (s->has_failed)
        FVI_FAIL("the last step failed", FVI_EINVAL);
    s->is_busy = 1;
    const int status = serialize_all(s, v);
    s->is_busy = 0;
    return status;
}

int fvi_stepper_reset(fvi_stepper *s)
{
    if (!s)
        FVI_FAIL("null pointer", FVI_EFAULT);
    REFUSE_CALLBACKS_OF(s);
    fvi_stepper *fresh;
    s->is_busy = 1;
    int status = fvi_stepper_start(s->method, &s->run, &fresh, NULL);
    s->is_busy = 0;
    if (status)
        return status;
    const fvi_stepper old = *s;
    *s = *fresh;
    *fresh = old;
    return fvi_stepper_free(fresh);
}

int fvi_stepper_free(fvi_stepper *s)
{
    if (!s)
        return FVI_SUCCESS;
    REFUSE_CALLBACKS_OF(s);
    if (s->method->stop)
        s->method->stop(s);
    fvi_newton_free(s->newton);
    free(s->x);
    free(s);
    return FVI_SUCCESS;
}

/* Write row k. dx and g are room for an x and p that only the energy needs. */
static int store_row(fvi_stepper *s, size_t k, double *x, double *p, double *energy)
{
    const size_t d = s->run.system->d;
    const double t = (double)k * s->run.h;
    int status = fvi_stepper_advance_to(s, t, x ? x + k * d : NULL, p ? p + k * d : NULL);
    if (status || !energy)
        return status;
    if (s->t == t)
        return fvi_energy_at(s->run.system, t, s->x, s->p, energy + k);
    status = fvi_stepper_advance_to(s, t, s->dx, s->g);
    return status ? status
                  : fvi_energy_at(s->run.system, t, s->dx, s->g, energy + k);
}

int fvi_trajectory(const fvi_method *method, const fvi_run *run, double *x,
                   double *p, double *energy)
{
    fvi_stepper *s;
    int status = fvi_stepper_start(method, run, &s, NULL);
    if (status)
        return status;
    if (run->steps >= SIZE_MAX / sizeof(double) / run->system->d) {
        fvi_stepper_free(s);
        FVI_FAIL("steps must be addressable", FVI_EINVAL);
    }
    for (size_t k = 0; !status && k <= run->steps; k++)
        status = store_row(s, k, x, p, energy);
    fvi_stepper_free(s);
    return status;
}
