/* tests/lagrangian/test_lagrangian_inertia.c -- Lagrangians whose inertia vanishes somewhere.
 * Run alone: make test-lagrangian_inertia */
#include "problems.h"

static const mechanism_text
    quartic = { .name = "v^4", .d = 1, .lagrangian = "v^4/12-x^2/2", .x0 = { 1 }, .v0 = { 1 } };

static int count_warnings(const mechanism_problem *p, fvi_stepper *s, double *when)
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
        ck_assert_int_eq(count_warnings(&p, s, &when), 1);
        ck_assert_msg(fabs(when - sum) < 0.01, "%s: %g, not %g", methods[i], when, sum);
        double E;
        OK(fvi_stepper_energy(s, &E));
        ck_assert_msg(fabs(E - 0.75) < 3e-3, "%s: %g", methods[i], E); /* v = 0 has been passed */
        fvi_stepper_free(s);
    }
    close_problem(&p);
}
END_TEST

/* The pole, between two checks; and no word of inertias that only vary, or of coordinates without any. */
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
    ck_assert_msg(count_warnings(&p, s, &when) == cases[_i].warns, "%s: %g", cases[_i].text.name, when);
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

/* ---- a coordinate without inertia ---- */

/* x1'' = x2 - x1, c x2' = x1 - x2: v and a of x2 at t by Taylor's series of (x1, v1, x2), 512 parts of 20 terms. */
static void exact_node(double c, double t, const double *x0, double p0, double *v, double *a)
{
    double y[] = { x0[0], p0, x0[1] };
    for (int n = 0; n < 512; n++) {
        double term[] = { y[0], y[1], y[2] };
        for (int i = 1; i <= 20; i++) {
            const double s = t / 512 / i, x1 = term[0], v1 = term[1], x2 = term[2];
            term[0] = s * v1;
            term[1] = s * (x2 - x1);
            term[2] = s * (x1 - x2) / c;
            for (int j = 0; j < 3; j++)
                y[j] += term[j];
        }
    }
    *v = (y[0] - y[2]) / c;
    *a = (y[1] - *v) / c;
}

/* The largest errors of v2 and a2 from t = 1 to 2, where the rows are those of the run, not of the shorter steps of its start. */
static void worst_of_node(const double *x0, const double *p0, double h, double *worst_v, double *worst_a)
{
    static const double mass[] = { 1, 0 }, none[] = { 0, 0 };
    const mechanism_text text = { .name = "a node", .d = 2, .damper = { "x2 : viscous:0.5" } };
    mechanism_problem p = { 0 };
    fvi_typed_potential spring = { 0 };
    fvi_error error = { 0 };
    fvi_stepper *s;
    fvi_observer *o;
    fvi_observation now;
    const size_t N = (size_t)lround(2 / h);
    ck_assert_int_eq(parse_texts(&text, &p.typed, &error), 0);
    ck_assert_int_eq(fvi_parse_potential("(x1-x2)^2/2", 2, NULL, &spring, &error), 0);
    const fvi_system system = { .d = 2, .mass = mass, .damping = none, .potential = fvi_potential_typed(&spring),
                                .mechanism = fvi_mechanism_typed(p.typed) };
    const fvi_run run = fvi_run_default(&system, x0, p0, h, N);
    ck_assert_msg(fvi_stepper_start(&fvi_cq2_midpoint, &run, &s, &error) == 0, "%s", error.text);
    ck_assert_int_eq(fvi_observer_start(s, FVI_OBSERVE_VELOCITY | FVI_OBSERVE_ACCELERATION, &o, &error), 0);
    *worst_v = *worst_a = 0;
    for (size_t k = 1; k <= N; k++) {
        double v, a;
        ck_assert_int_eq(fvi_observer_step(o, s), 0);
        ck_assert_int_eq(fvi_observer_read(o, s, s->t, &now), 0);
        exact_node(0.5, s->t, x0, p0[0], &v, &a);
        if (s->t >= 1) {
            *worst_v = larger(*worst_v, fabs(now.v[1] - v));
            *worst_a = larger(*worst_a, fabs(now.a[1] - a));
        }
    }
    fvi_observer_free(o);
    fvi_stepper_free(s);
    fvi_typed_potential_free(&spring);
    fvi_typed_mechanism_free(p.typed);
}

/* Out of balance and in balance: order 2 of v and of a, margin 0.3; none of it is taken. Slopes of the places swing by 2
 * for every h. */
START_TEST(eq_29_25_a_velocity_without_inertia_has_the_order_2)
{
    static const double x0[][2] = { { 1, 0 }, { 1, 1 } }, p0[][2] = { { 0, 0 }, { 1, 0 } };
    for (size_t i = 0; i < LEN(x0); i++) {
        double v[2], a[2];
        worst_of_node(x0[i], p0[i], 1.0 / 32, &v[0], &a[0]);
        worst_of_node(x0[i], p0[i], 1.0 / 128, &v[1], &a[1]);
        const double order_v = log2(v[0] / v[1]) / 2, order_a = log2(a[0] / a[1]) / 2;
        seen_worst((2 - smaller(order_v, order_a)) / 0.3, "of the margin");
        ck_assert_msg(order_v >= 1.7 && order_a >= 1.7, "v %g, %g, order %g; a %g, %g, order %g", v[0], v[1], order_v, a[0],
                      a[1], order_a);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("lagrangian: inertia");
    ADD_LOOP(suite, the_pole_of_polar_coordinates_is_seen, 5);
    ADD_CASE(suite, "inertia", where_v_passes_0_the_inertia_of_a_fourth_power_vanishes,
             a_start_without_inertia_is_refused,
             eq_29_25_a_velocity_without_inertia_has_the_order_2);
    return run_suite(suite);
}
