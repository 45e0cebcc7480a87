/* src/parameter_derivatives/kernel_derivatives.h -- The derivatives of kernels by their orders and times, as symbols.
 * [H 23]
 *
 * Internal. The symbol C(s) of a term with rho = 1 has derivatives by its numbers, (23.21). With L = ln s and u = time
 * s^{2 (alpha - end)}, two springpots in series have
 *
 *     dC/d alpha = 2 L C / (1 + u),   dC/d time = -C s^{2 (alpha - end)} / (1 + u),
 *     dC/d end = 2 L C u / (1 + u).                                             (23.28)
 *
 * Cole and Davidson's kernel, s/(1 + time s) to the power 2 alpha, has 2 ln(s/(1 + time s)) C and -2 alpha
 * s/(1 + time s) C. The derivatives of a POWER, a ZENER and a MAXWELL are products of symbols of the term, so one
 * history after another computes them. Those of a range of orders are powers. Every other kind gives its derivatives as
 * symbols (kernel_classes.h). */
#ifndef FVI_KERNEL_DERIVATIVES_H
#define FVI_KERNEL_DERIVATIVES_H

#include <fvi/damping_laws.h>
#include "kernel/kernel_classes.h"

/* The number of numbers that a derivative can be taken by, in the order of fvi_slope_by. */
enum { FVI_KERNEL_DERIVATIVES = 3 };

/* A derivative as a kernel of its own. */
typedef struct {
    fvi_kernel_function function; /* or for a range of orders a power, its first member */
    fvi_symbol_function *symbol;
    const fvi_kernel_term *of;
    fvi_kernel kernel; /* a kernel of one term, which points to function */
    double sign, more; /* sign: the derivative is sign times the kernel; more: see fvi_kernel_derivative_begin_at */
} fvi_kernel_derivative;

/* fvi_kernel_derivative_of -- make a kernel of the derivative by a number, for all kinds except POWER, ZENER and
 * MAXWELL. Returns 1; 0 if the term is of one of these kinds or has no such number. slope and term must stay where they
 * are. */
int fvi_kernel_derivative_of(const fvi_kernel_term *term, fvi_slope_by by,
                             fvi_kernel_derivative *slope);

/* fvi_kernel_derivative_begin_at -- prepare for weights whose first one is the symbol at `s`. A history divides its
 * weights by the first one. But if ln s is 0, the first weight of a derivative by an order is 0. Then `more` becomes 1,
 * the kernel contains itself `more` times in addition, and the caller subtracts `more` times the sums of the term's own
 * kernel. */
void fvi_kernel_derivative_begin_at(fvi_kernel_derivative *slope, double s);

#endif
