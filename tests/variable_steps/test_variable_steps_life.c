/* tests/variable_steps/test_variable_steps_life.c -- H 22: a stepper from its start to its end: copies, saved
 * states, stops.
 * Run alone: make test-variable_steps_life */
#include <fvi/fvi.h>
#include "harness/saved.h"
#include "harness/ulp.h"
#include "variable_step/variable_step.h"

#include "five_masses.h"

static double x[(N + 1) * D], y[(N + 1) * D], p[(N + 1) * D];
static const double cg[2] = { 2, 0.7 };

/* A copy, a run that was saved, and one begun anew go on with the same digits; rows may be
 * had at any time that is not before the last step. */
START_TEST(a_copy_goes_on_with_the_same_digits)
{
    const double jumps[] = { 3.3, 1.1, 99 };
    for (size_t way = 0; way < 4; way++) {
        fvi_system system = { D,
                              mass,
                              rho,
                              way % 3 == 0 ? fvi_potential_chain(cg)
                              : way == 1   ? fvi_potential_duffing(cg)
                                           : fvi_potential_harmonic(cg),
                              fvi_force_cosine(cg),
                              NULL, NULL };
        system.force.jumps = jumps;
        system.force.jump_count = LEN(jumps);
        fvi_run run = run_of(&system, 1e-9);
        run.alpha = way == 2 ? 0.75 : 0.3;
        fvi_stepper *s, *copy, *again;
        ck_assert_int_eq(fvi_stepper_start(&fvi_variable_step, &run, &s,
                                           NULL), 0);
        double last = -1;
        int ended_at_event = 0;
        while (s->t < 1e-3) {
            ck_assert_int_eq(fvi_stepper_step(s), 0);
            ck_assert(s->t > last);
            last = s->t;
        }
        if (way == 0) {
            fvi_variable_step_state *o = s->method_state;
            o->solve = FVI_SOLVE_TOGETHER;
            o->length.h = 0; /* other matrices */
        }
        ck_assert_int_eq(fvi_stepper_step(s), 0);
        while (s->t < 0.3 * (double)way)
            ck_assert_int_eq(fvi_stepper_step(s), 0);
        ck_assert_int_eq(fvi_stepper_copy(s, &copy), 0);
        ck_assert_int_eq(fvi_stepper_start(&fvi_variable_step, &run, &again,
                                           NULL), 0);
        save_and_restore(s, again);
        ck_assert(again->t == s->t);
        while (s->k < N) {
            ck_assert_int_eq(fvi_stepper_step(s), 0);
            ck_assert_int_eq(fvi_stepper_step(copy), 0);
            ck_assert_int_eq(fvi_stepper_step(again), 0);
            ck_assert(s->t == again->t
                      && memcmp(s->x, again->x, 2 * D * sizeof *x) == 0);
            ck_assert(s->t == copy->t && s->k == copy->k);
            ck_assert(s->k == N || (double)(s->k + 1) * run.h > s->t);
            ck_assert((double)s->k * run.h <= s->t);
            ck_assert(memcmp(s->x, copy->x, D * sizeof *x) == 0
                      && memcmp(s->p, copy->p, D * sizeof *x) == 0);
            ended_at_event += s->t == 3.3 || s->t == 1.1;
        }
        ck_assert(ended_at_event == 2 && s->t == N * run.h);
        ck_assert_int_eq(fvi_stepper_step(s), FVI_EINVAL);
        memcpy(x, s->x, D * sizeof *x);
        const fvi_variable_step_state *o = s->method_state;
        double middle = (o->t0 + s->t) / 2;
        ck_assert_int_eq(fvi_stepper_advance_to(s, middle, y, NULL), 0);
        ck_assert_int_eq(fvi_stepper_advance_to(copy, middle, NULL, p), 0);
        ck_assert_int_eq(fvi_stepper_advance_to(copy, s->t, y, NULL), 0);
        ck_assert(memcmp(x, y, D * sizeof *x) == 0);
        ck_assert_int_eq(fvi_stepper_advance_to(s, o->t0 * 0.999, y, NULL), FVI_EDOM);
        ck_assert_int_eq(fvi_stepper_advance_to(s, s->t * 1.001, y, NULL), FVI_EDOM);
        ck_assert_int_eq(fvi_stepper_advance_to(NULL, 1, y, NULL), FVI_EFAULT);
        fvi_stepper_free(copy);
        fvi_stepper_free(again);
        if (way > 0) {
            ck_assert_int_eq(fvi_stepper_reset(s), 0);
            ck_assert_int_eq(fvi_stepper_advance_to(s, N * run.h, y, NULL), 0);
            ck_assert(memcmp(x, y, D * sizeof *x) == 0);
        }
        fvi_stepper_free(s);
    }
}
END_TEST

