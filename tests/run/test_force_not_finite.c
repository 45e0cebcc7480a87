/* tests/run/test_force_not_finite.c -- A force that is not finite is an error with its time and its coordinate.
 * Run alone: make test-force_not_finite */
#include <fvi/fvi.h>
#include "methods/force_times.h"
#include "run/whole_run.h"
#include "harness/ulp.h"

#include <math.h>
#include <string.h>

enum { MOST = 9, STEPS = 20, ASKED = 500 };
static const double one[MOST] = { 1, 1, 1, 1, 1, 1, 1, 1, 1 }, none[MOST];

/* ---- typed forces, before the run ---- */

static int check(const fvi_method *method, double h, size_t steps, const char *text, fvi_error *error)
{
    fvi_typed_force *force;
    ck_assert_int_eq(fvi_parse_force(text, 1, NULL, 20, &force, error), FVI_SUCCESS);
    const int status = fvi_check_force(method, h, steps, "force", text, force, error);
    fvi_typed_force_free(force);
    return status;
}

START_TEST(a_typed_force_is_refused_where_a_method_asks_for_it)
{
    static const struct {
        const fvi_method *method;
        const char *force, *text; /* NULL: it is finite */
    } cases[] = {
        { &fvi_fractional, "1/(t-1)", "'1/(t-1)' is infinite at t = 1, where fvi asks for it" },
        { &fvi_fractional, "1/(t-2)", "'1/(t-2)' is infinite at t = 2, where fvi asks for it" },
        { &fvi_fractional, "1/(t-1.05)", NULL },
        { &fvi_fractional, "1/t", NULL },
        { &fvi_fractional, "sqrt(1-t)", "'sqrt(1-t)' is not a number at t = 1.1, where fvi asks for it" },
        { &fvi_fractional, "sin(t-1)/(t-1)", "'sin(t-1)/(t-1)' is not a number at t = 1, where fvi asks for it" },
        { &fvi_lagrange_dalembert, "1/(t-1)+1/(t-0.5)",
          "'1/(t-1)+1/(t-0.5)' is infinite at t = 0.5, where lda asks for it" },
        { &fvi_euler_explicit, "1/t", "'1/t' is infinite at t = 0, where euler-explicit asks for it" },
        { &fvi_euler_explicit, "1/(t-2)", NULL },
        { &fvi_cq_bdf2, "1/(t-1)", "'1/(t-1)' is infinite at t = 1, where fvi-bdf2 asks for it" },
        { &fvi_cq_bdf2, "1/(t-2)", "'1/(t-2)' is infinite at t = 2, where fvi-bdf2 asks for it" },
        { &fvi_cq_bdf2, "sin(t-1)/(t-1)", NULL },
        { &fvi_cq_bdf2, "1/t", "'1/t' is infinite at t = 0: fvi-bdf2 takes its first step from its limit there" },
        { &fvi_cq2_midpoint, "sqrt(t-1)", "'sqrt(t-1)' is not a number at t = 0, where fvi-stable asks for it" },
        { &fvi_lobatto_m3, "1/(t-1.05)", "'1/(t-1.05)' is infinite at t = 1.05, where fvi-lobatto3 asks for it" },
        { &fvi_lobatto_m4, "1/(t-1.05)", NULL },
        { &fvi_variable_step, "1/(t-1)", NULL },
    };
    for (size_t i = 0; i < LEN(cases); i++) {
        fvi_error error = { 0 };
        ck_assert_int_eq(check(cases[i].method, 0.1, STEPS, cases[i].force, &error), cases[i].text ? FVI_EINVAL : 0);
        if (cases[i].text)
            ck_assert_str_eq(error.text, cases[i].text);
        const int at_start = strstr(error.text, "first step") != NULL;
        ck_assert_int_eq(check(cases[i].method, 0.1, 0, cases[i].force, &error), at_start ? FVI_EINVAL : 0);
    }
}
END_TEST

/* Values in all steps would take minutes. */
START_TEST(a_bound_takes_the_place_of_many_values)
{
    ck_assert_int_eq(check(&fvi_fractional, 1e-9, (size_t)1e10, "cos(3*t)*exp(-t)", NULL), 0);
    ck_assert_int_eq(check(&fvi_fractional, 1e-9, (size_t)1e10, "1/(t-5)", NULL), FVI_EINVAL);
    ck_assert_int_eq(check(&fvi_fractional, 1e-9, (size_t)1e10, "sqrt(t)+1/(t-2.00000000051)", NULL), 0);
}
END_TEST

typedef struct {
    size_t count;
    double t[ASKED];
} asked_times;

static int note_time(double t, size_t d, void *params, double *F)
{
    asked_times *asked = params;
    ck_assert_uint_lt(asked->count, ASKED);
    asked->t[asked->count++] = t;
    for (size_t i = 0; i < d; i++)
        F[i] = 0;
    return 0;
}

