/* src/variable_step/variable_step_singular.c -- A start that is not smooth: subtract its singular part. [H 22]
 *
 * A held body, or a body whose past is Riemann and Liouville's, starts with a force of its initial history (19.3):
 *
 *     m x'' + rho D_C^{2 alpha} x + grad U = F - rho A t^{e - 2 alpha} / Gamma(1 + e - 2 alpha),
 *
 * with A = v0 and e = 1, or A = x0 and e = 0. Let c_n = A (-1)^n / Gamma(1 + a_n), a_n = n (2 - 2 alpha) + e. Then the
 * sum G of (22.19) solves m G'' + rho D_C^{2 alpha} G = the force of the initial history, except for the last term of
 * the sum. With enough terms the last term is as smooth as one likes. The method solves for y = x - G.
 *
 * Up to t1 = (m / (2 rho))^{1 / (2 - 2 alpha)} the terms of G fall like 2^-n or faster, and G is handed over to the
 * modes at t1. (If alpha is near 1, other expansions are valid everywhere, and t1 may be anywhere.) G and the jump
 * c_0 = A add to the mode of rate sigma
 *
 *     c_0 e^{-S} + sum_n c_n a_n t1^{a_n} I(a_n, S),              e = 0, times sigma, to y
 *     c_0 e^{-S} + sum_n c_n a_n (a_n - 1) t1^{a_n - 1} I(a_n - 1, S),   e = 1, to z
 *
 * with S = sigma t1 and I(a, S) = int_0^1 e^{-S (1 - u)} u^{a - 1} du. (22.20) */
#include "variable_step.h"

#include "memory/history_kinds.h" /* FVI_VECTORS */
#include "system/fail.h"
#include "system/larger.h"

#include <gsl/gsl_math.h>
#include <stdlib.h>

/* Number of terms. They leave to y at t1 the part 2^-32 of a velocity, or 2^-16 for a loose tolerance, or 2^-8 for six
 * stages. More terms are taken if y would not be smooth. NEGLIGIBLE_BITS: the other expansions leave 2^-56. */
enum { TERMS = 32, TERMS_LOOSE = 16, TERMS_OF_SIX_STAGES = 8, NEGLIGIBLE_BITS = 56 };

/* Return the number of terms of the expansion with falling powers, or 0 if it cannot be used. Long after t1, A t + G is
 *
 *     sum_{n>=1} -A (-m/rho)^n t^{a_n} / Gamma(1 + a_n),   a_n = 1 - n (2 - 2 alpha).
 *
 * This is (22.19) with m/rho in place of rho/m, falling powers, and no term n = 0. The terms returned are accurate to
 * 2^-56 at 1e-30 T, which is before all stages. So no step has to be as short as t1, and the residual force is
 * negligible. There must not be too many terms, and no a_n below 0, where I(a_n - 1, S) of (22.20) has poles. */
static size_t falling_terms(const fvi_singular *g, double slowest, double T)
{
    const double terms =
        ceil(NEGLIGIBLE_BITS * M_LN2 / log(slowest * pow(1e-30 * T, g->gap)));
    return g->e == 1 && terms > 0 && terms <= FVI_SINGULAR_MOST
                   && terms * g->gap < 1
               ? (size_t)terms
               : 0;
}

/* Return the last index N of the terms of Euler's transformation, or 0 if it cannot be used. It is for a short t1 where
 * powers of m/rho do not fall either. Then alpha is near 1, and z = (rho/m) t^{2 - 2 alpha} is not far from P = (rho/m)
 * T^{2 - 2 alpha} at the times of all stages. Euler's transformation of (22.19) about P, with p = P / (1 + P),
 * converges like (p (1 - z/P))^N. It multiplies c_n by w_n = sum_{k=n}^{N} C(k, n) (1 - p)^{n+1} p^{k-n}. The terms
 * cancel by (2 p)^N, so P is at most 3/2. N is for the largest P. */
