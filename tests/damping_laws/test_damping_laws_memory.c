/* tests/damping_laws/test_damping_laws_memory.c -- H 26: the memory of a law, by its
 * weights and by its modes.
 * Run alone: make test-damping_laws_memory */
#include <fvi/fvi.h>
#include "../../figures/damping_laws/creep.h"
#include "harness/ulp.h"

#include "damping_laws_ref.h"
#include "function_of_law.h"
#include "random_laws.h"

/* What a memory makes of random terms with first taken in again, in `H`. */
static void sums(const fvi_kernel *law, fvi_delta kind, double h,
                 size_t steps, fvi_history_kind how, const double *x, double *H)
{
    fvi_history *memory;
    double first;
    ck_assert_int_eq(
        fvi_kernel_history(law, kind, h, 1, steps, how, 0, &first, &memory),
        FVI_SUCCESS);
    for (size_t k = 0; k <= steps; k++) {
        const double dx = k ? x[k] - x[k - 1] : x[0];
        fvi_history_push(memory, &x[k], &dx, &H[k]);
        H[k] *= first;
    }
    fvi_history_free(memory);
}

/* The direct sum, from the weights: of k + 1 products, none above w_0 max |x|, and on
 * increments as much again. Seen by the worst of eight laws. */
START_TEST(eq_26_4_the_memory_sums_the_weights)
{
    enum { STEPS = 200 };
    double x[STEPS + 1], w[STEPS + 1], H[STEPS + 1];
    srand(2);
    for (size_t k = 0; k <= STEPS; k++)
        x[k] = random_in(-1, 1);
    for (size_t i = 0; i < LEN(ref_laws); i++)
        for (int kind = 0; kind < 2; kind++) {
            const fvi_delta q = (fvi_delta)kind;
            fvi_kernel_weights(&ref_laws[i], q, 0.01, STEPS + 1, w);
            sums(&ref_laws[i], q, 0.01, STEPS, FVI_HISTORY_DIRECT, x, H);
            for (size_t k = 0; k <= STEPS; k++) {
                double sum = 0;
                for (size_t n = 0; n <= k; n++)
                    sum += w[n] * x[k - n];
                ck_assert_near(H[k], sum, 4 * (STEPS + 60) * U * fabs(w[0]),
                               "law %zu, k = %zu", i, k);
            }
        }
}
END_TEST

/* A body at rest at 1: of (1-z)^1.6 / (1-z) the weights of (1-z)^0.6 are left, which fall
 * from 1 to 2e-6. Increments are 0 after the first, and so nothing is summed that cancels:
 * 60 u for a weight, its power of h and the product, and the 1e-14 of its mode. Seen: 0.18
 * of that. */
START_TEST(eq_26_4_what_rests_is_summed_to_all_digits)
{
    enum { STEPS = 3000 };
    static double x[STEPS + 1], H[STEPS + 1], w[STEPS + 1];
    const fvi_kernel_term term = { FVI_KERNEL_POWER, 1, 0.8, 0, 0 };
    const fvi_history_kind kinds[] = { FVI_HISTORY_DIRECT,
                                      FVI_HISTORY_MODES };
    for (size_t k = 0; k <= STEPS; k++)
        x[k] = 1;
    fvi_gl_weights(0.6, STEPS + 1, w);
    for (size_t i = 0; i < LEN(kinds); i++) {
        sums(&(fvi_kernel){ 1, &term }, FVI_DELTA_EULER, 0.01, STEPS,
             kinds[i], x, H);
        for (size_t k = 0; k <= STEPS; k++) {
            const double want = pow(0.01, -1.6) * w[k];
            ck_assert_near(H[k], want, (60 * U + (i ? 1e-14 : 0)) * fabs(want),
                           "kind %zu, k = %zu", i, k);
        }
    }
}
END_TEST

/* What the figure draws, by 1000 steps of BDF2, against (26.14): the steps see a jump at
 * t = 0, which leaves 1/1000 at most. Seen: 8e-4. */
