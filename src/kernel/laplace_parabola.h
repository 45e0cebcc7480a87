/* src/kernel/laplace_parabola.h -- Laplace's inverse integral along a parabola.    [H 26]
 *
 *     f(t) = (1/2 pi i) int F(s) e^{st} ds = Re sum_j weight_j F(s_j) e^{s_j t} + poles,
 *
 * s = mu (1 + i v)^2, by the midpoint rule in v: of F that is real for s > 0, and analytic but for
 * the negative axis and for poles. One parabola serves all times from t to SPAN t.
 *
 * With mu SPAN t = 3 the largest factor e^{st} is e^3, so that few digits cancel, and e^{st} falls
 * below 1e-17 where the nodes end. The rule resolves a distance of 1 in v, which is that of the
 * origin, to e^{-2 pi/0.12} = 2e-23: F may be like s^-4 there. */
#ifndef FVI_LAPLACE_PARABOLA_H
#define FVI_LAPLACE_PARABOLA_H

#include <complex.h>

enum { FVI_PARABOLA_NODES = 63, FVI_PARABOLA_SPAN = 4 };

typedef struct {
    double mu;
    double complex s[FVI_PARABOLA_NODES], weight[FVI_PARABOLA_NODES];
} fvi_parabola;

/* fvi_parabola_make -- for the times from t > 0 to SPAN t. */
void fvi_parabola_make(double t, fvi_parabola *parabola);

/* fvi_parabola_left_out -- what the rule leaves out of a pole s_p of F with Im s_p > 0 and the
 * residue r: Re of 2 r e^{s_p t} times this. It is nearly 1 to the right of the parabola, nearly 0
 * to the left of it, and next to it what the nodes do not resolve.
 *
 *   slope  output or NULL: s times the derivative of the logarithm, for poles that move */
double complex fvi_parabola_left_out(const fvi_parabola *parabola, double complex s,
                                     double complex *slope);

#endif
