/* src/adaptive/variable_steps.c -- Steps of any length.               [Chapter 22]
 *
 * A step from t_k to t_k + h, for each coordinate, with v_k = p_k / m and the unknown
 * delta = V - v_k 1, V the velocities at the s stages:
 *
 *     [m A^{-1} + rho h^{1-beta} W0] delta + h grad U(X)
 *         = h (F - rho H) - [beta <= 0] rho h^{1-beta} W0 1 v_k,            (22.14)
 *     X = x_k 1 + h c v_k + h A delta,
 *     x_{k+1} = X_s,   v_{k+1} = V_s.
 *
 * H is the history (22.10). x'' at the stages is A^{-1} delta / h, whatever the forces:
 * the last of its Legendre coefficients says how good the step is, all of them give x
 * and p in between. Form M, for rho = 0, has another matrix in place of A (22.15). */
#include <fvi/variable_steps.h>

#include "adaptive.h"
#include "memory/memory_kinds.h" /* FVI_VECTORS */
#include "system/fail.h"
#include "system/larger.h"

#include <gsl/gsl_machine.h>
#include <gsl/gsl_math.h>
#include <string.h>

/* ---- the equation ---- */

static double stage_time(const fvi_adaptive_run *o, size_t i)
{
    return fvi_adaptive_stage_time(o->rule, o->t, o->length.h, i);
}

/* Eight stages of a coordinate as two times four numbers; those beyond the s-th are of no
 * use. */
#define LANES(x) ((fvi_four *)(x))

/* What a singular start adds to base and R. */
static void drive_singular(fvi_adaptive_run *o)
{
    for (size_t i = 0; i < o->rule->s; i++) {
        const double t = stage_time(o, i);
        for (size_t j = 0; j < o->d; j++) {
            double G, pull;
            fvi_singular_at(&o->singular, j, t, &G, NULL, &pull);
            o->base[j * FVI_LANES + i] += G;
            o->R[j * FVI_LANES + i] -= o->length.h * pull;
        }
    }
}

/* base = x_k + h c v_k */
FVI_VECTORS static void glide(fvi_adaptive_run *o)
{
    const fvi_four *c = LANES(o->rule->c);
    for (size_t j = 0; j < o->d; j++) {
        const double x = o->y[j], move = o->length.h * o->v[j];
        fvi_four *base = LANES(o->base + j * FVI_LANES);
        base[0] = x + move * c[0];
        base[1] = x + move * c[1];
    }
}

/* base, R = h F; and what a singular start adds to both. */
//> drive
static int drive(fvi_stepper *s, fvi_adaptive_run *o)
{
    const double h = o->length.h;
    glide(o);
    if (!s->run.system->force.value)
        memset(o->R, 0, o->d * FVI_LANES * sizeof *o->R);
    for (size_t i = 0; i < o->rule->s && s->run.system->force.value; i++) {
        int status = fvi_force_at(s, stage_time(o, i));
        if (status)
            return status;
        for (size_t j = 0; j < o->d; j++)
            o->R[j * FVI_LANES + i] = h * s->F[j];
    }
    if (fvi_singular_is(o, o->t))
        drive_singular(o);
    return FVI_SUCCESS;
}
//< drive

//> remember
/* R -= h rho H, and rho h^{1-beta} W0 1 v_k where the memory has v, not v - v_k; or of what
 * v has jumped by. */
FVI_VECTORS static void remember(fvi_adaptive_run *o)
{
    const double h = o->length.h;
    const fvi_four *W1 = LANES(o->W1);
    for (size_t j = 0; j < o->d; j++) {
        const fvi_kind *kind = &o->of_kind[o->kind[j]];
        const double now = kind->drag * (o->beta <= 0 ? o->v[j] : o->kick[j]),
                     spring = o->beta == -1
                                  ? h * kind->damping * (o->y[j] - o->centre[j])
                                  : 0;
        fvi_four *R = LANES(o->R + j * FVI_LANES);
        R[0] -= now * W1[0] + spring;
        R[1] -= now * W1[1] + spring;
    }
    for (size_t l = 0; o->modes && l < o->damped; l++) {
        const size_t j = o->index[l];
        const double factor = h * o->of_kind[o->kind[j]].damping;
        double H[FVI_LANES];
        fvi_modes_history(o->modes, l, H);
        fvi_four *R = LANES(o->R + j * FVI_LANES);
        R[0] -= factor * LANES(H)[0];
        R[1] -= factor * LANES(H)[1];
    }
}
//< remember

/* ---- a trial of a step, and its error ---- */

