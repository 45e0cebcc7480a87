/* src/estimation/identification_profile.c -- Find the interval of one parameter, with the others refitted. [H 24] */
#include "identification_search.h"

#include "system/fail.h"

#include <gsl/gsl_math.h>
#include <string.h>

enum { OUTWARD = 40, INWARD = 60 };
#define FARTHEST 16 /* a logit or a logarithm beyond this says nothing more */
#define NEARLY 0.15 /* largest relative error of the excess at the end of the tangent's interval */
#define LOWER 1e-6  /* of chi^2: a minimum that is lower by this is another one */

/* The last two places where the other parameters were found, and the values of the fixed one there. */
typedef struct {
    fvi_estimation_place at, before;
    double u, u_before;
} trail;

typedef struct {
    fvi_estimation fit; /* the fit of the others */
    fvi_free_parameter
        which[FVI_ESTIMATION_MOST]; /* the other parameters, then the fixed one */
    size_t others;
    fvi_estimation_work work;
    trail on;
    double tangent[FVI_ESTIMATION_MOST]; /* derivatives of the others by the fixed one, by (24.3) */
    double unit, least; /* unit of the sum of squares in sigma^2; chi^2 of the fit */
    int is_least;       /* nonzero while no chi^2 was lower than that */
} profile;

//> excess
/* (24.11): return the root of the increase of chi^2 if the fixed parameter is u and the others are at their best. The
 * search for the others begins on the line through the last two places. */
static double excess(profile *o, double u)
{
    fvi_estimation_model *m = &o->work.model;
    const double far = o->on.u != o->on.u_before
                           ? (u - o->on.u) / (o->on.u - o->on.u_before)
                           : 0;
    fvi_estimation_place now = o->on.at;
    for (size_t i = 0; i < o->others && fabs(far) < 4; i++)
        now.u[i] += far * (o->on.at.u[i] - o->on.before.u[i]);
    fvi_estimation_model_set(m, o->others, fvi_estimation_u_to_theta(m, o->others, u));
    if (o->others > 0) {
        fvi_estimation_minimise(&o->work, &now, GSL_POSINF);
    } else {
        now.sum = fvi_estimation_sum_here(&o->work);
    }
    if (!(now.sum < GSL_POSINF))
        return GSL_POSINF;
    const double chi2 = now.sum * o->unit, more = chi2 - o->least;
    o->is_least &= more >= -LOWER * fmax(1, o->least);
    o->on.before = o->on.at;
    o->on.u_before = o->on.u;
    o->on.at = now;
    o->on.u = u;
    return sqrt(fmax(0, more));
}
//< excess

/* Find where the excess is `reach`, between a and b. The excess is nearly linear, so regula falsi is used, with the
 * halving of the Illinois method. */
static double find_crossing(profile *o, double a, double b, double below,
                            double above, double reach)
{
    double u = b, low = below - reach,
           high = above < GSL_POSINF ? above - reach : reach;
    for (int i = 0, side = 0; i < INWARD && fabs(b - a) > 1e-9 * fabs(a + b);
         i++) {
        u = b - high * (b - a) / (high - low);
        const double now = excess(o, u) - reach;
        if (fabs(now) < 1e-4 * reach)
            break;
        if (now > 0) {
            b = u;
            high = fmin(now, reach);
            low = side > 0 ? low / 2 : low;
            side = 1;
        } else {
            a = u;
            low = now;
            high = side < 0 ? high / 2 : high;
            side = -1;
        }
    }
    return u;
}

/* Try the end of the tangent's interval. Where chi^2 is nearly a parabola, the end of the profile's interval is near,
 * and two or three searches are enough; the excess there tells. Return 1 and the edge, or 0 if chi^2 is no parabola:
 * then the walk must begin at the fit again. */
static int tangent_edge(profile *o, double u, double length, double reach, double *edge)
{
    const trail here = o->on;
    double beyond = u + length;
    for (size_t i = 0; i < o->others; i++)
        o->on.before.u[i] = o->on.at.u[i] - length * o->tangent[i];
    o->on.u_before = u - length;
    double now = excess(o, beyond);
    const int is_near = fabs(now - reach) < NEARLY * reach;
    if (is_near && now < reach) {
        beyond = u + (1 + 2 * NEARLY) * length;
        now = excess(o, beyond);
    }
    if (is_near && now >= reach && now < 2 * reach) {
        *edge = find_crossing(o, u, beyond, 0, now, reach);
        return 1;
    }
    o->on = here;
    return 0;
}

/* Go outward from u by `step`, then by longer steps, until the excess is beyond reach. Then find where it is equal to
 * reach. If it never is, return the infinity of that side. If the excess jumps within a step, the step may have lost
 * the valley. So it is made shorter, down to a limit. */
