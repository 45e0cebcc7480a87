/* src/options/fvi_options.c -- Parse the command line of build/fvi. */
#include "fvi_options.h"
#include "fvi_mechanism_options.h"
#include "input/fvi_problem_words.h"

#include <fvi/convolution_quadrature_methods.h>
#include <fvi/variable_steps.h>

#include <string.h>

static int is_help(const char *word)
{
    return strcmp(word, "--help") == 0 || strcmp(word, "-h") == 0;
}

/* In the order of fvi_command; after them other words for the help. */
static const char *const commands[] = { "run",     "coefficients", "exact",
                                        "methods", "help",         "--version",
                                        "sweep",   "fit",          "gradient",
                                        "response", "poles",
                                        "--help",  "-h",           NULL };

const char *fvi_command_name(fvi_command command)
{
    return commands[command];
}

const char *fvi_command_of_word(const char *word)
{
    const char *command = commands[fvi_scan_word(word, strlen(word), commands)];
    return command ? command : "help";
}

static int command_of(const char *name, fvi_command *command, fvi_error *c)
{
    /* The hint is the nearest of these words, and the first one of several. -h would be near to every short word. */
    static const char *const all[] = {
        "run", "exact", "fit", "sweep", "gradient", "methods", "help", "coefficients", "response", "poles", "--help",
        "--version", NULL
    };
    const size_t i = fvi_scan_word(name, strlen(name), commands);
    char place[64];
    if (!commands[i])
        return fvi_refuse(c, NULL, "'%s' is not a command%s", name, fvi_word_hint(name, strlen(name), all, place));
    *command = is_help(commands[i]) ? FVI_COMMAND_HELP : (fvi_command)i;
    return 0;
}

/* Refuse a word that is no option of this command. */
static int refuse_unknown(const fvi_options *o, const char *given, fvi_error *c)
{
    const char *names[OPTIONS + 2];
    size_t n = 0;
    for (int i = 0; i < OUTPUT; i++)
        if (fvi_option_is_known(o->command, (option_index)i))
            names[n++] = fvi_option_list[i].name;
    names[n++] = "help";
    names[n] = NULL;
    return fvi_refuse_option(c, given, names);
}

/* Take the option `given`. Its value is the text behind =, the text behind the two letters of -o, or the next word. The
 * next word is NULL at the end of the words. *takes_next becomes nonzero if the value is the next word. */
static int read_option(fvi_options *o, const char *given, const char *next, int *takes_next, fvi_error *c)
{
    const int is_output = strncmp(given, "-o", 2) == 0;
    const option_index i = is_output ? OUTPUT : fvi_option_named(given);
    const char *equals = strchr(given, '='), *value = equals ? equals + 1 : NULL;
    if (i == OPTIONS || (i == CONTINUE && equals))
        return refuse_unknown(o, given, c);
    if (!fvi_option_is_known(o->command, i))
        return fvi_refuse(c, NULL, "%s%s: not an option of this command",
                          is_output ? "-" : "--", fvi_option_list[i].name);
    if (is_output)
        value = given[2] ? given + 2 : NULL;
    else if (i == CONTINUE)
        value = "";
    *takes_next = value == NULL;
    if (*takes_next && fvi_value_is_missing(given, next, c))
        return FVI_EINVAL;
    value = value ? value : next;
    return fvi_is_listed(i) ? fvi_list_option(o, i, value, c)
                            : fvi_word_once(is_output ? "-" : "--", fvi_option_list[i].name, &o->text[i], value, c);
}

/* Take the words after the command into o->text. If --help or -h is among them, the command becomes help. */
static int read_words(fvi_options *o, int count, char **words, fvi_error *c)
{
    int status = 0, takes_next = 0;
    for (int n = 0; n < count && !status; n += 1 + takes_next) {
        const char *word = words[n], *next = n + 1 < count ? words[n + 1] : NULL;
        if (is_help(word)) {
            o->about = o->command;
            o->command = FVI_COMMAND_HELP;
            return 0;
        }
        if (strcmp(word, "--") == 0) /* the end of the options */
            return next ? fvi_refuse(c, NULL, "'%s': not expected here", next) : 0;
        if (*word != '-' || !word[1])
            return fvi_refuse(c, NULL, "'%s': not expected here", word);
        status = read_option(o, word, next, &takes_next, c);
    }
    return status;
}

/* With --system, these options are replaced by the files of the folder: they are refused, and have no presets. */
static const option_index replaced[] = { MASS, RHO, POTENTIAL, DIMENSION };

