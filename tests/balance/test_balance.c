/* tests/balance/test_balance.c -- H 21: Green's identity and reciprocity.
 *                                         Run alone: make test-balance */
#include "balance/balance_runs.h"
#include "balance/balance_ref.h"
#include "system/larger.h"

enum { D = 2 };

/* (21.4), numbers that solve nothing, all of them short binary fractions. U = x^2/2 +
 * x^4/8 in each coordinate, h = 1/4. Tolerance 0. */
START_TEST(eq_21_4_the_form_without_rounding)
{
    const double mass[] = { 1, 2 }, damping[] = { 0.5, 1.5 }, cg[] = { 1, 0.5 };
    const fvi_system system = { .d = D,
                                .mass = mass,
                                .damping = damping,
                                .potential = fvi_potential_duffing(cg) };
    for (size_t i = 0; i < LEN(ref_forms); i++) {
        const fvi_balance_scheme s = {
            &system, ref_forms[i].alpha,   ref_forms[i].kappa,
            0.25,    ref_forms[i].weights, ref_forms[i].theta
        };
        double C[5];
        ck_assert_int_eq(fvi_green_form(&s, 5, ref_x, ref_u, ref_v, C),
                         FVI_SUCCESS);
        for (size_t n = 0; n < 5; n++)
            ck_assert_near(C[n], ref_forms[i].want[n], 0, "row %zu, n = %zu", i,
                           n);
    }
}
END_TEST

/* K_{kj} a of the linearised action about x, d = 2; rows k = 1..N-1, |k - j| <= 1. */
static void stiffness(const fvi_balance_scheme *s, const double *x, size_t k,
                      size_t j, double K[4])
{
    const double c = s->kappa, h = s->h;
    const size_t steps[] = { k - 1, k }; /* the two steps that meet at k */
    for (size_t i = 0; i < 4; i++)
        K[i] = i % 3 ? 0 : (k == j ? 2 : -1) * s->system->mass[i / 2] / h;
    for (size_t e = 0; e < 2; e++) {
        const size_t n = steps[e];
        if (j != n && j != n + 1)
            continue;
        const double at = k == n ? c : 1 - c, to = j == n ? c : 1 - c;
        double S[D], H[4];
        for (size_t i = 0; i < D; i++)
            S[i] = c * x[n * D + i] + (1 - c) * x[(n + 1) * D + i];
        ck_assert_int_eq(fvi_potential_hessian(s->system, S, H), FVI_SUCCESS);
        for (size_t i = 0; i < 4; i++)
            K[i] -= at * to * h * H[i];
    }
}

/* The size of all terms of all C_n - C_{n-1}: what one rounding error in each costs. */
static double size_of_terms(const fvi_balance_scheme *s, size_t N,
                            const double *x, const double *u, const double *v)
{
    double t[MOST + 3], sum = 0, a = fabs(s->theta);
    memory_of(s, N, t);
    for (size_t n = 0; n <= N + 1;
         n++) /* parts of t, and those of its weights */
        t[n] = fabs(t[n]) + (s->weights == FVI_DELTA_BDF2 ? fabs(t[1]) : 0)
               + a * pow(s->h, 1 - 2 * s->alpha);
    for (size_t k = 1; k < N; k++)
        for (size_t j = 0; j <= N; j++) {
            double K[4] = { 0 };
            if (j + 1 >= k && j <= k + 1)
                stiffness(s, x, k, j, K);
            for (size_t i = 0; i < 4; i++)
                sum += fabs(K[i])
                       * (fabs(v[k * D + i / 2] * u[j * D + i % 2])
                          + fabs(u[k * D + i / 2] * v[j * D + i % 2]));
            for (size_t i = 0; i < D; i++) {
                if (j <= k + 1)
                    sum += s->system->damping[i] * t[k + 1 - j]
                           * fabs(v[k * D + i] * u[j * D + i]);
                if (k <= j + 1)
                    sum += s->system->damping[i] * t[j + 1 - k]
                           * fabs(u[k * D + i] * v[j * D + i]);
            }
        }
    return sum;
}

/* C_n - C_{n-1} is v_n times what u leaves of its equation, minus u_n times what v
 * leaves of its own. Each leaves at most (2 N + 40) u times the size of its terms: N
 * for the sum over the past, N for momenta that carry the errors of all steps before.
 * The form's own rounding is (N + 18) u of the same terms. Returns the spread of C,
 * in units of that bound. Seen: 0.0011. */
