/* tests/lagrangian/test_lagrangian_ties.c -- H 29: impacts, marks and kicks of a body with constraints.
 * Run alone: make test-lagrangian_ties */
#include "problems.h"
#include "watched.h"

#include "system/larger.h"

/* The pendulum of H 29 in its angle, and two masses on two rods in angles and in the plane. */
static const mechanism_text
    angle = { .name = "pendulum in its angle",
              .d = 1,
              .lagrangian = "v^2/2 + cos(x)",
              .damper = { "sqrt((sin(x)-1.5)^2+cos(x)^2) : power:0.4,0.3" },
              .x0 = { 1.2 },
              .v0 = { 0.5 } },
    steep_angle = { .name = "the same, order 1.4",
                    .d = 1,
                    .lagrangian = "v^2/2 + cos(x)",
                    .damper = { "sqrt((sin(x)-1.5)^2+cos(x)^2) : power:0.4,0.7" },
                    .x0 = { 1.2 },
                    .v0 = { 0.5 } },
    steep_bob = { .name = "bob, order 1.4",
                  .d = 2,
                  .lagrangian = "(v1^2+v2^2)/2 - x2",
                  .damper = { "sqrt((x1-1.5)^2+x2^2) : power:0.4,0.7" },
                  .constraint = { "(x1^2+x2^2-1)/2" },
                  .x0 = { SIN, -COS },
                  .v0 = { 0.5 * COS, 0.5 * SIN } },
    two_angles = { .name = "double pendulum in angles",
                   .d = 2,
                   .lagrangian = "v1^2 + v2^2/2 + v1*v2*cos(x1-x2) + 2*cos(x1) + cos(x2)",
                   .damper = { "sqrt((sin(x1)+sin(x2)-3)^2+(cos(x1)+cos(x2))^2) : zener:0.4,0.3,0.5" },
                   .x0 = { 1.2, 1.2 },
                   .v0 = { 0.5, -0.3 } },
    two_rods = { .name = "double pendulum in the plane",
                 .d = 4,
                 .lagrangian = "(v1^2+v2^2+v3^2+v4^2)/2 - x2 - x4",
                 .damper = { "sqrt((x3-3)^2+x4^2) : zener:0.4,0.3,0.5" },
                 .constraint = { "(x1^2+x2^2-1)/2", "((x3-x1)^2+(x4-x2)^2-1)/2" },
                 .x0 = { SIN, -COS, 2 * SIN, -2 * COS },
                 .v0 = { 0.5 * COS, 0.5 * SIN, 0.2 * COS, 0.2 * SIN } };

/* The same body twice: tied, and in angles, where every number of the plane is an expression. */
static const struct {
    const mechanism_text *tied, *free;
    const char *tied_event[MOST_EVENTS], *free_event[MOST_EVENTS];
    double T;
    size_t least; /* so many events at least */
} twins[] = {
    { &problems[ROD], &angle,
      { "x1+0.2 : impact:0.7", "v1 : mark", "p2-0.1 : mark" },
      { "sin(x)+0.2 : impact:0.7", "cos(x)*v : mark", "sin(x)*v-0.1 : mark" }, 6, 7 },
    { &steep_bob, &steep_angle,
      { "x1+0.2*sin(t) : impact:0.7", "v1 : mark", "p2-0.1 : mark" },
      { "sin(x)+0.2*sin(t) : impact:0.7", "cos(x)*v : mark", "sin(x)*v-0.1 : mark" }, 6, 6 },
    { &two_rods, &two_angles,
      { "x3+x4/5 : impact:0.6", "x1-0.3 : impact:1", "v3 : mark" },
      { "sin(x1)+sin(x2)-(cos(x1)+cos(x2))/5 : impact:0.6", "sin(x1)-0.3 : impact:1",
        "cos(x1)*v1+cos(x2)*v2 : mark" }, 4, 3 },
};
enum { TWINS = sizeof twins / sizeof *twins };

/* Places and velocities in the plane of a body in angles. */
static void in_plane(size_t d, const double *x, const double *v, double *X, double *V)
{
    double at[4] = { 0 };
    for (size_t j = 0; j < d; j++) {
        X[2 * j] = at[0] += sin(x[j]);
        X[2 * j + 1] = at[1] -= cos(x[j]);
        V[2 * j] = at[2] += cos(x[j]) * v[j];
        V[2 * j + 1] = at[3] += sin(x[j]) * v[j];
    }
}

