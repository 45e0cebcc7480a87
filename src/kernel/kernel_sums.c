/* src/kernel/kernel_sums.c -- Check a law, a sum of terms, and compute its symbol, its growth, its moduli and
 * its derivatives. [H 26] */
#include "kernel_classes.h"

#include "symbol_poles.h"
#include "system/fail.h"
#include "system/larger.h"
#include "system/one_sided.h"

#include <complex.h>
#include <gsl/gsl_math.h>
#include <math.h>

static int check_term(const fvi_kernel_term *t)
{
    if ((size_t)t->kind >= fvi_kernel_class_count)
        FVI_FAIL("unknown law of damping", FVI_EINVAL);
    if (!(isfinite(t->rho) && t->rho >= 0))
        FVI_FAIL("rho of a law must be finite and not negative", FVI_EDOM);
    return fvi_kernel_classes[t->kind]->check(t);
}

int fvi_kernel_check_terms(const fvi_kernel *law)
{
    if (!law || (law->count && !law->term))
        FVI_FAIL("null pointer", FVI_EFAULT);
    if (law->count == 0)
        FVI_FAIL("a law has at least one term", FVI_EINVAL);
    for (size_t i = 0; i < law->count; i++) {
        if (law->term[i].kind == FVI_KERNEL_SYMBOL && law->count > 1)
            FVI_FAIL("a SYMBOL stands alone in its law", FVI_EINVAL);
        int status = check_term(&law->term[i]);
        if (status)
            return status;
    }
    return FVI_SUCCESS;
}

int fvi_kernel_check(const fvi_kernel *law)
{
    const int status = fvi_kernel_check_terms(law);
    if (!status && law->term->kind == FVI_KERNEL_SYMBOL
        && fvi_symbol_has_poles((const fvi_kernel_function *)law->term))
        FVI_FAIL("the symbol of a law must be analytic but for s <= 0: it has a pole beside the cut", FVI_EDOM);
    return status;
}

double fvi_kernel_growth(const fvi_kernel *law)
{
    double most = 0;
    for (size_t i = 0; i < law->count; i++) {
        const fvi_kernel_term *t = &law->term[i];
        const fvi_kernel_class *of = fvi_kernel_classes[t->kind];
        fvi_kernel_simple f;
        most = larger(most, of->growth                     ? of->growth(t)
                            : fvi_kernel_is_fraction(t, &f) ? fvi_fraction_growth(&f)
                                                            : fvi_symbol_growth(t));
    }
    return most;
}

double fvi_kernel_dashpot(const fvi_kernel *law)
{
    const double far = 1e100, farther = 1e200, a = fvi_kernel_symbol(law, far) / far,
                 b = fvi_kernel_symbol(law, farther) / farther;
    return fabs(a - b) <= 1e-9 * fabs(a) ? b : 0;
}

int fvi_kernel_takes_caputo(const fvi_kernel *law)
{
    if (fvi_kernel_growth(law) > 1)
        return 0;
    for (size_t i = 0; i < law->count; i++) {
        const fvi_kernel_term *t = &law->term[i];
        if (fvi_kernel_number_of(t, 1) && t->alpha > 0.5)
            return 0;
    }
    return 1;
}

/* Return C(s) and, unless slope is NULL, s C'(s). A SYMBOL needs many values for the slope, so the caller
 * passes NULL if it can. */
static double complex sum_at(const fvi_kernel *law, double modulus, double angle,
                             double complex *slope)
{
    double complex C = 0;
    if (!slope) {
        for (size_t i = 0; i < law->count; i++)
            C += fvi_kernel_term_at(&law->term[i], modulus, angle);
        return C;
    }
    *slope = 0;
    for (size_t i = 0; i < law->count; i++) {
        const fvi_kernel_term *t = &law->term[i];
        double complex one;
        C += t->rho * fvi_kernel_classes[t->kind]->symbol(t, modulus, angle, &one);
        *slope += t->rho * one;
    }
    return C;
}

fvi_kernel fvi_kernel_of_function(const fvi_kernel_function *function)
{
    return (fvi_kernel){ 1, &function->term };
}

