/* src/methods/convolution_quadrature_methods.c -- Integrators of order 2.                  [H 13] */
#include <fvi/convolution_quadrature.h>
#include <fvi/convolution_quadrature_methods.h>
#include <fvi/discrete_mechanics.h>
#include "damping.h"
#include "mechanism/mechanism.h"
#include "shifted_kernel.h"
#include "stability_number.h"
#include "initial_history_force.h"
#include "system/fail.h"
#include "system/newton.h"

#include <gsl/gsl_machine.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    fvi_damping *damping; /* NULL if nothing is damped */
    double theta, kappa;
    double *r;               /* right-hand side of the step, d numbers */
    double *H;               /* h^(2 alpha) D_k of each damped coordinate */
    double *ahead;           /* that of the next step if x stands still */
    double g[FVI_BDF2_TAPS]; /* (13.11), (13.16) */
    size_t taps, place;      /* taps == 0: no factor */
    int increments;          /* are summed, and stand in past */
    double *past; /* the last terms of each, the latest at [place], twice */
    fvi_initial_history_force history_force;
    double impulse[2]; /* of this step, at its ends (19.5) */
} second_order;

/* ---- what the methods do ---- */

//> force
/* The limits of F at t_k from below and from above. h, the product k h and the place
 * of a jump may each be off by half an ulp, and T / N for h by as much again: four
 * ulp on either side are enough. (13.12) */
static int force_before(fvi_stepper *s, size_t k)
{
    return fvi_force_value(s, (double)k * s->run.h * (1 - 4 * GSL_DBL_EPSILON));
}

static int force_after(fvi_stepper *s, size_t k)
{
    double t = (double)k * s->run.h * (1 + 4 * GSL_DBL_EPSILON);
    return fvi_force_value(s, fmax(t, GSL_DBL_MIN));
}
//< force

//> filter
/* The factor g, ((3 - z)/2)^beta or g_0 + g_1 z, applied to the term that has come in.
 * (13.11), (13.16) */
static void filter(second_order *o, size_t count, double *term)
{
    if (o->taps == 0)
        return;
    o->place = (o->place + o->taps - 1) % o->taps;
    for (size_t j = 0; j < count; j++) {
        double *past = o->past + j * 2 * o->taps + o->place, sum = 0;
        past[0] = past[o->taps] = term[j];
        for (size_t n = 0; n < o->taps; n++)
            sum += o->g[n] * past[n];
        term[j] = sum;
    }
}
//< filter

/* x_{k+1} has come: H of step k + 1. */
static int update_history(fvi_stepper *s, second_order *o)
{
    fvi_damping *d = o->damping;
    int status = fvi_damping_terms(d, s);
    if (status)
        return status;
    filter(o, d->count, o->increments ? d->dz : d->z);
    return fvi_damping_update_history(d, o->H);
}

/* What the past does at the left or the right end of this step. */
static void apply_initial_history(fvi_stepper *s, second_order *o, size_t end)
{
    if (!o->history_force.size)
        return;
    if (end == 0)
        fvi_kernel_impulses(&o->history_force.initial_impulse, s->k, o->impulse);
    for (size_t i = 0; i < s->run.system->d; i++)
        s->p[i] -= o->history_force.size[i] * o->impulse[end];
}

/* The weight of z_{k+1} in H_{k+1}: w_0 = 1, times g_0. */
static double first(const second_order *o)
{
    return o->taps ? o->g[0] : 1;
}

/* First line of (13.10): p becomes p_k and its half of F and of the damping, r what
 * remains of it when all of D_{k+1} is taken away but the term with dx. */
//> right-hand-side
static int right_hand_side(fvi_stepper *s, second_order *o)
{
    const fvi_damping *d = o->damping;
    const size_t dim = s->run.system->d, count = d ? d->count : 0;
    const double theta = o->theta, half = s->run.h / 2;
    int status = force_after(s, s->k);
    if (status)
        return status;
    for (size_t i = 0; i < dim; i++)
        s->p[i] += half * s->F[i];
    if (count > 0 && theta != 0.5)
        status = fvi_damping_apply_force(d, 0.5 - theta, o->H, s->p);
    apply_initial_history(s, o, 0);
    memcpy(o->r, s->p, dim * sizeof *o->r);
    if (status || count == 0 || theta == 0)
        return status;
    status = fvi_damping_gather(d, s->x, d->origin, d->z);
    if (!status)
        status = fvi_history_ahead(d->memory, d->z, o->ahead);
    for (size_t j = 0; j < count; j++) {
        o->ahead[j] -= first(o) * d->drift[j];
        if (o->taps && o->increments) /* g_1 times the last increment */
            o->ahead[j] += o->g[1] * o->past[j * 2 * o->taps + o->place];
    }
    return status ? status : fvi_damping_apply_force(d, theta, o->ahead, o->r);
}
//< right-hand-side

