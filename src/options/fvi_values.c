/* src/options/fvi_values.c -- From the words of the command line to values. */
#include "fvi_values.h"
#include "fvi_mechanism_options.h"
#include "fvi_option_columns.h"
#include "fvi_grid.h"
#include "input/fvi_files.h"
#include "input/fvi_shared.h"
#include <fvi/format_double.h>

#include <fvi/fvi.h>

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* The number of option i; see fvi_word_number. */
static int number(const fvi_options *o, option_index i, double low, double high,
                  const char *brackets, double *value, fvi_error *c)
{
    return fvi_parse_number(fvi_option_list[i].name, o->text[i], low, high,
                           brackets, value, c);
}

/* Counts of rows are added and doubled: half of what a size_t holds is enough. */
static int whole(const fvi_options *o, option_index i, size_t *value,
                 fvi_error *c)
{
    return fvi_parse_whole(fvi_option_list[i].name, o->text[i], SIZE_MAX / 2,
                          value, c);
}

/* The text becomes the word that is chosen, in small letters, as the head shows it. */
static int choice(fvi_options *o, option_index i, const char *const *words,
                  size_t *which, fvi_error *c)
{
    const int status =
        fvi_parse_word(fvi_option_list[i].name, o->text[i], words, which, c);
    if (!status)
        o->text[i] = words[*which];
    return status;
}

/* ---- what belongs together ---- */

static int interpret_error(fvi_options *o, fvi_error *c)
{
    int status = number(o, ERROR, 0, INFINITY, "()", &o->error, c);
    if (!status)
        status = fvi_options_refuse_jumps(o, FORCE, o->force, c);
    return status || !o->ground
               ? status
               : fvi_options_refuse_jumps(o, GROUND, fvi_ground_typed(o->ground), c);
}

/* Steps of a given length have no tolerance, and no limit unless they are searched for. */
static int interpret_of_steps(fvi_options *o, option_index i, double *value,
                              fvi_error *c)
{
    if (o->text[i] && !o->method->dense && !(i != STEP_ERROR && o->text[ERROR]))
        return fvi_refuse(c,
                          fvi_option_list[i].name, "'%s' is not for %s, whose steps are "
                          "given; fvi-adaptive chooses its own", o->text[i], o->method->name);
    return !o->text[i]       ? 0
           : i == MOST_STEPS ? whole(o, i, &o->most_steps, c)
                             : number(o, i, 0, INFINITY, "()", value, c);
}

/* Does the velocity of a mass that is damped jump at some time? */
static int begins_to_move(const fvi_options *o)
{
    for (size_t i = 0; i < o->d; i++)
        if (o->p0[i] != 0 && o->rho[i] > 0)
            return 1;
    return o->force && fvi_force_typed(o->force).impulse_count > 0;
}

/* Exponentials of a law, or of the dampers of a folder, for steps of one length, are there or are
 * refused. */
static int check_modes(const fvi_options *o, fvi_error *c)
{
    const int of_folder = o->directory && o->text[DAMPER];
    const fvi_system system =
        of_folder ? fvi_options_system(o) : (fvi_system){ .d = o->d };
    const fvi_run run = { .system = &system,
                          .law = of_folder ? NULL : &o->damping.law,
                          .h = o->h };
    int has = 1;
    if ((o->text[DAMPING] || of_folder) && o->memory == FVI_HISTORY_MODES
        && !o->method->dense && fvi_method_has_modes(o->method, &run, &has))
        return fvi_fail(c, FVI_ENOMEM, NULL, NAN, "not enough memory");
    return has ? 0
               : fvi_refuse(c, "memory", "'exponentials': of --%s '%s' there "
                            "are none with this step; 'auto' sums it all",
                            of_folder ? "damper" : "damping",
                            o->text[of_folder ? DAMPER : DAMPING]);
}

