/* src/estimation/identification_box.c -- Where to begin: what the data alone say.
 *                                                                     [H 24] */
#include "identification_model.h"

#include <fvi/rheology.h>

#include "system/fail.h"
#include "system/larger.h"

#include <gsl/gsl_math.h>

enum { LOOKED_AT = 1024, PARTS = 8 };

void fvi_estimation_frequency(size_t n, const double *t, const double *x, double *w,
                       double *A)
{
    double mean = 0, best = -1;
    for (size_t i = 0; i < n; i++)
        mean += x[i] / (double)n;
    *A = 0;
    for (size_t i = 0; i < n; i++)
        *A = larger(*A, fabs(x[i] - mean));
    const size_t most = n < LOOKED_AT ? n : LOOKED_AT;
    const double lowest = M_PI / (t[most - 1] - t[0]);
    *w = lowest;
    for (size_t k = 1; k <= most; k++) {
        double c = 0, s = 0;
        for (size_t i = 0; i < most; i++) {
            const double phase = (double)k * lowest * (t[i] - t[0]);
            c += (x[i] - mean) * cos(phase);
            s += (x[i] - mean) * sin(phase);
        }
        if (c * c + s * s > best) {
            best = c * c + s * s;
            *w = (double)k * lowest;
        }
    }
}

/* Does a step near h meet all times? It is made more exact on the way. */
static int meets(size_t n, const double *t, double *h)
{
    for (size_t i = 0; i < n; i++) {
        const double k = round(t[i] / *h);
        if (fabs(t[i] - k * *h) > 1e-4 * *h)
            return 0;
        if (k > 0)
            *h = t[i] / k;
    }
    return 1;
}

double fvi_estimation_first_step(const fvi_estimation *fit)
{
    const size_t n = fit->n;
    const double *t = fit->t, T = t[n - 1], mean = T / (double)n;
    double w, A, h = mean;
    fvi_estimation_frequency(n, t, fit->x, &w, &A);
    double gap = t[0] > 0 ? t[0] : T;
    for (size_t i = 1; i < n; i++)
        gap = smaller(gap, t[i] - t[i - 1]);
    for (int parts = 1; parts <= PARTS; parts++) {
        double step = gap / parts;
        if (step >= mean / PARTS && meets(n, t, &step)) {
            h = step;
            break;
        }
    }
    return h / fmax(1, ceil(h * w));
}

/* A number of a law: of a size as that of a springpot, of a time as 1/w, or an order. */
static void plausible_of_law(const fvi_estimation *fit, size_t which, double m, double w,
                             double *low, double *high)
{
    const fvi_kernel_term *t = &fit->run->law->term[which / 4];
    const double order = t->kind == FVI_KERNEL_MAXWELL ? 1 : 2 * t->alpha;
    if (which % 2) {
        *low = 0.02;
        *high = 0.98;
    } else if (which % 4 == 0 || t->kind == FVI_KERNEL_MAXWELL2) {
        *low = m * pow(w, 2 - order) / 50;
        *high = m * pow(w, 2 - order) * 2;
    } else {
        *low = pow(w, -order) / 30;
        *high = pow(w, -order) * 30;
    }
}

//> box
/* What parameter j may plausibly be. */
static void plausible(const fvi_estimation *fit, size_t j, double mean, double w,
                      double A, double *low, double *high)
{
    const double m = fit->run->system->mass[0], c = m * w * w;
    switch (fit->which[j]) {
    case FVI_FREE_PARAMETER_ALPHA:
        *low = fit->method->alpha_least;
        *high = fit->method->alpha_most;
        break;
    case FVI_FREE_PARAMETER_RHO: /* that of alpha = 1/2 */
        *low = m * w / 50;
        *high = m * w * 2;
        break;
    case FVI_FREE_PARAMETER_MASS:
        *low = m / 3;
        *high = m * 3;
        break;
    case FVI_FREE_PARAMETER_X0:
        *low = mean - 1.5 * A;
        *high = mean + 1.5 * A;
        break;
    case FVI_FREE_PARAMETER_P0:
        *high = 1.5 * m * w * A;
        *low = -*high;
        break;
    case FVI_FREE_PARAMETER_OFFSET:
        *high = A / 4;
        *low = -*high;
        break;
    case FVI_FREE_PARAMETER_DRIFT:
        *high = A / 4 / (fit->t[fit->n - 1] - fit->t[0]);
        *low = -*high;
        break;
    case FVI_FREE_PARAMETER_CONSTANT: /* of a linear spring, or of a pendulum */
        *low = c / 10;
        *high = c * 4;
        break;
    default:
        if (fit->which[j] < FVI_FREE_PARAMETER_CONSTANT) {
            plausible_of_law(fit, fit->which[j] - FVI_FREE_PARAMETER_LAW, m, w, low, high);
            return;
        } /* of x^4 / 4 */
        *low = -c / (A * A) / 2;
        *high = c / (A * A) * 2;
    }
}
//< box

