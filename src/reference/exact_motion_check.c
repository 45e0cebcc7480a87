/* src/reference/exact_motion_check.c -- Check whether a system has an exact motion here.   [H 11] */
#include "exact_motion_check.h"
#include "frequency/dynamic_stiffness.h"
#include "matrices/factors.h"
#include "system/fail.h"
#include "system/quadratic.h"

#include <fvi/dampers.h>

#include <math.h>
#include <stdlib.h>

/* ---- what it must be ---- */

/* Find out whether an elongation is linear: its gradient must be the same at two places and two times. The numbers have
 * no simple ratio, so that a coincidence is unlikely. x has room for 3 d numbers, for itself and both gradients. */
static int check_gradient_is_constant(const fvi_elongation *of, size_t d, double *x, int *is_linear)
{
    double *G = x + d, *other = G + d, rate = 0;
    for (size_t i = 0; i < d; i++)
        x[i] = 0;
    int status = of->gradient(0, d, x, of->params, G);
    for (size_t i = 0; i < d; i++)
        x[i] = 0.3 + sqrt(2 + (double)i);
    if (!status)
        status = of->gradient(1.5, d, x, of->params, other);
    if (!status && of->rate)
        status = of->rate(1.5, d, x, of->params, &rate);
    *is_linear = rate == 0 && memcmp(G, other, d * sizeof *G) == 0;
    return status;
}

static int is_linear(const fvi_damper *damper, size_t d, int *answer)
{
    *answer = 1;
    if (damper->matrix || damper->of.row)
        return FVI_SUCCESS;
    double *room = malloc(3 * d * sizeof *room);
    const int status = room ? check_gradient_is_constant(&damper->of, d, room, answer) : FVI_ENOMEM;
    free(room);
    return status;
}

static int check_dampers(const fvi_system *system, fvi_error *error)
{
    const fvi_mechanism *m = system->mechanism;
    for (size_t j = 0; m && j < m->damper_count; j++) {
        const fvi_damper *damper = m->damper + j;
        int linear;
        const int status = is_linear(damper, system->d, &linear);
        if (status)
            return fvi_fail(error, status, "damper", (double)j + 1, "%s", fvi_error_name(status));
        if (!linear) {
            fvi_fail(error, FVI_EUNSUP, "damper", (double)j + 1, "damper %zu: its elongation is not linear", j + 1);
        } else if (damper->past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE
                   || (damper->past == FVI_INITIAL_HISTORY_CAPUTO
                       && !fvi_kernel_takes_caputo(damper->kernel))) {
            fvi_fail(error, FVI_EUNSUP, "damper", (double)j + 1,
                     "damper %zu: the exact motion is that of dampers that were held", j + 1);
        } else {
            continue;
        }
        return fvi_at_index(error, j, FVI_EUNSUP);
    }
    return FVI_SUCCESS;
}

static int check_number(const char *field, double value, int is_good, fvi_error *error)
{
    return is_good ? FVI_SUCCESS
                   : fvi_fail(error, FVI_EDOM, field, value, "%s is %g", field, value);
}

static int check_numbers(const fvi_exact_problem *p, fvi_error *error)
{
    const size_t d = p->motion.system->d;
    int status = FVI_SUCCESS;
    for (size_t i = 0; !status && i < d; i++) {
        status = check_number("x0", p->x0[i], isfinite(p->x0[i]), error);
        if (!status)
            status = check_number("p0", p->p0[i], isfinite(p->p0[i]), error);
    }
    if (status || p->forcing == FVI_FORCING_NONE)
        return status;
    if (p->forcing != FVI_FORCING_STEP && p->forcing != FVI_FORCING_COSINE)
        return fvi_fail(error, FVI_EINVAL, "forcing", p->forcing, "unknown forcing");
    status = check_number("A", p->A, isfinite(p->A), error);
    if (!status && p->forcing == FVI_FORCING_STEP)
        status = check_number("T", p->T, isfinite(p->T) && p->T >= 0, error);
    return status || p->forcing == FVI_FORCING_STEP
               ? status
               : check_number("w", p->w, isfinite(p->w), error);
}

/* ---- K ---- */

/* Check that K is positive semidefinite. A body that moves freely has a pivot of 0 up to rounding errors. So 1e-9 M
 * times the trace of M^-1 K, which is at least the largest frequency squared, is added before the pivots are
 * checked. */
static int check_stiffness(const fvi_response *r, const fvi_system *system, fvi_error *error)
{
    const fvi_sparse *M = r->term[0].matrix, *K = r->term[1].matrix, *const terms[] = { K, M };
    double most = 0;
    for (size_t i = 0; i < system->d; i++)
        most += fabs(fvi_sparse_entry(K, i, i)) / system->mass[i];
    const double factor[] = { 1, 1e-9 * (most > 0 ? most : 1) };
    fvi_sparse sum;
    fvi_factors *factors = NULL;
    int status = fvi_sparse_add(2, terms, factor, &sum);
    if (!status)
        status = fvi_factors_alloc(fvi_choose_factorisation(&sum), &sum, &factors);
    fvi_factors_free(factors);
    if (status == FVI_ESING)
        return system->matrices ? fvi_fail(error, FVI_EDOM, "K", NAN, "K is negative somewhere")
                                : fvi_fail(error, FVI_EDOM, "potential", NAN,
                                           "the potential has no minimum: its Hessian is negative somewhere");
    return status ? fvi_no_memory(error, NULL) : FVI_SUCCESS;
}

int fvi_exact_motion_check(const fvi_exact_problem *problem, const fvi_response *response,
                           fvi_error *error)
{
    const fvi_system *system = problem->motion.system;
    const fvi_potential *u = &system->potential;
    if (u->value && !fvi_potential_is_quadratic(u))
        return fvi_fail(error, FVI_EUNSUP, "potential", NAN,
                        "the potential is not quadratic: the motion has no closed form");
    int status = check_dampers(system, error);
    if (!status)
        status = check_numbers(problem, error);
    return status ? status : check_stiffness(response, system, error);
}
