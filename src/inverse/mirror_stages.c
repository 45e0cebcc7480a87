/* src/inverse/mirror_stages.c -- The run that goes backwards through stages.
 *                                                                     [Chapter 23] */
#include "mirror_stages.h"

#include "methods/lobatto_stages.h"
#include "system/fail.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- the start ---- */

static int allocate(fvi_mirror_stages *m)
{
    const size_t s = m->s, d = m->d;
    const fvi_system *system = m->run->system;
    const size_t hessian =
        system->potential.hessian ? fvi_hessian_room(system) : 0;
    m->block = calloc(3 * s * d + s * hessian + (6 + s) * d, sizeof *m->block);
    if (!m->block)
        FVI_FAIL("no memory for the mirrored run", FVI_ENOMEM);
    m->Lambda = m->block;
    m->T = m->Lambda + s * d;
    m->past = m->T + s * d;
    m->column = m->past + s * d;
    m->Q = m->column + d;
    m->kinetic = m->Q + d;
    m->sum = m->kinetic + d;
    m->plain = m->sum + d;
    m->pull = m->plain + d;
    m->r = m->pull + d;
    m->G = hessian ? m->r + s * d : NULL;
    const size_t w =
        system->potential.diagonals ? system->potential.diagonals : d;
    if (fvi_band_alloc((s - 1) * d, (s - 1) * w, &m->J))
        FVI_FAIL("no memory for the mirrored run", FVI_ENOMEM);
    return FVI_SUCCESS;
}

static void start_matrices(fvi_mirror_stages *m)
{
    const fvi_lobatto_rule *r = m->rule;
    for (size_t i = 0; i < m->s; i++)
        for (size_t j = 0; j < m->s; j++) {
            for (size_t l = 0; l < m->s; l++)
                m->K[i][j] += r->D[l][i] * r->b[l] * r->D[l][j];
            m->E[i][j] = r->D[m->s - 1 - j][i] * r->b[m->s - 1 - j];
        }
}

static int start_memory(fvi_mirror_stages *m)
{
    const fvi_run *run = m->run;
    const double beta = 2 * run->alpha - 1;
    m->is_damped = m->want->damping != NULL;
    for (size_t i = 0; i < m->d; i++)
        m->is_damped |= run->system->damping[i] > 0;
    m->unit = pow(run->h, -beta);
    for (size_t i = 0; i < m->s; i++)
        m->W[i][i] = 1; /* beta = 0 */
    if (!m->is_damped || beta == 0)
        return FVI_SUCCESS;
    int status =
        fvi_lobatto_memory_alloc(m->s, beta, m->d, run->steps, run->memory,
                                 fvi_lobatto_finer(run), &m->memory);
    for (size_t i = 0; !status && i < m->s; i++)
        memcpy(m->W[i], fvi_lobatto_memory_now(m->memory) + i * m->s,
               m->s * sizeof(double));
    return status;
}

int fvi_mirror_stages_start(size_t stages, const fvi_run *run,
                            const fvi_gradients *want, const double *Jp,
                            fvi_mirror_stages *m)
{
    *m = (fvi_mirror_stages){ .run = run,
                              .want = want,
                              .rule = fvi_lobatto(stages),
                              .s = stages,
                              .d = run->system->d };
    int status = allocate(m);
    if (!status)
        status = start_memory(m);
    if (status)
        return status;
    start_matrices(m);
    for (size_t j = 0; j < m->d; j++)
        m->Lambda[j * m->s] = Jp[j]; /* lambda_N, as the first of a step N */
    m->is_pulled = m->is_damped && run->alpha != 0.5
                   && (run->past == FVI_PAST_RIEMANN_LIOUVILLE
                       || (run->past == FVI_PAST_HELD && run->alpha > 0.5));
    if (m->is_pulled)
        fvi_past_prepare(run->alpha, m->s, m->rule->c, &m->fading);
    return FVI_SUCCESS;
}

void fvi_mirror_stages_stop(fvi_mirror_stages *m)
{
    fvi_lobatto_memory_free(m->memory);
    fvi_band_free(&m->J);
    free(m->block);
}

/* ---- the equation of a step ---- */