static void expression_value(double re, double im, void *params, double *C_re,
                             double *C_im)
{
    fvi_expression_complex_value(params, re, im, C_re, C_im);
}

fvi_kernel_function fvi_kernel_of_expression(const fvi_expression *e,
                                             double rho)
{
    return (fvi_kernel_function){ { FVI_KERNEL_SYMBOL, rho, 0, 0, 0 },
                                  expression_value,
                                  (void *)e };
}

double complex fvi_kernel_at(const fvi_kernel *law, double complex s,
                          double complex *slope)
{
    return sum_at(law, cabs(s), carg(s), slope);
}

double fvi_kernel_symbol(const fvi_kernel *law, double s)
{
    return creal(sum_at(law, s, 0, NULL));
}

int fvi_kernel_moduli(const fvi_kernel *law, double omega, double *storage,
                   double *loss)
{
    int status = fvi_kernel_check(law);
    if (status)
        return status;
    if (!storage || !loss)
        FVI_FAIL("null pointer", FVI_EFAULT);
    if (!(isfinite(omega) && omega > 0))
        FVI_FAIL("omega must be finite and positive", FVI_EDOM);
    const double complex C = sum_at(law, omega, M_PI_2, NULL);
    if (!isfinite(creal(C)) || !isfinite(cimag(C)))
        FVI_FAIL("a modulus is not finite", FVI_EOVRFLW);
    *storage = creal(C);
    *loss = cimag(C);
    return FVI_SUCCESS;
}

/* ---- derivatives of the symbol by a number ---- */

//> differences
/* The differences have order 8. An order or an exponent a is in s^a, so its step is a part of 1/|ln s|. The step of a
 * time is a part of the time. At time = 0 it is a part of 1/|C| or of 1/|s|, and the differences have order 6. */
double complex fvi_symbol_by_differences(const fvi_kernel_term *term, double complex s, size_t field)
{
    static const double central[] = { 4. / 5, -1. / 5, 4. / 105, -1. / 280 };
    fvi_kernel_term t = *term;
    const fvi_kernel law = { 1, &t };
    double *const number = field == 1 ? &t.alpha : field == 2 ? &t.time : &t.end, at = *number;
    const int is_size = fvi_kernel_number_of(&t, field)->range == FVI_RANGE_SIZE;
    const double part = !is_size ? 1 / (1 + cabs(clog(s)))
                        : at > 0 ? at
                                 : 1 / larger(cabs(fvi_kernel_at(&law, s, NULL)), cabs(s)),
                 step = part / 64;
    double complex sum = 0;
    for (int i = 0; i <= 6 && is_size && at == 0; i++) {
        *number = i * step;
        sum += fvi_one_sided_weights[i] * fvi_kernel_at(&law, s, NULL);
    }
    for (int i = -4; i <= 4 && !(is_size && at == 0); i++) {
        *number = at + i * step;
        sum += (i > 0 ? central[i - 1] : i < 0 ? -central[-i - 1] : 0) * fvi_kernel_at(&law, s, NULL);
    }
    return sum / step;
}
//< differences

static double complex symbol_by(const fvi_kernel_term *t, double complex s, size_t field)
{
    const fvi_kernel_class *of = fvi_kernel_classes[t->kind];
    return of->by ? of->by(t, s, field) : fvi_symbol_by_differences(t, s, field);
}

static double complex symbol_by_alpha(const void *term, double complex s)
{
    return symbol_by(term, s, 1);
}

static double complex symbol_by_time(const void *term, double complex s)
{
    return symbol_by(term, s, 2);
}

static double complex symbol_by_end(const void *term, double complex s)
{
    return symbol_by(term, s, 3);
}

fvi_symbol_function *fvi_kernel_derivative_symbol(const fvi_kernel_term *term, fvi_slope_by by)
{
    static fvi_symbol_function *const all[] = { symbol_by_alpha, symbol_by_time, symbol_by_end };
    return fvi_kernel_number_of(term, 1 + by) ? all[by] : NULL;
}
