/* tests/bench/peers/flmm_modes.c -- The trapezoidal FLMM by exponentials. [H 18]
 *
 * With delta = 2 (1 - z) / (1 + z), 0 < gamma < 1 and r = (2 - x) / (2 + x)
 *
 *     delta^{-gamma} = sin(pi gamma) / pi int_0^infinity x^{-gamma} / (x + delta) dx,
 *     1 / (x + delta) = 1 / (x + 2) + sum_{n >= 1} 4 / (x + 2)^2 r^{n-1} z^n,
 *
 * by the trapezoid rule in ln x (the idea: M. Lopez-Fernandez, C. Lubich, A. Schaedle, SIAM J. Sci. Comput. 30
 * (2008)). For 1 < gamma < 2 the running sums of the trapezoidal rule come first, and the modes of gamma - 1
 * after them. */
#include "flmm_modes.h"
#include "ends.h"
#include "memory/history_kinds.h" /* FVI_VECTORS */
#include "system/larger.h"

#include <math.h>
#include <stdlib.h>

struct flmm_modes {
    int Q;              /* number of modes */
    double *r, *c, *z;  /* w_n = sum_q c_q r_q^{n-1}; z_q = sum_j r_q^{n-1-j} u_j */
    double order, first; /* gamma, or gamma - 1 above 1; w_0 of this order */
    int twice;          /* nonzero if gamma > 1 */
    double sum;         /* of all u; for the running sums and for gamma = 1 */
};

flmm_modes *flmm_modes_alloc(double gamma, size_t N, double tolerance)
{
    flmm_modes *o = calloc(1, sizeof *o);
    if (!o)
        return NULL;
    const double digits = -log(larger(tolerance, 1e-16)),
                 L = smaller(0.6, 9.87 / (digits + 3));
    o->twice = gamma > 1;
    o->order = gamma - o->twice;
    o->first = pow(2, -o->order);
    if (gamma == 1)
        return o;
    /* the ends: polynomials of degree 5 through six modes at the lower end, no correction at the upper end */
    const double middle = L * APART * (ENDS - 1) / 2.0,
                 low = -log((double)N) - middle - larger(0, digits - 6.6) / ENDS,
                 high = 0.7 + digits / (1 + o->order),
                 pi = acos(-1), size = sin(pi * o->order) / pi * L;
    o->Q = (int)larger(APART * ENDS, ceil((high - low) / L) + 1);
    o->r = malloc(3 * (size_t)o->Q * sizeof *o->r);
    if (!o->r) {
        free(o);
        return NULL;
    }
    o->c = o->r + o->Q;
    o->z = o->c + o->Q;
    double end[ENDS];
    ends(L, 1 - o->order, end);
    for (int q = 0; q < o->Q; q++) {
        const double x = exp(low + L * q), power = exp((1 - o->order) * (low + L * q));
        double weight = size * power;
        if (q % APART == 0 && q < APART * ENDS)
            weight += size * exp((1 - o->order) * low) * end[q / APART];
        o->r[q] = (2 - x) / (2 + x);
        o->c[q] = weight * 4 / ((x + 2) * (x + 2));
        o->z[q] = 0;
    }
    return o;
}

void flmm_modes_free(flmm_modes *o)
{
    if (o)
        free(o->r);
    free(o);
}

FVI_VECTORS static double sum_modes(int Q, const double *restrict c,
                                const double *restrict z)
{
    double sum = 0;
#pragma omp simd reduction(+ : sum)
    for (int q = 0; q < Q; q++)
        sum += c[q] * z[q];
    return sum;
}

FVI_VECTORS static void step_modes(int Q, double u, const double *restrict r,
                              double *restrict z)
{
#pragma omp simd
    for (int q = 0; q < Q; q++)
        z[q] = r[q] * z[q] + u;
}

double flmm_modes_sum(const flmm_modes *o)
{
    if (o->Q == 0)
        return o->sum;
    return sum_modes(o->Q, o->c, o->z) + (o->twice ? o->first * o->sum : 0);
}

void flmm_modes_push(flmm_modes *o, double u)
{
    if (o->Q)
        step_modes(o->Q, o->twice ? o->sum + u / 2 : u, o->r, o->z);
    o->sum += u;
}
