/* src/adjoint_variable/adjoint_variable_singular.c -- The adjoint run of a chain on its mesh, through a singular start.
 * [H 23] */
#include "adjoint_variable.h"

/* Write the velocity that the history subtracts in the last step, where the adjoint run begins: v0; or with a singular
 * part the velocity that v begins with, plus G' at t1 if the last step is behind t1. (23.26) */
void fvi_adjoint_variable_subtract_velocity(fvi_adjoint_variable_run *m)
{
    const size_t last = m->path.steps - 1;
    for (size_t j = 0; m->o->beta > 0 && j < m->d; j++) {
        double slope = 0;
        m->subtracted_velocity[j] = m->run->p0[j] / m->run->system->mass[j];
        if (!m->singular_start.is)
            continue;
        m->subtracted_velocity[j] = m->singular_start.A[j] * fvi_singular_start_adjoint_first(&m->singular_start, j);
        if (!fvi_adjoint_variable_is_singular(m, last))
            fvi_singular_start_adjoint_at(&m->singular_start, j, m->singular_start.undamped.t1, &slope);
        m->subtracted_velocity[j] += slope;
    }
}

/* In a step before t1, G moves the stages and leaves a force: add the derivatives through both. */
void fvi_adjoint_variable_accumulate_singular_start(fvi_adjoint_variable_run *m, size_t n)
{
    const double h = m->path.step[n].length.h, *b = m->rule->b;
    for (size_t i = 0; i < m->s; i++) {
        const double t = fvi_adjoint_variable_time(m, n, i);
        for (size_t j = 0; j < m->d; j++)
            fvi_singular_start_adjoint_accumulate(&m->singular_start, j, t,
                                 -h * b[i] * m->hessian_product[i * m->d + j], 0,
                                 -h * b[i] * m->Lambda[j * FVI_LANES + i]);
    }
}

//> transfer-back
/* At t1, before the first step that begins there. In the run x, v and the modes take over G at this time. So their
 * derivatives are handed back to G. */
void fvi_adjoint_variable_transfer_back(fvi_adjoint_variable_run *m)
{
    const double t1 = m->singular_start.undamped.t1;
    if (m->o->modes)
        fvi_modes_activate_all(m->o->modes);
    for (size_t j = 0; j < m->d; j++) {
        const double rho = m->run->system->damping[j];
        double by_v = m->after[j], slope;
        fvi_singular_start_adjoint_at(&m->singular_start, j, t1, &slope);
        if (m->o->beta > 0) { /* and the velocity that the history subtracts from V */
            by_v += rho * m->plain[j];
            m->subtracted_velocity[j] -= slope;
        }
        fvi_singular_start_adjoint_accumulate(&m->singular_start, j, t1, m->xi[j], by_v, 0);
        if (m->o->modes)
            m->sum[j] +=
                fvi_singular_start_adjoint_accumulate_modes(&m->singular_start, j, rho, m->o->modes,
                                         m->before[j], m->want->alpha != NULL);
    }
}
//< transfer-back

/* Add the derivatives through A, r and m at t = 0. v and y begin with c_0 A, and the history subtracts that from V. */
void fvi_adjoint_variable_end_singular_start(fvi_adjoint_variable_run *m, size_t j, double by_v0)
{
    const fvi_sensitivities *want = m->want;
    const fvi_singular_start_adjoint *p = &m->singular_start;
    const double M = m->run->system->mass[j], rho = m->run->system->damping[j];
    const int above = m->o->beta > 0;
    const double by_A =
        p->by_A[j] + (above ? fvi_singular_start_adjoint_first(p, j) * by_v0 : 0);
    double by_rho, by_m;
    fvi_singular_start_adjoint_ratio(p, M, rho, &by_rho, &by_m);
    if (want->p0 && above)
        want->p0[j] = by_A / M + m->Jk[j];
    if (want->x0 && !above)
        want->x0[j] += by_A;
    if (want->mass)
        want->mass[j] += p->by_ratio[j] * by_m + p->by_mass[j] / M
                         + (above ? (by_v0 - by_A) * p->A[j] / M : 0);
    if (want->damping)
        want->damping[j] += p->by_ratio[j] * by_rho;
}
