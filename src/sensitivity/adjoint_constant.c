/* src/sensitivity/adjoint_constant.c -- What a memory held at J_p leaves out.      [H 23] */
#include "adjoint_constant.h"

#include "methods/damping.h"
#include "adjoint_multistep.h"
#include "system/fail.h"

#include <math.h>
#include <string.h>

int fvi_adjoint_constant_start(const fvi_method *method, const fvi_run *run,
                              fvi_adjoint_constant *c)
{
    const fvi_scheme scheme = method->scheme;
    const double alpha = run->law ? 0 : run->alpha; /* (26.15) */
    double unused[FVI_BDF2_TAPS] = { 0 };
    *c = (fvi_adjoint_constant){
        .paper_convention = scheme == FVI_SCHEME_FVI,
        .theta = scheme == FVI_SCHEME_CQ2_SHIFTED  ? run->alpha
                 : scheme == FVI_SCHEME_CQ2_MIDPOINT ? 0.5
                                               : 0,
        .unit = run->law ? run->h : pow(run->h, 1 - 2 * run->alpha)
    };
    if (run->system->matrices->remembered == 0)
        return FVI_SUCCESS;
    c->taps = fvi_adjoint_factor(run->law && scheme == FVI_SCHEME_CQ_BDF2
                                    ? FVI_SCHEME_FVI /* no factor */
                                    : scheme,
                                alpha, c->g, unused);
    if (!run->law)
        return fvi_history_alloc(2 * alpha, 1, run->steps, run->memory,
                                run->tolerance, &c->memory);
    double first = 0;
    const int status = fvi_kernel_history(run->law, fvi_damping_quadrature(method),
                                      run->h, 1, run->steps, run->memory,
                                      run->tolerance, &first, &c->memory);
    c->unit *= first;
    return status;
}

void fvi_adjoint_constant_stop(fvi_adjoint_constant *c)
{
    fvi_history_free(c->memory);
}

//> next
int fvi_adjoint_constant_next(fvi_adjoint_constant *c, double *impulse)
{
    const double one = 1, change = !c->has_begun;
    double sum = 0;
    *impulse = 0;
    if (!c->memory)
        return FVI_SUCCESS;
    c->has_begun = 1;
    memmove(c->past + 1, c->past, (FVI_BDF2_TAPS - 1) * sizeof *c->past);
    const int status = fvi_history_push(c->memory, &one, &change, c->past);
    for (size_t n = 0; n < c->taps; n++)
        sum += c->g[n] * c->past[n];
    *impulse =
        c->unit
        * (c->paper_convention ? sum
                      : (0.5 + c->theta) * sum + (0.5 - c->theta) * c->before);
    c->before = sum;
    return status;
}
//< next
