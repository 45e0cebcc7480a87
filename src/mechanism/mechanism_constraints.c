/* src/mechanism/mechanism_constraints.c -- Make momenta and velocities satisfy the constraints. [H 29] */
#include "mechanism_state.h"
#include "system/lagrangian_point.h"

#include "system/dot.h"
#include "system/larger.h"
#include "system/fail.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

//> project
/* Solve L_v(x, v) + C^T w = p, C v = -c_t by Newton's method, usually in one step. When a body turns back,
 * v may consist of rounding errors only. So the iteration also ends when the changes are small compared
 * with the largest v so far. */
int fvi_mechanism_project_momentum(fvi_stepper *s, double t, const double *x,
                                   const double *C, double *p, double *v,
                                   double *w)
{
    fvi_mechanism_state *o = s->mechanism;
    const size_t d = o->d, m = o->m, n = d + m;
    double *Lv = o->room, *Lvv = Lv + d, *r = Lvv + d * d, *J = r + n,
           *ct = J + n * n, *again = ct + m, last = INFINITY, most = 0;
    int status = FVI_SUCCESS, is_done = 0;
    memset(w, 0, m * sizeof *w);
    if (m)
        status = fvi_mechanism_tie_gradients(s, t, x, again, ct);
    if (status)
        return status;
    for (int tries = 0; tries < FVI_VELOCITY_STEPS && !is_done; tries++) {
        status = fvi_lagrangian_point(s->run.system, t, x, v, NULL, NULL, Lv,
                                      NULL, NULL, Lvv);
        if (status)
            return status;
        memset(J, 0, n * n * sizeof *J);
        most = larger(most, largest_abs(d, v));
        for (size_t i = 0; i < d; i++) {
            r[i] = p[i] - Lv[i];
            memcpy(J + i * n, Lvv + i * d, d * sizeof *J);
            for (size_t l = 0; l < m; l++) {
                r[i] -= C[l * d + i] * w[l];
                J[i * n + d + l] = J[(d + l) * n + i] = C[l * d + i];
            }
            if (o->is_massless[i]) { /* the velocity stays unchanged */
                J[i * n + i] = 1;
                r[i] = 0;
            }
        }
        for (size_t l = 0; l < m; l++) {
            r[d + l] = -ct[l];
            for (size_t i = 0; i < d; i++)
                r[d + l] -= C[l * d + i] * v[i];
        }
        status = fvi_solve_matrix(n, J, r, o->order);
        if (!status)
            status = fvi_velocity_add(d, r, v, &last, &is_done);
        if (status)
            return status;
        for (size_t l = 0; l < m; l++)
            w[l] += r[d + l];
    }
    if (!is_done && !(last <= 4 * DBL_EPSILON * most))
        return FVI_EMAXITER;
    for (size_t i = 0; i < d; i++)
        for (size_t l = 0; l < m; l++)
            p[i] -= C[l * d + i] * w[l];
    return FVI_SUCCESS;
}
//< project

/* ---- start ---- */

static const char *name_of(const fvi_constraints *c, size_t i, char place[32])
{
    if (c->name && c->name[i])
        return c->name[i];
    snprintf(place, 32, "%zu", i + 1);
    return place;
}

static int refuse(int code, const char *field, double value, size_t i,
                  const char *text, const char *who, fvi_error *error)
{
    return fvi_at_index(error, i, fvi_fail(error, code, field, value, text, who, value));
}

/* Check that each gradient is independent of the gradients before it, by Gram-Schmidt orthogonalisation. */
static int check_independent(const fvi_stepper *s, fvi_error *error)
{
    const fvi_mechanism_state *o = s->mechanism;
    const fvi_constraints *c = s->run.system->mechanism->constraints;
    const size_t d = o->d;
    double *rest = o->room;
    char place[32];
    memcpy(rest, o->C, o->m * d * sizeof *rest);
    for (size_t i = 0; i < o->m; i++) {
        double *row = rest + i * d;
        const double whole = fvi_dot(d, row, row);
        for (int twice = 0; twice < 2; twice++)
            for (size_t j = 0; j < i; j++) {
                const double part = fvi_dot(d, rest + j * d, row);
                for (size_t a = 0; a < d; a++)
                    row[a] -= part * rest[j * d + a];
            }
        const double left = fvi_dot(d, row, row);
        if (!(left > 1e-20 * whole))
            return refuse(FVI_ESING, c->imposed && c->imposed[i] ? "impose" : "constraint", 0, i,
                          whole > 0 ? "'%s' is redundant: at x0 the "
                                      "constraints before it say the same"
                                    : "'%s' has no gradient at x0",
                          name_of(c, i, place), error);
        for (size_t a = 0; a < d; a++)
            row[a] /= sqrt(left);
    }
    return FVI_SUCCESS;
}

