/* src/adjoint_forces/adjoint_forces_walls.c -- The parts that all runs with walls have in common. [H 23] */
#include "adjoint_forces.h"

#include <stdint.h>
#include <stdlib.h>

int fvi_walls_places(fvi_walls *w, size_t d, size_t n, size_t whole)
{
    w->d = d;
    w->n = n;
    w->whole = whole;
    w->index = malloc((d + n + 1) * sizeof *w->index);
    if (!w->index)
        return FVI_ENOMEM;
    w->wall = w->index + d;
    for (size_t i = 0; i < d; i++)
        w->index[i] = i;
    for (size_t i = 0; i < n; i++)
        w->wall[i] = SIZE_MAX;
    return FVI_SUCCESS;
}

int fvi_walls_allocate(fvi_walls *w, const fvi_run *run)
{
    const fvi_system *of = run->system;
    const size_t d = w->d, whole = w->whole;
    w->numbers = calloc(4 * whole, sizeof *w->numbers);
    if (!w->numbers)
        return FVI_ENOMEM;
    w->mass = w->numbers;
    w->damping = w->mass + whole;
    w->x0 = w->damping + whole;
    w->p0 = w->x0 + whole;
    for (size_t i = 0; i < whole; i++)
        w->mass[i] = FVI_WALL_MASS;
    for (size_t i = 0; i < d; i++) {
        w->mass[w->index[i]] = of->mass ? of->mass[i] : 1; /* with a Lagrangian the masses are not read */
        w->damping[w->index[i]] = of->damping ? of->damping[i] : 0;
        w->x0[w->index[i]] = run->x0[i];
        w->p0[w->index[i]] = run->p0[i];
    }
    w->system = (fvi_system){ .d = whole, .mass = w->mass, .damping = w->damping };
    w->run = *run;
    w->run.system = &w->system;
    w->run.x0 = w->x0;
    w->run.p0 = w->p0;
    return FVI_SUCCESS;
}

/* Copy a force or an impulse to the coordinates and their ghosts. */
static void copy_force(const fvi_walls *w, const double *F, double *to)
{
    for (size_t i = 0; i < w->whole; i++)
        to[i] = 0;
    for (size_t i = 0; i < w->d; i++) {
        to[w->index[i]] = F[i];
        if (w->is_ghost)
            to[w->wall[i]] = F[i];
    }
}

static int force(double t, size_t d, void *params, double *F)
{
    const fvi_walls *w = params;
    (void)d;
    const int status = w->force->value(t, w->d, w->force->params, w->F);
    copy_force(w, w->F, F);
    return status;
}

int fvi_walls_force(fvi_walls *w, const fvi_force *of)
{
    const size_t count = of->impulse_count, whole = w->whole;
    w->force = of;
    w->F = calloc(w->d + count * whole, sizeof *w->F);
    w->impulses = calloc(count + 1, sizeof *w->impulses);
    if (!w->F || !w->impulses)
        return FVI_ENOMEM;
    for (size_t k = 0; k < count; k++) {
        double *J = w->F + w->d + k * whole;
        copy_force(w, of->impulses[k].J, J);
        w->impulses[k] = (fvi_impulse){ .t = of->impulses[k].t, .J = J };
    }
    w->system.force = (fvi_force){ .value = of->value ? force : NULL,
                                   .params = w,
                                   .jumps = of->jumps,
                                   .jump_count = of->jump_count,
                                   .impulses = w->impulses,
                                   .impulse_count = count };
    return FVI_SUCCESS;
}

void fvi_walls_free(fvi_walls *w)
{
    if (w->stop)
        w->stop(w->parts);
    free(w->impulses);
    free(w->F);
    free(w->numbers);
    free(w->index);
}
