/* src/mechanism/mechanism_newton.c -- Newton's method for the equations of a step.  [H 29] */
#include "mechanism_state.h"
#include "system/dot.h"
#include "system/lagrangian_point.h"
#include "system/larger.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { FEW = 15, MOST = 50, MOST_SLOW = 200 };

static double norm(size_t n, const double *v)
{
    return sqrt(fvi_dot(n, v, v));
}

/* The change of u, -J^-1 r, of what assemble has written. */
static int change_of(fvi_mechanism_state *o)
{
    for (size_t i = 0; i < o->n; i++)
        o->change[i] = -o->residual[i];
    return fvi_solve_matrix(o->n, o->matrix, o->change, o->order);
}

/* Is it done? The next change of an iteration of order two is about now^3 / before^2. */
static int is_done(double now, double before, double scale)
{
    const double rounding = 4 * DBL_EPSILON * scale;
    return now <= rounding || (now <= 1e-8 * scale && now >= before / 2)
           || (isfinite(before) && now < before / 8
               && now / before * (now / before) * now <= rounding / 1e4);
}

/* Is a change of x no more than its roundings, where these are all that an equation knows x to? That of a constraint is
 * one, and that of a coordinate without inertia. */
static int is_lost_in_places(const fvi_stepper *s, double change)
{
    const fvi_mechanism_state *o = s->mechanism;
    int knows_places = o->m > 0;
    for (size_t i = 0; i < o->d && o->is_on_mesh; i++)
        knows_places |= o->is_massless[i];
    return knows_places && change <= 4 * DBL_EPSILON * largest_abs(o->d, s->x);
}

/* On a mesh a step may be so short that the increments need more digits than c(x) = 0 gives, which knows x up to
 * roundings. Then the iteration also ends when it changes x by no more than these. Where a body rests nothing moves, and the
 * size of all motion before says what is small. */
static int iterate(fvi_stepper *s,
                   int (*assemble)(fvi_stepper *s, const double *u),
                   size_t places, double *u)
{
    fvi_mechanism_state *o = s->mechanism;
    double before = INFINITY;
    for (int i = 0; i < (o->is_on_mesh ? FEW : MOST); i++) {
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

/* Down the residual: the longest of the steps 1, 1/2, 1/4, ... of Newton's that makes it smaller. */
static int descend(fvi_stepper *s,
                   int (*assemble)(fvi_stepper *s, const double *u), double *u)
{
    fvi_mechanism_state *o = s->mechanism;
    const size_t n = o->n;
    int status = assemble(s, u);
    double size = norm(n, o->residual);
    for (int i = 0; i < MOST_SLOW && !status; i++) {
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
            if (status == FVI_EOVRFLW) /* outside of where L is known */
                status = FVI_SUCCESS, next = INFINITY;
        }
        if (!(next < size))
            return status; /* no further: iterate says whether it is a root */
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
