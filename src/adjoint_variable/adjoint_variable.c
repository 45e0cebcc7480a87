/* src/adjoint_variable/adjoint_variable.c -- The adjoint run of a chain on its mesh. [H 23] */
#include "adjoint_variable.h"

#include "parameter_derivatives/potential_derivatives.h"
#include "system/arrays.h"
#include "system/fail.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- the start ---- */

static int allocate(fvi_adjoint_variable_run *m)
{
    const size_t s = m->s, d = m->d;
    const fvi_system *system = m->run->system;
    m->block = FVI_ARRAYS({ &m->Lambda, FVI_LANES * d }, { &m->mu, FVI_LANES * d }, { &m->T, FVI_LANES * d },
                          { &m->v, FVI_LANES * d }, { &m->source, FVI_LANES * d }, { &m->xi, d }, { &m->after, d },
                          { &m->before, d }, { &m->Jx, d }, { &m->Jp, d }, { &m->column, d }, { &m->kinetic, d },
                          { &m->sum, d }, { &m->plain, d }, { &m->push, d }, { &m->subtracted_velocity, d },
                          { &m->Jk, d }, { &m->by_mass, d }, { &m->X, s * d }, { &m->r, s * d },
                          { &m->hessian_product, s * d }, { &m->G, s * m->linearised.size });
    if (!m->block)
        FVI_FAIL("no memory for the adjoint run", FVI_ENOMEM);
    if (m->linearised.size == 0)
        m->G = NULL;
    m->linearised.G = m->G;
    const size_t w =
        system->potential.diagonals ? system->potential.diagonals : d;
    if (fvi_band_alloc(s * d, s * w, &m->J_band))
        FVI_FAIL("no memory for the adjoint run", FVI_ENOMEM);
    return FVI_SUCCESS;
}

/* Give new modes to all coordinates, at rest, or none if no history needs them. */
static int start_modes(fvi_adjoint_variable_run *m)
{
    fvi_variable_step_state *o = m->o;
    fvi_modes_free(o->modes);
    fvi_modes_free(o->rising);
    o->modes = o->rising = NULL;
    if (!m->has_history || (o->beta == 0 && !m->want->alpha))
        return FVI_SUCCESS;
    if (o->kernel)
        return fvi_variable_step_begin_kernel(o, o->kernel, m->d, &o->modes, &o->rising);
    const int status = fvi_modes_alloc(m->rule, o->modes_kind, o->beta, m->d, o->T, o->least, &o->modes);
    if (status || !m->want->alpha)
        return status;
    fvi_variable_present_by_order(m->rule, o->beta, &m->W0_rate);
    return fvi_modes_add_order(o->modes);
}

static int start(fvi_adjoint_variable_run *m)
{
    const double ones[FVI_LANES] = { 1, 1, 1, 1, 1, 1, 1, 1 };
    m->o = m->path.stepper->method_state;
    m->rule = m->o->rule;
    m->s = m->rule->s;
    m->row = m->run->steps;
    m->mass_plus_damping = m->o->beta == 1;
    m->has_history = m->want->damping != NULL;
    for (size_t j = 0; j < m->d; j++)
        m->has_history |= m->run->system->damping[j] > 0;
    m->has_history = m->has_history && (!m->mass_plus_damping || m->want->alpha);
    m->linearised = fvi_linearised_begin(m->run->system, m->s);
    const int status = allocate(m);
    fvi_square_apply(m->s, &m->o->W0, ones, m->W_1);
    return status ? status : start_modes(m);
}

/* ---- the rows within a step ---- */

void fvi_adjoint_mesh_shape(const fvi_variable_rule *rule, double h, const double *integral,
                            double *shape)
{
    for (size_t i = 0; i < rule->s; i++) {
        double unit[FVI_LANES] = { 0 }, bend[FVI_LANES], power[FVI_LANES];
        unit[i] = 1;
        fvi_square_apply(rule->s, &rule->legendre, unit, bend);
        fvi_variable_step_powers(rule->s, bend, power);
        shape[i] = 0;
        for (size_t k = 0; k < rule->s; k++)
            shape[i] += h * integral[k] * power[k];
    }
}

/* Add the derivatives through p = m v at a row in step n, at the fraction theta of it. An impulse at the row changes p
 * but is no part of v. (23.27) */
