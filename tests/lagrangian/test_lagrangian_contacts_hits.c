/* tests/lagrangian/test_lagrangian_contacts_hits.c -- H 29: an impulse, a kick or another wall hits a body that
 * rests on a surface.
 * Run alone: make test-lagrangian_contacts_hits */
#include "watched.h"

#include "system/larger.h"

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

int main(void)
{
    Suite *suite = suite_create("lagrangian: contacts and hits");
    ADD_LOOP(suite, the_floor_takes_an_impulse_and_lets_go_of_a_pull, 6);
    ADD_LOOP(suite, a_wall_lifts_a_body_off_the_floor_or_the_floor_holds_it, 2);
    ADD_CASE(suite, "contacts", a_body_rests_in_a_corner);
    return run_suite(suite);
}