static size_t euler_terms(const fvi_singular *g, double fastest, double T)
{
    const double P = fastest * pow(T, g->gap), p = P / (1 + P),
                 by = p * (1 - pow(1e-30, g->gap));
    const double terms = ceil(NEGLIGIBLE_BITS * M_LN2 / -log(by));
    return g->e == 1 && g->t1 < 1e-6 * T && P <= 1.5
                   && terms <= FVI_SINGULAR_MOST / 4
               ? (size_t)terms
               : 0;
}

/* Multiply c_n by w_n, n = 0, ..., N. w_n is the probability of more than n heads in N + 1 throws of a coin that shows
 * heads with probability 1 - p. */
static void apply_euler_transform(size_t N, double p, double *c)
{
    double chance = pow(p, (double)N + 1), fewer = chance;
    for (size_t n = 0; n <= N; n++) { /* fewer: the probability of n heads or fewer */
        c[n] *= 1 - fewer;
        chance *= (double)(N + 1 - n) / (double)(n + 1) * (1 - p) / p;
        fewer += chance;
    }
}

/* Find the largest and the smallest rho/m of the coordinates that need a singular part: the amplitude A is not 0, or a
 * derivative by A is wanted. */
static void find_rate_range(const fvi_stepper *s, fvi_variable_step_state *o, double *fastest,
                            double *slowest)
{
    const fvi_system *system = s->run.system;
    *fastest = 0;
    *slowest = GSL_POSINF;
    for (size_t j = 0; j < o->d; j++) {
        const double m = system->mass[j], rho = system->damping[j],
                     A = fvi_initial_history_amplitude(s->run.past, s->run.alpha, s->x[j],
                                            s->p[j] / m);
        if ((A == 0 && !o->for_adjoint) || rho == 0)
            continue;
        *fastest = larger(*fastest, rho / m);
        *slowest = smaller(*slowest, rho / m);
    }
}

int fvi_singular_allocate(size_t d, fvi_singular *g)
{
    g->c = calloc(d * (g->J + 3), sizeof *g->c);
    if (!g->c)
        FVI_FAIL("no memory for the start", FVI_ENOMEM);
    g->ratio = g->c + d * (g->J + 1);
    g->residual_force = g->ratio + d;
    return FVI_SUCCESS;
}

void fvi_singular_fill(const fvi_system *system, double alpha, double T,
                       const double *A, fvi_singular *g)
{
    const int falling = g->gap < 0;
    double gamma[FVI_SINGULAR_MOST + 1];
    for (size_t n = 0; n <= g->J; n++)
        gamma[n] = tgamma(1 + fvi_singular_power(g, n));
    const double last = tgamma(1 + fvi_singular_power(g, g->J) - 2 * alpha);
    for (size_t j = 0; j < system->d; j++) {
        const double m = system->mass[j], rho = system->damping[j];
        double sign = rho == 0 ? 0 : falling ? -A[j] : A[j];
        g->ratio[j] = rho == 0 ? 0 : falling ? m / rho : rho / m;
        for (size_t n = 0; n <= g->J; n++, sign = -sign)
            g->c[j * (g->J + 1) + n] = falling && n == 0 ? 0 : sign / gamma[n];
        g->residual_force[j] = falling || g->by_euler_transform ? 0 : -sign * m / last;
        const double P = g->ratio[j] * pow(T, g->gap);
        if (g->by_euler_transform && rho > 0)
            apply_euler_transform(g->J, P / (1 + P), g->c + j * (g->J + 1));
    }
}

