/* src/kernel/laplace_parabola.h -- Invert a Laplace transform by an integral along a parabola.    [H 26]
 *
 *     f(t) = (1/2 pi i) int F(s) e^{st} ds = Re sum_j weight_j F(s_j) e^{s_j t} + poles
 *
 * The parabola is s = mu (1 + i v)^2, and the sum is the midpoint rule in v. F must be real for s > 0, and analytic
 * except for the negative axis and for poles. One parabola serves all times from t to SPAN t.
 *
 * With mu SPAN t = 3 the largest factor e^{st} is e^3, so few digits cancel, and at the last node e^{st} is below
 * 1e-17. The origin s = 0 has the distance 1 in v. The rule resolves this distance to e^{-2 pi/0.12} = 2e-23, so F may
 * be like s^-4 there. */
#ifndef FVI_LAPLACE_PARABOLA_H
#define FVI_LAPLACE_PARABOLA_H

#include <complex.h>

enum { FVI_PARABOLA_NODES = 63, FVI_PARABOLA_SPAN = 4 };

typedef struct {
    double mu;
    double complex s[FVI_PARABOLA_NODES], weight[FVI_PARABOLA_NODES];
} fvi_parabola;

/* fvi_parabola_make -- Compute the nodes and weights for the times from t > 0 to SPAN t. */
void fvi_parabola_make(double t, fvi_parabola *parabola);

/* fvi_parabola_left_out -- Return the part of a pole that the rule leaves out. For a pole s_p of F with Im s_p > 0 and
 * the residue r, the caller adds Re(2 r e^{s_p t} part) to the sum. The part is nearly 1 to the right of the parabola
 * and nearly 0 to its left. Near the parabola it corrects the part of the pole that the nodes do not resolve.
 *
 *   slope  NULL, or output: s times the derivative of ln(part), for poles that move */
double complex fvi_parabola_left_out(const fvi_parabola *parabola, double complex s,
                                     double complex *slope);

#endif
