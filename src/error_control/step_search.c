/* src/error_control/step_search.c -- Find the step size that a wanted error of x needs, by halving the step. [H 18] */
#include "step_search.h"

#include <fvi/fvi.h>
#include "stability/stability_share.h"
#include "run/run_damper.h"
#include "run/solution.h"
#include "search_bound.h"
#include "step_search_force.h"
#include "system/arrays.h"
#include "system/fail.h"
#include "system/larger.h"
#include "system/quadratic.h"
#include "system/stiffness.h"

#include <gsl/gsl_math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum {
    LEAST_STEPS = 128,
    PATIENCE = 3,
    RUNS = 8 /* an estimate needs a run and three runs with steps 2, 4 and 8 times as long */
};

/* Rows 0, ..., rows of a run, `parts` steps apart. x and p have `length` numbers each. */
typedef struct {
    const fvi_method *method;
    const fvi_run *run;
    size_t first;        /* rows of the search for each row of the caller */
    size_t rows, length; /* rows; (rows + 1) d */
    double *x, *before;  /* this run, and the run with steps twice as long */
    double *p;
    double *H; /* a Hessian, allocated when it is needed */
    fvi_force_probe probe;
} search;

/* The comparison of a run with the two runs before it. */
typedef struct {
    double D, D_before, q, q_before; /* (18.1) */
    double largest;                  /* of |x| */
    double floor;                    /* a smaller D may be rounding */
} comparison;

//> trial
/* Make one run, with each step of the caller cut into first * parts. */
static int run_trial(const search *o, size_t parts)
{
    const size_t d = o->run->system->d;
    fvi_run run = *o->run;
    run.h /= (double)(o->first * parts); /* division by a power of two is exact */
    run.steps = o->rows * parts;
    fvi_stepper *s;
    int status = fvi_stepper_start(o->method, &run, &s, NULL);
    if (status)
        return status;
    for (size_t row = 0;; row++) {
        memcpy(o->x + row * d, s->x, d * sizeof *o->x);
        memcpy(o->p + row * d, s->p, d * sizeof *o->p);
        for (size_t i = 0; i < parts && row < o->rows && !status; i++)
            status = fvi_stepper_step(s);
        if (status || row == o->rows)
            break;
    }
    fvi_stepper_free(s);
    return status;
}
//< trial

/* The last time up to which this run and the run before differ by no more than `error`. */
static double agreed_until(const search *o, double error)
{
    const size_t k = fvi_search_agreed(o->rows + 1, o->run->system->d, o->x, o->before, error);
    return k > 0 ? (double)(k - 1) * o->run->h / (double)o->first : 0;
}

/* ---- the order that a method has on a run ---- */

/* Return nonzero if the run begins with a kick (9.5). It does for a method with paper_convention and
 * Riemann-Liouville's past, if the damping acts on x0. If that cannot be found out, the answer is yes. */
static int is_kicked(const fvi_method *method, const fvi_run *run)
{
    int is_damped;
    return method->paper_convention && run->past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE
           && run->alpha < 0.5 && (fvi_run_start_is_damped(run, &is_damped) || is_damped);
}

/* Return half of the highest order of the dampers; laws count as 1 at least. *is_fractional: nonzero if some damper has
 * a law, or an order that is neither 0 nor 1. With a law the methods with stages are as exact as for its highest order,
 * or as for the order 1, whichever is worse. */
static double highest_order(const fvi_run *run, int *is_fractional)
{
    double alpha = 0;
    *is_fractional = 0;
    for (size_t j = 0; j < fvi_run_damper_count(run); j++) {
        const fvi_run_damper of = fvi_run_damper_of(run, j);
        alpha = larger(alpha, of.law ? larger(0.5, of.growth / 2) : of.alpha);
        *is_fractional |= of.law || (of.alpha != 0 && of.alpha != 0.5);
    }
    return alpha;
}

//> order
/* The orders of (18.5): p' of x over all rows (*least), and p of x at a fixed t > 0 (*most). */
static void find_orders(const fvi_method *method, const fvi_run *run, double *least,
                        double *most)
{
    int is_fractional;
    const double alpha = highest_order(run, &is_fractional), s = method->stages;
    *least = method->lowest;
    *most = method->highest;
    if (method->takes_kappa && run->kappa != 0.5)
        *least = *most = 1;
    if (is_kicked(method, run))
        *least = *most = 1 - 2 * alpha; /* (9.5) */
    if (method->stages > 0)
        *least = *most = 2 * s - 2;
    if (method->stages > 2 && is_fractional) {
        *most = fmin(2 * s - 2, (method->damped_inertia ? s + 4 : s + 2)
                                    - 2 * alpha); /* (17.13), (17.27) */
        *least = fmin(*most, 3 - 2 * alpha);
    }
}
//< order