int fvi_singular_start(const fvi_stepper *s, fvi_variable_step_state *o)
{
    const double alpha = s->run.alpha;
    fvi_singular *g = &o->singular;
    double fastest, slowest, *A = o->v; /* o->v has no values yet */
    find_rate_range(s, o, &fastest, &slowest);
    if (fastest == 0 || alpha == 0 || alpha == 1)
        return FVI_SUCCESS;
    g->gap = 2 - 2 * alpha;
    g->e = alpha > 0.5;
    g->J = (size_t)fmin(fmax(ceil((1 + 2 * alpha - g->e) / g->gap),
                             o->rule->s == 6        ? TERMS_OF_SIX_STAGES
                             : o->tolerance > FVI_TOLERANCE_LOOSE ? TERMS_LOOSE
                                                    : TERMS),
                        FVI_SINGULAR_MOST);
    g->t1 = pow(2 * fastest, -1 / g->gap);
    const size_t falling = falling_terms(g, slowest, o->T);
    const size_t euler = falling ? 0 : euler_terms(g, fastest, o->T);
    if (falling)
        g->gap = -g->gap;
    if (falling || euler) {
        g->J = falling + euler;
        g->t1 = 1e-3 * o->T;
        g->by_euler_transform = euler > 0;
    }
    int status = fvi_singular_allocate(o->d, g);
    if (status)
        return status;
    for (size_t j = 0; j < o->d; j++)
        A[j] = fvi_initial_history_amplitude(s->run.past, alpha, s->x[j],
                                  s->p[j] / s->run.system->mass[j]);
    fvi_singular_fill(s->run.system, alpha, o->T, A, g);
    return FVI_SUCCESS;
}

//> at
void fvi_singular_at(const fvi_singular *g, size_t j, double t, double *G,
                     double *slope, double *residual_force)
{
    const double *c = g->c + j * (g->J + 1), q = g->ratio[j] * pow(t, g->gap);
    double value = 0, first = 0, last = 1;
    for (size_t n = g->J; n > 0; n--) {
        value = value * q + c[n];
        first = first * q + c[n] * fvi_singular_power(g, n);
        last *= q;
    }
    if (G)
        *G = g->e == 1 ? value * q * t : value * q;
    if (slope)
        *slope = g->e == 1 ? first * q : first * q / t;
    if (residual_force) /* q^{J + 1} t^{e - 2} */
        *residual_force = g->residual_force[j] * (last * q / (g->e == 1 ? t : t * t));
}
//< at

double fvi_singular_acceleration(const fvi_singular *g, size_t j, double t)
{
    const double *c = g->c + j * (g->J + 1), q = g->ratio[j] * pow(t, g->gap);
    double second = 0;
    for (size_t n = g->J; n > 0; n--) {
        const double a = fvi_singular_power(g, n);
        second = second * q + c[n] * a * (a - 1);
    }
    return g->e == 1 ? second * q / t : second * q / (t * t);
}

/* Compute the part of (22.20) that does not depend on the mode, once for all modes. For small S and for large S
 *
 *     sum_n d_n I(a_n, S) = e^{-S} sum_k B_k S^k,   sum_n d_n I(a_n, S) ~ sum_k D_k / S^{k+1},
 *     B_k = sum_n d_n / (a_n + k) / k!,   D_k = sum_n d_n (1 - a_n) (2 - a_n) ... (k - a_n). */
//> moments
FVI_VECTORS static void sum_near_series(size_t count, const double *d, const double *a,
                                        size_t near, fvi_singular_series *f)
{
    for (size_t k = 0; k < near; k += 4) {
        const double l = (double)k;
        const fvi_four at = { l, l + 1, l + 2, l + 3 };
        fvi_four sum = { 0 };
        for (size_t n = 0; n < count; n++)
            sum += d[n] / (a[n] + at);
        *(fvi_four *)(f->B + k) = sum;
    }
}

void fvi_singular_sums(size_t count, const double *d, const double *a,
                       int coarse, fvi_singular_series *f)
{
    const size_t near = coarse ? FVI_NEAR / 2 : FVI_NEAR;
    double by = 1;
    f->coarse = coarse;
    sum_near_series(count, d, a, near, f);
    for (size_t k = 1; k < near; k++)
        f->B[k] *= by /= (double)k;
    for (size_t k = 0; k < FVI_FAR; k++)
        f->D[k] = 0;
    for (size_t n = 0; n < count; n++) {
        double term = d[n];
        for (size_t k = 0; k < FVI_FAR; term *= (double)++k - a[n])
            f->D[k] += term;
    }
}

