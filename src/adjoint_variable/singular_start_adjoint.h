/* src/adjoint_variable/singular_start_adjoint.h -- A singular start, backwards.  [H 23]
 *
 * Internal: what adjoint_variable.c has of the singular part G of a run,
 *
 *     G(t) = A sum_{n=1}^{J} k_n r^n t^{a_n},                     (22.19), (22.23)
 *
 * r = rho/m or m/rho. Number of terms and window are held: then G, G' and what G leaves as
 * a force depend on A, r, alpha and, the force, m, and have elementary derivatives. */
#ifndef FVI_SINGULAR_START_ADJOINT_H
#define FVI_SINGULAR_START_ADJOINT_H

#include "recorded_steps.h"

/* Where the comment says "each", d numbers. */
typedef struct {
    int is;            /* 0: there is no such part, and none of all this */
    double turn;       /* d gap / d alpha */
    fvi_singular unit; /* with A = 1; J = 0: no body has one */
    fvi_singular undamped; /* of what is not damped: its first term, as rho -> 0 */
    double *psi;       /* psi(1 + a_n), n <= J, of unit */
    double left;       /* psi(1 + a_J - 2 alpha) */
    double undamped_psi[2];
    double *A;         /* each */
    double *by_A, *by_ratio, *by_mass; /* each: dJ by A, r, the force's m */
    double by_alpha;
    double *moment; /* of each mode: what (22.20) sums */
    double *block;  /* psi, A, the three and moment; owned */
} fvi_singular_start_adjoint;

/* fvi_singular_start_adjoint_start -- of a run that was recorded; with modes: of how many. Errors:
 * FVI_ENOMEM. To be given back by fvi_singular_start_adjoint_stop in any case. */
int fvi_singular_start_adjoint_start(const fvi_run *run, const fvi_recorded_steps *path,
                          size_t modes, fvi_singular_start_adjoint *start);
void fvi_singular_start_adjoint_stop(fvi_singular_start_adjoint *start);

/* fvi_singular_start_adjoint_first -- what v begins with, for A = 1. */
double fvi_singular_start_adjoint_first(const fvi_singular_start_adjoint *start, size_t j);

/* fvi_singular_start_adjoint_at -- G of coordinate j at t > 0, and G' unless NULL. */
double fvi_singular_start_adjoint_at(const fvi_singular_start_adjoint *start, size_t j, double t,
                          double *slope);

/* fvi_singular_start_adjoint_accumulate -- dJ has by_G, by_slope and by_force of G, G' and the force that is
 * left at t: to by_A, by_ratio, by_mass and by_alpha. */
void fvi_singular_start_adjoint_accumulate(fvi_singular_start_adjoint *start, size_t j, double t,
                          double by_G, double by_slope, double by_force);

/* fvi_singular_start_adjoint_accumulate_modes -- the same of what the modes of a run with damping rho take over
 * at t1, from those of the adjoint run, all of them active. Returns what the damping has
 * worked on it, over rho.                                                      (23.25)
 *   mu   the last mu
 *   by_alpha  0: not wanted; else the modes have rates */
double fvi_singular_start_adjoint_accumulate_modes(fvi_singular_start_adjoint *start, size_t j, double rho,
                                const fvi_modes *modes, double mu,
                                int by_alpha);

/* fvi_singular_start_adjoint_ratio -- dr/drho and dr/dm of coordinate j, m and rho being those. */
void fvi_singular_start_adjoint_ratio(const fvi_singular_start_adjoint *start, double m, double rho,
                           double *by_rho, double *by_m);

#endif
