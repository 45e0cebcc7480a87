/* src/mechanism/mechanism_stages.c -- Take a step with stages; forms M and D share one equation. [H 29]
 *
 *     V = E (X - x_k) / h,     zdot = E (g(X) - g(x_k)) / h,
 *     R_i = p_k [i = 1] + h b_i (L_x + F - G^T lambda)_i + sum_j T_ij L_v(X_j, V_j)
 *           - h b_i C_i^T Lambda_i = 0,
 *     p_{k+1} = p_k + sum_i h b_i (L_x + F - G^T lambda - C^T Lambda)_i
 *
 * In form M, E = D and T = D^T B, and the first stage is x_k. In form D, E = A^-1 and T = -B A^-1, and all stages are
 * unknown. (29.7), (29.8) */
#include "mechanism_state.h"

#include "system/lagrange_polynomial.h"

#include <math.h>
#include <string.h>

/* ---- tables ---- */

//> tables
/* A^-1 is D plus 1 / b_1 in the first entry, (17.3). b^T A^-1 = e_s^T, so p_{k+1} is L_v of the last stage in form
 * D. */
void fvi_mechanism_tables(fvi_mechanism_state *o)
{
    const fvi_lobatto_rule *r = o->rule;
    const int is_m = o->form == FVI_MECHANISM_FORM_M;
    for (size_t i = 0; i < o->s; i++)
        for (size_t j = 0; j < o->s; j++) {
            const double corner = !is_m && i == 0 && j == 0 ? 1 / r->b[0] : 0;
            o->E[i][j] = r->D[i][j] + corner;
            o->T[i][j] =
                is_m ? r->b[j] * r->D[j][i] : -r->b[i] * (r->D[i][j] + corner);
            o->next[i][j] = fvi_lagrange_polynomial(o->s, r->c, j, 1 + r->c[i]);
        }
}
//< tables

/* ---- the equation ---- */

//> row
/* Return h R_i of coordinate j, without the constraints. */
static double residual(const fvi_stepper *s, size_t i, size_t j)
{
    const fvi_mechanism_state *o = s->mechanism;
    double R = o->h * o->rule->b[i] * o->f[i * o->d + j]
               + (i == 0 ? s->p[j] : 0);
    for (size_t l = 0; l < o->s; l++)
        R += o->T[i][l] * o->Lv[l * o->d + j];
    return o->h * R;
}
//< row

//> block
/* Write the derivative of the rows of stage i by the increments of stage l to J. */
static void add_stage_block(const fvi_stepper *s, size_t i, size_t l, double *J)
{
    const fvi_mechanism_state *o = s->mechanism;
    const size_t d = o->d, dd = d * d, n = o->n, r = o->r;
    const double h = o->h, b = o->rule->b[i];
    double inertia[FVI_STAGES];
    for (size_t m = 0; m < o->s; m++)
        inertia[m] = o->T[i][m] * o->E[m][l];
    for (size_t a = 0; a < d; a++)
        for (size_t c = 0; c < d; c++) {
            const size_t at = a * d + c;
            double sum = h * b * o->fv[i * dd + at] * o->E[i][l]
                         + h * o->T[i][l] * o->Lxv[l * dd + c * d + a];
            if (i == l)
                sum += h * h * b * o->fx[i * dd + at];
            for (size_t m = 0; m < o->s; m++)
                sum += inertia[m] * o->Lvv[m * dd + at];
            J[a * n + c] = sum;
        }
    for (size_t e = 0; e < r; e++) {
        double WE = 0;
        for (size_t m = 0; m < o->s; m++)
            WE += o->W[(e * o->s + i) * o->s + m] * o->E[m][l];
        const double *row = o->gradient + (i * r + e) * d,
                     *column = o->gradient + (l * r + e) * d;
        for (size_t a = 0; a < d; a++)
            for (size_t c = 0; c < d; c++)
                J[a * n + c] -= h * b * WE * row[a] * column[c];
    }
}
//< block

/* Add the constraints: -C_i^T mu_i to the rows of stage i, with mu_i = h^2 b_i Lambda_i, and the rows c = 0 at each
 * unknown stage. */
