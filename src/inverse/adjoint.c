/* src/inverse/adjoint.c -- Every derivative of a run for one mirrored run. [Chapter 23] */
#include <fvi/adjoint.h>

#include "backward.h"
#include "mirror.h"
#include "system/fail.h"

#include <stdlib.h>
#include <string.h>

static int check(const fvi_method *method, const fvi_run *run, const double *x,
                 const double *p, const fvi_objective *J,
                 const fvi_gradients *want)
{
    if (!method || !run || !J || !J->slopes || !want || !x != !p)
        FVI_FAIL("null pointer", FVI_EFAULT);
    if (method->scheme == FVI_SCHEME_OTHER
        || method->scheme == FVI_SCHEME_STAGES)
        FVI_FAIL("this method has no adjoint", FVI_EUNSUP);
    if (want->parameters && want->sensitivity.count > 0
        && !want->sensitivity.column)
        FVI_FAIL("derivatives by parameters need a sensitivity", FVI_EINVAL);
    fvi_stepper *s; /* knows what a run may be */
    int status = fvi_start(method, run, &s);
    if (!status)
        fvi_stop(s);
    return status;
}

/* What is added to, from zero on. */
static void clear(const fvi_run *run, const fvi_gradients *want)
{
    const size_t d = run->system->d;
    if (want->alpha)
        *want->alpha = 0;
    if (want->damping)
        memset(want->damping, 0, d * sizeof *want->damping);
    if (want->force)
        memset(want->force, 0, (run->steps + 1) * d * sizeof *want->force);
    for (size_t j = 0; want->parameters && j < want->sensitivity.count; j++)
        want->parameters[j] = 0;
}

/* dJ/dx_k, zeroed before it is asked for. */
static int slopes(const fvi_objective *J, size_t k, size_t d, const double *x,
                  const double *p, double *Jx, double *Jp)
{
    for (size_t i = 0; i < d; i++)
        Jx[i] = 0;
    return J->slopes(k, d, x, p, J->params, Jx, Jp);
}

//> walk
/* From node N to node 0. J: d numbers for dJ/dx_k, and d for dJ/dp_N. */
static int walk(fvi_scheme scheme, fvi_backward *path, const fvi_run *run,
                const fvi_objective *objective, const fvi_gradients *want,
                double *J)
{
    const size_t d = run->system->d, N = run->steps;
    const double *rows;
    fvi_mirror m = { 0 };
    int status = fvi_backward_step(path, N - 1, &rows);
    if (!status)
        status = slopes(objective, N, d, rows + d, fvi_backward_momentum(path),
                        J, J + d);
    if (!status)
        status = fvi_mirror_start(scheme, run, want, J + d, &m);
    for (size_t k = N; !status && k-- > 0;) {
        if (k + 1 < N)
            status = fvi_backward_step(path, k, &rows);
        if (!status)
            status = fvi_mirror_step(&m, k, rows, J);
        if (!status)
            status = slopes(objective, k, d, rows, NULL, J, NULL);
    }
    if (!status)
        status = fvi_mirror_end(&m, J);
    fvi_mirror_stop(&m);
    return status;
}
//< walk

int fvi_adjoint(const fvi_method *method, const fvi_run *run, const double *x,
                const double *p, const fvi_objective *objective,
                const fvi_gradients *want)
{
    fvi_backward *path;
    int status = check(method, run, x, p, objective, want);
    if (!status)
        status = fvi_backward_alloc(method, run, x, p, &path);
    if (status)
        return status;
    clear(run, want);
    double *J = calloc(2 * run->system->d, sizeof *J);
    if (!J) {
        fvi_backward_free(path);
        FVI_FAIL("no memory for the slopes", FVI_ENOMEM);
    }
    status = walk(method->scheme, path, run, objective, want, J);
    free(J);
    fvi_backward_free(path);
    return status;
}