/* Both are computed to 1e-11, and so by different steps: the events and the end are the same. */
START_TEST(eq_29_22_a_tied_body_hits_as_one_in_angles_does)
{
    watched tied, in_angles;
    open_watched(twins[_i].tied, twins[_i].tied_event, twins[_i].T, &tied);
    open_watched(twins[_i].free, twins[_i].free_event, twins[_i].T, &in_angles);
    tied.run.step_error = in_angles.run.step_error = 1e-11;
    fvi_stepper *s = at_end(&tied.run), *r = at_end(&in_angles.run);
    size_t n, many;
    const fvi_event_time *at = fvi_stepper_events(s, &n), *expected = fvi_stepper_events(r, &many);
    double worst = 0, X[4], V[4], v[4];
    ck_assert_uint_eq(n, many);
    ck_assert_uint_ge(n, twins[_i].least);
    for (size_t i = 0; i < n; i++) {
        ck_assert_uint_eq(at[i].event, expected[i].event);
        worst = larger(worst, fabs(at[i].t - expected[i].t));
    }
    OK(fvi_stepper_velocity(r, v));
    in_plane(r->run.system->d, r->x, v, X, V);
    OK(fvi_stepper_velocity(s, v));
    for (size_t j = 0; j < s->run.system->d; j++) {
        worst = larger(worst, fabs(s->x[j] - X[j]));
        worst = larger(worst, fabs(v[j] - V[j]));
        worst = larger(worst, fabs(s->p[j] - V[j])); /* all masses are 1 */
    }
    ck_assert_msg(worst <= 3e-11, "%s: %g", twins[_i].tied->name, worst);
    seen(worst, "%s", twins[_i].tied->name);
    fvi_stepper_free(s);
    fvi_stepper_free(r);
    close_watched(&tied);
    close_watched(&in_angles);
}
END_TEST

/* Where the bob turns back all velocities are 0, and v of p is nothing but roundings. */
START_TEST(a_bob_that_turns_back_is_marked)
{
    static const char *const rest[] = { "v1 : mark", NULL };
    watched w;
    open_watched(&problems[ROD], rest, 6, &w);
    for (double asked = 1e-4; asked > 0.5e-10; asked /= 10) {
        w.run.step_error = asked;
        fvi_stepper *s = at_end(&w.run);
        size_t n;
        const fvi_event_time *at = fvi_stepper_events(s, &n);
        ck_assert_uint_eq(n, 2);
        ck_assert_double_eq_tol(at[0].t, 0.50264626040198, 10 * asked);
        ck_assert_double_eq_tol(at[1].t, 3.8224932402842, 10 * asked);
        fvi_stepper_free(s);
    }
    close_watched(&w);
}
END_TEST

/* One step ends at an event: s->p behind it, p before it. */
static fvi_stepper *at_first_event(const watched *w, double *p)
{
    fvi_stepper *s;
    size_t n = 0;
    OK(fvi_stepper_start(&fvi_variable_step, &w->run, &s, NULL));
    while (n == 0) {
        OK(fvi_stepper_step(s));
        fvi_stepper_events(s, &n);
    }
    OK(fvi_variable_step.dense(s, s->t, NULL, p));
    return s;
}

/* From the equations alone, for an L that is not quadratic in v: the jump of p lies in the plane of the normal
 * and the constraint's gradient, the speed of Z turns round, and v keeps to the constraint. */
START_TEST(eq_29_22_the_jump_has_two_directions)
{
    static const mechanism_text text = { .name = "not quadratic in v, on a sphere",
                                         .d = 3,
                                         .lagrangian = "(v1^2+v2^2+v3^2)^2/4 + (v1^2+v2^2+v3^2)/2 - 2*x1",
                                         .damper = { "x2 : power:0.2,0.3" },
                                         .constraint = { "(x1^2+x2^2+x3^2-1)/2" },
                                         .x0 = { 0, 1, 0 },
                                         .v0 = { 0.3, 0, 0.4 } };
    static const char *const wall[] = { "x1+x3/3+0.4-0.1*sin(t) : impact:0.6", NULL };
    watched w;
    double p[3], before[3] = { 0 }, behind[3], normal[3], rate;
    open_watched(&text, wall, 10, &w);
    w.run.step_error = 1e-11;
    fvi_stepper *s = at_first_event(&w, p);
    const fvi_event *e = w.run.events;
    const double *x = s->x;
    OK(e->gradient(s->t, 3, x, e->params, normal, &rate));
    OK(fvi_velocity_of_momentum(&w.p.system, s->t, x, p, before));
    OK(fvi_stepper_velocity(s, behind));
    double speed = rate, after = rate, along = 0, Lv[3], jump[3], size = 0;
    for (size_t j = 0; j < 3; j++) {
        speed += normal[j] * before[j];
        after += normal[j] * behind[j];
        along += x[j] * behind[j];
        jump[j] = s->p[j] - p[j];
        size += fabs(jump[j]);
    }
    ck_assert_msg(speed < -0.1 && size > 0.1, "%g %g", speed, size);
    ck_assert_double_eq_tol(after, -0.6 * speed, 1e-10);
    ck_assert_double_eq_tol(along, 0, 1e-15);
    OK(fvi_momentum_of_velocity(&w.p.system, s->t, x, behind, Lv));
    for (size_t j = 0; j < 3; j++)
        ck_assert_double_eq_tol(s->p[j], Lv[j], 1e-14);
    const double volume = jump[0] * (normal[1] * x[2] - normal[2] * x[1])
                          + jump[1] * (normal[2] * x[0] - normal[0] * x[2])
                          + jump[2] * (normal[0] * x[1] - normal[1] * x[0]);
    ck_assert_double_eq_tol(volume, 0, 1e-10);
    fvi_stepper_free(s);
    close_watched(&w);
}
END_TEST

