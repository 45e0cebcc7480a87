/* src/variable_step/variable_step.h -- What a run with variable steps keeps.     [H 22]
 *
 * Internal. The files beside it each have one part: _start makes it, _state holds it, _solve solves the
 * equation of a step, _dense has what is between its ends, _singular the start that is not smooth,
 * _events ends a step at an event, and _impact has what the event does. */
#ifndef FVI_VARIABLE_STEP_H
#define FVI_VARIABLE_STEP_H

#include <fvi/variable_steps.h>
#include "variable_step_band.h"
#include "run/step_times.h"
#include "stages/variable_modes.h"

#include <gsl/gsl_machine.h>
#include <math.h>

/* Above it equations have fewer digits and a singular start fewer terms; above ten times it modes are coarse. */
#define FVI_TOLERANCE_LOOSE 1e-6

/* Above it a step's polynomial is no guess beyond the step, and stages need Hessians of their own. */
#define FVI_TOLERANCE_VERY_LOOSE 1e-2

/* The least tolerance, of the size: rounding hides what is less. */
#define FVI_TOLERANCE_LEAST 1e-17

/* With this run->tolerance, which is not read else, modes are fine whatever the tolerance. */
#define FVI_FINE_MODES 1e-300

/* With this one they follow the tolerance although a force acts: a search compares two runs, and counts what the modes
 * lose of the size that the motion comes to. */
#define FVI_MODES_BY_TOLERANCE 2e-300

/* With this one, and with the two above, the tolerance of a step is no caller's: below the least one it counts as that, and
 * is not refused. */
#define FVI_ANY_TOLERANCE 3e-300

/* Coordinates with the same mass, damping and spring share their matrices. */
typedef struct {
    double mass, damping; /* m, or m + rho for alpha = 1; rho */
    double spring; /* the c of U = c x^2 / 2 + ..., where that is all of it; or 0 */
    double damping_coeff;        /* rho h^{1 - beta} */
    double compliance;       /* about how far x moves for a velocity 1 more */
    fvi_square L;       /* m A^{-1} + rho h^{1 - beta} W0 + c h^2 to_x */
    fvi_square inverse; /* its inverse, if one asks for it */
} fvi_coordinate_group;

/* How many factors exp(L) a step may be longer than the one before, and after a trial
 * shorter. After so many steps without a failure a longer one is tried again that could not be solved;
 * after so many iterations that did not contract none is tried. */
enum {
    FVI_VARIABLE_STEP_GROWTH = 4,
    FVI_VARIABLE_STEP_LESS = 12,
    FVI_VARIABLE_STEP_RETRY = 16,
    FVI_VARIABLE_STEP_STUCK = 20
};

/* No step, and no t1, is shorter than that part of a run. */
#define FVI_SHORTEST 1e-248

/* The singular part of a start: x = y + G, y smoother, until t1.            (22.19)
 *
 *     G(t) = sum_{n=1}^{J} c_n (rho/m)^n t^{a_n},   a_n = n gap + e,   gap = 2 - 2 alpha
 *
 * or m/rho and gap = 2 alpha - 2, where these powers fall. y begins with c_0 t^e. (22.23) */
enum { FVI_SINGULAR_MOST = 256 };
typedef struct {
    size_t J; /* 0: there is no such part; SINGULAR_MOST at most */
    double e, gap, t1;
    int by_euler_transform; /* by Euler's transformation */
    double *c; /* c_0, ..., c_J of each coordinate; c_0 jumped at t = 0 */
    double *ratio; /* rho / m of each, or m / rho */
    double *
        residual_force; /* what is left as a force: -residual_force ((rho/m) t^gap)^{J+1} t^{e-2} */
} fvi_singular;

/* How the equation of a step is solved: at once, as U is quadratic and its Hessian
 * diagonal; as its Hessian is diagonal; as it is not, by iterations; all together at
 * once, as an iteration has not contracted too often. With a band the second and third
 * are one. */
typedef enum {
    FVI_SOLVE_LINEAR,
    FVI_SOLVE_DIAGONAL,
    FVI_SOLVE_COUPLED,
    FVI_SOLVE_TOGETHER
} fvi_step_solver;

