/* src/command_exact/fvi_exact_motion.c -- Print the table of `fvi exact` for several masses, and for accelerations and
 * forces of dampers. */
#define _GNU_SOURCE
#include "fvi_exact.h"
#include "command_shared/fvi_run_rows.h"
#include "options/fvi_option_columns.h"
#include "options/fvi_problem.h"
#include "output/fvi_complain.h"
#include "output/fvi_output.h"
#include "output/fvi_table.h"

#include <fvi/exact_motion.h>

#include <stdlib.h>
#include <string.h>

/* Compute p = M v. Return FVI_SUCCESS or what the function `inertia` of the matrices returns. */
static int find_momentum(const fvi_system *system, const double *v, double *p)
{
    const fvi_matrices *m = system->matrices;
    for (size_t i = 0; !m && i < system->d; i++)
        p[i] = system->mass[i] * v[i];
    return m ? m->inertia(system->d, v, m->params, p) : FVI_SUCCESS;
}

/* Arrays for one row: d numbers each for x, v, p and a, and one number per component of a damper's force for force and
 * impulse. */
typedef struct {
    double *x, *v, *p, *a, *force, *impulse;
} row_room;

static row_room place_row_parts(double *room, size_t d, size_t forces)
{
    return (row_room){ room, room + d, room + 2 * d, room + 3 * d, room + 4 * d, room + 4 * d + forces };
}

/* Compute the row at one time. If accelerations or forces of dampers are asked for, a force that is infinite at t = 0
 * is replaced by its mean over the first step. */
static int observe_motion(fvi_table *t, fvi_exact_motion *motion, double time, row_room *row, fvi_error *error)
{
    const fvi_exact_outputs out = { row->x, row->v, row->a, row->force, row->impulse };
    return fvi_options_observes(t->o) ? fvi_exact_motion_forces_at(motion, time, t->o->h, &out, error)
                                      : fvi_exact_motion_at(motion, 1, &time, row->x, row->v, error);
}

static int write_rows(fvi_table *t, fvi_exact_motion *motion, const fvi_system *system, row_room *row)
{
    const size_t N = t->o->steps;
    for (size_t k = 0;; k = fvi_table_next(t, k)) {
        const double time = (double)k * t->o->h;
        fvi_error error = { 0 };
        if (k == N)
            fvi_table_mark_last(t);
        int status = observe_motion(t, motion, time, row, &error);
        if (!status)
            status = find_momentum(system, row->v, row->p);
        const fvi_observation now = { .x = row->x, .p = row->p, .a = row->a, .force = row->force,
                                      .impulse = row->impulse };
        if (!status)
            status = fvi_run_observed_row(t, k, &now);
        if (status)
            return fvi_stopped_at(k, status);
        fvi_progress(k, N);
        if (k == N || ferror(t->out))
            return 0;
    }
}

/* Print the error of the library with the name of the option that sets the field of the error. Return 1. */
static int refuse(const fvi_error *error, int status)
{
    static const char *const options[][2] = { { "potential", "--potential: " },
                                              { "damper", "--damper: " },
                                              { "past", "--derivative: " },
                                              { "K", "--system: " } };
    const char *option = "";
    for (size_t i = 0; i < sizeof options / sizeof *options; i++)
        if (error->field && strcmp(error->field, options[i][0]) == 0)
            option = options[i][1];
    char text[sizeof error->text + 32];
    snprintf(text, sizeof text, "%s%s", option,
             *error->text ? error->text : fvi_error_name(status));
    return fvi_complain(text);
}

int fvi_command_exact_motion(const fvi_options *o, const fvi_system *system)
{
    double constants[2] = { 0 };
    fvi_forcing forcing = FVI_FORCING_NONE;
    fvi_typed_force_is_simple(o->force, &forcing, constants);
    const fvi_run run = fvi_options_run(o, system);
    const fvi_exact_problem problem = {
        .motion = { .system = system, .alpha = o->alpha, .law = run.law },
        .x0 = o->x0,
        .p0 = o->p0,
        .forcing = forcing,
        .A = constants[0],
        .T = constants[1],
        .w = constants[1]
    };
    fvi_exact_motion *motion;
    fvi_error error = { 0 };
    const int status = fvi_exact_motion_alloc(&problem, &motion, &error);
    if (status)
        return refuse(&error, status);
    fvi_table t;
    fvi_table_shape(&t, o, system);
    const size_t forces = fvi_exact_motion_forces(motion);
    double *room = malloc((4 * system->d + 2 * forces) * sizeof *room);
    row_room row = place_row_parts(room, system->d, forces);
    t.rows = room ? fvi_table_room(&t, 0) : NULL;
    int failed = t.rows ? fvi_table_open(&t) : fvi_complain("not enough memory");
    if (!failed) {
        fvi_table_head(t.out, o);
        fvi_table_names(&t);
        failed = fvi_table_close(&t, write_rows(&t, motion, system, &row));
    }
    free(t.rows);
    free(room);
    fvi_exact_motion_free(motion);
    return failed;
}