/* A copy does not share the factors of a quadratic U: of a driven mass whose steps are
 * mostly as long as the last, one copy after each step makes the next step itself. */
START_TEST(a_copy_makes_factors_of_its_own)
{
    const double drive[2] = { 1, 0.5 }, zero = 0;
    const fvi_system system = { .d = 1,
                                .mass = &one,
                                .damping = &one,
                                .potential = fvi_potential_harmonic(&one),
                                .force = fvi_force_cosine(drive) };
    fvi_run run = fvi_run_default(&system, &zero, &zero, 1, 50);
    run.alpha = 0.3;
    run.step_error = 1e-5;
    fvi_stepper *s, *copy[200]; /* all at once: none is where another was */
    size_t copies = 0;
    ck_assert_int_eq(fvi_stepper_start(&fvi_variable_step, &run, &s, NULL), 0);
    for (; s->k < run.steps; copies++) {
        ck_assert_uint_lt(copies, 200);
        ck_assert_int_eq(fvi_stepper_copy(s, &copy[copies]), 0);
        ck_assert_int_eq(fvi_stepper_step(s), 0);
        ck_assert_int_eq(fvi_stepper_step(copy[copies]), 0);
        ck_assert(s->t == copy[copies]->t && s->x[0] == copy[copies]->x[0]);
    }
    while (copies > 0)
        fvi_stepper_free(copy[--copies]);
    fvi_stepper_free(s);
}
END_TEST

/* fvi_stepper_advance_to knows the rows of methods that step by h, and no other times. */
START_TEST(uniform_methods_have_rows_only)
{
    const fvi_system system = { D,     mass, rho, fvi_potential_harmonic(cg),
                                { 0 }, NULL, NULL };
    const fvi_run run = run_of(&system, 0);
    fvi_stepper *s;
    ck_assert_int_eq(fvi_stepper_start(&fvi_fractional, &run, &s, NULL), 0);
    ck_assert_int_eq(fvi_stepper_advance_to(s, 7 * run.h, x, p), 0);
    ck_assert(s->k == 7 && memcmp(x, s->x, D * sizeof *x) == 0
              && memcmp(p, s->p, D * sizeof *x) == 0);
    ck_assert_int_eq(fvi_stepper_advance_to(s, 7.5 * run.h, x, p), FVI_EDOM);
    ck_assert_int_eq(fvi_stepper_advance_to(s, 2 * run.h, x, p), FVI_EDOM);
    fvi_step_statistics counts;
    ck_assert_int_eq(fvi_stepper_statistics(s, &counts), FVI_EINVAL);
    ck_assert_int_eq(fvi_stepper_statistics(NULL, &counts), FVI_EFAULT);
    fvi_stepper_free(s);
}
END_TEST

/* What a callback returns comes back; what is never finite ends the run. */
static int moods, mood;
static int moody(double t, size_t d, void *params, double *F)
{
    (void)t, (void)params;
    for (size_t i = 0; i < d; i++)
        F[i] = mood ? GSL_NAN : 1;
    return ++moods > 200 && !mood ? -77 : 0;
}

