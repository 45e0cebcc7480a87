/* tests/lobatto/test_lobatto_stability.c -- Chapter 17: how long a step may be.
 * Run alone: make test-lobatto_stability */
#include <fvi/stability.h>
#include "lobatto_runs.h"

#include "lobatto_ref.h"

#include <complex.h>
#include <gsl/gsl_rng.h>

enum { N = 1200 };
static double x[N + 1], p[N + 1];

//> stability
/* (17.15), x'' + x = 0: 2, 2 sqrt(2), sqrt(42 - 6 sqrt(29)), a thousandth below
 * and above: bounded, or growing exponentially. Seen: 22 at most; 3e6 at least. */
START_TEST(eq_17_15_stable_below_the_first_gap)
{
    const double bound[] = { 0, 0, 2, M_SQRT2 * 2, sqrt(42 - 6 * sqrt(29)) };
    for (size_t s = 2; s <= 4; s++)
        for (int above = 0; above <= 1; above++) {
            const setup a = { .s = s,
                              .x0 = 1,
                              .p0 = 1,
                              .h = bound[s] * (above ? 1.001 : 0.999),
                              .steps = N,
                              .cg = { 1, 0 } };
            solve(&a, x, p);
            const double reach = farthest(0, N + 1, x, NULL);
            seen(reach, above ? "above" : "below");
            ck_assert_msg(above ? reach > 1e6 : reach < 100, "s = %zu: %g", s,
                          reach);
        }
}
END_TEST
//< stability

//> damped
/* (17.16), s = 2, W = 1: three hundredths below and above. Seen: 1
 * at most, 1.5e4 at least. */
START_TEST(eq_17_16_weak_orders_bound_the_step)
{
    const double orders[] = { 0, 0.05, 0.25, 0.4 };
    for (size_t i = 0; i < LEN(orders); i++)
        for (int above = 0; above <= 1; above++) {
            const double bound = 3 * sqrt(3) / pow(2, 2 * orders[i] + 1)
                                 / sin((1 - 2 * orders[i]) * M_PI / 3);
            const setup a = { .s = 2,
                              .alpha = orders[i],
                              .rho = bound * (above ? 1.03 : 0.97),
                              .x0 = 1,
                              .h = 1,
                              .steps = N,
                              .cg = { 1, 0 } };
            solve(&a, x, p);
            const double reach = farthest(0, N + 1, x, NULL);
            seen(reach, above ? "above" : "below");
            ck_assert_msg(above ? reach > 1e3 : reach < 2, "alpha = %g: %g",
                          orders[i], reach);
        }
}
END_TEST
//< damped

/* alpha >= 1/2: any damping, here up to R = 1e4, and W just below the bound of
 * rho = 0. A push for one second, then nothing. Seen: 0.33. */
START_TEST(eq_17_11_strong_damping_is_stable)
{
    const double aT[] = { 1, 1 },
                 orders[] = { 0.5, 0.51, 0.6, 0.75, 0.9, 0.99 },
                 W[] = { 0, 0, 3.9, 7.9, 9.6 };
    for (size_t s = 2; s <= 4; s++)
        for (size_t i = 0; i < LEN(orders); i++)
            for (double rho = 1; rho < 2e4; rho *= 10) {
                const setup a = { .s = s,
                                  .alpha = orders[i],
                                  .rho = rho,
                                  .h = 1,
                                  .steps = N,
                                  .cg = { W[s], 0 },
                                  .force = fvi_force_step(aT) };
                solve(&a, x, p);
                const double reach = farthest(0, N + 1, x, NULL);
                seen(reach, "reach");
                ck_assert_double_le(reach, 1);
            }
}
END_TEST

/* ---- the load ---- */

/* fvi_stability_lobatto for one mass and h = 1: W and R are c and rho. */
static double load_at(size_t s, double alpha, double W, double R)
{
    const double one = 1, zero = 0;
    const fvi_system system = { 1,     &one, &R, fvi_potential_harmonic(&W),
                                { 0 }, NULL };
    const fvi_run run = {
        .system = &system, .x0 = &zero, .h = 1, .alpha = alpha
    };
    double load = -1;
    ck_assert_int_eq(fvi_stability_lobatto(s, &run, &load), FVI_SUCCESS);
    return load;
}

/* Against eigenvalues of the symbol from Lagrange's formula at 25 and 45 digits. The
 * tolerance is that of the header, no proof. */
