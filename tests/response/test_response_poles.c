/* tests/response/test_response_poles.c -- Poles and their shapes.        [H 30]
 * Run alone: make test-response_poles */
#include "response_systems.h"

#include "frequency/dynamic_stiffness.h"
#include "response/response_ref.h"

static double size_of_shape(const fvi_poles *p, size_t k)
{
    double sum = 0;
    for (size_t i = 0; i < p->d; i++)
        sum += creal(shape(p, k, i) * conj(shape(p, k, i)));
    return sum;
}

/* ---- values ---- */

/* ds = v^T dZ v, as v^T Z' v = 1: |v|^2 times 4 u of what Z is summed from. A residue has the
 * error of its shape, too: 1e-13 of |v|^2 (no proof). Seen: 0.3 and 0.02 of it. */
START_TEST(eq_30_5_poles_and_residues_match_40_digits)
{
    size_t k = 0;
    for (int which = 0; which < 3; which++) {
        linear_system s;
        make_system(which, &s);
        const fvi_linear_motion motion = { .system = &s.system };
        fvi_response *r = response_of(&motion);
        fvi_poles p = poles_of(r, 0);
        ck_assert_uint_eq(p.count, s.d);
        ck_assert_uint_eq(p.expected, s.d);
        for (size_t i = 0; i < p.count; i++, k++) {
            const double complex z = pole(&p, i),
                                 R = shape(&p, i, s.d - 1) * shape(&p, i, 0);
            const double size = size_of_shape(&p, i),
                         bound = 4 * U * size * fvi_stiffness_norm(r, z)
                                 + 2 * U * cabs(z);
            ck_assert_int_eq(roots[k].system, which);
            ck_assert_near(creal(z), roots[k].re, bound, "re of %zu", k);
            ck_assert_near(cimag(z), roots[k].im, bound, "im of %zu", k);
            ck_assert_near(creal(R), roots[k].residue_re, 1e-13 * size, "residue %zu", k);
            ck_assert_near(cimag(R), roots[k].residue_im, 1e-13 * size, "residue %zu", k);
            ck_assert_near(p.residual[i], 0, 20 * U, "residual %zu", k);
        }
        fvi_poles_free(&p);
        fvi_response_free(r);
    }
    ck_assert_uint_eq(k, LEN(roots));
}
END_TEST

/* ---- all of Z^-1 ---- */

/* The poles' part of (30.6). */
static double complex modes(const fvi_poles *p, double complex s, size_t i, size_t j)
{
    double complex sum = 0;
    for (size_t k = 0; k < p->count; k++) {
        const double complex R = shape(p, k, i) * shape(p, k, j), z = pole(p, k);
        sum += R / (s - z) + conj(R) / (s - conj(z));
    }
    return sum;
}

/* The integral along the cut, by the trapezoidal rule in ln r: e^{-40} is left out at both ends, and
 * the nearest pole of the integrand is 0.03 away from the cut in the angle or more. */
//> cut
static double complex cut(fvi_response *r, double complex s, size_t i, size_t j)
{
    const double step = 1.0 / 128;
    double complex sum = 0;
    for (int n = -40 * 128; n <= 40 * 128; n++) {
        const double radius = exp(n * step), at[2] = { -radius, 0 };
        double complex x[MOST] = { 0 };
        x[j] = 1;
        OK(fvi_response_solve(r, at, (double *)x, (double *)x, NULL));
        sum += cimag(x[i]) * radius / (s + radius) * step;
    }
    return -sum / M_PI;
}
//< cut

/* Poles, residues, cut and response at once. The modes alone are off by 1 to 40 per cent, as the
 * proof script computes. Davidson's symbol is infinite on the cut, so the second system's integral
 * is left to that script. Seen: 1e-15 of |H|. */
START_TEST(eq_30_6_a_response_is_its_modes_and_the_cut)
{
    static const double complex s = 7.3125 * I;
    for (int which = 0; which < 3; which++) {
        linear_system system;
        make_system(which, &system);
        const size_t last = system.d - 1;
        const fvi_linear_motion motion = { .system = &system.system };
        fvi_response *r = response_of(&motion);
        fvi_poles p = poles_of(r, 0);
        const double complex of_modes = modes(&p, s, last, last),
                             want = parts[which].modes_re + I * parts[which].modes_im,
                             H = parts[which].re + I * parts[which].im;
        ck_assert_near(cabs(of_modes - want), 0, 1e-14 * cabs(want), "modes of %d", which);
        seen(cabs(of_modes - H) / cabs(H), "modes alone, system %d", which);
        if (which != 1) {
            const double apart = cabs(of_modes + cut(r, s, last, last) - H) / cabs(H);
            seen(apart, "modes and cut, system %d", which);
            ck_assert_near(apart, 0, 1e-14, "system %d", which);
        }
        fvi_poles_free(&p);
        fvi_response_free(r);
    }
}
END_TEST

