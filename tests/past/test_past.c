/* tests/past/test_past.c -- H 19: impulses of the past, pasts that coincide, energy.
 * Run alone: make test-past */
#include "past_runs.h"
#include "run/whole_run.h"

#include "past_ref.h"

#include <gsl/gsl_integration.h>
#include <gsl/gsl_rng.h>

enum { N = 200 };
static double x[N + 1], p[N + 1], other_x[N + 1], other_p[N + 1];

/* ---- the impulses ---- */

/* (19.5): 16 u of the sum of one step, k from 0 to 10^9, for two to eight of Lobatto's
 * nodes. By powers of s in the place of Legendre's polynomials the first step is off by
 * 3700 u with n = 8; without Newton's step for their coefficients, by 240 u. */
START_TEST(eq_19_5_impulses_are_the_integrals)
{
    for (size_t i = 0; i < LEN(ref_impulses); i++) {
        const double alpha = ref_impulses[i].alpha;
        const size_t n = ref_impulses[i].n, k = ref_impulses[i].k;
        fvi_kernel_impulse table;
        double b[FVI_KERNEL_IMPULSE_NODES], sum = 0;
        fvi_kernel_impulse_prepare(alpha, n, ref_nodes[n - 2].c, &table);
        fvi_kernel_impulses(&table, k, b);
        for (size_t j = 0; j < n; j++)
            sum += fabs(ref_impulses[i].b[j]);
        for (size_t j = 0; j < n; j++)
            if (sum > 0) {
                ck_assert_near(b[j], ref_impulses[i].b[j], 16 * U * sum,
                               "alpha = %.17g, n = %zu, k = %zu, node %zu",
                               alpha, n, k, j);
                seen_worst(fabs(b[j] - ref_impulses[i].b[j]) / U / sum, "in u");
                ck_assert(b[j] == 0 || ref_impulses[i].b[j] != 0);
            } else
                ck_assert(b[j] == 0);
    }
}
END_TEST

/* They are exact for what they multiply if that is a polynomial of degree n - 1:
 * sum b_i c_i^q is the integral of s^q (k + s)^e / Gamma(1 + e). For k = 0 that is
 * 1 / ((1 + e + q) Gamma(1 + e)). 8 u of the sum for each of the n. */
START_TEST(eq_19_5_they_are_exact_on_polynomials)
{
    const double alphas[] = { 0, 0.2, 0.49, 0.51, 0.7, 0.95 };
    for (size_t i = 0; i < LEN(alphas); i++)
        for (size_t n = 2; n <= FVI_KERNEL_IMPULSE_NODES; n++)
            for (size_t q = 0; q < n; q++) {
                fvi_kernel_impulse table;
                double b[FVI_KERNEL_IMPULSE_NODES], sum = 0, all = 0;
                fvi_kernel_impulse_prepare(alphas[i], n, ref_nodes[n - 2].c, &table);
                fvi_kernel_impulses(&table, 0, b);
                for (size_t j = 0; j < n; j++) {
                    sum +=
                        b[j] * gsl_pow_uint(ref_nodes[n - 2].c[j], (unsigned)q);
                    all += fabs(b[j]);
                }
                const double e =
                    alphas[i] < 0.5 ? -2 * alphas[i] : 1 - 2 * alphas[i];
                ck_assert_near(sum, 1 / (1 + e + (double)q) / tgamma(1 + e),
                               8 * (double)n * U * all, "alpha=%g n=%zu q=%zu",
                               alphas[i], n, q);
            }
}
END_TEST

/* ---- pasts that are one ---- */

static int same_bits(const problem *q, const fvi_method *method, fvi_initial_history past)
{
    problem r = *q;
    r.past = past;
    solve(method, q, 0.05, N, x, p);
    solve(method, &r, 0.05, N, other_x, other_p);
    return memcmp(x, other_x, sizeof x) == 0
           && memcmp(p, other_p, sizeof p) == 0;
}

/* The same bits: held = Riemann-Liouville from the origin, and at alpha = 1/2;
 * held = Caputo for 2 alpha <= 1, and without a velocity; and not otherwise. */
