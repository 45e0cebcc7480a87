/* src/adjoint_mechanism/adjoint_mechanism_mesh.c -- The adjoint run of a mechanism on steps of any length. [H 23, 29]
 *
 * The steps are steps of form D, so a step goes back as in adjoint_mechanism_stages.c. The history of a damper goes
 * back as the history of a coordinate does (23.16): it has the same modes, and takes in
 * mu_i = nu_{s-1-i} / (h b_{s-1-i}) in the place of zdot. Within a step, x in a row is a polynomial of V, and of v at
 * the beginning of the step, which is the last V of the step before. */
#include "adjoint_mechanism.h"
#include "adjoint_variable/adjoint_variable.h"

#include "system/arrays.h"
#include "system/fail.h"
#include "variable_step/variable_mechanism.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct fvi_adjoint_mesh {
    const fvi_variable_rule *rule;
    fvi_recorded_steps path;  /* its stepper is that of the adjoint run */
    size_t row;               /* the next row that J's slopes are asked for */
    double *source, *by_v, *by_x, *Jx, *Jp, *Jk; /* s d, then d each; owned, one block */
    double W[FVI_LANES * FVI_LANES];
    fvi_mesh_damper *adjoint; /* the histories of the dampers of the adjoint run, r; owned */
};

/* ---- which derivatives are known ---- */

int fvi_adjoint_mesh_check(const fvi_run *run, const fvi_objective *J, const fvi_sensitivities *want)
{
    const fvi_mechanism *mechanism = run->system->mechanism;
    if (run->system->force.impulse_count && mechanism->constraints && mechanism->constraints->count > 0)
        FVI_FAIL("steps of any length have no adjoint of impulses and constraints together", FVI_EUNSUP);
    if (J && J->has_momenta)
        FVI_FAIL("steps of any length have no adjoint of a mechanism by momenta before the last", FVI_EUNSUP);
    if (want->terms || want->orders || want->times || want->ends)
        FVI_FAIL("with steps of any length a damper has a derivative by its factor alone", FVI_EUNSUP);
    for (size_t j = 0; j < mechanism->damper_count; j++) {
        const fvi_damper *damper = mechanism->damper + j;
        if (damper->past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE
            || (damper->past == FVI_INITIAL_HISTORY_CAPUTO && fvi_kernel_growth(damper->kernel) > 1))
            FVI_FAIL("steps of any length have no adjoint of a damper with the past rl, nor with that of "
                     "caputo above the order 1",
                     FVI_EUNSUP);
    }
    return FVI_SUCCESS;
}

/* ---- the run and its record ---- */

static int start(fvi_adjoint_mechanism *m)
{
    struct fvi_adjoint_mesh *mesh = m->mesh;
    int status = fvi_recorded_steps_start(m->run, 0, &mesh->path);
    if (status)
        return status;
    m->stepper = mesh->path.stepper;
    fvi_variable_step_state *of = m->stepper->method_state;
    fvi_mechanism_state *o = m->o = m->stepper->mechanism;
    m->r = o->r;
    m->s = o->s;
    m->n = o->n;
    mesh->path.size = 2 * m->d + m->n + m->r * m->s + o->m;
    mesh->rule = of->rule;
    mesh->row = m->run->steps;
    status = fvi_adjoint_mechanism_allocate(m);
    mesh->adjoint = calloc(m->r + 1, sizeof *mesh->adjoint);
    mesh->source = FVI_ARRAYS({ &mesh->source, m->s * m->d }, { &mesh->by_v, m->d }, { &mesh->by_x, m->d },
                              { &mesh->Jx, m->d }, { &mesh->Jp, m->d }, { &mesh->Jk, m->d });
    if (!status && (!mesh->adjoint || !mesh->source))
        FVI_FAIL("no memory for the rows of the run", FVI_ENOMEM);
    if (status)
        return status;
    m->source = mesh->source;
    memcpy(m->G0, o->G, m->r * m->d * sizeof *m->G0);
    memcpy(m->v0, o->v, m->d * sizeof *m->v0);
    if (m->want->mass)
        memset(m->want->mass, 0, m->d * sizeof *m->want->mass);
    for (size_t j = 0; j < m->r && !status; j++) {
        fvi_adjoint_mechanism_damper *a = m->damper + j;
        a->damper = j;
        a->kernel = m->run->system->mechanism->damper[j].kernel;
        status = fvi_mesh_begin_damper(m->stepper, of, a->kernel, 1, j, &mesh->adjoint[j]);
        a->spring = mesh->adjoint[j].beta == -1 ? mesh->adjoint[j].rho : 0;
    }
    return status;
}

/* Write x and v at the stepper's time, and the impulse w of the constraints without that of the last stage, to `last`.
 * (29.4) */
static void store_node(const fvi_adjoint_mechanism *m)
{
    const fvi_mechanism_state *o = m->o;
    const size_t d = m->d;
    memcpy(m->last, m->stepper->x, d * sizeof *m->last);
    memcpy(m->last + d, o->v, d * sizeof *m->last);
    for (size_t l = 0; l < o->m; l++)
        m->last[2 * d + l] = o->h > 0 ? o->h * o->rule->b[m->s - 1] * o->ended[l]
                                            - o->u[m->s * d + (m->s - 1) * o->m + l] / o->h
                                      : 0;
}

