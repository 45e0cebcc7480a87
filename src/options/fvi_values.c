/* src/options/fvi_values.c -- Interpret the values of the options. */
#include "fvi_values.h"
#include "fvi_checks.h"
#include "fvi_mechanism_options.h"
#include "fvi_option_columns.h"
#include "fvi_grid.h"
#include "input/fvi_files.h"
#include "input/fvi_shared.h"

#include <fvi/fvi.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* Read a word of a list. The text of the option becomes the chosen word in small letters, as the head shows it. */
static int choose_word(fvi_options *o, option_index i, const char *const *words,
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
    int status = fvi_option_number(o, ERROR, 0, INFINITY, "()", &o->error, c);
    if (!status)
        status = fvi_options_refuse_jumps(o, FORCE, o->force, c);
    return status || !o->ground
               ? status
               : fvi_options_refuse_jumps(o, GROUND, fvi_ground_typed(o->ground), c);
}

/* Read --step-error, --longest or --most-steps. For a method with steps of a given length, --step-error is refused, and
 * so are the two limits unless the step is searched for. */
static int interpret_of_steps(fvi_options *o, option_index i, double *value,
                              fvi_error *c)
{
    if (o->text[i] && !o->method->dense && !(i != STEP_ERROR && o->text[ERROR]))
        return fvi_refuse(c,
                          fvi_option_list[i].name, "'%s' is not for %s, whose steps are "
                          "given; fvi-adaptive chooses its own", o->text[i], o->method->name);
    return !o->text[i]       ? 0
           : i == MOST_STEPS ? fvi_option_whole(o, i, &o->most_steps, c)
                             : fvi_option_number(o, i, 0, INFINITY, "()", value, c);
}

/* Return nonzero if fvi-adaptive is the method of a structure with --error: no method is named, and fvi-adaptive takes
 * the structure. */
static int leaves_structure(const fvi_options *o)
{
    if (!o->method_is_preset || !o->text[ERROR] || !o->directory)
        return 0;
    const fvi_system system = fvi_options_system(o);
    return fvi_variable_step_takes_structure(&system, o->alpha,
                                             o->text[DAMPING] ? &o->damping.law : NULL);
}

/* With --error and --damping, return the fastest method that takes the law, the memory and kappa, or NULL if the method
 * is chosen otherwise. */
static const char *method_of_law(const fvi_options *o)
{
    double error;
    if (!o->method_is_preset || !o->text[ERROR] || !o->text[DAMPING] || o->directory || o->mechanism
        || fvi_parse_number("error", o->text[ERROR], 0, INFINITY, "()", &error, NULL))
        return NULL;
    const fvi_system system = fvi_options_system(o);
    const fvi_run run = fvi_options_run(o, &system);
    return fvi_method_for_error(&run, error)->name;
}

static int interpret_method(fvi_options *o, fvi_error *c)
{
    if (leaves_structure(o))
        o->text[METHOD] = fvi_variable_step.name;
    const char *of_law = method_of_law(o);
    if (of_law)
        o->text[METHOD] = of_law;
    if (o->method_is_preset && fvi_wants_stable(o) && !fvi_leaves_steps(o))
        o->text[METHOD] = "fvi-stable";
    const int status = fvi_parse_method(o->text[METHOD], &o->method, c);
    if (status)
        return status;
    o->text[METHOD] = o->method->name; /* in small letters */
    return fvi_check_method(o, c);
}

