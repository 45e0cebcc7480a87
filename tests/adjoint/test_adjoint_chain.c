/* tests/adjoint/test_adjoint_chain.c -- H 23: gradients of chains of many masses.
 * Run alone: make test-adjoint_chain */
#include "complex_run.h"
#include "harness/full_chain.h"
#include "system/larger.h"

#include <gsl/gsl_rng.h>

enum { D = 5, N = 24 };

/* Five masses, springs of Duffing's, one mass undamped; something of each kind. */
typedef struct {
    double x0[D], p0[D], mass[D], rho[D], cg[2], F[(N + 1) * D];
    fvi_system system;
    fvi_run run;
    complex_run tilted;
} chain;

/* The force of the run is linear between the times of steps; the limits at a node are
 * taken 4 ulp away, which changes F by that. */
static int table_value(double t, size_t d, void *params, double *F)
{
    const chain *c = params;
    const double k = t / c->run.h, whole = smaller(floor(k), N - 1);
    const double *left = c->F + (size_t)whole * d;
    for (size_t i = 0; i < d; i++)
        F[i] = left[i] + (k - whole) * (left[d + i] - left[i]);
    return 0;
}

static double uniform(gsl_rng *rng, double a, double b)
{
    return a + (b - a) * gsl_rng_uniform(rng);
}

static chain *random_chain(gsl_rng *rng, const fvi_method *method,
                           fvi_initial_history past, double alpha)
{
    chain *c = calloc(1, sizeof *c);
    ck_assert_ptr_nonnull(c);
    const int from_zero = past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE && alpha > 0.5
                          && method->scheme != FVI_SCHEME_FVI;
    for (size_t i = 0; i < D; i++) {
        c->x0[i] = from_zero ? 0 : uniform(rng, -1, 1);
        c->p0[i] = uniform(rng, -1, 1);
        c->mass[i] = uniform(rng, 0.5, 2);
        c->rho[i] = i == 2 ? 0 : uniform(rng, 0, 0.4);
    }
    for (size_t k = 0; k < LEN(c->F); k++)
        c->F[k] = uniform(rng, -1, 1);
    c->cg[0] = uniform(rng, 0.5, 2);
    c->cg[1] = uniform(rng, 0.2, 1);
    c->system = (fvi_system){ D,
                              c->mass,
                              c->rho,
                              fvi_potential_chain(c->cg),
                              { .value = table_value, .params = c },
                              NULL, NULL };
    c->run = fvi_run_default(&c->system, c->x0, c->p0, 1. / 16, N);
    c->run.kappa = method->takes_kappa ? uniform(rng, 0.2, 0.8) : 0.5;
    c->run.alpha = alpha;
    c->run.past = past;
    complex_run *z = &c->tilted;
    *z = (complex_run){ .scheme = method->scheme,
                        .past = past,
                        .d = D,
                        .N = N,
                        .h = c->run.h,
                        .kappa = c->run.kappa,
                        .alpha = alpha,
                        .cg = { c->cg[0], c->cg[1] } };
    for (size_t i = 0; i < D; i++) {
        z->x0[i] = c->x0[i];
        z->p0[i] = c->p0[i];
        z->mass[i] = c->mass[i];
        z->rho[i] = c->rho[i];
    }
    for (size_t k = 0; k < LEN(c->F); k++)
        z->F[k] = c->F[k];
    return c;
}

/* All of `count` derivatives, relative to the largest. */
static void ck_assert_slopes(complex_run *r, double complex *number,
                             const double *got, size_t count, const char *what)
{
    double want[LENGTH * MOST], largest = 0;
    const size_t stride = count > D ? 7 : 1; /* of many forces, some */
    for (size_t i = 0; i < count; i += stride) {
        want[i] = complex_slope(r, number + i);
        largest = larger(largest, fabs(want[i]));
    }
    for (size_t i = 0; i < count; i += stride)
        seen_worst(fabs(got[i] - want[i]) / largest, "worst");
    for (size_t i = 0; i < count; i += stride)
        ck_assert_near(got[i], want[i], 1e-11 * largest,
                       "%s %zu, scheme %d past %d alpha=%g", what, i,
                       (int)r->scheme, (int)r->past, creal(r->alpha));
}

