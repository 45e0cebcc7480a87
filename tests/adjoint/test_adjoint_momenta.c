/* tests/adjoint/test_adjoint_momenta.c -- H 23: objectives J of every momentum.
 * Run alone: make test-adjoint_momenta
 *
 * A run that ends at t_k has the same steps as a longer one. So the derivatives of sum_k a_k . p_k are the sum of
 * those of a_k . p_k, the last momentum of a run of k steps, which other tests compare with complex steps and with
 * references. */
#include "runs_of_all_kinds.h"

static double share(size_t k, size_t i)
{
    return cos((double)(3 * k + 5 * i + 1));
}

/* sum_k a_k . p_k */
static int all_momenta(size_t k, size_t d, const double *x, const double *p,
                       void *params, double *Jx, double *Jp)
{
    (void)x, (void)p, (void)params, (void)Jx;
    for (size_t i = 0; i < d; i++)
        Jp[i] += share(k, i);
    return 0;
}

/* a_k . p_k of a run of k steps */
static int last_momentum(size_t k, size_t d, const double *x, const double *p,
                         void *params, double *Jx, double *Jp)
{
    (void)x, (void)params, (void)Jx;
    for (size_t i = 0; p && i < d; i++)
        Jp[i] += share(k, i);
    return 0;
}

static void ck_assert_sum(const fvi_method *method, const fvi_run *run)
{
    static double all[NUMBERS_IN_ALL], one[NUMBERS_IN_ALL], sum[NUMBERS_IN_ALL];
    const fvi_objective momenta = { .slopes = all_momenta, .has_momenta = 1 },
                        last = { .slopes = last_momentum };
    double largest = 0;
    memset(all, 0, sizeof all);
    memset(sum, 0, sizeof sum);
    for (size_t i = 0; i < D; i++) /* p_0 is p0 */
        sum[D + i] = share(0, i);
    fvi_sensitivities to = into(all, run);
    ck_assert_int_eq(fvi_adjoint(method, run, NULL, NULL, &momenta, &to), 0);
    for (size_t k = 1; k <= N; k++) {
        fvi_run shorter = *run;
        shorter.steps = k;
        memset(one, 0, sizeof one);
        to = into(one, run);
        ck_assert_int_eq(fvi_adjoint(method, &shorter, NULL, NULL, &last, &to), 0);
        for (size_t i = 0; i < NUMBERS_IN_ALL; i++)
            sum[i] += one[i];
    }
    for (size_t i = 0; i < NUMBERS_IN_ALL; i++)
        largest = isnan(sum[i]) ? largest : larger(largest, fabs(sum[i])); /* (19.2) */
    /* N sums of N terms, each to 8 u; of eight stages what adjoint.h says. Seen: 9.9e-14, with eight stages 9.2e-13,
     * both by alpha, at alpha = 1 and 0.95 */
    const double bound = method->stages == 8 ? 1e-12 : N * N * 8 * U;
    for (size_t i = 0; i < NUMBERS_IN_ALL; i++)
        if (isnan(sum[i]))
            ck_assert(isnan(all[i]));
        else
            ck_assert_near(all[i], sum[i], bound * largest,
                           "%s, past %d, alpha %g, number %zu", method->name,
                           (int)run->past, run->alpha, i);
}

START_TEST(eq_23_27_is_a_sum_of_shorter_runs)
{
    check_chains(ck_assert_sum);
}
END_TEST

START_TEST(eq_23_27_is_a_sum_with_a_law_too)
{
    check_chains_with_a_law(ck_assert_sum);
}
END_TEST

START_TEST(eq_23_27_is_a_sum_with_matrices_too)
{
    check_structures(ck_assert_sum);
}
END_TEST

START_TEST(eq_23_27_is_a_sum_with_several_dampers_too)
{
    check_damped_structures(ck_assert_sum);
}
END_TEST

/* Where alpha = 1 makes rho a mass, p_k is not m v_k. */
START_TEST(momenta_at_alpha_1_are_refused_where_rho_is_a_mass)
{
    const fvi_objective momenta = { .slopes = all_momenta, .has_momenta = 1 };
    double x0[D];
    const fvi_sensitivities to = { .x0 = x0 };
    chain c;
    chain_at(&c, FVI_INITIAL_HISTORY_CAPUTO, 1);
    ck_assert_int_eq(fvi_adjoint(&fvi_lobatto_m3, &c.run, NULL, NULL, &momenta, &to),
                     FVI_EUNSUP);
    ck_assert_int_eq(fvi_adjoint(&fvi_variable_step, &c.run, NULL, NULL, &momenta, &to),
                     FVI_EUNSUP);
    memset(c.rho, 0, sizeof c.rho);
    ck_assert_int_eq(fvi_adjoint(&fvi_lobatto_m3, &c.run, NULL, NULL, &momenta, &to), 0);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("adjoint, every momentum");
    ADD_CASE(suite, "sums", eq_23_27_is_a_sum_of_shorter_runs,
             eq_23_27_is_a_sum_with_a_law_too, eq_23_27_is_a_sum_with_matrices_too, eq_23_27_is_a_sum_with_several_dampers_too,
             momenta_at_alpha_1_are_refused_where_rho_is_a_mass);
    return run_suite(suite);
}