/* What the last Legendre coefficient a of x'' in a step adds by itself, and should not: to
 * X at the stages, h^2 stage a at most; to v, through what the memory makes of these
 * stages, h slip (drag/m) a. And the quadrature adds h alias a to v, for the coefficients
 * of twice the degree. A velocity 1 moves x by its reach. The largest sum of all
 * coordinates; NaN if one is not finite.                                    (22.16) */
//> estimate
static double estimate(fvi_adaptive_run *o)
{
    const fvi_variable_rule *rule = o->rule;
    const size_t s = rule->s;
    double worst = 0;
    for (size_t j = 0; j < o->d; j++) {
        const fvi_kind *kind = &o->of_kind[o->kind[j]];
        double *bend = o->bend + j * FVI_LANES;
        fvi_square_apply(s, &rule->legendre, o->delta + j * FVI_LANES, bend);
        if (!isfinite(bend[s - 1]))
            return GSL_NAN;
        const double reach = fvi_adaptive_reach(o, kind),
                     of_x = rule->stage * o->length.h,
                     of_v = o->slip * kind->drag / kind->mass + rule->alias;
        worst = larger(worst, (of_x + reach * of_v) * fabs(bend[s - 1]));
    }
    return worst;
}
//< estimate

/* delta of a step of such length, and the estimate of its error. */
static int trial(fvi_stepper *s, fvi_adaptive_run *o, fvi_length length,
                 double *error)
{
    int status = fvi_adaptive_matrices(o, length);
    if (status)
        return status;
    if (o->modes)
        fvi_modes_begin(o->modes, length);
    status = drive(s, o);
    if (status)
        return status;
    remember(o);
    status = fvi_adaptive_solve(s, o);
    if (!status)
        *error = estimate(o);
    return status;
}

/* ---- the length of a step ---- */

//> control
/* How many factors exp(L) the next step is longer: the error is of order h^{s+1}. */
static int change(const fvi_adaptive_run *o, double error)
{
    const double L = fvi_variable_spacing(),
                 order = ((double)o->rule->s + 1) * L;
    const double room = log(o->allowed / error) / order;
    if (error <= o->allowed) { /* (22.17) */
        const double more = floor(0.9 * room - 0.3);
        return more < -1 ? -1 : more < o->growth ? (int)more : o->growth;
    }
    const double less = ceil(log(1.5) / order - room);
    return less < 1                    ? -1
           : less <= FVI_ADAPTIVE_LESS ? -(int)less
                                       : -FVI_ADAPTIVE_LESS; /* NaN, too */
}
//< control

/* Where x'' is smooth, a shorter step has an error of order h^s at least. One that hardly
 * falls tells of a jump that is not declared, whose coefficients hardly fall, and what
 * (22.16) says of it is a hundredth of the truth: until the place is passed it counts so
 * much more. */
static double judge(fvi_adaptive_run *o, double error, double error_before,
                    double h_before)
{
    if (!o->fresh && error_before > 0
        && error > error_before * gsl_pow_4(o->length.h / h_before))
        o->rough = larger(o->rough, o->t + h_before);
    return o->t < o->rough ? 100 * error : error;
}

/* ---- a step ---- */

/* The exponent of the next step, after one that is taken. A step that was made shorter
 * before is not followed by a longer one. */
static void lengthen(fvi_adaptive_run *o, double error, int again)
{
    const int more = change(o, error),
              k = fvi_adaptive_exponent(o->length) + (again && more > 0 ? 0 : more);
    o->next = o->length.k == FVI_OFF_LATTICE && !o->fresh
                  ? (int)fmax(o->next, k) /* it was cut by an event */
                  : k;
    o->calm = (o->calm + 1) % FVI_ADAPTIVE_CALM;
    if (o->calm == 0 && o->contracts < o->most)
        o->contracts++;
    o->next = (int)smaller(o->next, fmin(o->most, o->contracts));
    if (o->fresh) /* the next restart begins where this one got to */
        o->first = o->next;
}

/* The same after one that is not, as its error is too large, or NaN; or as its equation
 * was not solved. */
static void shorten(fvi_adaptive_run *o, fvi_length length, double error,
                    int failed)
{
    const int now = fvi_adaptive_exponent(length);
    if (failed) {
        o->contracts = now - 1;
        o->calm = 0;
    }
    o->next = (int)fmax(now + (failed ? -2 : change(o, error)), o->fewest);
    o->counts.rejected++;
}

/* sum += more, what rounding takes from it kept in less (Kahan). */
static void add(double *sum, double *less, double more)
{
    const double y = more - *less, t = *sum + y;
    *less = (t - *sum) - y;
    *sum = t;
}

