/* src/adjoint_variable/adjoint_structure_mesh.c -- The adjoint run of a structure on its mesh. [H 23, 27]
 *
 * (23.16) with M, C_j and K in the place of numbers. The adjoint run takes the lengths of the steps from the last to
 * the first, with the factors and the modes of the run, from rest. o->v is lambda, o->y its integral, and xi the force
 * that drives it. Its stages are the stages of the run in reverse order. */
#include "adjoint_structure_mesh.h"

#include "system/arrays.h"
#include "system/dot.h"
#include "system/fail.h"
#include "system/lagrangian_point.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- the start ---- */

static int allocate(fvi_adjoint_structure_mesh_run *m)
{
    const size_t d = m->d;
    double *next;
    m->each = calloc(m->count + 1, sizeof *m->each);
    m->block = FVI_ARRAYS({ &m->v0, d }, { &m->xi, d }, { &m->by_v, d }, { &m->by_x, d }, { &m->extra, d },
                          { &m->Jx, d }, { &m->Jp, d }, { &m->Jk, d }, { &m->product, d }, { &m->room, d },
                          { &m->moved, d }, { &m->y, d }, { &m->source, m->s * d }, { &m->V, m->s * d },
                          { &m->mu, m->s * d }, { &m->rate, m->s * d }, { &next, m->count * d });
    if (!m->each || !m->block)
        FVI_FAIL("no memory for the adjoint run", FVI_ENOMEM);
    for (size_t j = 0; j < m->count; j++, next += d)
        m->each[j].plain = next;
    return FVI_SUCCESS;
}

/* Set the stepper of the run to rest, with new modes of the same rates. */
static int start_modes(fvi_adjoint_structure_mesh_run *m)
{
    fvi_stepper *s = m->path.stepper;
    const size_t bytes = m->d * sizeof(double);
    m->of = m->o->structure;
    memset(s->x, 0, bytes);
    memset(m->o->v, 0, bytes);
    memset(m->o->y, 0, bytes);
    for (size_t j = 0; j < m->of->count; j++) {
        fvi_mesh_matrix *to = m->of->damper + j;
        fvi_mesh_free_damper(&to->memory);
        to->memory = (fvi_mesh_damper){ 0 };
        memset(to->before, 0, to->r * sizeof *to->before);
    }
    m->of->h = 0;
    return fvi_structure_mesh_begin_dampers(s, m->o);
}

/* Start the derivative by the order, which reads the modes a second time with other weights. A dashpot has no modes, so
 * it gets some for this. (23.18) */
static int start_order(fvi_adjoint_structure_mesh_run *m)
{
    fvi_mesh_damper *memory = &m->of->damper->memory;
    int status = FVI_SUCCESS;
    if (!m->want->alpha || m->of->count == 0)
        return status;
    fvi_variable_present_by_order(m->rule, memory->beta, &m->W0_rate);
    if (!memory->modes)
        status = fvi_modes_alloc(m->rule, m->o->modes_kind, memory->beta, m->of->damper->r, m->o->T, m->o->least,
                                 &memory->modes);
    return status ? status : fvi_modes_add_order(memory->modes);
}

static int start(fvi_adjoint_structure_mesh_run *m)
{
    m->o = m->path.stepper->method_state;
    m->rule = m->o->rule;
    m->s = m->rule->s;
    m->row = m->run->steps;
    m->count = fvi_run_damper_count(m->run);
    int status = allocate(m);
    if (!status)
        status = fvi_divide_by_mass(m->run->system, m->run->p0, m->v0);
    if (!status)
        status = start_modes(m);
    if (!status)
        status = start_order(m);
    for (size_t j = 0; !status && j < m->count; j++) {
        fvi_adjoint_structure_mesh_damper *a = m->each + j;
        a->of = fvi_run_damper_of(m->run, j);
        a->has_line = a->of.growth > 1 && a->of.past == FVI_INITIAL_HISTORY_CAPUTO && !a->of.law;
        for (size_t i = 0; i < m->of->count; i++)
            if (m->of->damper[i].number == j)
                a->to = m->of->damper + i;
    }
    return status;
}

/* ---- a step ---- */

