/* src/run/run_damper.h -- The dampers of a run, as the methods see them. [H 9, 26, 27]
 *
 * A caller gives the damping of a run by an alpha, by a law, or by the dampers of the system. All three are kernels.
 * The methods ask the functions below, and do not read `law` or `alpha` of a run themselves. */
#ifndef FVI_RUN_DAMPER_H
#define FVI_RUN_DAMPER_H

#include <fvi/dampers.h>
#include <fvi/trajectory.h>

/* One damper of a run: the damper of alpha or of the law of the run, or one of several dampers of a mechanism. A damper
 * of a mechanism whose law is one power has the same history as an alpha, to the bit, and the same impulses of the
 * past. */
typedef struct {
    const fvi_kernel *law; /* NULL: the kernel is one power, which has closed forms */
    double alpha, rho;     /* the power is rho s^{2 alpha}. With a law alpha = 0 and rho = 1: no power of h stands
                              before its sums, and no order shifts them */
    double growth;         /* the kernel grows like |s|^growth for large s */
    fvi_initial_history past;
    fvi_damping_matrix matrix; /* select_history is NULL without a matrix: then each coordinate has its own rho */
} fvi_run_damper;

/* fvi_run_damper_count -- how many dampers a run has.
 * fvi_run_damper_of -- damper j, from 0. If the system has a mechanism without dampers, it is the damper of alpha,
 * which acts on no coordinate. */
size_t fvi_run_damper_count(const fvi_run *run);
fvi_run_damper fvi_run_damper_of(const fvi_run *run, size_t j);

/* fvi_is_same_law -- nonzero if two laws have the same weights: they have the same terms, or both are NULL, which is no
 * law. Two terms of the kind SYMBOL are the same if they are one term. */
int fvi_is_same_law(const fvi_kernel *a, const fvi_kernel *b);

/* fvi_run_normal -- the run as the steps of a method see it. Without a law it is unchanged. With a law
 *
 *   past   becomes HELD, because every other past that fvi_run_check allows has the same motion
 *   alpha  becomes 0, because the history of a law includes the step size. A method that chooses its steps gets 1/4,
 *          from which it guesses the lengths of steps */
fvi_run fvi_run_normal(const fvi_method *method, const fvi_run *run);

/* fvi_run_damper_stages -- subtract S times `force` from `load` at each of s stages. `force` has r and `load` d numbers
 * a stage, stage after stage. Returns what the functions of the matrix return. */
int fvi_run_damper_stages(const fvi_run_damper *damper, size_t d, size_t s, const double *force, double *load);

/* fvi_run_damper_symbol -- the symbol C(s) of the damper at a real s > 0. */
double fvi_run_damper_symbol(const fvi_run_damper *damper, double s);

/* fvi_run_damper_history -- allocate the history of d numbers with the step size and the memory of a run (memory.h).
 *
 *   kind      the difference formula that the weights of a law are made from; the weights of a power are Euler's
 *   by_order  nonzero: the history gives the derivative of its sums by the order, too; for a power alone
 *   first     output: the factor that was taken out of all weights, 1 for a power
 *   memory    output; free it with fvi_history_free
 *
 * Returns what fvi_history_alloc and fvi_kernel_history return. */
int fvi_run_damper_history(const fvi_run_damper *damper, const fvi_run *run, fvi_delta kind,
                           int by_order, size_t d, double *first, fvi_history **memory);

/* fvi_run_damper_name_refused -- what a history of damper j of a system with a mechanism returned, as it is. If that is
 * FVI_EUNSUP, the law has no modes for its memory, and the error says so and names the damper. Stages need modes
 * whatever the memory is. */
int fvi_run_damper_name_refused(const fvi_run *run, size_t j, int status, fvi_error *error);

/* fvi_run_damper_bytes_order -- an order whose history takes as many bytes as the history of the damper. For a law it
 * is 1/2, because all orders between 0 and 1 take the same. */
double fvi_run_damper_bytes_order(const fvi_run_damper *damper);

#endif
