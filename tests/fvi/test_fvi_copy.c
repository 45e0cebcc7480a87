/* tests/fvi/test_fvi_copy.c -- Copies of runs, and runs that are reset.
 * Run alone: make test-fvi_copy */
#include <fvi/fvi.h>
#include "run/whole_run.h"
#include "harness/ulp.h"

#include <stdlib.h>
#include <string.h>

enum { N = 300, D = 3, ROWS = (N + 1) * D };

static const fvi_method *const methods[] = {
    &fvi_fractional,     &fvi_cq2_shifted,        &fvi_cq_bdf2,
    &fvi_lobatto_m2,       &fvi_lobatto_m3,       &fvi_lobatto_m4,
    &fvi_euler_explicit, &fvi_euler_implicit, &fvi_lagrange_dalembert,
    &fvi_midpoint_variational
};

static const double mass[] = { 1, 2, 0.5 }, none[D], rho[] = { 0.5, 0, 0.25 },
                    x0[] = { 0.5, -0.25, 1 }, rest[D], p0[] = { 0.5, 1, -1 };

/* Step on to row k, and compare each with the rows of a run that nobody forked. */
static void go_on(fvi_stepper *s, size_t k, const double *x, const double *p)
{
    int same = 1;
    while (same && s->k < k)
        same = fvi_stepper_step(s) == 0
               && memcmp(s->x, x + s->k * D, D * sizeof *x) == 0
               && memcmp(s->p, p + s->k * D, D * sizeof *p) == 0
               && s->t == (double)s->k * s->run.h;
    ck_assert_msg(same, "%s, alpha %g, memory %d, past %d: row %zu",
                  s->method->name, s->run.alpha, (int)s->run.memory,
                  (int)s->run.past, s->k);
}

/* The copy alone, its original being gone; the two in turns; and both anew. */
static void fork_at(const fvi_method *method, const fvi_run *given, size_t k,
                    const double *x, const double *p)
{
    double start[2][D]; /* is not read after fvi_stepper_start */
    fvi_run run = *given;
    run.x0 = memcpy(start[0], given->x0, sizeof start[0]);
    run.p0 = memcpy(start[1], given->p0, sizeof start[1]);
    fvi_stepper *s, *twin, *late;
    ck_assert_int_eq(fvi_stepper_start(method, &run, &s, NULL), 0);
    memset(start, 0xff, sizeof start);
    go_on(s, k, x, p);
    ck_assert_int_eq(fvi_stepper_copy(s, &twin), 0);
    ck_assert_int_eq(fvi_stepper_copy(s, &late), 0);
    ck_assert_uint_eq(twin->k, k);
    for (size_t l = k; l < N; l += 10) { /* N - k is not always whole tens */
        go_on(s, l + 10 < N ? l + 10 : N, x, p);
        go_on(twin, l + 10 < N ? l + 10 : N, x, p);
    }
    fvi_stepper_free(s);
    go_on(late, N, x, p);
    fvi_stepper_free(late);
    ck_assert_int_eq(fvi_stepper_reset(twin), 0);
    ck_assert_uint_eq(twin->k, 0);
    ck_assert(twin->t == 0);
    ck_assert_mem_eq(twin->x, x, D * sizeof *x);
    ck_assert_mem_eq(twin->p, p, D * sizeof *p);
    go_on(twin, N, x, p);
    fvi_stepper_free(twin);
}

static void fork_a_run(const fvi_method *method, const fvi_run *run)
{
    const size_t at[] = { 0, 1, 63, 130, N };
    static double x[ROWS], p[ROWS];
    ck_assert_int_eq(fvi_trajectory(method, run, x, p, NULL), 0);
    for (size_t i = 0; i < LEN(at); i++)
        fork_at(method, run, at[i], x, p);
}

/* All memories, both sides of 2 alpha = 1 and its ends, all pasts that have a
 * solution; with a matrix that is factorised once, and with Newton's method. Equal to
 * the bit: nothing is computed anew. */
START_TEST(a_copy_and_a_reset_give_the_same_digits)
{
    const double alphas[] = { 0, 0.3, 0.5, 0.8, 1 };
    const double chain[][2] = { { 1, 0 }, { 1, 0.5 } }, push[] = { 1, 2 };
    size_t runs = 0;
    for (size_t m = 0; m < LEN(methods); m++)
        for (size_t a = 0; a < LEN(alphas); a++)
            for (int kind = FVI_HISTORY_DIRECT; kind <= FVI_HISTORY_MODES;
                 kind++)
                for (int past = FVI_INITIAL_HISTORY_HELD;
                     past <= FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE; past++) {
                    const int quiet = methods[m] == &fvi_midpoint_variational;
                    const fvi_system system = {
                        D,
                        mass,
                        quiet ? none : rho,
                        fvi_potential_chain(chain[(a + m) % 2]),
                        quiet ? (fvi_force){ 0 } : fvi_force_cosine(push),
                        NULL, NULL
                    };
                    fvi_run run = fvi_run_default(&system, x0, p0, 0x1p-6, N);
                    run.alpha = alphas[a];
                    run.kappa = 0.25;
                    run.memory = (fvi_history_kind)kind;
                    run.past = (fvi_initial_history)past;
                    if (past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE && run.alpha > 0.5)
                        run.x0 = rest;
                    if (run.alpha < methods[m]->alpha_least
                        || run.alpha > methods[m]->alpha_most)
                        continue;
                    fork_a_run(methods[m], &run);
                    runs++;
                }
    ck_assert_uint_eq(runs, (7 * 5 + 3) * 6);
}
END_TEST

