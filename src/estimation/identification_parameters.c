/* src/estimation/identification_parameters.c -- Read, write and bound a single parameter of a fit. [H 24] */
#include "identification_model.h"

#include "kernel/kernel_classes.h"

#include <math.h>

fvi_free_parameter fvi_free_parameter_base(fvi_free_parameter which)
{
    return (fvi_free_parameter)((size_t)which % FVI_FREE_PARAMETER_EACH);
}

size_t fvi_free_parameter_index(fvi_free_parameter which)
{
    return (size_t)which / FVI_FREE_PARAMETER_EACH;
}

int fvi_free_parameter_is_of_law(fvi_free_parameter which)
{
    const fvi_free_parameter base = fvi_free_parameter_base(which);
    return base >= FVI_FREE_PARAMETER_LAW && base < FVI_FREE_PARAMETER_CONSTANT;
}

/* Return what is known of the number of a law that parameter j is; NULL if it is no number of a law. */
static const fvi_kernel_number *number_of_law(const fvi_estimation *fit, size_t j)
{
    const fvi_free_parameter which = fit->which[j];
    const size_t number = fvi_free_parameter_base(which) - FVI_FREE_PARAMETER_LAW;
    const fvi_kernel *law = fvi_estimation_law(fit->run, fvi_free_parameter_index(which));
    return fvi_free_parameter_is_of_law(which) && law && number / 4 < law->count
               ? fvi_kernel_number_of(&law->term[number / 4], number % 4)
               : NULL;
}

fvi_estimation_kind fvi_estimation_kind_of(const fvi_estimation *fit, size_t j)
{
    const fvi_free_parameter base = fvi_free_parameter_base(fit->which[j]);
    const fvi_kernel_number *number = number_of_law(fit, j);
    if (base == FVI_FREE_PARAMETER_ALPHA || (number && number->range != FVI_RANGE_SIZE))
        return FVI_ESTIMATION_ORDER;
    return number || base == FVI_FREE_PARAMETER_RHO || base == FVI_FREE_PARAMETER_MASS ? FVI_ESTIMATION_SIZE
                                                                                      : FVI_ESTIMATION_NUMBER;
}

/* ---- numbers of laws ---- */

static fvi_kernel_term *term_of(const fvi_estimation_model *m, fvi_free_parameter which)
{
    const size_t number = fvi_free_parameter_base(which) - FVI_FREE_PARAMETER_LAW;
    return m->laws.term + m->laws.first[fvi_free_parameter_index(which)] + number / 4;
}

/* For two springpots in series the field time is rho1 / rho2, and the third parameter is rho2. */
static double get_law(const fvi_estimation_model *m, fvi_free_parameter which)
{
    const fvi_kernel_term *t = term_of(m, which);
    switch ((fvi_free_parameter_base(which) - FVI_FREE_PARAMETER_LAW) % 4) {
    case 0:
        return t->rho;
    case 1:
        return t->alpha;
    case 2:
        return t->kind == FVI_KERNEL_MAXWELL2 ? t->rho / t->time : t->time;
    default:
        return t->end;
    }
}

static void set_law(fvi_estimation_model *m, fvi_free_parameter which, double theta)
{
    fvi_kernel_term *t = term_of(m, which);
    switch ((fvi_free_parameter_base(which) - FVI_FREE_PARAMETER_LAW) % 4) {
    case 0:
        if (t->kind == FVI_KERNEL_MAXWELL2)
            t->time *= theta / t->rho;
        t->rho = theta;
        break;
    case 1:
        t->alpha = theta;
        break;
    case 2:
        t->time = t->kind == FVI_KERNEL_MAXWELL2 ? t->rho / theta : theta;
        break;
    default:
        t->end = theta;
    }
}

/* ---- all others ---- */

