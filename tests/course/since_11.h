/* tests/course/since_11.h -- What stage 11 and every later stage must do. */
#ifndef SINCE_11_H
#define SINCE_11_H

#include "since_10.h"

/* The modes stand for the weights of the lags beyond NEAR: to 1e-8 of each, for all orders
 * between. (The rule's step of .3 alone gives exp(-2 pi (pi/2) / .3) < 1e-14; the modes left
 * out below log s = -log N - 28 give the rest, most at small orders and large lags.) */
START_TEST(eq_11b_modes_are_weights)
{
    for (double b = 0.1; b < 0.95; b += 0.1) {
        weights(b, 20001);
        make_modes(b, 20000);
        for (int n = NEAR + 1; n <= 20000; n = n * 3 / 2) {
            double sum = 0;
            for (int q = 0; q < modes; q++)
                sum += share[q] * exp(-(n - NEAR - 1) * -log(decay[q]));
            ck_assert_near(sum, w[n], 1e-8 * fabs(w[n]), "order %g, lag %d", b, n);
        }
    }
}
END_TEST

/* Both sums make the same run; what the modes lose is far below the first digits. */
START_TEST(eq_11c_modes_make_the_same_run)
{
    kappa = 0.5;
    for (alpha = 0.05; alpha < 1; alpha += 0.1) {
        fast = 0;
        double sums = at(20, 4000);
        fast = 1;
        ck_assert_near(at(20, 4000), sums, 1e-11, "alpha = %g", alpha);
    }
    fast = 0, alpha = 0.25;
}
END_TEST

#endif
