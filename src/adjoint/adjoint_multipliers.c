/* src/adjoint/adjoint_multipliers.c -- The multipliers nu, as the histories of an adjoint run take them in. [H 23] */
#include "adjoint_multipliers.h"

void fvi_adjoint_multipliers_next(fvi_adjoint_multipliers *f, int is_last, const double *right,
                                  const double *left, const double *jump)
{
    const double theta = f->theta,
                 share = f->is_first_order ? 1
                         : is_last         ? 0.5
                                           : 1 - theta;
    for (size_t i = 0; i < f->d; i++) {
        f->nu[i] = share * right[i] + theta * left[i];
        if (jump && !f->is_first_order && !is_last)
            f->nu[i] += (theta - 0.5) * jump[i];
        const double now = f->is_mean ? (f->nu[i] + f->behind[i]) / 2 : f->nu[i];
        f->behind[i] = f->nu[i];
        f->change[i] = now - f->mean[i];
        f->mean[i] = now;
    }
}
