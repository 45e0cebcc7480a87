/* tests/lagrangian/test_lagrangian_adaptive_state.c -- H 29: form D with steps that the method chooses: copies,
 * archives, impulses and sums.
 * Run alone: make test-lagrangian_adaptive_state */
#include "adaptive_runs.h"

#include "harness/saved.h"

/* A kick at 1.5, a power above the order 1, a law: what a state may be made of. */
static const mechanism_text rich = {
    .name = "rich",
    .d = 2,
    .lagrangian = "v1^2+v2^2/2+v1*v2*cos(x1-x2)+2*cos(x1)+cos(x2)",
    .damper = { "x1 : power:0.2,0.7", "x2-x1 : zener:0.3,0.3,0.5 + power:0.1,0.25", "x2 : spring:0.1" },
    .force_on = { "1=-0.1*v1+0.1*sin(t)" },
    .x0 = { 1, 1.5 },
    .v0 = { 0.2, 0.5 }
};
static const double kick[] = { 0.1, -0.2 };
static const fvi_impulse hit = { 1.5, kick };

START_TEST(a_copy_and_an_archive_go_on_with_the_same_digits)
{
    mechanism_problem p;
    open_problem(&rich, &p);
    p.system.force.impulse_count = 1;
    p.system.force.impulses = &hit;
    fvi_run run = run_of(&p, 0.5, 8);
    run.step_error = 1e-8;
    fvi_stepper *s = NULL, *copy, *again;
    OK(fvi_stepper_start(&fvi_variable_step, &run, &s, NULL));
    while (s->t < 1)
        OK(fvi_stepper_step(s));
    OK(fvi_stepper_copy(s, &copy));
    OK(fvi_stepper_start(&fvi_variable_step, &run, &again, NULL));
    save_and_restore(s, again);
    fvi_stepper *const all[] = { s, copy, again };
    double work[3], impulse[3];
    for (int i = 0; i < 3; i++) {
        while (all[i]->k < 8)
            OK(fvi_stepper_step(all[i]));
        OK(fvi_stepper_damper(all[i], 1, &impulse[i], &work[i]));
        ck_assert_double_eq(all[i]->x[0], s->x[0]);
        ck_assert_double_eq(all[i]->p[1], s->p[1]);
        ck_assert_double_eq(work[i], work[0]);
        ck_assert_double_eq(impulse[i], impulse[0]);
    }
    OK(fvi_stepper_reset(s));
    while (s->k < 8)
        OK(fvi_stepper_step(s));
    ck_assert_double_eq(s->x[0], copy->x[0]);
    for (int i = 0; i < 3; i++)
        fvi_stepper_free(all[i]);
    close_problem(&p);
}
END_TEST

/* The impulse of a force is that of fvi-lobatto6d: both are right to 1e-8, of a law, and of an order above 1. */
START_TEST(an_impulse_between_two_steps)
{
    mechanism_problem p;
    open_problem(&rich, &p);
    p.system.force.impulse_count = 1;
    p.system.force.impulses = &hit;
    fvi_run run = run_of(&p, 4, 1);
    run.step_error = 1e-10;
    fvi_stepper *s = at_end(&run),
                *other = stepper_at(fvi_method_find("fvi-lobatto6d"), &p, 4. / 640, 640, 640);
    ck_assert_msg(off(s, other->x) <= 2e-8, "%g", off(s, other->x));
    fvi_stepper_free(s);
    fvi_stepper_free(other);
    close_problem(&p);
}
END_TEST

/* At any time, within steps, too: v, a, forces, impulses and work are those of fvi-lobatto6 with 640 steps,
 * and E + work of dampers - work of forces stays. */
