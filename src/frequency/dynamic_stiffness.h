/* src/frequency/dynamic_stiffness.h -- Z(s) = s^2 M + K + sum_j C_j(s) B_j.  [H 30]
 *
 * Internal: what the files of this room share. */
#ifndef FVI_DYNAMIC_STIFFNESS_H
#define FVI_DYNAMIC_STIFFNESS_H

#include <fvi/response.h>
#include <fvi/structures.h>

#include <complex.h>

/* Up to so many unknowns Z has dense factors, and a determinant. */
enum { FVI_ALWAYS_DENSE = 24 };

/* A matrix of the sum: M, K or a B_j. An entry e of it stands at place[e] of the sum's. */
typedef struct {
    fvi_sparse own;          /* empty where the matrix is the caller's */
    const fvi_sparse *matrix;
    const fvi_kernel *kernel; /* of a damping */
    int *place;
    double norm;              /* Frobenius's */
} fvi_stiffness_term;

typedef struct fvi_complex_factors fvi_complex_factors;

struct fvi_response {
    size_t d, terms;
    fvi_stiffness_term *term; /* M, K, then the dampings */
    double *along;            /* how the unknowns move with the ground */
    fvi_kernel_term power;    /* D^{2 alpha} as a law */
    fvi_kernel powers;
    int *start, *row;         /* the pattern of the sum, by columns */
    double complex *Z, *slope; /* its entries, and those of Z' */
    double complex *full;      /* all of them, where that is how Z is solved */
    double complex s;         /* where, */
    double e;                 /* and with which part of the damping, they are */
    int is_evaluated, is_factorised, is_dense;
    fvi_complex_factors *factors;
};

/* fvi_stiffness_build -- M, K and the dampings of a motion, into a response that is zeroed but
 * for d. Returns as fvi_response_alloc; the response is to be freed in any case. */
int fvi_stiffness_build(const fvi_linear_motion *motion, fvi_response *response,
                        fvi_error *error);

/* fvi_stiffness_find_pattern -- of the sum of all terms, and room for it and its factors. Returns
 * FVI_SUCCESS or FVI_ENOMEM. */
int fvi_stiffness_find_pattern(fvi_response *response);

/* fvi_stiffness_at -- Z(s) and Z'(s), with e times the damping. */
void fvi_stiffness_at(fvi_response *response, double complex s, double e);

/* fvi_stiffness_factorise -- factors of Z(s). Returns FVI_SUCCESS, FVI_ESING or FVI_ENOMEM. */
int fvi_stiffness_factorise(fvi_response *response, double complex s, double e);

/* fvi_stiffness_solve -- x becomes Z^-1 x with these factors. Returns FVI_SUCCESS or
 * FVI_ENOMEM. */
int fvi_stiffness_solve(const fvi_response *response, double complex *x);

/* fvi_stiffness_multiply -- y = A x, A the entries Z or slope of the response. */
void fvi_stiffness_multiply(const fvi_response *response,
                            const double complex *A, const double complex *x,
                            double complex *y);

/* fvi_stiffness_norm -- |s|^2 |M| + |K| + sum_j |C_j(s)| |B_j|: of what Z(s) is summed. */
double fvi_stiffness_norm(const fvi_response *response, double complex s);

/* fvi_stiffness_phase -- arg det Z with these factors, by whole turns; of dense factors only. */
double fvi_stiffness_phase(const fvi_response *response);

#endif
