/* tests/stability/test_stability_stages.c -- H 14: the number of growing modes of Lobatto's form M, counted around
 * the circle.
 * Run alone: make test-stability_stages */
#include <fvi/fvi.h>
#include "harness/ulp.h"

#include <complex.h>
#include <gsl/gsl_math.h>
#include <gsl/gsl_rng.h>
#include <gsl/gsl_sf_gamma.h>

enum { MOST = 8 };

/* The stability function N/Q of Lobatto IIIC: Padé's of the exponential, of the degrees
 * s - 2 and s. */
typedef struct {
    size_t s;
    double N[MOST + 1], Q[MOST + 1];
} pade;

static pade pade_of(size_t s)
{
    pade r = { .s = s };
    const unsigned n = (unsigned)s - 2, d = (unsigned)s;
    for (unsigned i = 0; i <= d; i++) {
        const double rest = gsl_sf_fact(n + d - i) / gsl_sf_fact(n + d);
        if (i <= n)
            r.N[i] = rest * gsl_sf_choose(n, i);
        r.Q[i] = (i % 2 ? -1 : 1) * rest * gsl_sf_choose(d, i);
    }
    return r;
}

/* Q - z N and its slope, at lambda. */
static double complex poly(const pade *r, double complex z, double complex at,
                           double complex *slope)
{
    double complex value = 0;
    *slope = 0;
    for (size_t i = r->s + 1; i-- > 0;) {
        *slope = *slope * at + value;
        value = value * at + r->Q[i] - z * r->N[i];
    }
    return value;
}

/* The eigenvalues of Delta(z), from near ones (Aberth's iteration). */
static void eigenvalues(const pade *r, double complex z, double complex *lambda)
{
    double moved = 1;
    for (int turns = 0; moved > 1e-13 && turns < 200; turns++) {
        moved = 0;
        for (size_t j = 0; j < r->s; j++) {
            double complex slope, others = 0,
                                  value = poly(r, z, lambda[j], &slope);
            for (size_t i = 0; i < r->s; i++)
                if (i != j)
                    others += 1 / (lambda[j] - lambda[i]);
            const double complex move = value / (slope - value * others);
            lambda[j] -= move;
            moved = larger(moved, cabs(move));
        }
    }
    ck_assert_double_le(moved, 1e-9);
}

typedef struct {
    double alpha, W, R;
} point;

//> symbol
/* det S(z) on |z| = 1 but for a positive factor: (14.9). */
static double complex symbol(const pade *r, double complex z, const point *q,
                             double complex *lambda)
{
    double complex sum = 0, f[MOST];
    eigenvalues(r, z, lambda);
    for (size_t i = 0; i < r->s; i++) {
        f[i] = lambda[i] * lambda[i] + q->W;
        if (cabs(lambda[i]) > 1e-12) /* at z = 1 one of them is 0 */
            f[i] += q->R * cpow(lambda[i], 2 * q->alpha);
    }
    for (size_t j = 0; j < r->s; j++) {
        double complex term = 1;
        for (size_t i = 0; i < r->s; i++) {
            term *= lambda[j] + conj(lambda[i]);
            if (i != j)
                term *= f[i] / (lambda[j] - lambda[i]);
        }
        sum += term;
    }
    return sum;
}
//< symbol

/* By how much the argument turns from phi = a to b, halved until it turns by little. */
static double turned(const pade *r, const point *q, const double complex *near,
                     const double phi[2], const double complex S[2], int depth)
{
    const double by = carg(S[1] / S[0]);
    if (depth == 0 || fabs(by) < 0.5)
        return by;
    double complex lambda[MOST], middle[2];
    memcpy(lambda, near, sizeof lambda);
    const double half = (phi[0] + phi[1]) / 2;
    middle[0] = middle[1] = symbol(r, cexp(-I * half), q, lambda);
    const double left[] = { phi[0], half }, right[] = { half, phi[1] };
    const double complex first[] = { S[0], middle[0] },
                         second[] = { middle[1], S[1] };
    return turned(r, q, near, left, first, depth - 1)
           + turned(r, q, lambda, right, second, depth - 1);
}

//> count
/* The zeros of det S in |z| < 1, where it has one pole: its argument along the lower half
 * of the circle, z = exp(-i phi); and its signs at both ends. */