/* The body of Chapter 1, m = c = 1, rho = 1/2, alpha = 1/4. At omega = 1 mass and spring cancel, and the
 * damping alone is left: H = 2 e^(-i pi/4). Its poles alone would jump by 2 Re R at a knock, and would
 * give way to a constant force by -2 Re(R / s), which is not 1. */
START_TEST(eq_30_6_poles_alone_of_the_body_of_chapter_1)
{
    const double one = 1, half = 0.5;
    const fvi_system body = { .d = 1, .mass = &one, .damping = &half,
                              .potential = fvi_potential_harmonic(&one) };
    const fvi_linear_motion motion = { .system = &body, .alpha = 0.25 };
    fvi_response *r = response_of(&motion);
    double H[2];
    OK(fvi_response_at(r, FVI_RESPONSE_RECEPTANCE, 1, &one, 0, 0, H, NULL));
    ck_assert_near(H[0], M_SQRT2, 4 * U, "re");
    ck_assert_near(H[1], -M_SQRT2, 4 * U, "im");
    fvi_poles p = poles_of(r, 0);
    const double complex s = pole(&p, 0), v = shape(&p, 0, 0), R = v * v;
    seen(creal(s), "re");
    seen(cimag(s), "im");
    seen(cabs(s) / (2 * M_PI), "frequency");
    seen(-creal(s) / cabs(s), "damping ratio");
    seen(creal(R), "re R");
    seen(-cimag(R), "minus im R");
    seen(-2 * creal(R), "jump");
    seen(-2 * creal(R / s), "static");
    /* the cut makes up for both: its integrals of 1 and of 1/r, by the tail of (30.6) */
    ck_assert_near(creal(1e-7 * modes(&p, 1e-7, 0, 0)), 1e-7 * -2 * creal(R / s), 1e-12, "static");
    ck_assert_near(creal(1e7 * modes(&p, 1e7, 0, 0)), 2 * creal(R), 1e-6, "jump");
    double at_once = 0, at_last = 0;
    for (int n = -40 * 32; n <= 40 * 32; n++) {
        const double radius = exp(n / 32.0), at[2] = { -radius, 0 };
        double complex x = 1;
        OK(fvi_response_solve(r, at, (double *)&x, (double *)&x, NULL));
        at_once -= cimag(x) * radius / M_PI / 32;
        at_last -= cimag(x) / M_PI / 32;
    }
    ck_assert_near(at_once, -2 * creal(R), 1e-8, "the cut's jump"); /* its tail is r^-1.5 */
    ck_assert_near(at_last, 1 + 2 * creal(R / s), 1e-7, "the cut's part of the static place");
    fvi_poles_free(&p);
    fvi_response_free(r);
}
END_TEST

/* ---- one oscillator ---- */

/* Where H 11 and H 26 have a pole of their own. Two searches differ by some roundings of |s|:
 * seen 4 u. */
START_TEST(one_oscillator_has_the_pole_of_the_exact_solution)
{
    uint64_t seed = 11;
    int compared = 0;
    for (int i = 0; i < 400; i++) {
        const double m = exp(6 * chance(&seed) - 3), c = exp(6 * chance(&seed) - 3),
                     rho = exp(6 * chance(&seed) - 3), a = 0.02 + 0.96 * chance(&seed);
        const double below = a < 0.49 ? a : 0.49;
        const fvi_kernel_term terms[2] = {
            { FVI_KERNEL_ZENER, rho, below, exp(4 * chance(&seed) - 2), 0 },
            { FVI_KERNEL_POWER, rho, a, 0, 0 }
        };
        const fvi_kernel law = { 1, &terms[i % 2] };
        const fvi_linear_oscillator problem = { .m = m, .c = c, .rho = 1, .law = &law };
        const double one = 1;
        const fvi_system system = { .d = 1, .mass = &m, .damping = &one,
                                    .potential = fvi_potential_harmonic(&c) };
        const fvi_linear_motion motion = { .system = &system, .law = &law };
        double re, im;
        if (fvi_exact_pole(&problem, &re, &im, NULL))
            continue; /* with arg s > 2.95 it is not looked for there */
        compared++;
        fvi_response *r = response_of(&motion);
        fvi_poles p = poles_of(r, 0);
        ck_assert_uint_eq(p.count, 1);
        ck_assert_near(p.pole[0], re, 8 * U * hypot(re, im), "re of %d", i);
        ck_assert_near(p.pole[1], im, 8 * U * hypot(re, im), "im of %d", i);
        fvi_poles_free(&p);
        fvi_response_free(r);
    }
    ck_assert_int_eq(compared, 399);
}
END_TEST

