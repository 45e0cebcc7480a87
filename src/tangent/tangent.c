/* src/tangent/tangent.c -- A run and its derivatives along directions: checks, start and rows. [H 24] */
#include "tangent.h"

#include <fvi/adjoint.h>
#include "mechanism/mechanism.h"
#include "methods/damping.h"
#include "methods/lobatto_matrices.h"
#include "methods/lobatto_stages.h"
#include "parameter_derivatives/potential_derivatives.h"
#include "parameter_derivatives/wanted_check.h"
#include "run/impulses.h"
#include "system/arrays.h"
#include "system/fail.h"
#include "system/system_check.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- which derivatives are known ---- */

static int check_laws(const fvi_method *method, const fvi_run *run, const fvi_sensitivities *along)
{
    for (size_t j = 0; j < fvi_run_damper_count(run); j++) {
        const fvi_kernel *law = fvi_run_damper_of(run, j).law;
        if (law && method->scheme == FVI_SCHEME_CQ2_SHIFTED)
            FVI_FAIL("fvi-shifted has no derivatives with a law; the other methods have", FVI_EUNSUP);
    }
    return method->stages ? fvi_wanted_check_stage_laws(run, along) : FVI_SUCCESS;
}

static int check_direction(const fvi_method *method, const fvi_run *run, const fvi_sensitivities *along)
{
    const fvi_system *system = run->system;
    const int by_law = fvi_wanted_kernel_numbers(along);
    if (system->mechanism && along->alpha)
        FVI_FAIL("several dampers have orders, and no alpha", FVI_EINVAL);
    if (run->law ? along->alpha != NULL : !system->mechanism && by_law)
        FVI_FAIL("a law has terms, and no alpha; a power the other way round", FVI_EINVAL);
    if (along->parameters && !system->matrices && along->sensitivity.count > 0
        && !along->sensitivity.column)
        FVI_FAIL("derivatives by parameters need a sensitivity", FVI_EINVAL);
    if (along->mass && system->matrices && !system->matrices->inertia)
        FVI_FAIL("no derivative by a factor of M without its products", FVI_EUNSUP);
    int status = system->mechanism && !method->stages ? fvi_wanted_check_dampers(method, run, along)
                                                      : FVI_SUCCESS;
    return status ? status : check_laws(method, run, along);
}

static int check(const fvi_tangent_run *o, const fvi_run *run)
{
    const fvi_method *method = o->method;
    if (!method || !run || !o->along || !run->x0 || !run->p0)
        FVI_FAIL("a pointer of the tangents is NULL", FVI_EFAULT);
    int status = fvi_system_require_any(run->system);
    if (!status)
        status = fvi_wanted_check_scheme(method);
    if (!status && o->P == 0)
        FVI_FAIL("there is no direction to take derivatives along", FVI_EINVAL);
    if (!status
        && (fvi_has_mechanism_steps(run->system) || method->scheme == FVI_SCHEME_VARIABLE_STEP
            || run->event_count > 0))
        FVI_FAIL("no derivatives along directions of this run: chains and structures have them, by methods with a "
                 "memory and equal steps, without events",
                 FVI_EUNSUP);
    if (!status && method->stages && !run->law && !run->system->mechanism && run->alpha == 1)
        FVI_FAIL("with stages there are no derivatives along directions at alpha = 1", FVI_EUNSUP);
    for (size_t j = 0; !status && j < o->P; j++)
        status = check_direction(method, run, o->along + j);
    return status;
}

/* ---- the potential at one point ---- */

int fvi_tangent_evaluate_potential(fvi_tangent_run *o, size_t i, const double *X)
{
    const fvi_system *system = o->run->system;
    const size_t size = o->size, d = o->d;
    const int is_shared = o->tangents < o->P;
    double *H = is_shared ? o->room : o->G + i * size, *dU = o->dU + i * o->P * d;
    o->room[0] = 0; /* so that H is 0 for one coordinate without a potential */
    int status = fvi_potential_evaluate_hessians(system, 1, X, size, H);
    for (size_t j = 0; is_shared && j < o->P; j++)
        o->G[i * o->P + j] = H[0];
    memset(dU, 0, o->P * d * sizeof *dU);
    for (size_t j = 0; !status && j < o->P; j++, dU += d) {
        const fvi_sensitivities *along = o->along + j;
        const size_t count = !along->parameters ? 0 : system->matrices ? 1 : along->sensitivity.count;
        for (size_t c = 0; !status && c < count; c++) {
            double *column = o->room;
            if (along->parameters[c] == 0)
                continue;
            status = system->matrices ? system->matrices->stiffness(d, X, system->matrices->params, column)
                                      : along->sensitivity.column(c, d, X, system->potential.params, column);
            for (size_t n = 0; n < d; n++)
                dU[n] += along->parameters[c] * column[n];
        }
    }
    return status;
}