static int is_replaced(const fvi_options *o, option_index i)
{
    for (size_t n = 0; n < sizeof replaced / sizeof *replaced; n++)
        if (o->text[SYSTEM] && replaced[n] == i)
            return 1;
    return 0;
}

static int check_system(const fvi_options *o, fvi_error *c)
{
    for (int i = 0; i < OPTIONS; i++)
        if (o->text[i] && is_replaced(o, (option_index)i))
            return fvi_refuse(c, "system", "not together with --%s", fvi_option_list[i].name);
    return 0;
}

/* Return the preset of an option. With --system the start is 0, because a building is at rest until something acts on
 * it. */
static const char *preset_of(const fvi_options *o, option_index i)
{
    const int is_start = i == X0 || i == P0;
    return is_start && o->text[SYSTEM] ? "0" : fvi_option_list[i].preset;
}

/* Return nonzero for an option that has no preset because a Lagrangian, a damper or --v0 takes its place. */
static int has_no_preset(const fvi_options *o, option_index i)
{
    const int is_damping = i == ALPHA || i == RHO || i == DERIVATIVE;
    return (o->text[LAGRANGIAN]
            && (is_damping || i == MASS || i == POTENTIAL))
           || (o->text[DAMPER] && is_damping) || (i == P0 && o->text[V0]);
}

/* Fill in the presets. The step comes from --h or from --time, or is searched for. */
static int fill_in(fvi_options *o, fvi_error *c)
{
    if (o->text[H] && o->text[ERROR])
        return fvi_refuse(c, "h", "not together with --error");
    if (o->text[ALPHA] && o->text[ORDER])
        return fvi_refuse(c, "order", "not together with --alpha, which is half of it");
    o->steps_follow = o->text[H] && o->text[TIME] && !o->text[STEPS];
    if (o->text[STEP_ERROR] && o->text[ERROR])
        return fvi_refuse(c, "step-error", "not together with --error");
    if (o->text[ERROR] && !o->text[TIME])
        o->text[TIME] = "20";
    const int law = o->text[DAMPING] != NULL;
    if (law && (o->text[ALPHA] || o->text[ORDER] || o->text[RHO]))
        return fvi_refuse(c, "damping", "not together with --%s",
                          o->text[ALPHA] ? "alpha" : o->text[ORDER] ? "order" : "rho");
    o->method_is_preset = !o->text[METHOD];
    if (o->text[ERROR] && !o->text[METHOD])
        o->text[METHOD] = o->text[SYSTEM] ? fvi_cq2_midpoint.name
                                          : fvi_variable_step.name; /* a law may choose another method later */
    if ((o->text[STEP_ERROR] || o->text[LONGEST] || o->text[EVENT]) && !o->text[METHOD])
        o->text[METHOD] = fvi_variable_step.name;
    int status = check_system(o, c);
    if (!status)
        status = fvi_check_mechanism_words(o, c);
    if (!o->text[METHOD] && fvi_wants_stable(o))
        o->text[METHOD] = fvi_cq2_midpoint.name;
    for (int i = 0; i < OPTIONS; i++)
        if (!o->text[i] && !(i == H && o->text[TIME])
            && !is_replaced(o, (option_index)i)
            && !has_no_preset(o, (option_index)i)
            && !(i == STEPS && o->steps_follow)
            && !(i == COLUMNS && o->text[REDUCE])
            && !(i == ALPHA && o->text[ORDER])
            && !(law && (i == ALPHA || i == RHO)))
            o->text[i] = preset_of(o, (option_index)i);
    return status;
}

int fvi_options_parse(int argc, char **argv, fvi_options *o, fvi_error *c)
{
    *o =
        (fvi_options){ .command = FVI_COMMAND_HELP, .about = FVI_COMMAND_HELP };
    if (argc < 2)
        return fvi_refuse(c, NULL, "a command is missing");
    int status = command_of(argv[1], &o->command, c);
    const int about = !status && o->command == FVI_COMMAND_HELP && argc > 2;
    if (about) /* fvi help run */
        status = command_of(argv[2], &o->about, c);
    if (!status
        && o->command >= FVI_COMMAND_SWEEP) { /* its options: see src/command_sweep and so on */
        for (int i = 2; i < argc && strcmp(argv[i], "--") != 0; i++)
            if (is_help(argv[i])) {
                o->about = o->command;
                o->command = FVI_COMMAND_HELP;
            }
        return 0;
    }
    if (!status)
        status = read_words(o, argc - 2 - about, argv + 2 + about, c);
    if (!status && fvi_option_is_known(o->command, OPTIONS))
        status = fill_in(o, c);
    return !status && fvi_option_is_known(o->command, OPTIONS)
               ? fvi_options_interpret(o, c)
               : status;
}
