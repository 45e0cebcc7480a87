/* src/options/fvi_option_columns.c -- Interpret --columns and --reduce. */
#include "fvi_option_columns.h"
#include "fvi_checks.h"
#include "fvi_problem.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>

static int start(fvi_options *o, fvi_error *c)
{
    o->column_source = malloc(sizeof *o->column_source);
    if (!o->column_source)
        return fvi_no_memory(c, NULL);
    const fvi_system system = fvi_options_system(o);
    *o->column_source = (fvi_column_source){ .d = o->d,
                                             .is_numbered = o->numbered,
                                             .mechanism = system.mechanism,
                                             .is_structure =
                                                 system.matrices != NULL,
                                             .ground =
                                                 o->ground
                                                     ? fvi_ground_acceleration(
                                                         o->ground)
                                                     : NULL,
                                             .shown = o->shown,
                                             .shown_count = o->shown_count };
    fvi_events_typed(o->events, &o->column_source->events);
    return fvi_typed_columns_start(o->column_source, &o->typed, c);
}

int fvi_options_columns(fvi_options *o, fvi_error *c)
{
    const int reduces = o->text[REDUCE] != NULL;
    int status = start(o, c);
    if (!status && o->text[COLUMNS])
        status = fvi_word_columns(o->text[COLUMNS], &o->lets, &o->columns,
                                  o->typed, c);
    if (!status && reduces)
        status = fvi_parse_reductions(o->text[REDUCE], &o->lets, o->typed, c);
    if (status)
        return status;
    o->typed_row = calloc(fvi_typed_columns_count(o->typed) + 1,
                          sizeof *o->typed_row);
    return o->typed_row ? 0
                        : fvi_no_memory(c, NULL);
}

int fvi_options_observes(const fvi_options *o)
{
    const unsigned sums = FVI_OBSERVE_ACCELERATION | FVI_OBSERVE_FORCE
                          | FVI_OBSERVE_IMPULSE | FVI_OBSERVE_WORK
                          | FVI_OBSERVE_MULTIPLIER | FVI_OBSERVE_CONTACT;
    return (fvi_typed_columns_wanted(o->typed) & sums) != 0;
}

int fvi_options_needs_stepper(const fvi_options *o)
{
    /* Columns with events need a stepper, because only it knows how many events there are, and when. */
    return fvi_options_observes(o)
           || (o->events && fvi_typed_columns_count(o->typed) > 0)
           || (o->mechanism
               && fvi_typed_columns_wanted(o->typed) & FVI_OBSERVE_VELOCITY);
}

int fvi_text_speaks_of(const char *text, const char *name)
{
    const size_t length = strlen(name);
    for (const char *at = text; (at = strstr(at, name)); at++) {
        const int before = at > text && (isalnum((unsigned char)at[-1]) || at[-1] == '_'),
                  after = isalnum((unsigned char)at[length]) || at[length] == '_';
        if (!before && !after)
            return 1;
    }
    return 0;
}

/* With --reduce a column is allowed only if it has a name that a reduction uses. */
static int check_named_columns(const fvi_options *o, fvi_error *c)
{
    for (const char *at = o->text[COLUMNS]; *at;) {
        char name[64] = "";
        const size_t length = fvi_list_item(at), named = strcspn(at, "=,(");
        snprintf(name, sizeof name, "%.*s", (int)(named < 60 ? named : 60), at);
        if (at[named] != '=' || !fvi_text_speaks_of(o->text[REDUCE], name))
            return fvi_refuse(c, "columns", "'%.*s' is of no use to --reduce, which has one row; NAME=EXPRESSION is, "
                              "if it speaks of NAME", length < 60 ? (int)length : 60, at);
        at += length + (at[length] == ',');
    }
    return 0;
}

int fvi_options_check_reduced(const fvi_options *o, fvi_error *c)
{
    if (!o->text[REDUCE])
        return 0;
    if (o->every > 1)
        return fvi_refuse(c, "every", "not together with --reduce, which has one row, of all steps");
    return o->text[COLUMNS] ? check_named_columns(o, c) : 0;
}

/* Accelerations, forces and work need sums over the steps, so only some commands know them. */
int fvi_options_check_columns(const fvi_options *o, fvi_error *c)
{
    const char *field = o->text[REDUCE] ? "reduce" : "columns",
               *text = o->text[o->text[REDUCE] ? REDUCE : COLUMNS];
    const unsigned unknown = FVI_OBSERVE_WORK | FVI_OBSERVE_MULTIPLIER;
    if (o->command == FVI_COMMAND_EXACT && fvi_typed_columns_wanted(o->typed) & unknown)
        return fvi_refuse(c, field, "'%s': the work of dampers and the balance are known to run alone", text);
    if (o->command == FVI_COMMAND_EXACT && fvi_options_observes(o))
        return fvi_check_exact_motion(o, c);
    if (!o->text[REDUCE])
        return 0;
    if (o->plot)
        return fvi_refuse(c, "reduce", "not together with --plot: it has one row");
    return 0;
}