/* What is asked for is done or refused: the words that a method cannot honour. */
static int check_method(const fvi_options *o, fvi_error *c)
{
    const fvi_method *m = o->method;
    const int by_order = o->text[ORDER] != NULL;
    if (o->alpha < m->alpha_least || o->alpha > m->alpha_most)
        return fvi_refuse(c, by_order ? "order" : "alpha",
                          "'%s' is not %g, all that %s knows",
                          o->text[by_order ? ORDER : ALPHA],
                          (1 + by_order) * m->alpha_least, m->name);
    if (o->text[DAMPING] && !m->takes_laws)
        return fvi_refuse(c, "damping", "'%s' is not known to %s",
                          o->text[DAMPING], m->name);
    if (o->text[DAMPING] && m->dense
        && fvi_kernel_growth(&o->damping.law) > 1 && begins_to_move(o))
        return fvi_refuse(c, "p0", "fvi-adaptive takes no velocity that jumps "
                          "with a law that grows faster than s; fvi-bdf2 and "
                          "fvi-stable do");
    const int status = check_modes(o, c);
    if (status)
        return status;
    if (o->directory && !m->takes_matrices)
        return fvi_refuse(c,
                          "method", "'%s' takes no matrices; fvi, fvi-shifted, "
                          "fvi-bdf2 and fvi-stable do",
                          m->name);
    if (o->mechanism && !m->takes_mechanism)
        return fvi_refuse(c, "method",
                          "'%s' takes no Lagrangian, dampers between points, "
                          "constraints or forces of velocity; fvi, fvi-stable, "
                          "fvi-lobatto2 to 8 and 2d to 8d do",
                          m->name);
    if (!m->takes_kappa && o->kappa != 0.5)
        return fvi_refuse(c, "kappa", "'%s' is not for %s, which has no kappa",
                          o->text[KAPPA], m->name);
    if (!fvi_method_takes_history(m, o->memory))
        return fvi_refuse(c, "memory", "'%s' is not known to %s",
                          o->text[MEMORY], m->name);
    return 0;
}

static int interpret_method(fvi_options *o, fvi_error *c)
{
    if (o->method_is_preset && fvi_wants_stable(o))
        o->text[METHOD] = "fvi-stable";
    const int status = fvi_parse_method(o->text[METHOD], &o->method, c);
    if (status)
        return status;
    o->text[METHOD] = o->method->name; /* in small letters */
    return check_method(o, c);
}

static int interpret_run(fvi_options *o, fvi_error *c)
{
    size_t which;
    int status = number(o, KAPPA, 0, 1, "[]", &o->kappa, c);
    if (!status)
        status = number(o, TOLERANCE, 1e-14, 1, "[)", &o->tolerance, c);
    if (!status)
        status = choice(o, MEMORY, fvi_history_words, &which, c);
    if (status)
        return status;
    o->memory = (fvi_history_kind)which;
    status = interpret_method(o, c);
    if (!status)
        status = interpret_of_steps(o, STEP_ERROR, &o->step_error, c);
    if (!status)
        status = interpret_of_steps(o, LONGEST, &o->longest, c);
    if (!status)
        status = interpret_of_steps(o, MOST_STEPS, NULL, c);
    return !status && o->text[ERROR] ? interpret_error(o, c) : status;
}

/* One mass, that alpha or a law damps, has an exact solution of its own. */
int fvi_is_oscillator(const fvi_options *o)
{
    const fvi_potential_kind kind = o->potential.kind;
    return o->d == 1 && !o->directory && !o->mechanism
           && kind != FVI_POTENTIAL_EXPRESSION && kind != FVI_POTENTIAL_CHAIN;
}

/* Of many masses the library sees what is linear, when their poles are found; and of a single one
 * whose potential is an expression. */
static int check_many(const fvi_options *o, fvi_error *c)
{
    if (o->directory && o->text[FORCE] == fvi_directory_force_name(o->directory))
        return fvi_refuse(c, "system", "%s has no exact solution here; without it, or "
                          "--force step:A,T and cosine:A,W have",
                          o->text[FORCE]);
    if (o->past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE
        || (o->past == FVI_INITIAL_HISTORY_CAPUTO && o->alpha > 0.5))
        return fvi_refuse(c, "derivative", "'%s' has no exact solution of several masses "
                          "here; held has",
                          o->text[DERIVATIVE]);
    return 0;
}

/* What has an exact solution in the library. */
static int check_linear(const fvi_options *o, fvi_error *c)
{
    const fvi_typed_potential *u = &o->potential;
    fvi_forcing kind;
    double constants[2];
    if (!fvi_is_oscillator(o)) {
        const int status = check_many(o, c);
        if (status)
            return status;
    } else if (o->library
               || (u->kind != FVI_POTENTIAL_FREE
                   && !(u->kind == FVI_POTENTIAL_HARMONIC && u->constants[0] >= 0))) {
        return fvi_refuse(c,
                          "potential", "'%s' has no exact solution here; "
                          "harmonic:C with C >= 0 and free have",
                          o->text[POTENTIAL]);
    }
    if (!fvi_typed_force_is_simple(o->force, &kind, constants))
        return fvi_refuse(c,
                          "force", "'%s' has no exact solution here; none, "
                          "step:A,T and cosine:A,W have",
                          o->text[FORCE]);
    return 0;
}

