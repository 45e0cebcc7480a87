/* tests/harness/full_chain.h -- The Hessian of a chain as a full matrix, so that the library cannot use its band. */
#ifndef FULL_CHAIN_H
#define FULL_CHAIN_H

#include <fvi/system.h>

/* Write the Hessian of fvi_potential_chain(params), for a potential that gives no diagonals. */
static inline int full_chain_hessian(size_t d, const double *x, void *params,
                                     double *H)
{
    const fvi_system chain = { .d = d,
                               .potential = fvi_potential_chain(params) };
    fvi_potential_hessian(&chain, x, H);
    return 0;
}

#endif
