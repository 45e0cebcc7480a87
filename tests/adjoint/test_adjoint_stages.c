/* tests/adjoint/test_adjoint_stages.c -- H 23: methods with stages, and identities that every method must satisfy.
 * Run alone: make test-adjoint_stages */
#include "adjoint_runs.h"
#include "distance_to_sine.h"
#include "run/whole_run.h"
#include "stages/lobatto_weights.h"
#include "system/larger.h"

static const fvi_method *const staged[] = { &fvi_lobatto_m2,  &fvi_lobatto_m3,
                                            &fvi_lobatto_m4,  &fvi_lobatto_m5,
                                            &fvi_lobatto_m8,  &fvi_lobatto_d2,
                                            &fvi_lobatto_d3, &fvi_lobatto_d8 };
static const fvi_initial_history pasts[] = { FVI_INITIAL_HISTORY_HELD, FVI_INITIAL_HISTORY_CAPUTO,
                                  FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE };
static const double alphas[] = { 0.05, 0.3, 0.5, 0.7, 0.95 };
enum { D = 3, N = 100 };

/* Three masses in a chain; t moves all numbers but alpha along a direction. */
typedef struct {
    double x0[D], p0[D], mass[D], rho[D], cg[2], aw[2];
    fvi_system system;
    fvi_run run;
} chain;

static void chain_at(chain *c, fvi_initial_history past, double alpha, double g, double t)
{
    const int from_zero = past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE && alpha > 0.5;
    *c = (chain){ .p0 = { 0.5 + t, -0.3, 0.2 - t },
                  .mass = { 1 + 0.2 * t, 1.5, 0.7 - 0.3 * t },
                  .rho = { 0.4 + 0.3 * t, 0.2, 0.1 - 0.1 * t },
                  .cg = { 1 + 0.5 * t, g + (g > 0 ? 0.4 * t : 0) },
                  .aw = { 0.2, 1.3 } };
    if (!from_zero)
        memcpy(c->x0, (double[]){ 1 - 0.3 * t, -0.5, 0.25 + t }, sizeof c->x0);
    c->system = (fvi_system){ .d = D,
                              .mass = c->mass,
                              .damping = c->rho,
                              .potential = fvi_potential_chain(c->cg),
                              .force = fvi_force_cosine(c->aw) };
    c->run = fvi_run_default(&c->system, c->x0, c->p0, 1. / 16, N);
    c->run.alpha = alpha;
    c->run.past = past;
}

static int last_position(size_t k, size_t d, const double *x, const double *p,
                         void *params, double *Jx, double *Jp)
{
    (void)k, (void)d, (void)x, (void)params, (void)Jp;
    Jx[0] = p != NULL;
    return 0;
}

static slopes *slopes_by(const fvi_method *method, chain *c, int of_ends)
{
    const size_t per = method->stages ? (size_t)method->stages - 1 : 1;
    slopes *s = slopes_of(&c->run, N * per + 1);
    const fvi_objective J = { .slopes = of_ends ? ends : to_sine, .params = &c->run };
    ck_assert_int_eq(fvi_adjoint(method, &c->run, NULL, NULL, &J, &s->to),
                     FVI_SUCCESS);
    return s;
}

static void run_of(const fvi_method *method, chain *c, double *x, double *p)
{
    ck_assert_int_eq(fvi_trajectory(method, &c->run, x, p, NULL), FVI_SUCCESS);
}

/* sum_k dJ/dF_k . F(t_k) over the times of all stages. */
static double by_forces(const fvi_method *method, const chain *c,
                        const slopes *s)
{
    const size_t per = method->stages ? (size_t)method->stages - 1 : 1;
    const fvi_lobatto_rule *rule =
        method->stages ? fvi_lobatto((size_t)method->stages) : NULL;
    double sum = 0;
    for (size_t k = 0; k <= N * per; k++) {
        const double inner = rule ? rule->c[k % per] : 0;
        const double t = ((double)(k / per) + inner) * c->run.h;
        for (size_t i = 0; i < D; i++)
            sum += s->force[k * D + i] * c->aw[0] * cos(c->aw[1] * t);
    }
    return sum;
}

static const fvi_method *method_of(size_t i)
{
    static const fvi_method *const plain[] = { &fvi_fractional, &fvi_cq2_shifted,
                                               &fvi_cq_bdf2, &fvi_cq2_midpoint };
    return i < LEN(plain) ? plain[i] : staged[i - LEN(plain)];
}