/* Check that c(x0) = 0, up to the digits that a user types. */
static int check_start_position(const fvi_stepper *s, fvi_error *error)
{
    const fvi_mechanism_state *o = s->mechanism;
    const fvi_constraints *c = s->run.system->mechanism->constraints;
    double *value = o->residual, far = largest_abs(o->d, s->x);
    char place[32];
    const int status = c->value(0, o->d, s->x, c->params, value);
    for (size_t i = 0; i < o->m && !status; i++)
        if (!(fabs(value[i])
              <= 1e-9 * largest_abs(o->d, o->C + i * o->d) * (far > 0 ? far : 1)))
            return refuse(FVI_EDOM, "x0", value[i], i,
                          isnan(value[i]) ? "the constraint '%s' is not a number there"
                                          : "it does not keep to the constraint '%s', which is "
                                            "%g there",
                          name_of(c, i, place), error);
    return status;
}

/* Check that the projection changes p0 by no more than the digits that a user types. The projection removes the part
 * that violates the hidden constraint or moves a coordinate without inertia. */
static int check_momentum(fvi_stepper *s, fvi_error *error)
{
    fvi_mechanism_state *o = s->mechanism;
    double *p = o->residual, *Lv = o->change;
    memcpy(p, s->p, o->d * sizeof *p);
    int status = fvi_mechanism_project_momentum(s, 0, s->x, o->C, p, o->v,
                                                o->ended);
    memset(o->ended, 0, o->m * sizeof *o->ended);
    if (status == FVI_ESING || status == FVI_EMAXITER)
        return fvi_fail(error, status, "lagrangian", NAN,
                        "its second derivatives by the velocities are a singular matrix at the start");
    if (!status)
        status = fvi_lagrangian_point(s->run.system, 0, s->x, o->v, NULL, NULL,
                                      Lv, NULL, NULL, NULL);
    const double size = largest_abs(o->d, s->p) + largest_abs(o->d, Lv);
    for (size_t i = 0; i < o->d && !status; i++) {
        const double off = s->p[i] - (o->is_massless[i] ? Lv[i] : p[i]);
        if (fabs(off) <= 1e-9 * size)
            continue;
        if (o->is_massless[i])
            fvi_fail(error, FVI_EDOM, "p0", s->p[i], "p%zu is off by %g: this coordinate has no inertia", i + 1, off);
        else
            fvi_fail(error, FVI_EDOM, "p0", s->p[i], "p%zu is off by %g: the velocity does not keep to the "
                     "constraints, which need v%zu = %.12g, p%zu = %.12g", i + 1, off, i + 1, o->v[i], i + 1, p[i]);
        return fvi_at_index(error, i, FVI_EDOM);
    }
    if (!status)
        memcpy(s->p, p, o->d * sizeof *p);
    return status;
}

/* Find the coordinates that have neither inertia nor a constraint; p does not determine their velocity. If an inertia
 * vanishes only at rest, the search for the velocity begins with the velocities 1. */
static int find_massless(fvi_stepper *s)
{
    fvi_mechanism_state *o = s->mechanism;
    const size_t d = o->d;
    int vanishes;
    const int status = fvi_inertia_at_rest(s->run.system, 0, s->x, o->v, o->room, o->order, &vanishes);
    for (size_t i = 0; i < d && !status; i++) {
        o->is_massless[i] = o->order[i] != 0;
        for (size_t l = 0; l < o->m; l++)
            if (o->C[l * d + i] != 0)
                o->is_massless[i] = 0;
        if (vanishes)
            o->v[i] = 1;
    }
    return status;
}

int fvi_mechanism_check_start(fvi_stepper *s, fvi_error *error)
{
    fvi_mechanism_state *o = s->mechanism;
    const fvi_constraints *c = s->run.system->mechanism->constraints;
    int status = FVI_SUCCESS;
    if (o->m) {
        status = c->gradient(0, o->d, s->x, c->params, o->C, NULL);
        if (!status)
            status = check_independent(s, error);
        if (!status)
            status = check_start_position(s, error);
    }
    if (!status)
        status = find_massless(s);
    return status ? status : check_momentum(s, error);
}
