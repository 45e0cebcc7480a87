/* tests/events/test_events.c -- Events: stops, marks, kicks, and events that are refused. [H 22]
 * Run alone: make test-events */
#include "ball.h"
#include "harness/saved.h"

#include <math.h>

static int speed(double t, size_t d, const double *x, const double *p,
                 void *params, double *z)
{
    (void)t, (void)d, (void)x, (void)params;
    *z = p[0];
    return 0;
}

/* ---- stops and marks ---- */

/* Of a fall from 1, x = 1 - t^2/2: a quarter is passed at sqrt(3/2), down only; p = 0 at the
 * start is no event, and its jump is none; at the top of the hop it is one. */
START_TEST(stops_and_marks)
{
    double quarter = 0.25, end = 0.125;
    fvi_event events[] = { impact(0.8),
                           { .value = height, .params = &quarter, .direction = -1 },
                           { .value = speed },
                           { .value = height },
                           { .value = height, .params = &end, .action = FVI_EVENT_STOP, .direction = 1 } };
    const fvi_system system = ball(&none);
    fvi_run run = fall(&system, 4, events, 5);
    fvi_stepper *s = started(&run);
    go(s);
    const double T = sqrt(2), v = 0.8 * T, top = T + v, h = v * v / 2,
                 want[] = { sqrt(1.5), T, T, top, top + sqrt(2 * (h - 0.25)), T + 2 * v, T + 2 * v };
    const size_t which[] = { 1, 0, 3, 2, 1, 0, 3 };
    size_t n;
    const fvi_event_time *at = fvi_stepper_events(s, &n);
    ck_assert_uint_ge(n, LEN(want));
    for (size_t k = 0; k < LEN(want); k++) {
        ck_assert_msg(at[k].event == which[k], "%zu: event %zu", k, at[k].event);
        ck_assert_near(at[k].t, want[k], 64 * U * want[k], "event %zu", k);
    }
    fvi_stepper_free(s);
    run.event_count = 5;
    s = started(&run);
    go(s);
    at = fvi_stepper_events(s, &n);
    ck_assert(fvi_stepper_is_over(s) && at[n - 1].event == 4 && n == 4);
    ck_assert_near(s->t, T + v - sqrt(v * v - 0.25), 64 * U * 2, "it stops");
    ck_assert_near(s->x[0], 0.125, 4 * U, "there");
    fvi_stepper_free(s);
}
END_TEST

/* A run goes on from a copy with the same digits, and with events of its own. */
START_TEST(a_copy_knows_the_events)
{
    const fvi_event floor = impact(0.8);
    const double rho = 0.3;
    const fvi_system system = ball(&rho);
    fvi_run run = fall(&system, 1, &floor, 5);
    run.alpha = 0.7;
    fvi_stepper *s = started(&run), *copy;
    ck_assert_int_eq(fvi_stepper_advance_to(s, 2, NULL, NULL), FVI_SUCCESS);
    ck_assert_int_eq(fvi_stepper_copy(s, &copy), FVI_SUCCESS);
    go(s);
    go(copy);
    size_t n, m;
    const fvi_event_time *a = fvi_stepper_events(s, &n), *b = fvi_stepper_events(copy, &m);
    ck_assert(n == 4 && m == 4 && s->x[0] == copy->x[0] && s->p[0] == copy->p[0]);
    for (size_t k = 0; k < n; k++)
        ck_assert(a[k].t == b[k].t);
    ck_assert_int_eq(fvi_stepper_reset(copy), FVI_SUCCESS);
    fvi_stepper_events(copy, &m);
    ck_assert_uint_eq(m, 0);
    go(copy);
    ck_assert_double_eq(s->x[0], copy->x[0]);
    fvi_stepper_free(copy);
    fvi_stepper_free(s);
}
END_TEST

