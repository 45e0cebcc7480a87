/* src/system/lagrangian.c -- Compute momentum, velocity and energy from a Lagrangian. [H 29] */
#include "lagrangian_point.h"

#include "fail.h"
#include "lu.h"

#include <fvi/dampers.h>

#include <float.h>
#include <gsl/gsl_linalg.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

const fvi_lagrangian *fvi_lagrangian_of(const fvi_system *system)
{
    return system->mechanism ? system->mechanism->lagrangian : NULL;
}

/* Evaluate L = sum_i m_i v_i^2 / 2 - U(x) and its derivatives. The mixed derivative Lxv is zero, so the caller sets
 * it. */
static int masses_and_potential(const fvi_system *s, const double *x,
                                const double *v, double *L, double *Lx,
                                double *Lv, double *Lxx, double *Lvv)
{
    const size_t d = s->d;
    double U = 0;
    int status = L ? fvi_potential_value(s, x, &U) : FVI_SUCCESS;
    if (!status && Lx)
        status = fvi_potential_gradient(s, x, Lx);
    if (!status && Lxx)
        status = fvi_potential_hessian(s, x, Lxx);
    if (status)
        return status;
    if (L)
        *L = -U;
    if (Lvv)
        memset(Lvv, 0, d * d * sizeof *Lvv);
    for (size_t i = 0; i < d; i++) {
        if (L)
            *L += s->mass[i] * v[i] * v[i] / 2;
        if (Lx)
            Lx[i] = -Lx[i];
        if (Lv)
            Lv[i] = s->mass[i] * v[i];
        if (Lvv)
            Lvv[i * d + i] = s->mass[i];
    }
    for (size_t i = 0; Lxx && i < d * d; i++)
        Lxx[i] = -Lxx[i];
    return FVI_SUCCESS;
}

int fvi_lagrangian_point(const fvi_system *s, double t, const double *x,
                         const double *v, double *L, double *Lx, double *Lv,
                         double *Lxx, double *Lxv, double *Lvv)
{
    const fvi_lagrangian *own = fvi_lagrangian_of(s);
    if (own)
        return own->at(t, s->d, x, v, own->params, L, Lx, Lv, Lxx, Lxv, Lvv);
    if (Lxv)
        memset(Lxv, 0, s->d * s->d * sizeof *Lxv);
    return masses_and_potential(s, x, v, L, Lx, Lv, Lxx, Lvv);
}

int fvi_solve_matrix(size_t n, double *A, double *r, size_t *order)
{
    gsl_permutation permutation = { n, order };
    gsl_matrix_view matrix = gsl_matrix_view_array(A, n, n);
    gsl_vector_view vector = gsl_vector_view_array(r, n);
    fvi_lu_factorise(&matrix.matrix, &permutation);
    for (size_t i = 0; i < n; i++)
        if (!(fabs(A[i * n + i]) > 0))
            return FVI_ESING;
    gsl_linalg_LU_svx(&matrix.matrix, &permutation, &vector.vector);
    return FVI_SUCCESS;
}

static int row_is_zero(size_t d, const double *Lvv, size_t i)
{
    for (size_t j = 0; j < d; j++)
        if (Lvv[i * d + j] != 0 || Lvv[j * d + i] != 0)
            return 0;
    return 1;
}

/* Replace the equation of each coordinate without inertia by a row of the unit matrix with right side 0, so that
 * Newton's method leaves its velocity unchanged. */
static void leave_out_massless(size_t d, double *Lvv, double *r)
{
    for (size_t i = 0; i < d; i++)
        if (row_is_zero(d, Lvv, i)) {
            Lvv[i * d + i] = 1;
            r[i] = 0;
        }
}

int fvi_inertia_at_rest(const fvi_system *s, double t, const double *x, const double *v,
                        double *room, size_t *is_zero, int *vanishes)
{
    const size_t d = s->d;
    double *Lvv = room, *ones = room + d * d;
    int any = 0, status = fvi_lagrangian_point(s, t, x, v, NULL, NULL, NULL, NULL, NULL, Lvv);
    *vanishes = 0;
    for (size_t i = 0; i < d && !status; i++) {
        is_zero[i] = (size_t)row_is_zero(d, Lvv, i);
        any |= is_zero[i] != 0;
        ones[i] = 1;
    }
    if (status || !any)
        return status;
    status = fvi_lagrangian_point(s, t, x, ones, NULL, NULL, NULL, NULL, NULL, Lvv);
    for (size_t i = 0; i < d && !status; i++) {
        const int has = is_zero[i] && !row_is_zero(d, Lvv, i);
        is_zero[i] = is_zero[i] && !has;
        *vanishes |= has;
    }
    return status;
}

static int has_zero_row(size_t d, const double *Lvv)
{
    for (size_t i = 0; i < d; i++)
        if (row_is_zero(d, Lvv, i))
            return 1;
    return 0;
}

