/* src/system/damping_matrix.c -- Multiply by a damping matrix that is given as functions.  [H 27] */
#include "damping_matrix.h"

#include "fail.h"

#include <stdlib.h>

int fvi_damping_multiply(const fvi_damping_matrix *C, size_t d, double factor, const double *x, double *y)
{
    if (C->history_size == 0)
        return FVI_SUCCESS;
    double *z = calloc(2 * C->history_size, sizeof *z);
    if (!z)
        FVI_FAIL("no memory for a product with C", FVI_ENOMEM);
    int status = C->select_history(d, x, z + C->history_size, C->params, z);
    if (!status)
        status = C->apply_damping(d, -factor, z, C->params, y);
    free(z);
    return status;
}
