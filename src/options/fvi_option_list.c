/* src/options/fvi_option_list.c -- List the options of the command line of build/fvi. */
#include "fvi_option_list.h"
#include "input/fvi_problem_words.h"

#include <ctype.h>
#include <stdint.h>
#include <string.h>

const char *const fvi_format_names[] = { "tsv", "csv", "json", NULL };

enum { RUN = 1, EXACT = 2, COEFFICIENTS = 4 };

const fvi_option fvi_option_list[OPTIONS] = {
    [METHOD] = { "method", RUN, "fvi" },
    [ALPHA] = { "alpha", RUN | EXACT | COEFFICIENTS, "0.5" },
    [ORDER] = { "order", RUN | EXACT | COEFFICIENTS, NULL },
    [RHO] = { "rho", RUN | EXACT, "0.2" },
    [DAMPING] = { "damping", RUN | EXACT, NULL },
    [MASS] = { "mass", RUN | EXACT, "1" },
    [POTENTIAL] = { "potential", RUN | EXACT, "harmonic:1" },
    [LAGRANGIAN] = { "lagrangian", RUN, NULL },
    [DAMPER] = { "damper", RUN | EXACT, NULL },
    [CONSTRAINT] = { "constraint", RUN, NULL },
    [IMPOSE] = { "impose", RUN, NULL },
    [FORCE_ON] = { "force-on", RUN, NULL },
    [EVENT] = { "event", RUN, NULL },
    [LET] = { "let", RUN | EXACT, NULL },
    [DIMENSION] = { "dimension", RUN | EXACT, NULL },
    [SYSTEM] = { "system", RUN | EXACT, NULL },
    [FORCE] = { "force", RUN | EXACT, "none" },
    [GROUND] = { "ground", RUN, NULL },
    [ALONG] = { "along", RUN, NULL },
    [DERIVATIVE] = { "derivative", RUN | EXACT, "held" },
    [KAPPA] = { "kappa", RUN, "0.5" },
    [X0] = { "x0", RUN | EXACT, "1" },
    [P0] = { "p0", RUN | EXACT, "0.5" },
    [V0] = { "v0", RUN, NULL },
    [H] = { "h", RUN | EXACT, "0.1" },
    [STEPS] = { "steps", RUN | EXACT, "200" },
    [TIME] = { "time", RUN | EXACT, NULL },
    [ERROR] = { "error", RUN, NULL },
    [STEP_ERROR] = { "step-error", RUN, NULL },
    [LONGEST] = { "longest", RUN, NULL },
    [COLUMNS] = { "columns", RUN | EXACT, "t,x,p,energy" },
    [REDUCE] = { "reduce", RUN, NULL },
    [UNKNOWNS] = { "unknowns", RUN | EXACT, NULL },
    [EVERY] = { "every", RUN | EXACT, "1" },
    [MEMORY] = { "memory", RUN, "auto" },
    [TOLERANCE] = { "tolerance", RUN, "1e-13" },
    [COUNT] = { "count", COEFFICIENTS, "10" },
    [MOST_STEPS] = { "most-steps", RUN, NULL },
    [FORMAT] = { "format", RUN | EXACT | COEFFICIENTS, "tsv" },
    [PLOT] = { "plot", RUN | EXACT, NULL },
    [SNAPSHOT] = { "snapshot", RUN, NULL },
    [CHECKPOINT] = { "checkpoint", RUN, NULL },
    [CONTINUE] = { "continue", RUN, NULL },
    [OUTPUT] = { "o", RUN | EXACT | COEFFICIENTS, NULL },
};

static int mask_of_command(fvi_command command)
{
    return command == FVI_COMMAND_RUN            ? RUN
           : command == FVI_COMMAND_EXACT        ? EXACT
           : command == FVI_COMMAND_COEFFICIENTS ? COEFFICIENTS
                                                 : 0;
}

int fvi_option_is_known(fvi_command command, option_index i)
{
    if (i == OPTIONS)
        return mask_of_command(command) != 0;
    return (fvi_option_list[i].commands & mask_of_command(command)) != 0;
}

option_index fvi_option_named(const char *word)
{
    int i = 0;
    while (i < OUTPUT && !fvi_word_is_option(word, fvi_option_list[i].name))
        i++;
    return i < OUTPUT ? (option_index)i : OPTIONS;
}

int fvi_value_is_missing(const char *given, const char *next, fvi_error *c)
{
    if (!next)
        return fvi_refuse(c, NULL, "%s: a value is missing", given);
    return strcmp(next, "-o") == 0 || (strncmp(next, "--", 2) == 0 && isalpha((unsigned char)next[2]))
               ? fvi_refuse(c, NULL, "%s: a value is missing before '%s'", given, next)
               : 0;
}

int fvi_option_number(const fvi_options *o, option_index i, double low, double high, const char *brackets,
                      double *value, fvi_error *c)
{
    return fvi_parse_number(fvi_option_list[i].name, o->text[i], low, high, brackets, value, c);
}

int fvi_option_whole(const fvi_options *o, option_index i, size_t *value, fvi_error *c)
{
    return fvi_parse_whole(fvi_option_list[i].name, o->text[i], SIZE_MAX / 2, value, c);
}

int fvi_options_describe(const fvi_options *o, size_t i, const char **name,
                         const char **value)
{
    size_t seen = 0;
    for (size_t j = 0; j < FORMAT; j++)
        if (fvi_option_is_known(o->command, (option_index)j) && o->text[j]
            && seen++ == i) {
            *name = fvi_option_list[j].name;
            *value = o->text[j];
            return 1;
        }
    return 0;
}
