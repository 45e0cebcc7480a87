/* tests/lagrangian/test_lagrangian_contacts.c -- A body rests on a surface, slides, and lifts off.
 * Run alone: make test-lagrangian_contacts */
#include "problems.h"
#include "saved.h"
#include "watched.h"

#include "system/larger.h"

#include <fvi/observer.h>

static const mechanism_text
    table = { .name = "on a table", .d = 1, .lagrangian = "v^2/2 - x", .force_on = { "1=2*sin(t)" } },
    thrown = { .name = "in the plane", .d = 2, .lagrangian = "(v1^2+v2^2)/2 - x2", .x0 = { 0, 1 }, .v0 = { 0.5, 0 } },
    caught = { .name = "caught and lifted", .d = 1, .lagrangian = "v^2/2 - x + exp(t-3)*x",
               .damper = { "x : power:0.3,0.3" }, .x0 = { 1 } };

/* The events of a run: so many, and each at rest (1), lifting off (2) or neither (0), at its time. */
static void check_events(const fvi_stepper *s, size_t count, const int *kind, const double *t, double most)
{
    size_t n;
    const fvi_event_time *at = fvi_stepper_events(s, &n);
    ck_assert_uint_eq(n, count);
    for (size_t i = 0; i < n; i++) {
        ck_assert_int_eq(at[i].at_rest + 2 * at[i].lifts_off, kind[i]);
        if (t)
            ck_assert_msg(fabs(at[i].t - t[i]) <= most, "event %zu at %.17g, not %.17g", i, at[i].t, t[i]);
    }
    ck_assert(!fvi_stepper_is_over(s));
}

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

/* A spring of stiffness 4, whose other end moves with 1/2, pulls a body of weight 2 off the floor at t = 1. A springpot of
 * 0.5 holds it. Behind that X(p) = 2 / (p^2 (p^2 + 0.5 p^o + 4)), inverted by Talbot's rule with 30 digits. */
START_TEST(a_spring_pulls_a_body_with_a_springpot_off_the_floor)
{
    static const char *const floor[] = { "x : contact:0.5", NULL };
    static const double x[] = { 1.0360090447817911, 1.0185397439526651 },
                        v[] = { 0.6728258803152768, 0.82083928906105784 }, times[] = { 0, 1 };
    static const int kinds[] = { 1, 2 };
    const mechanism_text text = { .name = "pulled up", .d = 1, .lagrangian = "v^2/2-2*(0.5*t-x)^2-2*x",
                                  .damper = { _i ? "x : power:0.5,0.7" : "x : power:0.5,0.3" } };
    watched w;
    open_watched(&text, floor, 3, &w);
    w.run.step_error = 1e-11;
    fvi_stepper *s = at_end(&w.run);
    check_events(s, 2, kinds, times, 1e-8);
    ck_assert_double_eq_tol(s->x[0], x[_i], 1e-11);
    ck_assert_double_eq_tol(s->p[0], v[_i], 1e-10);
    fvi_stepper_free(s);
    close_watched(&w);
}
END_TEST

/* A ball on a springpot of order 0.6 is caught by the floor and lifted off by a force exp(t - 3). Between these times the
 * floor pushes with 1 - exp(t - 3) + lambda, where lambda is known from the fall; and the motion is a sum of
 * Mittag-Leffler functions over all forces and the impulse of the impact, here by quadrature with 25 digits. */
static const double caught_times[] = { 1.56799741577628246, 2.90100678012783190 };
static const int caught_kinds[] = { 1, 2 };

START_TEST(a_memory_goes_through_touch_down_and_lift_off)
{
    static const char *const floor[] = { "x : contact:0", NULL };
    watched w;
    open_watched(&caught, floor, 4, &w);
    for (double asked = 1e-4; asked > 0.5e-12; asked /= 100) {
        w.run.step_error = asked;
        fvi_stepper *s = at_end(&w.run);
        check_events(s, 2, caught_kinds, caught_times, larger(1e-8, sqrt(asked)));
        const double off = larger(fabs(s->x[0] - 0.25356359405997369), fabs(s->p[0] - 0.75689817693379850));
        ck_assert_msg(off <= asked + 1e-13, "asked %g, off by %g", asked, off);
        seen(off, "asked %g", asked);
        fvi_stepper_free(s);
    }
    close_watched(&w);
}
END_TEST