/* To the bit, with the times of all events, also of those before it was saved, and of a run that is over. */
START_TEST(a_run_with_events_that_was_saved_goes_on)
{
    const double low = -0.5, rho = 0.3;
    const fvi_event events[] = { impact(0.8), { .value = height, .params = (void *)&low, .action = FVI_EVENT_STOP },
                                 { .value = speed, .action = FVI_EVENT_MARK } };
    for (int is_stopped = 0; is_stopped < 2; is_stopped++) {
        const fvi_system system = ball(&rho);
        fvi_run run = fall(&system, is_stopped ? 1 : 3, is_stopped ? events + 1 : events, 5);
        run.alpha = 0.7;
        fvi_stepper *s = started(&run), *again = started(&run);
        ck_assert_int_eq(fvi_stepper_advance_to(s, is_stopped ? 1 : 2, NULL, NULL), FVI_SUCCESS);
        if (is_stopped)
            go(s);
        save_and_restore(s, again);
        ck_assert_int_eq(fvi_stepper_is_over(again), fvi_stepper_is_over(s));
        if (!is_stopped)
            go(s), go(again);
        size_t n, m;
        const fvi_event_time *a = fvi_stepper_events(s, &n), *b = fvi_stepper_events(again, &m);
        ck_assert(n == (is_stopped ? 1 : 8) && m == n && s->x[0] == again->x[0] && s->p[0] == again->p[0]);
        for (size_t k = 0; k < n; k++)
            ck_assert(a[k].t == b[k].t && a[k].event == b[k].event && a[k].at_rest == b[k].at_rest);
        fvi_stepper_free(again);
        fvi_stepper_free(s);
    }
}
END_TEST

/* x = cos(t + phase) passes -1 + depth twice in each period, acos(1 - depth) before and after it turns back; wherever
 * the steps, which are longer than that, end, both are seen, and none is seen twice. x is right to 1e-10 (seen: 4e-12),
 * so the time is right to 1e-10 over the speed sqrt(2 depth). */
START_TEST(a_short_visit_beyond_0_is_seen)
{
    static const double depths[] = { 1e-2, 1e-4, 1e-7 }, spring = 1, T = 18.8;
    for (size_t n = 0; n < LEN(depths); n++)
        for (double phase = 0.05; phase < 3; phase += 0.00593) {
            const double x0 = cos(phase), p0 = -sin(phase), level = depths[n] - 1, half = acos(1 - depths[n]);
            const fvi_event event = { .value = height, .params = (void *)&level };
            const fvi_system system = { .d = 1, .mass = &mass, .damping = &none,
                                        .potential = fvi_potential_harmonic(&spring) };
            fvi_run run = fvi_run_default(&system, &x0, &p0, T, 1);
            run.events = &event;
            run.event_count = 1;
            run.step_error = 1e-11;
            fvi_stepper *s = started(&run);
            go(s);
            size_t count, k = 0;
            const fvi_event_time *at = fvi_stepper_events(s, &count);
            for (double turn = M_PI - phase; turn - half < T; turn += 2 * M_PI)
                for (int side = -1; side < 2; side += 2) {
                    const double t = turn + side * half;
                    if (t < 0 || t > T)
                        continue;
                    ck_assert_msg(k < count, "depth %g, phase %g: %zu events", depths[n], phase, count);
                    ck_assert_near(at[k++].t, t, 1e-10 / sqrt(2 * depths[n]), "depth %g, phase %g", depths[n], phase);
                }
            ck_assert_msg(k == count, "depth %g, phase %g: %zu events", depths[n], phase, count);
            fvi_stepper_free(s);
        }
}
END_TEST

/* ---- kicks ---- */

