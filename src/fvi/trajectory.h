/* src/fvi/trajectory.h -- Runs: a system, a start, a step size and a method, made step by step.         [H 2]
 *
 * A stepper holds x_k, p_k and the state of the method. It does not store earlier rows: between two steps the caller
 * reads x and p, and prints or stores them.
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

/* fvi_run -- everything that determines the numbers of a trajectory, besides the method.
 *
 *   system   the system; must outlive the run
 *   x0, p0   initial position and momentum, d finite numbers each; copied
 *   h        step, finite, > 0
 *   steps    N >= 1: the rows are k = 0, ..., N at the times t_k = k h
 *   kappa    the potential is taken at kappa x_k + (1 - kappa) x_{k+1}, 0 <= kappa <= 1
 *   alpha    the damping has the order 2 alpha, 0 <= alpha <= 1
 *   past     what the body did before t = 0 (past.h); zeroed: it was held at x0
 *   memory   how the history is summed (memory.h)
 *   tolerance  the tolerance of the modes, relative to the direct sum, in [0, 1); 0: the default 1e-13. It has no
 *            effect without a history; fvi_warning_of_memory (warnings.h) tells where else it has none
 *   step_error  for methods that choose their steps: the largest estimated error of x in one step, in the unit of x,
 *            >= 0; 0: 1e-10 of the largest |x_i| so far. A step_error below 1e-17 of the size at the start is refused
 *            (FVI_ETOL). If the motion grows, the method allows 1e-17 of the new size at least. For these methods h and
 *            steps say where the rows are, not how long a step is
 *   longest  for methods that choose their steps, and for searches for a step: no step is longer, >= 0; 0: no limit.
 *            Set it to the length of a swing or a pulse of a force without a bound (system.h), so that no step passes
 *            over it
 *   most_steps  for methods that choose their steps: the largest number of steps, rejected trials included; then the
 *            run ends with FVI_ERUNAWAY. 0: no such number; but the run ends with FVI_ERUNAWAY if the rest would take
 *            more than 2^40 steps at the pace of the last 2^18 steps
 *   law      NULL; or the law that replaces D^{2 alpha} (damping_laws.h), for methods with takes_laws; must outlive the
 *            run. Then alpha is not read, and the body was held before t = 0
 *   events, event_count  for fvi_variable_step: the events to watch for (events.h), which must outlive the run, and
 *            their number; NULL and 0: none
 *   failure  NULL; or a place, which must outlive the run, where a step that fails with FVI_EBADFUNC says which number
 *            is not finite, and when. Its field is "force", "force_on", "damper", "constraint" or "lagrangian"
 *
 * A member that an initialiser leaves out is zero. So start with fvi_run_default, which sets the members that must not
 * be zero by accident. The methods are in the table fvi_methods (methods.h). Runs with different steppers may go on in
 * several threads. */
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
    fvi_error *failure;
} fvi_run;

/* fvi_run_default -- Return a run with kappa = 1/2, alpha = 1/2, a body that was held at x0, and FVI_HISTORY_AUTO. The
 * caller changes other members afterwards. */
fvi_run fvi_run_default(const fvi_system *system, const double *x0,
                        const double *p0, double h, size_t steps);

typedef struct fvi_method fvi_method;

/* fvi_scheme -- the equations that a method solves. The adjoint (adjoint.h) needs it to transpose them.
 *
 *   CLASSICAL      equations without an adjoint: the classical methods (discrete_mechanics.h)
 *   FVI            Algorithm 3
 *   CQ2_SHIFTED    (13.7) with the shift alpha
 *   CQ_BDF2        (13.7) with the weights of BDF2
 *   CQ2_MIDPOINT   (13.16)
 *   LOBATTO        (17.8) or (17.24)
 *   VARIABLE_STEP  (22.14) */
typedef enum {
    FVI_SCHEME_CLASSICAL,
    FVI_SCHEME_FVI,
    FVI_SCHEME_CQ2_SHIFTED,
    FVI_SCHEME_CQ_BDF2,
    FVI_SCHEME_CQ2_MIDPOINT,
    FVI_SCHEME_LOBATTO,
    FVI_SCHEME_VARIABLE_STEP
} fvi_scheme;

/* fvi_stepper -- one trajectory at its present step. The caller may read k, t, x, p and run; the other members belong
 * to the library. While a function works on a stepper, a callback (a potential, a force, an archive) may read these
 * members but do nothing else: in it fvi_stepper_step, fvi_stepper_copy, fvi_stepper_archive, fvi_stepper_reset and
 * fvi_stepper_free of the same stepper return FVI_EINVAL and change nothing. */
