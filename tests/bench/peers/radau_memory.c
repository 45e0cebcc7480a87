/* tests/bench/peers/radau_memory.c -- The modes of a Radau IIA convolution quadrature: radau_memory.h. [H 18] */
#include "radau_memory.h"
#include "ends.h"
#include "memory/history_kinds.h" /* FVI_VECTORS */
#include "system/larger.h"

#include <gsl/gsl_math.h>
#include <stdlib.h>
#include <string.h>

enum { TABLES = 256 };

/* Rows of 2 s arrays: a_0 ... a_{s-1}, then the factors of an input. */
typedef struct {
    int s, positive, first, length;
    double L, *row;
} table;

struct radau_memory {
    const radau *m;
    size_t d;
    int Q, q0, awake, read,
        stride; /* the updated modes; the modes in the sum */
    double beta, L, unit, far, top[ENDS], *om, *z, *weighted, *own;
    const table *t;
    const double *now; /* a_0 of mode 0 in this step */
};

double radau_memory_spacing(double tolerance)
{
    /* e^{-pi^2 / L}, rounded to whole decades, so that there are few tables */
    const double digits =
        M_LN10 * ceil(-log10(larger(tolerance, 1e-16)) - 1e-9);
    return smaller(0.6, 9.87 / (digits + 3));
}

/* Return the table of s and L, which is kept. It does not depend on the order or the problem. */
static const table *table_of(const radau *m, double L, int positive)
{
    static table all[TABLES];
    for (int k = 0; k < TABLES; k++) {
        table *t = &all[k];
        if (t->row && (t->s != m->s || t->L != L || t->positive != positive))
            continue;
        if (t->row)
            return t;
        *t = (table){ .s = m->s, .L = L, .positive = positive };
        t->first = (int)floor(-90 / L);
        t->length = (int)ceil(14 / L) - t->first;
        t->row = malloc((size_t)(2 * m->s * t->length) * sizeof *t->row);
        for (int k2 = 0; t->row && k2 < t->length; k2++) {
            double a[RADAU_STAGES], g[RADAU_STAGES];
            radau_mode(m, exp(L * (t->first + k2)), positive, a, g);
            for (int i = 0; i < m->s; i++) {
                t->row[i * t->length + k2] = a[i];
                t->row[(m->s + i) * t->length + k2] = g[i];
            }
        }
        return t->row ? t : NULL;
    }
    return NULL;
}

static void weights(radau_memory *o)
{
    const double pi = acos(-1), beta = o->beta, L = o->L;
    double c[ENDS];
    for (int q = 0; q < o->Q; q++)
        o->om[q] = sin(pi * fabs(beta)) / pi * L
                   * exp(beta * (L * (q + o->q0) - log(o->unit)));
    const double first = o->om[0];
    ends(L, beta > 0 ? beta : 1 + beta, c);
    for (int l = 0; l < ENDS; l++)
        o->om[APART * l] += first * c[l] * (beta > 0 ? 1 : exp(-L * APART * l));
    const double nu = (beta > 0 ? 2 : 1) - beta;
    ends(L, nu, o->top);
    for (int l = 0; l < ENDS; l++)
        o->top[l] *= exp(-L * APART * l * nu);
}

radau_memory *radau_memory_alloc(const radau *m, double beta, size_t d,
                                 double unit, double least, double T,
                                 double tolerance)
{
    const double digits = -log(larger(tolerance, 1e-16));
    radau_memory *o = calloc(1, sizeof *o);
    if (!o)
        return NULL;
    o->m = m;
    o->d = d;
    o->beta = beta;
    o->unit = unit;
    o->L = radau_memory_spacing(tolerance);
    /* polynomials of degree 5 through 6 modes: their error is that of the sixth power, divided by 6! where
     * e^{-s t} is expanded, and |lambda| < 11 at the other end */
    const double middle = o->L * APART * (ENDS - 1) / 2.0;
    o->far = 11 * exp(middle + digits / ENDS);
    o->q0 = (int)floor((log(unit / T) - middle - larger(0, digits - 6.6) / ENDS)
                       / o->L);
    o->Q = (int)ceil(log(o->far * unit / least) / o->L) - o->q0 + 1;
    o->t = table_of(m, o->L, beta > 0);
    const size_t Q = (size_t)o->Q;
    o->om = calloc(Q * (2 + d + 2 * (size_t)m->s), sizeof *o->om);
    if (!o->om || !o->t || o->Q < APART * ENDS) {
        radau_memory_free(o);
        return NULL;
    }
    o->weighted = o->om + Q;
    o->z = o->weighted + Q;
    o->own = o->z + Q * d;
    weights(o);
    return o;
}

