/* src/newton/newton_stages.h -- The solver of the equations of the stages, and their Jacobian. [H 2]
 *
 * This header is internal. newton_stages.c evaluates and stores the equations; newton.c solves them. */
#ifndef FVI_NEWTON_STAGES_H
#define FVI_NEWTON_STAGES_H

#include "band.h"
#include "newton.h"
#include "system/lanes.h"

/* The solver of one equation, or of q stages. In d, r and g, coordinate j of stage l stands at [l * dim + j], because
 * the callbacks need a stage in one piece. In the eliminated arrays (e, terms, moves, step) and in the rows of J it
 * stands at [j * q + l], so that the band is narrow. */
struct fvi_newton {
    const fvi_system *system;
    size_t q;     /* number of stages, 1 in (2.10) */
    size_t half_bandwidth; /* d^2U / dx_j dx_c = 0 if |j - c| > half_bandwidth */
    double theta;
    int implicit, linear;       /* an explicit solver has only A, point and one s */
    int user_solve;                    /* nonzero if the potential solves the equation; H then holds the diagonal a */
    double *A;                  /* one number for each coordinate */
    double *s;                  /* q * q numbers for each coordinate; one number in (2.10) */
    double *point, *H;          /* x + theta d of a stage, and Hess U there */
    double *e, *terms, *moves;  /* outputs of fvi_newton_residual and fvi_newton_jacobian */
    double *step;               /* the Newton step */
    double *from, *before;      /* d and e before the step */
    double size, last, largest; /* largest |step_i| of this step and of the step before, largest |d_i| */
    fvi_band J;                 /* the Jacobian (2.11), or its LU factors */
    size_t first;    /* used by linearised.h: the stage of the time step that is stage 0 of this solver */
    int has_factors; /* nonzero if J holds factors that stay valid */
    int callback_status;                 /* the last nonzero code that a callback returned, or 0 */
    double m, *c;               /* m and c_j of (27.3); s of (27.3) is *s */
    void *factors;              /* factors of the matrices, made by the functions of the system */
    fvi_newton *lane[FVI_MOST_LANES]; /* solvers of single lanes, allocated when needed; else NULL */
};

/* fvi_newton_is_diagonal -- Return 1 if U is quadratic with a diagonal Hessian and there is one stage. Then J is one
 * number for each coordinate, and Hess U of coordinate j is H[j * diagonals]. */
static inline int fvi_newton_is_diagonal(const fvi_newton *n)
{
    return n->implicit && n->linear && n->q == 1 && n->half_bandwidth == 0 && !n->user_solve;
}

/* fvi_newton_by_matrices -- Solve (27.3). fvi_newton_solve calls it; arguments and codes are the same. */
int fvi_newton_by_matrices(fvi_newton *n, const double *x, const double *r,
                           double *d, double *g);

/* fvi_newton_gradients -- Compute g = grad U(x + theta d) of all stages. Return FVI_SUCCESS, or the code of the
 * potential, which is also stored in n->callback_status. */
int fvi_newton_gradients(fvi_newton *n, const double *x, const double *d,
                         double *g);

/* fvi_newton_residual -- Compute n->e = r - A d - s g. Store in n->terms, for each equation, the sum of the absolute
 * values of its terms. */
void fvi_newton_residual(fvi_newton *n, const double *r, const double *d,
                         const double *g);

/* fvi_newton_jacobian -- Compute n->J = (1 + mu) A + s theta Hess U(x + theta d), with mu = 0 in (2.11). Store in
 * n->moves how much s grad U changes if each coordinate of x + theta d and of d changes by its own absolute value. If
 * the potential has its own `solve`, set n->H = (1 + mu) A and n->moves = 0 instead. Return the codes of
 * fvi_newton_gradients. */
int fvi_newton_jacobian(fvi_newton *n, const double *x, const double *d,
                        double mu);

#endif
