/* src/variable_step/variable_structure.c -- Steps of a structure in a run with variable steps. [H 27, 22] */
#include "variable_structure.h"

#include "system/archive_pieces.h"
#include "system/dot.h"
#include "system/fail.h"
#include "system/lagrangian_point.h"
#include "system/larger.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- the start ---- */

int fvi_structure_mesh_scale(fvi_stepper *s, double *scale)
{
    const fvi_system *system = s->run.system;
    const size_t d = system->d;
    const double h = s->run.h;
    double *v = calloc(2 * d, sizeof *v);
    if (!v)
        FVI_FAIL("no memory for the start", FVI_ENOMEM);
    double *a = v + d;
    memcpy(v, s->p, d * sizeof *v);
    for (size_t i = 0; i < system->force.impulse_count; i++)
        for (size_t j = 0; j < d; j++)
            v[j] = larger(fabs(v[j]), fabs(system->force.impulses[i].J[j]));
    int status = fvi_step_force(s, 0, s->F);
    if (!status)
        status = system->matrices->stiffness(d, s->x, system->matrices->params, a);
    for (size_t j = 0; j < d; j++)
        a[j] = s->F[j] - a[j];
    if (!status)
        status = fvi_divide_by_mass(system, v, v);
    if (!status)
        status = fvi_divide_by_mass(system, a, a);
    *scale = fvi_variable_step_scale(largest_abs(d, s->x), h * largest_abs(d, v), h * h * largest_abs(d, a));
    free(v);
    return status;
}

/* Compute about how far the lowest mode moves if its velocity is larger by 1: 2/omega, twice its amplitude; T if a
 * motion is free. Inverse iteration approaches omega from above. */
static int find_compliance(const fvi_system *system, double T, double *x, double *Mx, double *reach)
{
    enum { TIMES = 30 };
    const fvi_matrices *m = system->matrices;
    const size_t d = system->d;
    void *factors = NULL;
    int status = m->factorise(d, 0, NULL, 1, m->params, &factors);
    *reach = T;
    for (size_t j = 0; j < d; j++)
        x[j] = 1 + 0.37 * sin((double)(3 * j + 1)); /* only by chance a mode is orthogonal to x */
    for (int i = 0; i < TIMES && !status; i++) {
        status = m->inertia(d, x, m->params, Mx);
        const double of_x = fvi_dot(d, x, Mx);
        memcpy(x, Mx, d * sizeof *x);
        if (!status)
            status = m->solve(d, factors, x); /* y = K^{-1} M x */
        *reach = smaller(T, 2 * sqrt(fabs(fvi_dot(d, x, Mx) / of_x)));
        const double size = largest_abs(d, x);
        for (size_t j = 0; j < d; j++)
            x[j] /= size;
    }
    if (factors)
        m->free_factors(factors);
    return status == FVI_ESING ? FVI_SUCCESS : status;
}

/* Refuse matrices without complex factors or a product with M, and dampers of order 2. */
static int refuse(const fvi_stepper *s)
{
    const fvi_matrices *m = s->run.system->matrices;
    if (!m->factorise_complex || !m->solve_complex || !m->free_complex_factors || !m->inertia)
        return fvi_fail(s->error, FVI_EUNSUP, "matrices", NAN, "these matrices have no complex factors, or no "
                        "product with M, which methods with stages need");
    for (size_t j = 0; j < fvi_run_damper_count(&s->run); j++) {
        const fvi_run_damper of = fvi_run_damper_of(&s->run, j);
        if (of.growth == 2 && of.matrix.history_size > 0)
            return fvi_at_index(s->error, j,
                                fvi_fail(s->error, FVI_EUNSUP,
                                         s->run.system->mechanism ? "damper" : s->run.law ? "law" : "alpha",
                                         (double)j + 1, "a damping of order 2 is a mass: fvi-lobatto2d to 8d take it "
                                         "with matrices, fvi-adaptive does not"));
    }
    return FVI_SUCCESS;
}

/* Return nonzero if it is known that no pole beside the cut is too near to it. */
static int has_known_modes(const fvi_kernel *law)
{
    for (size_t i = 0; i < law->count; i++) {
        const fvi_kernel_term *t = &law->term[i];
        const int is_fraction = t->kind == FVI_KERNEL_ZENER && t->time > 0;
        if (t->kind > FVI_KERNEL_DISTRIBUTED || (is_fraction && !(t->alpha < 0.49)))
            return 0;
    }
    return 1;
}

