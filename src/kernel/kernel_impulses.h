/* src/kernel/kernel_impulses.h -- The impulses of a start with a velocity, by any kernel. [H 26]
 *
 * A body that was held until t = 0, and then got the velocity v0, moves like x_0 + v0 t at first.
 * A kernel answers to that line with v0 q(t), where q has the Laplace transform C(s)/s^2. If the
 * kernel grows faster than s, q is infinite at t = 0, and weights alone lose order. So a method
 * lets its history act on x - x_0 - v0 t, and adds the impulses of v0 q:
 *
 *     I_0 = h int_0^1 (1 - u) q((k + u) h) du,   I_1 = h int_0^1 u q((k + u) h) du     (26.20) */
#ifndef FVI_KERNEL_IMPULSES_H
#define FVI_KERNEL_IMPULSES_H

#include <fvi/damping_laws.h>

#include <complex.h>

typedef struct fvi_impulses_of_kernel fvi_impulses_of_kernel;

/* C(s) of what `of` points to; analytic but for s <= 0. */
typedef double complex fvi_symbol_function(const void *of, double complex s);

/* fvi_impulses_of_kernel_alloc -- of a kernel that fvi_kernel_check takes, and steps of length h.
 * It points to the kernel.
 * fvi_impulses_of_slope_alloc -- of the derivative of a kernel of one term, with rho = 1, by its
 * order or its time; or by another number, if the symbol has no pole off the cut. `symbol` is that
 * derivative at s; it and the impulses point to the term.
 * Both return FVI_SUCCESS or FVI_ENOMEM. */
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

/* fvi_impulses_of_kernel_at_stages -- the same on n stages c, 2 to 8: the impulses
 * h int_0^1 l_i(u) q((k + u) h) du, l_i Lagrange's polynomials, as fvi_kernel_impulses has them of a
 * power (19.5). */
int fvi_impulses_of_kernel_at_stages(const fvi_kernel *law, double h, size_t n,
                                     const double *c,
                                     fvi_impulses_of_kernel **impulses);

/* fvi_impulses_of_kernel_at -- I_0 and I_1 of step k, or those of the stages, times 1/v0. The numbers
 * depend on k alone; the cost is 150 products of complex numbers where k is the last one, plus 1.
 * Accuracy: 1e-13 of their sum (no proof; seen 2e-14). */
void fvi_impulses_of_kernel_at(fvi_impulses_of_kernel *impulses, size_t k,
                               double *impulse);

/* fvi_impulses_of_kernel_copy -- the same again. Returns FVI_SUCCESS or FVI_ENOMEM. */
int fvi_impulses_of_kernel_copy(const fvi_impulses_of_kernel *from,
                                fvi_impulses_of_kernel **to);

/* fvi_impulses_of_kernel_free -- give everything back. NULL is allowed. */
void fvi_impulses_of_kernel_free(fvi_impulses_of_kernel *impulses);

#endif
