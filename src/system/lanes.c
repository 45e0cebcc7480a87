/* src/system/lanes.c -- Evaluate potentials and forces of several oscillators as lanes of a vector.  [H 28] */
#include "lanes.h"

#include "quadratic.h"

#include <stdlib.h>
#include <string.h>

/* ---- potentials ---- */

/* Call the potential of each active lane by itself. */
static int slopes_one_by_one(const fvi_lanes *lanes, const double *x, const double *active,
                             double *g, double *H)
{
    int status = FVI_SUCCESS;
    for (size_t l = 0; l < lanes->count && !status; l++) {
        const fvi_potential *u = &lanes->system[l]->potential;
        if (active[l] == 0)
            continue;
        status = u->gradient(1, x + l, u->params, g + l);
        if (!status && H)
            status = u->hessian(1, x + l, u->params, H + l);
    }
    return status;
}

int fvi_lanes_slopes(const fvi_lanes *lanes, const double *x, const double *active,
                     double *g, double *H)
{
    if (!lanes->potential)
        return slopes_one_by_one(lanes, x, active, g, H);
    lanes->system[0]->potential.lanes->evaluate(lanes->potential, x, active, g, H);
    return FVI_SUCCESS;
}

static const double all_active[FVI_MOST_LANES] = { 1, 1, 1, 1, 1, 1, 1, 1 };

static int potential_value(size_t d, const double *x, void *params, double *value)
{
    const fvi_lanes *lanes = params;
    int status = FVI_SUCCESS;
    *value = 0;
    for (size_t l = 0; l < d && !status; l++) {
        double one;
        status = fvi_potential_value(lanes->system[l], x + l, &one);
        *value += one;
    }
    return status;
}

static int potential_gradient(size_t d, const double *x, void *params, double *grad)
{
    double all[FVI_MOST_LANES] = { 0 }, g[FVI_MOST_LANES];
    memcpy(all, x, d * sizeof *x);
    const int status = fvi_lanes_slopes(params, all, all_active, g, NULL);
    memcpy(grad, g, d * sizeof *g);
    return status;
}

static int potential_hessian(size_t d, const double *x, void *params, double *H)
{
    double all[FVI_MOST_LANES] = { 0 }, g[FVI_MOST_LANES], slope[FVI_MOST_LANES];
    memcpy(all, x, d * sizeof *x);
    const int status = fvi_lanes_slopes(params, all, all_active, g, slope);
    memcpy(H, slope, d * sizeof *slope);
    return status;
}

/* The address of this object marks the potential of a common system. Its functions are NULL, because no lane is itself
 * a common system. */
const fvi_lane_functions fvi_lanes_together = { NULL, NULL, NULL, NULL };

/* Either the potentials of all lanes are quadratic or no potential is, so the first lane decides. */
static int is_quadratic(const void *params)
{
    return fvi_potential_is_quadratic(&((const fvi_lanes *)params)->system[0]->potential);
}

fvi_potential fvi_lanes_potential(fvi_lanes *lanes)
{
    return lanes->system[0]->potential.gradient
               ? (fvi_potential){ .value = potential_value,
                                  .gradient = potential_gradient,
                                  .hessian = potential_hessian,
                                  .params = lanes,
                                  .quadratic = is_quadratic,
                                  .diagonals = 1,
                                  .lanes = &fvi_lanes_together }
               : (fvi_potential){ 0 };
}

/* ---- forces ---- */

static int force_value(double t, size_t d, void *params, double *F)
{
    const fvi_lanes *lanes = params;
    int status = FVI_SUCCESS;
    if (lanes->force) {
        double times[FVI_MOST_LANES], all[FVI_MOST_LANES];
        for (size_t l = 0; l < FVI_MOST_LANES; l++)
            times[l] = t;
        lanes->system[0]->force.lanes->evaluate(lanes->force, times, NULL, all, NULL);
        if (d == FVI_MOST_LANES) /* for a constant size the compiler makes one vector move instead of a call */
            memcpy(F, all, sizeof all);
        else
            memcpy(F, all, d * sizeof *F);
        return FVI_SUCCESS;
    }
    for (size_t l = 0; l < d && !status; l++) {
        const fvi_force *force = &lanes->system[l]->force;
        status = force->value(t, 1, force->params, F + l);
    }
    return status;
}

fvi_force fvi_lanes_force(fvi_lanes *lanes)
{
    return lanes->system[0]->force.value ? (fvi_force){ .value = force_value, .params = lanes }
                                         : (fvi_force){ 0 };
}

/* ---- preparation ---- */

/* Read 1 or 2 numbers of each lane. The lanes behind the last one repeat the last one. */
static int prepare_numbers(size_t numbers, size_t count, void *const *params, void **prepared)
{
    fvi_lane_pairs *p = malloc(sizeof *p);
    if (!p)
        return FVI_ENOMEM;
    p->has_one_second = 1;
    for (size_t l = 0; l < FVI_MOST_LANES; l++) {
        const double *of = params[l < count ? l : count - 1];
        p->first[l] = of[0];
        p->second[l] = numbers > 1 ? of[1] : 0;
        p->has_one_second = p->has_one_second && p->second[l] == p->second[0];
    }
    *prepared = p;
    return FVI_SUCCESS;
}

int fvi_lane_pairs_prepare(size_t count, void *const *params, void **prepared)
{
    return prepare_numbers(2, count, params, prepared);
}

int fvi_lane_numbers_prepare(size_t count, void *const *params, void **prepared)
{
    return prepare_numbers(1, count, params, prepared);
}

/* Prepare the functions if all lanes have the same ones. Otherwise, and if `prepare` returns FVI_EUNSUP, leave
 * *prepared = NULL: then each lane calls its own function. */
static int prepare(const fvi_lanes *lanes, const fvi_lane_functions *const *functions,
                   void *const *params, void **prepared)
{
    *prepared = NULL;
    for (size_t l = 0; l < lanes->count; l++)
        if (!functions[l] || functions[l] != functions[0])
            return FVI_SUCCESS;
    const int status = functions[0]->prepare(lanes->count, params, prepared);
    return status == FVI_EUNSUP ? FVI_SUCCESS : status;
}

int fvi_lanes_prepare(fvi_lanes *lanes)
{
    const fvi_lane_functions *of_potential[FVI_MOST_LANES], *of_force[FVI_MOST_LANES];
    void *potential[FVI_MOST_LANES], *force[FVI_MOST_LANES];
    for (size_t l = 0; l < lanes->count; l++) {
        const fvi_system *system = lanes->system[l];
        of_potential[l] = system->potential.lanes;
        potential[l] = system->potential.params;
        of_force[l] = system->force.lanes;
        force[l] = system->force.params;
    }
    int status = prepare(lanes, of_potential, potential, &lanes->potential);
    if (!status)
        status = prepare(lanes, of_force, force, &lanes->force);
    if (status)
        fvi_lanes_discard(lanes);
    return status;
}

void fvi_lanes_discard(fvi_lanes *lanes)
{
    const fvi_system *first = lanes->system[0];
    if (lanes->potential)
        first->potential.lanes->discard(lanes->potential);
    if (lanes->force)
        first->force.lanes->discard(lanes->force);
    lanes->potential = lanes->force = NULL;
}