/* With e = 1, and a wall and rods that stand, no impact takes energy; with e < 1 hops come to rest. */
START_TEST(rods_take_no_energy_of_an_impact)
{
    static const char *const wall[] = { "x3+x4/5 : impact:1", "x1-0.3 : impact:1", NULL },
                      *const soft[] = { "x1-0.4 : impact:0.3", NULL };
    mechanism_text text = two_rods;
    watched w;
    double E0, E;
    size_t n;
    text.damper[0] = NULL;
    open_watched(&text, wall, 10, &w);
    w.run.step_error = 1e-12;
    fvi_stepper *s = at_end(&w.run);
    fvi_stepper_events(s, &n);
    ck_assert_uint_ge(n, 4);
    OK(fvi_energy_at(&w.p.system, 0, w.p.x0, w.p.p0, &E0));
    OK(fvi_stepper_energy(s, &E));
    ck_assert_double_eq_tol(E, E0, 1e-10);
    seen(fabs(E - E0), "loss");
    fvi_stepper_free(s);
    close_watched(&w);

    open_watched(&problems[ROD], soft, 60, &w);
    w.run.step_error = 1e-8;
    s = at_end(&w.run);
    const fvi_event_time *at = fvi_stepper_events(s, &n);
    ck_assert(n > 3 && fvi_stepper_is_over(s) && at[n - 1].at_rest);
    fvi_stepper_free(s);
    close_watched(&w);
}
END_TEST

/* A cart that is driven by hand: x1 = sin t / 2. What the hand gives at an impact of the pendulum is the jump of
 * p1, and fvi_stepper_tie counts it, with the other sign. */
START_TEST(the_hand_gives_an_impulse_too)
{
    static const mechanism_text text = { .name = "driven cart",
                                         .d = 2,
                                         .lagrangian = "3*v1^2/2 + v1*v2*cos(x2) + v2^2/2 + cos(x2)",
                                         .damper = { "x2 : power:0.2,0.3" },
                                         .constraint = { "x1-sin(t)/2" },
                                         .x0 = { 0, 1.2 },
                                         .v0 = { 0.5, -0.5 } };
    static const char *const wall[] = { "x1+sin(x2) : impact:0.5", NULL };
    watched w;
    double p[2], v[2], tie;
    open_watched(&text, wall, 10, &w);
    w.run.step_error = 1e-12;
    fvi_stepper *s = at_first_event(&w, p);
    OK(fvi_stepper_tie(s, 0, &tie));
    fvi_stepper *smooth;
    fvi_run run = w.run; /* the same step without the event */
    run.event_count = 0;
    run.h = s->t;
    OK(fvi_stepper_start(&fvi_variable_step, &run, &smooth, NULL));
    while (smooth->k < 1)
        OK(fvi_stepper_step(smooth));
    double tie_before;
    OK(fvi_stepper_tie(smooth, 0, &tie_before));
    ck_assert_double_eq_tol(p[0], smooth->p[0], 1e-10);
    const double by_wall = s->p[1] - p[1], cosine = cos(s->x[1]);
    ck_assert(fabs(by_wall) > 0.1);
    /* the wall's impulse is lambda (1, cos x2) */
    ck_assert_double_eq_tol(s->p[0] - p[0], by_wall / cosine - (tie - tie_before), 1e-10);
    ck_assert(fabs(tie - tie_before) > 0.01);
    OK(fvi_stepper_velocity(s, v));
    ck_assert_double_eq_tol(v[0], cos(s->t) / 2, 1e-14);
    fvi_stepper_free(smooth);
    fvi_stepper_free(s);
    close_watched(&w);
}
END_TEST