static int add_constraints(fvi_stepper *s, const double *u)
{
    fvi_mechanism_state *o = s->mechanism;
    const size_t d = o->d, m = o->m, n = o->n, inner = o->s - o->begin;
    double *C = o->room;
    int status = FVI_SUCCESS;
    for (size_t i = 0; i < o->s && !status; i++) {
        const double *x = o->X + i * d, t = fvi_mechanism_stage_time(s, i);
        status = fvi_mechanism_tie_gradients(s, t, x, C, NULL);
        for (size_t l = 0; l < m && i < inner; l++)
            for (size_t j = 0; j < d; j++) {
                o->residual[i * d + j] -= C[l * d + j] * u[inner * d + i * m + l];
                o->matrix[(i * d + j) * n + inner * d + i * m + l] =
                    -C[l * d + j];
            }
        if (i < o->begin || status)
            continue;
        const size_t unknown = i - o->begin, row = inner * d + unknown * m;
        status = fvi_mechanism_tie_values(s, t, x, o->residual + row);
        if (!status)
            status = fvi_mechanism_contact_increments(s, u, i, C, o->residual + row);
        for (size_t l = 0; l < m; l++)
            memcpy(o->matrix + (row + l) * n + unknown * d, C + l * d,
                   d * sizeof *C);
    }
    return status;
}

static int assemble_equations(fvi_stepper *s, const double *u)
{
    fvi_mechanism_state *o = s->mechanism;
    const size_t d = o->d, inner = o->s - o->begin;
    int status = fvi_mechanism_evaluate_stages(s, u);
    if (!status)
        status = fvi_mechanism_add_curvature(s, u);
    if (status)
        return status;
    if (o->m)
        memset(o->matrix, 0, o->n * o->n * sizeof *o->matrix);
    for (size_t i = 0; i < inner; i++) {
        for (size_t j = 0; j < d; j++)
            o->residual[i * d + j] = residual(s, i, j);
        for (size_t l = 0; l < inner; l++)
            add_stage_block(s, i, l + o->begin, o->matrix + i * d * o->n + l * d);
    }
    return o->m ? add_constraints(s, u) : status;
}

int fvi_mechanism_linearise(fvi_stepper *s, const double *u)
{
    const fvi_mechanism_state *o = s->mechanism;
    return (o->rule ? assemble_equations : fvi_mechanism_linearise_nodes)(s, u);
}

/* ---- a step ---- */

/* Guess the increments by extrapolation of the last step. For up to five stages its polynomial is continued. For more
 * stages the polynomial would oscillate, so its last slope is continued. */
static void guess_increments(const fvi_stepper *s)
{
    enum { FEW = 5 };
    const fvi_mechanism_state *o = s->mechanism;
    const size_t d = o->d;
    for (size_t j = 0; j < d; j++) {
        double u[FVI_STAGES] = { 0 }, slope = 0, end = fvi_mechanism_increment(o, o->u, o->s - 1, j);
        for (size_t l = o->begin; l < o->s; l++)
            slope += o->E[o->s - 1][l] * fvi_mechanism_increment(o, o->u, l, j);
        for (size_t i = 0; i < o->s; i++) {
            u[i] = -end;
            for (size_t l = 0; l < o->s; l++)
                u[i] += o->next[i][l] * fvi_mechanism_increment(o, o->u, l, j);
            if (o->s > FEW)
                u[i] = o->rule->c[i] * slope;
        }
        for (size_t i = o->begin; i < o->s; i++)
            o->u[(i - o->begin) * d + j] = u[i];
    }
}

void fvi_mechanism_keep_dampers(fvi_mechanism_state *o)
{
    const size_t d = o->d, r = o->r, last = o->s - 1;
    for (size_t i = 0; i < o->s; i++)
        for (size_t e = 0; e < r; e++) {
            const double weight = o->h * o->rule->b[i], force = o->lambda[e * o->s + i];
            o->impulse[e] += weight * force;
            o->work[e] += weight * force * o->zdot[e * o->s + i];
        }
    memcpy(o->v, o->V + last * d, d * sizeof *o->v);
    memcpy(o->z, o->elongation + last * r, r * sizeof *o->z);
    memcpy(o->G, o->gradient + last * r * d, r * d * sizeof *o->G);
}