typedef struct {
    size_t k;      /* number of steps made; with a method that chooses its steps, number of rows passed */
    double t;      /* time of x and p: k h, rounded once, unless the method chooses its steps */
    double *x, *p; /* position and momentum, d numbers each */

    double *dx, *g, *F; /* the last increment, gradient and force */
    struct fvi_newton *newton;
    void *method_state; /* the state of this method; or NULL */
    struct fvi_mechanism_state *mechanism; /* the state of a mechanism; NULL without one */
    fvi_run run;
    const fvi_method *method;
    int is_busy; /* nonzero while a function works on it that may call callbacks */
    fvi_error *error; /* the place where a method describes why its start or a step failed; or NULL */
    int has_failed; /* nonzero after a step that failed: x, p and the history may belong to no step */
} fvi_stepper;

/* fvi_method -- an integrator, with all its properties. Only the fields have an effect, so a copy under another name
 * and at another address is the same method. name, order and memory are texts for people, and may be NULL.
 *
 *   lowest, highest  the order as numbers: the lowest and the highest order of x at a fixed time, over all alpha, for
 *          Caputo's past and a held body. (A kick, Riemann-Liouville's past, a U that is not quadratic, (20.11),
 *          (20.12), or kappa != 1/2 may have a lower order.) For fvi_variable_step the order in the number of its
 *          steps, over all t
 *   stages  the number of stages s of the methods of Lobatto; 0 for all other methods
 *   damped_inertia  nonzero if the inertia is treated as a damping of order 1 of the same kind, m DD^2 x (form D, H 17)
 *   alpha_least, alpha_most  the range of alpha, within [0, 1]; 1/2 and 1/2 means linear damping only.
 *          fvi_stepper_start refuses every other alpha (FVI_EDOM)
 *   memories  a bit 1u << kind for each kind of memory (memory.h) that the method takes; fvi_stepper_start refuses the
 *          other kinds (FVI_EUNSUP). 0: the method has no history, and run->memory is not read
 *   quadrature  the weights of the history; not read for methods without a history and for methods with stages
 *   scheme  as above. A method has adjoint runs and tangents if a method of the library has the same scheme, start and
 *          step; CLASSICAL has none
 *   takes_kappa  nonzero if run->kappa has an effect for a system with a potential. Zero: where a function needs a
 *          kappa, for example for an adjoint, it takes 1/2
 *   takes_laws  nonzero if run->law may be set; fvi_stepper_start refuses it otherwise (FVI_EUNSUP)
 *   takes_matrices  nonzero if the system may have matrices; fvi_stepper_start refuses them otherwise (FVI_EUNSUP)
 *   takes_mechanism  nonzero if the system may have a mechanism; fvi_stepper_start refuses it otherwise (FVI_EUNSUP)
 *   implicit  nonzero if a step solves an equation with grad U, by Newton's method with the Hessian of U
 *   paper_convention  how the past RIEMANN_LIOUVILLE acts. Zero: by its exact impulses (19.5); a run without a solution
 *          (19.2) is refused (FVI_EDOM). Nonzero: by the weights alone, as in the paper. Then a kick (9.5) leaves only
 *          the order 1 - 2 alpha, and a run without a solution is made, too. Every method takes all three pasts
 *   stability_number  computes the load of a run, as fvi_stability_number (stability.h), from the Hessian of U at x0.
 *          NULL: the load is not known
 *   stability_number_grows  nonzero if the load never falls while h grows. Then all steps up to
 *          fvi_stability_longest_step are stable
 *   start  refuses runs that the method does not take, and prepares newton and method_state; may be NULL
 *   step   replaces x_k, p_k by x_{k+1}, p_{k+1}; k and t still belong to step k
 *   dense  NULL; or, for a method that chooses its steps, computes x and p (either may be NULL) at a time t <= s->t
 *          within the last step, and returns FVI_EDOM for an earlier time. The step of such a method sets s->t; the
 *          last step ends at s->t = steps h
 *   rows   NULL; or, for a method with dense, computes the same numbers, to the bit, at `count` increasing times within
 *          the last step, row after row into x and p. FVI_EDOM if a time is outside the step
 *   copy   makes to->method_state from from->method_state; NULL only if method_state is never set. When copy is called,
 *          all other members of *to are set. The library calls stop for *to later, whatever copy returns
 *   serialize  hands the members of method_state to an archive: those that steps change, and those that must be the
 *          same (archive.h). NULL if method_state is never set, or if the method has no such function
 *   stop   frees method_state; may be NULL
 *   keep_dampers, damper  for a structure with several dampers, as fvi_stepper_keep_dampers and fvi_stepper_damper
 *          (dampers.h); NULL: the method takes no such structure */
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