START_TEST(what_callbacks_say_comes_back)
{
    fvi_system system = {
        1, &one, &one, fvi_potential_harmonic(&one), { .value = moody }, NULL, NULL
    };
    const fvi_run run = fvi_run_default(&system, &one, &one, 1, 100);
    for (mood = 0; mood < 2; mood++) {
        fvi_stepper *s;
        int status = 0;
        moods = 0;
        ck_assert_int_eq(fvi_stepper_start(&fvi_variable_step, &run, &s,
                                           NULL), 0);
        while (s->k < run.steps && !status)
            status = fvi_stepper_step(s);
        ck_assert_int_eq(status, mood ? FVI_EBADFUNC : -77);
        fvi_stepper_free(s);
    }
    fvi_run wrong = run;
    fvi_stepper *s;
    wrong.step_error = -1;
    ck_assert_int_eq(fvi_stepper_start(&fvi_variable_step, &wrong, &s,
                                       NULL), FVI_EDOM);
    wrong.step_error = GSL_NAN;
    ck_assert_int_eq(fvi_stepper_start(&fvi_variable_step, &wrong, &s,
                                       NULL), FVI_EDOM);
}
END_TEST

/* x0 is 1, of one body alone and of one with a damper of its own, whose equations are coupled. */
START_TEST(a_tolerance_that_rounding_hides_is_refused)
{
    const fvi_kernel_term springpot = { FVI_KERNEL_POWER, 1, 0.3, 0, 0 };
    const fvi_kernel law = { 1, &springpot };
    const fvi_damper damper = { .of.row = &one, .kernel = &law };
    const fvi_mechanism mechanism = { .damper_count = 1, .damper = &damper };
    const double none = 0;
    fvi_system system = { 1, &one, &one, fvi_potential_harmonic(&one), { 0 }, NULL, NULL };
    fvi_run run = fvi_run_default(&system, &one, &one, 1, 3);
    fvi_stepper *s;
    for (int i = 0; i < 2; i++) {
        fvi_error error = { 0 };
        run.step_error = 0.9e-17;
        ck_assert_int_eq(fvi_stepper_start(&fvi_variable_step, &run, &s, &error), FVI_ETOL);
        ck_assert_str_eq(error.field, "step_error");
        run.step_error = 1e-17;
        ck_assert_int_eq(fvi_stepper_start(&fvi_variable_step, &run, &s, NULL), FVI_SUCCESS);
        fvi_stepper_free(s);
        system.mechanism = &mechanism;
        system.damping = &none;
    }
}
END_TEST

/* Many times together: what one after the other gives, to the bit; for one mass and many, with a start
 * that is singular, and by a method whose steps are all alike. Times may be rows, ends of steps, anything
 * between, and the same twice. */
