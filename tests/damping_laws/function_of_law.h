/* tests/damping_laws/function_of_law.h -- The laws of the references as functions of s, as their
 * definitions stand, for the tests of H 26. */
#ifndef FUNCTION_OF_LAW_H
#define FUNCTION_OF_LAW_H

#include <fvi/damping_laws.h>

#include <complex.h>

static inline double complex symbol_of_term(const fvi_kernel_term *t,
                                            double complex s)
{
    const double complex log_s = clog(s), q = cexp(2 * t->alpha * log_s),
                         end = cexp(2 * t->end * log_s);
    switch (t->kind) {
    case FVI_KERNEL_ZENER:
        return q / (1 + t->time * q);
    case FVI_KERNEL_MAXWELL:
        return s / (1 + t->time * s);
    case FVI_KERNEL_DISTRIBUTED:
        return (end - q) / (2 * log_s);
    case FVI_KERNEL_MAXWELL2:
        return 1 / (1 / q + t->time / end);
    case FVI_KERNEL_DAVIDSON:
        return cexp(2 * t->alpha * clog(s / (1 + t->time * s)));
    default:
        return q;
    }
}

static inline void symbol_of_law(double re, double im, void *params,
                                 double *C_re, double *C_im)
{
    const fvi_kernel *law = params;
    double complex C = 0;
    for (size_t i = 0; i < law->count; i++)
        C += law->term[i].rho * symbol_of_term(&law->term[i], re + I * im);
    *C_re = creal(C);
    *C_im = cimag(C);
}

static inline fvi_kernel_function function_of_law(const fvi_kernel *law)
{
    return (fvi_kernel_function){ { FVI_KERNEL_SYMBOL, 1, 0, 0, 0 },
                                  symbol_of_law,
                                  (void *)law };
}

/* Is there a pole on the cut, or an end of the cut besides 0? Then there are no modes. */
static inline int has_a_second_singularity(const fvi_kernel *law)
{
    for (size_t i = 0; i < law->count; i++)
        if (law->term[i].kind == FVI_KERNEL_MAXWELL
            || law->term[i].kind == FVI_KERNEL_DAVIDSON)
            return 1;
    return 0;
}

#endif
