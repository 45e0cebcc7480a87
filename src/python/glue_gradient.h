/* src/python/glue_gradient.h -- What gradients in Python have of C besides the library. */
#ifndef FVI_GLUE_GRADIENT_H
#define FVI_GLUE_GRADIENT_H
#include <fvi/fvi.h>
#include <stdlib.h>
#include <string.h>
/* The cotangents of every row, as arrays: no Python in the adjoint run. */
typedef struct {
    const double *Jx, *Jp; /* Jp may be NULL */
} cotangents;
static int read_slopes(size_t k, size_t d, const double *x, const double *p, void *params, double *Jx, double *Jp)
{
    const cotangents *c = params;
    (void)x, (void)p;
    for (size_t i = 0; i < d; i++)
        Jx[i] += c->Jx[k * d + i];
    for (size_t i = 0; Jp && c->Jp && i < d; i++)
        Jp[i] += c->Jp[k * d + i];
    return 0;
}
/* d^2U/(dx dk_j) of an expression, as fvi_parameter_gradient has it. */
static int by_parameter(size_t j, size_t d, const double *x, void *params, double *S)
{
    double value;
    (void)d;
    fvi_expression_parameter_gradient(params, j, x, &value, S);
    return 0;
}
/* E = v . L_v - L by p, which is v, and by x, which is -L_x, at the time t. room: a guess of v, and 2 d numbers in
 * all. */
static int slopes_of_energy(const fvi_system *system, double t, const double *x, const double *p, double *room)
{
    const fvi_lagrangian *L = system->mechanism ? system->mechanism->lagrangian : NULL;
    const size_t d = system->d;
    if (!L) {
        const int status = fvi_potential_gradient(system, x, room);
        if (status || system->matrices || !system->mechanism)
            return status ? status : fvi_velocity(system, p, room + d);
        for (size_t i = 0; i < d; i++) /* without inertia p does not count */
            room[d + i] = system->mass[i] > 0 ? p[i] / system->mass[i] : 0;
        return FVI_SUCCESS;
    }
    int status = fvi_velocity_of_momentum(system, t, x, p, room + d);
    if (!status)
        status = L->at(t, d, x, room + d, L->params, NULL, room, NULL, NULL, NULL, NULL);
    for (size_t i = 0; i < d; i++)
        room[i] = -room[i];
    return status;
}
/* What an objective that has by[k] of the energies has of x and p, added. */
static int energy_slopes(const fvi_system *system, size_t rows, const double *t, const double *x, const double *p,
                         const double *by, double *Jx, double *Jp)
{
    const size_t d = system->d;
    double *room = calloc(2 * d, sizeof *room);
    int status = room ? 0 : FVI_ENOMEM;
    for (size_t k = 0; k < rows && !status; k++) {
        if (by[k] == 0)
            continue;
        status = slopes_of_energy(system, t[k], x + k * d, p + k * d, room);
        for (size_t i = 0; i < d; i++) {
            Jx[k * d + i] += by[k] * room[i];
            Jp[k * d + i] += by[k] * room[d + i];
        }
    }
    free(room);
    return status;
}
/* Of a typed Lagrangian: at x and p E falls by what L grows with a parameter; added to `parameters`, n numbers. */
static int energies_by_lagrangian(const fvi_system *system, size_t rows, const double *t, const double *x,
                                  const double *v, const double *by, size_t n, double *parameters)
{
    const size_t d = system->d;
    double *room = calloc(2 * d, sizeof *room), value;
    int status = room ? 0 : FVI_ENOMEM;
    for (size_t k = 0; k < rows && !status; k++)
        for (size_t j = 0; by[k] != 0 && j < n && !status; j++) {
            status = fvi_typed_lagrangian_by_parameter(j, t[k], d, x + k * d, v + k * d,
                                                       system->mechanism->lagrangian->params, &value, room, room + d);
            parameters[j] -= by[k] * value;
        }
    free(room);
    return status;
}
/* p0 = L_v(x0, v0): what the derivatives by p0 are by v0, and what they add to those by x0 and by n parameters. */
static int start_by_velocity(const fvi_system *system, const double *x0, const double *v0, const double *by_p0,
                             double *by_x0, double *by_v0, size_t n, double *parameters)
{
    const fvi_lagrangian *L = system->mechanism->lagrangian;
    const size_t d = system->d;
    double *Lxv = calloc(2 * d * d + 2 * d, sizeof *Lxv), *Lvv = Lxv + d * d, *S = Lvv + d * d;
    int status = Lxv ? L->at(0, d, x0, v0, L->params, NULL, NULL, NULL, NULL, Lxv, Lvv) : FVI_ENOMEM;
    for (size_t i = 0; i < d && !status; i++) {
        by_v0[i] = 0;
        for (size_t j = 0; j < d; j++) {
            by_x0[i] += Lxv[i * d + j] * by_p0[j];
            by_v0[i] += Lvv[i * d + j] * by_p0[j];
        }
    }
    for (size_t k = 0; k < n && !status; k++) {
        memset(S, 0, 2 * d * sizeof *S);
        status = fvi_typed_lagrangian_column(k, 0, d, x0, v0, L->params, S, S + d);
        for (size_t j = 0; j < d; j++)
            parameters[k] += S[d + j] * by_p0[j];
    }
    free(Lxv);
    return status;
}
/* The dampers of a mechanism, and the law of each. */
static size_t dampers_of(const fvi_system *system)
{
    return system->mechanism ? system->mechanism->damper_count : 0;
}
static const fvi_kernel *kernel_of(const fvi_system *system, size_t j)
{
    return system->mechanism->damper[j].kernel;
}
/* dU/dk_j at x; U is linear in the constants of what is ready to use. */
static int energy_by_parameter(const fvi_typed_potential *potential, size_t d, size_t j, const double *x,
                               double *value)
{
    const double unit[2] = { j == 0, j == 1 };
    fvi_potential u = fvi_potential_typed(potential);
    if (potential->expression) {
        fvi_expression_parameter_gradient(potential->expression, j, x, value, NULL);
        return 0;
    }
    return u.value(d, x, (void *)unit, value);
}
#endif
