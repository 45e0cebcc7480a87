/* src/reference/exact_inverse.h -- Invert the Laplace transform of the linear problem.        [H 11]
 *
 * exact_solution.c uses these functions. They prepare the transform of a checked problem once, and invert it at any
 * number of times. */
#ifndef FVI_EXACT_INVERSE_H
#define FVI_EXACT_INVERSE_H

#include <fvi/exact_solution.h>
#include "frequency/exact_pole.h"

enum { FVI_ZEROS = 3, FVI_POLES = FVI_ZEROS + 1, FVI_NODES = 288 };

//> contour
/* The hyperbola z(u) of (11.10) at u = (k + 1/2) h, and the factors of the integrand that are the same for all problems
 * of this order and all times. */
typedef struct {
    size_t count;
    double complex z[FVI_NODES], weight[FVI_NODES], power[FVI_NODES];
} fvi_contour;
//< contour

/* A pole s + low of the transform, and its residues without e^{st}. */
typedef struct {
    double complex s, low;
    double complex start, force; /* residues of x0 and v0, and of F */
} fvi_residue;

/* Everything that does not depend on t. */
typedef struct {
    fvi_linear_oscillator p;
    double beta;              /* 2 alpha */
    int keeps_x0, keeps_v0;   /* 1 or 0: kappa_0 and kappa_1 of (11.2) */
    fvi_pole root[FVI_ZEROS]; /* zeros of Q; without a law one or none */
    size_t roots;
    fvi_residue pole[FVI_POLES]; /* poles at the zeros of Q, then that of a cosine */
    size_t poles;
    int closed; /* nonzero if the transform has no other singularity than these poles */
    fvi_contour contour[FVI_POLES + 1]; /* made when first needed; count > 0 then */
} fvi_inverse;

/* A source of the motion, which began a time t ago. `start` is 1 if it contains x0 and v0, else 0. It also contains
 * `sign` times the force, which ended `lasts` after its beginning if lasts > 0. For example, soon after T a step from 0
 * to T is two sources: one with sign 1, and from T on one with sign -1. */
typedef struct {
    double t, start, sign, lasts;
} fvi_exact_source;

/* fvi_inverse_prepare -- Compute poles and residues. The problem must have been checked. Return FVI_SUCCESS; for a law
 * what fvi_kernel_poles returns. */
int fvi_inverse_prepare(const fvi_linear_oscillator *problem, fvi_inverse *S,
                        fvi_error *error);

/* fvi_inverse_contour -- Return contour number `place` of S->poles + 1, for (11.11). */
const fvi_contour *fvi_inverse_contour(fvi_inverse *S, size_t place);

/* fvi_inverse_add -- Add the contribution of a source to x and v. t > 0, and t >= 2 lasts. */
void fvi_inverse_add(fvi_inverse *S, const fvi_exact_source *at, double *x, double *v);

/* fvi_inverse_oscillation -- Add only the residues of the zeros of Q, which must exist. t >= lasts. */
void fvi_inverse_oscillation(const fvi_inverse *S, const fvi_exact_source *at,
                             double *x, double *v);

/* fvi_inverse_residue -- Return the contribution r of one pole: 2 Re(r) belongs to x, and 2 Re(s r) to v. t >=
 * lasts. */
double complex fvi_inverse_residue(const fvi_residue *a, const fvi_exact_source *at,
                                   int with_force);

/* fvi_inverse_resonance -- Add the residues of a zero of Q and of the cosine together, by (11.12). Return 1; or 0 if
 * the two are far enough from each other, and then nothing is added. */
int fvi_inverse_resonance(const fvi_inverse *S, const fvi_pole *root, double t,
                          double *x, double *v);

/* ---- what exact_solution.c has that exact_rows.c needs ---- */

/* fvi_exact_check -- Check a problem, as fvi_exact_at does. */
int fvi_exact_check(const fvi_linear_oscillator *problem, fvi_error *error);

/* fvi_exact_phase_is_lost -- Return nonzero if fvi_exact_at would return FVI_ELOSS at t. */
int fvi_exact_phase_is_lost(const fvi_inverse *S, double t);

/* fvi_exact_evaluate -- Compute the solution at one time t >= 0. */
void fvi_exact_evaluate(fvi_inverse *S, double t, double *x, double *v);

#endif