/* As to_sine; and of each p_k, k < N, some share. */
static double share[N * D];

static int with_momenta(size_t k, size_t d, const double *x, const double *p,
                        void *params, double *Jx, double *Jp)
{
    for (size_t i = 0; k < N && i < d; i++)
        Jp[i] += share[k * d + i];
    return to_sine(k, d, x, p, params, Jx, Jp);
}

static void ck_assert_chain(chain *c, const fvi_method *method, int has_momenta)
{
    complex_run *z = &c->tilted;
    slopes *s = slopes_of(&c->run, N + 1);
    const fvi_objective J = { .slopes = has_momenta ? with_momenta : to_sine,
                              .params = &c->run,
                              .has_momenta = has_momenta };
    z->by_momenta = has_momenta ? share : NULL;
    ck_assert_int_eq(fvi_adjoint(method, &c->run, NULL, NULL, &J, &s->to),
                     FVI_SUCCESS);
    if (isnan(s->to.x0[0])) { /* but where nothing is damped */
        ck_assert(method->scheme != FVI_SCHEME_FVI && c->run.alpha > 0.5
                  && isfinite(s->to.x0[2]));
    } else {
        ck_assert_slopes(z, z->x0, s->to.x0, D, "x0");
    }
    ck_assert_slopes(z, z->p0, s->to.p0, D, "p0");
    ck_assert_slopes(z, z->mass, s->to.mass, D, "mass");
    ck_assert_slopes(z, z->rho, s->to.damping, D, "rho");
    ck_assert_slopes(z, &z->alpha, s->to.alpha, 1, "alpha");
    ck_assert_slopes(z, z->cg, s->to.parameters, 2, "parameter");
    ck_assert_slopes(z, z->F, s->force, (N + 1) * D, "force");
    slopes_free(s);
}

/* (23.6) for five masses: every derivative, to 1e-11 of the largest of its kind. */
static void ck_assert_chains(int has_momenta)
{
    static const fvi_method *const methods[] = { &fvi_fractional, &fvi_cq2_shifted,
                                                 &fvi_cq_bdf2, &fvi_cq2_midpoint };
    static const fvi_initial_history pasts[] = { FVI_INITIAL_HISTORY_HELD, FVI_INITIAL_HISTORY_CAPUTO,
                                      FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE };
    static const double alphas[] = { 0.05, 0.35, 0.5, 0.7, 0.95 };
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    for (size_t i = 0; i < LEN(methods) * LEN(pasts) * LEN(alphas); i++) {
        const fvi_method *method = methods[i % LEN(methods)];
        const fvi_initial_history past = pasts[i / LEN(methods) % LEN(pasts)];
        chain *c = random_chain(rng, method, past,
                                alphas[i / LEN(methods) / LEN(pasts)]);
        ck_assert_chain(c, method, has_momenta);
        if (i % 2) { /* the same potential by a full Hessian */
            c->system.potential.hessian = full_chain_hessian;
            c->system.potential.diagonals = 0;
            ck_assert_chain(c, method, has_momenta);
        }
        free(c);
    }
    gsl_rng_free(rng);
}

START_TEST(eq_23_6_every_derivative_of_a_chain_by_complex_steps)
{
    ck_assert_chains(0);
}
END_TEST

/* (23.27): J knows every momentum. */
START_TEST(eq_23_27_every_momentum_of_a_chain_by_complex_steps)
{
    for (size_t k = 0; k < LEN(share); k++)
        share[k] = cos((double)(7 * k + 3)) / 4;
    ck_assert_chains(1);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("adjoint, chains");
    ADD_CASE(suite, "values",
             eq_23_6_every_derivative_of_a_chain_by_complex_steps,
             eq_23_27_every_momentum_of_a_chain_by_complex_steps);
    return run_suite(suite);
}
