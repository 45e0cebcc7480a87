/* tests/lobatto/test_lobatto_load.c -- H 17: the load, compared with properties of the symbol that need no run.
 * Run alone: make test-lobatto_load */
#include <fvi/lobatto.h>

#include "lobatto_load.h"
#include "lobatto_ref.h"
#include "system/larger.h"

#include <complex.h>
#include <gsl/gsl_math.h>
#include <gsl/gsl_rng.h>

/* Against eigenvalues of the symbol from Lagrange's formula at 25 and 45 digits. The
 * tolerance is that of the header, no proof. */
START_TEST(eq_17_18_load_is_where_the_symbol_vanishes)
{
    for (size_t i = 0; i < LEN(ref_loads); i++) {
        const double load = load_at(ref_loads[i].s, ref_loads[i].alpha,
                                    ref_loads[i].W, ref_loads[i].R),
                     scale = larger(1, load);
        seen(fabs(load - ref_loads[i].want) / scale, "relative");
        ck_assert_near(load, ref_loads[i].want, 1e-12 * scale, "row %zu", i);
    }
}
END_TEST

//> count
/* s = 2: the zeros of z P(z) in |z| < 1, P = 1/z - 2 + z + W + R M(z), with M in closed
 * form: Delta(z) has the eigenvalues 1 +- sqrt(2 z - 1). From z = 1 to z = -1 along
 * the lower half of the circle; P has one pole in the disc. What belongs to the points
 * alone is made once for all. */
enum { POINTS = 4096 };
static struct {
    double complex part, plus, minus, odd;
} at[POINTS + 1];

/* What P needs at a point: 1/z - 2 + z, log(1 +- r), and what (a - b)/2 is times. */
static void tabulate(void)
{
    for (int j = 1; j <= POINTS; j++) {
        const double complex z = cexp(-I * M_PI
                                      * gsl_pow_2((double)j / POINTS)),
                             r = csqrt(2 * z - 1);
        at[j].part = 1 / z - 2 + z;
        at[j].plus = clog(1 + r);
        at[j].minus = clog(1 - r);
        at[j].odd = (1 / z - 2 - z) / (2 * r);
    }
}

static int zeros(double alpha, double W, double R)
{
    double turned = 0, last = 0;
    for (int j = 1; j <= POINTS; j++) {
        const double complex a = cexp(2 * alpha * at[j].plus),
                             b = cexp(2 * alpha * at[j].minus),
                             M = (a + b) / 2 + (a - b) / 2 * at[j].odd;
        const double now = carg(at[j].part + W + R * M);
        turned += remainder(now - last, 2 * M_PI);
        last = now;
    }
    return 1 - (int)lround(turned / M_PI);
}

/* The theorem of (17.16), at random points, seeded; a quarter of them is unstable. */
START_TEST(eq_17_16_the_argument_principle_counts_what_the_theorem_says)
{
    enum { RUNS = 2000 };
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    int unstable = 0;
    tabulate();
    for (int i = 0; i < RUNS; i++) {
        const double alpha = 0.001 + 0.998 * gsl_rng_uniform(random),
                     W = pow(10, 3 * gsl_rng_uniform(random) - 2),
                     R = pow(10, 4 * gsl_rng_uniform(random) - 2),
                     bound = W
                             + pow(2, 2 * alpha + 1) / sqrt(3)
                                   * sin((1 - 2 * alpha) * M_PI / 3) * R;
        ck_assert_msg(zeros(alpha, W, R) == (bound > 4)
                          && (load_at(2, alpha, W, R) > 1) == (bound > 4),
                      "alpha=%.17g W=%.17g R=%.17g: %d", alpha, W, R,
                      zeros(alpha, W, R));
        unstable += bound > 4;
    }
    seen(unstable, "unstable points");
    ck_assert(unstable > RUNS / 5 && unstable < RUNS / 2);
    gsl_rng_free(random);
}
END_TEST
//< count

/* s = 3 in closed form, before the first bound: a monotone mode by (17.19), an
 * alternating one by (17.20), at random points. Points within 1e-9 of a bound are
 * left out, as rounding may decide there. */
START_TEST(eq_17_19_three_stages_in_closed_form)
{
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    int grow = 0;
    for (int i = 0; i < 2000; i++) {
        const double alpha = (i % 2 ? 1 : 0.1) * gsl_rng_uniform_pos(random),
                     W = 15 * gsl_rng_uniform_pos(random),
                     R = pow(10, 3 * gsl_rng_uniform(random) - 1),
                     angle = atan(sqrt(5. / 3)),
                     monotone = W
                                + pow(24, alpha) * sin((1 - 2 * alpha) * angle)
                                      / sin(angle) * R
                                - 24;
        double f[3], root = cbrt(40);
        for (int l = 0; l < 3; l++) { /* of (2 + N)^{2 alpha}, N^3 = 40 */
            double complex sum = 0;
            for (int j = 0; j < 3; j++) {
                const double complex w = cexp(2 * M_PI / 3 * I * j);
                sum += cpow(w, -l) * cpow(2 + root * w, 2 * alpha);
            }
            f[l] = creal(sum) / 3 / pow(root, l);
        }
        const double first = W / 3 - 4 + R * (f[0] - 2 * f[1] - 8 * f[2]) / 3,
                     last = 2 * W / 3 - 16. / 3
                            + R * (2 * f[0] - 4 * f[1] - 8 * f[2]) / 3,
                     mixed = R * 4 * (f[1] - 4 * f[2]) / 3,
                     alternating = first * last + mixed * mixed;
        if (smaller(fabs(monotone), fabs(alternating)) < 1e-9 * (1 + R * R))
            continue;
        ck_assert_msg((load_at(3, alpha, W, R) > 1)
                          == (monotone > 0 || alternating < 0),
                      "alpha=%.17g W=%.17g R=%.17g", alpha, W, R);
        grow += monotone > 0 || alternating < 0;
    }
    seen(grow, "growing points");
    ck_assert_int_ge(grow, 300);
    gsl_rng_free(random);
}
END_TEST

