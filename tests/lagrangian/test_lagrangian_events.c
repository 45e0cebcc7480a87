/* tests/lagrangian/test_lagrangian_events.c -- Impacts, stops and marks of a mechanism.
 * Run alone: make test-lagrangian_events */
#include "problems.h"
#include "watched.h"

#include "system/larger.h"

static const mechanism_text
    ball = { .name = "ball", .d = 1, .lagrangian = "v^2/2 - x", .damper = { "x : power:0.3,0.3" },
             .x0 = { 1 }, .v0 = { 0 } },
    steep_ball = { .name = "ball, order 1.4", .d = 1, .lagrangian = "v^2/2 - x",
                   .damper = { "x : power:0.3,0.7" }, .x0 = { 1 }, .v0 = { 0 } },
    cart = { .name = "cart with a pendulum between two walls",
             .d = 2,
             .lagrangian = "3*v1^2/2 + v1*v2*cos(x2) + v2^2/2 + cos(x2)",
             .damper = { "x1 : power:0.3,0.3", "sqrt((x1+sin(x2))^2+(2-cos(x2))^2) : power:0.2,0.3" },
             .x0 = { 0.2, 1.2 },
             .v0 = { 0, 0.5 } };

/* Prony sums of 120 exponentials and Radau's method, the times of impacts by Newton's; two such sums agree to
 * 3e-15. */
static const struct {
    const mechanism_text *text;
    const char *event[MOST_EVENTS];
    double T, x[2], p[2];
    size_t impacts;
    double t[4];
} references[] = {
    { &ball, { "x : impact:0.8" }, 5, { 0.07483486955863 }, { -0.61511788407427 }, 2,
      { 1.488362842713238, 3.559706909650385 } },
    { &steep_ball, { "x : impact:0.8" }, 5, { 0.01063941636570 }, { -0.14012322471981 }, 4,
      { 1.558856990006441, 3.108679570573761, 4.044795610490283, 4.651383333797419 } },
    { &cart, { "0.45-x1 : impact:0.7", "x1+0.15 : impact:0.7" }, 3,
      { 0.193728244277777, -0.400429576539904 }, { -1.316278106985, -0.862553978509 }, 1,
      { 1.788114076084374 } },
};
enum { COUNT = sizeof references / sizeof *references };

/* Times of impacts, x and p behind them: what a step may err is not lost at an impact. */
START_TEST(eq_29_20_impacts_are_where_the_reference_has_them)
{
    watched w;
    open_watched(references[_i].text, references[_i].event, references[_i].T, &w);
    for (double asked = 1e-4; asked > 0.5e-12; asked /= 100) {
        w.run.step_error = asked;
        fvi_stepper *s = at_end(&w.run);
        size_t n;
        const fvi_event_time *at = fvi_stepper_events(s, &n);
        ck_assert_uint_eq(n, references[_i].impacts);
        double worst = 0;
        for (size_t i = 0; i < n; i++)
            worst = larger(worst, fabs(at[i].t - references[_i].t[i]));
        for (size_t j = 0; j < references[_i].text->d; j++)
            worst = larger(worst, fabs(s->x[j] - references[_i].x[j]));
        ck_assert_msg(worst <= asked + 2e-14, "%s: asked %g, off by %g", references[_i].text->name,
                      asked, worst);
        seen(worst, "%s %g", references[_i].text->name, asked);
        for (size_t j = 0; j < references[_i].text->d && asked < 1e-11; j++)
            ck_assert_double_eq_tol(s->p[j], references[_i].p[j], 2e-12);
        fvi_stepper_free(s);
    }
    close_watched(&w);
}
END_TEST

/* Steps of six stages, no longer than 0.607 and 0.287: the error at the end, behind the impacts, falls with
 * h^(2 s - 2), on average. */
