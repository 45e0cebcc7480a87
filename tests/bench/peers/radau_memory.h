/* tests/bench/peers/radau_memory.h -- The past of a fractional derivative, by real exponentials that the Radau
 * IIA methods integrate. [H 18] */
#ifndef RADAU_MEMORY_H
#define RADAU_MEMORY_H

#include "radau_tables.h"

#include <stddef.h>

/* radau_memory -- Y = DD^beta v for -1 < beta < 0, DD^beta (v - v(0)) for 0 < beta < 1, as convolution
 * quadrature on any steps. In a step of length h
 *
 *     Y = h^{-beta} M^beta V + H,   beta < 0;   h^{-beta} M^beta (V - v_k 1) + H,   beta > 0,
 *
 * where V are the stages, v_k is the value at the start of the step, and H is a sum over modes s_q = e^{L (q +
 * q0)} / unit by the trapezoid rule in ln s with corrected ends. For h = unit e^{L j} with a whole j all
 * numbers of all modes and steps come from one table; for other steps they are computed. (M. Lopez-Fernandez,
 * S. Sauter, Numer. Math. 133 (2016); L. Banjai, M. Lopez-Fernandez, Numer. Math. 141 (2019); J. Guo, M.
 * Lopez-Fernandez, arXiv 2506.21242 (2025).) */
typedef struct radau_memory radau_memory;

/* radau_memory_alloc -- a memory of d functions, for steps from `least` to T. The sum has an error of about
 * `tolerance` of its size. NULL if there is no memory. */
radau_memory *radau_memory_alloc(const radau *m, double beta, size_t d,
                                 double unit, double least, double T,
                                 double tolerance);
void radau_memory_free(radau_memory *o);

/* radau_memory_spacing -- return L for a tolerance. */
double radau_memory_spacing(double tolerance);

/* radau_memory_step -- prepare a step of length h. A step of length `next` follows soon, next >= h or < h, and
 * the modes that it needs stay active. on_lattice: h = unit e^{L j}. */
void radau_memory_step(radau_memory *o, double h, double next, int on_lattice);

/* radau_memory_history -- compute H at the stages: H[i * d + a]. */
void radau_memory_history(const radau_memory *o, double *H);

/* radau_memory_push -- finish the step. u[i * d + a] is V for beta < 0, V - v_k for beta > 0. */
void radau_memory_push(radau_memory *o, const double *u);

#endif
