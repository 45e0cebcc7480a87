/* src/kernel/symbol_poles.h -- Search for poles of a symbol off the cut.        [H 26] */
#ifndef FVI_SYMBOL_POLES_H
#define FVI_SYMBOL_POLES_H

#include <fvi/damping_laws.h>

/* fvi_symbol_has_poles -- Return nonzero if the symbol has a pole with |arg s| < 165 degrees and 10^-6 < |s| < 10^6.
 *
 * A pole is found if it contributes more than a thousandth of the function around it, and if the function is finite
 * there. Cost: about 3000 values of the symbol. */
int fvi_symbol_has_poles(const fvi_kernel_function *f);

#endif
