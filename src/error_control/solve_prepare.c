/* src/error_control/solve_prepare.c -- Choose the method, the steps and the rows of a call of fvi_solve. [H 18, 22] */
#include "solve_state.h"

#include "system/fail.h"

#include "run/run_check.h"
#include "variable_step/variable_step.h"

#include <fvi/fvi.h>
#include "system/larger.h"

#include <float.h>
#include <math.h>
#include <stdint.h>

enum {
    MOST_PARTS = 1 << 20, /* of T: a common step of the times is not shorter */
    COMPARED = 128        /* runs are compared at so many times at least; a power of two */
};

/* Return nonzero if the method accepts such a run. It is started with a single step to find out. */
static int can_start(const fvi_method *method, const fvi_run *run, double tolerance)
{
    fvi_run one = *run;
    fvi_stepper *s = NULL;
    one.h *= (double)one.steps;
    one.steps = 1;
    one.step_error = method->dense ? tolerance : 0;
    if (method->dense)
        one.tolerance = FVI_ANY_TOLERANCE;
    if (!method->takes_kappa && run->kappa != 0.5)
        return 0;
    const int status = fvi_stepper_start(method, &one, &s, NULL);
    fvi_stepper_free(s);
    return status == FVI_SUCCESS;
}

/* The method for a law. Steps of any length were 1 to 120 times faster than steps of one length. If the run cannot have
 * them: four stages for small errors, and a method of order 2 for larger ones. */
static const fvi_method *method_of_law(const fvi_run *run, double tolerance)
{
    static const double FINE = 1e-5;
    const double size = largest_abs(run->system->d, run->x0);
    if (can_start(&fvi_variable_step, run, tolerance))
        return &fvi_variable_step;
    return tolerance < FINE * (size > 0 ? size : 1) && can_start(&fvi_lobatto_m4, run, tolerance)
               ? &fvi_lobatto_m4
               : &fvi_cq_bdf2;
}

const fvi_method *fvi_method_for_error(const fvi_run *run, double tolerance)
{
    const fvi_system *system = run->system;
    if (run->event_count > 0)
        return &fvi_variable_step;
    if (system->matrices)
        return fvi_variable_step_takes_structure(system, run->alpha, run->law) ? &fvi_variable_step
                                                                               : &fvi_cq2_midpoint;
    return run->law && !system->mechanism ? method_of_law(run, tolerance) : &fvi_variable_step;
}

static int refuse_time(size_t k, double t, const char *reason, fvi_error *error)
{
    return fvi_at_index(error, k, fvi_fail(error, FVI_EDOM, "t", t, "t[%zu] is %.10g; %s", k, t, reason));
}

/* Check that the times increase and lie within the motion. */
static int check_times(const fvi_outputs *out, double T, fvi_error *error)
{
    if (out->rows == 0)
        return fvi_fail(error, FVI_EINVAL, "rows", 0, "rows is 0; at least one time must be asked for");
    for (size_t k = 0; out->t && k < out->rows; k++) {
        if (!(out->t[k] >= 0 && out->t[k] <= T))
            return refuse_time(k, out->t[k], "it must be in [0, T]", error);
        if (k > 0 && !(out->t[k] > out->t[k - 1]))
            return refuse_time(k, out->t[k], "the times must increase", error);
    }
    return FVI_SUCCESS;
}

/* The index of the first of the times that is no multiple of h, apart from rounding; `count` if there is none. */
static size_t first_between(size_t count, const double *t, double h)
{
    for (size_t k = 0; k < count; k++) {
        const double parts = t[k] / h;
        if (!(fabs(parts - round(parts)) <= 16 * DBL_EPSILON * parts))
            return k;
    }
    return count;
}

/* The number of common_steps; 0 if there is none. *least: the index of a time that most of the tried steps do not
 * meet. */
static size_t common_steps(size_t count, const double *t, double T, size_t *least)
{
    *least = 0;
    for (size_t steps = 1; steps <= MOST_PARTS; steps++) {
        const size_t k = first_between(count, t, T / (double)steps);
        if (k == count)
            return steps;
        *least += k > *least ? k - *least : 0;
    }
    return 0;
}

size_t fvi_common_steps(size_t count, const double *t, double T)
{
    size_t least;
    return t ? common_steps(count, t, T, &least) : 0;
}

static int check_step(const fvi_solve_state *o, double h)
{
    return h > 0 && isfinite(h)
               ? FVI_SUCCESS
               : fvi_fail(o->error, FVI_EDOM, "h", h, "h is %g; without a tolerance a step > 0 is needed", h);
}

/* Return nonzero if x and p are known between the ends of steps of one length. The quantities of an observer are
 * not. */
static int has_path(const fvi_solve_state *o)
{
    return o->method->stages > 0 && !o->out->observed;
}

/* Choose steps that end at each of the times. If there are none, a method with stages gives x and p between its
 * steps. */
