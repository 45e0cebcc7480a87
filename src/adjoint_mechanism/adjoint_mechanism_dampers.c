/* src/adjoint_mechanism/adjoint_mechanism_dampers.c -- The dampers of a mechanism in its adjoint run. [H 23, 29] */
#include "adjoint_mechanism.h"

#include "methods/lobatto_stages.h"
#include "system/dot.h"
#include "system/fail.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const fvi_damper *damper_of(const fvi_adjoint_mechanism *m,
                                   const fvi_adjoint_mechanism_damper *a)
{
    return m->run->system->mechanism->damper + a->damper;
}

static int is_first_order(const fvi_adjoint_mechanism *m)
{
    return m->o->form == FVI_MECHANISM_FIRST_ORDER;
}

/* ---- the start ---- */

/* Prepare the impulses of term l, a power, for rho A = 1. */
static void start_power(const fvi_adjoint_mechanism *m, fvi_adjoint_mechanism_damper *a, size_t l)
{
    static const double ends[] = { 0, 1 };
    const fvi_lobatto_rule *rule = m->o->rule;
    fvi_adjoint_start_power *p = a->each + a->powers++;
    p->term = l;
    fvi_kernel_impulse_prepare(a->kernel->term[l].alpha, rule ? m->s : 2, rule ? rule->c : ends, &p->power);
    p->unit = pow(m->run->h, 1 + p->power.e);
}

/* Write A, and prepare the impulses of the past. The force of a damper that is stretched at t = 0 is a sum of powers of
 * t, one for each power of its law. */
static int start_impulses(const fvi_adjoint_mechanism *m, fvi_adjoint_mechanism_damper *a)
{
    const fvi_lobatto_rule *rule = m->o->rule;
    const fvi_damper *damper = damper_of(m, a);
    const size_t j = a->damper;
    const int is_power = fvi_kernel_is_power(a->kernel),
              is_stretched = damper->past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE && !is_first_order(m),
              is_sum = is_stretched && !is_power
                       && fvi_mechanism_check_stretch(a->kernel, j, NULL) == FVI_SUCCESS;
    a->needs_start_slope = !is_sum && fvi_mechanism_needs_start_slope(m->o, damper);
    a->needs_start_place = is_sum || (is_stretched && fvi_kernel_growth(a->kernel) < 1);
    a->A = a->needs_start_place ? m->o->z[j] : 0;
    const int status = a->needs_start_slope ? fvi_mechanism_slope(m->stepper, j, m->v0, &a->A) : FVI_SUCCESS;
    if (status || (!a->needs_start_slope && !a->needs_start_place) || is_first_order(m)
        || (a->needs_start_slope && damper->past == FVI_INITIAL_HISTORY_CAPUTO))
        return status;
    if (!is_sum && !is_power)
        return rule ? fvi_impulses_of_kernel_at_stages(a->kernel, m->run->h, m->s, rule->c, &a->impulses)
                    : fvi_impulses_of_kernel_alloc(a->kernel, m->run->h, &a->impulses);
    a->each = calloc(a->kernel->count, sizeof *a->each);
    if (!a->each)
        FVI_FAIL("no memory for the adjoint run", FVI_ENOMEM);
    for (size_t l = 0; l < a->kernel->count; l++)
        if (is_power || (a->kernel->term[l].rho != 0 && a->kernel->term[l].alpha < 0.5))
            start_power(m, a, l);
    return FVI_SUCCESS;
}

static int start_history(const fvi_adjoint_mechanism *m, fvi_adjoint_mechanism_damper *a)
{
    const fvi_run *run = m->run;
    double some = 0;
    for (size_t i = 0; i < a->kernel->count; i++)
        some += a->kernel->term[i].rho;
    if (!(some > 0))
        return FVI_SUCCESS;
    if (m->o->rule)
        return fvi_lobatto_history_of_kernel(m->s, a->kernel, run->h, 1, run->steps,
                                             run->memory, fvi_mechanism_tolerance(run),
                                             &a->stages);
    return fvi_kernel_history(a->kernel, is_first_order(m) ? FVI_DELTA_EULER : FVI_DELTA_BDF2,
                              run->h, 1, run->steps + 1, run->memory, run->tolerance,
                              &a->weight, &a->history);
}

/* Start the terms of a kernel with stages. They are the terms of one body with a damping of 1. */
static int start_terms_of_stages(fvi_adjoint_mechanism *m, fvi_adjoint_mechanism_damper *a)
{
    const double one = 1;
    const fvi_system body = { .d = 1, .mass = &one, .damping = &one };
    fvi_run run = *m->run;
    run.system = &body;
    run.law = a->kernel;
    return fvi_stage_terms_start(&run, m->want, m->s, 1, fvi_lobatto_history_tolerance(&run),
                                 a->kernel, &a->of_stages);
}

