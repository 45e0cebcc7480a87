/* tests/adjoint/test_adjoint_mechanism_mesh.c -- H 23, 29: derivatives of mechanisms by fvi_variable_step.
 * Run alone: make test-adjoint_mechanism_mesh */
#include <fvi/fvi.h>

#include "harness/seen.h"
#include "harness/ulp.h"
#include "system/larger.h"

#include <check.h>
#include <math.h>
#include <string.h>

#define OK(call) ck_assert_int_eq(call, FVI_SUCCESS)

enum { MOST = 3, NAMES = 4, ROWS = 500 };

static const char *const names[] = { "a", "b", "c", "k" };
static const double values[] = { 1.5, 0.25, 0.375, 2 }, span = 2;

typedef struct {
    const char *name, *lagrangian, *damper[MOST], *force, *constraint, *imposed;
    size_t d, dampers;
    int is_hit; /* by two impulses */
    double x0[2], p0[2], along[2]; /* by x0 and p0 in this direction alone, if there is one */
} mesh_problem;

/* Laws below and above the order 1, at rest and with a slope, springs and dashpots, and sums that have modes that
 * rise; g knows t. */
static const mesh_problem problems[] = {
    { .name = "below the order 1",
      .lagrangian = "(v1^2+v2^2)/2-k*(sqrt(x1^2+x2^2)-1)^2-x2",
      .damper = { "sqrt((x1-a)^2+x2^2)+b*x1^2 : power:0.4,0.3", "x2 : viscous:0.2", "x1*x2+b*t : spring:0.3" },
      .force = "1=c*v1*(1-x1^2)",
      .d = 2, .dampers = 3, .x0 = { 1.2, 0.3 }, .p0 = { 0.3, 0.8 } },
    { .name = "Zener and Maxwell",
      .lagrangian = "(v1^2+v2^2)/2+b*v1*v2*cos(x1)-k*(sqrt(x1^2+x2^2)-1)^2-x2",
      .damper = { "sqrt((x1-a)^2+x2^2) : zener:0.4,0.3,0.5", "x2-c*x1 : maxwell:0.4,0.7" },
      .d = 2, .dampers = 2, .x0 = { 1.2, 0.3 }, .p0 = { 0.3, 0.8 } },
    { .name = "steep, at rest",
      .lagrangian = "(v1^2+v2^2)/2-k*(sqrt(x1^2+x2^2)-1)^2-x2+b*c*x1",
      .damper = { "sqrt((x1-a)^2+x2^2) : power:0.4,0.7" },
      .d = 2, .dampers = 1, .x0 = { 1.2, 0.3 } },
    { .name = "steep, with a slope",
      .lagrangian = "(v1^2+v2^2)/2-k*(sqrt(x1^2+x2^2)-1)^2-x2+b*c*x1",
      .damper = { "sqrt((x1-a)^2+x2^2) : power:0.4,0.7" },
      .d = 2, .dampers = 1, .x0 = { 1.2, 0.3 }, .p0 = { 0.3, 0.8 } },
    { .name = "a law that rises",
      .lagrangian = "(v1^2+v2^2)/2-k*(sqrt(x1^2+x2^2)-1)^2-x2+b*c*x1",
      .damper = { "sqrt((x1-a)^2+x2^2) : distributed:0.4,0.2,0.8" },
      .d = 2, .dampers = 1, .x0 = { 1.2, 0.3 }, .p0 = { 0.3, 0.8 } },
    { .name = "hit",
      .lagrangian = "(1+x1^2)*v1^2/2+(2+sin(3*x1))*v2^2/2+b*v1*v2*cos(2*x2)-k*(x1^2+x2^2)/2",
      .damper = { "sqrt((x1-a)^2+x2^2) : power:0.4,0.3", "x2-c*x1 : zener:0.3,0.3,0.5" },
      .is_hit = 1,
      .d = 2, .dampers = 2, .x0 = { 1.2, 0.3 }, .p0 = { 0.3, 0.8 } },
    { .name = "on a rod",
      .lagrangian = "(v1^2+v2^2)/2+x1*x2*v1/3-k*x2",
      .damper = { "sqrt((x1-a)^2+b*x2^2) : power:0.4,0.3" },
      .force = "1=c*v1*x2",
      .constraint = "(x1^2+x2^2-1)/2",
      .d = 2, .dampers = 1, .x0 = { 0.6, -0.8 }, .p0 = { 0.24, 0.3 }, .along = { 0.8, 0.6 } },
    { .name = "driven by hand",
      .lagrangian = "3*v1^2/2+v1*v2*cos(x2)+v2^2/2+k*cos(x2)",
      .damper = { "x2 : power:0.4,0.7" },
      .imposed = "x1=a*(1-cos(c*t))",
      .d = 2, .dampers = 1, .x0 = { 0, 1.2 }, .along = { 0, 1 } },
    { .name = "on a parabola",
      .lagrangian = "(v1^2+v2^2)/2-k*x2",
      .damper = { "x2+b*x1 : zener:0.4,0.3,0.5" },
      .constraint = "x2-a*x1^2",
      .d = 2, .dampers = 1, .p0 = { 0.7, 0 }, .along = { 1, 0 } },
    { .name = "without mass beside a hand",
      .lagrangian = "v1^2/2-(x1-k*x2)^2/2-b*x2^4",
      .damper = { "x2 : viscous:0.8" },
      .imposed = "x1=a*(1-cos(c*t))",
      .d = 2, .dampers = 1, .x0 = { 0, 1.2 }, .along = { 0, 1 } },
};
enum { COUNT = sizeof problems / sizeof *problems };

