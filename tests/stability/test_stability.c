/* tests/stability/test_stability.c -- Chapter 14.     Run alone: make test-stability */
#include <fvi/fvi.h>
#include "harness/ulp.h"

#include "stability_ref.h"

#include <gsl/gsl_math.h>
#include <gsl/gsl_rng.h>
#include <stdlib.h>

/* A run of the scalar problem with given W, R and h = m = 1. */
static double m = 1, c, rho, x0, p0 = 1;
static fvi_system scalar;

static fvi_run scalar_run(double alpha, double kappa, double W, double R,
                          size_t steps)
{
    c = W;
    rho = R;
    scalar = (fvi_system){ 1, &m, &rho, fvi_potential_harmonic(&c), { 0 } };
    return (fvi_run){ .system = &scalar,
                      .x0 = &x0,
                      .p0 = &p0,
                      .h = 1,
                      .steps = steps,
                      .kappa = kappa,
                      .alpha = alpha };
}

/* Largest |x_k| over the first half, and over the rest, of N steps. */
static void halves(const fvi_run *run, double *first, double *second)
{
    double *x = malloc((run->steps + 1) * sizeof *x);
    ck_assert_ptr_nonnull(x);
    ck_assert_int_eq(fvi_trajectory(&fvi_fractional, run, x, NULL, NULL),
                     FVI_SUCCESS);
    *first = *second = 0;
    for (size_t k = 0; k <= run->steps; k++) {
        double *half = k <= run->steps / 2 ? first : second;
        *half = fmax(*half, fabs(x[k]));
    }
    free(x);
}

/* (14.5) in a run, from the last 500 of 5000 steps. When they begin the growing
 * mode has reached 1e9 and more; the rest, below 10, is all that blurs it. And
 * ln(growth) is good to 32 ulp of growth, 64 u. Seen: 0.53 of it. */
static void check_growth(double alpha, double kappa, double W, double R)
{
    enum { FROM = 4500, TO = 5000 };
    double x[TO + 1], growth;
    const fvi_run run = scalar_run(alpha, kappa, W, R, TO);
    ck_assert_int_eq(fvi_growth(alpha, kappa, W, R, &growth), FVI_SUCCESS);
    ck_assert_int_eq(fvi_trajectory(&fvi_fractional, &run, x, NULL, NULL),
                     FVI_SUCCESS);
    ck_assert(fabs(x[FROM]) > 1e9);
    ck_assert_near(log(fabs(x[TO] / x[FROM])) / (TO - FROM), log(growth),
                   2 * 10 / fabs(x[FROM]) / (TO - FROM) + 64 * U,
                   "outside: alpha=%g kappa=%g W=%g", alpha, kappa, W);
}

/* (14.5). Q is computed with a relative error of some u of its terms, and is
 * steep at the root: z is good to 32 ulp here. Seen: 4 ulp. */
START_TEST(eq_14_5_growth_is_the_root_of_the_symbol)
{
    for (size_t i = 0; i < LEN(ref_growth); i++) {
        double growth = 0;
        ck_assert_int_eq(fvi_growth(ref_growth[i].alpha, ref_growth[i].kappa,
                                    ref_growth[i].W, ref_growth[i].R, &growth),
                         FVI_SUCCESS);
        ck_assert_ulp(growth, ref_growth[i].want, 32, "row %zu", i);
    }
}
END_TEST

