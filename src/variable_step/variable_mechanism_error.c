/* src/variable_step/variable_mechanism_error.c -- Estimate the error of a step of a mechanism. [H 29, 22] */
#include "variable_mechanism.h"

#include "system/dot.h"
#include "system/larger.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Return the last Legendre coefficient of h v', by the values v at the stages and `first` at the start of the step. */
static double last_coefficient(const fvi_variable_step_state *o, const double *v, size_t stride,
                               double first)
{
    const size_t n = o->rule->s;
    double change[FVI_LANES] = { 0 }, all[FVI_LANES];
    for (size_t i = 0; i < n; i++)
        change[i] = v[i * stride] - first;
    fvi_square_apply(n, &o->rule->legendre, change, all);
    return fabs(all[n - 1]);
}

/* Return the effect of the memory of damper e on v_j for a last coefficient of 1: M^{-1} G lambda. (22.16) */
static double leak_of_damper(const fvi_stepper *s, const fvi_variable_step_state *o, size_t e,
                             size_t j)
{
    const fvi_mesh_damper *of = &o->mechanism->damper[e];
    const double *G = s->mechanism->gradient + ((o->rule->s - 1) * s->mechanism->r + e) * o->d;
    return of->leakage * of->rho * pow(o->length.h, 1 - of->beta)
           * fabs(fvi_dot(o->d, o->mechanism->inverse + j * o->d, G));
}

/* Project the velocities at the stages onto the hidden constraint: s d numbers, and G v of the dampers, s r numbers,
 * behind them. The velocities of the stages themselves satisfy it to a lower order, but this error does not enter the
 * end of the step. */
static int project_stages(fvi_stepper *s, double *v)
{
    const fvi_mechanism_state *of = s->mechanism;
    const size_t d = of->d, r = of->r, m = of->m;
    double *C = malloc((m * (d + 1) + d) * sizeof *C), *w = C + m * d, *p = w + m;
    int status = C ? FVI_SUCCESS : FVI_ENOMEM;
    memcpy(v, of->V, of->s * d * sizeof *v);
    for (size_t i = 0; i < of->s && !status; i++) {
        const double t = fvi_mechanism_stage_time(s, i), *x = of->X + i * d;
        double *zdot = v + of->s * d + i * r;
        memcpy(p, of->Lv + i * d, d * sizeof *p);
        status = fvi_mechanism_tie_gradients(s, t, x, C, NULL);
        if (!status)
            status = fvi_mechanism_project_momentum(s, t, x, C, p, v + i * d, w);
        for (size_t e = 0; e < r; e++) {
            zdot[e] = 0;
            for (size_t j = 0; j < d; j++)
                zdot[e] += of->gradient[(i * r + e) * d + j] * v[i * d + j];
        }
    }
    free(C);
    return status;
}

/* Return the error of the step, as in variable_steps.c. A coordinate without inertia keeps no velocity, so an error of
 * its velocity moves it no farther than this step. If a force jumps and the dampers of the coordinate answer stiffly at
 * once, its position jumps within the shortest step. The end of this step is right, but its polynomial does not show
 * the error, so this coordinate does not count. v: velocities of the stages; zdot: rates of dampers, stage i of damper
 * e at [i * by_stage + e * by_damper]. */
//> estimate
static double estimate_error(const fvi_stepper *s, const fvi_variable_step_state *o, const double *v,
                             const double *zdot, size_t by_stage, size_t by_damper)
{
    const double h = o->length.h, reach = o->T - o->t;
    const int may_jump = o->first_after_event && h <= o->least;
    double worst = 0;
    for (size_t j = 0; j < o->d; j++) {
        const double last = last_coefficient(o, v + j, o->d, o->v[j]);
        double of_v = s->mechanism->is_massless[j] ? 0 : o->rule->alias * last;
        for (size_t e = 0; e < o->mechanism->r; e++)
            of_v += leak_of_damper(s, o, e, j)
                    * last_coefficient(o, zdot + e * by_damper, by_stage, o->mechanism->damper[e].now);
        const double of_x = may_jump && s->mechanism->is_massless[j] ? 0 : o->rule->stage * h * last;
        worst = larger(worst, of_x + reach * of_v);
    }
    return worst;
}
//< estimate

int fvi_mesh_estimate(fvi_stepper *s, const fvi_variable_step_state *o, double *error)
{
    const fvi_mechanism_state *of = s->mechanism;
    if (of->m == 0) {
        *error = estimate_error(s, o, of->V, of->zdot, 1, of->s);
        return FVI_SUCCESS;
    }
    double *v = malloc(of->s * (of->d + of->r) * sizeof *v);
    if (!v)
        return FVI_ENOMEM;
    const int status = project_stages(s, v);
    *error = status ? 0 : estimate_error(s, o, v, v + of->s * of->d, of->r, 1);
    free(v);
    if (status)
        return status == FVI_EOVRFLW ? FVI_EMAXITER : status;
    return fvi_mesh_contact_error(s, o, error);
}
