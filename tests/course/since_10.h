/* tests/course/since_10.h -- What stage 10 and every later stage must do. */
#ifndef SINCE_10_H
#define SINCE_10_H

#include "since_06.h"

/* Order 1, and 2 at alpha = 0, where nothing comes late: on both sides. */
START_TEST(eq_10b_the_orders)
{
    kappa = 0.5;
    for (alpha = 0; alpha <= 1; alpha += 0.25) {
        double one = at(2, 640), two = at(2, 1280), four = at(2, 2560);
        ck_assert_near(log2((one - two) / (two - four)), alpha == 0 ? 2 : 1, 0.005, "alpha = %g", alpha);
    }
    alpha = 0.25;
}
END_TEST

/* At alpha = 1/2 the three pasts are one, for a body that starts with a momentum, too: a constant
 * that is subtracted from all places drops out of a difference. */
START_TEST(eq_8b_three_pasts_are_one_at_one_half)
{
    static double held[201];
    alpha = 0.5, kappa = 0.5, p0 = 0.5, h = 0.01;
    for (past = HELD; past <= RL; past++) {
        run(200);
        for (int k = 0; k <= 200; k++)
            if (past == HELD)
                held[k] = x[k];
            else
                ck_assert_near(x[k], held[k], rounding_of_run(200, 0.5), "past %d, k = %d", past, k);
    }
    past = HELD, p0 = 0, alpha = 0.25;
}
END_TEST

#endif
