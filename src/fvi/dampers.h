/* src/fvi/dampers.h -- Dampers between the points of a system, and what a run gives about them.   [H 29]
 *
 *     d/dt L_v - L_x + sum_j grad g_j(x) C_j(D) [g_j(x) - g_j(x_0)] = F(t)      (29.1)
 *
 * A damper measures one number, its elongation z = g(x), and answers with the force C(D) (z - z_0) along grad g. For
 * example, a damper between two masses has g(x) = x_2 - x_1, and for a strut between two points of the plane g is their
 * distance. A system with dampers has no damping of its own: `damping` of the system is zero, `law` of the run is NULL,
 * and `alpha` of the run is not read.
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

/* fvi_elongation -- the number z = g(x, t) that a damper measures.
 *
 *   row       d numbers, and g(x) = row . x. Or NULL, and then the functions define g:
 *   value     writes g to *g
 *   gradient  writes the d derivatives of g by x to G
 *   hessian   adds factor times the d * d second derivatives of g by x to H, row by row. May be NULL for fvi_fractional
 *             and fvi_cq2_midpoint without an adjoint; methods with stages and fvi_variable_step need it
 *   rate      writes the derivative of g by t to *gt; NULL: g does not depend on t
 *   params    handed to the functions, owned by the caller, may be NULL
 *
 * The functions return 0, or a code as the functions of a potential do (system.h). */
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

/* fvi_damper -- an elongation, a kernel, and the past of the elongation.
 *
 *   name    for columns and for parameters of a fit; NULL: d1, d2, ... by the place of the damper. Most error texts
 *           count instead: "damper 2" is the second damper, with the index 1
 *   of      the elongation
 *   matrix  NULL; or, in a structure (structures.h), a symmetric positive semidefinite matrix C. The force is then C
 *           times the answer of the kernel to x - x_0, and `of` is not read
 *   kernel  the law with its factors (damping_laws.h); must outlive the run
 *   past    what the elongation did before t = 0 (past.h); zeroed: it was held at g(x_0) */
typedef struct fvi_damper {
    const char *name;
    fvi_elongation of;
    const struct fvi_sparse *matrix;
    const fvi_kernel *kernel;
    fvi_initial_history past;
} fvi_damper;

/* fvi_mechanism -- what a system has besides masses and a potential. Everything that it points to belongs to the caller
 * and must outlive the run.
 *
 *   damper_count, damper  the dampers; the number of a damper is its place, from 0
 *   lagrangian   NULL: L = sum_i m_i v_i^2 / 2 - U(x), with the masses and the potential of the system; a mass may then
 *                be 0. Else the Lagrangian (lagrangian.h): masses and potential are not read, and the arrays `mass` and
 *                `damping` of the system may be NULL
 *   force_on     NULL, or forces that depend on x and v. The force of the system acts, too
 *   constraints  NULL, or equations between the coordinates
 *
 * fvi_fractional, fvi_cq2_midpoint, the methods with stages (lobatto.h) and fvi_variable_step take a mechanism.
 * fvi_fractional takes no constraints, and fvi_variable_step takes no damper of the order 2 and no law with a pole
 * beside its cut. If fvi_stepper_start refuses a mechanism (FVI_EUNSUP, FVI_EDOM, FVI_ESING), the field of its error
 * names the part, for example "lagrangian", "damper", "constraint", "mass", "x0" or "p0". The index is the number of
 * the damper, constraint or coordinate, from 0. */
typedef struct fvi_mechanism {
    size_t damper_count;
    const fvi_damper *damper;
    const fvi_lagrangian *lagrangian;
    const fvi_state_force *force_on;
    const fvi_constraints *constraints;
} fvi_mechanism;

/* ---- what a run with a mechanism gives besides x and p ----
 *
 * These functions read a stepper whose system has a mechanism. Any other stepper gives FVI_EUNSUP, except for
 * fvi_stepper_energy. A null pointer gives FVI_EFAULT. Only fvi_stepper_keep_dampers changes the stepper. On error the
 * outputs are untouched. At k = 0 all sums are zero. For example,
 *
 *     double impulse, work;
 *     fvi_stepper_damper(s, 0, &impulse, &work);
 *     printf("%g %g %g\n", s->t, impulse, work); */