/* Stage i of coordinate j stands at [j * FVI_LANES + i], but in point, gradient and
 * hessian at [i * d + j], as the callbacks want it. */
typedef struct {
    const fvi_variable_rule *rule;
    size_t d;
    double beta;
    double tolerance; /* the tolerance of a step, of the size at first */
    fvi_step_solver solve;
    const fvi_square *to_x; /* X = base + h to_x delta: A, or that of form M */
    fvi_square W0;          /* (22.2), and W0 1 */
    double W1[FVI_LANES];
    double memory_leakage; /* |b . W0 A P_{s-1}|: what the memory adds to v, (22.16) */
    size_t kinds, *kind; /* how many; which of them has each coordinate */
    fvi_coordinate_group *group;
    fvi_length length; /* of the steps for which their matrices are */
    double coupled; /* and s->newton, if there is one, or the factors of a quadratic U */
    /* the past */
    fvi_modes_kind modes_kind; /* how many digits the modes of such a tolerance have */
    fvi_modes *modes;      /* NULL: none is needed */
    struct fvi_variable_step_kernel *kernel; /* of a law; NULL: a power */
    fvi_modes *rising;     /* of its terms that grow faster than s, or NULL */
    size_t damped, *index; /* the coordinates that have modes */
    double *centre; /* alpha = 0: where the springs of the damping rest */
    struct fvi_mesh_structure *structure; /* variable_structure.h; NULL: no matrices */
    struct fvi_mesh_mechanism *mechanism; /* variable_mechanism.h; NULL: none */
    fvi_singular singular;
    int for_adjoint; /* the singular part is there where A = 0, too, for a derivative by A */
    /* the state at t, compensated; y is x without its singular part */
    double *y, *y_less, *v, *v_less, t, t_less;
    double *impulse_dv; /* what the impulses at t have added to v */
    size_t hits;  /* impulses that have acted */
    int takes_kicks; /* nonzero if steps can be as short as a jump of v asks for */
    struct fvi_event_watch *watch; /* variable_step_events.h; NULL: no events */
    /* this step, or the last: its start, its stages */
    double t0, *y0, *v0;
    double *base, *R, *delta;
    double *accel_legendre,
        *accel_legendre0; /* h times the Legendre coefficients of x''; of the last step */
    double *powers;   /* those as powers, in the place of accel_legendre, */
    int powers_known; /* once a row within the last step was asked for */
    double *point, *gradient, *hessian;
    fvi_square *jacobian; /* of each coordinate, inverted; or NULL */
    size_t diagonals;     /* of the Hessian, if they are few; or 0 */
    fvi_variable_step_band *band;
    /* control */
    double *events; /* where steps have to end: jumps, impulses, t1, T at last */
    size_t event, event_count;
    double T, least;    /* the end; no step is shorter */
    double scale;       /* the largest |x_i| so far */
    double allowed;     /* the tolerance of this step */
    double contraction; /* of the last iteration */
    int next,
        first; /* exponents k of the next h = exp(L k), of one after a jump */
    int first_after_event; /* nonzero in the first step after a jump */
    int most, fewest; /* those of the longest and the shortest step */
    int growth;       /* so much may k grow from step to step */
    int longest_solvable; /* k to be tried at most, as the equation of a longer step */
    int steps_since_failure;      /* has not been solved, so many steps ago */
    /* up to this time, steps of this length and shorter ones hide nothing of the force; so
     * many steps ahead its bounds, which are *most_of_force, are asked for */
    double clear_to, clear_h, *most_of_force;
    int ahead;
    double undeclared_jump_until;  /* up to this time a force may jump that did not say so */
    int stalled_iterations;     /* so often has the iteration not contracted */
    fvi_step_statistics counts;
    size_t next_pace_check; /* so many steps, and at what time the pace was checked */
    double pace_checked_at;
} fvi_variable_step_state;

/* fvi_variable_step_runs_away -- has the run taken run.most_steps, or is it so slow that it comes to
 * no end? Asked before each step that is tried. */
int fvi_variable_step_runs_away(fvi_variable_step_state *o, size_t most_steps);

/* fvi_variable_step_scale -- a size for a tolerance that is none: x; or how far the body comes in the time of a row by its
 * velocity, or by its acceleration; or 1. What is not above rounding beside the next is none. */
