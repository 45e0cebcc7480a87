/* src/variable_step/variable_mechanism.c -- Steps of a mechanism in a run with variable steps. [H 29, 22] */
#include "variable_mechanism.h"

#include "system/archive_pieces.h"
#include "system/dot.h"
#include "system/fail.h"
#include "system/lagrangian_point.h"
#include "system/larger.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- the start ---- */

/* Compute v of p, and a = M^-1 (L_x + F), at the start. If they do not exist there, another function refuses the
 * start. */
static int motion_at_start(fvi_stepper *s, double *v, double *a)
{
    const fvi_system *system = s->run.system;
    const size_t d = system->d;
    double *Lvv = calloc(d * d, sizeof *Lvv);
    size_t *order = calloc(d, sizeof *order);
    int status = Lvv && order ? FVI_SUCCESS : FVI_ENOMEM;
    if (!status)
        status = fvi_velocity_of_momentum(system, 0, s->x, s->p, v);
    if (!status)
        status = fvi_lagrangian_point(system, 0, s->x, v, NULL, a, NULL, NULL, NULL, Lvv);
    if (!status)
        status = fvi_step_force(s, 0, s->F);
    for (size_t j = 0; j < d && !status; j++)
        a[j] += s->F[j];
    if (!status)
        status = fvi_solve_matrix(d, Lvv, a, order);
    free(Lvv);
    free(order);
    return status;
}

int fvi_mesh_scale(fvi_stepper *s, double *scale)
{
    const size_t d = s->run.system->d;
    const double h = s->run.h;
    double *v = calloc(2 * d, sizeof *v);
    if (!v)
        FVI_FAIL("no memory for the start", FVI_ENOMEM);
    const int status = motion_at_start(s, v, v + d);
    *scale = fvi_variable_step_scale(largest_abs(d, s->x), status ? 0 : h * largest_abs(d, v),
                                     status ? 0 : h * h * largest_abs(d, v + d));
    free(v);
    return status == FVI_ENOMEM ? status : FVI_SUCCESS;
}

/* Set masses for the bounds of forces: a force of 1 on a coordinate accelerates each coordinate by 1 / mass at most.
 * The mass of a coordinate without inertia is infinite. */
static void set_masses(fvi_variable_step_state *o)
{
    const size_t d = o->d;
    struct fvi_mesh_mechanism *m = o->mechanism;
    for (size_t j = 0; j < d; j++) {
        double most = 0;
        for (size_t i = 0; i < d; i++)
            most = larger(most, fabs(m->inverse[i * d + j]));
        m->mass[j] = o->group[j].mass = 1 / most;
    }
}

int fvi_mesh_answer(const fvi_mechanism_state *o, const double *Lvv, const double *C, double *r)
{
    const size_t d = o->d, n = d + o->m;
    double *J = o->room;
    memset(J, 0, n * n * sizeof *J);
    for (size_t i = 0; i < d; i++) {
        memcpy(J + i * n, Lvv + i * d, d * sizeof *J);
        if (o->is_massless[i]) {
            J[i * n + i] = 1;
            r[i] = 0;
        }
        for (size_t l = 0; l < o->m; l++)
            J[i * n + d + l] = J[(d + l) * n + i] = C[l * d + i];
    }
    const int status = fvi_solve_matrix(n, J, r, o->order);
    for (size_t i = 0; i < d; i++)
        if (o->is_massless[i])
            r[i] = 0;
    return status;
}

/* Compute how v answers to each component of p, column by column. */
static int invert(const fvi_mechanism_state *o, const double *Lvv, const double *C, double *inverse)
{
    const size_t d = o->d, n = d + o->m;
    double *column = o->room + n * n;
    int status = FVI_SUCCESS;
    for (size_t j = 0; j < d && !status; j++) {
        memset(column, 0, n * sizeof *column);
        column[j] = 1;
        status = fvi_mesh_answer(o, Lvv, C, column);
        for (size_t i = 0; i < d; i++)
            inverse[i * d + j] = column[i];
    }
    return status;
}

/* Compute the same at the end of the step that has been tried. */
static int invert_at_end(const fvi_stepper *s, const fvi_variable_step_state *o)
{
    const fvi_mechanism_state *of = s->mechanism;
    const size_t last = of->s - 1, d = of->d;
    double *C = of->room + 2 * (d + of->m + 1) * (d + of->m + 1);
    const int status = of->m ? fvi_mechanism_tie_gradients(s, fvi_mechanism_stage_time(s, last),
                                                           of->X + last * d, C, NULL)
                             : FVI_SUCCESS;
    return status ? status : invert(of, of->Lvv + last * d * d, C, o->mechanism->inverse);
}

int fvi_mesh_begin(fvi_stepper *s, fvi_variable_step_state *o)
{
    const size_t d = o->d;
    fvi_mechanism_state *of = s->mechanism;
    int status = fvi_mesh_begin_dampers(s, o);
    if (!status)
        status = fvi_lagrangian_point(s->run.system, 0, s->x, of->v, NULL, NULL, NULL, NULL,
                                      NULL, of->Lvv);
    if (!status)
        status = invert(of, of->Lvv, of->C, o->mechanism->inverse);
    if (status)
        return status;
    for (size_t j = 0; j < d; j++) {
        o->group_of[j] = j;
        o->group[j].compliance = o->T;
        o->y[j] = s->x[j];
        o->v[j] = of->v[j];
    }
    set_masses(o);
    return status;
}

