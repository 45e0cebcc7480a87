/* src/parameter_derivatives/kernel_derivatives.c -- The derivatives of kernels by their orders and times, as symbols.
 * [H 23] */
#include "kernel_derivatives.h"

#include "kernel/kernel_terms.h"

/* ---- symbols ---- */

/* dC/d alpha and dC/d time of a power, a fraction or a Maxwell element; dC/da and dC/de of a range of orders.
 * (23.21) */
static double complex symbol_by_order(const void *term, double complex s)
{
    const fvi_kernel_term *t = term;
    const double complex C = fvi_kernel_at(&(fvi_kernel){ 1, t }, s, NULL);
    return t->kind == FVI_KERNEL_DISTRIBUTED ? -cpow(s, 2 * t->alpha)
                                             : 2 * clog(s) * C * (1 - t->time * C);
}

static double complex symbol_by_time(const void *term, double complex s)
{
    const double complex C = fvi_kernel_at(&(fvi_kernel){ 1, term }, s, NULL);
    return -C * C;
}

static double complex symbol_by_end(const void *term, double complex s)
{
    return cpow(s, 2 * ((const fvi_kernel_term *)term)->end);
}

//> pair
/* C of two springpots in series, (23.28), and s^{2 (alpha - end)} to *q. */
static double complex pair_at(const fvi_kernel_term *t, double complex s, double complex *q)
{
    *q = cexp(2 * (t->alpha - t->end) * clog(s));
    return cexp(2 * t->alpha * clog(s)) / (1 + t->time * *q);
}

static double complex pair_by_order(const void *term, double complex s)
{
    double complex q;
    const double complex C = pair_at(term, s, &q);
    return 2 * clog(s) * C / (1 + ((const fvi_kernel_term *)term)->time * q);
}

static double complex pair_by_time(const void *term, double complex s)
{
    double complex q;
    const double complex C = pair_at(term, s, &q);
    return -C * q / (1 + ((const fvi_kernel_term *)term)->time * q);
}

static double complex pair_by_end(const void *term, double complex s)
{
    double complex q;
    const double complex C = pair_at(term, s, &q), u = ((const fvi_kernel_term *)term)->time * q;
    return 2 * clog(s) * C * u / (1 + u);
}
//< pair

/* ln(1 + z), accurate also for |z| much smaller than 1. */
static double complex log_of_1_and(double complex z)
{
    return cabs(z) > 1e-4 ? clog(1 + z) : z * (1 - z * (1. / 2 - z * (1. / 3 - z * (1. / 4 - z / 5))));
}

/* ln(s / (1 + time s)). For |time s| > 1 the quotient is divided by s first, because ln s and ln(1 + time s) are then
 * nearly alike and their difference would lose digits. */
static double complex davidson_log(const fvi_kernel_term *t, double complex s)
{
    const double complex Ts = t->time * s;
    return cabs(Ts) > 1 ? -log(t->time) - log_of_1_and(1 / Ts) : clog(s) - log_of_1_and(Ts);
}

static double complex davidson_by_order(const void *term, double complex s)
{
    const fvi_kernel_term *t = term;
    const double complex ln = davidson_log(t, s);
    return 2 * ln * cexp(2 * t->alpha * ln);
}

static double complex davidson_by_time(const void *term, double complex s)
{
    const fvi_kernel_term *t = term;
    const double complex ln = davidson_log(t, s);
    return -2 * t->alpha * cexp((2 * t->alpha + 1) * ln);
}

/* ---- the table ---- */

static fvi_symbol_function *const symbols[][FVI_KERNEL_DERIVATIVES] = {
    [FVI_KERNEL_POWER] = { symbol_by_order, NULL, NULL },
    [FVI_KERNEL_ZENER] = { symbol_by_order, symbol_by_time, NULL },
    [FVI_KERNEL_MAXWELL] = { NULL, symbol_by_time, NULL },
    [FVI_KERNEL_DISTRIBUTED] = { symbol_by_order, NULL, symbol_by_end },
    [FVI_KERNEL_MAXWELL2] = { pair_by_order, pair_by_time, pair_by_end },
    [FVI_KERNEL_DAVIDSON] = { davidson_by_order, davidson_by_time, NULL },
    [FVI_KERNEL_SYMBOL] = { NULL, NULL, NULL }
};

fvi_symbol_function *fvi_kernel_derivative_symbol(const fvi_kernel_term *term, fvi_slope_by by)
{
    return symbols[term->kind][by];
}

int fvi_kernel_has_derivative(const fvi_kernel_term *term, fvi_slope_by by)
{
    return fvi_kernel_derivative_symbol(term, by) != NULL;
}

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
    if (!fvi_kernel_has_derivative(term, by) || (!is_range && term->kind < FVI_KERNEL_MAXWELL2))
        return 0;
    *slope = (fvi_kernel_derivative){ .symbol = fvi_kernel_derivative_symbol(term, by), .of = term };
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
