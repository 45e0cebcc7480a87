/* tests/lagrangian/test_lagrangian_adaptive.c -- H 29: form D with steps that the method chooses.
 * Run alone: make test-lagrangian_adaptive */
#include "adaptive_runs.h"

static const mechanism_text
    friction = FRICTION,
    drag = DRAG,
    /* order 1.4, held with a velocity along the damper */
    steep = { .name = "steep",
              .d = 2,
              .lagrangian = "(v1^2+v2^2)/2 - 2*(sqrt(x1^2+x2^2)-1)^2 - x2",
              .damper = { "sqrt(x1^2+x2^2) : power:0.4,0.7" },
              .x0 = { 1.2, 0 },
              .v0 = { 0.3, 0.8 } },
    imposed = { .name = "imposed",
                .d = 2,
                .lagrangian = "3*v1^2/2 + v1*v2*cos(x2) + v2^2/2 + cos(x2)",
                .damper = { "x1 : power:0.3,0.3", "x2 : power:0.2,0.3" },
                .imposed = { "x1=0.3*sin(2*t)" },
                .x0 = { 0, 1.2 },
                .v0 = { 0.6, 0.5 } };

/* References as in test_lagrangian_orders.c: Prony sums and Radau's method. */
enum { COUNT = 9 };
static const struct {
    const mechanism_text *text;
    double T, digits, x[2];
} references[COUNT] = {
    { &problems[CART], 4, 1e-12, { 0.127966315868, -0.687174193121 } },
    { &problems[TWIN], 4, 1e-12, { -0.883946635396, -0.825565360704 } },
    { &problems[VAN_DER_POL], 6, 1e-12, { 1.660268711808 } },
    { &problems[MATHIEU], 6, 1e-12, { 0.383718180036 } },
    { &friction, 6, 1e-12, { -0.160835363216 } },
    { &drag, 4, 1e-12, { 0.170596353837, -1.704472329246 } },
    { &steep, 4, 1e-10, { -0.578302121583, -1.387803211541 } },
    { &problems[ROD], 4, 1e-13, { -0.6238293682574, -0.7815605666227 } },
    { &imposed, 4, 1e-12, { 0.29680747398701454, -1.815275855394 } },
};

/* What a step may err by is what the end errs by at most, though steps add up: the estimate is a cautious
 * one. The largest part of it that was seen is 0.97. */
START_TEST(the_error_of_a_step_is_kept_at_the_end)
{
    mechanism_problem p;
    open_problem(references[_i].text, &p);
    for (double asked = 1e-3; asked > 0.5e-11; asked /= 100) {
        fvi_run run = run_of(&p, references[_i].T, 1);
        run.step_error = asked;
        fvi_stepper *s = at_end(&run);
        const double error = off(s, references[_i].x);
        ck_assert_msg(error <= asked + 2 * references[_i].digits, "%s: asked %g, reached %g",
                      references[_i].text->name, asked, error);
        seen(error / asked, "%s %g", references[_i].text->name, asked);
        fvi_stepper_free(s);
    }
    close_problem(&p);
}
END_TEST

/* fvi_solve with a tolerance: fvi-adaptive is its method, and its estimate is honest. */
START_TEST(a_tolerance_is_kept_and_its_estimate_honest)
{
    mechanism_problem p;
    open_problem(references[_i].text, &p);
    fvi_problem problem = { .system = p.system, .x0 = p.x0, .p0 = p.p0, .T = references[_i].T };
    for (double asked = 1e-3; asked > 0.5e-11; asked /= 100) {
        double x[2 * 2];
        const fvi_accuracy accuracy = { asked, 0 };
        const fvi_outputs out = { .rows = 2, .x = x };
        fvi_report report;
        OK(fvi_solve(&problem, NULL, &accuracy, &out, &report, NULL));
        ck_assert_ptr_eq(report.method, &fvi_variable_step);
        ck_assert_int_eq(report.form, 'D');
        double error = 0;
        for (size_t j = 0; j < p.system.d; j++)
            error = larger(error, fabs(x[p.system.d + j] - references[_i].x[j]));
        ck_assert_msg(error <= report.error + 2 * references[_i].digits && report.error <= asked,
                      "%s: asked %g, estimate %g, reached %g", references[_i].text->name, asked,
                      report.error, error);
    }
    close_problem(&p);
}
END_TEST