START_TEST(eq_19_1_where_two_pasts_are_one)
{
    const double alphas[] = { 0, 0.1, 0.3, 0.5, 0.6, 0.9 };
    for (size_t i = 0; i < LEN(alphas) * METHODS; i++) {
        const double alpha = alphas[i / METHODS];
        const fvi_method *method = methods[i % METHODS];
        problem q = { FVI_INITIAL_HISTORY_HELD, alpha, 0.2, 1, 0.5, { 1, 0.5 } };
        const int low = alpha <= 0.5, half = alpha == 0.5;
        ck_assert_int_eq(same_bits(&q, method, FVI_INITIAL_HISTORY_CAPUTO), low);
        if (low)
            ck_assert_int_eq(same_bits(&q, method, FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE),
                             half);
        q.p0 = 0;
        ck_assert(same_bits(&q, method, FVI_INITIAL_HISTORY_CAPUTO));
        q.p0 = 0.5;
        q.x0 = 0;
        ck_assert(same_bits(&q, method, FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE));
        ck_assert_int_eq(same_bits(&q, method, FVI_INITIAL_HISTORY_CAPUTO), low);
    }
}
END_TEST

/* Four times the mass, the spring, the damping and the momentum: no bit of x moves. */
START_TEST(eq_19_3_units_of_mass_do_not_matter)
{
    const double mass = 4, rho = 0.8, c = 4, p0 = 2;
    for (size_t i = 0; i < METHODS * LEN(pasts) * 2; i++) {
        const problem q = { pasts[i / METHODS % LEN(pasts)],
                            i < METHODS * LEN(pasts) ? 0.3 : 0.8,
                            0.2,
                            i < METHODS * LEN(pasts) ? 1 : 0,
                            0.5,
                            { 1, 0 } };
        const fvi_system system = { .d = 1,
                                    .mass = &mass,
                                    .damping = &rho,
                                    .potential = fvi_potential_harmonic(&c) };
        fvi_run run = fvi_run_default(&system, &q.x0, &p0, 0.05, N);
        run.alpha = q.alpha;
        run.past = q.past;
        solve(methods[i % METHODS], &q, 0.05, N, x, p);
        ck_assert_int_eq(
            fvi_trajectory(methods[i % METHODS], &run, other_x, other_p, NULL),
            0);
        for (size_t k = 0; k <= N; k++) {
            ck_assert_ulp(other_x[k], x[k], 0, "x, %zu", i);
            ck_assert_ulp(other_p[k], 4 * p[k], 0, "p, %zu", i);
        }
    }
}
END_TEST

/* ---- alpha = 1/2 and alpha = 1 ---- */

/* Duffing, m = c = 1, g = 1/2, rho = 2/5, x0 = 1, p0 = 1/2: x(20) a millionth above
 * alpha = 1/2. Held moves by as little; Caputo's other equation by 0.19. */
START_TEST(eq_19_6_caputo_jumps_at_one_half_and_held_does_not)
{
    static double long_x[2001];
    const double step = 1e-6;
    problem q = { FVI_INITIAL_HISTORY_HELD, 0.5, 0.4, 1, 0.5, { 1, 0.5 } };
    double at[3];
    for (size_t i = 0; i < 3; i++) { /* 1/2, held, Caputo */
        q.alpha = i == 0 ? 0.5 : 0.5 + step;
        q.past = i == 2 ? FVI_INITIAL_HISTORY_CAPUTO : FVI_INITIAL_HISTORY_HELD;
        solve(&fvi_lobatto_m4, &q, 0.01, 2000, long_x, NULL);
        at[i] = long_x[2000];
    }
    seen(at[0], "one half");
    seen(at[2], "Caputo");
    seen(fabs(at[1] - at[0]), "held moves by");
    ck_assert_near(at[0], 0.014313, 5e-7, "alpha = 1/2");
    ck_assert_near(at[2], 0.202491, 5e-7, "Caputo");
    ck_assert_near(at[1], at[0], 10 * step, "held");
}
END_TEST

/* (19.6), linear: held's x is Lipschitz in alpha, with a constant below 10 for these
 * t <= 32, at 1/2 as elsewhere and at both ends. Seen: 7.4. */