/* fvi_method_takes_history -- Return nonzero if the method takes this kind of memory, or has no history. Return nonzero
 * for a number that is no kind, too; fvi_history_alloc refuses it. */
int fvi_method_takes_history(const fvi_method *method, fvi_history_kind kind);

/* fvi_stepper_start -- Check a run, and make a stepper at k = 0.
 *
 *   method   the integrator; must outlive the stepper
 *   run      copied, with x0 and p0; its system, law and events must outlive the stepper
 *   stepper  output; free it with fvi_stepper_free
 *   error    output, or NULL: its field is a member of fvi_run or of the system
 *
 * Memory: O(d); for an implicit step O(d w) for the 2 w - 1 diagonals of a Hessian (O(d^2) if it is full); and the
 * memory of the history.
 * Returns FVI_SUCCESS; what fvi_system_check and fvi_history_alloc return; and
 *
 *   FVI_EFAULT   a pointer is NULL; an impulse without an array or a J
 *   FVI_EINVAL   steps == 0; an unknown past; times of impulses that decrease; a system that the method does not take
 *   FVI_EDOM     h, kappa, alpha, tolerance, step_error, longest, x0 or p0 is out of range; an impulse with a number
 *                that is not finite, or with a negative time; a run without a solution (19.2), unless the method has
 *                paper_convention; a run whose end T = steps h is so near to 0 that the memory of fvi_variable_step has
 *                no finite decay rates: below about 1e-287, or far above it if velocities jump and alpha is near 1, for
 *                example at T = 1e-90 for alpha = 0.97 and step_error = 1e-8; or no finite weights times decay rates,
 *                below about 1e-165 for a range of orders that ends at 0.5
 *   FVI_EUNSUP   the method does not take this memory, a law, this law, matrices or a mechanism; the past of a law is
 *                neither HELD nor, for orders up to 1, CAPUTO; impulses at alpha = 1, for a method with stages and a
 *                damped coordinate
 *   FVI_ETOL     a tolerance or a step_error that is too small
 *   FVI_ESING    a constant matrix is singular
 *   FVI_EOVRFLW  an impulse at t = 0 makes p infinite
 *   FVI_ENOMEM   no memory
 *
 * or what fvi_kernel_history, the events, a callback or the interrupter (error.h) returned. On error *stepper is
 * untouched. */
int fvi_stepper_start(const fvi_method *method, const fvi_run *run,
                      fvi_stepper **stepper, fvi_error *error);

/* fvi_stepper_step -- Make one step, from k to k + 1. The new p contains the impulses at that node (2.15). A method
 * that chooses its steps makes one of its steps, from s->t to a later s->t; its last step ends at steps h.
 *
 *     while (s->k < s->run.steps && !(status = fvi_stepper_step(s)))
 *         printf("%g %g\n", s->t, s->x[0]);
 *
 * Cost: that of the history, and of the equation of an implicit step. For a quadratic U the equation costs at most two
 * gradients and O(d w). For any other U it costs two to five gradients, Hessians and factorisations in most cases, each
 * factorisation O(d w^2), or O(d^3) for a full Hessian. If Newton's method fails, it costs up to 1050 of them, and
 * twice as many gradients. If the equation has several solutions, any of them may be found.
 *
 * Returns FVI_SUCCESS; FVI_EFAULT if s is NULL; FVI_EINVAL if the run is over, or in a callback of this stepper. These
 * two errors are mistakes of the caller, and s is unchanged. Or it returns a result of the motion:
 *
 *   FVI_EMAXITER, FVI_ESING  the equation of the step could not be solved
 *   FVI_EOVRFLW   a value is no longer finite
 *   FVI_EBADFUNC  the force, an elongation, a constraint or the Lagrangian is not finite at a time of the step
 *   FVI_ERUNAWAY  after most_steps
 *   any number    what the force, the potential or the interrupter (error.h) returned
 *
 * The error handler is not called for a result of the motion, here or in fvi_stepper_start. Afterwards s->k is still k,
 * and x and p belong to no step: only reset or free the stepper. But the interrupter is asked before the step begins,
 * so after its number s is unchanged. */
int fvi_stepper_step(fvi_stepper *s);

/* fvi_force_value -- For use in methods: write F(t) to s->F. Without a force s->F stays zero. Returns FVI_SUCCESS;
 * FVI_EBADFUNC if F(t) is not finite, with the reason in s->run.failure; or what the force returned. */