/* Of the form (2 x_1, x_1 x_2; x_1 x_2, 5), in more diagonals than it has rows. */
static int wide_hessian(size_t d, const double *z, void *params, double *H)
{
    const size_t m = *(size_t *)params;
    (void)d;
    H[0] = 2 * z[0];
    H[1] = z[0] * z[1];
    H[m] = 5;
    return 0;
}

static int no_gradient(size_t d, const double *z, void *params, double *g)
{
    (void)d, (void)z, (void)params, (void)g;
    return -1;
}

/* The same numbers in 2 and in 40 diagonals, and so the same digits. */
START_TEST(eq_17_18_more_diagonals_than_masses)
{
    const double mass[] = { 1, 2 }, rho[] = { 0.3, 0.1 }, start[] = { 1, -1.5 };
    double step[2], load[2];
    for (size_t i = 0; i < 2; i++) {
        size_t m = i == 0 ? 2 : 40;
        const fvi_system system = { 2,
                                    mass,
                                    rho,
                                    { .value = no_gradient,
                                      .gradient = no_gradient,
                                      .hessian = wide_hessian,
                                      .params = &m,
                                      .diagonals = m },
                                    { 0 },
                                    NULL, NULL };
        const fvi_run run = fvi_run_default(&system, start, start, 0.5, 1);
        ck_assert_int_eq(fvi_stability_lobatto(3, &run, load + i), 0);
        ck_assert_int_eq(fvi_stability_longest_step(&fvi_lobatto_m2, &run, step + i), 0);
    }
    ck_assert_double_eq(load[0], load[1]);
    ck_assert_double_eq(step[0], step[1]);
}
END_TEST

START_TEST(bad_questions_about_stages_are_refused)
{
    const double one = 1, big = 1e300;
    const fvi_system free_particle = { 1, &one, &one, { 0 }, { 0 }, NULL, NULL },
                     harmonic = { 1,     &one,
                                  &one,  fvi_potential_harmonic(&big),
                                  { 0 }, NULL, NULL };
    const fvi_run run = {
        .system = &free_particle, .x0 = &one, .h = 1, .alpha = 0.25
    };
    double load = 7;
    ck_assert_int_eq(fvi_stability_lobatto(2, NULL, &load), FVI_EFAULT);
    ck_assert_int_eq(fvi_stability_lobatto(2, &run, NULL), FVI_EFAULT);
    ck_assert_int_eq(fvi_stability_lobatto(1, &run, &load), FVI_EINVAL);
    ck_assert_int_eq(fvi_stability_lobatto(9, &run, &load), FVI_EINVAL);
    fvi_run bad = run;
    bad.x0 = NULL;
    ck_assert_int_eq(fvi_stability_lobatto(2, &bad, &load), FVI_EFAULT);
    bad = run;
    bad.system = NULL;
    ck_assert_int_eq(fvi_stability_lobatto(2, &bad, &load), FVI_EFAULT);
    const double outside[] = { -0.1, 1.1, GSL_NAN };
    for (size_t i = 0; i < LEN(outside); i++) {
        bad = run;
        bad.alpha = outside[i];
        ck_assert_int_eq(fvi_stability_lobatto(2, &bad, &load), FVI_EDOM);
        bad = run;
        bad.h = i == 0 ? 0 : i == 1 ? GSL_POSINF : GSL_NAN;
        ck_assert_int_eq(fvi_stability_lobatto(2, &bad, &load), FVI_EDOM);
    }
    bad = run;
    bad.alpha = 0;
    bad.h = 1e200;
    ck_assert_int_eq(fvi_stability_lobatto(3, &bad, &load), FVI_EOVRFLW);
    bad.system = &harmonic;
    ck_assert_int_eq(fvi_stability_lobatto(4, &bad, &load), FVI_EOVRFLW);
    ck_assert_double_eq(load, 7);
    /* a free particle: 2^(3/2) sin(pi/6) / sqrt(3) / 4 */
    ck_assert_int_eq(fvi_stability_lobatto(2, &run, &load), FVI_SUCCESS);
    ck_assert_near(load, 1 / sqrt(24), 1e-12, "load");
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("lobatto_load");
    ADD_CASE(suite, "values", eq_17_18_load_is_where_the_symbol_vanishes);
    ADD_CASE(suite, "identities",
             eq_17_16_the_argument_principle_counts_what_the_theorem_says,
             eq_17_19_three_stages_in_closed_form,
             eq_17_18_more_diagonals_than_masses);
    ADD_CASE(suite, "errors", bad_questions_about_stages_are_refused);
    return run_suite(suite);
}
