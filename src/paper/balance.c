/* src/paper/balance.c -- Compute what a scheme with memory conserves, and what it loses. [H 21] */
#include <fvi/paper/balance.h>

#include "system/fail.h"
#include "system/system_check.h"

#include <gsl/gsl_math.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>

static int check(const fvi_balance_scheme *scheme, size_t N)
{
    if (!scheme)
        FVI_FAIL("null pointer", FVI_EFAULT);
    int status = fvi_system_require(scheme->system);
    if (status)
        return status;
    if (!(scheme->alpha >= 0 && scheme->alpha <= 1))
        FVI_FAIL("alpha must be in [0, 1]", FVI_EDOM);
    if (!(scheme->kappa >= 0 && scheme->kappa <= 1))
        FVI_FAIL("kappa must be in [0, 1]", FVI_EDOM);
    if (!(scheme->theta >= 0 && scheme->theta <= 1))
        FVI_FAIL("theta must be in [0, 1]", FVI_EDOM);
    if (!(gsl_finite(scheme->h) && scheme->h > 0))
        FVI_FAIL("h must be finite and positive", FVI_EDOM);
    if (scheme->weights != FVI_DELTA_EULER
        && scheme->weights != FVI_DELTA_BDF2)
        FVI_FAIL("the weights must be those of EULER or BDF2", FVI_EINVAL);
    if (N == 0 || N >= SIZE_MAX / sizeof(double) / 2 / scheme->system->d - 2)
        FVI_FAIL("N must be at least 1 and 2 (N + 2) d addressable",
                 FVI_EINVAL);
    return FVI_SUCCESS;
}

/* Add factor a . B b to *sum. B is a full Hessian. */
static void add_form(size_t d, const double *B, double factor, const double *a,
                     const double *b, double *sum)
{
    for (size_t i = 0; i < d; i++)
        for (size_t j = 0; j < d; j++)
            *sum += factor * a[i] * B[i * d + j] * b[j];
}

/* ---- Green's identity ---- */

//> near
/* Compute *C = v_n . K u_{n+1} - u_n . K v_{n+1}, the symplectic form of the step. K = -m/h - kappa (1 - kappa) h U''
 * at the point where the step evaluates the potential. */
static int near(const fvi_balance_scheme *s, const double *x, const double *u,
                const double *v, double *room, double *C)
{
    const size_t d = s->system->d;
    const double factor = -s->kappa * (1 - s->kappa) * s->h;
    double *point = room, *B = room + d;
    *C = 0;
    for (size_t i = 0; i < d; i++) {
        point[i] = x ? s->kappa * x[i] + (1 - s->kappa) * x[d + i] : 0;
        *C -= s->system->mass[i] / s->h * (v[i] * u[d + i] - u[i] * v[d + i]);
    }
    int status = fvi_potential_hessian(s->system, point, B);
    if (status)
        return status;
    add_form(d, B, factor, v, u + d, C);
    add_form(d, B, -factor, u, v + d, C);
    return FVI_SUCCESS;
}
//< near

//> far
/* Return sum_{k <= n < j} (v_j . T_{jk} u_k - v_k . T_{kj} u_j), where T_{jk} = rho t_{j-k} and T_{k,k+1} = rho ahead.
 * On entry later_k is the sum of t_{j-k} v_j over j > n + 1, on return that over j > n. So all n together, from the
 * last to the first, cost O(N^2 d). */
static double far(const fvi_system *system, size_t n, const double *t,
                  double ahead, const double *u, const double *v, double *later)
{
    const size_t d = system->d;
    double sum = 0;
    for (size_t k = 0; k <= n; k++)
        for (size_t i = 0; i < d; i++) {
            later[k * d + i] += t[n + 1 - k] * v[(n + 1) * d + i];
            sum += system->damping[i] * later[k * d + i] * u[k * d + i];
        }
    for (size_t i = 0; i < d; i++)
        sum -= system->damping[i] * ahead * v[n * d + i] * u[(n + 1) * d + i];
    return sum;
}
//< far

int fvi_green_form(const fvi_balance_scheme *scheme, size_t N, const double *x,
                   const double *u, const double *v, double *C)
{
    int status = check(scheme, N);
    if (status)
        return status;
    if (!u || !v || !C)
        FVI_FAIL("null pointer", FVI_EFAULT);
    const size_t d = scheme->system->d;
    double *t = calloc(N + 2 + (N + 1) * d, sizeof *t);
    double *room = calloc(d + fvi_potential_hessian_size(scheme->system), sizeof *room);
    if (!t || !room) {
        free(t);
        free(room);
        FVI_FAIL("no memory for the form", FVI_ENOMEM);
    }
    status =
        fvi_cq_weights(scheme->weights, 2 * scheme->alpha, N + 2, t);
    //> green
    const double theta = scheme->theta;
    double *later = t + N + 2;
    const double scale = pow(scheme->h, 1 - 2 * scheme->alpha);
    const double ahead = scale * theta * t[0];
    for (size_t n = 0; n <= N; n++)
        t[n] = scale * ((1 - theta) * t[n] + theta * t[n + 1]);
    for (size_t n = N; n-- > 0 && !status;) {
        status = near(scheme, x ? x + n * d : NULL, u + n * d, v + n * d, room,
                      C + n);
        C[n] += far(scheme->system, n, t, ahead, u, v, later); /* (21.4) */
    }
    //< green
    free(t);
    free(room);
    return status;
}

/* ---- energy ---- */

/* Return delta(-1)^(2 alpha) (1 - 2 theta), the damping of an alternating motion. */
static double chi_at_minus_one(const fvi_balance_scheme *s)
{
    const double delta = s->weights == FVI_DELTA_BDF2 ? 4 : 2;
    return pow(delta, 2 * s->alpha) * (1 - 2 * s->theta);
}

int fvi_scheme_energy(const fvi_balance_scheme *scheme, size_t N,
                      const double *x, double *E, double *hat)
{
    int status = check(scheme, N);
    if (status)
        return status;
    if (!x || !E || !hat)
        FVI_FAIL("null pointer", FVI_EFAULT);
    const fvi_system *system = scheme->system;
    const size_t d = system->d;
    double *room = calloc(3 * d + fvi_potential_hessian_size(system), sizeof *room);
    if (!room)
        FVI_FAIL("no memory for the energy", FVI_ENOMEM);
    double *dx = room, *p = dx + d, *middle = p + d, *B = middle + d;
    const double h = scheme->h, share = gsl_pow_2(1 - 2 * scheme->kappa) / 8;
    const double eighth =
        pow(h, -2 * scheme->alpha) * chi_at_minus_one(scheme) / 8;
    //> energy
    for (size_t n = 0; n < N && !status; n++, x += d) {
        double damped = 0;
        for (size_t i = 0; i < d; i++) {
            dx[i] = x[d + i] - x[i];
            p[i] = system->mass[i] * dx[i] / h;
            middle[i] = (x[i] + x[d + i]) / 2;
            damped += system->damping[i] * dx[i] * dx[i];
        }
        status = fvi_energy(system, middle, p, E + n); /* (12.15) */
        if (share > 0 && !status) {
            status = fvi_potential_hessian(system, middle, B);
            add_form(d, B, -share, dx, dx, E + n);
        }
        hat[n] = E[n] - eighth * damped; /* (12.16) */
    }
    //< energy
    free(room);
    return status;
}
