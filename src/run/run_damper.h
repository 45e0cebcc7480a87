/* src/run/run_damper.h -- What damps a run.                        [H 9, 26, 27]
 *
 * A caller names the damping of a run by an alpha, by a law, or by the dampers of the system. All
 * three are kernels. Whoever works with a run asks here, and no more for `law` or `alpha`. */
#ifndef FVI_RUN_DAMPER_H
#define FVI_RUN_DAMPER_H

#include <fvi/dampers.h>
#include <fvi/trajectory.h>

/* What a damper of a run is: the only one, of alpha or of the law of the run, or one of several
 * of a mechanism. A damper of a mechanism whose law is one power has the history of an alpha, to
 * the bit, and its impulses of the past. */
typedef struct {
    const fvi_kernel *law; /* NULL: the kernel is one power, which has closed forms */
    double alpha, rho;     /* the power is rho s^{2 alpha}. Of a law 0 and 1: no power of h stands
                            * before its sums, and no order shifts them */
    double growth;         /* its kernel is like |s|^growth for large s */
    fvi_initial_history past;
    fvi_damping_matrix matrix; /* select_history is NULL: coordinates, each with its own rho */
} fvi_run_damper;

/* fvi_run_damper_count -- how many dampers a run has.
 * fvi_run_damper_of -- damper j of them; of a mechanism without dampers what alpha says, which
 * acts on nothing. */
size_t fvi_run_damper_count(const fvi_run *run);
fvi_run_damper fvi_run_damper_of(const fvi_run *run, size_t j);

/* fvi_run_normal -- the run as the steps of a method see it. Without a law it is as it was. With a law
 *
 *   past   is HELD: what else fvi_run_check takes is the same
 *   alpha  is 0, since a law scales the sums of a method itself. Where steps vary it is 1/4, by
 *          which their lengths are guessed */
fvi_run fvi_run_normal(const fvi_method *method, const fvi_run *run);

/* fvi_run_damper_stages -- takes S times `force` away from `load`, at each of s stages: r and d numbers each, one stage
 * behind the other. Returns what the functions of the matrix return. */
int fvi_run_damper_stages(const fvi_run_damper *damper, size_t d, size_t s, const double *force, double *load);

/* fvi_run_damper_symbol -- its C(s) of s > 0. */
double fvi_run_damper_symbol(const fvi_run_damper *damper, double s);

/* fvi_run_damper_history -- the sums of d numbers over the past, by the steps and the memory of
 * a run (memory.h).
 *
 *   kind      of the weights of a law; those of a power are Euler's
 *   by_order  nonzero: with their derivative by the order; of a power alone
 *   first     output: what was taken out of the weights, 1 of a power
 *
 * Returns what fvi_history_alloc and fvi_kernel_history return. */
int fvi_run_damper_history(const fvi_run_damper *damper, const fvi_run *run, fvi_delta kind,
                           int by_order, size_t d, double *first, fvi_history **memory);

/* fvi_run_damper_bytes_order -- the order whose history takes as many bytes as that of the
 * damper: 1/2 of a law, as every order between 0 and 1 does. */
double fvi_run_damper_bytes_order(const fvi_run_damper *damper);

#endif
