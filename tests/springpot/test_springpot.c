/* tests/springpot/test_springpot.c -- H 0: ladders behave like springpots.
 * Run alone: make test-springpot */
#include "../../figures/springpot/first_run.h"
#include "harness/ulp.h"

#include "springpot_ref.h"

static double x[ROWS + 1], p[ROWS + 1], other[ROWS + 1];

/* The creep under a force 1 after `doublings` times `count` steps, the first of them
 * 80 / 1024 / count long, then twice that, and so on; k = eta = 1. */
static double creep(double beta, int count, int doublings, double *t)
{
    ladder l = ladder_of_order(beta, 1, 1);
    double h = 80.0 / 1024 / count;
    *t = 0;
    for (int i = 0; i < doublings; i++, h *= 2)
        for (int n = 0; n < count; n++, *t += h)
            ladder_step(&l, h, 1);
    return l.x[0];
}

/* The force that is left on node j after a stage from `from` to y, with velocity v before it,
 * and the sum of the sizes of what should add up to nothing: (0.3), and for node 0 the
 * balance of the body. */
static double left_over(const ladder *l, const double *from, const double *y,
                        size_t j, double v, double h, double f, double *size)
{
    const double before = j > 0 ? y[j - 1] : 0,
                 behind = j + 1 < RUNGS ? y[j + 1] : 0,
                 k = j > 0 ? l->spring[j - 1] : 0, m = j > 0 ? 0 : l->m,
                 c = j > 0 ? 0 : l->c, rate = (y[j] - from[j]) / h;
    *size = (l->dashpot[j] + m / h) * (fabs(y[j]) + fabs(from[j])) / h
            + m / h * fabs(v) + (j > 0 ? 0 : fabs(f))
            + l->spring[j] * (fabs(y[j]) + fabs(behind))
            + k * (fabs(y[j]) + fabs(before)) + c * fabs(y[j]);
    return l->dashpot[j] * rate + m * (rate - v) / h - (j > 0 ? 0 : f)
           + l->spring[j] * (y[j] - behind) + k * (y[j] - before) + c * y[j];
}

/* A stage is right if nothing is left over. The elimination makes each of its numbers of a
 * few others by a sum or a quotient of positive terms, or by one difference of a term that
 * stands in the equation itself: 8 u of the size. Seen: 0.23 of that. */
START_TEST(eq_0_3_a_stage_solves_the_equations_of_all_nodes)
{
    for (int i = 1; i < 4; i++) {
        const double h = pow(10, -i), v = 0.5, f = 2, beta = 0.25 * i;
        ladder l = ladder_of_order(beta, 3, 2);
        l.m = i - 1, l.c = 1;
        double from[RUNGS], y[RUNGS], size;
        for (size_t j = 0; j < RUNGS; j++)
            from[j] = sin((double)(j * j));
        ladder_stage(&l, from, v, h, f, y);
        for (size_t j = 0; j < RUNGS; j++) {
            const double left = left_over(&l, from, y, j, v, h, f, &size);
            ck_assert_near(left, 0, 8 * U * size,
                           "beta = %g, h = %g, force left on node %zu", beta, h,
                           j);
        }
    }
}
END_TEST

/* (0.4), in time: 2 t e^-2t (I_0(2t) + I_1(2t)). The steps at t are t / (2 count) long, and
 * the method of order 2: 0.02 / count^2, relative. Seen: 0.21 of it. */
START_TEST(eq_0_4_a_ladder_creeps_as_its_bessel_functions)
{
    for (size_t i = 1; i < LEN(ref_creep); i++)
        for (int count = 40; count <= 160; count *= 2) {
            double t, got = creep(0.5, count, ref_creep[i].doublings, &t);
            ck_assert_near(t, ref_creep[i].t, 4e-13 * t, "the time");
            ck_assert_near(got / ref_creep[i].x, 1, 0.02 / count / count,
                           "t = %g, %d steps", t, count);
        }
}
END_TEST

/* (0.4), slow: the springpot of order 1/2, short of 1 / (16 t). The next term is below
 * 1 / t^2; the steps, as above. */
START_TEST(eq_0_4_a_slow_ladder_is_a_springpot)
{
    for (int doublings = 8; doublings <= 16; doublings += 4) {
        double t, got = creep(0.5, 160, doublings, &t);
        const double springpot = sqrt(t) / tgamma(1.5) / ladder_rho(0.5, 1, 1);
        ck_assert_near(got / springpot, 1 - 1 / (16 * t),
                       1 / (t * t) + 0.02 / 160 / 160, "t = %g", t);
        seen(1 - got / springpot, doublings == 16 ? "t = 5120" : "earlier");
    }
}
END_TEST

