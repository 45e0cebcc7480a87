/* src/error_control/solve_between.c -- Solve to a tolerance at any times, by the path of the stages of a step. [H 17,
 * 18]
 *
 * fvi_step_search finds a step for the common rows. Then the step is halved until two runs agree at the times
 * themselves. */
#include "solve_state.h"

#include "error_control/search_bound.h"
#include "error_control/step_search.h"
#include "system/fail.h"
#include "system/larger.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Write all rows of a run whose steps are h / parts. */
static int rows_at_times(const fvi_solve_state *o, size_t parts, double *x, double *p)
{
    const fvi_outputs rows = { .rows = o->out->rows, .t = o->out->t, .x = x, .p = p };
    fvi_report report;
    fvi_solve_state finer = *o;
    finer.out = &rows;
    finer.report = &report;
    finer.error = NULL;
    finer.run.h /= (double)parts;
    finer.run.steps *= parts;
    return fvi_solve_by_steps(&finer);
}

/* The last of the times up to which two runs differ by no more than the tolerance. */
static double agreed_until(const fvi_solve_state *o, const double *x, const double *before)
{
    const size_t k = fvi_search_agreed(o->out->rows, o->run.system->d, x, before, o->tolerance);
    return k > 0 ? o->out->t[k - 1] : 0;
}

/* Halve the steps until two runs agree at the times. x and p are then those of the finer run. */
static int halve_until_agreed(fvi_solve_state *o, size_t parts, size_t most, double *x, double *p, double *before)
{
    const size_t length = o->out->rows * o->run.system->d;
    double least = INFINITY;
    int status = rows_at_times(o, parts, before, p);
    o->report->until = 0; /* agreement at the ends of steps says nothing about the times */
    while (!status) {
        if (parts > most / 2 / o->run.steps) {
            o->report->error = least;
            return FVI_ETOL;
        }
        parts *= 2;
        status = rows_at_times(o, parts, x, p);
        const double difference = status ? INFINITY : largest_difference(length, x, before);
        least = smaller(least, difference);
        o->report->steps = parts * o->run.steps;
        o->report->h = o->run.h / (double)parts;
        if (!status && difference <= o->tolerance) {
            o->report->error = larger(o->report->error, difference);
            return FVI_SUCCESS;
        }
        if (!status)
            o->report->until = larger(o->report->until, agreed_until(o, x, before));
        memcpy(before, x, length * sizeof *before);
    }
    return status;
}

int fvi_solve_between(fvi_solve_state *o, size_t most, double *x, double *p)
{
    const size_t d = o->run.system->d, nodes = (o->run.steps + 1) * d, length = o->out->rows * d;
    fvi_step_found found = { .estimate = INFINITY, .parts = 1 };
    double *room = malloc((nodes + length) * sizeof *room);
    if (!room)
        FVI_FAIL("no memory for the rows", FVI_ENOMEM);
    int status = fvi_step_search(o->method, &o->run, o->tolerance, most, room, NULL, &found);
    o->report->error = found.estimate;
    o->report->until = found.until;
    o->report->rows = o->out->rows;
    if (!status)
        status = halve_until_agreed(o, found.parts, most, x, p, room + nodes);
    if (status == FVI_ETOL)
        o->report->other = fvi_step_search_other(o->method, &o->run);
    free(room);
    return status;
}