static int start_terms(fvi_adjoint_mechanism *m, fvi_adjoint_mechanism_damper *a)
{
    int status = FVI_SUCCESS;
    if (!fvi_wanted_kernel_numbers(m->want))
        return status;
    if (m->o->rule)
        return start_terms_of_stages(m, a);
    a->term = calloc(a->kernel->count, sizeof *a->term);
    if (!a->term)
        FVI_FAIL("no memory for the adjoint run", FVI_ENOMEM);
    fvi_run longer = *m->run; /* the method of order 1 pushes node 0, too */
    longer.steps++;
    for (size_t l = 0; !status && l < a->kernel->count; l++) {
        status = fvi_node_term_start(&longer, m->want,
                                     is_first_order(m) ? FVI_DELTA_EULER : FVI_DELTA_BDF2,
                                     a->kernel->term + l, 1, NULL, a->term + l);
        if (!status && a->needs_start_slope && (a->powers || a->impulses))
            status = fvi_node_term_start_impulses(a->term + l, m->run->h, m->want);
    }
    return status;
}

int fvi_adjoint_mechanism_damper_start(fvi_adjoint_mechanism *m, size_t j)
{
    fvi_adjoint_mechanism_damper *a = m->damper + j;
    a->damper = j;
    a->first = j > 0 ? a[-1].first + a[-1].kernel->count : 0;
    a->kernel = damper_of(m, a)->kernel;
    int status = start_impulses(m, a);
    if (!status)
        status = start_history(m, a);
    return status ? status : start_terms(m, a);
}

void fvi_adjoint_mechanism_damper_stop(fvi_adjoint_mechanism_damper *a)
{
    for (size_t l = 0; a->term && l < a->kernel->count; l++)
        fvi_node_term_stop(a->term + l);
    fvi_stage_terms_stop(&a->of_stages);
    fvi_history_free(a->history);
    fvi_lobatto_history_free(a->stages);
    fvi_impulses_of_kernel_free(a->impulses);
    free(a->each);
    free(a->term);
}

/* ---- a step ---- */

void fvi_adjoint_mechanism_damper_impulses(const fvi_adjoint_mechanism *m, size_t k,
                                           fvi_adjoint_mechanism_damper *a, const double *by)
{
    const size_t n = m->o->rule ? m->s : 2;
    double at[FVI_KERNEL_IMPULSE_NODES], slope[FVI_KERNEL_IMPULSE_NODES];
    if (a->impulses) {
        fvi_impulses_of_kernel_at(a->impulses, k, at);
        a->by_A += fvi_dot(n, by, at);
    }
    for (size_t l = 0; l < a->powers; l++) {
        fvi_adjoint_start_power *p = a->each + l;
        fvi_kernel_impulses(&p->power, k, at);
        fvi_kernel_impulses_by_order(&p->power, k, slope);
        p->by_A += p->unit * fvi_dot(n, by, at);
        p->by_A_and_order += p->unit * fvi_dot(n, by, slope);
    }
}

int fvi_adjoint_mechanism_damper_ahead(const fvi_adjoint_mechanism_damper *a, double *eta)
{
    double ahead;
    *eta = 0;
    if (!a->history)
        return FVI_SUCCESS;
    const int status = fvi_history_ahead(a->history, &a->last, &ahead);
    *eta = a->weight * (ahead - a->last);
    return status;
}

static int push_nodes(fvi_adjoint_mechanism *m, fvi_adjoint_mechanism_damper *a,
                      const double *zeta)
{
    const double nu = a->nu[0], change = nu - a->last;
    double H = 0;
    int status = a->history ? fvi_history_push(a->history, &nu, &change, &H) : FVI_SUCCESS;
    a->eta[0] = a->weight * H;
    a->by_origin += a->eta[0];
    a->factor -= nu * m->o->lambda[a->damper];
    for (size_t l = 0; !status && a->term && l < a->kernel->count; l++)
        status = fvi_node_term_accumulate(a->term + l, &nu, &change, zeta, m->want,
                                          a->first + l);
    a->last = nu;
    return status;
}

