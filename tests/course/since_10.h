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

#endif
