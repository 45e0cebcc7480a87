/* src/adjoint_mechanism/adjoint_mechanism_stages.c -- A step of the adjoint run of a mechanism with stages. [H 23, 29]
 *
 * A_i is the multiplier of row i of (29.7), and beta that of p_{k+1}. So phi_i = h b_i (A_i + beta) is the multiplier
 * of the force of stage i, tau_l = sum_i T_il A_i that of L_v, and nu_i = -grad g(X_i) . phi_i that of the force
 * lambda_i. By (17.6) the multiplier of the slopes zdot of all steps is chi = B P sum_n W_n P B^-1 nu_{k+n}. */
#include "adjoint_mechanism.h"

#include "system/dot.h"
#include "system/lagrangian_point.h"

#include <string.h>

/* Compute phi and tau from the multipliers A of the rows; NULL: zeros. */
static void find_forces(fvi_adjoint_mechanism *m, const double *A)
{
    const fvi_mechanism_state *o = m->o;
    const size_t d = m->d, s = m->s, inner = s - o->begin;
    const double h = m->o->h;
    for (size_t i = 0; i < s; i++)
        for (size_t j = 0; j < d; j++) {
            const double own = A && i < inner ? A[i * d + j] : 0;
            double sum = 0;
            m->phi[i * d + j] = h * o->rule->b[i] * (own + m->beta[j]);
            for (size_t l = 0; A && l < inner; l++)
                sum += o->T[l][i] * A[l * d + j];
            m->tau[i * d + j] = sum;
        }
}

/* Compute nu of each damper, and chi to eta: the known part of later steps, and W_0 of this step. */
static void find_dampers(fvi_adjoint_mechanism *m)
{
    const fvi_mechanism_state *o = m->o;
    const size_t d = m->d, s = m->s;
    const double *b = o->rule->b;
    for (size_t e = 0; e < m->r; e++) {
        fvi_adjoint_mechanism_damper *a = m->damper + e;
        for (size_t i = 0; i < s; i++)
            a->nu[i] = -fvi_dot(d, o->gradient + (i * m->r + e) * d, m->phi + i * d);
        for (size_t i = 0; i < s; i++) {
            double sum = a->past[i];
            for (size_t l = 0; l < s; l++)
                sum += o->W[(e * s + i) * s + l] * a->nu[s - 1 - l] / b[s - 1 - l];
            a->eta[s - 1 - i] = b[s - 1 - i] * sum;
        }
    }
}

/* Compute kappa_i, the derivative by V_i. V_i and zdot_i depend on X_l through E. */
static void find_slopes(fvi_adjoint_mechanism *m)
{
    const fvi_mechanism_state *o = m->o;
    const size_t d = m->d;
    for (size_t i = 0; i < m->s; i++)
        for (size_t c = 0; c < d; c++) {
            double sum = m->source ? m->source[i * d + c] : 0;
            for (size_t a = 0; a < d; a++)
                sum += o->Lvv[(i * d + c) * d + a] * m->tau[i * d + a]
                       + o->fv[(i * d + a) * d + c] * m->phi[i * d + a];
            m->kappa[i * d + c] = sum;
        }
}

/* Add the derivative by X_l without the slopes, d numbers. */
static void add_stage_position_term(const fvi_adjoint_mechanism *m, size_t l, double *to)
{
    const fvi_mechanism_state *o = m->o;
    const size_t d = m->d;
    for (size_t c = 0; c < d; c++)
        for (size_t a = 0; a < d; a++)
            to[c] += o->fx[(l * d + a) * d + c] * m->phi[l * d + a]
                     + o->Lxv[(l * d + c) * d + a] * m->tau[l * d + a];
}

/* Add the derivative by the increment of X_l through the slopes, times factor. G: the gradients of the dampers
 * there. */
static void add_slopes(const fvi_adjoint_mechanism *m, size_t l, double factor, const double *G,
                       double *to)
{
    const fvi_mechanism_state *o = m->o;
    const size_t d = m->d;
    for (size_t i = 0; i < m->s; i++) {
        const double E = factor * o->E[i][l] / m->o->h;
        for (size_t c = 0; c < d; c++)
            to[c] += E * m->kappa[i * d + c];
        for (size_t e = 0; e < m->r; e++)
            for (size_t c = 0; c < d; c++)
                to[c] += E * m->damper[e].eta[i] * G[e * d + c];
    }
}

/* Write the derivatives by the impulses of the constraints at stage i: they add -C_i^T / h times themselves to p_{k+1},
 * whose multiplier is beta. */
static int add_constraints(fvi_adjoint_mechanism *m, size_t i)
{
    const fvi_mechanism_state *o = m->o;
    const fvi_constraints *c = m->run->system->mechanism->constraints;
    const size_t d = m->d, inner = m->s - o->begin;
    const double h = m->o->h, t = fvi_mechanism_stage_time(m->stepper, i);
    double *to = m->multiplier + inner * d + i * o->m;
    const int status = c->gradient(t, d, o->X + i * d, c->params, m->gradient, NULL);
    for (size_t l = 0; l < o->m; l++)
        to[l] = -fvi_dot(d, m->gradient + l * d, m->beta) / h;
    return status;
}

