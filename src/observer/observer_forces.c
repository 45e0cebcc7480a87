/* src/observer/observer_forces.c -- The force of a damper from its impulses, and the forces at t = 0. */
#include "observer_state.h"
#include "kernel/kernel_terms.h"
#include "methods/damping.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* At row k a difference of degree n, over n + 1 rows, of a power of t has an error of about k^-(n + 1). Behind so many
 * rows it is 1e-4 at most. Differences of degree 1 are the forces of their method itself. */
size_t fvi_observer_first_rows(const fvi_observer *o)
{
    const size_t n = o->degree;
    return n == 1 ? 3 : 3 * n > 90 / n ? 3 * n : 90 / n;
}

size_t fvi_observer_motion_rows(const fvi_observer *o)
{
    for (size_t j = 0; j < o->dampers; j++)
        if (o->growth[j] > 1 && o->line[j] != 0)
            return o->degree + 1;
    return fvi_observer_first_rows(o);
}

/* ---- differences ---- */

/* Backward differences: f'(0) h = sum_{i=1}^{n} c_i (f(-i h) - f(0)), c_i = (-1)^i binom(n, i) / i, exact up to the
 * degree n. */
static double differentiate(size_t n, const double *change)
{
    double sum = 0, binomial = 1;
    for (size_t i = 1; i <= n; i++) {
        binomial *= -(double)(n + 1 - i) / (double)i;
        sum += binomial / (double)i * change[i];
    }
    return sum;
}

/* Write J of force j in the last n rows before this one, minus J in this row. */
static void impulse_changes(const fvi_observer *o, size_t j, size_t n, double *change)
{
    change[0] = 0;
    for (size_t i = 1; i <= n; i++)
        change[i] = change[i - 1] - o->latest[(i - 1) * o->tracked + j];
}

/* h J' where J = t^q g(t) near the start: J' = t^q g' + q J / t. g is taken without t = 0. */
static double force_near_start_of_power(const fvi_observer *o, size_t j, size_t k)
{
    const size_t n = k - 1 < o->degree ? k - 1 : o->degree;
    const double q = o->exponent[j], J = o->impulse[j];
    double change[FVI_MOST_DIFFERENCES + 1];
    impulse_changes(o, j, n, change);
    for (size_t i = 1; i <= n; i++)
        change[i] = (J + change[i])
                        * pow((double)k / (double)(k - i), q)
                    - J;
    return differentiate(n, change) + q * J / (double)k;
}

/* Return nonzero if the first step gives almost no impulse for a parabola. Only form D of two stages does so. */
static int misses_parabola(const fvi_law_row *first)
{
    return fabs(first->summed[FVI_PARABOLA]) < 0.1 * first->exact[FVI_PARABOLA + 1];
}

/* The motion with whose S the impulse of force j is compared: J = ... + g S, g smooth. The jumps and lines before it
 * are subtracted exactly. It is the line for an order above 1, where z goes on like t^(3 - 2 alpha) and not like t^2,
 * and if the first step misses the parabola. */
static size_t compared_with(const fvi_observer *o, size_t j, size_t damper, const fvi_law_row *first)
{
    return o->is_moving[j] != 0 && (o->growth[damper] > 1 || misses_parabola(first)) ? FVI_LINE : FVI_PARABOLA;
}

/* The impulse that is missing in damper j at row k: its elongation misses a line of slope change_i from each node i
 * on. */
static double missing_impulse_of_bend(const fvi_observer *o, size_t j, size_t k, double h, const fvi_law_row *first)
{
    const double *bend = o->bend + j * fvi_observer_first_rows(o) - 1; /* of rows 1, 2, ... */
    double sum = 0;
    for (size_t i = 0; i < k && o->bends > 0; i++) {
        const double now = i > 0 ? bend[i] : 0, before = i > 1 ? bend[i - 1] : 0;
        sum += (bend[i + 1] - 2 * now + before) / h * first[k - i - 1].uncorrected_line;
    }
    return sum;
}

