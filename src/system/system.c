/* src/system/system.c -- Check a system, and evaluate its potential, energy and ready-made forces.  [H 2] */
#include <fvi/system.h>

#include "system/fail.h"
#include "lanes.h"
#include "system_check.h"

#include <fvi/dampers.h>

#include <float.h>
#include <gsl/gsl_math.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

int fvi_system_check(const fvi_system *s, fvi_error *error)
{
    if (s && s->matrices)
        return fvi_fail(error, FVI_EUNSUP, "matrices", NAN,
                        "this is not for systems with matrices");
    if (s && s->mechanism)
        return fvi_fail(error, FVI_EUNSUP, "mechanism", NAN,
                        "this is not for systems with a mechanism");
    return fvi_system_check_any(s, error);
}

static int check_matrices(const fvi_system *s, fvi_error *error)
{
    const fvi_matrices *m = s->matrices;
    if (!m->stiffness || !m->factorise || !m->solve || !m->free_factors
        || (m->damping.history_size > 0 && (!m->damping.select_history || !m->damping.apply_damping)))
        return fvi_fail(error, FVI_EFAULT, "matrices", NAN,
                        "a function of the matrices is missing");
    if (s->potential.value)
        return fvi_refuse(error, "potential", "matrices and a potential do not go together");
    if (m->damper_count > 0 && (!m->damper || m->damping.history_size > 0))
        return fvi_fail(error, FVI_EFAULT, "matrices", NAN, "several dampers need their matrices, and no C");
    return FVI_SUCCESS;
}

/* Refuse a number of coordinate i, such as a mass, that is out of range. */
static int refuse_number(const char *field, double value, size_t i,
                         const char *range, fvi_error *error)
{
    return fvi_at_index(error, i,
                        fvi_fail(error, FVI_EDOM, field, value, "%s[%zu] is %g; it must be %s", field, i, value,
                                 range));
}

int fvi_system_check_any(const fvi_system *s, fvi_error *error)
{
    const int has_lagrangian = s && s->mechanism && s->mechanism->lagrangian;
    if (!s || ((!s->mass || !s->damping) && !has_lagrangian))
        return fvi_fail(error, FVI_EFAULT, "system", NAN,
                        "a system needs masses and dampings");
    const fvi_potential *u = &s->potential;
    const size_t row = s->matrices ? 1 : u->diagonals ? u->diagonals : s->d;
    if (s->d == 0 || s->d > SIZE_MAX / sizeof(double) / 8 / row)
        return fvi_fail(error, FVI_EINVAL, "d", (double)s->d,
                        "it must be at least 1 and a Hessian addressable");
    if (!u->value != !u->gradient || !u->value != !u->hessian)
        return fvi_refuse(error, "potential", "it needs value, gradient and hessian, or none");
    for (size_t i = 0; i < s->d && !has_lagrangian; i++) {
        if (!(gsl_finite(s->mass[i])
              && (s->mass[i] > 0 || (s->mass[i] == 0 && s->mechanism))))
            return refuse_number("mass", s->mass[i], i, "finite and positive",
                                 error);
        if (!(gsl_finite(s->damping[i]) && s->damping[i] >= 0))
            return refuse_number("rho", s->damping[i], i,
                                 "finite and not negative", error);
    }
    return s->matrices ? check_matrices(s, error) : FVI_SUCCESS;
}

static int report_error(const fvi_error *error, int status)
{
    return status ? fvi_tell_handler(error->text, __FILE__, __LINE__, status) : FVI_SUCCESS;
}

int fvi_system_require(const fvi_system *s)
{
    fvi_error error;
    return report_error(&error, fvi_system_check(s, &error));
}

int fvi_system_require_any(const fvi_system *s)
{
    fvi_error error;
    return report_error(&error, fvi_system_check_any(s, &error));
}

int fvi_potential_value(const fvi_system *s, const double *x, double *U)
{
    const fvi_potential *u = &s->potential;
    if (u->value)
        return u->value(s->d, x, u->params, U);
    *U = 0;
    return FVI_SUCCESS;
}

int fvi_potential_gradient(const fvi_system *s, const double *x, double *grad)
{
    const fvi_potential *u = &s->potential;
    if (s->matrices)
        return s->matrices->stiffness(s->d, x, s->matrices->params, grad);
    if (u->gradient)
        return u->gradient(s->d, x, u->params, grad);
    memset(grad, 0, s->d * sizeof *grad);
    return FVI_SUCCESS;
}

