/* src/variable_step/variable_step.h -- The state and the parts of a run with variable steps. [H 22]
 *
 * Internal to the library. Each source file beside this header has one part: _start begins a run, _state copies and
 * archives its state, _solve solves the equation of a step, _length and _control choose the length of the next step,
 * _dense interpolates within a step, _singular treats a start that is not smooth, _events ends a step at an event, and
 * _impact carries the event out. */
#ifndef FVI_VARIABLE_STEP_H
#define FVI_VARIABLE_STEP_H

#include <fvi/variable_steps.h>
#include "variable_step_band.h"
#include "run/step_force.h"
#include "run/step_times.h"
#include "stages/variable_modes.h"

#include <gsl/gsl_machine.h>
#include <math.h>

/* Above this tolerance, the equation of a step is solved to fewer digits and a singular start has fewer terms. Above
 * ten times this tolerance the modes are coarse. */
#define FVI_TOLERANCE_LOOSE 1e-6

/* Above this tolerance, the polynomial of a step is no initial guess beyond the step, and Newton's method takes the
 * Hessian of every stage. */
#define FVI_TOLERANCE_VERY_LOOSE 1e-2

/* The least tolerance of a step, as a part of the size of the motion. Rounding hides errors below it. */
#define FVI_TOLERANCE_LEAST 1e-17

/* The next three values of run->tolerance, which the method does not use otherwise, are signals from the library
 * itself. This one: the modes are fine, whatever the tolerance of a step is. */
#define FVI_FINE_MODES 1e-300

/* The modes follow the tolerance of a step, although a force acts. The search for an error asks for it: it compares two
 * runs and adds the error of the modes, as a part of the largest motion, to its estimate. */
#define FVI_MODES_BY_TOLERANCE 2e-300

/* With this value, and with the two values above, the tolerance of a step is not the choice of a caller. So a tolerance
 * below the least one is not refused but replaced by the least one. */
#define FVI_ANY_TOLERANCE 3e-300

/* The coordinates with the same mass, damping and spring form a group, and share their matrices. */
typedef struct {
    double mass, damping; /* mass: m, or m + rho for alpha = 1; damping: rho */
    double spring; /* c, if U = c x^2 / 2 + b x + a and no iteration is needed; else 0 */
    double damping_coeff;        /* rho h^(1 - beta); 0 for beta = 1 */
    double compliance;       /* about how far x moves until the end of the run if the velocity is larger by 1 */
    fvi_square L;       /* L = m A^{-1} + rho h^{1 - beta} W0 + c h^2 to_x */
    fvi_square inverse; /* L^{-1}, if the solver needs it */
} fvi_coordinate_group;

/* Limits of the exponent k of h = exp(L k), and of counts. A step may be longer than the step before by GROWTH factors
 * exp(L), and after a rejected trial shorter by LESS factors. If the equation of a step could not be solved, a longer
 * step is tried again after RETRY accepted steps. If the fixed-point iteration has failed to contract STUCK times, it
 * is not tried any more. */
enum {
    FVI_VARIABLE_STEP_GROWTH = 4,
    FVI_VARIABLE_STEP_LESS = 12,
    FVI_VARIABLE_STEP_RETRY = 16,
    FVI_VARIABLE_STEP_STUCK = 20
};

/* A start is refused if its t1 is shorter than this part of the run, or its steps shorter than a sixteenth of it. */
#define FVI_SHORTEST 1e-248

/* The singular part G of a start: x = y + G until t1, where y is smoother than x. (22.19)
 *
 *     G(t) = sum_{n=1}^{J} c_n (rho/m)^n t^{a_n},   a_n = n gap + e,   gap = 2 - 2 alpha
 *
 * In the expansion with falling powers, m/rho stands in place of rho/m, and gap = 2 alpha - 2. The motion y begins with
 * c_0 t^e. (22.23) */
enum { FVI_SINGULAR_MOST = 256 };
typedef struct {
    size_t J; /* number of terms, at most FVI_SINGULAR_MOST; 0: the start has no singular part */
    double e, gap, t1;
    int by_euler_transform; /* nonzero: the c_n are those of Euler's transformation */
    double *c; /* c_0, ..., c_J of each coordinate; x (e = 0) or v (e = 1) jumps by c_0 at t = 0 */
    double *ratio; /* rho / m of each coordinate, or m / rho */
    double *
        residual_force; /* G leaves to y the force -residual_force ((rho/m) t^gap)^{J+1} t^{e-2} */
} fvi_singular;