/* Steps no longer than h, of six stages: the error at the end falls with h^(2 s - 2), h from 0.779 to
 * 0.287, on average. The reference is the same method with 1e-13 and the others agree to its digits. */
START_TEST(eq_29_18_the_order_is_2s_minus_2)
{
    static const mechanism_text *const texts[] = { &problems[CART], &problems[TWIN],
                                                   &problems[ELASTIC] };
    mechanism_problem p;
    open_problem(texts[_i], &p);
    fvi_run run = run_of(&p, 4, 1);
    run.step_error = 1e-13;
    fvi_stepper *s = at_end(&run);
    double reference[2], errors[2];
    memcpy(reference, s->x, sizeof reference);
    fvi_stepper_free(s);
    const fvi_method *other = fvi_method_find("fvi-lobatto8d");
    s = stepper_at(other, &p, 4. / 320, 320, 320);
    ck_assert_msg(off(s, reference) <= 1e-12, "%s: %g", texts[_i]->name, off(s, reference));
    fvi_stepper_free(s);
    for (int k = 0; k < 2; k++) {
        run.step_error = 0.5;
        run.tolerance = 1e-300; /* the finest modes */
        run.longest = exp(k ? -1.25 : -0.25);
        s = at_end(&run);
        fvi_step_statistics counts;
        OK(fvi_stepper_statistics(s, &counts));
        ck_assert_int_eq(counts.stages, 6);
        errors[k] = off(s, reference);
        fvi_stepper_free(s);
    }
    const double order = log(errors[0] / errors[1]);
    ck_assert_msg(fabs(order - 10) <= 1.5, "%s: order %g, errors %g, %g", texts[_i]->name, order,
                  errors[0], errors[1]);
    seen(order, "%s", texts[_i]->name);
    close_problem(&p);
}
END_TEST

/* A damper on each coordinate alone is the damping of a run without a mechanism, whatever its past. The two
 * choose their steps alike, but solve for other unknowns, and start a singular past in another way. */
START_TEST(dampers_on_coordinates_are_the_old_damping)
{
    static const double alphas[] = { 0, 0.2, 0.45, 0.5, 0.7 }, row[] = { 1 }, cg[] = { 1, 0.5 },
                        x0 = 1, p0 = 0.5, rho = 0.4, mass = 1, none = 0;
    static const fvi_initial_history pasts[] = { FVI_INITIAL_HISTORY_HELD,
                                                 FVI_INITIAL_HISTORY_CAPUTO,
                                                 FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE };
    const double alpha = alphas[_i % 5];
    const fvi_initial_history past = pasts[_i / 5];
    if (past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE && alpha > 0.5)
        return;
    const fvi_kernel_term term = { FVI_KERNEL_POWER, rho, alpha, 0, 0 };
    const fvi_kernel law = { 1, &term };
    const fvi_damper damper = { .of = fvi_elongation_row(row), .kernel = &law, .past = past };
    const fvi_mechanism m = { .damper_count = 1, .damper = &damper };
    const fvi_potential spring = fvi_potential_duffing(cg);
    const fvi_system plain = { .d = 1, .mass = &mass, .damping = &rho, .potential = spring },
                     other = { .d = 1, .mass = &mass, .damping = &none, .potential = spring,
                               .mechanism = &m };
    fvi_run run = fvi_run_default(&plain, &x0, &p0, 0.1, 60);
    double x[61], p[61], X[61], P[61], worst = 0;
    run.step_error = 1e-10;
    run.alpha = alpha;
    run.past = past;
    OK(fvi_trajectory(&fvi_variable_step, &run, x, p, NULL));
    run.system = &other;
    run.alpha = 0.5;
    run.past = FVI_INITIAL_HISTORY_HELD;
    OK(fvi_trajectory(&fvi_variable_step, &run, X, P, NULL));
    for (int k = 0; k <= 60; k++)
        worst = larger(worst, fabs(x[k] - X[k]));
    ck_assert_msg(worst <= 1e-10, "alpha %g, past %d: %g", alpha, past, worst);
    seen(worst, "alpha %g past %d", alpha, past);
}
END_TEST

