/* tests/convolution_quadrature/convolution_quadrature_runs.h -- The methods that the runs of Chapter 13
 * go through. */
#ifndef CONVOLUTION_QUADRATURE_RUNS_H
#define CONVOLUTION_QUADRATURE_RUNS_H

#include <fvi/convolution_quadrature_methods.h>

static const fvi_method *const methods[] = { &fvi_shifted, &fvi_bdf2,
                                             &fvi_stable };

#endif
