/* src/adjoint_variable/singular_start_adjoint.h -- The derivatives through the singular part of a start. [H 23]
 *
 * Internal: for adjoint_variable.c. The singular part G of a run is
 *
 *     G(t) = A sum_{n=1}^{J} k_n r^n t^{a_n},                     (22.19), (22.23)
 *
 * with r = rho/m or m/rho. The number of terms and the window are fixed. Then G, G' and the force that G leaves depend
 * on A, r and alpha, and the force also on m, and all have elementary derivatives. */
#ifndef FVI_SINGULAR_START_ADJOINT_H
#define FVI_SINGULAR_START_ADJOINT_H

#include "variable_step/variable_step.h"

/* "each" means that an array has d numbers. */
typedef struct {
    int is;            /* 0: there is no singular part, and the rest is not used */
    double turn;       /* d gap / d alpha */
    fvi_singular unit; /* the expansion with A = 1; J = 0: no body has one */
    fvi_singular undamped; /* the expansion of a body without damping: its first term, as rho -> 0 */
    double *psi;       /* psi(1 + a_n), n <= J, of unit */
    double left;       /* psi(1 + a_J - 2 alpha) */
    double undamped_psi[2];
    double *A;         /* each */
    double *by_A, *by_ratio, *by_mass; /* each: dJ by A, by r, and by the m of the force */
    double by_alpha;
    double *moment; /* of each mode: the moment that (22.20) sums */
    double *block;  /* the memory of psi, A, the three derivatives and moment; owned */
} fvi_singular_start_adjoint;

/* fvi_singular_start_adjoint_start -- start for a run with this state, whose modes are those of the adjoint run. Give
 * it back with fvi_singular_start_adjoint_stop, also after an error. Returns FVI_SUCCESS or FVI_ENOMEM. */
int fvi_singular_start_adjoint_start(const fvi_run *run, const fvi_variable_step_state *o,
                                     fvi_singular_start_adjoint *start);
void fvi_singular_start_adjoint_stop(fvi_singular_start_adjoint *start);

/* fvi_singular_start_adjoint_first -- the velocity that v begins with, for A = 1. */
double fvi_singular_start_adjoint_first(const fvi_singular_start_adjoint *start, size_t j);

/* fvi_singular_start_adjoint_at -- G of coordinate j at t > 0, and G' to *slope unless that is NULL. */
double fvi_singular_start_adjoint_at(const fvi_singular_start_adjoint *start, size_t j, double t,
                          double *slope);

/* fvi_singular_start_adjoint_accumulate -- add to by_A, by_ratio, by_mass and by_alpha. by_G, by_slope and by_force are
 * the derivatives of J by G, by G' and by the force that G leaves, at the time t. */
void fvi_singular_start_adjoint_accumulate(fvi_singular_start_adjoint *start, size_t j, double t,
                          double by_G, double by_slope, double by_force);

/* fvi_singular_start_adjoint_accumulate_modes -- the same for the numbers that the modes of the run take over at t1,
 * (23.25). rho is the damping of coordinate j. The modes are those of the adjoint run, and all of them must be active.
 *
 *   mu        the last mu
 *   by_alpha  nonzero: the derivative by alpha is wanted, and the modes have the weights for it
 *
 * Returns the part of minus dJ/drho that goes through these numbers. */
double fvi_singular_start_adjoint_accumulate_modes(fvi_singular_start_adjoint *start, size_t j, double rho,
                                const fvi_modes *modes, double mu,
                                int by_alpha);

/* fvi_singular_start_adjoint_ratio -- write dr/drho and dr/dm of a coordinate with the mass m and the damping rho. */
void fvi_singular_start_adjoint_ratio(const fvi_singular_start_adjoint *start, double m, double rho,
                           double *by_rho, double *by_m);

#endif
