/* src/observer/observer_law.c -- The rows of the laws of a run: their exact answers, and the impulses of the steps.
 * [H 13, 26] */
#include "observer_law.h"

#include "kernel/kernel_responses.h"
#include "kernel/kernel_terms.h"
#include "run/run_damper.h"

#include <stdlib.h>
#include <string.h>

static int is_same_sum(const fvi_summed_damper *a, const fvi_summed_damper *b)
{
    return a->law || b->law ? fvi_is_same_law(a->law, b->law)
                            : a->power.rho == b->power.rho && a->power.alpha == b->power.alpha;
}

fvi_summed_damper fvi_summed_damper_of(const fvi_stepper *s, size_t j)
{
    const fvi_system *system = s->run.system;
    const fvi_run_damper of = fvi_run_damper_of(&s->run, j);
    const int is_by_kernel = system->mechanism && !system->matrices;
    return (fvi_summed_damper){ .law = is_by_kernel ? system->mechanism->damper[j].kernel : of.law,
                                .power = { .kind = FVI_KERNEL_POWER, .rho = of.rho, .alpha = of.alpha } };
}

/* Find the dampers that are summed in different ways, in the order in which they occur. */
static void find_laws(fvi_law_rows *o, const fvi_stepper *s, fvi_summed_damper *law)
{
    for (size_t j = 0; j < o->dampers; j++) {
        const fvi_summed_damper of = fvi_summed_damper_of(s, j);
        size_t i = 0;
        while (i < o->laws && !is_same_sum(&law[i], &of))
            i++;
        o->law_of[j] = i;
        if (i == o->laws)
            law[o->laws++] = of;
    }
}

static int make_rows(const fvi_stepper *s, const fvi_summed_damper *of, size_t rows, fvi_law_row *first)
{
    const fvi_kernel power = { .count = 1, .term = &of->power };
    double *exact = malloc(rows * sizeof first->exact);
    if (!exact)
        return FVI_ENOMEM;
    int status = fvi_kernel_responses(of->law ? of->law : &power, s->run.h, rows, exact);
    for (size_t k = 0; k < rows && !status; k++)
        memcpy(first[k].exact, exact + k * FVI_KERNEL_RESPONSES, sizeof first->exact);
    free(exact);
    if (!status)
        status = fvi_law_sums(s, of, rows, first);
    return status;
}

int fvi_law_rows_start(fvi_law_rows *o, const fvi_stepper *s, size_t dampers, size_t rows)
{
    fvi_summed_damper *law = calloc(dampers + 1, sizeof *law);
    o->dampers = dampers;
    o->rows = rows;
    o->law_of = calloc(dampers + 1, sizeof *o->law_of);
    if (law && o->law_of)
        find_laws(o, s, law);
    o->first = calloc(o->laws * rows + 1, sizeof *o->first);
    int status = law && o->law_of && o->first ? FVI_SUCCESS : FVI_ENOMEM;
    for (size_t i = 0; i < o->laws && !status; i++)
        status = make_rows(s, &law[i], rows, o->first + i * rows);
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
    if (!o->law_of)
        return NULL;
    const fvi_law_row *first = o->first + o->law_of[j] * o->rows;
    return first->exact[FVI_STARTS] > 0 ? first : NULL;
}
