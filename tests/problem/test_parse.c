/* tests/problem/test_parse.c -- Typed problems that the library understands, and its messages for the others.
 * Run alone: make test-parse */
#include "harness/ulp.h"

#include <fvi/fvi.h>

#include <math.h>
#include <string.h>

static fvi_error error;

/* An error as a function left it. */
static void expect(int code, const char *field, const char *text)
{
    ck_assert_int_eq(error.code, code);
    ck_assert_str_eq(error.field, field);
    ck_assert_str_eq(error.text, text);
}

START_TEST(a_text_becomes_a_potential)
{
    const double x = 1.25;
    double typed, made;
    fvi_typed_potential well = { 0 };
    fvi_user_parameters k = { 0 };
    ck_assert_int_eq(fvi_parse_user_parameters("k=3,c=2*k", &k, &error), 0);
    ck_assert(k.count == 2 && k.value[1] == 6);
    ck_assert_int_eq(fvi_parse_potential("c*x^2/2 + k*x^4/4", 0, &k, &well, NULL),
                     0);
    ck_assert_int_eq(fvi_user_parameters_are_used(&k, &error), 0);
    const fvi_potential u = fvi_potential_typed(&well);
    ck_assert_int_eq(u.value(1, &x, u.params, &typed), 0);
    fvi_typed_potential_free(&well);
    ck_assert_int_eq(fvi_parse_potential("Duffing:6,3", 0, NULL, &well, NULL), 0);
    const fvi_potential v = fvi_potential_typed(&well);
    ck_assert_int_eq(v.value(1, &x, v.params, &made), 0);
    ck_assert_double_eq_tol(typed, made, 4e-15);
    fvi_typed_potential_free(&well);
    ck_assert_int_eq(fvi_parse_potential("chain:3,1,0.5", 0, NULL, &well, NULL),
                     0);
    ck_assert(well.d == 3 && well.constants[0] == 1 && well.constants[1] == 0.5);
}
END_TEST

/* The field, the number and the place are there for programs, the text for people. */
START_TEST(an_error_says_field_value_index_and_text)
{
    fvi_typed_potential well = { 0 };
    fvi_typed_damping damping = { 0 };
    fvi_typed_force *force = NULL;
    double x0[3];
    size_t which;
    ck_assert_int_eq(fvi_parse_potential("1 + x^^2", 0, NULL, &well, &error),
                     FVI_EINVAL);
    ck_assert_uint_eq(error.index, 6);
    ck_assert_ptr_nonnull(strstr(error.text, "\n       ^"));
    fvi_parse_potential("duffin:1,1", 0, NULL, &well, &error);
    expect(FVI_EINVAL, "potential",
           "'duffin:1,1' is none of harmonic:C, duffing:C,G, pendulum:G, free, "
           "chain:D,C,G; did you mean duffing?");
    fvi_parse_potential("chain:3,1,1", 2, NULL, &well, &error);
    expect(FVI_EINVAL, "dimension", "'2' is not that of 'chain:3,1,1'");
    fvi_parse_numbers("x0", "1,-2,3", 0, INFINITY, "[)", 3, x0, &error);
    expect(FVI_EDOM, "x0", "'-2' is outside [0, inf)");
    ck_assert(error.value == -2 && error.index == 1);
    double *list;
    ck_assert_int_eq(fvi_parse_list("x0", "1,-2,3", -9, 9, "[]", &which, &list, &error), FVI_SUCCESS);
    ck_assert(which == 3 && list[1] == -2);
    free(list);
    ck_assert_int_eq(fvi_parse_list("x0", "1,-2,3", 0, 9, "[]", &which, &list, &error), FVI_EDOM);
    free(list);
    ck_assert_int_eq(fvi_parse_list("x0", "@/dev/null", 0, 9, "[]", &which, &list, &error), FVI_EINVAL);
    expect(FVI_EINVAL, "x0", "'@/dev/null' has no numbers");
    free(list);
    ck_assert_int_eq(fvi_parse_list("x0", NULL, 0, 9, "[]", &which, &list, &error), FVI_EFAULT);
    fvi_parse_damping("zener:1,0.3,2 + power:1,1.5", NULL, &damping,
                      &error);
    expect(FVI_EDOM, "damping",
           "'power:1,1.5': power:R,A with R >= 0 and 0 <= A <= 1");
    fvi_parse_force("step:1,-2", 1, NULL, 9, &force, &error);
    expect(FVI_EDOM, "force", "'step:1,-2' ends before it begins");
    ck_assert(error.value == -2 && !force);
    fvi_parse_force("cos(t) + impulse:1,10", 1, NULL, 9, &force, &error);
    expect(FVI_EDOM, "force",
           "'impulse:1,10' is not within the run, 0 <= T <= 9");
    fvi_parse_word("derivative", "hled", fvi_initial_history_words, &which,
                   &error);
    expect(FVI_EINVAL, "derivative",
           "'hled' is none of held, caputo, rl; did you mean held?");
    ck_assert_int_eq(fvi_parse_potential(NULL, 0, NULL, &well, NULL), FVI_EFAULT);
}
END_TEST

