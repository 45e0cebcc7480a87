/* src/fvi/dampers.h -- Several dampers, each between points of its own.   [H 29]
 *
 *     d/dt L_v - L_x + sum_j grad g_j(x) C_j(D) [g_j(x) - g_j(x_0)] = F(t)      (29.1)
 *
 * A damper acts on one number, its elongation z = g(x), with the force C(D) (z - z_0) along
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
#include "lagrangian.h"
#include "past.h"
#include "trajectory.h"

#include <stddef.h>
#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_elongation -- what a damper acts on, a number z = g(x, t).
 *
 *   row       g(x) = row . x, d numbers; or NULL, and then the functions say what g is:
 *   value     writes g to *g
 *   gradient  writes its d derivatives by x to G
 *   hessian   adds factor times its d * d second derivatives to H, row by row; NULL where a method
 *             does not ask for them
 *   rate      writes the derivative by t to *gt; NULL: t does not stand in g
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
    int (*rate)(double t, size_t d, const double *x, void *params, double *gt);
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
 *   damper_count, damper  the dampers; a damper's number is its place
 *   lagrangian   NULL: L = sum_i m_i v_i^2 / 2 - U(x), of the system's masses, which may then be 0, and
 *                its potential. Else neither is read, and both arrays of the system may be NULL
 *   force_on     NULL, or forces that know x and v; the system's force acts, too
 *   constraints  NULL, or equations between the coordinates
 *
 * fvi, fvi-stable, fvi-lobatto2 to 8, 2d to 8d and fvi-adaptive take it; constraints
 * not fvi; fvi-adaptive no damper of the order 2, nor a law with a pole beside its cut. What they refuse at the start (FVI_EUNSUP, FVI_EDOM, FVI_ESING) they say with its
 * field: "lagrangian", "damper", "constraint", "x0", "p0", the number as the index. */
typedef struct fvi_mechanism {
    size_t damper_count;
    const fvi_damper *damper;
    const fvi_lagrangian *lagrangian;
    const fvi_state_force *force_on;
    const fvi_constraints *constraints;
} fvi_mechanism;

/* ---- what a run with a mechanism tells besides x and p ----
 *
 * Of a stepper whose system has a mechanism; another gives FVI_EUNSUP, and a null pointer
 * FVI_EFAULT. Nothing changes. At k = 0 all sums are zero. */

/* fvi_stepper_velocity -- v of L_v(x, v, t) = p at the last step, d numbers: of the order of p. That of
 * a coordinate without inertia is the slope of the last step, by fvi-stable that of the last means (29.25); 0 at k = 0. */
int fvi_stepper_velocity(const fvi_stepper *s, double *v);

/* fvi_stepper_keep_dampers -- at k = 0: sum up what fvi_stepper_damper tells. A structure with
 * several dampers does so only if it is asked, as its forces act on all unknowns: two passes over
 * them for a damper and step. Other systems do it always.
 * Returns FVI_SUCCESS; FVI_EFAULT; FVI_EINVAL after k = 0; FVI_EUNSUP without a mechanism; FVI_ENOMEM. */
int fvi_stepper_keep_dampers(fvi_stepper *s);

/* fvi_stepper_damper -- what damper j, from 0, has given and taken from t = 0 to the last step.
 *
 *   (of fvi-adaptive: to the end of its last step, whatever the rows; an observer knows them at any time)
 *   impulse  output or NULL: the integral of its force lambda = C(D) (z - z_0), the partner of p,
 *            and of p's order: the force at a node is its difference, over a run. Of a damper by a
 *            matrix d numbers, the integral of C times the answer to x - x_0
 *   work     output or NULL: that of lambda dz. Never negative by fvi-stable and the methods with
 *            stages if the damper is held, and either its order is at most 1 or its elongation
 *            starts without a slope, (29.11)
 *
 * Both are the scheme's own sums. FVI_EINVAL if there is no such damper; FVI_EUNSUP where nothing
 * was kept. */
int fvi_stepper_damper(const fvi_stepper *s, size_t j, double *impulse,
                       double *work);

/* fvi_stepper_multipliers -- the multipliers Lambda of the constraints, C^T Lambda in the equation of
 * motion, at both ends of the last step: each is of low order alone.
 *
 *   begin, end  outputs or NULL: count numbers each; zeros at k = 0
 *
 * The multiplier at the node k is the mean of `end` after step k and of `begin` after step k + 1: of
 * order 2, or 4 for fvi-lobatto4. Minus that of x1 - u(t) is the reaction to an imposed motion. */
int fvi_stepper_multipliers(const fvi_stepper *s, double *begin, double *end);

/* fvi_stepper_tie -- the impulse of constraint i, from 0: the integral of Lambda_i from t = 0 to the last step,
 * the partner of p. The multiplier at a node is its difference, over a run. FVI_EINVAL if there is no
 * such constraint. */
int fvi_stepper_tie(const fvi_stepper *s, size_t i, double *impulse);

/* fvi_stepper_energy -- E = v . L_v - L at the last step; also of a stepper without a mechanism. Returns
 * as fvi_energy_at. */
int fvi_stepper_energy(const fvi_stepper *s, double *E);

/* fvi_elongation_row -- g(x) = row . x; the d numbers belong to the caller and must outlive the run. */
static inline fvi_elongation fvi_elongation_row(const double *row)
{
    fvi_elongation linear;
    memset(&linear, 0, sizeof linear); /* { 0 } is no C++ without warnings */
    linear.row = row;
    return linear;
}

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
