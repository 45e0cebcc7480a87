/* src/options/fvi_grid.c -- Find the times of the rows from --h, --steps and --time. */
#include "fvi_grid.h"

#include <fvi/format_double.h>

#include <float.h>
#include <math.h>
#include <stdio.h>

/* Interpret --h H and --time T: there are T/H steps. If --steps is given, it must agree. */
static int interpret_step_and_time(fvi_options *o, fvi_error *c)
{
    int status = fvi_option_number(o, H, 0, INFINITY, "()", &o->h, c);
    if (!status)
        status = fvi_option_number(o, TIME, 0, INFINITY, "()", &o->time, c);
    if (status)
        return status;
    const double steps = o->time / o->h, whole_steps = round(steps);
    if (!(steps < 0x1p53))
        return fvi_refuse(c, "time", "'%s' is more than %.4g steps of --h %s", o->text[TIME], 0x1p53, o->text[H]);
    if (!(whole_steps >= 1 && fabs(steps - whole_steps) <= 1e-9 * whole_steps))
        return fvi_refuse(c, "time", "'%s' is not a whole number of steps of --h %s", o->text[TIME], o->text[H]);
    if (o->text[STEPS]) {
        status = fvi_option_whole(o, STEPS, &o->steps, c);
        return status || (double)o->steps == whole_steps
                   ? status
                   : fvi_refuse(c, "steps", "'%s' is not %.0f, which --time by --h is", o->text[STEPS], whole_steps);
    }
    o->steps = (size_t)whole_steps;
    snprintf(o->count_text, sizeof o->count_text, "%zu", o->steps);
    o->text[STEPS] = o->count_text;
    return 0;
}

/* Find h and the number of steps from --h, from --time, or from both. */
int fvi_options_grid(fvi_options *o, fvi_error *c)
{
    if (o->text[H] && o->text[TIME])
        return interpret_step_and_time(o, c);
    int status = fvi_option_whole(o, STEPS, &o->steps, c);
    if (status || !o->text[TIME])
        return status ? status : fvi_option_number(o, H, 0, INFINITY, "()", &o->h, c);
    status = fvi_option_number(o, TIME, 0, INFINITY, "()", &o->time, c);
    if (status)
        return status;
    o->h = o->time / (double)o->steps;
    if (!(o->h > 0))
        return fvi_refuse(c, "time", "'%s' is too short for so many steps", o->text[TIME]);
    fvi_format_double(o->h, o->step);
    o->text[H] = o->step; /* the head contains the step that follows */
    return 0;
}

/* Refuse a force that jumps between two rows, because no estimate of the error can see such a jump. A method that ends
 * its steps at jumps is not affected. */
int fvi_options_refuse_jumps(const fvi_options *o, option_index which,
                        const fvi_typed_force *force, fvi_error *c)
{
    for (size_t i = 0; force && !o->method->dense; i++) {
        const double jump = fvi_typed_force_jump(force, i), end = jump / o->h,
                     row = round(end);
        if (isnan(jump))
            break;
        if (row <= (double)o->steps && fabs(end - row) > 4 * DBL_EPSILON * row)
            return fvi_refuse(c, "error", "the %s '%s' jumps between two rows; take other --steps%s",
                              fvi_option_list[which].name, o->text[which],
                              o->text[DAMPING] || o->directory ? "" : ", or --method fvi-adaptive");
    }
    return 0;
}