int fvi_force_value(fvi_stepper *s, double t);

/* fvi_stepper_advance_to -- Make all steps up to a time, and copy x and p at this time.
 *
 *   t     one of the times k h, from s->t to steps h. With a method that chooses its steps any time up to steps h, from
 *         the beginning of its last step
 *   x, p  outputs, d numbers each, or NULL
 *
 *     status = fvi_stepper_advance_to(s, 10 * s->run.h, x, p);       // row 10
 *
 * Returns FVI_SUCCESS; FVI_EFAULT if s is NULL; FVI_EDOM if there is no state at t: the outputs are then untouched, and
 * after a t between two steps s stands at the later step; FVI_EOVRFLW if x or p is not finite at t; what
 * fvi_stepper_step returns. */
int fvi_stepper_advance_to(fvi_stepper *s, double t, double *x, double *p);

/* fvi_stepper_advance_through -- Advance to several times, one after another. The numbers are those of
 * fvi_stepper_advance_to, but the call is faster if a method that chooses its steps passes many times in one step.
 *
 *   t     count times that do not decrease
 *   x, p  outputs, each may be NULL: count * d numbers, row after row
 *
 * Returns FVI_SUCCESS; FVI_EFAULT if s or t is NULL; or the code of fvi_stepper_advance_to for the first time that it
 * cannot reach. The rows before this time are valid, unless the code is FVI_EOVRFLW and they are in the same step. */
int fvi_stepper_advance_through(fvi_stepper *s, size_t count, const double *t, double *x,
                                double *p);

/* fvi_stepper_copy -- Copy a stepper at its k, with its history. Use the copy as a second branch of the trajectory, or
 * to return to this k. Both steppers go on with the same digits, independently of each other. They share the system,
 * which must outlive both.
 *
 *   from  a stepper in which no step failed
 *   to    output; free it with fvi_stepper_free
 *
 * Cost: a copy of the bytes of the stepper and of its history. The only callback is factorise of matrices.
 * Returns FVI_SUCCESS; FVI_EFAULT if a pointer is NULL; FVI_EINVAL in a callback of this stepper; FVI_EUNSUP if the
 * method has a method_state and no copy; FVI_ENOMEM; what factorise returned. On error *to is untouched. */
int fvi_stepper_copy(const fvi_stepper *from, fvi_stepper **to);

/* fvi_stepper_archive -- Hand everything that steps have changed to an archive, piece by piece, to save a run and to
 * continue it in another process.
 *
 *   save   the archive copies all pieces, also those with `constant`
 *   load   start the same run with fvi_stepper_start; then the archive writes the saved pieces back. Where constant !=
 *          0 it must compare instead of writing, and return a code of its own if the piece differs. After an error
 *          reset the stepper or free it
 *
 * The continued run then has the digits of the saved run. Of the system only d, the masses and the dampings are pieces,
 * and they are constant. The potential, the matrices and the force must be the same.
 *
 * `steps` of the second run may differ, but not be below k, if the run has no history, or if it has FVI_HISTORY_DIRECT
 * and a method without stages. In all other cases, and for fvi_variable_step, some constant pieces depend on `steps`.
 * An archive that compares them refuses another number. All pieces have the binary format of this machine. They have
 * O(Q d) bytes with FVI_HISTORY_MODES and O(k d) with FVI_HISTORY_DIRECT.
 *
 * Returns FVI_SUCCESS; FVI_EFAULT if a pointer is NULL; FVI_EUNSUP, before any piece, if the method has a method_state
 * and no serialize; FVI_EINVAL in a callback of this stepper, for a stepper in which a step failed, and for a loaded
 * state that this run cannot have (k beyond the end, or an impossible time, place or count). The function checks this
 * before any step reads the state, so a state from an unknown source is safe. It does not check the numbers of the
 * past: if one is not finite, a later step fails. Or it returns the code that the archive returned. */
int fvi_stepper_archive(fvi_stepper *s, fvi_archive *archive);

/* fvi_stepper_reset -- Return to k = 0 of the same run, also after a step that failed. The run then has the same digits
 * again. s->x and s->p become other arrays.
 *
 * Returns FVI_SUCCESS; FVI_EFAULT if s is NULL; FVI_EINVAL in a callback of this stepper; what fvi_stepper_start
 * returns. On error s is unchanged. */
int fvi_stepper_reset(fvi_stepper *s);

/* fvi_stepper_free -- Free a stepper. NULL is allowed.
 *
 * Returns FVI_SUCCESS; FVI_EINVAL in a callback of the same stepper, which then is not freed. */
int fvi_stepper_free(fvi_stepper *s);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
