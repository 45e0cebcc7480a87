/* tests/adjoint/chain_with_a_law.h -- Three masses in a chain with all their numbers, and a law of four terms. */
#ifndef CHAIN_WITH_A_LAW_H
#define CHAIN_WITH_A_LAW_H

#include <fvi/fvi.h>

enum { D = 3, TERMS = 4 };

typedef struct {
    double x0[D], p0[D], mass[D], rho[D], cg[2], aw[2];
    fvi_kernel_term term[TERMS];
    fvi_kernel law;
    fvi_system system;
    fvi_run run;
} chain;

/* The law, the system and the run of the numbers of c, which stays where it is. */
static inline void connect_chain(chain *c, double h, size_t steps)
{
    c->law = (fvi_kernel){ TERMS, c->term };
    c->system = (fvi_system){ .d = D,
                              .mass = c->mass,
                              .damping = c->rho,
                              .potential = fvi_potential_chain(c->cg),
                              .force = fvi_force_cosine(c->aw) };
    c->run = fvi_run_default(&c->system, c->x0, c->p0, h, steps);
}

#endif
