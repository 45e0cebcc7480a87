/* tests/course/test_body_13.c -- The Course, stage 13: a damper along any length. */
#ifndef STAGE
#define STAGE "course/body_13.c"
#endif
#include "stage.h"
#include "course_strut_ref.h"
#include "system/larger.h"

enum { ROWS = 400 };

/* Ten steps against 50 digits. A step rounds some 60 numbers of at most 1.3, and p has m/h = 20
 * times the error of x. */
START_TEST(eq_29_6_ten_steps)
{
    for (size_t i = 0; i < LEN(ref_strut); i++) {
        const int k = ref_strut[i].k;
        const double bound = 60 * k * ROUNDING;
        strut = ref_strut[i].strut, alpha = ref_strut[i].alpha;
        run(k);
        for (int j = 0; j < DIM; j++) {
            ck_assert_near(x[k][j], ref_strut[i].x[j], bound, "strut %d, x, k = %d", strut, k);
            ck_assert_near(p[k][j], ref_strut[i].p[j], 20 * bound, "strut %d, p, k = %d", strut, k);
        }
        ck_assert_near(work[k], ref_strut[i].work, bound, "strut %d, work, k = %d", strut, k);
    }
    alpha = 0.3;
}
END_TEST

/* The library's fvi_cq2_midpoint of the same texts, row by row. */
START_TEST(eq_29_6_the_library_makes_the_same_run)
{
    static const char *const along_spring[] = { "sqrt(x1^2+x2^2) : power:0.1,0.3" };
    static const char *const along_axes[] = { "x1 : power:0.1,0.3", "x2 : power:0.1,0.3" };
    for (strut = 0; strut <= 1; strut++) {
        const fvi_mechanism_texts texts = { .lagrangian = "(v1^2+v2^2)/2 - 2*(sqrt(x1^2+x2^2)-1)^2",
                                            .dampers = strut ? 1 : 2,
                                            .damper = strut ? along_spring : along_axes };
        fvi_typed_mechanism *typed;
        ck_assert_int_eq(fvi_parse_mechanism(&texts, DIM, NULL, &typed, NULL), FVI_SUCCESS);
        const fvi_system system = { .d = DIM, .mechanism = fvi_mechanism_typed(typed) };
        const fvi_run settings = fvi_run_default(&system, x0, p0, h, ROWS);
        fvi_stepper *s;
        ck_assert_int_eq(fvi_stepper_start(&fvi_cq2_midpoint, &settings, &s, NULL), FVI_SUCCESS);
        run(ROWS);
        double sum = 0;
        for (int k = 1; k <= ROWS; k++) {
            ck_assert_int_eq(fvi_stepper_step(s), FVI_SUCCESS);
            for (int j = 0; j < DIM; j++) {
                ck_assert_near(x[k][j], s->x[j], 1e-12, "strut %d, x, k = %d", strut, k);
                ck_assert_near(p[k][j], s->p[j], 1e-12, "strut %d, p, k = %d", strut, k);
            }
        }
        for (size_t j = 0; j < texts.dampers; j++) {
            double part;
            ck_assert_int_eq(fvi_stepper_damper(s, j, NULL, &part), FVI_SUCCESS);
            sum += part;
        }
        ck_assert_near(work[ROWS], sum, 1e-12, "strut %d, work", strut);
        fvi_stepper_free(s);
        fvi_typed_mechanism_free(typed);
    }
    strut = 1;
}
END_TEST

/* The strut takes energy and no angular momentum: 1200 steps walk 35 roundings of 0.96, each of some
 * ten operations. Two dampers along the axes leave nothing of it. */
START_TEST(eq_29_14_a_strut_turns_nothing)
{
    double most = 0;
    run(1200);
    for (int k = 1; k <= 1200; k++)
        most = larger(most, fabs(turning(k) - turning(0)));
    seen(most, "drift");
    ck_assert(most < 1e-13);
    ck_assert_near(energy(1200), 0.395, 0.0005, "energy");
    strut = 0;
    run(1200);
    seen(turning(1200) - turning(0), "along the axes");
    ck_assert(turning(1200) < 0.01 && turning(240) < 0.3);
    strut = 1;
}
END_TEST

/* Axes that are turned are the same two dampers: their slopes turn alike. The curves of the program
 * cannot be turned, but the body and its axes can: it starts turned by a right angle. */
START_TEST(axes_are_two_equal_dampers)
{
    static double first[ROWS + 1][DIM];
    strut = 0;
    run(ROWS);
    for (int k = 0; k <= ROWS; k++)
        first[k][0] = x[k][0], first[k][1] = x[k][1];
    x0[0] = 0, x0[1] = 1.2, p0[0] = -0.8, p0[1] = 0.3;
    run(ROWS);
    for (int k = 0; k <= ROWS; k++) {
        ck_assert_near(x[k][0], -first[k][1], 1e-13, "k = %d", k);
        ck_assert_near(x[k][1], first[k][0], 1e-13, "k = %d", k);
    }
    strut = 1, x0[0] = 1.2, x0[1] = 0, p0[0] = 0.3, p0[1] = 0.8;
}
END_TEST

/* (29.11): up to every step, for rough steps and laws of every order below 1. */
START_TEST(eq_29_11_no_damper_gives)
{
    for (strut = 0; strut <= 1; strut++)
        for (alpha = 0.1; alpha < 0.5; alpha += 0.15)
            for (h = 0.05; h < 0.5; h *= 2) {
                run(ROWS);
                for (int k = 0; k <= ROWS; k++)
                    ck_assert_msg(work[k] >= 0, "strut %d, alpha %g, h %g: %g", strut, alpha, h, work[k]);
            }
    strut = 1, alpha = 0.3, h = 0.05;
}
END_TEST

/* x at t = 4 for h = 1/80, 1/160, 1/320. */
START_TEST(eq_29_6_order_two)
{
    double at[3];
    for (int i = 0; i < 3; i++) {
        h = 1.0 / (80 << i);
        run(320 << i);
        at[i] = x[320 << i][0];
    }
    ck_assert_near(log2((at[0] - at[1]) / (at[1] - at[2])), 2, 0.01, "order");
    h = 0.05;
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("stage 13");
    ADD_CASE(suite, "a damper along any length", eq_29_6_ten_steps, eq_29_6_the_library_makes_the_same_run, eq_29_14_a_strut_turns_nothing, axes_are_two_equal_dampers, eq_29_11_no_damper_gives, eq_29_6_order_two);
    return run_suite(suite);
}
