/* src/sensitivity/adjoint_multistep_step.c -- A step of the run that goes backwards.   [H 23] */
#include "adjoint_multistep.h"

#include "system/fail.h"

#include <string.h>

/* ---- the memory ---- */

/* z_j, on which the memory of the run acts. */
static double term(const fvi_adjoint_multistep *m, double j, double x, size_t i)
{
    return x - m->origin[i] - j * m->drift[i];
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
static void filter(fvi_adjoint_multistep *m)
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
static int look_ahead(fvi_adjoint_multistep *m)
{
    int status = fvi_history_ahead(m->memory, m->nu, m->N);
    for (size_t i = 0; m->taps && i < m->d; i++) {
        m->N[i] *= m->g[0];
        for (size_t n = 1; n < m->taps; n++)
            m->N[i] += m->g[n] * m->sums[i * m->taps + n - 1];
    }
    return status;
}

/* z_j, times the factor: what of it the weights without that one meet. z_0 is 0. */
static double filtered_elongation(const fvi_adjoint_multistep *m, size_t j, const double *x, size_t i)
{
    const double number = (double)j, z = term(m, number, x[i], i);
    if (m->taps == 0 || j == 0)
        return z;
    const double *before = x - m->d; /* rows k and k + 1 stand together */
    return m->g[0] * z + m->g[1] * term(m, number - 1, before[i], i);
}

/* What each term of the law, alone, gives to its derivatives. */
static int update_history_of_terms(fvi_adjoint_multistep *m, size_t j, const double *x)
{
    int status = FVI_SUCCESS;
    for (size_t i = 0; m->terms && i < m->d; i++)
        m->work[i] = m->run->h * m->run->system->damping[i] * filtered_elongation(m, j, x, i);
    for (size_t l = 0; !status && l < m->terms; l++)
        status = fvi_adjoint_term_accumulate(&m->each[l], m->nu, m->dnu, m->work,
                                      m->want, l);
    return status;
}

/* N_j, and its derivative if it is wanted; nu_j is there. */
static int push(fvi_adjoint_multistep *m)
{
    return m->want->alpha
               ? fvi_history_push_by_order(m->memory, m->nu, m->dnu, m->N, m->Ndot)
               : fvi_history_push(m->memory, m->nu, m->dnu, m->N);
}

/* (23.7): nu_j is there; N_j, and what it gives to the sums and, but for N_0, to q.
 * x: x_j. */
static int update_history(fvi_adjoint_multistep *m, size_t j, const double *x)
{
    int status = push(m);
    const double number = (double)j;
    if (m->taps > 0)
        filter(m);
    for (size_t i = 0; i < m->d; i++) {
        const double z = term(m, number, x[i], i), N = m->N[i];
        m->sum[i] += z * N;
        m->rate[i] += z * m->Ndot[i];
        if (j == 0)
            continue;
        m->plain[i] += N;
        m->linear[i] += number * N;
        m->q[i] -= m->c[i] * N;
    }
    return status ? status : update_history_of_terms(m, j, x);
}

/* With a shift: r = q - c N into delta, with the N that look_ahead gave. */
static void guess(fvi_adjoint_multistep *m)
{
    const double now = m->taps ? m->g[0] : 1;
    for (size_t i = 0; i < m->d; i++)
        m->delta[i] = m->q[i] - m->c[i] * (m->N[i] + now * m->dnu[i]);
}

/* With a shift, delta being there: the rest of nu_j, then as above. */
static int update_history_shifted(fvi_adjoint_multistep *m, size_t j, const double *x)
{
    for (size_t i = 0; i < m->d; i++) {
        m->nu[i] += m->theta * m->delta[i];
        m->dnu[i] += m->theta * m->delta[i];
    }
    return update_history(m, j, x);
}

/* d nu_j / d theta = lambda_{j-1} - lambda_j, at node N lambda_{N-1}: its memory, which
 * by theta takes the place of that of nu. */
static int update_history_of_slope(fvi_adjoint_multistep *m, size_t j, const double *x)
{
    const int at_end = j == m->run->steps;
    for (size_t i = 0; i < m->d; i++) {
        const double now = m->delta[i] + (at_end ? m->lambda[i] : 0);
        m->work[i] = now - m->before[i];
        m->before[i] = now;
    }
    int status = fvi_history_push(m->slope, m->before, m->work, m->N);
    for (size_t i = 0; i < m->d; i++)
        m->shift[i] += term(m, (double)j, x[i], i) * m->N[i];
    return status;
}

/* ---- the equation of a step ---- */

/* out = G v for a Hessian with more than its diagonal. */
static void apply(const fvi_adjoint_multistep *m, const double *v, double *out)
{
    const size_t d = m->d, w = m->run->system->potential.diagonals;
    const double *row = m->G;
    memset(out, 0, d * sizeof *out);
    for (size_t i = 0; i < d; i++, row += w ? w : d)
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
static int factorise(fvi_adjoint_multistep *m)
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

/* G and J at S. */
static int evaluate_hessian(fvi_adjoint_multistep *m)
{
    const fvi_potential *u = &m->run->system->potential;
    if (!m->G || m->is_ready)
        return FVI_SUCCESS;
    m->is_ready = m->is_quadratic;
    int status = u->hessian(m->d, m->S, u->params, m->G);
    return status || !m->J.block ? status : factorise(m);
}

/* delta, from J delta = r - (1 - kappa) h G lambda. r may be delta. */
static int solve(fvi_adjoint_multistep *m, const double *r)
{
    const double after = (1 - m->kappa) * m->run->h, share = m->kappa * after;
    int status = FVI_SUCCESS;
    if (m->J.block) {
        apply(m, m->lambda, m->work);
        for (size_t i = 0; i < m->d; i++)
            m->delta[i] = r[i] - after * m->work[i];
        fvi_band_solve(&m->J, m->delta);
        return status;
    }
    for (size_t i = 0; i < m->d; i++) { /* each coordinate alone */
        const double G = m->G ? m->G[i] : 0, J = m->inertia[i] + share * G;
        m->delta[i] = (r[i] - after * G * m->lambda[i]) / J;
        if (J == 0)
            status = FVI_ESING;
    }
    return status;
}

/* ---- a step ---- */

/* What the past gave to the two ends of step k. */
static void accumulate_initial_history(fvi_adjoint_multistep *m, size_t k)
{
    double at[2] = { 0 }, slope[2] = { 0 };
    fvi_kernel_impulses(&m->initial_impulse, k, at);
    if (m->want->alpha)
        fvi_kernel_impulses_by_order(&m->initial_impulse, k, slope);
    for (size_t i = 0; i < m->d; i++) {
        const double left = m->lambda[i] + m->delta[i], right = m->lambda[i];
        m->pull[i] += at[0] * left + at[1] * right;
        m->impulse_sum_by_order[i] += slope[0] * left + slope[1] * right;
    }
}

/* What the parameters of the potential give, M being there. */
static int accumulate_parameters(fvi_adjoint_multistep *m)
{
    const fvi_sensitivities *want = m->want;
    const fvi_parameter_gradient *by = &want->sensitivity;
    const size_t d = m->d, count = want->parameters ? by->count : 0;
    const double *M = m->M, *column = m->column, h = m->run->h;
    void *params = m->run->system->potential.params;
    int status = FVI_SUCCESS;
    for (size_t j = 0; !status && j < count; j++) {
        status = by->column(j, d, m->S, params, m->column);
        double sum = column[0] * M[0];
        for (size_t i = 1; i < d; i++)
            sum += column[i] * M[i];
        want->parameters[j] -= h * sum;
    }
    return status;
}

/* lambda_{k+1} becomes lambda_k. On the way: M_k = kappa lambda_k + (1 - kappa)
 * lambda_{k+1}, the momentum behind the step, and what mass and force meet. */
static int advance_adjoint(fvi_adjoint_multistep *m, size_t k, const double *rows)
{
    const double h = m->run->h, kappa = m->kappa;
    const size_t d = m->d;
    double *force = m->want->force ? m->want->force + k * d : NULL;
    for (size_t i = 0; i < d; i++) {
        const double right = m->lambda[i], delta = m->delta[i],
                     left = right + delta, M = right + kappa * delta;
        m->lambda[i] = left;
        m->M[i] = M;
        m->kinetic[i] -= (rows[d + i] - rows[i]) * delta;
        if (m->G && !m->J.block)
            m->q[i] -= h * (m->G[i] * M);
        if (!force)
            continue;
        force[d + i] += m->paper_convention ? h * right : h / 2 * right;
        force[i] += m->paper_convention ? 0 : h / 2 * left;
    }
    if (m->J.block)
        apply(m, m->M, m->work);
    for (size_t i = 0; m->J.block && i < d; i++)
        m->q[i] -= h * m->work[i];
    return accumulate_parameters(m);
}

/* J_{k+1} and lambda_{k+1} come in. */
static void begin_node(fvi_adjoint_multistep *m, size_t k, const double *rows, const double *Jx)
{
    const double last = k + 1 == m->run->steps ? m->end + m->theta : 1;
    const double after = 1 - m->kappa;
    const size_t d = m->d;
    for (size_t i = 0; i < d; i++) {
        const double dnu = last * m->lambda[i] - m->nu[i];
        m->S[i] = rows[i] + after * (rows[d + i] - rows[i]);
        m->q[i] += Jx[i];
        m->dnu[i] = dnu;
        m->nu[i] += dnu;
    }
}

/* Algorithm 3, and each coordinate alone? */
static int is_straight(const fvi_adjoint_multistep *m)
{
    return m->paper_convention && m->memory && !m->J.block && !m->terms;
}

/* remember, solve and pass in one: what the next line wants stays in a register, where the
 * step of one coordinate would wait for what is written and read again. */
static int advance_adjoint_straight(fvi_adjoint_multistep *m, size_t k, const double *rows)
{
    const double h = m->run->h, kappa = m->kappa, after = (1 - kappa) * h;
    const size_t d = m->d;
    double *force = m->want->force ? m->want->force + k * d : NULL;
    int status = push(m);
    for (size_t i = 0; i < d; i++) {
        const double z = term(m, (double)(k + 1), rows[d + i], i), N = m->N[i];
        const double G = m->G ? m->G[i] : 0, lambda = m->lambda[i];
        const double q = m->q[i] - m->c[i] * N;
        const double J = m->inertia[i] + kappa * after * G;
        const double delta = (q - after * G * lambda) / J;
        const double M = lambda + kappa * delta;
        status = J == 0 ? FVI_ESING : status;
        m->lambda[i] = lambda + delta;
        m->q[i] = q - h * (G * M);
        m->M[i] = M;
        m->sum[i] += z * N;
        m->rate[i] += z * m->Ndot[i];
        m->plain[i] += N;
        m->linear[i] += (double)(k + 1) * N;
        m->kinetic[i] -= (rows[d + i] - rows[i]) * delta;
        if (force)
            force[d + i] += h * lambda;
    }
    return status ? status : accumulate_parameters(m);
}

//> step
int fvi_adjoint_multistep_step(fvi_adjoint_multistep *m, size_t k, const double *rows,
                    const double *Jx)
{
    const double *x = rows + m->d; /* x_{k+1} */
    const int shifted = m->memory && m->theta > 0;
    int status = shifted ? look_ahead(m) : FVI_SUCCESS;
    begin_node(m, k, rows, Jx);
    if (!status)
        status = evaluate_hessian(m);
    if (!status && is_straight(m))
        return advance_adjoint_straight(m, k, rows);
    if (!status && m->memory && !shifted)
        status = update_history(m, k + 1, x);
    if (shifted)
        guess(m);
    if (!status)
        status = solve(m, shifted ? m->delta : m->q);
    if (!status && shifted)
        status = update_history_shifted(m, k + 1, x);
    if (!status && m->slope)
        status = update_history_of_slope(m, k + 1, x);
    if (!status && m->has_initial_impulses)
        accumulate_initial_history(m, k);
    return status ? status : advance_adjoint(m, k, rows);
}
//< step

int fvi_adjoint_last(fvi_adjoint_multistep *m)
{
    for (size_t i = 0; i < m->d; i++) {
        m->dnu[i] = -m->nu[i];
        m->nu[i] = 0;
    }
    return update_history(m, 0, m->run->x0);
}
