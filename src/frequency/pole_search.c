/* src/frequency/pole_search.c -- Find one pole of a system, from an undamped mode.  [H 30] */
#include "pole_search.h"

#include "kernel/kernel_terms.h"
#include "system/larger.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

int fvi_pole_is_found(const fvi_pole_candidate *p, double widest)
{
    return p->residual < 1e-12 && p->uncancelled < 0.01 && cimag(p->s) > 0
           && creal(p->s) <= 1e-10 * cabs(p->s) && carg(p->s) < widest;
}

/* ---- products of vectors; x^T y is without conjugation ---- */

static double norm(size_t d, const double complex *x)
{
    double sum = 0;
    for (size_t i = 0; i < d; i++)
        sum += creal(x[i]) * creal(x[i]) + cimag(x[i]) * cimag(x[i]);
    return sqrt(sum);
}

static double complex conjugate_product(size_t d, const double complex *x,
                                        const double complex *y)
{
    double complex sum = 0;
    for (size_t i = 0; i < d; i++)
        sum += conj(x[i]) * y[i];
    return sum;
}

/* Compute v^T A_l v for each term of Z. */
static void find_forms(const fvi_response *r, const double complex *v,
                       double complex *form)
{
    for (size_t l = 0; l < r->terms; l++) {
        const fvi_sparse *A = r->term[l].matrix;
        form[l] = 0;
        for (size_t j = 0; j < r->d; j++) {
            double complex sum = 0;
            for (int e = A->start[j]; e < A->start[j + 1]; e++)
                sum += A->entry[e] * v[A->row[e]];
            form[l] += v[j] * sum;
        }
    }
}

/* v^T Z v from these forms: the part without damping, the part of all dampings, and their slopes. */
typedef struct {
    double complex undamped, damping, undamped_slope, damping_slope;
} scalar_stiffness;

static scalar_stiffness stiffness_of(const fvi_response *r,
                                     const double complex *form,
                                     double complex s)
{
    scalar_stiffness f = { .undamped = s * s * form[0] + form[1],
                           .undamped_slope = 2 * s * form[0] };
    for (size_t l = 2; l < r->terms; l++) {
        double complex slope;
        f.damping += fvi_kernel_at(r->term[l].kernel, s, &slope) * form[l];
        f.damping_slope += slope / s * form[l];
    }
    return f;
}

/* ---- Newton ---- */

/* Return the zero of v^T Z(s) v near s, in the upper half plane. */
static double complex rayleigh(const fvi_response *r,
                               const double complex *form, double complex s)
{
    for (int i = 0; i < 30; i++) {
        const scalar_stiffness f = stiffness_of(r, form, s);
        const double complex step =
            (f.undamped + f.damping) / (f.undamped_slope + f.damping_slope);
        if (!isfinite(cabs(step)))
            return s;
        s -= step;
        if (cimag(s) < 0)
            s = conj(s);
        if (cabs(step) <= 1e-15 * cabs(s))
            break;
    }
    return s;
}

/* Replace v by Z^-1 Z' v at s, with its largest number equal to 1. At a pole Z has no inverse, so s is moved by some
 * rounding errors then. */
static int iterate_shape(fvi_response *r, double complex *s, double complex *v,
                         double complex *room)
{
    int status = fvi_stiffness_factorise(r, *s, 1);
    for (int i = 0; status == FVI_ESING && i < 4; i++) {
        *s *= 1 + 4 * DBL_EPSILON;
        status = fvi_stiffness_factorise(r, *s, 1);
    }
    if (status)
        return status;
    fvi_stiffness_multiply(r, r->slope, v, room);
    status = fvi_stiffness_solve(r, room);
    size_t top = 0;
    for (size_t i = 0; i < r->d; i++)
        if (cabs(room[i]) > cabs(room[top]))
            top = i;
    const double complex unit = room[top];
    for (size_t i = 0; i < r->d && isfinite(cabs(unit)); i++)
        v[i] = room[i] / unit;
    return status;
}

/* Return |A v| for one term. */
static double norm_of_product(const fvi_sparse *A, const double complex *v)
{
    double square = 0;
    for (size_t j = 0; j < A->n; j++) {
        double complex sum = 0;
        for (int e = A->start[j]; e < A->start[j + 1]; e++)
            sum += A->entry[e] * v[A->row[e]];
        square += creal(sum * conj(sum));
    }
    return sqrt(square);
}

static void find_residual(fvi_response *r, fvi_pole_candidate *p, double complex *room)
{
    double parts = 0;
    for (size_t l = 0; l < r->terms; l++) {
        const double complex factor =
            l == 0   ? p->s * p->s
            : l == 1 ? 1
                     : fvi_kernel_at(r->term[l].kernel, p->s, NULL);
        parts += cabs(factor) * norm_of_product(r->term[l].matrix, p->v);
    }
    fvi_stiffness_at(r, p->s, 1);
    fvi_stiffness_multiply(r, r->Z, p->v, room);
    const double left = norm(r->d, room);
    p->residual = left / (fvi_stiffness_norm(r, p->s) * norm(r->d, p->v));
    p->uncancelled = left / parts;
}

//> newton
/* Alternate: s becomes the zero of v^T Z(s) v, which is stationary in v at a shape because Z is symmetric; then v
 * becomes Z(s)^-1 Z'(s) v. End when s does not change, or when its steps are rounding errors and no longer shrink. */
