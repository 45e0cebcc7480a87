/* src/variable_step/variable_mechanism_impact.c -- Jumps of the momenta of a mechanism. [H 29, 22]
 *
 * With the normal n = dZ/dx an impact is p+ = p + lambda n. It multiplies the speed of Z by -e:
 *
 *     n . v(p + lambda n) = n . v(p) - (1 + e) (n . v(p) + dZ/dt).       (29.20)
 *
 * Constraints add impulses of their own:
 *
 *     p+ = p + lambda n - C^T w,   C v(p+) + c_t = 0.    (29.22) */
#include "variable_mechanism.h"

#include "system/lagrangian_point.h"
#include "system/dot.h"
#include "system/larger.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

/* Compute v of p at the end of the last step. With constraints, add their impulses to p, and to tie unless it is
 * NULL. */
static int project_on_constraints(fvi_stepper *s, double t, const double *x, double *p, double *v,
                                  double *tie)
{
    const fvi_mechanism_state *of = s->mechanism;
    if (of->m == 0)
        return fvi_velocity_of_momentum(s->run.system, t, x, p, v);
    double *w = of->residual;
    const int status = fvi_mechanism_project_momentum(s, t, x, of->C, p, v, w);
    for (size_t l = 0; l < of->m && tie; l++)
        tie[l] += w[l];
    return status;
}

/* The impulse of a contact is -w along its normal. It must push to the side where the body is. */
int fvi_mesh_find_tensile_contact(fvi_stepper *s, fvi_variable_step_state *o, const double *J,
                                  double factor, const double *side, size_t *event)
{
    fvi_mechanism_state *of = s->mechanism;
    double *p = o->mechanism->slope, *v = p + o->d; /* slope has been read */
    *event = SIZE_MAX;
    if (of->m == of->permanent)
        return FVI_SUCCESS;
    for (size_t j = 0; j < o->d; j++)
        p[j] = s->p[j] + factor * J[j];
    memcpy(v, o->v, o->d * sizeof *v);
    const int status = project_on_constraints(s, o->t, o->y, p, v, NULL);
    const double jump = fabs(factor) * largest_abs(o->d, J),
                 least = 1e-12 * (jump + largest_abs(o->d, s->p));
    double worst = 0;
    for (size_t l = of->permanent; l < of->m && !status; l++) {
        const size_t i = of->contact[l - of->permanent];
        const double tension = side[i] * of->residual[l]
                            * largest_abs(o->d, of->C + l * o->d);
        if (tension > least && tension > worst) {
            worst = tension;
            *event = i;
        }
    }
    return status;
}

int fvi_mesh_jump(fvi_stepper *s, fvi_variable_step_state *o, const double *J,
                  double factor)
{
    fvi_mechanism_state *of = s->mechanism;
    double *v = o->mechanism->slope; /* slope has been read */
    memcpy(v, o->v, o->d * sizeof *v);
    for (size_t j = 0; j < o->d; j++)
        s->p[j] += factor * J[j];
    const int status = project_on_constraints(s, o->t, o->y, s->p, v, of->tie);
    for (size_t j = 0; j < o->d && !status; j++) {
        for (size_t e = 0; e < o->mechanism->r; e++)
            o->mechanism->damper[e].now += of->G[e * o->d + j] * (v[j] - o->v[j]);
        o->v[j] = of->v[j] = v[j];
    }
    return status;
}

int fvi_mesh_apply_impulse(fvi_stepper *s, fvi_variable_step_state *o, const double *J)
{
    double *made = o->mechanism->slope + o->d; /* with the impulses of the constraints */
    memcpy(made, s->p, o->d * sizeof *made);
    const int status = fvi_mesh_jump(s, o, J, 1);
    if (status || o->t == 0) /* the energy at the start contains it */
        return status;
    for (size_t j = 0; j < o->d; j++)
        made[j] = s->mechanism->m ? s->p[j] - made[j] : J[j];
    return fvi_mechanism_work_of_impulse(s, o->t, o->y, s->p, made, &o->mechanism->by_force);
}

/* ---- impacts ---- */

int fvi_mesh_inverse_along(fvi_stepper *s, const double *normal, const double *v,
                           double *inverse)
{
    fvi_mechanism_state *of = s->mechanism;
    const size_t d = of->d, n = d + of->m;
    double *r = of->room + n * n, *Lvv = r + n;
    int status = fvi_lagrangian_point(s->run.system, s->t, s->x, v, NULL, NULL, NULL, NULL, NULL,
                                      Lvv);
    memset(r, 0, n * sizeof *r);
    memcpy(r, normal, d * sizeof *r);
    if (!status)
        status = fvi_mesh_answer(of, Lvv, of->C, r);
    *inverse = status ? 0 : fvi_dot(d, normal, r);
    return status;
}

//> impact
/* Solve by Newton's method. If L is quadratic in v, the guess is right up to rounding errors, and the corrections are
 * rounding errors that do not fall. */
int fvi_mesh_impact(fvi_stepper *s, const double *normal, const double *v, double change,
                    double *lambda)
{
    enum { MOST = 30 };
    const fvi_variable_step_state *o = s->method_state;
    const size_t d = o->d;
    double *p = o->mechanism->slope, *w = p + d; /* slope has been read */
    const double wanted = fvi_dot(d, normal, v) + change;
    double before = INFINITY;
    memcpy(w, v, d * sizeof *w);
    for (int i = 0; i < MOST; i++) {
        double inverse;
        for (size_t j = 0; j < d; j++)
            p[j] = s->p[j] + *lambda * normal[j];
        int status = project_on_constraints(s, s->t, s->x, p, w, NULL);
        if (!status)
            status = fvi_mesh_inverse_along(s, normal, w, &inverse);
        if (status)
            return status;
        const double more = (wanted - fvi_dot(d, normal, w)) / inverse;
        if (!isfinite(more))
            return FVI_EOVRFLW;
        *lambda += more;
        if (fabs(more) <= 16 * DBL_EPSILON * fabs(*lambda) || fabs(more) >= before / 2)
            return FVI_SUCCESS;
        before = fabs(more);
    }
    return FVI_EMAXITER;
}
//< impact
