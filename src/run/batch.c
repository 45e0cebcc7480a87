/* src/run/batch.c -- Make one run of up to eight runs of one coordinate, and write the rows of many runs. [H 28]
 *
 * Run number l becomes coordinate l of one system, a lane (system/lanes.h). fvi_batch_trajectories takes the runs in
 * groups that can go together, and repeats the runs of a group one by one if the group fails. */
#include <fvi/batch.h>

#include "run_damper.h"
#include "system/fail.h"
#include "system/lanes.h"
#include "system/quadratic.h"

#include <math.h>
#include <stdlib.h>

_Static_assert((int)FVI_BATCH_MOST == (int)FVI_MOST_LANES, "a batch has a vector of lanes");

struct fvi_batch {
    fvi_lanes lanes;
    fvi_system system; /* the common system of the lanes */
    fvi_run run;       /* the run of this system */
    double x0[FVI_MOST_LANES], p0[FVI_MOST_LANES], mass[FVI_MOST_LANES], damping[FVI_MOST_LANES];
};

/* ---- which runs can go together ---- */

/* Return the reason why this run cannot go together with any other run, or NULL. */
static const char *reason_against_run(const fvi_method *method, const fvi_run *run)
{
    const fvi_system *system = run->system;
    if (method->dense)
        return "the method chooses its steps";
    if (system->d != 1)
        return "a run has more than one coordinate";
    if (system->matrices)
        return "a system has matrices";
    if (system->mechanism)
        return "a system has a Lagrangian, constraints or dampers between points";
    if (fvi_lanes_of(system))
        return "a run is a batch";
    if (run->event_count > 0 || system->force.impulse_count > 0)
        return "there are events or impulses";
    return system->potential.solve ? "a potential solves its own equation" : NULL;
}

/* The reason why these two runs cannot go together, though each could with other runs; or NULL. */
static const char *reason_against_pair(const fvi_method *method, const fvi_run *a, const fvi_run *b)
{
    const fvi_system *system_a = a->system, *system_b = b->system;
    const fvi_potential *U_a = &system_a->potential, *U_b = &system_b->potential;
    if (a->h != b->h || a->steps != b->steps)
        return "the steps differ";
    if (a->alpha != b->alpha || !fvi_is_same_law(a->law, b->law) || a->past != b->past
        || a->memory != b->memory || a->tolerance != b->tolerance)
        return "the memories differ";
    if (a->kappa != b->kappa)
        return "kappa differs";
    if (method->stages
        && (*system_a->mass != *system_b->mass || *system_a->damping != *system_b->damping))
        return "with stages the masses and the dampings must be the same";
    if (!U_a->gradient != !U_b->gradient || fvi_potential_is_quadratic(U_a) != fvi_potential_is_quadratic(U_b)
        || !U_a->diagonals != !U_b->diagonals)
        return "the potentials are of different kinds";
    return !system_a->force.value != !system_b->force.value ? "one has a force, another none" : NULL;
}

const char *fvi_batch_refusal(const fvi_method *method, size_t count, const fvi_run *run)
{
    if (!method || !run || count == 0 || count > FVI_BATCH_MOST)
        return "there must be 1 to 8 runs and a method";
    const char *why = NULL;
    for (size_t l = 0; l < count && !why; l++) {
        if (!run[l].system || !run[l].x0 || !run[l].p0 || !run[l].system->mass
            || !run[l].system->damping)
            return "a pointer of a run is null";
        why = reason_against_run(method, run + l);
        if (!why)
            why = reason_against_pair(method, run, run + l);
    }
    return why;
}

/* ---- one run of several ---- */

/* Make the common run of `count` runs. What all runs share is that of the first run. */
static void fill_lanes(fvi_batch *b, size_t count, const fvi_run *run)
{
    b->lanes.count = count;
    for (size_t l = 0; l < count; l++) {
        b->lanes.system[l] = run[l].system;
        b->x0[l] = *run[l].x0;
        b->p0[l] = *run[l].p0;
        b->mass[l] = *run[l].system->mass;
        b->damping[l] = *run[l].system->damping;
    }
    b->run = *run;
    b->run.system = &b->system;
    b->run.x0 = b->x0;
    b->run.p0 = b->p0;
    b->system = (fvi_system){ .d = count,
                              .mass = b->mass,
                              .damping = b->damping,
                              .potential = fvi_lanes_potential(&b->lanes),
                              .force = fvi_lanes_force(&b->lanes) };
}