/* Record the last step: x_k, u and the known forces, and v and w at its beginning. */
static void record_step(void *params, double *to)
{
    const fvi_adjoint_mechanism *m = params;
    const size_t d = m->d, forces = m->r * m->s;
    memcpy(to, m->last, d * sizeof *to);
    memcpy(to + d, m->o->u, m->n * sizeof *to);
    memcpy(to + d + m->n, m->o->known, forces * sizeof *to);
    memcpy(to + d + m->n + forces, m->last + d, (d + m->o->m) * sizeof *to);
    store_node(m);
}

/* Return nonzero if v at the end of step n is computed from p, and is not the last V: an impulse acts there, or there
 * are constraints. */
static int solves_velocity(const fvi_adjoint_mechanism *m, size_t n)
{
    return m->mesh->path.step[n].is_hit || m->o->m;
}

/* Put the stepper back to step n, and linearise its equation at the root. */
static int restore_step(fvi_adjoint_mechanism *m, size_t n)
{
    const fvi_recorded_step *step = m->mesh->path.step + n;
    const double *from = m->mesh->path.numbers + n * m->mesh->path.size;
    fvi_stepper *s = m->stepper;
    fvi_variable_step_state *of = s->method_state;
    fvi_mechanism_state *o = m->o;
    of->length = step->length;
    o->t = step->t;
    o->h = step->length.h;
    m->unknown = from + m->d;
    memcpy(s->x, from, m->d * sizeof *from);
    memcpy(o->known, from + m->d + m->n, m->r * m->s * sizeof *from);
    fvi_mesh_present(s, of);
    const int status = fvi_mechanism_elongations(s, step->t, s->x, o->z, o->G);
    return status ? status : fvi_mechanism_linearise(s, m->unknown);
}

/* ---- rows within a step ---- */

/* Ask J for dJ/dx of row k, and add dJ/dp of the last row to beta. */
static int evaluate_row_slopes(fvi_adjoint_mechanism *m, size_t k)
{
    struct fvi_adjoint_mesh *mesh = m->mesh;
    const int status = fvi_recorded_steps_slopes(&mesh->path, m->run, m->J, k, mesh->Jx, mesh->Jp, mesh->Jk);
    for (size_t j = 0; k == m->run->steps && j < m->d; j++)
        m->beta[j] += mesh->Jp[j];
    return status;
}

/* Add dJ/dx of all rows in step n, but for one at its beginning, to the derivatives by V of its stages and by v and x
 * at its beginning. The derivative by v at its end, by_v, goes to its last V, unless v is solved from p there, as it is
 * not for a coordinate without inertia. */
static int add_rows(fvi_adjoint_mechanism *m, size_t n)
{
    struct fvi_adjoint_mesh *mesh = m->mesh;
    const fvi_recorded_step *step = mesh->path.step + n;
    const size_t d = m->d, s = m->s;
    const double h = step->length.h;
    int status = FVI_SUCCESS;
    memset(mesh->source, 0, s * d * sizeof *mesh->source);
    for (size_t j = 0; j < d; j++)
        if (!solves_velocity(m, n) || m->o->is_massless[j])
            mesh->source[(s - 1) * d + j] = mesh->by_v[j];
    memset(mesh->by_v, 0, 2 * d * sizeof *mesh->by_v);
    for (; !status && mesh->row > 0; mesh->row--) {
        const double t = (double)mesh->row * m->run->h, theta = fmin((t - step->t) / h, 1);
        double shape[FVI_LANES], twice[FVI_LANES], whole = 0;
        if (t <= step->t)
            break;
        status = evaluate_row_slopes(m, mesh->row);
        fvi_variable_step_twice(theta, twice);
        fvi_adjoint_mesh_shape(mesh->rule, h, twice, shape);
        for (size_t i = 0; i < s; i++)
            whole += shape[i];
        for (size_t j = 0; j < d; j++) {
            for (size_t i = 0; i < s; i++)
                mesh->source[i * d + j] += mesh->Jx[j] * shape[i];
            mesh->by_v[j] += mesh->Jx[j] * (h * theta - whole);
            mesh->by_x[j] += mesh->Jx[j];
        }
    }
    return status;
}

/* ---- histories ---- */

/* Write the sums over later steps, `past`, for a step of this length: (22.10) with mu. */
static void find_history(fvi_adjoint_mechanism *m, size_t e)
{
    const fvi_variable_step_state *of = m->stepper->method_state;
    fvi_mesh_damper *adjoint = m->mesh->adjoint + e;
    const double h = m->o->h;
    double H[FVI_LANES] = { 0 }, more[FVI_LANES] = { 0 };
    fvi_mesh_present_damper(of, h, adjoint, m->mesh->W);
    if (adjoint->modes) {
        fvi_modes_begin(adjoint->modes, of->length);
        fvi_modes_history(adjoint->modes, 0, H);
    }
    if (adjoint->rising) {
        fvi_modes_begin(adjoint->rising, of->length);
        fvi_modes_history(adjoint->rising, 0, more);
    }
    for (size_t i = 0; i < m->s; i++)
        m->damper[e].past[i] = h * adjoint->rho
                               * (H[i] + more[i]
                                  - (adjoint->W1[i] != 0 ? pow(h, -adjoint->beta) * adjoint->W1[i] * adjoint->before
                                                        : 0));
}

