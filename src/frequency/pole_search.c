/* src/frequency/pole_search.c -- Find one pole of a system, from an undamped mode.  [H 30] */
#include "pole_search.h"

#include "kernel/kernel_terms.h"
#include "system/larger.h"
#include "system/seeded.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

int fvi_pole_is_found(const fvi_pole_candidate *p, double widest)
{
    /* The residual is a few rounding errors, and cancellation made it so. The pole oscillates, and does not grow by
     * more than rounding errors. */
    return p->residual < 1e-12 && p->uncancelled < 0.01 && cimag(p->s) > 0
           && creal(p->s) <= 1e-10 * cabs(p->s) && carg(p->s) < widest;
}

/* ---- two at one pole ---- */

int fvi_pole_is_close(const fvi_pole_candidate *a, const fvi_pole_candidate *b)
{
    return cabs(a->s - b->s) < 1e-9 * cabs(a->s);
}

/* Return |x^* y| divided by the product of the norms. */
static double modal_assurance(size_t d, const double complex *x,
                              const double complex *y)
{
    double complex xy = 0;
    double xx = 0, yy = 0;
    for (size_t i = 0; i < d; i++) {
        xy += conj(x[i]) * y[i];
        xx += creal(conj(x[i]) * x[i]);
        yy += creal(conj(y[i]) * y[i]);
    }
    return cabs(xy) / sqrt(xx * yy);
}

int fvi_pole_is_same(size_t d, const fvi_pole_candidate *a, const fvi_pole_candidate *b)
{
    return fvi_pole_is_close(a, b) && modal_assurance(d, a->v, b->v) > 1 - 1e-6;
}

/* ---- products of vectors; v^T A v is without conjugation ---- */

/* Return the Euclidean norm of d complex numbers. */
static double norm(size_t d, const double complex *x)
{
    double sum = 0;
    for (size_t i = 0; i < d; i++)
        sum += creal(x[i]) * creal(x[i]) + cimag(x[i]) * cimag(x[i]);
    return sqrt(sum);
}

/* Return the sum of conj(x_i) y_i. */
static double complex conjugate_product(size_t d, const double complex *x,
                                        const double complex *y)
{
    double complex sum = 0;
    for (size_t i = 0; i < d; i++)
        sum += conj(x[i]) * y[i];
    return sum;
}