START_TEST(eq_29_20_the_order_stays_2s_minus_2)
{
    const int which = _i == 0 ? 0 : 2;
    watched w;
    open_watched(references[which].text, references[which].event, references[which].T, &w);
    double errors[2];
    for (int k = 0; k < 2; k++) {
        w.run.step_error = 5e-3; /* six stages; with more, all hops would be below it */
        w.run.tolerance = 1e-300; /* the finest modes */
        w.run.longest = exp(k ? -1.25 : -0.5);
        fvi_stepper *s = at_end(&w.run);
        errors[k] = 0;
        for (size_t j = 0; j < references[which].text->d; j++)
            errors[k] = larger(errors[k], fabs(s->x[j] - references[which].x[j]));
        fvi_stepper_free(s);
    }
    const double order = log(errors[0] / errors[1]) / 0.75;
    ck_assert_msg(fabs(order - 10) <= 3, "%s: order %g, errors %g, %g", references[which].text->name,
                  order, errors[0], errors[1]);
    seen(order, "%s", references[which].text->name);
    close_watched(&w);
}
END_TEST

/* Z, its speed, and what does not jump, just before and behind an impact, from the equation alone: of a
 * double pendulum at a wall, and of L = v^4/4 + v^2/2, which is not quadratic in v. */
static const mechanism_text
    twin = { .name = "double pendulum at a wall",
             .d = 2,
             .lagrangian = "v1^2 + v2^2/2 + v1*v2*cos(x1-x2) + 2*cos(x1) + cos(x2)",
             .damper = { "x1 : power:0.2,0.3", "x2-x1 : zener:0.3,0.3,0.5" },
             .x0 = { 1, 1.5 },
             .v0 = { 0, 0.5 } },
    quartic = { .name = "not quadratic in v",
                .d = 2,
                .lagrangian = "(v1^2+v2^2)^2/4 + (v1^2+v1*v2+v2^2)/2 - x1",
                .damper = { "x1 : power:0.2,0.3" },
                .x0 = { 1, 0 },
                .v0 = { -0.3, 0.2 } };

START_TEST(eq_29_20_the_speed_of_z_turns_round)
{
    static const char *const walls[][2] = { { "sin(x1)+sin(x2)-0.2 : impact:0.6", NULL },
                                            { "x1+x2/3-0.1*sin(t) : impact:0.6", NULL } };
    const mechanism_text *text = _i ? &quartic : &twin;
    watched w;
    open_watched(text, walls[_i], 10, &w);
    w.run.step_error = 1e-11;
    fvi_stepper *s;
    OK(fvi_stepper_start(&fvi_variable_step, &w.run, &s, NULL));
    size_t n = 0;
    while (n == 0) {
        OK(fvi_stepper_step(s));
        fvi_stepper_events(s, &n);
    }
    double z, normal[2], rate, x[2], before[2], p[2], behind[2] = { 0 };
    const fvi_event *wall = w.run.events;
    OK(wall->value(s->t, 2, s->x, s->p, wall->params, &z));
    ck_assert_double_eq_tol(z, 0, 1e-14);
    OK(wall->gradient(s->t, 2, s->x, wall->params, normal, &rate));
    OK(fvi_variable_step.dense(s, s->t, x, p)); /* of the step that ended there */
    before[0] = before[1] = 0;
    OK(fvi_velocity_of_momentum(&w.p.system, s->t, s->x, p, before));
    OK(fvi_velocity_of_momentum(&w.p.system, s->t, s->x, s->p, behind));
    const double speed = normal[0] * before[0] + normal[1] * before[1] + rate,
                 after = normal[0] * behind[0] + normal[1] * behind[1] + rate;
    ck_assert_msg(speed < 0, "%g", speed);
    ck_assert_double_eq_tol(after, -0.6 * speed, 1e-10);
    const double across = (s->p[0] - p[0]) * normal[1] - (s->p[1] - p[1]) * normal[0];
    ck_assert_double_eq_tol(across, 0, 1e-10);
    double v[2];
    OK(fvi_stepper_velocity(s, v));
    ck_assert_double_eq_tol(v[0], behind[0], 1e-14);
    fvi_stepper_free(s);
    close_watched(&w);
}
END_TEST

