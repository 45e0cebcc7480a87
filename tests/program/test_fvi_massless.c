/* tests/program/test_fvi_massless.c -- The program build/fvi: coordinates without mass.
 * Run alone: make test-fvi_massless */
#define _GNU_SOURCE
#include "program.h"

/* x + D^q x = 0 from 1 is Mittag-Leffler's E_q(-t^q); for q = 1/2 it is exp(t) erfc(sqrt t), the others are its
 * integral over the cut of the symbol, by mpmath. A force 1 until 2.3 gives E_q(-2.7^q) - E_q(-5^q) at t = 5. */
static const struct {
    double q, at_5, at_27;
} relaxation[] = {
    { 0.1, 0.44537684290667180, 0.46070757001927228 },
    { 0.2, 0.39101477456746503, 0.42122903939713778 },
    { 0.5, 0, 0 },
    { 0.6, 0.18200051379323620, 0.25721592659977623 },
};

static double mittag_leffler(size_t i, double t)
{
    return relaxation[i].q == 0.5 ? exp(t) * erfc(sqrt(t))
           : t == 5               ? relaxation[i].at_5
                                  : relaxation[i].at_27;
}

/* The motion is as t^q at first, and behind each jump of the force: steps are then as short as the error asks. */
START_TEST(eq_29_15_a_springpot_without_mass_keeps_every_tolerance)
{
    static const double errors[] = { 1e-6, 1e-9, 1e-12 };
    char line[300];
    for (size_t i = 0; i < LEN(relaxation) * LEN(errors); i++) {
        const size_t which = i / LEN(errors);
        const double q = relaxation[which].q, error = errors[i % LEN(errors)],
                     bound = 3 * error, at_5 = mittag_leffler(which, 5), at_27 = mittag_leffler(which, 2.7);
        snprintf(line, sizeof line, "run --mass 0 --order %g --rho 1 --x0 1 --p0 0 --time 5 --steps 2 "
                 "--columns x,p --step-error %g", q, error);
        ck_assert_msg(fvi(line) == 0, "%s: %s", line, err);
        ck_assert_near(cell(2, 0), at_5, bound, "order %g to %g", q, error);
        ck_assert(cell(2, 1) == 0);
        snprintf(line, sizeof line, "run --mass 0 --order %g --rho 1 --x0 0 --p0 0 --time 5 --steps 2 "
                 "--columns x,p --step-error %g --force step:1,2.3", q, error);
        ck_assert_msg(fvi(line) == 0, "%s: %s", line, err);
        ck_assert_near(cell(2, 0), at_27 - at_5, bound, "order %g to %g", q, error);
    }
    ck_assert_int_eq(fvi("run --mass 0 --order 0.4 --rho 1 --x0 1 --p0 0 --time 5 --steps 2 --columns x "
                         "--error 1e-11"),
                     0);
    ck_assert_near(cell(2, 0), 0.28418004448661884, 1e-11, "by its own steps");
}
END_TEST

/* Where it cannot be, that is what is said. */
START_TEST(an_order_near_0_without_mass_is_refused_by_name)
{
    ck_assert_refused("run --mass 0 --damper 'x : power:1,0.01' --x0 1 --p0 0 --step-error 1e-9",
                      "fvi: --damper: no step is short enough for this error: an order is too near to 2 "
                      "behind a velocity that jumps, or to 0 at a coordinate without mass");
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("the program fvi: no mass");
    ADD_CASE(suite, "massless", eq_29_15_a_springpot_without_mass_keeps_every_tolerance,
             an_order_near_0_without_mass_is_refused_by_name);
    return run_suite_of_program(suite);
}
