/* tests/lagrangian/test_lagrangian_adaptive_state.c -- Form D on a mesh: copies, archives, impulses and sums.
 * Run alone: make test-lagrangian_adaptive_state */
#include "adaptive_runs.h"

typedef struct {
    fvi_archive archive;
    char *room;
    size_t at;
    int is_saved;
} saved;

static int serialize(fvi_archive *archive, void *data, size_t bytes, int constant)
{
    saved *to = (saved *)archive;
    char *here = to->room + to->at;
    to->at += bytes;
    if (!to->is_saved)
        memcpy(here, data, bytes);
    else if (constant)
        return memcmp(here, data, bytes) != 0;
    else
        memcpy(data, here, bytes);
    return 0;
}

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
    saved to = { .archive = { serialize }, .room = malloc(1 << 20) };
    OK(fvi_stepper_archive(s, &to.archive));
    OK(fvi_stepper_start(&fvi_variable_step, &run, &again, NULL));
    to.is_saved = 1;
    to.at = 0;
    OK(fvi_stepper_archive(again, &to.archive));
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
    free(to.room);
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

int main(void)
{
    Suite *suite = suite_create("lagrangian: the state of steps of any length");
    ADD_CASE(suite, "state", a_copy_and_an_archive_go_on_with_the_same_digits,
             an_impulse_between_two_steps, forces_and_work_are_known_within_steps);
    return run_suite(suite);
}