double fvi_variable_step_scale(double x, double of_v, double of_a);

/* fvi_variable_step_limit -- before the first step: no step longer than `longest`, nor than
 * the last by more than `growth` factors exp(FVI_SPACING). */
void fvi_variable_step_limit(fvi_stepper *s, double longest, int growth);

/* fvi_variable_step_rest_below -- before the first step: an impact leaves a body at rest if it would rise no
 * higher than `height`, a length of x, > 0; with 0, and without this, that is the tolerance of a step. */
void fvi_variable_step_rest_below(fvi_stepper *s, double height);

/* fvi_variable_step_apply_impulses -- let the impulses at o->t act that have not: v jumps, (22.22). Returns as
 * fvi_mesh_jump of a mechanism. */
int fvi_variable_step_apply_impulses(fvi_stepper *s, fvi_variable_step_state *o);

/* fvi_variable_step_start_for_adjoint -- as fvi_variable_step_start; steps end at t1 also where the
 * initial history of a damped coordinate has a force that is 0 at this start, for a derivative by its amplitude. */
int fvi_variable_step_start_for_adjoint(fvi_stepper *s);

/* fvi_variable_step_stage_time -- of stage i of a step from t on, of length h, from within the
 * step at its ends: a jump of the force at a node belongs to neither side. */
static inline double fvi_variable_step_stage_time(const fvi_variable_rule *rule,
                                             double t, double h, size_t i)
{
    return fvi_inner_time(t, t + h, h, t + rule->c[i] * h, i, rule->s);
}

/* fvi_variable_step_start, _stop, _copy, _archive -- as fvi_method has them. */
int fvi_variable_step_start(fvi_stepper *s);
void fvi_variable_step_stop(fvi_stepper *s);
int fvi_variable_step_copy(const fvi_stepper *from, fvi_stepper *to);
int fvi_variable_step_archive(fvi_stepper *s, fvi_archive *v);

/* fvi_variable_step_allocate -- the arrays of o, whose sizes are known; what is missing stays
 * NULL. FVI_ENOMEM. */
int fvi_variable_step_allocate(fvi_variable_step_state *o);

/* fvi_variable_step_compliance -- about how far a coordinate moves, until the end, for a velocity 1
 * more at o->t. */
static inline double fvi_variable_step_compliance(const fvi_variable_step_state *o,
                                        const fvi_coordinate_group *kind)
{
    return fmin(kind->compliance, o->T - o->t);
}

/* fvi_variable_step_prepare_kernel, _copy_kernel -- a law as a run needs it; give it back with
 * free. FVI_ENOMEM; NULL.
 * fvi_variable_step_begin_kernel -- o->modes and o->rising of o->kernel: FVI_EUNSUP where poles are
 * too near to the cut, or off it; FVI_ENOMEM.
 * fvi_variable_step_present_kernel -- W0, W1 and memory_leakage of steps of length h.   (26.18) */
typedef struct fvi_variable_step_kernel fvi_variable_step_kernel;
int fvi_variable_step_prepare_kernel(const fvi_kernel *law,
                                     fvi_variable_step_kernel **kernel);
fvi_variable_step_kernel *
fvi_variable_step_copy_kernel(const fvi_variable_step_kernel *from);
int fvi_variable_step_begin_kernel(fvi_variable_step_state *o);
void fvi_variable_step_present_kernel(fvi_variable_step_state *o, double h);

/* The same of any law, which acts on d numbers, in a run of the time T whose steps are never shorter than
 * `least`. W1 is W0 1 of the terms that do not rise. fvi_memory_leakage is |b . W0 A P_{s-1}|. */
typedef struct {
    const fvi_variable_step_kernel *kernel;
    const fvi_variable_rule *rule;
    size_t d;
    double T, least;
} fvi_kernel_on_mesh;
int fvi_kernel_begin_on_mesh(const fvi_kernel_on_mesh *o, fvi_modes **modes,
                             fvi_modes **rising);
void fvi_kernel_present_on_mesh(const fvi_kernel_on_mesh *o, double h, double beta,
                                fvi_square *W0, double *W1);
double fvi_memory_leakage(const fvi_variable_rule *rule, const fvi_square *W0);

