/* src/problem/ground.c -- Let the ground move, with coordinates relative to it. */
#include "words.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct fvi_ground {
    size_t d;
    fvi_typed_force *typed;
    fvi_force acceleration, others; /* a_g, one number; the other forces of the system */
    double *load_vector; /* M r, d numbers */
    double *jumps;  /* all times at which one of the two jumps */
    size_t jump_count;
};

static int value(double t, size_t d, void *params, double *F)
{
    const fvi_ground *g = params;
    double ag = 0;
    int status = FVI_SUCCESS;
    if (g->acceleration.value)
        status = g->acceleration.value(t, 1, g->acceleration.params, &ag);
    if (!status && g->others.value)
        status = g->others.value(t, d, g->others.params, F);
    else
        memset(F, 0, d * sizeof *F);
    for (size_t i = 0; i < d; i++)
        F[i] -= g->load_vector[i] * ag;
    return status;
}

static int bound(double from, double to, size_t order, size_t d, void *params,
                 double *most)
{
    const fvi_ground *g = params;
    double of_ground[FVI_BOUND_ORDER + 1] = { 0 };
    int status = FVI_SUCCESS;
    if (g->acceleration.value)
        status = g->acceleration.bound(from, to, order, 1,
                                       g->acceleration.params, of_ground);
    if (!status && g->others.value)
        status =
            g->others.bound(from, to, order, d, g->others.params, most);
    else
        memset(most, 0, (order + 1) * d * sizeof *most);
    for (size_t k = 0; k <= order && !status; k++)
        for (size_t i = 0; i < d; i++)
            if (g->load_vector[i] != 0)
                most[k * d + i] += fabs(g->load_vector[i]) * of_ground[k];
    return status;
}

void fvi_ground_free(fvi_ground *g)
{
    if (!g)
        return;
    fvi_typed_force_free(g->typed);
    free(g->load_vector);
    free(g->jumps);
    free(g);
}

/* Compute M r. */
static int find_load_vector(fvi_ground *g, const fvi_system *system, const double *r,
                            fvi_error *error)
{
    const fvi_matrices *m = system->matrices;
    if (m && !m->inertia)
        return fvi_fail(error, FVI_EUNSUP, "ground", NAN, "these matrices do not tell M times a vector");
    if (m)
        return m->inertia(system->d, r, m->params, g->load_vector);
    for (size_t i = 0; i < system->d; i++)
        g->load_vector[i] = system->mass[i] * r[i];
    return FVI_SUCCESS;
}

static int collect_jumps(fvi_ground *g)
{
    const size_t a = g->acceleration.jump_count, b = g->others.jump_count;
    g->jumps = malloc((a + b + 1) * sizeof *g->jumps);
    if (!g->jumps)
        return FVI_ENOMEM;
    if (a)
        memcpy(g->jumps, g->acceleration.jumps, a * sizeof *g->jumps);
    if (b)
        memcpy(g->jumps + a, g->others.jumps, b * sizeof *g->jumps);
    g->jump_count = a + b;
    return FVI_SUCCESS;
}

int fvi_ground_alloc(const fvi_force *acceleration, const fvi_system *system,
                     const double *r, fvi_ground **ground, fvi_error *error)
{
    if (!acceleration || !system || !r || !ground)
        return fvi_fail(error, FVI_EFAULT, "ground", NAN, "null pointer");
    if (acceleration->impulse_count)
        return fvi_refuse(error, "ground", "an impulse is no acceleration");
    fvi_ground *g = calloc(1, sizeof *g);
    double *load_vector = calloc(system->d, sizeof *load_vector);
    if (!g || !load_vector) {
        free(g);
        free(load_vector);
        return fvi_no_memory(error, "ground");
    }
    *g = (fvi_ground){ .d = system->d,
                       .load_vector = load_vector,
                       .acceleration = *acceleration,
                       .others = system->force };
    int status = find_load_vector(g, system, r, error);
    if (!status && collect_jumps(g))
        status = fvi_no_memory(error, "ground");
    if (status)
        fvi_ground_free(g);
    else
        *ground = g;
    return status;
}

int fvi_parse_ground(const char *text, const fvi_system *system,
                     const double *r, fvi_user_parameters *parameters,
                     double last, fvi_ground **ground, fvi_error *error)
{
    fvi_typed_force *typed = NULL;
    if (!text || !system || !r || !ground)
        return fvi_fail(error, FVI_EFAULT, "ground", NAN, "null pointer");
    int status = fvi_parse_force_of("ground", text, 1, parameters, last, &typed,
                                    error);
    if (status)
        return status;
    const fvi_force acceleration = fvi_force_typed(typed);
    status = acceleration.impulse_count
                 ? fvi_refuse(error, "ground", "'%s': an impulse is no acceleration", text)
                 : fvi_ground_alloc(&acceleration, system, r, ground, error);
    if (status)
        fvi_typed_force_free(typed);
    else
        (*ground)->typed = typed;
    return status;
}

fvi_force fvi_ground_force(const fvi_ground *g)
{
    const int is_bounded = (!g->others.value || g->others.bound)
                           && (!g->acceleration.value || g->acceleration.bound);
    return (fvi_force){ .value = value,
                        .params = (void *)g,
                        .bound = is_bounded ? bound : NULL,
                        .jumps = g->jumps,
                        .jump_count = g->jump_count,
                        .impulses = g->others.impulses,
                        .impulse_count = g->others.impulse_count };
}

const fvi_force *fvi_ground_acceleration(const fvi_ground *g)
{
    return &g->acceleration;
}

const fvi_typed_force *fvi_ground_typed(const fvi_ground *g)
{
    return g->typed;
}

const double *fvi_ground_load_vector(const fvi_ground *g)
{
    return g->load_vector;
}
