/* tests/step_search/test_step_search_still.c -- H 18: a spring that no step
 * resolves. Run alone: make test-step_search_still */
#include <fvi/fvi.h>
#include "run/whole_run.h"
#include "harness/ulp.h"

#include "step_search_ref.h"

#include <gsl/gsl_math.h>

/* x_k = cos(k phi). A step is a turn in the plane of x and p/sqrt(mc), so that errors
 * add up. Those of x: the increment, at most 2, is off by 6 u, the sum by 1 u, and the
 * error of W, 3 u, turns phi by at most 1.5 u: 10 u a step. Half of the increment's
 * error, 3 u, goes into the gradient and so, times h c, into p: 3 sqrt(W) u in this plane.
 * j steps later |sin(j phi)| <= 4 j / sqrt(W) of that is in x. Seen: 0.23 of the bound. */
START_TEST(eq_18_6_a_stiff_spring_turns_by_almost_half_a_turn)
{
    const fvi_method *const methods[] = { &fvi_fractional, &fvi_cq2_shifted,
                                          &fvi_cq_bdf2, &fvi_lagrange_dalembert };
    const double one = 1, none = 0;
    for (size_t i = 0; i < LEN(ref_turns) * LEN(methods); i++) {
        const fvi_method *method = methods[i % LEN(methods)];
        const size_t row = i / LEN(methods), N = ref_turns[row].k;
        double c = ref_turns[row].c, x[641];
        const fvi_system system = { 1,     &one,
                                    &none, fvi_potential_harmonic(&c),
                                    { 0 }, NULL, NULL };
        const fvi_run run =
            fvi_run_default(&system, &one, &none, ref_turns[row].h, N);
        ck_assert_int_eq(fvi_trajectory(method, &run, x, NULL, NULL), 0);
        const double n = (double)N, W = c * gsl_pow_2(run.h);
        const double bound = 10 * n + 3 * smaller(sqrt(W) * n, 2 * n * (n + 1));
        ck_assert_near(x[N], ref_turns[row].x, bound * U,
                       "%s, c=%g, h=%g, k=%zu", method->name, c,
                       ref_turns[row].h, N);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("the search for a step: what stands still");
    ADD_CASE(suite, "values",
             eq_18_6_a_stiff_spring_turns_by_almost_half_a_turn);
    return run_suite(suite);
}
