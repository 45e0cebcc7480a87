/* tests/adjoint/test_adjoint_laws.c -- H 23: derivatives of runs with a law of damping.
 * Run alone: make test-adjoint_laws */
#include "adjoint_runs.h"
#include "chain_with_a_law.h"
#include "distance_to_sine.h"
#include "run/whole_run.h"
#include "stages/lobatto_weights.h"
#include "system/larger.h"

enum { N = 300 };

/* t moves all numbers along a direction. */
static void chain_at(chain *c, fvi_history_kind memory, double t)
{
    *c = (chain){
        .x0 = { 1 - 0.3 * t, -0.5, 0.25 + t },
        .p0 = { 0.5 + t, -0.3, 0.2 - t },
        .mass = { 1 + 0.2 * t, 1.5, 0.7 - 0.3 * t },
        .rho = { 1 + 0.4 * t, 0, 0.5 - 0.2 * t },
        .cg = { 1 + 0.5 * t, 0.5 + 0.4 * t },
        .aw = { 0.2, 1.3 },
        .term = { { FVI_KERNEL_POWER, 0.2 - 0.1 * t, 0.3 + 0.2 * t, 0, 0 },
                  { FVI_KERNEL_ZENER, 0.4 + 0.2 * t, 0.35 - 0.3 * t, 0.6 + 0.5 * t,
                    0 },
                  { FVI_KERNEL_MAXWELL, 0.3 + 0.3 * t, 0, 0.5 - 0.4 * t, 0 },
                  { FVI_KERNEL_DISTRIBUTED, 0.2 - 0.2 * t, 0.1 + 0.1 * t, 0,
                    0.45 - 0.2 * t } },
    };
    connect_chain(c, 1. / 32, N);
    c->run.memory = memory;
    c->run.law = &c->law;
    c->run.alpha = 0.9; /* not read */
}

/* The first six have the digits of the tests before Taylor's. */
static const fvi_method *const methods[] = { &fvi_fractional, &fvi_cq_bdf2,
                                             &fvi_lobatto_d2,  &fvi_lobatto_d3,
                                             &fvi_lobatto_d4,  &fvi_lobatto_d5,
                                             &fvi_cq2_midpoint,     &fvi_lobatto_m3,
                                             &fvi_lobatto_m4 };
enum { FIRST = 6 };
enum { MOST_ROWS = 4 * N + 1 }; /* of forces */
static const fvi_history_kind kinds[] = { FVI_HISTORY_DIRECT,
                                         FVI_HISTORY_MODES };

/* terms: by rho, alpha, time and end of each, as many as the law has. */
static slopes *slopes_by(const fvi_method *method, chain *c, int of_ends,
                         double *terms)
{
    slopes *s = slopes_of(&c->run, MOST_ROWS);
    const fvi_objective J = { .slopes = of_ends ? ends : to_sine, .params = &c->run };
    s->to.alpha = NULL;
    s->to.terms = terms;
    s->to.orders = terms + c->run.law->count;
    s->to.times = terms + 2 * c->run.law->count;
    s->to.ends = terms + 3 * c->run.law->count;
    ck_assert_int_eq(fvi_adjoint(method, &c->run, NULL, NULL, &J, &s->to),
                     FVI_SUCCESS);
    return s;
}

static void run_of(const fvi_method *method, const chain *c, double *x,
                   double *p)
{
    ck_assert_int_eq(fvi_trajectory(method, &c->run, x, p, NULL), FVI_SUCCESS);
}

/* A law that is one power, and that power: the same derivatives. The law has its weights
 * from its own quadrature, to 60 u; N of them, 1e-12 in all. Seen: 3e-14. */
START_TEST(eq_23_6_a_law_of_one_power_has_its_derivatives)
{
    for (size_t i = 0; i < FIRST * LEN(kinds); i++) {
        const fvi_kernel_term term = { FVI_KERNEL_POWER, 0.4, 0.3, 0, 0 };
        const fvi_kernel law = { 1, &term };
        chain c;
        double by_term[4];
        chain_at(&c, kinds[i / FIRST], 0);
        c.run.law = &law;
        slopes *s = slopes_by(methods[i % FIRST], &c, 0, by_term);
        double alone[D] = { 0.4, 0, 0.2 }, sum = 0;
        c.run.law = NULL;
        c.run.alpha = 0.3;
        c.system.damping = alone;
        slopes *same = slopes_of(&c.run, MOST_ROWS);
        const fvi_objective J = { .slopes = to_sine, .params = &c.run };
        ck_assert_int_eq(
            fvi_adjoint(methods[i % FIRST], &c.run, NULL, NULL, &J, &same->to),
            FVI_SUCCESS);
        for (size_t j = 0; j < D; j++) {
            ck_assert_near(s->to.x0[j], same->to.x0[j], 1e-12, "x0");
            ck_assert_near(s->to.p0[j], same->to.p0[j], 1e-12, "p0");
            ck_assert_near(s->to.mass[j], same->to.mass[j], 1e-12, "mass");
            ck_assert_near(s->to.damping[j], 0.4 * same->to.damping[j], 1e-12,
                           "damping");
            ck_assert_near(s->force[7 * D + j], same->force[7 * D + j], 1e-12,
                           "force");
            sum += alone[j] / 0.4 * same->to.damping[j];
        }
        ck_assert_near(by_term[0], sum, 1e-12, "the factor of the term");
        ck_assert_near(by_term[1], *same->to.alpha, 1e-12, "its order");
        ck_assert_near(by_term[2], 0, 0, "it has no time");
        ck_assert_near(by_term[3], 0, 0, "it has no end");
        slopes_free(s);
        slopes_free(same);
    }
}
END_TEST