/* Compute p and x at the end of the step, and the impulses and the work of the dampers. */
static void end_step(fvi_stepper *s)
{
    fvi_mechanism_state *o = s->mechanism;
    const size_t d = o->d;
    for (size_t i = 0; i < o->s; i++)
        for (size_t j = 0; j < d; j++)
            s->p[j] += o->h * o->rule->b[i] * o->f[i * d + j];
    memcpy(s->x, o->X + (o->s - 1) * d, d * sizeof *s->x);
    fvi_mechanism_keep_dampers(o);
}

int fvi_mechanism_subtract_multipliers(const fvi_stepper *s, double *C, double *p)
{
    const fvi_mechanism_state *o = s->mechanism;
    const size_t d = o->d, m = o->m, inner = o->s - o->begin;
    const double h = o->h, *mu = o->u + inner * d;
    int status = FVI_SUCCESS;
    for (size_t i = 0; i < inner && !status; i++) {
        status = fvi_mechanism_tie_gradients(s, fvi_mechanism_stage_time(s, i), o->X + i * d, C, NULL);
        for (size_t l = 0; l < m; l++)
            for (size_t j = 0; j < d; j++)
                p[j] -= C[l * d + j] * mu[i * m + l] / h;
    }
    return status;
}

/* The impulse at the end follows from the hidden constraint. In form D the last stage has a multiplier of its own, and
 * this impulse is a correction to it. */
int fvi_mechanism_end_constraints(fvi_stepper *s)
{
    fvi_mechanism_state *o = s->mechanism;
    const size_t d = o->d, m = o->m, inner = o->s - o->begin, last = o->s - 1;
    const double h = o->h, *b = o->rule->b, *mu = o->u + inner * d, t = fvi_mechanism_stage_time(s, last);
    int status = fvi_mechanism_subtract_multipliers(s, o->C, s->p);
    for (size_t i = 0; i < inner * m; i++)
        o->tie[i % m] += mu[i] / h;
    for (size_t l = 0; l < m; l++)
        o->begun[l] = mu[l] / (h * h * b[0]);
    if (!status)
        status = fvi_mechanism_tie_gradients(s, t, o->X + last * d, o->C, NULL);
    if (!status)
        status = fvi_mechanism_project_momentum(s, t, o->X + last * d, o->C, s->p, o->v, o->ended);
    for (size_t l = 0; l < m; l++) {
        o->tie[l] += o->ended[l];
        if (o->begin == 0)
            o->ended[l] += mu[last * m + l] / h;
        o->ended[l] /= h * b[last];
    }
    return status;
}

int fvi_mechanism_solve_stages(fvi_stepper *s)
{
    fvi_mechanism_state *o = s->mechanism;
    int status = FVI_SUCCESS;
    for (size_t i = 0; i < o->s && !status; i++)
        status = fvi_mechanism_force(s, fvi_mechanism_inner_time(s, i), o->load + i * o->d);
    if (!status)
        status = fvi_mechanism_solve(s, assemble_equations, (o->s - o->begin) * o->d, o->u);
    o->has_root = 1;
    if (!status)
        status = fvi_mechanism_evaluate_stages(s, o->u);
    o->has_root = 0;
    return status;
}

//> step
int fvi_mechanism_step_stages(fvi_stepper *s)
{
    fvi_mechanism_state *o = s->mechanism;
    const size_t places = (o->s - o->begin) * o->d;
    int status = fvi_mechanism_predict_forces(s);
    if (!status && s->k > 0)
        guess_increments(s);
    if (!status)
        status = fvi_mechanism_solve_stages(s);
    if (status)
        return status;
    memcpy(s->dx, o->u + places - o->d, o->d * sizeof *s->dx);
    end_step(s);
    status = fvi_mechanism_update_histories(s, 0, o->zdot);
    return status || !o->m ? status : fvi_mechanism_end_constraints(s);
}
//< step