/* As the impulse of a force at the same time, which both runs end a step at: to the bit. */
START_TEST(a_kick_is_an_impulse)
{
    const double J = 0.5, rho = 0.3, alphas[] = { 0, 0.3, 0.7, 1 }, nothing = 0;
    double hit_p = J;
    const fvi_impulse hits[] = { { 1, &hit_p } }, empty[] = { { 1, &nothing } };
    for (size_t i = 0; i < LEN(alphas); i++) {
        fvi_system by_force = ball(&rho), by_kick = ball(&rho);
        by_force.force.impulses = hits;
        by_kick.force.impulses = empty;
        by_force.force.impulse_count = by_kick.force.impulse_count = 1;
        fvi_run a = fall(&by_force, 0, NULL, 4), b = fall(&by_kick, 0, NULL, 4);
        a.alpha = b.alpha = alphas[i];
        fvi_stepper *s = started(&a), *k = started(&b);
        ck_assert_int_eq(fvi_stepper_advance_to(k, 1, NULL, NULL), FVI_SUCCESS);
        ck_assert_int_eq(fvi_stepper_kick(k, &J), FVI_SUCCESS);
        go(s);
        go(k);
        ck_assert_double_eq(s->x[0], k->x[0]);
        ck_assert_double_eq(s->p[0], k->p[0]);
        ck_assert(fabs(s->p[0]) > 1e-3);
        fvi_stepper_free(s);
        fvi_stepper_free(k);
    }
}
END_TEST

/* ---- what is refused ---- */

static int failing(double t, size_t d, const double *x, const double *p,
                   void *params, double *z)
{
    (void)d, (void)x, (void)p, (void)params;
    *z = t > 0.5 ? NAN : 1;
    return 0;
}

static void refused(const fvi_method *method, const fvi_event *e, int code)
{
    const fvi_system system = ball(&none);
    const fvi_run run = fall(&system, 1, e, 5);
    fvi_stepper *s = NULL;
    fvi_error error = { 0 };
    ck_assert_int_eq(fvi_stepper_start(method, &run, &s, &error), code);
    ck_assert_str_eq(error.field, "events");
    ck_assert_ptr_null(s);
}

START_TEST(bad_events_are_refused)
{
    fvi_event e = impact(0.8);
    refused(&fvi_fractional, &e, FVI_EUNSUP);
    refused(&fvi_variable_step, NULL, FVI_EFAULT);
    e.restitution = 1.5;
    refused(&fvi_variable_step, &e, FVI_EDOM);
    e.restitution = NAN;
    refused(&fvi_variable_step, &e, FVI_EDOM);
    e = impact(0.8);
    e.gradient = NULL;
    refused(&fvi_variable_step, &e, FVI_EFAULT);
    e = (fvi_event){ .value = height, .action = 17 };
    refused(&fvi_variable_step, &e, FVI_EINVAL);
    const fvi_system system = ball(&none);
    e = (fvi_event){ .value = failing };
    fvi_run run = fall(&system, 1, &e, 5);
    fvi_stepper *s = started(&run);
    fvi_observer *o = NULL;
    ck_assert_int_eq(fvi_observer_start(s, FVI_OBSERVE_FORCE, &o, NULL), FVI_EUNSUP);
    int status = 0;
    while (!status)
        status = fvi_stepper_step(s);
    ck_assert_int_eq(status, FVI_EOVRFLW);
    const double J = NAN, fine = 1;
    ck_assert_int_eq(fvi_stepper_kick(s, &J), FVI_EDOM);
    ck_assert_int_eq(fvi_stepper_kick(s, NULL), FVI_EFAULT);
    fvi_stepper_free(s);
    const double rho = 0.3; /* steps would have to be shorter than this run knows */
    const fvi_system damped = ball(&rho);
    run = fall(&damped, 0, NULL, 5);
    run.alpha = 0.7;
    s = started(&run);
    ck_assert_int_eq(fvi_stepper_kick(s, &fine), FVI_EUNSUP);
    fvi_stepper_free(s);
    ck_assert_int_eq(fvi_stepper_start(&fvi_fractional, &run, &s, NULL), FVI_SUCCESS);
    ck_assert_int_eq(fvi_stepper_kick(s, &fine), FVI_EINVAL);
    fvi_stepper_free(s);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("events");
    ADD_CASE(suite, "stops, marks, copies", stops_and_marks, a_short_visit_beyond_0_is_seen, a_copy_knows_the_events,
             a_run_with_events_that_was_saved_goes_on);
    ADD_CASE(suite, "kicks", a_kick_is_an_impulse);
    ADD_CASE(suite, "refused", bad_events_are_refused);
    return run_suite(suite);
}