/* A name that is taken, twice the same name, and one that no expression speaks of. */
START_TEST(parameters_are_names_with_one_value_that_are_used)
{
    fvi_user_parameters k = { 0 };
    ck_assert_int_eq(fvi_user_parameters_set(&k, "x", 1, &error), FVI_EINVAL);
    expect(FVI_EINVAL, "let", "'x' is not a name for a parameter");
    ck_assert_int_eq(fvi_user_parameters_set(&k, "k", NAN, &error), FVI_EDOM);
    ck_assert_int_eq(fvi_user_parameters_set(&k, "k", 1, &error), 0);
    ck_assert_int_eq(fvi_user_parameters_set(&k, "k", 1, &error), 0);
    ck_assert_int_eq(fvi_user_parameters_set(&k, "k", 2, &error), FVI_EINVAL);
    ck_assert_uint_eq(k.count, 1);
    ck_assert_int_eq(fvi_user_parameters_are_used(&k, &error), FVI_EINVAL);
    expect(FVI_EINVAL, "let", "'k' is in no expression");
    char name[] = "a0"; /* no more than there is room for */
    for (int i = 1; i < FVI_MOST_USER_PARAMETERS; i++) {
        name[0] = (char)('a' + i / 10), name[1] = (char)('0' + i % 10);
        ck_assert_int_eq(fvi_user_parameters_set(&k, name, i, &error), 0);
    }
    ck_assert_int_eq(fvi_user_parameters_set(&k, "more", 1, &error),
                     FVI_EINVAL);
    expect(FVI_EINVAL, "let", "'more': too many parameters");
    ck_assert_str_eq(k.name[0], "k");
    ck_assert_str_eq(k.name[63], "g3");
}
END_TEST

/* One step acts as the library's own; a sum is the sum of its parts, and knows where it jumps. */
START_TEST(a_text_becomes_a_force)
{
    fvi_typed_force *one, *sum;
    fvi_forcing kind;
    double p[2], F[2];
    ck_assert_int_eq(fvi_parse_force("step:8,1", 2, NULL, 9, &one, NULL), 0);
    ck_assert(fvi_typed_force_is_simple(one, &kind, p)
              && kind == FVI_FORCING_STEP && p[0] == 8 && p[1] == 1);
    ck_assert_int_eq(fvi_parse_force("step:8,1 + cos(t) + impulse:2,3", 2, NULL,
                                     9, &sum, NULL),
                     0);
    ck_assert(!fvi_typed_force_is_simple(sum, &kind, p));
    const fvi_force f = fvi_force_typed(sum);
    ck_assert_int_eq(f.value(0.5, 2, f.params, F), 0);
    ck_assert(F[0] == 8 + cos(0.5) && F[1] == F[0]);
    ck_assert(fvi_typed_force_jump(sum, 0) == 1
              && fvi_typed_force_jump(sum, 1) == 3
              && isnan(fvi_typed_force_jump(sum, 2)));
    ck_assert(f.impulse_count == 1 && f.impulses->J[1] == 2);
    ck_assert_ptr_null(fvi_typed_force_file(sum, 0));
    fvi_typed_force_free(one);
    fvi_typed_force_free(sum);
}
END_TEST

