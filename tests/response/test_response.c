/* tests/response/test_response.c -- Responses by frequency.              [H 30]
 * Run alone: make test-response */
#include "response_systems.h"

#include "frequency/dynamic_stiffness.h"
#include "response/response_ref.h"

/* ---- values ---- */

/* An error dZ of Z is H dZ H of H: |H|^2 times 8 u of what Z is summed from, and the last
 * product. Seen: 0.04 of it. */
START_TEST(eq_30_2_responses_match_40_digits)
{
    for (size_t i = 0; i < LEN(responses); i++) {
        linear_system s;
        make_system(responses[i].system, &s);
        const fvi_linear_motion motion = { .system = &s.system };
        fvi_response *r = response_of(&motion);
        const double omega = responses[i].omega, at[2] = { 0, omega };
        double H[2];
        OK(fvi_response_at(r, (fvi_response_kind)responses[i].kind, 1, &omega,
                           s.d - 1, 0, H, NULL));
        const double inverse = norm_of_inverse(r, at),
                     norm = fvi_stiffness_norm(r, I * omega),
                     factor = responses[i].kind == 0   ? 1
                              : responses[i].kind == 1 ? omega
                                                       : omega * omega,
                     load = responses[i].kind == 3 ? 3 : 1;
        const double bound = 8 * U * inverse * inverse * norm * factor * load
                             + 2 * U * hypot(responses[i].re, responses[i].im);
        ck_assert_near(H[0], responses[i].re, bound, "re of %zu", i);
        ck_assert_near(H[1], responses[i].im, bound, "im of %zu", i);
        fvi_response_free(r);
    }
}
END_TEST

/* alpha with rho is a damper of its own on each mass, and so is a law with rho. */
START_TEST(eq_30_1_dampings_of_a_system_are_dampers)
{
    const double rho[3] = { 0.5, 0, 0.25 }, omega[2] = { 0.7, 2.3 };
    linear_system s;
    make_system(1, &s);
    fvi_kernel_term power = { FVI_KERNEL_POWER, 1, 0.3, 0, 0 };
    const fvi_kernel law = { 1, &power };
    double row[2][3] = { { sqrt(0.5) }, { 0, 0, 0.5 } };
    const fvi_damper two[] = { { .of = fvi_elongation_row(row[0]), .kernel = &law },
                               { .of = fvi_elongation_row(row[1]), .kernel = &law } };
    const fvi_mechanism mechanism = { .damper_count = 2, .damper = two };
    fvi_system plain = s.system, damped = s.system;
    plain.mechanism = NULL;
    plain.damping = rho;
    damped.mechanism = &mechanism;
    const fvi_linear_motion motions[] = {
        { .system = &damped }, { .system = &plain, .alpha = 0.3 },
        { .system = &plain, .alpha = 0.9, .law = &law }
    };
    double H[3][4];
    for (size_t i = 0; i < LEN(motions); i++) {
        fvi_response *r = response_of(&motions[i]);
        OK(fvi_response_at(r, FVI_RESPONSE_RECEPTANCE, 2, omega, 2, 1, H[i], NULL));
        fvi_response_free(r);
    }
    for (size_t l = 0; l < 4; l++)
        for (size_t i = 1; i < LEN(motions); i++)
            ck_assert_near(H[i][l], H[0][l], 40 * U, "%zu, number %zu", i, l);
}
END_TEST

static int distance(double t, size_t d, const double *x, void *params, double *g)
{
    (void)t, (void)d, (void)params;
    *g = hypot(x[0], x[1]);
    return 0;
}

static int distance_gradient(double t, size_t d, const double *x, void *params,
                             double *G)
{
    double g;
    (void)distance(t, d, x, params, &g);
    G[0] = x[0] / g;
    G[1] = x[1] / g;
    return 0;
}

