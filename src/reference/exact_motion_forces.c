/* src/reference/exact_motion_forces.c -- Compute accelerations and forces of dampers of an exact motion. [H 11] */
#include "exact_motion_state.h"

#include "kernel/kernel_terms.h"
#include "system/dot.h"

#include <fvi/dampers.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { FIRST = 2 /* M and K come before the dampings of a response */ };

static size_t count_dampings(const fvi_exact_motion *o)
{
    return o->response->terms - FIRST;
}

/* The dampers of a mechanism are the last of the dampings. */
static size_t count_dampers(const fvi_exact_motion *o)
{
    const fvi_mechanism *m = o->system.mechanism;
    return m ? m->damper_count : 1;
}

/* Return the gradient of the elongation of damper j, which is the same everywhere; NULL if it acts along none. */
static const double *gradient_of(const fvi_exact_motion *o, size_t j)
{
    return o->response->term[o->response->terms - count_dampers(o) + j].gradient;
}

size_t fvi_exact_motion_forces(const fvi_exact_motion *o)
{
    size_t count = 0;
    for (size_t j = 0; o && j < count_dampers(o); j++)
        count += gradient_of(o, j) ? 1 : o->d;
    return count;
}

//> dampers
void fvi_exact_motion_add_dampers(const fvi_exact_motion *o, const double complex *a,
                                  double complex s, double complex factor,
                                  const fvi_exact_sums *sums)
{
    const size_t d = o->d;
    for (size_t l = 0; l < count_dampings(o); l++) {
        const fvi_stiffness_term *t = &o->response->term[FIRST + l];
        const double complex force = factor * fvi_kernel_at(t->kernel, s, NULL), impulse = force / s;
        for (size_t i = 0; i < d; i++) { /* column i is row i */
            double complex sum = 0;
            for (int e = t->matrix->start[i]; e < t->matrix->start[i + 1]; e++)
                sum += t->matrix->entry[e] * a[t->matrix->row[e]];
            sums->force[l * d + i] += creal(force * sum);
            sums->impulse[l * d + i] += creal(impulse * sum);
        }
    }
}
//< dampers

void fvi_exact_motion_free_dampers(fvi_exact_motion *o)
{
    if (o->inertia)
        o->system.matrices->free_factors(o->inertia);
    free(o->sum);
    o->inertia = NULL;
    o->sum = NULL;
}

/* ---- what is made once ---- */

static int prepare_forces(fvi_exact_motion *o)
{
    const fvi_matrices *matrices = o->system.matrices;
    if (o->sum)
        return FVI_SUCCESS;
    o->sum = calloc((2 * count_dampings(o) + 1) * o->d, sizeof *o->sum);
    int status = o->sum ? FVI_SUCCESS : FVI_ENOMEM;
    if (!status && matrices)
        status = matrices->factorise(o->d, 1, NULL, 0, matrices->params, &o->inertia);
    if (status) /* so the next call begins anew */
        fvi_exact_motion_free_dampers(o);
    return status;
}

/* ---- at a time ---- */

static double force_at(const fvi_exact_motion *o, double t)
{
    return o->forcing == FVI_FORCING_STEP     ? (t <= o->T ? o->A : 0)
           : o->forcing == FVI_FORCING_COSINE ? o->A * cos(o->w * t)
                                              : 0;
}

/* Return nonzero if the damping acts as a mass: rho s^2 alone, on each coordinate. */
static int is_mass(const fvi_exact_motion *o)
{
    if (count_dampings(o) != 1 || o->system.matrices)
        return 0;
    const fvi_stiffness_term *t = &o->response->term[FIRST];
    int is_diagonal = fvi_kernel_is_power(t->kernel) && t->kernel->term->alpha == 1;
    for (size_t i = 0; i < o->d; i++)
        for (int e = t->matrix->start[i]; e < t->matrix->start[i + 1]; e++)
            is_diagonal &= t->matrix->row[e] == (int)i;
    return is_diagonal;
}

/* Compute the force R a of such a damping, with (m + R) a = F - grad U. */
static void find_force_of_mass(fvi_exact_motion *o, double *force)
{
    const fvi_stiffness_term *t = &o->response->term[FIRST];
    for (size_t i = 0; i < o->d; i++) {
        double R = 0;
        for (int e = t->matrix->start[i]; e < t->matrix->start[i + 1]; e++)
            R += t->kernel->term->rho * t->matrix->entry[e];
        force[i] = R * (force_at(o, 0) - o->spring_force[i]) / (o->system.mass[i] + R);
    }
}

/* Compute the forces at t = 0+ for a body that was held. If C(s) grows like c s, the force is c B v_0. If it grows more
 * slowly, the force is 0. If it grows faster, the force is infinite, or 0 if B v_0 = 0; the mean over the time `first`
 * takes the place of an infinite force. */
