/* src/fvi/dampers.h -- Several dampers, each between points of its own.   [H 29]
 *
 *     d/dt L_v - L_x + sum_j grad g_j(x) C_j(D) [g_j(x) - g_j(x_0)] = F(t)      (29.1)
 *
 * A damper feels one number, its elongation z = g(x), and answers with the force C(D) (z - z_0) along
 * grad g. For example, a damper between two masses has g(x) = x_2 - x_1, and a strut between two points
 * of the plane has their distance. A system with dampers has no damping of its own: its `damping`
 * is zero, and neither alpha nor law of a run is read.
 *
 *     const double between[] = { -1, 1 };
 *     const fvi_damper damper = { .of = fvi_elongation_row(between), .kernel = &zener };
 *     const fvi_mechanism mechanism = { .damper_count = 1, .damper = &damper };
 *     system.mechanism = &mechanism; */
#ifndef FVI_DAMPERS_H
#define FVI_DAMPERS_H

#include "damping_laws.h"
#include "past.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_elongation -- what a damper feels, a number z = g(x, t).
 *
 *   row       g(x) = row . x, d numbers; or NULL, and then the functions say what g is:
 *   value     writes g to *g
 *   gradient  writes its d derivatives by x to G
 *   hessian   adds factor times its d * d second derivatives to H, row by row; NULL where a method
 *             does not ask for them
 *   params    handed to the functions, owned by the caller, may be NULL
 *
 * The functions return 0, or a code as those of a potential do (system.h). */
typedef struct {
    const double *row;
    int (*value)(double t, size_t d, const double *x, void *params, double *g);
    int (*gradient)(double t, size_t d, const double *x, void *params,
                    double *G);
    int (*hessian)(double t, size_t d, const double *x, double factor,
                   void *params, double *H);
    void *params;
} fvi_elongation;

/* fvi_damper -- an elongation, its kernel, and what it was before t = 0.
 *
 *   name    for columns and messages; NULL: d1, d2, ... by its place
 *   of      the elongation
 *   matrix  NULL; or, of a structure (structures.h), a symmetric matrix C that is not negative: the
 *           force is then C times the kernel's answer to x - x_0, and `of` is not read
 *   kernel  the law with its factors (damping_laws.h); must outlive the run
 *   past    of the elongation (past.h); zeroed: it was held at g(x_0) */
typedef struct fvi_damper {
    const char *name;
    fvi_elongation of;
    const struct fvi_sparse *matrix;
    const fvi_kernel *kernel;
    fvi_initial_history past;
} fvi_damper;

/* fvi_mechanism -- what a system has besides masses and a potential.
 *
 *   damper_count, damper  the dampers; a damper's number is its place */
typedef struct fvi_mechanism {
    size_t damper_count;
    const fvi_damper *damper;
} fvi_mechanism;

/* fvi_elongation_row -- g(x) = row . x; the d numbers belong to the caller and must outlive the run. */
static inline fvi_elongation fvi_elongation_row(const double *row)
{
    fvi_elongation linear = { 0 };
    linear.row = row;
    return linear;
}

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
