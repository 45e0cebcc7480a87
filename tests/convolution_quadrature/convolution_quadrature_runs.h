/* tests/convolution_quadrature/convolution_quadrature_runs.h -- The methods that the runs of H 13
 * go through. */
#ifndef CONVOLUTION_QUADRATURE_RUNS_H
#define CONVOLUTION_QUADRATURE_RUNS_H

#include <fvi/convolution_quadrature_methods.h>

static const fvi_method *const methods[] = { &fvi_cq2_shifted, &fvi_cq_bdf2,
                                             &fvi_cq2_midpoint };

#endif
