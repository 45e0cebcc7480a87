/* tests/adjoint/test_adjoint_names.c -- H 23, 29: derivatives by names that occur in elongations, constraints,
 * imposed coordinates and forces of velocity.
 * Run alone: make test-adjoint_names */
#include <fvi/fvi.h>

#include "harness/seen.h"
#include "harness/ulp.h"
#include "system/larger.h"

#include <check.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MOST = 3, NAMES = 3, STEPS = 12 };

static const char *const names[] = { "a", "b", "c" };
static const double values[] = { 1.5, 0.25, 0.375 };

typedef struct {
    const char *name;
    size_t d, dampers, constraints, imposed, forces;
    const char *lagrangian, *damper[MOST], *constraint[MOST], *impose[MOST], *force[MOST];
    double x0[3], v0[3];
} names_problem;

/* Every place where a name may stand; kernels below and above the order 1, every past, and a start with a slope. */
static const names_problem problems[] = {
    { .name = "elongations and a force",
      .d = 2,
      .dampers = 2,
      .forces = 1,
      .lagrangian = "(v1^2+v2^2)/2-2*(sqrt(x1^2+x2^2)-1)^2-b*x2",
      .damper = { "sqrt((x1-a)^2+x2^2)+b*x1^2*sin(t) : power:0.4,0.3", "x1*x2*c : zener:0.3,0.4,2" },
      .force = { "1=c*v1*(1-x1^2)+a*t*v2" },
      .x0 = { 1.2, 0.3 },
      .v0 = { 0.3, 0.8 } },
    { .name = "a steep start",
      .d = 2,
      .dampers = 3,
      .lagrangian = "(v1^2+v2^2)/2+x1*v2*b-x1^2*x2^2/2",
      .damper = { "sqrt((x1-a)^2+x2^2)+c*t : power:0.4,0.7", "x1+c*x2^2 : power:0.2,0.7 : caputo",
                  "x2-b*x1 : distributed:0.4,0.2,0.8" },
      .x0 = { 0.2, 0.3 },
      .v0 = { 0.3, 0.8 } },
    { .name = "stretched at once",
      .d = 1,
      .dampers = 1,
      .forces = 1,
      .lagrangian = "v^2/2-x^2/2",
      .damper = { "a*x+b*x^3 : power:0.4,0.3 : rl" },
      .force = { "1=-c*v^3" },
      .x0 = { 0.5 },
      .v0 = { 0.3 } },
    { .name = "a constraint that holds at the start",
      .d = 2,
      .dampers = 1,
      .constraints = 1,
      .forces = 1,
      .lagrangian = "(v1^2+v2^2)/2-x2",
      .damper = { "x2+b*x1 : power:0.4,0.3" },
      .constraint = { "x2-a*x1^2-c*x1^3" },
      .force = { "2=-c*v2" },
      .x0 = { 0, 0 },
      .v0 = { 0.7, 0 } },
    { .name = "imposed",
      .d = 3,
      .dampers = 1,
      .imposed = 1,
      .constraints = 1,
      .lagrangian = "(v1^2+v2^2+v3^2)/2+v1*v2/4-(x2-x1)^2/2-x3^2/2-x3^4/8",
      .damper = { "x2-x1 : power:0.4,0.3" },
      .impose = { "x1=a*(1-cos(c*t))" },
      .constraint = { "x3-x2-b*x2^2" },
      .x0 = { 0, 0, 0 },
      .v0 = { 0, 0.5, 0.5 } },
};
enum { COUNT = sizeof problems / sizeof *problems };

typedef struct {
    fvi_user_parameters known;
    fvi_typed_mechanism *typed;
    fvi_system system;
    double p0[3];
    fvi_run run;
} opened;

static void open_at(const names_problem *t, const double *at, opened *o)
{
    fvi_error error = { 0 };
    memset(o, 0, sizeof *o);
    o->known.count = NAMES;
    for (size_t j = 0; j < NAMES; j++) {
        o->known.name[j] = names[j];
        o->known.value[j] = at[j];
    }
    const fvi_mechanism_texts texts = { .lagrangian = t->lagrangian,
                                        .dampers = t->dampers,
                                        .damper = t->damper,
                                        .constraints = t->constraints,
                                        .constraint = t->constraint,
                                        .imposed = t->imposed,
                                        .impose = t->impose,
                                        .forces_on = t->forces,
                                        .force_on = t->force };
    ck_assert_msg(!fvi_parse_mechanism(&texts, t->d, &o->known, &o->typed, &error), "%s", error.text);
    o->system = (fvi_system){ .d = t->d, .mechanism = fvi_mechanism_typed(o->typed) };
}