/* The whole of it in one text: the motion is that of the same numbers by hand. */
START_TEST(a_text_becomes_a_problem)
{
    fvi_typed_problem *typed;
    ck_assert_int_eq(
        fvi_parse_problem("m=2; U=k*x^4/4; let=k=0.7; damper=zener:1,.3,.5 + "
                          "viscous:0.1;\n force=step:8,1; x0=1; p0=0; T=3",
                          &typed, &error),
        0);
    const fvi_problem *p = fvi_problem_typed(typed);
    ck_assert(p->system.d == 1 && p->system.mass[0] == 2
              && p->system.damping[0] == 1 && p->x0[0] == 1 && p->p0[0] == 0);
    ck_assert(p->T == 3 && p->law && p->law->count == 2
              && p->past == FVI_INITIAL_HISTORY_HELD);
    const fvi_accuracy accuracy = { .tolerance = 1e-5 };
    double x[4], grad;
    const fvi_outputs outputs = { .rows = 4, .x = x };
    ck_assert_int_eq(
        fvi_solve(p, NULL, &accuracy, &outputs, NULL, &error), 0);
    ck_assert(p->system.potential.gradient(1, x, p->system.potential.params,
                                           &grad)
              == 0);
    ck_assert(x[0] == 1 && fabs(x[3] - 1) > 0.01 && fabs(grad - 0.7) < 1e-15);
    fvi_typed_problem_free(typed);
    fvi_parse_problem("potentia=free", &typed, &error);
    expect(FVI_EINVAL, "problem",
           "'potentia' is no name of a problem; did you mean potential?");
    fvi_parse_problem("m=1; mass=2", &typed, &error);
    expect(FVI_EINVAL, "mass", "given twice");
    fvi_parse_problem("damping=viscous:1; alpha=0.3", &typed, &error);
    expect(FVI_EINVAL, "damping", "not together with alpha");
    fvi_parse_problem("alpha=1.3", &typed, &error);
    expect(FVI_EDOM, "alpha", "'1.3' is outside [0, 1]");
    fvi_parse_problem("L=v1^2/2 - x1^2 - x2^2; x0=1,1; v0=1,5", &typed, &error);
    expect(FVI_EINVAL, "v0",
           "v2 is 5: this coordinate has no inertia, and its velocity follows from the forces: give 0");
    const fvi_method *method;
    ck_assert_int_eq(fvi_parse_method("fvi-lobatto3", &method, NULL), 0);
    ck_assert_str_eq(method->name, "fvi-lobatto3");
}
END_TEST

/* 1/t is infinite at t = 0, and sin(t)/t is not a number there; Algorithm 3 takes both. */
START_TEST(a_force_is_checked_at_the_start_of_a_run)
{
    static const char *const texts[] = { "1/t", "sin(t)/t", "cos(t)" };
    for (size_t i = 0; i < LEN(texts); i++) {
        fvi_user_parameters none = { 0 };
        fvi_typed_force *force;
        ck_assert_int_eq(fvi_parse_force(texts[i], 1, &none, 1, &force, &error), 0);
        ck_assert_int_eq(fvi_check_start_force(&fvi_cq_bdf2, "F", texts[i], force, &error),
                         i == 0 ? FVI_EINVAL : FVI_SUCCESS);
        if (i == 0)
            expect(FVI_EINVAL, "F", "'1/t' is infinite at t = 0: fvi-bdf2 takes its first step from its limit there");
        ck_assert_int_eq(fvi_check_start_force(&fvi_fractional, "F", texts[i], force, &error), FVI_SUCCESS);
        fvi_typed_force_free(force);
    }
}
END_TEST