/* (14.3) in numbers: the bounds that the chapter's table prints. */
START_TEST(eq_14_3_load_of_single_oscillators)
{
    /* alpha, kappa, W, R, load: R / 4^{1-alpha} + W (1 - 2 kappa)^2 / 4 */
    const double row[][5] = {
        { 0, 0.5, 3, 4, 1 },    { 0.25, 0.5, 1, 2 * M_SQRT2, 1 },
        { 0.5, 0.5, 9, 2, 1 },  { 0.75, 0.5, 1, M_SQRT2, 1 },
        { 1, 0.5, 7, 1, 1 },    { 0.5, 0, 2, 1, 1 },
        { 0.5, 1, 2, 1, 1 },    { 0.5, 0.25, 4, 1.5, 1 },
        { 1, 0, 1, 0.5, 0.75 }, { 0.5, 0.5, 1, 0.1, 0.05 }
    };
    for (size_t i = 0; i < LEN(row); i++) {
        const fvi_run run =
            scalar_run(row[i][0], row[i][1], row[i][2], row[i][3], 1);
        double load = 0;
        ck_assert_int_eq(fvi_stability_load(&fvi_fractional, &run, &load),
                         FVI_SUCCESS);
        ck_assert_near(load, row[i][4], 8 * U * row[i][4], "row %zu", i);
    }
    /* no potential, kappa = 0: 2 rho h / 4, in exact numbers */
    fvi_run run = scalar_run(0.5, 0, 1, 1, 1);
    scalar.potential = (fvi_potential){ 0 };
    double load = 0;
    ck_assert_int_eq(fvi_stability_load(&fvi_fractional, &run, &load),
                     FVI_SUCCESS);
    ck_assert_double_eq(load, 0.5);
}
END_TEST

/* A nonlinear spring counts with its stiffness at the start, c + 3 g x0^2 = 13, not
 * at the origin: h^2 13 / 4 + 2 rho h / 4 at kappa = 0, alpha = 1/2. */
START_TEST(eq_14_3_load_of_a_nonlinear_spring_is_that_at_the_start)
{
    const double one = 1, damping = 0.5, start = 2, cg[2] = { 1, 1 };
    const fvi_system system = {
        1, &one, &damping, fvi_potential_duffing(cg), { 0 }
    };
    const fvi_run run = { .system = &system,
                          .x0 = &start,
                          .p0 = &one,
                          .h = 0.1,
                          .steps = 1,
                          .kappa = 0,
                          .alpha = 0.5 };
    double load = 0;
    ck_assert_int_eq(fvi_stability_load(&fvi_fractional, &run, &load),
                     FVI_SUCCESS);
    ck_assert_near(load, 0.13 / 4 + 0.1 / 4, 8 * U, "load");
}
END_TEST

/* h enters as h^2 c / m and rho h^(2 - 2 alpha) / m: Bagley-Torvik's step is 2,
 * linear damping's 2 m / rho, and alpha = 1 has all steps or none. */
START_TEST(eq_14_4_largest_step)
{
    fvi_run run = scalar_run(0.75, 0.5, 1, 1, 1);
    double step = 0;
    ck_assert_int_eq(fvi_stability_step(&fvi_fractional, &run, &step),
                     FVI_SUCCESS);
    ck_assert_near(step, 2, 8 * GSL_DBL_EPSILON * 2, "Bagley-Torvik");
    run = scalar_run(0.5, 0.5, 1, 0.25, 1);
    ck_assert_int_eq(fvi_stability_step(&fvi_fractional, &run, &step),
                     FVI_SUCCESS);
    ck_assert_near(step, 8, 8 * GSL_DBL_EPSILON * 8, "linear damping");
    run = scalar_run(0.5, 0, 1, 1, 1); /* h^2 + 2 h = 4 */
    ck_assert_int_eq(fvi_stability_step(&fvi_fractional, &run, &step),
                     FVI_SUCCESS);
    ck_assert_near(step, sqrt(5) - 1, 8 * GSL_DBL_EPSILON * 2, "kappa = 0");
    run = scalar_run(1, 0.5, 1, 0.999, 1);
    ck_assert_int_eq(fvi_stability_step(&fvi_fractional, &run, &step),
                     FVI_SUCCESS);
    ck_assert(step == GSL_POSINF);
    run = scalar_run(1, 0.5, 1, 1.001, 1);
    ck_assert_int_eq(fvi_stability_step(&fvi_fractional, &run, &step),
                     FVI_SUCCESS);
    ck_assert(step == 0);
    m = 0.1; /* the load overflows on the way; the step is 2e-154.5, and tiny */
    run = scalar_run(0, 0.5, 1, 1e308, 1);
    ck_assert_int_eq(fvi_stability_step(&fvi_fractional, &run, &step),
                     FVI_SUCCESS);
    m = 1;
    ck_assert(step < 1e-150);
}
END_TEST

