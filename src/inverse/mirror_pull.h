/* src/inverse/mirror_pull.h -- A start that the past pulls, backwards.  [Chapter 23]
 *
 * Internal: what mirror_mesh.c has of the singular part G of a run,
 *
 *     G(t) = A sum_{n=1}^{J} k_n r^n t^{a_n},                     (22.19), (22.23)
 *
 * r = rho/m or m/rho. Number of terms and window are held: then G, G' and what G leaves as
 * a force depend on A, r, alpha and, the force, m, and have elementary derivatives. */
#ifndef FVI_MIRROR_PULL_H
#define FVI_MIRROR_PULL_H

#include <fvi/adjoint.h>
#include "mesh_path.h"

/* Where the comment says "each", d numbers. */
typedef struct {
    int is;            /* 0: there is no such part, and none of all this */
    double turn;       /* d gap / d alpha */
    fvi_singular unit; /* with A = 1; J = 0: no body has one */
    fvi_singular bare; /* of what is not damped: its first term, as rho -> 0 */
    double *psi;       /* psi(1 + a_n), n <= J, of unit */
    double left;       /* psi(1 + a_J - 2 alpha) */
    double bare_psi[2];
    double *A;         /* each */
    double *by_A, *by_ratio, *by_mass; /* each: dJ by A, r, the force's m */
    double by_alpha;
    double *moment; /* of each mode: what (22.20) sums */
    double *block;  /* psi, A, the three and moment; owned */
} fvi_mirror_pull;

/* fvi_mirror_pull_start -- of a run that was recorded; with modes: of how many. Errors:
 * FVI_ENOMEM. To be given back by fvi_mirror_pull_stop in any case. */
int fvi_mirror_pull_start(const fvi_run *run, const fvi_mesh_path *path,
                          size_t modes, fvi_mirror_pull *pull);
void fvi_mirror_pull_stop(fvi_mirror_pull *pull);

/* fvi_mirror_pull_first -- what v begins with, for A = 1. */
double fvi_mirror_pull_first(const fvi_mirror_pull *pull, size_t j);

/* fvi_mirror_pull_at -- G of coordinate j at t > 0, and G' unless NULL. */
double fvi_mirror_pull_at(const fvi_mirror_pull *pull, size_t j, double t,
                          double *slope);

/* fvi_mirror_pull_meet -- dJ has by_G, by_slope and by_force of G, G' and the force that is
 * left at t: to by_A, by_ratio, by_mass and by_alpha. */
void fvi_mirror_pull_meet(fvi_mirror_pull *pull, size_t j, double t,
                          double by_G, double by_slope, double by_force);

/* fvi_mirror_pull_remember -- the same of what the modes of a run with damping rho take over
 * at t1, from those of the mirrored run, all of them awake. Returns what the damping has
 * worked on it, over rho.                                                      (23.25)
 *   mu   the last mu
 *   by_alpha  0: not wanted; else the modes have rates */
double fvi_mirror_pull_remember(fvi_mirror_pull *pull, size_t j, double rho,
                                const fvi_modes *modes, double mu,
                                int by_alpha);

/* fvi_mirror_pull_ratio -- dr/drho and dr/dm of coordinate j, m and rho being those. */
void fvi_mirror_pull_ratio(const fvi_mirror_pull *pull, double m, double rho,
                           double *by_rho, double *by_m);

#endif
