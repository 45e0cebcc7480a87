/* tests/convergence/test_convergence.c -- H 20: the velocity form, lemmas, constants.
 * Run alone: make test-convergence */
#include "motions.h"
#include "order_table.h"
#include "series.h"

#include "convergence_ref.h"
#include "system/larger.h"

static double x[COARSE + 1], p[COARSE + 1];
static double b[1000]; /* the largest n of ref_quotients */

/* ---- the velocity form ---- */

/* (20.2) with the positions of the run gives its momenta, and (20.1) its next mean
 * velocity. Each of the sums of k terms rounds by at most (k + 8) u of its absolute
 * terms; a mean velocity is off by 2 u max|x| / h. Seen: 0.18 of that. */
START_TEST(eq_20_1_the_run_in_its_velocities)
{
    for (size_t seed = 0; seed < 40; seed++) {
        const motion q = some_motion(seed);
        const size_t N = COARSE;
        const double h = q.T / (double)N, gamma = 2 - 2 * q.alpha, m = q.mass,
                     v0 = q.p0 / m,
                     nu = q.past == FVI_INITIAL_HISTORY_CAPUTO && q.alpha > 0.5 ? v0 : 0,
                     scale = q.rho * pow(h, gamma);
        solve(&fvi_fractional, &q, N, x, p);
        integral_weights(gamma, N, b);
        double far = 0, sum = q.p0, terms = fabs(q.p0);
        for (size_t k = 0; k <= N; k++)
            far = larger(far, fabs(x[k]));
        for (size_t k = 0; k <= N; k++) {
            double memory = 0, rough = 0;
            for (size_t j = 1; j <= k; j++) {
                const double u = (x[j] - x[j - 1]) / h - nu;
                memory += b[k - j] * u;
                rough += b[k - j] * (fabs(u) + fabs(nu) + 2 * far / h);
            }
            if (k > 0) {
                const double S = q.kappa * x[k - 1] + (1 - q.kappa) * x[k];
                double F;
                jumping((double)k * h, 1, (void *)&q.force, &F);
                sum += h * (F - gradient(&q, S));
                terms += h * (fabs(F) + fabs(gradient(&q, S)) + far);
            }
            const double units = ((double)k + 8) * U;
            ck_assert_near(sum - scale * memory, p[k],
                           units * (terms + scale * rough), "p, %zu, %zu", seed,
                           k);
            if (k == N)
                break;
            const double S = q.kappa * x[k] + (1 - q.kappa) * x[k + 1];
            ck_assert_near(m * (x[k + 1] - x[k]) / h
                               + q.kappa * h * gradient(&q, S),
                           p[k], 8 * U * (fabs(p[k]) + m * far / h + far),
                           "v, %zu, %zu", seed, k);
        }
    }
}
END_TEST

/* ---- lemmas ---- */

/* (20.3), (20.4) at the reference values, to their rounding; how sharp they are. The
 * weights of the test add up to c_n, n terms and twice n roundings: 4 n u. */
START_TEST(eq_20_3_gamma_quotients)
{
    double sharp = 0;
    for (size_t i = 0; i < LEN(ref_quotients); i++) {
        const double g = ref_quotients[i].gamma, c = ref_quotients[i].c,
                     n = (double)ref_quotients[i].n, power = pow(n, g),
                     round = 8 * U * (g + 1) * (1 + log(n)) * power * n,
                     low = g <= 1 ? power * (1 - g * (1 - g) / n) : power,
                     high = g <= 1 ? power : power * (1 + (g - 1) / n),
                     excess = ref_quotients[i].excess;
        ck_assert(c >= low - round && c <= high + round);
        ck_assert(excess * (g - 1) >= 0);
        ck_assert_double_le(fabs(excess),
                            2 * fabs(g - 1) * power * (1 + 8 * U));
        if (g != 1)
            sharp = larger(sharp, fabs(excess) / (2 * fabs(g - 1) * power));
        integral_weights(g, ref_quotients[i].n, b);
        double sum = 0;
        for (size_t j = 0; j < ref_quotients[i].n; j++)
            sum += b[j];
        ck_assert_near(sum * tgamma(g + 1), c, (4 * n + 8) * U * c,
                       "gamma = %g, n = %g", g, n);
    }
    seen(sharp, "sharp");
    ck_assert_double_eq(sharp, 1); /* gamma = 2, n = 1 */
}
END_TEST