/* The argument principle against the formula, at seeded random points. */
START_TEST(eq_14_3_the_argument_principle_counts_what_the_theorem_says)
{
    enum { POINTS = 4000 };
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    size_t unstable = 0;
    //> argument
    for (int i = 0; i < POINTS; i++) {
        double alpha = gsl_rng_uniform_pos(random),
               kappa = gsl_rng_uniform(random);
        double W = pow(10, 4 * gsl_rng_uniform(random) - 2);
        double R = pow(10, 4 * gsl_rng_uniform(random) - 2), load, growth;
        int modes = -1;
        const fvi_run run = scalar_run(alpha, kappa, W, R, 1);
        ck_assert_int_eq(fvi_stability_load(&fvi_fractional, &run, &load),
                         FVI_SUCCESS);
        ck_assert_int_eq(fvi_unstable_modes(alpha, kappa, W, R, &modes),
                         FVI_SUCCESS);
        ck_assert_int_eq(fvi_growth(alpha, kappa, W, R, &growth), FVI_SUCCESS);
        ck_assert_msg(
            modes == (load > 1) && (growth > 1) == (load > 1),
            "alpha=%g kappa=%g W=%g R=%g: %d modes, load %g, growth %g", alpha,
            kappa, W, R, modes, load, growth);
        unstable += load > 1;
    }
    //< argument
    ck_assert(unstable > POINTS / 4 && unstable < POINTS * 3 / 4);
    seen((double)unstable, "unstable points");
    gsl_rng_free(random);
}
END_TEST

/* Long runs, half a percent inside and outside. Inside, the second half stays
 * below the first; alpha = 0 is neutral, a sampled oscillation, whose halves are
 * equal to 1 %. */
START_TEST(eq_14_3_long_runs_on_both_sides_of_the_boundary)
{
    const double alphas[] = { 0, 0.25, 0.5, 0.75, 1 },
                 kappas[] = { 0, 0.25, 0.5 };
    const double Ws[] = { 0.01, 0.5, 2, 3 };
    for (size_t i = 0; i < LEN(alphas); i++)
        for (size_t j = 0; j < LEN(kappas); j++)
            for (size_t l = 0; l < LEN(Ws); l++) {
                double a = alphas[i], k = kappas[j], W = Ws[l], first, second;
                double R = (4 - W * gsl_pow_2(1 - 2 * k)) / pow(4, a);
                fvi_run run = scalar_run(a, k, W, 0.995 * R, 6000);
                halves(&run, &first, &second);
                ck_assert_msg(second <= (a > 0 ? 1 : 1.01) * first,
                              "inside: alpha=%g kappa=%g W=%g: %g then %g", a,
                              k, W, first, second);
                check_growth(a, k, W, 1.005 * R);
            }
}
END_TEST

/* Two per cent outside, as in the figure: how much a thousand steps grow. */
START_TEST(eq_14_5_two_per_cent_outside_a_run_is_lost)
{
    for (double alpha = 0.25; alpha < 1; alpha += 0.25) {
        double growth = 0, R = 1.02 * pow(4, 1 - alpha);
        ck_assert_int_eq(fvi_growth(alpha, 0.5, 1, R, &growth), FVI_SUCCESS);
        ck_assert(pow(growth, 1000) > 1e10);
        seen(pow(growth, 1000), "growth");
    }
}
END_TEST

/* A uniform chain without damping: K has the eigenvalues 4 c sin^2(j pi/(2 (d + 1))), and
 * the load is h^2 / 4 times the largest, at kappa = 0. Each pivot has three roundings of
 * terms up to 4 c: 3 u of that in the matrix, as much for the sine. Seen: 0.2 of it. */
