/* tests/adjoint/adjoint_meshes.h -- A chain on a mesh, its derivatives, and quotients. */
#ifndef ADJOINT_MESHES_H
#define ADJOINT_MESHES_H

#include "adjoint_runs.h"
#include "run/whole_run.h"

enum { D = 3, N = 40 };

/* Orders and pasts, damped or not, of chains on meshes. */
static const struct {
    fvi_initial_history past;
    double alpha, rho;
} mesh_cases[] = {
    { FVI_INITIAL_HISTORY_HELD, 0, 1 },      { FVI_INITIAL_HISTORY_HELD, 0.05, 1 },
    { FVI_INITIAL_HISTORY_HELD, 0.3, 1 },    { FVI_INITIAL_HISTORY_HELD, 0.5, 1 },
    { FVI_INITIAL_HISTORY_CAPUTO, 0.3, 1 },  { FVI_INITIAL_HISTORY_CAPUTO, 0.7, 1 },
    { FVI_INITIAL_HISTORY_CAPUTO, 0.95, 1 }, { FVI_INITIAL_HISTORY_CAPUTO, 1, 1 },
    { FVI_INITIAL_HISTORY_HELD, 0.5, 0 },    { FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE, 0.5, 1 },
    { FVI_INITIAL_HISTORY_CAPUTO, 0.7, 0 },  { FVI_INITIAL_HISTORY_HELD, 0.2, 0 },
};

/* Three masses in a chain under a constant force; the force is exact by its rows. */
typedef struct {
    double x0[D], p0[D], mass[D], rho[D], cg[2], F[D];
    fvi_system system;
    fvi_run run;
} chain;

static inline int constant(double t, size_t d, void *params, double *F)
{
    (void)t;
    memcpy(F, params, d * sizeof *F);
    return 0;
}

static inline void chain_at(chain *c, fvi_initial_history past, double alpha, double g,
                            double rho)
{
    *c = (chain){ .x0 = { 1, -0.5, 0.25 },
                  .p0 = { 0.5, -0.3, 0.2 },
                  .mass = { 1, 1.5, 0.7 },
                  .rho = { 0.4 * rho, 0.2 * rho, 0 },
                  .cg = { 1, g },
                  .F = { 0.3, 0, -0.2 } };
    c->system = (fvi_system){ .d = D,
                              .mass = c->mass,
                              .damping = c->rho,
                              .potential = fvi_potential_chain(c->cg),
                              .force = { .value = constant, .params = c->F } };
    c->run = fvi_run_default(&c->system, c->x0, c->p0, 0.125, N);
    c->run.alpha = alpha;
    c->run.past = past;
    c->run.step_error = 1e-12;
}

static inline slopes *slopes_by(chain *c, int of_ends)
{
    slopes *s = slopes_of(&c->run, N + 1);
    const fvi_objective J = { .slopes = of_ends ? ends : to_sine, .params = &c->run };
    if (of_ends) /* then alpha = 1 needs no modes */
        s->to.alpha = NULL;
    ck_assert_int_eq(
        fvi_adjoint(&fvi_variable_step, &c->run, NULL, NULL, &J, &s->to),
        FVI_SUCCESS);
    return s;
}

static inline double by_forces(const chain *c, const slopes *s)
{
    double sum = 0;
    for (size_t k = 0; k <= N; k++)
        for (size_t i = 0; i < D; i++)
            sum += s->force[k * D + i] * c->F[i];
    return sum;
}

static inline void run_of(chain *c, double *x, double *p)
{
    ck_assert_int_eq(fvi_trajectory(&fvi_variable_step, &c->run, x, p, NULL),
                     FVI_SUCCESS);
}

/* Where the system is linear, the derivatives of J by x0, p0 and F times these add up to J:
 * what is left. */
static inline double off_linear(chain *c)
{
    static double x[(N + 1) * D], p[(N + 1) * D];
    slopes *s = slopes_by(c, 1);
    run_of(c, x, p);
    double sum = by_forces(c, s) - x[N * D] - p[N * D + 1];
    for (size_t j = 0; j < D; j++) {
        sum += c->x0[j] == 0 ? 0 : s->to.x0[j] * c->x0[j];
        sum += s->to.p0[j] * c->p0[j];
    }
    slopes_free(s);
    return sum;
}

/* Masses, dampings, springs, forces and momenta times one factor: the same x, and p_N times
 * it. What is left. */
static inline double off_scaled(chain *c)
{
    static double x[(N + 1) * D], p[(N + 1) * D];
    slopes *s = slopes_by(c, 1);
    run_of(c, x, p);
    double sum = by_forces(c, s) + s->to.parameters[0] * c->cg[0]
                 + s->to.parameters[1] * c->cg[1] - p[N * D + 1];
    for (size_t j = 0; j < D; j++)
        sum += s->to.p0[j] * c->p0[j] + s->to.mass[j] * c->mass[j]
               + s->to.damping[j] * c->rho[j];
    slopes_free(s);
    return sum;
}

/* The J of to_sine. */
static inline double value_of(const chain *c)
{
    static double x[(N + 1) * D], p[(N + 1) * D];
    double J = 0;
    run_of((chain *)c, x, p);
    for (size_t i = 0; i < D; i++) {
        const double *end = x + N * D, last = p[N * D + i];
        for (size_t k = 1; k <= N; k++) {
            const double away = x[k * D + i] - sin((double)k * c->run.h);
            J += c->run.h / 2 * away * away;
        }
        J += end[i] / 2 + end[i] * last * last / 4;
    }
    return J;
}

/* Of order 4, four steps wide: on steps of its own a run errs by 1e-11, which is 1e-8 of a
 * quotient with 1e-3. */
static inline double quotient_by(chain *c, double *number, double step)
{
    static const double share[] = { 1, -8, 8, -1 }, at[] = { -2, -1, 1, 2 };
    const double was = *number;
    double sum = 0;
    for (size_t i = 0; i < LEN(at); i++) {
        *number = was + at[i] * step;
        sum += share[i] * value_of(c) / (12 * step);
    }
    *number = was;
    return sum;
}

static inline double quotient(chain *c, double *number)
{
    return quotient_by(c, number, 1e-3);
}

#endif
