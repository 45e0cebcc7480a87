/* src/variable_step/variable_step_band.h -- Newton's correction for a Hessian with few diagonals. [H 22]
 *
 * With one Hessian H for all stages of a step, the corrections eps_j of its velocities solve
 *
 *     L_j eps_j + h^2 sum_k H_jk A eps_k = r_j,   L_j = m_j A^{-1} + rho_j h^{1-beta} W0.
 *
 * Every matrix in this equation is a function of A^{-1}. So the eigenvectors of A^{-1}, (22.9), separate the stages:
 * e_j = w^T eps_j solves, for each eigenvalue lambda in the upper half plane,
 *
 *     (m_j lambda + rho_j h^{1-beta} lambda^beta) e_j + (h^2 / lambda) sum_k H_jk e_k = w^T r_j,
 *
 * and eps_j = 2 Re sum v e_j. Since |arg lambda| < pi/2 and |beta| <= 1, the real part of the matrix is positive if H
 * is, and then its factors need no exchange of rows. */
#ifndef FVI_VARIABLE_STEP_BAND_H
#define FVI_VARIABLE_STEP_BAND_H

#include "stages/variable_rule.h"

typedef struct fvi_variable_step_band fvi_variable_step_band;

/* fvi_variable_step_band_alloc -- allocate a solver of d coordinates in `groups` groups, which share m and rho, and of
 * a Hessian with `diagonals` diagonals. Free it with fvi_variable_step_band_free; NULL is allowed. Returns NULL
 * without memory. */
fvi_variable_step_band *fvi_variable_step_band_alloc(const fvi_variable_rule *rule,
                                           double beta, size_t d, size_t groups,
                                           size_t diagonals);
void fvi_variable_step_band_free(fvi_variable_step_band *band);

/* fvi_variable_step_band_group -- set m lambda + damping_coeff lambda^beta of a group, before the factorisation. */
void fvi_variable_step_band_group(fvi_variable_step_band *band, size_t group, double m,
                            double damping_coeff);

/* fvi_variable_step_band_factorise -- compute the factors, from the group of each coordinate and from hh times H. H is
 * stored by diagonals as in fvi_potential. Cost O(d diagonals^2). */
void fvi_variable_step_band_factorise(fvi_variable_step_band *band, const size_t *group_of,
                                 double hh, const double *H);

/* fvi_variable_step_band_solve -- replace r by eps, FVI_LANES numbers for each coordinate. eps is not finite if a pivot
 * was zero. Cost O(d (diagonals + s)). */
void fvi_variable_step_band_solve(fvi_variable_step_band *band, double *r);

#endif