/* Set all velocities to 1 if an inertia vanishes at v only, because there Newton's method has no step. */
static int start_away_from_rest(const fvi_system *s, double t, const double *x, double *v, double *room,
                                size_t *order)
{
    int vanishes;
    const int status = fvi_inertia_at_rest(s, t, x, v, room, order, &vanishes);
    for (size_t i = 0; i < s->d && !status && vanishes; i++)
        v[i] = 1;
    return status;
}

/* Near the root each change is about the square of the change before. So a change is made of rounding errors if it is
 * below 1e-8 (about the root of a rounding error) of v and still more than half of the change before. */
int fvi_velocity_add(size_t d, const double *change, double *v, double *last,
                     int *is_done)
{
    double now = 0, size = 0;
    for (size_t i = 0; i < d; i++) {
        v[i] += change[i];
        now += fabs(change[i]);
        size += fabs(v[i]);
    }
    *is_done = now <= 4 * DBL_EPSILON * size
               || (now <= 1e-8 * size && now >= *last / 2);
    *last = now;
    return isfinite(now) ? FVI_SUCCESS : FVI_EOVRFLW;
}

//> velocity
/* Solve L_v(x, v, t) = p for v by Newton's method. Most Lagrangians are quadratic in v. Then one step gives v, and a
 * second step only confirms it. room is workspace for 2 d + d * d numbers. */
static int solve_velocity(const fvi_system *s, double t, const double *x, const double *p, double *v, double *room,
                          size_t *order)
{
    const size_t d = s->d;
    double *Lv = room, *r = room + d, *Lvv = room + 2 * d, last = INFINITY;
    int is_done = 0, is_checked = 0, status = FVI_SUCCESS;
    for (int n = 0; n < FVI_VELOCITY_STEPS && !is_done && !status; n++) {
        status = fvi_lagrangian_point(s, t, x, v, NULL, NULL, Lv, NULL, NULL, Lvv);
        if (!status && !is_checked && has_zero_row(d, Lvv)) {
            status = start_away_from_rest(s, t, x, v, room, order);
            is_checked = 1;
            continue;
        }
        if (status)
            return status;
        for (size_t i = 0; i < d; i++)
            r[i] = p[i] - Lv[i];
        leave_out_massless(d, Lvv, r);
        status = fvi_solve_matrix(d, Lvv, r, order);
        if (!status)
            status = fvi_velocity_add(d, r, v, &last, &is_done);
        if (status)
            return status;
    }
    return status || is_done ? status : FVI_EMAXITER;
}
//< velocity

int fvi_velocity_of_momentum(const fvi_system *system, double t,
                             const double *x, const double *p, double *v)
{
    const size_t d = system->d;
    if (system->matrices)
        return FVI_EUNSUP;
    if (!fvi_lagrangian_of(system)) {
        for (size_t i = 0; i < d; i++)
            if (system->mass[i] > 0)
                v[i] = p[i] / system->mass[i];
        return FVI_SUCCESS;
    }
    double *room = malloc((2 + d) * d * sizeof *room);
    size_t *order = malloc(d * sizeof *order);
    const int status = room && order
                           ? solve_velocity(system, t, x, p, v, room, order)
                           : FVI_ENOMEM;
    free(room);
    free(order);
    return status;
}

int fvi_divide_by_mass(const fvi_system *system, const double *p, double *v)
{
    const fvi_matrices *m = system->matrices;
    void *factors;
    for (size_t i = 0; i < system->d; i++)
        v[i] = m ? p[i] : p[i] / system->mass[i];
    if (!m)
        return FVI_SUCCESS;
    int status = m->factorise(system->d, 1, NULL, 0, m->params, &factors);
    if (status)
        return status;
    status = m->solve(system->d, factors, v);
    m->free_factors(factors);
    return status;
}

int fvi_momentum_of_velocity(const fvi_system *system, double t,
                             const double *x, const double *v, double *p)
{
    return system->matrices ? FVI_EUNSUP
                            : fvi_lagrangian_point(system, t, x, v, NULL, NULL,
                                                   p, NULL, NULL, NULL);
}

int fvi_energy_at(const fvi_system *system, double t, const double *x,
                  const double *p, double *E)
{
    const size_t d = system->d;
    if (!fvi_lagrangian_of(system))
        return fvi_energy(system, x, p, E);
    double *v = calloc(2 * d, sizeof *v), L = 0;
    if (!v)
        return FVI_ENOMEM;
    double *Lv = v + d;
    int status = fvi_velocity_of_momentum(system, t, x, p, v);
    if (!status)
        status = fvi_lagrangian_point(system, t, x, v, &L, NULL, Lv, NULL, NULL,
                                      NULL);
    double sum = -L;
    for (size_t i = 0; i < d && !status; i++)
        sum += v[i] * Lv[i]; /* (29.9) */
    free(v);
    if (!status && !isfinite(sum))
        return FVI_EOVRFLW; /* overflow is no mistake of the caller, so the error handler is not called */
    if (!status)
        *E = sum;
    return status;
}
