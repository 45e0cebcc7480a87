/* tests/step_search/test_step_search_decides.c -- H 18: the reasons for which a run is refused.
 * Run alone: make test-step_search_decides */
#include "credulous.h"
#include "error_control/step_search.h"
#include "system/larger.h"

/* W = 2.5e13 down to 1.6e12. The next terms of the cosine and of the phase are below
 * 1e-7 of D, the rounding of a few steps is below 1e-5 of it, and of the D before, which
 * is a sixteenth, below 1e-4. Seen: 8e-6 of D; 5e-4 of growth. */
START_TEST(eq_18_6_differences_of_what_stands_still_grow)
{
    const double one = 1, none = 0, c = 1e16;
    const fvi_system system = { 1,     &one, &none, fvi_potential_harmonic(&c),
                                { 0 }, NULL, NULL };
    const fvi_run run = { .system = &system,
                          .x0 = &one,
                          .p0 = &none,
                          .h = 0.1,
                          .steps = 10,
                          .kappa = 0.5,
                          .alpha = 0.5 };
    double x[3][11], D[2] = { 0 };
    for (size_t j = 0; j < 3; j++)
        run_rows(&fvi_cq2_shifted, run, 10, (size_t)2 << j, x[j]);
    for (size_t j = 0; j < 2; j++)
        for (size_t k = 0; k <= 10; k++)
            D[j] = larger(D[j], fabs(x[j + 1][k] - x[j][k]));
    for (size_t k = 0; k <= 10; k++) {
        double t = 0.1 * (double)k, h = 0.1 / 8;
        ck_assert_near(1 - x[2][k], 8 * t * t / (pow(h, 4) * c), 1e-4 * D[1],
                       "row %zu", k);
    }
    ck_assert_near(D[1] / D[0], 16, 1e-3, "growth");
}
END_TEST

/* So stiff that x stands still at every node of every run: all D are rounding. */
START_TEST(eq_18_6_what_stands_still_is_not_what_converged)
{
    for (int light = 0; light < 2; light++) {
        const fvi_linear_oscillator q = {
            .m = light ? 1e-30 : 1, .c = light ? 1 : 1e30, .alpha = 0.5, .x0 = 1
        };
        fvi_step_found found;
        double worst;
        ck_assert_int_eq(search_linear(&fvi_cq2_shifted, &q, 20, 20, 1e-2, 1 << 12,
                                       &found, &worst),
                         FVI_ETOL);
        ck_assert_int_eq(search_with(credulous, &fvi_cq2_shifted, &q, 20, 20, 1e-2,
                                     1 << 12, &found, &worst),
                         FVI_SUCCESS);
        ck_assert(worst > 1);
    }
    const fvi_linear_oscillator rest = { .m = 1, .c = 1e3, .alpha = 0.5 };
    fvi_step_found found; /* but what is at rest is found to be */
    double worst;
    ck_assert_int_eq(search_linear(&fvi_cq2_shifted, &rest, 20, 20, 1e-2, 1 << 16,
                                   &found, &worst),
                     FVI_SUCCESS);
}
END_TEST

/* At rest in 0, D is 0. The fast link is beside the diagonal of the Hessian, which
 * is 0: a matrix, or a band of two diagonals; the light mass is the second or the
 * first. */
static int link_value(size_t d, const double *x, void *params, double *value)
{
    (void)d, (void)params;
    *value = 1e30 * x[0] * x[1];
    return 0;
}

static int link_gradient(size_t d, const double *x, void *params, double *g)
{
    (void)d, (void)params;
    g[0] = 1e30 * x[1];
    g[1] = 1e30 * x[0];
    return 0;
}

static int link_band(size_t d, const double *x, void *params, double *H)
{
    (void)d, (void)x, (void)params;
    H[0] = H[2] = 0;
    H[1] = 1e30;
    return 0;
}

static int link_full(size_t d, const double *x, void *params, double *H)
{
    link_band(d, x, params, H);
    H[2] = H[1];
    H[3] = 0;
    return 0;
}

static int always(const void *params)
{
    (void)params;
    return 1;
}

START_TEST(eq_18_6_all_of_a_row_of_the_hessian_counts)
{
    const double masses[][2] = { { 1e30, 1 }, { 1, 1e30 } }, none[] = { 0, 0 };
    for (size_t i = 0; i < 4; i++) {
        fvi_potential u = {
            link_value, link_gradient, i < 2 ? link_full : link_band,
            NULL,       always,        i < 2 ? 0 : 2,
            NULL,       NULL
        };
        const fvi_system system = { 2, masses[i % 2], none, u, { 0 }, NULL, NULL };
        const fvi_run run = { .system = &system,
                              .x0 = none,
                              .p0 = none,
                              .h = 0.1,
                              .steps = 128,
                              .kappa = 0.5,
                              .alpha = 0.5 };
        double x[2 * 129];
        fvi_step_found found;
        ck_assert_int_eq(fvi_step_search(&fvi_cq2_shifted, &run, 1e300, 1 << 12, x,
                                         NULL, &found),
                         FVI_ETOL);
    }
}
END_TEST