static int choose_common_steps(fvi_solve_state *o, double T)
{
    size_t least;
    const size_t steps = common_steps(o->out->rows, o->out->t, T, &least);
    o->is_between = steps == 0 && has_path(o);
    o->run.steps = steps ? steps : COMPARED;
    return steps || o->is_between ? FVI_SUCCESS
           : o->method->stages > 0
               ? refuse_time(least, o->out->t[least],
                             "accelerations, forces and work need times with a common step; fvi-adaptive has them at "
                             "any",
                             o->error)
               : refuse_time(least, o->out->t[least],
                             "this method needs times with a common step, because no error is known between its steps; "
                             "fvi-lobatto2d to 8d and fvi-adaptive give out any time",
                             o->error);
}

/* Take steps of the given length h to T. */
static int given_steps(fvi_solve_state *o, double T, double h)
{
    const int status = check_step(o, h);
    if (status)
        return status;
    const double steps = round(T / h);
    if (!(fabs(steps * h - T) <= 1e-9 * T) || !(steps < (double)SIZE_MAX))
        return fvi_fail(o->error, FVI_EDOM, "T", T, "T is %.10g, which is no multiple of h = %.10g", T, h);
    o->run.h = h;
    o->run.steps = (size_t)steps;
    if (!o->out->t && o->out->rows != o->run.steps + 1)
        return fvi_fail(o->error, FVI_EINVAL, "rows", (double)o->out->rows,
                        "rows is %zu; without times it must be %zu, one row for each step and one for t = 0",
                        o->out->rows, o->run.steps + 1);
    const size_t k =
        o->out->t && !o->method->dense ? first_between(o->out->rows, o->out->t, h) : SIZE_MAX;
    o->is_between = k < o->out->rows && has_path(o);
    return k < o->out->rows && !o->is_between
               ? refuse_time(k, o->out->t[k],
                             o->method->stages > 0
                                 ? "accelerations, forces and work are known at multiples of h; fvi-adaptive has them "
                                    "at any time"
                                 : "this method gives out multiples of h, because no error is known between its steps; "
                                   "fvi-lobatto2d to 8d and fvi-adaptive give out any time",
                             o->error)
               : FVI_SUCCESS;
}

/* Choose the rows of the run: the caller's, unless the method gives out any time; then COMPARED rows for the search. */
static int choose_grid(fvi_solve_state *o, double T, double h)
{
    if (!(o->tolerance > 0) && !(o->method->dense && h == 0))
        return given_steps(o, T, h);
    int status = FVI_SUCCESS;
    if (!o->out->t && o->out->rows < 2)
        return fvi_fail(o->error, FVI_EINVAL, "rows", 1,
                        "rows is 1; without times it must be 2 or more, for the times 0 and T");
    o->run.steps = o->out->t ? COMPARED : o->out->rows - 1;
    if (o->out->t && !o->method->dense)
        status = choose_common_steps(o, T);
    o->run.h = T / (double)o->run.steps;
    return status;
}

int fvi_solve_prepare(fvi_solve_state *o, const fvi_problem *problem,
                      const fvi_solve_options *options,
                      const fvi_accuracy *accuracy)
{
    o->tolerance = accuracy->tolerance;
    o->most_steps = accuracy->most_steps;
    if (!(o->tolerance >= 0 && isfinite(o->tolerance)))
        return fvi_fail(o->error, FVI_EDOM, "tolerance", o->tolerance,
                        "tolerance is %g; it must be finite and not negative", o->tolerance);
    if (o->tolerance == 0 && options->h != 0 && check_step(o, options->h)) /* a caller may have computed T from h */
        return FVI_EDOM;
    if (!(problem->T > 0 && isfinite(problem->T)))
        return fvi_fail(o->error, FVI_EDOM, "T", problem->T, "T is %g; it must be finite and positive", problem->T);
    o->run = (fvi_run){ .system = &problem->system,
                        .x0 = problem->x0,
                        .p0 = problem->p0,
                        .kappa = options->kappa ? *options->kappa : 0.5,
                        .alpha = problem->alpha,
                        .past = problem->past,
                        .memory = options->history,
                        .tolerance = options->history_tolerance,
                        .step_error = options->step_error,
                        .longest = options->longest,
                        .most_steps = o->most_steps,
                        .law = problem->law,
                        .events = problem->events,
                        .event_count = problem->event_count,
                        .h = problem->T,
                        .steps = 1 };
    o->method = options->method                             ? options->method
                : o->tolerance > 0 || problem->event_count ? fvi_method_for_error(&o->run, o->tolerance)
                                                            : &fvi_fractional;
    int status = check_times(o->out, problem->T, o->error);
    if (!status)
        status = choose_grid(o, problem->T, options->h);
    return status ? status : fvi_run_check(o->method, &o->run, o->error);
}