/* A strut at (3, 4) acts along (0.6, 0.8), and a potential by its Hessian there. */
START_TEST(eq_30_1_is_linear_around_a_place)
{
    const double mass[2] = { 1, 2 }, none[2] = { 0 }, at[2] = { 3, 4 };
    const double cg[2] = { 1, 0.5 };
    fvi_kernel_term term = { FVI_KERNEL_POWER, 2, 0.25, 0, 0 };
    const fvi_kernel kernel = { 1, &term };
    const fvi_damper strut = { .of = { .value = distance,
                                       .gradient = distance_gradient },
                               .kernel = &kernel };
    const fvi_mechanism mechanism = { .damper_count = 1, .damper = &strut };
    const fvi_system system = { .d = 2, .mass = mass, .damping = none,
                                .potential = fvi_potential_duffing(cg),
                                .mechanism = &mechanism };
    const fvi_linear_motion motion = { .system = &system, .at = at };
    fvi_response *r = response_of(&motion);
    const double s[2] = { 0, 1.5 }, x[4] = { 1, 0, 0, 0 };
    double y[4];
    OK(fvi_response_multiply(r, s, 0, x, y, NULL));
    const double complex C = 2 * csqrt(1.5 * I);
    const double complex want[2] = { -2.25 + 1 + 3 * 0.5 * 9 + 0.36 * C, 0.48 * C };
    for (int i = 0; i < 2; i++) {
        ck_assert_near(y[2 * i], creal(want[i]), 32 * U, "re %d", i);
        ck_assert_near(y[2 * i + 1], cimag(want[i]), 32 * U, "im %d", i);
    }
    fvi_response_free(r);
}
END_TEST

/* Of a band, by sparse factors and dense ones, which are chosen by zeros. */
START_TEST(sparse_and_dense_factors_agree)
{
    enum { d = 40 };
    static double mass[d], rho[d];
    const double cg[2] = { 3, 0 };
    for (int i = 0; i < d; i++) {
        mass[i] = 1 + i % 3;
        rho[i] = i % 4 == 0;
    }
    fvi_system system = { .d = d, .mass = mass, .damping = rho,
                          .potential = fvi_potential_chain(cg) };
    const fvi_linear_motion motion = { .system = &system, .alpha = 0.3 };
    fvi_response *r = response_of(&motion);
    ck_assert_int_eq(r->is_dense, 0);
    const double s[2] = { -0.1, 1.3 };
    double complex f[d], x[d], y[d];
    for (int i = 0; i < d; i++)
        f[i] = cos(i) + I * sin(3 * i);
    OK(fvi_response_solve(r, s, (double *)f, (double *)x, NULL));
    OK(fvi_response_multiply(r, s, 0, (double *)x, (double *)y, NULL));
    double size = 0;
    for (int i = 0; i < d; i++)
        size = larger(size, cabs(x[i]));
    for (int i = 0; i < d; i++)
        ck_assert_near(cabs(y[i] - f[i]), 0, 40 * U * 15 * size, "residual %d", i);
    double all[d]; /* a damper between all of them fills the matrix */
    for (int i = 0; i < d; i++)
        all[i] = 0x1p-30;
    fvi_kernel_term term = { FVI_KERNEL_POWER, 1, 0.25, 0, 0 };
    const fvi_kernel kernel = { 1, &term };
    const fvi_damper damper = { .of = fvi_elongation_row(all), .kernel = &kernel };
    const fvi_mechanism mechanism = { .damper_count = 1, .damper = &damper };
    system.mechanism = &mechanism;
    fvi_response *dense = response_of(&motion);
    ck_assert_int_eq(dense->is_dense, 1);
    OK(fvi_response_solve(dense, s, (double *)f, (double *)y, NULL));
    for (int i = 0; i < d; i++)
        ck_assert_near(cabs(y[i] - x[i]), 0, 1e-12 * size, "solution %d", i);
    fvi_response_free(dense);
    fvi_response_free(r);
}
END_TEST

/* After many periods the exact solution of H 11 swings as the response says: |x - Re(H e^(i w t))| falls
 * like t^(-2 - 2 alpha), 1e-11 at 1000 periods. Seen: 5e-11 of |H|. */
