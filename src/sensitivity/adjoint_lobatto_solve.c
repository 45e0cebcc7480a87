/* src/sensitivity/adjoint_lobatto_solve.c -- A step backwards through stages. [H 23] */
#include "adjoint_lobatto.h"

#include "hessian_band.h"
#include "methods/lobatto_stages.h"
#include "system/fail.h"

#include <string.h>

void fvi_adjoint_lobatto_matrices(fvi_adjoint_lobatto *m)
{
    const fvi_lobatto_rule *r = m->rule;
    const size_t s = m->s;
    if (m->damped_inertia)
        fvi_lobatto_table(r, s, m->E);
    for (size_t i = 0; i < s; i++)
        for (size_t j = 0; j < s; j++) {
            if (!m->damped_inertia)
                m->E[i][j] = r->D[s - 1 - j][i] * r->b[s - 1 - j];
            for (size_t l = 0; l < s; l++)
                m->K[i][j] += m->damped_inertia
                                  ? m->E[i][l] * m->E[l][j]
                                  : r->D[l][i] * r->b[l] * r->D[l][j];
        }
}

/* ---- the Hessians ---- */

/* Entry (j, l) of the Hessian at a stage. */
static double hessian(const fvi_adjoint_lobatto *m, size_t stage, size_t j,
                      size_t l)
{
    const fvi_system *system = m->run->system;
    return fvi_hessian_entry(system, m->G + stage * fvi_potential_hessian_size(system), j,
                             l);
}

/* h b_i (G Lambda_i) of coordinate j */
static double bent(const fvi_adjoint_lobatto *m, size_t j, size_t i)
{
    size_t low, high;
    double sum = 0;
    if (!m->G)
        return 0;
    fvi_hessian_reach(m->run->system, j, &low, &high);
    for (size_t l = low; l < high; l++)
        sum += hessian(m, i, j, l) * m->Lambda[l * m->s + i];
    return m->run->h * m->rule->b[i] * sum;
}

/* sum_c E_ic of row c of a matrix, or of past. */
static double gathered(const fvi_adjoint_lobatto *m, size_t i, const double *of,
                       size_t stride)
{
    double sum = 0;
    for (size_t c = 0; c < m->s; c++)
        sum += m->E[i][c] * of[c * stride];
    return sum;
}

/* rho h^(-beta) of coordinate j; at alpha = 1 in form M it stands in the mass. */
static double damping(const fvi_adjoint_lobatto *m, size_t j)
{
    return m->mass_plus_damping ? 0 : m->run->system->damping[j] * m->unit;
}

/* ---- form M ---- */

/* Of coordinate j what multiplies Lambda_l in row i of (23.13), but for U. */
static double linear(const fvi_adjoint_lobatto *m, size_t j, size_t i, size_t l)
{
    return m->mass[j] / m->run->h * m->K[i][l]
           - damping(m, j) * gathered(m, i, &m->W[0][m->s - 1 - l], FVI_STAGES);
}

/* Rows 2, ..., s of (23.13) for Lambda_1, ..., Lambda_{s-1}. */
static int factorise(fvi_adjoint_lobatto *m)
{
    const size_t n = m->s - 1;
    fvi_band_clear(&m->J);
    for (size_t j = 0; j < m->d; j++)
        for (size_t i = 1; i <= n; i++) {
            double *row = fvi_band_row(&m->J, j * n + i - 1);
            for (size_t l = 0; l < n; l++)
                row[j * n + l] = linear(m, j, i, l);
            size_t low = 0, high = 0;
            if (m->G && i < n)
                fvi_hessian_reach(m->run->system, j, &low, &high);
            for (size_t l = low; l < high; l++)
                row[l * n + i] -=
                    m->run->h * m->rule->b[i] * hessian(m, i, j, l);
        }
    return fvi_band_factorise(&m->J);
}

/* What is known of row i: the history, and Lambda_s. */
static double known(const fvi_adjoint_lobatto *m, size_t j, size_t i)
{
    return linear(m, j, i, m->s - 1) * m->after[j]
           - damping(m, j) * gathered(m, i, m->past + j * m->s, 1);
}

//> stages
static int solve(fvi_adjoint_lobatto *m)
{
    const size_t s = m->s, n = s - 1;
    int status = factorise(m);
    if (status)
        return status;
    for (size_t j = 0; j < m->d; j++) {
        m->Lambda[j * s + n] = m->after[j];
        for (size_t i = 1; i <= n; i++)
            m->r[j * n + i - 1] = -known(m, j, i);
    }
    for (size_t j = 0; j < m->d; j++)
        m->r[j * n + n - 1] += bent(m, j, n) - m->Q[j];
    fvi_band_solve(&m->J, m->r);
    for (size_t j = 0; j < m->d; j++)
        memcpy(m->Lambda + j * s, m->r + j * n, n * sizeof *m->r);
    for (size_t j = 0; j < m->d; j++) { /* row 1 of (23.13) */
        m->Q[j] = known(m, j, 0) - bent(m, j, 0);
        for (size_t l = 0; l < n; l++)
            m->Q[j] += linear(m, j, 0, l) * m->Lambda[j * s + l];
    }
    return FVI_SUCCESS;
}
//< stages

/* ---- form D ---- */

/* A times (23.15), for the stages in reverse order. */
static int factorise_damped(fvi_adjoint_lobatto *m)
{
    const size_t s = m->s;
    const double h = m->run->h;
    fvi_band_clear(&m->J);
    for (size_t j = 0; j < m->d; j++)
        for (size_t i = 0; i < s; i++) {
            double *row = fvi_band_row(&m->J, j * s + i);
            for (size_t l = 0; l < s; l++)
                row[j * s + l] =
                    h * damping(m, j) * gathered(m, i, &m->W[0][l], FVI_STAGES);
            row[j * s + i] += m->mass[j];
            size_t low = 0, high = 0;
            if (m->G)
                fvi_hessian_reach(m->run->system, j, &low, &high);
            for (size_t n = low; n < high; n++)
                for (size_t l = 0; l < s; l++)
                    row[n * s + l] +=
                        h * h * m->K[i][l] * hessian(m, s - 1 - l, j, n);
        }
    return fvi_band_factorise(&m->J);
}

//> damped
static int solve_damped(fvi_adjoint_lobatto *m)
{
    const size_t s = m->s;
    const double h = m->run->h;
    int status = factorise_damped(m);
    if (status)
        return status;
    for (size_t j = 0; j < m->d; j++)
        for (size_t i = 0; i < s; i++)
            m->r[j * s + i] =
                m->mass[j] * m->after[j] + h * m->rule->c[i] * m->Q[j]
                - h * damping(m, j) * gathered(m, i, m->past + j * s, 1);
    fvi_band_solve(&m->J, m->r);
    for (size_t j = 0; j < m->d; j++)
        for (size_t i = 0; i < s; i++)
            m->Lambda[j * s + i] = m->r[j * s + s - 1 - i];
    for (size_t j = 0; j < m->d; j++)
        for (size_t i = 0; i < s; i++)
            m->Q[j] -= bent(m, j, i);
    return FVI_SUCCESS;
}
//< damped

int fvi_adjoint_lobatto_solve(fvi_adjoint_lobatto *m)
{
    return m->damped_inertia ? solve_damped(m) : solve(m);
}