static const double jumps[][2] = { { 3, -4 }, { -5, 2 } };
static const fvi_impulse impulses[] = { { 0.8, jumps[0] }, { 1.2, jumps[1] } };

typedef struct {
    fvi_user_parameters known;
    fvi_typed_mechanism *typed;
    fvi_system system;
    fvi_run run;
} opened;

static void open_problem(const mesh_problem *t, opened *o)
{
    fvi_error error = { 0 };
    memset(o, 0, sizeof *o);
    o->known.count = NAMES;
    for (size_t j = 0; j < NAMES; j++) {
        o->known.name[j] = names[j];
        o->known.value[j] = values[j];
    }
    const fvi_mechanism_texts texts = { .lagrangian = t->lagrangian,
                                        .dampers = t->dampers,
                                        .damper = t->damper,
                                        .constraints = t->constraint != NULL,
                                        .constraint = &t->constraint,
                                        .imposed = t->imposed != NULL,
                                        .impose = &t->imposed,
                                        .forces_on = t->force != NULL,
                                        .force_on = &t->force };
    ck_assert_msg(!fvi_parse_mechanism(&texts, t->d, &o->known, &o->typed, &error), "%s", error.text);
    o->system = (fvi_system){ .d = t->d, .mechanism = fvi_mechanism_typed(o->typed) };
    o->system.force.impulse_count = t->is_hit ? 2 : 0;
    o->system.force.impulses = impulses;
    o->run = fvi_run_default(&o->system, t->x0, t->p0, span / ROWS, ROWS);
    o->run.step_error = 1e-12;
}

/* J has every row, and the last momentum. */
static int slopes(size_t k, size_t d, const double *x, const double *p, void *params, double *Jx,
                  double *Jp)
{
    (void)x, (void)params;
    for (size_t i = 0; i < d; i++) {
        Jx[i] += k < ROWS ? cos((double)(k * (i + 1)) / 40) / 100 : 1;
        if (p)
            Jp[i] += (double)(i + 1) / 2;
    }
    return 0;
}

typedef struct {
    double x0[2], p0[2], damping[MOST], by[NAMES], of_L[NAMES], force[2 * (ROWS + 1)];
} answers;

static void derivatives(const fvi_method *method, const mesh_problem *t, answers *a)
{
    const fvi_objective J = { .slopes = slopes };
    opened o;
    open_problem(t, &o);
    memset(a, 0, sizeof *a);
    const fvi_mechanism_columns columns = fvi_typed_mechanism_columns(o.typed, NAMES);
    const fvi_sensitivities want = { .x0 = a->x0,
                                     .p0 = a->p0,
                                     .damping = a->damping,
                                     .names = a->by,
                                     .columns = &columns,
                                     .sensitivity = { .count = NAMES },
                                     .parameters = a->of_L,
                                     .lagrangian = fvi_typed_lagrangian_column,
                                     .force = method->dense ? a->force : NULL };
    OK(fvi_adjoint(method, &o.run, NULL, NULL, &J, &want));
    for (size_t j = 0; j < NAMES; j++)
        a->by[j] += a->of_L[j];
    fvi_typed_mechanism_free(o.typed);
}

static void ck_assert_same(double got, double want, const char *name, const char *what, size_t i)
{
    const double off = fabs(got - want) / larger(1, fabs(want));
    ck_assert_msg(off <= 2e-10, "%s, %s %zu: %.15g, %.15g", name, what, i, got, want);
    seen_worst(off, "off");
}

static double along(const mesh_problem *t, const double *by)
{
    return t->along[0] * by[0] + t->along[1] * by[1];
}

