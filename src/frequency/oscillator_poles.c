/* src/frequency/oscillator_poles.c -- Find the poles of a system with one unknown.    [H 30] */
#include "oscillator_poles.h"
#include "exact_law.h"
#include "pole_search.h"

#include <stdlib.h>

/* Add all dampings to one law, with a common factor. Return its terms, which the caller frees; NULL without memory. */
static fvi_kernel_term *sum_of_laws(const fvi_response *r, fvi_kernel *law,
                                    double *factor)
{
    size_t count = 0;
    for (size_t l = 2; l < r->terms; l++)
        count += r->term[l].kernel->count;
    fvi_kernel_term *term = malloc((count + 1) * sizeof *term);
    *law = (fvi_kernel){ 0, term };
    *factor = 1;
    for (size_t l = 2; term && l < r->terms; l++)
        for (size_t i = 0; i < r->term[l].kernel->count; i++) {
            term[law->count] = r->term[l].kernel->term[i];
            term[law->count++].rho *= *r->term[l].matrix->entry;
        }
    if (r->terms == 3 && r->term[2].kernel->term->kind == FVI_KERNEL_SYMBOL) {
        *law = *r->term[2].kernel; /* a law that is a function keeps its own term, to which the function belongs */
        *factor = *r->term[2].matrix->entry;
    }
    return term;
}

int fvi_oscillator_poles(const fvi_response *r, size_t most, fvi_pole *pole, size_t *count)
{
    const double m = *r->term[0].matrix->entry, c = *r->term[1].matrix->entry;
    fvi_kernel law;
    double factor;
    fvi_kernel_term *term = sum_of_laws(r, &law, &factor);
    int status = term ? FVI_SUCCESS : FVI_ENOMEM, is_special = c >= 0;
    for (size_t i = 0; !status && law.count > 1 && i < law.count; i++)
        is_special = is_special && law.term[i].kind != FVI_KERNEL_SYMBOL;
    *count = 0;
    if (!status && is_special) {
        const int is_power =
            law.count == 1 && law.term->kind == FVI_KERNEL_POWER;
        if (is_power || law.count == 0)
            *count = (size_t)fvi_pole_find(m, c, is_power ? law.term->rho : 0,
                                           is_power ? 2 * law.term->alpha : 0, pole);
        else if (fvi_kernel_poles(m, c, factor, &law, FVI_NEARLY_REAL, most, pole, count, NULL))
            *count = 0;
    }
    free(term);
    return status;
}
