/* src/methods/step_sums.c -- Compute the impulse and the work of the dampers and of the force in one step. */
#include "step_sums.h"

#include "convolution_quadrature_dampers.h"
#include "lobatto_matrices.h"
#include "lobatto_stages.h"

#include "mechanism/mechanism.h"
#include "run/step_times.h"

#include <string.h>

static int is_of_order_1(const fvi_method *m)
{
    return m->scheme == FVI_SCHEME_CLASSICAL || m->scheme == FVI_SCHEME_FVI;
}

size_t fvi_step_dampers(const fvi_system *system)
{
    return fvi_has_dampers_of_matrices(system) ? system->mechanism->damper_count : 1;
}

/* ---- several dampers, each with its own history ---- */

/* Write the part of the force of each damper that acts at the beginning of a step, (13.10). A damper without a history,
 * such as one with a matrix of zeros, is not in the list of the method, so each damper has its number. */
static int begin_several(const fvi_stepper *s, double *dampers)
{
    const fvi_cq_state *o = s->method_state;
    const size_t d = s->run.system->d,
                 count = fvi_step_dampers(s->run.system);
    int status = FVI_SUCCESS;
    memset(dampers, 0, count * d * sizeof *dampers);
    for (size_t j = 0; !is_of_order_1(s->method) && j < o->count && !status; j++) {
        const fvi_cq_damper *a = o->each + j;
        if (a->theta != 0.5)
            status = fvi_damping_apply_force(a->damping, a->theta - 0.5, a->H, dampers + a->damping->number * d);
    }
    return status;
}

/* Add the part that acts at the end of the step, and the impulses of the past at both ends. */
static int end_several(const fvi_stepper *s, const double *begun,
                       double *dampers)
{
    const fvi_cq_state *o = s->method_state;
    const size_t d = s->run.system->d,
                 count = fvi_step_dampers(s->run.system);
    const fvi_damping *own = fvi_damping_of(s);
    int status = FVI_SUCCESS;
    memcpy(dampers, begun, count * d * sizeof *dampers);
    for (; is_of_order_1(s->method) && own && !status; own = own->next)
        status = fvi_damping_apply_force(own, -1, own->z, dampers + own->number * d);
    for (size_t j = 0; !is_of_order_1(s->method) && j < o->count && !status;
         j++) {
        const fvi_cq_damper *a = o->each + j;
        double *own_force = dampers + a->damping->number * d;
        status = fvi_damping_apply_force(a->damping, -0.5 - a->theta, a->H, own_force);
        for (size_t i = 0; a->history_force.size && i < d; i++)
            own_force[i] += a->history_force.size[i] * (a->impulse[0] + a->impulse[1]);
    }
    return status;
}

int fvi_step_begins(const fvi_stepper *s, fvi_step_begin *begin)
{
    const size_t bytes = s->run.system->d * sizeof *s->x;
    memcpy(begin->x, s->x, bytes);
    memcpy(begin->p, s->p, bytes);
    if (s->method->stages)
        return FVI_SUCCESS;
    if (fvi_has_dampers_of_matrices(s->run.system)) {
        const int status = begin_several(s, begin->dampers);
        if (status)
            return status;
    }
    if (is_of_order_1(s->method))
        return FVI_SUCCESS;
    return fvi_step_force(s, fvi_just_after((double)s->k * s->run.h), begin->F);
}

/* Compute the sums for a method with one gradient in a step. Its force acts at the end of the step,
 * or half at either end. */
static void sums_of_nodes(const fvi_stepper *s, const fvi_step_begin *begin,
                          const double *hit, fvi_step_sums *sums)
{
    const double h = s->run.h;
    const int whole = is_of_order_1(s->method);
    for (size_t j = 0; j < s->run.system->d; j++) {
        const double F = whole ? s->F[j] : (begin->F[j] + s->F[j]) / 2,
                     v = (s->x[j] - begin->x[j]) / h;
        if (!fvi_has_dampers_of_matrices(s->run.system)) {
            sums->damper[j] =
                h * (F - s->g[j]) - (s->p[j] - hit[j] - begin->p[j]);
            *sums->work += sums->damper[j] * v;
        }
        sums->by_force += h * F * v;
    }
}

/* ---- stages ---- */

/* Compute the velocities V_i of coordinate j, the derivative of the polynomial through X_i, (17.3). In form D this
 * polynomial jumps from x_k to X_1. */
static void find_stage_velocities(const fvi_stepper *s, const fvi_lobatto_stages *o,
                                  size_t j, double *V)
{
    const int jumps = s->method->damped_inertia;
    for (size_t i = 0; i < o->s; i++) {
        V[i] = i == 0 && jumps ? o->dX[j] / o->rule->b[0] : 0;
        for (size_t c = 0; c < o->s; c++)
            V[i] += o->rule->D[i][c]
                    * (c == 0 && !jumps ? 0 : o->dX[c * o->d + j]);
        V[i] /= s->run.h;
    }
}

/* Compute h b_i times the force of the damping at each stage. In form M it is part of S. In form D it follows from
 * (17.24) as the remaining term. */
