/* src/kernel/kernel_impulses.h -- The impulses of any kernel after a start with a velocity. [H 26]
 *
 * A body was held until t = 0 and then got the velocity v0. At first it moves like x_0 + v0 t. The response of a kernel
 * to this line is v0 q(t), where q has the Laplace transform C(s)/s^2. If the kernel grows faster than s, q is infinite
 * at t = 0, and a method that uses weights only loses order. So the method applies its history to x - x_0 - v0 t, and
 * adds the impulses of v0 q:
 *
 *     I_0 = h int_0^1 (1 - u) q((k + u) h) du,   I_1 = h int_0^1 u q((k + u) h) du     (26.20) */
#ifndef FVI_KERNEL_IMPULSES_H
#define FVI_KERNEL_IMPULSES_H

#include <fvi/damping_laws.h>

#include <complex.h>

typedef struct fvi_impulses_of_kernel fvi_impulses_of_kernel;

/* A symbol C(s) with the parameters `of`. It is analytic except for s <= 0 and for poles. */
typedef double complex fvi_symbol_function(const void *of, double complex s);

/* fvi_impulses_of_kernel_alloc -- Allocate the impulses of a kernel for steps of length h. The kernel has passed
 * fvi_kernel_check, and it must outlive the impulses.
 * fvi_impulses_of_slope_alloc -- Allocate the impulses of the derivative of a kernel by its order, its time or its end.
 * The kernel is one term with rho = 1, and `symbol` is the derivative at s. The impulses point to the term, which must
 * outlive them. Free them with fvi_impulses_of_kernel_free. Both functions return FVI_SUCCESS or FVI_ENOMEM; or
 * FVI_EUNSUP, the first one for a law with more than 64 poles off the cut, the second one for a term with such a pole
 * that is neither a ZENER nor a MAXWELL2. */
int fvi_impulses_of_kernel_alloc(const fvi_kernel *law, double h,
                                 fvi_impulses_of_kernel **impulses);
typedef enum {
    FVI_SLOPE_BY_ORDER,
    FVI_SLOPE_BY_TIME,
    FVI_SLOPE_BY_END
} fvi_slope_by;
int fvi_impulses_of_slope_alloc(fvi_symbol_function *symbol, const fvi_kernel_term *term,
                                fvi_slope_by by, double h,
                                fvi_impulses_of_kernel **impulses);

/* fvi_impulses_of_kernel_at_stages -- Allocate the impulses of a kernel at the n stages c of a step, 2 <= n <= 8. They
 * are h int_0^1 l_i(u) q((k + u) h) du with the Lagrange polynomials l_i, as fvi_kernel_impulses computes them for a
 * power (19.5). Return the codes of fvi_impulses_of_kernel_alloc. */
int fvi_impulses_of_kernel_at_stages(const fvi_kernel *law, double h, size_t n,
                                     const double *c,
                                     fvi_impulses_of_kernel **impulses);

/* fvi_impulses_of_kernel_at -- Compute the impulses of step k for v0 = 1: I_0 and I_1, or one impulse for each stage.
 * The result depends on k only, but the cost depends on the call before: it is 150 complex products if k is the last k
 * plus 1. Accuracy: 1e-13 of the sum of the impulses (no proof; seen 2e-14). */
void fvi_impulses_of_kernel_at(fvi_impulses_of_kernel *impulses, size_t k,
                               double *impulse);

/* fvi_impulses_of_kernel_copy -- Copy the impulses. Return FVI_SUCCESS or FVI_ENOMEM. */
int fvi_impulses_of_kernel_copy(const fvi_impulses_of_kernel *from,
                                fvi_impulses_of_kernel **to);

/* fvi_impulses_of_kernel_free -- Free the impulses. NULL is allowed. */
void fvi_impulses_of_kernel_free(fvi_impulses_of_kernel *impulses);

#endif