static int zeros(const pade *r, const point *q, double ends[2])
{
    enum { PARTS = 200 };
    double complex lambda[MOST], near[MOST], S[2];
    double turn = 0, phi[2] = { 0, 0 };
    for (size_t i = 0; i < r->s; i++)
        lambda[i] = 4 * cpow(0.4 + 0.9 * I, (double)i);
    S[0] = symbol(r, 1, q, lambda);
    ends[0] = creal(S[0]);
    for (int j = 1; j <= PARTS; j++) {
        memcpy(near, lambda, sizeof near);
        phi[1] = M_PI * j / PARTS;
        S[1] = symbol(r, cexp(-I * phi[1]), q, lambda);
        turn += turned(r, q, near, phi, S, 30);
        phi[0] = phi[1];
        S[0] = S[1];
    }
    ends[1] = creal(S[1]);
    return 1 - (int)lround(turn / M_PI);
}
//< count

/* fvi_stability_lobatto for one mass and h = 1: W and R are c and rho. */
static double load_at(size_t s, const point *q)
{
    const double one = 1, zero = 0;
    const fvi_system system = { 1,     &one,
                                &q->R, fvi_potential_harmonic(&q->W),
                                { 0 }, NULL, NULL };
    const fvi_run run = {
        .system = &system, .x0 = &zero, .h = 1, .alpha = q->alpha
    };
    double load = -1;
    ck_assert_int_eq(fvi_stability_lobatto(s, &run, &load), FVI_SUCCESS);
    return load;
}

//> modes
/* 3 to 8 stages at random points, seeded: the modes that grow are one for each end, z = -1 and
 * z = 1, at which det S has changed its sign, and the library's load says when. */
START_TEST(eq_14_9_no_mode_grows_but_those_of_the_two_ends)
{
    enum { POINTS = 1200 };
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    int grow = 0;
    for (int i = 0; i < POINTS; i++) {
        const pade r = pade_of(3 + (size_t)i % 6);
        const double most = i % 12 < 6 ? 1 : 0.5; /* more below 1/2 */
        const point q = { most * (0.001 + 0.998 * gsl_rng_uniform(random)),
                          pow(10, 5 * gsl_rng_uniform(random) - 2),
                          pow(10, 5 * gsl_rng_uniform(random) - 2) };
        double ends[2];
        const int count = zeros(&r, &q, ends), even = r.s % 2 ? -1 : 1,
                  want = (even * ends[0] < 0) + (even * ends[1] > 0);
        ck_assert_msg(count == want && (load_at(r.s, &q) > 1) == (want > 0),
                      "s=%zu alpha=%.17g W=%.17g R=%.17g: %d, not %d, load %g",
                      r.s, q.alpha, q.W, q.R, count, want, load_at(r.s, &q));
        grow += want > 0;
    }
    seen(grow, "points with a growing mode");
    ck_assert(grow > POINTS / 5 && grow < POINTS / 2);
    gsl_rng_free(random);
}
END_TEST
//< modes

/* alpha = 1/2: z det S is a quadratic polynomial, for s = 3 positive at -1 and 1 if and only
 * if W < 24 and (W - 8)(W - 12) + 8 R^2 > 0. Points within 1e-9 of a bound are left out. */
START_TEST(eq_14_10_three_stages_with_friction)
{
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    int grow = 0;
    for (int i = 0; i < 2000; i++) {
        const point q = { 0.5, 30 * gsl_rng_uniform_pos(random),
                          2 * gsl_rng_uniform_pos(random) };
        const double gap = (q.W - 8) * (q.W - 12) + 8 * q.R * q.R,
                     least = smaller(24 - q.W, gap);
        if (fabs(least) < 1e-9)
            continue;
        ck_assert_msg((load_at(3, &q) > 1) == (least < 0), "W=%.17g R=%.17g",
                      q.W, q.R);
        grow += least < 0;
    }
    seen(grow, "points with a growing mode");
    ck_assert_int_ge(grow, 400);
    gsl_rng_free(random);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("14 stability: stages");
    ADD_CASE(suite, "stages", eq_14_9_no_mode_grows_but_those_of_the_two_ends,
             eq_14_10_three_stages_with_friction);
    return run_suite(suite);
}