/* p without the impulses of the force at this node. */
static void momentum_before_impulses(const fvi_tangent_run *o, double *p)
{
    const fvi_stepper *s = o->stepper;
    memset(p, 0, o->d * sizeof *p);
    fvi_impulses_add(&s->run.system->force, s->run.h, s->k, o->d, p);
    for (size_t i = 0; i < o->d; i++)
        p[i] = s->p[i] - p[i];
}

void fvi_tangent_velocity(const fvi_tangent_run *o, double *v)
{
    momentum_before_impulses(o, v);
    for (size_t i = 0; i < o->d; i++)
        v[i] /= o->run->system->mass[i];
}

/* Read dx and dp from the linearised runs. In form D their momentum is m dv, so v dm is added. */
static void read_tangents(fvi_tangent_run *o)
{
    const size_t d = o->d;
    double *p = o->room;
    momentum_before_impulses(o, p);
    for (size_t l = 0; l < o->tangents; l++) {
        memcpy(o->dx + l * o->width, o->tangent[l]->x, o->width * sizeof *o->dx);
        memcpy(o->pi + l * o->width, o->tangent[l]->p, o->width * sizeof *o->pi);
    }
    for (size_t j = 0; o->method->damped_inertia && j < o->P; j++) {
        const double *mass = o->along[j].mass;
        for (size_t i = 0; mass && i < d; i++)
            o->pi[j * d + i] += o->run->system->matrices ? *mass * p[i]
                                                         : mass[i] * (p[i] / o->run->system->mass[i]);
    }
}

int fvi_tangent_step(fvi_tangent_run *o)
{
    const int status = o->rule ? fvi_tangent_stages_step(o) : fvi_tangent_nodes_step(o);
    if (!status)
        read_tangents(o);
    return status;
}

/* ---- the start ---- */

static int make_room(fvi_tangent_run *o)
{
    const size_t d = o->d, all = o->P * d, s = o->s, hessian = o->tangents < o->P ? o->P : o->size;
    o->block = FVI_ARRAYS({ &o->dx, all }, { &o->pi, all }, { &o->mass, o->P }, { &o->damping, o->P },
                          { &o->G, s * hessian }, { &o->dU, s * all }, { &o->source, s * all }, { &o->left, all },
                          { &o->right, all }, { &o->x_k, d }, { &o->v0, d }, { &o->room, d + o->size },
                          { &o->V, s * d }, { &o->X, s * d });
    o->linearised = calloc(o->tangents, sizeof *o->linearised);
    o->system = calloc(o->tangents, sizeof *o->system);
    o->tangent = calloc(o->tangents, sizeof *o->tangent);
    o->each = calloc(fvi_run_damper_count(o->run) + 1, sizeof *o->each);
    if (!o->block || !o->linearised || !o->system || !o->tangent || !o->each)
        FVI_FAIL("no memory for the tangents", FVI_ENOMEM);
    return FVI_SUCCESS;
}

/* The run->tolerance with which the history of stages keeps its sums to `enough`, or to the error of the run's own
 * history if that is larger. A history keeps its sums to a fixed fraction of run->tolerance, which a probe shows.
 * (17.21) */
static double tolerance_of_slopes(const fvi_run *run, double enough)
{
    enum { PROBE = 100 };
    fvi_run probe = *run;
    probe.tolerance = 1. / PROBE;
    const double part = PROBE * fvi_lobatto_history_tolerance(&probe),
                 keep = fmax(fvi_lobatto_history_tolerance(run), enough);
    return fmin(keep / part, 1. / PROBE);
}

