/* src/estimation/identification_box.c -- Find a box of plausible parameters from the data alone. [H 24] */
#include "identification_model.h"

#include <fvi/rheology.h>

#include "kernel/kernel_classes.h"
#include "system/fail.h"
#include "system/larger.h"
#include "system/system_check.h"

#include <gsl/gsl_math.h>
#include <stdint.h>
#include <stdlib.h>

enum { MAX_POINTS = 1024, PARTS = 8 };

void fvi_estimation_frequency(size_t n, const double *t, const double *x, double *w,
                       double *A)
{
    double mean = 0, best = -1;
    for (size_t i = 0; i < n; i++)
        mean += x[i] / (double)n;
    *A = 0;
    for (size_t i = 0; i < n; i++)
        *A = larger(*A, fabs(x[i] - mean));
    const size_t most = n < MAX_POINTS ? n : MAX_POINTS;
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

/* Return nonzero if all times are multiples of a step near *h. *h is made more exact by each time. */
static int divides_times(size_t n, const double *t, double *h)
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

/* Return the longest step for one piece; see fvi_estimation_first_step. */
static double first_step_of_piece(const fvi_estimation_piece *p)
{
    const size_t n = p->n;
    const double *t = p->t, T = t[n - 1], mean = T / (double)n;
    double w, A, h = mean;
    if (n < 2)
        return T;
    fvi_estimation_frequency(n, t, p->x, &w, &A);
    double gap = t[0] > 0 ? t[0] : T;
    for (size_t i = 1; i < n; i++)
        gap = smaller(gap, t[i] - t[i - 1]);
    for (int parts = 1; parts <= PARTS; parts++) {
        double step = gap / parts;
        if (step >= mean / PARTS && divides_times(n, t, &step)) {
            h = step;
            break;
        }
    }
    return h / fmax(1, ceil(h * w));
}

double fvi_estimation_first_step(const fvi_estimation *fit)
{
    double h = GSL_POSINF;
    for (size_t k = 0; k < fvi_estimation_pieces(fit); k++) {
        const fvi_estimation_piece p = fvi_estimation_piece_at(fit, k);
        const double step = first_step_of_piece(&p);
        h = step > 0 ? smaller(h, step) : h;
    }
    return h;
}

/* Find a plausible range for a parameter of a law: an amplitude as that of a springpot, a time near 1/w, or near the
 * power of 1/w that is its unit, or an order. */
static void find_plausible_range_of_law(const fvi_estimation *fit, size_t j, double m, double w,
                                        double *low, double *high)
{
    const size_t which = fvi_free_parameter_base(fit->which[j]) - FVI_FREE_PARAMETER_LAW;
    const fvi_kernel *law =
        fvi_estimation_law(fit->run, fvi_free_parameter_index(fit->which[j]));
    const fvi_kernel_term *t = &law->term[which / 4];
    const double order = t->kind == FVI_KERNEL_MAXWELL ? 1 : 2 * t->alpha,
                 power = fvi_kernel_classes[t->kind]->has_time ? 1 : order;
    if (fvi_estimation_kind_of(fit, j) == FVI_ESTIMATION_ORDER) {
        fvi_estimation_range(fit, j, low, high);
        *low = 0.02 * *high;
        *high *= 0.98;
    } else if (which % 4 == 0 || t->kind == FVI_KERNEL_MAXWELL2) {
        *low = m * pow(w, 2 - order) / 50;
        *high = m * pow(w, 2 - order) * 2;
    } else {
        *low = pow(w, -power) / 30;
        *high = pow(w, -power) * 30;
    }
}

/* What the data say: w is the frequency of the first column, mean and A are the mean and the amplitude. With several
 * columns or coordinates the mean is 0, and A is the largest |x|. */
typedef struct {
    double w, mean, A;
    /* 1; or, if the inertia of the body is negligible beside its force, the factor by which m w^2 of the first mass
     * becomes the force divided by A. */
    double inertia;
} data_summary;

enum { NEGLIGIBLE = 1000 };

/* Return the largest force at the first MAX_POINTS times of a record. */
static double largest_force(const fvi_estimation *fit, const fvi_record *record)
{
    const fvi_system *system = fit->run->system;
    const fvi_force *force = record->force ? record->force : &system->force;
    double most = 0, *F = calloc(system->d, sizeof *F);
    for (size_t i = 0; i < record->n && i < MAX_POINTS && F && force->value; i++) {
        if (force->value(record->t[i], system->d, force->params, F))
            break;
        most = larger(most, largest_abs(system->d, F));
    }
    free(F);
    return isfinite(most) ? most : 0;
}

static double inertia_of(const fvi_estimation *fit, double w, double A)
{
    const fvi_record first = fvi_estimation_record(fit, 0);
    const double by_mass = fit->run->system->mass[0] * w * w, by_force = largest_force(fit, &first) / A;
    return by_force > NEGLIGIBLE * by_mass && by_mass > 0 ? by_force / by_mass : 1;
}

static data_summary summarise_data(const fvi_estimation *fit)
{
    const fvi_estimation_piece p = fvi_estimation_piece_at(fit, 0);
    data_summary at = { 1, 0, 1, 1 };
    if (p.n > 1)
        fvi_estimation_frequency(p.n, p.t, p.x, &at.w, &at.A);
    for (size_t i = 0; i < p.n; i++)
        at.mean += p.x[i] / (double)p.n;
    if (fvi_estimation_pieces(fit) > 1 || fit->run->system->d > 1) {
        at.mean = at.A = 0;
        for (size_t c = 0; c < fvi_estimation_columns(fit); c++)
            at.A = larger(at.A, fvi_estimation_size(fit, c));
    }
    at.A = at.A > 0 ? at.A : 1;
    at.inertia = inertia_of(fit, at.w, at.A);
    return at;
}

//> box
/* Find a plausible range for parameter j. */
static void find_plausible_range(const fvi_estimation *fit, size_t j, const data_summary *at, double *low,
                                 double *high)
{
    const fvi_free_parameter base = fvi_free_parameter_base(fit->which[j]);
    const size_t i = fvi_free_parameter_index(fit->which[j]);
    const int is_of_coordinate = base != FVI_FREE_PARAMETER_OFFSET && base != FVI_FREE_PARAMETER_DRIFT
                                 && i > 0 && i <= fit->run->system->d;
    const double mass = fit->run->system->mass[is_of_coordinate ? i - 1 : 0],
                 m = mass * at->inertia, w = at->w, A = at->A, c = m * w * w;
    switch (base) {
    case FVI_FREE_PARAMETER_ALPHA:
        *low = fit->method->alpha_least;
        *high = fit->method->alpha_most;
        break;
    case FVI_FREE_PARAMETER_RHO: /* the range for alpha = 1/2 */
        *low = m * w / 50;
        *high = m * w * 2;
        break;
    case FVI_FREE_PARAMETER_MASS:
        *low = mass / 3;
        *high = mass * 3;
        break;
    case FVI_FREE_PARAMETER_X0:
        *low = at->mean - 1.5 * A;
        *high = at->mean + 1.5 * A;
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
        *high = A / 4 / (fvi_estimation_last_time(fit) - fvi_estimation_record(fit, 0).t[0]);
        *low = -*high;
        break;
    case FVI_FREE_PARAMETER_CONSTANT: /* constant of a linear spring, or of a pendulum */
        *low = c / 10;
        *high = c * 4;
        break;
    default:
        if (base < FVI_FREE_PARAMETER_CONSTANT) {
            find_plausible_range_of_law(fit, j, m, w, low, high);
            return;
        } /* constant of x^4 / 4 */
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
    const data_summary at = summarise_data(fit);
    for (size_t j = 0; j < fit->parameters; j++)
        find_plausible_range(fit, j, &at, &low[j], &high[j]);
    return FVI_SUCCESS;
}

/* ---- what can be asked ---- */

/* Return nonzero if `which` is no parameter of a law, or one that its law has. The order of a dashpot, for example, is
 * none. */
static int has_number(const fvi_estimation *fit, fvi_free_parameter which)
{
    const size_t number = fvi_free_parameter_base(which) - FVI_FREE_PARAMETER_LAW;
    const fvi_kernel *law;
    if (!fvi_free_parameter_is_of_law(which))
        return 1;
    law = fvi_estimation_law(fit->run, fvi_free_parameter_index(which));
    if (!law || number / 4 >= law->count || law->term[number / 4].kind == FVI_KERNEL_SYMBOL)
        return 0;
    const fvi_element kind = fvi_element_of(&law->term[number / 4]);
    for (size_t i = 0, field = 0; fvi_element_number(kind, i, &field); i++)
        if (field == number % 4)
            return 1;
    return 0;
}

/* Return how many parameters of this kind the model has, one for each mass, coordinate or column. */
static size_t count_of_kind(const fvi_estimation *fit, fvi_free_parameter base)
{
    const fvi_system *system = fit->run->system;
    switch (base) {
    case FVI_FREE_PARAMETER_RHO:
    case FVI_FREE_PARAMETER_MASS:
        return system->matrices ? 0 : system->d;
    case FVI_FREE_PARAMETER_X0:
    case FVI_FREE_PARAMETER_P0:
        return system->d;
    case FVI_FREE_PARAMETER_OFFSET:
    case FVI_FREE_PARAMETER_DRIFT:
        return fvi_estimation_columns(fit);
    default: /* has_number checks whether the law exists */
        return base >= FVI_FREE_PARAMETER_LAW && base < FVI_FREE_PARAMETER_CONSTANT ? SIZE_MAX : 0;
    }
}

/* Check that the model has this parameter, and that the method can fit it. */
static int check_which(const fvi_estimation *fit, fvi_free_parameter which)
{
    const fvi_free_parameter base = fvi_free_parameter_base(which);
    const fvi_system *system = fit->run->system;
    if (fvi_free_parameter_index(which) > count_of_kind(fit, base))
        FVI_FAIL("there are not so many of this parameter", FVI_EINVAL);
    if (base == FVI_FREE_PARAMETER_ALPHA
        && fit->method->alpha_least == fit->method->alpha_most)
        FVI_FAIL("the method knows one alpha", FVI_EUNSUP);
    if (base == FVI_FREE_PARAMETER_ALPHA && (fit->run->law || system->mechanism))
        FVI_FAIL("a law of damping does not read alpha", FVI_EUNSUP);
    if ((base == FVI_FREE_PARAMETER_RHO || base == FVI_FREE_PARAMETER_MASS) && system->matrices)
        FVI_FAIL("masses and dampings of matrices are not fitted", FVI_EUNSUP);
    if (base == FVI_FREE_PARAMETER_MASS && system->mechanism && system->mechanism->lagrangian)
        FVI_FAIL("the masses are those of the Lagrangian", FVI_EUNSUP);
    if ((base == FVI_FREE_PARAMETER_MASS || base == FVI_FREE_PARAMETER_P0)
        && fvi_estimation_has_massless(system, fvi_free_parameter_index(which)))
        FVI_FAIL("a coordinate without inertia keeps its mass and its momentum, 0", FVI_EUNSUP);
    if ((base == FVI_FREE_PARAMETER_MASS || base == FVI_FREE_PARAMETER_X0 || base == FVI_FREE_PARAMETER_P0)
        && system->mechanism && system->mechanism->constraints)
        FVI_FAIL("with another mass, x0 or p0 the start breaks a constraint", FVI_EUNSUP);
    if (base == FVI_FREE_PARAMETER_RHO && system->mechanism)
        FVI_FAIL("a system with dampers has no rho", FVI_EUNSUP);
    if (!has_number(fit, which))
        FVI_FAIL("the law has no such number", FVI_EINVAL);
    if (base >= FVI_FREE_PARAMETER_CONSTANT && !fit->constants)
        FVI_FAIL("there are no constants", FVI_EFAULT);
    return FVI_SUCCESS;
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
        const int status = check_which(fit, fit->which[j]);
        if (status)
            return status;
        if (fit->low && fit->high
            && !(isfinite(fit->low[j]) && isfinite(fit->high[j])
                 && fit->low[j] < fit->high[j]))
            FVI_FAIL("the box is low < high", FVI_EDOM);
    }
    return FVI_SUCCESS;
}

int fvi_estimation_check(const fvi_estimation *fit)
{
    if (!fit || !fit->method || !fit->run || !fit->run->x0 || !fit->run->p0 || !fit->which
        || !fit->low != !fit->high)
        FVI_FAIL("a pointer of the fit is NULL", FVI_EFAULT);
    const fvi_system *system = fit->run->system;
    int status = fvi_system_require_any(system);
    if (!status)
        status = check_parameters(fit);
    if (!status)
        status = fvi_estimation_check_data(fit);
    if (!status && fit->h > 0 && !(fit->h * FVI_FIT_MOST_EQUAL_STEPS >= fvi_estimation_last_time(fit) * (1 - 1e-9)))
        FVI_FAIL("h is too short a part of the last time", FVI_EDOM);
    return status;
}