/* Compute the multipliers mu of step n. (23.16) */
static int solve(fvi_adjoint_structure_mesh_run *m, size_t n)
{
    fvi_variable_step_state *o = m->o;
    const fvi_matrices *matrices = m->run->system->matrices;
    const fvi_length length = m->path.step[n].length;
    const double h = length.h, *b = m->rule->b;
    const size_t d = m->d, s = m->s;
    o->length = length;
    int status = fvi_structure_mesh_solver(m->path.stepper, o, h);
    if (!status)
        status = matrices->stiffness(d, o->v, matrices->params, m->product);
    for (size_t i = 0; i < s; i++)
        for (size_t j = 0; j < d; j++)
            m->of->load[i * d + j] = m->xi[j] - h * m->rule->c[i] * m->product[j]
                                     + (m->source[(s - 1 - i) * d + j] + (i == 0 ? m->extra[j] : 0)) / (h * b[i]);
    if (!status)
        status = fvi_structure_mesh_predict(o);
    if (!status)
        status = fvi_stage_solver_solve(m->of->solver, m->of->load, m->of->delta);
    for (size_t i = 0; i < s; i++)
        for (size_t j = 0; j < d; j++)
            m->mu[i * d + j] = o->v[j] + m->of->delta[i * d + j];
    return status;
}

/* Add the derivatives by factors of M and K. V: the velocities of the stages, without the velocities that impulses
 * add. */
static int add_matrices(fvi_adjoint_structure_mesh_run *m, size_t n)
{
    const fvi_matrices *matrices = m->run->system->matrices;
    const size_t d = m->d, s = m->s;
    const double *numbers = m->path.numbers + n * FVI_MESH_NUMBERS * d, h = m->path.step[n].length.h,
                 *b = m->rule->b;
    int status = FVI_SUCCESS;
    for (size_t i = 0; i < s; i++)
        for (size_t j = 0; j < d; j++)
            m->V[i * d + j] = numbers[d + j] + numbers[3 * d + j * FVI_LANES + s - 1 - i];
    for (size_t i = 0; !status && m->want->mass && i < s; i++) {
        for (size_t j = 0; j < d; j++) {
            m->room[j] = 0;
            for (size_t l = 0; l < s; l++)
                m->room[j] += b[i] * m->rule->inverse.column[l][s - 1 - i]
                              * (numbers[3 * d + j * FVI_LANES + l] + numbers[2 * d + j]);
        }
        status = matrices->inertia(d, m->room, matrices->params, m->product);
        m->by_M -= fvi_dot(d, m->mu + i * d, m->product);
    }
    m->by_M -= fvi_dot(d, m->by_v, numbers + 2 * d);
    for (size_t i = 0; !status && m->want->parameters && i < s; i++) {
        for (size_t j = 0; j < d; j++) {
            double moved = m->rule->c[s - 1 - i] * numbers[d + j];
            for (size_t l = 0; l < s; l++)
                moved += m->o->to_x->column[l][s - 1 - i] * numbers[3 * d + j * FVI_LANES + l];
            m->room[j] = numbers[j] + h * moved;
        }
        status = matrices->stiffness(d, m->room, matrices->params, m->product);
        m->by_K += h * b[i] * fvi_dot(d, m->mu + i * d, m->product);
    }
    return status;
}

/* Add the products of the force of a damper on the adjoint run with V. fvi_structure_mesh_advance has updated the
 * velocities of the damper before. Only the derivatives by factors and the line of the start need these sums. */
static int add_damper(fvi_adjoint_structure_mesh_run *m, size_t n, fvi_adjoint_structure_mesh_damper *a)
{
    const fvi_damping_matrix *C = &a->of.matrix;
    const double h = m->path.step[n].length.h;
    int status = FVI_SUCCESS;
    if (!m->want->damping && !m->want->terms && !a->has_line)
        return status;
    for (size_t i = 0; a->to && !status && i < m->s; i++) {
        const size_t r = a->to->r;
        for (size_t l = 0; l < r; l++) {
            double force = a->to->force[i * r + l];
            for (size_t c = 0; c < m->s; c++)
                force += a->to->W[i * m->s + c] * a->to->slope[c * r + l];
            m->y[l] = h * m->rule->b[i] * force;
        }
        memset(m->product, 0, m->d * sizeof *m->product);
        status = C->apply_damping(m->d, -1, m->y, C->params, m->product);
        a->sum += fvi_dot(m->d, m->V + i * m->d, m->product) - (a->has_line ? fvi_dot(m->d, m->v0, m->product) : 0);
        for (size_t j = 0; j < m->d; j++)
            a->plain[j] += m->product[j];
    }
    return status;
}

