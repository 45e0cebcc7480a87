/* tests/bench/peer_product_trapezoid.c -- The method that ours are measured against.
 *                                                               [Chapter 18] */
#include <fvi/error.h>
#include "peer_product_trapezoid.h"
#include "system/newton.h"

#include <gsl/gsl_fft_halfcomplex.h>
#include <gsl/gsl_fft_real.h>
#include <gsl/gsl_machine.h>
#include <gsl/gsl_math.h>
#include <stdlib.h>
#include <string.h>

enum { BLOCK = 64, MOST_BITS = 40 };

/* One integral J^gamma: its weights, their transforms, and the sums to come. */
typedef struct {
    double factor, *a, *c; /* h^gamma / Gamma(gamma + 2); a_k, c_n */
    double *spectrum[MOST_BITS];
    double *g, *sum; /* (N + 1) d values and sums so far */
} integral;

/* ---- weights ---- */

/* The second difference of k^(gamma + 1), by its series where it would cancel:
 * 2 sum_i binom(gamma + 1, 2i) k^(gamma + 1 - 2i). */
static double second_difference(double gamma, double k)
{
    const double e = gamma + 1;
    if (k < 32)
        return pow(k + 1, e) - 2 * pow(k, e) + pow(k - 1, e);
    double term = 1, sum = 0;
    for (int i = 1; i <= 10; i++) {
        term *= (e - i + 1) / (i * k);
        if (i % 2 == 0)
            sum += 2 * term;
    }
    return pow(k, e) * sum;
}

/* c_n = (n-1)^(gamma+1) - n^gamma (n - gamma - 1), in the same way. */
static double first_weight(double gamma, double n)
{
    const double e = gamma + 1;
    if (n < 32)
        return pow(n - 1, e) - pow(n, gamma) * (n - e);
    double term = 1, sum = 0;
    for (int i = 1; i <= 12; i++) {
        term *= -(e - i + 1) / (i * n);
        if (i >= 2)
            sum += term;
    }
    return pow(n, e) * sum;
}

static int prepare(integral *J, double gamma, double h, size_t N, size_t d)
{
    size_t length = BLOCK;
    while (length < 2 * (N + 1))
        length *= 2;
    *J = (integral){ .factor = pow(h, gamma) / tgamma(gamma + 2) };
    J->a = calloc(length + (N + 1) * (2 * d + 1), sizeof *J->a);
    if (!J->a)
        return FVI_ENOMEM;
    J->c = J->a + length;
    J->g = J->c + N + 1;
    J->sum = J->g + (N + 1) * d;
    J->a[0] = 1;
    for (size_t k = 1; k <= N; k++) {
        J->a[k] = second_difference(gamma, (double)k);
        J->c[k] = first_weight(gamma, (double)k);
    }
    return FVI_SUCCESS;
}

static void release(integral *J)
{
    for (int i = 0; i < MOST_BITS; i++)
        free(J->spectrum[i]);
    free(J->a);
}

/* ---- convolution in blocks (Hairer, Lubich, Schlichte) ---- */

/* w = u times v, both transforms of real sequences of length n. */
static void multiply(const double *u, double *v, size_t n)
{
    v[0] *= u[0];
    v[n / 2] *= u[n / 2];
    for (size_t k = 1; k < n / 2; k++) {
        double re = u[k] * v[k] - u[n - k] * v[n - k];
        v[n - k] = u[k] * v[n - k] + u[n - k] * v[k];
        v[k] = re;
    }
}

/* Before step n: the terms n - L, ..., n - 1 are added to the sums n, ...,
 * n + L - 1, where L is the largest power of two in n. g_0 has its own weight. */
//> blocks
static int add_block(integral *J, size_t n, size_t N, size_t d, double *work)
{
    size_t L = n & -n, size = 2 * L;
    int bits = 0;
    while (((size_t)1 << bits) < size)
        bits++;
    if (!J->spectrum[bits]) {
        J->spectrum[bits] = malloc(size * sizeof(double));
        if (!J->spectrum[bits])
            return FVI_ENOMEM;
        memcpy(J->spectrum[bits], J->a, size * sizeof(double));
        gsl_fft_real_radix2_transform(J->spectrum[bits], 1, size);
    }
    for (size_t i = 0; i < d; i++) {
        memset(work, 0, size * sizeof *work);
        for (size_t j = n == L; j < L; j++)
            work[j] = J->g[(n - L + j) * d + i];
        gsl_fft_real_radix2_transform(work, 1, size);
        multiply(J->spectrum[bits], work, size);
        gsl_fft_halfcomplex_radix2_inverse(work, 1, size);
        for (size_t j = 0; j < L && n + j <= N; j++)
            J->sum[(n + j) * d + i] += work[L + j];
    }
    return FVI_SUCCESS;
}
//< blocks

/* c_n g_0 + sum_{j=1}^{n-1} a_{n-j} g_j, coordinate i */
static double history(const integral *J, size_t n, size_t d, size_t i)
{
    double sum = J->c[n] * J->g[i] + J->sum[n * d + i];
    for (size_t j = n < BLOCK ? 1 : n - n % BLOCK; j < n; j++)
        sum += J->a[n - j] * J->g[j * d + i];
    return J->factor * sum;
}

