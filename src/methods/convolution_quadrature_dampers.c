/* src/methods/convolution_quadrature_dampers.c -- The dampers in a run by a method of order 2.   [H 13] */
#include "convolution_quadrature_dampers.h"

#include "system/archive_pieces.h"
#include "system/fail.h"
#include "newton/newton.h"

#include <stdlib.h>
#include <string.h>

fvi_damping *fvi_damping_of(const fvi_stepper *s)
{
    const fvi_cq_state *o = s->method_state;
    return s->method->paper_convention ? s->method_state : o->damping;
}

int fvi_damping_move_origin(fvi_stepper *s, const double *by)
{
    int status = FVI_SUCCESS;
    for (fvi_damping *d = fvi_damping_of(s); !status && d; d = d->next) {
        double *moved = calloc(d->count + s->run.system->d, sizeof *moved);
        if (!moved)
            FVI_FAIL("no memory for the damping", FVI_ENOMEM);
        status = fvi_damping_gather(d, by, moved + d->count, moved);
        for (size_t j = 0; !status && j < d->count; j++)
            d->origin[j] += moved[j];
        free(moved);
    }
    return status;
}

void fvi_cq_stop(fvi_stepper *s)
{
    fvi_cq_state *o = s->method_state;
    if (!o)
        return;
    for (size_t j = 0; j < o->count; j++) {
        free(o->each[j].H);
        fvi_initial_history_force_stop(&o->each[j].history_force);
    }
    fvi_damping_free(o->damping);
    free(o->each);
    free(o->r);
    free(o);
}

/* Return the number of doubles in H, ahead and, if there is a factor, past. */
static size_t rows(const fvi_cq_damper *o)
{
    return (2 + 2 * o->taps) * o->damping->count;
}

static int make_rows(fvi_cq_damper *o)
{
    const size_t count = o->damping->count;
    o->H = calloc(rows(o), sizeof *o->H);
    if (!o->H)
        FVI_FAIL("no memory for the method", FVI_ENOMEM);
    o->ahead = o->H + count;
    o->past = o->ahead + count;
    return FVI_SUCCESS;
}

/* Make one damper for each history of o->damping. */
static int make_dampers(fvi_cq_state *o)
{
    size_t count = 0;
    for (const fvi_damping *d = o->damping; d; d = d->next)
        count++;
    o->each = calloc(count + 1, sizeof *o->each);
    if (!o->each)
        FVI_FAIL("no memory for the method", FVI_ENOMEM);
    for (fvi_damping *d = o->damping; d; d = d->next)
        o->each[o->count++].damping = d;
    return FVI_SUCCESS;
}

static fvi_cq_state *make_state(fvi_stepper *s)
{
    fvi_cq_state *o = s->method_state = calloc(1, sizeof *o);
    if (o)
        o->r = calloc(s->run.system->d, sizeof *o->r);
    return o && o->r ? o : NULL;
}

static int copy_damper(const fvi_cq_damper *from, size_t d, fvi_cq_damper *to)
{
    fvi_damping *own = to->damping;
    *to = *from;
    to->damping = own;
    to->H = to->ahead = to->past = NULL;
    int status = fvi_initial_history_force_copy(&from->history_force, d,
                                                &to->history_force);
    if (!status)
        status = make_rows(to);
    if (!status)
        memcpy(to->H, from->H, rows(to) * sizeof *to->H);
    return status;
}

int fvi_cq_copy(const fvi_stepper *from, fvi_stepper *to)
{
    const fvi_cq_state *old = from->method_state;
    fvi_cq_state *o = make_state(to);
    if (!o)
        FVI_FAIL("no memory for the method", FVI_ENOMEM);
    int status = fvi_damping_copy(old->damping, &o->damping);
    if (!status)
        status = make_dampers(o);
    for (size_t j = 0; !status && j < o->count; j++)
        status = copy_damper(old->each + j, from->run.system->d, o->each + j);
    return status;
}

static int serialize_damper(fvi_cq_damper *o, fvi_archive *v)
{
    int status = FVI_SERIALIZE(v, FVI_CONSTANT(o->taps), FVI_STATE(o->place));
    if (!status && o->place > 0 && o->place >= o->taps)
        FVI_FAIL("not a place among the last terms", FVI_EINVAL);
    return status ? status : v->serialize(v, o->H, rows(o) * sizeof *o->H, 0);
}