/* Entry (i, j) of the Hessian at a stage. */
static double hessian(const fvi_mirror_stages *m, size_t stage, size_t i,
                      size_t j)
{
    const size_t w = m->run->system->potential.diagonals;
    const double *G = m->G + stage * fvi_hessian_room(m->run->system);
    if (!w)
        return G[i * m->d + j];
    const size_t low = i < j ? i : j, high = i < j ? j : i;
    return high - low < w ? G[low * w + high - low] : 0;
}

/* Of coordinate j what multiplies Lambda_l in row i of (23.13), but for U. */
static double linear(const fvi_mirror_stages *m, size_t j, size_t i, size_t l)
{
    const fvi_system *system = m->run->system;
    double memory = 0; /* D^T B P W_0 P */
    for (size_t c = 0; c < m->s; c++)
        memory += m->E[i][c] * m->W[c][m->s - 1 - l];
    return system->mass[j] / m->run->h * m->K[i][l]
           - system->damping[j] * m->unit * memory;
}

/* The neighbours in the Hessian of coordinate j: from low to below high. */
static void reach(const fvi_mirror_stages *m, size_t j, size_t *low,
                  size_t *high)
{
    const size_t w = m->run->system->potential.diagonals;
    *low = w && j + 1 > w ? j + 1 - w : 0;
    *high = w && j + w < m->d ? j + w : m->d;
}

/* h b_i (G Lambda_i) of coordinate j */
static double bent(const fvi_mirror_stages *m, size_t j, size_t i)
{
    size_t low, high;
    double sum = 0;
    if (!m->G)
        return 0;
    reach(m, j, &low, &high);
    for (size_t l = low; l < high; l++)
        sum += hessian(m, i, j, l) * m->Lambda[l * m->s + i];
    return m->run->h * m->rule->b[i] * sum;
}

/* Rows 2, ..., s of (23.13) for Lambda_1, ..., Lambda_{s-1}. */
static int factorise(fvi_mirror_stages *m)
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
                reach(m, j, &low, &high);
            for (size_t l = low; l < high; l++)
                row[l * n + i] -=
                    m->run->h * m->rule->b[i] * hessian(m, i, j, l);
        }
    return fvi_band_factorise(&m->J);
}

/* What is known of row i: the history, and Lambda_s. */
static double known(const fvi_mirror_stages *m, size_t j, size_t i)
{
    double sum = 0;
    for (size_t c = 0; c < m->s; c++)
        sum += m->E[i][c] * m->past[j * m->s + c];
    return -m->run->system->damping[j] * m->unit * sum
           + linear(m, j, i, m->s - 1) * m->Lambda[j * m->s + m->s - 1];
}