/* Every law by its own modes: the rows are those of the damping of a run, by the same law. */
START_TEST(laws_on_coordinates_are_the_old_laws)
{
    static const char *const laws[] = { "zener:0.4,0.3,0.5", "maxwell:0.3,0.5",
                                        "distributed:0.3,0.1,0.4", "davidson:0.3,0.3,0.5",
                                        "viscous:0.1 + spring:0.2 + power:0.2,0.3",
                                        "symbol:0.2*s^0.5/(1+s^0.3)" };
    static const double row[] = { 1 }, cg[] = { 1, 0.5 }, x0 = 1, p0 = 0.5, one = 1, none = 0;
    fvi_typed_damping law = { 0 };
    OK(fvi_parse_damping(laws[_i], NULL, &law, NULL));
    const fvi_kernel *kernel = &law.law;
    const fvi_damper damper = { .of = fvi_elongation_row(row), .kernel = kernel };
    const fvi_mechanism m = { .damper_count = 1, .damper = &damper };
    const fvi_potential spring = fvi_potential_duffing(cg);
    const fvi_system plain = { .d = 1, .mass = &one, .damping = &one, .potential = spring },
                     other = { .d = 1, .mass = &one, .damping = &none, .potential = spring,
                               .mechanism = &m };
    fvi_run run = fvi_run_default(&plain, &x0, &p0, 0.1, 60);
    double x[61], X[61];
    run.step_error = 1e-11;
    run.law = kernel;
    OK(fvi_trajectory(&fvi_variable_step, &run, x, NULL, NULL));
    run.system = &other;
    run.law = NULL;
    OK(fvi_trajectory(&fvi_variable_step, &run, X, NULL, NULL));
    for (int k = 0; k <= 60; k++)
        ck_assert_msg(fabs(x[k] - X[k]) <= 1e-11, "%s, row %d: %g", laws[_i], k, x[k] - X[k]);
    fvi_typed_damping_free(&law);
}
END_TEST

/* A rod and a crank that is driven: c and the hidden constraint hold at the ends of steps to roundings, at
 * other times c to the error and the hidden one to roundings; multipliers are those of fvi-lobatto5,
 * which is worse near the start. */
START_TEST(constraints_hold_on_a_mesh)
{
    const mechanism_text *text = _i ? &imposed : &problems[ROD];
    mechanism_problem p;
    open_problem(text, &p);
    fvi_run run = run_of(&p, 0.1, 40);
    run.step_error = 1e-9;
    const fvi_constraints *c = p.system.mechanism->constraints;
    fvi_stepper *s, *other;
    fvi_observer *o, *of_other;
    fvi_observation now, then;
    OK(fvi_stepper_start(&fvi_variable_step, &run, &s, NULL));
    OK(fvi_observer_start(s, FVI_OBSERVE_MULTIPLIER | FVI_OBSERVE_VELOCITY, &o, NULL));
    run.h /= 8;
    run.steps *= 8;
    OK(fvi_stepper_start(fvi_method_find("fvi-lobatto5"), &run, &other, NULL));
    OK(fvi_observer_start(other, FVI_OBSERVE_MULTIPLIER, &of_other, NULL));
    double worst = 0;
    for (size_t k = 0; k <= 40; k++) {
        const double t = (double)k * 0.1;
        while (s->t < t) {
            double value, v[2], C[2], ct;
            OK(fvi_observer_step(o, s));
            OK(c->value(s->t, 2, s->x, c->params, &value));
            OK(c->gradient(s->t, 2, s->x, c->params, C, &ct));
            OK(fvi_stepper_velocity(s, v));
            ck_assert_double_eq_tol(value, 0, 2e-15);
            ck_assert_double_eq_tol(C[0] * v[0] + C[1] * v[1] + ct, 0, 1e-14);
        }
        while (other->t < t)
            OK(fvi_observer_step(of_other, other));
        OK(fvi_observer_read(o, s, t, &now));
        OK(fvi_observer_read(of_other, other, t, &then));
        double value, C[2], ct;
        OK(c->value(t, 2, now.x, c->params, &value));
        OK(c->gradient(t, 2, now.x, c->params, C, &ct));
        ck_assert_double_eq_tol(value, 0, 1e-9);
        ck_assert_double_eq_tol(C[0] * now.v[0] + C[1] * now.v[1] + ct, 0, 1e-14);
        for (size_t j = 0; j < 2; j++)
            ck_assert_double_eq_tol(now.x[j], then.x[j], 1e-9);
        worst = larger(worst, k > 8 ? fabs(*now.multiplier - *then.multiplier) : 0);
    }
    ck_assert_msg(worst <= 2e-6, "%s: %g", text->name, worst);
    seen(worst, "multiplier, %s", text->name);
    double begin, end;
    OK(fvi_stepper_multipliers(s, &begin, &end));
    ck_assert_double_eq_tol(end, *then.multiplier, 1e-4); /* of one stage, to a low order */
    fvi_observer_free(o);
    fvi_observer_free(of_other);
    fvi_stepper_free(s);
    fvi_stepper_free(other);
    close_problem(&p);
}
END_TEST