/* Add the derivative by alpha, before the history gets the step: dT/dbeta, (23.18). */
static int add_order(fvi_adjoint_structure_mesh_run *m, size_t n, fvi_adjoint_structure_mesh_damper *a)
{
    const fvi_damping_matrix *C = &a->of.matrix;
    const fvi_mesh_damper *memory = &a->to->memory;
    const double h = m->path.step[n].length.h, now = pow(h, -memory->beta), log_h = log(h);
    const size_t r = a->to->r, s = m->s;
    int status = FVI_SUCCESS;
    for (size_t i = 0; !status && i < s; i++)
        status = C->select_history(m->d, m->mu + i * m->d, a->to->zero, C->params, m->rate + i * r);
    for (size_t l = 0; l < r; l++) {
        double v[FVI_LANES] = { 0 }, rate[FVI_LANES], same[FVI_LANES], past[FVI_LANES];
        for (size_t i = 0; i < s; i++)
            v[i] = m->rate[i * r + l] - (memory->beta > 0 ? a->to->before[l] : 0);
        fvi_square_apply(s, &m->W0_rate, v, rate);
        fvi_square_apply(s, &memory->W0, v, same);
        fvi_modes_history_by_order(memory->modes, l, past);
        for (size_t i = 0; i < s; i++)
            m->rate[i * r + l] = memory->rho * (past[i] + now * (rate[i] - log_h * same[i]));
    }
    for (size_t i = 0; !status && i < s; i++) {
        memset(m->product, 0, m->d * sizeof *m->product);
        status = C->apply_damping(m->d, -h * m->rule->b[i], m->rate + i * r, C->params, m->product);
        a->sum_by_order += fvi_dot(m->d, m->V + i * m->d, m->product)
                           - (a->has_line ? fvi_dot(m->d, m->v0, m->product) : 0);
    }
    return status;
}

/* Add the derivatives by the force, which changes along straight lines between the rows. */
static void add_force(const fvi_adjoint_structure_mesh_run *m, size_t n)
{
    const fvi_recorded_step *step = m->path.step + n;
    for (size_t i = 0; m->want->force && i < m->s; i++)
        fvi_adjoint_mesh_force(m->run, step->t + m->rule->c[i] * step->length.h, step->length.h * m->rule->b[i], 1,
                               m->mu + (m->s - 1 - i) * m->d, m->want->force);
}

static int step_back(fvi_adjoint_structure_mesh_run *m, size_t n)
{
    const fvi_matrices *matrices = m->run->system->matrices;
    const double h = m->path.step[n].length.h;
    const size_t d = m->d, s = m->s;
    int status = fvi_adjoint_structure_mesh_read_rows(m, n);
    if (!status)
        status = solve(m, n);
    if (!status)
        status = add_matrices(m, n);
    if (!status && m->want->alpha && m->each->to)
        status = add_order(m, n, m->each);
    if (!status)
        status = fvi_structure_mesh_advance(m->o);
    for (size_t j = 0; !status && j < m->count; j++)
        status = add_damper(m, n, m->each + j);
    add_force(m, n);
    memset(m->moved, 0, d * sizeof *m->moved);
    for (size_t i = 0; i < s; i++)
        for (size_t j = 0; j < d; j++)
            m->moved[j] += h * m->rule->b[i] * m->mu[i * d + j];
    if (!status)
        status = matrices->stiffness(d, m->moved, matrices->params, m->product);
    for (size_t j = 0; j < d; j++) {
        m->xi[j] += m->by_x[j] - m->product[j];
        m->o->y[j] += m->moved[j];
        m->o->v[j] = m->mu[(s - 1) * d + j];
    }
    memcpy(m->extra, m->by_v, d * sizeof *m->extra);
    return status;
}

/* ---- the end ---- */

/* Riemann and Liouville's past below the order 1 acts as a jump of x by x_0 at t = 0. Write the part of dJ/dx_0 that
 * goes through this jump to by_place. */
