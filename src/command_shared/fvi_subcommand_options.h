/* src/command_shared/fvi_subcommand_options.h -- Parse the commands that have options of their own beside those of `fvi
 * run`: fit, gradient, response and poles. */
#ifndef FVI_SUBCOMMAND_OPTIONS_H
#define FVI_SUBCOMMAND_OPTIONS_H

#include "options/fvi_options.h"

#include <stdio.h>

enum {
    FVI_SUBCOMMAND_MOST = 6, /* the most options of its own that a command may have */
    FVI_OPERANDS_MOST = 64,
    FVI_PRESETS_MOST = 5
};

struct fvi_subcommand_options;

/* The syntax of such a command. Lists of names are without hyphens and end with NULL. */
typedef struct {
    const char *name;
    /* The options of its own. The last option is the name of an output file, so fvi_subcommand_options_head leaves it
     * out. */
    const char *own[FVI_SUBCOMMAND_MOST + 1];
    const char *const *without; /* options of run that the command does not have; NULL: see with */
    int operand;  /* the most operands that are allowed */
    const char *const *with; /* the only options of run that the command has; NULL: see without */
    const char *flag;        /* its option without a value, or NULL */
    const char *no_events;   /* why it has no --event, or NULL */
    char *const *presets;    /* options for run, each used unless it is given; ended by NULL */
    /* NULL, or a function that writes one more option for run to `text`, or the empty string. The operands decide
     * which. `run` contains the options for run so far. */
    void (*more)(const struct fvi_subcommand_options *w, char *const *run, size_t size, char *text);
} fvi_own_command;

/* The options of such a command, as they were given. */
typedef struct fvi_subcommand_options {
    const char *own[FVI_SUBCOMMAND_MOST]; /* the values of its own options, in the order of own; NULL if not given */
    const char *all[FVI_OPERANDS_MOST]; /* the operands */
    size_t operands;               /* number of operands */
    int flag;                      /* nonzero if the flag is given */
    int given[OPTIONS];            /* nonzero for each option of run that is given */
    char more[64];                 /* the option that the operands asked for */
} fvi_subcommand_options;

/* fvi_subcommand_options_parse -- Sort the words after the name of the command: the options of its own into w, the
 * options of run into o. Both are all 0 before. Return what fvi_options_parse returns. Free o with fvi_options_free in
 * each case. */
int fvi_subcommand_options_parse(const fvi_own_command *command, int argc, char **argv,
                        fvi_subcommand_options *w, fvi_options *o, fvi_error *c);

/* fvi_subcommand_options_head -- Print the head of a table: the version, the options of run that the command has, and
 * the options of its own that are given, except the last. */
void fvi_subcommand_options_head(FILE *out, const fvi_own_command *command,
                        const fvi_subcommand_options *w, const fvi_options *o);

#endif
