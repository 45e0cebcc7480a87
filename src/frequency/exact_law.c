/* src/frequency/exact_law.c -- Find the complex poles of 1 / Q for a law of damping. [H 26] */
#include "exact_law.h"
#include "winding.h"

#include "kernel/kernel_general.h"

#include <math.h>

static const double STEP = 0.5; /* of ln s, from one evaluation of Q to the next */
static const double EDGE = 150, FARTHEST = 340; /* of ln |s|: zeros are found up to EDGE; s^2 is in range */

/* ---- how many zeros there are ---- */

/* Return the argument of Q(s) times 1 + T s^{2 below} for each fraction that has poles off the cut. This product has no
 * poles, only zeros. */
static double phase(const void *params, double u, double v)
{
    const fvi_pole *Q = params;
    const double complex s = exp(u) * (cos(v) + I * sin(v));
    double complex slope;
    double angle =
        carg(Q->m * s * s + Q->c + Q->rho * fvi_kernel_at(Q->law, s, &slope));
    for (size_t i = 0; i < Q->law->count; i++) {
        const fvi_kernel_term *t = &Q->law->term[i];
        fvi_kernel_simple fraction;
        if (t->rho > 0 && fvi_kernel_is_fraction(t, &fraction) && fraction.below > 0.5)
            angle += carg(1 + fraction.time * cexp(2 * fraction.below * (u + I * v)));
    }
    return angle;
}

/* Return the number of zeros in a box, or -1 if one is on its side. */
static int count_zeros(const fvi_pole *Q, const fvi_log_box *b)
{
    return fvi_winding(phase, Q, STEP, b);
}

/* ---- where they are ---- */

static int is_inside(const fvi_log_box *b, double complex s)
{
    const double u = log(cabs(s)), v = carg(s);
    return u > b->u[0] && u < b->u[1] && v > b->v[0] && v < b->v[1];
}

/* Newton's method for ln s, from the middle of a box. Return 1 if it ends inside the box. */
static int newton(const fvi_log_box *b, fvi_pole *Q)
{
    double u = (b->u[0] + b->u[1]) / 2, v = (b->v[0] + b->v[1]) / 2;
    for (int i = 0; i < 50; i++) {
        const double complex s = exp(u) * (cos(v) + I * sin(v));
        double complex slope;
        const double complex C = fvi_kernel_at(Q->law, s, &slope),
                             step = -(Q->m * s * s + Q->c + Q->rho * C)
                                    / (2 * Q->m * s * s + Q->rho * slope);
        if (!(cabs(step) < 1))
            return 0;
        u += creal(step);
        v += cimag(step);
        Q->s = exp(u) * (cos(v) + I * sin(v));
        if (cabs(step) < 1e-12)
            return is_inside(b, Q->s);
    }
    return 0;
}

static int no_poles(fvi_error *error)
{
    return fvi_fail(error, FVI_EMAXITER, "law", NAN,
                    "the poles of the motion were not found: they are too far out, or too near to each other");
}

/* Find the n zeros of a box, and add them to those that have been found. */
static int find_zeros(const fvi_pole *Q, const fvi_log_box *b, int n, size_t most,
                      fvi_pole *pole, size_t *count, fvi_error *error)
{
    if (n == 0)
        return FVI_SUCCESS;
    if (*count + (size_t)n > most)
        return fvi_fail(error, FVI_EUNSUP, "law", NAN, "the law has too many oscillations");
    fvi_pole one = *Q;
    if (n == 1 && newton(b, &one)) {
        pole[(*count)++] = one;
        return FVI_SUCCESS;
    }
    fvi_log_box half[2];
    const int first =
        b->u[1] - b->u[0] + b->v[1] - b->v[0] > 1e-12 ? fvi_halve_box(phase, Q, STEP, b, half) : -1;
    if (first < 0 || first > n)
        return no_poles(error);
    int status = find_zeros(Q, &half[0], first, most, pole, count, error);
    if (!status)
        status = find_zeros(Q, &half[1], n - first, most, pole, count, error);
    return status;
}

/* Return nonzero if a zero may lie outside -EDGE <= ln |s| <= EDGE. Above this range Q must be nearly m s^2, and below
 * it nearly c + rho C(s). Otherwise zeros are counted there, up to FARTHEST. */
static int has_distant_zero(const fvi_pole *Q, double angle)
{
    for (int above = 0; above < 2; above++) {
        const double complex s = exp(above ? EDGE : -EDGE) * (cos(2) + I * sin(2));
        const double inertia = cabs(Q->m * s * s),
                     rest = cabs(Q->c + Q->rho * fvi_kernel_at(Q->law, s, NULL));
        const fvi_log_box beyond = { { above ? EDGE : -FARTHEST, above ? FARTHEST : -EDGE }, { 1.5, angle } };
        if (!(above ? rest < 1e-3 * inertia : inertia < 1e-3 * rest) && count_zeros(Q, &beyond) != 0)
            return 1;
    }
    return 0;
}

int fvi_kernel_poles(double m, double c, double rho, const fvi_kernel *law, double widest,
                     size_t most, fvi_pole *pole, size_t *count, fvi_error *error)
{
    static const double parts[] = { 1, 1.05, 0.95 }; /* of pi - widest, if a zero lies on the side of the box */
    const fvi_pole Q = { .m = m, .c = c, .rho = rho, .law = law };
    if (isnan(phase(&Q, EDGE, 2)) || isnan(phase(&Q, -EDGE, 2)))
        return fvi_fail(error, FVI_EOVRFLW, "law", NAN, "the law is not finite");
    int n = -1;
    fvi_log_box all;
    for (size_t i = 0; n < 0 && i < sizeof parts / sizeof *parts; i++) {
        all = (fvi_log_box){ { -EDGE, EDGE }, { 1.5, M_PI - parts[i] * (M_PI - widest) } };
        n = count_zeros(&Q, &all);
    }
    *count = 0;
    if (n < 0 || has_distant_zero(&Q, all.v[1]))
        return no_poles(error);
    int status = find_zeros(&Q, &all, n, most, pole, count, error);
    for (size_t i = 0; !status && i < *count; i++)
        fvi_pole_polish(&pole[i]);
    return status;
}
