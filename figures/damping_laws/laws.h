/* figures/damping_laws/laws.h -- Four laws with the same loss modulus, 0.2, at omega = 1. */
#ifndef LAWS_H
#define LAWS_H

#include <fvi/damping_laws.h>

enum { LAWS = 4 };

static const struct {
    const char *name;
    fvi_kernel_term term;
} laws[LAWS] = {
    { "springpot, 2α = 1/2", { FVI_KERNEL_POWER, 1, 0.25, 0, 0 } },
    { "fractional Zener, 2α = 1/2, τ = 1", { FVI_KERNEL_ZENER, 1, 0.25, 1, 0 } },
    { "Maxwell, τ = 1", { FVI_KERNEL_MAXWELL, 1, 0, 1, 0 } },
    { "all orders from 0 to 1", { FVI_KERNEL_DISTRIBUTED, 1, 0, 0, 0.5 } },
};

/* Return the term of the law i, with the rho that makes its loss modulus 0.2 at omega = 1. */
static inline fvi_kernel_term scaled(int i)
{
    fvi_kernel_term term = laws[i].term;
    double storage, loss = 1;
    fvi_kernel_moduli(&(fvi_kernel){ 1, &term }, 1, &storage, &loss);
    term.rho = 0.2 / loss;
    return term;
}

#endif
