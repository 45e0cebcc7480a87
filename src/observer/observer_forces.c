/* src/observer/observer_forces.c -- A damper's force from its impulses. */
#include "observer_state.h"
#include "kernel/kernel_terms.h"
#include "methods/damping.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- differences ---- */

/* f'(0) h = sum_{i=1}^{n} c_i (f(-i h) - f(0)), c_i = (-1)^i binom(n, i) / i, exact up to the
 * degree n. */
static double backward(size_t n, const double *change)
{
    double sum = 0, binomial = 1;
    for (size_t i = 1; i <= n; i++) {
        binomial *= -(double)(n + 1 - i) / (double)i;
        sum += binomial / (double)i * change[i];
    }
    return sum;
}

/* J of force number j, steps back, less J now. */
static void changes(const fvi_observer *o, size_t j, size_t n, double *change)
{
    change[0] = 0;
    for (size_t i = 1; i <= n; i++)
        change[i] = change[i - 1] - o->latest[(i - 1) * o->tracked + j];
}

/* At first J = t^q g(t): J' = t^q g' + q J / t, and g is taken without t = 0. */
static double near_start(const fvi_observer *o, size_t j, size_t k)
{
    const size_t n = k - 1 < o->degree ? k - 1 : o->degree;
    const double q = o->exponent[j], J = o->impulse[j];
    double change[FVI_MOST_DIFFERENCES + 1];
    changes(o, j, n, change);
    for (size_t i = 1; i <= n; i++)
        change[i] = (J + change[i])
                        * pow((double)k / (double)(k - i), q)
                    - J;
    return backward(n, change) + q * J / (double)k;
}

void fvi_observer_differences(const fvi_observer *o, size_t k, double h,
                              double *slope)
{
    double change[FVI_MOST_DIFFERENCES + 1];
    if (k == 0) {
        memcpy(slope, o->start, o->tracked * sizeof *slope);
        return;
    }
    for (size_t j = 0; j < o->tracked; j++) {
        const int plain = k > 3 * o->degree || isnan(o->exponent[j]);
        const size_t n = k < o->degree ? k : o->degree;
        if (plain)
            changes(o, j, n, change);
        slope[j] = (plain ? backward(n, change) : near_start(o, j, k)) / h;
        if (k == 1 && j >= o->forces + o->slopes) /* of a parabola, as at the start */
            slope[j] = 2 * slope[j] - o->start[j];
    }
}

/* Of damper j, along its elongation. */
static int add_elongation(const fvi_observer *o, const fvi_stepper *s, size_t j,
                          double *sum)
{
    const fvi_elongation *of = &s->run.system->mechanism->damper[j].of;
    int status = FVI_SUCCESS;
    if (!of->row)
        status = of->gradient(s->t, o->d, s->x, of->params, o->change);
    for (size_t i = 0; i < o->d && !status; i++)
        sum[i] += (of->row ? of->row[i] : o->change[i]) * o->force[j];
    return status;
}

int fvi_observer_damping(const fvi_observer *o, const fvi_stepper *s,
                         double *sum)
{
    int status = FVI_SUCCESS;
    memset(sum, 0, o->d * sizeof *sum);
    for (size_t j = 0; j < o->dampers && !status; j++) {
        if (o->has_mechanism)
            status = add_elongation(o, s, j, sum);
        for (size_t i = 0; i < o->d && !o->has_mechanism; i++)
            sum[i] += o->force[j * o->d + i];
    }
    return status;
}

/* ---- the start ---- */

/* What stands before s in C(s) for large s, of a damper of the order 1. */
static double dashpot(const fvi_run_damper *of)
{
    return of->law ? fvi_kernel_dashpot(of->law) : of->rho;
}

/* A damper's force at t = 0+ of an elongation with the velocity zdot and, of Riemann and
 * Liouville's past, a jump by z0. INFINITY where there is none, and of a law that jumps, where it is not known. */
