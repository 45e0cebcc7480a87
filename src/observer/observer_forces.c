/* src/observer/observer_forces.c -- The force of a damper from its impulses, and the forces at t = 0.
 *
 * The steps sum the impulse J of each damper. Its force is J', by differences of J in the last rows. Near the start J
 * is not smooth, so there it is divided by a function with the same singularity first: by the impulse of a known
 * motion, if the responses of the law are known (observer_law.h), or else by a power of t. In this file j counts
 * forces, k counts rows from t = 0, and n is the degree of a difference. */
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
    if (n == 1)
        return 3;
    return 3 * n > 90 / n ? 3 * n : 90 / n;
}

size_t fvi_observer_motion_rows(const fvi_observer *o)
{
    for (size_t j = 0; j < o->dampers; j++)
        if (o->growth[j] > 1 && o->line[j] != 0)
            return o->degree + 1;
    return fvi_observer_first_rows(o);
}

/* ---- differences ---- */

/* Return h f'(0) by backward differences of degree n, with change[i] = f(-i h) - f(0):
 *
 *     h f'(0) = sum_{i=1}^{n} (-1)^i binom(n, i) / i change[i],    exact up to the degree n */
static double differentiate(size_t n, const double *change)
{
    double sum = 0, binomial = 1; /* with its sign */
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

/* Return h J' where J = t^q g(t) near the start: J' = t^q g' + q J / t. The difference of g leaves out the row at t =
 * 0, where g is 0/0. */
static double force_near_start_of_power(const fvi_observer *o, size_t j, size_t k)
{
    const size_t n = k - 1 < o->degree ? k - 1 : o->degree;
    const double q = o->exponent[j], J = o->impulse[j];
    double change[FVI_MOST_DIFFERENCES + 1];
    impulse_changes(o, j, n, change);
    for (size_t i = 1; i <= n; i++) /* t^q times the change of g */
        change[i] = (J + change[i])
                        * pow((double)k / (double)(k - i), q)
                    - J;
    return differentiate(n, change) + q * J / (double)k;
}

/* ---- the first rows of a law, (13.20) ---- */

/* Return nonzero if the first step gives almost no impulse for a parabola. Only form D of two stages does so. `rows`
 * are the rows of the law, row 1 first. */
static int misses_parabola(const fvi_law_row *rows)
{
    return fabs(rows->summed[FVI_PARABOLA]) < 0.1 * rows->exact[FVI_PARABOLA + 1];
}

/* How the impulse J of a force is compared with the impulses S of known motions (observer_law.h):
 *
 *     J = sum_{i < motion} size_i S_i + g S_motion
 *
 * The jump and the line at the start are known exactly, so that g is smooth. */
typedef struct {
    size_t motion;      /* FVI_LINE or FVI_PARABOLA */
    size_t first_known; /* the first row whose S_motion gives information */
    double size[2];     /* of the jump and of the line of the elongation at the start */
} comparison;

/* Choose the motion. It is the line for an order above 1, where z goes on like t^(3 - 2 alpha) and not like t^2, and if
 * the first step misses the parabola. */
static comparison choose_comparison(const fvi_observer *o, size_t j, size_t damper, const fvi_law_row *rows)
{
    const int takes_line = o->is_moving[j] != 0 && (o->growth[damper] > 1 || misses_parabola(rows));
    return (comparison){ .motion = takes_line ? FVI_LINE : FVI_PARABOLA,
                         .first_known = !takes_line && misses_parabola(rows) ? 2 : 1,
                         .size = { o->jump[j], o->line[j] } };
}

/* Return g in the row `row` of the law, where the force has the impulse J. In a row before the first known one the
 * exact impulse of the motion takes the place of S. */
static double find_smooth_factor(const comparison *c, const fvi_law_row *row, double J, int is_known)
{
    double rest = J;
    for (size_t i = 0; i < c->motion; i++)
        rest -= c->size[i] * row->summed[i];
    return rest / (is_known ? row->summed[c->motion] : row->exact[c->motion + 1]);
}

/* Return the impulse that is missing in damper j at row k, because the steps near the start have errors. `bend` has the
 * errors of its elongation in rows 1, 2, ... (29.24). They are polygons: at each node i begins a line whose slope is
 * the change of the polygon's slope there. */
static double missing_impulse_of_bend(const fvi_observer *o, size_t j, size_t k, double h, const fvi_law_row *rows)
{
    const double *bend = o->bend + j * fvi_observer_first_rows(o);
    double sum = 0;
    for (size_t i = 0; i < k && o->bends > 0; i++) {
        const double next = bend[i], now = i > 0 ? bend[i - 1] : 0, before = i > 1 ? bend[i - 2] : 0;
        sum += (next - 2 * now + before) / h * rows[k - i - 1].uncorrected_line;
    }
    return sum;
}

/* Return h J' of force j at row k by (13.20).
 *
 *   damper   the index of the damper of this force
 *   is_bent  nonzero: correct the impulses for the errors of the first steps
 *   rows     the rows of the law, row 1 first
 *
 * The difference of g leaves out the row at t = 0, and the first step if it gives no information. */
static double force_near_start_of_law(const fvi_observer *o, size_t j, size_t damper, size_t k, double h, int is_bent,
                                      const fvi_law_row *rows)
{
    const comparison c = choose_comparison(o, j, damper, rows);
    const size_t known = k > c.first_known ? k - c.first_known : 0, n = known < o->degree ? known : o->degree;
    const double *exact = rows[k - 1].exact;
    double change[FVI_MOST_DIFFERENCES + 1], force = 0, g = 0;
    impulse_changes(o, j, n, change);
    for (size_t i = 0; i < c.motion; i++)
        force += c.size[i] * exact[i];
    for (size_t i = 0; i <= n; i++) { /* row k - i */
        const double missing = is_bent ? missing_impulse_of_bend(o, j, k - i, h, rows) : 0,
                     J = o->impulse[j] + change[i] + missing,
                     factor = find_smooth_factor(&c, rows + k - i - 1, J, k >= c.first_known);
        g = i == 0 ? factor : g;
        change[i] = factor - g;
    }
    return h * (force + g * exact[c.motion]) + exact[c.motion + 1] * differentiate(n, change);
}

/* Return the rows of the law of force j, row 1 first. Return NULL if the force cannot be compared: the velocity of a
 * massless coordinate at the start is not known, or the steps do not sum the impulse of a jump. */
static const fvi_law_row *rows_of_law(const fvi_observer *o, size_t j, size_t damper)
{
    const fvi_law_row *rows = o->has_massless ? NULL : fvi_law_rows_of(&o->law_rows, damper);
    return rows && (o->is_jumping[j] == 0 || rows->summed[FVI_JUMP] > 0) ? rows : NULL;
}

/* Return the index of the damper that exerts force j. */
static size_t damper_of_force(const fvi_observer *o, size_t j)
{
    return o->has_mechanism ? j : j / o->d;
}

int fvi_observer_is_compared(const fvi_observer *o, size_t j)
{
    return rows_of_law(o, j, damper_of_force(o, j)) != NULL;
}

/* Return h J' of force j at a row k near the start. */
static double force_near_start(const fvi_observer *o, size_t j, size_t k, double h)
{
    const size_t damper = damper_of_force(o, j);
    const fvi_law_row *rows = rows_of_law(o, j, damper);
    return rows ? force_near_start_of_law(o, j, damper, k, h, 0, rows) : force_near_start_of_power(o, j, k);
}

void fvi_observer_compare_forces(const fvi_observer *o, size_t k, double h, double *force)
{
    for (size_t j = 0; j < o->forces; j++) {
        const fvi_law_row *rows = rows_of_law(o, j, j);
        if (rows)
            force[j] = force_near_start_of_law(o, j, j, k, h, 1, rows) / h;
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

void fvi_observer_differences(const fvi_observer *o, size_t k, double h, double *slope)
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

/* Add the force of damper j to the sum of forces on the coordinates: its force along the elongation times the gradient
 * of the elongation. o->change is room for the gradient. */
static int add_force_of_elongation(const fvi_observer *o, const fvi_stepper *s, size_t j, double *sum)
{
    const fvi_elongation *of = &s->run.system->mechanism->damper[j].of;
    int status = FVI_SUCCESS;
    if (!of->row)
        status = of->gradient(s->t, o->d, s->x, of->params, o->change);
    for (size_t i = 0; i < o->d && !status; i++)
        sum[i] += (of->row ? of->row[i] : o->change[i]) * o->force[j];
    return status;
}

int fvi_observer_damping(const fvi_observer *o, const fvi_stepper *s, double *sum)
{
    int status = FVI_SUCCESS;
    memset(sum, 0, o->d * sizeof *sum);
    for (size_t j = 0; j < o->dampers && !status; j++) {
        if (o->has_mechanism)
            status = add_force_of_elongation(o, s, j, sum);
        for (size_t i = 0; i < o->d && !o->has_mechanism; i++)
            sum[i] += o->force[j * o->d + i];
    }
    return status;
}

/* ---- the start ---- */

/* Return the factor of s in C(s) for large s, for a damper of the order 1. */
static double dashpot_coefficient(const fvi_run_damper *of)
{
    return of->law ? fvi_kernel_dashpot(of->law) : of->rho;
}

/* Return lim C(s) for s to infinity, which is the stiffness that a jump meets at first. The order of the damper is 0.
 * If its law contains orders 2 alpha close to 0, below 0.06, the limit is taken to 1e-15. */
static double stiffness_of_jump(const fvi_run_damper *of)
{
    const double limit = of->growth == 0 ? fvi_run_damper_symbol(of, 1e250) : INFINITY;
    return isfinite(limit) ? limit : INFINITY;
}

/* Return 1 if the elongation of a damper jumps from 0 to z0 at t = 0 for its history. */
static int does_jump(fvi_initial_history past, double z0)
{
    return past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE && z0 != 0;
}

/* Return the force of a damper just after t = 0, if its elongation begins with z0 and the velocity zdot. Return
 * INFINITY if it is infinite. */
static double force_at_start(const fvi_run_damper *of, double z0, double zdot)
{
    const double order = of->growth;
    if (does_jump(of->past, z0)) {
        if (order == 0)
            return stiffness_of_jump(of) * z0;
        return order == 1 && !of->law ? of->rho * zdot : INFINITY;
    }
    if (order < 1 || zdot == 0)
        return 0;
    if (order == 1)
        return dashpot_coefficient(of) * zdot;
    return of->past == FVI_INITIAL_HISTORY_CAPUTO ? 0 : INFINITY;
}

/* Return the exponent q with which the impulse of a damper begins, J = t^q g(t). A jump of z gives 1 - order, a line
 * gives 2 - order. */
static double exponent_at_start(double order, fvi_initial_history past, double z0)
{
    return does_jump(past, z0) && order < 1 ? 1 - order : 2 - order;
}

double fvi_observer_begin_force(const fvi_run *run, size_t damper, double jump, double line)
{
    const fvi_run_damper of = fvi_run_damper_of(run, damper);
    return force_at_start(&of, jump, line);
}

/* Store the jump z0 and the velocity zdot with which the elongation of force j begins, times `factor`. */
static void store_start(fvi_observer *o, size_t j, const fvi_run_damper *of, double factor, double z0, double zdot)
{
    const int is_jumping = does_jump(of->past, z0);
    o->jump[j] = is_jumping ? factor * z0 : 0;
    o->line[j] = factor * zdot;
    o->is_jumping[j] = is_jumping; /* also if the factor is 0 */
    o->is_moving[j] = zdot != 0;
}

/* Compute the forces at t = 0 of one law or alpha, or of the dampers of a structure: each has a force on every
 * coordinate. The elongations are x0, or C x0 with the matrix of the damper; o->change and o->F are room for them and
 * for their velocities. */
static int begin_coordinates(fvi_observer *o, const fvi_stepper *s)
{
    const fvi_run *run = &s->run;
    const size_t d = o->d;
    double *z = o->change, *zdot = o->matrices ? o->F : o->v;
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
            const double factor = o->matrices ? 1 : run->system->damping[i];
            const int exerts_none = factor == 0 || of.rho == 0; /* an infinite force times 0 would be NaN */
            o->exponent[j * d + i] = exponent_at_start(of.growth, of.past, z[i]);
            store_start(o, j * d + i, &of, factor, z[i], zdot[i]);
            o->start[j * d + i] = exerts_none ? 0 : factor * force_at_start(&of, z[i], zdot[i]);
        }
    }
    return status;
}

int fvi_observer_elongation(fvi_observer *o, const fvi_stepper *s, const fvi_elongation *of, double *z, double *rate)
{
    const double *row = of->row;
    int status = FVI_SUCCESS;
    *z = *rate = 0;
    if (!row) { /* z = g(t, x), zdot = dg/dt + grad g . v; the gradient goes to o->F */
        if (of->rate)
            status = of->rate(0, o->d, s->x, of->params, rate);
        if (!status)
            status = of->value(0, o->d, s->x, of->params, z);
        if (!status)
            status = of->gradient(0, o->d, s->x, of->params, o->F);
    }
    for (size_t i = 0; i < o->d && !status; i++) {
        *z += row ? row[i] * s->x[i] : 0;
        *rate += (row ? row[i] : o->F[i]) * o->v[i];
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

/* Compute the forces of the dampers of a mechanism, its accelerations and its multipliers at t = 0. */
static int begin_mechanism(fvi_observer *o, const fvi_stepper *s)
{
    const fvi_damper *damper = s->run.system->mechanism->damper;
    int status = FVI_SUCCESS;
    for (size_t j = 0; j < o->dampers && !status; j++) {
        const fvi_run_damper of = fvi_run_damper_of(&s->run, j);
        double z, zdot;
        status = fvi_observer_elongation(o, s, &damper[j].of, &z, &zdot);
        o->exponent[j] = exponent_at_start(of.growth, of.past, z);
        store_start(o, j, &of, 1, z, zdot);
        o->start[j] = force_at_start(&of, z, zdot);
    }
    for (size_t i = o->forces; i < o->tracked; i++) {
        o->exponent[i] = NAN;
        o->start[i] = INFINITY; /* the first node has no slope */
    }
    return status ? status : fvi_observer_begin_motion(o, s);
}

int fvi_observer_begin_forces(fvi_observer *o, const fvi_stepper *s)
{
    const int sums_are_impulses = s->method->takes_mechanism || fvi_ramp_method(s);
    int status = fvi_observer_velocity(o, s, s->p, o->v);
    if (!status && o->begin_v_known)
        fvi_observer_put_massless(o, s, o->v);
    if (!status)
        status = o->has_mechanism ? begin_mechanism(o, s) : begin_coordinates(o, s);
    for (size_t j = 0; j < o->dampers; j++)
        o->growth[j] = fvi_run_damper_of(&s->run, j).growth;
    if (!status && o->is_damped && !o->is_mass && sums_are_impulses && !s->method->dense)
        status = fvi_law_rows_start(&o->law_rows, s, o->dampers, fvi_observer_first_rows(o));
    for (size_t j = 0; j < o->tracked && !o->is_mass; j++) {
        o->is_infinite |= isinf(o->start[j]) != 0;
        o->has_infinite_force |= j < o->forces && isinf(o->start[j]);
    }
    return status;
}
