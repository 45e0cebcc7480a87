/* src/inverse/mirror_stages_terms.c -- The terms of a law, through stages. [Chapter 23]
 *
 * The derivative by the factor of a term is that by rho with the weights of this term
 * alone: each has a memory of what goes backwards. */
#include "mirror_stages.h"

#include "methods/lobatto_stages.h"
#include "system/fail.h"

#include <stdlib.h>

/* The memory of one term, with rho = 1. */
static int start_one(const fvi_mirror_stages *m, size_t l,
                     fvi_lobatto_memory **memory)
{
    const fvi_run *run = m->run;
    fvi_law_term term = run->law->term[l];
    const fvi_law alone = { 1, &term };
    term.rho = 1;
    return fvi_lobatto_memory_of_law(m->s, &alone, run->h, m->d, run->steps,
                                     run->memory, fvi_lobatto_finer(run),
                                     memory);
}

int fvi_mirror_terms_start(fvi_mirror_stages *m)
{
    const size_t count = m->want->terms ? m->run->law->count : 0;
    int status = FVI_SUCCESS;
    if (count == 0)
        return status;
    m->each = calloc(count, sizeof *m->each);
    m->each_past = calloc(count * m->s * m->d, sizeof *m->each_past);
    if (!m->each || !m->each_past)
        FVI_FAIL("no memory for the mirrored run", FVI_ENOMEM);
    for (; !status && m->terms < count; m->terms += !status)
        status = start_one(m, m->terms, &m->each[m->terms]);
    return status;
}

void fvi_mirror_terms_stop(fvi_mirror_stages *m)
{
    for (size_t l = 0; l < m->terms; l++)
        fvi_lobatto_memory_free(m->each[l]);
    free(m->each);
    free(m->each_past);
}

void fvi_mirror_terms_meet(fvi_mirror_stages *m, size_t j, const double *v)
{
    const size_t s = m->s;
    const double *Lambda = m->Lambda + j * s;
    const double weight = m->run->h * m->run->system->damping[j];
    for (size_t l = 0; l < m->terms; l++) {
        const double *W = fvi_lobatto_memory_now(m->each[l]);
        const double *past = m->each_past + (l * m->d + j) * s;
        for (size_t i = 0; i < s; i++) {
            double T = past[i];
            for (size_t c = 0; c < s; c++)
                T += W[i * s + c] * Lambda[s - 1 - c];
            m->want->terms[l] -= weight * m->rule->b[i] * v[s - 1 - i] * T;
        }
    }
}

int fvi_mirror_terms_remember(fvi_mirror_stages *m)
{
    int status = FVI_SUCCESS;
    for (size_t l = 0; !status && l < m->terms; l++)
        status = fvi_lobatto_memory_push(m->each[l], m->T,
                                         m->each_past + l * m->s * m->d);
    return status;
}