START_TEST(rows_together_are_rows_one_by_one)
{
    enum { TIMES = 300 };
    static double t[TIMES], u[D * TIMES], v[D * TIMES], w[D], z[D];
    static const struct {
        size_t d;
        fvi_initial_history past;
        double alpha;
        const fvi_method *method;
    } of[] = { { 1, FVI_INITIAL_HISTORY_HELD, 0.3, &fvi_variable_step },
               { 1, FVI_INITIAL_HISTORY_CAPUTO, 0.75, &fvi_variable_step },
               { 1, FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE, 0.2, &fvi_variable_step },
               { 1, FVI_INITIAL_HISTORY_HELD, 0.5, &fvi_variable_step },
               { D, FVI_INITIAL_HISTORY_HELD, 0.3, &fvi_variable_step },
               { 1, FVI_INITIAL_HISTORY_HELD, 0.3, &fvi_cq2_midpoint } };
    for (size_t i = 0; i < LEN(of); i++) {
        const fvi_system system = { .d = of[i].d,
                                    .mass = mass,
                                    .damping = rho,
                                    .potential = fvi_potential_duffing(cg) };
        fvi_run run = run_of(&system, 1e-3);
        run.alpha = of[i].alpha;
        run.past = of[i].past;
        const int dense = of[i].method->dense != NULL;
        for (size_t k = 0; k < TIMES; k++)
            t[k] = dense ? 10 * (double)(k - k % 7 / 6) / (TIMES - 1)
                         : 0.125 * (double)(k * N / (TIMES - 1));
        for (int wanted = 1; wanted <= 3; wanted++) {
            fvi_stepper *one_by_one, *together;
            ck_assert_int_eq(fvi_stepper_start(of[i].method, &run, &one_by_one, NULL), 0);
            ck_assert_int_eq(fvi_stepper_start(of[i].method, &run, &together, NULL), 0);
            ck_assert_int_eq(fvi_stepper_advance_through(together, TIMES, t, wanted & 1 ? u : NULL,
                                                         wanted & 2 ? v : NULL),
                             0);
            for (size_t k = 0; k < TIMES; k++) {
                ck_assert_int_eq(fvi_stepper_advance_to(one_by_one, t[k], w, z), 0);
                const size_t bytes = of[i].d * sizeof *w, at = k * of[i].d;
                ck_assert_msg((!(wanted & 1) || memcmp(u + at, w, bytes) == 0)
                                  && (!(wanted & 2) || memcmp(v + at, z, bytes) == 0),
                              "case %zu, row %zu", i, k);
            }
            ck_assert_int_eq(fvi_stepper_free(one_by_one), 0);
            ck_assert_int_eq(fvi_stepper_free(together), 0);
        }
    }
}
END_TEST

START_TEST(rows_that_are_not_to_be_had_are_refused)
{
    const fvi_system system = { .d = 1, .mass = mass, .damping = rho,
                                .potential = fvi_potential_duffing(cg) };
    const fvi_run run = run_of(&system, 1e-3);
    fvi_stepper *s;
    const double past_the_end[] = { 1, 2, 11 }, back[] = { 10, 0.1, 0.2, 0.3 },
                 turning[] = { 9.9, 9.95, 9.93, 9.94 };
    double u[4], v[4];
    ck_assert_int_eq(fvi_stepper_start(&fvi_variable_step, &run, &s, NULL), 0);
    ck_assert_int_eq(fvi_stepper_advance_through(NULL, 1, back, u, v), FVI_EFAULT);
    ck_assert_int_eq(fvi_stepper_advance_through(s, 1, NULL, u, v), FVI_EFAULT);
    ck_assert_int_eq(fvi_stepper_advance_through(s, 0, NULL, u, v), 0);
    ck_assert_int_eq(fvi_stepper_advance_through(s, 3, past_the_end, u, v), FVI_EDOM);
    ck_assert_int_eq(fvi_stepper_advance_through(s, 4, back, u, v), FVI_EDOM);
    ck_assert_int_eq(fvi_stepper_advance_through(s, 3, back + 1, u, v), FVI_EDOM);
    ck_assert_int_eq(fvi_stepper_advance_through(s, 4, turning, u, v), 0);
    for (size_t k = 0; k < LEN(turning); k++) { /* within one step they may turn back */
        double at;
        ck_assert_int_eq(fvi_stepper_advance_to(s, turning[k], &at, NULL), 0);
        ck_assert(at == u[k]);
    }
    ck_assert_int_eq(fvi_stepper_free(s), 0);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("variable_steps: the life of a stepper");
    ADD_CASE(suite, "stepper", a_copy_goes_on_with_the_same_digits,
             a_copy_makes_factors_of_its_own, uniform_methods_have_rows_only,
             what_callbacks_say_comes_back, a_tolerance_that_rounding_hides_is_refused, rows_together_are_rows_one_by_one,
             rows_that_are_not_to_be_had_are_refused);
    return run_suite(suite);
}