static int newton_with(fvi_response *r, fvi_pole_candidate *p,
                       double complex *room, double complex *form)
{
    double last = HUGE_VAL;
    for (int i = 0; i < 50; i++) {
        const double complex before = p->s;
        find_forms(r, p->v, form);
        p->s = rayleigh(r, form, p->s);
        const double step = cabs(p->s - before) / cabs(p->s);
        if (i > 0 && (step <= 4e-15 || (step < 1e-7 && step > last / 2)))
            break;
        last = step;
        const int status = iterate_shape(r, &p->s, p->v, room);
        if (status == FVI_ENOMEM)
            return status;
        if (status || !isfinite(step))
            break;
    }
    find_residual(r, p, room);
    if (p->residual > 4 * DBL_EPSILON && p->residual < 1e-6) { /* v belongs to an older s */
        const int status = iterate_shape(r, &p->s, p->v, room);
        if (status == FVI_ENOMEM)
            return status;
        find_residual(r, p, room);
    }
    return FVI_SUCCESS;
}
//< newton

int fvi_pole_newton(fvi_response *r, fvi_pole_candidate *p)
{
    double complex *room = malloc((r->d + r->terms) * sizeof *room);
    if (!room)
        return FVI_ENOMEM;
    const int status = newton_with(r, p, room, room + r->d);
    free(room);
    return status;
}

double complex fvi_pole_start(const fvi_response *r, double lambda,
                              const double complex *v, double complex *form)
{
    double low = -300, high = 300;
    if (lambda > 0)
        return I * sqrt(lambda);
    find_forms(r, v, form);
    for (int i = 0; i < 60; i++) {
        const double middle = (low + high) / 2, omega = exp(middle);
        const scalar_stiffness f = stiffness_of(r, form, I * omega);
        *(cabs(f.damping) > omega * omega * cabs(form[0]) ? &low : &high) =
            middle;
    }
    return low == -300 ? 0 : I * exp(low);
}

double complex fvi_pole_estimate(const fvi_response *r, double lambda,
                                 const double complex *v, double complex *form)
{
    find_forms(r, v, form);
    return rayleigh(r, form, I * sqrt(lambda));
}

/* ---- along the damping ---- */

/* A pole on its path: s and v with the part e of the damping, |v| = 1, and the next step of e. */
typedef struct {
    double complex s, *v, *w, *x, *form;
    double e, step;
} path;

/* Find the pole with the part e of the damping near `guess`, and its shape, beginning with v. Write them to *z and w.
 * Return FVI_SUCCESS, FVI_EMAXITER, FVI_ENOMEM or what fvi_stiffness_factorise returns. */
static int correct_pole(fvi_response *r, path *p, double e, double complex guess,
                        double complex *z)
{
    const size_t d = r->d;
    *z = guess;
    memcpy(p->w, p->v, d * sizeof *p->w);
    for (int i = 0; i < 8; i++) {
        int status = fvi_stiffness_factorise(r, *z, e);
        if (status == FVI_ESING && i > 0)
            return FVI_SUCCESS;
        if (status)
            return status == FVI_ESING ? FVI_EMAXITER : status;
        fvi_stiffness_multiply(r, r->slope, p->w, p->x);
        status = fvi_stiffness_solve(r, p->x);
        if (status)
            return status;
        const double complex step = conjugate_product(d, p->w, p->w)
                                    / conjugate_product(d, p->w, p->x);
        const double size = norm(d, p->x);
        if (!isfinite(cabs(step)) || !(size > 0))
            return FVI_EMAXITER;
        *z -= step;
        for (size_t j = 0; j < d; j++)
            p->w[j] = p->x[j] / size;
        if (cabs(step) < 1e-6 * cabs(*z))
            return FVI_SUCCESS;
    }
    return FVI_EMAXITER;
}

//> path
/* Make one step of e, with the tangent ds/de = -v^T L v / v^T Z' v and Newton's method. The step is halved if s or the
 * shape would move too far, and doubled for the next time if they hardly move. */
static int advance(fvi_response *r, double tight, path *p)
{
    p->step = smaller(p->step, 1 - p->e);
    find_forms(r, p->v, p->form);
    const scalar_stiffness f = stiffness_of(r, p->form, p->s);
    const double complex tangent =
        -f.damping / (f.undamped_slope + p->e * f.damping_slope);
    const double complex guess = p->s + p->step * tangent;
    double complex z = 0;
    int status = FVI_EMAXITER;
    if (cimag(guess) > 0
        && cabs(p->step * tangent) <= 0.3 * tight * cabs(p->s))
        status = correct_pole(r, p, p->e + p->step, guess, &z);
    if (status == FVI_ENOMEM)
        return status;
    const double moved = status ? 1 : cabs(z - guess) / cabs(z),
                 turned =
                     status ? 1 : 1 - cabs(conjugate_product(r->d, p->w, p->v));
    if (!(cimag(z) > 0) || !(moved <= 0.1 * tight)
        || !(turned <= 0.1 * tight)) {
        p->step /= 2;
        return FVI_SUCCESS;
    }
    memcpy(p->v, p->w, r->d * sizeof *p->v);
    p->s = z;
    p->e += p->step;
    if (moved < 0.02 * tight && turned < 0.02 * tight)
        p->step *= 2;
    return FVI_SUCCESS;
}
//< path

int fvi_pole_follow(fvi_response *r, double tight, fvi_pole_candidate *c)
{
    const size_t d = r->d;
    double complex *room = malloc((2 * d + r->terms) * sizeof *room);
    if (!room)
        return FVI_ENOMEM;
    path p = { .s = c->s, .v = c->v, .w = room, .x = room + d,
               .form = room + 2 * d, .step = 0.25 };
    const double size = norm(d, p.v);
    for (size_t i = 0; i < d; i++)
        p.v[i] /= size;
    int status = FVI_SUCCESS;
    while (!status && p.e < 1 && p.step > 1e-7)
        status = advance(r, tight, &p);
    free(room);
    c->s = p.s;
    c->residual = 1;
    return status || p.e < 1 ? status : fvi_pole_newton(r, c);
}
