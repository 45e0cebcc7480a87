/* tests/lobatto/test_lobatto_stability.c -- H 17: the largest stable step, by runs.
 * Run alone: make test-lobatto_stability */
#include "lobatto_load.h"
#include "run/whole_run.h"
#include "lobatto_runs.h"
#include "system/larger.h"

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
        seen(smaller(growth, 1e300), verdict[0] ? "above" : "below");
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
                                   NULL, NULL };
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

int main(void)
{
    Suite *suite = suite_create("lobatto_stability");
    ADD_CASE(suite, "identities", eq_17_15_stable_below_the_first_gap,
             eq_17_16_weak_orders_bound_the_step,
             eq_17_11_strong_damping_is_stable,
             eq_17_18_runs_grow_where_the_load_says_so,
             eq_17_19_the_first_unstable_mode_of_three_stages_is_monotone,
             eq_17_18_a_chain_of_masses);
    return run_suite(suite);
}
