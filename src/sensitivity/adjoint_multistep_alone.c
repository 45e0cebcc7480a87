/* src/sensitivity/adjoint_multistep_alone.c -- A step backwards of one coordinate.    [H 23]
 *
 * The step of the mirrored run, (9.4) or (13.10), is a division, and no loop has to find out that
 * it runs once: the digits of adjoint_multistep.c and of the methods of order 2, in half to two
 * thirds of their time. */
#include "adjoint_multistep.h"

#include "methods/convolution_quadrature_dampers.h"
#include "system/dot.h"

/* N, and its derivative by 2 alpha if that is wanted: lambda and its increment go in. */
static int push(const fvi_adjoint_multistep *m, double lambda, double delta, double *N,
                double *Ndot)
{
    return m->damping->Hdot ? fvi_history_push_by_order(m->damping->memory, &lambda,
                                                        &delta, N, Ndot)
                            : fvi_history_push(m->damping->memory, &lambda, &delta, N);
}

/* The derivatives by the parameters of U, M being the multiplier of S. */
static int accumulate_parameters(const fvi_adjoint_multistep *m, double S, double M)
{
    const fvi_sensitivities *want = m->want;
    const fvi_parameter_gradient *by = &want->sensitivity;
    void *params = m->run->system->potential.params;
    int status = FVI_SUCCESS;
    for (size_t p = 0; want->parameters && !status && p < by->count; p++) {
        double column;
        status = by->column(p, 1, &S, params, &column);
        want->parameters[p] -= m->run->h * (column * M);
    }
    return status;
}

//> alone
int fvi_adjoint_multistep_step_alone(fvi_adjoint_multistep *m, size_t k,
                                     const double *rows, double Jx)
{
    const fvi_run *run = m->run;
    const fvi_potential *u = &run->system->potential;
    fvi_stepper *s = m->stepper;
    const double h = run->h, kappa = m->kappa, share = (1 - kappa) * h,
                 moved = rows[1] - rows[0], S = rows[0] + (1 - kappa) * moved;
    double G = 0, N, Ndot = 0;
    int status = FVI_SUCCESS;
    if (m->has_hessian && !(m->is_quadratic && k + 1 < run->steps))
        status = u->hessian(1, &S, u->params, m->G);
    if (m->has_hessian)
        G = *m->G;
    const double p = *s->p + Jx, right = *s->x,
                 J = m->inertia + share * kappa * G,
                 delta = (p - share * (G * right)) / J, left = right + delta,
                 M = right + kappa * delta, g = h * (G * M);
    const int pushed = push(m, left, delta, &N, &Ndot);
    *s->x = left;
    *s->p = p - g - *m->damping->factor * N;
    *m->by_start += Jx - g;
    if (m->has_drift)
        *m->by_line += (double)(k + 1) * h * (Jx - g) + kappa * h * g;
    *m->kinetic -= moved * delta;
    const double z = rows[0] - (m->is_liouville ? 0 : *run->x0)
                     - (double)k * h * *m->v0;
    *m->sum += z * N;
    m->sum_by_order += z * Ndot; /* times rho in the end */
    if (m->want->force)
        m->want->force[k + 1] += h * right;
    status = status ? status : J == 0 ? FVI_ESING : pushed;
    return status ? status : accumulate_parameters(m, S, M);
}
//< alone

/* ---- the step of a method of order 2, (13.10) ---- */

int fvi_adjoint_multistep_can_step_alone(const fvi_adjoint_multistep *m)
{
    const fvi_cq_state *o = m->stepper->method_state;
    return !m->paper_convention && m->d == 1 && m->damping && m->damping->all
           && !m->run->system->matrices && o->count == 1
           && !o->each->history_force.size && *m->damping->drift == 0;
}

/* The factor of the weights, on the term that has come in. */
static double filter(fvi_cq_damper *a, double term)
{
    if (a->taps == 0)
        return term;
    a->place = (a->place ? a->place : a->taps) - 1;
    double *past = a->past + a->place;
    past[0] = past[a->taps] = term;
    return fvi_dot(a->taps, a->g, past);
}

/* D of the later end as far as it is known. */
static int look_ahead(const fvi_cq_damper *a, double z, double *ahead)
{
    const int status = fvi_history_ahead(a->damping->memory, &z, ahead);
    if (a->taps && a->increments)
        *ahead += a->g[1] * a->past[a->place];
    return status;
}

//> advance
int fvi_adjoint_multistep_advance_alone(fvi_adjoint_multistep *m)
{
    fvi_stepper *s = m->stepper;
    const fvi_newton *n = s->newton;
    fvi_cq_damper *a = ((fvi_cq_state *)s->method_state)->each;
    fvi_damping *d = a->damping;
    const double h = m->run->h, G = m->has_hessian ? *m->G : 0, x = *s->x,
                 J = *n->A + *n->s * n->theta * G;
    double p = *s->p, ahead = 0;
    int status = FVI_SUCCESS;
    if (a->theta != 0.5)
        p -= (0.5 - a->theta) * *d->factor * *a->H;
    if (a->theta != 0)
        status = look_ahead(a, x - *d->origin, &ahead);
    const double r = a->theta != 0 ? p - a->theta * *d->factor * ahead : p,
                 dx = (r - *n->s * (G * x)) / J, g = G * (x + n->theta * dx);
    double z = x + dx - *d->origin, dz = dx;
    p -= h * g;
    *(a->increments ? &dz : &z) = filter(a, a->increments ? dz : z);
    const int pushed = d->Hdot
                           ? fvi_history_push_by_order(d->memory, &z, &dz, d->H, d->Hdot)
                           : fvi_history_push(d->memory, &z, &dz, d->H);
    *a->H = *d->H;
    *s->x = x + dx;
    *s->p = p - (0.5 + a->theta) * *d->factor * *a->H;
    *s->g = g;
    return J == 0 ? FVI_ESING : status ? status : pushed;
}
//< advance