START_TEST(forces_and_work_are_known_within_steps)
{
    mechanism_problem p;
    mechanism_text text = rich;
    text.damper[0] = "x1 : power:0.2,0.3"; /* of order 0.6: fvi-lobatto6 has ten digits of it */
    open_problem(&text, &p);
    fvi_run run = run_of(&p, 0.05, 80);
    run.step_error = 1e-11;
    const unsigned wanted = FVI_OBSERVE_VELOCITY | FVI_OBSERVE_ACCELERATION | FVI_OBSERVE_FORCE
                            | FVI_OBSERVE_IMPULSE | FVI_OBSERVE_WORK;
    const fvi_method *const methods[] = { &fvi_variable_step, fvi_method_find("fvi-lobatto6") };
    fvi_stepper *s[2];
    fvi_observer *o[2];
    fvi_observation now[2];
    double balance = NAN;
    for (int i = 0; i < 2; i++) {
        fvi_run each = run;
        each.h /= i ? 8 : 1;
        each.steps *= i ? 8 : 1;
        OK(fvi_stepper_start(methods[i], &each, &s[i], NULL));
        OK(fvi_observer_start(s[i], wanted, &o[i], NULL));
    }
    for (size_t k = 40; k <= 80; k += 8) {
        const double t = (double)k * 0.05;
        for (int i = 0; i < 2; i++) {
            while (s[i]->t < t)
                OK(fvi_observer_step(o[i], s[i]));
            OK(fvi_observer_read(o[i], s[i], t, &now[i]));
        }
        for (int j = 0; j < 2; j++) {
            ck_assert_double_eq_tol(now[0].v[j], now[1].v[j], 1e-9);
            ck_assert_double_eq_tol(now[0].a[j], now[1].a[j], 1e-6);
        }
        for (int j = 0; j < 3; j++) {
            ck_assert_double_eq_tol(now[0].force[j], now[1].force[j], 1e-6);
            ck_assert_double_eq_tol(now[0].impulse[j], now[1].impulse[j], 1e-8);
            ck_assert_double_eq_tol(now[0].work[j], now[1].work[j], 1e-8);
        }
        ck_assert_double_eq_tol(now[0].work_of_force, now[1].work_of_force, 1e-8);
        if (k > 40)
            ck_assert_double_eq_tol(now[0].balance, balance, 1e-10);
        balance = now[0].balance;
    }
    for (int i = 0; i < 2; i++) {
        fvi_observer_free(o[i]);
        fvi_stepper_free(s[i]);
    }
    close_problem(&p);
}
END_TEST

/* A relativistic body, whose kinetic energy is no square, and two masses: what an impulse gives is work of the
 * force, at t = 0 it belongs to the start, and one between two nodes acts on both. */
static const mechanism_text fast = { .name = "fast", .d = 1, .lagrangian = "-sqrt(1-v^2)-x^2/2",
                                     .damper = { "x : power:0.3,0.3" }, .x0 = { 0.3 }, .v0 = { 0.5 } };

START_TEST(eq_29_11_the_balance_holds_through_impulses)
{
    static const struct {
        const fvi_method *method;
        double bound; /* of the balance */
    } cases[] = { { &fvi_cq2_midpoint, 2e-3 }, { &fvi_lobatto_m4, 1e-5 }, { &fvi_lobatto_d4, 1e-5 },
                  { &fvi_variable_step, 1e-8 } };
    static const double kicks[2][2] = { { 0.4, 0 }, { 0.7, -0.5 } };
    static const fvi_impulse hits[] = { { 0, kicks[0] }, { 1.013, kicks[1] } };
    for (size_t i = 0; i < 2 * LEN(cases); i++) {
        const fvi_method *method = cases[i / 2].method;
        mechanism_problem p;
        open_problem(i % 2 ? &fast : &rich, &p);
        p.system.force.impulse_count = 2;
        p.system.force.impulses = hits;
        fvi_run run = run_of(&p, 0.02, 100);
        run.step_error = 1e-10;
        fvi_stepper *s;
        fvi_observer *o;
        fvi_observation now;
        OK(fvi_stepper_start(method, &run, &s, NULL));
        OK(fvi_observer_start(s, FVI_OBSERVE_WORK | FVI_OBSERVE_ENERGY, &o, NULL));
        OK(fvi_observer_read(o, s, 0, &now));
        const double E0 = now.energy;
        ck_assert_double_eq_tol(now.balance, E0, 1e-15);
        for (size_t k = 1; k <= 100; k++) {
            const double t = (double)k * run.h;
            while (method->dense ? s->t < t : s->k < k)
                OK(fvi_observer_step(o, s));
            OK(fvi_observer_read(o, s, t, &now));
            ck_assert_msg(fabs(now.balance - E0) <= cases[i / 2].bound, "%s %zu k %zu: %g", method->name,
                          i % 2, k, now.balance - E0);
        }
        ck_assert(fabs(now.work_of_force) > 0.1);
        fvi_observer_free(o);
        fvi_stepper_free(s);
        close_problem(&p);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("lagrangian: the state of steps of any length");
    ADD_CASE(suite, "state", a_copy_and_an_archive_go_on_with_the_same_digits,
             an_impulse_between_two_steps, forces_and_work_are_known_within_steps,
             eq_29_11_the_balance_holds_through_impulses);
    return run_suite(suite);
}
