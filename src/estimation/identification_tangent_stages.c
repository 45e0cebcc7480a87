/* src/estimation/identification_tangent_stages.c -- What the parameters change at the stages.
 *                                                                     [H 24] */
#include "identification_tangent.h"

#include "system/fail.h"

#include <math.h>

/* (17.3): the inverse of A, of form D; or D alone, of form M. */
static double differentiated(const fvi_tangent_run *o, size_t i, const double *w)
{
    double sum = o->damped_inertia && i == 0 ? w[0] / o->rule->b[0] : 0;
    for (size_t l = 0; l < o->stages; l++)
        sum += o->rule->D[i][l] * w[l];
    return sum;
}

/* Y = W v with its history, and its derivative by beta; and the history of the next step.
 * v: velocities of the stages, less the line that the memory knows. */
static int damping_of(fvi_tangent_run *o, const double *v, double *Y, double *Ydot)
{
    const size_t s = o->stages;
    const double *W = fvi_lobatto_history_now(o->of_stages),
                 *rate = fvi_lobatto_history_now_by_order(o->of_stages),
                 unit = pow(o->run->h, 1 - 2 * o->run->alpha), log_h = log(o->run->h);
    for (size_t i = 0; i < s; i++) {
        Y[i] = o->H[i];
        Ydot[i] = o->Hdot[i];
        for (size_t l = 0; l < s; l++) {
            Y[i] += W[i * s + l] * v[l];
            Ydot[i] += rate[i * s + l] * v[l];
        }
        Y[i] *= unit;
        Ydot[i] = unit * Ydot[i] - log_h * Y[i];
    }
    return fvi_lobatto_history_push_by_order(o->of_stages, v, o->H, o->Hdot);
}

/* What a unit of mass does to stage i, as a force: the inertia of the motion. */
static double inertia(const fvi_tangent_run *o, size_t i, const double *v, double v_k)
{
    const double *b = o->rule->b, h = o->run->h;
    double sum = 0, away[FVI_STAGES];
    if (o->damped_inertia) {
        for (size_t l = 0; l < o->stages; l++)
            away[l] = v[l] - v_k;
        return -differentiated(o, i, away) / h;
    }
    for (size_t l = 0; l < o->stages; l++)
        sum += o->rule->D[l][i] * b[l] * v[l];
    return sum / (h * b[i]);
}

/* The force on the slope by parameter j at stage i. */
static double source_of(const fvi_tangent_run *o, size_t i, size_t j, double inertia_i,
                        double by_rho, double by_order)
{
    switch (o->which[j]) {
    case FVI_FREE_PARAMETER_MASS:
        return inertia_i;
    case FVI_FREE_PARAMETER_RHO:
        return by_rho;
    case FVI_FREE_PARAMETER_ALPHA: /* beta grows by 2 dalpha */
        return 2 * o->run->system->damping[0] * by_order;
    default:
        return -o->dU[i * o->P + j]; /* zero of what is no constant */
    }
}

//> stages
/* (24.12): q_i, the forces on the slopes, from the stages of the step just done. v_k: the
 * velocity at its beginning. The impulses of the past are as h^{1+e}, and e falls by 2. */
static int fill_sources(fvi_tangent_run *o, size_t k, const double *v, double v_k)
{
    const fvi_run *r = o->run;
    const double line = r->alpha > 0.5 ? r->p0[0] / r->system->mass[0] : 0,
                 log_h = log(r->h),
                 A = fvi_initial_history_amplitude(r->past, r->alpha, r->x0[0], line);
    double felt[FVI_STAGES], Y[FVI_STAGES], Ydot[FVI_STAGES],
        at[FVI_STAGES] = { 0 }, slope[FVI_STAGES] = { 0 };
    for (size_t i = 0; i < o->stages; i++)
        felt[i] = v[i] - line;
    const int status = damping_of(o, felt, Y, Ydot);
    if (o->impulse_size > 0) {
        fvi_kernel_impulses(&o->initial_impulse, k, at);
        fvi_kernel_impulses_by_order(&o->initial_impulse, k, slope);
    }
    for (size_t i = 0; i < o->stages; i++) {
        const double impulse = A * o->impulse_size / (r->h * o->rule->b[i]),
                     by_rho = -Y[i] - impulse * at[i],
                     by_order = -Ydot[i] + impulse * (log_h * at[i] + slope[i]),
                     inertia_i = inertia(o, i, v, v_k);
        for (size_t j = 0; j < o->P; j++)
            o->source[i * o->P + j] =
                source_of(o, i, j, inertia_i, by_rho, by_order);
    }
    return status;
}
//< stages

int fvi_tangent_stages_step(fvi_tangent_run *o)
{
    fvi_stepper *s = o->stepper;
    const fvi_lobatto_stages *stages = s->method_state;
    const size_t k = s->k;
    const double x = s->x[0], v_k = s->p[0] / o->run->system->mass[0];
    double v[FVI_STAGES];
    int status = fvi_stepper_step(s);
    for (size_t i = 0; !status && i < o->stages; i++) {
        v[i] = differentiated(o, i, stages->dX) / o->run->h;
        status = fvi_tangent_evaluate_potential(o, i, x + stages->dX[i]);
    }
    if (!status)
        status = fill_sources(o, k, v, v_k);
    o->linearised.asked = 0;
    return status ? status : fvi_stepper_step(o->tangent);
}

int fvi_tangent_stages_start(fvi_tangent_run *o)
{
    const fvi_run *r = o->run;
    o->rule = fvi_lobatto(o->stages);
    if (fvi_initial_history_acts(r->past, r->alpha)) {
        fvi_kernel_impulse_prepare(r->alpha, o->stages, o->rule->c,
                                   &o->initial_impulse);
        o->impulse_size = pow(r->h, 1 + o->initial_impulse.e);
    }
    return fvi_lobatto_history_alloc_by_order(
        o->stages, 2 * r->alpha - 1, 1, r->steps, r->memory,
        fvi_lobatto_history_tolerance(&o->tangent->run), &o->of_stages);
}