/* A spring in series with a springpot, and no mass between them, is Zener's law. The place without mass keeps no velocity, so
 * errors of that cost no steps: 69 in place of 49, and 142 if they counted until the end of the run. */
START_TEST(eq_29_15_a_coordinate_without_mass)
{
    static const mechanism_text
        pair = { .name = "pair", .d = 2, .lagrangian = "v1^2/2 - x1^2/2 - (x1-x2)^2",
                 .damper = { "x2 : power:0.5,0.3" }, .v0 = { 1, 0 } },
        zener = { .name = "zener", .d = 1, .lagrangian = "v^2/2 - x^2/2",
                  .damper = { "x : zener:0.5,0.3,0.25" }, .v0 = { 1 } };
    double x[2];
    size_t steps[2];
    for (int i = 0; i < 2; i++) {
        mechanism_problem p;
        open_problem(i ? &zener : &pair, &p);
        fvi_run run = run_of(&p, 10, 1);
        run.step_error = 1e-12;
        fvi_stepper *s = at_end(&run);
        fvi_step_statistics counts;
        OK(fvi_stepper_statistics(s, &counts));
        steps[i] = counts.steps;
        x[i] = *s->x;
        fvi_stepper_free(s);
        close_problem(&p);
    }
    ck_assert_double_eq_tol(x[0], x[1], 1e-12);
    ck_assert_uint_le(steps[0], 2 * steps[1]);
}
END_TEST

/* What it refuses, with the field and the number. */
START_TEST(what_a_mesh_does_not_take_is_named)
{
    static const struct {
        mechanism_text text;
        const char *field, *says;
        int code;
    } wrong[] = {
        { { .name = "mass", .d = 1, .lagrangian = "v^2/2", .damper = { "x : viscous:1", "x : power:1,1" } },
          "damper", "damper 2 has the order 2", FVI_EUNSUP },
        { { .name = "cut", .d = 1, .lagrangian = "v^2/2", .damper = { "x : zener:1,0.7,1" } },
          "damper", "damper 1: a pole", FVI_EUNSUP },
        { { .name = "rl", .d = 1, .lagrangian = "v^2/2", .damper = { "x : zener:1,0.3,1 : rl" }, .x0 = { 1 } },
          "damper", "past rl", FVI_EUNSUP },
        { { .name = "rl", .d = 1, .lagrangian = "v^2/2", .damper = { "x : power:1,0.7 : rl" }, .x0 = { 1 } },
          "damper", "past rl", FVI_EDOM },
    };
    mechanism_problem p;
    open_problem(&wrong[_i].text, &p);
    const fvi_run run = run_of(&p, 0.1, 10);
    fvi_stepper *s = NULL;
    fvi_error error = { 0 };
    ck_assert_int_eq(fvi_stepper_start(&fvi_variable_step, &run, &s, &error), wrong[_i].code);
    ck_assert_str_eq(error.field, wrong[_i].field);
    ck_assert_ptr_nonnull(strstr(error.text, wrong[_i].says));
    close_problem(&p);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("lagrangian: steps of any length");
    ADD_LOOP(suite, the_error_of_a_step_is_kept_at_the_end, COUNT);
    ADD_LOOP(suite, a_tolerance_is_kept_and_its_estimate_honest, COUNT);
    ADD_LOOP(suite, eq_29_18_the_order_is_2s_minus_2, 3);
    ADD_LOOP(suite, what_a_mesh_does_not_take_is_named, 4);
    ADD_LOOP(suite, dampers_on_coordinates_are_the_old_damping, 15);
    ADD_LOOP(suite, laws_on_coordinates_are_the_old_laws, 6);
    ADD_LOOP(suite, constraints_hold_on_a_mesh, 2);
    ADD_CASE(suite, "memory", eq_29_15_a_coordinate_without_mass);
    return run_suite(suite);
}
