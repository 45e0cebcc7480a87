/* tests/adjoint/adjoint_runs.h -- Objectives and all derivatives of a run. */
#ifndef ADJOINT_RUNS_H
#define ADJOINT_RUNS_H

#include <fvi/fvi.h>
#include "harness/ulp.h"

#include <stdlib.h>

/* J = (h/2) sum_{k=1}^N |x_k - sin t_k|^2 + sum_i x_N,i/2 + x_N,i p_N,i^2/4; params is
 * the run. */
static inline int to_sine(size_t k, size_t d, const double *x, const double *p,
                          void *params, double *Jx, double *Jp)
{
    const fvi_run *run = params;
    const double h = run->h;
    for (size_t i = 0; i < d; i++) {
        Jx[i] += k > 0 ? h * (x[i] - sin((double)k * h)) : 0;
        if (k == run->steps) {
            Jx[i] += 0.5 + p[i] * p[i] / 4;
            Jp[i] += x[i] * p[i] / 2;
        }
    }
    return 0;
}

/* J = x_N,1 + p_N,2 */
static inline int ends(size_t k, size_t d, const double *x, const double *p,
                       void *params, double *Jx, double *Jp)
{
    (void)k, (void)d, (void)x, (void)params;
    if (p) {
        Jx[0] = 1;
        Jp[1] = 1;
    }
    return 0;
}

enum { MOST = 8 /* coordinates */, NUMBERS = 4 * MOST + 3 };

/* Room for all derivatives, of x0, p0, masses, dampings, alpha and two parameters one
 * behind the other. */
typedef struct {
    double all[NUMBERS], *force;
    fvi_sensitivities to;
} slopes;

static inline slopes *slopes_of(const fvi_run *run, size_t rows)
{
    slopes *s = calloc(1, sizeof *s);
    ck_assert_ptr_nonnull(s);
    s->force = calloc(rows * run->system->d, sizeof *s->force);
    ck_assert_ptr_nonnull(s->force);
    s->to = (fvi_sensitivities){ .x0 = s->all,
                             .p0 = s->all + MOST,
                             .mass = s->all + 2 * MOST,
                             .damping = s->all + 3 * MOST,
                             .alpha = s->all + 4 * MOST,
                             .parameters = s->all + 4 * MOST + 1,
                             .force = s->force };
    s->to.sensitivity = fvi_parameter_gradient_of(&run->system->potential);
    return s;
}

/* What was asked for, one behind the other: x0, p0, masses, dampings, two parameters, and
 * alpha, if it was. */
static inline void slopes_in_order(const slopes *s, size_t d, double *got)
{
    for (size_t j = 0; j < 4 * d; j++)
        got[j] = s->all[j / d * MOST + j % d];
    got[4 * d] = s->to.parameters[0];
    got[4 * d + 1] = s->to.parameters[1];
    if (s->to.alpha)
        got[4 * d + 2] = *s->to.alpha;
}

static inline void slopes_free(slopes *s)
{
    free(s->force);
    free(s);
}

#endif