START_TEST(eq_17_18_load_is_where_the_symbol_vanishes)
{
    for (size_t i = 0; i < LEN(ref_loads); i++) {
        const double load = load_at(ref_loads[i].s, ref_loads[i].alpha,
                                    ref_loads[i].W, ref_loads[i].R),
                     scale = fmax(1, load);
        seen(fabs(load - ref_loads[i].want) / scale, "relative");
        ck_assert_near(load, ref_loads[i].want, 1e-12 * scale, "row %zu", i);
    }
}
END_TEST

//> count
/* s = 2: the zeros of z P(z) in |z| < 1, P = 1/z - 2 + z + W + R M(z), with M in closed
 * form: Delta(z) has the eigenvalues 1 +- sqrt(2 z - 1). From z = 1 to z = -1 along
 * the lower half of the circle; P has one pole in the disc. */
static int zeros(double alpha, double W, double R)
{
    enum { POINTS = 4096 };
    double turned = 0, last = 0;
    for (int j = 1; j <= POINTS; j++) {
        const double complex z = cexp(-I * M_PI
                                      * gsl_pow_2((double)j / POINTS)),
                             r = csqrt(2 * z - 1), a = cpow(1 + r, 2 * alpha),
                             b = cpow(1 - r, 2 * alpha),
                             M = (a + b) / 2
                                 + (a - b) / (4 * r) * (1 / z - 2 - z),
                             P = 1 / z - 2 + z + W + R * M;
        turned += remainder(carg(P) - last, 2 * M_PI);
        last = carg(P);
    }
    return 1 - (int)lround(turned / M_PI);
}

