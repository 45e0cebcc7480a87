/* src/inverse/mirror_step.c -- A step of the run that goes backwards.   [Chapter 23] */
#include "mirror.h"

#include "system/fail.h"

#include <string.h>

/* ---- the memory ---- */

/* z_j, on which the memory of the run acts. */
static double term(const fvi_mirror *m, size_t j, double x, size_t i)
{
    return x - m->origin[i] - (double)j * m->drift[i];
}

/* `now` enters a ring of last terms; returns sum_n f[n] of them. */
static double ring(size_t taps, const double *f, double *past, double now)
{
    double sum = 0;
    memmove(past + 1, past, (taps - 1) * sizeof *past);
    past[0] = now;
    for (size_t n = 0; n < taps; n++)
        sum += f[n] * past[n];
    return sum;
}

/* Sums by the weights of (1 - z)^beta become those by the weights with the factor: N by
 * g, and its derivative by g and gdot. */
static void filter(fvi_mirror *m)
{
    for (size_t i = 0; i < m->d; i++) {
        double *N = m->sums + i * m->taps;
        m->N[i] = ring(m->taps, m->g, N, m->N[i]);
        if (!m->want->alpha)
            continue;
        m->Ndot[i] = ring(m->taps, m->g, m->rates + i * m->taps, m->Ndot[i]);
        for (size_t n = 0; n < m->taps; n++)
            m->Ndot[i] += m->gdot[n] * N[n];
    }
}

/* N of the next node if nu stays what it is; then it is times g_0 more for dnu. */
static int look_ahead(fvi_mirror *m)
{
    int status = fvi_memory_ahead(m->memory, m->nu, m->N);
    for (size_t i = 0; m->taps && i < m->d; i++) {
        m->N[i] *= m->g[0];
        for (size_t n = 1; n < m->taps; n++)
            m->N[i] += m->g[n] * m->sums[i * m->taps + n - 1];
    }
    return status;
}

/* What each term of the law, alone, gives to its derivative. */
static int remember_terms(fvi_mirror *m, size_t j, const double *x)
{
    int status = FVI_SUCCESS;
    for (size_t l = 0; !status && l < m->terms; l++) {
        status = fvi_memory_push(m->each[l], m->nu, m->dnu, m->work);
        for (size_t i = 0; i < m->d; i++)
            m->want->terms[l] -= m->run->h * m->first[l]
                                 * m->run->system->damping[i]
                                 * term(m, j, x[i], i) * m->work[i];
    }
    return status;
}

/* (23.7): nu_j is there; N_j, and what it gives to the sums. x: x_j. */
static int remember(fvi_mirror *m, size_t j, const double *x)
{
    int status =
        m->want->alpha
            ? fvi_memory_push_rate(m->memory, m->nu, m->dnu, m->N, m->Ndot)
            : fvi_memory_push(m->memory, m->nu, m->dnu, m->N);
    if (m->taps > 0)
        filter(m);
    for (size_t i = 0; i < m->d; i++) {
        const double z = term(m, j, x[i], i);
        m->sum[i] += z * m->N[i];
        m->rate[i] += z * m->Ndot[i];
        m->plain[i] += j > 0 ? m->N[i] : 0;
        m->linear[i] += (double)j * m->N[i];
    }
    return status ? status : remember_terms(m, j, x);
}

/* d nu_j / d theta = lambda_{j-1} - lambda_j, at node N lambda_{N-1}: its memory, which
 * by theta takes the place of that of nu. */
static int remember_slope(fvi_mirror *m, size_t j, const double *x)
{
    const int at_end = j == m->run->steps;
    for (size_t i = 0; i < m->d; i++) {
        const double now = m->delta[i] + (at_end ? m->lambda[i] : 0);
        m->work[i] = now - m->before[i];
        m->before[i] = now;
    }
    int status = fvi_memory_push(m->slope, m->before, m->work, m->N);
    for (size_t i = 0; i < m->d; i++)
        m->shift[i] += term(m, j, x[i], i) * m->N[i];
    return status;
}