int fvi_adjoint_mechanism_damper_push(fvi_adjoint_mechanism *m, fvi_adjoint_mechanism_damper *a,
                                      const double *zeta)
{
    const fvi_lobatto_rule *rule = m->o->rule;
    double y[FVI_STAGES];
    int status = FVI_SUCCESS;
    if (!rule)
        return push_nodes(m, a, zeta);
    for (size_t i = 0; i < m->s; i++)
        y[i] = a->nu[m->s - 1 - i] / rule->b[m->s - 1 - i];
    if (a->stages)
        status = fvi_lobatto_history_push(a->stages, y, a->past, NULL);
    if (status || !a->of_stages.each)
        return status;
    for (size_t i = 0; i < m->s; i++) /* the weights of the terms contain h */
        y[i] = -y[i] / m->run->h;
    fvi_stage_terms_accumulate(&a->of_stages, 0, y, m->run->h, zeta, m->want, a->first);
    return fvi_stage_terms_update_history(&a->of_stages, y);
}

/* ---- the end ---- */

/* Return the derivative by A. Add the derivatives by rho and the order of each power; e falls by 2 dalpha. Without
 * stages the terms of the kernel have the derivatives through a slope. */
static double add_impulses(const fvi_adjoint_mechanism *m, const fvi_adjoint_mechanism_damper *a)
{
    const fvi_sensitivities *want = m->want;
    const int has_terms = a->term && a->needs_start_slope;
    double by_A = a->by_A;
    for (size_t l = 0; l < a->powers; l++) {
        const fvi_adjoint_start_power *p = a->each + l;
        const double rho = a->kernel->term[p->term].rho;
        by_A += rho * p->by_A;
        if (want->terms && !has_terms)
            want->terms[a->first + p->term] += a->A * p->by_A;
        if (want->orders && !has_terms)
            want->orders[a->first + p->term] -=
                2 * rho * a->A * (log(m->run->h) * p->by_A + p->by_A_and_order);
    }
    return by_A;
}

/* Refuse an elongation whose rate changes with the place, because no callback gives that derivative. It is 0 for
 * g(x) - u(t). */
static int check_rate(const fvi_adjoint_mechanism *m, const fvi_elongation *of)
{
    int is_fixed;
    const int status = fvi_elongation_rate_is_fixed(of, m->d, m->run->x0, m->room, &is_fixed);
    if (!status && !is_fixed)
        FVI_FAIL("no derivative of a start with a velocity where a damper grows faster than s "
                 "and the rate of its elongation changes with the place",
                 FVI_EUNSUP);
    return status;
}

int fvi_adjoint_mechanism_damper_bar(fvi_adjoint_mechanism *m,
                                     const fvi_adjoint_mechanism_damper *a, double *by_x0)
{
    if (damper_of(m, a)->past != FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE || is_first_order(m)
        || fvi_mechanism_check_stretch(a->kernel, a->damper, NULL) == FVI_SUCCESS)
        return FVI_SUCCESS;
    for (size_t i = 0; by_x0 && i < m->d; i++)
        if (m->G0[a->damper * m->d + i] != 0)
            by_x0[i] = NAN; /* (19.2) */
    return fvi_adjoint_mechanism_names_bar(m, a->damper);
}

int fvi_adjoint_mechanism_damper_end(fvi_adjoint_mechanism *m, fvi_adjoint_mechanism_damper *a,
                                     double *by_x0, double *by_v)
{
    const fvi_damper *damper = damper_of(m, a);
    const size_t d = m->d, j = a->damper;
    const double *G = m->G0 + j * d, by_A = add_impulses(m, a);
    const int is_liouville =
        damper->past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE && is_first_order(m);
    double by_place = m->o->rule || is_liouville ? 0 : a->by_origin, by_slope = 0;
    int status = FVI_SUCCESS;
    if (is_liouville) { /* node 0 has an elongation, but no force acts there */
        const double zeta = m->z0[j];
        a->nu[0] = 0;
        status = push_nodes(m, a, &zeta);
        by_place = -a->eta[0];
    }
    if (a->needs_start_place)
        by_place += by_A;
    if (a->needs_start_slope)
        by_slope = by_A + a->by_drift;
    if (!status && by_slope != 0)
        status = check_rate(m, &damper->of);
    if (!status)
        status = fvi_adjoint_mechanism_names_start(m, j, by_place, by_slope);
    if (status)
        return status;
    for (size_t i = 0; i < d; i++) {
        by_x0[i] += by_place * G[i];
        by_v[i] += by_slope * G[i];
    }
    if (!status && by_slope != 0 && !damper->of.row) { /* z' = grad g . v0 */
        double *H = m->room;
        memset(H, 0, d * d * sizeof *H);
        status = damper->of.hessian(0, d, m->run->x0, by_slope, damper->of.params, H);
        for (size_t i = 0; i < d * d; i++)
            by_x0[i / d] += H[i] * m->v0[i % d];
    }
    if (m->want->damping)
        m->want->damping[j] = a->factor;
    return status;
}
