/* src/kernel/symbol_poles.h -- The kind SYMBOL, and a search for poles of a symbol off the cut.        [H 26] */
#ifndef FVI_SYMBOL_POLES_H
#define FVI_SYMBOL_POLES_H

#include <fvi/damping_laws.h>

#include <complex.h>

/* The functions of the kind SYMBOL (kernel_classes.h).
 *
 * fvi_symbol_value -- Return the value of the function of a SYMBOL.
 * fvi_symbol_check -- Test at some frequencies that this function is finite, and real for real s.
 * fvi_symbol_growth -- Estimate the growth of a term of any kind from its values at 2^399 and 2^400. A symbol that
 * decreases there has growth 0. */
double complex fvi_symbol_value(const fvi_kernel_term *t, double modulus, double angle, double complex *slope);
int fvi_symbol_check(const fvi_kernel_term *t);
double fvi_symbol_growth(const fvi_kernel_term *t);

/* fvi_symbol_has_poles -- Return nonzero if the symbol has a pole with |arg s| < 165 degrees and 10^-6 < |s| < 10^6.
 *
 * A pole is found if it contributes more than a thousandth of the function around it, and if the function is finite
 * there. Cost: about 3000 values of the symbol. */
int fvi_symbol_has_poles(const fvi_kernel_function *f);

#endif