/* A fraction with 2 alpha > 1 has a pole of its own, and so the body has two. mpmath's findroot
 * has the slow one in 25 digits. */
START_TEST(eq_26_11_one_oscillator_may_have_two_poles)
{
    const fvi_kernel_term term = { FVI_KERNEL_ZENER, 1, 0.8, 2, 0 };
    const fvi_kernel law = { 1, &term };
    const double one = 1;
    const fvi_system system = { .d = 1, .mass = &one, .damping = &one,
                                .potential = fvi_potential_harmonic(&one) };
    const fvi_linear_motion motion = { .system = &system, .law = &law };
    fvi_response *r = response_of(&motion);
    fvi_poles p = poles_of(r, 0);
    ck_assert_uint_eq(p.count, 2);
    ck_assert_uint_eq(p.expected, 2);
    const size_t slow = p.pole[0] > p.pole[2] ? 0 : 1;
    ck_assert_near(p.pole[2 * slow], -0.0620223882620713, 1e-14, "re");
    ck_assert_near(p.pole[2 * slow + 1], 1.28935238232783, 1e-13, "im");
    fvi_poles_free(&p);
    fvi_response_free(r);
}
END_TEST

/* ---- others ---- */

/* Two equal masses without a spring between them have one pole and two shapes, which are orthogonal
 * in Z'. */
START_TEST(a_double_pole_has_two_shapes)
{
    linear_system s;
    make_system(2, &s);
    memset(s.K, 0, sizeof s.K);
    s.K[0] = s.K[3] = 4;
    s.row[1][0] = 0;
    s.term[1][0] = s.term[0][0];
    const fvi_linear_motion motion = { .system = &s.system };
    fvi_response *r = response_of(&motion);
    fvi_poles p = poles_of(r, 0);
    ck_assert_uint_eq(p.count, 2);
    ck_assert_near(cabs(pole(&p, 0) - pole(&p, 1)), 0, 1e-14, "apart");
    const double complex v[2] = { shape(&p, 0, 0), shape(&p, 0, 1) },
                         w[2] = { shape(&p, 1, 0), shape(&p, 1, 1) };
    const double complex z = pole(&p, 0), C = 0.5 * cpow(z, 1.625);
    double complex y[2];
    OK(fvi_response_multiply(r, p.pole, 1, p.shape, (double *)y, NULL));
    ck_assert_near(cabs(v[0] * y[0] + v[1] * y[1] - 1), 0, 1e-14, "v Z' v");
    ck_assert_near(cabs(w[0] * y[0] + w[1] * y[1]), 0, 1e-14, "w Z' v");
    ck_assert_near(cabs(z * z + 4 + C), 0, 1e-14, "it is a pole");
    fvi_poles_free(&p);
    fvi_response_free(r);
}
END_TEST

START_TEST(bad_counts_are_refused)
{
    linear_system s;
    make_system(2, &s);
    const fvi_linear_motion motion = { .system = &s.system };
    fvi_response *r = response_of(&motion);
    fvi_poles p = { 0 };
    fvi_error error;
    ck_assert_int_eq(fvi_poles_find(r, 3, &p, &error), FVI_EINVAL);
    ck_assert_str_eq(error.field, "count");
    ck_assert_int_eq(fvi_poles_find(NULL, 0, &p, &error), FVI_EFAULT);
    ck_assert_int_eq(fvi_poles_find(r, 0, NULL, &error), FVI_EFAULT);
    fvi_poles_free(&p);
    fvi_response_free(r);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("response_poles");
    ADD_CASE(suite, "values", eq_30_5_poles_and_residues_match_40_digits,
             eq_30_6_a_response_is_its_modes_and_the_cut,
             eq_30_6_poles_alone_of_the_body_of_chapter_1);
    ADD_CASE(suite, "one", one_oscillator_has_the_pole_of_the_exact_solution,
             eq_26_11_one_oscillator_may_have_two_poles);
    ADD_CASE(suite, "others", a_double_pole_has_two_shapes, bad_counts_are_refused);
    return run_suite(suite);
}