/* How the equation of a step is solved.
 *
 *   LINEAR    without iteration, because there is no U, or U is quadratic with a diagonal Hessian
 *   DIAGONAL  by Newton's method for each coordinate, because the Hessian is diagonal
 *   COUPLED   by the fixed-point iteration
 *   TOGETHER  by Newton's method for all stages and coordinates at once, if COUPLED has failed too often
 *
 * If the state has a band, DIAGONAL and COUPLED both mean Newton's method with one Hessian for all stages. */
typedef enum {
    FVI_SOLVE_LINEAR,
    FVI_SOLVE_DIAGONAL,
    FVI_SOLVE_COUPLED,
    FVI_SOLVE_TOGETHER
} fvi_step_solver;

/* Stage i of coordinate j stands at [j * FVI_LANES + i]. In point, gradient and hessian it stands at [i * d + j], as
 * the callbacks of the potential expect it. */
typedef struct {
    const fvi_variable_rule *rule;
    size_t d;
    double beta;
    double tolerance; /* the tolerance of a step, as a part of the size of the motion at the start */
    fvi_step_solver solve;
    const fvi_square *to_x; /* X = base + h to_x delta: A in form D, form_m in form M */
    fvi_square W0;          /* (22.2); W1 = W0 1 */
    double W1[FVI_LANES];
    double memory_leakage; /* the wrong effect of the memory on v, |b . W0 A P_{s-1}| of (22.16) */
    size_t groups, *group_of; /* number of groups; the group of each coordinate */
    fvi_coordinate_group *group;
    fvi_length length; /* of the step that is tried, and of the matrices; h = 0: they are not ready */
    double coupled; /* length of the steps that s->newton, or the factors of a quadratic U, are for; 0: none */
    /* the past */
    fvi_modes_kind modes_kind; /* the accuracy of the modes for this tolerance */
    fvi_modes *modes;      /* NULL: no coordinate has a memory */
    struct fvi_variable_step_kernel *kernel; /* a law of damping; NULL: a power */
    fvi_modes *rising;     /* modes of the terms of the law that grow faster than s, or NULL */
    size_t damped, *index; /* number of the coordinates that have modes; their indices */
    double *centre; /* alpha = 0: the positions at which the springs of the damping are at rest */
    struct fvi_mesh_structure *structure; /* variable_structure.h; NULL: the system has no matrices */
    struct fvi_mesh_mechanism *mechanism; /* variable_mechanism.h; NULL: the system has no mechanism */
    fvi_singular singular;
    int for_adjoint; /* nonzero: a start with amplitude A = 0 has a singular part, too, for a derivative by A; with
                        matrices it has short steps */
    /* the state at t, with compensated sums; y is x without its singular part */
    double *y, *y_compensation, *v, *v_compensation, t, t_compensation; /* at the end of the last step */
    double *impulse_dv; /* the jump of v by the impulses at t */
    size_t hits;  /* number of impulses that have acted */
    struct fvi_event_watch *watch; /* variable_step_events.h; NULL: the run has no events */
    /* the step that is tried, or the last step: its start, its stages */
    double t0, *y0, *v0;
    double *base;  /* x_k + h c v_k, with G in a singular start: X at the stages for delta = 0 */
    double *R;     /* right-hand side of (22.14), without grad U */
    double *delta; /* the unknowns V - v_k */
    double *accel_legendre,
        *accel_legendre0; /* h times the Legendre coefficients of x'': of the step that is tried; of the last step */
    double *powers;   /* accel_legendre0 as coefficients of powers of theta, in the room of accel_legendre */
    int powers_known; /* nonzero once `powers` is computed */
    double *point, *gradient, *hessian; /* X at the stages; grad U and Hess U there */
    fvi_square *jacobian; /* the inverse Jacobian of each coordinate; or NULL */
    size_t diagonals;     /* number of diagonals of the Hessian, if they are few; or 0 */
    fvi_variable_step_band *band;
    /* control */
    double *events; /* times at which a step must end: jumps and impulses of the force, t1, and finally T */
    size_t event, event_count;
    double T, least;    /* T: end of the run; least: no step that the control chooses is shorter */
    double scale;       /* the largest |x_i| so far */
    double allowed;     /* the error that this step may have */
    double contraction; /* factor by which the last iteration reduced the change */
    int next_exponent, first_exponent; /* k of h = exp(L k): of the next step; of the first step after an event */
    int first_after_event; /* nonzero in the first step after an event */
    int longest_exponent, shortest_exponent; /* k of the longest and of the shortest step */
    int growth;       /* k may grow by so much from step to step */
    int longest_solvable; /* limit of k, since the equation of a longer step could not be solved */
    int steps_since_failure;      /* accepted steps since then, modulo FVI_VARIABLE_STEP_RETRY */
    /* Steps that end by clear_to and are not longer than clear_h pass over no pulse of the force. most_of_force holds
     * the bounds of the force. The bounds are computed for `ahead` steps at once. */
    double clear_to, clear_h, *most_of_force;
    int ahead;
    double undeclared_jump_until;  /* until this time the force may have a jump that was not declared */
    int stalled_iterations;     /* how often the fixed-point iteration has failed to contract */
    fvi_step_statistics counts;
    size_t next_pace_check; /* the number of steps at the next check of the pace, and the time of the last check */
    double pace_checked_at;
} fvi_variable_step_state;

