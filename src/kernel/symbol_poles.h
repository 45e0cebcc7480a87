/* src/kernel/symbol_poles.h -- Is a symbol analytic but for its cut?        [H 26] */
#ifndef FVI_SYMBOL_POLES_H
#define FVI_SYMBOL_POLES_H

#include <fvi/damping_laws.h>

/* fvi_symbol_has_poles -- nonzero if a pole is seen with |arg s| < 165 degrees and 10^-6 < |s| < 10^6.
 *
 * It is seen if it is not a thousandth of the function around it, and if the function there is finite.
 * Cost: 3000 values of the symbol. */
int fvi_symbol_has_poles(const fvi_kernel_function *f);

#endif