/* Return the array with the numbers of this kind, and its length. */
static double *numbers_of(fvi_estimation_model *m, fvi_free_parameter base, size_t *count)
{
    *count = m->system.d;
    switch (base) {
    case FVI_FREE_PARAMETER_RHO:
        return m->damping;
    case FVI_FREE_PARAMETER_MASS:
        return m->mass;
    case FVI_FREE_PARAMETER_X0:
        return m->x0;
    case FVI_FREE_PARAMETER_P0:
        return m->p0;
    case FVI_FREE_PARAMETER_OFFSET:
        *count = fvi_estimation_columns(m->fit);
        return m->offset;
    case FVI_FREE_PARAMETER_DRIFT:
        *count = fvi_estimation_columns(m->fit);
        return m->drift;
    default:
        *count = 1;
        return base == FVI_FREE_PARAMETER_ALPHA
                   ? &m->run.alpha
                   : &m->fit->constants[base - FVI_FREE_PARAMETER_CONSTANT];
    }
}

double fvi_estimation_model_get(const fvi_estimation_model *m, size_t j)
{
    const fvi_free_parameter which = m->fit->which[j];
    const size_t i = fvi_free_parameter_index(which);
    size_t count;
    if (fvi_free_parameter_is_of_law(which))
        return get_law(m, which);
    return numbers_of((fvi_estimation_model *)m, fvi_free_parameter_base(which), &count)[i ? i - 1 : 0];
}

void fvi_estimation_model_set(fvi_estimation_model *m, size_t j, double theta)
{
    const fvi_free_parameter which = m->fit->which[j];
    const size_t index = fvi_free_parameter_index(which);
    size_t count;
    if (fvi_free_parameter_is_of_law(which)) {
        set_law(m, which, theta);
        return;
    }
    double *number = numbers_of(m, fvi_free_parameter_base(which), &count); /* in *m, or an array of the caller */
    for (size_t i = 0; i < count; i++)
        if (index == 0 || index == i + 1)
            number[i] = theta;
}

/* ---- bounds ---- */

void fvi_estimation_range(const fvi_estimation *fit, size_t j, double *low, double *high)
{
    const fvi_estimation_kind kind = fvi_estimation_kind_of(fit, j);
    const fvi_kernel_number *number = number_of_law(fit, j);
    const int is_alpha = kind == FVI_ESTIMATION_ORDER && !number;
    *low = kind == FVI_ESTIMATION_NUMBER ? -INFINITY : is_alpha ? fit->method->alpha_least : 0;
    *high = is_alpha ? fit->method->alpha_most : number ? number->most : INFINITY;
}

//> bound
double fvi_estimation_u_to_theta(const fvi_estimation_model *m, size_t j, double u)
{
    double low, high;
    switch (fvi_estimation_kind_of(m->fit, j)) {
    case FVI_ESTIMATION_ORDER:
        fvi_estimation_range(m->fit, j, &low, &high);
        return low + (high - low) / (1 + exp(-u));
    case FVI_ESTIMATION_SIZE:
        return exp(u);
    default:
        return u;
    }
}
//< bound

double fvi_estimation_theta_to_u(const fvi_estimation_model *m, size_t j, double theta)
{
    double low, high;
    switch (fvi_estimation_kind_of(m->fit, j)) {
    case FVI_ESTIMATION_ORDER:
        fvi_estimation_range(m->fit, j, &low, &high);
        return log((theta - low) / (high - theta));
    case FVI_ESTIMATION_SIZE:
        return log(theta);
    default:
        return theta;
    }
}

double fvi_estimation_slope_of_theta(const fvi_estimation_model *m, size_t j, double theta)
{
    double low, high;
    switch (fvi_estimation_kind_of(m->fit, j)) {
    case FVI_ESTIMATION_ORDER:
        fvi_estimation_range(m->fit, j, &low, &high);
        return (theta - low) * (high - theta) / (high - low);
    case FVI_ESTIMATION_SIZE:
        return theta;
    default:
        return 1;
    }
}
