/* src/variable_step/variable_step_band.h -- Newton's correction of all coordinates, where their
 * Hessian has few diagonals.                                          [H 22]
 *
 * With one Hessian H for all stages of a step the corrections eps_j of its velocities
 * solve, L_j = m_j A^{-1} + rho_j h^{1-beta} W0,
 *
 *     L_j eps_j + h^2 sum_k H_jk A eps_k = r_j.
 *
 * Every matrix in it is a function of A^{-1}. Its eigenvectors (22.9) take the stages
 * apart: e_j = w^T eps_j solves, for each lambda in the upper half plane,
 *
 *     (m_j lambda + rho_j h^{1-beta} lambda^beta) e_j + (h^2 / lambda) sum_k H_jk e_k =
 *     w^T r_j,
 *
 * and eps_j = 2 Re sum v e_j. As |arg lambda| < pi/2 and |beta| <= 1, the real part of the
 * matrix is positive where H is, and its factors need no exchange of rows. */
#ifndef FVI_VARIABLE_STEP_BAND_H
#define FVI_VARIABLE_STEP_BAND_H

#include "stages/variable_rule.h"

typedef struct fvi_variable_step_band fvi_variable_step_band;

/* fvi_variable_step_band_alloc -- room for d coordinates of so many kinds, which share m and
 * rho, and for a Hessian of so many diagonals. NULL: no memory. */
fvi_variable_step_band *fvi_variable_step_band_alloc(const fvi_variable_rule *rule,
                                           double beta, size_t d, size_t kinds,
                                           size_t diagonals);
void fvi_variable_step_band_free(fvi_variable_step_band *band);

/* fvi_variable_step_band_kind -- before the factors: m lambda + drag lambda^beta of a kind. */
void fvi_variable_step_band_kind(fvi_variable_step_band *band, size_t kind, double m,
                            double damping_coeff);

/* fvi_variable_step_band_factorise -- with the kind of each coordinate, and hh times H, which
 * stands in diagonals as fvi_potential has it. Cost O(d diagonals^2). */
void fvi_variable_step_band_factorise(fvi_variable_step_band *band, const size_t *kind,
                                 double hh, const double *H);

/* fvi_variable_step_band_solve -- r, FVI_LANES numbers for each coordinate, becomes eps.
 * Not finite where a pivot was zero. Cost O(d (diagonals + s)). */
void fvi_variable_step_band_solve(fvi_variable_step_band *band, double *r);

#endif
