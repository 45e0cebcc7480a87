/* src/adjoint_forces/adjoint_forces_start.c -- The derivatives of the forces of dampers through the start of their
 * elongations. [H 23] */
#include "adjoint_forces_start.h"

#include "methods/damping.h"
#include "run/run_damper.h"

#include <stdlib.h>
#include <string.h>

/* line_i = rho_i p_i / m_i, jump_i = rho_i x_i. */
static int start_of_chain(const fvi_stepper *s, const fvi_force_shares *shares, const fvi_sensitivities *want)
{
    const fvi_system *system = s->run.system;
    for (size_t i = 0; i < system->d; i++) {
        const double rho = system->damping[i], m = system->mass[i], v = s->p[i] / m, by_v = rho * shares->line[i];
        if (want->x0)
            want->x0[i] += rho * shares->jump[i];
        if (want->p0)
            want->p0[i] += by_v / m;
        if (want->mass)
            want->mass[i] -= by_v * v / m;
        if (want->damping)
            want->damping[i] += v * shares->line[i] + s->run.x0[i] * shares->jump[i];
    }
    return FVI_SUCCESS;
}

/* to += C_j by; for a damper along a row, to += row times its number. Adds the derivative by a factor of the damper to
 * *factor. */
static int multiply(const fvi_run *run, size_t j, const double *by, const double *at, double *to, double *factor)
{
    const size_t d = run->system->d;
    const fvi_mechanism *m = run->system->mechanism;
    if (!m || m->damper[j].matrix) {
        double *product = calloc(d, sizeof *product);
        const fvi_run_damper of = fvi_run_damper_of(run, j);
        const int status = product ? fvi_damping_multiply(&of.matrix, d, 1, by, product) : FVI_ENOMEM;
        for (size_t i = 0; i < d && !status; i++) {
            to[i] += product[i];
            *factor += product[i] * at[i];
        }
        free(product);
        return status;
    }
    for (size_t i = 0; i < d; i++) {
        to[i] += m->damper[j].of.row[i] * *by;
        *factor += m->damper[j].of.row[i] * *by * at[i];
    }
    return FVI_SUCCESS;
}

/* line = C_j v and jump = C_j x for damper j, v = M^-1 p. */
static int start_of_structure(const fvi_stepper *s, const fvi_force_shares *shares, const fvi_sensitivities *want)
{
    const fvi_run *run = &s->run;
    const fvi_mechanism *m = run->system->mechanism;
    const size_t d = run->system->d;
    double *v = calloc(4 * d, sizeof *v), *by_v = v + d, *by_x = by_v + d, *by_p = by_x + d;
    int status = v ? fvi_divide_by_mass(run->system, s->p, v) : FVI_ENOMEM;
    for (size_t j = 0, i = 0; j < fvi_run_damper_count(run) && !status; j++) {
        double factor = 0;
        status = multiply(run, j, shares->line + i, v, by_v, &factor);
        if (!status)
            status = multiply(run, j, shares->jump + i, run->x0, by_x, &factor);
        if (!status && want->damping)
            want->damping[j] += factor;
        i += m && !m->damper[j].matrix ? 1 : d;
    }
    if (!status)
        status = fvi_divide_by_mass(run->system, by_v, by_p);
    for (size_t i = 0; i < d && !status; i++) {
        if (want->x0)
            want->x0[i] += by_x[i];
        if (want->p0)
            want->p0[i] += by_p[i];
        if (want->mass)
            *want->mass -= by_v[i] * v[i];
    }
    free(v);
    return status;
}

int fvi_force_start(const fvi_stepper *s, const fvi_force_shares *shares, const fvi_sensitivities *want)
{
    return s->run.system->matrices    ? start_of_structure(s, shares, want)
           : s->run.system->mechanism ? fvi_force_start_of_mechanism(s, shares, want)
                                      : start_of_chain(s, shares, want);
}