static double spread(const fvi_balance_scheme *s, size_t N, const double *x,
                     const double *u, const double *v, double *relative)
{
    double C[MOST], far = 0, largest = 0;
    ck_assert_int_eq(fvi_green_form(s, N, x, u, v, C), FVI_SUCCESS);
    for (size_t n = 0; n < N; n++) {
        far = larger(far, fabs(C[n] - C[0]));
        largest = larger(largest, fabs(C[n]));
    }
    *relative = far / largest;
    return far / ((4 * (double)N + 120) * U * size_of_terms(s, N, x, u, v));
}

/* (21.4): a run, and another read backwards; two masses between walls, unequal
 * dampings; 2 alpha <= 1 for the methods of order 2. With u and v exchanged T_{jk}
 * becomes T_{kj}, and the form is not constant. Seen: 0.0004 of the bound. */
//> pairs
START_TEST(eq_21_4_a_run_pairs_with_one_read_backwards)
{
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    double least = 1;
    for (int i = 0; i < 300; i++) {
        const size_t N = 10 + gsl_rng_uniform_int(random, 70);
        const double spring[] = { between(random, 0.2, 2), 0 }, none[D] = { 0 };
        const double mass[] = { between(random, 0.5, 2), 1 };
        const double rho[] = { between(random, 0.1, 1), between(random, 0, 1) };
        const fvi_system system = { .d = D,
                                    .mass = mass,
                                    .damping = rho,
                                    .potential = fvi_potential_chain(spring) };
        const fvi_balance_scheme s =
            scheme_of(i % 3, &system, between(random, 0.05, i % 3 ? 0.5 : 0.95),
                      between(random, 0, 1), between(random, 0.1, 0.5));
        double u[D * MOST], back[D * MOST], v[D * MOST], constant, exchanged;
        const double push[] = { 1, 0.5 }, other[] = { -0.25, 1 };
        trajectory(i % 3, &s, FVI_INITIAL_HISTORY_HELD, N, none, push, u, NULL);
        trajectory(i % 3, &s, FVI_INITIAL_HISTORY_HELD, N, none, other, back, NULL);
        for (size_t k = 0; k <= N; k++)
            memcpy(v + k * D, back + (N - k) * D, D * sizeof *v);
        double of = spread(&s, N, u, u, v, &constant);
        seen_worst(of, "of the bound");
        seen_worst(constant, "spread");
        ck_assert_msg(of <= 1, "run %d: %g of the bound", i, of);
        spread(&s, N, u, v, u, &exchanged);
        least = smaller(least, exchanged);
    }
    seen(least, "exchanged");
    ck_assert(least > 1e-3);
    gsl_rng_free(random);
}
END_TEST
//< pairs

/* The linearised equations about x for u, forwards from u_0, u_1, or, transposed, for
 * v, backwards from v_N, v_{N-1}: a system of two unknowns at each step. */
static void linearised(const fvi_balance_scheme *s, size_t N, const double *x,
                       int backwards, double *u)
{
    double t[MOST + 3];
    memory_of(s, N, t);
    for (size_t i = 1; i < N; i++) {
        const size_t k = backwards ? N - i : i;
        const size_t next = backwards ? k - 1 : k + 1;
        double right[D] = { 0 }, A[4], K[4];
        for (size_t e = 0; e <= i; e++) { /* all that is known */
            const size_t j = backwards ? N - e : e;
            const size_t lag = backwards ? j - k : k - j;
            if (lag <= 1)
                stiffness(s, x, k, j, K);
            for (size_t r = 0; r < D; r++) {
                right[r] += s->system->damping[r] * t[lag + 1] * u[j * D + r];
                for (size_t c = 0; c < D && lag <= 1; c++)
                    right[r] -= K[2 * r + c] * u[j * D + c];
            }
        }
        stiffness(s, x, k, next, A);
        for (size_t r = 0; r < D; r++)
            A[3 * r] -= s->system->damping[r] * t[0];
        const double det = A[0] * A[3] - A[1] * A[2];
        u[next * D] = (A[3] * right[0] - A[1] * right[1]) / det;
        u[next * D + 1] = (A[0] * right[1] - A[2] * right[0]) / det;
    }
}