int fvi_variable_step_takes_structure(const fvi_system *system, double alpha,
                                      const fvi_kernel *law)
{
    const fvi_matrices *m = system->matrices;
    const fvi_run run = { .system = system, .alpha = alpha, .law = law };
    if (!m || !m->factorise_complex || !m->solve_complex || !m->free_complex_factors || !m->inertia)
        return 0;
    for (size_t j = 0; j < fvi_run_damper_count(&run); j++) {
        const fvi_run_damper of = fvi_run_damper_of(&run, j);
        if (of.growth == 2 || (of.law && !has_known_modes(of.law)))
            return 0;
    }
    return 1;
}

int fvi_structure_mesh_start(fvi_stepper *s, fvi_variable_step_state *o)
{
    const int status = refuse(s);
    return status ? status : fvi_structure_mesh_allocate(s, o);
}

int fvi_structure_mesh_begin(fvi_stepper *s, fvi_variable_step_state *o)
{
    const fvi_system *system = s->run.system;
    struct fvi_mesh_structure *m = o->structure;
    double reach = o->T, mass = INFINITY;
    memcpy(o->y, s->x, o->d * sizeof *o->y);
    int status = fvi_divide_by_mass(system, s->p, o->v);
    if (!status)
        status = find_compliance(system, o->T, m->Kx, m->Kv, &reach);
    for (size_t j = 0; j < o->d; j++)
        mass = smaller(mass, system->mass[j]);
    *o->group = (fvi_coordinate_group){ .mass = mass, .compliance = reach };
    return status ? status : fvi_structure_mesh_begin_dampers(s, o);
}

/* The numbers of fvi_mesh_shortest, for dampers with many numbers each. */
double fvi_structure_mesh_shortest(const fvi_stepper *s, const fvi_variable_step_state *o)
{
    const struct fvi_mesh_structure *m = o->structure;
    double shortest = 1;
    for (size_t j = 0; j < m->count; j++) {
        const fvi_mesh_matrix *of = &m->damper[j];
        const int moves = largest_abs(o->d, s->p) > 0 || s->run.system->force.impulse_count > 0,
                  jumps = of->of.growth > 1 && moves
                          && (s->run.system->force.impulse_count > 0
                              || of->of.past != FVI_INITIAL_HISTORY_CAPUTO),
                  starts_with_jump = fvi_structure_mesh_starts_with_jump(&of->of)
                                     && (o->for_adjoint || largest_abs(o->d, s->x) > 0);
        const double power = jumps       ? 2 - of->of.growth
                             : starts_with_jump ? 1 - of->of.growth
                                         : INFINITY;
        shortest = smaller(shortest, pow(1e-4 * fmin(o->tolerance, 1), 1 / power));
    }
    return shortest;
}

/* ---- a trial of a step, and its error ---- */

/* Compute the load F - K (x_k + h c_i v_k) at the stages. */
static int set_load(fvi_stepper *s, fvi_variable_step_state *o)
{
    const fvi_matrices *m = s->run.system->matrices;
    struct fvi_mesh_structure *of = o->structure;
    const size_t d = o->d;
    const double h = o->length.h;
    int status = m->stiffness(d, o->y, m->params, of->Kx);
    if (!status)
        status = m->stiffness(d, o->v, m->params, of->Kv);
    for (size_t i = 0; i < o->rule->s && !status; i++) {
        const double ch = h * o->rule->c[i];
        status = fvi_force_value(s, fvi_variable_step_stage_time(o->rule, o->t, h, i));
        for (size_t j = 0; j < d; j++)
            of->load[i * d + j] = s->F[j] - of->Kx[j] - ch * of->Kv[j];
    }
    return status;
}

