/* tests/lagrangian/test_lagrangian_contacts.c -- A body rests on a surface, slides, and lifts off.
 * Run alone: make test-lagrangian_contacts */
#include "watched.h"

#include "system/larger.h"

#include <fvi/observer.h>

static const mechanism_text
    table = { .name = "on a table", .d = 1, .lagrangian = "v^2/2 - x", .force_on = { "1=2*sin(t)" } },
    thrown = { .name = "in the plane", .d = 2, .lagrangian = "(v1^2+v2^2)/2 - x2", .x0 = { 0, 1 }, .v0 = { 0.5, 0 } };

/* A body with m = g = 1 under the force 2 sin t lifts off at a = pi/6, where the force is the weight. Then x'' = 2 sin t - 1.
 * An error of that time moves x by its square. */
START_TEST(a_body_lifts_off_where_the_force_is_its_weight)
{
    static const char *const floor[] = { "x : contact:0.5", NULL };
    static const int kinds[] = { 1, 2 };
    const double a = M_PI / 6, T = 1.5, times[] = { 0, a };
    watched w;
    open_watched(&table, floor, T, &w);
    for (double asked = 1e-4; asked > 0.5e-12; asked /= 100) {
        w.run.step_error = asked;
        fvi_stepper *s = at_end(&w.run);
        check_events(s, 2, kinds, times, 1e-6);
        const double x = 2 * cos(a) * (T - a) - 2 * (sin(T) - sin(a)) - (T - a) * (T - a) / 2,
                     v = 2 * (cos(a) - cos(T)) - (T - a);
        ck_assert_double_eq_tol(s->x[0], x, 1e-14);
        ck_assert_double_eq_tol(s->p[0], v, 1e-14);
        fvi_stepper_free(s);
    }
    close_watched(&w);
}
END_TEST

/* The contact force is the weight less the pull, at the start, within a step and behind; to what the multiplier of a
 * step knows. */
START_TEST(the_force_of_a_contact_is_what_is_left_of_the_weight)
{
    static const char *const floor[] = { "x : contact:0.5", NULL };
    watched w;
    open_watched(&table, floor, 1.5, &w);
    w.run.step_error = 1e-12;
    w.run.h = 0.05;
    w.run.steps = 30;
    fvi_stepper *s;
    fvi_observer *o;
    fvi_observation now;
    double worst = 0, force;
    OK(fvi_stepper_start(&fvi_variable_step, &w.run, &s, NULL));
    OK(fvi_observer_start(s, FVI_OBSERVE_CONTACT | FVI_OBSERVE_WORK, &o, NULL));
    for (int k = 0; k <= 30; k++) {
        const double t = 0.05 * k;
        while (s->t < t)
            OK(fvi_observer_step(o, s));
        OK(fvi_observer_read(o, s, t, &now));
        worst = larger(worst, fabs(now.contact[0] - larger(1 - 2 * sin(t), 0)));
        ck_assert_double_eq_tol(now.balance, 0, 1e-12);
    }
    ck_assert_msg(worst <= 1e-7, "%g", worst);
    seen(worst, "force");
    ck_assert_int_eq(fvi_stepper_contact_force(s, 1, s->t, &force), FVI_EINVAL);
    ck_assert_int_eq(fvi_stepper_contact_force(s, 0, s->t, NULL), FVI_EFAULT);
    const double elsewhere[] = { 0.1, s->t + 1, NAN };
    for (size_t i = 0; i < LEN(elsewhere); i++)
        ck_assert_int_eq(fvi_stepper_contact_force(s, 0, elsewhere[i], &force), FVI_EDOM);
    fvi_observer_free(o);
    fvi_stepper_free(s);
    close_watched(&w);
}
END_TEST

/* An incline does not touch the motion along it: s = (2 x1 - x2)/sqrt(5) has the acceleration 1/sqrt(5), whatever the hops.
 * They end, and then the body slides: x1/2 + x2 stays what it was, 0 to the tolerance. */
START_TEST(a_ball_slides_down_an_incline)
{
    static const char *const incline[] = { "x1/2+x2 : contact:0.5", NULL };
    const double T = 15;
    watched w;
    open_watched(&thrown, incline, T, &w);
    w.run.step_error = 1e-10;
    fvi_stepper *s = at_end(&w.run);
    size_t n;
    const fvi_event_time *at = fvi_stepper_events(s, &n);
    ck_assert(at[n - 1].at_rest && at[n - 1].t < 5 && !fvi_stepper_is_over(s));
    const double along = 2 * s->x[0] - s->x[1], speed = 2 * s->p[0] - s->p[1];
    ck_assert_double_eq_tol(along, -1 + T + T * T / 2, 1e-12);
    ck_assert_double_eq_tol(speed, 1 + T, 1e-13);
    ck_assert_double_eq_tol(s->x[0] / 2 + s->x[1], 0, 1e-13);
    ck_assert_double_eq_tol(s->p[0] / 2 + s->p[1], 0, 1e-14);
    fvi_stepper_free(s);
    close_watched(&w);
}
END_TEST

