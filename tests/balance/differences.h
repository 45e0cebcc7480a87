/* tests/balance/differences.h -- x'' + grad U(x) + rho D^{2 alpha} x = 0, differenced as
 * it stands.                                    [chapters/handbook/what_the_principle_buys.md]
 *
 *     (x_{k+1} - 2 x_k + x_{k-1}) / h^2 + G_k + rho D_k = 0,   k = 1, ..., N - 1,
 *
 * where G_k is grad U at x_k (NODE); its mean with weights 1/4, 1/2, 1/4 over x_{k-1}, x_k,
 * x_{k+1} (MEAN, Newmark's average acceleration); or the whole equation at k + 1, G and D
 * too (BACK, the matrix method (10.9)). D_k is that of H 9 for a body that was held.
 * U = |x|^2 / 2 + g |x|^4 / 4 in one dimension or in the plane, so that a new x lies on
 * the ray of what is known. VARIED names the FVI with kappa = 1/2, for the tangents. */
#ifndef DIFFERENCES_H
#define DIFFERENCES_H

#include "system/larger.h"

#include <math.h>
#include <stddef.h>

typedef enum { NODE, MEAN, BACK, VARIED } differences;

typedef struct {
    size_t d, steps;
    double g, rho, alpha, h;
} differenced;

/* h^2 rho D_k with x_k: h^(2 - 2 alpha) rho sum_n w_n z_{k-n}; in all rows and one column. */
static double past_of(const differenced *o, size_t k, const double *x, size_t i)
{
    double w = 1, sum = 0;
    for (size_t n = 0; n <= k && o->rho != 0; n++) {
        sum += w * (x[(k - n) * o->d + i] - x[i]);
        w *= ((double)n - 2 * o->alpha) / (double)(n + 1);
    }
    return o->rho * pow(o->h, 2 - 2 * o->alpha) * sum;
}

static double square(size_t d, const double *x)
{
    return d == 2 ? x[0] * x[0] + x[1] * x[1] : x[0] * x[0];
}

/* q >= 0 with a q + s (q + g q^3) = r: Newton's method from the right, where it falls. */
static double along(double a, double s, double g, double r)
{
    double q = r / (a + s), last;
    do {
        last = q;
        q = (r + 2 * s * g * q * q * q) / (a + s + 3 * s * g * q * q);
    } while (q < last);
    return q;
}

/* x_2, ..., x_N from x_0 and x_1, rows of d numbers. */
static void difference(differences kind, const differenced *o, double *x)
{
    const size_t d = o->d;
    const double h2 = o->h * o->h;
    const double s = kind == BACK ? h2 : kind == MEAN ? h2 / 4 : 0;
    const double a =
        1 + (kind == BACK ? o->rho * pow(o->h, 2 - 2 * o->alpha) : 0);
    for (size_t k = 1; k < o->steps; k++) {
        const double *now = x + k * d, *last = now - d;
        double *next = x + (k + 1) * d;
        const double here = 1 + o->g * square(d, now),
                     before = 1 + o->g * square(d, last);
        for (size_t i = 0; i < d; i++) {
            double G = 0;
            if (kind == NODE)
                G = here * now[i];
            if (kind == MEAN)
                G = (2 * here * now[i] + before * last[i]) / 4;
            next[i] = x[i]; /* z_{k+1} = 0, for the sum over the past */
            next[i] = 2 * now[i] - last[i] - h2 * G
                      - past_of(o, kind == BACK ? k + 1 : k, x, i)
                      + (a - 1) * x[i];
        }
        const double r = sqrt(square(d, next));
        const double share = r > 0 ? along(a, s, o->g, r) / r : 1;
        for (size_t i = 0; i < d; i++)
            next[i] *= share;
    }
}

/* The scheme linearised about x, d = 1: v_N after a unit impulse at node j, from rest.
 * H_k is U'' where the scheme asks for it: at x_k, for VARIED between x_k and x_{k+1}. */
static void tangent(differences kind, const differenced *o, const double *H,
                    size_t j, double *v)
{
    const double h2 = o->h * o->h, first = o->rho * pow(o->h, 2 - 2 * o->alpha);
    for (size_t k = 0; k <= j; k++)
        v[k] = 0;
    for (size_t k = j; k < o->steps; k++) {
        const double last = k ? v[k - 1] : 0;
        double known = 2 * v[k] - last + (k == j ? o->h : 0), a = 1;
        v[k + 1] = 0;
        known -= past_of(o, kind == BACK ? k + 1 : k, v, 0);
        if (kind == NODE)
            known -= h2 * H[k] * v[k];
        if (kind == BACK)
            a += h2 * H[k + 1] + first;
        if (kind == MEAN) {
            known -= h2 / 4 * (2 * H[k] * v[k] + (k ? H[k - 1] * last : 0));
            a += h2 / 4 * H[k + 1];
        }
        if (kind == VARIED) {
            known -= h2 / 4 * (H[k] * v[k] + (k ? H[k - 1] * (last + v[k]) : 0));
            a += h2 / 4 * H[k];
        }
        v[k + 1] = known / a;
    }
}

/* How far d x_N / d (impulse at j), from the same linear scheme run backwards about the
 * trajectory, is from the derivative of the run itself, over the largest: eight j. Room:
 * H, back, v of steps + 1. */
static double gradient_error(differences kind, const differenced *o,
                             const double *x, double *H, double *back, double *v)
{
    const size_t N = o->steps, rows = kind == VARIED ? N : N + 1;
    double worst = 0, largest = 0;
    for (size_t k = 0; k < rows; k++) {
        const double at = kind == VARIED ? (x[k] + x[k + 1]) / 2 : x[k];
        back[rows - 1 - k] = H[k] = 1 + 3 * o->g * at * at;
    }
    if (kind == BACK) /* the equation of node k stands at k + 1 */
        for (size_t k = 0; k + 1 < rows; k++)
            back[rows - 1 - k] = H[k + 1];
    tangent(kind, o, back, 0, v);
    for (size_t k = 0; k <= N; k++)
        back[k] = v[N - k];
    for (size_t i = 1; i < 8; i++) {
        tangent(kind, o, H, i * N / 8, v);
        worst = larger(worst, fabs(v[N] - back[i * N / 8]));
        largest = larger(largest, fabs(v[N]));
    }
    return worst / largest;
}

#endif