/* With e = 1, a wall that stands and L quadratic in v an impact takes no energy: half of v M v stays, as the
 * part of v along M^-1 n turns round. */
START_TEST(an_elastic_impact_takes_no_energy)
{
    static const char *const wall[] = { "sin(x1)+sin(x2)-0.2 : impact:1", NULL };
    mechanism_text text = twin;
    text.damper[0] = text.damper[1] = NULL;
    watched w;
    open_watched(&text, wall, 10, &w);
    w.run.step_error = 1e-12;
    fvi_stepper *s = at_end(&w.run);
    double E0, E;
    size_t n;
    fvi_stepper_events(s, &n);
    ck_assert_uint_ge(n, 2);
    OK(fvi_energy_at(&w.p.system, 0, w.p.x0, w.p.p0, &E0));
    OK(fvi_stepper_energy(s, &E));
    ck_assert_double_eq_tol(E, E0, 1e-11);
    seen(fabs(E - E0), "loss");
    fvi_stepper_free(s);
    close_watched(&w);
}
END_TEST

/* Hops that grow shorter and shorter end with the run, and it says so; the times are a geometric series. */
START_TEST(hops_come_to_rest)
{
    static const char *const wall[] = { "sin(x1)+sin(x2)-0.2 : impact:0.3", NULL };
    watched w;
    open_watched(&twin, wall, 40, &w);
    w.run.step_error = 1e-8;
    fvi_stepper *s = at_end(&w.run);
    size_t n;
    const fvi_event_time *at = fvi_stepper_events(s, &n);
    ck_assert(fvi_stepper_is_over(s) && at[n - 1].at_rest);
    ck_assert_uint_lt(n, 30);
    const double ratio = (at[n - 1].t - at[n - 2].t) / (at[n - 2].t - at[n - 3].t);
    ck_assert_double_eq_tol(ratio, 0.3, 0.01);
    ck_assert_int_eq(fvi_stepper_step(s), FVI_EINVAL);
    fvi_stepper_free(s);
    close_watched(&w);
}
END_TEST

/* A mark and a stop know velocities of the Lagrangian, and momenta. */
START_TEST(marks_and_stops_know_v_and_p)
{
    static const char *const events[] = { "v1 : mark", "p1-2*v1-v2*cos(x1-x2)-1e-3 : mark", "v2+1 : stop" };
    mechanism_text text = twin;
    watched w;
    open_watched(&text, events, 10, &w);
    w.run.step_error = 1e-11;
    fvi_stepper *s = at_end(&w.run);
    size_t n;
    const fvi_event_time *at = fvi_stepper_events(s, &n);
    double v[2];
    ck_assert(fvi_stepper_is_over(s));
    ck_assert_uint_eq(at[n - 1].event, 2);
    for (size_t i = 0; i < n; i++)
        ck_assert_uint_ne(at[i].event, 1); /* p = L_v all the time */
    OK(fvi_stepper_velocity(s, v));
    ck_assert_double_eq_tol(v[1], -1, 1e-12);
    fvi_stepper_free(s);
    close_watched(&w);
}
END_TEST

/* A kick between two steps is that of an impulse of the force, and may follow an event. */
START_TEST(a_kick_of_a_mechanism_is_an_impulse)
{
    static const double J[] = { 0.1, -0.2 };
    static const double zeros[] = { 0, 0 };
    static const fvi_impulse none = { 0, zeros };
    static const char *const at_one[] = { "t-1 : mark", NULL };
    const fvi_impulse impulse = { 1, J };
    mechanism_text text = twin;
    text.damper[0] = "x1 : power:0.2,0.7";
    double x[2][2];
    for (int i = 0; i < 2; i++) {
        watched w;
        open_watched(&text, at_one, 3, &w);
        w.p.system.force.impulse_count = 1;
        w.p.system.force.impulses = i ? &impulse : &none;
        w.run.step_error = 1e-10;
        fvi_stepper *s;
        OK(fvi_stepper_start(&fvi_variable_step, &w.run, &s, NULL));
        int is_kicked = i;
        while (s->k < 1) {
            size_t n;
            OK(fvi_stepper_step(s));
            fvi_stepper_events(s, &n);
            if (n == 1 && !is_kicked)
                OK(fvi_stepper_kick(s, J));
            is_kicked |= n == 1;
        }
        memcpy(x[i], s->x, sizeof x[i]);
        fvi_stepper_free(s);
        close_watched(&w);
    }
    ck_assert_double_eq_tol(x[0][0], x[1][0], 1e-9);
    ck_assert_double_eq_tol(x[0][1], x[1][1], 1e-9);
}
END_TEST

