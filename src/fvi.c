/* src/fvi.c -- Fractional variational integrators.               [Chapter 9] */
#include "fvi.h"

#include "damping.h"
#include "discrete_mechanics.h"
#include "half_derivative.h"
#include "legendre.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* ---- the memory of the damped coordinates ---- */

void fvi_damping_free(fvi_damping *d)
{
    if (!d)
        return;
    fvi_memory_free(d->memory);
    free(d->index);
    free(d->factor);
    free(d);
}

/* Zeros for the numbers of `count` coordinates. */
static int damping_alloc(size_t count, fvi_damping **damping)
{
    fvi_damping *d = *damping = calloc(1, sizeof *d);
    if (!d)
        GSL_ERROR("no memory for the damping", GSL_ENOMEM);
    d->index = malloc(count * sizeof *d->index);
    d->factor = calloc(5 * count, sizeof *d->factor);
    if (!d->index || !d->factor)
        GSL_ERROR("no memory for the damping", GSL_ENOMEM);
    d->origin = d->factor + count;
    d->drift = d->factor + 2 * count;
    d->z = d->factor + 3 * count;
    d->dz = d->factor + 4 * count;
    return GSL_SUCCESS;
}

int fvi_damping_start(const fvi_stepper *s, fvi_past past,
                      fvi_damping **damping)
{
    const fvi_run *run = &s->run;
    const fvi_system *system = run->system;
    const double order = 2 * run->alpha;
    size_t count = 0;
    *damping = NULL;
    for (size_t i = 0; i < system->d; i++)
        count += system->damping[i] > 0;
    if (count == 0) /* nothing damped: no memory at all */
        return GSL_SUCCESS;
    int status = damping_alloc(count, damping);
    if (status)
        return status;
    fvi_damping *d = *damping;
    //> start
    for (size_t i = 0; i < system->d; i++) {
        if (system->damping[i] == 0)
            continue;
        size_t j = d->count++;
        d->index[j] = i;
        d->factor[j] = system->damping[i] * pow(run->h, 1 - order);
        if (past != FVI_PAST_RIEMANN_LIOUVILLE)
            d->origin[j] = s->x[i]; /* (9.6) */
        if (past == FVI_PAST_CAPUTO && order > 1)
            d->drift[j] = run->h * s->p[i] / system->mass[i];
        d->z[j] = d->dz[j] = s->x[i] - d->origin[j]; /* the term k = 0 */
    }
    //< start
    status = fvi_memory_alloc(order, count, run->steps, run->memory,
                              run->tolerance, &d->memory);
    if (!status)
        status = fvi_memory_push(d->memory, d->z, d->dz, d->dz);
    return status;
}

static int start_fractional(fvi_stepper *s)
{
    fvi_damping *d;
    int status = fvi_variational_solver(s);
    if (status)
        return status;
    status = fvi_damping_start(s, s->run.past, &d);
    s->own = d;
    return status;
}

static void stop_fractional(fvi_stepper *s)
{
    fvi_damping_free(s->own);
}

//> damp
/* p_{k+1} -= h rho Delta_-^alpha Delta_-^alpha x_{k+1} */
static int damp(fvi_stepper *s, fvi_damping *d)
{
    for (size_t j = 0; j < d->count; j++) {
        d->z[j] = s->x[d->index[j]] - d->origin[j];
        d->dz[j] = s->dx[d->index[j]] - d->drift[j];
    }
    int status = fvi_memory_push(d->memory, d->z, d->dz, d->z);
    for (size_t j = 0; j < d->count; j++)
        s->p[d->index[j]] -= d->factor[j] * d->z[j];
    return status;
}
//< damp

//> step
static int step_fractional(fvi_stepper *s)
{
    const double h = s->run.h;
    int status = fvi_newton_solve(s->newton, s->x, s->p, s->dx, s->g);
    if (status)
        return status;
    fvi_force_at(s, (double)(s->k + 1) * h);
    for (size_t i = 0; i < s->run.system->d; i++) {
        s->x[i] += s->dx[i];
        s->p[i] += h * (s->F[i] - s->g[i]);
    }
    return s->own ? damp(s, s->own) : GSL_SUCCESS; /* (9.4) */
}
//< step

const fvi_method fvi_fractional = { .name = "fvi",
                                    .order = "1",
                                    .lowest = 1,
                                    .highest = 1,
                                    .memory = "full",
                                    .as_printed = 1,
                                    .start = start_fractional,
                                    .step = step_fractional,
                                    .stop = stop_fractional };

/* ---- Algorithm 3 as printed ---- */

/* The loop of Algorithm 3. c are the weights of two derivatives of order alpha. */
//> algorithm-3
static int three_terms(const fvi_system *system, double kappa, double h,
                       size_t N, double p0, const double *c, double factor,
                       double *x)
{
    double p = p0, F = 0; /* p_0 = -D1 L_d(x_0, x_1) gives x_1 */
    for (size_t k = 0; k < N; k++) {
        if (k > 0) {
            double D = 0; /* Delta_-^alpha Delta_-^alpha x_k */
            for (size_t n = 0; n <= k; n++)
                D += factor * c[n] * x[k - n];
            if (system->force.value)
                system->force.value((double)k * h, 1, system->force.params, &F);
            /* p = D2 L_d(x_{k-1}, x_k) - h rho D + h F(t_k) */
            int status = fvi_legendre_plus(system, kappa, h, x + k - 1, x + k,
                                           &D, &F, &p);
            if (status)
                return status;
        }
        if (!gsl_finite(p))
            GSL_ERROR("a value is no longer finite", GSL_EOVRFLW);
        /* x_{k+1} from -D1 L_d(x_k, x_{k+1}) = p */
        int status =
            fvi_legendre_inverse(system, kappa, h, x + k, &p, x + k + 1);
        if (status)
            return status;
    }
    return GSL_SUCCESS;
}
//< algorithm-3

int fvi_algorithm_3(const fvi_system *system, double alpha, double kappa,
                    double h, size_t N, double x0, double p0, double *x)
{
    if (!x)
        GSL_ERROR("null pointer", GSL_EFAULT);
    int status = fvi_system_check(system);
    if (status)
        return status;
    if (system->d != 1)
        GSL_ERROR("Algorithm 3 as printed is in one dimension", GSL_EINVAL);
    if (N >= SIZE_MAX / sizeof(double) / 2 - 1)
        GSL_ERROR("N must be addressable", GSL_EINVAL);
    const fvi_run run = { .system = system,
                          .x0 = &x0,
                          .p0 = &p0,
                          .h = h,
                          .steps = N,
                          .kappa = kappa,
                          .alpha = alpha,
                          .past = FVI_PAST_RIEMANN_LIOUVILLE };
    fvi_stepper *s;
    status = fvi_start(&fvi_fractional, &run, &s); /* only to check them */
    if (status)
        return status;
    fvi_stop(s);
    double *c = malloc(2 * (N + 1) * sizeof *c);
    if (!c)
        GSL_ERROR("no memory for the weights", GSL_ENOMEM);
    double *path = c + N + 1;
    path[0] = x0;
    status = fvi_coefficients_product(alpha, alpha, N + 1, c);
    if (!status)
        status =
            three_terms(system, kappa, h, N, p0, c, pow(h, -2 * alpha), path);
    if (!status)
        memcpy(x, path, (N + 1) * sizeof *x);
    free(c);
    return status;
}