/* x of the problem at its end, by a method in 40 steps. */
static void solve_text(const char *text, const fvi_method *method, double *x)
{
    fvi_typed_problem *typed;
    ck_assert_msg(fvi_parse_problem(text, &typed, &error) == 0, "%s: %s: %s",
                  text, error.field, error.text);
    const fvi_problem *p = fvi_problem_typed(typed);
    const fvi_solve_options options = { .method = method, .h = p->T / 40 };
    double all[41 * 4], E[41];
    const fvi_outputs outputs = { .rows = 41, .x = all, .energy = E };
    ck_assert_msg(fvi_solve(p, &options, NULL, &outputs, NULL, &error) == 0,
                  "%s: %s: %s", text, error.field, error.text);
    memcpy(x, all + 40 * p->system.d, p->system.d * sizeof *x);
    ck_assert(isfinite(E[40]));
    fvi_typed_problem_free(typed);
}

/* Rows of another program (tests/lagrangian/prototype_values.h), and the old words in the new ones. */
START_TEST(a_text_becomes_a_mechanism)
{
    double x[4], y[4];
    solve_text("L=(v1^2+v2^2)/2 - 2*(sqrt(x1^2+x2^2)-1)^2 - x2; damper=strut="
               "sqrt(x1^2+x2^2) : power:0.4,0.3; x0=1.2,0; v0=0.3,0.8; T=4",
               &fvi_lobatto_m3, x);
    ck_assert(fabs(x[0] + 0.5808302917698285) < 1e-13
              && fabs(x[1] + 1.1437031544085847) < 1e-13);
    solve_text("U=x^2/2; force-on=1=(1-x^2)*v; damper=x : power:0.3,0.3; "
               "x0=0.5; p0=0.4; T=4", &fvi_cq2_midpoint, x);
    ck_assert(fabs(x[0] + 1.1217070298850418) < 1e-13);
    solve_text("U=x^2/2; force-on=1=(1-x^2)*v; alpha=0.3; rho=0.3; x0=0.5; "
               "v0=0.4; T=4", &fvi_cq2_midpoint, y);
    ck_assert(x[0] == y[0]);
    solve_text("U=x3^2/2; damper=x2-x1 : zener:1,0.3,2 : caputo; T=4",
               &fvi_lobatto_d3, x);
    solve_text("m=1,2; U=(x1-x2)^2; impose=x1=sin(t); rho=0; x0=0; v0=1,0; T=4",
               &fvi_cq2_midpoint, x);
    ck_assert(fabs(x[0] - sin(4)) < 1e-14);
    solve_text("L=(v1^2+v2^2)/2; constraint=x1+x2-1; x0=1,0; v0=1,-1; T=4",
               &fvi_lobatto_m4, x);
    ck_assert(fabs(x[0] - 5) < 1e-14 && fabs(x[1] + 4) < 1e-14);
    static const char *const wrong[][3] = {
        { "L=v^2; x0=1", "lagrangian", "a start is missing: x0, and v0 or p0" },
        { "L=v^2; m=1; x0=1; v0=1", "lagrangian", "not together with mass" },
        { "L=v^2; rho=1; x0=1; v0=1", "lagrangian", "not together with rho" },
        { "damper=x : power:1,0.3; past=rl", "damper",
          "not together with derivative" },
        { "v0=1; p0=1", "v0", "not together with p0" },
        { "damper=x : pwer:1,0.3", "damper", NULL },
        { "constraint=z", "constraint", NULL },
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        fvi_typed_problem *typed;
        ck_assert_int_eq(fvi_parse_problem(wrong[i][0], &typed, &error),
                         FVI_EINVAL);
        ck_assert_str_eq(error.field, wrong[i][1]);
        if (wrong[i][2])
            ck_assert_str_eq(error.text, wrong[i][2]);
    }
}
END_TEST

