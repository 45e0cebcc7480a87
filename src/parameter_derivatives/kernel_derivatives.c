/* src/parameter_derivatives/kernel_derivatives.c -- The derivatives of kernels by their orders and times, as symbols.
 * [H 23] */
#include "kernel_derivatives.h"

#include "kernel/kernel_classes.h"
#include "node_terms.h"

/* ---- a derivative as a kernel ---- */

static void value(double re, double im, void *params, double *C_re, double *C_im)
{
    const fvi_kernel_derivative *slope = params;
    const double complex s = re + I * im;
    double complex C = slope->symbol(slope->of, s);
    if (slope->more != 0)
        C += slope->more * fvi_kernel_at(&(fvi_kernel){ 1, slope->of }, s, NULL);
    *C_re = creal(C);
    *C_im = cimag(C);
}

int fvi_kernel_derivative_of(const fvi_kernel_term *term, fvi_slope_by by,
                             fvi_kernel_derivative *slope)
{
    const int is_range = term->kind == FVI_KERNEL_DISTRIBUTED;
    fvi_symbol_function *symbol = fvi_kernel_derivative_symbol(term, by);
    if (!symbol || fvi_kernel_is_zener_or_maxwell(term) || fvi_kernel_is_power_or_zener(term))
        return 0;
    *slope = (fvi_kernel_derivative){ .symbol = symbol, .of = term };
    slope->sign = is_range && by == FVI_SLOPE_BY_ORDER ? -1 : 1;
    slope->function = (fvi_kernel_function){ { FVI_KERNEL_SYMBOL, 1, 0, 0, 0 }, value, slope };
    if (is_range)
        slope->function.term =
            (fvi_kernel_term){ FVI_KERNEL_POWER, 1,
                               by == FVI_SLOPE_BY_ORDER ? term->alpha : term->end, 0, 0 };
    slope->kernel = fvi_kernel_of_function(&slope->function);
    return 1;
}

void fvi_kernel_derivative_begin_at(fvi_kernel_derivative *slope, double s)
{
    const double first = creal(slope->symbol(slope->of, s)),
                 itself = fvi_kernel_symbol(&(fvi_kernel){ 1, slope->of }, s);
    slope->more = slope->function.term.kind == FVI_KERNEL_SYMBOL
                  && fabs(first) < 1e-3 * itself;
}