static int interpret_run(fvi_options *o, fvi_error *c)
{
    size_t which;
    int status = fvi_option_number(o, KAPPA, 0, 1, "[]", &o->kappa, c);
    if (!status)
        status = fvi_option_number(o, TOLERANCE, 1e-14, 1, "[)", &o->tolerance, c);
    if (!status)
        status = choose_word(o, MEMORY, fvi_history_words, &which, c);
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

/* Interpret the options of both run and exact: the system, its start, the grid, the columns. */
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
        status = choose_word(o, DERIVATIVE, fvi_initial_history_words,
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
        status = fvi_refuse(c, "derivative", "'%s' is not for --damping; held is, and caputo for orders up to 1",
                            o->text[DERIVATIVE]);
    if (!status)
        status = fvi_option_whole(o, EVERY, &o->every, c);
    if (!status)
        status = fvi_problem_unknowns(o, c);
    if (!status)
        status = fvi_options_columns(o, c);
    if (!status)
        status = fvi_user_parameters_are_used(&o->lets, c);
    for (size_t i = 0; !status && o->checkpoint && i < o->columns.count; i++)
        if (o->columns.at[i] == FVI_COLUMN_Y)
            status = fvi_refuse(c, o->resume ? "continue" : "checkpoint", "column y needs every row");
    if (!status && o->plot && o->columns.count == 1
        && o->columns.at[0] == FVI_COLUMN_T)
        status = fvi_refuse(c, "plot", "the only column is t");
    if (!status && o->command == FVI_COMMAND_RUN)
        status = interpret_run(o, c);
    if (!status)
        status = fvi_check_events(o, c);
    if (!status && o->command == FVI_COMMAND_EXACT)
        status = fvi_check_exact(o, c);
    if (!status)
        status = fvi_options_check_columns(o, c);
    if (!status)
        status = fvi_check_impulses(o, c);
    if (!status)
        status = fvi_check_forces(o, 0, c);
    return status ? status : fvi_check_solution(o, c);
}

/* Return nonzero if the name ends with .svg or .png. */
static int is_picture(const char *name)
{
    for (const char *at = name; *at; at++)
        if ((unsigned char)*at < ' ')
            return 0; /* a control character would end a line of gnuplot here */
    const size_t length = strlen(name);
    return length > 4
           && (strcasecmp(name + length - 4, ".svg") == 0
               || strcasecmp(name + length - 4, ".png") == 0);
}

/* Refuse two outputs with the same file, because the later one would replace the other. */
static int check_files(const fvi_options *o, fvi_error *c)
{
    static const option_index files[] = { PLOT, SNAPSHOT, CHECKPOINT };
    for (int i = 0; i < 3; i++) {
        const char *name = fvi_option_list[files[i]].name,
                   *text = o->text[files[i]];
        if (text && files[i] != SNAPSHOT && !fvi_may_be_ordinary(text))
            return fvi_refuse(c, name, "'%s' is not an ordinary file", text);
        if (text && fvi_same_file(text, o->output))
            return fvi_refuse(c, name, "'%s' is the table's file, too", text);
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
    if (o->text[OUTPUT] && strcmp(o->text[OUTPUT], "-") != 0)
        o->output = o->text[OUTPUT];
    o->plot = o->text[PLOT];
    if (o->plot && !is_picture(o->plot))
        return fvi_refuse(c, "plot", "'%s' is not a name.svg or name.png", o->plot);
    o->snapshot = o->text[SNAPSHOT];
    if (o->snapshot && !*o->snapshot)
        return fvi_refuse(c, "snapshot", "'' is not a file's name");
    if (o->snapshot && o->text[ERROR])
        return fvi_refuse(c, "snapshot", "not together with --error");
    o->checkpoint = o->text[CHECKPOINT];
    o->resume = o->text[CONTINUE] != NULL;
    if (o->checkpoint && (!*o->checkpoint || strcmp(o->checkpoint, "-") == 0))
        return fvi_refuse(c, "checkpoint", "'%s' is not a file's name", o->checkpoint);
    if (o->checkpoint && o->text[ERROR])
        return fvi_refuse(c, "checkpoint", "not together with --error");
    if (o->resume && !o->checkpoint)
        return fvi_refuse(c, "continue", "from which --checkpoint FILE?");
    int status = check_files(o, c);
    if (!status)
        status = choose_word(o, FORMAT, fvi_format_names, &format, c);
    if (status)
        return status;
    o->format = (fvi_format)format;
    /* The weights are those of the order 2 alpha of the damping, so their order goes up to 2. */
    int only_weights = o->command == FVI_COMMAND_COEFFICIENTS;
    o->alpha = 0.5;
    if (o->text[ALPHA])
        status = fvi_option_number(o, ALPHA, 0, only_weights ? 2 : 1, "[]", &o->alpha, c);
    if (o->text[ORDER]) {
        status = fvi_option_number(o, ORDER, 0, only_weights ? 4 : 2, "[]", &o->alpha, c);
        o->alpha /= 2;
    }
    if (status)
        return status;
    return only_weights ? fvi_option_whole(o, COUNT, &o->count, c)
                        : interpret_trajectory(o, c);
}

/* Refuse an output that would replace a file that was read. */
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
    fvi_typed_mechanism_free(o->mechanism);
    fvi_typed_events_free(o->events);
    fvi_directory_close(o->directory);
    free(o->shown);
    fvi_typed_columns_free(o->typed);
    free(o->column_source);
    free(o->typed_row);
    fvi_shared_close(o->library);
    *o = (fvi_options){ .command = o->command, .about = o->about };
}
