/* tests/lobatto/test_lobatto_coordinates.c -- H 17: runs of several coordinates that must agree.
 * Run alone: make test-lobatto_coordinates */
#include "lobatto_pairs.h"
#include "run/whole_run.h"

/* A run in three dimensions into x and p. */
static void solve3(const fvi_system *system, size_t s, double alpha,
                   fvi_history_kind memory, const double *x0, const double *p0)
{
    const fvi_run run = { .system = system,
                          .x0 = x0,
                          .p0 = p0,
                          .h = 0.1,
                          .steps = N,
                          .alpha = alpha,
                          .past = FVI_INITIAL_HISTORY_CAPUTO,
                          .memory = memory };
    ck_assert_int_eq(fvi_trajectory(methods[s], &run, x, p, NULL), 0);
}

//> chain
/* Three equal masses and four equal springs, with equal damping, are three
 * oscillators c (2 - 2 cos(j pi/4)) in disguise, sin(i j pi/4) their shapes. The
 * bound: three runs. Seen: 0.009 of it. */
START_TEST(eq_17_8_a_chain_is_its_modes)
{
    const double cg[] = { 1, 0 }, one[] = { 1, 1, 1 },
                 rho[] = { 0.3, 0.3, 0.3 };
    const fvi_system system = { 3,     one, rho, fvi_potential_chain(cg),
                                { 0 }, NULL, NULL };
    for (size_t s = 2; s <= 4; s++)
        for (size_t i = 0; i < LEN(alphas); i++) {
            double start[3], push[3];
            for (size_t c = 0; c < 3; c++) {
                start[c] = push[c] = 0;
                for (size_t j = 1; j <= 3; j++) {
                    start[c] += sin((double)((c + 1) * j) * M_PI_4);
                    push[c] -= 0.5 * sin((double)((c + 1) * j) * M_PI_4);
                }
            }
            solve3(&system, s, alphas[i], FVI_HISTORY_AUTO, start, push);
            for (size_t j = 1; j <= 3; j++) {
                const setup a = { .s = s,
                                  .alpha = alphas[i],
                                  .rho = 0.3,
                                  .x0 = 1,
                                  .p0 = -0.5,
                                  .h = 0.1,
                                  .steps = N,
                                  .cg = { 2 - 2 * cos((double)j * M_PI_4) } };
                solve(&a, want_x, want_p);
                for (size_t k = 0; k <= N; k++) {
                    double amplitude = 0;
                    for (size_t c = 0; c < 3; c++)
                        amplitude += x[3 * k + c] / 2
                                     * sin((double)((c + 1) * j) * M_PI_4);
                    ck_assert_near(amplitude, want_x[k], 3 * rounding(&a),
                                   "s=%zu alpha=%g mode %zu k=%zu", s,
                                   alphas[i], j, k);
                }
            }
        }
}
END_TEST
//< chain

/* Three masses that do not feel each other, two of them equal, one of the two undamped, or
 * two with equal damping, Duffing: each as it is alone. Newton's method stops for all at
 * once: rounding. Seen: 0.002 of the bound. */
START_TEST(eq_17_8_only_damped_coordinates_have_a_history)
{
    const double cg[] = { 1, 1 }, mass[] = { 1, 1, 0.5 },
                 rhos[][3] = { { 0.3, 0, 1 }, { 0, 1, 1 } },
                 start[] = { 1, -0.5, 0.3 }, push[] = { 0.2, 0, -0.4 },
                 aw[] = { 1, 2 };
    for (size_t s = 2; s <= 4; s++)
        for (size_t i = 0; i < 2 * LEN(alphas); i++) {
            const double *rho = rhos[i % 2], alpha = alphas[i / 2];
            const fvi_system system = {
                3,   mass, rho, fvi_potential_duffing(cg), fvi_force_cosine(aw),
                NULL, NULL
            };
            solve3(&system, s, alpha, FVI_HISTORY_DIRECT, start, push);
            for (size_t c = 0; c < 3; c++) {
                const setup a = { .s = s,
                                  .alpha = alpha,
                                  .rho = rho[c],
                                  .mass = mass[c],
                                  .x0 = start[c],
                                  .p0 = push[c],
                                  .h = 0.1,
                                  .steps = N,
                                  .cg = { 1, 1 },
                                  .memory = FVI_HISTORY_DIRECT,
                                  .force = fvi_force_cosine(aw) };
                solve(&a, want_x, want_p);
                for (size_t k = 0; k <= N; k++)
                    ck_assert_near(x[3 * k + c], want_x[k], rounding(&a),
                                   "s=%zu alpha=%g mass %zu k=%zu", s, alpha, c,
                                   k);
            }
        }
}
END_TEST

/* The quadratic path of the code and Newton's: one promises a constant Hessian.
 * Seen: 5e-16. */
START_TEST(eq_17_8_newton_finds_what_one_factorisation_finds)
{
    const double cg[] = { 1, 0 }, one[] = { 1, 2, 1 }, rho[] = { 0.3, 0, 0.6 },
                 start[] = { 1, -0.5, 0.3 }, push[] = { 0.2, 0, -0.4 };
    fvi_system system = { 3, one, rho, fvi_potential_chain(cg), { 0 }, NULL, NULL };
    for (size_t s = 2; s <= 4; s++) {
        system.potential = fvi_potential_chain(cg);
        solve3(&system, s, 0.3, FVI_HISTORY_AUTO, start, push);
        memcpy(want_x, x, sizeof x);
        system.potential.quadratic = NULL;
        solve3(&system, s, 0.3, FVI_HISTORY_AUTO, start, push);
        ck_assert_near(farthest(0, 3 * N + 3, x, want_x), 0, 10 * N * U,
                       "s=%zu", s);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("lobatto_coordinates");
    ADD_CASE(suite, "identities", eq_17_8_a_chain_is_its_modes,
             eq_17_8_only_damped_coordinates_have_a_history,
             eq_17_8_newton_finds_what_one_factorisation_finds);
    return run_suite(suite);
}
