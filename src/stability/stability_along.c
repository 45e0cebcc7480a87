/* src/stability/stability_along.c -- Is the step stable where a run has come to? [Chapter 14] */
#include <fvi/stability.h>

#include "system/fail.h"

#include <gsl/gsl_math.h>
#include <math.h>
#include <stdlib.h>

/* sum_j |H_ij|; of a band, row i holds the diagonal and what is right of it. */
static double row_sum(const double *H, size_t d, size_t diagonals, size_t i)
{
    double sum = 0;
    for (size_t j = 0; j < d && diagonals == 0; j++)
        sum += fabs(H[i * d + j]);
    for (size_t k = 0; k < diagonals; k++) {
        sum += i + k < d ? fabs(H[i * diagonals + k]) : 0;
        sum += k > 0 && k <= i ? fabs(H[(i - k) * diagonals + k]) : 0;
    }
    return sum;
}

/* max_i sum_j |U_ij(x)| / m_i: no |eigenvalue| of M^{-1} Hess U is above it
 * (Gershgorin). */
static int stiffness_at(const fvi_system *system, const double *x,
                        double *stiffness)
{
    const fvi_potential *u = &system->potential;
    const size_t d = system->d, width = u->diagonals ? u->diagonals : d;
    double *H = malloc(d * width * sizeof *H);
    if (!H)
        FVI_FAIL("no memory for the Hessian", FVI_ENOMEM);
    int status = u->hessian(d, x, u->params, H);
    *stiffness = 0;
    for (size_t i = 0; i < d && !status; i++)
        *stiffness =
            fmax(*stiffness, row_sum(H, d, u->diagonals, i) / system->mass[i]);
    free(H);
    return status;
}

//> along
int fvi_stability_along(const fvi_method *method, const fvi_run *run,
                        const double *x, double *stiffest, double *load)
{
    if (!method || !run || !x || !stiffest || !load)
        FVI_FAIL("null pointer", FVI_EFAULT);
    int status = fvi_system_check(run->system);
    if (status)
        return status;
    double stiffness = 0, there = 0;
    if (run->system->potential.hessian)
        status = stiffness_at(run->system, x, &stiffness);
    if (!status && stiffness > 1.05 * *stiffest) {
        fvi_run here = *run;
        here.x0 = x;
        status = fvi_stability_load(method, &here, &there);
        if (!status)
            *stiffest = stiffness;
    }
    if (!status)
        *load = there;
    return status;
}
//< along
