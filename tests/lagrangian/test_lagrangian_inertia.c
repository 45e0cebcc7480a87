/* tests/lagrangian/test_lagrangian_inertia.c -- Lagrangians whose inertia vanishes somewhere.
 * Run alone: make test-lagrangian_inertia */
#include "problems.h"

static const mechanism_text
    quartic = { .name = "v^4", .d = 1, .lagrangian = "v^4/12-x^2/2", .x0 = { 1 }, .v0 = { 1 } };

static int look_along(const mechanism_problem *p, fvi_stepper *s, double *when)
{
    fvi_inertia_watch *watch;
    char text[FVI_WARNING_ROOM] = "";
    OK(fvi_inertia_watch_begin(&p->system, &watch));
    int count = 0, warned = fvi_warning_of_inertia(watch, 0, s->x, s->p, sizeof text, text);
    while (s->k < s->run.steps) {
        OK(fvi_stepper_step(s));
        warned = fvi_warning_of_inertia(watch, s->t, s->x, s->p, sizeof text, text);
        count += warned;
        if (warned)
            ck_assert_int_eq(sscanf(strstr(text, "t = "), "t = %lf", when), 1);
    }
    fvi_inertia_watch_free(watch);
    return count;
}

/* d/dt L_v = L_x is v^2 v' = -x: E = v^4/4 + x^2/2 = 3/4, and v = 0 where x^2 = 3/2, after the time
 * int_1^sqrt(3/2) dx / v, v = (3 - 2 x^2)^(1/4), which is = 0.29552. */
START_TEST(where_v_passes_0_the_inertia_of_a_fourth_power_vanishes)
{
    static const char *const methods[] = { "fvi", "fvi-stable", "fvi-lobatto4", "fvi-lobatto3d" };
    mechanism_problem p;
    open_problem(&quartic, &p);
    double sum = 0, when = NAN;
    for (int i = 0; i < 200000; i++) { /* x = sqrt(3/2) - y^2 takes the root away */
        const double top = sqrt(sqrt(1.5) - 1), y = (i + 0.5) / 200000 * top, x = sqrt(1.5) - y * y;
        sum += 2 * y / sqrt(sqrt(3 - 2 * x * x)) * top / 200000;
    }
    ck_assert_double_eq_tol(sum, 0.29552, 1e-4);
    for (int i = 0; i < 4; i++) {
        fvi_stepper *s = stepper_at(fvi_method_find(methods[i]), &p, 0.01, 60, 0);
        ck_assert_int_eq(look_along(&p, s, &when), 1);
        ck_assert_msg(fabs(when - sum) < 0.01, "%s: %g, not %g", methods[i], when, sum);
        double E;
        OK(fvi_stepper_energy(s, &E));
        ck_assert_msg(fabs(E - 0.75) < 3e-3, "%s: %g", methods[i], E); /* v = 0 has been passed */
        fvi_stepper_free(s);
    }
    close_problem(&p);
}
END_TEST

/* The pole, between two looks; and no word of inertias that only vary, or of coordinates without any. */
START_TEST(the_pole_of_polar_coordinates_is_seen)
{
    static const struct {
        mechanism_text text;
        int warns;
    } cases[] = {
        { { .name = "through the pole", .d = 2, .lagrangian = "(v1^2+sin(x1)^2*v2^2)/2+cos(x1)",
            .x0 = { 1, 0 }, .v0 = { 0, 0 } }, 1 },
        { { .name = "around it", .d = 2, .lagrangian = "(v1^2+sin(x1)^2*v2^2)/2+cos(x1)",
            .x0 = { 1, 0 }, .v0 = { 0, 0.2 } }, 0 },
        { { .name = "two that are one at x1 = 0", .d = 2,
            .lagrangian = "(v1^2+v2^2)/2+v1*v2*cos(x1)-x1^2/2", .x0 = { 1, 0 }, .v0 = { 0, 0 } }, 1 },
        { { .name = "double pendulum", .d = 2,
            .lagrangian = "v1^2+v2^2/2+v1*v2*cos(x1-x2)+2*cos(x1)+cos(x2)", .x0 = { 1, 1.5 },
            .v0 = { 0, 0.5 } }, 0 },
        { { .name = "without mass", .d = 2, .lagrangian = "v1^2/2 - x1^2/2 - (x1-x2)^2",
            .damper = { "x2 : power:0.5,0.3" }, .v0 = { 1, 0 } }, 0 },
    };
    mechanism_problem p;
    double when = NAN;
    open_problem(&cases[_i].text, &p);
    fvi_stepper *s = stepper_at(&fvi_cq2_midpoint, &p, 0.05, 100, 0);
    ck_assert_msg(look_along(&p, s, &when) == cases[_i].warns, "%s: %g", cases[_i].text.name, when);
    fvi_stepper_free(s);
    close_problem(&p);
}
END_TEST

/* At rest there is no inertia, and no velocity of p: it is refused, and not taken for a coordinate without any. */
START_TEST(a_start_without_inertia_is_refused)
{
    mechanism_text at_rest = quartic;
    at_rest.v0[0] = 0;
    mechanism_problem p;
    open_problem(&at_rest, &p);
    const char *const methods[] = { "fvi", "fvi-stable", "fvi-lobatto4", "fvi-lobatto4d", "fvi-adaptive" };
    for (int i = 0; i < 5; i++) {
        const fvi_run run = run_of(&p, 0.1, 10);
        fvi_stepper *s = NULL;
        fvi_error error = { 0 };
        ck_assert_int_ne(fvi_stepper_start(fvi_method_find(methods[i]), &run, &s, &error), 0);
        ck_assert_str_eq(error.field, "lagrangian");
    }
    close_problem(&p);
    open_problem(&quartic, &p); /* p0 = -1/3 has the velocity -1 */
    const double x = 1, p0 = -1. / 3;
    double v = 0;
    OK(fvi_velocity_of_momentum(&p.system, 0, &x, &p0, &v));
    ck_assert_double_eq_tol(v, -1, 1e-14);
    close_problem(&p);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("lagrangian: inertia");
    ADD_LOOP(suite, the_pole_of_polar_coordinates_is_seen, 5);
    ADD_CASE(suite, "inertia", where_v_passes_0_the_inertia_of_a_fourth_power_vanishes,
             a_start_without_inertia_is_refused);
    return run_suite(suite);
}