/* Return nonzero if a motion starts at another x0_i, (19.2). */
static int has_start(const fvi_tangent_run *o, size_t i)
{
    const fvi_run *run = o->run;
    return o->method->paper_convention || run->law || run->system->mechanism
           || fvi_initial_history_solvable(run->past, run->alpha, run->system->damping[i], 1);
}

/* The start of the linearised runs at k = 0, as their histories see it. Their past is the past of the run: a line from
 * d x0 with the slope d v0. The momentum of this start is m dv0; add_start_jumps adds v0 dm. If no motion starts at
 * another x0, the derivative is the derivative of a run whose past exerts no force. */
static void fill_starts(fvi_tangent_run *o)
{
    const fvi_run *run = o->run;
    const int is_whole = run->system->matrices != NULL;
    for (size_t j = 0, n = 0; j < o->P; j++) {
        const fvi_sensitivities *along = o->along + j;
        for (size_t i = 0; i < o->d; i++, n++) {
            o->dx[n] = along->x0 && has_start(o, i) ? along->x0[i] : 0;
            o->pi[n] = along->p0 ? along->p0[i] : 0;
            if (along->mass)
                o->pi[n] -= is_whole ? *along->mass * run->p0[i]
                                     : along->mass[i] * (run->p0[i] / run->system->mass[i]);
        }
    }
}

static int start_tangent(fvi_tangent_run *o, double enough, size_t l)
{
    const fvi_system *system = o->run->system;
    fvi_run tangent = *o->run;
    fvi_linearised *linearised = o->linearised + l;
    const int is_shared = o->tangents < o->P;
    *linearised = fvi_linearised_begin(system, o->s);
    linearised->G = linearised->size > 0 ? o->G : NULL;
    if (is_shared)
        *linearised = (fvi_linearised){
            .G = o->G, .d = o->P, .diagonals = 1, .size = o->P, .is_one_body = 1, .stages = o->s
        };
    o->system[l] = fvi_linearised_system(system, linearised);
    for (size_t j = 0; is_shared && j < o->P; j++) {
        o->mass[j] = system->mass[0];
        o->damping[j] = system->damping[0];
    }
    if (is_shared) {
        o->system[l].mass = o->mass;
        o->system[l].damping = o->damping;
    }
    if (o->rule)
        linearised->source = o->source + l * o->s * o->width;
    if (o->rule && enough > 0)
        tangent.tolerance = tolerance_of_slopes(o->run, enough);
    tangent.system = o->system + l;
    tangent.x0 = o->dx + l * o->width;
    tangent.p0 = o->pi + l * o->width;
    return fvi_stepper_start(o->method, &tangent, o->tangent + l, NULL);
}

/* Add the part of the start that the histories must not see: v0 dm, and dx0 where no motion starts at another x0
 * (19.2). */
static void add_start_jumps(fvi_tangent_run *o)
{
    const fvi_run *run = o->run;
    for (size_t j = 0, n = 0; j < o->P; j++) {
        const fvi_sensitivities *along = o->along + j;
        for (size_t i = 0; i < o->d; i++, n++) {
            fvi_stepper *s = o->tangent[n / o->width];
            const size_t q = n % o->width;
            if (along->mass && !o->method->damped_inertia)
                s->p[q] += run->system->matrices ? *along->mass * run->p0[i]
                                                 : along->mass[i] * (run->p0[i] / run->system->mass[i]);
            if (along->x0)
                s->x[q] = along->x0[i];
        }
    }
}

static int start_dampers(fvi_tangent_run *o)
{
    const fvi_run *run = o->run;
    const double keep = o->rule ? fvi_stage_dampers_tolerance(&o->tangent[0]->run) : 0; /* histories at nodes are not
                                                                                           compressed further */
    int status = FVI_SUCCESS;
    for (size_t j = 0, first = 0; !status && j < fvi_run_damper_count(run); j++) {
        fvi_tangent_damper *a = o->each + o->dampers++;
        a->of = fvi_run_damper_of(run, j);
        a->number = j;
        a->first = first;
        first += run->system->mechanism ? run->system->mechanism->damper[j].kernel->count : 0;
        if (!a->of.matrix.select_history || a->of.matrix.history_size > 0)
            status = fvi_tangent_damper_start(o, keep, a);
    }
    return status;
}