/* The theorem of (17.16), at random points, seeded; a quarter of them is unstable. */
START_TEST(eq_17_16_the_argument_principle_counts_what_the_theorem_says)
{
    enum { POINTS = 2000 };
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    int unstable = 0;
    for (int i = 0; i < POINTS; i++) {
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
    ck_assert(unstable > POINTS / 5 && unstable < POINTS / 2);
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
        if (fmin(fabs(monotone), fabs(alternating)) < 1e-9 * (1 + R * R))
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

/* max |x| over the second half of a run, over that of the first. */
static double growth_of(const setup *a)
{
    const int status = try_run(a, x, p);
    if (status == FVI_EOVRFLW)
        return GSL_POSINF;
    ck_assert_int_eq(status, FVI_SUCCESS);
    return farthest(N / 2, N + 1, x, NULL) / farthest(0, N / 2, x, NULL);
}

//> runs
/* What the load says is what runs do, at random points of all s. Where the verdict
 * changes within 5 % of W and R the run is too short to tell, and it is left out.
 * Seen: at most 1.04 where nothing grows, at least 156 where something does. */
START_TEST(eq_17_18_runs_grow_where_the_load_says_so)
{
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    size_t counts[2] = { 0 };
    for (size_t i = 0; i < 600; i++) {
        setup a = { .s = 2 + i % 3,
                    .alpha = 0.01 + 0.98 * gsl_rng_uniform(random),
                    .rho = pow(10, 2.5 * gsl_rng_uniform(random)),
                    .x0 = 0.3,
                    .p0 = 1,
                    .h = 1,
                    .steps = N };
        if (i % 4)
            a.alpha /= 2;
        a.cg[0] = 12 * gsl_pow_2(gsl_rng_uniform_pos(random));
        int verdict[3];
        for (int j = 0; j < 3; j++) {
            const double part = 0.95 + 0.05 * j;
            verdict[j] =
                load_at(a.s, a.alpha, part * a.cg[0], part * a.rho) > 1;
        }
        if (verdict[0] != verdict[1] || verdict[1] != verdict[2])
            continue;
        const double growth = growth_of(&a);
        counts[verdict[0]]++;
        seen(fmin(growth, 1e300), verdict[0] ? "above" : "below");
        ck_assert_msg(verdict[0] ? growth > 5 : growth < 1.1,
                      "s=%zu alpha=%.17g W=%.17g R=%.17g: %g", a.s, a.alpha,
                      a.cg[0], a.rho, growth);
    }
    seen((double)counts[1], "unstable runs");
    ck_assert_uint_ge(counts[0], 100);
    ck_assert_uint_ge(counts[1], 100);
    gsl_rng_free(random);
}
END_TEST
//< runs

/* The first instability of three stages does not alternate: alpha = 1/4, and two
 * hundredths above (17.19) all x_k have one sign; four stages do alternate. */
START_TEST(eq_17_19_the_first_unstable_mode_of_three_stages_is_monotone)
{
    setup a = { .s = 3,
                .alpha = 0.25,
                .rho = 19.8,
                .p0 = 1,
                .h = 1,
                .steps = N,
                .cg = { 0.001, 0 } };
    for (; a.s <= 4; a.s++, a.rho = 47.5) {
        ck_assert_double_gt(growth_of(&a), 1e3);
        for (size_t k = N - 100; k < N; k++)
            ck_assert_int_eq(x[k + 1] / x[k] > 0, a.s == 3);
    }
}
END_TEST

/* A chain of three, unequal masses and dampings, s = 2; equal ones, all s. The h
 * of load 1 by bisection; runs of 2000 steps two hundredths below and above. */
static double chain_step(size_t s, fvi_run *run)
{
    double low = 1e-3, high = 100, load;
    while (high - low > 1e-9 * low) {
        run->h = sqrt(low * high);
        ck_assert_int_eq(fvi_stability_lobatto(s, run, &load), FVI_SUCCESS);
        if (load > 1)
            high = run->h;
        else
            low = run->h;
    }
    return low;
}

START_TEST(eq_17_18_a_chain_of_masses)
{
    enum { D = 3, STEPS = 2000 };
    const double unequal[] = { 1, 2, 0.5 }, some[] = { 5, 0, 9 },
                 equal[] = { 2, 2, 2 }, all[] = { 7, 7, 7 },
                 spring[] = { 1, 0 }, start[D] = { 0 }, kick[] = { 1, -1, 0.5 };
    static double path[D * (STEPS + 1)];
    for (size_t s = 2; s <= 5; s++) {
        const fvi_system chain = { D,
                                   s < 5 ? equal : unequal,
                                   s < 5 ? all : some,
                                   fvi_potential_chain(spring),
                                   { 0 },
                                   NULL };
        const size_t stages = s < 5 ? s : 2;
        fvi_run run = { .system = &chain,
                        .x0 = start,
                        .p0 = kick,
                        .steps = STEPS,
                        .alpha = 0.2 };
        const double step = chain_step(stages, &run);
        for (int above = 0; above <= 1; above++) {
            run.h = step * (above ? 1.02 : 0.98);
            ck_assert_int_eq(
                fvi_trajectory(methods[stages], &run, path, NULL, NULL), 0);
            const double end =
                farthest(D * (STEPS - 10), D * STEPS, path, NULL);
            seen(end, above ? "above" : "below");
            ck_assert_msg(above ? end > 1e3 : end < 1, "s = %zu: %g", s, end);
        }
    }
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
                                    NULL };
        const fvi_run run = fvi_run_default(&system, start, start, 0.5, 1);
        ck_assert_int_eq(fvi_stability_lobatto(3, &run, load + i), 0);
        ck_assert_int_eq(fvi_stability_step(&fvi_lobatto2, &run, step + i), 0);
    }
    ck_assert_double_eq(load[0], load[1]);
    ck_assert_double_eq(step[0], step[1]);
}
END_TEST

START_TEST(bad_questions_about_stages_are_refused)
{
    const double one = 1, big = 1e300;
    const fvi_system free_particle = { 1, &one, &one, { 0 }, { 0 }, NULL },
                     harmonic = { 1,     &one,
                                  &one,  fvi_potential_harmonic(&big),
                                  { 0 }, NULL };
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
    Suite *suite = suite_create("lobatto_stability");
    ADD_CASE(suite, "values", eq_17_18_load_is_where_the_symbol_vanishes);
    ADD_CASE(suite, "identities", eq_17_15_stable_below_the_first_gap,
             eq_17_16_weak_orders_bound_the_step,
             eq_17_11_strong_damping_is_stable,
             eq_17_16_the_argument_principle_counts_what_the_theorem_says,
             eq_17_19_three_stages_in_closed_form,
             eq_17_18_runs_grow_where_the_load_says_so,
             eq_17_19_the_first_unstable_mode_of_three_stages_is_monotone,
             eq_17_18_more_diagonals_than_masses, eq_17_18_a_chain_of_masses);
    ADD_CASE(suite, "errors", bad_questions_about_stages_are_refused);
    return run_suite(suite);
}