/* 500 steps of form D with six stages, and the steps of fvi-adaptive, for the same rows. */
START_TEST(eq_23_16_a_mechanism_on_a_mesh_has_the_derivatives_of_form_D)
{
    const mesh_problem *t = problems + _i;
    answers mesh, fixed;
    derivatives(&fvi_variable_step, t, &mesh);
    derivatives(&fvi_lobatto_d6, t, &fixed);
    for (size_t i = 0; i < 2 && !t->constraint && !t->imposed; i++) {
        ck_assert_same(mesh.x0[i], fixed.x0[i], t->name, "x0", i);
        ck_assert_same(mesh.p0[i], fixed.p0[i], t->name, "p0", i);
    }
    ck_assert_same(along(t, mesh.x0), along(t, fixed.x0), t->name, "x0 along", 0);
    ck_assert_same(along(t, mesh.p0), along(t, fixed.p0), t->name, "p0 along", 0);
    for (size_t i = 0; i < t->dampers; i++)
        ck_assert_same(mesh.damping[i], fixed.damping[i], t->name, "factor", i);
    for (size_t i = 0; i < NAMES; i++)
        ck_assert_same(mesh.by[i], fixed.by[i], t->name, names[i], i);
}
END_TEST

/* A force that changes along lines is one in L: -b t x1 has the derivative of the rows of F_1 times t, and c x2 that
 * of the sum of those of F_2. To rounding: both are of the same steps. */
START_TEST(rows_of_the_force_are_those_of_the_lagrangian)
{
    static const mesh_problem t = { .name = "forces",
                                    .lagrangian = "(v1^2+v2^2)/2-x1^4/4-x2^2/2+(x1*x2)^2/3+(b-0.25)*t*x1+(c-0.375)*x2",
                                    .damper = { "x2-x1+x1^2/3 : power:0.4,0.3" },
                                    .d = 2, .dampers = 1, .x0 = { 1, 0.2 }, .p0 = { 0, 0.5 } };
    answers a;
    double by_b = 0, by_c = 0;
    derivatives(&fvi_variable_step, &t, &a);
    for (size_t k = 0; k <= ROWS; k++) {
        by_b += (double)k * span / ROWS * a.force[2 * k];
        by_c += a.force[2 * k + 1];
    }
    ck_assert_double_eq_tol(a.by[1], by_b, 1e-12);
    ck_assert_double_eq_tol(a.by[2], by_c, 1e-12);
    ck_assert(fabs(by_b) > 0.1 && fabs(by_c) > 0.1);
}
END_TEST

/* Masses and a potential beside dampers between points. */
START_TEST(masses_have_derivatives_on_a_mesh)
{
    static const double m[] = { 1, 2 }, zeros[] = { 0, 0 }, cg[] = { 1, 0.5 };
    static const mesh_problem t = { .damper = { "x2-x1 : power:0.4,0.3" }, .d = 2, .dampers = 1,
                                    .x0 = { 1, -0.5 }, .p0 = { 0, 0.5 } };
    const fvi_objective J = { .slopes = slopes };
    double mass[2][2], by[2][2];
    for (int i = 0; i < 2; i++) {
        opened o;
        open_problem(&t, &o);
        o.system.mass = m;
        o.system.damping = zeros;
        o.system.potential = fvi_potential_duffing(cg);
        memset(by[i], 0, sizeof by[i]);
        const fvi_sensitivities want = { .mass = mass[i],
                                         .parameters = by[i],
                                         .sensitivity = fvi_parameter_gradient_of(&o.system.potential) };
        OK(fvi_adjoint(i ? &fvi_lobatto_d6 : &fvi_variable_step, &o.run, NULL, NULL, &J, &want));
        fvi_typed_mechanism_free(o.typed);
    }
    for (size_t j = 0; j < 2; j++) {
        ck_assert_same(mass[0][j], mass[1][j], "masses", "mass", j);
        ck_assert_same(by[0][j], by[1][j], "masses", "c, g", j);
    }
}
END_TEST

enum { ROW = 200 };

static int place_in_one_row(size_t k, size_t d, const double *x, const double *p, void *params, double *Jx, double *Jp)
{
    (void)d, (void)x, (void)p, (void)params, (void)Jp;
    *Jx += k == ROW;
    return 0;
}

/* The mass is (1 + x)^2, so u = x + x^2/2 has the constant speed w = p / (1 + x), until an impulse adds 4 to p. A row
 * is so near behind the impulse that it lies in the next step. There x contains the v with which this step begins, and
 * this v depends on x through the mass: w+ = w + 4 / (1 + x). Without this dependence the derivative by x0 is off by
 * 1.3e-7. Seen: 3.4e-16. */