static int find_limits(fvi_exact_motion *o, double first, fvi_error *error)
{
    const size_t d = o->d, all = count_dampings(o) * d;
    double *force = o->sum, *impulse = force + all;
    const fvi_exact_sums sums = { .force = force, .impulse = impulse };
    int status = FVI_SUCCESS, is_infinite = 0;
    for (size_t l = 0; l < count_dampings(o); l++)
        is_infinite |= fvi_kernel_growth(o->response->term[FIRST + l].kernel) > 1;
    if (is_infinite)
        status = fvi_exact_motion_sum(o, first, &sums, error);
    for (size_t l = 0; l < count_dampings(o); l++) {
        const fvi_stiffness_term *t = &o->response->term[FIRST + l];
        const double growth = fvi_kernel_growth(t->kernel),
                     dashpot = growth == 1 ? fvi_kernel_dashpot(t->kernel) : 0;
        for (size_t i = 0; i < d; i++) {
            double rate = 0;
            for (int e = t->matrix->start[i]; e < t->matrix->start[i + 1]; e++)
                rate += t->matrix->entry[e] * o->v0[t->matrix->row[e]];
            const int has_mean = growth == 2 || (growth > 1 && rate != 0);
            force[l * d + i] = has_mean ? impulse[l * d + i] / first : dashpot * rate;
        }
    }
    if (is_mass(o))
        find_force_of_mass(o, force);
    memset(impulse, 0, all * sizeof *impulse);
    return status;
}

/* a = M^-1 (F - grad U - the forces of dampers), with grad U = K x_0 + K (x - x_0). */
static int find_acceleration(fvi_exact_motion *o, double t, const double *x, double *a)
{
    const size_t d = o->d;
    const fvi_sparse *K = o->response->term[1].matrix;
    const double F = force_at(o, t);
    for (size_t i = 0; i < d; i++) {
        a[i] = F - o->spring_force[i];
        for (int e = K->start[i]; e < K->start[i + 1]; e++)
            a[i] -= K->entry[e] * (x[K->row[e]] - o->x0[K->row[e]]);
        for (size_t l = 0; l < count_dampings(o); l++)
            a[i] -= o->sum[l * d + i];
        if (!o->system.matrices)
            a[i] /= o->system.mass[i];
    }
    return o->system.matrices ? o->system.matrices->solve(d, o->inertia, a) : FVI_SUCCESS;
}

/* Write the forces of all dampers, one damper after another. Along an elongation the force is f = lambda g, and lambda
 * is written. */
static void write_damper_forces(const fvi_exact_motion *o, const double *sum, double *told)
{
    const size_t d = o->d, before = count_dampings(o) - (o->system.mechanism ? count_dampers(o) : 0);
    for (size_t j = 0; j < count_dampers(o); j++) {
        const double *f = sum + (o->system.mechanism ? before + j : 0) * d, *g = gradient_of(o, j);
        const double square = g ? fvi_dot(d, g, g) : 0;
        if (g)
            *told++ = square > 0 ? fvi_dot(d, g, f) / square : 0;
        for (size_t i = 0; i < d && !g; i++)
            *told++ = count_dampings(o) > 0 ? f[i] : 0;
    }
}

int fvi_exact_motion_forces_at(fvi_exact_motion *o, double t, double first,
                               const fvi_exact_outputs *out, fvi_error *error)
{
    if (!o || !out || !out->x || !out->v)
        return fvi_fail(error, FVI_EFAULT, NULL, NAN, "null pointer");
    if (!(isfinite(t) && t >= 0))
        return fvi_fail(error, FVI_EDOM, "t", t, "t is %g; it must be finite and not negative", t);
    if (!(isfinite(first) && first > 0))
        return fvi_fail(error, FVI_EDOM, "first", first, "first is %g; it must be finite and positive", first);
    int status = prepare_forces(o);
    if (status)
        return fvi_fail(error, status, NULL, NAN, "%s", fvi_error_name(status));
    const size_t all = count_dampings(o) * o->d, told = fvi_exact_motion_forces(o);
    const fvi_exact_sums sums = { out->x, out->v, o->sum, o->sum + all };
    memset(o->sum, 0, 2 * all * sizeof *o->sum);
    status = fvi_exact_motion_sum(o, t, &sums, error);
    if (!status && t == 0)
        status = find_limits(o, first, error);
    if (!status && out->a)
        status = find_acceleration(o, t, out->x, out->a);
    if (status)
        return status;
    if (out->force)
        write_damper_forces(o, o->sum, out->force);
    if (out->impulse)
        write_damper_forces(o, o->sum + all, out->impulse);
    return fvi_all_finite(o->d, out->x) && fvi_all_finite(o->d, out->v)
                   && (!out->a || fvi_all_finite(o->d, out->a))
                   && (!out->force || fvi_all_finite(told, out->force))
                   && (!out->impulse || fvi_all_finite(told, out->impulse))
               ? FVI_SUCCESS
               : fvi_fail(error, FVI_EOVRFLW, NULL, t, "the motion is not finite at t = %g", t);
}