START_TEST(eq_14_3_long_chains)
{
    enum { D = 100000 };
    static const size_t sizes[] = { 1, 2, 3, 50, D };
    static double one[D], zero[D];
    for (size_t i = 0; i < D; i++)
        one[i] = 1;
    const double spring[] = { 3, 0 }, h = 0.5;
    for (size_t i = 0; i < LEN(sizes); i++) {
        const size_t d = sizes[i];
        const fvi_system chain = {
            d, one, zero, fvi_potential_chain(spring), { 0 }
        };
        const fvi_run run = {
            .system = &chain, .x0 = zero, .h = h, .alpha = 0.5
        };
        double load, s = sin((double)d * M_PI / (2 * (double)(d + 1)));
        ck_assert_int_eq(fvi_stability_load(&fvi_fractional, &run, &load),
                         FVI_SUCCESS);
        ck_assert_near(load, h * h * spring[0] * s * s,
                       8 * U * h * h * spring[0], "d = %zu", d);
    }
}
END_TEST

static int full_chain_hessian(size_t d, const double *x, void *params,
                              double *H)
{
    const double none[5] = { 0 };
    const fvi_system chain = {
        d, none, none, fvi_potential_chain(params), { 0 }
    };
    fvi_hessian(&chain, x, H);
    return 0;
}

/* In R^d: a chain of five, unequal dampings. The largest step from the matrix,
 * then runs just inside and outside of it. */
START_TEST(eq_14_3_a_chain_of_masses)
{
    const double mass[] = { 1, 2, 0.5, 1, 3 },
                 damping[] = { 0.3, 0, 1, 0.2, 2 };
    const double spring[] = { 1, 0 }, start[] = { 0, 0, 0, 0, 0 };
    const double kick[] = { 1, -1, 0.5, 0.2, 1 };
    const fvi_system chain = {
        5, mass, damping, fvi_potential_chain(spring), { 0 }
    };
    fvi_run run = { .system = &chain,
                    .x0 = start,
                    .p0 = kick,
                    .steps = 4000,
                    .alpha = 0.3,
                    .kappa = 0 };
    double step, load, last[5 * 4001];
    ck_assert_int_eq(fvi_stability_step(&fvi_fractional, &run, &step),
                     FVI_SUCCESS);
    for (int outside = 0; outside <= 1; outside++) {
        run.h = step * (outside ? 1.01 : 0.99);
        ck_assert_int_eq(fvi_stability_load(&fvi_fractional, &run, &load),
                         FVI_SUCCESS);
        ck_assert_int_eq(load > 1, outside);
        ck_assert_int_eq(
            fvi_trajectory(&fvi_fractional, &run, last, NULL, NULL),
            FVI_SUCCESS);
        double end = 0;
        for (size_t i = 0; i < 5; i++)
            end = fmax(end, fabs(last[5 * 4000 + i]));
        ck_assert_msg(outside ? end > 1e6 : end < 1, "h = %g: %g", run.h, end);
    }
    fvi_system full = chain; /* by another road to the eigenvalues */
    full.potential.hessian = full_chain_hessian;
    full.potential.diagonals = 0;
    run.system = &full;
    double again;
    ck_assert_int_eq(fvi_stability_load(&fvi_fractional, &run, &again),
                     FVI_SUCCESS);
    ck_assert_near(again, load, 5 * 8 * U * load, "a full Hessian");
}
END_TEST

