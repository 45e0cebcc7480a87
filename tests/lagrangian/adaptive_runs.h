/* tests/lagrangian/adaptive_runs.h -- Runs of fvi-adaptive to their end. */
#ifndef ADAPTIVE_RUNS_H
#define ADAPTIVE_RUNS_H

#include "problems.h"

#include "run/whole_run.h"
#include "system/larger.h"

/* The stepper at the end of a run of one row; an error ends the test. */
static inline fvi_stepper *at_end(const fvi_run *run)
{
    fvi_stepper *s;
    fvi_error error = { 0 };
    const int status = fvi_stepper_start(&fvi_variable_step, run, &s, &error);
    ck_assert_msg(status == 0, "%d %s", status, error.text);
    while (s->k < run->steps)
        OK(fvi_stepper_step(s));
    return s;
}

static inline double off(const fvi_stepper *s, const double *x)
{
    double most = 0;
    for (size_t j = 0; j < s->run.system->d; j++)
        most = larger(most, fabs(s->x[j] - x[j]));
    return most;
}

#endif