/* The start is that of `values`, whatever the names are. */
static void open_problem(const names_problem *t, const double *at, opened *o)
{
    opened first;
    open_at(t, values, &first);
    double p0[3];
    OK(fvi_momentum_of_velocity(&first.system, 0, t->x0, t->v0, p0));
    fvi_typed_mechanism_free(first.typed);
    open_at(t, at, o);
    memcpy(o->p0, p0, sizeof p0);
    o->run = fvi_run_default(&o->system, t->x0, o->p0, 1. / 8, STEPS);
}

/* J = sum_i (i + 1) x_i / 2 + p_i at the end, and a tenth of x_0 at each node before. */
static int slopes(size_t k, size_t d, const double *x, const double *p, void *params, double *Jx,
                  double *Jp)
{
    (void)x, (void)params;
    if (k < STEPS)
        Jx[0] += 0.1;
    for (size_t i = 0; p && i < d; i++) {
        Jx[i] += (double)(i + 1) / 2;
        Jp[i] += 1;
    }
    return 0;
}

static double objective(const fvi_method *method, const names_problem *t, const double *at)
{
    opened o;
    fvi_stepper *s;
    fvi_error error = { 0 };
    double J = 0;
    open_problem(t, at, &o);
    ck_assert_msg(!fvi_stepper_start(method, &o.run, &s, &error), "%s: %s", t->name, error.text);
    for (;;) {
        for (size_t i = 0; s->k == STEPS && i < t->d; i++)
            J += (double)(i + 1) / 2 * s->x[i] + s->p[i];
        if (s->k == STEPS)
            break;
        J += 0.1 * s->x[0];
        OK(fvi_stepper_step(s));
    }
    fvi_stepper_free(s);
    fvi_typed_mechanism_free(o.typed);
    return J;
}

/* Of the order 6. J rounds some 1e-15, which 110 times at most is divided by 60 e. */
static double difference(const fvi_method *method, const names_problem *t, size_t j)
{
    static const double weights[] = { 45, -9, 1 };
    const double e = 2e-3;
    double sum = 0;
    for (int n = 1; n <= 3; n++)
        for (int sign = -1; sign <= 1; sign += 2) {
            double at[NAMES];
            memcpy(at, values, sizeof at);
            at[j] += sign * n * e;
            sum += sign * weights[n - 1] * objective(method, t, at);
        }
    return sum / (60 * e);
}

static void derivatives(const fvi_method *method, const names_problem *t, double *by)
{
    const fvi_objective J = { .slopes = slopes };
    double of_L[NAMES];
    opened o;
    open_problem(t, values, &o);
    const fvi_mechanism_columns columns = fvi_typed_mechanism_columns(o.typed, NAMES);
    memset(by, 0, NAMES * sizeof *by);
    memset(of_L, 0, sizeof of_L);
    const fvi_sensitivities want = { .names = by,
                                     .columns = &columns,
                                     .sensitivity = { .count = NAMES },
                                     .parameters = of_L,
                                     .lagrangian = fvi_typed_lagrangian_column };
    OK(fvi_adjoint(method, &o.run, NULL, NULL, &J, &want));
    for (size_t j = 0; j < NAMES; j++)
        by[j] += of_L[j];
    fvi_typed_mechanism_free(o.typed);
}

START_TEST(eq_23_31_names_have_the_derivatives_of_differences)
{
    const fvi_method *const methods[] = { &fvi_fractional, &fvi_cq2_midpoint, &fvi_lobatto_m2,
                                          &fvi_lobatto_m4, &fvi_lobatto_d2,   &fvi_lobatto_d4 };
    const names_problem *t = problems + _i;
    for (size_t m = 0; m < 6; m++) {
        if (t->constraints && m == 0)
            continue;
        double by[NAMES];
        derivatives(methods[m], t, by);
        for (size_t j = 0; j < NAMES; j++) {
            const double want = difference(methods[m], t, j), off = fabs(by[j] - want);
            ck_assert_msg(off <= 1e-11 * larger(1, fabs(want)), "%s, %s, %s: %.12g, difference %.12g",
                          t->name, methods[m]->name, names[j], by[j], want);
            seen_worst(off, "off");
        }
    }
}
END_TEST

/* Twice as long is four times as strong: by c at 1 of g = c (x2 - x1)^2 the derivative is twice that by the factor
 * of a law, to rounding. */
