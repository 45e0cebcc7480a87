/* tests/bench/peers/ends.h -- Correct the ends of infinite sums. [H 18] */
#ifndef ENDS_H
#define ENDS_H

enum { ENDS = 6, APART = 3 };

/* ends -- the contribution of the terms beyond one end of a trapezoid sum in ln s.
 *
 *     sum_{q < 0} phi(r^q) r^{nu q} = sum_{l=0}^{5} c_l phi(r^{3 l}),   r = e^L,
 *
 * for polynomials phi of degree 5: sum_l c_l r^{3 l n} = 1 / (r^{nu + n} - 1). */
void ends(double L, double nu, double *c);

#endif
