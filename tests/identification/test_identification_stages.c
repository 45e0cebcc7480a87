/* tests/identification/test_identification_stages.c -- H 24: the derivatives of runs with stages.
 * Run alone: make test-identification_stages */
#include "identification_runs.h"

#include "estimation/identification_tangent.h"
#include "system/larger.h"

enum { N = 90, P = 7 };

static const fvi_free_parameter ALL[P] = {
    FVI_FREE_PARAMETER_ALPHA,       FVI_FREE_PARAMETER_RHO, FVI_FREE_PARAMETER_MASS,
    FVI_FREE_PARAMETER_X0,          FVI_FREE_PARAMETER_P0,  FVI_FREE_PARAMETER_CONSTANT,
    FVI_FREE_PARAMETER_CONSTANT + 1
};

static int last_x(size_t k, size_t d, const double *x, const double *p,
                  void *params, double *Jx, double *Jp)
{
    (void)k, (void)d, (void)x, (void)params, (void)Jp;
    Jx[0] += p != NULL;
    return 0;
}

static int last_p(size_t k, size_t d, const double *x, const double *p,
                  void *params, double *Jx, double *Jp)
{
    (void)k, (void)d, (void)x, (void)params, (void)Jx;
    if (p)
        Jp[0] += 1;
    return 0;
}

/* The slopes of x_N and p_N from the run that goes backwards. It solves the same equations in
 * the opposite order, sums up its derivatives in another way, and stands against numbers of
 * 72 digits (H 23). The memory of the slopes is compressed to 1e-10, some 1e-9 of the
 * largest; seen: 2e-11. Where all weights are summed both are right to rounding: 1e-12 of the
 * largest, but for the slopes of p in form M above alpha = 1/2, where the adjoint run begins
 * with a jump; there 1e-10. Seen: 0.07 of them. At rho = 0 the past has no force, but a
 * derivative by rho. */
START_TEST(eq_24_12_the_tangents_are_those_of_the_adjoint_run)
{
    const fvi_method *const methods[] = { &fvi_lobatto_m2, &fvi_lobatto_m3,
                                          &fvi_lobatto_m4, &fvi_lobatto_m5,
                                          &fvi_lobatto_d2, &fvi_lobatto_d4,
                                          &fvi_lobatto_d8 };
    const double alphas[] = { 0.1, 0.3, 0.5, 0.65, 0.9 };
    for (size_t n = 0; n < LEN(methods) * LEN(alphas) * 12; n++) {
        const fvi_method *method = methods[n % LEN(methods)];
        const size_t way = n / LEN(methods) / LEN(alphas);
        const fvi_initial_history past = (fvi_initial_history)(way % 3);
        question q;
        double by_x[P], by_p[P], *to[] = { by_x, by_p };
        fvi_estimation_tangents o;
        ask(&q, NULL, 2);
        q.constants[1] = 0.5;
        q.m = 1.3;
        const int is_exact = way >= 6;
        q.rho = way % 6 < 3 ? 0.4 : 0;
        q.run.memory = is_exact ? FVI_HISTORY_DIRECT : FVI_HISTORY_MODES;
        q.run.h = 0.125;
        q.run.steps = N;
        q.run.past = past;
        q.run.alpha = alphas[n / LEN(methods) % LEN(alphas)];
        const int whole = past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE;
        if (whole && q.run.alpha > 0.5)
            q.x0 = 0; /* (19.2) */
        for (size_t i = 0; i < 2; i++) {
            const fvi_objective J = { .slopes = i ? last_p : last_x, .params = NULL };
            const fvi_sensitivities want = { .alpha = to[i],
                                         .damping = to[i] + 1,
                                         .mass = to[i] + 2,
                                         .x0 = to[i] + 3,
                                         .p0 = to[i] + 4,
                                         .parameters = to[i] + 5,
                                         .sensitivity = fvi_parameter_gradient_of(
                                             &q.system.potential) };
            ck_assert_int_eq(fvi_adjoint(method, &q.run, NULL, NULL, &J, &want),
                             FVI_SUCCESS);
        }
        ck_assert_int_eq(fvi_estimation_tangents_start(method, &q.run, P, ALL, &o),
                         FVI_SUCCESS);
        for (size_t k = 0; k < N; k++)
            ck_assert_int_eq(fvi_tangent_step(&o.of), FVI_SUCCESS);
        double most = 0;
        for (size_t j = 0; j < P; j++)
            most = larger(most, larger(fabs(o.of.dx[j]), fabs(o.of.pi[j])));
        for (size_t j = 0; j < P; j++) {
            if (whole && q.run.alpha > 0.5 && ALL[j] == FVI_FREE_PARAMETER_X0)
                continue;
            const int jumps = q.run.alpha > 0.5 && !method->damped_inertia;
            const double of_x = is_exact ? 1e-12 * most : 1e-9 * most,
                         of_p = is_exact && jumps ? 1e-10 * most : of_x;
            ck_assert_near(o.of.dx[j], by_x[j], of_x, "x, %s, %g, %d, %zu",
                           method->name, q.run.alpha, past, j);
            ck_assert_near(o.of.pi[j], by_p[j], of_p, "p, %s, %g, %d, %zu",
                           method->name, q.run.alpha, past, j);
        }
        fvi_estimation_tangents_stop(&o);
    }
}
END_TEST

/* Where they are not known, a fit takes differences: at alpha = 1. */
START_TEST(stages_have_no_tangents_at_the_end)
{
    const fvi_method *const methods[] = { &fvi_lobatto_m4, &fvi_lobatto_d4 };
    for (size_t i = 0; i < LEN(methods); i++) {
        question q;
        fvi_estimation_tangents o;
        ask(&q, NULL, 2);
        q.run.alpha = 1;
        ck_assert_int_eq(fvi_estimation_tangents_start(methods[i], &q.run, P - 2, ALL, &o),
                         FVI_EUNSUP);
        fvi_estimation_tangents_stop(&o);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("slopes through stages");
    ADD_CASE(suite, "slopes",
             eq_24_12_the_tangents_are_those_of_the_adjoint_run,
             stages_have_no_tangents_at_the_end);
    return run_suite(suite);
}