START_TEST(a_factor_of_an_elongation_is_twice_one_of_the_law)
{
    static const names_problem t = { .name = "factor",
                                     .d = 2,
                                     .dampers = 1,
                                     .lagrangian = "(v1^2+v2^2)/2-x1^2/2-x2^4/4",
                                     .damper = { "(c+0.625)*(x2-x1+x1^2/3) : zener:0.4,0.3,0.5" },
                                     .x0 = { 1, 0.2 },
                                     .v0 = { 0, 0.5 } };
    const fvi_method *const methods[] = { &fvi_fractional, &fvi_cq2_midpoint, &fvi_lobatto_m3, &fvi_lobatto_d3 };
    const fvi_objective J = { .slopes = slopes };
    for (size_t m = 0; m < 4; m++) {
        double by[NAMES], factor = 0;
        opened o;
        derivatives(methods[m], &t, by);
        open_problem(&t, values, &o);
        const fvi_sensitivities want = { .damping = &factor };
        OK(fvi_adjoint(methods[m], &o.run, NULL, NULL, &J, &want));
        ck_assert_msg(fabs(by[2] - 2 * factor) <= 1e-13, "%s: %g, %g", methods[m]->name, by[2], factor);
        fvi_typed_mechanism_free(o.typed);
    }
}
END_TEST

/* A body that only a force and a damper move. If the elongation is x + c t, the damper acts as if the elongation were x
 * and the start faster by c. So the derivatives by its law are the same, also for an order above 1, where the slope of
 * the start acts. With stages a sum of such an order has no derivatives by its numbers, but one by a factor. */
START_TEST(eq_23_29_an_elongation_that_moves_starts_with_a_slope_of_its_own)
{
    static const char *const laws[] = { "power:0.4,0.7", "power:0.4,0.7 : caputo", "zener:0.4,0.3,2",
                                        "viscous:0.3 + power:0.4,0.6" };
    const fvi_method *const methods[] = { &fvi_fractional, &fvi_cq2_midpoint, &fvi_lobatto_m2,
                                          &fvi_lobatto_m4, &fvi_lobatto_d2,   &fvi_lobatto_d4 };
    const fvi_objective J = { .slopes = slopes };
    for (size_t n = 0; n < LEN(laws) * LEN(methods); n++) {
        const fvi_method *method = methods[n % LEN(methods)];
        const char *law = laws[n / LEN(methods)];
        double by[2][4] = { { 0 } }; /* by a factor, rho, order and time */
        for (size_t moves = 0; moves < 2; moves++) {
            char text[80];
            snprintf(text, sizeof text, "%s : %s", moves ? "x+c*t" : "x", law);
            const names_problem t = { .name = law,
                                      .d = 1,
                                      .dampers = 1,
                                      .forces = 1,
                                      .lagrangian = "v^2/2",
                                      .damper = { text },
                                      .force = { "1=cos(t)" },
                                      .x0 = { 0.5 },
                                      .v0 = { moves ? -0.25 : -0.25 + values[2] } };
            double *to = by[moves];
            opened o;
            open_problem(&t, values, &o);
            const fvi_sensitivities factor = { .damping = to },
                                    all = { .damping = to, .terms = to + 1, .orders = to + 2, .times = to + 3 };
            OK(fvi_adjoint(method, &o.run, NULL, NULL, &J, strchr(law, '+') ? &factor : &all));
            fvi_typed_mechanism_free(o.typed);
        }
        for (size_t i = 0; i < 4; i++) {
            seen_worst(fabs(by[1][i] - by[0][i]), "slope");
            ck_assert_near(by[1][i], by[0][i], 1e-13, "%s, %s, %zu", law, method->name, i);
        }
        ck_assert(by[0][0] != 0);
    }
}
END_TEST

/* The length of a rod moves the start: NaN; so does a speed at which a coordinate is imposed. Columns that are
 * missing are asked for. */