/* fvi_variable_step_runs_away -- return nonzero if the run has taken most_steps steps, rejected ones included, or for
 * most_steps = 0 if it advances so slowly that it will not reach its end. */
int fvi_variable_step_runs_away(fvi_variable_step_state *o, size_t most_steps);

/* fvi_variable_step_scale -- return the size of the motion for a tolerance that is relative: x; or, if x is 0, of_v,
 * the distance that the body moves between two rows by its velocity; or of_a, the distance by its acceleration; or 1. A
 * number that is only a rounding error of the next one counts as 0. */
double fvi_variable_step_scale(double x, double of_v, double of_a);

/* fvi_variable_step_limit -- limit the steps, before the first step: no step is longer than `longest`, or longer than
 * the step before by more than `growth` factors exp(FVI_SPACING). */
void fvi_variable_step_limit(fvi_stepper *s, double longest, int growth);

/* fvi_variable_step_rest_below -- set the height of rest, before the first step: after an impact a body is at rest if
 * it would rise no higher than `height`, a length of x, > 0. With 0, and without this call, the height is the tolerance
 * of a step. */
void fvi_variable_step_rest_below(fvi_stepper *s, double height);

/* fvi_variable_step_jump -- add an impulse, factor J, at o->t: v jumps, (22.22), and with a mechanism p, too.
 *
 * fvi_variable_step_apply_impulses -- add the impulses at o->t that have not acted yet.
 *
 * Both return FVI_SUCCESS; with a mechanism the codes of fvi_mesh_jump, with matrices the codes of their functions. */
int fvi_variable_step_jump(fvi_stepper *s, fvi_variable_step_state *o, const double *J, double factor);
int fvi_variable_step_apply_impulses(fvi_stepper *s, fvi_variable_step_state *o);

/* fvi_variable_step_start_for_adjoint -- start a run without events like fvi_variable_step_start. But a start has a
 * singular part, and a step ends at t1, also if the amplitude A of the initial history of every damped coordinate is 0.
 * A structure whose dampers are not stretched at the start takes steps as short as if they were. A derivative by A
 * needs this. */
int fvi_variable_step_start_for_adjoint(fvi_stepper *s);

/* fvi_variable_step_stage_time -- return the time of stage i of a step from t, of length h. The first and the last
 * stage lie just within the step, because a jump of the force at a node belongs to neither side. */
static inline double fvi_variable_step_stage_time(const fvi_variable_rule *rule,
                                             double t, double h, size_t i)
{
    return fvi_inner_time(t, t + h, h, t + rule->c[i] * h, i, rule->s);
}