/* Estimate the error as in variable_steps.c. But the wrong effect of the memory moves all coordinates together. */
static int estimate_error(fvi_variable_step_state *o, double *error)
{
    struct fvi_mesh_structure *m = o->structure;
    const fvi_variable_rule *rule = o->rule;
    const size_t d = o->d, s = rule->s;
    for (size_t j = 0; j < d; j++) {
        double *delta = o->delta + j * FVI_LANES;
        for (size_t i = 0; i < s; i++)
            delta[i] = m->delta[i * d + j];
        fvi_square_apply(s, &rule->legendre, delta, o->accel_legendre + j * FVI_LANES);
        m->last[j] = o->accel_legendre[j * FVI_LANES + s - 1];
    }
    const int status = fvi_structure_mesh_leak(o, m->last, m->size);
    const double reach = fvi_variable_step_compliance(o, o->group);
    *error = 0;
    for (size_t j = 0; j < d && !status; j++)
        *error = larger(*error, (rule->stage * o->length.h + reach * rule->alias) * fabs(m->last[j])
                                    + reach * m->size[j]);
    return status;
}

int fvi_structure_mesh_try(fvi_stepper *s, fvi_variable_step_state *o, fvi_length length,
                           double *error)
{
    o->length = length;
    int status = fvi_structure_mesh_solver(s, o, length.h);
    if (!status)
        status = set_load(s, o);
    if (!status)
        status = fvi_structure_mesh_predict(o);
    if (!status)
        status = fvi_stage_solver_solve(o->structure->solver, o->structure->load,
                                        o->structure->delta);
    return status ? status : estimate_error(o, error);
}

int fvi_structure_mesh_jump(fvi_stepper *s, fvi_variable_step_state *o, const double *J, double factor)
{
    struct fvi_mesh_structure *m = o->structure;
    double *v = m->Kv;
    for (size_t j = 0; j < o->d; j++)
        v[j] = factor * J[j];
    int status = fvi_divide_by_mass(s->run.system, v, v);
    for (size_t j = 0; j < m->count && !status; j++) {
        const fvi_mesh_matrix *of = &m->damper[j];
        const fvi_damping_matrix *C = &of->of.matrix;
        status = C->select_history(o->d, v, of->zero, C->params, of->z);
        for (size_t n = 0; n < of->r; n++)
            of->now[n] += of->z[n];
    }
    for (size_t j = 0; j < o->d; j++) {
        o->impulse_dv[j] += v[j];
        o->v[j] += v[j];
    }
    return status;
}

/* ---- copies ---- */

static size_t numbers_of(const fvi_variable_step_state *o, const fvi_mesh_matrix *of)
{
    return (5 + 2 * o->rule->s) * of->r;
}

int fvi_structure_mesh_copy(const fvi_stepper *from, fvi_stepper *to)
{
    const fvi_variable_step_state *old = from->method_state;
    fvi_variable_step_state *o = to->method_state;
    o->structure = NULL;
    int status = fvi_structure_mesh_allocate(to, o);
    for (size_t j = 0; !status && j < old->structure->count; j++) {
        const fvi_mesh_matrix *of = &old->structure->damper[j];
        fvi_mesh_matrix *copy = &o->structure->damper[j];
        memcpy(copy->before, of->before, numbers_of(o, of) * sizeof *of->before);
        memcpy(copy->W, of->W, sizeof of->W);
        status = fvi_mesh_copy_damper(&of->memory, &copy->memory);
    }
    return status;
}

int fvi_structure_mesh_archive(fvi_stepper *s, fvi_archive *v)
{
    fvi_variable_step_state *o = s->method_state;
    struct fvi_mesh_structure *m = o->structure;
    int status = FVI_SUCCESS;
    for (size_t j = 0; j < m->count && !status; j++) {
        fvi_mesh_matrix *of = &m->damper[j];
        status = FVI_SERIALIZE(v, FVI_STATES(of->before, 3 * of->r), FVI_STATES(of->force, o->rule->s * of->r),
                               FVI_STATES(of->slope, o->rule->s * of->r), FVI_STATES(of->W, FVI_STAGES * FVI_STAGES));
        if (!status)
            status = fvi_mesh_archive_damper(&of->memory, v);
    }
    m->h = 0;
    return status;
}

void fvi_structure_mesh_free(fvi_variable_step_state *o)
{
    struct fvi_mesh_structure *m = o->structure;
    if (!m)
        return;
    for (size_t j = 0; m->damper && j < m->count; j++) {
        fvi_mesh_free_damper(&m->damper[j].memory);
        free(m->damper[j].before);
    }
    for (size_t i = 0; i < FVI_MESH_RUNGS; i++)
        fvi_stage_solver_free(m->rung[i].solver);
    free(m->damper);
    free(m->numbers);
    free(m);
}