static double force_at_start(const fvi_run_damper *of, double z0, double zdot)
{
    const double order = of->growth;
    if (of->past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE && z0 != 0)
        return of->law      ? INFINITY
               : order == 0 ? of->rho * z0
               : order == 1 ? of->rho * zdot
                            : INFINITY;
    if (order < 1 || zdot == 0)
        return 0;
    if (order == 1)
        return dashpot(of) * zdot;
    return of->past == FVI_INITIAL_HISTORY_CAPUTO ? 0 : INFINITY;
}

static double exponent_at_start(double order, fvi_initial_history past,
                                double z0)
{
    return past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE && z0 != 0
                   && order < 1
               ? 1 - order
               : 2 - order;
}

/* One law or alpha, or the dampers of a structure: each with a force on every coordinate. */
static int begin_coordinates(fvi_observer *o, const fvi_stepper *s)
{
    const fvi_run *run = &s->run;
    const size_t d = o->d;
    double *z = o->change;
    int status = FVI_SUCCESS;
    memcpy(z, run->x0, d * sizeof *z);
    for (size_t j = 0; j < o->dampers && !status; j++) {
        const fvi_run_damper of = fvi_run_damper_of(run, j);
        memset(o->F, 0, d * sizeof *o->F);
        if (o->matrices) {
            memset(z, 0, d * sizeof *z);
            status = fvi_damping_multiply(&of.matrix, d, 1, run->x0, z);
        }
        if (o->matrices && !status)
            status = fvi_damping_multiply(&of.matrix, d, 1, o->v, o->F);
        for (size_t i = 0; i < d && !status; i++) {
            const double factor = o->matrices ? 1 : run->system->damping[i],
                         rate = o->matrices ? o->F[i] : o->v[i];
            o->exponent[j * d + i] =
                exponent_at_start(of.growth, of.past, z[i]);
            o->start[j * d + i] =
                factor == 0 || of.rho == 0
                    ? 0
                    : factor * force_at_start(&of, z[i], rate);
        }
    }
    return status;
}

int fvi_observer_elongation(fvi_observer *o, const fvi_stepper *s,
                            const fvi_elongation *of, double *z, double *rate)
{
    int status = FVI_SUCCESS;
    *z = *rate = 0;
    if (!of->row && of->rate)
        status = of->rate(0, o->d, s->x, of->params, rate);
    if (!of->row && !status)
        status = of->value(0, o->d, s->x, of->params, z);
    if (!of->row && !status)
        status = of->gradient(0, o->d, s->x, of->params, o->F);
    for (size_t i = 0; i < o->d && !status; i++) {
        *z += of->row ? of->row[i] * s->x[i] : 0;
        *rate += (of->row ? of->row[i] : o->F[i]) * o->v[i];
    }
    return status;
}

static int begin_mechanism(fvi_observer *o, const fvi_stepper *s)
{
    const fvi_mechanism *m = s->run.system->mechanism;
    int status = FVI_SUCCESS;
    for (size_t j = 0; j < o->dampers && !status; j++) {
        const fvi_damper *damper = &m->damper[j];
        const fvi_run_damper of = fvi_run_damper_of(&s->run, j);
        double z, rate;
        status = fvi_observer_elongation(o, s, &damper->of, &z, &rate);
        o->exponent[j] = exponent_at_start(of.growth, of.past, z);
        o->start[j] = force_at_start(&of, z, rate);
    }
    for (size_t i = o->forces; i < o->tracked; i++) {
        o->exponent[i] = NAN;
        o->start[i] = INFINITY; /* there is no slope at the first node */
    }
    return status;
}

int fvi_observer_begin_forces(fvi_observer *o, const fvi_stepper *s)
{
    int status = fvi_observer_velocity(o, s, s->p, o->v);
    if (!status)
        status = o->has_mechanism ? begin_mechanism(o, s)
                                  : begin_coordinates(o, s);
    for (size_t j = 0; j < o->tracked && !o->is_mass; j++)
        o->is_infinite |= isinf(o->start[j]) != 0;
    return status;
}