/* A problem without a solution is for `run` with the paper's method alone, and not
 * with --error, as there is nothing to be near to. (19.2) */
static int check_solution(fvi_options *o, fvi_error *c)
{
    const fvi_system system = fvi_options_system(o);
    const fvi_run run = fvi_options_run(o, &system);
    if (fvi_warning_of_initial_history(&run, &o->no_solution) < 0)
        return fvi_fail(c, FVI_ENOMEM, NULL, NAN, "not enough memory");
    if (o->no_solution
        && !(o->method && o->method->paper_convention && o->error == 0))
        return fvi_refuse(c,
                          "derivative", "'rl' has no solution for %s != 0 and "
                          "alpha > 1/2; take held or caputo",
                          o->directory ? "C x0" : "x0");
    return 0;
}

/* At alpha = 1 the momentum of a method with stages is not the one that is hit. (17.17) */
static int check_impulses(const fvi_options *o, fvi_error *c)
{
    int added_mass = 0;
    for (size_t i = 0; i < o->d; i++)
        added_mass |= o->alpha == 1 && o->rho[i] > 0;
    if (added_mass && o->method && o->method->stages && o->force
        && fvi_force_typed(o->force).impulse_count)
        return fvi_refuse(c,
                          "force", "'%s': %s takes no impulse at alpha = 1; "
                          "fvi-adaptive does",
                          o->text[FORCE], o->method->name);
    return 0;
}

/* What run and exact share: the system, its start, the grid, the columns. */
static int interpret_trajectory(fvi_options *o, fvi_error *c)
{
    size_t which = 0;
    int status = fvi_problem_potential(o, c);
    if (!status)
        status = fvi_problem_lists(o, c);
    if (!status)
        status = fvi_options_grid(o, c);
    if (!status)
        status = fvi_problem_force(o, c);
    if (!status && o->text[DAMPING])
        status = fvi_parse_damping(o->text[DAMPING], &o->lets, &o->damping, c);
    if (!status && o->text[DERIVATIVE])
        status = choice(o, DERIVATIVE, fvi_initial_history_words,
                        &which, c);
    if (!status)
        status = fvi_problem_mechanism(o, c);
    if (!status)
        status = fvi_problem_events(o, c);
    if (!status)
        status = fvi_problem_velocity(o, c);
    if (!status)
        status = fvi_problem_ground(o, c);
    o->past = (fvi_initial_history)which;
    if (!status && o->text[DAMPING] && o->past != FVI_INITIAL_HISTORY_HELD
        && !(o->past == FVI_INITIAL_HISTORY_CAPUTO
             && fvi_kernel_takes_caputo(&o->damping.law)))
        status = fvi_refuse(c, "derivative",
                            "'%s' is not for --damping; held is, and caputo "
                            "for orders up to 1",
                            o->text[DERIVATIVE]);
    if (!status)
        status = whole(o, EVERY, &o->every, c);
    if (!status)
        status = fvi_problem_unknowns(o, c);
    if (!status)
        status = fvi_options_columns(o, c);
    if (!status)
        status = fvi_user_parameters_are_used(&o->lets, c);
    for (size_t i = 0; !status && o->checkpoint && i < o->columns.count; i++)
        if (o->columns.at[i] == FVI_COLUMN_Y)
            status = fvi_refuse(c, o->resume ? "continue" : "checkpoint",
                                "column y needs every row");
    if (!status && o->plot && o->columns.count == 1
        && o->columns.at[0] == FVI_COLUMN_T)
        status = fvi_refuse(c, "plot", "the only column is t");
    if (!status && o->command == FVI_COMMAND_RUN)
        status = interpret_run(o, c);
    if (!status)
        status = fvi_check_events(o, c);
    if (!status && o->command == FVI_COMMAND_EXACT)
        status = check_linear(o, c);
    if (!status)
        status = fvi_options_check_columns(o, c);
    if (!status)
        status = check_impulses(o, c);
    return status ? status : check_solution(o, c);
}

/* Is this a name for a picture: does it end with .svg or .png? */
static int is_picture(const char *name)
{
    for (const char *at = name; *at; at++)
        if ((unsigned char)*at < ' ')
            return 0; /* a line of gnuplot's must not end here */
    const size_t length = strlen(name);
    return length > 4
           && (strcasecmp(name + length - 4, ".svg") == 0
               || strcasecmp(name + length - 4, ".png") == 0);
}