int fvi_energy(const fvi_system *s, const double *x, const double *p, double *E)
{
    double kinetic = 0, value;
    int status;
    if ((s->matrices && !s->matrices->energy)
        || (s->mechanism && s->mechanism->lagrangian))
        return FVI_EUNSUP;
    if (s->matrices)
        status = s->matrices->energy(s->d, x, p, s->matrices->params, &value);
    else
        status = fvi_potential_value(s, x, &value);
    for (size_t i = 0; i < s->d && !s->matrices; i++)
        if (s->mass[i] > 0) /* with a mechanism a coordinate may have mass 0 */
            kinetic += p[i] / s->mass[i] * p[i];
    if (status)
        return status;
    value += kinetic / 2; /* (2.4) */
    if (!isfinite(value))
        return FVI_EOVRFLW; /* overflow is no mistake of the caller, so the error handler is not called */
    *E = value;
    return FVI_SUCCESS;
}

size_t fvi_potential_hessian_size(const fvi_system *s)
{
    const size_t m = s->potential.diagonals, row = m > s->d ? m : s->d;
    return s->d > SIZE_MAX / 64 / row ? SIZE_MAX / 64 : s->d * row;
}

/* The diagonals are spread in place, from the last number to the first. So no number is overwritten before it has been
 * read, provided that a row is not longer than d. Longer rows are shortened to d first. */
int fvi_potential_hessian(const fvi_system *s, const double *x, double *H)
{
    const fvi_potential *u = &s->potential;
    const size_t d = s->d, m = u->diagonals < d ? u->diagonals : d;
    memset(H, 0, d * d * sizeof *H);
    int status = u->hessian ? u->hessian(d, x, u->params, H) : FVI_SUCCESS;
    if (status)
        return status;
    for (size_t i = 1; u->diagonals > d && i < d; i++)
        memmove(H + i * d, H + i * u->diagonals, (d - i) * sizeof *H);
    for (size_t i = d; m > 0 && i-- > 0;)
        for (size_t j = i + (m < d - i ? m : d - i); j-- > i;) {
            double value = H[i * m + j - i];
            H[i * m + j - i] = 0;
            H[i * d + j] = H[j * d + i] = value;
        }
    return FVI_SUCCESS;
}

/* ---- ready-made forces ----
 *
 * They only read their params. So the casts remove const, but no constant is ever written. */

static int step_value(double t, size_t d, void *params, double *F)
{
    const double *aT = params;
    for (size_t i = 0; i < d; i++)
        F[i] = t >= 0 && t <= aT[1] ? aT[0] : 0;
    return 0;
}

/* Set the bound of derivative k to the same number for every mass. */
static void fill_bounds(size_t k, size_t d, double bound, double *most)
{
    for (size_t i = 0; i < d; i++)
        most[k * d + i] = bound;
}

static int step_bound(double from, double to, size_t order, size_t d,
                      void *params, double *most)
{
    const double *aT = params;
    const int jumps = from < aT[1] && aT[1] < to;
    fill_bounds(0, d, jumps ? fabs(aT[0]) / 2 : 0, most);
    for (size_t k = 1; k <= order; k++)
        fill_bounds(k, d, jumps ? INFINITY : 0, most);
    return 0;
}

fvi_force fvi_force_step(const double aT[2])
{
    return (fvi_force){ .value = step_value,
                        .bound = step_bound,
                        .params = (void *)aT,
                        .jumps = aT + 1,
                        .jump_count = 1 };
}

static int cosine_value(double t, size_t d, void *params, double *F)
{
    const double *aw = params;
    double value = aw[0] * cos(aw[1] * t);
    for (size_t i = 0; i < d; i++)
        F[i] = value;
    return 0;
}

static int cosine_bound(double from, double to, size_t order, size_t d,
                        void *params, double *most)
{
    const double *aw = params;
    const double size = fabs(aw[0]) * (1 + 64 * DBL_EPSILON);
    double bound = size; /* |a| |w|^k / k! */
    fill_bounds(0, d, fmin(size, size * fabs(aw[1]) * (to - from)), most);
    for (size_t k = 1; k <= order; k++) {
        bound *= fabs(aw[1]) / (double)k;
        fill_bounds(k, d, bound, most);
    }
    return 0;
}

/* Compute the force of all lanes. The pair of each lane is (a, w), and t is the same in all lanes. So one cosine is
 * enough if all lanes have the same w. slope is not used. */
static void evaluate_cosines(const void *prepared, const double *t, const double *active, double *f, double *slope)
{
    const fvi_lane_pairs *p = prepared;
    const double value = cos(p->second[0] * *t);
    (void)active, (void)slope;
#pragma omp simd
    for (size_t l = 0; l < FVI_MOST_LANES; l++)
        f[l] = p->first[l] * value;
    for (size_t l = 1; l < FVI_MOST_LANES && !p->has_one_second; l++)
        f[l] = p->first[l] * cos(p->second[l] * *t);
}

static const fvi_lane_functions cosine_lanes = { fvi_lane_pairs_prepare, evaluate_cosines, free,
                                                 NULL };

fvi_force fvi_force_cosine(const double aw[2])
{
    return (fvi_force){ .value = cosine_value,
                        .bound = cosine_bound,
                        .params = (void *)aw,
                        .lanes = &cosine_lanes };
}
