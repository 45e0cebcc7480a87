/* tests/past/test_past_errors.c -- H 19: runs that are refused, several coordinates, defaults.
 * Run alone: make test-past_errors */
#include <fvi/discrete_mechanics.h>
#include "run/whole_run.h"
#include "past_runs.h"

static const double one = 1;

static fvi_run run_of(const fvi_system *system, const double *x0,
                      const double *p0, double alpha, fvi_initial_history past)
{
    fvi_run run = fvi_run_default(system, x0, p0, 0.05, 100);
    run.alpha = alpha;
    run.past = past;
    return run;
}

/* (19.2): every method but Algorithm 3 refuses what has no solution, and only that.
 * fvi_exact_at does, too. */
START_TEST(eq_19_2_what_has_no_solution_is_refused)
{
    const double alphas[] = { 0.3, 0.5, 0.5 + 0x1p-53, 0.8, 1 };
    double x[101], p[101];
    for (size_t i = 0; i < LEN(alphas) * METHODS * LEN(pasts) * 4; i++) {
        const size_t method = i / 4 % METHODS;
        const problem q = { pasts[i / 4 / METHODS % LEN(pasts)],
                            alphas[i / 4 / METHODS / LEN(pasts)],
                            i % 2 ? 0.2 : 0,
                            i / 2 % 2 ? 1e-300 : 0,
                            0.5,
                            { 1, 0 } };
        const int none = q.past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE && q.alpha > 0.5
                         && q.rho > 0 && q.x0 != 0;
        ck_assert_int_eq(fvi_initial_history_solvable(q.past, q.alpha, q.rho, q.x0),
                         !none);
        ck_assert_int_eq(try_run(methods[method], &q, 0.01, 100, x, p),
                         none && method != FVI ? FVI_EDOM : FVI_SUCCESS);
        const fvi_linear_oscillator linear = { 1,      1,    q.rho, q.alpha,
                                    q.past, q.x0, q.p0,  FVI_FORCING_NONE,
                                    0,      0,    0, NULL };
        ck_assert_int_eq(fvi_exact_at(&linear, 1, &one, x, p, NULL),
                         none ? FVI_EDOM : FVI_SUCCESS);
    }
}
END_TEST

START_TEST(an_unknown_past_is_refused)
{
    const problem q = { (fvi_initial_history)3, 0.3, 0.2, 1, 0.5, { 1, 0 } };
    const fvi_linear_oscillator linear = {
        .m = 1, .c = 1, .rho = 0.2, .alpha = 0.3, .past = (fvi_initial_history)3
    };
    double x[101], p[101];
    for (size_t method = 0; method < METHODS; method++)
        ck_assert_int_eq(try_run(methods[method], &q, 0.01, 100, x, p),
                         FVI_EINVAL);
    ck_assert_int_eq(fvi_exact_at(&linear, 1, &one, x, p, NULL), FVI_EINVAL);
}
END_TEST

/* Four masses that do not feel each other, damped and not, from the origin and not.
 * Each does what it does alone, with the whole history to the last bit (a compressed
 * one is as fine as the most damped of them wants it, (17.21)); where there is no
 * solution for one of them, there is none for all. */
START_TEST(eq_19_1_each_coordinate_has_its_own_past)
{
    enum { D = 4, N = 100 };
    const double mass[D] = { 1, 2, 0.5, 3 }, damping[D] = { 0.2, 0, 0.3, 0 };
    const double start[D] = { 0, 1, 1, 0 }, p0[D] = { 0.5, -0.3, 0.4, 1 };
    const double alphas[] = { 0.2, 0.5, 0.7, 0.9 };
    static double x[(N + 1) * D], p[(N + 1) * D], alone_x[N + 1],
        alone_p[N + 1];
    const fvi_potential potential = fvi_potential_harmonic(&one);
    const fvi_system all = { D, mass, damping, potential, { 0 }, NULL, NULL };
    for (size_t i = 0; i < LEN(alphas) * LEN(pasts) * METHODS; i++) {
        const fvi_method *method = methods[i % METHODS];
        const fvi_initial_history past = pasts[i / METHODS % LEN(pasts)];
        const double alpha = alphas[i / METHODS / LEN(pasts)];
        double x0[D];
        memcpy(x0, start, sizeof x0);
        fvi_run run = run_of(&all, x0, p0, alpha, past);
        run.memory = FVI_HISTORY_DIRECT;
        int status = fvi_trajectory(method, &run, x, p, NULL);
        if (past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE && alpha > 0.5
            && method != &fvi_fractional) {
            ck_assert_int_eq(status, FVI_EDOM);
            x0[2] = 0; /* the damped one */
            status = fvi_trajectory(method, &run, x, p, NULL);
        }
        ck_assert_int_eq(status, FVI_SUCCESS);
        for (size_t j = 0; j < D; j++) {
            const fvi_system single = { 1,         mass + j, damping + j,
                                        potential, { 0 },    NULL, NULL };
            fvi_run own = run_of(&single, x0 + j, p0 + j, alpha, past);
            own.memory = FVI_HISTORY_DIRECT;
            ck_assert_int_eq(
                fvi_trajectory(method, &own, alone_x, alone_p, NULL), 0);
            for (size_t k = 0; k <= N; k++) {
                ck_assert_ulp(x[k * D + j], alone_x[k], 0, "%s, %s, %g: x %zu",
                              method->name, past_names[past], alpha, j);
                ck_assert_ulp(p[k * D + j], alone_p[k], 0, "%s, %s, %g: p %zu",
                              method->name, past_names[past], alpha, j);
            }
        }
    }
}
END_TEST

/* No order that a run takes has them: what is not checked is NaN, and ends no process. */
START_TEST(orders_at_a_pole_of_psi_have_no_rates)
{
    static const double nodes[] = { 0, 1 };
    const double e[] = { -2, -3, NAN };
    for (size_t i = 0; i < LEN(e); i++)
        for (size_t k = 0; k < 2; k++) {
            fvi_kernel_impulse table;
            double rate[2];
            fvi_kernel_impulse_prepare(0.8, LEN(nodes), nodes, &table);
            table.e = e[i];
            fvi_kernel_impulses_by_order(&table, k, rate);
            ck_assert(isnan(rate[0]));
        }
}
END_TEST

/* A run that says nothing of the past is one of a body at rest. */
START_TEST(the_default_run_is_held)
{
    const fvi_system system = { 1,     &one, &one, fvi_potential_harmonic(&one),
                                { 0 }, NULL, NULL };
    const fvi_run run = fvi_run_default(&system, &one, &one, 0.25, 7);
    ck_assert(run.system == &system && run.x0 == &one && run.p0 == &one);
    ck_assert(run.h == 0.25 && run.steps == 7);
    ck_assert(run.kappa == 0.5 && run.alpha == 0.5 && run.tolerance == 0);
    ck_assert(run.past == FVI_INITIAL_HISTORY_HELD && run.memory == FVI_HISTORY_AUTO);
    const fvi_run zeroed = { 0 };
    const fvi_linear_oscillator linear = { 0 };
    ck_assert(zeroed.past == FVI_INITIAL_HISTORY_HELD && linear.past == FVI_INITIAL_HISTORY_HELD);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("19 past: errors");
    ADD_CASE(suite, "errors", eq_19_2_what_has_no_solution_is_refused,
             an_unknown_past_is_refused,
             orders_at_a_pole_of_psi_have_no_rates);
    ADD_CASE(suite, "runs", eq_19_1_each_coordinate_has_its_own_past,
             the_default_run_is_held);
    return run_suite(suite);
}