/* x and p of the state. */
static void show(fvi_stepper *s, fvi_adaptive_run *o)
{
    for (size_t j = 0; j < o->d; j++) {
        double G = 0, slope = 0;
        if (fvi_singular_is(o, o->t))
            fvi_singular_at(&o->singular, j, o->t, &G, &slope, NULL);
        s->x[j] = o->y[j] + G;
        s->p[j] = s->run.system->mass[j] * (o->v[j] + slope);
        o->scale = larger(o->scale, fabs(s->x[j]));
    }
    s->t = o->t;
}

/* The velocities of coordinate j at the stages, as its memory wants them, to v. */
FVI_VECTORS static void stage_velocities(const fvi_adaptive_run *o, size_t j,
                                         double *v)
{
    const double more = o->beta < 0 ? o->v[j] : o->kick[j];
    const fvi_four *delta = LANES(o->delta + j * FVI_LANES);
    LANES(v)[0] = delta[0] + more;
    LANES(v)[1] = delta[1] + more;
}

//> take
/* The trial is the step: x, v, the modes, the time. */
static void take(fvi_adaptive_run *o, double event)
{
    const size_t s = o->rule->s;
    const double h = o->length.h;
    for (size_t l = 0; o->modes && l < o->damped; l++) {
        const size_t j = o->index[l];
        double v[FVI_LANES];
        stage_velocities(o, j, v);
        fvi_modes_advance(o->modes, l, v, o->v[j] - o->kick[j]);
    }
    for (size_t j = 0; j < o->d; j++) {
        double *delta = o->delta + j * FVI_LANES, move[FVI_LANES];
        fvi_square_apply(s, o->to_x, delta, move);
        o->y0[j] = o->y[j];
        o->v0[j] = o->v[j];
        add(&o->y[j], &o->y_less[j], h * (o->v[j] + move[s - 1]));
        add(&o->v[j], &o->v_less[j], delta[s - 1]);
    }
    memcpy(o->bend0, o->bend, o->d * FVI_LANES * sizeof *o->bend);
    o->t0 = o->t;
    add(&o->t, &o->t_less, h);
    if (fabs(o->t - event) <= 8 * GSL_DBL_EPSILON * event || o->t > event) {
        o->t = event;
        o->t_less = 0;
    }
    o->counts.steps++;
    o->counts.longest = larger(o->counts.longest, h);
}
//< take

//> step
static int step(fvi_stepper *s)
{
    fvi_adaptive_run *o = s->own;
    const double event = fvi_adaptive_next_event(o);
    double found = 0, error = 0, found_before = 0, h_before = 0;
    o->powers_known = 0; /* bend stands there */
    for (;;) {
        if (fvi_adaptive_runs_away(o, s->run.most_steps))
            return FVI_ERUNAWAY;
        fvi_length length;
        int status = fvi_adaptive_choose(s, o, event, &length);
        if (!status)
            status = trial(s, o, length, &found);
        const int failed = status == FVI_EMAXITER || status == FVI_ESING;
        if (status && !failed)
            return status;
        if (!failed)
            error = judge(o, found, found_before, h_before);
        if (!failed && error <= o->allowed) {
            lengthen(o, error, h_before > 0);
            break;
        }
        if (length.h <= o->least)
            return status              ? status
                   : gsl_finite(error) ? FVI_EMAXITER
                                       : FVI_EOVRFLW;
        shorten(o, length, error, failed);
        found_before = failed ? 0 : found;
        h_before = length.h;
    }
    take(o, event);
    const int over = fvi_singular_is(o, o->t0) && !fvi_singular_is(o, o->t);
    if (over)
        fvi_singular_hand_over(o);
    fvi_adaptive_strike(s, o);
    o->fresh = o->t == event && !over;
    if (o->fresh)
        o->next = o->first;
    show(s, o);
    return FVI_SUCCESS;
}
//< step

/* ---- the method ---- */

int fvi_adaptive_look(const fvi_stepper *s, fvi_adaptive_counts *counts)
{
    if (!s || !counts)
        FVI_FAIL("null pointer", FVI_EFAULT);
    if (s->method->step != step)
        FVI_FAIL("not a stepper of fvi_adaptive", FVI_EINVAL);
    *counts = ((const fvi_adaptive_run *)s->own)->counts;
    return FVI_SUCCESS;
}

const fvi_method fvi_adaptive = {
    .name = "fvi-adaptive",
    .order = "about 10",
    .memory = "full",
    .lowest = 9,
    .highest = 12,
    .alpha_most = 1,
    .scheme = FVI_SCHEME_MESH,
    .memories = 1u << FVI_MEMORY_AUTO | 1u << FVI_MEMORY_EXPONENTIALS,
    .implicit = 1,
    .start = fvi_adaptive_start,
    .step = step,
    .dense = fvi_adaptive_dense,
    .copy = fvi_adaptive_copy,
    .visit = fvi_adaptive_visit,
    .stop = fvi_adaptive_stop,
};
