/* src/reference/exact_inverse.h -- Inverting the Laplace transform.        [H 11]
 *
 * What exact_solution.c is made of: the transform of a checked problem is
 * prepared once, and inverted at as many times as one likes. */
#ifndef FVI_EXACT_INVERSE_H
#define FVI_EXACT_INVERSE_H

#include <fvi/exact_solution.h>
#include "frequency/exact_pole.h"

enum { FVI_ZEROS = 3, FVI_POLES = FVI_ZEROS + 1, FVI_NODES = 288 };

//> contour
/* The hyperbola z(u) of (11.10) at u = (k + 1/2) h, and what the integrand has on
 * it for every problem of this order and every time. */
typedef struct {
    size_t count;
    double complex z[FVI_NODES], weight[FVI_NODES], power[FVI_NODES];
} fvi_contour;
//< contour

/* A pole s + low of the transform, and its residues without e^{st}. */
typedef struct {
    double complex s, low;
    double complex start, force; /* what x0 and v0 give, what F gives */
} fvi_residue;

/* All that does not depend on t. */
typedef struct {
    fvi_linear_oscillator p;
    double beta;              /* 2 alpha */
    int keeps_x0, keeps_v0;   /* 1 or 0: kappa_0 and kappa_1 of (11.2) */
    fvi_pole root[FVI_ZEROS]; /* the zeros of Q: one or none without a law */
    size_t roots;
    fvi_residue pole[FVI_POLES]; /* those of Q first, then that of a cosine */
    size_t poles;
    int closed; /* the transform has these poles and no other singularity */
    fvi_contour contour[FVI_POLES + 1]; /* made when first needed: count > 0 */
} fvi_inverse;

/* A source of the motion, which began a time t ago: x0 and v0 if `start` is 1, not if it is 0, and
 * `sign` times the force, which ended `lasts` later if that is > 0. A step from 0 to T, for
 * example, is two sources soon after T: one with sign 1, and from T on one with sign -1. */
typedef struct {
    double t, start, sign, lasts;
} fvi_exact_source;

/* fvi_inverse_prepare -- poles and residues. The problem is a valid one.
 * Returns FVI_SUCCESS; for a law what fvi_kernel_poles returns. */
int fvi_inverse_prepare(const fvi_linear_oscillator *problem, fvi_inverse *S,
                        fvi_error *error);

/* fvi_inverse_contour -- contour number `place` of S->poles + 1, for (11.11). */
const fvi_contour *fvi_inverse_contour(fvi_inverse *S, size_t place);

/* fvi_inverse_add -- add to x and v what a source does; t > 0, and t >= 2 lasts. */
void fvi_inverse_add(fvi_inverse *S, const fvi_exact_source *at, double *x, double *v);

/* fvi_inverse_oscillation -- of that only the residues of the zeros of Q, which
 * must exist; t >= lasts will do. */
void fvi_inverse_oscillation(const fvi_inverse *S, const fvi_exact_source *at,
                             double *x, double *v);

/* fvi_inverse_residue -- what one pole of them gives: twice the real part of it in x, of s
 * times it in v. t >= lasts. */
double complex fvi_inverse_residue(const fvi_residue *a, const fvi_exact_source *at,
                                   int with_force);

/* fvi_inverse_resonance -- add the residues of a zero of Q and of the cosine together, by
 * (11.12); returns 0, and does nothing, if the two are far enough from each other. */
int fvi_inverse_resonance(const fvi_inverse *S, const fvi_pole *root, double t,
                          double *x, double *v);

/* ---- what exact_solution.c has that exact_rows.c needs ---- */

/* fvi_exact_check -- what fvi_exact_at says of a problem. */
int fvi_exact_check(const fvi_linear_oscillator *problem, fvi_error *error);

/* fvi_exact_phase_is_lost -- nonzero where it would return FVI_ELOSS. */
int fvi_exact_phase_is_lost(const fvi_inverse *S, double t);

/* fvi_exact_evaluate -- the solution at one time, t >= 0. */
void fvi_exact_evaluate(fvi_inverse *S, double t, double *x, double *v);

#endif