//> step
static int step_second_order(fvi_stepper *s)
{
    second_order *o = s->method_state;
    const fvi_damping *d = o->damping;
    const double h = s->run.h;
    int status = right_hand_side(s, o);
    if (!status)
        status = fvi_newton_solve(s->newton, s->x, o->r, s->dx, s->g);
    if (!status)
        status = force_before(s, s->k + 1);
    if (status)
        return status;
    for (size_t i = 0; i < s->run.system->d; i++) {
        s->x[i] += s->dx[i];
        s->p[i] += h / 2 * s->F[i] - h * s->g[i];
    }
    if (!d)
        return FVI_SUCCESS;
    status = update_history(s, o);
    if (!status)
        status = fvi_damping_apply_force(d, 0.5 + o->theta, o->H, s->p);
    apply_initial_history(s, o, 1);
    return status;
}
//< step

const fvi_damping *fvi_damping_of(const fvi_stepper *s)
{
    const second_order *o = s->method_state;
    return s->method->paper_convention ? s->method_state : o->damping;
}

/* ---- starts ---- */

static void stop_second_order(fvi_stepper *s)
{
    second_order *o = s->method_state;
    if (!o)
        return;
    fvi_damping_free(o->damping);
    free(o->r);
    free(o->H);
    free(o->history_force.size);
    free(o);
}

/* Of so many damped coordinates: H and ahead, and past if there is a factor. */
static size_t rows(const second_order *o, size_t count)
{
    return (2 + 2 * o->taps) * count;
}

static int make_rows(second_order *o, size_t count)
{
    o->H = calloc(rows(o, count), sizeof *o->H);
    if (!o->H)
        FVI_FAIL("no memory for the method", FVI_ENOMEM);
    o->ahead = o->H + count;
    o->past = o->ahead + count;
    return FVI_SUCCESS;
}

static int copy_second_order(const fvi_stepper *from, fvi_stepper *to)
{
    const second_order *old = from->method_state;
    second_order *o = to->method_state = malloc(sizeof *o);
    if (!o)
        FVI_FAIL("no memory for the method", FVI_ENOMEM);
    *o = *old;
    o->damping = NULL;
    o->H = o->ahead = o->past = o->history_force.size = NULL;
    o->r = calloc(from->run.system->d, sizeof *o->r); /* of one step only */
    if (!o->r)
        FVI_FAIL("no memory for the method", FVI_ENOMEM);
    int status = fvi_initial_history_force_copy(&old->history_force, from->run.system->d, &o->history_force);
    if (!status)
        status = fvi_damping_copy(old->damping, &o->damping);
    if (status || !old->damping)
        return status;
    const size_t count = old->damping->count;
    status = make_rows(o, count);
    if (!status)
        memcpy(o->H, old->H, rows(o, count) * sizeof *o->H);
    return status;
}

static int serialize_second_order(fvi_stepper *s, fvi_archive *v)
{
    second_order *o = s->method_state;
    if (!o->damping)
        return FVI_SUCCESS;
    int status = v->serialize(v, &o->place, sizeof o->place, 0);
    if (!status && o->place > 0 && o->place >= o->taps)
        FVI_FAIL("not a place among the last terms", FVI_EINVAL);
    if (!status)
        status =
            v->serialize(v, o->H, rows(o, o->damping->count) * sizeof *o->H, 0);
    return status ? status : fvi_damping_archive(o->damping, s->k, v);
}

/* A d + s grad U(x + (1 - kappa) d) = r with A = m/h + theta rho h^(1-2 alpha) g_0:
 * in D_{k+1} the weight w_0 = 1 stands before x_{k+1}. (13.10) */
static int solver(fvi_stepper *s, const second_order *o)
{
    const fvi_run *run = &s->run;
    const fvi_damping *damping = o->damping;
    if (run->system->matrices)
        return fvi_newton_matrices_alloc(
            run->system, 1 / run->h,
            damping ? o->theta * first(o) * damping->factor[0] : 0,
            o->kappa * run->h, 1 - o->kappa, &s->newton);
    for (size_t i = 0; i < run->system->d; i++)
        o->r[i] = run->system->mass[i] / run->h;
    for (size_t j = 0; damping && j < damping->count; j++)
        o->r[damping->index[j]] += o->theta * first(o) * damping->factor[j];
    return fvi_newton_alloc(run->system, o->r, o->kappa * run->h, 1 - o->kappa,
                            &s->newton);
}