/* fvi_variable_step_start, _stop, _copy, _archive -- the functions of fvi_method. */
int fvi_variable_step_start(fvi_stepper *s);
void fvi_variable_step_stop(fvi_stepper *s);
int fvi_variable_step_copy(const fvi_stepper *from, fvi_stepper *to);
int fvi_variable_step_archive(fvi_stepper *s, fvi_archive *v);

/* fvi_variable_step_allocate -- allocate the arrays of o, for the sizes in o. fvi_variable_step_stop frees them, also
 * after an error. Returns FVI_SUCCESS or FVI_ENOMEM. */
int fvi_variable_step_allocate(fvi_variable_step_state *o);

/* fvi_variable_step_compliance -- return about how far a coordinate moves until the end of the run if its velocity at
 * o->t is larger by 1. */
static inline double fvi_variable_step_compliance(const fvi_variable_step_state *o,
                                        const fvi_coordinate_group *group)
{
    return fmin(group->compliance, o->T - o->t);
}

/* fvi_variable_step_prepare_kernel, _copy_kernel -- prepare a law of damping for a run, or copy it; free it with free.
 * The first returns FVI_SUCCESS or FVI_ENOMEM, the second NULL without memory.
 * fvi_variable_step_begin_kernel -- allocate the modes of a law that acts on `count` numbers: `rising` for its terms
 * that grow faster than s, and `modes` for the others. Both are NULL before, and stay so if there are none. Returns
 * FVI_SUCCESS; FVI_EUNSUP if a pole of the law is too near to its cut, or off it; FVI_EDOM if the run is too short for
 * modes; FVI_ENOMEM.
 * fvi_variable_step_explain_modes -- return the status of an allocation of modes; tell s->error of FVI_EDOM.
 * fvi_variable_step_present_kernel -- compute W0 for steps of length h and a scale h^beta of time, and W1, which is
 * W0 1 of the terms that do not rise. (26.18)
 * fvi_memory_leakage -- return |b . W0 A P_{s-1}|. */
typedef struct fvi_variable_step_kernel fvi_variable_step_kernel;
int fvi_variable_step_prepare_kernel(const fvi_kernel *law,
                                     fvi_variable_step_kernel **kernel);
fvi_variable_step_kernel *
fvi_variable_step_copy_kernel(const fvi_variable_step_kernel *from);
int fvi_variable_step_begin_kernel(const fvi_variable_step_state *o, const fvi_variable_step_kernel *kernel,
                                   size_t count, fvi_modes **modes, fvi_modes **rising);
int fvi_variable_step_explain_modes(const fvi_stepper *s, const fvi_variable_step_state *o, int status);
void fvi_variable_step_present_kernel(const fvi_variable_rule *rule, const fvi_variable_step_kernel *kernel, double h,
                                      double beta, fvi_square *W0, double *W1);
double fvi_memory_leakage(const fvi_variable_rule *rule, const fvi_square *W0);

/* fvi_add_compensated -- add more to *sum. *less keeps the rounding error of the sum (Kahan). */
static inline void fvi_add_compensated(double *sum, double *less, double more)
{
    const double y = more - *less, t = *sum + y;
    *less = (t - *sum) - y;
    *sum = t;
}

/* fvi_variable_step_try -- solve a step of this length for delta, and estimate its error. Returns the codes
 * of fvi_variable_step_solve. */
int fvi_variable_step_try(fvi_stepper *s, fvi_variable_step_state *o, fvi_length length,
                          double *error);

/* fvi_variable_step_find_events -- fill o->events, in order. Returns FVI_SUCCESS; FVI_EINVAL if the force has too many
 * jumps; FVI_ENOMEM.
 * fvi_variable_step_next_event -- return the next time at which a step must end.
 * fvi_variable_step_exponent -- return k of h = exp(L k); for a length off the lattice, the next lower k.
 * fvi_variable_step_choose -- set o->allowed, and choose the length of the next step. It is exp(L k) with k =
 * o->next_exponent. It is shorter if the step could pass over a pulse of the force, (22.25), and then o->next_exponent
 * becomes smaller, too, or if the step must end at the event. Returns FVI_SUCCESS, or the code of force.bound. */