START_TEST(eq_19_6_held_is_continuous_in_alpha)
{
    size_t ran = 0;
    const double t[] = { 0.5, 1, 2, 4, 8, 16, 32 };
    const double from[] = { 0, 0.25, 0.5, 0.75, 1 };
    for (double e = 1e-3; e > 5e-13; e /= 10)
        for (size_t i = 0; i < LEN(from); i++)
            for (int side = -1; side <= 1; side += 2) {
                problem q = { FVI_INITIAL_HISTORY_HELD, from[i], 0.2, 1, 0.5, { 1, 0 } };
                double here[LEN(t)], there[LEN(t)];
                exact(&q, LEN(t), t, here, NULL);
                q.alpha += side * e;
                if (q.alpha < 0 || q.alpha > 1)
                    continue;
                ran++;
                exact(&q, LEN(t), t, there, NULL);
                for (size_t k = 0; k < LEN(t); k++)
                    ck_assert_near(there[k], here[k], 10 * e + 1e-13,
                                   "alpha = %g%+g, t = %g", from[i], side * e,
                                   t[k]);
            }
    ck_assert_uint_eq(ran, 10 * (2 * LEN(from) - 2)); /* two stand at an end */
}
END_TEST

/* (19.7): at alpha = 1 the body is let go with m v0 / (m + rho) and moves as a mass
 * m + rho. The exact solution, to the bound of its header; the Lobatto methods as
 * their own undamped selves, N (8 s + 20) roundings of numbers below 1.2. */
START_TEST(eq_19_7_a_velocity_jumps_at_alpha_1)
{
    const problem q = { FVI_INITIAL_HISTORY_HELD, 1, 0.2, 1, 0.5, { 1, 0 } };
    const double total_mass = 1.2, w = sqrt(1 / total_mass), zero = 0;
    const fvi_system system = { .d = 1,
                                .mass = &total_mass,
                                .damping = &zero,
                                .potential = fvi_potential_harmonic(q.cg) };
    for (double t = 1e-6; t < 20; t *= 3) {
        double X, V;
        exact(&q, 1, &t, &X, &V);
        ck_assert_near(X, cos(w * t) + q.p0 / total_mass / w * sin(w * t), 1e-13,
                       "x, t = %g", t);
        ck_assert_near(V, q.p0 / total_mass * cos(w * t) - w * sin(w * t),
                       4e-14 * (1.2 + 1.2 / t), "x', t = %g", t);
    }
    for (size_t s = 2; s <= 4; s++) {
        const fvi_method *method = methods[LOBATTO2 + s - 2];
        const double bound = N * (8 * (double)s + 20) * U * 1.2;
        const fvi_run run = fvi_run_default(&system, &q.x0, &q.p0, 0.05, N);
        ck_assert_int_eq(fvi_trajectory(method, &run, other_x, other_p, NULL),
                         0);
        solve(method, &q, 0.05, N, x, p);
        for (size_t k = 1; k <= N; k++) {
            ck_assert_near(x[k], other_x[k], bound, "x, s=%zu k=%zu", s, k);
            ck_assert_near(p[k], other_p[k] / total_mass, bound, "p, s=%zu k=%zu", s,
                           k);
        }
    }
}
END_TEST

/* ---- energy ---- */

static double energy(const problem *q, double t)
{
    double X, V;
    exact(q, 1, &t, &X, &V);
    return (V * V + q->cg[0] * X * X) / 2;
}

/* v^2 at t s, for the integral of (19.4). */
typedef struct {
    const problem *q;
    double t;
} until;

static double square(double s, void *params)
{
    const until *u = params;
    double X, V, t = u->t * s;
    exact(u->q, 1, &t, &X, &V);
    return V * V;
}

static double dice(const gsl_rng *rng, double low, double high)
{
    return low + (high - low) * gsl_rng_uniform(rng);
}

/* (19.4), 300 random problems and any alpha: E(t) never exceeds E(0), but for the
 * 4e-14 (max|x'| + max|x| / t) of fvi_exact_at, here below 1e-11. */
