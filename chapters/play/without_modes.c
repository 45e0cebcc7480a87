/* chapters/play/without_modes.c -- In place of the exponentials of chapter 12: the page
 * sums directly. The figures of the book have them. */
#include "memory/memory_kinds.h"

#include <fvi/error.h>

double fvi_exponentials_delta(size_t steps, double tolerance)
{
    (void)steps, (void)tolerance;
    return 0;
}

size_t fvi_exponentials_bytes(double nu, int rated, size_t d, size_t steps,
                              double delta)
{
    (void)nu, (void)rated, (void)d, (void)steps, (void)delta;
    return SIZE_MAX;
}

fvi_exponentials *fvi_exponentials_alloc(double nu, int rated, size_t d,
                                         size_t steps, double delta)
{
    (void)nu, (void)rated, (void)d, (void)steps, (void)delta;
    return NULL;
}

void fvi_exponentials_push(fvi_exponentials *e, const double *term, double *H)
{
    (void)e, (void)term, (void)H;
}

void fvi_exponentials_ahead(const fvi_exponentials *e, double *sum)
{
    (void)e, (void)sum;
}

int fvi_exponentials_visit(fvi_exponentials *e, fvi_visitor *v)
{
    (void)e, (void)v;
    return FVI_EUNSUP;
}

void fvi_exponentials_free(fvi_exponentials *e)
{
    (void)e;
}

fvi_exponentials *fvi_exponentials_copy(const fvi_exponentials *e)
{
    (void)e;
    return NULL;
}
