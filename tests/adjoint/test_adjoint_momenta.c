/* tests/adjoint/test_adjoint_momenta.c -- H 23: objectives that know every momentum.
 *                                        Run alone: make test-adjoint_momenta
 *
 * A run that ends at t_k has the same steps as a longer one. So the derivatives of sum_k a_k . p_k
 * are the sum of those of a_k . p_k, the last momentum of a run of k steps, which other tests
 * compare with complex steps and with references. */
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
    /* N sums of N terms, each to 8 u; of eight stages what adjoint.h says. Seen: 3e-15, 4e-13 */
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
    const double alphas[] = { 0, 0.05, 0.3, 0.5, 0.7, 0.95, 1 };
    for (size_t i = 0; i < LEN(methods) * LEN(alphas) * LEN(pasts); i++) {
        const fvi_method *method = methods[i % LEN(methods)];
        chain c;
        chain_at(&c, pasts[i / LEN(methods) / LEN(alphas)],
                 alphas[i / LEN(methods) % LEN(alphas)]);
        if (c.run.alpha == 1 && method->stages)
            continue; /* form M is refused, and has no derivative by alpha */
        ck_assert_sum(method, &c.run);
    }
}
END_TEST

START_TEST(eq_23_27_is_a_sum_with_a_law_too)
{
    for (size_t i = 0; i < LEN(methods); i++) {
        chain c;
        chain_at(&c, FVI_INITIAL_HISTORY_HELD, 0.5);
        c.run.law = &c.law;
        if (methods[i] != &fvi_cq2_shifted)
            ck_assert_sum(methods[i], &c.run);
    }
}
END_TEST

START_TEST(eq_23_27_is_a_sum_with_matrices_too)
{
    const double alphas[] = { 0.3, 0.5, 0.7 }, x0[D] = { 1, -0.5, 0.25 },
                 p0[D] = { 0.5, -0.3, 0.2 };
    matrices m;
    tridiagonal(D, 1, 0.2, &m.M);
    tridiagonal(D, 3, -1.4, &m.K);
    tridiagonal(D, 0.5, 0.15, &m.C);
    make(&m);
    for (size_t i = 0; i < LEN(takers_of_matrices) * LEN(alphas) * LEN(pasts); i++) {
        fvi_run run = run_of(&m.system, alphas[i / LEN(takers_of_matrices) % LEN(alphas)], 1. / 8, N, x0, p0);
        run.past = pasts[i / LEN(takers_of_matrices) / LEN(alphas)];
        if (run.past != FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE || run.alpha < 0.5)
            ck_assert_sum(takers_of_matrices[i % LEN(takers_of_matrices)], &run);
    }
    drop(&m);
}
END_TEST

START_TEST(eq_23_27_is_a_sum_with_several_dampers_too)
{
    const double x0[D] = { 1, -0.5, 0.25 }, p0[D] = { 0.5, -0.3, 0.2 },
                 orders[][DAMPERS] = { { 0.3, 0.05, 0.7 }, { 0, 0.4, 1 }, { 0.5, 0.2, 0.95 } };
    const fvi_initial_history past[][DAMPERS] = {
        { FVI_INITIAL_HISTORY_HELD, FVI_INITIAL_HISTORY_HELD, FVI_INITIAL_HISTORY_HELD },
        { FVI_INITIAL_HISTORY_CAPUTO, FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE, FVI_INITIAL_HISTORY_CAPUTO }
    };
    for (size_t i = 0; i < 4 * LEN(orders) * LEN(past) * 2; i++) {
        const fvi_method *method = methods[i % 4];
        const size_t pull = i / 4 / LEN(orders) % LEN(past), has_laws = i / 4 / LEN(orders) / LEN(past);
        damped_structure s;
        if ((method == &fvi_fractional && pull) || (method == &fvi_cq2_shifted && has_laws))
            continue; /* refused */
        make_damped(&s, orders[i / 4 % LEN(orders)], past[pull], has_laws && !pull);
        fvi_run run = run_of(&s.system, 0.5, 1. / 8, N, x0, p0);
        run.kappa = 0.3;
        ck_assert_sum(method, &run);
        drop_damped(&s);
    }
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