START_TEST(a_row_in_the_step_behind_an_impulse_knows_the_mass_there)
{
    static const double J = 4, behind = 3e-7;
    static const mesh_problem t = { .lagrangian = "(1+x)^2*v^2/2", .d = 1, .x0 = { 0.5 }, .p0 = { 0.75 } };
    const double t_hit = ROW * span / ROWS - behind, x0 = t.x0[0], p0 = t.p0[0], w = p0 / (1 + x0),
                 x_hit = sqrt(1 + 2 * (x0 + x0 * x0 / 2 + t_hit * w)) - 1, w_behind = w + J / (1 + x_hit),
                 x_row = sqrt((1 + x_hit) * (1 + x_hit) + 2 * behind * w_behind) - 1;
    const double by_u[] = { 1 + x0, 0 }, by_w[] = { -w / (1 + x0), 1 / (1 + x0) }; /* of u and w at the start */
    const fvi_impulse hit = { t_hit, &J };
    const fvi_objective row = { .slopes = place_in_one_row };
    double got[2];
    opened o;
    open_problem(&t, &o);
    o.system.force.impulse_count = 1;
    o.system.force.impulses = &hit;
    const fvi_sensitivities want = { .x0 = got, .p0 = got + 1 };
    OK(fvi_adjoint(&fvi_variable_step, &o.run, NULL, NULL, &row, &want));
    for (size_t i = 0; i < 2; i++) {
        const double u_hit = by_u[i] + t_hit * by_w[i], by_w_behind = by_w[i] - J * u_hit / pow(1 + x_hit, 3),
                     by = (u_hit + behind * by_w_behind) / (1 + x_row);
        seen_worst(fabs(got[i] - by), "row");
        ck_assert_near(got[i], by, 1e-11, "by %s", i ? "p0" : "x0");
    }
    fvi_typed_mechanism_free(o.typed);
}
END_TEST

START_TEST(what_a_mesh_has_no_derivative_of_is_refused)
{
    static const mesh_problem stretched = { .lagrangian = "v1^2/2-x1^2/2", .damper = { "x1 : power:0.4,0.3 : rl" },
                                            .d = 1, .dampers = 1, .x0 = { 1 } },
                              caputo = { .lagrangian = "v1^2/2-x1^2/2", .damper = { "x1 : power:0.4,0.7 : caputo" },
                                         .d = 1, .dampers = 1, .x0 = { 1 } };
    const fvi_objective J = { .slopes = slopes }, all = { .slopes = slopes, .has_momenta = 1 };
    double numbers[8];
    opened o;
    for (int i = 0; i < 2; i++) {
        open_problem(i ? &caputo : &stretched, &o);
        const fvi_sensitivities want = { .x0 = numbers };
        ck_assert_int_eq(fvi_adjoint(&fvi_variable_step, &o.run, NULL, NULL, &J, &want), FVI_EUNSUP);
        fvi_typed_mechanism_free(o.typed);
    }
    mesh_problem both = problems[COUNT - 1];
    both.is_hit = 1;
    open_problem(&both, &o);
    const fvi_sensitivities by_x0 = { .x0 = numbers };
    ck_assert_int_eq(fvi_adjoint(&fvi_variable_step, &o.run, NULL, NULL, &J, &by_x0), FVI_EUNSUP);
    fvi_typed_mechanism_free(o.typed);
    open_problem(problems, &o);
    const fvi_sensitivities want = { .x0 = numbers }, by_order = { .orders = numbers }, by_rho = { .terms = numbers };
    ck_assert_int_eq(fvi_adjoint(&fvi_variable_step, &o.run, NULL, NULL, &all, &want), FVI_EUNSUP);
    ck_assert_int_eq(fvi_adjoint(&fvi_variable_step, &o.run, NULL, NULL, &J, &by_order), FVI_EUNSUP);
    ck_assert_int_eq(fvi_adjoint(&fvi_variable_step, &o.run, NULL, NULL, &J, &by_rho), FVI_EUNSUP);
    fvi_typed_mechanism_free(o.typed);
}
END_TEST

/* J has no value at a row behind the start. */
static int stop_at_3(size_t k, size_t d, const double *x, const double *p, void *params, double *Jx, double *Jp)
{
    (void)d, (void)x, (void)p, (void)params, (void)Jx, (void)Jp;
    return k == 3 ? -7 : 0;
}

START_TEST(what_a_callback_returns_comes_back)
{
    const fvi_objective J = { .slopes = stop_at_3 };
    for (int i = 0; i < COUNT; i++) {
        double x0[4];
        opened o;
        open_problem(&problems[i], &o);
        const fvi_sensitivities want = { .x0 = x0 };
        ck_assert_int_eq(fvi_adjoint(&fvi_variable_step, &o.run, NULL, NULL, &J, &want), -7);
        fvi_typed_mechanism_free(o.typed);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("adjoint, mechanisms on a mesh");
    ADD_LOOP(suite, eq_23_16_a_mechanism_on_a_mesh_has_the_derivatives_of_form_D, COUNT);
    ADD_CASE(suite, "mesh", rows_of_the_force_are_those_of_the_lagrangian, masses_have_derivatives_on_a_mesh,
             a_row_in_the_step_behind_an_impulse_knows_the_mass_there,
             what_a_mesh_has_no_derivative_of_is_refused, what_a_callback_returns_comes_back);
    return run_suite(suite);
}