int fvi_variable_step_find_events(const fvi_stepper *s, fvi_variable_step_state *o);
double fvi_variable_step_next_event(fvi_variable_step_state *o);
int fvi_variable_step_exponent(fvi_length length);
int fvi_variable_step_choose(const fvi_stepper *s, fvi_variable_step_state *o, double event,
                        fvi_length *length);

/* fvi_variable_step_find -- find the next step: try lengths until the error is small enough, and shorten the step if an
 * event happens in it. Set o->next_exponent for the step after it.
 *
 *   event  the step ends at this time at the latest
 *
 * Returns FVI_SUCCESS; FVI_ERUNAWAY; FVI_EMAXITER, FVI_ESING or FVI_EOVRFLW if no step is short enough, FVI_EBADFUNC
 * if a function is not finite there; the codes of fvi_variable_step_try and of the events. */
int fvi_variable_step_find(fvi_stepper *s, fvi_variable_step_state *o, double event);

/* fvi_variable_step_matrices -- compute the matrices of all groups for steps of this length. Returns FVI_SUCCESS, or
 * FVI_ESING if a matrix is singular. */
int fvi_variable_step_matrices(fvi_variable_step_state *o, fvi_length length);

/* fvi_variable_step_solve -- solve the equation of a step for o->delta. base and R are known: (22.14)
 *
 *     L delta = R - h grad U(base + h to_x delta)
 *
 * The accuracy of x is 1e-5 of o->allowed, or 1e-3 of it if the tolerance is above FVI_TOLERANCE_LOOSE. Returns
 * FVI_SUCCESS; FVI_EMAXITER or FVI_ESING if the iteration does not converge, and then a shorter step may converge;
 * FVI_ENOMEM; or the code of a callback. */
int fvi_variable_step_solve(fvi_stepper *s, fvi_variable_step_state *o);

/* fvi_variable_step_extrapolate -- write an initial guess to o->delta: the velocities of the last step's polynomial; or
 * zeros, if the new step is too long for it or follows an event.
 * fvi_variable_step_guess_by_leapfrog -- write another guess: the leapfrog method runs from stage to stage, with the
 * force at each stage and the memory of the stages before it. Cost O(s^2 d) and s gradients. Returns FVI_SUCCESS; the
 * code of the gradient; FVI_EMAXITER if a stage is too far away. */
void fvi_variable_step_extrapolate(fvi_variable_step_state *o);
int fvi_variable_step_guess_by_leapfrog(const fvi_stepper *s, fvi_variable_step_state *o);

/* fvi_variable_step_is_astray -- return nonzero if a stage, at o->point, is too far from the stage of a free body. Too
 * far means ten times the sum of the largest |x| so far, o->allowed, and the distance that the free body moves. With
 * few digits, such a long step may end at a solution of (22.14) that belongs to no motion. */
int fvi_variable_step_is_astray(const fvi_variable_step_state *o);

/* fvi_variable_step_solve_linear -- solve the same equation if o->solve is FVI_SOLVE_LINEAR. R is overwritten. Returns
 * FVI_SUCCESS, or the code of the gradient. */
int fvi_variable_step_solve_linear(fvi_stepper *s, fvi_variable_step_state *o);

/* fvi_variable_step_factorise -- compute the factors of o->band for the diagonals in o->hessian. */
void fvi_variable_step_factorise(fvi_variable_step_state *o);

/* fvi_variable_step_powers -- convert Legendre coefficients to coefficients g of powers: f(theta) = sum_n
 * accel_legendre_n P_n(2 theta - 1) = sum_k g_k theta^k, n and k < s. g is an output of FVI_LANES numbers.
 * fvi_variable_step_once, _twice -- compute weights w, so that sum_k w_k g_k is the integral of f from 0 to theta, or
 * the double integral, in units of a step. w is an output of FVI_LANES numbers. */
void fvi_variable_step_powers(size_t s, const double *accel_legendre, double *g);
void fvi_variable_step_once(double theta, double *w);
void fvi_variable_step_twice(double theta, double *w);

/* fvi_variable_step_shapes -- compute the integrals of P_n(2 u - 1) from 0 to theta_i, n < s, at entry (i, n) of R.
 * theta has FVI_LANES numbers, of which the first s count. The rest of R has no meaning. */
