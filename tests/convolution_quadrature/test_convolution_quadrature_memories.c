/* tests/convolution_quadrature/test_convolution_quadrature_memories.c -- Chapter 13: the same run by every
 * memory, and the runs that are refused.
 * Run alone: make test-convolution_quadrature_memories */
#include "harness/fvi_runs.h"
#include "run/whole_run.h"

#include "convolution_quadrature_runs.h"

static const fvi_history_kind kinds[] = { FVI_HISTORY_DIRECT,
                                         FVI_HISTORY_MODES,
                                         FVI_HISTORY_AUTO };

static void motion(const fvi_method *method, int which, double alpha, size_t N,
                   fvi_history_kind kind, double *x)
{
    static const double one[] = { 1, 1, 1, 1 }, zero[4], cg[] = { 1, 1 },
                        pushes[] = { 8, 1 }, wave[] = { 0.5, 1.2 },
                        up[] = { 1, 0, -0.5, 0.2 };
    /* within the stable steps of both, (13.14) */
    const double R = method == &fvi_cq_bdf2 && alpha > 0.75 ? 0.2 : 1,
                 rho[] = { R, 0, 0.3 * R, 0.7 * R };
    fvi_system system = {
        1, one, rho, fvi_potential_harmonic(one), fvi_force_step(pushes), NULL, NULL
    };
    if (which == 1)
        system = (fvi_system){
            4, one, rho, fvi_potential_chain(cg), fvi_force_cosine(wave), NULL, NULL
        };
    if (which == 2)
        system = (fvi_system){
            1,   one, rho, fvi_potential_pendulum(one), fvi_force_cosine(wave),
            NULL, NULL
        };
    const fvi_run run = { .system = &system,
                          .x0 = which ? up : zero,
                          .p0 = zero,
                          .h = 20 / (double)N,
                          .steps = N,
                          .kappa = 0.5,
                          .alpha = alpha,
                          .memory = kind };
    ck_assert_int_eq(fvi_trajectory(method, &run, x, NULL, NULL), FVI_SUCCESS);
}

/* The promise of memory.h is 1e-13 max |x|; a factor of 10 for motions that part,
 * and for the factor of BDF2, sum |g_n| <= 4.
 * Bagley and Torvik, a quartic chain, a driven pendulum. Seen: 1.2e-14. */
//> memories
START_TEST(eq_13_11_all_memories_give_the_same_trajectory)
{
    enum { N = 3000 };
    const double alphas[] = { 0, 0.1, 0.25, 0.5, 0.75, 0.9, 1 };
    static double want[4 * N + 4], x[4 * N + 4];
    for (size_t i = 0; i < LEN(methods) * LEN(alphas) * 3; i++) {
        const size_t which = i % 3, count = which == 1 ? 4 * N + 4 : N + 1;
        const double alpha = alphas[i / 3 % LEN(alphas)];
        const fvi_method *method = methods[i / 3 / LEN(alphas)];
        motion(method, (int)which, alpha, N, FVI_HISTORY_DIRECT, want);
        for (size_t k = 1; k < LEN(kinds); k++) {
            motion(method, (int)which, alpha, N, kinds[k], x);
            const double off =
                farthest(count, x, want) / farthest(count, want, NULL);
            seen(off, "difference");
            ck_assert_near(off, 0, 1e-12, "%s alpha=%g problem %zu kind %zu",
                           method->name, alpha, which, k);
        }
    }
}
END_TEST
//< memories

/* ---- errors ---- */

START_TEST(runs_that_cannot_be_done_are_refused)
{
    const double one = 1, c = 1, minus = -1;
    fvi_system good = {
        1, &one, &one, fvi_potential_harmonic(&c), { 0 }, NULL, NULL
    };
    fvi_system light = good;
    light.mass = &minus;
    const struct {
        const fvi_system *system;
        double alpha, kappa, h;
        size_t steps;
        fvi_history_kind kind;
        double tolerance;
        int status;
    } bad[] = {
        { NULL, 0.3, 0.5, 0.1, 9, FVI_HISTORY_AUTO, 0, FVI_EFAULT },
        { &light, 0.3, 0.5, 0.1, 9, FVI_HISTORY_AUTO, 0, FVI_EDOM },
        { &good, 1.1, 0.5, 0.1, 9, FVI_HISTORY_AUTO, 0, FVI_EDOM },
        { &good, 0.3, 1.5, 0.1, 9, FVI_HISTORY_AUTO, 0, FVI_EDOM },
        { &good, 0.3, 0.5, 0, 9, FVI_HISTORY_AUTO, 0, FVI_EDOM },
        { &good, 0.3, 0.5, 0.1, 0, FVI_HISTORY_AUTO, 0, FVI_EINVAL },
        { &good, 0.3, 0.5, 0.1, 9, (fvi_history_kind)9, 0, FVI_EINVAL },
        { &good, 0.3, 0.5, 0.1, 9, FVI_HISTORY_AUTO, 1, FVI_EDOM },
        { &good, 0.3, 0.5, 0.1, SIZE_MAX, FVI_HISTORY_DIRECT, 0, FVI_EINVAL },
        { &good, 0.3, 0.5, 0.1, (size_t)1 << 50, FVI_HISTORY_DIRECT, 0,
          FVI_ENOMEM },
        { &good, 0.3, 0.5, 0.1, 1000, FVI_HISTORY_AUTO, 1e-15, FVI_ETOL },
    };
    fvi_stepper *const sentinel = (fvi_stepper *)&good, *s = sentinel;
    for (size_t i = 0; i < LEN(bad) * LEN(methods); i++) {
        const size_t r = i / LEN(methods);
        const fvi_run run = { .system = bad[r].system,
                              .x0 = &one,
                              .p0 = &one,
                              .h = bad[r].h,
                              .steps = bad[r].steps,
                              .kappa = bad[r].kappa,
                              .alpha = bad[r].alpha,
                              .memory = bad[r].kind,
                              .tolerance = bad[r].tolerance };
        ck_assert_int_eq(fvi_stepper_start(methods[i % LEN(methods)], &run, &s,
                                           NULL),
                         bad[r].status);
        ck_assert_ptr_eq(s, sentinel);
    }
    /* theta rho h^(1 - 2 alpha) = 10^320; a motion that leaves the doubles */
    fvi_run run = { .system = &good,
                    .x0 = &one,
                    .p0 = &one,
                    .h = 1e-320,
                    .steps = 9,
                    .kappa = 0.5,
                    .alpha = 1 };
    ck_assert_int_eq(fvi_stepper_start(&fvi_cq2_shifted, &run, &s,
                                       NULL), FVI_EDOM);
    const double far = 1.7e308;
    run.h = 1;
    run.x0 = run.p0 = &far;
    double x[10] = { 0 };
    for (size_t i = 0; i < LEN(methods); i++)
        ck_assert_int_eq(fvi_trajectory(methods[i], &run, x, NULL, NULL),
                         FVI_EOVRFLW);
}
END_TEST

/* Under AddressSanitizer, too, malloc may say no. */
const char *__asan_default_options(void);
const char *__asan_default_options(void)
{
    return "allocator_may_return_null=1";
}

int main(void)
{
    Suite *suite = suite_create("13 convolution quadrature: memories");
    ADD_CASE(suite, "identities",
             eq_13_11_all_memories_give_the_same_trajectory);
    ADD_CASE(suite, "errors", runs_that_cannot_be_done_are_refused);
    return run_suite(suite);
}