/* ---- a trial of a step, and its error ---- */

/* Write the initial guess: the polynomial of velocities of the last step goes on, and so do the last multipliers. */
static void guess_increments(fvi_stepper *s, fvi_variable_step_state *o)
{
    const size_t d = o->d, n = o->rule->s;
    const double h = o->length.h;
    fvi_variable_step_extrapolate(o);
    for (size_t j = 0; j < d; j++) {
        double move[FVI_LANES];
        fvi_square_apply(n, o->to_x, o->delta + j * FVI_LANES, move);
        for (size_t i = 0; i < n; i++)
            s->mechanism->u[i * d + j] = h * (o->rule->c[i] * o->v[j] + move[i]);
    }
    const fvi_mechanism_state *of = s->mechanism;
    for (size_t i = 0; i < n; i++)
        for (size_t l = 0; l < of->m; l++)
            of->u[n * d + i * of->m + l] = h * h * o->rule->b[i] * of->ended[l];
}

/* Compute delta = V - v_k, and the Legendre coefficients of x'' and p'. */
static void describe_stages(fvi_stepper *s, fvi_variable_step_state *o)
{
    const fvi_mechanism_state *of = s->mechanism;
    const size_t d = o->d, n = o->rule->s;
    for (size_t j = 0; j < d; j++) {
        double *delta = o->delta + j * FVI_LANES, gain[FVI_LANES] = { 0 };
        for (size_t i = 0; i < n; i++) {
            delta[i] = of->V[i * d + j] - o->v[j];
            gain[i] = of->Lv[i * d + j] - s->p[j];
        }
        fvi_square_apply(n, &o->rule->legendre, delta, o->accel_legendre + j * FVI_LANES);
        fvi_square_apply(n, &o->rule->legendre, gain, o->mechanism->slope + j * FVI_LANES);
    }
}

int fvi_mesh_try(fvi_stepper *s, fvi_variable_step_state *o, fvi_length length,
                 double *error)
{
    fvi_mechanism_state *of = s->mechanism;
    o->length = length;
    of->h = length.h;
    of->t = o->t;
    of->rest_scale = of->m > of->permanent ? o->scale : 0;
    fvi_mesh_present(s, o);
    fvi_mesh_predict(s, o);
    guess_increments(s, o);
    int status = fvi_mechanism_solve_stages(s);
    if (status == FVI_EOVRFLW) /* outside of the domain of L: a shorter step may stay inside */
        status = FVI_EMAXITER;
    if (!status)
        status = invert_at_end(s, o);
    if (status)
        return status;
    describe_stages(s, o);
    return fvi_mesh_estimate(s, o, error);
}

/* ---- a step ---- */

void fvi_mesh_coefficients(const fvi_variable_step_state *o, const double *values, double *to)
{
    double sums[FVI_LANES];
    fvi_square_apply(o->rule->s, &o->rule->A, values, sums);
    fvi_square_apply(o->rule->s, &o->rule->legendre, sums, to);
}

/* Compute the coefficients of h f from the values of f at the stages. */
static void find_legendre_coefficients(const fvi_variable_step_state *o, const double *f, double *to)
{
    double values[FVI_LANES] = { 0 };
    for (size_t i = 0; i < o->rule->s; i++)
        values[i] = o->length.h * f[i];
    fvi_mesh_coefficients(o, values, to);
}

/* Compute the power F v at the stages. F is the sum of the force of t and the forces of velocity. */
static int powers_of_forces(fvi_stepper *s, double *power)
{
    const fvi_mechanism_state *of = s->mechanism;
    const fvi_state_force *force = s->run.system->mechanism->force_on;
    const size_t d = of->d;
    double *F = of->room;
    int status = FVI_SUCCESS;
    memset(F, 0, d * sizeof *F);
    for (size_t i = 0; i < of->s && !status; i++) {
        if (force)
            status = force->at(fvi_mechanism_inner_time(s, i), d, of->X + i * d, of->V + i * d,
                               force->params, F, NULL, NULL);
        power[i] = 0;
        for (size_t j = 0; j < d && !status; j++)
            power[i] += (of->load[i * d + j] + F[j]) * of->V[i * d + j];
    }
    return status;
}

/* Compute the coefficients, for times within the step, of the forces of dampers, their powers, the power of the forces
 * F, and the multipliers. */
