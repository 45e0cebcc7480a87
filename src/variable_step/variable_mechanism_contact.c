/* src/variable_step/variable_mechanism_contact.c -- The forces of closed contacts of a mechanism. [H 29, 22] */
#include "variable_mechanism.h"

#include "system/larger.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* Compute Lambda at the stages. */
static void forces_at_stages(const fvi_stepper *s, const fvi_variable_step_state *o, size_t l,
                             double *force)
{
    const fvi_mechanism_state *of = s->mechanism;
    const double h = o->length.h;
    for (size_t i = 0; i < o->rule->s; i++)
        force[i] = of->u[o->rule->s * of->d + i * of->m + l] / (h * h * o->rule->b[i]);
}

double fvi_mesh_contact_force(const fvi_stepper *s, const fvi_variable_step_state *o, size_t l,
                              double theta)
{
    double force[FVI_LANES] = { 0 }, legendre[FVI_LANES], g[FVI_LANES], sum = 0;
    forces_at_stages(s, o, l, force);
    fvi_mesh_coefficients(o, force, legendre);
    fvi_variable_step_powers(o->rule->s, legendre, g);
    for (size_t n = o->rule->s; n-- > 0;)
        sum = sum * theta + g[n];
    return sum;
}

/* The position n . x has rounding errors. Divided by h^2 they are accelerations, and times a mass they are forces. */
double fvi_mesh_contact_noise(const fvi_stepper *s, const fvi_variable_step_state *o, size_t l)
{
    const fvi_mechanism_state *of = s->mechanism;
    const double *normal = of->C + l * of->d, h = o->length.h;
    double size = 0, mass = 0;
    for (size_t j = 0; j < of->d; j++) {
        size += fabs(normal[j] * s->x[j]);
        if (normal[j] != 0 && isfinite(o->group[j].mass))
            mass = larger(mass, o->group[j].mass / (normal[j] * normal[j]));
    }
    return 64 * DBL_EPSILON * size * mass / (h * h * o->rule->b[0]);
}

/* Compute the largest acceleration M^{-1} n of a coordinate for Lambda = 1 in row l, with the contacts open. */
static int answer_to_contact(fvi_stepper *s, const fvi_variable_step_state *o, size_t l, double *most)
{
    fvi_mechanism_state *of = s->mechanism;
    const size_t d = of->d, m = of->m;
    double *r = of->room + (d + of->most) * (d + of->most);
    memset(r, 0, (d + of->most) * sizeof *r);
    memcpy(r, of->C + l * d, d * sizeof *r);
    of->m = of->permanent;
    const int status = fvi_mesh_answer(of, of->Lvv + (o->rule->s - 1) * d * d, of->C, r);
    of->m = m;
    *most = largest_abs(d, r);
    return status;
}

int fvi_mesh_contact_error(fvi_stepper *s, const fvi_variable_step_state *o, double *error)
{
    const fvi_mechanism_state *of = s->mechanism;
    const double h = o->length.h;
    int status = FVI_SUCCESS;
    for (size_t l = of->permanent; l < of->m && !status; l++) {
        double force[FVI_LANES] = { 0 }, legendre[FVI_LANES], most = 0;
        forces_at_stages(s, o, l, force);
        fvi_mesh_coefficients(o, force, legendre);
        const double last = fabs(legendre[o->rule->s - 1]) - fvi_mesh_contact_noise(s, o, l);
        status = answer_to_contact(s, o, l, &most);
        if (last > 0)
            *error = larger(*error, o->rule->stage * h * h * last * most);
    }
    return status;
}