/* Return nonzero if the method takes the law of the run. Variable steps do not fit a law that grows faster than s,
 * because a velocity that jumps then makes x'' infinite. */
static int takes_law(const fvi_method *method, const fvi_run *run)
{
    return !run->law
           || (method->takes_laws
               && !(method->dense && fvi_kernel_growth(run->law) > 1));
}

const fvi_method *fvi_step_search_other(const fvi_method *method,
                                        const fvi_run *run)
{
    const fvi_method *best = NULL;
    double least, most, others;
    find_orders(method, run, &least, &most);
    const double own = most;
    for (size_t i = 0; fvi_methods[i] && !(best && best->dense); i++) {
        const fvi_method *other = fvi_methods[i];
        find_orders(other, run, &least, &others);
        if (others > (other->dense ? own : most)
            && run->alpha >= other->alpha_least
            && run->alpha <= other->alpha_most
            && fvi_method_takes_history(other, run->memory)
            && takes_law(other, run)
            && (other->takes_matrices || !run->system->matrices)) {
            best = other;
            most = others;
        }
    }
    return best;
}

/* ---- the estimate ---- */

/* The largest bound of the eigenvalues of M^{-1} Hess U over all rows. It is NaN without memory for the Hessian, and
 * the caller then takes the potential for too stiff. */
static int stiffness(search *o, double *most)
{
    const fvi_system *system = o->run->system;
    const fvi_potential *u = &system->potential;
    const size_t d = system->d, width = u->diagonals ? u->diagonals : d;
    *most = 0;
    if (!u->hessian)
        return FVI_SUCCESS;
    if (!o->H && !(o->H = malloc(d * width * sizeof *o->H))) {
        *most = GSL_NAN;
        return FVI_SUCCESS;
    }
    const int constant = fvi_potential_is_quadratic(u);
    for (size_t row = 0; row <= (constant ? 0 : o->rows); row++) {
        int status = u->hessian(d, o->x + row * d, u->params, o->H);
        if (status)
            return status;
        *most = larger(*most, fvi_stiffness(system, o->H));
    }
    return FVI_SUCCESS;
}

/* *still: nonzero if (18.6) is violated. Then the potential may swing so fast that these steps pass over it. With
 * matrices the load of Algorithm 3 without damping, times 4, is the left side: h^2 times the largest eigenvalue of M^-1
 * K. */
static int may_miss_swing(search *o, size_t parts, int *still)
{
    const double h = o->run->h / (double)(o->first * parts);
    double most;
    if (o->run->system->matrices) {
        const int known = fvi_stability_of_matrices(h * h, NULL, o->run, &most);
        *still = !(4 * most <= 1);
        return known;
    }
    int status = stiffness(o, &most);
    *still = !(h * h * most <= 1);
    return status;
}

//> estimate
/* The estimate (18.2), with its order to *order; infinite if (18.5) does not hold. */
static double estimate_error(const comparison *c, double least, double most,
                             double *order)
{
    const double q = fmin(c->q, c->q_before);
    *order = fmin(q, most);
    return q >= fmax(least - 0.5, least / 2)
               ? c->D / expm1(*order * M_LN2) + c->floor
               : GSL_POSINF;
}
//< estimate

static int is_rounding(const comparison *c)
{
    return larger(c->D, c->D_before) <= 10 * c->floor;
}

/* The relative error that x has at least. Eight stages of matrices are solved in eigenvectors, which lose four digits
 * (27.14). */
static double least_relative_error(const search *o)
{
    const double tolerance = o->run->tolerance > 0 ? o->run->tolerance : 1e-13;
    return o->run->system->matrices && o->method->stages == 8 ? larger(tolerance, 5e-12) : tolerance;
}

/* Compare the run in o->x with the run before it. Either of them may have failed. */
static comparison compare(const search *o, const comparison *last, int failed,
                          int failed_before)
{
    comparison c = { GSL_POSINF, last->D, GSL_NEGINF, last->q, 0, 0 };
    if (failed || failed_before)
        return c;
    c.D = largest_difference(o->length, o->x, o->before);
    c.largest = largest_abs(o->length, o->x);
    c.floor = least_relative_error(o) * c.largest;
    if (gsl_finite(c.D_before))
        c.q = c.D > 0 ? log2(c.D_before / c.D) : GSL_POSINF;
    return c;
}

//> search
/* Halve the step until an estimate is believed and small enough. The rows of the last run stay in o->x and o->p. The
 * first run is chosen so that an estimate is ready once the steps see all of the force; if even `most` steps do not see
 * it, no run is made. A run that is no better counts against PATIENCE only if (18.6) holds and the force is resolved,
 * because otherwise shorter steps may still see more. */
