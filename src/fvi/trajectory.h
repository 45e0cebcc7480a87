/* src/fvi/trajectory.h -- Runs: a start, a step size, a method.      [H 2]
 *
 * A stepper holds x_k, p_k and what the method needs to go on, and nothing
 * else: no array over the time steps is made unless the caller makes it. The
 * caller reads x and p between steps, so rows can be printed as they come:
 *
 *     fvi_stepper *s;
 *     if (fvi_stepper_start(&fvi_fractional, &run, &s, &error) == FVI_SUCCESS) {
 *         while (s->k < run.steps && fvi_stepper_step(s) == FVI_SUCCESS)
 *             printf("%g %g\n", s->t, s->x[0]);
 *         fvi_stepper_free(s);
 *     } */
#ifndef FVI_TRAJECTORY_H
#define FVI_TRAJECTORY_H

#include "convolution_quadrature.h"
#include "damping_laws.h"
#include "memory.h"
#include "past.h"
#include "system.h"
#include "archive.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

typedef struct fvi_event fvi_event; /* events.h */

/* fvi_run -- all that determines the numbers of a trajectory.
 *
 *   system   what moves; must outlive the run
 *   x0, p0   start, d finite numbers each; copied
 *   h        step, finite, > 0
 *   steps    N >= 1: the rows are k = 0, ..., N at t_k = k h
 *   kappa    potential taken at kappa x_k + (1 - kappa) x_{k+1}, 0 <= kappa <= 1
 *   alpha    the damping is of order 2 alpha, 0 <= alpha <= 1
 *   past     what the body did before t = 0 (past.h); zeroed: it was held at x0
 *   memory   how the history is summed
 *   tolerance  of the compressed memory, relative to the direct sum, in [0, 1); 0
 *              means the default 1e-13; of no effect without a history
 *   step_error  for methods that choose their steps: what the estimated error of x
 *              in one step may be, >= 0; 0 means 1e-10 of the largest |x_i| so far.
 *              Below 1e-17 of the size at the start it is refused (FVI_ETOL), and
 *              where the motion grows to more it means 1e-17 of that.
 *              h and steps say where the rows are, then, and not how long a step is
 *   longest  for methods that choose their steps, and for searches: no step is longer,
 *              >= 0; 0 means that there is no such limit. A force that swings, or has a
 *              pulse, in less than this time is seen though it has no bound (system.h)
 *   most_steps  for methods that choose their steps: so many may be taken, with those that were
 *              given up; then FVI_ERUNAWAY. 0: no number, but a run ends so if the rest would
 *              take more than 2^40 steps at the pace of the last 2^18
 *   events, event_count  for fvi_variable_step: what is watched along the run (events.h), or none;
 *              must outlive the run
 *   law      NULL, or what stands in place of D^{2 alpha} (damping_laws.h): alpha is then
 *            not read, and the body was held before t = 0; must outlive the run. For
 *            methods that say so
 *
 * What is left out of an initialiser is zero: begin with fvi_run_default, which
 * sets what must not be zero by accident.
 * The methods stand in the table fvi_methods (methods.h). Runs that share no stepper
 * may go on in several threads. */
typedef struct {
    const fvi_system *system;
    const double *x0, *p0;
    double h;
    size_t steps;
    double kappa;
    double alpha;
    fvi_initial_history past;
    fvi_history_kind memory;
    double tolerance;
    double step_error;
    double longest;
    size_t most_steps;
    const fvi_kernel *law;
    const fvi_event *events;
    size_t event_count;
} fvi_run;

/* fvi_run_default -- a run with kappa = 1/2 and alpha = 1/2, of a body that was held
 * at x0, its memory summed in the best way that there is; change what you like. */
fvi_run fvi_run_default(const fvi_system *system, const double *x0,
                        const double *p0, double h, size_t steps);

typedef struct fvi_method fvi_method;

/* fvi_scheme -- which equations a method solves, for those who transpose them
 * (adjoint.h): those of Algorithm 3, (13.7) with the shift alpha, (13.7) with the weights
 * of BDF2, (13.16), (17.8) or (17.24), (22.14); or others. */
typedef enum {
    FVI_SCHEME_CLASSICAL,
    FVI_SCHEME_FVI,
    FVI_SCHEME_CQ2_SHIFTED,
    FVI_SCHEME_CQ_BDF2,
    FVI_SCHEME_CQ2_MIDPOINT,
    FVI_SCHEME_LOBATTO,
    FVI_SCHEME_VARIABLE_STEP
} fvi_scheme;