/* A body slides down a ball of radius 1 from its top with the speed 1/2 and leaves it at the height 2/3 + (1/2)^2/3. On the
 * ball its energy stays, and the force is the height less v^2. */
START_TEST(a_body_leaves_a_ball_at_three_quarters_of_its_height)
{
    static const char *const forms[][2] = { { "sqrt(x1^2+x2^2)-1 : contact:0.5", NULL },
                                            { "1-x1^2-x2^2 : contact:0.5", NULL } };
    static const int kinds[] = { 1, 2 };
    watched w;
    open_watched(&thrown, forms[_i], 1.5, &w);
    w.run.step_error = 1e-12;
    fvi_event events[2] = { w.run.events[0] };
    events[0].direction = _i ? 1 : 0; /* the body is where 1 - x1^2 - x2^2 < 0 */
    w.run.events = events;
    fvi_stepper *s;
    double force, before = 0, middle = 0;
    OK(fvi_stepper_start(&fvi_variable_step, &w.run, &s, NULL));
    size_t n = 0;
    while (n < 2) {
        double x[2], p[2];
        const double t0 = s->t;
        OK(fvi_stepper_step(s));
        fvi_stepper_events(s, &n);
        middle = t0 + (s->t - t0) / 2;
        OK(fvi_stepper_contact_force(s, 0, middle, &force));
        OK(fvi_variable_step.dense(s, middle, x, p));
        before = x[1] - p[0] * p[0] - p[1] * p[1];
        if (s->t - t0 > 0.02) /* a short step knows it to roundings of the place over h^2 */
            ck_assert_double_eq_tol(force * (_i ? 2 : 1), before, 1e-8);
    }
    ck_assert_double_eq_tol(s->x[1], 0.75, 1e-8);
    while (s->k < w.run.steps)
        OK(fvi_stepper_step(s));
    check_events(s, 2, kinds, NULL, 0);
    double E;
    OK(fvi_stepper_energy(s, &E));
    ck_assert_double_eq_tol(E, 1.125, 1e-13);
    fvi_stepper_free(s);
    close_watched(&w);
}
END_TEST

/* A table that shakes, x = 0.3 sin 3t, throws a body off where 2.7 sin 3t = 1 and catches it again, e = 0. Where the two meet,
 * and where the next flight begins, is known from the parabola. */
START_TEST(a_table_that_shakes_throws_a_body_off_again_and_again)
{
    static const char *const shaking[] = { "x-0.3*sin(3*t) : contact:0", NULL };
    static const mechanism_text text = { .name = "on a table that shakes", .d = 1, .lagrangian = "v^2/2-x", .x0 = { 0 },
                                         .v0 = { 0.9 } };
    static const int kinds[] = { 1, 2, 1, 2, 1 };
    const double a = asin(1 / 2.7) / 3, x0 = 0.3 * sin(3 * a), v0 = 0.9 * cos(3 * a), turn = 2 * M_PI / 3;
    double b = 2;
    for (int i = 0; i < 50; i++) { /* Newton's method for the parabola and the table */
        const double s = b - a;
        b -= (x0 + v0 * s - s * s / 2 - 0.3 * sin(3 * b)) / (v0 - s - 0.9 * cos(3 * b));
    }
    const double times[] = { 0, a, b, a + turn, b + turn };
    watched w;
    open_watched(&text, shaking, 4.2, &w);
    w.run.step_error = 1e-11;
    fvi_stepper *s = at_end(&w.run);
    check_events(s, 5, kinds, times, 1e-8);
    ck_assert_double_eq_tol(s->x[0], 0.3 * sin(3 * 4.2), 1e-13);
    ck_assert_double_eq_tol(s->p[0], 0.9 * cos(3 * 4.2), 1e-12);
    fvi_stepper_free(s);
    close_watched(&w);
}
END_TEST

/* The steps of a body that lies still become long. A force 2/(1 + (t - 20)^2) lifts it off at t = 19 all the same; behind that
 * x is X(5) - X(-1). */
START_TEST(a_body_that_lies_still_does_not_sleep)
{
    static const char *const floor[] = { "x : contact:0", NULL };
    static const mechanism_text text = { .name = "asleep", .d = 1, .lagrangian = "v^2/2-x",
                                         .force_on = { "1=2/(1+(t-20)^2)" } };
    static const int kinds[] = { 1, 2 };
    static const double times[] = { 0, 19 };
    watched w;
    open_watched(&text, floor, 25, &w);
    w.run.step_error = 1e-9;
    fvi_stepper *s = at_end(&w.run);
    check_events(s, 2, kinds, times, 1e-5);
    const double late = 10 * atan(5) - log(26) + (M_PI / 2 - 1) * 5 - 12.5,
                 early = M_PI / 2 - log(2) - (M_PI / 2 - 1) - 0.5;
    ck_assert_double_eq_tol(s->x[0], late - early, 1e-9);
    fvi_stepper_free(s);
    close_watched(&w);
}
END_TEST