/* (21.4) about a trajectory of a nonlinear system, its variations from arbitrary
 * starts. */
START_TEST(eq_21_4_about_a_nonlinear_trajectory)
{
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    for (int i = 0; i < 150; i++) {
        const size_t N = 10 + gsl_rng_uniform_int(random, 50);
        const double mass[] = { 1, 1.5 }, rho[] = { 0.3, 0.8 };
        const fvi_system system = {
            .d = D, .mass = mass, .damping = rho, .potential = central
        };
        const fvi_balance_scheme s =
            scheme_of(i % 3, &system, between(random, 0.05, 0.95),
                      between(random, 0, 1), between(random, 0.05, 0.25));
        const double x0[] = { 1, between(random, -1, 1) }, p0[] = { 0, 1 };
        double x[D * MOST], u[D * MOST], v[D * MOST], relative;
        trajectory(i % 3, &s, FVI_INITIAL_HISTORY_HELD, N, x0, p0, x, NULL);
        for (size_t j = 0; j < 2 * D; j++) {
            u[j] = between(random, -1, 1);
            v[(N - 1) * D + j] = between(random, -1, 1);
        }
        linearised(&s, N, x, 0, u);
        linearised(&s, N, x, 1, v);
        double of = spread(&s, N, x, u, v, &relative);
        seen_worst(of, "of the bound");
        ck_assert_msg(of <= 1, "run %d: %g of the bound", i, of);
    }
    gsl_rng_free(random);
}
END_TEST

/* (21.5): at alpha = 1/2 the sum has one term left, and without damping none. Both
 * forms have the same terms; the weights after the second are exact zeros: a sum of 15
 * terms, twice. Seen: 0.023 of it. */
START_TEST(eq_21_5_bateman_at_one_half_and_areas_without_damping)
{
    const double mass[] = { 1, 2 }, cg[] = { 1, 0.5 }, h = 0.3;
    for (int damped = 0; damped < 2; damped++) {
        const double damping[] = { damped * 0.7, damped * 0.2 };
        const fvi_system system = { .d = D,
                                    .mass = mass,
                                    .damping = damping,
                                    .potential = fvi_potential_duffing(cg) };
        const fvi_balance_scheme s = scheme_of(0, &system, 0.5, 0, h);
        double C[5];
        ck_assert_int_eq(fvi_green_form(&s, 5, ref_x, ref_u, ref_v, C),
                         FVI_SUCCESS);
        for (size_t n = 0; n < 5; n++) {
            double want = 0, size = 0;
            for (size_t i = n * D; i < n * D + D; i++) {
                const double m = mass[i % D] / h, r = damping[i % D];
                const double in = ref_u[i], out = ref_v[i];
                want -= m * (out * ref_u[i + D] - in * ref_v[i + D])
                        + r * ref_v[i + D] * in;
                size += m * (fabs(out * ref_u[i + D]) + fabs(in * ref_v[i + D]))
                        + r * fabs(ref_v[i + D] * in);
            }
            ck_assert_near(C[n], want, 30 * U * size, "damped %d, n = %zu",
                           damped, n);
        }
    }
}
END_TEST

/* (21.6): five unequal masses, chain of springs 2, kappa = 1/4, h = 1/4. Positions stay
 * below 1; one step is wrong by some 3 u, and in a stable run of 8 steps no error of a
 * step grows by more than the number of the steps that follow: 200 u. Seen: 0.01 of it. */
//> reciprocity
START_TEST(eq_21_6_five_masses_answer_each_other)
{
    const double mass[] = { 1, 2, 0.5, 1, 3 }, spring[] = { 2, 0 };
    const double damping[] = { 0.125, 1, 0, 0.5, 0.25 }, none[5] = { 0 };
    const fvi_system system = { .d = 5,
                                .mass = mass,
                                .damping = damping,
                                .potential = fvi_potential_chain(spring) };
    for (size_t i = 0; i < LEN(ref_response); i++) {
        const int method = ref_response[i].method;
        const fvi_balance_scheme s =
            scheme_of(method, &system, ref_response[i].alpha, 0.25, 0.25);
        double x[5][(REF_STEPS + 1) * 5], bound = 200 * U;
        for (size_t j = 0; j < 5; j++) {
            double push[5] = { 0 };
            push[j] = 1;
            trajectory(method, &s, FVI_INITIAL_HISTORY_HELD, REF_STEPS, none, push, x[j],
                       NULL);
        }
        for (size_t j = 0; j < 5; j++)
            for (size_t k = 0; k < 5; k++)
                ck_assert_near(x[j][REF_STEPS * 5 + k], ref_response[i].x[j][k],
                               bound, "row %zu: %zu from %zu", i, k, j);
        for (size_t n = 0; n <= REF_STEPS; n++)
            for (size_t j = 0; j < 5; j++)
                for (size_t k = 0; k < j; k++)
                    ck_assert_near(x[j][n * 5 + k], x[k][n * 5 + j], 2 * bound,
                                   "row %zu, n = %zu: %zu and %zu", i, n, j, k);
    }
}
END_TEST
//< reciprocity

