/* src/methods/damping.h -- The damped coordinates of a run and their histories. [H 9]
 *
 * This header is internal. The integrators of H 9 and H 13 use it. */
#ifndef FVI_DAMPING_H
#define FVI_DAMPING_H

#include "run/run_damper.h"
#include "system/damping_matrix.h"
#include "system/lagrangian_point.h" /* fvi_divide_by_mass */

/* The history of one damper, in a list of all dampers. */
typedef struct fvi_damping {
    struct fvi_damping *next; /* the next damper; owned */
    fvi_run_damper of;
    size_t number;  /* index of the damper among the dampers of the run */
    size_t count;   /* number of coordinates with rho > 0; with matrices, of history numbers */
    int covers_all; /* nonzero if all coordinates are damped and there are no matrices */
    int sums_increments; /* nonzero if the history sums dz instead of z */
    size_t *index;  /* indices of the damped coordinates; not used with matrices */
    double *factor; /* rho h^(1 - 2 alpha) of each damped coordinate; with matrices one number */
    double *origin; /* x_0 of each damped coordinate, 0 for Riemann-Liouville */
    double *drift;  /* h v_0 of each damped coordinate for Caputo's past with growth > 1, else 0 */
    double unit;    /* factor divided by the damping rho of a coordinate: h^(1 - 2 alpha), or h w_0 of a law */
    /* x - origin and its increment, for the damped coordinates: the newest terms of the history. Some steps overwrite z
     * by the sums of the history. */
    double *z, *dz;
    /* 3 d numbers: the impulse on each unknown so far, the impulse of this step, and p before the damper acts; NULL if
     * the sums are not kept */
    double *impulse_sums;
    double work;    /* work of the impulses, if the sums are kept */
    double *H;      /* in a linearised run: the last sums of the history, for its caller; else NULL */
    double *Hdot;   /* in a linearised run: their derivatives by 2 alpha, or NULL */
    fvi_history *memory;
    const fvi_system *system;
} fvi_damping;

/* fvi_damping_begin_matrices -- Set factor, origin, drift and the term k = 0 of one damper, for a system with matrices.
 * Return FVI_SUCCESS, or the code of a function of the matrices. */
int fvi_damping_begin_matrices(const fvi_stepper *s, fvi_initial_history past,
                               fvi_damping *damping);

/* fvi_damping_gather -- Write the history numbers of x to z: x_i - from_i of the damped coordinates, or B^T x - from
 * with matrices. Return FVI_SUCCESS, or the code of select_history. */
int fvi_damping_gather(const fvi_damping *damping, const double *x,
                       const double *from, double *z);

/* fvi_damping_set_terms -- Compute z from the position s->x and, if the history sums increments, dz from its increment
 * s->dx. Return the codes of fvi_damping_gather. */
int fvi_damping_set_terms(fvi_damping *damping, const fvi_stepper *s);

/* fvi_damping_update_history -- Push z and dz, and write the sums to H, count numbers. Return the code of
 * fvi_history_push or fvi_history_push_by_order. */
int fvi_damping_update_history(fvi_damping *damping, double *H);

/* fvi_damping_apply_force -- Compute p -= share h rho h^(-2 alpha) H for the damped coordinates; with matrices p -=
 * share h h^(-2 alpha) S H. Return FVI_SUCCESS, or the code of apply_damping. */
int fvi_damping_apply_force(const fvi_damping *damping, double share, const double *H,
                     double *p);

/* fvi_damping_start -- Allocate the histories of all dampers and push the term k = 0.
 *
 *   s          a stepper at k = 0
 *   is_caputo  nonzero: all histories use Caputo's past, because the method adds the difference to another past by
 *              impulses. Zero: each history uses the past of its damper. In a linearised run that begins at 0 the
 *              histories contain the term 0 only, whatever is_caputo is
 *   damping    output: the first damper of the list; NULL if nothing is damped
 *
 * Return FVI_SUCCESS; the codes of fvi_history_alloc and fvi_kernel_history; FVI_ENOMEM. After an error *damping holds
 * the part that was allocated, so the caller must free it in any case. */