static void read_momentum(fvi_adjoint_variable_run *m, size_t n, double t, double theta,
                          double *by_v)
{
    const double *numbers = m->path.numbers + n * FVI_MESH_NUMBERS * m->d;
    double once[FVI_LANES], shape[FVI_LANES];
    fvi_variable_step_once(theta, once);
    fvi_adjoint_mesh_shape(m->rule, 1, once, shape);
    for (size_t j = 0; j < m->d; j++) {
        const double by = m->run->system->mass[j] * m->Jk[j],
                     *delta = numbers + 3 * m->d + j * FVI_LANES;
        double v = numbers[m->d + j], whole = 0, slope = 0;
        for (size_t i = 0; i < m->s; i++) {
            m->source[j * FVI_LANES + i] += by * shape[i];
            whole += shape[i];
            v += shape[i] * delta[i];
        }
        by_v[j] += by * (1 - whole);
        if (fvi_adjoint_variable_is_singular(m, n)) {
            fvi_singular_start_adjoint_at(&m->singular_start, j, t, &slope);
            fvi_singular_start_adjoint_accumulate(&m->singular_start, j, t, 0, by, 0);
        }
        m->by_mass[j] += m->Jk[j] * (v + slope);
    }
}

/* Read all rows in step n that are not at its beginning. Add the derivatives through them by V - v to source, and by
 * v_n and x_n to `by_v` and `by_x`. */
static int read_rows(fvi_adjoint_variable_run *m, size_t n, double *by_v,
                     double *by_x)
{
    const fvi_recorded_step *step = &m->path.step[n];
    const double h = step->length.h;
    int status = FVI_SUCCESS;
    memset(m->source, 0, m->d * FVI_LANES * sizeof *m->source);
    for (; !status && m->row > 0; m->row--) {
        const double t = (double)m->row * m->run->h,
                     theta = fmin((t - step->t) / h, 1);
        double shape[FVI_LANES], twice[FVI_LANES];
        if (t <= step->t)
            break;
        status = fvi_recorded_steps_slopes(&m->path, m->run, m->J, m->row, m->Jx, m->Jp, m->Jk);
        fvi_variable_step_twice(theta, twice);
        fvi_adjoint_mesh_shape(m->rule, h, twice, shape);
        if (m->J->has_momenta && m->row < m->run->steps)
            read_momentum(m, n, t, theta, by_v);
        for (size_t j = 0; j < m->d; j++) {
            double whole = 0;
            for (size_t i = 0; i < m->s; i++) {
                m->source[j * FVI_LANES + i] += m->Jx[j] * shape[i];
                whole += shape[i];
            }
            by_v[j] += m->Jx[j] * (h * theta - whole);
            by_x[j] += m->Jx[j];
            if (m->row == m->run->steps) /* p_N = m v_N */
                m->after[j] = m->run->system->mass[j] * m->Jp[j];
            if (fvi_adjoint_variable_is_singular(m, n))
                fvi_singular_start_adjoint_accumulate(&m->singular_start, j, t, m->Jx[j],
                                     m->row == m->run->steps ? m->after[j] : 0,
                                     0);
        }
    }
    return status;
}

/* ---- a step ---- */

/* Add the products of T, of the inertia and of V. numbers: of the step. */
static void accumulate_damping(fvi_adjoint_variable_run *m, const double *numbers, double h)
{
    const size_t s = m->s, d = m->d;
    const double now = pow(h, -m->o->beta), *b = m->rule->b;
    for (size_t j = 0; j < d; j++) {
        const double *delta = numbers + 3 * d + j * FVI_LANES;
        const double *Lambda = m->Lambda + j * FVI_LANES,
                     *mu = m->mu + j * FVI_LANES, *T = m->T + j * FVI_LANES;
        double jump[FVI_LANES] = { 0 }, bend[FVI_LANES], present[FVI_LANES];
        for (size_t i = 0; i < s; i++) /* V minus the last v before an impulse */
            jump[i] = delta[i] + numbers[2 * d + j];
        fvi_square_apply(s, &m->rule->inverse, jump, bend);
        fvi_square_apply(s, &m->o->W0, mu, present);
        for (size_t i = 0; i < s; i++) {
            const double V = numbers[d + j] + delta[s - 1 - i] - m->subtracted_velocity[j],
                         all = T[i] + now * present[i];
            m->kinetic[j] -= b[i] * Lambda[i] * bend[i];
            m->sum[j] += h * b[i] * V * all;
            m->plain[j] += h * b[i] * all;
            m->push[j] += h * b[i] * Lambda[i];
        }
    }
}

