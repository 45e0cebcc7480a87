/* src/program/fvi_exact_motion.c -- `fvi exact` of several masses. */
#define _GNU_SOURCE
#include "fvi_commands.h"
#include "fvi_run.h"
#include "options/fvi_problem.h"
#include "output/fvi_complain.h"
#include "output/fvi_format.h"
#include "output/fvi_output.h"
#include "output/fvi_table.h"

#include <fvi/exact_motion.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* p = M v. */
static int find_momentum(const fvi_system *system, const double *v, double *p)
{
    const fvi_matrices *m = system->matrices;
    for (size_t i = 0; !m && i < system->d; i++)
        p[i] = system->mass[i] * v[i];
    return m ? m->inertia(system->d, v, m->params, p) : FVI_SUCCESS;
}

static int write_rows(fvi_table *t, fvi_exact_motion *motion, const fvi_system *system,
                      double *x)
{
    const size_t d = system->d, N = t->o->steps;
    double *v = x + d, *p = v + d;
    for (size_t k = 0;; k = fvi_table_next(t, k)) {
        const double time = (double)k * t->o->h;
        fvi_error error = { 0 };
        if (k == N)
            fvi_table_mark_last(t);
        int status = fvi_exact_motion_at(motion, 1, &time, x, v, &error);
        if (!status)
            status = find_momentum(system, v, p);
        if (!status)
            status = fvi_run_state_row(t, k, x, p);
        if (status)
            return fvi_stopped_at(k, status);
        fvi_progress(k, N);
        if (k == N || ferror(t->out))
            return 0;
    }
}

/* What the library said, behind the option that its field is. */
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
    double *x = malloc(3 * system->d * sizeof *x);
    t.rows = x ? fvi_table_room(&t, 0) : NULL;
    int failed = t.rows ? fvi_table_open(&t) : fvi_complain("not enough memory");
    if (!failed) {
        fvi_table_head(t.out, o);
        fvi_table_names(&t);
        failed = fvi_table_close(&t, write_rows(&t, motion, system, x));
    }
    free(t.rows);
    free(x);
    fvi_exact_motion_free(motion);
    return failed;
}
