/* tests/course/since_06.h -- What stage 6 and every later stage must do. */
#ifndef SINCE_06_H
#define SINCE_06_H

/* The steps by hand: with kappa = 1 dyadic fractions, which do not round; with 1/2 each step
 * rounds some 16 times. */
START_TEST(eq_6d_the_steps_by_hand)
{
    for (size_t i = 0; i < LEN(ref_by_hand); i++) {
        h = 1, kappa = ref_by_hand[i].kappa;
        run(5);
        for (int k = 0; k <= 5; k++) {
            double bound = kappa == 1 ? 0x1p-1074 : 16 * (k + 1) * ROUNDING;
            ck_assert_near(x[k], ref_by_hand[i].x[k], bound, "x_%d, kappa = %g", k, kappa);
            ck_assert_near(p[k], ref_by_hand[i].p[k], bound, "p_%d, kappa = %g", k, kappa);
        }
    }
}
END_TEST

/* Seven orders against 50 digits. */
START_TEST(eq_6d_seven_alphas)
{
    h = 0.1, kappa = 0.5;
    for (size_t i = 0; i < LEN(ref_seven); i++) {
        alpha = ref_seven[i].alpha;
        run(140);
        double bound = rounding_of_run(140, h * 0.5 * pow(h, -2 * alpha));
        ck_assert_near(x[ref_seven[i].k], ref_seven[i].x, bound, "alpha = %g", alpha);
        ck_assert_near(p[ref_seven[i].k], ref_seven[i].p, bound, "alpha = %g", alpha);
    }
    alpha = 0.25;
}
END_TEST

#endif
