/* src/command_shared/fvi_subcommand_options.c -- Parse the commands that have options of their own beside those of `fvi
 * run`. */
#include "fvi_subcommand_options.h"
#include "input/fvi_problem_words.h"
#include "output/fvi_format.h"

#include <stdlib.h>
#include <string.h>

/* The state of the parser. The options of `fvi run` are collected in `run`. */
typedef struct {
    const fvi_own_command *command;
    fvi_subcommand_options *w;
    char **run;
    int count;
    fvi_error *c;
} sorter;

/* Return the index of the option that the word "--name" or "--name=value" gives, or -1. */
static int index_of(const char *word, const char *const *names)
{
    for (int i = 0; names[i]; i++)
        if (fvi_word_is_option(word, names[i]))
            return i;
    return -1;
}

static int is_without(const fvi_own_command *command, const char *name)
{
    return fvi_is_one_of(name, command->with ? command->with : command->without) == !command->with;
}

/* Return nonzero if the option belongs to `fvi run` and to this command. */
static int is_shared(const fvi_own_command *command, option_index i)
{
    return fvi_option_is_known(FVI_COMMAND_RUN, i)
           && !is_without(command, fvi_option_list[i].name);
}

/* Refuse an option of another command, or an unknown option. For an unknown one the message names the nearest known
 * option, because it may be a typing error. */
static int refuse_option(const sorter *s, const char *word, option_index i)
{
    const char *names[FVI_SUBCOMMAND_MOST + OPTIONS + 3];
    size_t n = 0;
    const char *why = i == EVENT ? s->command->no_events : NULL;
    if (i < OPTIONS)
        return fvi_refuse(s->c, fvi_option_list[i].name, "not an option of this command%s%s", why ? ": " : "",
                          why ? why : "");
    for (; s->command->own[n]; n++)
        names[n] = s->command->own[n];
    if (s->command->flag)
        names[n++] = s->command->flag;
    for (int j = 0; j < OUTPUT; j++)
        if (is_shared(s->command, (option_index)j))
            names[n++] = fvi_option_list[j].name;
    names[n++] = "help";
    names[n] = NULL;
    return fvi_refuse_option(s->c, word, names);
}

static int read_own_option(sorter *s, int which, const char *given, const char *next)
{
    const char *equals = strchr(given, '='), *name = s->command->own[which];
    const int status = equals ? 0 : fvi_value_is_missing(given, next, s->c);
    return status ? status : fvi_word_once("--", name, &s->w->own[which], equals ? equals + 1 : next, s->c);
}

static int read_operand(sorter *s, const char *word)
{
    if (s->w->operands >= (size_t)s->command->operand)
        return fvi_refuse(s->c, NULL, "'%s': not expected here", word);
    s->w->all[s->w->operands++] = word;
    return 0;
}

static int sort_words(sorter *s, int argc, char **argv)
{
    int status = 0, is_after_end = 0; /* after --, which ends the options */
    for (int i = 2; i < argc && !status; i++) {
        char *word = argv[i], *equals = strchr(word, '=');
        const int own = index_of(word, s->command->own),
                  is_output = strncmp(word, "-o", 2) == 0;
        const option_index of_run = is_output ? OUTPUT : fvi_option_named(word);
        if (is_after_end) {
            status = read_operand(s, word);
        } else if (strcmp(word, "--") == 0) {
            is_after_end = 1;
        } else if (s->command->flag && strncmp(word, "--", 2) == 0
            && strcmp(word + 2, s->command->flag) == 0) {
            s->w->flag = 1;
        } else if (own >= 0) {
            status = read_own_option(s, own, word, argv[i + 1]);
            i += !equals;
        } else if (*word != '-') {
            status = read_operand(s, word);
        } else if (of_run == OPTIONS || !is_shared(s->command, of_run)) {
            status = refuse_option(s, word, of_run);
        } else {
            s->w->given[of_run] = 1;
            s->run[s->count++] = word;
            if (is_output ? !word[2] : !equals) {
                status = fvi_value_is_missing(word, argv[i + 1], s->c);
                s->run[s->count++] = argv[++i];
            }
        }
    }
    return status;
}

int fvi_subcommand_options_parse(const fvi_own_command *command, int argc, char **argv,
                        fvi_subcommand_options *w, fvi_options *o, fvi_error *c)
{
    char **run = malloc(((size_t)argc + 3 + FVI_PRESETS_MOST) * sizeof *run);
    if (!run)
        return fvi_no_memory(c, NULL);
    run[0] = argv[0];
    run[1] = "run";
    sorter s = { command, w, run + 2, 0, c };
    int status = sort_words(&s, argc, argv);
    for (size_t i = 0; command->presets && command->presets[i]; i++)
        if (!w->given[fvi_option_named(command->presets[i])])
            s.run[s.count++] = command->presets[i];
    s.run[s.count] = NULL;
    if (!status && command->more) {
        command->more(w, s.run, sizeof w->more, w->more);
        if (*w->more)
            s.run[s.count++] = w->more;
        s.run[s.count] = NULL;
    }
    if (!status)
        status = fvi_options_parse(s.count + 2, run, o, c);
    free(run);
    /* Without these options the mechanism comes from a mass of 0 or from a potential that contains t. */
    if (!status && o->mechanism && !o->text[DAMPER] && !o->text[LAGRANGIAN]
        && !o->text[CONSTRAINT] && !o->text[IMPOSE] && !o->text[FORCE_ON])
        return fvi_refuse(c, o->potential_has_time ? "potential" : "mass", "'%s' is not for %s",
                          o->text[o->potential_has_time ? POTENTIAL : MASS], command->name);
    return status;
}

void fvi_subcommand_options_head(FILE *out, const fvi_own_command *command,
                        const fvi_subcommand_options *w, const fvi_options *o)
{
    const char *name, *value;
    fvi_format_begin(out, FVI_FORMAT_TSV);
    for (size_t i = 0; fvi_options_describe(o, i, &name, &value); i++)
        if (!is_without(command, name))
            fvi_format_parameter(out, FVI_FORMAT_TSV, name, value);
    for (size_t i = 0; command->own[i + 1]; i++)
        if (w->own[i])
            fvi_format_parameter(out, FVI_FORMAT_TSV, command->own[i],
                                 w->own[i]);
}
