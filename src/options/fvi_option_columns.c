/* src/options/fvi_option_columns.c -- --columns and --reduce. */
#include "fvi_option_columns.h"
#include "fvi_problem.h"

#include <stdlib.h>

static int start(fvi_options *o, fvi_error *c)
{
    o->column_source = malloc(sizeof *o->column_source);
    if (!o->column_source)
        return fvi_fail(c, FVI_ENOMEM, NULL, NAN, "not enough memory");
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
                        : fvi_fail(c, FVI_ENOMEM, NULL, NAN, "not enough memory");
}

int fvi_options_observes(const fvi_options *o)
{
    const unsigned sums = FVI_OBSERVE_ACCELERATION | FVI_OBSERVE_FORCE
                          | FVI_OBSERVE_IMPULSE | FVI_OBSERVE_WORK
                          | FVI_OBSERVE_MULTIPLIER;
    return (fvi_typed_columns_wanted(o->typed) & sums) != 0;
}

int fvi_options_needs_stepper(const fvi_options *o)
{
    return fvi_options_observes(o)
           || (o->mechanism
               && fvi_typed_columns_wanted(o->typed) & FVI_OBSERVE_VELOCITY);
}

/* Sums over the steps need a run of known steps. */
int fvi_options_check_columns(const fvi_options *o, fvi_error *c)
{
    const char *field = o->text[REDUCE] ? "reduce" : "columns",
               *text = o->text[o->text[REDUCE] ? REDUCE : COLUMNS];
    if (fvi_options_observes(o) && o->command == FVI_COMMAND_EXACT)
        return fvi_refuse(c, field,
                          "'%s': a, and a damper's force, impulse and work, are "
                          "known to run alone",
                          text);
    if (!o->text[REDUCE])
        return 0;
    if (o->error > 0)
        return fvi_refuse(c, "reduce", "not together with --error");
    if (o->checkpoint)
        return fvi_refuse(c, "reduce", "not together with --checkpoint");
    if (o->plot)
        return fvi_refuse(c, "reduce", "not together with --plot: it has one row");
    return 0;
}
