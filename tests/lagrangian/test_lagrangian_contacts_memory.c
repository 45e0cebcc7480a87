/* tests/lagrangian/test_lagrangian_contacts_memory.c -- A body with a springpot rests on a surface and lifts off; copies and archives.
 * Run alone: make test-lagrangian_contacts_memory */
#include "watched.h"

#include "harness/saved.h"
#include "system/larger.h"

static const mechanism_text caught = { .name = "caught and lifted", .d = 1, .lagrangian = "v^2/2 - x + exp(t-3)*x",
                                       .damper = { "x : power:0.3,0.3" }, .x0 = { 1 } };

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
        OK(fvi_stepper_copy(s, &copy));
        OK(fvi_stepper_start(&fvi_variable_step, &w.run, &restored, NULL));
        save_and_restore(s, restored);
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

int main(void)
{
    Suite *suite = suite_create("lagrangian: contacts and memory");
    ADD_LOOP(suite, a_spring_pulls_a_body_with_a_springpot_off_the_floor, 2);
    ADD_CASE(suite, "contacts", a_memory_goes_through_touch_down_and_lift_off,
             the_order_goes_through_touch_down_and_lift_off, copies_and_archives_know_which_contacts_are_closed);
    return run_suite(suite);
}