/* ---- the equation of a step ---- */

/* out = H v for a Hessian as the potential writes it. */
static void apply(const fvi_mirror *m, const double *v, double *out)
{
    const size_t d = m->d, w = m->run->system->potential.diagonals;
    const double *row = m->G;
    if (m->G && w == 1) { /* the usual case, at a third of the time */
        for (size_t i = 0; i < d; i++)
            out[i] = row[i] * v[i];
        return;
    }
    memset(out, 0, d * sizeof *out);
    for (size_t i = 0; m->G && i < d; i++, row += w ? w : d)
        for (size_t j = 0; j < (w ? w : d); j++) {
            const size_t k = w ? i + j : j;
            if (k >= d)
                break;
            out[i] += row[j] * v[k];
            if (w && j > 0)
                out[k] += row[j] * v[i];
        }
}

/* J = m/h + theta c + kappa (1 - kappa) h G, factorised. */
static int factorise(fvi_mirror *m)
{
    const fvi_run *run = m->run;
    const double share = m->kappa * (1 - m->kappa) * run->h;
    const size_t d = m->d, w = run->system->potential.diagonals;
    fvi_band_clear(&m->J);
    for (size_t i = 0; i < d; i++)
        fvi_band_row(&m->J, i)[i] = m->inertia[i];
    for (size_t i = 0; i < d; i++)
        for (size_t j = 0; j < (w ? w : d) && (w ? i + j : j) < d; j++) {
            const double value = share * m->G[i * (w ? w : d) + j];
            fvi_band_row(&m->J, i)[w ? i + j : j] += value;
            if (w && j > 0)
                fvi_band_row(&m->J, i + j)[i] += value;
        }
    return fvi_band_factorise(&m->J);
}

/* G and J at S = kappa x_k + (1 - kappa) x_{k+1}. */
static int look(fvi_mirror *m, const double *rows)
{
    const fvi_run *run = m->run;
    const fvi_potential *u = &run->system->potential;
    const size_t d = m->d;
    for (size_t i = 0; i < d; i++)
        m->S[i] = rows[i] + (1 - m->kappa) * (rows[d + i] - rows[i]);
    if (!m->G || m->is_ready)
        return FVI_SUCCESS;
    m->is_ready = u->quadratic && u->quadratic(u->params);
    int status = u->hessian(d, m->S, u->params, m->G);
    return status || u->diagonals == 1 ? status : factorise(m);
}

/* delta, from J delta = r - (1 - kappa) h G lambda; r is in delta. */
static int solve(fvi_mirror *m)
{
    const fvi_run *run = m->run;
    const double h = run->h, kappa = m->kappa;
    apply(m, m->lambda, m->work);
    for (size_t i = 0; i < m->d; i++)
        m->delta[i] -= (1 - kappa) * h * m->work[i];
    if (m->J.block) {
        fvi_band_solve(&m->J, m->delta);
        return FVI_SUCCESS;
    }
    for (size_t i = 0; i < m->d; i++) {
        const double J =
            m->inertia[i] + kappa * (1 - kappa) * h * (m->G ? m->G[i] : 0);
        if (J == 0)
            return FVI_ESING;
        m->delta[i] /= J;
    }
    return FVI_SUCCESS;
}

/* ---- a step ---- */

/* What the force and the past gave to the two ends of step k, lambda_{k+1} and
 * lambda_k being there. */