//> alpha
/* Add the part of coordinate j and of one step to dJ/dalpha, (23.18). */
static void accumulate_alpha(fvi_adjoint_variable_run *m, size_t j, const double *numbers,
                       double h)
{
    const size_t s = m->s;
    const int above = m->o->beta > 0;
    const double now = pow(h, -m->o->beta), ln = log(h),
                 *delta = numbers + 3 * m->d + j * FVI_LANES;
    double v[FVI_LANES] = { 0 }, rate[FVI_LANES], same[FVI_LANES],
           past[FVI_LANES], sum = 0;
    for (size_t i = 0; i < s; i++)
        v[i] = m->mu[j * FVI_LANES + i] - (above ? m->before[j] : 0);
    fvi_square_apply(s, &m->W0_rate, v, rate);
    fvi_square_apply(s, &m->o->W0, v, same);
    fvi_modes_history_by_order(m->o->modes, j, past);
    for (size_t i = 0; i < s; i++)
        sum += m->rule->b[i]
               * (numbers[m->d + j] + delta[s - 1 - i] - m->subtracted_velocity[j])
               * (past[i] + now * (rate[i] - ln * same[i]));
    *m->want->alpha -= 2 * m->run->system->damping[j] * h * sum;
}
//< alpha

void fvi_adjoint_mesh_force(const fvi_run *run, double t, double weight, size_t stride,
                            const double *multiplier, double *force)
{
    const size_t d = run->system->d;
    const double at = t / run->h, k = fmin(floor(at), (double)run->steps - 1),
                 share = fmin(at - k, 1);
    for (size_t j = 0; j < d; j++) {
        const double by = weight * multiplier[j * stride];
        force[(size_t)k * d + j] += (1 - share) * by;
        force[((size_t)k + 1) * d + j] += share * by;
    }
}

static void accumulate_force(fvi_adjoint_variable_run *m, const fvi_recorded_step *step)
{
    for (size_t i = 0; m->want->force && i < m->s; i++)
        fvi_adjoint_mesh_force(m->run, step->t + m->rule->c[i] * step->length.h,
                               step->length.h * m->rule->b[i], FVI_LANES, m->Lambda + i,
                               m->want->force);
}

/* Add mu to the history. */
static void update_history(fvi_adjoint_variable_run *m)
{
    for (size_t j = 0; m->has_history && j < m->d; j++) {
        const double *mu = m->mu + j * FVI_LANES;
        double v[FVI_LANES] = { 0 };
        for (size_t i = 0; i < m->s; i++)
            v[i] = mu[i] - (m->o->beta > 0 ? m->before[j] : 0);
        if (m->o->modes)
            fvi_modes_advance(m->o->modes, j, v, m->before[j]);
        for (size_t i = 0; m->o->rising && i < m->s; i++)
            v[i] -= m->before[j];
        if (m->o->rising)
            fvi_modes_advance(m->o->rising, j, v, m->before[j]);
        m->before[j] = mu[m->s - 1];
    }
}

/* Go from the end of step n to its beginning. */
static int step_back(fvi_adjoint_variable_run *m, size_t n)
{
    const fvi_recorded_step *step = &m->path.step[n];
    const double *numbers = m->path.numbers + n * FVI_MESH_NUMBERS * m->d;
    const double h = step->length.h, *b = m->rule->b;
    double *by_v = m->v, *by_x = m->v + m->d;
    if (fvi_adjoint_variable_is_singular(m, n) && n + 1 < m->path.steps
        && !fvi_adjoint_variable_is_singular(m, n + 1))
        fvi_adjoint_variable_transfer_back(m);
    memset(m->v, 0, 2 * m->d * sizeof *m->v);
    int status = read_rows(m, n, by_v, by_x);
    if (!status)
        status = fvi_adjoint_variable_solve(m, n);
    if (!status)
        status = fvi_potential_accumulate_parameters(m->want, m->run->system, m->s, h, b,
                                                     m->X, m->Lambda, FVI_LANES,
                                                     m->column);
    if (status)
        return status;
    accumulate_damping(m, numbers, h);
    if (fvi_adjoint_variable_is_singular(m, n))
        fvi_adjoint_variable_accumulate_singular_start(m, n);
    for (size_t j = 0; m->want->alpha && j < m->d; j++)
        if (m->run->system->damping[j] > 0)
            accumulate_alpha(m, j, numbers, h);
    accumulate_force(m, step);
    update_history(m);
    for (size_t j = 0; j < m->d; j++) { /* to x_n and v_n */
        const double M = fvi_adjoint_variable_mass(m, j);
        m->after[j] = M * m->Lambda[j * FVI_LANES] + by_v[j];
        m->kinetic[j] -= by_v[j] * numbers[2 * m->d + j] / M; /* the impulse J adds J / M to v */
        for (size_t i = 0; i < m->s; i++)
            by_x[j] -= h * b[i] * m->hessian_product[i * m->d + j];
        m->xi[j] += by_x[j];
    }
    return FVI_SUCCESS;
}