START_TEST(eq_26_14_a_law_relaxes_and_creeps)
{
    for (double t = 1e-3; t < 4; t *= 3) {
        const double rho = 0.75, time = 1.5;
        double force, stretch;
        for (double a = 0.05; a < 0.46; a += 0.1) {
            const fvi_kernel_term power = { FVI_KERNEL_POWER, rho, a, 0, 0 };
            ck_assert_int_eq(relaxation_and_creep(&(fvi_kernel){ 1, &power }, t,
                                                  &force, &stretch),
                             0);
            const double G = rho * pow(t, -2 * a) / tgamma(1 - 2 * a),
                         J = pow(t, 2 * a) / (rho * tgamma(1 + 2 * a));
            ck_assert_near(force, G, 1e-3 * G, "a %g t %g", a, t);
            ck_assert_near(stretch, J, 1e-3 * J, "a %g t %g", a, t);
        }
        const fvi_kernel_term maxwell = { FVI_KERNEL_MAXWELL, rho, 0, time, 0 };
        ck_assert_int_eq(relaxation_and_creep(&(fvi_kernel){ 1, &maxwell }, t,
                                              &force, &stretch),
                         0);
        const double G = rho / time * exp(-t / time), J = (t + time) / rho;
        ck_assert_near(force, G, 1e-3 * G, "Maxwell, t %g", t);
        ck_assert_near(stretch, J, 1e-3 * J, "Maxwell, t %g", t);
    }
}
END_TEST

/* (26.6), (26.7): one set of modes. A unit impulse comes back as the weights, each kept
 * to 1e-13 of what the sums of the moduli of all terms' weights are; here of w_0, times
 * (1 + n)^(-1/2), for 200 random laws. Seen: see make seen. */
START_TEST(eq_26_6_one_set_of_modes)
{
    enum { STEPS = 3000 };
    static double x[STEPS + 1], direct[STEPS + 1], modes[STEPS + 1];
    size_t ran = 0;
    x[0] = 1;
    srand(3);
    for (int i = 0; i < 200; i++) {
        fvi_kernel_term term[3];
        const fvi_kernel law = { random_terms(term), term };
        const fvi_delta kind = (fvi_delta)(i % 2);
        const double h = pow(10, random_in(-4, -1.7)); /* 4 h <= time */
        sums(&law, kind, h, STEPS, FVI_HISTORY_DIRECT, x, direct);
        sums(&law, kind, h, STEPS, FVI_HISTORY_MODES, x, modes);
        for (size_t k = 0; k <= STEPS; k++)
            ck_assert_near(modes[k], direct[k],
                           1e-13 * direct[0] / sqrt((double)k + 1),
                           "law %d, n = %zu", i, k);
        ran++;
    }
    ck_assert_uint_eq(ran, 200);
}
END_TEST

/* Of laws with orders up to 1 every weight is kept to 1e-13 of itself, however far it has
 * fallen off. (Of a higher order sums are kept, which pass through zero. With BDF2 the
 * weights of a Maxwell element, 1e-9 of the first in the end, are as exact by their modes,
 * and not as they are divided out.) Seen: 5e-14. */
START_TEST(eq_26_6_every_weight_to_all_its_digits)
{
    enum { STEPS = 4000 };
    static double x[STEPS + 1], direct[STEPS + 1], modes[STEPS + 1];
    x[0] = 1;
    for (size_t l = 0; l < 5; l++)
        for (int kind = 0; kind < (l == 3 ? 1 : 2); kind++)
            for (double h = 0.01; h > 1e-4; h /= 10) {
                sums(&ref_laws[l], (fvi_delta)kind, h, STEPS,
                     FVI_HISTORY_DIRECT, x, direct);
                sums(&ref_laws[l], (fvi_delta)kind, h, STEPS,
                     FVI_HISTORY_MODES, x, modes);
                for (size_t k = 0; k <= STEPS; k++)
                    ck_assert_near(modes[k], direct[k], 1e-13 * fabs(direct[k]),
                                   "law %zu, n = %zu", l, k);
            }
}
END_TEST

/* An order next to 0 is a spring, or almost one: GSL is not asked for Gamma at its pole, where its
 * handler would end the process, and the modes sum what the weights sum. */