/* Solve for the multipliers A. The right-hand side is minus the derivative by the unknown stages without A. */
static int solve_multipliers(fvi_adjoint_mechanism *m)
{
    const fvi_mechanism_state *o = m->o;
    const size_t d = m->d, s = m->s, n = m->n;
    memset(m->multiplier, 0, n * sizeof *m->multiplier);
    find_forces(m, NULL);
    find_dampers(m);
    find_slopes(m);
    for (size_t l = o->begin; l < s; l++) {
        double *to = m->multiplier + (l - o->begin) * d;
        add_stage_position_term(m, l, to);
        add_slopes(m, l, 1, o->gradient + l * m->r * d, to);
        for (size_t c = 0; l + 1 == s && c < d; c++)
            to[c] += m->g[c];
    }
    int status = FVI_SUCCESS;
    for (size_t i = 0; !status && o->m && i < s - o->begin; i++)
        status = add_constraints(m, i);
    if (status)
        return status;
    for (size_t i = 0; i < n; i++) {
        m->multiplier[i] *= -m->o->h; /* the rows of the equation are h times (29.7) */
        for (size_t j = 0; j < n; j++)
            m->matrix[j * n + i] = o->matrix[i * n + j];
    }
    return fvi_solve_matrix(n, m->matrix, m->multiplier, m->order);
}

static void add_forces(fvi_adjoint_mechanism *m, size_t k)
{
    const size_t d = m->d;
    double *force = m->want->force ? m->want->force + k * (m->s - 1) * d : NULL;
    for (size_t i = 0; force && i < m->s * d; i++)
        force[i] += m->phi[i];
}

static int push_dampers(fvi_adjoint_mechanism *m, size_t k)
{
    const fvi_mechanism_state *o = m->o;
    const size_t s = m->s;
    const double h = m->o->h;
    int status = FVI_SUCCESS;
    for (size_t e = 0; !status && e < m->r; e++) {
        fvi_adjoint_mechanism_damper *a = m->damper + e;
        double slope_less_start[FVI_STAGES], by[FVI_STAGES];
        for (size_t i = 0; i < s; i++) {
            by[i] = a->nu[i] / (h * o->rule->b[i]);
            a->factor += a->nu[i] * o->lambda[e * s + i];
            a->by_drift -= a->eta[i];
            slope_less_start[i] = o->zdot[e * s + i] - (a->needs_start_slope ? a->A : 0);
        }
        fvi_adjoint_mechanism_damper_impulses(m, k, a, by);
        status = fvi_adjoint_mechanism_damper_push(m, a, slope_less_start);
    }
    return status;
}

/* Add the derivatives through the constraints of the stages to g. If the increments stay and x_k moves, the stages no
 * longer satisfy the constraints. */
static int add_rows_of_constraints(fvi_adjoint_mechanism *m)
{
    const fvi_mechanism_state *o = m->o;
    const fvi_constraints *c = m->run->system->mechanism->constraints;
    const size_t d = m->d, rows = (m->s - o->begin) * d;
    int status = FVI_SUCCESS;
    for (size_t i = o->begin; i < m->s && !status; i++) {
        const double *by = m->multiplier + rows + (i - o->begin) * o->m;
        status = c->gradient(fvi_mechanism_stage_time(m->stepper, i), d, o->X + i * d, c->params,
                             m->gradient, NULL);
        for (size_t l = 0; l < o->m; l++)
            for (size_t j = 0; j < d; j++)
                m->g[j] += by[l] / o->h * m->gradient[l * d + j];
    }
    return status;
}

/* Add the derivatives by x_k with all increments fixed to g, which has the derivative by x_{k+1}. This form contains no
 * 1/h that cancels, so it loses no digits in a very short step. */
static int add_position_terms(fvi_adjoint_mechanism *m)
{
    const fvi_mechanism_state *o = m->o;
    const size_t d = m->d;
    for (size_t l = 0; l < m->s; l++) {
        add_stage_position_term(m, l, m->g);
        for (size_t e = 0; e < m->r; e++) {
            const double *G = o->gradient + (l * m->r + e) * d;
            double sum = 0;
            for (size_t i = 0; i < m->s; i++)
                sum += m->damper[e].eta[i] * o->E[i][l];
            for (size_t c = 0; c < d; c++)
                m->g[c] += sum / o->h * (G[c] - o->G[e * d + c]);
        }
    }
    return o->m ? add_rows_of_constraints(m) : FVI_SUCCESS;
}

/* The same through the slopes of the stages, after their equation has been solved. */
static int find_position_multipliers(fvi_adjoint_mechanism *m)
{
    const fvi_mechanism_state *o = m->o;
    memset(m->g, 0, m->d * sizeof *m->g);
    for (size_t l = o->begin; l < m->s; l++)
        add_slopes(m, l, -1, o->G, m->g);
    for (size_t l = 0; l < o->begin; l++)
        add_stage_position_term(m, l, m->g);
    return FVI_SUCCESS;
}

//> stages
int fvi_adjoint_mechanism_stages(fvi_adjoint_mechanism *m, size_t k)
{
    const size_t d = m->d;
    int status = solve_multipliers(m);
    if (status)
        return status;
    find_forces(m, m->multiplier);
    find_dampers(m);
    find_slopes(m);
    status = (m->mesh ? add_position_terms : find_position_multipliers)(m);
    for (size_t i = 0; !status && i < m->s; i++)
        status = fvi_adjoint_mechanism_point(m, i, fvi_mechanism_stage_time(m->stepper, i),
                                             m->tau + i * d, m->phi + i * d);
    if (!status)
        status = m->mesh ? fvi_adjoint_mesh_push(m) : push_dampers(m, k);
    if (!m->mesh)
        add_forces(m, k);
    if (!status)
        status = fvi_adjoint_mechanism_names_stages(m);
    for (size_t j = 0; j < d; j++)
        m->beta[j] += m->multiplier[j];
    return status;
}
//< stages