/* ---- the end ---- */

/* Write the derivatives. At alpha = 0 Riemann-Liouville's damping is a spring about 0. At alpha = 1 Riemann-Liouville's
 * past and a held past make the start jump: v begins with p0 / (m + rho). */
static int end(fvi_adjoint_variable_run *m)
{
    const fvi_sensitivities *want = m->want;
    const fvi_run *run = m->run;
    const int liouville = run->past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE,
              start_jumps = m->mass_plus_damping && run->past != FVI_INITIAL_HISTORY_CAPUTO;
    int status = fvi_recorded_steps_slopes(&m->path, run, m->J, 0, m->Jx, m->Jp, m->Jk);
    for (size_t j = 0; j < m->d; j++) {
        const double M = run->system->mass[j], rho = run->system->damping[j],
                     first = start_jumps ? M + rho : M, v0 = run->p0[j] / first,
                     spring = liouville && run->alpha == 0 ? m->push[j] : 0,
                     by_v0 = m->after[j]
                             + (m->o->beta > 0 ? fvi_adjoint_variable_damping(m, j)
                                                       * m->plain[j]
                                                 : 0);
        m->xi[j] += m->Jx[j] - rho * spring;
        m->kinetic[j] -=
            m->Jp[j] * M * m->path.impulse_dv[j] / fvi_adjoint_variable_mass(m, j);
        if (want->x0)
            want->x0[j] = m->xi[j];
        if (want->p0) /* the velocity must not jump at the start */
            want->p0[j] = m->o->rising && rho > 0 ? NAN : by_v0 / first + m->Jk[j];
        if (want->terms)
            want->terms[0] -= rho * m->sum[j] / run->law->term[0].rho;
        if (want->mass)
            want->mass[j] = m->kinetic[j] - by_v0 * v0 / first
                            + m->Jp[j] * m->path.p[j] / M + m->by_mass[j];
        if (want->damping)
            want->damping[j] =
                m->mass_plus_damping ? m->kinetic[j] - (start_jumps ? by_v0 * v0 / first : 0)
                         : -m->sum[j] - spring * run->x0[j];
        if (m->singular_start.is)
            fvi_adjoint_variable_end_singular_start(m, j, by_v0);
        if (want->x0 && liouville && run->alpha > 0.5 && rho > 0)
            want->x0[j] = NAN; /* no run starts at another x0, (19.2) */
    }
    if (want->alpha)
        *want->alpha += m->singular_start.by_alpha;
    return status || fvi_all_finite(m->d, m->xi) ? status : FVI_EOVRFLW;
}

/* Return nonzero if the start must have a singular part also where A = 0. A derivative by A needs steps that end at
 * t1. */
static int needs_singular_part(const fvi_run *run, const fvi_sensitivities *want)
{
    return fvi_initial_history_acts(run->past, run->alpha)
           && (run->alpha > 0.5 ? want->p0 : want->x0) != NULL;
}

int fvi_adjoint_variable(const fvi_run *run, const fvi_objective *J,
                    const fvi_sensitivities *want)
{
    fvi_run own = *run;
    fvi_adjoint_variable_run m = {
        .run = &own, .J = J, .want = want, .d = run->system->d
    };
    int status = fvi_recorded_steps_run(&own, needs_singular_part(&own, want), &m.path);
    if (!status)
        status = start(&m);
    if (!status)
        status = fvi_singular_start_adjoint_start(
            &own, m.o, &m.singular_start);
    if (!status)
        fvi_adjoint_variable_subtract_velocity(&m);
    for (size_t n = m.path.steps; !status && n-- > 0;)
        status = step_back(&m, n);
    if (!status)
        status = end(&m);
    fvi_singular_start_adjoint_stop(&m.singular_start);
    fvi_band_free(&m.J_band);
    free(m.block);
    fvi_recorded_steps_free(&m.path);
    return status;
}