START_TEST(the_times_of_a_step_are_those_at_which_it_asks)
{
    for (size_t i = 0; fvi_methods[i]; i++) {
        const fvi_method *method = fvi_methods[i];
        asked_times asked = { 0 };
        const fvi_system body = { .d = 1, .mass = one, .damping = one, .force = { note_time, &asked } };
        const fvi_run run = fvi_run_default(&body, one, none, 0.1, STEPS);
        fvi_stepper *s;
        if (method->dense)
            continue;
        ck_assert_int_eq(fvi_stepper_start(method, &run, &s, NULL), 0);
        for (size_t k = 0; k < STEPS; k++) {
            double t[FVI_MOST_FORCE_TIMES];
            asked.count = 0;
            ck_assert_int_eq(fvi_stepper_step(s), 0);
            ck_assert_uint_eq(fvi_step_force_times(method, 0.1, k, t), asked.count);
            for (size_t n = 0; n < asked.count; n++)
                ck_assert_msg(t[n] == asked.t[n], "%s: step %zu: %a, not %a", method->name, k, t[n], asked.t[n]);
        }
        fvi_stepper_free(s);
    }
}
END_TEST

/* ---- forces of the caller's, in the step ---- */

/* The force on the last coordinate is not finite from t = 1 on; params: the value there. */
static int end_at_1(double t, size_t d, void *params, double *F)
{
    for (size_t i = 0; i < d; i++)
        F[i] = i + 1 < d || t < 1 - 1e-12 ? 1 : *(double *)params;
    return 0;
}

START_TEST(a_step_names_the_time_and_the_coordinate)
{
    static const size_t dimensions[] = { 1, 2, MOST };
    static double values[] = { INFINITY, -INFINITY, NAN };
    for (size_t i = 0; fvi_methods[i]; i++)
        for (size_t n = 0; n < LEN(dimensions) * LEN(values); n++) {
            const size_t d = dimensions[n % 3];
            double *value = &values[n / 3];
            char text[FVI_ERROR_ROOM], coordinate[40] = "";
            fvi_error failure = { 0 };
            const fvi_system body = { .d = d, .mass = one, .damping = one, .force = { end_at_1, value } };
            fvi_run run = fvi_run_default(&body, one, none, 0.1, STEPS);
            run.failure = &failure;
            fvi_stepper *s;
            int status = fvi_stepper_start(fvi_methods[i], &run, &s, NULL);
            ck_assert_int_eq(status, 0);
            while (!status && s->k < STEPS)
                status = fvi_stepper_step(s);
            ck_assert_msg(status == FVI_EBADFUNC, "%s: %d", fvi_methods[i]->name, status);
            ck_assert_uint_le(s->k, 10);
            fvi_stepper_free(s);
            if (d > 1)
                snprintf(coordinate, sizeof coordinate, " on coordinate %zu", d);
            snprintf(text, sizeof text, "the force%s is %s at t = 1", coordinate,
                     isnan(*value) ? "not a number" : "infinite");
            ck_assert_msg(strncmp(failure.text, text, strlen(text)) == 0, "%s: %s", fvi_methods[i]->name, failure.text);
            ck_assert_int_eq(failure.code, FVI_EBADFUNC);
            ck_assert_str_eq(failure.field, "force");
            ck_assert_uint_eq(failure.index, d - 1);
        }
}
END_TEST

START_TEST(a_force_at_stages_of_matrices_is_checked)
{
    static double value = INFINITY;
    static const fvi_triplet ones[] = { { 0, 0, 1 }, { 1, 1, 1 } };
    fvi_sparse M;
    fvi_structure *structure;
    ck_assert_int_eq(fvi_sparse_assemble(2, LEN(ones), ones, &M), 0);
    ck_assert_int_eq(fvi_structure_alloc(&M, &M, &M, &structure, NULL), 0);
    fvi_system system = fvi_structure_system(structure);
    system.force = (fvi_force){ .value = end_at_1, .params = &value };
    for (size_t i = 0; fvi_methods[i]; i++) {
        double x[2 * (STEPS + 1)];
        fvi_error failure = { 0 };
        fvi_run run = fvi_run_default(&system, one, none, 0.1, STEPS);
        run.failure = &failure;
        if (!fvi_methods[i]->takes_matrices)
            continue;
        ck_assert_int_eq(fvi_trajectory(fvi_methods[i], &run, x, NULL, NULL), FVI_EBADFUNC);
        ck_assert_msg(strncmp(failure.text, "the force on coordinate 2 is infinite at t = 1", 46) == 0, "%s: %s",
                      fvi_methods[i]->name, failure.text);
    }
    fvi_structure_free(structure);
    fvi_sparse_free(&M);
}
END_TEST

/* ---- fvi_solve ---- */

static int solve(const char *text, const fvi_method *method, double tolerance, fvi_error *error)
{
    fvi_typed_problem *typed;
    double x[2 * (STEPS + 1)];
    const fvi_solve_options options = { .method = method, .h = 0.1 };
    const fvi_accuracy accuracy = { tolerance, 0 };
    const fvi_outputs outputs = { .rows = STEPS + 1, .x = x };
    ck_assert_msg(fvi_parse_problem(text, &typed, error) == 0, "%s: %s", text, error->text);
    const int status = fvi_solve(fvi_problem_typed(typed), &options, &accuracy, &outputs, NULL, error);
    fvi_typed_problem_free(typed);
    return status;
}

