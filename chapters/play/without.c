/* chapters/play/without.c -- In place of what a run of the page never reaches.
 *
 * So that neither the FFT nor the laws of chapter 26 need to be there. */
#include "memory/memory_kinds.h"

#include <fvi/damping_laws.h>
#include <fvi/error.h>
#include <math.h>

/* ---- blocks of convolutions ---- */

size_t fvi_blocks_bytes(size_t d, size_t steps)
{
    (void)d, (void)steps;
    return SIZE_MAX;
}

fvi_blocks *fvi_blocks_alloc(double nu, int rate, size_t d, size_t steps)
{
    (void)nu, (void)rate, (void)d, (void)steps;
    return NULL; /* fvi_memory_alloc then returns FVI_ENOMEM */
}

void fvi_blocks_push(fvi_blocks *b, const double *term, double *H)
{
    (void)b, (void)term, (void)H;
}

void fvi_blocks_ahead(const fvi_blocks *b, double *sum)
{
    (void)b, (void)sum;
}

int fvi_blocks_visit(fvi_blocks *b, fvi_visitor *v)
{
    (void)b, (void)v;
    return FVI_EUNSUP;
}

void fvi_blocks_free(fvi_blocks *b)
{
    (void)b;
}

fvi_blocks *fvi_blocks_copy(const fvi_blocks *b)
{
    (void)b;
    return NULL;
}

/* ---- the laws of chapter 26: a run of the page has none ---- */

int fvi_law_check(const fvi_law *law)
{
    (void)law;
    return FVI_EUNSUP;
}

double fvi_law_symbol(const fvi_law *law, double s)
{
    (void)law, (void)s;
    return NAN;
}

int fvi_law_memory(const fvi_law *law, fvi_quadrature kind, double h, size_t d,
                   size_t steps, fvi_memory_kind how, double tolerance,
                   double *first, fvi_memory **memory)
{
    (void)law, (void)kind, (void)h, (void)d, (void)steps, (void)how;
    (void)tolerance, (void)first, (void)memory;
    return FVI_EUNSUP;
}
