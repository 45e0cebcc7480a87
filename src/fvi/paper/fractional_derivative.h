/* src/fvi/paper/fractional_derivative.h -- Riemann-Liouville and Caputo derivatives, from
 * the left and from the right, of a function and of a power.     [H 1] */
#ifndef FVI_FRACTIONAL_DERIVATIVE_H
#define FVI_FRACTIONAL_DERIVATIVE_H

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* Which part of the interval a derivative looks at. */
typedef enum {
    FVI_RETARDED = -1, /* D_-: from the beginning a up to t */
    FVI_ADVANCED = 1   /* D_+: from t up to the end b */
} fvi_side;

/* fvi_curve -- a function of time with its derivative.
 *
 *   f, df   f(t) and f'(t), finite on the interval, smooth enough for a
 *           quadrature (kinks cost time, jumps accuracy)
 *   params  handed to both, owned by the caller, may be NULL */
typedef struct {
    double (*f)(double t, const void *params);
    double (*df)(double t, const void *params);
    const void *params;
} fvi_curve;

/* fvi_caputo -- the derivative of Caputo.                     [(1.3), (1.5)]
 *
 *     C_D_-^alpha f(t) =  1/Gamma(1-alpha) int_a^t (t-s)^(-alpha) f'(s) ds
 *     C_D_+^alpha f(t) = -1/Gamma(1-alpha) int_t^b (s-t)^(-alpha) f'(s) ds
 *
 * fvi_riemann_liouville -- the same plus what the end contributes.    [(1.4)]
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
 * The limits are exact: order 0 gives f(t) - f(end) and f(t), order 1 gives
 * f'(t) and, advanced, -f'(t). Else: adaptive quadrature of f' against the
 * singular kernel (GSL's QAWS), with f' evaluated some hundred times.
 * Accuracy: |error| <= 1e-12 M, where
 *     M = (|t-end|^(1-alpha) / Gamma(2-alpha)) max |f'|
 * is as large as the derivative of such an f can be, and for Riemann-Liouville
 * 20 u of the second term more, u = 2^-53. The rounding of f' itself, and of its
 * argument (t - s is rounded where |t| >> |t - end|), comes on top.
 *
 * Returns FVI_SUCCESS; FVI_EFAULT if curve, one of its functions or d is NULL;
 * FVI_EINVAL if side is neither; FVI_EDOM if alpha, end or t is out of range;
 * FVI_ESING at t = end for Riemann-Liouville with 0 < alpha < 1 and f(end) != 0;
 * FVI_EBADFUNC if f or f' is not finite; FVI_ENOMEM; or the code with
 * which QAWS gives up (FVI_EMAXITER, FVI_EROUND, FVI_ESING). On error d is
 * untouched. */
int fvi_caputo(fvi_side side, double alpha, double end, const fvi_curve *curve,
               double t, double *d);
int fvi_riemann_liouville(fvi_side side, double alpha, double end,
                          const fvi_curve *curve, double t, double *d);

/* fvi_power_derivative -- Riemann-Liouville of a power, either side.  [(1.6)]
 *
 *     D^order u^g = Gamma(g + 1) / Gamma(g + 1 - order) u^(g - order)
 *
 * with u = t - a for D_- and u = b - t for D_+. A negative order is an integral
 * of the order -order. Where g + 1 - order is 0 or -1 the result is an exact 0.
 *
 *   order  -2 <= order <= 2
 *   g      exponent, finite, g > -1
 *   u      distance from the end, finite, u >= 0
 *   d      output, one number
 *
 * Accuracy: relative error below 60 u, u = 2^-53 here, if g <= 10^12 and nothing
 * is subnormal. Caputo's derivative, order in [0, 1], is the same for g > 0,
 * and 0 for g = 0. Cost: two gammas and a power.
 * Returns FVI_SUCCESS; FVI_EFAULT if d is NULL; FVI_EDOM if an argument is out
 * of range; FVI_ESING if u == 0 and the result is infinite; FVI_EOVRFLW if it,
 * or u^(g - order), is too large for a double. On error d is untouched. */
int fvi_power_derivative(double order, double g, double u, double *d);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
