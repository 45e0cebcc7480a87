/* src/expression/tape_complex.c -- Evaluate a law of damping that is an expression in s.          [H 26] */

#include "tape.h"

#include <complex.h>
#include <math.h>

static double complex function(fvi_operation op, double complex u)
{
    switch (op) {
    case TAPE_SIN:
        return csin(u);
    case TAPE_COS:
        return ccos(u);
    case TAPE_TAN:
        return ctan(u);
    case TAPE_ASIN:
        return casin(u);
    case TAPE_ACOS:
        return cacos(u);
    case TAPE_ATAN:
        return catan(u);
    case TAPE_SINH:
        return csinh(u);
    case TAPE_COSH:
        return ccosh(u);
    case TAPE_TANH:
        return ctanh(u);
    case TAPE_EXP:
        return cexp(u);
    case TAPE_LOG:
        return clog(u);
    case TAPE_SQRT:
        return csqrt(u);
    default: /* abs, sign, min and max are not analytic */
        return NAN;
    }
}

/* u^w with the principal logarithm. A real exponent is treated separately, so that it only multiplies the angle. */
static double complex power(double complex u, double complex w)
{
    if (cimag(w) != 0)
        return cexp(w * clog(u));
    const double size = pow(cabs(u), creal(w)), angle = creal(w) * carg(u);
    return size * cos(angle) + I * (angle == 0 ? 0 : size * sin(angle));
}

static double complex operate(const fvi_node *at, double complex u,
                              double complex w)
{
    switch (at->op) {
    case TAPE_ADD:
        return u + w;
    case TAPE_SUBTRACT:
        return u - w;
    case TAPE_MULTIPLY:
        return u * w;
    case TAPE_DIVIDE:
        return u / w;
    case TAPE_NEGATE:
        return -u;
    case TAPE_WHOLE_POWER:
        return power(u, at->number);
    case TAPE_POWER:
        return power(u, w);
    default:
        return function(at->op, u);
    }
}

double complex fvi_tape_complex(const fvi_node *node, size_t n,
                                double complex s, const double *k)
{
    double complex v[n]; /* n <= FVI_TAPE_LONGEST */
    for (size_t m = 0; m < n; m++) {
        const fvi_node *at = &node[m];
        v[m] = at->op == TAPE_NUMBER       ? at->number
               : at->op == TAPE_COORDINATE ? s
               : at->op == TAPE_PARAMETER  ? k[at->a]
                                           : operate(at, v[at->a], v[at->b]);
    }
    return v[n - 1];
}
