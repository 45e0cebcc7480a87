/* src/program/fvi_options.c -- What the command line of build/fvi says. */
#define _GNU_SOURCE /* getopt_long */
#include "fvi_options.h"

#include "fvi_values.h"

#include <getopt.h>
#include <string.h>

/* ---- the table of options ---- */

enum { RUN = 1, EXACT = 2, COEFFICIENTS = 4 };

static const struct {
    const char *name;
    int commands;       /* which of them know it */
    const char *preset; /* NULL: none */
} table[OPTIONS] = {
    [METHOD] = { "method", RUN, "fvi" },
    [ALPHA] = { "alpha", RUN | EXACT | COEFFICIENTS, "0.5" },
    [RHO] = { "rho", RUN | EXACT, "0.2" },
    [MASS] = { "mass", RUN | EXACT, "1" },
    [POTENTIAL] = { "potential", RUN | EXACT, "harmonic:1" },
    [FORCE] = { "force", RUN | EXACT, "none" },
    [DERIVATIVE] = { "derivative", RUN | EXACT, "held" },
    [KAPPA] = { "kappa", RUN, "0.5" },
    [X0] = { "x0", RUN | EXACT, "1" },
    [P0] = { "p0", RUN | EXACT, "0.5" },
    [H] = { "h", RUN | EXACT, "0.1" },
    [STEPS] = { "steps", RUN | EXACT, "200" },
    [TIME] = { "time", RUN | EXACT, NULL },
    [ERROR] = { "error", RUN, NULL },
    [COLUMNS] = { "columns", RUN | EXACT, "t,x,p,energy" },
    [EVERY] = { "every", RUN | EXACT, "1" },
    [MEMORY] = { "memory", RUN, "auto" },
    [TOLERANCE] = { "tolerance", RUN, "1e-13" },
    [COUNT] = { "count", COEFFICIENTS, "10" },
    [OUTPUT] = { "o", RUN | EXACT | COEFFICIENTS, NULL },
};

const char *fvi_option_name(option_index i)
{
    return table[i].name;
}

static int mask(fvi_command command)
{
    return command == FVI_COMMAND_RUN            ? RUN
           : command == FVI_COMMAND_EXACT        ? EXACT
           : command == FVI_COMMAND_COEFFICIENTS ? COEFFICIENTS
                                                 : 0;
}

int fvi_options_describe(const fvi_options *o, size_t i, const char **name,
                         const char **value)
{
    size_t seen = 0;
    for (size_t j = 0; j < OUTPUT; j++)
        if (table[j].commands & mask(o->command) && o->text[j] && seen++ == i) {
            *name = table[j].name;
            *value = o->text[j];
            return 1;
        }
    return 0;
}

/* ---- getopt ---- */

static int is_help(const char *word)
{
    return strcmp(word, "--help") == 0 || strcmp(word, "-h") == 0;
}

static int command_of(const char *name, fvi_command *command, fvi_complaint c)
{
    /* in the order of fvi_command, then other words for the help */
    static const char *const commands[] = {
        "run",       "coefficients", "exact", "methods", "help",
        "--version", "--help",       "-h",    NULL
    };
    for (size_t i = 0; commands[i]; i++)
        if (strcmp(name, commands[i]) == 0) {
            *command = is_help(name) ? FVI_COMMAND_HELP : (fvi_command)i;
            return 0;
        }
    const char *nearest = fvi_word_nearest(name, strlen(name), commands);
    return fvi_refuse(c, "'%s' is not a command%s%s%s", name,
                      nearest ? "; did you mean " : "", nearest ? nearest : "",
                      nearest ? "?" : "");
}

/* A word that is none of the options of this command. */
static int unknown(const fvi_options *o, const char *given, fvi_complaint c)
{
    const char *names[OPTIONS + 2], *word = given + strspn(given, "-");
    size_t n = 0;
    for (int i = 0; i < OUTPUT; i++)
        if (table[i].commands & mask(o->command))
            names[n++] = table[i].name;
    names[n++] = "help";
    names[n] = NULL;
    const char *nearest = fvi_word_nearest(word, strcspn(word, "="), names);
    return fvi_refuse(c, "%s: no such option%s%s%s", given,
                      nearest ? "; did you mean --" : "",
                      nearest ? nearest : "", nearest ? "?" : "");
}