static int end_start_jump(fvi_adjoint_structure_mesh_run *m, fvi_adjoint_structure_mesh_damper *a, double *by_place)
{
    fvi_mesh_matrix *to = a->to;
    fvi_modes *modes = to->memory.modes;
    const fvi_damping_matrix *C = &a->of.matrix;
    int status = FVI_SUCCESS;
    memset(m->y, 0, m->d * sizeof *m->y);
    if (!modes && to->memory.beta == -1)
        status = C->select_history(m->d, m->o->y, to->zero, C->params, m->y);
    if (modes) {
        const size_t count = fvi_modes_count(modes);
        double *ones = malloc(count * sizeof *ones);
        if (!ones)
            FVI_FAIL("no memory for the adjoint run", FVI_ENOMEM);
        for (size_t q = 0; q < count; q++)
            ones[q] = 1;
        fvi_modes_activate_all(modes);
        for (size_t n = 0; n < to->r; n++)
            m->y[n] = fvi_modes_accumulate(modes, n, ones, to->before[n], m->want->alpha ? m->rate + n : NULL);
        free(ones);
    }
    memset(by_place, 0, m->d * sizeof *by_place);
    if (!status && m->want->alpha)
        status = C->apply_damping(m->d, -to->memory.rho, m->rate, C->params, by_place);
    a->sum_by_order += fvi_dot(m->d, m->run->x0, by_place);
    memset(by_place, 0, m->d * sizeof *by_place);
    return status ? status : C->apply_damping(m->d, -to->memory.rho, m->y, C->params, by_place);
}

/* Write the derivatives by a factor of each damper, and add the derivatives by the start through the dampers. */
static int end_dampers(fvi_adjoint_structure_mesh_run *m)
{
    const fvi_sensitivities *want = m->want;
    int status = FVI_SUCCESS;
    for (size_t j = 0; !status && j < m->count; j++) {
        fvi_adjoint_structure_mesh_damper *a = m->each + j;
        double by_factor = -a->sum;
        if (a->to && fvi_structure_mesh_starts_with_jump(&a->of)) {
            status = end_start_jump(m, a, m->product);
            by_factor -= fvi_dot(m->d, m->run->x0, m->product);
            for (size_t i = 0; i < m->d; i++)
                m->xi[i] -= m->product[i];
        }
        for (size_t i = 0; a->has_line && i < m->d; i++)
            m->extra[i] += a->plain[i];
        if (want->damping)
            want->damping[j] = by_factor;
        if (want->alpha)
            *want->alpha = -2 * a->sum_by_order;
        if (want->terms) /* only a law of one term gets here */
            want->terms[0] = by_factor / m->run->law->term[0].rho;
    }
    return status;
}

static int end(fvi_adjoint_structure_mesh_run *m)
{
    const fvi_run *run = m->run;
    const fvi_sensitivities *want = m->want;
    const fvi_matrices *matrices = run->system->matrices;
    const size_t d = m->d;
    int status = fvi_recorded_steps_slopes(&m->path, run, m->J, 0, m->Jx, m->Jp, m->Jk);
    for (size_t i = 0; i < d; i++)
        m->xi[i] += m->Jx[i];
    if (!status)
        status = end_dampers(m);
    if (!status)
        status = fvi_divide_by_mass(run->system, m->extra, m->room);
    for (size_t i = 0; i < d; i++) {
        const int has = run->law || run->system->mechanism
                        || fvi_initial_history_solvable(run->past, run->alpha, run->system->damping[i], 1);
        if (want->x0)
            want->x0[i] = has ? m->xi[i] : NAN; /* (19.2) */
        if (want->p0)
            want->p0[i] = m->o->v[i] + m->room[i] + m->Jk[i];
    }
    if (want->mass && !status) { /* v0 is M^-1 p0; p_N is M v_N plus the impulse at the last time */
        status = matrices->inertia(d, m->path.impulse_dv, matrices->params, m->product);
        *want->mass = m->by_M - fvi_dot(d, run->p0, m->o->v) - fvi_dot(d, m->v0, m->extra)
                      + fvi_dot(d, m->Jp, m->path.p) - fvi_dot(d, m->Jp, m->product);
    }
    if (want->parameters)
        *want->parameters = -m->by_K;
    return status || fvi_all_finite(d, m->xi) ? status : FVI_EOVRFLW;
}

int fvi_adjoint_structure_mesh(const fvi_run *run, const fvi_objective *J, const fvi_sensitivities *want)
{
    fvi_adjoint_structure_mesh_run m = { .run = run, .J = J, .want = want, .d = run->system->d };
    int status = fvi_recorded_steps_run(run, want->x0 != NULL, &m.path);
    if (!status)
        status = start(&m);
    for (size_t n = m.path.steps; !status && n-- > 0;)
        status = step_back(&m, n);
    if (!status)
        status = end(&m);
    free(m.each);
    free(m.block);
    fvi_recorded_steps_free(&m.path);
    return status;
}