static int halve_until_agreed(search *o, double error, size_t most, fvi_step_found *found)
{
    comparison c = { GSL_POSINF, GSL_POSINF, GSL_NEGINF, GSL_NEGINF, 0, 0 };
    double least, highest;
    int failed = 1, worse = 0;
    size_t seen; /* with so many parts the steps see all of the force */
    find_orders(o->method, o->run, &least, &highest);
    found->estimate = GSL_POSINF;
    found->until = 0;
    int unknown = fvi_search_least_parts(o->run, (size_t)o->method->stages,
                                         error, most / o->run->steps, &seen);
    if (unknown)
        return unknown;
    seen /= o->first;
    for (size_t parts = seen > RUNS ? seen / RUNS : 1;
         seen <= most / o->rows && o->rows <= most / parts; parts *= 2) {
        const int failed_before = failed;
        int resolved, still = 0;
        int status = fvi_force_probe_evaluate(&o->probe, o->run, o->first * parts,
                                          &resolved);
        if (status)
            return status;
        resolved = resolved && parts >= seen;
        failed = run_trial(o, parts);
        if (failed && !fvi_search_is_too_long(failed))
            return failed;
        c = compare(o, &c, failed, failed_before);
        if (!failed && !failed_before)
            found->until = larger(found->until, agreed_until(o, error));
        fvi_step_found now = { .parts = o->first * parts };
        now.estimate = estimate_error(&c, least, highest, &now.order);
        if (is_rounding(&c)) {
            status = may_miss_swing(o, parts, &still);
            if (status)
                return status;
            now.estimate = still ? GSL_POSINF : c.D + c.floor;
            now.order = 1;
        }
        if (resolved && now.estimate < found->estimate) {
            now.until = found->until;
            *found = now;
            worse = 0;
        } else if (resolved && !still
                   && c.D <= GSL_SQRT_DBL_EPSILON * c.largest) {
            worse++;
        }
        if (found->estimate <= error)
            return FVI_SUCCESS;
        if (worse == PATIENCE)
            break;
        double *swap = o->x;
        o->x = o->before;
        o->before = swap;
    }
    return FVI_ETOL;
}
//< search

static int check(const fvi_method *method, const fvi_run *run, double error,
                 const double *x, const fvi_step_found *found)
{
    if (!x || !found)
        FVI_FAIL("null pointer", FVI_EFAULT);
    if (!(gsl_finite(error) && error > 0))
        FVI_FAIL("error must be finite and positive", FVI_EDOM);
    fvi_stepper *s;
    fvi_run shortest;
    if (run) { /* one step is enough for the checks of fvi_stepper_start */
        shortest = *run;
        shortest.steps = run->steps > 0;
    }
    if (method && method->dense)
        FVI_FAIL("its steps are its own: fvi_variable_step_search", FVI_EUNSUP);
    int status = fvi_stepper_start(method, run ? &shortest : NULL, &s, NULL);
    if (status && !fvi_search_is_too_long(status))
        return status;
    if (!status)
        fvi_stepper_free(s);
    int has;
    status = fvi_run_has_solution(run, &has); /* a method with paper_convention runs it all the same */
    if (!has)
        FVI_FAIL("there is no solution to be near to", FVI_EDOM);
    if (status)
        return status;
    if (method->lowest < 1)
        FVI_FAIL("the method does not say its order", FVI_EINVAL);
    return FVI_SUCCESS;
}

/* Allocate the arrays of a search in one block, which is returned; NULL without memory. */
static double *make_room(search *o, size_t d)
{
    double *room, *block = FVI_ARRAYS({ &o->x, o->length }, { &o->before, o->length }, { &o->p, o->length },
                                      { &room, FVI_PROBE_ROOM * d });
    if (block)
        fvi_force_probe_start(&o->probe, d, room);
    return block;
}

int fvi_step_search(const fvi_method *method, const fvi_run *run, double error,
                    size_t most, double *x, double *p, fvi_step_found *found)
{
    int status = check(method, run, error, x, found);
    if (status)
        return status;
    const size_t d = run->system->d;
    search o = { .method = method, .run = run, .first = 1 };
    while (run->steps * o.first < LEAST_STEPS)
        o.first *= 2;
    if (run->steps >= SIZE_MAX / sizeof(double) / 8 / d / o.first)
        FVI_FAIL("rows must be addressable", FVI_EINVAL);
    o.rows = run->steps * o.first;
    o.length = (o.rows + 1) * d;
    double *block = make_room(&o, d);
    if (!block)
        FVI_FAIL("no memory for the rows", FVI_ENOMEM);
    fvi_step_found best = { 0 };
    status = halve_until_agreed(&o, error, most, &best);
    for (size_t k = 0; !status && k <= run->steps; k++) {
        memcpy(x + k * d, o.x + k * o.first * d, d * sizeof *x);
        if (p)
            memcpy(p + k * d, o.p + k * o.first * d, d * sizeof *p);
    }
    free(o.H);
    free(block);
    if (!status || status == FVI_ETOL)
        *found = best;
    return status;
}