static void drive(fvi_mirror *m, size_t k)
{
    const double h = m->run->h;
    const size_t d = m->d;
    double at[2] = { 0 }, slope[2] = { 0 }, *force = m->want->force;
    for (size_t i = 0; force && i < d; i++) {
        const double left = m->lambda[i] + m->delta[i], right = m->lambda[i];
        force[(k + 1) * d + i] += m->printed ? h * right : h / 2 * right;
        force[k * d + i] += m->printed ? 0 : h / 2 * left;
    }
    if (!m->is_pulled)
        return;
    static const double ends[] = { 0, 1 };
    fvi_past_impulses(&m->fading, k, at);
    if (m->want->alpha)
        fvi_past_impulses_rate(&m->fading, ends, k, slope);
    for (size_t i = 0; i < d; i++) {
        const double left = m->lambda[i] + m->delta[i], right = m->lambda[i];
        m->pull[i] += at[0] * left + at[1] * right;
        m->pulldot[i] += slope[0] * left + slope[1] * right;
    }
}

/* M_k = kappa lambda_k + (1 - kappa) lambda_{k+1}, and what it meets. */
static int meet(fvi_mirror *m, const double *rows)
{
    const fvi_sensitivity *s = &m->want->sensitivity;
    const double h = m->run->h;
    const size_t d = m->d;
    for (size_t i = 0; i < d; i++) {
        m->M[i] = m->lambda[i] + m->kappa * m->delta[i];
        m->kinetic[i] -= (rows[d + i] - rows[i]) * m->delta[i];
    }
    apply(m, m->M, m->work);
    for (size_t i = 0; i < d; i++)
        m->q[i] -= h * m->work[i];
    int status = FVI_SUCCESS;
    for (size_t j = 0; m->want->parameters && !status && j < s->count; j++) {
        status =
            s->column(j, d, m->S, m->run->system->potential.params, m->column);
        for (size_t i = 0; i < d; i++)
            m->want->parameters[j] -= h * m->column[i] * m->M[i];
    }
    return status;
}

/* The right-hand side, q - c N_{k+1}, into delta; of N only what is known before lambda_k
 * is, if theta > 0. */
static int right_hand_side(fvi_mirror *m, size_t k, const double *x)
{
    const double last = k + 1 == m->run->steps ? m->end + m->theta : 1;
    int status = FVI_SUCCESS;
    for (size_t i = 0; i < m->d; i++)
        m->delta[i] = m->q[i];
    if (!m->memory)
        return status;
    if (m->theta > 0)
        status = look_ahead(m);
    for (size_t i = 0; i < m->d; i++) {
        m->dnu[i] = last * m->lambda[i] - m->nu[i];
        m->nu[i] += m->dnu[i];
    }
    if (!status && m->theta == 0)
        status = remember(m, k + 1, x);
    const double now = m->theta > 0 ? m->taps ? m->g[0] : 1 : 0;
    for (size_t i = 0; i < m->d; i++)
        m->delta[i] -= m->c[i] * (m->N[i] + now * m->dnu[i]);
    return status;
}

//> step
int fvi_mirror_step(fvi_mirror *m, size_t k, const double *rows,
                    const double *Jx)
{
    const double *x = rows + m->d; /* x_{k+1} */
    for (size_t i = 0; i < m->d; i++)
        m->q[i] += Jx[i];
    int status = look(m, rows);
    if (!status)
        status = right_hand_side(m, k, x);
    if (!status)
        status = solve(m);
    if (!status && m->memory && m->theta > 0) {
        for (size_t i = 0; i < m->d; i++) {
            m->nu[i] += m->theta * m->delta[i];
            m->dnu[i] += m->theta * m->delta[i];
        }
        status = remember(m, k + 1, x);
    }
    if (status)
        return status;
    for (size_t i = 0; m->memory && i < m->d; i++)
        m->q[i] -= m->c[i] * m->N[i];
    drive(m, k);
    status = meet(m, rows);
    if (!status && m->slope)
        status = remember_slope(m, k + 1, x);
    for (size_t i = 0; i < m->d; i++)
        m->lambda[i] += m->delta[i]; /* lambda_k */
    return status;
}
//< step

int fvi_mirror_last(fvi_mirror *m)
{
    for (size_t i = 0; i < m->d; i++) {
        m->dnu[i] = -m->nu[i];
        m->nu[i] = 0;
    }
    return remember(m, 0, m->run->x0);
}