/* h J' by (13.20), without t = 0, and without a first step that gives no information. */
static double force_near_start_of_law(const fvi_observer *o, size_t j, size_t damper, size_t k, double h, int is_bent,
                                      const fvi_law_row *first)
{
    const size_t to = compared_with(o, j, damper, first),
                 from = to == FVI_PARABOLA && misses_parabola(first) ? 2 : 1, known = k > from ? k - from : 0,
                 n = known < o->degree ? known : o->degree;
    const double size[] = { o->jump[j], o->line[j] }, *exact = first[k - 1].exact;
    double change[FVI_MOST_DIFFERENCES + 1], force = 0, g = 0;
    impulse_changes(o, j, n, change);
    for (size_t i = 0; i < to; i++)
        force += size[i] * exact[i];
    for (size_t i = 0; i <= n; i++) {
        const fvi_law_row *row = first + k - i - 1;
        double rest = o->impulse[j] + change[i] + (is_bent ? missing_impulse_of_bend(o, j, k - i, h, first) : 0);
        for (size_t of = 0; of < to; of++)
            rest -= size[of] * row->summed[of];
        rest /= k < from ? row->exact[to + 1] : row->summed[to];
        g = i == 0 ? rest : g;
        change[i] = rest - g;
    }
    return h * (force + g * exact[to]) + exact[to + 1] * differentiate(n, change);
}

/* The rows of the law of force j, or NULL if its start cannot be compared with anything. */
static const fvi_law_row *rows_of(const fvi_observer *o, size_t j, size_t damper)
{
    const fvi_law_row *first = o->has_massless ? NULL : fvi_law_rows_of(&o->law_rows, damper);
    return first && (o->is_jumping[j] == 0 || first->summed[FVI_JUMP] > 0) ? first : NULL;
}

int fvi_observer_is_compared(const fvi_observer *o, size_t j)
{
    return rows_of(o, j, o->has_mechanism ? j : j / o->d) != NULL;
}

static double force_near_start(const fvi_observer *o, size_t j, size_t k, double h)
{
    const size_t damper = o->has_mechanism ? j : j / o->d;
    const fvi_law_row *first = rows_of(o, j, damper);
    return first ? force_near_start_of_law(o, j, damper, k, h, 0, first) : force_near_start_of_power(o, j, k);
}

void fvi_observer_compare_forces(const fvi_observer *o, size_t k, double h, double *force)
{
    for (size_t j = 0; j < o->forces; j++) {
        const fvi_law_row *first = rows_of(o, j, j);
        if (first)
            force[j] = force_near_start_of_law(o, j, j, k, h, 1, first) / h;
    }
}

double fvi_observer_slope(const fvi_observer *o, size_t j, size_t k, double h)
{
    double change[FVI_MOST_DIFFERENCES + 1];
    const size_t n = k < o->degree ? k : o->degree;
    if (k <= fvi_observer_first_rows(o) && !isnan(o->exponent[j]))
        return force_near_start(o, j, k, h) / h;
    impulse_changes(o, j, n, change);
    return differentiate(n, change) / h;
}

void fvi_observer_differences(const fvi_observer *o, size_t k, double h,
                              double *slope)
{
    if (k == 0) {
        memcpy(slope, o->start, o->tracked * sizeof *slope);
        return;
    }
    for (size_t j = 0; j < o->tracked; j++) {
        slope[j] = fvi_observer_slope(o, j, k, h);
        if (k == 1 && j >= o->forces + o->slopes) /* the slope of a parabola, as at the start */
            slope[j] = 2 * slope[j] - o->start[j];
    }
}

/* Add the force of damper j, along its elongation. */
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

/* The factor of s in C(s) for large s, for a damper of the order 1. */
static double dashpot_coefficient(const fvi_run_damper *of)
{
    return of->law ? fvi_kernel_dashpot(of->law) : of->rho;
}

/* lim C(s) for s to infinity: the stiffness that a jump meets at first. For a law of the order 0 which contains orders
 * 2 alpha close to 0, below 0.06, the limit is taken to 1e-15. */
