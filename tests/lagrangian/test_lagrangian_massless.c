/* tests/lagrangian/test_lagrangian_massless.c -- H 29: a coordinate without inertia that jumps.
 * Run alone: make test-lagrangian_massless */
#include "problems.h"
#include "watched.h"

#include "system/larger.h"

/* x1 with mass 1 and a spring, and 2 between it and x2, which a Zener element holds. By the inverse of the Laplace transform,
 * Talbot's rule with 25 digits, at t = 2. The order is 0.6, 0.2 and 0.9. */
static const struct {
    const char *damper;
    double let_go[2], force_driven[2];
} zeners[] = {
    { "x2 : zener:0.5,0.3,0.4", { -0.593496357528891, -0.446368652039837 }, { 1.42575364028442, 1.11389455377362 } },
    { "x2 : zener:0.5,0.1,0.4", { -0.634676670480243, -0.518268251809475 }, { 1.44009407396411, 1.07169503109282 } },
    { "x2 : zener:0.5,0.45,0.4", { -0.560329721078561, -0.389622344308331 }, { 1.41397500615183, 1.14707239173195 } },
};

/* The element is stiff at once, so x2 jumps to where the forces are in balance: at t = 0, where x1 is let go from 1, or where
 * cos t pulls both from rest. */
START_TEST(a_zener_element_out_of_balance_jumps)
{
    for (int force_driven = 0; force_driven < 2; force_driven++) {
        const mechanism_text text = { .name = "zener", .d = 2, .damper = { zeners[_i].damper },
                                      .lagrangian = force_driven ? "v1^2/2-x1^2/2-(x2-x1)^2+cos(t)*(x1+x2)"
                                                           : "v1^2/2-x1^2/2-(x2-x1)^2",
                                      .x0 = { !force_driven, 0 } };
        const double *want = force_driven ? zeners[_i].force_driven : zeners[_i].let_go;
        mechanism_problem p;
        open_problem(&text, &p);
        fvi_run run = run_of(&p, 2, 1);
        for (double asked = 1e-5; asked > 0.5e-11; asked /= 1000) {
            run.step_error = asked;
            fvi_stepper *s = at_end(&run);
            const double off = larger(fabs(s->x[0] - want[0]), fabs(s->x[1] - want[1]));
            ck_assert_msg(off <= asked + 2e-14, "asked %g, off by %g", asked, off);
            seen(off, "%s %g", zeners[_i].damper, asked);
            fvi_stepper_free(s);
        }
        close_problem(&p);
    }
}
END_TEST

static int steps_to_one(double t, size_t d, void *params, double *F)
{
    (void)params;
    for (size_t i = 0; i < d; i++)
        F[i] = t < 1;
    return 0;
}

/* A force that is 1 on both until t = 1, which it says: x2 jumps there, too. Two answers to a step, one second apart, to
 * a tenth of the error that is asked; seen 0.003 of it. */
START_TEST(a_jump_of_the_force_is_one_of_the_place)
{
    static const double at_one[] = { 1 };
    const mechanism_text text = { .name = "step", .d = 2, .damper = { "x2 : zener:0.5,0.3,0.4" },
                                  .lagrangian = "v1^2/2-x1^2/2-(x2-x1)^2" };
    mechanism_problem p;
    open_problem(&text, &p);
    p.system.force = (fvi_force){ .value = steps_to_one, .jumps = at_one, .jump_count = 1 };
    fvi_run run = run_of(&p, 2, 1);
    run.step_error = 1e-11;
    fvi_stepper *s = at_end(&run);
    ck_assert_near(s->x[0], 1.49452493161417, 1e-12, "x1");
    ck_assert_near(s->x[1], 1.3364097377503, 1e-12, "x2");
    fvi_stepper_free(s);
    close_problem(&p);
}
END_TEST

/* An impulse makes its place infinite at once: those methods refuse whose steps would see it. Form D is right behind
 * it, for an order below 1, of 1, and above: with four stages to h^6; seen 0.007 of it. */
START_TEST(an_impulse_on_it_is_for_stages_of_form_d)
{
    static const char *const dampers[] = { "x2 : power:0.5,0.3", "x2 : power:0.5,0.5", "x2 : power:0.5,0.7" };
    static const double want[][2] = { { 1.34171254956663, 1.10006773805694 },
                                      { 1.30624007088678, 1.07129892262507 },
                                      { 1.26748522913529, 1.03090507118512 } },
        ones[] = { 1, 1 };
    const fvi_impulse impulse = { 1, ones };
    const mechanism_text text = { .name = "struck", .d = 2, .damper = { dampers[_i] },
                                  .lagrangian = "v1^2/2-x1^2/2-(x2-x1)^2" };
    mechanism_problem p;
    open_problem(&text, &p);
    p.system.force.impulse_count = 1;
    p.system.force.impulses = &impulse;
    fvi_run run = run_of(&p, 2. / 128, 128);
    fvi_stepper *s;
    fvi_error error;
    OK(fvi_stepper_start(fvi_method_find("fvi-lobatto4d"), &run, &s, NULL));
    while (s->k < run.steps)
        OK(fvi_stepper_step(s));
    for (int i = 0; i < 2; i++)
        ck_assert_near(s->x[i], want[_i][i], pow(run.h, 6), "%s, x%d", dampers[_i], i + 1);
    fvi_stepper_free(s);
    const fvi_method *const others[] = { &fvi_variable_step, fvi_method_find("fvi-stable") };
    for (int i = 0; i < 2; i++) {
        ck_assert_int_eq(fvi_stepper_start(others[i], &run, &s, &error), FVI_EUNSUP);
        ck_assert_str_eq(error.text, "an impulse on coordinate 2, which has no inertia, moves it at once: "
                                     "fvi-lobatto2d to 8d take it");
    }
    static const double first[] = { 1, 0 };
    const fvi_impulse on_first = { 1, first };
    p.system.force.impulses = &on_first;
    OK(fvi_stepper_start(&fvi_variable_step, &run, &s, NULL));
    if (_i == 0)
        ck_assert_int_eq(fvi_stepper_kick(s, ones), FVI_EUNSUP);
    OK(fvi_stepper_kick(s, first));
    fvi_stepper_free(s);
    close_problem(&p);
}
END_TEST