/* Steps of six stages, no longer than 0.607 and 0.287: the error behind touch-down and lift-off falls with h^10. */
START_TEST(the_order_goes_through_touch_down_and_lift_off)
{
    static const char *const floor[] = { "x : contact:0", NULL };
    watched w;
    open_watched(&caught, floor, 4, &w);
    double errors[2];
    for (int k = 0; k < 2; k++) {
        w.run.step_error = 5e-3; /* six stages */
        w.run.tolerance = 1e-300; /* the finest modes */
        w.run.longest = exp(k ? -1.25 : -0.5);
        fvi_stepper *s = at_end(&w.run);
        errors[k] = fabs(s->x[0] - 0.25356359405997369);
        fvi_stepper_free(s);
    }
    const double order = log(errors[0] / errors[1]) / 0.75;
    ck_assert_msg(fabs(order - 10) <= 3, "order %g, errors %g, %g", order, errors[0], errors[1]);
    seen(order, "order");
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

/* A surface that falls almost as fast as a body: the contact closes, opens and closes while Z is below the error of a step. */
START_TEST(a_body_is_caught_by_a_surface_that_hardly_pushes)
{
    static const char *const floor[] = { "x1-0.3*sin(2*t)-0.3*x2 : contact:0", NULL };
    static const mechanism_text text = { .name = "grazes", .d = 2, .lagrangian = "(v1^2+v2^2)/2-x1-x2^2/2",
                                         .x0 = { 1, 0.5 }, .v0 = { 0, 0.2 } };
    watched w;
    double x[2][2];
    open_watched(&text, floor, 10, &w);
    for (int i = 0; i < 2; i++) {
        w.run.step_error = i ? 1e-11 : 1e-6;
        fvi_stepper *s = at_end(&w.run);
        memcpy(x[i], s->x, sizeof x[i]);
        fvi_stepper_free(s);
    }
    ck_assert_double_eq_tol(x[0][0], x[1][0], 1e-5);
    ck_assert_double_eq_tol(x[0][1], x[1][1], 1e-5);
    close_watched(&w);
}
END_TEST

/* Impulses of a body that slides with v1 = 1/2 on x2 = 0: one along the floor, one into it and one up. The floor takes what
 * goes into it; behind the last the body flies. And kicks do the same. */
START_TEST(the_floor_takes_an_impulse_and_lets_go_of_a_pull)
{
    static const double J[][2] = { { 0.25, 0 }, { 0.25, -3 }, { 0, 1 } }, zeros[2] = { 0 };
    const fvi_impulse impulses[] = { { 1, J[_i % 3] } }, none = { 0, zeros };
    static const char *const floor[] = { "x2 : contact:0.5", "t-1 : mark", NULL };
    static const mechanism_text text = { .name = "slides", .d = 2, .lagrangian = "(v1^2+v2^2)/2 - x2", .x0 = { 0, 0 },
                                         .v0 = { 0.5, 0 }, .damper = { "x1 : power:0,0.3" } };
    watched w;
    open_watched(&text, floor, 2, &w);
    w.p.system.force.impulse_count = 1;
    w.p.system.force.impulses = _i < 3 ? impulses : &none;
    fvi_stepper *s;
    OK(fvi_stepper_start(&fvi_variable_step, &w.run, &s, NULL));
    int is_kicked = _i < 3;
    while (s->t < 2) {
        size_t n;
        OK(fvi_stepper_step(s));
        fvi_stepper_events(s, &n);
        if (!is_kicked && s->t >= 1) {
            OK(fvi_stepper_kick(s, J[_i % 3]));
            is_kicked = 1;
        }
    }
    const double push = J[_i % 3][0], up = larger(J[_i % 3][1], 0);
    ck_assert_double_eq_tol(s->x[0], 0.5 * 2 + push, 1e-13);
    ck_assert_double_eq_tol(s->x[1], up > 0 ? up - 0.5 : 0, 1e-13);
    ck_assert_double_eq_tol(s->p[1], up > 0 ? up - 1 : 0, 1e-13);
    fvi_stepper_free(s);
    close_watched(&w);
}
END_TEST

/* A body slides along x2 = 0 into a wall that leans back, and is thrown up; or into one that hangs over, and the floor
 * holds it: then the speed of the wall's Z turns round along the floor. */
START_TEST(a_wall_lifts_a_body_off_the_floor_or_the_floor_holds_it)
{
    static const char *const walls[][3] = { { "x2 : contact:0.5", "1-x1+x2/2 : impact:0.5", NULL },
                                            { "x2 : contact:0.5", "1-x1-x2/2 : impact:0.5", NULL } };
    static const mechanism_text text = { .name = "slides", .d = 2, .lagrangian = "(v1^2+v2^2)/2 - x2", .x0 = { 0, 0 },
                                         .v0 = { 2, 0 } };
    watched w;
    open_watched(&text, walls[_i], 1, &w);
    fvi_stepper *s;
    OK(fvi_stepper_start(&fvi_variable_step, &w.run, &s, NULL));
    size_t n = 0;
    while (n < 2) {
        OK(fvi_stepper_step(s));
        fvi_stepper_events(s, &n);
    }
    ck_assert_double_eq_tol(s->t, 0.5, 1e-14);
    /* n = (-1, 1/2), v+ = v + 3/2 2/(5/4) n; and along the floor -v/2 */
    ck_assert_double_eq_tol(s->p[0], _i ? -1 : 2 - 2.4, 1e-13);
    ck_assert_double_eq_tol(s->p[1], _i ? 0 : 1.2, 1e-13);
    const fvi_event_time *at = fvi_stepper_events(s, &n);
    ck_assert_uint_eq(n, _i ? 2 : 3);
    ck_assert(_i || at[1].lifts_off);
    fvi_stepper_free(s);
    close_watched(&w);
}
END_TEST

/* In a corner both contacts close, each with its own force. */
START_TEST(a_body_rests_in_a_corner)
{
    static const char *const corner[] = { "x1 : contact:0", "x2 : contact:0.3", NULL };
    static const mechanism_text text = { .name = "corner", .d = 2, .lagrangian = "(v1^2+v2^2)/2 - x1 - 2*x2",
                                         .x0 = { 1, 1 }, .v0 = { 0.1, 0 }, .damper = { "x1 : power:0.2,0.3" } };
    watched w;
    open_watched(&text, corner, 8, &w);
    fvi_stepper *s = at_end(&w.run);
    double force[2];
    for (size_t i = 0; i < 2; i++) {
        OK(fvi_stepper_contact_force(s, i, s->t, &force[i]));
        ck_assert_double_eq_tol(s->x[i], 0, 1e-13);
        ck_assert_double_eq_tol(s->p[i], 0, 1e-14);
    }
    ck_assert_double_eq_tol(force[1], 2, 1e-9);
    ck_assert(force[0] > 0.5 && force[0] < 1); /* the springpot pushes, too */
    fvi_stepper_free(s);
    close_watched(&w);
}
END_TEST

/* A run that goes on from a copy, or from what was saved, in flight, at rest and behind the lift-off has the same digits. */
START_TEST(copies_and_archives_know_which_contacts_are_closed)
{
    static const char *const floor[] = { "x : contact:0.2", NULL };
    watched w;
    open_watched(&caught, floor, 4, &w);
    fvi_stepper *whole = at_end(&w.run), *s;
    OK(fvi_stepper_start(&fvi_variable_step, &w.run, &s, NULL));
    for (double t = 0.5; t < 4; t += 0.5) {
        while (s->t < t)
            OK(fvi_stepper_step(s));
        fvi_stepper *copy, *restored;
        saved to = { .archive = { serialize }, .room = malloc(1 << 20) };
        OK(fvi_stepper_copy(s, &copy));
        OK(fvi_stepper_archive(s, &to.archive));
        OK(fvi_stepper_start(&fvi_variable_step, &w.run, &restored, NULL));
        to.is_saved = 1;
        to.at = 0;
        OK(fvi_stepper_archive(restored, &to.archive));
        free(to.room);
        while (copy->t < 4)
            OK(fvi_stepper_step(copy));
        while (restored->t < 4)
            OK(fvi_stepper_step(restored));
        ck_assert_double_eq(copy->x[0], whole->x[0]);
        ck_assert_double_eq(restored->x[0], whole->x[0]);
        size_t n, m;
        fvi_stepper_events(whole, &n);
        fvi_stepper_events(restored, &m);
        ck_assert_uint_eq(n, m);
        fvi_stepper_free(copy);
        fvi_stepper_free(restored);
    }
    fvi_stepper_free(s);
    fvi_stepper_free(whole);
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
    open_watched(&caught, floor, 1, &w);
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

int main(void)
{
    Suite *suite = suite_create("lagrangian: contacts");
    ADD_LOOP(suite, a_body_leaves_a_ball_at_three_quarters_of_its_height, 2);
    ADD_LOOP(suite, a_spring_pulls_a_body_with_a_springpot_off_the_floor, 2);
    ADD_LOOP(suite, the_floor_takes_an_impulse_and_lets_go_of_a_pull, 6);
    ADD_LOOP(suite, a_wall_lifts_a_body_off_the_floor_or_the_floor_holds_it, 2);
    ADD_CASE(suite, "contacts", a_body_lifts_off_where_the_force_is_its_weight,
             the_force_of_a_contact_is_what_is_left_of_the_weight, a_ball_slides_down_an_incline,
             a_memory_goes_through_touch_down_and_lift_off, the_order_goes_through_touch_down_and_lift_off,
             a_table_that_shakes_throws_a_body_off_again_and_again, a_body_that_lies_still_does_not_sleep,
             a_body_is_caught_by_a_surface_that_hardly_pushes, a_body_rests_in_a_corner,
             copies_and_archives_know_which_contacts_are_closed, a_contact_asks_for_a_mechanism);
    return run_suite(suite);
}