int fvi_damping_start(const fvi_stepper *s, int is_caputo, fvi_damping **damping);

/* fvi_damping_keep_sums -- Start to sum the impulses and the work of all dampers, at k = 0. The function is the member
 * `keep_dampers` of a method. Return FVI_SUCCESS or FVI_ENOMEM. */
int fvi_damping_keep_sums(fvi_stepper *s);

/* fvi_damping_note_momentum -- Note p before the damper acts on it.
 * fvi_damping_add_impulse -- Add the change of p since then to the impulse of the damper in this step.
 * fvi_damping_add_work -- End a step with the increment dx: add the impulse times dx/h to the work of the damper.
 * If the sums are not kept, these functions do nothing. */
void fvi_damping_sums_note_momentum(fvi_damping *damping, const double *p);
void fvi_damping_sums_add_impulse(fvi_damping *damping, const double *p);
void fvi_damping_sums_add_work(fvi_damping *damping, double h, const double *dx);

static inline void fvi_damping_note_momentum(fvi_damping *damping, const double *p)
{
    if (damping->impulse_sums)
        fvi_damping_sums_note_momentum(damping, p);
}

static inline void fvi_damping_add_impulse(fvi_damping *damping, const double *p)
{
    if (damping->impulse_sums)
        fvi_damping_sums_add_impulse(damping, p);
}

static inline void fvi_damping_add_work(fvi_damping *damping, double h, const double *dx)
{
    if (damping->impulse_sums)
        fvi_damping_sums_add_work(damping, h, dx);
}

/* fvi_damping_sums -- Write the impulse and the work of damper j of a run; either output may be NULL. The function is
 * the member `damper` of a method, see fvi_stepper_damper. Return FVI_SUCCESS; FVI_EINVAL if there is no damper j;
 * FVI_EUNSUP if there are no dampers or their sums are not kept. */
int fvi_damping_sums(const fvi_stepper *s, size_t j, double *impulse, double *work);

/* fvi_damping_impulse -- Write the impulse of a damper for output. A damper along a row gives one number, a damper with
 * a matrix d numbers. `sum` is the impulse on the d unknowns; NULL means zero. */
void fvi_damping_impulse(const fvi_damper *damper, size_t d, const double *sum,
                         double *impulse);

/* fvi_damping_of -- Return the first damper of a stepper of Algorithm 3 or of a method of order 2, or
 * NULL if nothing is damped. */
fvi_damping *fvi_damping_of(const fvi_stepper *s);

/* fvi_damping_move_origin -- Add `by`, d numbers, to the origins of all dampers of a stepper. Then s->x may jump by the
 * same numbers, and no history sees the jump. The stepper has at least one damper. Return FVI_SUCCESS; FVI_ENOMEM; or
 * the code of select_history. */
int fvi_damping_move_origin(fvi_stepper *s, const double *by);

/* fvi_damping_copy -- Copy the list of dampers with their histories; a copy of NULL is NULL. Return FVI_SUCCESS or
 * FVI_ENOMEM. After an error the caller must free *to. */
int fvi_damping_copy(const fvi_damping *from, fvi_damping **to);

/* fvi_damping_archive -- Serialise the state of all dampers after k steps, as fvi_stepper_archive
 * does. NULL is allowed. */
int fvi_damping_archive(fvi_damping *damping, size_t k, fvi_archive *archive);

/* fvi_damping_free -- Free the list of dampers. NULL is allowed. */
void fvi_damping_free(fvi_damping *damping);

/* fvi_damping_quadrature -- Return the quadrature for the weights of a law: the quadrature of the method, but BDF2 for
 * fvi_cq2_midpoint, which takes means of BDF2's weights (26.15). */
fvi_delta fvi_damping_quadrature(const fvi_method *method);

#endif