int fvi_tangent_start(const fvi_method *method, const fvi_run *run, size_t P,
                      const fvi_sensitivities *along, double enough, fvi_tangent_run *o)
{
    *o = (fvi_tangent_run){ .method = method, .along = along, .P = P };
    int status = check(o, run);
    if (!status)
        status = fvi_stepper_start(method, run, &o->stepper, NULL);
    if (status)
        return status;
    o->run_copy = fvi_run_normal(method, run);
    o->run = run = &o->run_copy;
    o->d = run->system->d;
    o->s = method->stages ? (size_t)method->stages : 1;
    o->rule = method->stages ? fvi_lobatto(o->s) : NULL;
    o->kappa = method->takes_kappa ? run->kappa : 0.5;
    const int is_shared = o->d == 1 && !run->system->matrices;
    o->tangents = is_shared ? 1 : P;
    o->width = is_shared ? P : o->d;
    o->size = fvi_linearised_begin(run->system, o->s).size;
    status = make_room(o);
    if (o->rule)
        fvi_lobatto_table(o->rule, o->s, o->A);
    if (!status)
        status = fvi_divide_by_mass(run->system, run->p0, o->v0);
    if (!status)
        fill_starts(o);
    if (!status) /* form M asks for the first forces */
        status = fvi_tangent_evaluate_potential(o, 0, run->x0);
    for (size_t l = 0; !status && l < o->tangents; l++)
        status = start_tangent(o, enough, l);
    if (!status)
        add_start_jumps(o);
    if (!status)
        status = start_dampers(o);
    if (!status)
        read_tangents(o);
    return status;
}

void fvi_tangent_stop(fvi_tangent_run *o)
{
    fvi_stepper_free(o->stepper);
    for (size_t l = 0; o->tangent && l < o->tangents; l++)
        fvi_stepper_free(o->tangent[l]);
    for (size_t j = 0; j < o->dampers; j++)
        fvi_tangent_damper_stop(o->each + j);
    free(o->each);
    free(o->tangent);
    free(o->linearised);
    free(o->system);
    free(o->block);
}

/* ---- the whole run ---- */

/* Write NaN along a direction that changes an x0_i at which no other motion starts, (19.2). */
static void mark_impossible_starts(const fvi_tangent_run *o, double *dx)
{
    for (size_t j = 0, n = 0; j < o->P; j++)
        for (size_t i = 0; i < o->d; i++, n++)
            if (o->along[j].x0 && o->along[j].x0[i] != 0 && !has_start(o, i))
                for (size_t c = 0; c < o->d; c++)
                    dx[j * o->d + c] = NAN;
}

static void write_row(const fvi_tangent_run *o, double *x, double *p, double *dx, double *dp)
{
    const size_t k = o->stepper->k, row = o->P * o->d;
    memcpy(x + k * o->d, o->stepper->x, o->d * sizeof *x);
    if (p)
        memcpy(p + k * o->d, o->stepper->p, o->d * sizeof *p);
    memcpy(dx + k * row, o->dx, row * sizeof *dx);
    if (dp)
        memcpy(dp + k * row, o->pi, row * sizeof *dp);
    if (k > 0)
        mark_impossible_starts(o, dx + k * row);
    if (k > 0 && dp)
        mark_impossible_starts(o, dp + k * row);
}

int fvi_directional_derivatives(const fvi_method *method, const fvi_run *run, size_t count,
                                const fvi_sensitivities *along, double *x, double *p, double *dx,
                                double *dp)
{
    fvi_tangent_run o = { 0 };
    if (!x || !dx)
        FVI_FAIL("a pointer of the tangents is NULL", FVI_EFAULT);
    int status = fvi_tangent_start(method, run, count, along, 0, &o);
    while (!status) {
        write_row(&o, x, p, dx, dp);
        if (o.stepper->k == run->steps)
            break;
        status = o.stepper->k % 64 == 63 ? fvi_interrupted() : FVI_SUCCESS;
        if (!status)
            status = fvi_tangent_step(&o);
        if (!status && !fvi_all_finite(o.P * o.d, o.dx))
            status = FVI_EOVRFLW;
    }
    fvi_tangent_stop(&o);
    return status;
}