/* (0.5): graded ladders tend to their springpots; what is missing falls like
 * t^-min(beta, 1 - beta), which a wrong order or a wrong rho does not. Seen: 0.36 of that
 * power. */
START_TEST(eq_0_5_graded_ladders_are_springpots)
{
    const double betas[] = { 0.2, 0.25, 0.4, 0.6, 0.75, 0.8 };
    for (size_t i = 0; i < LEN(betas); i++) {
        const double beta = betas[i], rho = ladder_rho(beta, 1, 1);
        double before = 1;
        for (int doublings = 8; doublings <= 16; doublings += 4) {
            double t, got = creep(beta, 80, doublings, &t);
            const double missing =
                fabs(got * rho * tgamma(1 + beta) / pow(t, beta) - 1);
            const double power = pow(t, -smaller(beta, 1 - beta));
            ck_assert_near(missing, 0, 0.5 * power, "beta = %g, t = %g", beta,
                           t);
            ck_assert_double_lt(missing, 0.75 * before);
            before = missing;
        }
        seen(before, i == 1 ? "1/4" : i == 4 ? "3/4" : "others");
    }
}
END_TEST

/* (0.2): what a ladder gives back when the force goes. rho = 1, its time is 1/1000: at t it
 * is off by 1 / 16 of that over t, and over t - 1. */
START_TEST(eq_0_2_a_ladder_forgets_its_load_as_a_springpot)
{
    ladder l = ladder_of_order(0.5, sqrt(1000), sqrt(1000) / 1000);
    for (int n = 1; n <= 3000; n++) {
        ladder_step(&l, 0.001, n <= 1000 ? 1 : 0);
        const double t = 0.001 * n;
        if (n == 1000)
            ck_assert_near(l.x[0], 1 / tgamma(1.5), 1e-4, "loaded");
        if (n >= 1100 && n % 100 == 0)
            ck_assert_near(l.x[0], (sqrt(t) - sqrt(t - 1)) / tgamma(1.5), 1e-3,
                           "t = %g", t);
        if (n == 3000)
            seen(l.x[0] * tgamma(1.5), "kept at t = 3");
    }
}
END_TEST

/* (0.6): a body on the ladder, 600 ordinary equations, moves as the run of the library,
 * whose damping is a fractional derivative. A ladder of time 1/1000 is off by a share of
 * 1/8000 of the damping at the frequency 1 (0.4), a step 1/200 by less: 2e-4. */
START_TEST(eq_0_6_a_body_on_a_ladder_moves_as_the_run)
{
    double worst = 0;
    ladder l = first_ladder(1, 0);
    ck_assert_int_eq(first_run(1, 0, x, p), FVI_SUCCESS);
    for (int n = 1; n <= ROWS; n++) {
        ladder_step(&l, STEP, 0);
        ck_assert_near(l.x[0], x[n], 2e-4, "x, t = %g", STEP * n);
        ck_assert_near(l.v, p[n], 2e-3, "p, t = %g", STEP * n);
        worst = larger(worst, fabs(l.x[0] - x[n]));
    }
    seen(worst, "difference");
}
END_TEST

/* The same x and p at t = 2.8, with other rungs or another history: another motion, and
 * the same one for the ladder and the library. */
START_TEST(eq_0_6_the_past_is_part_of_the_state)
{
    double apart = 0;
    ladder l = first_ladder(1, 0);
    ck_assert_int_eq(first_run(1, 0, x, p), FVI_SUCCESS);
    for (int n = 0; n < FORK; n++)
        ladder_step(&l, STEP, 0);
    ladder fresh = first_ladder(l.x[0], l.v);
    ck_assert_int_eq(first_run(x[FORK], p[FORK], other, p), FVI_SUCCESS);
    for (int n = 1; FORK + n <= ROWS; n++) {
        ladder_step(&fresh, STEP, 0);
        ck_assert_near(fresh.x[0], other[n], 4e-4, "t = %g", STEP * (FORK + n));
        apart = larger(apart, fabs(other[n] - x[FORK + n]));
    }
    ck_assert_double_gt(apart, 0.25);
    seen(apart, "apart");
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("00 springpot");
    ADD_CASE(suite, "a stage",
             eq_0_3_a_stage_solves_the_equations_of_all_nodes);
    ADD_CASE(suite, "ladders", eq_0_4_a_ladder_creeps_as_its_bessel_functions,
             eq_0_4_a_slow_ladder_is_a_springpot,
             eq_0_5_graded_ladders_are_springpots,
             eq_0_2_a_ladder_forgets_its_load_as_a_springpot);
    ADD_CASE(suite, "bodies", eq_0_6_a_body_on_a_ladder_moves_as_the_run,
             eq_0_6_the_past_is_part_of_the_state);
    return run_suite(suite);
}