/* fvi_stepper -- one trajectory on its way. Read k, t, x, p; leave the rest. While a function
 * works on a stepper, a callback (a potential, a force, an archive) may read these four, and
 * no more: fvi_stepper_step, fvi_stepper_copy, fvi_stepper_archive, fvi_stepper_reset and fvi_stepper_free of the same stepper return
 * FVI_EINVAL there, and change nothing. */
typedef struct {
    size_t k;      /* steps done; rows that have been passed, if steps vary */
    double t;      /* k h, one product; that of x and p, if steps vary */
    double *x, *p; /* position and momentum, d numbers each */

    double *dx, *g, *F; /* the last increment, gradient and force */
    struct fvi_newton *newton;
    void *method_state; /* what only this method has */
    struct fvi_mechanism_state *mechanism; /* of a system with a mechanism; or NULL */
    fvi_run run;
    const fvi_method *method;
    int is_busy; /* nonzero while a function has it that calls the caller's */
    fvi_error *error; /* while a method starts: where it says what it refuses */
} fvi_stepper;

/* fvi_method -- an integrator, and all that others ask about it. What counts are its
 * fields: a copy, under another name and at another address, is as good. name, order
 * and memory are for people, and may be NULL.
 *
 *   lowest, highest  the order as numbers: the lowest and the highest that x has at
 *          a fixed time, over all alpha, for Caputo's past and that of a held body (a
 *          kick, Riemann and Liouville's past, or a U that is not quadratic, (20.11),
 *          (20.12), or kappa != 1/2 may cost more); of fvi_variable_step, in the number
 *          of its steps, over all t
 *   stages  s, of the methods of Lobatto; 0 for all others
 *   damped_inertia  nonzero if the inertia is a damping of order 1 of the same kind,
 *          m DD^2 x, form D of H 17
 *   alpha_least, alpha_most  the alpha that it knows, within [0, 1]: 1/2 and 1/2 is
 *          linear damping only; fvi_stepper_start refuses other runs (FVI_EDOM)
 *   memories  a bit 1u << kind for each kind of memory that it can sum with;
 *          fvi_stepper_start refuses the others (FVI_EUNSUP). 0: it has no history, and
 *          run->memory is not read
 *   quadrature  whose weights stand before the positions of the past; not read of
 *          methods without a history, or with stages
 *   scheme  as above; OTHER has no adjoint
 *   takes_kappa  nonzero if run->kappa is used where there is a potential
 *   implicit  nonzero if a step solves an equation in which grad U stands, by Newton's
 *          method with the Hessian of U
 *   takes_laws  nonzero if run->law need not be NULL; fvi_stepper_start refuses it else
 *   (FVI_EUNSUP)
 *   takes_matrices  nonzero if the system may have matrices; fvi_stepper_start refuses it else
 *          (FVI_EUNSUP)
 *   takes_mechanism  nonzero if the system may have a mechanism; fvi_stepper_start refuses it else
 *          (FVI_EUNSUP)
 *   paper_convention  Every method knows the three pasts. Zero: Riemann-Liouville's acts by
 *          its exact impulses (19.5), and is refused where there is no solution (19.2,
 *          FVI_EDOM). Nonzero: by the weights alone, as in the paper; then order 1 - 2
 *          alpha is all there is of a kick (9.5), and what has no solution is run too
 *   stability_number   of run, above 1 if a mode grows, as fvi_stability_number (stability.h) has it;
 *          of U it asks for the Hessian at x0 alone. NULL if it is not known
 *   stability_number_grows  nonzero if that number does not fall while h grows: the stable steps are
 *          then all those up to the longest, fvi_stability_longest_step
 *   start  refuses runs that the method does not know; prepares newton and method_state;
 *          may be NULL
 *   step   x_k, p_k -> x_{k+1}, p_{k+1}; k and t still belong to step k
 *   dense  NULL, or of a method that chooses its steps: x and p (either may be NULL) at a
 *          time t <= s->t within the last step; FVI_EDOM before it. Such a method's step
 *          sets s->t, to steps h in the end
 *   rows   NULL, or of a method with dense: the same at `count` increasing times within the last
 *          step, to the bit, row after row into x and p; FVI_EDOM if one is outside
 *   copy   makes to->method_state out of from->method_state; NULL only if method_state is never set. The rest of
 *          *to is there, and stop will be called for it, whatever copy returns
 *   serialize  shows what steps change of method_state to an archive, and what must be the same
 *          (archive.h). NULL if method_state is never set, or the method has no such function
 *   stop   gives method_state back; may be NULL
 *   keep_dampers, damper  of a structure with several dampers: as fvi_stepper_keep_dampers and
 *          fvi_stepper_damper (dampers.h); NULL: the method takes none */
