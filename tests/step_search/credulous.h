/* tests/step_search/credulous.h -- A search that believes its estimate, for the tests of
 * H 18: what it accepts and is wrong, fvi_step_search has to refuse. */
#ifndef CREDULOUS_H
#define CREDULOUS_H

#include "step_search_runs.h"
#include "error_control/step_search.h"
#include "system/larger.h"

static inline void run_rows(const fvi_method *method, fvi_run run, size_t rows,
                            size_t parts, double *x)
{
    fvi_stepper *s;
    run.h /= (double)parts;
    run.steps = rows * parts;
    ck_assert_int_eq(fvi_stepper_start(method, &run, &s, NULL), FVI_SUCCESS);
    int status = FVI_SUCCESS;
    for (size_t k = 0; k <= rows; k++) {
        x[k] = status ? GSL_NAN : s->x[0];
        for (size_t i = 0; i < parts && k < rows && !status; i++)
            status = fvi_stepper_step(s);
    }
    fvi_stepper_free(s);
}

/* (18.2), the order held between 1/4 and the lowest of the method, at once believed:
 * no second order, no evaluation of F. Only x of the caller's rows is compared. */
static inline int credulous(const fvi_method *method, const fvi_run *run,
                            double error, size_t most, double *x, double *p,
                            fvi_step_found *found)
{
    double before[ROWS + 1], D = GSL_POSINF, D_before;
    size_t first = 1;
    (void)p;
    while (run->steps * first < 128)
        first *= 2;
    for (size_t parts = first; run->steps * parts <= most; parts *= 2) {
        run_rows(method, *run, run->steps, parts, x);
        D_before = D;
        D = parts == first ? GSL_POSINF : 0;
        for (size_t k = 0; k <= run->steps && parts > first; k++)
            D = isnan(x[k] - before[k]) ? GSL_POSINF
                                        : larger(D, fabs(x[k] - before[k]));
        double by = D_before > D ? log2(D_before / D) : 0,
               q = smaller(larger(by, 0.25), method->lowest);
        *found = (fvi_step_found){ .parts = parts, .estimate = D / (exp2(q) - 1), .order = q };
        if (isfinite(D_before) && found->estimate <= error)
            return FVI_SUCCESS;
        memcpy(before, x, sizeof before);
    }
    return FVI_ETOL;
}

#endif