void fvi_singular_sums_by_order(size_t count, const double *d, const double *rate,
                        const double *a, fvi_singular_series *f)
{
    double by = 1;
    *f = (fvi_singular_series){ 0 };
    for (size_t k = 0; k < FVI_NEAR; k++, by /= (double)k)
        for (size_t n = 0; n < count; n++) {
            const double at = 1 / (a[n] + (double)k);
            f->B[k] += by * at * (rate[n] - d[n] * at);
        }
    for (size_t n = 0; n < count; n++) {
        double term = d[n], slope = rate[n];
        for (size_t k = 0; k < FVI_FAR; k++) {
            f->D[k] += slope;
            const double next = (double)(k + 1) - a[n];
            slope = slope * next - term;
            term *= next;
        }
    }
}

/* The first series ends where e^{-S} S^k / k! is below 1e-18, from k = 12 + S + 9 sqrt(S) on; coarse: below 1e-8, from
 * k = 6 + S + 6 sqrt(S) on. The terms of the second series fall to 35! / 40^35, below rounding, before they grow;
 * coarse: to 20! / 20^20 = 2e-8. For larger S fewer terms are enough, until S^-k is that small. */
double fvi_singular_moment(const fvi_singular_series *f, double S)
{
    double sum = 0;
    if (S < (f->coarse ? 20 : 40)) {
        const double root = sqrt(S),
                     last = f->coarse ? 6 + S + 6 * root : 12 + S + 9 * root;
        for (size_t k = (size_t)last + 1; k-- > 0;)
            sum = sum * S + f->B[k];
        return exp(-S) * sum;
    }
    int octaves; /* 2^(octaves - 1) <= S; 86 = 20 log2 20, 192 = 36 log2 40 */
    frexp(S, &octaves);
    const double by = 1 / S;
    for (int k = (f->coarse ? 86 : 192) / (octaves - 1) + 1; k-- > 0;)
        if (k < FVI_FAR)
            sum = (sum + f->D[k]) * by;
    return sum;
}
//< moments

//> transfer
/* Compute the series of (22.20) for coordinate j, from d_n and a_n. B_0 takes in the term c_0 e^{-S}, which is
 * negligible in the second series. */
static void mode_series(const fvi_singular *g, size_t j, int coarse,
                        fvi_singular_series *f)
{
    const double *c = g->c + j * (g->J + 1);
    double d[FVI_SINGULAR_MOST], a[FVI_SINGULAR_MOST], q = 1;
    const double by = g->ratio[j] * pow(g->t1, g->gap);
    for (size_t n = 1; n <= g->J; n++) {
        a[n - 1] = fvi_singular_power(g, n) - g->e;
        q *= by;
        d[n - 1] =
            c[n] * fvi_singular_power(g, n) * (g->e == 1 ? a[n - 1] : 1) * q;
    }
    fvi_singular_sums(g->J, d, a, coarse, f);
    f->B[0] += c[0];
}

void fvi_singular_transfer(fvi_variable_step_state *o)
{
    const fvi_singular *g = &o->singular;
    for (size_t j = 0; j < o->d; j++) {
        double G, slope;
        fvi_singular_at(g, j, g->t1, &G, &slope, NULL);
        o->y[j] += G;
        o->v[j] += slope;
    }
    fvi_modes_activate_all(o->modes);
    for (size_t l = 0; l < o->damped; l++) {
        fvi_singular_series f;
        mode_series(g, o->index[l], o->tolerance > FVI_TOLERANCE_LOOSE, &f);
        for (size_t q = 0; q < fvi_modes_count(o->modes); q++) {
            const double sigma = fvi_modes_decay(o->modes, q),
                         more = fvi_singular_moment(&f, sigma * g->t1);
            fvi_modes_add(o->modes, l, q, g->e == 1 ? more : sigma * more);
        }
    }
}
//< transfer
