/* src/adjoint_forces/adjoint_forces_chain.c -- A chain with a ghost of each coordinate, which F - grad U moves.
 * [H 23] */
#include "adjoint_forces.h"

#include <stdlib.h>
#include <string.h>

/* Coordinate i has the index 2 i, and its ghost follows it, so that a Hessian of few diagonals still has few
 * diagonals. */
typedef struct {
    size_t d;
    const fvi_system *of;
    const fvi_sensitivities *want;
    double *x, *g, *H;
} ghosts;

/* x + y, the point at which U is evaluated. */
static const double *find_evaluation_point(ghosts *o, const double *x)
{
    for (size_t i = 0; i < o->d; i++)
        o->x[i] = x[2 * i] + x[2 * i + 1];
    return o->x;
}

static void write_to_body_and_ghost(const ghosts *o, double *to)
{
    for (size_t i = 0; i < o->d; i++)
        to[2 * i] = to[2 * i + 1] = o->g[i];
}

static int value(size_t d, const double *x, void *params, double *U)
{
    ghosts *o = params;
    (void)d;
    return o->of->potential.value(o->d, find_evaluation_point(o, x), o->of->potential.params, U);
}

static int gradient(size_t d, const double *x, void *params, double *grad)
{
    ghosts *o = params;
    const int status = o->of->potential.gradient(o->d, find_evaluation_point(o, x), o->of->potential.params, o->g);
    (void)d;
    write_to_body_and_ghost(o, grad);
    return status;
}

/* Copy each entry of the Hessian to its four places. */
static void write_full_hessian(const ghosts *o, double *H)
{
    const size_t d = o->d, whole = 2 * d;
    for (size_t i = 0; i < whole; i++)
        for (size_t j = 0; j < whole; j++)
            H[i * whole + j] = o->H[i / 2 * d + j / 2];
}

static void write_band_hessian(const ghosts *o, double *H)
{
    const size_t d = o->d, few = o->of->potential.diagonals, all = 2 * few;
    for (size_t i = 0; i < 2 * d; i++)
        for (size_t k = 0; k < all && i + k < 2 * d; k++) {
            const size_t column = (i + k) / 2 - i / 2;
            H[i * all + k] = column < few ? o->H[i / 2 * few + column] : 0;
        }
}

static int hessian(size_t d, const double *x, void *params, double *H)
{
    ghosts *o = params;
    const int status = o->of->potential.hessian(o->d, find_evaluation_point(o, x), o->of->potential.params, o->H);
    (void)d;
    (o->of->potential.diagonals ? write_band_hessian : write_full_hessian)(o, H);
    return status;
}

static int is_quadratic(const void *params)
{
    const ghosts *o = params;
    const fvi_potential *U = &o->of->potential;
    return U->quadratic && U->quadratic(U->params);
}

static int column(size_t j, size_t d, const double *x, void *params, double *S)
{
    ghosts *o = params;
    const int status = o->want->sensitivity.column(j, o->d, find_evaluation_point(o, x), o->of->potential.params, o->g);
    (void)d;
    write_to_body_and_ghost(o, S);
    return status;
}

typedef struct {
    ghosts o;
    double *room;
} parts;

static void stop(void *params)
{
    parts *all = params;
    free(all->room);
    free(all);
}

static void describe(fvi_walls *w, ghosts *o)
{
    const fvi_potential *U = &o->of->potential;
    if (U->gradient)
        w->system.potential = (fvi_potential){ .value = value,
                                               .gradient = gradient,
                                               .hessian = hessian,
                                               .params = o,
                                               .quadratic = U->quadratic ? is_quadratic : NULL,
                                               .diagonals = 2 * U->diagonals };
    w->sensitivity = o->want->sensitivity;
    if (w->sensitivity.column)
        w->sensitivity.column = column;
}

int fvi_walls_of_chain(fvi_walls *w, const fvi_run *run, const fvi_sensitivities *want)
{
    const size_t d = run->system->d;
    int status = fvi_walls_places(w, d, d, 2 * d);
    if (status)
        return status;
    for (size_t i = 0; i < d; i++) {
        w->index[i] = 2 * i;
        w->wall[i] = 2 * i + 1;
    }
    w->is_ghost = 1;
    parts *all = w->parts = calloc(1, sizeof *all);
    if (!all)
        return FVI_ENOMEM;
    w->stop = stop;
    all->room = malloc((2 * d + fvi_potential_hessian_size(run->system)) * sizeof *all->room);
    if (!all->room)
        return FVI_ENOMEM;
    all->o = (ghosts){ .d = d, .of = run->system, .want = want,
                       .x = all->room, .g = all->room + d, .H = all->room + 2 * d };
    status = fvi_walls_allocate(w, run);
    if (!status) {
        describe(w, &all->o);
        status = fvi_walls_force(w, &run->system->force);
    }
    return status;
}
