/* tests/run/test_interrupter.c -- A long call is ended from outside.
 * Run alone: make test-interrupter */
#include <fvi/fvi.h>
#include "run/whole_run.h"
#include "error_control/variable_step_search.h"
#include "error_control/step_search.h"
#include "harness/ulp.h"

enum { CODE = -5 };

static int asked,
    asks; /* how often, and how often until it says stop; 0: never */

static int stop(void)
{
    return asks > 0 && ++asked >= asks ? CODE : 0;
}

static double one[40], p0[40];

static fvi_run run_of(const fvi_system *system, double alpha, size_t steps)
{
    fvi_run run = fvi_run_default(system, one, p0, 0.01, steps);
    run.alpha = alpha;
    asked = 0;
    return run;
}

/* Of a small system every 64th step asks, of a large one each, and each that chooses itself. */
START_TEST(a_run_ends_with_the_code_that_was_given)
{
    for (size_t i = 0; i < LEN(one); i++)
        one[i] = 1;
    const fvi_system small = { .d = 1, .mass = one, .damping = one },
                     large = { .d = 40, .mass = one, .damping = one };
    static double x[10001];
    double w[40 * 11];
    fvi_run run = run_of(&small, 0.5, 10000);
    fvi_stepper *s;
    fvi_set_interrupter(stop);
    asks = 3;
    ck_assert_int_eq(fvi_stepper_start(&fvi_fractional, &run, &s, NULL), 0);
    int status = 0;
    while (!status)
        status = fvi_stepper_step(s);
    ck_assert_int_eq(status, CODE);
    ck_assert_uint_eq(s->k, 128);
    asks = 0; /* the run goes on as if nothing had been */
    while (s->k < run.steps)
        ck_assert_int_eq(fvi_stepper_step(s), 0);
    ck_assert_int_eq(fvi_trajectory(&fvi_fractional, &run, x, NULL, NULL), 0);
    ck_assert(s->x[0] == x[10000]);
    fvi_stepper_free(s);
    run = run_of(&large, 0.5, 10);
    asks = 5;
    ck_assert_int_eq(fvi_trajectory(&fvi_fractional, &run, w, NULL, NULL),
                     CODE);
    ck_assert_int_eq(asked, 5);
    run = run_of(&small, 0.3, 10000);
    asks = 5;
    ck_assert_int_eq(fvi_trajectory(&fvi_variable_step, &run, x, NULL, NULL), CODE);
    ck_assert_int_eq(asked, 5);
    ck_assert(fvi_set_interrupter(NULL) == stop);
    ck_assert_int_eq(fvi_trajectory(&fvi_fractional, &run, x, NULL, NULL), 0);
}
END_TEST

START_TEST(a_search_and_the_exact_solution_end_too)
{
    *one = 1;
    const fvi_system system = { .d = 1, .mass = one, .damping = one };
    const fvi_linear_oscillator problem = { .m = 1, .c = 1, .rho = 0.2, .alpha = 0.3 };
    double x[101], t[10];
    fvi_step_found found;
    fvi_variable_step_found adaptive;
    fvi_run run = run_of(&system, 0.3, 100);
    fvi_set_interrupter(stop);
    asks = 1;
    ck_assert_int_eq(
        fvi_step_search(&fvi_fractional, &run, 1e-9, 1 << 20, x, NULL, &found),
        CODE);
    ck_assert_int_eq(
        fvi_variable_step_search(&run, 0, NULL, 1e-9, 1 << 20, x, NULL, &adaptive), CODE);
    for (size_t i = 0; i < LEN(t); i++)
        t[i] = (double)i;
    const fvi_free_parameter rho = FVI_FREE_PARAMETER_RHO;
    const fvi_estimation fit = { .method = &fvi_fractional,
                          .run = &run,
                          .n = LEN(t),
                          .t = t,
                          .x = one + 1,
                          .parameters = 1,
                          .which = &rho,
                          .starts = 1000 };
    fvi_estimate fitted;
    asked = 0;
    asks = 10; /* the first starts are over */
    ck_assert_int_eq(fvi_estimate_multistart(&fit, NULL, &fitted), CODE);
    ck_assert_int_lt(asked, 1000);
    asked = 0;
    asks = 4;
    ck_assert_int_eq(fvi_exact_at(&problem, LEN(t), t, x, NULL, NULL), CODE);
    ck_assert_int_eq(asked, 4);
    asked = 0;
    ck_assert_int_eq(fvi_exact_grid(&problem, 0.1, 100, 0, x, NULL,
                                    NULL), CODE);
    fvi_set_interrupter(NULL);
    ck_assert_int_eq(fvi_exact_at(&problem, LEN(t), t, x, NULL, NULL), 0);
}
END_TEST

static int errors;

static void count_error(const char *reason, const char *file, int line, int code)
{
    (void)reason, (void)file, (void)line, (void)code;
    errors++;
}

/* The tables of a law that is a fraction, and each frequency. The error handler hears nothing of it. */
START_TEST(tables_and_responses_end_too)
{
    for (size_t i = 0; i < LEN(one); i++)
        one[i] = 1;
    const fvi_kernel_term fraction = { FVI_KERNEL_ZENER, 1, 0.6, 0.5, 0 };
    const fvi_kernel law = { 1, &fraction };
    const fvi_system small = { .d = 1, .mass = one, .damping = one },
                     large = { .d = 40, .mass = one, .damping = one };
    fvi_run run = run_of(&small, 0.5, 4000);
    run.law = &law;
    fvi_stepper *s = NULL;
    fvi_set_interrupter(stop);
    fvi_set_error_handler(count_error);
    asks = 3;
    ck_assert_int_eq(fvi_stepper_start(&fvi_lobatto_m4, &run, &s, NULL), CODE);
    ck_assert_ptr_null(s);
    fvi_set_error_handler(NULL);
    ck_assert_int_eq(errors, 0);
    const fvi_linear_motion motion = { .system = &large, .alpha = 0.3 };
    const double omega[] = { 0.5, 1, 1.5, 2 };
    double H[8];
    fvi_response *r;
    asks = asked = 0;
    ck_assert_int_eq(fvi_response_alloc(&motion, &r, NULL), 0);
    asks = 3;
    ck_assert_int_eq(fvi_response_at(r, FVI_RESPONSE_RECEPTANCE, LEN(omega), omega, 0, 0, H, NULL), CODE);
    ck_assert_int_eq(asked, 3);
    fvi_set_interrupter(NULL);
    ck_assert_int_eq(fvi_response_at(r, FVI_RESPONSE_RECEPTANCE, LEN(omega), omega, 0, 0, H, NULL), 0);
    fvi_response_free(r);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("an end from without");
    ADD_CASE(suite, "values", a_run_ends_with_the_code_that_was_given,
             a_search_and_the_exact_solution_end_too, tables_and_responses_end_too);
    return run_suite(suite);
}