/* Rows (0, 1, 10), (1, 2, 30), (4, -1, 30): halves and quarters are exact. */
START_TEST(a_table_is_linear_between_its_rows)
{
    const double t[] = { 0, 1, 4 }, F[] = { 1, 10, 2, 30, -1, 30 };
    const fvi_force_rows each = { 3, 2, t, F }, all = { 2, 1, t, F };
    fvi_force force = fvi_force_table(&each);
    double at[2], most[4];
    const double when[] = { -1, 0, 0.5, 1, 2.5, 4, 9 },
                 one[] = { 1, 1, 1.5, 2, 0.5, -1, -1 },
                 two[] = { 10, 10, 20, 30, 30, 30, 30 };
    for (size_t k = 0; k < sizeof when / sizeof *when; k++) {
        ck_assert_int_eq(force.value(when[k], 2, force.params, at), 0);
        ck_assert(at[0] == one[k] && at[1] == two[k]);
    }
    ck_assert(force.jump_count == 3 && force.jumps[2] == 4);
    ck_assert_int_eq(force.bound(0, 2, 1, 2, force.params, most), 0);
    ck_assert(most[0] >= 0.5 && most[0] < 0.5 + 1e-14 && most[1] >= 10
              && most[2] >= 1 && most[2] < 1 + 1e-11 && most[3] >= 20);
    force = fvi_force_table(&all); /* 1 at 0, 10 at 1, on both masses */
    ck_assert_int_eq(force.value(0.5, 2, force.params, at), 0);
    ck_assert(at[0] == 5.5 && at[1] == 5.5);
    ck_assert_int_eq(force.bound(0, 1, 1, 2, force.params, most), 0);
    ck_assert(most[1] == most[0] && most[0] >= 4.5 && most[3] == most[2]
              && most[2] >= 9);
    force = fvi_force_table(&(fvi_force_rows){ 0 });
    ck_assert(!force.value);
}
END_TEST

/* m = 2, 4 along r = 1, -1/2, a_g = 3 t on two rows, and a force of 1 besides: F = 1 - 6 t, 1 + 6 t. */
START_TEST(a_ground_is_also_an_acceleration_that_is_no_text)
{
    const double t[] = { 0, 1 }, a[] = { 0, 3 }, mass[] = { 2, 4 }, r[] = { 1, -0.5 },
                 one = 1;
    const fvi_force_rows rows = { 2, 1, t, a }, besides = { 1, 1, t, &one };
    const fvi_force shaking = fvi_force_table(&rows);
    const fvi_system system = { .d = 2, .mass = mass, .force = fvi_force_table(&besides) };
    fvi_ground *ground;
    double F[2], ag, most[4];
    ck_assert_int_eq(fvi_ground_alloc(&shaking, &system, r, &ground, &error), 0);
    const fvi_force force = fvi_ground_force(ground),
                    *acceleration = fvi_ground_acceleration(ground);
    ck_assert_int_eq(force.value(0.5, 2, force.params, F), 0);
    ck_assert(F[0] == -2 && F[1] == 4);
    ck_assert_int_eq(acceleration->value(0.5, 1, acceleration->params, &ag), 0);
    ck_assert(ag == 1.5 && !fvi_ground_typed(ground));
    ck_assert(force.jump_count == 3 && force.bound);
    ck_assert_int_eq(force.bound(0, 0.5, 1, 2, force.params, most), 0);
    ck_assert(most[2] >= 6 && most[3] >= 6 && most[3] < 6.01);
    fvi_ground_free(ground);
    const fvi_force hammer = { .impulse_count = 1 };
    ck_assert_int_eq(fvi_ground_alloc(&hammer, &system, r, &ground, &error), FVI_EINVAL);
    expect(FVI_EINVAL, "ground", "an impulse is no acceleration");
    ck_assert_int_eq(fvi_ground_alloc(&hammer, &system, NULL, &ground, &error), FVI_EFAULT);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("problems as they are typed");
    ADD_CASE(suite, "parse", a_text_becomes_a_potential,
             an_error_says_field_value_index_and_text,
             parameters_are_names_with_one_value_that_are_used,
             a_text_becomes_a_force, a_table_is_linear_between_its_rows,
             a_ground_is_also_an_acceleration_that_is_no_text,
             a_text_becomes_a_problem, a_force_is_checked_at_the_start_of_a_run, a_text_becomes_a_mechanism);
    return run_suite(suite);
}