static double fast; /* the frequency of what hides */

/* Coordinate 0 hides a hundredth that all nodes see in one phase. */
static int two_tones(double t, size_t d, void *params, double *F)
{
    (void)params;
    for (size_t i = 0; i < d; i++)
        F[i] = cos(t) + (i == 0 ? 0.01 * cos(fast * t) : 0);
    return 0;
}

START_TEST(eq_18_7_a_small_fast_part_of_a_force_is_seen)
{
    const double mass[] = { 1, 1 }, rho[] = { 0.2, 0.2 }, c = 1,
                 none[] = { 0, 0 };
    const fvi_system system = {
        2, mass, rho, fvi_potential_harmonic(&c), { .value = two_tones }, NULL, NULL
    };
    const fvi_run run = { .system = &system,
                          .x0 = none,
                          .p0 = none,
                          .h = 0.125,
                          .steps = 128,
                          .kappa = 0.5,
                          .alpha = 0.3 };
    double x[2 * 129];
    fvi_step_found found;
    fast = 2 * M_PI * 0x1p12;
    ck_assert_int_eq(
        fvi_step_search(&fvi_lobatto_m3, &run, 1e-3, 1 << 13, x, NULL, &found),
        FVI_ETOL);
    fast = 3; /* nothing hides */
    ck_assert_int_eq(
        fvi_step_search(&fvi_lobatto_m3, &run, 1e-3, 1 << 13, x, NULL, &found),
        FVI_SUCCESS);
}
END_TEST

/* Forces that jump at every row, and at no other time: there they have the limit
 * from the right, or that from the left, and both limits are compared. */
static int from_right(double t, size_t d, void *params, double *F)
{
    (void)params;
    for (size_t i = 0; i < d; i++)
        F[i] = fmod(floor(8 * t), 2) == 0 ? 1 : -1;
    return 0;
}

static int from_left(double t, size_t d, void *params, double *F)
{
    (void)params;
    for (size_t i = 0; i < d; i++)
        F[i] = fmod(ceil(8 * t), 2) == 0 ? 1 : -1;
    return 0;
}

START_TEST(eq_18_7_jumps_at_rows_are_no_obstacle)
{
    const double one = 1, none = 0;
    const fvi_force forces[] = { { .value = from_right },
                                 { .value = from_left } };
    for (size_t i = 0; i < 2; i++) {
        const fvi_system system = { 1,         &one,
                                    &one,      fvi_potential_harmonic(&one),
                                    forces[i], NULL, NULL };
        const fvi_run run = { .system = &system,
                              .x0 = &none,
                              .p0 = &none,
                              .h = 0.125,
                              .steps = 128,
                              .kappa = 0.5,
                              .alpha = 0.5 };
        double x[129];
        fvi_step_found found;
        ck_assert_int_eq(fvi_step_search(&fvi_lobatto_m4, &run, 1e-6, 1 << 11, x,
                                         NULL, &found),
                         FVI_SUCCESS);
    }
}
END_TEST

/* F is a constant and the rounding of it: nothing to come nearer to. */
START_TEST(eq_18_7_rounding_is_no_deviation)
{
    const fvi_linear_oscillator q = { .m = 1,
                           .c = 1,
                           .rho = 0.2,
                           .alpha = 0.5,
                           .forcing = FVI_FORCING_COSINE,
                           .A = 5,
                           .w = 1e-8 };
    fvi_step_found found;
    double worst;
    ck_assert_int_eq(
        search_linear(&fvi_cq2_shifted, &q, 20, 20, 1e-3, 1 << 13, &found, &worst),
        FVI_SUCCESS);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("the search for a step: what decides");
    ADD_CASE(suite, "differences",
             eq_18_6_differences_of_what_stands_still_grow,
             eq_18_6_what_stands_still_is_not_what_converged,
             eq_18_6_all_of_a_row_of_the_hessian_counts);
    ADD_CASE(suite, "forces", eq_18_7_a_small_fast_part_of_a_force_is_seen,
             eq_18_7_jumps_at_rows_are_no_obstacle,
             eq_18_7_rounding_is_no_deviation);
    return run_suite(suite);
}