/* One more option with its text. A long name must be written in full. */
static int take(fvi_options *o, int found, const char *given, fvi_complaint c)
{
    if (found == '?')
        return unknown(o, given, c);
    if (found == ':')
        return fvi_refuse(c, "%s: a value is missing", given);
    option_index i = (option_index)(found - 256);
    size_t length = strcspn(given, "=");
    if (i != OUTPUT
        && (length != strlen(table[i].name) + 2
            || strncmp(given + 2, table[i].name, length - 2) != 0))
        return unknown(o, given, c);
    if (!(table[i].commands & mask(o->command)))
        return fvi_refuse(c, "%s%s: not an option of this command",
                          i == OUTPUT ? "-" : "--", table[i].name);
    if (o->text[i] && strcmp(o->text[i], optarg) != 0)
        return fvi_refuse(c, "%s%s: given twice, as '%s' and as '%s'",
                          i == OUTPUT ? "-" : "--", table[i].name, o->text[i],
                          optarg);
    o->text[i] = optarg;
    return 0;
}

/* The words behind the command into o->text; --help or -h among them changes
 * the command. */
static int take_all(fvi_options *o, int count, char **words, fvi_complaint c)
{
    struct option longs[OPTIONS + 1] = { { 0 } };
    for (int i = 0; i < OUTPUT; i++)
        longs[i] =
            (struct option){ table[i].name, required_argument, NULL, 256 + i };
    longs[OUTPUT] = (struct option){ "help", no_argument, NULL, 256 + OPTIONS };

    optind = 0; /* start afresh, whoever parsed before */
    opterr = 0;
    for (;;) {
        const char *given = words[optind ? optind : 1];
        int found = getopt_long(count, words, "+:o:h", longs, NULL);
        if (found == -1)
            break;
        if ((found == 256 + OPTIONS || found == 'h') && is_help(given)) {
            o->about = o->command;
            o->command = FVI_COMMAND_HELP;
            return 0;
        }
        found = found == 'o' ? 256 + OUTPUT
                : found == 256 + OPTIONS || found == 'h'
                    ? '?' /* --hel, -h0.1 */
                    : found;
        int status = take(o, found, given, c);
        if (status)
            return status;
    }
    return optind < count
               ? fvi_refuse(c, "'%s': not expected here", words[optind])
               : 0;
}

/* The presets; the step comes from --h, or from --time, or is looked for. */
static int fill_in(fvi_options *o, fvi_complaint c)
{
    const option_index instead = o->text[ERROR] ? ERROR : TIME;
    if (o->text[H] && o->text[instead])
        return fvi_refuse(c, "--h: not together with --%s",
                          table[instead].name);
    if (o->text[ERROR] && !o->text[TIME])
        o->text[TIME] = "20";
    for (int i = 0; i < OPTIONS; i++)
        if (!o->text[i] && !(i == H && o->text[TIME]))
            o->text[i] = table[i].preset;
    return 0;
}

int fvi_options_parse(int argc, char **argv, fvi_options *o, char *text,
                      size_t size)
{
    fvi_complaint c = { text, size };
    *o = (fvi_options){ .about = FVI_COMMAND_HELP };
    if (argc < 2)
        return fvi_refuse(c, "a command is missing");
    int status = command_of(argv[1], &o->command, c);
    const int about = !status && o->command == FVI_COMMAND_HELP && argc > 2;
    if (about) /* fvi help run */
        status = command_of(argv[2], &o->about, c);
    if (!status)
        status = take_all(o, argc - 1 - about, argv + 1 + about, c);
    if (!status && mask(o->command))
        status = fill_in(o, c);
    return !status && mask(o->command) ? fvi_options_interpret(o, c) : status;
}