/* fvi_add_compensated -- sum += more, what rounding takes from it kept in less (Kahan). */
static inline void fvi_add_compensated(double *sum, double *less, double more)
{
    const double y = more - *less, t = *sum + y;
    *less = (t - *sum) - y;
    *sum = t;
}

/* fvi_variable_step_try -- delta of a step of such length, and the estimate of its error. Returns what
 * fvi_variable_step_solve does. */
int fvi_variable_step_try(fvi_stepper *s, fvi_variable_step_state *o, fvi_length length,
                          double *error);

/* fvi_variable_step_find_events -- o->events, in order. FVI_EINVAL; FVI_ENOMEM.
 * fvi_variable_step_next_event -- the next time at which a step has to end.
 * fvi_variable_step_exponent -- the k of a length exp(L k), which may be none of the lattice.
 * fvi_variable_step_choose -- o->allowed, and the length of the next step: as o->next says, or
 * shorter, where the step would pass over something of the force (22.25), or before an
 * event. o->next then says so too. Returns what force.bound does. */
int fvi_variable_step_find_events(const fvi_stepper *s, fvi_variable_step_state *o);
double fvi_variable_step_next_event(fvi_variable_step_state *o);
int fvi_variable_step_exponent(fvi_length length);
int fvi_variable_step_choose(const fvi_stepper *s, fvi_variable_step_state *o, double event,
                        fvi_length *length);

/* fvi_variable_step_find -- the next step, tried with the longest length whose error is small enough, or cut by an
 * event; o->next, for the step behind it. event: it ends there at the latest. Returns FVI_ERUNAWAY; FVI_EMAXITER or
 * FVI_EOVRFLW where no step is short enough; what fvi_variable_step_try and the events return. */
int fvi_variable_step_find(fvi_stepper *s, fvi_variable_step_state *o, double event);

/* fvi_variable_step_matrices -- those of steps of such length. FVI_ESING if one is singular. */
int fvi_variable_step_matrices(fvi_variable_step_state *o, fvi_length length);

/* fvi_variable_step_solve -- o->delta of the step whose base and R are there:    (22.14)
 *
 *     L delta = R - h grad U(base + h to_x delta)
 *
 * to 1e-5 of o->allowed in x, or 1e-3 where the tolerance is larger than FVI_TOLERANCE_LOOSE.
 * FVI_EMAXITER or FVI_ESING if it does not converge: a
 * shorter step may. What a callback returned comes back. */
int fvi_variable_step_solve(fvi_stepper *s, fvi_variable_step_state *o);

/* fvi_variable_step_extrapolate -- a guess of o->delta, from the velocities of the last step's
 * polynomial; zeros where that is too far away.
 * fvi_variable_step_guess_by_leapfrog -- another, from stage to stage by the leapfrog method, with the force at
 * each and what the memory makes of the stages before it. Cost O(s^2 d) and s gradients.
 * Returns what a callback does; FVI_EMAXITER where it goes astray. */
void fvi_variable_step_extrapolate(fvi_variable_step_state *o);
int fvi_variable_step_guess_by_leapfrog(const fvi_stepper *s, fvi_variable_step_state *o);

/* fvi_variable_step_is_astray -- is a stage, at o->point, more than ten times farther from x_k
 * than all motion so far, o->allowed, and the way of a free body together? With few digits
 * a step that long may end at a solution of (22.14) that belongs to no motion. */
int fvi_variable_step_is_astray(const fvi_variable_step_state *o);

/* fvi_variable_step_solve_linear -- the same where o->solve is FVI_SOLVE_LINEAR; R is not kept. */
int fvi_variable_step_solve_linear(fvi_stepper *s, fvi_variable_step_state *o);

/* fvi_variable_step_factorise -- the factors of o->band for the diagonals in o->hessian. */
void fvi_variable_step_factorise(fvi_variable_step_state *o);

/* fvi_variable_step_powers -- f(theta) = sum_n accel_legendre_n P_n(2 theta - 1) = sum_k g_k theta^k, n
 * and k < s; g has FVI_LANES numbers.
 * fvi_variable_step_once, _twice -- its integral from 0 to theta, in units of a step, and that
 * of its integral are sum_k w_k g_k; w has FVI_LANES numbers. */
