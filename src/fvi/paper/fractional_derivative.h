/* src/fvi/paper/fractional_derivative.h -- Riemann-Liouville and Caputo derivatives of a function and of a
 * power, from the left and from the right.                                                      [H 1] */
#ifndef FVI_FRACTIONAL_DERIVATIVE_H
#define FVI_FRACTIONAL_DERIVATIVE_H

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_side -- the part of the interval [a, b] on which a derivative at t depends. */
typedef enum {
    FVI_RETARDED = -1, /* D_-: from the beginning a up to t */
    FVI_ADVANCED = 1   /* D_+: from t up to the end b */
} fvi_side;

/* fvi_curve -- a function of time with its derivative.
 *
 *   f, df   f(t) and f'(t), finite on the interval and smooth enough for a quadrature of f': its kinks cost
 *           time, its jumps cost accuracy
 *   params  handed to both functions, owned by the caller, may be NULL */
typedef struct {
    double (*f)(double t, const void *params);
    double (*df)(double t, const void *params);
    const void *params;
} fvi_curve;

/* fvi_caputo -- Compute the Caputo derivative of a curve at t.                         [(1.3), (1.5)]
 *
 *     C_D_-^alpha f(t) =  1/Gamma(1-alpha) int_a^t (t-s)^(-alpha) f'(s) ds
 *     C_D_+^alpha f(t) = -1/Gamma(1-alpha) int_t^b (s-t)^(-alpha) f'(s) ds
 *
 * fvi_riemann_liouville -- Compute the Riemann-Liouville derivative, which adds a term of the end.  [(1.4)]
 *
 *     RL_D_-^alpha f(t) = C_D_-^alpha f(t) + f(a) (t-a)^(-alpha) / Gamma(1-alpha)
 *     RL_D_+^alpha f(t) = C_D_+^alpha f(t) + f(b) (b-t)^(-alpha) / Gamma(1-alpha)
 *
 *   side   FVI_RETARDED or FVI_ADVANCED
 *   alpha  order, 0 <= alpha <= 1
 *   end    where the memory ends: a for D_-, b for D_+; finite
 *   curve  f and f'
 *   t      t >= end for D_-, t <= end for D_+; finite
 *   d      output, one number
 *
 *     const fvi_curve curve = { sine, cosine, NULL };
 *     double d;
 *     status = fvi_caputo(FVI_RETARDED, 0.5, 0, &curve, 2, &d);
 *
 * The limits are exact. Order 0 gives f(t) - f(end) for Caputo and f(t) for Riemann-Liouville. Order 1 gives
 * f'(t), or -f'(t) for the advanced derivative. For every other order the function integrates f' against the
 * singular kernel by adaptive quadrature (GSL's QAWS), which evaluates f' some hundred times.
 * Accuracy: |error| <= 1e-12 M, where
 *     M = (|t-end|^(1-alpha) / Gamma(2-alpha)) max |f'|
 * is the largest possible derivative of a curve with this max |f'|. Riemann-Liouville adds an error of 20 u
 * of its second term, u = 2^-53. The rounding errors of f' and of its argument come on top (t - s is rounded
 * where |t| >> |t - end|).
 *
 * Returns FVI_SUCCESS; FVI_EFAULT if curve, one of its functions or d is NULL; FVI_EINVAL if side is neither
 * of the two; FVI_EDOM if alpha, end or t is out of range; FVI_ESING at t = end for Riemann-Liouville with
 * 0 < alpha < 1 and f(end) != 0; FVI_EBADFUNC if f or f' is not finite; FVI_ENOMEM; or the code with which
 * QAWS gives up (FVI_EMAXITER, FVI_EROUND, FVI_ESING). On error d is untouched. */
int fvi_caputo(fvi_side side, double alpha, double end, const fvi_curve *curve,
               double t, double *d);
int fvi_riemann_liouville(fvi_side side, double alpha, double end,
                          const fvi_curve *curve, double t, double *d);

/* fvi_power_derivative -- Compute the Riemann-Liouville derivative of a power, from either side.  [(1.6)]
 *
 *     D^order u^g = Gamma(g + 1) / Gamma(g + 1 - order) u^(g - order)
 *
 * with u = t - a for D_- and u = b - t for D_+. A negative order is an integral of the order -order. Where
 * g + 1 - order is 0 or -1, the result is exactly 0.
 *
 *   order  -2 <= order <= 2
 *   g      exponent, finite, g > -1
 *   u      distance from the end, finite, u >= 0
 *   d      output, one number
 *
 *     double d;
 *     status = fvi_power_derivative(0.5, 1, 4, &d);       // D^(1/2) u at u = 4: 4/sqrt(pi)
 *
 * Caputo's derivative, of order in [0, 1], has the same value for g > 0, and is 0 for g = 0.
 * Accuracy: relative error below 60 u with u = 2^-53, if g <= 10^12 and no number is subnormal. Cost: two
 * gamma functions and a power.
 * Returns FVI_SUCCESS; FVI_EFAULT if d is NULL; FVI_EDOM if an argument is out of range; FVI_ESING if u == 0
 * and the result is infinite; FVI_EOVRFLW if the result, or u^(g - order), is too large for a double. On
 * error d is untouched. */
int fvi_power_derivative(double order, double g, double u, double *d);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