START_TEST(a_solver_says_what_is_not_finite)
{
    static const struct {
        const char *problem;
        const fvi_method *method;
        double tolerance;
        const char *text; /* NULL: it ends well */
    } cases[] = {
        { "force=1/(t-1); T=2", &fvi_fractional, 0, "step 10: the force is infinite at t = 1" },
        { "force-on=1=1/(t-1); T=2", &fvi_fractional, 1e-3, "the force is infinite at t = 1" },
        { "force=1/(t-1.05); T=2", &fvi_fractional, 0, NULL },
        { "force=1/(t-1.05); T=2", &fvi_variable_step, 0, "step 11: the force is infinite at t = 1.05" },
        { "force=1/(t-1.05); T=2", &fvi_variable_step, 1e-3, "the force is infinite at t = 1.05" },
        { "force=sin(t)/t; T=2", &fvi_variable_step, 0, NULL },
        { "d=2; U=(x1^2+x2^2)/2; force-on=2=1/(t-1); T=2", &fvi_fractional, 0,
          "step 10: the force on coordinate 2 is infinite at t = 1" },
        { "d=2; U=(x1^2+x2^2)/2; force-on=2=v1/(x2-x2); T=2; p0=1", &fvi_cq2_midpoint, 0,
          "step 1: the force on coordinate 2 is infinite at t = 0.05" },
        { "d=2; U=(x1^2+x2^2)/2; force-on=2=1/(x1-x1); T=2", &fvi_lobatto_m3, 0,
          "step 1: the force on coordinate 2 is infinite at t = 0" },
        { "damper=x1/(t-1) : viscous:1; T=2", &fvi_fractional, 0, "step 10: the elongation is infinite at t = 1" },
        { "damper=x1/(t-1) : viscous:1; T=2", &fvi_lobatto_m4, 0, "step 10: the elongation is infinite at t = 1" },
        { "d=2; U=x1^2/2; damper=x1 : viscous:1; damper=x2-sqrt(1-t) : viscous:1; T=2", &fvi_cq2_midpoint, 0,
          "step 11: the elongation of damper 2 is not a number at t = 1.1" },
        { "impose=x1=1/(t-1); x0=-1; v0=-1; T=2", &fvi_cq2_midpoint, 0,
          "step 10: the constraint is infinite at t = 1" },
        { "impose=x1=1/(t-1); x0=-1; v0=-1; T=2", &fvi_lobatto_m4, 0, "step 10: the constraint is infinite at t = 1" },
        { "lagrangian=v1^2/2-x1^2/2/(t-0.25); x0=1; v0=0; T=2", &fvi_cq2_midpoint, 0,
          "step 3: the slope of the Lagrangian is not a number at t = 0.25" },
    };
    for (size_t i = 0; i < LEN(cases); i++) {
        fvi_error error = { 0 };
        const int status = solve(cases[i].problem, cases[i].method, cases[i].tolerance, &error);
        ck_assert_msg(status == (cases[i].text ? FVI_EBADFUNC : 0), "%s: %d: %s", cases[i].problem, status, error.text);
        if (cases[i].text)
            ck_assert_str_eq(error.text, cases[i].text);
    }
}
END_TEST

START_TEST(a_fit_says_that_its_force_is_not_finite)
{
    static double value = INFINITY;
    static const double t[] = { 0, 0.5, 1, 1.5, 2 }, x[] = { 1, 0.8, 0.5, 0.1, -0.2 };
    static const fvi_free_parameter which[] = { FVI_FREE_PARAMETER_RHO };
    double c = 1;
    const fvi_system body = { .d = 1,
                              .mass = one,
                              .damping = one,
                              .potential = fvi_potential_harmonic(&c),
                              .force = { end_at_1, &value } };
    const fvi_run run = fvi_run_default(&body, one, none, 0.1, STEPS);
    const fvi_estimation fit = { .method = &fvi_lobatto_m4, .run = &run, .constants = &c, .n = LEN(t), .t = t,
                                 .x = x, .parameters = 1, .which = which, .starts = 2 };
    fvi_estimate found;
    char text[FVI_WARNING_ROOM];
    const int status = fvi_estimate_multistart(&fit, NULL, &found);
    ck_assert_int_eq(status, FVI_EBADFUNC);
    ck_assert_int_eq(fvi_estimate_reason(status, &fit, &found, "rho", "", sizeof text, text), 1);
    ck_assert_str_eq(text, "no start gives a motion that can be computed: the force is infinite at t = 1");
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("forces that are not finite");
    ADD_CASE(suite, "typed", a_typed_force_is_refused_where_a_method_asks_for_it,
             a_bound_takes_the_place_of_many_values, the_times_of_a_step_are_those_at_which_it_asks);
    ADD_CASE(suite, "in a step", a_step_names_the_time_and_the_coordinate, a_force_at_stages_of_matrices_is_checked,
             a_solver_says_what_is_not_finite, a_fit_says_that_its_force_is_not_finite);
    return run_suite(suite);
}