START_TEST(eq_26_6_an_order_next_to_zero_is_a_spring)
{
    enum { STEPS = 2000 };
    static double x[STEPS + 1], direct[STEPS + 1], modes[STEPS + 1];
    static const fvi_kernel_term small[] = {
        { FVI_KERNEL_POWER, 1, 1e-20, 0, 0 },
        { FVI_KERNEL_POWER, 1, 5e-324, 0, 0 },
        { FVI_KERNEL_POWER, 1, 0x1p-55, 0, 0 },
        { FVI_KERNEL_POWER, 1, 3e-17, 0, 0 },
        { FVI_KERNEL_POWER, 1, 5.6e-17, 0, 0 }, /* from here on the nodes begin far below those of */
        { FVI_KERNEL_POWER, 1, 1e-12, 0, 0 },   /* the other term, and end where its nodes do */
        { FVI_KERNEL_POWER, 1, 1e-8, 0, 0 },
        { FVI_KERNEL_POWER, 1, 1e-6, 0, 0 },
        { FVI_KERNEL_ZENER, 1, 1e-20, 0.5, 0 },
        { FVI_KERNEL_ZENER, 1, 1e-20, 5, 0 },
        { FVI_KERNEL_MAXWELL2, 1, 1e-20, 2, 0 },
        { FVI_KERNEL_DISTRIBUTED, 1e20, 0, 0, 1e-20 },
    };
    for (size_t k = 0; k <= STEPS; k++)
        x[k] = 1; /* what rests feels the springs alone in the end */
    for (size_t i = 0; i < LEN(small); i++)
        for (int kind = 0; kind < 2; kind++) {
            const fvi_kernel_term term[] = {
                small[i], { FVI_KERNEL_POWER, 1, 0.9, 0, 0 }
            };
            const fvi_kernel law = { 2, term };
            sums(&law, (fvi_delta)kind, 1, STEPS, FVI_HISTORY_DIRECT, x,
                 direct);
            sums(&law, (fvi_delta)kind, 1, STEPS, FVI_HISTORY_MODES, x, modes);
            for (size_t k = 0; k <= STEPS; k++)
                ck_assert_near(modes[k], direct[k], 1e-13, "law %zu, k = %zu",
                               i, k);
            const double spring = small[i].rho == 1 ? 1 / (1 + small[i].time) : 1;
            ck_assert_near(modes[STEPS], spring, 1e-4, "law %zu", i);
        }
}
END_TEST

/* AUTO takes modes beyond 256 steps, and the sum as it stands where there are none. */
START_TEST(eq_26_6_where_there_are_no_modes)
{
    const struct {
        fvi_kernel_term term;
        fvi_delta kind;
        double h;
        int modes;
    } cases[] = {
        { { FVI_KERNEL_ZENER, 1, 0.45, 1, 0 }, FVI_DELTA_EULER, 0.1, 1 },
        { { FVI_KERNEL_ZENER, 1, 0.46, 1, 0 }, FVI_DELTA_EULER, 0.1, 0 },
        { { FVI_KERNEL_ZENER, 1, 0.8, 1, 0 }, FVI_DELTA_EULER, 0.1, 0 },
        { { FVI_KERNEL_ZENER, 1, 1, 1, 0 }, FVI_DELTA_EULER, 0.1, 0 },
        { { FVI_KERNEL_ZENER, 1, 1, 0, 0 }, FVI_DELTA_EULER, 0.1, 1 },
        { { FVI_KERNEL_ZENER, 1, 0.45, 1, 0 }, FVI_DELTA_EULER, 0.65, 1 },
        { { FVI_KERNEL_ZENER, 1, 0.45, 1, 0 }, FVI_DELTA_BDF2, 0.25, 1 },
        { { FVI_KERNEL_ZENER, 1, 0.45, 1, 0 }, FVI_DELTA_BDF2, 0.26, 0 },
        { { FVI_KERNEL_ZENER, 1, 0.4, 1, 0 }, FVI_DELTA_BDF2, 0.65, 1 },
        { { FVI_KERNEL_ZENER, 1, 0.02, 10, 0 }, FVI_DELTA_EULER, 0.1, 1 },
        { { FVI_KERNEL_ZENER, 1, 0.001, 10, 0 }, FVI_DELTA_EULER, 0.1, 0 },
        { { FVI_KERNEL_ZENER, 1, 0.8, 0, 0 }, FVI_DELTA_EULER, 0.1, 1 },
        { { FVI_KERNEL_MAXWELL, 1, 0, 1, 0 }, FVI_DELTA_EULER, 10, 1 },
        { { FVI_KERNEL_MAXWELL, 1, 0, 1, 0 }, FVI_DELTA_BDF2, 0.25, 1 },
        { { FVI_KERNEL_MAXWELL, 1, 0, 1, 0 }, FVI_DELTA_BDF2, 0.26, 0 },
    };
    enum { STEPS = 400 };
    double x[STEPS + 1] = { 1 }, H[2][STEPS + 1], first = 7;
    for (size_t i = 0; i < LEN(cases); i++) {
        const fvi_kernel law = { 1, &cases[i].term };
        fvi_history *memory = NULL;
        const int status =
            fvi_kernel_history(&law, cases[i].kind, cases[i].h, 1, STEPS,
                           FVI_HISTORY_MODES, 0, &first, &memory);
        ck_assert_int_eq(status, cases[i].modes ? FVI_SUCCESS : FVI_EUNSUP);
        ck_assert((memory != NULL) == cases[i].modes);
        fvi_history_free(memory);
        sums(&law, cases[i].kind, cases[i].h, STEPS, FVI_HISTORY_AUTO, x, H[0]);
        sums(&law, cases[i].kind, cases[i].h, STEPS, FVI_HISTORY_DIRECT, x,
             H[1]);
        for (size_t k = 0; k <= STEPS; k++)
            ck_assert_near(H[0][k], H[1][k],
                           (cases[i].modes ? 1e-13 : 0x1p-1000) * H[1][0],
                           "case %zu, n = %zu", i, k);
    }
}
END_TEST

