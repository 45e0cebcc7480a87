/* src/command_gradient/fvi_gradient_forces.c -- Add what forces and the ground contribute to a gradient. */
#include "fvi_gradient_forces.h"

#include <float.h>
#include <math.h>

typedef fvi_gradient_request request;

/* Return the sum of row k of the derivatives by the force, each multiplied by -load_vector[i], or by 1 if load_vector
 * is NULL. */
static double sum_of_forces(const request *r, size_t k, const double *load_vector)
{
    double sum = 0;
    for (size_t i = 0; i < r->o.d; i++)
        sum += (load_vector ? -load_vector[i] : 1) * r->force[k * r->o.d + i];
    return sum;
}

/* Write the times at which a step evaluates the force of row k. A method of order 2 or more evaluates the force of a
 * node from within the steps on both sides, so at a jump it uses both limits. Return the number of times, 1 or 2. */
static size_t times_of_row(const request *r, size_t k, double t[2])
{
    const double at = fvi_gradient_row_time(r, k);
    t[0] = t[1] = at;
    if (r->o.method->highest == 1 || k % r->per > 0)
        return 1;
    const double in = 4 * DBL_EPSILON, after = fmax(at * (1 + in), DBL_MIN);
    t[0] = k > 0 ? at * (1 - in) : after;
    t[1] = k < r->o.steps * r->per ? after : t[0];
    return k > 0 && k < r->o.steps * r->per ? 2 : 1;
}

/* Return the mean of the values on both sides of a node. In form D the two sides move the body differently. So if they
 * differ there is no derivative, and *is_lost is set. */
static double mean_of_sides(const request *r, const double *side, size_t sides, int *is_lost)
{
    if (sides == 2 && r->o.method->damped_inertia
        && fabs(side[0] - side[1]) > 1e-9 * (fabs(side[0]) + fabs(side[1])))
        *is_lost = 1;
    return sides == 2 ? (side[0] + side[1]) / 2 : side[0];
}

static double by_parameter(request *r, const fvi_typed_force *of, size_t j, size_t k)
{
    double t[2], side[2] = { 0 };
    const size_t sides = times_of_row(r, k, t);
    for (size_t i = 0; i < sides; i++)
        side[i] = fvi_typed_force_by_parameter(of, j, t[i]);
    return mean_of_sides(r, side, sides, &r->is_jumped[j]);
}

/* A --let may stand in the force and in the acceleration of the ground. */
void fvi_gradient_add_forces(request *r)
{
    const fvi_typed_force *ground = r->o.ground ? fvi_ground_typed(r->o.ground) : NULL;
    for (size_t j = 0; fvi_gradient_force_has_lets(r) && j < r->o.lets.count; j++)
        for (size_t k = 0; k <= r->o.steps * r->per; k++) {
            if (r->o.force)
                r->lets[j] += by_parameter(r, r->o.force, j, k) * sum_of_forces(r, k, NULL);
            if (ground)
                r->lets[j] += by_parameter(r, ground, j, k)
                              * sum_of_forces(r, k, fvi_ground_load_vector(r->o.ground));
        }
}

/* The force of the ground is -M r a_g, so it depends on each mass, or on a factor of M. */
int fvi_gradient_add_ground(request *r)
{
    const size_t d = r->o.d;
    int status = 0;
    if (!r->o.ground || !r->to.mass)
        return status;
    const fvi_force *ag = fvi_ground_acceleration(r->o.ground);
    const double *load_vector = fvi_ground_load_vector(r->o.ground);
    for (size_t k = 0; !status && k <= r->o.steps * r->per; k++) {
        double t[2], side[2] = { 0 };
        const size_t sides = times_of_row(r, k, t);
        for (size_t i = 0; i < sides && !status && ag->value; i++)
            status = ag->value(t[i], 1, ag->params, &side[i]);
        const double a = mean_of_sides(r, side, sides, &r->ground_jumps);
        if (r->system.matrices)
            *r->to.mass += a * sum_of_forces(r, k, load_vector);
        for (size_t i = 0; !r->system.matrices && i < d; i++)
            r->to.mass[i] -= a * load_vector[i] / r->o.mass[i] * r->force[k * d + i];
    }
    return status;
}
