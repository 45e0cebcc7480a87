/* src/tangent/tangent_nodes.c -- A step of the derivatives by a method without stages. [H 24] */
#include "tangent.h"

#include <string.h>

/* ---- inertia, the potential and the force ---- */

/* x_{k+1} - x_k, or M times it. A change of the masses multiplies it. */
static int inertia(const fvi_tangent_run *o, double *moved)
{
    const fvi_matrices *m = o->run->system->matrices;
    double *dx = m ? o->room : moved;
    for (size_t i = 0; i < o->d; i++)
        dx[i] = o->stepper->x[i] - o->x_k[i];
    return m && m->inertia ? m->inertia(o->d, dx, m->params, moved) : FVI_SUCCESS;
}

static double mass_along(const fvi_tangent_run *o, size_t j, size_t i)
{
    const double *mass = o->along[j].mass;
    return mass ? mass[o->run->system->matrices ? 0 : i] : 0;
}

/* Subtract the change of the force. In Algorithm 3 the force of node k + 1 acts whole behind the step, and node 0 has
 * none. In the other methods half of the force of a node belongs to each step beside it. */
static void add_force(fvi_tangent_run *o, size_t k, size_t j)
{
    const double *F = o->along[j].force, h = o->run->h;
    const int is_first_order = o->method->paper_convention;
    for (size_t i = 0; F && i < o->d; i++) {
        o->left[j * o->d + i] -= is_first_order ? 0 : h / 2 * F[k * o->d + i];
        o->right[j * o->d + i] -= (is_first_order ? h : h / 2) * F[(k + 1) * o->d + i];
    }
}

static int find_losses(fvi_tangent_run *o, size_t k)
{
    const double h = o->run->h, kappa = o->kappa;
    double *moved = o->V;
    int status = inertia(o, moved);
    for (size_t j = 0; j < o->P; j++) {
        for (size_t i = 0, n = j * o->d; i < o->d; i++, n++) {
            const double by_mass = mass_along(o, j, i) * moved[i] / h;
            o->left[n] = kappa * h * o->dU[n] + by_mass;
            o->right[n] = (1 - kappa) * h * o->dU[n] - by_mass;
        }
        add_force(o, k, j);
    }
    for (size_t l = 0; !status && l < o->dampers; l++) {
        status = fvi_tangent_damper_next(o, k + 1, o->each + l);
        if (!status)
            status = fvi_tangent_damper_impulses(o, k, o->each + l);
    }
    return status;
}

static void subtract(fvi_tangent_run *o, const double *lost)
{
    for (size_t l = 0; l < o->tangents; l++)
        for (size_t q = 0; q < o->width; q++)
            o->tangent[l]->p[q] -= *lost++;
}

/* ---- a step ---- */

//> tangent
/* A step of (24.6). The derivative of the equation of a step is linear, and it is the equation of a step of the
 * linearised run. All other changes that a direction makes are impulses. The impulses in the equation for x_{k+1} are
 * subtracted before the step, and the impulses in p_{k+1} after it. */
int fvi_tangent_nodes_step(fvi_tangent_run *o)
{
    fvi_stepper *s = o->stepper;
    const double kappa = o->kappa;
    const size_t k = s->k;
    memcpy(o->x_k, s->x, o->d * sizeof *o->x_k);
    int status = fvi_stepper_step(s);
    for (size_t i = 0; i < o->d; i++)
        o->X[i] = kappa * o->x_k[i] + (1 - kappa) * s->x[i];
    if (!status)
        status = fvi_tangent_evaluate_potential(o, 0, o->X);
    if (!status)
        status = find_losses(o, k);
    if (!status)
        subtract(o, o->left);
    for (size_t l = 0; !status && l < o->tangents; l++)
        status = fvi_stepper_step(o->tangent[l]);
    if (!status)
        subtract(o, o->right);
    return status;
}
//< tangent
