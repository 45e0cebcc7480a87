/* src/mechanism/mechanism_newton.c -- Solve the equations of a step by Newton's method.  [H 29] */
#include "mechanism_state.h"
#include "system/dot.h"
#include "system/lagrangian_point.h"
#include "system/larger.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { STEPS_ON_MESH = 15, MOST_NEWTON_STEPS = 50, MOST_DAMPED_STEPS = 200 };

static double norm(size_t n, const double *v)
{
    return sqrt(fvi_dot(n, v, v));
}

/* Compute the Newton step change = -J^-1 r from the residual and the matrix. */
static int change_of(fvi_mechanism_state *o)
{
    for (size_t i = 0; i < o->n; i++)
        o->change[i] = -o->residual[i];
    return fvi_solve_matrix(o->n, o->matrix, o->change, o->order);
}

/* Return 1 if the iteration has converged. Near a simple root the next change is about now^3 / before^2. */
static int is_done(double now, double before, double scale)
{
    const double rounding = 4 * DBL_EPSILON * scale;
    return now <= rounding || (now <= 1e-8 * scale && now >= before / 2)
           || (isfinite(before) && now < before / 8
               && now / before * (now / before) * now <= rounding / 1e4);
}

/* Return 1 if a change of x is within the rounding errors of x, and if an equation determines x no better than this.
 * The equation of a constraint does so, and on a mesh that of a coordinate without inertia. */
static int is_lost_in_places(const fvi_stepper *s, double change)
{
    const fvi_mechanism_state *o = s->mechanism;
    int knows_places = o->m > 0;
    for (size_t i = 0; i < o->d && o->is_on_mesh; i++)
        knows_places |= o->is_massless[i];
    return knows_places && change <= 4 * DBL_EPSILON * largest_abs(o->d, s->x);
}

/* Iterate by Newton's method. On a mesh a step may be so short that the increments need more digits than c(x) = 0 can
 * give, because c determines x only up to rounding errors. So the iteration also ends when it changes x by no more than
 * these. While a body rests, nothing moves, so the size of its motion before (rest_scale) says which changes are
 * small. */
static int iterate(fvi_stepper *s,
                   int (*assemble)(fvi_stepper *s, const double *u),
                   size_t places, double *u)
{
    fvi_mechanism_state *o = s->mechanism;
    double before = INFINITY;
    for (int i = 0; i < (o->is_on_mesh ? STEPS_ON_MESH : MOST_NEWTON_STEPS); i++) {
        int status = assemble(s, u);
        if (!status)
            status = change_of(o);
        if (status)
            return status;
        for (size_t j = 0; j < o->n; j++)
            u[j] += o->change[j];
        const double now = largest_abs(places, o->change),
                     near = o->is_on_mesh ? 0 : largest_abs(o->d, s->x),
                     scale = near + largest_abs(places, u) + o->rest_scale;
        if (!isfinite(now) || !isfinite(largest_abs(o->n, u)))
            return FVI_EMAXITER;
        if (is_done(now, before, scale))
            return FVI_SUCCESS;
        before = now;
    }
    return is_lost_in_places(s, before) ? FVI_SUCCESS : FVI_EMAXITER;
}

/* Reduce the residual. Each step is Newton's step times the largest of the factors 1, 1/2, 1/4, ... that makes the
 * residual smaller. */
static int descend(fvi_stepper *s,
                   int (*assemble)(fvi_stepper *s, const double *u), double *u)
{
    fvi_mechanism_state *o = s->mechanism;
    const size_t n = o->n;
    int status = assemble(s, u);
    double size = norm(n, o->residual);
    for (int i = 0; i < MOST_DAMPED_STEPS && !status; i++) {
        const double length = norm(n, u);
        status = change_of(o);
        if (status)
            return status;
        double part = 2, next = INFINITY;
        while (!(next < size) && part > 1e-12 && !status) {
            part /= 2;
            for (size_t j = 0; j < n; j++)
                o->trial[j] = u[j] + part * o->change[j];
            status = assemble(s, o->trial);
            next = norm(n, o->residual);
            if (status == FVI_EOVRFLW) /* the point is outside the domain of L */
                status = FVI_SUCCESS, next = INFINITY;
        }
        if (!(next < size))
            return status; /* no step reduces the residual; iterate will decide whether u is a root */
        memcpy(u, o->trial, n * sizeof *u);
        size = next;
        if (part == 1 && norm(n, o->change) <= 1e-6 * (length + norm(n, u)))
            return status;
    }
    return status;
}

int fvi_mechanism_solve(fvi_stepper *s,
                        int (*assemble)(fvi_stepper *s, const double *u),
                        size_t places, double *u)
{
    fvi_mechanism_state *o = s->mechanism;
    int status = iterate(s, assemble, places, u);
    if (o->is_on_mesh || (status != FVI_EMAXITER && status != FVI_ESING))
        return status;
    memset(u, 0, o->n * sizeof *u);
    status = descend(s, assemble, u);
    return status ? status : iterate(s, assemble, places, u);
}