/* The factor of (13.16): the mean of the last two, by which D^{2 alpha} becomes half a
 * step earlier than it is, less alpha of a step; of a law half a step, alpha being 0
 * (26.15). Returns how many terms it has. */
static size_t two_taps(double alpha, double *g)
{
    g[0] = 0.5 + alpha;
    g[1] = 0.5 - alpha;
    return g[1] == 0 ? 0 : 2;
}

typedef enum { SHIFTED, BDF2, STABLE } scheme;

static int start(fvi_stepper *s, double theta, scheme which)
{
    static const double ends[] = { 0, 1 };
    second_order *o = s->method_state = calloc(1, sizeof *o);
    if (!o)
        FVI_FAIL("no memory for the method", FVI_ENOMEM);
    o->theta = theta;
    o->kappa = which == STABLE ? 0.5 : s->run.kappa;
    o->r = calloc(s->run.system->d, sizeof *o->r);
    if (!o->r)
        FVI_FAIL("no memory for the method", FVI_ENOMEM);
    const int law = s->run.law != NULL;
    o->increments =
        law ? fvi_kernel_growth(s->run.law) > 1 : 2 * s->run.alpha >= 1;
    int status = fvi_damping_start(s, law ? FVI_INITIAL_HISTORY_HELD : FVI_INITIAL_HISTORY_CAPUTO,
                                   &o->damping); /* D_0 = 0 */
    if (status)
        return status;
    if (o->damping) {
        const size_t count = o->damping->count;
        if (which == BDF2 && !law)
            o->taps = fvi_cq_bdf2_factor(2 * s->run.alpha, o->g);
        if (which == STABLE)
            o->taps = two_taps(law ? 0 : s->run.alpha, o->g);
        status = make_rows(o, count);
        if (!status && !law)
            status = fvi_initial_history_force_start(s, 2, ends, &o->history_force); /* (19.3) */
        if (status)
            return status;
    }
    return solver(s, o);
}

static int start_shifted(fvi_stepper *s)
{
    return start(s,
                 s->run.law ? fvi_shifted_theta(s->run.law) : s->run.alpha,
                 SHIFTED);
}

static int start_bdf2(fvi_stepper *s)
{
    return start(s, 0, BDF2);
}

static int start_stable(fvi_stepper *s)
{
    return fvi_has_mechanism_steps(s->run.system)
               ? fvi_mechanism_start(s, FVI_MECHANISM_NODES, 0)
               : start(s, 0.5, STABLE);
}

const fvi_method fvi_cq2_shifted = { .name = "fvi-shifted",
                                 .order = "2",
                                 .lowest = 2,
                                 .highest = 2,
                                 .memory = "full",
                                 .alpha_most = 1,
                                 .memories = FVI_ALL_MEMORIES,
                                 .scheme = FVI_SCHEME_CQ2_SHIFTED,
                                 .takes_kappa = 1,
                                 .takes_laws = 1,
                                 .takes_matrices = 1,
                                 .implicit = 1,
                                 .stability_number = fvi_stability_number_shifted,
                                 .stability_number_grows = 1,
                                 .start = start_shifted,
                                 .step = step_second_order,
                                 .copy = copy_second_order,
                                 .serialize = serialize_second_order,
                                 .stop = stop_second_order };
const fvi_method fvi_cq_bdf2 = { .name = "fvi-bdf2",
                              .order = "2",
                              .lowest = 2,
                              .highest = 2,
                              .memory = "full",
                              .alpha_most = 1,
                              .memories = FVI_ALL_MEMORIES,
                              .quadrature = FVI_DELTA_BDF2,
                              .scheme = FVI_SCHEME_CQ_BDF2,
                              .takes_kappa = 1,
                              .takes_laws = 1,
                              .takes_matrices = 1,
                              .implicit = 1,
                              .stability_number = fvi_stability_number_bdf2,
                              .stability_number_grows = 1,
                              .start = start_bdf2,
                              .step = step_second_order,
                              .copy = copy_second_order,
                              .serialize = serialize_second_order,
                              .stop = stop_second_order };
const fvi_method fvi_cq2_midpoint = { .name = "fvi-stable",
                                .order = "2",
                                .lowest = 2,
                                .highest = 2,
                                .memory = "full",
                                .alpha_most = 1,
                                .memories = FVI_ALL_MEMORIES,
                                .scheme = FVI_SCHEME_CQ2_MIDPOINT,
                                .takes_laws = 1,
                                .takes_matrices = 1,
                                .takes_mechanism = 1,
                                .implicit = 1,
                                .stability_number = fvi_stability_number_none,
                                .stability_number_grows = 1,
                                .start = start_stable,
                                .step = step_second_order,
                                .copy = copy_second_order,
                                .serialize = serialize_second_order,
                                .stop = stop_second_order };
