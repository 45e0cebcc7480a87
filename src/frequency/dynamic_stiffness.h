/* src/frequency/dynamic_stiffness.h -- Compute Z(s) = s^2 M + K + sum_j C_j(s) B_j.  [H 30]
 *
 * This header is internal: it declares what the files of this folder share. */
#ifndef FVI_DYNAMIC_STIFFNESS_H
#define FVI_DYNAMIC_STIFFNESS_H

#include "matrices/complex_factors.h"

#include <fvi/response.h>
#include <fvi/structures.h>

/* Up to this number of unknowns Z has dense factors, and a determinant. */
enum { FVI_ALWAYS_DENSE = 24 };

/* A term of the sum, with its matrix M, K or B_j. */
typedef struct {
    fvi_sparse owned;        /* empty if the matrix belongs to the caller */
    const fvi_sparse *matrix;
    const fvi_kernel *kernel; /* of a damping; NULL for M and K */
    double *gradient;         /* of the elongation of a damper, d numbers; NULL for all others; owned */
    double norm;              /* Frobenius norm of the matrix */
} fvi_stiffness_term;

struct fvi_response {
    size_t d, terms;
    fvi_stiffness_term *term; /* M, K, then the dampings */
    double complex *along;    /* the motion of the unknowns with the ground; real */
    fvi_kernel_term power;    /* D^{2 alpha} as a law */
    fvi_kernel powers;
    int *start, *row;         /* pattern of the sum, by columns */
    int *place;               /* the position in the sum of each entry of each term, one term after another */
    double complex *Z, *slope; /* entries of Z and of Z' */
    double complex *full;      /* all entries of Z, if its factors are dense */
    double complex s;         /* the s of these entries */
    double e;                 /* the part of the damping that they contain */
    int is_evaluated, is_factorised, is_dense;
    fvi_complex_factors *factors;
};

/* fvi_stiffness_build -- Add M, K and the dampings of a motion to a response, which is all 0 except for d and along.
 * Return what fvi_response_alloc returns. Free the response in each case. */
int fvi_stiffness_build(const fvi_linear_motion *motion, fvi_response *response,
                        fvi_error *error);

/* fvi_stiffness_find_pattern -- Find the pattern of the sum of all terms, and allocate the sum and its factors. Return
 * FVI_SUCCESS or FVI_ENOMEM. */
int fvi_stiffness_find_pattern(fvi_response *response);

/* fvi_stiffness_at -- Compute Z(s) and Z'(s) with e times the damping. */
void fvi_stiffness_at(fvi_response *response, double complex s, double e);

/* fvi_stiffness_factorise -- Compute response->factors, those of Z(s). Return FVI_SUCCESS, FVI_ESING, FVI_ENOMEM or
 * what fvi_interrupted returns. */
int fvi_stiffness_factorise(fvi_response *response, double complex s, double e);

/* fvi_stiffness_multiply -- Compute y = A x. A is the array Z or slope of the response. */
void fvi_stiffness_multiply(const fvi_response *response,
                            const double complex *A, const double complex *x,
                            double complex *y);

/* fvi_stiffness_factor -- Return s^2, 1 or C_j(s), the factor of term l.
 * fvi_stiffness_add_product -- Add a factor times A v to y, for the symmetric matrix A of a term. Return the norm of
 * what is added. */
double complex fvi_stiffness_factor(const fvi_response *response, size_t l, double complex s);
double fvi_stiffness_add_product(const fvi_sparse *A, double complex factor, const double complex *v,
                                 double complex *y);

/* fvi_stiffness_norm -- Return |s|^2 |M| + |K| + sum_j |C_j(s)| |B_j|, which bounds |Z(s)|. */
double fvi_stiffness_norm(const fvi_response *response, double complex s);

#endif
