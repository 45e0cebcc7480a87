/* src/parameter_derivatives/kernel_derivatives.h -- Kernels by their orders and times, as symbols.   [H 23]
 *
 * Internal. Of a term with rho = 1, C(s) has derivatives by its numbers, (23.21). With L = ln s and
 * u = time s^{2 (alpha - end)} two springpots in series have
 *
 *     dC/d alpha = 2 L C / (1 + u),   dC/d time = -C s^{2 (alpha - end)} / (1 + u),
 *     dC/d end = 2 L C u / (1 + u),                                             (23.28)
 *
 * and Cole and Davidson's s/(1 + time s) to the power 2 alpha has 2 ln(s/(1 + time s)) C and
 * -2 alpha s/(1 + time s) C. Those of the other kinds are products of memories, or powers. */
#ifndef FVI_KERNEL_DERIVATIVES_H
#define FVI_KERNEL_DERIVATIVES_H

#include <fvi/damping_laws.h>
#include "kernel/kernel_impulses.h"

/* By which number: as fvi_slope_by counts them. */
enum { FVI_KERNEL_DERIVATIVES = 3 };

/* fvi_kernel_has_derivative -- has a kernel of this kind such a number?
 * fvi_kernel_derivative_symbol -- the derivative of a kernel of one term with rho = 1 by it; NULL if it
 * has no such number. */
int fvi_kernel_has_derivative(const fvi_kernel_term *term, fvi_slope_by by);
fvi_symbol_function *fvi_kernel_derivative_symbol(const fvi_kernel_term *term, fvi_slope_by by);

/* A derivative as a kernel of its own. */
typedef struct {
    fvi_kernel_function function; /* or of a range of orders a power, its first member */
    fvi_symbol_function *symbol;
    const fvi_kernel_term *of;
    fvi_kernel kernel; /* points to the function */
    double sign, more; /* more times the kernel itself is in it, see below */
} fvi_kernel_derivative;

/* fvi_kernel_derivative_of -- the derivative by a number that no product of memories gives: of a range
 * of orders, of two springpots in series, and of Cole and Davidson's kernel. Returns 1, or 0 if the
 * term has no such number, or it is a product. slope and term must stay where they are. */
int fvi_kernel_derivative_of(const fvi_kernel_term *term, fvi_slope_by by,
                             fvi_kernel_derivative *slope);

/* fvi_kernel_derivative_begin_at -- for weights whose first is the symbol at `s`. A memory takes that
 * weight out, and where ln s is 0 a derivative by an order begins with 0: then `more` is 1, and
 * `more` times the sums of the kernel are to be taken away. */
void fvi_kernel_derivative_begin_at(fvi_kernel_derivative *slope, double s);

#endif