enum { METHODS = 4 + LEN(staged) };

/* For a linear system x_N and p_N are linear in x0, p0 and F: J is the sum of what they
 * do. Roundings of N sums, 1e-12 in all, as J is of order 1;
 * of stages 2e-12, since for alpha near 1 their memory sums increments, with weights that
 * are larger the more stages there are. Seen: 9e-13, and 0.03 of 1e-12 without stages. */
START_TEST(eq_23_6_start_and_force_add_up_to_a_linear_motion)
{
    static double x[(N + 1) * D], p[(N + 1) * D];
    for (size_t i = 0; i < METHODS * LEN(pasts) * LEN(alphas); i++) {
        const fvi_method *method = method_of(i % METHODS);
        chain c;
        chain_at(&c, pasts[i / METHODS % LEN(pasts)],
                 alphas[i / METHODS / LEN(pasts)], 0, 0);
        slopes *s = slopes_by(method, &c, 1);
        run_of(method, &c, x, p);
        double sum = by_forces(method, &c, s);
        for (size_t j = 0; j < D; j++) {
            sum += isnan(s->to.x0[j]) ? 0 : s->to.x0[j] * c.x0[j];
            sum += s->to.p0[j] * c.p0[j];
        }
        ck_assert_near(sum, x[N * D] + p[N * D + 1],
                       method->stages ? 2e-12 : 1e-12, "%s past %d alpha=%g",
                       method->name, (int)c.run.past, c.run.alpha);
        slopes_free(s);
    }
}
END_TEST

/* Masses, dampings, springs, forces and momenta times one factor: the same x. So
 * J(x) has the slope zero there, Duffing springs and all. J = x_N,1 + p_N,2, of which
 * p_N grows by the factor. */
START_TEST(eq_23_6_a_factor_of_all_forces_changes_no_position)
{
    static double x[(N + 1) * D], p[(N + 1) * D];
    for (size_t i = 0; i < METHODS * LEN(pasts) * LEN(alphas); i++) {
        const fvi_method *method = method_of(i % METHODS);
        chain c;
        chain_at(&c, pasts[i / METHODS % LEN(pasts)],
                 alphas[i / METHODS / LEN(pasts)], 0.5, 0);
        slopes *s = slopes_by(method, &c, 1);
        run_of(method, &c, x, p);
        double sum = by_forces(method, &c, s), size = fabs(sum);
        const double parts[] = { s->to.parameters[0] * c.cg[0],
                                 s->to.parameters[1] * c.cg[1] };
        for (size_t j = 0; j < 2; j++) {
            sum += parts[j];
            size += fabs(parts[j]);
        }
        for (size_t j = 0; j < D; j++) {
            const double some[] = { s->to.p0[j] * c.p0[j],
                                    s->to.mass[j] * c.mass[j],
                                    s->to.damping[j] * c.rho[j] };
            for (size_t l = 0; l < LEN(some); l++) {
                sum += some[l];
                size += fabs(some[l]);
            }
        }
        ck_assert_near(sum, p[N * D + 1], 1e-12 * larger(1, size),
                       "%s past %d alpha=%g", method->name, (int)c.run.past,
                       c.run.alpha);
        slopes_free(s);
    }
}
END_TEST

/* Taylor's test for the methods with stages: as in test_adjoint_identities.c. */
static double objective(const fvi_method *method, chain *c)
{
    static double x[(N + 1) * D], p[(N + 1) * D];
    run_of(method, c, x, p);
    return distance_to_sine(D, N, c->run.h, x, p);
}

START_TEST(eq_23_6_what_the_gradient_of_stages_leaves_is_of_order_2)
{
    for (size_t i = 0; i < LEN(staged) * LEN(pasts) * LEN(alphas); i++) {
        const fvi_method *method = staged[i % LEN(staged)];
        const fvi_initial_history past = pasts[i / LEN(staged) % LEN(pasts)];
        const double alpha = alphas[i / LEN(staged) / LEN(pasts)], t = 1e-3;
        chain c;
        chain_at(&c, past, alpha, 0.5, 0);
        slopes *s = slopes_by(method, &c, 0);
        const fvi_sensitivities *g = &s->to;
        double slope = g->p0[0] - g->p0[2] + 0.2 * g->mass[0] - 0.3 * g->mass[2]
                       + 0.3 * g->damping[0] - 0.1 * g->damping[2]
                       + 0.5 * g->parameters[0] + 0.4 * g->parameters[1];
        if (!isnan(g->x0[0]))
            slope += -0.3 * g->x0[0] + g->x0[2];
        const double J = objective(method, &c);
        chain_at(&c, past, alpha, 0.5, t);
        const double whole = objective(method, &c) - J - t * slope;
        chain_at(&c, past, alpha, 0.5, t / 2);
        const double half = objective(method, &c) - J - t / 2 * slope;
        ck_assert_near(whole / half, 4, 0.4, "%s past %d alpha=%g",
                       method->name, (int)past, alpha);
        slopes_free(s);
    }
}
END_TEST

