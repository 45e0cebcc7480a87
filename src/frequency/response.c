/* src/frequency/response.c -- Compute responses by frequency.                  [H 30] */
#include "dynamic_stiffness.h"

#include "system/system_check.h"

#include <fvi/dampers.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A Lagrangian, forces of velocity and constraints are not linearised. */
static int check_mechanism(const fvi_mechanism *m, fvi_error *error)
{
    const char *field = !m                ? NULL
                        : m->lagrangian   ? "lagrangian"
                        : m->force_on     ? "force"
                        : m->constraints ? "constraint"
                                          : NULL;
    return field ? fvi_fail(error, FVI_EUNSUP, field, NAN, "only masses, a potential and dampers are made linear")
                 : FVI_SUCCESS;
}

static int copy_direction(const fvi_linear_motion *motion, fvi_response *r,
                          fvi_error *error)
{
    r->along = malloc(r->d * sizeof *r->along);
    if (!r->along)
        return fvi_no_memory(error, NULL);
    for (size_t i = 0; i < r->d; i++)
        r->along[i] = motion->along ? motion->along[i] : 1;
    return fvi_all_finite(2 * r->d, (const double *)r->along)
               ? FVI_SUCCESS
               : fvi_fail(error, FVI_EDOM, "along", NAN, "how the unknowns move with the ground is not finite");
}

int fvi_response_alloc(const fvi_linear_motion *motion, fvi_response **response,
                       fvi_error *error)
{
    if (!motion || !motion->system || !response)
        return fvi_fail(error, FVI_EFAULT, "system", NAN, "null pointer");
    int status = check_mechanism(motion->system->mechanism, error);
    if (!status)
        status = fvi_system_check_any(motion->system, error);
    if (status)
        return status;
    for (size_t i = 0; motion->at && i < motion->system->d; i++)
        if (!isfinite(motion->at[i]))
            return fvi_fail(error, FVI_EDOM, "at", motion->at[i], "the place is not finite");
    fvi_response *r = calloc(1, sizeof *r);
    if (!r)
        return fvi_no_memory(error, NULL);
    r->d = motion->system->d;
    status = copy_direction(motion, r, error);
    if (!status)
        status = fvi_stiffness_build(motion, r, error);
    if (status)
        fvi_response_free(r);
    else
        *response = r;
    return status;
}

void fvi_response_free(fvi_response *r)
{
    if (!r)
        return;
    for (size_t l = 0; l < r->terms; l++) {
        fvi_sparse_free(&r->term[l].owned);
        free(r->term[l].gradient);
    }
    fvi_complex_factors_free(r->factors);
    free(r->term);
    free(r->along);
    free(r->place);
    free(r->start);
    free(r->row);
    free(r->Z);
    free(r);
}

size_t fvi_response_dimension(const fvi_response *r)
{
    return r->d;
}

/* ---- one s ---- */

/* Make s a complex number; on the upper side of the cut if its imaginary part is zero. */
static int read_frequency(const double s[2], double complex *z, fvi_error *error)
{
    *z = s[0] + I * fabs(s[1]);
    if (s[1] < 0)
        *z = conj(*z);
    if (!isfinite(s[0]) || !isfinite(s[1]) || *z == 0)
        return fvi_fail(error, FVI_EDOM, "s", s[0], "s must be finite and not zero");
    return FVI_SUCCESS;
}

static int refuse_pole(int status, fvi_error *error)
{
    return fvi_fail(error, status, NULL, NAN,
                    status == FVI_ESING ? "this is a pole: there is no response" : "not enough memory");
}

int fvi_response_solve(fvi_response *r, const double s[2], const double *f,
                       double *x, fvi_error *error)
{
    double complex z;
    if (!r || !s || !f || !x)
        return fvi_fail(error, FVI_EFAULT, NULL, NAN, "null pointer");
    int status = read_frequency(s, &z, error);
    if (status)
        return status;
    status = fvi_stiffness_factorise(r, z, 1);
    if (!status) {
        memmove(x, f, 2 * r->d * sizeof *x);
        status = fvi_complex_factors_solve(r->factors, (double complex *)x);
    }
    if (status)
        return refuse_pole(status, error);
    return fvi_all_finite(2 * r->d, x)
               ? FVI_SUCCESS
               : fvi_fail(error, FVI_EOVRFLW, NULL, NAN, "the response is not finite");
}