struct fvi_method {
    const char *name, *order, *memory;
    int lowest, highest, stages, damped_inertia;
    double alpha_least, alpha_most;
    unsigned memories;
    fvi_delta quadrature;
    fvi_scheme scheme;
    int takes_kappa, takes_laws, takes_matrices, takes_mechanism, implicit,
        paper_convention;
    int (*stability_number)(const fvi_run *run, double *load);
    int stability_number_grows;
    int (*start)(fvi_stepper *s);
    int (*step)(fvi_stepper *s);
    int (*dense)(const fvi_stepper *s, double t, double *x, double *p);
    int (*rows)(const fvi_stepper *s, size_t count, const double *t, double *x, double *p);
    int (*copy)(const fvi_stepper *from, fvi_stepper *to);
    int (*serialize)(fvi_stepper *s, fvi_archive *archive);
    void (*stop)(fvi_stepper *s);
    int (*keep_dampers)(fvi_stepper *s);
    int (*damper)(const fvi_stepper *s, size_t j, double *impulse, double *work);
};

/* fvi_method_takes_history -- nonzero if the method can sum with such a memory, or has no
 * history. What is no kind at all is not judged here: fvi_history_alloc refuses it. */
int fvi_method_takes_history(const fvi_method *method, fvi_history_kind kind);

/* fvi_stepper_start -- check the run, stand at k = 0.
 *
 *   error  output, or NULL: what is wrong, its field a member of fvi_run or of the system
 *
 * Memory O(d), O(d w) for the 2 w - 1 diagonals of a Hessian (O(d^2) if full) where
 * the step is implicit, and what the method's memory takes. Returns FVI_SUCCESS; what
 * fvi_system_check and fvi_history_alloc return; FVI_EFAULT if a pointer is NULL;
 * FVI_EINVAL if steps == 0 or the method does not take such a system; FVI_EDOM if h,
 * kappa, alpha, tolerance, x0 or p0 is out of range or the method does not know this
 * alpha, or if the run has no solution (19.2) and the method does not run it as printed;
 * of the impulses FVI_EFAULT without an array or a J, FVI_EINVAL if their times fall,
 * FVI_EDOM if a number is not finite or a time negative, FVI_EUNSUP at alpha = 1 if the
 * method has stages and anything is damped;
 * FVI_EUNSUP if the method has no such memory, does not know laws, or matrices, or the past
 * of a law is not FVI_INITIAL_HISTORY_HELD, nor, up to the order 1, Caputo's; what fvi_kernel_history returns, and FVI_EUNSUP for a law
 * that stages do not take; FVI_ENOMEM; FVI_ESING if a constant matrix is singular; FVI_EOVRFLW
 * if an impulse at t = 0 makes p infinite; what the potential returned. On error *stepper is
 * untouched. */
int fvi_stepper_start(const fvi_method *method, const fvi_run *run,
                      fvi_stepper **stepper, fvi_error *error);

/* fvi_stepper_step -- from k to k + 1, where p then holds what impulses give to that node, (2.15);
 * or, of a method that chooses its steps, one of these: from
 * s->t to a later s->t, the last of them to steps h.
 *
 * Cost: of the memory, and of the equation of an implicit step. If U is quadratic that
 * is at most two gradients and O(d w), else mostly two to five gradients, Hessians and
 * factorisations of O(d w^2), O(d^3) if the Hessian is full; up to 1050, and twice as
 * many gradients, where Newton's method fails. Which solution is found where there are
 * several is not said.
 *
 * Returns FVI_SUCCESS; FVI_EFAULT if s is NULL; FVI_EINVAL if the run is over;
 * FVI_EMAXITER or FVI_ESING if the equation of the step could not be solved;
 * FVI_EOVRFLW if a value stopped being finite; FVI_ERUNAWAY after most_steps; what the force
 * or the potential returned. These five are what came out, no mistake of the caller: the error handler
 * is not called for them, here or by fvi_stepper_start. After an error, but for FVI_EFAULT
 * and a run that is over, s->k is still k and x, p are not those of any step: stop. */