START_TEST(a_response_is_what_is_left_of_a_motion)
{
    static const double cases[3][5] = { { 1, 1, 0.2, 0.3, 0.7 }, { 1, 1, 0.2, 0.3, 2 },
                                        { 2, 5, 0.4, 0.7, 1.3 } };
    for (size_t i = 0; i < LEN(cases); i++) {
        const double *a = cases[i];
        const fvi_linear_oscillator problem = {
            .m = a[0], .c = a[1], .rho = a[2], .alpha = a[3], .forcing = FVI_FORCING_COSINE,
            .A = 1, .w = a[4]
        };
        const fvi_system system = { .d = 1, .mass = &a[0], .damping = &a[2],
                                    .potential = fvi_potential_harmonic(&a[1]) };
        const fvi_linear_motion motion = { .system = &system, .alpha = a[3] };
        fvi_response *r = response_of(&motion);
        double H[2], t[4], x[4];
        OK(fvi_response_at(r, FVI_RESPONSE_RECEPTANCE, 1, &a[4], 0, 0, H, NULL));
        for (int k = 0; k < 4; k++)
            t[k] = (1000 + 0.25 * k) * 2 * M_PI / a[4];
        OK(fvi_exact_at(&problem, 4, t, x, NULL, NULL));
        for (int k = 0; k < 4; k++)
            ck_assert_near(x[k], H[0] * cos(a[4] * t[k]) - H[1] * sin(a[4] * t[k]),
                           1e-10 * hypot(H[0], H[1]), "case %zu, quarter %d", i, k);
        fvi_response_free(r);
    }
}
END_TEST

/* The matrices of a structure are those of a system, and its dampers may be matrices. */
START_TEST(a_structure_responds_as_its_masses_do)
{
    linear_system s;
    make_system(0, &s);
    s.term[1][0].rho = 3;
    fvi_triplet list[3][20];
    size_t n[3] = { 0 };
    for (int i = 0; i < 5; i++)
        for (int j = 0; j < 5; j++) {
            if (s.K[i * 5 + j] != 0)
                list[0][n[0]++] = (fvi_triplet){ i, j, s.K[i * 5 + j] };
            if (i == j)
                list[1][n[1]++] = (fvi_triplet){ i, j, 1 };
            const double B = s.row[1][i] * s.row[1][j];
            if (B != 0)
                list[2][n[2]++] = (fvi_triplet){ i, j, B };
        }
    fvi_sparse A[3];
    for (int l = 0; l < 3; l++)
        OK(fvi_sparse_assemble(5, n[l], list[l], &A[l]));
    fvi_structure *structure;
    char fault;
    OK(fvi_structure_alloc(&A[1], &A[0], NULL, &structure, &fault));
    fvi_system system = fvi_structure_system(structure);
    s.damper[1] = (fvi_damper){ .matrix = &A[2], .kernel = &s.kernel[1] };
    system.mechanism = &s.mechanism;
    const fvi_linear_motion as_structure = { .system = &system };
    double H[2][2], omega = 7.3125;
    fvi_response *r = response_of(&as_structure);
    OK(fvi_response_at(r, FVI_RESPONSE_GROUND, 1, &omega, 4, 0, H[0], NULL));
    fvi_response_free(r);
    make_system(0, &s);
    s.term[1][0].rho = 3;
    const fvi_linear_motion as_masses = { .system = &s.system };
    r = response_of(&as_masses);
    OK(fvi_response_at(r, FVI_RESPONSE_GROUND, 1, &omega, 4, 0, H[1], NULL));
    fvi_response_free(r);
    for (int i = 0; i < 2; i++)
        ck_assert_near(H[0][i], H[1][i], 64 * U, "%d", i);
    fvi_structure_free(structure);
    for (int l = 0; l < 3; l++)
        fvi_sparse_free(&A[l]);
}
END_TEST

/* Two bodies on springs of their own, of which the ground moves the second by -2 and the first not at
 * all: T = r / (1 - omega^2 / c). */
START_TEST(eq_30_3_the_ground_moves_along_a_direction)
{
    const double mass[2] = { 1, 1 }, none[2] = { 0 }, along[2] = { 0, -2 }, c = 4, omega = 1;
    const fvi_system system = { .d = 2, .mass = mass, .damping = none,
                                .potential = fvi_potential_harmonic(&c) };
    const fvi_linear_motion motion = { .system = &system, .along = along };
    fvi_response *r = response_of(&motion);
    for (size_t at = 0; at < 2; at++) {
        double T[2];
        OK(fvi_response_at(r, FVI_RESPONSE_GROUND, 1, &omega, at, 0, T, NULL));
        ck_assert_near(T[0], along[at] / 0.75, 4 * U, "T of %zu", at);
    }
    fvi_response_free(r);
}
END_TEST

