/* tests/bench/peers/radau_step.h -- One step of a Radau IIA method.     [H 18] */
#ifndef RADAU_STEP_H
#define RADAU_STEP_H

#include "peers.h"
#include "radau_memory.h"

enum { S = RADAU_STAGES, KEPT = 512 };

/* A step; on_lattice: h is e^{L j} times the unit of the memory. */
typedef struct {
    double h;
    int on_lattice;
} radau_step;

/* The factors for steps of one length, for each coordinate that differs from the one before it: K = m M / h +
 * rho h^{-beta} M^beta, and its inverse (if U = c x^2 / 2, the inverse of K + c h A). */
typedef struct {
    double h, *K, *inverse;
} radau_factor;

typedef struct {
    const problem *p;
    const radau *m;
    radau_memory *memory;
    size_t d, steps, kinds;
    int s, kept;
    double beta, stop, curvature; /* U'' if it is constant */
    double W[S * S], A[S * S];    /* M^beta; A without gaps */
    radau_step *mesh;
    radau_factor factors[KEPT];
    size_t *kind; /* the number of the factor of each coordinate */
    double *x, *v, *room, *H, *X, *D, *G, *V, *powers;
} radau_solver;

/* radau_solve -- compute D = V - v of the step from t to t + h. Before the call D is a guess, and H has the
 * memory. X and G are overwritten. Returns FVI_SUCCESS; FVI_EMAXITER if the iteration does not end; FVI_ENOMEM;
 * or the code of a callback. */
int radau_solve(radau_solver *o, double t, double h);

/* radau_solve_one -- the same for one mass by Newton's method. F is part of H; f are the factors for h. */
int radau_solve_one(radau_solver *o, double h, const radau_factor *f);

/* radau_uniform, radau_graded -- make the steps: N of one length; or steps that begin with `first` at 0 and at
 * the jump and grow by e^{4 L} at most, as t^{3/4}, up to *longest. *longest is chosen so that all steps after
 * the jump are on the lattice and end at T. There are at most `most` steps. Both return their number. */
size_t radau_uniform(const problem *p, size_t N, radau_step *mesh);
size_t radau_graded(const problem *p, double first, double *longest, double L,
                    size_t most, radau_step *mesh);

#endif