/* A kick of a tied body is the kick of its angle, K = n . J with the slopes n of the place by the angle; and so is
 * an impulse of the force. Other methods refuse it. */
START_TEST(eq_29_22_a_kick_is_that_of_the_angle)
{
    static const double J[] = { 0.3, -0.2 }, zeros[] = { 0, 0 };
    static const char *const at_one[] = { "t-1 : mark", NULL };
    const fvi_impulse impulse = { 1, J }, none = { 0, zeros };
    double x[3][2];
    for (int i = 0; i < 3; i++) { /* by kick; by an impulse; in the angle */
        watched w;
        open_watched(i < 2 ? &steep_bob : &steep_angle, at_one, 3, &w);
        w.run.step_error = 1e-11;
        w.p.system.force.impulse_count = 1;
        w.p.system.force.impulses = i == 1 ? &impulse : &none;
        fvi_stepper *s;
        OK(fvi_stepper_start(&fvi_variable_step, &w.run, &s, NULL));
        int is_kicked = i == 1;
        while (s->k < 1) {
            size_t n;
            OK(fvi_stepper_step(s));
            fvi_stepper_events(s, &n);
            if (n == 1 && !is_kicked) {
                const double K = cos(s->x[0]) * J[0] + sin(s->x[0]) * J[1];
                OK(fvi_stepper_kick(s, i ? &K : J));
            }
            is_kicked |= n == 1;
        }
        x[i][0] = i < 2 ? s->x[0] : sin(s->x[0]);
        x[i][1] = i < 2 ? s->x[1] : -cos(s->x[0]);
        fvi_stepper_free(s);
        if (i == 1) {
            fvi_error error;
            ck_assert_int_eq(fvi_stepper_start(&fvi_lobatto_d4, &w.run, &s, &error), FVI_EUNSUP);
            w.run.event_count = 0;
            ck_assert_int_eq(fvi_stepper_start(&fvi_lobatto_d4, &w.run, &s, &error), FVI_EUNSUP);
            ck_assert_str_eq(error.field, "constraint");
        }
        close_watched(&w);
    }
    for (size_t j = 0; j < 2; j++) {
        ck_assert_double_eq_tol(x[0][j], x[2][j], 1e-10);
        ck_assert_double_eq_tol(x[1][j], x[2][j], 1e-10);
    }
}
END_TEST

/* E + work of dampers - work of F stays through impulses: what they give is what they change of the energy. */
START_TEST(the_balance_holds_through_impulses)
{
    static const double J[] = { 0.3, -0.2 }, K[] = { -0.1, 0.5 };
    const fvi_impulse impulses[] = { { 1, J }, { 2.5, K } };
    static const char *const none[] = { NULL };
    watched w;
    open_watched(&problems[ROD], none, 4, &w);
    w.p.system.force.impulse_count = 2;
    w.p.system.force.impulses = impulses;
    w.run.step_error = 1e-11;
    w.run.h = 0.5;
    w.run.steps = 8;
    fvi_stepper *s;
    fvi_observer *o;
    fvi_observation now;
    double first = 0;
    OK(fvi_stepper_start(&fvi_variable_step, &w.run, &s, NULL));
    OK(fvi_observer_start(s, FVI_OBSERVE_WORK, &o, NULL));
    for (size_t k = 0; k <= 8; k++) {
        const double t = (double)k * 0.5;
        while (s->t < t)
            OK(fvi_observer_step(o, s));
        OK(fvi_observer_read(o, s, t, &now));
        first = k ? first : now.balance;
        ck_assert_double_eq_tol(now.balance, first, 1e-10);
    }
    fvi_observer_free(o);
    fvi_stepper_free(s);
    close_watched(&w);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("lagrangian: ties");
    ADD_LOOP(suite, eq_29_22_a_tied_body_hits_as_one_in_angles_does, TWINS);
    ADD_CASE(suite, "ties", a_bob_that_turns_back_is_marked, eq_29_22_the_jump_has_two_directions,
             rods_take_no_energy_of_an_impact, the_hand_gives_an_impulse_too, eq_29_22_a_kick_is_that_of_the_angle,
             the_balance_holds_through_impulses);
    return run_suite(suite);
}