/* A function of s has modes by its values on the cut, as far as the weights confirm them: the
 * memory of a law is that of its function, to 1e-13 of the largest weight. Where the cut does
 * not tell all, MODES is refused and AUTO sums the weights. */
START_TEST(eq_26_16_the_memory_of_a_function)
{
    enum { STEPS = 2000 };
    static double x[STEPS + 1], direct[STEPS + 1], by[STEPS + 1];
    srand(5);
    for (size_t k = 0; k <= STEPS; k++)
        x[k] = random_in(-1, 1);
    for (size_t l = 0; l < LEN(ref_laws); l++)
        for (int kind = 0; kind < 2; kind++) {
            const fvi_delta q = (fvi_delta)kind;
            const fvi_kernel_function f = function_of_law(&ref_laws[l]);
            const fvi_kernel law = fvi_kernel_of_function(&f);
            const int none = has_a_second_singularity(&ref_laws[l]);
            fvi_history *memory = NULL;
            double first, w0;
            ck_assert_int_eq(fvi_kernel_history(&law, q, 0.01, 1, STEPS,
                                                FVI_HISTORY_MODES, 0, &first,
                                                &memory),
                             none ? FVI_EUNSUP : FVI_SUCCESS);
            fvi_history_free(memory);
            fvi_kernel_weights(&law, q, 0.01, 1, &w0);
            sums(&ref_laws[l], q, 0.01, STEPS, FVI_HISTORY_DIRECT, x, direct);
            sums(&ref_laws[l], q, 0.01, STEPS, FVI_HISTORY_MODES, x, by);
            for (size_t k = 0; k <= STEPS; k++) /* its own modes */
                ck_assert_near(by[k], direct[k], 1e-13 * w0, "law %zu, n = %zu",
                               l, k);
            sums(&law, q, 0.01, STEPS,
                 none ? FVI_HISTORY_AUTO : FVI_HISTORY_MODES, x, by);
            for (size_t k = 0; k <= STEPS; k++) {
                seen(fabs(by[k] - direct[k]) / w0, "of the largest weight");
                ck_assert_near(by[k], direct[k], 1e-13 * w0, "law %zu, n = %zu",
                               l, k);
            }
        }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("damping_laws: memory");
    ADD_CASE(suite, "memory", eq_26_4_the_memory_sums_the_weights,
             eq_26_4_what_rests_is_summed_to_all_digits,
             eq_26_14_a_law_relaxes_and_creeps, eq_26_6_one_set_of_modes,
             eq_26_6_every_weight_to_all_its_digits,
             eq_26_6_an_order_next_to_zero_is_a_spring,
             eq_26_6_where_there_are_no_modes,
             eq_26_16_the_memory_of_a_function);
    return run_suite(suite);
}
