/* tests/harness/full_chain.h -- A chain's Hessian as a full matrix: the same runs by another road. */
#ifndef FULL_CHAIN_H
#define FULL_CHAIN_H

#include <fvi/system.h>

/* Of fvi_potential_chain(params); for a potential whose diagonals are 0. */
static inline int full_chain_hessian(size_t d, const double *x, void *params,
                                     double *H)
{
    const fvi_system chain = { .d = d,
                               .potential = fvi_potential_chain(params) };
    fvi_potential_hessian(&chain, x, H);
    return 0;
}

#endif