/* An error dZ changes T by Z^-1 dZ T, and the load S r = (K + C B) r has errors of its own. With |T| <= |Z^-1| |S r|
 * the bound is 8 u |Z^-1| |S| |r| (1 + |Z^-1| |Z|). At 65536 |Z^-1| |S| is so small that the bound is below u.
 * At 1/128 1 + omega^2 Z^-1 M r has errors of its second part, which omega^2 |M| |r| bounds, and u. */
START_TEST(eq_30_3_a_fast_ground_leaves_all_digits)
{
    for (size_t i = 0; i < LEN(grounds); i++) {
        linear_system s;
        make_system(grounds[i].system, &s);
        const fvi_linear_motion motion = { .system = &s.system };
        fvi_response *r = response_of(&motion);
        const double omega = grounds[i].omega, at[2] = { 0, omega };
        double T[2];
        OK(fvi_response_at(r, FVI_RESPONSE_GROUND, 1, &omega, 0, 0, T, NULL));
        const double inverse = norm_of_inverse(r, at), norm = fvi_stiffness_norm(r, I * omega),
                     inertia = omega * omega * r->term[0].norm;
        const int is_fast = omega > 1000;
        const double load = is_fast ? norm - inertia : inertia,
                     bound = 8 * U * inverse * load * sqrt((double)s.d) * (1 + inverse * norm) + (is_fast ? 0 : U);
        ck_assert(bound < (is_fast ? U : 2 * U));
        ck_assert_near(T[0], grounds[i].re, bound, "re of %zu", i);
        ck_assert_near(T[1], grounds[i].im, bound, "im of %zu", i);
        fvi_response_free(r);
    }
}
END_TEST

/* Two masses of 1, tied by a spring of 10^12, on a spring of 1. They move as one mass of 2: T = 1 / (1 - 2 omega^2) but
 * for terms of omega^4 and 10^-12 omega^2. Z has the condition number 10^12, so Z^-1 K r has errors of 10^-4. */
START_TEST(eq_30_3_a_slow_ground_leaves_all_digits)
{
    linear_system s = { .d = 2, .mass = { 1, 1 } };
    springs(&s, (const double[]){ 1, 1e12 });
    point_into(&s);
    const fvi_linear_motion motion = { .system = &s.system };
    fvi_response *r = response_of(&motion);
    const double omega = 0x1p-20;
    double T[2];
    OK(fvi_response_at(r, FVI_RESPONSE_GROUND, 1, &omega, 0, 0, T, NULL));
    ck_assert_near(T[0], 1 + 2 * omega * omega, 8 * pow(omega, 4) + 2 * U, "T");
    fvi_response_free(r);
}
END_TEST

/* ---- what is refused ---- */

#define REFUSED(want, field_, call)                                            \
    do {                                                                       \
        fvi_error error = { 0 };                                               \
        ck_assert_int_eq((call), want);                                        \
        ck_assert_int_eq(error.code, want);                                    \
        ck_assert_str_eq(error.field ? error.field : "", field_);              \
    } while (0)

static int no_hessian(size_t d, const double *x, void *params, double *H)
{
    (void)d, (void)x, (void)params, (void)H;
    return -7;
}

static int nan_hessian(size_t d, const double *x, void *params, double *H)
{
    (void)x, (void)params;
    for (size_t i = 0; i < d * d; i++)
        H[i] = NAN;
    return 0;
}