/* A surface that falls almost as fast as a body: the contact closes, opens and closes while Z is below the error of a step.
 * With 3e-4 it closes at Z = -2e-4, and keeps that. */
START_TEST(a_body_is_caught_by_a_surface_that_hardly_pushes)
{
    static const char *const floor[] = { "x1-0.3*sin(2*t)-0.3*x2 : contact:0", NULL };
    static const mechanism_text text = { .name = "grazes", .d = 2, .lagrangian = "(v1^2+v2^2)/2-x1-x2^2/2",
                                         .x0 = { 1, 0.5 }, .v0 = { 0, 0.2 } };
    static const double asked[] = { 1e-11, 1e-6, 5e-5, 1e-4, 2e-4, 3e-4 };
    watched w;
    double x[2] = { 0 };
    open_watched(&text, floor, 10, &w);
    for (int i = 0; i < (int)LEN(asked); i++) {
        w.run.step_error = asked[i];
        fvi_stepper *s = at_end(&w.run);
        for (int j = 0; j < 2; j++) {
            if (i == 0)
                x[j] = s->x[j];
            ck_assert_double_eq_tol(s->x[j], x[j], asked[i]); /* seen: 0.1 of it */
        }
        fvi_stepper_free(s);
    }
    close_watched(&w);
}
END_TEST

/* A contact is a constraint of a mechanism. */
START_TEST(a_contact_asks_for_a_mechanism)
{
    static const char *const floor[] = { "x : contact:0.2", NULL };
    static const fvi_mechanism empty = { 0 };
    const double one = 1, none = 0;
    watched w;
    fvi_stepper *s;
    fvi_error error;
    open_watched(&table, floor, 1, &w);
    fvi_system plain = { .d = 1, .mass = &one, .damping = &none };
    w.run.system = &plain;
    ck_assert_int_eq(fvi_stepper_start(&fvi_variable_step, &w.run, &s, &error), FVI_EUNSUP);
    ck_assert_str_eq(error.text, "event 0: a contact needs a system with a mechanism, which may be an empty one");
    plain.mechanism = &empty;
    OK(fvi_stepper_start(&fvi_variable_step, &w.run, &s, &error));
    fvi_stepper_free(s);
    close_watched(&w);
}
END_TEST

/* A damper of an order above 1 pulls with an infinite force at t = 0, so a there is its mean over the first row, as the force
 * is: m a_1 = -f. It is a difference of velocities of the size 1 over h = 0.1: 64 u / h; seen 0.09 of it. Along the normal a
 * body at rest has no acceleration. */
START_TEST(an_infinite_force_on_a_body_at_rest_has_its_mean_in_a)
{
    static const char *const floor[] = { "x2 : contact:0", NULL };
    const mechanism_text text = { .name = "slides", .d = 2, .lagrangian = "(v1^2+v2^2)/2 - x2",
                                  .damper = { "x1 : power:1,0.7" }, .x0 = { 1, 0 }, .v0 = { 1, 0 } };
    const double h = 0.1;
    watched w;
    fvi_stepper *s;
    fvi_observer *o;
    fvi_observation now;
    open_watched(&text, floor, 1, &w);
    w.run.h = h;
    w.run.steps = 10;
    OK(fvi_stepper_start(&fvi_variable_step, &w.run, &s, NULL));
    OK(fvi_observer_start(s, FVI_OBSERVE_ACCELERATION | FVI_OBSERVE_FORCE, &o, NULL));
    OK(fvi_observer_read(o, s, 0, &now));
    ck_assert_int_eq(now.is_mean, 1);
    ck_assert_near(now.a[0], -now.force[0], 64 * U / h, "along the surface");
    ck_assert_near(now.a[1], 0, 64 * U / h, "along the normal");
    fvi_observer_free(o);
    fvi_stepper_free(s);
    close_watched(&w);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("lagrangian: contacts");
    ADD_LOOP(suite, a_body_leaves_a_ball_at_three_quarters_of_its_height, 2);
    ADD_CASE(suite, "contacts", a_body_lifts_off_where_the_force_is_its_weight,
             the_force_of_a_contact_is_what_is_left_of_the_weight, a_ball_slides_down_an_incline,
             a_table_that_shakes_throws_a_body_off_again_and_again, a_body_that_lies_still_does_not_sleep,
             a_body_is_caught_by_a_surface_that_hardly_pushes, a_contact_asks_for_a_mechanism,
             an_infinite_force_on_a_body_at_rest_has_its_mean_in_a);
    return run_suite(suite);
}