void radau_memory_free(radau_memory *o)
{
    if (o)
        free(o->om);
    free(o);
}

/* Return the number of modes that a step of length h needs. */
static int needed(const radau_memory *o, double h)
{
    const int Q = (int)ceil(log(o->far * o->unit / h) / o->L) - o->q0;
    return Q < o->Q ? Q : o->Q;
}

void radau_memory_step(radau_memory *o, double h, double next, int on_lattice)
{
    const int s = o->m->s;
    o->read = needed(o, h);
    o->awake = next < h ? needed(o, next) : o->read;
    o->stride = o->t->length;
    if (on_lattice) {
        const int at =
            (int)lround(log(h / o->unit) / o->L) + o->q0 - o->t->first;
        if (at >= 0 && at + o->awake <= o->t->length) {
            o->now = o->t->row + at;
            return;
        }
    }
    const double ratio = exp(o->L);
    double mu = h / o->unit * exp(o->L * o->q0);
    o->stride = o->Q;
    for (int q = 0; q < o->awake; q++) {
        double a[RADAU_STAGES], g[RADAU_STAGES];
        radau_mode(o->m, mu, o->beta > 0, a, g);
        mu *= ratio;
        for (int i = 0; i < s; i++) {
            o->own[i * o->Q + q] = a[i];
            o->own[(s + i) * o->Q + q] = g[i];
        }
    }
    o->now = o->own;
}

FVI_VECTORS static double inner(int n, const double *restrict a,
                                const double *restrict b)
{
    double sum = 0;
#pragma omp simd reduction(+ : sum)
    for (int q = 0; q < n; q++)
        sum += a[q] * b[q];
    return sum;
}

FVI_VECTORS static void weigh(int n, const double *restrict a,
                              const double *restrict b, double *restrict c)
{
#pragma omp simd
    for (int q = 0; q < n; q++)
        c[q] = a[q] * b[q];
}

/* Advance the modes by a step: z <- R z + sum_j g_j u_j. */
FVI_VECTORS static void go_on(int n, int s, int stride,
                              const double *restrict a, const double *u,
                              double *restrict z)
{
    const double *restrict R = a + (s - 1) * stride, *restrict g =
                                                         a + s * stride;
    OUTER_SIMD for (int q = 0; q < n; q++)
    {
        double sum = R[q] * z[q];
        for (int j = 0; j < s; j++)
            sum += g[j * stride + q] * u[j];
        z[q] = sum;
    }
}

void radau_memory_history(const radau_memory *o, double *H)
{
    for (size_t a = 0; a < o->d; a++) {
        const double *z = o->z + a * (size_t)o->Q;
        weigh(o->read, o->om, z, o->weighted);
        for (int l = 0; l < ENDS; l++)
            o->weighted[o->read - 1 - APART * l] *= 1 + o->top[l];
        for (int i = 0; i < o->m->s; i++)
            H[(size_t)i * o->d + a] =
                inner(o->read, o->weighted, o->now + i * o->stride);
    }
}

void radau_memory_push(radau_memory *o, const double *u)
{
    double v[RADAU_STAGES];
    for (size_t a = 0; a < o->d; a++) {
        for (int i = 0; i < o->m->s; i++)
            v[i] = u[(size_t)i * o->d + a];
        go_on(o->awake, o->m->s, o->stride, o->now, v, o->z + a * (size_t)o->Q);
    }
}
