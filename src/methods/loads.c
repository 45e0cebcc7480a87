/* src/methods/loads.c -- The loads of the methods.       [Chapters 13, 14 and 17] */
#include "loads.h"

#include <fvi/stability.h>
#include "stability/stability_share.h"

#include <math.h>

int fvi_load_backward(const fvi_run *run, double *load)
{
    return fvi_stability_share(1, run, load);
}

int fvi_load_shifted(const fvi_run *run, double *load)
{
    double largest;
    int status = fvi_stability_share(1 - 2 * run->alpha, run, &largest);
    if (!status)
        *load = fmax(0, largest); /* alpha > 1/2: the damping helps */
    return status;
}

int fvi_load_bdf2(const fvi_run *run, double *load)
{
    return fvi_stability_share(pow(4, run->alpha), run, load);
}

int fvi_load_lobatto2(const fvi_run *run, double *load)
{
    return fvi_stability_lobatto(2, run, load);
}

int fvi_load_lobatto3(const fvi_run *run, double *load)
{
    return fvi_stability_lobatto(3, run, load);
}

int fvi_load_lobatto4(const fvi_run *run, double *load)
{
    return fvi_stability_lobatto(4, run, load);
}
