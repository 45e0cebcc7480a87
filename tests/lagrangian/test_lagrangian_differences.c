/* tests/lagrangian/test_lagrangian_differences.c -- H 29: a body on a strut, by an action and by differences of the
 * same order: the quantities that the action conserves. [chapters/further/29-lagrangian.md]
 * Run alone: make test-lagrangian_differences */
#define STAGE "course/body_13.c"
#include "course/stage.h"
#include "strut_differences.h"
#include "run/whole_run.h"
#include "system/larger.h"

enum { LONG = 2000 };

/* The exact motion at t = 8, by four stages and 320 steps. Twice as many steps change x by 1.1e-13. */
static void find_truth(double *at)
{
    static const char *const along_spring[] = { "sqrt(x1^2+x2^2) : power:0.1,0.3" };
    const fvi_mechanism_texts texts = { .lagrangian = "(v1^2+v2^2)/2 - 2*(sqrt(x1^2+x2^2)-1)^2",
                                        .dampers = 1,
                                        .damper = along_spring };
    static double rows[321 * DIM];
    fvi_typed_mechanism *typed;
    ck_assert_int_eq(fvi_parse_mechanism(&texts, DIM, NULL, &typed, NULL), FVI_SUCCESS);
    const fvi_system system = { .d = DIM, .mechanism = fvi_mechanism_typed(typed) };
    const fvi_run settings = fvi_run_default(&system, x0, p0, 8.0 / 320, 320);
    ck_assert_int_eq(fvi_trajectory(&fvi_lobatto_m4, &settings, rows, NULL, NULL), FVI_SUCCESS);
    fvi_typed_mechanism_free(typed);
    at[0] = rows[320 * DIM], at[1] = rows[320 * DIM + 1];
}

/* Neither method is a straw man: with h and h/2, the distance from the truth at t = 8 falls by 4.
 * Seen: the order is off 2 by at most 0.015, as further terms of the error fall faster. */
START_TEST(both_have_the_order_two)
{
    double truth[DIM], error[2][2];
    find_truth(truth);
    for (int i = 0; i < 2; i++) {
        h = 0.02 / (1 << i);
        int N = 400 << i;
        run(N), run_differences(N);
        error[0][i] = hypot(x[N][0] - truth[0], x[N][1] - truth[1]);
        error[1][i] = hypot(x_differenced[N][0] - truth[0], x_differenced[N][1] - truth[1]);
    }
    for (int i = 0; i < 2; i++) {
        const char *name = i ? "differences" : "action";
        seen(error[i][0], name);
        ck_assert_near(log2(error[i][0] / error[i][1]), 2, 0.1, "order, %s", name);
    }
    h = 0.05;
}
END_TEST

/* The figure: h = 0.2, t = 400. A damper along the spring stops the swing, and a circle is left. On it
 * 4 (r - 1) r^3 = J^2 with J = 0.96, so r = 1.15107 and E = J^2/2r^2 + 2 (r - 1)^2 = 0.393428. At t = 400 the damper still
 * pulls, rho t^-0.6 times its elongation, and holds r off by 0.002. E is least on the circle, so it is off by half of its
 * curvature 5.6 times 0.002^2, which is 1.2e-5. A step of the action rounds as in stage 13. What the differences lose is
 * no truth: these two numbers are those of the figure and of H 29. */
START_TEST(what_turns_for_long)
{
    double most = 0;
    h = 0.2;
    run(LONG), run_differences(LONG);
    for (int k = 1; k <= LONG; k++)
        most = larger(most, fabs(turning(k) - turning(0)));
    seen(most, "drift of the action");
    ck_assert(most < 1e-12);
    ck_assert_near(energy(LONG), 0.39344, 2e-5, "energy, action");
    seen(1 - turning_differenced(LONG) / turning(0), "lost by differences");
    seen(energy_differenced(LONG), "energy by differences");
    ck_assert_near(turning_differenced(LONG), 0.713, 1e-3, "angular momentum, differences");
    ck_assert_near(energy_differenced(LONG), 0.230, 1e-3, "energy, differences");
    h = 0.05;
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("an action and differences");
    ADD_CASE(suite, "a body on a strut", both_have_the_order_two, what_turns_for_long);
    return run_suite(suite);
}
