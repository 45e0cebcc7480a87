/* src/methods/damping.h -- The damped coordinates of a run and their memory. [H 9]
 *
 * Internal: what the integrators of H 9 and 13 have in common. */
#ifndef FVI_DAMPING_H
#define FVI_DAMPING_H

#include "run/run_damper.h"

/* The history of one damper, and of those behind it. */
typedef struct fvi_damping {
    struct fvi_damping *next; /* of the next damper; owned */
    fvi_run_damper of;
    size_t number;  /* its place among the dampers of the run */
    size_t count;   /* how many coordinates have rho > 0 */
    int all;        /* is that every one, and are there no matrices? */
    int increments; /* does the memory sum dz, and not z? */
    size_t *index;  /* which; not used with matrices */
    double *factor; /* rho h^(1 - 2 alpha) of each; with matrices of all */
    double *origin; /* x_0 of each, 0 for Riemann-Liouville */
    double *drift;  /* Caputo, growth > 1: h v_0 of each, else 0 */
    double unit;    /* h^(1 - 2 alpha), or h w_0 of a law: factor is rho of it */
    double *z, *dz; /* x - origin and its increment, gathered */
    double *kept;   /* the impulse on each unknown up to now, that of the step at hand, and p
                     * before it; NULL: nobody asked */
    double work;    /* of the impulses, if they are kept */
    double *H;      /* of a linearised run: the last sums, else NULL, */
    double *Hdot;   /* and their derivative by 2 alpha, or NULL */
    fvi_history *memory;
    const fvi_system *system;
} fvi_damping;

/* fvi_damping_velocity -- v = M^-1 p, d numbers each. Returns FVI_SUCCESS, or what factorise or
 * solve of the matrices returned. */
int fvi_damping_velocity(const fvi_system *system, const double *p, double *v);

/* fvi_damping_begin_matrices -- factor, origin, drift and the term k = 0 of one damper of a system
 * with matrices. Returns FVI_SUCCESS, or what their functions returned. */
int fvi_damping_begin_matrices(const fvi_stepper *s, fvi_initial_history past,
                               fvi_damping *damping);

/* fvi_damping_multiply -- y += factor C x, d numbers each. Returns FVI_SUCCESS; FVI_ENOMEM; what
 * the matrix returned. */
int fvi_damping_multiply(const fvi_damping_matrix *C, size_t d, double factor,
                         const double *x, double *y);

/* fvi_damping_gather -- the history numbers of x, less `from`, to z: x_i - from_i of the damped
 * coordinates, or B^T x - from.  Returns FVI_SUCCESS, or what select_history returned. */
int fvi_damping_gather(const fvi_damping *damping, const double *x,
                       const double *from, double *z);

/* fvi_damping_terms -- z and dz of the position s->x and of its increment s->dx; where the
 * memory sums positions, dz is left as it is. Returns as fvi_damping_gather. */
int fvi_damping_terms(fvi_damping *damping, const fvi_stepper *s);

/* fvi_damping_update_history -- z and dz go into the memory, and its sums to H, count numbers.
 * Returns what fvi_history_push and fvi_history_push_by_order return. */
int fvi_damping_update_history(fvi_damping *damping, double *H);

/* fvi_damping_apply_force -- p -= share h rho h^(-2 alpha) H, H of the damped coordinates; with
 * matrices share h h^(-2 alpha) S H.  Returns FVI_SUCCESS, or what apply_damping returned. */
int fvi_damping_apply_force(const fvi_damping *damping, double share, const double *H,
                     double *p);

/* fvi_damping_start -- the histories of all dampers, which know the term k = 0.
 *
 *   s        a stepper at k = 0
 *   is_caputo  nonzero: their pasts are Caputo's, as the method adds by impulses what another
 *            past has besides; zero: each has its own. Where a linearised run begins at 0
 *            neither is read: that is all that its history knows
 *   damping  output: the first of them; NULL, and no memory at all, if nothing is damped
 *
 * Returns FVI_SUCCESS; what fvi_history_alloc and fvi_kernel_history return; FVI_ENOMEM. After
 * an error what was made so far is in *damping: free it in any case. */
int fvi_damping_start(const fvi_stepper *s, int is_caputo, fvi_damping **damping);

/* fvi_damping_keep -- at k = 0: the impulses and the work of all dampers are summed from now on.
 * Returns FVI_SUCCESS or FVI_ENOMEM. */
int fvi_damping_keep(fvi_damping *damping);

/* fvi_damping_before, _after -- p before and after a damper has acted on it.
 * fvi_damping_end_step -- the increment of the step is dx: the work is the step's impulse times
 * dx/h. None of them does anything where nothing is kept. */
void fvi_damping_keep_before(fvi_damping *damping, const double *p);
void fvi_damping_keep_after(fvi_damping *damping, const double *p);
void fvi_damping_keep_step(fvi_damping *damping, double h, const double *dx);

static inline void fvi_damping_before(fvi_damping *damping, const double *p)
{
    if (damping->kept)
        fvi_damping_keep_before(damping, p);
}

static inline void fvi_damping_after(fvi_damping *damping, const double *p)
{
    if (damping->kept)
        fvi_damping_keep_after(damping, p);
}

static inline void fvi_damping_end_step(fvi_damping *damping, double h, const double *dx)
{
    if (damping->kept)
        fvi_damping_keep_step(damping, h, dx);
}

/* fvi_damping_sums -- what damper j of a run has given and taken, as fvi_stepper_damper has it. */
int fvi_damping_sums(const fvi_stepper *s, size_t j, double *impulse, double *work);

/* fvi_damping_impulse -- of the impulse that a damper has given to the d unknowns, NULL for zeros, what
 * is told: along a row one number, of a matrix all. */
void fvi_damping_impulse(const fvi_damper *damper, size_t d, const double *kept,
                         double *impulse);

/* fvi_damping_of -- the first damping of a stepper of Algorithm 3, or of a method of order 2;
 * or NULL. */
const fvi_damping *fvi_damping_of(const fvi_stepper *s);

/* fvi_damping_move_origin -- move the origins of all dampings of a stepper, which has one at least,
 * by d numbers. Then s->x may jump by them, and no memory sees the jump. Returns FVI_SUCCESS;
 * FVI_ENOMEM; what select_history returned. */
int fvi_damping_move_origin(fvi_stepper *s, const double *by);

/* fvi_damping_copy -- all of them again, memory included; NULL of NULL.
 * Returns FVI_SUCCESS or FVI_ENOMEM; errors as above. */
int fvi_damping_copy(const fvi_damping *from, fvi_damping **to);

/* fvi_damping_archive -- what k steps have changed, as fvi_stepper_archive; nothing of NULL. */
int fvi_damping_archive(fvi_damping *damping, size_t k, fvi_archive *archive);

/* fvi_damping_free -- give all of them back. NULL is allowed. */
void fvi_damping_free(fvi_damping *damping);

/* fvi_damping_quadrature -- of the weights of a law: those of the method, but fvi_cq2_midpoint
 * takes means of BDF2's (26.15). */
fvi_delta fvi_damping_quadrature(const fvi_method *method);

#endif
