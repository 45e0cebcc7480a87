/* src/system/stiffness.c -- Bound the eigenvalues of a Hessian.  [H 18] */
#include "stiffness.h"
#include "system/larger.h"

#include <fvi/error.h>

#include <math.h>
#include <stdlib.h>

/* Return sum_j |H_ij|. Row i of a band holds the diagonal and the entries to its right. The entries to the left are
 * found in the rows above, by symmetry. */
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

double fvi_stiffness(const fvi_system *system, const double *H)
{
    const size_t d = system->d;
    double most = 0;
    for (size_t i = 0; i < d; i++)
        most = larger(most, row_sum(H, d, system->potential.diagonals, i)
                                / system->mass[i]);
    return most;
}

int fvi_potential_stiffness(const fvi_system *system, const double *x, double *stiffness)
{
    const fvi_potential *u = &system->potential;
    double *H = malloc(system->d * (u->diagonals ? u->diagonals : system->d) * sizeof *H);
    const int status = H ? u->hessian(system->d, x, u->params, H) : FVI_ENOMEM;
    if (!status)
        *stiffness = fvi_stiffness(system, H);
    free(H);
    return status;
}