static void find_damping_impulses(const fvi_stepper *s, const fvi_lobatto_stages *o,
                                  size_t j, const double *F, const double *V, double v,
                                  double *impulse)
{
    const double m = s->run.system->mass[j];
    for (size_t i = 0; i < o->s; i++) {
        const double b = o->rule->b[i], w = s->run.h * b;
        if (!s->method->damped_inertia) {
            impulse[i] = o->S[i * o->d + j] + w * F[i * o->d + j];
            continue;
        }
        double slope = i == 0 ? (V[0] - v) / o->rule->b[0] : 0;
        for (size_t c = 0; c < o->s; c++)
            slope += o->rule->D[i][c] * V[c];
        impulse[i] =
            w * (F[i * o->d + j] - o->grad[i * o->d + j]) - m * b * slope;
    }
}

/* Return the impulse of the damping for alpha = 1, where the damping is a mass and S holds the forces times their
 * share. (17.17) */
static double impulse_of_damping_mass(const fvi_stepper *s, const fvi_lobatto_stages *o,
                                      size_t j, const double *F, double change)
{
    double impulse = 0;
    for (size_t i = 0; i < o->s; i++)
        impulse += o->S[i * o->d + j]
                + s->run.h * o->rule->b[i] * o->share[j] * F[i * o->d + j];
    return (change + impulse) / o->share[j] - change;
}

int fvi_step_forces_at_stages(const fvi_stepper *s, size_t k, size_t stages,
                              const fvi_lobatto_rule *rule, double *F)
{
    const double h = s->run.h, left = (double)k * h, right = (double)(k + 1) * h;
    const size_t d = s->run.system->d;
    int status = FVI_SUCCESS;
    if (!s->run.system->force.value) {
        memset(F, 0, stages * d * sizeof *F);
        return FVI_SUCCESS;
    }
    for (size_t i = 0; i < stages && !status; i++)
        status = fvi_finite_step_force(s, fvi_inner_time(left, right, h, left + rule->c[i] * h, i, stages), F + i * d);
    return status;
}

/* Compute the sums for a method with stages. begin->F is workspace for the forces at all stages. */
static int sums_of_stages(const fvi_stepper *s, const fvi_step_begin *begin,
                          const double *hit, fvi_step_sums *sums)
{
    const fvi_lobatto_stages *o = s->method_state;
    double V[FVI_STAGES], impulse[FVI_STAGES], *F = begin->F;
    const int status = fvi_step_forces_at_stages(s, s->k - 1, o->s, o->rule, F);
    for (size_t j = 0; j < o->d && !status; j++) {
        const double change = s->p[j] - hit[j] - begin->p[j];
        find_stage_velocities(s, o, j, V);
        find_damping_impulses(s, o, j, F, V, begin->p[j] / s->run.system->mass[j], impulse);
        sums->damper[j] =
            o->share[j] == 1 ? 0 : impulse_of_damping_mass(s, o, j, F, change);
        for (size_t i = 0; i < o->s; i++) {
            if (o->share[j] == 1)
                sums->damper[j] += impulse[i];
            *sums->work += impulse[i] * V[i];
            sums->by_force +=
                s->run.h * o->rule->b[i] * F[i * o->d + j] * V[i];
        }
    }
    return status;
}

int fvi_step_ends(const fvi_stepper *s, const fvi_step_begin *begin,
                  const double *hit, fvi_step_sums *sums)
{
    const size_t d = s->run.system->d,
                 count = fvi_step_dampers(s->run.system);
    sums->by_force = 0;
    memset(sums->work, 0, count * sizeof *sums->work);
    if (fvi_lobatto_matrices_of(s))
        return fvi_lobatto_matrices_ends(s, sums);
    if (s->method->stages)
        return sums_of_stages(s, begin, hit, sums);
    sums_of_nodes(s, begin, hit, sums);
    const int status =
        fvi_has_dampers_of_matrices(s->run.system) ? end_several(s, begin->dampers, sums->damper) : FVI_SUCCESS;
    for (size_t j = 0; fvi_has_dampers_of_matrices(s->run.system) && j < count; j++)
        for (size_t i = 0; i < d; i++)
            sums->work[j] += sums->damper[j * d + i]
                             * ((s->x[i] - begin->x[i]) / s->run.h);
    return status;
}

int fvi_step_work_is_known(const fvi_stepper *s)
{
    const fvi_lobatto_stages *o = s->method_state;
    if (s->method->dense)
        return 0;
    const fvi_run_damper of = fvi_run_damper_of(&s->run, 0);
    if (of.law ? !is_of_order_1(s->method) && of.growth > 1 : of.alpha == 1)
        return 0;
    if (fvi_lobatto_matrices_of(s))
        return !fvi_lobatto_matrices_has_initial_history_force(s);
    if (s->method->stages)
        return o->history_force.size == NULL;
    return is_of_order_1(s->method) || fvi_has_dampers_of_matrices(s->run.system)
           || !fvi_initial_history_acts(s->run.past, s->run.alpha);
}
