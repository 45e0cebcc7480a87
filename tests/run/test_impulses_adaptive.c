/* tests/run/test_impulses_adaptive.c -- Impulses with steps that the method chooses: steps end at the impulses.
 * Run alone: make test-impulses_adaptive */
#include "impulse_runs.h"
#include "run/whole_run.h"
#include "error_control/variable_step_search.h"

/* At its time: over all rows x is right to the tolerance of a step, for every order of
 * damping here at which it is not refused. That is an estimate's word, and no bound. */
START_TEST(eq_22_22_at_its_time_whatever_the_memory)
{
    static const double orders[] = { 0,   0.1,  0.3, 0.45, 0.5, 0.55,
                                     0.7, 0.85, 0.9, 0.95, 1 };
    for (size_t i = 0; i < LEN(orders); i++)
        for (int e = -12; e <= -4; e += 4) {
            fvi_run run = hit_at(1.2837, orders[i], 40);
            run.step_error = pow(10, e);
            const double off = error(&fvi_variable_step, &run, 1.2837, NULL);
            seen_worst(off / run.step_error, "of step_error");
            ck_assert_msg(off <= run.step_error, "alpha = %g, 1e%d: %g",
                          orders[i], e, off);
        }
    const double most = 1 - 14 / 498.4; /* the default tolerance is 10^-10 */
    fvi_run run = hit_at(1.2837, most + 1e-4, 40);
    fvi_stepper *s;
    ck_assert_int_eq(fvi_stepper_start(&fvi_variable_step, &run, &s,
                                       NULL), FVI_EUNSUP);
    run.alpha = most - 1e-4;
    ck_assert_int_eq(fvi_stepper_start(&fvi_variable_step, &run, &s,
                                       NULL), FVI_SUCCESS);
    fvi_stepper_free(s);
}
END_TEST

/* At t = 0 it is another p0, at the end it is seen in p, at a row in the row itself. */
START_TEST(eq_22_22_at_the_ends_and_at_a_row)
{
    static const double other = p0 + J;
    double y[41], v;
    fvi_run run = hit_at(0, 0.3, 40);
    ck_assert_int_eq(fvi_trajectory(&fvi_variable_step, &run, y, p, NULL),
                     FVI_SUCCESS);
    ck_assert_near(p[0], other, U, "p0");
    spring.force = (fvi_force){ 0 };
    run.p0 = &other;
    ck_assert_int_eq(fvi_trajectory(&fvi_variable_step, &run, x, NULL, NULL),
                     FVI_SUCCESS);
    for (size_t k = 0; k <= 40; k++)
        ck_assert_near(y[k], x[k], 1e-12, "row %zu", k);
    for (double at = 2.5; at <= 5; at += 2.5) {
        run = hit_at(at, 0.3, 40);
        const size_t k = at > 3 ? 40 : 20;
        ck_assert_int_eq(fvi_trajectory(&fvi_variable_step, &run, x, p, NULL),
                         FVI_SUCCESS);
        truth(&run, at, at, &v);
        ck_assert_near(p[k], v + J, 1e-8, "at %g", at);
    }
}
END_TEST

/* A search starts with the wanted error: a coarse one is had beyond the alpha at which the
 * default tolerance is refused, and refused itself only where (22.23) refuses it. */
START_TEST(eq_22_22_a_search_asks_for_the_wanted_error)
{
    static const double orders[] = { 0.971, 0.973, 0.978, 0.985, 0.99, 0.995 };
    for (size_t i = 0; i < LEN(orders); i++)
        for (double wish = 1e-3; wish > 1e-7; wish /= 1000) {
            fvi_run run = hit_at(1.2837, orders[i], 40);
            fvi_variable_step_found found;
            const int status = fvi_variable_step_search(&run, 0, NULL, wish, 100000, x, NULL,
                                                   &found);
            run.step_error = wish / 10; /* that of the finer of two runs */
            fvi_stepper *s = NULL;
            ck_assert_int_eq(status, fvi_stepper_start(&fvi_variable_step, &run, &s,
                                                       NULL));
            fvi_stepper_free(s);
            for (size_t k = 0; !status && k <= 40; k++) {
                double v;
                const double t = (double)k * run.h;
                ck_assert_near(x[k], truth(&run, t, 1.2837, &v), wish,
                               "alpha = %g, t = %g", orders[i], t);
            }
        }
}
END_TEST

/* A copy in the step after an impulse goes on with the same digits. */
START_TEST(eq_22_22_a_copy_knows_the_impulses_that_have_acted)
{
    for (double alpha = 0.25; alpha < 1; alpha += 0.5) {
        const fvi_run run = hit_at(1.2837, alpha, 40);
        fvi_stepper *s, *copy;
        ck_assert_int_eq(fvi_stepper_start(&fvi_variable_step, &run, &s,
                                           NULL), FVI_SUCCESS);
        while (s->t < 1.2837)
            ck_assert_int_eq(fvi_stepper_step(s), FVI_SUCCESS);
        ck_assert(s->t == 1.2837);
        ck_assert_int_eq(fvi_stepper_copy(s, &copy), FVI_SUCCESS);
        while (s->t < 5) {
            ck_assert_int_eq(fvi_stepper_step(s), FVI_SUCCESS);
            ck_assert_int_eq(fvi_stepper_step(copy), FVI_SUCCESS);
            ck_assert(s->t == copy->t && s->x[0] == copy->x[0]
                      && s->p[0] == copy->p[0]);
        }
        fvi_stepper_free(s);
        fvi_stepper_free(copy);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("impulses that steps end at");
    ADD_CASE(suite, "steps of its own",
             eq_22_22_at_its_time_whatever_the_memory,
             eq_22_22_at_the_ends_and_at_a_row,
             eq_22_22_a_search_asks_for_the_wanted_error,
             eq_22_22_a_copy_knows_the_impulses_that_have_acted);
    return run_suite(suite);
}