static double find_edge(profile *o, double u, double step, double reach)
{
    const int bounded = fvi_estimation_kind_of(&o->fit, o->others) != FVI_ESTIMATION_NUMBER;
    const double least = fabs(step) / 1024;
    double before = u, below = 0, near;
    if (tangent_edge(o, u, 4 * step, reach, &near))
        return near;
    for (int i = 0; i < OUTWARD; i++) {
        const double there = before + step;
        const trail here = o->on;
        if (bounded && fabs(there - u) > FARTHEST)
            break;
        const double now = excess(o, there);
        if (now > below + reach / 2 && fabs(step) > least) {
            o->on = here;
            step /= 4;
            continue;
        }
        if (now >= reach)
            return find_crossing(o, before, there, below, now, reach);
        before = there;
        below = now;
        step *= 1.5;
    }
    return step > 0 ? GSL_POSINF : GSL_NEGINF;
}

/* Compute, by (24.3), how the best value of each other parameter changes if the fixed one, number j of the fit, changes
 * by 1. All parameters are u. */
static void fill_tangent(profile *o, const fvi_estimate *fitted, size_t j)
{
    const fvi_estimation_model *m = &o->work.model;
    const double sd = fitted->sd[j]
                      / fvi_estimation_slope_of_theta(m, o->others, fitted->estimate[j]);
    for (size_t k = 0; k < o->others; k++) {
        const size_t i = k + (k >= j);
        o->tangent[k] = fitted->correlation[i][j] * fitted->sd[i]
                     / fvi_estimation_slope_of_theta(m, k, fitted->estimate[i]) / sd;
    }
}

/* Set up the fit of the others, with parameter j as the last one. Keep the present value of j in *given. */
static int begin(profile *o, const fvi_estimation *fit, const fvi_estimate *fitted,
                 size_t j, double *given)
{
    double low[FVI_ESTIMATION_MOST], high[FVI_ESTIMATION_MOST], found[FVI_ESTIMATION_MOST];
    o->fit = *fit;
    o->fit.low = o->fit.high = NULL; /* no search begins anywhere else */
    o->fit.which = o->which;
    for (size_t i = 0; i < fit->parameters; i++)
        if (i != j) {
            o->which[o->others] = fit->which[i];
            found[o->others++] = fitted->estimate[i];
        }
    o->which[o->others] = fit->which[j];
    found[o->others] = fitted->estimate[j];
    o->fit.parameters = o->others > 0 ? o->others : 1;
    int status = fvi_estimation_work_alloc(&o->work, &o->fit, low, high);
    fvi_estimation_model *m = &o->work.model;
    if (!status)
        *given = fvi_estimation_model_get(m, o->others);
    for (size_t i = 0; !status && i <= o->others; i++) {
        fvi_estimation_model_set(m, i, found[i]);
        o->on.at.u[i] = fvi_estimation_theta_to_u(m, i, found[i]);
    }
    if (status)
        return status;
    fill_tangent(o, fitted, j);
    fvi_estimation_model_set_step(m, fitted->h);
    o->work.fine = 1e-5; /* chi^2 is flat at its minimum */
    fvi_estimation_model_weigh(m, fitted);
    o->unit = gsl_pow_2(fvi_estimation_model_unit(m, fitted)) * fitted->loss_unit;
    o->least = fitted->chi2;
    return FVI_SUCCESS;
}

/* Find both ends of the interval, from u_j of the fit with steps in proportion to its standard deviation. */
static void find_both_edges(profile *o, const fvi_estimate *fitted, size_t j,
                            double *low, double *high)
{
    const fvi_estimation_model *m = &o->work.model;
    const double theta = fitted->estimate[j],
                 u = fvi_estimation_theta_to_u(m, o->others, theta),
                 sd = fitted->sd[j]
                      / fabs(fvi_estimation_slope_of_theta(m, o->others, theta));
    const trail here = { o->on.at, o->on.at, u, u };
    const double step = fitted->quantile * sd / 4;
    o->on = here;
    const double down = find_edge(o, u, -step, fitted->quantile);
    o->on = here;
    const double up = find_edge(o, u, step, fitted->quantile);
    *low = fvi_estimation_u_to_theta(m, o->others, down);
    *high = fvi_estimation_u_to_theta(m, o->others, up);
}

int fvi_estimate_profile(const fvi_estimation *fit, const fvi_estimate *fitted, size_t j,
                    double *low, double *high)
{
    profile o = { .is_least = 1 };
    double given;
    int status = fvi_estimation_check(fit);
    if (status)
        return status;
    if (!fitted || !low || !high)
        FVI_FAIL("a pointer of the profile is NULL", FVI_EFAULT);
    if (j >= fit->parameters)
        FVI_FAIL("there is no such parameter", FVI_EINVAL);
    if (!(fitted->sd[j] > 0) || !isfinite(fitted->sd[j]) || !(fitted->h > 0)
        || !(fitted->sigma > 0))
        FVI_FAIL("a profile needs the answer of a fit", FVI_EDOM);
    fvi_quiet();
    status = begin(&o, fit, fitted, j, &given);
    if (!status) {
        find_both_edges(&o, fitted, j, low, high);
        fvi_estimation_model_set(&o.work.model, o.others, given); /* the model gives back those of its fit */
    }
    fvi_estimation_work_free(&o.work);
    fvi_loud();
    if (o.work.model.ended == FVI_ERUNAWAY)
        return FVI_ERUNAWAY;
    if (o.work.model.ended)
        FVI_FAIL("no memory for a motion", o.work.model.ended);
    return status || o.is_least ? status : FVI_EMAXITER;
}