static double stiffness_of_jump(const fvi_run_damper *of)
{
    const double limit = of->growth == 0 ? fvi_run_damper_symbol(of, 1e250) : INFINITY;
    return isfinite(limit) ? limit : INFINITY;
}

/* The force of a damper at t = 0+, if its elongation begins with the velocity zdot and, with Riemann and Liouville's
 * past, jumps by z0. INFINITY if it is infinite. */
static double force_at_start(const fvi_run_damper *of, double z0, double zdot)
{
    const double order = of->growth;
    if (of->past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE && z0 != 0)
        return order == 0             ? stiffness_of_jump(of) * z0
               : order == 1 && !of->law ? of->rho * zdot
                                        : INFINITY;
    if (order < 1 || zdot == 0)
        return 0;
    if (order == 1)
        return dashpot_coefficient(of) * zdot;
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

double fvi_observer_begin_force(const fvi_run *run, size_t damper, double jump, double line)
{
    const fvi_run_damper of = fvi_run_damper_of(run, damper);
    return force_at_start(&of, jump, line);
}

/* Store the jump and the line with which the elongation of force j begins, times `factor`. */
static void store_start(fvi_observer *o, size_t j, const fvi_run_damper *of, double factor, double z0, double zdot)
{
    const int is_jumping = of->past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE && z0 != 0;
    o->jump[j] = is_jumping ? factor * z0 : 0;
    o->line[j] = factor * zdot;
    o->is_jumping[j] = is_jumping; /* also if the factor is 0 */
    o->is_moving[j] = zdot != 0;
}

/* The start of one law or alpha, or of the dampers of a structure: each has a force on every coordinate. */
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
            store_start(o, j * d + i, &of, factor, z[i], rate);
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

int fvi_observer_begin_motion(fvi_observer *o, const fvi_stepper *s)
{
    for (size_t j = 0; j < o->forces; j++)
        if (!isfinite(o->start[j]))
            return FVI_SUCCESS;
    int status = o->tracked > o->forces ? fvi_step_force(s, 0, o->F) : FVI_EUNSUP;
    memcpy(o->force, o->start, o->forces * sizeof *o->force);
    if (!status)
        status = fvi_observer_motion(o, s, 0, s->x);
    if (!status)
        memcpy(o->start + o->forces, o->force + o->forces, (o->tracked - o->forces) * sizeof *o->start);
    return status == FVI_ENOMEM ? status : FVI_SUCCESS;
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
        store_start(o, j, &of, 1, z, rate);
        o->start[j] = force_at_start(&of, z, rate);
    }
    for (size_t i = o->forces; i < o->tracked; i++) {
        o->exponent[i] = NAN;
        o->start[i] = INFINITY; /* the first node has no slope */
    }
    return status ? status : fvi_observer_begin_motion(o, s);
}

int fvi_observer_begin_forces(fvi_observer *o, const fvi_stepper *s)
{
    int status = fvi_observer_velocity(o, s, s->p, o->v);
    if (!status && o->begin_v_known)
        fvi_observer_put_massless(o, s, o->v);
    if (!status)
        status = o->has_mechanism ? begin_mechanism(o, s)
                                  : begin_coordinates(o, s);
    for (size_t j = 0; j < o->dampers; j++) {
        const fvi_run_damper of = fvi_run_damper_of(&s->run, j);
        o->growth[j] = of.growth;
    }
    if (!status && o->is_damped && !o->is_mass && (s->method->takes_mechanism || fvi_ramp_method(s)) && !s->method->dense)
        status = fvi_law_rows_start(&o->law_rows, s, o->dampers, fvi_observer_first_rows(o));
    for (size_t j = 0; j < o->tracked && !o->is_mass; j++) {
        o->is_infinite |= isinf(o->start[j]) != 0;
        o->has_infinite_force |= j < o->forces && isinf(o->start[j]);
    }
    return status;
}