/* The memory's sum on the mean velocities of v0 t + a t^2/2, less r I^gamma v, over h:
 * at most what the theorem counts for it, C - A/2, and not a tenth of it. The
 * difference loses k u of the sums by h. Seen: from 0.26 to 1 of it. */
START_TEST(eq_20_4_the_memory_of_a_parabola)
{
    for (int i = 0; i < 40; i++) {
        const double alpha = (i / 2) / 20.0, gamma = 2 - 2 * alpha, a = i % 2,
                     v0 = i % 2 ? 0 : alpha < 0.5, r = 0.7, h = 1.0 / 64;
        double worst = 0, least = GSL_POSINF;
        integral_weights(gamma, 64, b);
        for (size_t k = 1; k <= 64; k++) {
            const double t = (double)k * h;
            double sum = 0;
            for (size_t j = 1; j <= k; j++)
                sum += b[k - j] * (v0 + a * h * ((double)j - 0.5));
            const double want = v0 * pow(t, gamma) / tgamma(gamma + 1)
                                + a * pow(t, gamma + 1) / tgamma(gamma + 2),
                         off = r * fabs(pow(h, gamma) * sum - want),
                         round = 4 * (double)k * U * r * want / h;
            const fvi_smoothness q = { .alpha = alpha,
                                   .T = t,
                                   .damping = r,
                                   .start = v0,
                                   .acceleration = a,
                                   .room = 1 };
            fvi_error_bound bound;
            ck_assert_int_eq(fvi_error_bound_compute(&q, &bound), 0);
            const double allowed = bound.C - a / 2;
            ck_assert_double_le(off / h, allowed * (1 + 8 * U) + a * U + round);
            if (allowed > 1e-6) {
                worst = larger(worst, off / h / allowed);
                least = smaller(least, off / h / allowed);
            }
        }
        if (worst > 0) {
            seen(worst, "of the bound at most");
            seen(least, "of the bound at least");
            ck_assert_double_gt(least, 0.2);
        }
    }
}
END_TEST

/* ---- the constants ---- */

/* What a row of references says of a motion; the tenth number is A, or W. */
static fvi_smoothness known(const double *v, int by_variation)
{
    return (fvi_smoothness){ .alpha = v[0],
                             .kappa = v[1],
                             .T = v[2],
                             .damping = v[3],
                             .lipschitz = v[4],
                             .gradient = v[5],
                             .variation = v[6],
                             .start = v[7],
                             .speed = v[8],
                             .acceleration = by_variation ? 0 : v[9],
                             .velocity_variation = by_variation ? v[9] : 0,
                             .room = v[10] > 0 ? v[10] : GSL_POSINF };
}

static void check_constants(const fvi_error_bound *got, double C, double lambda, double h,
                            size_t i)
{
    ck_assert_ulp(got->C, C, 16, "C, %zu", i);
    ck_assert_ulp(got->lambda, lambda, 16, "lambda, %zu", i);
    if (h > 0)
        ck_assert_ulp(got->h, h, 64, "h, %zu", i);
    else
        ck_assert(got->h == GSL_POSINF);
}

/* Seen: 4 ulp. */
START_TEST(eq_20_5_constants)
{
    for (size_t i = 0; i < LEN(ref_bounds); i++) {
        const fvi_smoothness q = known(ref_bounds[i].motion, 0);
        fvi_error_bound got;
        ck_assert_int_eq(fvi_error_bound_compute(&q, &got), 0);
        check_constants(&got, ref_bounds[i].C, ref_bounds[i].lambda, ref_bounds[i].h, i);
    }
}
END_TEST

START_TEST(eq_20_14_constants)
{
    for (size_t i = 0; i < LEN(ref_position_bounds); i++) {
        const fvi_smoothness q = known(ref_position_bounds[i].motion, 1);
        fvi_error_bound got;
        ck_assert_int_eq(fvi_position_bound_compute(&q, &got), 0);
        check_constants(&got, ref_position_bounds[i].C, ref_position_bounds[i].lambda,
                        ref_position_bounds[i].h, i);
    }
}
END_TEST