/* sum_k dJ/dF_k . F(t_k) over the times of all stages. */
static double by_forces(const fvi_method *method, const chain *c,
                        const slopes *s)
{
    const size_t per = method->stages ? (size_t)method->stages - 1 : 1;
    double sum = 0;
    for (size_t k = 0; k <= N * per; k++) {
        const double inner =
            method->stages ? fvi_lobatto((size_t)method->stages)->c[k % per]
                           : 0;
        const double t = ((double)(k / per) + inner) * c->run.h;
        for (size_t i = 0; i < D; i++)
            sum += s->force[k * D + i] * c->aw[0] * cos(c->aw[1] * t);
    }
    return sum;
}

/* Masses, the terms of the law, springs, forces and momenta times one factor: the same x.
 * J = x_N,1 + p_N,2, of which p_N grows by the factor; for the terms the dampings, too. */
START_TEST(eq_23_6_a_factor_of_all_forces_and_of_a_law_changes_no_position)
{
    static double x[(N + 1) * D], p[(N + 1) * D];
    for (size_t i = 0; i < FIRST * LEN(kinds); i++) {
        chain c;
        double terms[4 * TERMS], by_terms = 0, by_rho = 0, size = 0;
        chain_at(&c, kinds[i / FIRST], 0);
        const fvi_method *method = methods[i % FIRST];
        slopes *s = slopes_by(method, &c, 1, terms);
        run_of(method, &c, x, p);
        double sum =
            s->to.parameters[0] * c.cg[0] + s->to.parameters[1] * c.cg[1];
        sum += by_forces(method, &c, s);
        for (size_t j = 0; j < D; j++) {
            sum += s->to.p0[j] * c.p0[j] + s->to.mass[j] * c.mass[j];
            by_rho += s->to.damping[j] * c.rho[j];
            size += fabs(s->to.mass[j] * c.mass[j]);
        }
        for (size_t l = 0; l < TERMS; l++)
            by_terms += terms[l] * c.term[l].rho;
        ck_assert_near(sum + by_rho, p[N * D + 1], 1e-12 * larger(1, size),
                       "%s", method->name);
        ck_assert_near(by_terms, by_rho, 1e-12 * larger(1, size), "%s",
                       method->name);
        slopes_free(s);
    }
}
END_TEST

static double objective(const fvi_method *method, const chain *c)
{
    static double x[(N + 1) * D], p[(N + 1) * D];
    run_of(method, c, x, p);
    return distance_to_sine(D, N, c->run.h, x, p);
}

/* Taylor's test, along the direction of chain_at. */
START_TEST(eq_23_6_what_the_gradient_of_a_law_leaves_is_of_order_2)
{
    for (size_t i = 0; i < LEN(methods) * LEN(kinds); i++) {
        const fvi_method *method = methods[i % LEN(methods)];
        const fvi_history_kind memory = kinds[i / LEN(methods)];
        const double t = 1e-3;
        chain c;
        double terms[4 * TERMS];
        chain_at(&c, memory, 0);
        slopes *s = slopes_by(method, &c, 0, terms);
        const fvi_sensitivities *g = &s->to;
        const double slope =
            -0.3 * g->x0[0] + g->x0[2] + g->p0[0] - g->p0[2] + 0.2 * g->mass[0]
            - 0.3 * g->mass[2] + 0.4 * g->damping[0] - 0.2 * g->damping[2]
            + 0.5 * g->parameters[0] + 0.4 * g->parameters[1] - 0.1 * terms[0]
            + 0.2 * terms[1] + 0.3 * terms[2] - 0.2 * terms[3]
            + 0.2 * g->orders[0] - 0.3 * g->orders[1] + 0.1 * g->orders[3]
            + 0.5 * g->times[1] - 0.4 * g->times[2] - 0.2 * g->ends[3];
        const double J = objective(method, &c);
        chain_at(&c, memory, t);
        const double whole = objective(method, &c) - J - t * slope;
        chain_at(&c, memory, t / 2);
        const double half = objective(method, &c) - J - t / 2 * slope;
        ck_assert_near(whole / half, 4, 0.1, "%s", method->name);
        slopes_free(s);
    }
}
END_TEST

START_TEST(a_law_has_no_alpha_and_a_power_no_terms)
{
    chain c;
    double number;
    chain_at(&c, FVI_HISTORY_AUTO, 0);
    const fvi_objective J = { .slopes = ends, .params = NULL };
    const fvi_sensitivities by_alpha = { .alpha = &number };
    const fvi_sensitivities by_terms[] = { { .terms = &number },
                                       { .orders = &number },
                                       { .times = &number },
                                       { .ends = &number } };
    ck_assert_int_eq(fvi_adjoint(&fvi_cq_bdf2, &c.run, NULL, NULL, &J, &by_alpha),
                     FVI_EINVAL);
    c.run.law = NULL;
    for (size_t i = 0; i < LEN(by_terms); i++)
        ck_assert_int_eq(
            fvi_adjoint(&fvi_cq_bdf2, &c.run, NULL, NULL, &J, &by_terms[i]),
            FVI_EINVAL);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("adjoint, laws");
    ADD_CASE(suite, "laws", eq_23_6_a_law_of_one_power_has_its_derivatives,
             eq_23_6_a_factor_of_all_forces_and_of_a_law_changes_no_position,
             eq_23_6_what_the_gradient_of_a_law_leaves_is_of_order_2);
    ADD_CASE(suite, "errors", a_law_has_no_alpha_and_a_power_no_terms);
    return run_suite(suite);
}