START_TEST(bad_questions_are_refused_and_outputs_are_untouched)
{
    fvi_run run = scalar_run(0.5, 0.5, 1, 1, 1);
    double kept = 7;
    int modes = 7;
    int (*const both[])(const fvi_method *, const fvi_run *,
                        double *) = { fvi_stability_load, fvi_stability_step };
    const fvi_method *const fvi = &fvi_fractional;
    for (size_t i = 0; i < 2; i++) {
        fvi_run bad = run;
        ck_assert_int_eq(both[i](NULL, &run, &kept), FVI_EFAULT);
        ck_assert_int_eq(both[i](fvi, NULL, &kept), FVI_EFAULT);
        ck_assert_int_eq(both[i](fvi, &run, NULL), FVI_EFAULT);
        bad.x0 = NULL;
        ck_assert_int_eq(both[i](fvi, &bad, &kept), FVI_EFAULT);
        bad = run;
        bad.system = NULL;
        ck_assert_int_eq(both[i](fvi, &bad, &kept), FVI_EFAULT);
        const double outside[] = { -0.1, 1.1, GSL_NAN };
        for (size_t j = 0; j < LEN(outside); j++) {
            bad = run;
            bad.kappa = outside[j];
            ck_assert_int_eq(both[i](fvi, &bad, &kept), FVI_EDOM);
            bad = run;
            bad.alpha = outside[j];
            ck_assert_int_eq(both[i](fvi, &bad, &kept), FVI_EDOM);
        }
    }
    fvi_run bad = run;
    bad.h = 0;
    ck_assert_int_eq(fvi_stability_load(&fvi_fractional, &bad, &kept),
                     FVI_EDOM);
    bad.h = 1e300;
    bad.alpha = 0;
    ck_assert_int_eq(fvi_stability_load(&fvi_fractional, &bad, &kept),
                     FVI_EOVRFLW);
    bad.kappa = 0;
    ck_assert_int_eq(fvi_stability_load(&fvi_fractional, &bad, &kept),
                     FVI_EOVRFLW);

    const double wrong[][4] = { { -0.1, 0.5, 1, 1 },        { 1.1, 0.5, 1, 1 },
                                { 0.5, -0.1, 1, 1 },        { 0.5, 1.1, 1, 1 },
                                { 0.5, 0.5, 0, 1 },         { 0.5, 0.5, 1, 0 },
                                { 0.5, 0.5, 1, GSL_POSINF } };
    for (size_t i = 0; i < LEN(wrong); i++) {
        const double *w = wrong[i];
        ck_assert_int_eq(fvi_unstable_modes(w[0], w[1], w[2], w[3], &modes),
                         FVI_EDOM);
        ck_assert_int_eq(fvi_growth(w[0], w[1], w[2], w[3], &kept), FVI_EDOM);
    }
    ck_assert_int_eq(fvi_unstable_modes(0.5, 0.5, 1, 1, NULL), FVI_EFAULT);
    ck_assert_int_eq(fvi_growth(0.5, 0.5, 1, 1, NULL), FVI_EFAULT);
    ck_assert(kept == 7 && modes == 7);
}
END_TEST

/* The Hessian has 2^44 numbers; kappa = 1/2 needs none. */
START_TEST(a_hessian_that_finds_no_room_is_reported)
{
    enum { D = 1 << 22 };
    double *ones = malloc(D * sizeof *ones), kept = 7;
    ck_assert_ptr_nonnull(ones);
    for (size_t i = 0; i < D; i++)
        ones[i] = 1;
    fvi_system system = { D, ones, ones, fvi_potential_harmonic(ones), { 0 } };
    system.potential.diagonals = 0; /* it is never asked for */
    fvi_run run = { .system = &system, .x0 = ones, .h = 1, .alpha = 0.5 };
    ck_assert_int_eq(fvi_stability_load(&fvi_fractional, &run, &kept),
                     FVI_ENOMEM);
    ck_assert_int_eq(fvi_stability_step(&fvi_fractional, &run, &kept),
                     FVI_ENOMEM);
    ck_assert_double_eq(kept, 7);
    run.kappa = 0.5;
    ck_assert_int_eq(fvi_stability_load(&fvi_fractional, &run, &kept),
                     FVI_SUCCESS);
    ck_assert_double_eq(kept, 0.5);
    free(ones);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("14 stability");
    ADD_CASE(suite, "values", eq_14_5_growth_is_the_root_of_the_symbol,
             eq_14_5_two_per_cent_outside_a_run_is_lost,
             eq_14_3_load_of_single_oscillators,
             eq_14_3_load_of_a_nonlinear_spring_is_that_at_the_start,
             eq_14_4_largest_step);
    ADD_CASE(suite, "identities",
             eq_14_3_the_argument_principle_counts_what_the_theorem_says,
             eq_14_3_long_runs_on_both_sides_of_the_boundary,
             eq_14_3_a_chain_of_masses, eq_14_3_long_chains);
    ADD_CASE(suite, "errors",
             bad_questions_are_refused_and_outputs_are_untouched,
             a_hessian_that_finds_no_room_is_reported);
    return run_suite(suite);
}