START_TEST(what_is_out_of_range_is_refused)
{
    const double one = 1, x[] = { 0, 1, 2 };
    const fvi_system system = { .d = 1, .mass = &one, .damping = &one };
    const fvi_balance_scheme good = {
        &system, 0.5, 0.5, 0.1, FVI_DELTA_EULER, 0
    };
    fvi_balance_scheme bad[7];
    const int code[] = { FVI_EFAULT, FVI_EDOM, FVI_EDOM,  FVI_EDOM,
                         FVI_EDOM,   FVI_EDOM, FVI_EINVAL };
    for (size_t i = 0; i < LEN(bad); i++)
        bad[i] = good;
    bad[0].system = NULL;
    bad[1].alpha = -0.1;
    bad[2].alpha = NAN;
    bad[3].kappa = 1.1;
    bad[4].theta = -1;
    bad[5].h = 0;
    bad[6].weights = FVI_DELTA_TRAPEZOID;
    double C[2] = { 7, 7 }, E[2] = { 7, 7 };
    for (size_t i = 0; i < LEN(bad); i++) {
        ck_assert_int_eq(fvi_green_form(&bad[i], 2, x, x, x, C), code[i]);
        ck_assert_int_eq(fvi_scheme_energy(&bad[i], 2, x, E, C), code[i]);
    }
    ck_assert_int_eq(fvi_green_form(NULL, 2, x, x, x, C), FVI_EFAULT);
    ck_assert_int_eq(fvi_green_form(&good, 2, x, NULL, x, C), FVI_EFAULT);
    ck_assert_int_eq(fvi_green_form(&good, 0, x, x, x, C), FVI_EINVAL);
    ck_assert_int_eq(fvi_green_form(&good, SIZE_MAX / 8, x, x, x, C),
                     FVI_EINVAL);
    ck_assert_int_eq(fvi_scheme_energy(&good, 2, NULL, E, C), FVI_EFAULT);
    ck_assert(C[0] == 7 && C[1] == 7 && E[0] == 7 && E[1] == 7);
    ck_assert_int_eq(fvi_green_form(&good, 2, NULL, x, x, C), FVI_SUCCESS);
}
END_TEST

static int refuses(size_t d, const double *x, void *params, double *out)
{
    (void)d, (void)x, (void)params, (void)out;
    return FVI_EMAXITER;
}

START_TEST(what_the_potential_returns_comes_back)
{
    const double one = 1, x[] = { 0, 1, 2 };
    const fvi_potential none = { .value = refuses,
                                 .gradient = refuses,
                                 .hessian = refuses };
    const fvi_system system = {
        .d = 1, .mass = &one, .damping = &one, .potential = none
    };
    const fvi_balance_scheme s = { &system, 0.5, 0.5, 0.1, FVI_DELTA_EULER,
                                   0 };
    double C[2], E[2];
    ck_assert_int_eq(fvi_green_form(&s, 2, x, x, x, C), FVI_EMAXITER);
    ck_assert_int_eq(fvi_scheme_energy(&s, 2, x, E, C), FVI_EMAXITER);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("balance");
    ADD_CASE(suite, "Green", eq_21_4_the_form_without_rounding,
             eq_21_4_a_run_pairs_with_one_read_backwards,
             eq_21_4_about_a_nonlinear_trajectory,
             eq_21_5_bateman_at_one_half_and_areas_without_damping,
             eq_21_6_five_masses_answer_each_other);
    ADD_CASE(suite, "errors", what_is_out_of_range_is_refused,
             what_the_potential_returns_comes_back);
    return run_suite(suite);
}