static int describe_forces(fvi_stepper *s, fvi_variable_step_state *o)
{
    struct fvi_mesh_mechanism *m = o->mechanism;
    const fvi_mechanism_state *of = s->mechanism;
    const size_t n = o->rule->s;
    double power[FVI_LANES] = { 0 };
    for (size_t e = 0; e < m->r; e++) {
        const double *lambda = of->lambda + e * n;
        for (size_t i = 0; i < n; i++)
            power[i] = lambda[i] * of->zdot[e * n + i];
        find_legendre_coefficients(o, lambda, m->force0 + e * FVI_LANES);
        find_legendre_coefficients(o, power, m->power0 + e * FVI_LANES);
    }
    const int status = powers_of_forces(s, power);
    if (status)
        return status;
    find_legendre_coefficients(o, power, m->by_force0);
    m->by_force_begin = m->by_force;
    for (size_t i = 0; i < n; i++)
        m->by_force += o->length.h * o->rule->b[i] * power[i];
    for (size_t l = 0; l < of->m; l++) {
        for (size_t i = 0; i < n; i++)
            power[i] = of->u[n * o->d + i * of->m + l]
                       / (o->length.h * o->length.h * o->rule->b[i]);
        find_legendre_coefficients(o, power, m->multiplier0 + l * FVI_LANES);
    }
    return status;
}

//> take
int fvi_mesh_accept(fvi_stepper *s, fvi_variable_step_state *o)
{
    struct fvi_mesh_mechanism *m = o->mechanism;
    fvi_mechanism_state *of = s->mechanism;
    const size_t d = o->d, n = o->rule->s;
    int status = describe_forces(s, o);
    fvi_mechanism_keep_contacts(of);
    memcpy(m->slope0, m->slope, d * FVI_LANES * sizeof *m->slope);
    memcpy(m->p0, s->p, d * sizeof *s->p);
    memcpy(m->impulse0, of->impulse, m->r * sizeof *of->impulse);
    memcpy(m->work0, of->work, m->r * sizeof *of->work);
    fvi_mesh_advance(s, o);
    for (size_t j = 0; j < d; j++) {
        o->y0[j] = o->y[j];
        o->v0[j] = o->v[j];
        fvi_add_compensated(&o->y[j], &o->y_compensation[j], of->u[(n - 1) * d + j]);
        double gain = 0;
        for (size_t i = 0; i < n; i++)
            gain += o->length.h * o->rule->b[i] * of->f[i * d + j];
        fvi_add_compensated(&s->p[j], &m->p_compensation[j], gain);
        if (of->is_massless[j]) { /* otherwise a rounding error of p would be a force p/h in the next step */
            s->p[j] = of->Lv[(n - 1) * d + j];
            m->p_compensation[j] = 0;
        }
    }
    fvi_mechanism_keep_dampers(of);
    if (!status && of->m)
        status = fvi_mechanism_end_constraints(s);
    memcpy(o->v, of->v, d * sizeof *o->v);
    for (size_t e = 0; e < m->r && of->m; e++) /* now satisfies the hidden constraint */
        m->damper[e].now = fvi_dot(d, of->G + e * d, o->v);
    set_masses(o);
    return status;
}
//< take

/* ---- copies ---- */

int fvi_mesh_copy(const fvi_stepper *from, fvi_stepper *to)
{
    const fvi_variable_step_state *old = from->method_state;
    fvi_variable_step_state *o = to->method_state;
    o->mechanism = NULL;
    int status = fvi_mechanism_copy(from, to);
    if (!status)
        status = fvi_mesh_allocate(o, old->mechanism->r, to->mechanism->most);
    if (status)
        return status;
    struct fvi_mesh_mechanism *m = o->mechanism;
    const struct fvi_mesh_mechanism *of = old->mechanism;
    memcpy(m->numbers, of->numbers, (size_t)(of->slope - of->numbers) * sizeof *m->numbers);
    m->by_force = of->by_force;
    m->by_force_begin = of->by_force_begin;
    for (size_t j = 0; j < of->r && !status; j++)
        status = fvi_mesh_copy_damper(&of->damper[j], &m->damper[j]);
    return status;
}

int fvi_mesh_archive(fvi_stepper *s, fvi_archive *v)
{
    fvi_variable_step_state *o = s->method_state;
    struct fvi_mesh_mechanism *m = o->mechanism;
    int status = fvi_mechanism_serialize(s, v);
    if (!status)
        status = FVI_SERIALIZE(v, FVI_STATES(m->numbers, (size_t)(m->slope - m->numbers)), FVI_STATE(m->by_force),
                               FVI_STATE(m->by_force_begin));
    for (size_t j = 0; j < m->r && !status; j++) {
        fvi_mesh_damper *of = &m->damper[j];
        status = FVI_SERIALIZE(v, FVI_STATE(of->before), FVI_STATE(of->now));
        if (!status)
            status = fvi_mesh_archive_damper(of, v);
    }
    for (size_t j = 0; j < o->d; j++)
        o->group[j].mass = m->mass[j];
    m->h = 0;
    return status;
}

void fvi_mesh_free(fvi_variable_step_state *o)
{
    struct fvi_mesh_mechanism *m = o->mechanism;
    if (!m)
        return;
    for (size_t j = 0; m->damper && j < m->r; j++)
        fvi_mesh_free_damper(&m->damper[j]);
    free(m->damper);
    free(m->numbers);
    free(m);
}