/* One body on a spring, Caputo's past: x_N is linear in p0, so that dx_N/dp0 is x_N of the
 * run with x0 = 0 and p0 = 1. The adjoint goes through the same equations in the opposite
 * order. It meets that run up to rounding of N = 400 steps: 1e-13 of it up to alpha = 1/2,
 * where the history sums what it is told, and 1e-12 above, where it sums differences. A
 * solver of its own for the adjoint, for positions and not for increments, was off by
 * 2e-10 in form M with eight stages. Seen: 0.3 of both. */
START_TEST(eq_23_13_the_derivative_by_p0_is_a_run)
{
    enum { STEPS = 400 };
    for (size_t i = 0; i < LEN(staged) * LEN(alphas); i++) {
        const fvi_method *method = staged[i % LEN(staged)];
        double mass = 1.3, rho = 0.4, c = 1, x0 = 1.1, p0 = 0.4, none = 0, one = 1;
        double x[STEPS + 1], by_p0;
        const fvi_system system = { .d = 1,
                                    .mass = &mass,
                                    .damping = &rho,
                                    .potential = fvi_potential_harmonic(&c) };
        fvi_run run = fvi_run_default(&system, &x0, &p0, 0.05, STEPS);
        run.alpha = alphas[i / LEN(staged)];
        run.past = FVI_INITIAL_HISTORY_CAPUTO;
        const fvi_objective J = { .slopes = last_position, .params = NULL };
        const fvi_sensitivities want = { .p0 = &by_p0 };
        ck_assert_int_eq(fvi_adjoint(method, &run, NULL, NULL, &J, &want),
                         FVI_SUCCESS);
        run.x0 = &none;
        run.p0 = &one;
        ck_assert_int_eq(fvi_trajectory(method, &run, x, NULL, NULL),
                         FVI_SUCCESS);
        const double allowed =
            (run.alpha > 0.5 ? 1e-12 : 1e-13) * larger(fabs(x[STEPS]), 0.1);
        ck_assert_near(by_p0, x[STEPS], allowed, "%s alpha=%g", method->name,
                       run.alpha);
    }
}
END_TEST

/* What the stages do not know is refused. */
START_TEST(stages_refuse_what_they_have_no_derivative_of)
{
    chain c;
    double alpha, x[(N + 1) * D] = { 0 };
    chain_at(&c, FVI_INITIAL_HISTORY_HELD, 0.3, 0, 0);
    const fvi_objective J = { .slopes = ends, .params = NULL };
    const fvi_sensitivities by_alpha = { .alpha = &alpha }, none = { .x0 = NULL };
    ck_assert_int_eq(fvi_adjoint(&fvi_lobatto_m3, &c.run, x, x, &J, &none),
                     FVI_EUNSUP);
    ck_assert_int_eq(fvi_adjoint(&fvi_lobatto_d3, &c.run, x, x, &J, &none),
                     FVI_EUNSUP);
    c.run.alpha = 1;
    ck_assert_int_eq(
        fvi_adjoint(&fvi_lobatto_m3, &c.run, NULL, NULL, &J, &by_alpha),
        FVI_EUNSUP);
    ck_assert_int_eq(
        fvi_adjoint(&fvi_lobatto_d3, &c.run, NULL, NULL, &J, &by_alpha),
        FVI_SUCCESS);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("adjoint, stages");
    ADD_CASE(suite, "identities",
             eq_23_6_start_and_force_add_up_to_a_linear_motion,
             eq_23_6_a_factor_of_all_forces_changes_no_position,
             eq_23_6_what_the_gradient_of_stages_leaves_is_of_order_2,
             eq_23_13_the_derivative_by_p0_is_a_run);
    ADD_CASE(suite, "errors", stages_refuse_what_they_have_no_derivative_of);
    return run_suite(suite);
}