START_TEST(a_name_that_moves_the_start_has_none)
{
    static const names_problem rod = { .name = "rod",
                                       .d = 2,
                                       .constraints = 1,
                                       .lagrangian = "(v1^2+v2^2)/2-b*x2",
                                       .constraint = { "x1^2+x2^2-a^2" },
                                       .x0 = { 1.5, 0 },
                                       .v0 = { 0, 0.5 } },
                               driven = { .name = "driven",
                                          .d = 2,
                                          .imposed = 1,
                                          .lagrangian = "(v1^2+v2^2)/2-(x2-x1)^2/2",
                                          .impose = { "x1=b*sin(t)+c*t^2" },
                                          .x0 = { 0, 0 },
                                          .v0 = { 0.25, 0.5 } };
    double by[NAMES];
    derivatives(&fvi_cq2_midpoint, &rod, by);
    ck_assert(isnan(by[0]) && isfinite(by[1]) && by[2] == 0);
    derivatives(&fvi_lobatto_m3, &driven, by);
    ck_assert(by[0] == 0 && isnan(by[1]) && isfinite(by[2]) && by[2] != 0);

    const fvi_objective J = { .slopes = slopes };
    opened o;
    open_problem(&rod, values, &o);
    fvi_mechanism_columns columns = fvi_typed_mechanism_columns(o.typed, NAMES);
    fvi_sensitivities want = { .names = by };
    ck_assert_int_eq(fvi_adjoint(&fvi_cq2_midpoint, &o.run, NULL, NULL, &J, &want), FVI_EINVAL);
    columns.constraint = NULL;
    want.columns = &columns;
    ck_assert_int_eq(fvi_adjoint(&fvi_cq2_midpoint, &o.run, NULL, NULL, &J, &want), FVI_EINVAL);
    fvi_typed_mechanism_free(o.typed);
}
END_TEST

/* A pendulum on its rod that starts elsewhere on the circle, or faster: what x0 and p0 do along such changes, and the
 * factor of its damper, by all methods that take constraints. */
static names_problem rod_at(double angle, double speed, double factor, char law[static 80])
{
    snprintf(law, 80, "sqrt((x1-1.5)^2+x2^2) : power:%.17g,0.3", 0.4 * factor);
    return (names_problem){ .name = "rod, started elsewhere",
                            .d = 2,
                            .dampers = 1,
                            .constraints = 1,
                            .lagrangian = "(v1^2+v2^2)/2+x1*x2*v1/3-x2",
                            .damper = { law },
                            .constraint = { "(x1^2+x2^2-1)/2" },
                            .x0 = { sin(angle), -cos(angle) },
                            .v0 = { speed * cos(angle), speed * sin(angle) } };
}

START_TEST(eq_23_30_starts_along_a_constraint_by_every_method)
{
    const fvi_method *const methods[] = { &fvi_cq2_midpoint, &fvi_lobatto_m2, &fvi_lobatto_m4, &fvi_lobatto_d2,
                                          &fvi_lobatto_d3,   &fvi_lobatto_d4, &fvi_lobatto_d6 };
    const fvi_objective J = { .slopes = slopes };
    static const double weights[] = { 45, -9, 1 }, e = 2e-3, at[] = { 1.2, 0.5, 1 };
    char law[80];
    for (size_t m = 0; m < 7; m++) {
        const names_problem t = rod_at(at[0], at[1], at[2], law);
        double x0[2], p0[2], factor, got[3], p[7][2], off[3] = { 0 };
        opened o;
        open_problem(&t, values, &o);
        const fvi_sensitivities want = { .x0 = x0, .p0 = p0, .damping = &factor };
        OK(fvi_adjoint(methods[m], &o.run, NULL, NULL, &J, &want));
        fvi_typed_mechanism_free(o.typed);
        for (int i = 0; i < 3; i++) {
            double by = 0, dp[2] = { 0 };
            for (int n = -3; n <= 3; n++) {
                const double move = n * e, weight = n ? (n > 0 ? 1 : -1) * weights[(n > 0 ? n : -n) - 1] : 0;
                const names_problem moved = rod_at(at[0] + (i == 0) * move, at[1] + (i == 1) * move,
                                                   at[2] + (i == 2) * move, law);
                open_problem(&moved, values, &o);
                memcpy(p[n + 3], o.p0, sizeof *p);
                fvi_typed_mechanism_free(o.typed);
                by += n ? weight * objective(methods[m], &moved, values) : 0;
                for (int j = 0; j < 2; j++)
                    dp[j] += weight * p[n + 3][j];
            }
            by /= 60 * e;
            const double along = i == 0 ? x0[0] * cos(at[0]) + x0[1] * sin(at[0]) : 0;
            got[i] = i == 2 ? factor : along + (p0[0] * dp[0] + p0[1] * dp[1]) / (60 * e);
            off[i] = fabs(got[i] - by);
            ck_assert_msg(off[i] <= 1e-11, "%s, %d: %.12g, difference %.12g", methods[m]->name, i, got[i], by);
        }
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("adjoint, names");
    ADD_LOOP(suite, eq_23_31_names_have_the_derivatives_of_differences, COUNT);
    ADD_CASE(suite, "names", a_factor_of_an_elongation_is_twice_one_of_the_law,
             eq_23_29_an_elongation_that_moves_starts_with_a_slope_of_its_own,
             eq_23_30_starts_along_a_constraint_by_every_method, a_name_that_moves_the_start_has_none);
    return run_suite(suite);
}