/* Of two outputs in one file the later would take the place of the other. */
static int check_files(const fvi_options *o, fvi_error *c)
{
    static const option_index files[] = { PLOT, SNAPSHOT, CHECKPOINT };
    for (int i = 0; i < 3; i++) {
        const char *name = fvi_option_list[files[i]].name,
                   *text = o->text[files[i]];
        if (text && fvi_same_file(text, o->output))
            return fvi_refuse(c, name, "'%s' is the table's file, too",
                              text);
        for (int j = 0; text && j < i; j++)
            if (o->text[files[j]] && fvi_same_file(text, o->text[files[j]]))
                return fvi_refuse(c, name, "'%s' is the file of --%s, too", text, fvi_option_list[files[j]].name);
    }
    return 0;
}

static int interpret(fvi_options *o, fvi_error *c)
{
    size_t format;
    if (o->text[OUTPUT] && !*o->text[OUTPUT])
        return fvi_refuse(c, "o", "'' is not a file's name");
    o->output = o->text[OUTPUT];
    o->plot = o->text[PLOT];
    if (o->plot && !is_picture(o->plot))
        return fvi_refuse(c, "plot", "'%s' is not a name.svg or name.png",
                          o->plot);
    o->snapshot = o->text[SNAPSHOT];
    if (o->snapshot && !*o->snapshot)
        return fvi_refuse(c, "snapshot", "'' is not a file's name");
    if (o->snapshot && o->text[ERROR])
        return fvi_refuse(c, "snapshot", "not together with --error");
    o->checkpoint = o->text[CHECKPOINT];
    o->resume = o->text[CONTINUE] != NULL;
    if (o->checkpoint && (!*o->checkpoint || strcmp(o->checkpoint, "-") == 0))
        return fvi_refuse(c, "checkpoint", "'%s' is not a file's name",
                          o->checkpoint);
    if (o->checkpoint && o->text[ERROR])
        return fvi_refuse(c, "checkpoint", "not together with --error");
    if (o->resume && !o->checkpoint)
        return fvi_refuse(c, "continue", "from which --checkpoint FILE?");
    int status = check_files(o, c);
    if (!status)
        status = choice(o, FORMAT, fvi_format_names, &format, c);
    if (status)
        return status;
    o->format = (fvi_format)format;
    /* The weights go up to the order 2 alpha of the damping. */
    int only_weights = o->command == FVI_COMMAND_COEFFICIENTS;
    o->alpha = 0.5;
    if (o->text[ALPHA])
        status = number(o, ALPHA, 0, only_weights ? 2 : 1, "[]", &o->alpha, c);
    if (o->text[ORDER]) {
        status = number(o, ORDER, 0, only_weights ? 4 : 2, "[]", &o->alpha, c);
        o->alpha /= 2;
    }
    if (status)
        return status;
    return only_weights ? whole(o, COUNT, &o->count, c)
                        : interpret_trajectory(o, c);
}

/* No output in the place of what was read. */
static int check_outputs(const fvi_options *o, fvi_error *c)
{
    int status = fvi_check_output("-o", o->output, c);
    if (!status)
        status = fvi_check_output("--plot", o->plot, c);
    if (!status)
        status = fvi_check_output("--snapshot", o->snapshot, c);
    if (!status)
        status = fvi_check_output("--checkpoint", o->checkpoint, c);
    return status;
}

int fvi_options_interpret(fvi_options *o, fvi_error *c)
{
    int status = interpret(o, c);
    if (!status)
        status = check_outputs(o, c);
    if (status)
        fvi_options_free(o);
    return status;
}

void fvi_options_free(fvi_options *o)
{
    free(o->x0);
    fvi_typed_potential_free(&o->potential);
    fvi_typed_damping_free(&o->damping);
    fvi_typed_force_free(o->force);
    fvi_ground_free(o->ground);
    o->ground = NULL;
    fvi_typed_mechanism_free(o->mechanism);
    o->mechanism = NULL;
    fvi_typed_events_free(o->events);
    o->events = NULL;
    fvi_directory_close(o->directory);
    free(o->shown);
    fvi_typed_columns_free(o->typed);
    free(o->column_source);
    free(o->typed_row);
    o->typed = NULL;
    o->column_source = NULL;
    o->typed_row = NULL;
    o->x0 = o->p0 = o->mass = o->rho = NULL;
    fvi_shared_close(o->library);
    o->library = NULL;
    o->force = NULL;
    o->directory = NULL;
    o->shown = NULL;
}