/* One history, two futures: the force is another one from row 130 on, first for the
 * original, which leaves the run that nobody forked, then, as it was, for the copy. */
START_TEST(a_fork_goes_on_under_another_force)
{
    static double x[ROWS], p[ROWS];
    for (size_t m = 0; m < 6; m++) {
        double push[] = { 1, 2 };
        const fvi_system system = {
            D, mass, rho, { 0 }, fvi_force_cosine(push), NULL, NULL
        };
        const fvi_run run = fvi_run_default(&system, x0, p0, 0x1p-6, N);
        fvi_stepper *s, *twin;
        ck_assert_int_eq(fvi_trajectory(methods[m], &run, x, p, NULL), 0);
        ck_assert_int_eq(fvi_stepper_start(methods[m], &run, &s, NULL), 0);
        go_on(s, 130, x, p);
        ck_assert_int_eq(fvi_stepper_copy(s, &twin), 0);
        push[0] = 3;
        while (s->k < N)
            ck_assert_int_eq(fvi_stepper_step(s), 0);
        ck_assert(fabs(s->x[0] - x[N * D]) > 0.1);
        push[0] = 1;
        go_on(twin, N, x, p);
        fvi_stepper_free(s);
        fvi_stepper_free(twin);
    }
}
END_TEST

/* A step that failed: begin anew, and all is well. */
static int moody(double t, size_t d, void *params, double *F)
{
    int *fail = params;
    for (size_t i = 0; i < d; i++)
        F[i] = t;
    return t > 1 ? *fail : 0;
}

START_TEST(a_run_that_failed_begins_anew)
{
    int fail = 0;
    const fvi_system system = {
        D, mass, rho, { 0 }, { .value = moody, .params = &fail }, NULL, NULL
    };
    const fvi_run run = fvi_run_default(&system, x0, p0, 0x1p-4, N);
    static double x[ROWS], p[ROWS];
    ck_assert_int_eq(fvi_trajectory(&fvi_cq_bdf2, &run, x, p, NULL), 0);
    fvi_stepper *s;
    ck_assert_int_eq(fvi_stepper_start(&fvi_cq_bdf2, &run, &s, NULL), 0);
    fail = -3;
    while (fvi_stepper_step(s) == 0) {
    }
    ck_assert_uint_eq(s->k, 16); /* F is asked for just behind t = 1 */
    fail = 0;
    ck_assert_int_eq(fvi_stepper_reset(s), 0);
    go_on(s, N, x, p);
    fvi_stepper_free(s);
}
END_TEST

static int leave(fvi_stepper *s)
{
    s->method_state = malloc(1);
    return s->method_state ? 0 : FVI_ENOMEM;
}

static void forget(fvi_stepper *s)
{
    free(s->method_state);
}

static int stay(fvi_stepper *s)
{
    (void)s;
    return 0;
}

START_TEST(copy_and_reset_refuse)
{
    const fvi_method mine = { .name = "mine",
                              .alpha_most = 1,
                              .start = leave,
                              .step = stay,
                              .stop = forget };
    const fvi_system system = { D, mass, rho, { 0 }, { 0 }, NULL, NULL };
    const fvi_run run = fvi_run_default(&system, x0, p0, 0x1p-4, N);
    fvi_stepper *s, *to = NULL;
    fvi_history *memory, *twin = NULL;
    ck_assert_int_eq(fvi_stepper_start(&mine, &run, &s, NULL), 0);
    ck_assert_int_eq(fvi_stepper_copy(s, &to), FVI_EUNSUP);
    ck_assert_int_eq(fvi_stepper_copy(s, NULL), FVI_EFAULT);
    ck_assert_int_eq(fvi_stepper_copy(NULL, &to), FVI_EFAULT);
    ck_assert_int_eq(fvi_stepper_reset(NULL), FVI_EFAULT);
    ck_assert_int_eq(fvi_stepper_reset(s), 0);
    fvi_stepper_free(s);
    ck_assert_int_eq(fvi_history_alloc(0.5, 1, 9, FVI_HISTORY_DIRECT, 0, &memory),
                     0);
    ck_assert_int_eq(fvi_history_copy(memory, NULL), FVI_EFAULT);
    ck_assert_int_eq(fvi_history_copy(NULL, &twin), FVI_EFAULT);
    fvi_history_free(memory);
    ck_assert_ptr_null(to);
    ck_assert_ptr_null(twin);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("09 copies");
    ADD_CASE(suite, "copies", a_copy_and_a_reset_give_the_same_digits,
             a_fork_goes_on_under_another_force, a_run_that_failed_begins_anew,
             copy_and_reset_refuse);
    return run_suite(suite);
}