START_TEST(bad_systems_are_refused)
{
    linear_system s;
    make_system(2, &s);
    fvi_response *r;
    fvi_linear_motion motion = { .system = &s.system };
    REFUSED(FVI_EFAULT, "system", fvi_response_alloc(NULL, &r, &error));
    REFUSED(FVI_EFAULT, "system", fvi_response_alloc(&motion, NULL, &error));
    const double at[2] = { 0, INFINITY };
    motion.at = at;
    REFUSED(FVI_EDOM, "at", fvi_response_alloc(&motion, &r, &error));
    motion.at = NULL;
    s.mass[1] = -1;
    REFUSED(FVI_EDOM, "mass", fvi_response_alloc(&motion, &r, &error));
    s.mass[1] = 1;
    s.term[1]->alpha = 2;
    REFUSED(FVI_EDOM, "damper", fvi_response_alloc(&motion, &r, &error));
    s.term[1]->alpha = 0.5;
    s.row[1][0] = NAN;
    REFUSED(FVI_EBADFUNC, "damper", fvi_response_alloc(&motion, &r, &error));
    s.row[1][0] = 0;
    s.none[0] = 1;
    motion.alpha = 1.5;
    REFUSED(FVI_EDOM, "alpha", fvi_response_alloc(&motion, &r, &error));
    fvi_kernel nothing = { 0 };
    motion.law = &nothing;
    REFUSED(FVI_EINVAL, "law", fvi_response_alloc(&motion, &r, &error));
    motion.law = NULL;
    motion.alpha = 0.5;
    s.system.potential.hessian = no_hessian;
    REFUSED(-7, "potential", fvi_response_alloc(&motion, &r, &error));
    s.system.potential.hessian = nan_hessian;
    REFUSED(FVI_EBADFUNC, "potential", fvi_response_alloc(&motion, &r, &error));
}
END_TEST

START_TEST(bad_questions_are_refused)
{
    linear_system s;
    make_system(2, &s);
    const fvi_linear_motion motion = { .system = &s.system };
    fvi_response *r = response_of(&motion);
    double omega[2] = { 1, 0 }, H[4];
    const fvi_response_kind none = (fvi_response_kind)9;
    REFUSED(FVI_EINVAL, "kind", fvi_response_at(r, none, 1, omega, 0, 0, H, &error));
    REFUSED(FVI_EINVAL, "at", fvi_response_at(r, FVI_RESPONSE_RECEPTANCE, 1, omega, 2, 0, H, &error));
    REFUSED(FVI_EINVAL, "by", fvi_response_at(r, FVI_RESPONSE_RECEPTANCE, 1, omega, 0, 2, H, &error));
    OK(fvi_response_at(r, FVI_RESPONSE_GROUND, 1, omega, 0, 2, H, NULL));
    fvi_error second = { 0 };
    ck_assert_int_eq(fvi_response_at(r, FVI_RESPONSE_RECEPTANCE, 2, omega, 0, 0, H, &second), FVI_EDOM);
    ck_assert_uint_eq(second.index, 1);
    const double zero[2] = { 0, 0 }, x[4] = { 1 };
    REFUSED(FVI_EDOM, "s", fvi_response_solve(r, zero, x, H, &error));
    REFUSED(FVI_EFAULT, "", fvi_response_solve(r, zero, x, NULL, &error));
    REFUSED(FVI_EFAULT, "", fvi_response_multiply(r, NULL, 0, x, H, &error));
    fvi_response_free(r);
    fvi_response_free(NULL);
    s.system.mechanism = NULL; /* x'' + 4 x = 0: resonance at 2 */
    s.K[1] = s.K[2] = 0;
    s.K[0] = 4;
    r = response_of(&motion);
    omega[0] = 2;
    REFUSED(FVI_ESING, "omega", fvi_response_at(r, FVI_RESPONSE_RECEPTANCE, 1, omega, 0, 0, H, &error));
    fvi_response_free(r);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("response");
    ADD_CASE(suite, "values", eq_30_2_responses_match_40_digits,
             eq_30_1_dampings_of_a_system_are_dampers,
             eq_30_1_is_linear_around_a_place, sparse_and_dense_factors_agree,
             a_response_is_what_is_left_of_a_motion,
             eq_30_3_the_ground_moves_along_a_direction, eq_30_3_a_fast_ground_leaves_all_digits,
             eq_30_3_a_slow_ground_leaves_all_digits,
             a_structure_responds_as_its_masses_do);
    ADD_CASE(suite, "refused", bad_systems_are_refused,
             bad_questions_are_refused);
    return run_suite(suite);
}
