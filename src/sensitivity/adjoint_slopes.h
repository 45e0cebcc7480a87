/* src/sensitivity/adjoint_slopes.h -- Kernels by their orders and times, as symbols.   [H 23]
 *
 * Internal. Of a term with rho = 1, C(s) has derivatives by its numbers, (23.21). With L = ln s and
 * u = time s^{2 (alpha - end)} two springpots in series have
 *
 *     dC/d alpha = 2 L C / (1 + u),   dC/d time = -C s^{2 (alpha - end)} / (1 + u),
 *     dC/d end = 2 L C u / (1 + u),                                             (23.28)
 *
 * and Cole and Davidson's s/(1 + time s) to the power 2 alpha has 2 ln(s/(1 + time s)) C and
 * -2 alpha s/(1 + time s) C. Those of the other kinds are products of memories, or powers. */
#ifndef FVI_ADJOINT_SLOPES_H
#define FVI_ADJOINT_SLOPES_H

#include <fvi/damping_laws.h>
#include "kernel/kernel_impulses.h"

/* By which number: as fvi_slope_by counts them. */
enum { FVI_ADJOINT_SLOPES = 3 };

/* fvi_adjoint_has_slope -- has a kernel of this kind such a number?
 * fvi_adjoint_slope_symbol -- the derivative of a kernel of one term with rho = 1 by it; NULL if it
 * has no such number. */
int fvi_adjoint_has_slope(const fvi_kernel_term *term, fvi_slope_by by);
fvi_symbol_function *fvi_adjoint_slope_symbol(const fvi_kernel_term *term, fvi_slope_by by);

/* A derivative as a kernel of its own. */
typedef struct {
    fvi_kernel_function function; /* or of a range of orders a power, its first member */
    fvi_symbol_function *symbol;
    const fvi_kernel_term *of;
    fvi_kernel kernel; /* points to the function */
    double sign, more; /* more times the kernel itself is in it, see below */
} fvi_adjoint_slope;

/* fvi_adjoint_slope_of -- the derivative by a number that no product of memories gives: of a range
 * of orders, of two springpots in series, and of Cole and Davidson's kernel. Returns 1, or 0 if the
 * term has no such number, or it is a product. slope and term must stay where they are. */
int fvi_adjoint_slope_of(const fvi_kernel_term *term, fvi_slope_by by,
                         fvi_adjoint_slope *slope);

/* fvi_adjoint_slope_begin_at -- for weights whose first is the symbol at `s`. A memory takes that
 * weight out, and where ln s is 0 a derivative by an order begins with 0: then `more` is 1, and
 * `more` times the sums of the kernel are to be taken away. */
void fvi_adjoint_slope_begin_at(fvi_adjoint_slope *slope, double s);

#endif