static void add_forces(fvi_adjoint_mechanism *m)
{
    for (size_t i = 0; m->want->force && i < m->s; i++)
        fvi_adjoint_mesh_force(m->run, fvi_mechanism_stage_time(m->stepper, i), 1, 1, m->phi + i * m->d,
                               m->want->force);
}

int fvi_adjoint_mesh_push(fvi_adjoint_mechanism *m)
{
    const fvi_mechanism_state *o = m->o;
    const size_t s = m->s;
    const double *b = o->rule->b;
    for (size_t e = 0; e < m->r; e++) {
        fvi_adjoint_mechanism_damper *a = m->damper + e;
        fvi_mesh_damper *adjoint = m->mesh->adjoint + e;
        double mu[FVI_LANES] = { 0 }, all = 0;
        for (size_t i = 0; i < s; i++) {
            mu[i] = a->nu[s - 1 - i] / (o->h * b[s - 1 - i]);
            a->factor += a->nu[i] * o->lambda[e * s + i];
            all += a->spring * a->nu[i];
        }
        fvi_mesh_advance_damper(adjoint, 0, s, mu, &adjoint->before);
        a->by_origin -= all; /* the place where the spring is at rest */
        for (size_t j = 0; j < m->d; j++)
            m->g[j] += all * o->G[e * m->d + j];
    }
    add_forces(m);
    return FVI_SUCCESS;
}

/* ---- the walk back ---- */

static int step_back(fvi_adjoint_mechanism *m, size_t n)
{
    const size_t d = m->d;
    const fvi_recorded_steps *path = &m->mesh->path;
    const double *x = path->numbers + n * path->size, *v = x + path->size - d - m->o->m;
    int status = n % 64 == 0 ? fvi_interrupted() : FVI_SUCCESS;
    if (!status)
        status = add_rows(m, n);
    if (!status && n + 1 == path->steps && m->o->m)
        status = fvi_adjoint_mechanism_project(m, m->stepper->t, m->last, m->last + d, m->last + 2 * d, NULL);
    if (!status)
        status = restore_step(m, n);
    for (size_t e = 0; e < m->r && !status; e++)
        find_history(m, e);
    if (!status)
        status = fvi_adjoint_mechanism_stages(m, n);
    for (size_t j = 0; j < d; j++)
        m->g[j] += m->mesh->by_x[j];
    const int is_projected = n == 0 ? m->o->m > 0 : solves_velocity(m, n - 1);
    if (status || !is_projected)
        return status;
    return fvi_adjoint_mechanism_project(m, path->step[n].t, x, v, v + d, m->mesh->by_v);
}

static int finish(fvi_adjoint_mechanism *m)
{
    const fvi_sensitivities *want = m->want;
    const size_t d = m->d;
    int status = evaluate_row_slopes(m, 0);
    for (size_t j = 0; j < d; j++)
        m->g[j] += m->mesh->Jx[j];
    for (size_t e = 0; e < m->r && !status; e++) {
        const fvi_adjoint_mechanism_damper *a = m->damper + e;
        status = fvi_adjoint_mechanism_names_start(m, e, a->by_origin, 0);
        for (size_t j = 0; j < d; j++)
            m->g[j] += a->by_origin * m->G0[e * d + j];
        if (want->damping)
            want->damping[e] = a->factor;
    }
    if (!status)
        status = fvi_adjoint_mechanism_names_check(m);
    if (!status && m->o->m == 0)
        status = fvi_adjoint_mechanism_add_velocity(m, m->mesh->by_v);
    if (want->x0)
        memcpy(want->x0, m->g, d * sizeof *m->g);
    if (want->p0)
        memcpy(want->p0, m->beta, d * sizeof *m->beta);
    return status;
}

int fvi_adjoint_mesh_run(const fvi_run *run, const fvi_objective *J, const fvi_sensitivities *want)
{
    struct fvi_adjoint_mesh mesh = { .row = 0 };
    fvi_adjoint_mechanism m = { .run = run, .want = want, .J = J, .d = run->system->d, .mesh = &mesh };
    int status = start(&m);
    if (!status) {
        store_node(&m);
        status = fvi_recorded_steps_go(&mesh.path, record_step, &m);
    }
    for (size_t n = mesh.path.steps; !status && n-- > 0;)
        status = step_back(&m, n);
    if (!status)
        status = finish(&m);
    for (size_t e = 0; mesh.adjoint && e < m.r; e++)
        fvi_mesh_free_damper(&mesh.adjoint[e]);
    free(mesh.adjoint);
    free(mesh.source);
    m.stepper = NULL; /* that of the path */
    fvi_adjoint_mechanism_stop(&m);
    fvi_recorded_steps_free(&mesh.path);
    return status;
}