/* ---- the equation of a step ---- */

typedef struct {
    const fvi_run *run;
    size_t d, N;
    integral two, gamma;
    double *work; /* for the transforms */
    double *r, *F, *grad, *delta, *e;
    fvi_newton *newton;
} peer;

/* F at t, from both sides of a jump. */
static int force(peer *o, double t)
{
    const fvi_force *f = &o->run->system->force;
    memset(o->F, 0, o->d * sizeof *o->F);
    if (!f->value)
        return FVI_SUCCESS;
    int status = f->value(t * (1 - 4 * GSL_DBL_EPSILON), o->d, f->params, o->e);
    if (!status)
        status = f->value(t * (1 + 4 * GSL_DBL_EPSILON), o->d, f->params, o->F);
    if (status)
        return status;
    for (size_t i = 0; i < o->d; i++)
        o->F[i] = (o->F[i] + o->e[i]) / 2;
    return FVI_SUCCESS;
}

/* (m + rho A) x - B (F - grad U(x)) = r for x = old x + delta: (2.10), by the solver
 * that our integrators have. */
static int solve(peer *o, double *x)
{
    const fvi_system *s = o->run->system;
    const double A = o->gamma.factor, B = o->two.factor;
    for (size_t i = 0; i < o->d; i++) {
        o->e[i] =
            o->r[i] + B * o->F[i] - (s->mass[i] + s->damping[i] * A) * x[i];
        o->delta[i] = 0;
    }
    int status = fvi_newton_solve(o->newton, x, o->e, o->delta, o->grad);
    for (size_t i = 0; i < o->d; i++)
        x[i] += o->delta[i];
    return status;
}

static int prepare_solver(peer *o)
{
    const fvi_system *s = o->run->system;
    for (size_t i = 0; i < o->d; i++)
        o->e[i] = s->mass[i] + s->damping[i] * o->gamma.factor;
    return fvi_newton_alloc(s, o->e, o->two.factor, 1, &o->newton);
}

/* g_n of both integrals, once x_n is known. */
static int remember(peer *o, size_t n, const double *x)
{
    int status = fvi_gradient(o->run->system, x, o->grad);
    for (size_t i = 0; i < o->d && !status; i++) {
        o->two.g[n * o->d + i] = o->F[i] - o->grad[i];
        o->gamma.g[n * o->d + i] = x[i];
    }
    return status;
}

//> step
static int step(peer *o, size_t n, double *x)
{
    const fvi_run *run = o->run;
    const fvi_system *s = run->system;
    const size_t d = o->d;
    const double t = (double)n * run->h, beta = 2 * run->alpha;
    const double T0 = pow(t, 2 - beta) / tgamma(3 - beta),
                 T1 = beta > 1 ? pow(t, 3 - beta) / tgamma(4 - beta) : 0;
    int status = FVI_SUCCESS;
    if (n % BLOCK == 0)
        status = add_block(&o->two, n, o->N, d, o->work);
    if (n % BLOCK == 0 && !status)
        status = add_block(&o->gamma, n, o->N, d, o->work);
    if (status)
        return status;
    for (size_t i = 0; i < d; i++) {
        double x0 = run->x0[i], v0 = run->p0[i] / s->mass[i];
        o->r[i] =
            s->mass[i] * (x0 + t * v0) + history(&o->two, n, d, i)
            + s->damping[i] * (x0 * T0 + v0 * T1 - history(&o->gamma, n, d, i));
    }
    status = force(o, t);
    memcpy(x + n * d, x + (n - 1) * d, d * sizeof *x);
    if (!status)
        status = solve(o, x + n * d);
    return status ? status : remember(o, n, x + n * d);
}
//< step

int peer_product_trapezoid(const fvi_run *run, double *x)
{
    const size_t d = run->system->d, N = run->steps;
    peer o = { .run = run, .d = d, .N = N };
    int status = prepare(&o.two, 2, run->h, N, d);
    if (prepare(&o.gamma, 2 - 2 * run->alpha, run->h, N, d))
        status = FVI_ENOMEM;
    size_t longest = BLOCK;
    while (longest < 2 * (N + 1))
        longest *= 2;
    o.work = malloc((longest + 5 * d) * sizeof *o.work);
    if (!o.work)
        status = FVI_ENOMEM;
    if (!status) {
        o.r = o.work + longest;
        o.F = o.r + d;
        o.grad = o.F + d;
        o.e = o.grad + d;
        o.delta = o.e + d;
        status = prepare_solver(&o);
    }
    if (!status) {
        memcpy(x, run->x0, d * sizeof *x);
        status = force(&o, 0);
        if (!status)
            status = remember(&o, 0, x);
    }
    for (size_t n = 1; n <= N && !status; n++)
        status = step(&o, n, x);
    free(o.work);
    fvi_newton_free(o.newton);
    release(&o.two);
    release(&o.gamma);
    return status;
}