/* Forces, impulses and work are known with events; what E + work of dampers loses, the impacts took. */
START_TEST(the_balance_falls_at_impacts_alone)
{
    watched w;
    open_watched(&ball, references[0].event, 5, &w);
    w.run.step_error = 1e-12;
    w.run.h = 0.05;
    w.run.steps = 100;
    fvi_stepper *s;
    fvi_observer *o;
    fvi_observation now;
    OK(fvi_stepper_start(&fvi_variable_step, &w.run, &s, NULL));
    OK(fvi_observer_start(s, FVI_OBSERVE_WORK | FVI_OBSERVE_FORCE, &o, NULL));
    double levels[3] = { 1, 0, 0 };
    size_t n = 0;
    for (size_t k = 0; k <= 100; k++) {
        const double t = (double)k * 0.05;
        while (s->t < t)
            OK(fvi_observer_step(o, s));
        OK(fvi_observer_read(o, s, t, &now));
        const size_t impacts = t > references[0].t[1] ? 2 : t > references[0].t[0];
        if (impacts > n)
            levels[n = impacts] = now.balance;
        ck_assert_double_eq_tol(now.balance, levels[n], 1e-11);
    }
    ck_assert(levels[1] < levels[0] && levels[2] < levels[1]);
    fvi_observer_free(o);
    fvi_stepper_free(s);
    close_watched(&w);
}
END_TEST

/* A force that is infinite at t = 0 is printed as its mean over the first row, here up to the stop within that row. */
START_TEST(a_stop_in_the_first_row_ends_the_mean_at_its_start)
{
    static const mechanism_text text = { .name = "stopped", .d = 1, .lagrangian = "v^2/2 - x^2/2",
                                         .damper = { "x : power:1,0.8" }, .x0 = { 1 }, .v0 = { 1 } };
    static const char *const stop[MOST_EVENTS] = { "x : stop" };
    watched w;
    open_watched(&text, stop, 5, &w);
    fvi_stepper *s;
    fvi_observer *o;
    fvi_observation now;
    OK(fvi_stepper_start(&fvi_variable_step, &w.run, &s, NULL));
    OK(fvi_observer_start(s, FVI_OBSERVE_FORCE | FVI_OBSERVE_IMPULSE, &o, NULL));
    OK(fvi_observer_read(o, s, 0, &now));
    const double mean = now.force[0];
    while (!fvi_stepper_is_over(s))
        OK(fvi_observer_step(o, s));
    ck_assert(s->t > 1 && s->t < w.run.h);
    OK(fvi_observer_read(o, s, s->t, &now));
    ck_assert_double_eq_tol(mean * s->t, now.impulse[0], 1e-14);
    fvi_observer_free(o);
    fvi_stepper_free(s);
    close_watched(&w);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("lagrangian: events");
    ADD_LOOP(suite, eq_29_20_impacts_are_where_the_reference_has_them, COUNT);
    ADD_LOOP(suite, eq_29_20_the_order_stays_2s_minus_2, 2);
    ADD_LOOP(suite, eq_29_20_the_speed_of_z_turns_round, 2);
    ADD_CASE(suite, "events", an_elastic_impact_takes_no_energy, hops_come_to_rest, marks_and_stops_know_v_and_p,
             a_kick_of_a_mechanism_is_an_impulse, the_balance_falls_at_impacts_alone,
             a_stop_in_the_first_row_ends_the_mean_at_its_start);
    return run_suite(suite);
}