int fvi_stepper_step(fvi_stepper *s);

/* fvi_force_value -- for methods: s->F = F(t). A system without force leaves s->F
 * zero, as it was made. Returns FVI_SUCCESS, or what the force returned. */
int fvi_force_value(fvi_stepper *s, double t);

/* fvi_stepper_advance_to -- as many steps as it takes to a time, and x and p there.
 *
 *   t     not before the last step, not after steps h; one of the times k h, but for
 *         methods that choose their steps, which give out any time
 *   x, p  outputs, d numbers each, or NULL
 *
 * Returns FVI_SUCCESS; FVI_EFAULT if s is NULL; FVI_EDOM if there is no state at t to be
 * had; FVI_EOVRFLW if x or p is not finite there; what fvi_stepper_step returns. */
int fvi_stepper_advance_to(fvi_stepper *s, double t, double *x, double *p);

/* fvi_stepper_advance_through -- fvi_stepper_advance_to, to one time after the other: the same
 * numbers, but faster where a method that chooses its steps passes many times in one.
 *
 *   t     count times, none before the one in front of it
 *   x, p  outputs, each may be NULL: count d numbers, row after row
 *
 * Returns what fvi_stepper_advance_to returns for the first time that it cannot reach; the rows before
 * it stand, unless numbers stopped being finite within its step. */
int fvi_stepper_advance_through(fvi_stepper *s, size_t count, const double *t, double *x,
                                double *p);

/* fvi_stepper_copy -- the same trajectory again, at the same k, history included: a fork, or a
 * place to come back to. Both go on with the same digits, and neither knows of the
 * other; the system is the one and only, and must outlive both.
 *
 *   from  a stepper in which no step failed
 *   to    output; stop it with fvi_stepper_free
 *
 * Cost: the bytes of the stepper and of its memory are copied. No callback is called, but
 * for factorise of matrices, whose code is then returned.
 * Returns FVI_SUCCESS; FVI_EFAULT if a pointer is NULL; FVI_EUNSUP if the method has
 * data of its own and no copy; FVI_ENOMEM. On error *to is untouched. */
int fvi_stepper_copy(const fvi_stepper *from, fvi_stepper **to);

/* fvi_stepper_archive -- show an archive all that steps have changed, so that a run can be saved, and
 * gone on with in another process:
 *
 *   save   let the archive copy the pieces, whatever `constant`
 *   load   fvi_stepper_start the same run, then let the archive write them back: where constant != 0
 *          it must compare instead, and return a code of its own if they differ. After an
 *          error the stepper is of no use: stop it, or reset it
 *
 * The digits are then those of the run that was saved. The system is not among the pieces,
 * but for d, masses and dampings, which are constant; potential, matrices and force must be
 * the same.
 * `steps` may be another one where the memory is none or FVI_HISTORY_DIRECT, and at least
 * k; in FVI_HISTORY_MODES what depends on it is constant. All pieces are as this machine
 * has them. O(Q d) bytes with FVI_HISTORY_MODES, O(k d) with DIRECT.
 *
 * Returns FVI_SUCCESS; FVI_EFAULT if a pointer is NULL; FVI_EUNSUP, before any piece, if
 * the method has data of its own and no serialize; FVI_EINVAL if what was loaded is no state of
 * this run (k beyond its end, a time, a place or a count that it cannot have), as soon as
 * that is seen: no step ever reads it. So a state may come from a stranger. Of the numbers
 * of its past nothing is asked: if one is not finite, a step fails. FVI_EINVAL, too, of a
 * stepper whose last step failed; what the archive returns. */
int fvi_stepper_archive(fvi_stepper *s, fvi_archive *archive);

/* fvi_stepper_reset -- back to k = 0 of the same run, also after a step that failed. The digits
 * are the same again. s->x and s->p are other arrays then.
 *
 * Returns FVI_SUCCESS; FVI_EFAULT if s is NULL; what fvi_stepper_start returns: s is then as it
 * was. */
int fvi_stepper_reset(fvi_stepper *s);

/* fvi_stepper_free -- give everything back. NULL is allowed.
 *
 * Returns FVI_SUCCESS; FVI_EINVAL in a callback of the same stepper: it lives on then. */
int fvi_stepper_free(fvi_stepper *s);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
