/* src/frequency/winding.c -- Count how often a function winds around 0.     [H 26, H 30] */
#include "winding.h"

#include "system/larger.h"

#include <gsl/gsl_math.h>
#include <math.h>

/* Return the angle by which the phase turns from one end of a piece to the other. The piece is halved until the angles
 * are small. Return NaN if they do not become small, which happens if a zero is on the way. If the first half fails,
 * the second is left out, because otherwise a phase of rounding errors would be evaluated 2^40 times. */
static double phase_change(fvi_phase *phase, const void *params, const double a[2],
                           const double b[2], double at_a, double at_b, int depth)
{
    const double middle[2] = { (a[0] + b[0]) / 2, (a[1] + b[1]) / 2 };
    const double here = phase(params, middle[0], middle[1]),
                 first = remainder(here - at_a, 2 * M_PI),
                 second = remainder(at_b - here, 2 * M_PI);
    if (fabs(first) < 0.5 && fabs(second) < 0.5)
        return first + second;
    if (depth == 0 || isnan(here))
        return GSL_NAN;
    const double half = phase_change(phase, params, a, middle, at_a, here, depth - 1);
    return isnan(half) ? half : half + phase_change(phase, params, middle, b, here, at_b, depth - 1);
}

/* Return the angle along a side of the box, on which only u or only v changes. Return NaN if its length is not
 * finite. */
static double phase_along_side(fvi_phase *phase, const void *params, double step,
                               const double a[2], const double b[2])
{
    const double length = fabs(b[0] - a[0]) + fabs(b[1] - a[1]);
    if (!isfinite(length))
        return GSL_NAN;
    const int pieces = (int)ceil(length / step);
    double sum = 0, from[2] = { a[0], a[1] }, before = phase(params, a[0], a[1]);
    for (int i = 1; i <= pieces && !isnan(sum); i++) {
        const double part = (double)i / pieces,
                     to[2] = { a[0] + part * (b[0] - a[0]),
                               a[1] + part * (b[1] - a[1]) };
        const double now = phase(params, to[0], to[1]);
        sum += phase_change(phase, params, from, to, before, now, 40);
        from[0] = to[0];
        from[1] = to[1];
        before = now;
    }
    return sum;
}

/* Return the step for a side from a to b. Zeros and poles may lie on the negative axis, v = pi. Two that are nearly
 * equal turn the phase along v by almost a whole turn, while u changes by some multiples of pi - v. So the step is not
 * longer than that. */
static double step_beside_axis(double step, const double a[2], const double b[2])
{
    return a[1] == b[1] ? smaller(step, 12 * (M_PI - a[1])) : step;
}

//> count
int fvi_winding(fvi_phase *phase, const void *params, double step,
                const fvi_log_box *b)
{
    const double corner[5][2] = { { b->u[0], b->v[0] },
                                  { b->u[1], b->v[0] },
                                  { b->u[1], b->v[1] },
                                  { b->u[0], b->v[1] },
                                  { b->u[0], b->v[0] } };
    double sum = 0;
    for (int i = 0; i < 4 && !isnan(sum); i++)
        sum += phase_along_side(phase, params, step_beside_axis(step, corner[i], corner[i + 1]), corner[i],
                                corner[i + 1]);
    return isnan(sum) ? -1 : (int)lround(sum / (2 * M_PI));
}
//< count

int fvi_halve_box(fvi_phase *phase, const void *params, double step, const fvi_log_box *b, fvi_log_box half[2])
{
    static const double parts[] = { 0.5137, 0.4321, 0.6173, 0.3719 };
    const int wide = b->u[1] - b->u[0] > b->v[1] - b->v[0];
    int first = -1;
    for (size_t i = 0; first < 0 && i < sizeof parts / sizeof *parts; i++) {
        half[0] = half[1] = *b;
        const double *side = wide ? b->u : b->v,
                     at = side[0] + parts[i] * (side[1] - side[0]);
        (wide ? half[0].u : half[0].v)[1] = at;
        (wide ? half[1].u : half[1].v)[0] = at;
        first = fvi_winding(phase, params, step, &half[0]);
    }
    return first;
}