/* With an order of 0.06 the place goes on as t^0.06 behind its jump: no step is short enough. */
START_TEST(a_relaxation_that_is_too_slow_is_refused)
{
    const mechanism_text text = { .name = "slow", .d = 2, .damper = { "x2 : zener:0.5,0.03,0.4" },
                                  .lagrangian = "v1^2/2-x1^2/2-(x2-x1)^2", .x0 = { 1, 0 } };
    mechanism_problem p;
    open_problem(&text, &p);
    const fvi_run run = run_of(&p, 2, 1);
    fvi_stepper *s;
    fvi_error error;
    ck_assert_int_eq(fvi_stepper_start(&fvi_variable_step, &run, &s, &error), FVI_EUNSUP);
    ck_assert_ptr_nonnull(strstr(error.text, "no step is short enough"));
    close_problem(&p);
}
END_TEST

static int three_times(double t, size_t d, void *params, double *F)
{
    (void)params;
    for (size_t i = 0; i < d; i++)
        F[i] = 3 * t;
    return 0;
}

/* x + x'/2 = 3 t from 0: x = 3 (t - (1 - e^(-2 t))/2), and x' = 3 (1 - e^(-2 t)). fvi-stable has the order 2, in every
 * row from the fourth on; seen 0.74 h^2 of x and 2.9 h^2 of x'. A force at the nodes made x swing by h, and x' by a
 * number that no step made smaller. */
START_TEST(a_force_on_it_does_not_make_it_swing)
{
    const mechanism_text text = { .name = "pulled", .d = 1, .lagrangian = "-x^2/2", .damper = { "x : viscous:0.5" } };
    mechanism_problem p;
    open_problem(&text, &p);
    p.system.force = (fvi_force){ .value = three_times };
    for (size_t N = 40; N <= 160; N *= 2) {
        const double h = 2 / (double)N;
        fvi_stepper *s = stepper_at(&fvi_cq2_midpoint, &p, h, N, 3);
        double v, most = 0;
        while (s->k < N) {
            OK(fvi_stepper_step(s));
            OK(fvi_stepper_velocity(s, &v));
            most = larger(most, fabs(s->x[0] - 3 * (s->t - (1 - exp(-2 * s->t)) / 2)));
            most = larger(most, fabs(v - 3 * (1 - exp(-2 * s->t))));
        }
        ck_assert_msg(most < 4 * h * h, "%zu: %g", N, most / (h * h));
        fvi_stepper_free(s);
    }
    close_problem(&p);
}
END_TEST

/* (1 + x/2)^2 x'/2 = 1 - x from 0, a dashpot on z = x + x^2/4: with u = 1 - x it is 8 t = 6 u - u^2/2 - 9 ln u - 11/2.
 * From the tenth row on x has the order 2, and v the order 1; seen 1.3 h^2 and 1.4 h. With the gradients at the nodes
 * both swung, the more the shorter the step. */
START_TEST(a_curved_elongation_does_not_make_it_swing)
{
    const mechanism_text text = { .name = "curved", .d = 1, .lagrangian = "x-x^2/2",
                                  .damper = { "x+x^2/4 : viscous:0.5" } };
    mechanism_problem p;
    open_problem(&text, &p);
    for (size_t N = 40; N <= 640; N *= 4) {
        const double h = 2 / (double)N;
        fvi_stepper *s = stepper_at(&fvi_cq2_midpoint, &p, h, N, 9);
        double v, of_x = 0, of_v = 0;
        while (s->k < N) {
            OK(fvi_stepper_step(s));
            OK(fvi_stepper_velocity(s, &v));
            const double u = 1 - s->x[0], slope = 2 * u / pow((3 - u) / 2, 2),
                         t = (6 * u - u * u / 2 - 9 * log(u) - 5.5) / 8;
            of_x = larger(of_x, fabs(t - s->t) * slope);
            of_v = larger(of_v, fabs(v - slope));
        }
        ck_assert_msg(of_x < 3 * h * h && of_v < 3 * h, "%zu: %g h^2, %g h", N, of_x / (h * h), of_v / h);
        seen(of_x / (h * h), "x %zu", N);
        seen(of_v / h, "v %zu", N);
        fvi_stepper_free(s);
    }
    close_problem(&p);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("lagrangian: massless");
    ADD_LOOP(suite, a_zener_element_out_of_balance_jumps, 3);
    ADD_LOOP(suite, an_impulse_on_it_is_for_stages_of_form_d, 3);
    ADD_CASE(suite, "jumps", a_jump_of_the_force_is_one_of_the_place, a_relaxation_that_is_too_slow_is_refused,
             a_force_on_it_does_not_make_it_swing, a_curved_elongation_does_not_make_it_swing);
    return run_suite(suite);
}