int fvi_estimate_box(const fvi_estimation *fit, double *low, double *high)
{
    const int status = fvi_estimation_check(fit);
    if (status)
        return status;
    if (!low || !high)
        FVI_FAIL("no room for the box", FVI_EFAULT);
    double w, A, mean = 0;
    fvi_estimation_frequency(fit->n, fit->t, fit->x, &w, &A);
    for (size_t i = 0; i < fit->n; i++)
        mean += fit->x[i] / (double)fit->n;
    for (size_t j = 0; j < fit->parameters; j++)
        plausible(fit, j, mean, w, A > 0 ? A : 1, &low[j], &high[j]);
    return FVI_SUCCESS;
}

/* ---- what can be asked ---- */

static int check_data(const fvi_estimation *fit)
{
    if (fit->n <= fit->parameters)
        FVI_FAIL("a fit needs more data than parameters", FVI_EINVAL);
    if (!fvi_all_finite(fit->n, fit->t) || !fvi_all_finite(fit->n, fit->x)
        || !isfinite(fit->sigma) || fit->sigma < 0 || !isfinite(fit->h)
        || fit->h < 0 || fit->t[0] < 0)
        FVI_FAIL("data are finite; t, sigma, h not negative", FVI_EDOM);
    for (size_t i = 1; i < fit->n; i++)
        if (!(fit->t[i] > fit->t[i - 1]))
            FVI_FAIL("the times increase", FVI_EINVAL);
    return FVI_SUCCESS;
}

/* Is it no number of a law, or one that the run's law has? A dashpot's order is none. */
static int has_number(const fvi_estimation *fit, fvi_free_parameter which)
{
    const size_t number = which - FVI_FREE_PARAMETER_LAW;
    const fvi_kernel *law = fit->run->law;
    if (which < FVI_FREE_PARAMETER_LAW || which >= FVI_FREE_PARAMETER_CONSTANT)
        return 1;
    if (!law || law->count > FVI_ESTIMATION_TERMS || number / 4 >= law->count
        || law->term[number / 4].kind == FVI_KERNEL_SYMBOL)
        return 0;
    const fvi_element kind = fvi_element_of(&law->term[number / 4]);
    for (size_t i = 0, field = 0; fvi_element_number(kind, i, &field); i++)
        if (field == number % 4)
            return 1;
    return 0;
}

static int check_parameters(const fvi_estimation *fit)
{
    if (fit->parameters == 0 || fit->parameters > FVI_ESTIMATION_MOST
        || fit->starts < 2)
        FVI_FAIL("1 to 8 parameters, 2 starts or more", FVI_EINVAL);
    for (size_t j = 0; j < fit->parameters; j++) {
        for (size_t i = 0; i < j; i++)
            if (fit->which[i] == fit->which[j])
                FVI_FAIL("a parameter is fitted once", FVI_EINVAL);
        if (fit->which[j] == FVI_FREE_PARAMETER_ALPHA
            && fit->method->alpha_least == fit->method->alpha_most)
            FVI_FAIL("the method knows one alpha", FVI_EUNSUP);
        if (fit->which[j] == FVI_FREE_PARAMETER_ALPHA && fit->run->law)
            FVI_FAIL("a law of damping does not read alpha", FVI_EUNSUP);
        if (!has_number(fit, fit->which[j]))
            FVI_FAIL("the law has no such number", FVI_EINVAL);
        if (fit->which[j] >= FVI_FREE_PARAMETER_CONSTANT && !fit->constants)
            FVI_FAIL("there are no constants", FVI_EFAULT);
        if (fit->low && fit->high
            && !(isfinite(fit->low[j]) && isfinite(fit->high[j])
                 && fit->low[j] < fit->high[j]))
            FVI_FAIL("the box is low < high", FVI_EDOM);
    }
    return FVI_SUCCESS;
}

int fvi_estimation_check(const fvi_estimation *fit)
{
    if (!fit || !fit->method || !fit->run || !fit->run->x0 || !fit->run->p0
        || !fit->t || !fit->x || !fit->which || !fit->low != !fit->high)
        FVI_FAIL("a pointer of the fit is NULL", FVI_EFAULT);
    int status = fvi_system_check(fit->run->system, NULL);
    if (!status && fit->run->system->d != 1)
        FVI_FAIL("a fit is of one mass", FVI_EINVAL);
    if (!status)
        status = check_parameters(fit);
    return status ? status : check_data(fit);
}