START_TEST(eq_19_4_held_never_gives_more_than_it_took)
{
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    gsl_rng_set(rng, 19);
    for (size_t i = 0; i < 300; i++) {
        const problem q = { .alpha = dice(rng, 0, 1),
                            .rho = exp(dice(rng, -4, 4)),
                            .x0 = dice(rng, -1, 1),
                            .p0 = dice(rng, -2, 2),
                            .cg = { exp(dice(rng, -4, 2)) } };
        const double E0 = (q.p0 * q.p0 + q.cg[0] * q.x0 * q.x0) / 2;
        for (double t = 0.02; t < 50; t *= 1.2) {
            const double E = energy(&q, t);
            seen_worst(E / E0, "of the start");
            ck_assert_msg(E <= E0 + 1e-11, "alpha=%g rho=%g t=%g: %g of %g",
                          q.alpha, q.rho, t, E, E0);
        }
    }
    gsl_rng_free(rng);
}
END_TEST

/* The sharper (19.4): with the integral of order 2 - 2 alpha of v^2, by QUADPACK's
 * rule for (1 - s)^(1 - 2 alpha), to 1e-6. The sum falls; at t = 0+ it is E(0). */
START_TEST(eq_19_4_with_the_integral_it_never_rises)
{
    const double alphas[] = { 0.55, 0.7, 0.85 }, rhos[] = { 0.2, 3 };
    gsl_integration_workspace *w = gsl_integration_workspace_alloc(1000);
    for (size_t i = 0; i < LEN(alphas) * LEN(rhos); i++) {
        const double alpha = alphas[i / 2], g = 2 - 2 * alpha;
        const problem q = {
            FVI_INITIAL_HISTORY_HELD, alpha, rhos[i % 2], 0.3, 1, { 1, 0 }
        };
        double last = (1 + 0.09) / 2;
        gsl_integration_qaws_table *table =
            gsl_integration_qaws_table_alloc(0, g - 1, 0, 0);
        for (double t = 0.1; t < 15; t *= 1.5) {
            until u = { &q, t };
            gsl_function f = { square, &u };
            double integral, error;
            ck_assert_int_eq(gsl_integration_qaws(&f, 0, 1, table, 0, 1e-7,
                                                  1000, w, &integral, &error),
                             0);
            const double sum =
                energy(&q, t) + q.rho / 2 * pow(t, g) / tgamma(g) * integral;
            ck_assert_msg(sum <= last + 1e-6, "alpha=%g rho=%g t=%g", alpha,
                          q.rho, t);
            last = sum;
        }
        gsl_integration_qaws_table_free(table);
    }
    gsl_integration_workspace_free(w);
}
END_TEST

/* Caputo's damping, alpha = 3/4, c = 1, rho = 3, x0 = 0, p0 = 1: 4.28 times the
 * energy at t = 3.75. The same data, held: no more than at the start. */
START_TEST(eq_19_4_caputo_gains_energy)
{
    problem q = { FVI_INITIAL_HISTORY_CAPUTO, 0.75, 3, 0, 1, { 1, 0 } };
    const double caputo = energy(&q, 3.75) / 0.5;
    seen(caputo, "Caputo");
    ck_assert_near(caputo, 4.28, 0.005, "Caputo");
    q.past = FVI_INITIAL_HISTORY_HELD;
    ck_assert_double_lt(energy(&q, 3.75), 0.5);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("19 past");
    ADD_CASE(suite, "impulses", eq_19_5_impulses_are_the_integrals,
             eq_19_5_they_are_exact_on_polynomials);
    ADD_CASE(suite, "pasts", eq_19_1_where_two_pasts_are_one,
             eq_19_3_units_of_mass_do_not_matter,
             eq_19_6_caputo_jumps_at_one_half_and_held_does_not,
             eq_19_6_held_is_continuous_in_alpha,
             eq_19_7_a_velocity_jumps_at_alpha_1);
    ADD_CASE(suite, "energy", eq_19_4_held_never_gives_more_than_it_took,
             eq_19_4_with_the_integral_it_never_rises,
             eq_19_4_caputo_gains_energy);
    return run_suite(suite);
}