void fvi_variable_step_shapes(size_t s, const double *theta, fvi_square *R);

/* fvi_variable_step_dense, fvi_variable_step_rows -- the functions of fvi_method. (22.18) */
int fvi_variable_step_dense(const fvi_stepper *s, double t, double *x, double *p);
int fvi_variable_step_rows(const fvi_stepper *s, size_t count, const double *t, double *x,
                           double *p);

/* fvi_variable_step_within -- compute x and p, d numbers each, at t + theta h in the step that is tried. */
void fvi_variable_step_within(const fvi_stepper *s, const fvi_variable_step_state *o,
                              double theta, double *x, double *p);

/* fvi_variable_step_acceleration -- compute x'', d numbers, at a time within the last step: the polynomial that
 * fvi_variable_step_dense integrates, and G'' in a singular start. Returns FVI_SUCCESS, or FVI_EDOM for a time outside
 * the last step. */
int fvi_variable_step_acceleration(const fvi_stepper *s, double t, double *a);

/* fvi_singular_power -- return a_n of (22.19) and (22.23). */
static inline double fvi_singular_power(const fvi_singular *g, size_t n)
{
    return (double)n * g->gap + g->e;
}

/* fvi_singular_before -- return nonzero if a step that begins at t begins before t1. If an event lies a rounding error
 * before t1, the steps end at the event and not at t1, and a step from the event does not count as before t1.
 * fvi_singular_is -- return nonzero if x = y + G in the step that begins at t. */
static inline int fvi_singular_before(const fvi_singular *g, double t)
{
    return g->J > 0 && t * (1 + 8 * GSL_DBL_EPSILON) < g->t1;
}

static inline int fvi_singular_is(const fvi_variable_step_state *o, double t)
{
    return fvi_singular_before(&o->singular, t);
}

/* fvi_singular_start -- compute J, t1 and the coefficients of the start of s. Free o->singular.c with free, also after
 * an error. Returns FVI_SUCCESS or FVI_ENOMEM. */
int fvi_singular_start(const fvi_stepper *s, fvi_variable_step_state *o);

/* fvi_singular_allocate -- allocate c, ratio and residual_force of d coordinates and g->J terms, as zeros in one array;
 * free g->c with free. Returns FVI_SUCCESS or FVI_ENOMEM.
 * fvi_singular_fill -- compute these arrays for the amplitudes A, one number for each coordinate. */
int fvi_singular_allocate(size_t d, fvi_singular *g);
void fvi_singular_fill(const fvi_system *system, double alpha, double T,
                       const double *A, fvi_singular *g);

/* fvi_singular_at -- compute for coordinate j at t > 0: G, G', and ((rho/m) t^gap)^{J+1} t^{e-2} times residual_force.
 * Any output may be NULL. */
void fvi_singular_at(const fvi_singular *g, size_t j, double t, double *G,
                     double *slope, double *residual_force);

/* fvi_singular_acceleration -- return G'' of coordinate j at t > 0. */
double fvi_singular_acceleration(const fvi_singular *g, size_t j, double t);

/* fvi_singular_moment -- return sum_n d_n I(a_n, S) of (22.20), for S >= 0. fvi_singular_sums computes the series f
 * from d_n and a_n > 0, n < count. Accuracy: 1e-14 of sum |d_n| I(a_n, S), or 1e-8 if coarse is nonzero. */
enum { FVI_NEAR = 128, FVI_FAR = 36 };
typedef struct {
    int coarse;
    double B[FVI_NEAR], D[FVI_FAR];
} fvi_singular_series;
void fvi_singular_sums(size_t count, const double *d, const double *a,
                       int coarse, fvi_singular_series *f);

/* fvi_singular_sums_by_order -- the same series for sum_n rate_n I(a_n, S) + d_n dI/da (a_n, S), never coarse. */
void fvi_singular_sums_by_order(size_t count, const double *d, const double *rate,
                        const double *a, fvi_singular_series *f);
double fvi_singular_moment(const fvi_singular_series *f, double S);

/* fvi_singular_transfer -- end the singular part at o->t = t1: y and v become x and x', and the modes take over the
 * effect of G. (22.20) */
void fvi_singular_transfer(fvi_variable_step_state *o);

#endif