int fvi_cq_serialize(fvi_stepper *s, fvi_archive *v)
{
    fvi_cq_state *o = s->method_state;
    int status = FVI_SUCCESS;
    for (size_t j = 0; !status && j < o->count; j++)
        status = serialize_damper(o->each + j, v);
    return status ? status : fvi_damping_archive(o->damping, s->k, v);
}

/* Return the factor of d in (13.10) from the force of a damper. x_{k+1} has the weight w_0 = 1, times g_0, in
 * D_{k+1}. */
static double present_weight(const fvi_cq_damper *o)
{
    return o->theta * fvi_cq_first_weight(o);
}

/* Allocate the solver of (m M + sum_j c_j C_j) d + s K (x + (1 - kappa) d) = r. A damper without a history has c_j =
 * 0. */
static int matrix_solver(fvi_stepper *s, const fvi_cq_state *o, double kappa)
{
    const fvi_run *run = &s->run;
    const size_t count = fvi_run_damper_count(run);
    double *c = calloc(count + 1, sizeof *c);
    if (!c)
        FVI_FAIL("no memory for the method", FVI_ENOMEM);
    for (size_t j = 0, i = 0; j < count && i < o->count; j++)
        if (fvi_run_damper_of(run, j).matrix.history_size > 0) {
            c[j] = present_weight(o->each + i) * *o->each[i].damping->factor;
            i++;
        }
    const int status = fvi_newton_matrices_alloc(
        run->system, 1 / run->h, c, kappa * run->h, 1 - kappa, &s->newton);
    free(c);
    return status;
}

/* Allocate the solver of A d + s grad U(x + (1 - kappa) d) = r with A = m/h + theta rho h^(1-2 alpha) g_0. (13.10) */
static int solver(fvi_stepper *s, const fvi_cq_state *o)
{
    const fvi_run *run = &s->run;
    const double kappa = s->method->takes_kappa ? run->kappa : 0.5;
    if (run->system->matrices)
        return matrix_solver(s, o, kappa);
    for (size_t i = 0; i < run->system->d; i++)
        o->r[i] = run->system->mass[i] / run->h;
    for (size_t j = 0; j < o->count; j++) {
        const fvi_damping *d = o->each[j].damping;
        for (size_t i = 0; i < d->count; i++)
            o->r[d->index[i]] += present_weight(o->each + j) * d->factor[i];
    }
    return fvi_newton_alloc(run->system, o->r, kappa * run->h, 1 - kappa, &s->newton);
}

/* Compute the factor (13.16), a mean of the last two terms. It shifts D^{2 alpha} to half a step earlier. Euler's
 * weights act alpha of a step earlier already, so the factor depends on alpha; for a law alpha is 0 (26.15). Return the
 * number of terms, 0 if the factor is 1. */
static size_t has_two_taps(double alpha, double *g)
{
    g[0] = 0.5 + alpha;
    g[1] = 0.5 - alpha;
    return g[1] == 0 ? 0 : 2;
}

/* Set theta and the factor g for the scheme. */
static void choose_scheme(fvi_scheme scheme, fvi_cq_damper *o)
{
    const fvi_run_damper *of = &o->damping->of;
    if (scheme == FVI_SCHEME_CQ2_SHIFTED)
        o->theta = of->growth / 2;
    if (scheme == FVI_SCHEME_CQ_BDF2 && of->alpha > 0)
        o->taps = fvi_cq_bdf2_factor(2 * of->alpha, o->g);
    if (scheme != FVI_SCHEME_CQ2_MIDPOINT)
        return;
    o->theta = 0.5;
    o->taps = has_two_taps(of->alpha, o->g);
}

static int start_damper(const fvi_stepper *s, fvi_cq_damper *o)
{
    static const double ends[] = { 0, 1 };
    choose_scheme(s->method->scheme, o);
    const int status = make_rows(o);
    return status ? status
                  : fvi_initial_history_force_start(s, &o->damping->of, 2, ends,
                                                    &o->history_force); /* (19.3) */
}

int fvi_cq_start(fvi_stepper *s)
{
    fvi_cq_state *o = make_state(s);
    if (!o)
        FVI_FAIL("no memory for the method", FVI_ENOMEM);
    int status = fvi_damping_start(s, 1, &o->damping); /* D_0 = 0 */
    if (!status)
        status = make_dampers(o);
    for (size_t j = 0; !status && j < o->count; j++)
        status = start_damper(s, o->each + j);
    return status ? status : solver(s, o);
}
