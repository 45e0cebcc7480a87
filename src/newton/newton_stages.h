/* src/newton/newton_stages.h -- The equations of the stages, their Jacobian. [H 2]
 *
 * What newton.c, which solves them, sees of newton_stages.c, which has them. */
#ifndef FVI_NEWTON_STAGES_H
#define FVI_NEWTON_STAGES_H

#include "band.h"
#include "newton.h"
#include "system/lanes.h"

/* Stage l of coordinate j stands at [l * dim + j] in d, r and g, where the callbacks
 * want a stage in one piece; in what is eliminated, the rows of J, at [j * q + l],
 * so that the band is narrow. */
struct fvi_newton {
    const fvi_system *system;
    size_t q;     /* stages, 1 in (2.10) */
    size_t reach; /* d^2U / dx_j dx_c = 0 if |j - c| > reach */
    double theta;
    int implicit, linear;       /* explicit: A, point and one s is all */
    int user_solve;                    /* the potential solves: H is the diagonal a */
    double *A;                  /* of each coordinate */
    double *s;                  /* of each q * q numbers; one in (2.10) */
    double *point, *H;          /* x + theta d of a stage, and Hess U there */
    double *e, *terms, *moves;  /* see residual and jacobian */
    double *step;               /* of Newton's method, */
    double *from, *before;      /* and d and e before it */
    double size, last, largest; /* of step_i, of the last, of d_i; absolute */
    fvi_band J;                 /* (2.11), or its LU factors */
    size_t first;    /* for linearised.h alone: which stage of a step is stage 0 here; */
    int has_factors; /* is J there already, and stays? */
    int callback_status;                 /* what a callback returned, if not 0 */
    double m, *c;               /* with matrices: of (27.3), s being *s, */
    void *factors;              /* and what they made of them */
    fvi_newton *lane[FVI_MOST_LANES]; /* of single lanes, where they are needed; or NULL */
};

/* fvi_newton_is_diagonal -- is one stage of a quadratic U all, and the coordinates do not
 * see each other? Then J is a number for each, and H is Hess U, [j * diagonals]. */
static inline int fvi_newton_is_diagonal(const fvi_newton *n)
{
    return n->implicit && n->linear && n->q == 1 && n->reach == 0 && !n->user_solve;
}

/* fvi_newton_by_matrices -- the solution of (27.3); arguments and codes as fvi_newton_solve. */
int fvi_newton_by_matrices(fvi_newton *n, const double *x, const double *r,
                           double *d, double *g);

/* fvi_newton_gradients -- g = grad U(x + theta d), all stages.
 * Returns 0, or what the potential returned, which is then in n->theirs too. */
int fvi_newton_gradients(fvi_newton *n, const double *x, const double *d,
                         double *g);

/* fvi_newton_residual -- n->e = r - A d - s g, and in n->terms the sum of the sizes
 * of its terms. */
void fvi_newton_residual(fvi_newton *n, const double *r, const double *d,
                         const double *g);

/* fvi_newton_jacobian -- n->J = (1 + mu) A + s theta Hess U(x + theta d), mu = 0 in
 * (2.11); and in n->moves how far s grad U moves if each coordinate of x and d does by
 * the whole of itself. Where the potential solves for itself, n->H = (1 + mu) A and
 * n->moves = 0. Returns as fvi_newton_gradients. */
int fvi_newton_jacobian(fvi_newton *n, const double *x, const double *d,
                        double mu);

#endif