/* fvi_stepper_velocity -- compute v from L_v(x, v, t) = p at the last step.
 *
 *   v  output, d numbers
 *
 * The order is that of p. The velocity of a coordinate without inertia is the slope of x in the last step; with
 * fvi_cq2_midpoint it is the slope between the last two means of x (29.25). It is 0 at k = 0.
 * Returns FVI_SUCCESS; FVI_EFAULT; FVI_EUNSUP; what fvi_velocity_of_momentum returns (lagrangian.h), after which v is
 * of no use. */
int fvi_stepper_velocity(const fvi_stepper *s, double *v);

/* fvi_stepper_keep_dampers -- ask a structure with several dampers to add up the impulses and works that
 * fvi_stepper_damper gives. Call it at k = 0. A structure keeps these sums only on request, because its dampers act on
 * all unknowns: the sums cost two passes over the unknowns for each damper and step. All other systems with a mechanism
 * keep the sums always.
 * Returns FVI_SUCCESS; FVI_EFAULT; FVI_EINVAL for a structure after k = 0; FVI_EUNSUP without a mechanism, or if the
 * method does not keep such sums; FVI_ENOMEM. */
int fvi_stepper_keep_dampers(fvi_stepper *s);

/* fvi_stepper_damper -- give the impulse and the work of damper j from t = 0 to the last step.
 *
 *   j        the number of the damper, from 0
 *   impulse  output or NULL: the integral of the force lambda = C(D) (z - z_0) of the damper, one number. It has the
 *            order of p, and a difference quotient of the impulses gives the force. For a damper with a matrix: d
 *            numbers, the integral of C times the answer to x - x_0
 *   work     output or NULL: the integral of lambda dz, one number. By fvi_cq2_midpoint and the methods with stages it
 *            is never negative if the past is HELD, and either the order of the damper is at most 1 or its elongation
 *            starts without a slope (29.11)
 *
 * Both are the scheme's own sums. With fvi_variable_step they reach to the end of its last step, wherever the rows are;
 * an observer (observer.h) gives them at any time.
 * Returns FVI_SUCCESS; FVI_EFAULT if s is NULL; FVI_EINVAL if there is no damper j; FVI_EUNSUP without a mechanism, or
 * without fvi_stepper_keep_dampers where it is needed. */
int fvi_stepper_damper(const fvi_stepper *s, size_t j, double *impulse,
                       double *work);

/* fvi_stepper_multipliers -- give the multipliers Lambda of the constraints at both ends of the last step. The equation
 * of motion contains them as C^T Lambda.
 *
 *   begin, end  outputs or NULL: one number for each constraint; zeros at k = 0
 *
 * Each of the two is of low order alone. The multiplier at node k is the mean of `end` after step k and of `begin`
 * after step k + 1. This mean has order 2, or 4 for fvi_lobatto_m4. Minus the multiplier of x1 - u(t) is the reaction
 * to the imposed motion. Returns FVI_SUCCESS; FVI_EFAULT if s is NULL; FVI_EUNSUP. */
int fvi_stepper_multipliers(const fvi_stepper *s, double *begin, double *end);

/* fvi_stepper_tie -- give the impulse of constraint i, from 0: the integral of Lambda_i from t = 0 to the last step.
 *
 *   impulse  output, one number. A difference quotient of the impulses gives the multiplier
 *
 * Returns FVI_SUCCESS; FVI_EFAULT; FVI_EUNSUP; FVI_EINVAL if there is no constraint i. */
int fvi_stepper_tie(const fvi_stepper *s, size_t i, double *impulse);

/* fvi_stepper_energy -- compute E = v . L_v - L at the last step, also for a stepper without a mechanism.
 *
 *   E  output, one number
 *
 * Returns as fvi_energy_at (lagrangian.h); FVI_EFAULT if a pointer is NULL. */
int fvi_stepper_energy(const fvi_stepper *s, double *E);

/* fvi_elongation_row -- return the elongation g(x) = row . x. The d numbers belong to the caller and must outlive the
 * run. */
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