/* Compute form[l] = v^T A_l v for each term l of Z. The matrices A_l are M, K and the B_j of the dampings. */
static void compute_forms(const fvi_response *r, const double complex *v,
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

/* The function v^T Z(s) v of s for a fixed shape v: its part s^2 v^T M v + v^T K v, its part from all dampings, and the
 * derivatives of both parts by s. */
typedef struct {
    double complex undamped, damping, undamped_slope, damping_slope;
} scalar_stiffness;

/* Compute v^T Z(s) v from the forms of v. */
static scalar_stiffness evaluate_scalar_stiffness(const fvi_response *r,
                                                  const double complex *form,
                                                  double complex s)
{
    scalar_stiffness f = { .undamped = s * s * form[0] + form[1],
                           .undamped_slope = 2 * s * form[0] };
    for (size_t l = 2; l < r->terms; l++) {
        double complex s_times_slope; /* s C'(s) */
        f.damping += fvi_kernel_at(r->term[l].kernel, s, &s_times_slope) * form[l];
        f.damping_slope += s_times_slope / s * form[l];
    }
    return f;
}

/* ---- Newton ---- */

/* Return the zero of v^T Z(s) v near s in the upper half plane, by Newton's method for one unknown. */
static double complex find_zero_of_form(const fvi_response *r,
                                        const double complex *form, double complex s)
{
    for (int i = 0; i < 30; i++) {
        const scalar_stiffness f = evaluate_scalar_stiffness(r, form, s);
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

/* Replace v by Z^-1 Z' v at s, scaled so that its largest number is 1. At a pole Z has no inverse. If the factors say
 * so, s moves by some rounding errors. `room` has d numbers. */
static int update_shape(fvi_response *r, double complex *s, double complex *v,
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
    status = fvi_complex_factors_solve(r->factors, room);
    size_t largest = 0;
    for (size_t i = 0; i < r->d; i++)
        if (cabs(room[i]) > cabs(room[largest]))
            largest = i;
    const double complex unit = room[largest];
    for (size_t i = 0; i < r->d && isfinite(cabs(unit)); i++)
        v[i] = room[i] / unit;
    return status;
}

/* Compute p->residual and p->uncancelled for s and v of the candidate. The terms of Z v are added, and not the terms of
 * Z, because K would hide the other terms near s = 0, where K v may be 0. `room` has d numbers. */
static void compute_residual(const fvi_response *r, fvi_pole_candidate *p, double complex *room)
{
    double sum_of_norms = 0, norm_of_Zv = 0; /* sum_of_norms: of the terms of Z v */
    memset(room, 0, r->d * sizeof *room);
    for (size_t l = 0; l < r->terms; l++)
        sum_of_norms += fvi_stiffness_add_product(r->term[l].matrix, fvi_stiffness_factor(r, l, p->s), p->v, room);
    for (size_t j = 0; j < r->d; j++)
        norm_of_Zv = hypot(norm_of_Zv, cabs(room[j]));
    p->residual = norm_of_Zv / (fvi_stiffness_norm(r, p->s) * norm(r->d, p->v));
    p->uncancelled = norm_of_Zv / sum_of_norms;
}

//> newton
/* Alternate: s becomes the zero of v^T Z(s) v, which is stationary in v at a shape because Z is symmetric; then v
 * becomes Z(s)^-1 Z'(s) v. End when s does not change, or when its steps are rounding errors and no longer shrink.
 * `room` has d numbers, and `form` has one for each term of Z. */
static int alternate_pole_and_shape(fvi_response *r, fvi_pole_candidate *p,
                                    double complex *room, double complex *form)
{
    double last_step = HUGE_VAL;
    for (int i = 0; i < 50; i++) {
        const double complex before = p->s;
        compute_forms(r, p->v, form);
        p->s = find_zero_of_form(r, form, p->s);
        const double step = cabs(p->s - before) / cabs(p->s);
        if (i > 0 && (step <= 4e-15 || (step < 1e-7 && step > last_step / 2)))
            break;
        last_step = step;
        const int status = update_shape(r, &p->s, p->v, room);
        if (status == FVI_ENOMEM)
            return status;
        if (status || !isfinite(step))
            break;
    }
    compute_residual(r, p, room);
    if (p->residual > 4 * DBL_EPSILON && p->residual < 1e-6) { /* v belongs to an older s */
        const int status = update_shape(r, &p->s, p->v, room);
        if (status == FVI_ENOMEM)
            return status;
        compute_residual(r, p, room);
    }
    return FVI_SUCCESS;
}
//< newton

int fvi_pole_newton(fvi_response *r, fvi_pole_candidate *p)
{
    double complex *room = malloc((r->d + r->terms) * sizeof *room);
    if (!room)
        return FVI_ENOMEM;
    const int status = alternate_pole_and_shape(r, p, room, room + r->d);
    free(room);
    return status;
}

/* Two steps of inverse iteration turn the random numbers toward the shape. */
int fvi_pole_newton_from(fvi_response *r, fvi_pole_candidate *p, uint64_t *seed)
{
    double complex *room = malloc((r->d + r->terms) * sizeof *room);
    int status = room ? FVI_SUCCESS : FVI_ENOMEM;
    for (size_t i = 0; i < r->d; i++)
        p->v[i] = fvi_seeded_uniform(seed, -1, 1);
    for (int i = 0; !status && i < 2; i++)
        status = update_shape(r, &p->s, p->v, room);
    if (!status)
        status = alternate_pole_and_shape(r, p, room, room + r->d);
    else
        p->residual = 1; /* no pole was found */
    free(room);
    return status == FVI_ESING ? FVI_SUCCESS : status;
}

double complex fvi_pole_start(const fvi_response *r, double lambda,
                              const double complex *v, double complex *form)
{
    const double least = -300; /* of ln omega */
    double low = least, high = 300;
    if (lambda > 0)
        return I * sqrt(lambda);
    compute_forms(r, v, form);
    for (size_t l = 2; l < r->terms; l++) /* a damper that does not act on v has a rounding error */
        if (cabs(form[l]) <= 1e-14 * r->term[l].norm * norm(r->d, v) * norm(r->d, v))
            form[l] = 0;
    /* Bisect. Below the frequency that is sought, the damping is larger than the inertia. */
    for (int i = 0; i < 60; i++) {
        const double middle = (low + high) / 2, omega = exp(middle);
        const scalar_stiffness f = evaluate_scalar_stiffness(r, form, I * omega);
        if (cabs(f.damping) > omega * omega * cabs(form[0]))
            low = middle;
        else
            high = middle;
    }
    return low == least ? 0 : I * exp(low);
}

double complex fvi_pole_estimate(const fvi_response *r, double lambda,
                                 const double complex *v, double complex *form)
{
    compute_forms(r, v, form);
    return find_zero_of_form(r, form, I * sqrt(lambda));
}

/* ---- while the damping grows ---- */

/* A pole on its path, while the part e of the damping grows from 0 to 1. */
typedef struct {
    double complex s, *v; /* pole and shape for the present e; |v| = 1 */
    double complex *w;    /* the shape for the next e, |w| = 1 */
    double complex *x;    /* room for Z^-1 Z' w, d numbers */
    double complex *form; /* room for one number for each term of Z */
    double e, step;       /* present part of the damping; how much the next step adds to it */
} damping_path;

/* Find the pole with the part e of the damping near `guess`, and its shape, beginning with p->v. Write the pole to *z
 * and the shape to p->w. With x = Z^-1 Z' w, Newton's step of z is -w^* w / w^* x, and the next w is x / |x|. Return
 * FVI_SUCCESS, FVI_EMAXITER, FVI_ENOMEM or what fvi_stiffness_factorise returns. */
static int correct_pole_and_shape(fvi_response *r, damping_path *p, double e, double complex guess,
                                  double complex *z)
{
    const size_t d = r->d;
    *z = guess;
    memcpy(p->w, p->v, d * sizeof *p->w);
    for (int i = 0; i < 8; i++) {
        int status = fvi_stiffness_factorise(r, *z, e);
        if (status == FVI_ESING && i > 0)
            return FVI_SUCCESS; /* z is a pole to all digits */
        if (status)
            return status == FVI_ESING ? FVI_EMAXITER : status;
        fvi_stiffness_multiply(r, r->slope, p->w, p->x);
        status = fvi_complex_factors_solve(r->factors, p->x);
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
/* Try one step of e: predict s with the tangent ds/de = -v^T L v / v^T Z' v, where L is the damping, and correct it by
 * Newton's method. If s or the shape moves too far, keep the present pole and halve the step. If both hardly move,
 * double the step for the next time. Return FVI_SUCCESS in all these cases, or FVI_ENOMEM. */
static int advance_along_path(fvi_response *r, double limit_factor, damping_path *p)
{
    p->step = smaller(p->step, 1 - p->e);
    compute_forms(r, p->v, p->form);
    const scalar_stiffness f = evaluate_scalar_stiffness(r, p->form, p->s);
    const double complex tangent =
        -f.damping / (f.undamped_slope + p->e * f.damping_slope);
    const double complex guess = p->s + p->step * tangent;
    double complex z = 0;
    int status = FVI_EMAXITER;
    if (cimag(guess) > 0
        && cabs(p->step * tangent) <= 0.3 * limit_factor * cabs(p->s))
        status = correct_pole_and_shape(r, p, p->e + p->step, guess, &z);
    if (status == FVI_ENOMEM)
        return status;
    /* the correction relative to |s|, and 1 minus the cosine between the shapes; 1 if no pole was found */
    const double moved = status ? 1 : cabs(z - guess) / cabs(z),
                 turned =
                     status ? 1 : 1 - cabs(conjugate_product(r->d, p->w, p->v));
    if (!(cimag(z) > 0) || !(moved <= 0.1 * limit_factor)
        || !(turned <= 0.1 * limit_factor)) {
        p->step /= 2;
        return FVI_SUCCESS;
    }
    memcpy(p->v, p->w, r->d * sizeof *p->v);
    p->s = z;
    p->e += p->step;
    if (moved < 0.02 * limit_factor && turned < 0.02 * limit_factor)
        p->step *= 2;
    return FVI_SUCCESS;
}
//< path

int fvi_pole_follow(fvi_response *r, double limit_factor, fvi_pole_candidate *c)
{
    const size_t d = r->d;
    double complex *room = malloc((2 * d + r->terms) * sizeof *room);
    if (!room)
        return FVI_ENOMEM;
    damping_path p = { .s = c->s, .v = c->v, .w = room, .x = room + d,
               .form = room + 2 * d, .step = 0.25 };
    const double size = norm(d, p.v);
    for (size_t i = 0; i < d; i++)
        p.v[i] /= size;
    int status = FVI_SUCCESS;
    while (!status && p.e < 1 && p.step > 1e-7)
        status = advance_along_path(r, limit_factor, &p);
    free(room);
    c->s = p.s;
    c->residual = 1; /* not found, unless Newton's method finds it */
    return status || p.e < 1 ? status : fvi_pole_newton(r, c);
}
