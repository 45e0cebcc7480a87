/* src/adjoint_variable/adjoint_variable_solve.c -- The equation of a step of the adjoint run on a mesh. [H 23] */
#include "adjoint_variable.h"

#include "parameter_derivatives/potential_derivatives.h"

#include <math.h>
#include <string.h>

static void find_stages(fvi_adjoint_variable_run *m, size_t n, double h)
{
    const double *numbers = m->path.numbers + n * FVI_MESH_NUMBERS * m->d;
    const size_t d = m->d;
    for (size_t j = 0; j < d; j++) {
        double move[FVI_LANES];
        fvi_square_apply(m->s, m->o->to_x, numbers + 3 * d + j * FVI_LANES,
                         move);
        for (size_t i = 0; i < m->s; i++)
            m->X[i * d + j] =
                numbers[j] + h * (m->rule->c[i] * numbers[d + j] + move[i]);
        for (size_t i = 0; fvi_adjoint_variable_is_singular(m, n) && i < m->s; i++)
            m->X[i * d + j] += fvi_singular_start_adjoint_at(
                &m->singular_start, j, fvi_adjoint_variable_time(m, n, i), NULL);
    }
}

/* G Lambda at all stages. */
static void multiply_by_hessians(fvi_adjoint_variable_run *m)
{
    for (size_t i = 0; i < m->s; i++) {
        for (size_t j = 0; j < m->d; j++)
            m->column[j] = m->Lambda[j * FVI_LANES + i];
        m->linearised.stage = i;
        fvi_linearised_gradient(m->d, m->column, &m->linearised,
                                m->hessian_product + i * m->d);
    }
}

/* Add the Hessians' entry (j, l) of all stages, h^2 b_i H_i in `weight`, to the rows of coordinate j. */
static void add_entry(fvi_adjoint_variable_run *m, size_t j, size_t l, const double *weight)
{
    const size_t s = m->s;
    for (size_t c = 0; c < s; c++) {
        double *row = fvi_band_row(&m->J_band, j * s + c) + l * s;
        const double *to_x = m->o->to_x->column[c];
#pragma omp simd
        for (size_t i = 0; i < s; i++)
            row[i] += weight[i] * to_x[i];
    }
}

/* Add the Hessians to the matrix. */
static void add_hessians(fvi_adjoint_variable_run *m, double h)
{
    const fvi_linearised *of = &m->linearised;
    const size_t d = m->d, w = of->diagonals;
    for (size_t j = 0; m->G && j < d; j++)
        for (size_t k = 0; k < (w ? w : d) && (w ? j + k : k) < d; k++) {
            double weight[FVI_LANES];
            for (size_t i = 0; i < m->s; i++)
                weight[i] = h * h * m->rule->b[i] * m->G[i * of->size + j * (w ? w : d) + k];
            add_entry(m, j, w ? j + k : k, weight);
            if (w && k > 0)
                add_entry(m, j + k, j, weight);
        }
}

/* Factorise the transpose of the matrix of the step: row c is the derivative by V_c. */
static int factorise(fvi_adjoint_variable_run *m, double h)
{
    const size_t s = m->s;
    const double unit = pow(h, 1 - m->o->beta), *b = m->rule->b;
    fvi_band_clear(&m->J_band);
    for (size_t j = 0; j < m->d; j++) {
        const double mass = fvi_adjoint_variable_mass(m, j),
                     rho = fvi_adjoint_variable_damping(m, j) * unit;
        for (size_t c = 0; c < s; c++) {
            double *row = fvi_band_row(&m->J_band, j * s + c) + j * s;
            const double *inverse = m->rule->inverse.column[c], *W0 = m->o->W0.column[c];
#pragma omp simd
            for (size_t i = 0; i < s; i++)
                row[i] = b[i] * (mass * inverse[i] + rho * W0[i]);
        }
    }
    add_hessians(m, h);
    return fvi_band_factorise(&m->J_band);
}

/* Write T without W0 mu: the history. (22.6), (22.7) */
static void evaluate_history(fvi_adjoint_variable_run *m, double h)
{
    const double now = pow(h, -m->o->beta);
    for (size_t j = 0; m->has_history && j < m->d; j++) {
        double *T = m->T + j * FVI_LANES, rising[FVI_LANES] = { 0 };
        memset(T, 0, FVI_LANES * sizeof *T);
        if (m->o->modes)
            fvi_modes_history(m->o->modes, j, T);
        if (m->o->rising)
            fvi_modes_history(m->o->rising, j, rising);
        for (size_t i = 0; (m->o->beta > 0 || m->o->rising) && i < m->s; i++)
            T[i] += rising[i] - now * m->W_1[i] * m->before[j];
    }
}

//> mesh
/* Solve (23.16) for Lambda of a step of length h. In both forms to_x 1 = c, and the last row of to_x is b, so
 * x_{n+1} = x_n + h b.V. */
static int solve(fvi_adjoint_variable_run *m, double h)
{
    const size_t s = m->s;
    const double *b = m->rule->b;
    int status = factorise(m, h);
    if (status)
        return status;
    for (size_t j = 0; j < m->d; j++)
        for (size_t c = 0; c < s; c++) {
            const double history = m->T[j * FVI_LANES + s - 1 - c];
            m->r[j * s + c] =
                m->source[j * FVI_LANES + c] + h * b[c] * m->xi[j]
                - h * fvi_adjoint_variable_damping(m, j) * b[c] * history;
            if (c == s - 1)
                m->r[j * s + c] += m->after[j];
        }
    fvi_band_solve(&m->J_band, m->r);
    for (size_t j = 0; j < m->d; j++)
        for (size_t i = 0; i < s; i++) {
            m->Lambda[j * FVI_LANES + i] = m->r[j * s + i];
            m->mu[j * FVI_LANES + s - 1 - i] = m->r[j * s + i];
        }
    multiply_by_hessians(m);
    return FVI_SUCCESS;
}
//< mesh

/* Compute W0 of a law for a step of length h. The modes of the terms that grow faster than s contain the answer to a
 * constant velocity, and the other modes do not. */
static void begin_kernel(fvi_adjoint_variable_run *m, double h)
{
    const double ones[FVI_LANES] = { 1, 1, 1, 1, 1, 1, 1, 1 };
    fvi_variable_step_present_kernel(m->rule, m->o->kernel, h, m->o->beta, &m->o->W0, m->o->W1);
    fvi_square_apply(m->s, &m->o->W0, ones, m->W_1);
    for (size_t i = 0; i < m->s; i++)
        m->W_1[i] -= m->o->W1[i];
}

int fvi_adjoint_variable_solve(fvi_adjoint_variable_run *m, size_t n)
{
    const fvi_length length = m->path.step[n].length;
    find_stages(m, n, length.h);
    const int status = fvi_potential_evaluate_hessians(m->run->system, m->s, m->X,
                                                       m->linearised.size, m->G);
    if (m->o->kernel)
        begin_kernel(m, length.h);
    if (m->o->modes)
        fvi_modes_begin(m->o->modes, length);
    if (m->o->rising)
        fvi_modes_begin(m->o->rising, length);
    evaluate_history(m, length.h);
    return status ? status : solve(m, length.h);
}