int fvi_batch_alloc(const fvi_method *method, size_t count, const fvi_run *run, fvi_batch **batch,
                    fvi_error *error)
{
    if (!method || !run || !batch)
        return fvi_fail(error, FVI_EFAULT, !method ? "method" : !run ? "run" : "batch", NAN, "null pointer");
    if (count == 0 || count > FVI_BATCH_MOST)
        return fvi_fail(error, FVI_EINVAL, "count", (double)count, "count is %zu; it must be 1 to 8", count);
    const char *why = fvi_batch_refusal(method, count, run);
    if (why)
        return fvi_fail(error, FVI_EUNSUP, "run", NAN, "the runs do not go together: %s", why);
    fvi_batch *b = calloc(1, sizeof *b);
    if (b)
        fill_lanes(b, count, run);
    if (!b || fvi_lanes_prepare(&b->lanes)) {
        free(b);
        return fvi_fail(error, FVI_ENOMEM, NULL, NAN, "no memory for the batch");
    }
    *batch = b;
    return FVI_SUCCESS;
}

const fvi_run *fvi_batch_run(const fvi_batch *batch)
{
    return &batch->run;
}

/* ---- many runs ---- */

/* Which rows are wanted, and the arrays that they go to. A batch has an array for each lane, with one number in each
 * row. A single run has one array, with d numbers in each row. */
typedef struct {
    size_t rows;                 /* number of rows */
    const size_t *row;           /* the step of each row; NULL: row r is step r */
    size_t lanes;                /* number of lanes; 0: a single run */
    double *const *x, *const *p; /* the arrays, for each lane; each list and each array may be NULL */
} wanted_rows;

/* Return the outputs for `lanes` runs from run number `first` on, or, if lanes = 0, for this run alone. */
static wanted_rows outputs_from_run(const wanted_rows *all, size_t first, size_t lanes)
{
    wanted_rows w = *all;
    w.lanes = lanes;
    w.x = all->x ? all->x + first : NULL;
    w.p = all->p ? all->p + first : NULL;
    return w;
}

/* Write row r of a batch, the numbers v, to the arrays of its lanes. */
static void write_lanes(const wanted_rows *w, double *const *to, const double *v, size_t r)
{
    for (size_t l = 0; to && l < w->lanes; l++)
        if (to[l])
            to[l][r] = v[l];
}

/* Advance to row r, and write it. */
static int advance_to_row(fvi_stepper *s, const wanted_rows *w, size_t r)
{
    const size_t d = s->run.system->d;
    const double t = (double)(w->row ? w->row[r] : r) * s->run.h;
    double x[FVI_MOST_LANES], p[FVI_MOST_LANES];
    if (w->lanes == 0)
        return fvi_stepper_advance_to(s, t, w->x && *w->x ? *w->x + r * d : NULL,
                                      w->p && *w->p ? *w->p + r * d : NULL);
    const int status = fvi_stepper_advance_to(s, t, x, p);
    if (!status) {
        write_lanes(w, w->x, x, r);
        write_lanes(w, w->p, p, r);
    }
    return status;
}

/* Make a run, which may be that of a batch, and write its rows. */
static int write_run(const fvi_method *method, const fvi_run *run, const wanted_rows *w)
{
    fvi_stepper *s;
    int status = fvi_stepper_start(method, run, &s, NULL);
    if (status)
        return status;
    for (size_t r = 0; r < w->rows && !status; r++)
        status = advance_to_row(s, w, r);
    fvi_stepper_free(s);
    return status;
}

/* Make `count` runs as one batch, and write their rows. */
static int write_batch(const fvi_method *method, size_t count, const fvi_run *run,
                       const wanted_rows *w)
{
    fvi_batch *batch;
    int status = fvi_batch_alloc(method, count, run, &batch, NULL);
    if (status)
        return status;
    status = write_run(method, fvi_batch_run(batch), w);
    fvi_batch_free(batch);
    return status;
}

/* Return how many runs, from the first one on, can go together: at most 8. */
static size_t count_group(const fvi_method *method, size_t count, const fvi_run *run)
{
    size_t n = count < FVI_BATCH_MOST ? count : FVI_BATCH_MOST;
    while (n > 1 && fvi_batch_refusal(method, n, run))
        n--;
    return n;
}

int fvi_batch_trajectories(const fvi_method *method, size_t count, const fvi_run *run, size_t rows,
                           const size_t *row, double *const *x, double *const *p, int *status)
{
    if (!method || !run)
        FVI_FAIL("null pointer", FVI_EFAULT);
    const wanted_rows all = { rows, row, 0, x, p };
    int first_failure = FVI_SUCCESS;
    for (size_t first = 0, group; first < count; first += group) {
        group = count_group(method, count - first, run + first);
        wanted_rows w = outputs_from_run(&all, first, group);
        const int is_done = group > 1 && !write_batch(method, group, run + first, &w);
        for (size_t i = first; i < first + group; i++) { /* one by one, if the batch failed */
            w = outputs_from_run(&all, i, 0);
            const int own = is_done ? FVI_SUCCESS : write_run(method, run + i, &w);
            first_failure = first_failure ? first_failure : own;
            if (status)
                status[i] = own;
        }
    }
    return first_failure;
}

void fvi_batch_free(fvi_batch *batch)
{
    if (batch)
        fvi_lanes_discard(&batch->lanes);
    free(batch);
}