//> stages
static int solve(fvi_mirror_stages *m)
{
    const size_t s = m->s, n = s - 1;
    int status = factorise(m);
    if (status)
        return status;
    for (size_t j = 0; j < m->d; j++) {
        for (size_t i = 1; i < n; i++)
            m->r[j * n + i - 1] = -known(m, j, i);
        m->r[j * n + n - 1] = -m->Q[j] - known(m, j, n) + bent(m, j, n);
    }
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

/* ---- a step ---- */

static int look(fvi_mirror_stages *m, const double *rows)
{
    const fvi_potential *u = &m->run->system->potential;
    const size_t room = fvi_hessian_room(m->run->system);
    int status = FVI_SUCCESS;
    for (size_t i = 0; m->G && !status && i < m->s; i++)
        status = u->hessian(m->d, rows + i * m->d, u->params, m->G + i * room);
    return status;
}

/* T = W_0 P Lambda + what was known, and what it and Lambda meet. */
static void meet(fvi_mirror_stages *m, const double *rows)
{
    const size_t s = m->s, d = m->d;
    const double h = m->run->h;
    for (size_t j = 0; j < d; j++) {
        const double *Lambda = m->Lambda + j * s;
        const double v0 =
            m->run->alpha > 0.5 ? m->run->p0[j] / m->run->system->mass[j] : 0;
        for (size_t i = 0; i < s; i++) {
            double T = m->past[j * s + i], v = 0, KX = 0;
            for (size_t l = 0; l < s; l++) {
                T += m->W[i][l] * Lambda[s - 1 - l];
                v += m->rule->D[s - 1 - i][l] * rows[l * d + j] / h;
                KX += m->K[i][l] * (rows[l * d + j] - rows[j]);
            }
            m->sum[j] += m->rule->b[i] * (v - v0) * T;
            m->plain[j] += m->rule->b[i] * T;
            m->kinetic[j] += Lambda[i] * KX;
        }
    }
}

static int drive(fvi_mirror_stages *m, size_t k, const double *rows)
{
    const fvi_sensitivity *by = &m->want->sensitivity;
    const size_t s = m->s, d = m->d;
    double at[FVI_STAGES] = { 0 };
    int status = FVI_SUCCESS;
    if (m->is_pulled)
        fvi_past_impulses(&m->fading, k, at);
    for (size_t i = 0; i < s; i++) {
        const double unit = m->run->h * m->rule->b[i];
        for (size_t j = 0; j < d; j++) {
            if (m->want->force)
                m->want->force[(k * (s - 1) + i) * d + j] +=
                    unit * m->Lambda[j * s + i];
            m->pull[j] += at[i] * m->Lambda[j * s + i];
        }
        for (size_t p = 0; m->want->parameters && !status && p < by->count;
             p++) {
            status = by->column(p, d, rows + i * d,
                                m->run->system->potential.params, m->column);
            for (size_t j = 0; j < d; j++)
                m->want->parameters[p] -=
                    unit * m->column[j] * m->Lambda[j * s + i];
        }
    }
    return status;
}

/* P Lambda goes into the memory, and out comes what is known of the next T. */
static int remember(fvi_mirror_stages *m)
{
    if (!m->memory)
        return FVI_SUCCESS;
    for (size_t j = 0; j < m->d; j++)
        for (size_t i = 0; i < m->s; i++)
            m->T[j * m->s + i] = m->Lambda[j * m->s + m->s - 1 - i];
    return fvi_lobatto_memory_push(m->memory, m->T, m->past);
}

int fvi_mirror_stages_step(fvi_mirror_stages *m, size_t k, const double *rows,
                           const double *Jx)
{
    for (size_t j = 0; j < m->d; j++) {
        m->Q[j] += Jx[j];
        m->Lambda[j * m->s + m->s - 1] = m->Lambda[j * m->s]; /* lambda_{k+1} */
    }
    int status = look(m, rows);
    if (!status)
        status = solve(m);
    if (!status)
        status = drive(m, k, rows);
    if (status)
        return status;
    if (m->is_damped || m->want->mass)
        meet(m, rows);
    return remember(m);
}

/* ---- the end ---- */

int fvi_mirror_stages_end(fvi_mirror_stages *m, const double *Jx)
{
    const fvi_run *run = m->run;
    const fvi_gradients *want = m->want;
    for (size_t j = 0; j < m->d; j++) {
        const double rho = run->system->damping[j], mass = run->system->mass[j],
                     v0 = run->p0[j] / mass;
        const double pulled = m->is_pulled ? pow(run->h, 1 + m->fading.e) : 0;
        const double by_A = -rho * pulled * m->pull[j];
        const int above = run->alpha > 0.5;
        const double by_v0 =
            above ? by_A + run->h * rho * m->unit * m->plain[j] : 0;
        const double A =
            fvi_past_amplitude(run->past, run->alpha, run->x0[j], v0);
        m->Q[j] += Jx[j];
        if (want->x0)
            want->x0[j] = m->Q[j] + (above ? 0 : by_A);
        if (want->x0 && above && rho > 0
            && run->past == FVI_PAST_RIEMANN_LIOUVILLE)
            want->x0[j] = NAN; /* (19.2) */
        if (want->p0)
            want->p0[j] = m->Lambda[j * m->s] + by_v0 / mass;
        if (want->mass)
            want->mass[j] = m->kinetic[j] / run->h - by_v0 * v0 / mass;
        if (want->damping)
            want->damping[j] =
                -run->h * m->unit * m->sum[j] - A * pulled * m->pull[j];
    }
    return fvi_all_finite(m->d, m->Q) ? FVI_SUCCESS : FVI_EOVRFLW;
}