START_TEST(eq_20_8_what_is_no_motion_is_refused)
{
    const fvi_smoothness good = { .alpha = 0.3,
                              .kappa = 0.5,
                              .T = 1,
                              .damping = 1,
                              .lipschitz = 1,
                              .gradient = 1,
                              .variation = 1,
                              .start = 1,
                              .speed = 1,
                              .acceleration = 1,
                              .room = 1 };
    const fvi_error_bound untouched = { 7, 7, 7 };
    fvi_error_bound got = untouched;
    ck_assert_int_eq(fvi_error_bound_compute(NULL, &got), FVI_EFAULT);
    ck_assert_int_eq(fvi_error_bound_compute(&good, NULL), FVI_EFAULT);
    ck_assert_int_eq(fvi_position_bound_compute(NULL, &got), FVI_EFAULT);
    ck_assert_int_eq(fvi_position_bound_compute(&good, NULL), FVI_EFAULT);
    fvi_smoothness q[16];
    size_t bad = 0;
    double *const places[] = {
        &q[0].alpha,     &q[1].kappa,        &q[2].T,         &q[3].damping,
        &q[4].lipschitz, &q[5].gradient,     &q[6].variation, &q[7].start,
        &q[8].speed,     &q[9].acceleration, &q[10].room, &q[11].velocity_variation
    };
    for (size_t i = 0; i < LEN(places); i++)
        for (int j = 0; j < 3; j++) {
            q[i] = good;
            *places[i] = j == 0 ? -1 : j == 1 ? GSL_NAN : GSL_POSINF;
            if (i == 10 && j == 2)
                continue; /* an infinite room is allowed */
            ck_assert_int_eq(fvi_error_bound_compute(&q[i], &got), FVI_EDOM);
            ck_assert_int_eq(fvi_position_bound_compute(&q[i], &got), FVI_EDOM);
            bad++;
        }
    ck_assert_uint_eq(bad, 35);
    q[0] = good;
    q[0].alpha = 1;
    ck_assert_int_eq(fvi_error_bound_compute(&q[0], &got), FVI_EDOM);
    q[0].alpha = 1 - 0x1p-20; /* 4^(2^19) */
    ck_assert_int_eq(fvi_error_bound_compute(&q[0], &got), FVI_EOVRFLW);
    ck_assert_mem_eq(&got, &untouched, sizeof got);
    q[0] = good;
    q[0].lipschitz = 1e12; /* e^(2e6) */
    ck_assert_int_eq(fvi_error_bound_compute(&q[0], &got), FVI_SUCCESS);
    ck_assert_double_eq(got.h, 0);
}
END_TEST

/* The series is the motion: of a spring that of H 11, to 1e-13. */
START_TEST(the_series_is_the_motion_of_a_spring)
{
    static series alone;
    for (size_t i = 0; i < GENERIC / 2; i++) {
        duffing q;
        if (!is_generic(i, &q))
            continue;
        q = limit_of_runs(&q);
        q.A = 0;
        expand(&q, &alone);
        const fvi_linear_oscillator linear = { .m = 1,
                                    .c = q.c,
                                    .rho = q.rho,
                                    .alpha = q.alpha,
                                    .past = q.past,
                                    .x0 = q.x0,
                                    .v0 = q.v0 };
        const double t[] = { 0, 0.001, 0.25, 0.5, 1 };
        ck_assert_int_eq(fvi_exact_at(&linear, LEN(t), t, x, p,
                                      NULL), FVI_SUCCESS);
        for (size_t k = 0; k < LEN(t); k++) {
            double where, speed;
            at(&alone, t[k], &where, &speed);
            ck_assert_near(where, x[k], 1e-13, "x(%g)", t[k]);
            ck_assert_near(speed, p[k], 1e-12, "v(%g)", t[k]);
        }
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("20 convergence");
    ADD_CASE(suite, "velocity", eq_20_1_the_run_in_its_velocities);
    ADD_CASE(suite, "lemmas", eq_20_3_gamma_quotients,
             eq_20_4_the_memory_of_a_parabola);
    ADD_CASE(suite, "constants", eq_20_5_constants, eq_20_14_constants,
             eq_20_8_what_is_no_motion_is_refused);
    ADD_CASE(suite, "series", the_series_is_the_motion_of_a_spring);
    return run_suite(suite);
}