int fvi_response_multiply(fvi_response *r, const double s[2], int derivative,
                          const double *x, double *y, fvi_error *error)
{
    double complex z;
    if (!r || !s || !x || !y)
        return fvi_fail(error, FVI_EFAULT, NULL, NAN, "null pointer");
    const int status = read_frequency(s, &z, error);
    if (status)
        return status;
    fvi_stiffness_at(r, z, 1);
    fvi_stiffness_multiply(r, derivative ? r->slope : r->Z,
                           (const double complex *)x, (double complex *)y);
    return fvi_all_finite(2 * r->d, y)
               ? FVI_SUCCESS
               : fvi_fail(error, FVI_EOVRFLW, NULL, NAN, "the product is not finite");
}

/* ---- responses ---- */

//> kinds
static double complex convert_receptance(fvi_response_kind kind, double omega,
                                         double complex along, double complex x)
{
    switch (kind) {
    case FVI_RESPONSE_MOBILITY:
        return I * omega * x;
    case FVI_RESPONSE_ACCELERANCE:
        return -omega * omega * x;
    case FVI_RESPONSE_GROUND:
        return along + omega * omega * x;
    case FVI_RESPONSE_RECEPTANCE:
        break;
    }
    return x;
}
//< kinds

//> ground
/* Compute the load for a ground that moves along r: M r, or the forces (K + sum_j C_j B_j) r by which springs and
 * dampers pull the unknowns along. Omega^2 M r and these forces are two loads for the answer relative to the ground and
 * for the whole answer. The smaller load has the smaller rounding errors. Return 1 if x is the second load. `x` has 2 d
 * numbers. (30.3) */
static int assemble_ground_load(const fvi_response *r, double omega, double complex *x)
{
    const size_t d = r->d;
    double complex *forces = x + d;
    double size_of_forces = 0, size;
    memset(x, 0, 2 * d * sizeof *x);
    size = omega * omega * fvi_stiffness_add_product(r->term[0].matrix, 1, r->along, x);
    for (size_t l = 1; l < r->terms; l++)
        size_of_forces += fvi_stiffness_add_product(r->term[l].matrix, fvi_stiffness_factor(r, l, I * omega),
                                                    r->along, forces);
    const int is_whole = size_of_forces < size;
    if (is_whole)
        memcpy(x, forces, d * sizeof *x);
    return is_whole;
}
//< ground

static int solve_at_frequency(fvi_response *r, fvi_response_kind kind, double omega,
                              size_t at, size_t by, double complex *x,
                              double H[2])
{
    if (!(isfinite(omega) && omega > 0))
        return FVI_EDOM;
    int status = fvi_stiffness_factorise(r, I * omega, 1);
    if (status)
        return status;
    for (size_t j = 0; j < r->d; j++)
        x[j] = j == by; /* a force of 1 */
    const int is_whole = kind == FVI_RESPONSE_GROUND && assemble_ground_load(r, omega, x);
    status = fvi_complex_factors_solve(r->factors, x);
    const double complex h = is_whole ? x[at] : convert_receptance(kind, omega, r->along[at], x[at]);
    H[0] = creal(h);
    H[1] = cimag(h);
    return status                  ? status
           : fvi_all_finite(2, H) ? FVI_SUCCESS
                                   : FVI_EOVRFLW;
}

int fvi_response_at(fvi_response *r, fvi_response_kind kind, size_t n,
                    const double *omega, size_t at, size_t by, double *H,
                    fvi_error *error)
{
    if (!r || !omega || !H)
        return fvi_fail(error, FVI_EFAULT, NULL, NAN, "null pointer");
    if ((unsigned)kind > FVI_RESPONSE_GROUND)
        return fvi_fail(error, FVI_EINVAL, "kind", (double)kind, "no such response");
    if (at >= r->d || (kind != FVI_RESPONSE_GROUND && by >= r->d))
        return fvi_fail(error, FVI_EINVAL, at >= r->d ? "at" : "by", (double)(at >= r->d ? at : by),
                        "there are %zu unknowns", r->d);
    double complex *x = malloc(2 * r->d * sizeof *x); /* the second half for a moving ground */
    if (!x)
        return fvi_no_memory(error, NULL);
    int status = FVI_SUCCESS;
    for (size_t i = 0; !status && i < n; i++) {
        status = solve_at_frequency(r, kind, omega[i], at, by, x, H + 2 * i);
        if (!status)
            continue;
        (void)fvi_fail(error, status, "omega", omega[i], "at omega = %g %s",
                       omega[i],
                       status == FVI_EDOM ? "there is none: it must be finite "
                                            "and positive"
                       : status == FVI_ESING
                           ? "the response is infinite: a mode without damping"
                       : status == FVI_ENOMEM ? "there is not enough memory"
                                              : "the response is not finite");
        if (error)
            error->index = i;
    }
    free(x);
    return status;
}