void fvi_variable_step_powers(size_t s, const double *accel_legendre, double *g);
void fvi_variable_step_once(double theta, double *w);
void fvi_variable_step_twice(double theta, double *w);

/* fvi_variable_step_shapes -- the integrals of P_n(2 u - 1) from 0 to theta_i, n < s, entry
 * (i, n), at s times of which FVI_LANES are there; the rest of the matrix is of no use. */
void fvi_variable_step_shapes(size_t s, const double *theta, fvi_square *R);

/* fvi_variable_step_dense, fvi_variable_step_rows -- as fvi_method has them.      (22.18) */
int fvi_variable_step_dense(const fvi_stepper *s, double t, double *x, double *p);
int fvi_variable_step_rows(const fvi_stepper *s, size_t count, const double *t, double *x,
                           double *p);

/* fvi_variable_step_within -- x and p, d numbers each, at t + theta h of the step that has been tried. */
void fvi_variable_step_within(const fvi_stepper *s, const fvi_variable_step_state *o,
                              double theta, double *x, double *p);

/* fvi_variable_step_acceleration -- x'' at a time within the last step, d numbers: the polynomial that
 * dense integrates, and G'' of a singular start. Returns as dense. */
int fvi_variable_step_acceleration(const fvi_stepper *s, double t, double *a);

/* fvi_singular_power -- a_n of (22.19) and (22.23). */
static inline double fvi_singular_power(const fvi_singular *g, size_t n)
{
    return (double)n * g->gap + g->e;
}

/* fvi_singular_before -- does a step that begins at t begin before t1? Where steps end at another
 * event a rounding before t1, they do not end at t1 itself.
 * fvi_singular_is -- is x = y + G in such a step? */
static inline int fvi_singular_before(const fvi_singular *g, double t)
{
    return g->J > 0 && t * (1 + 8 * GSL_DBL_EPSILON) < g->t1;
}

static inline int fvi_singular_is(const fvi_variable_step_state *o, double t)
{
    return fvi_singular_before(&o->singular, t);
}

/* fvi_singular_start -- finds J, t1 and the coefficients; FVI_ENOMEM. The arrays of
 * o->singular are there, or NULL, after it: give c back with free. */
int fvi_singular_start(const fvi_stepper *s, fvi_variable_step_state *o);

/* fvi_singular_allocate -- c, ratio and residual_force of d coordinates and g->J terms, zeros; give c
 * back with free. FVI_ENOMEM.
 * fvi_singular_fill -- what stands there, for these A, one of each coordinate. */
int fvi_singular_allocate(size_t d, fvi_singular *g);
void fvi_singular_fill(const fvi_system *system, double alpha, double T,
                       const double *A, fvi_singular *g);

/* fvi_singular_at -- of coordinate j at t > 0: G, G', and t^{a_J - 2 alpha} times residual_force.
 * Any of the outputs may be NULL. */
void fvi_singular_at(const fvi_singular *g, size_t j, double t, double *G,
                     double *slope, double *residual_force);

/* fvi_singular_acceleration -- G'' of coordinate j at t > 0. */
double fvi_singular_acceleration(const fvi_singular *g, size_t j, double t);

/* fvi_singular_moment -- sum_n d_n I(a_n, S) of (22.20), S >= 0, from what
 * fvi_singular_sums makes of d_n and a_n > 0, n < count. To 1e-14 of sum |d_n| I(a_n, S), or
 * to 1e-8 where that is coarse. */
enum { FVI_NEAR = 128, FVI_FAR = 36 };
typedef struct {
    int coarse;
    double B[FVI_NEAR], D[FVI_FAR];
} fvi_singular_series;
void fvi_singular_sums(size_t count, const double *d, const double *a,
                       int coarse, fvi_singular_series *f);

/* fvi_singular_sums_by_order -- the same for sum_n rate_n I(a_n, S) + d_n dI/da (a_n, S). */
void fvi_singular_sums_by_order(size_t count, const double *d, const double *rate,
                        const double *a, fvi_singular_series *f);
double fvi_singular_moment(const fvi_singular_series *f, double S);

/* fvi_singular_hand_over -- at o->t = t1: y and v become x and x', the modes take over
 * what G has done, and the singular part is no more.                        (22.20) */
void fvi_singular_hand_over(fvi_variable_step_state *o);

#endif
