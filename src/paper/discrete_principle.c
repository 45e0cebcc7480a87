/* src/paper/discrete_principle.c -- Compute the non-local discrete action and its gradient.     [H 6] */
#include <fvi/paper/discrete_principle.h>

#include <fvi/coefficients.h>
#include <fvi/discrete_mechanics.h>
#include <fvi/paper/integration_by_parts.h>
#include "system/fail.h"
#include "system/system_check.h"

#include <gsl/gsl_math.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>

/* The arguments of both functions. */
typedef struct {
    const fvi_system *system;
    double alpha, kappa, h;
    size_t N, first, last;
    const double *x, *y;
} problem;

static int check(const problem *p)
{
    int status = fvi_system_require(p->system);
    if (status)
        return status;
    if (!p->x || !p->y)
        FVI_FAIL("null pointer", FVI_EFAULT);
    if (!(p->alpha >= 0 && p->alpha <= 1))
        FVI_FAIL("alpha must be in [0, 1]", FVI_EDOM);
    if (!(p->kappa >= 0 && p->kappa <= 1))
        FVI_FAIL("kappa must be in [0, 1]", FVI_EDOM);
    if (!(gsl_finite(p->h) && p->h > 0))
        FVI_FAIL("h must be finite and positive", FVI_EDOM);
    if (p->N == 0 || p->N >= SIZE_MAX / sizeof(double) / 4 / p->system->d)
        FVI_FAIL("N must be at least 1 and 4 (N + 1) d addressable",
                  FVI_EINVAL);
    if (p->first > p->last || p->last > p->N)
        FVI_FAIL("the fractional sum needs first <= last <= N", FVI_EINVAL);
    return FVI_SUCCESS;
}

/* Allocate four sequences, and fill in the first two: X = Delta_- x and Y = Delta_+ y. */
static int derivatives(const problem *p, double **room)
{
    const size_t d = p->system->d, length = (p->N + 1) * d;
    double *X = calloc(4 * length, sizeof *X);
    if (!X)
        FVI_FAIL("no memory for the fractional derivatives", FVI_ENOMEM);
    int status = fvi_delta_minus(p->alpha, p->h, p->N, d, p->x, X);
    if (!status)
        status = fvi_delta_plus(p->alpha, p->h, p->N, d, p->y, X + length);
    if (status)
        free(X);
    else
        *room = X;
    return status;
}

int fvi_discrete_action(const fvi_system *system, double alpha, double kappa,
                        double h, size_t N, size_t first, size_t last,
                        const double *x, const double *y, double *S)
{
    const problem p = { system, alpha, kappa, h, N, first, last, x, y };
    double *X, sum = 0;
    int status = check(&p);
    if (!status && !S)
        FVI_FAIL("null pointer", FVI_EFAULT);
    if (!status)
        status = derivatives(&p, &X);
    if (status)
        return status;
    const size_t d = system->d;
    const double *Y = X + (N + 1) * d;
    //> action
    for (size_t k = 0; k < N && !status; k++) {
        const double *curve[] = { x + k * d, y + k * d };
        for (size_t c = 0; c < 2 && !status; c++) {
            double L = 0;
            status = fvi_discrete_lagrangian(system, kappa, h, curve[c],
                                             curve[c] + d, &L);
            sum += L;
        }
    }
    for (size_t k = first; k <= last; k++)
        for (size_t i = 0; i < d; i++)
            sum -= h * X[k * d + i] * system->damping[i] * Y[k * d + i];
    //< action
    free(X);
    if (!status)
        *S = sum; /* (6.2) */
    return status;
}

//> slopes
/* Compute g_k = D1 L_d(z_k, z_{k+1}) + D2 L_d(z_{k-1}, z_k), k = 0, ..., N. Each step gives one slope to each of its
 * ends. D has room for d numbers. */
static int mechanical(const problem *p, const double *z, double *D, double *g)
{
    const size_t d = p->system->d;
    for (size_t k = 0; k < p->N; k++) {
        double *here = g + k * d, *next = here + d;
        int status = fvi_discrete_slopes(p->system, p->kappa, p->h, z + k * d,
                                         z + (k + 1) * d, D, next);
        if (status)
            return status;
        for (size_t i = 0; i < d; i++)
            here[i] += D[i]; /* g_0 begins as 0, g_k as D2 */
    }
    return FVI_SUCCESS;
}
//< slopes

//> fractional
/* Add the contribution of the fractional sum. Delta_- x_i contains x_k for i >= k with the weight alpha_{i-k}, and
 * Delta_+ y_i contains y_k for i <= k with the weight alpha_{k-i}. */
static void fractional(const problem *p, const double *w, const double *X,
                       const double *Y, double *gx, double *gy)
{
    const size_t d = p->system->d;
    const double scale = p->h * pow(p->h, -p->alpha);
    for (size_t k = 0; k <= p->N; k++)
        for (size_t j = 0; j < d; j++) {
            double ahead = 0, behind = 0;
            for (size_t i = p->first; i <= p->last; i++) {
                if (i >= k)
                    ahead += w[i - k] * Y[i * d + j];
                if (i <= k)
                    behind += w[k - i] * X[i * d + j];
            }
            gx[k * d + j] -= scale * p->system->damping[j] * ahead; /* (6.5) */
            gy[k * d + j] -= scale * p->system->damping[j] * behind;
        }
}
//< fractional

int fvi_discrete_action_gradient(const fvi_system *system, double alpha,
                                 double kappa, double h, size_t N, size_t first,
                                 size_t last, const double *x, const double *y,
                                 double *gx, double *gy)
{
    const problem p = { system, alpha, kappa, h, N, first, last, x, y };
    int status = check(&p);
    if (status)
        return status;
    if (!gx || !gy)
        FVI_FAIL("null pointer", FVI_EFAULT);
    const size_t d = system->d, length = (N + 1) * d;
    double *X, *w = malloc((N + 1 + d) * sizeof *w);
    if (!w)
        FVI_FAIL("no memory for the weights", FVI_ENOMEM);
    status = derivatives(&p, &X);
    if (!status) {
        double *Y = X + length, *fx = Y + length, *fy = fx + length;
        status = fvi_gl_weights(alpha, N + 1, w);
        if (!status)
            status = mechanical(&p, x, w + N + 1, fx);
        if (!status)
            status = mechanical(&p, y, w + N + 1, fy);
        if (!status) {
            fractional(&p, w, X, Y, fx, fy);
            for (size_t i = 0; i < length; i++) {
                gx[i] = fx[i];
                gy[i] = fy[i];
            }
        }
        free(X);
    }
    free(w);
    return status;
}
