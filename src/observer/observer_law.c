/* src/observer/observer_law.c -- What the laws of a run answer in its first rows. [H 13, 26] */
#include "observer_law.h"

#include "kernel/kernel_responses.h"
#include "kernel/kernel_terms.h"
#include "run/run_damper.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static int is_same_term(const fvi_kernel_term *a, const fvi_kernel_term *b)
{
    if (a->kind == FVI_KERNEL_SYMBOL || b->kind == FVI_KERNEL_SYMBOL)
        return a == b;
    return a->kind == b->kind && a->rho == b->rho && a->alpha == b->alpha && a->time == b->time
           && a->end == b->end;
}

static int is_same_law(const fvi_kernel *a, const fvi_kernel *b)
{
    if (a->count != b->count)
        return 0;
    for (size_t i = 0; i < a->count; i++)
        if (!is_same_term(a->term + i, b->term + i))
            return 0;
    return 1;
}

/* The law of damper j, NULL if it is one power and powers are not asked for. */
static const fvi_kernel *law_of(const fvi_stepper *s, size_t j, int has_powers)
{
    const fvi_kernel *law = has_powers ? s->run.system->mechanism->damper[j].kernel : fvi_run_damper_of(&s->run, j).law;
    return law && fvi_kernel_is_power(law) && !has_powers ? NULL : law;
}

/* The different laws of the dampers, in the order in which they come. */
static void find_laws(fvi_law_rows *o, const fvi_stepper *s, int has_powers, const fvi_kernel **law)
{
    for (size_t j = 0; j < o->dampers; j++) {
        const fvi_kernel *of = law_of(s, j, has_powers);
        size_t i = 0;
        while (of && i < o->laws && !is_same_law(law[i], of))
            i++;
        o->law_of[j] = of ? i : FVI_NO_LAW;
        if (of && i == o->laws)
            law[o->laws++] = of;
    }
}

static int make_rows(const fvi_stepper *s, const fvi_kernel *law, size_t rows, fvi_law_row *first)
{
    double *exact = malloc(rows * sizeof first->exact);
    if (!exact)
        return FVI_ENOMEM;
    int status = fvi_kernel_responses(law, s->run.h, rows, exact);
    for (size_t k = 0; k < rows && !status; k++)
        memcpy(first[k].exact, exact + k * FVI_KERNEL_RESPONSES, sizeof first->exact);
    free(exact);
    if (!status)
        status = fvi_law_sums(s, law, rows, first);
    return status;
}

int fvi_law_rows_start(fvi_law_rows *o, const fvi_stepper *s, size_t dampers, int has_powers, size_t rows)
{
    const fvi_kernel **law = calloc(dampers + 1, sizeof *law);
    o->dampers = dampers;
    o->rows = rows;
    o->law_of = calloc(dampers + 1, sizeof *o->law_of);
    if (law && o->law_of)
        find_laws(o, s, has_powers, law);
    o->first = calloc(o->laws * rows + 1, sizeof *o->first);
    int status = law && o->law_of && o->first ? FVI_SUCCESS : FVI_ENOMEM;
    for (size_t i = 0; i < o->laws && !status; i++)
        status = make_rows(s, law[i], rows, o->first + i * rows);
    free(law);
    return status;
}

int fvi_law_rows_copy(const fvi_law_rows *from, fvi_law_rows *to)
{
    *to = *from;
    to->law_of = NULL;
    to->first = NULL;
    if (!from->law_of)
        return FVI_SUCCESS;
    const size_t laws = from->dampers * sizeof *to->law_of, rows = from->laws * from->rows * sizeof *to->first;
    to->law_of = malloc(laws + 1);
    to->first = malloc(rows + 1);
    if (!to->law_of || !to->first)
        return FVI_ENOMEM;
    memcpy(to->law_of, from->law_of, laws);
    memcpy(to->first, from->first, rows);
    return FVI_SUCCESS;
}

void fvi_law_rows_free(fvi_law_rows *o)
{
    free(o->law_of);
    free(o->first);
}

const fvi_law_row *fvi_law_rows_of(const fvi_law_rows *o, size_t j)
{
    if (!o->law_of || o->law_of[j] == FVI_NO_LAW)
        return NULL;
    const fvi_law_row *first = o->first + o->law_of[j] * o->rows;
    return first->exact[FVI_STARTS] > 0 ? first : NULL;
}
