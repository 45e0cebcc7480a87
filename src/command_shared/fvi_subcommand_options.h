/* src/command_shared/fvi_subcommand_options.h -- Commands with options of their own beside those of
 * `fvi run`: fit, gradient, response and poles. */
#ifndef FVI_SUBCOMMAND_OPTIONS_H
#define FVI_SUBCOMMAND_OPTIONS_H

#include "options/fvi_options.h"

#include <stdio.h>

enum {
    FVI_SUBCOMMAND_MOST = 6, /* options of its own that a command may have */
    FVI_OPERANDS_MOST = 64,
    FVI_PRESETS_MOST = 5
};

struct fvi_subcommand_options;

/* What such a command knows. */
typedef struct {
    const char *name;
    /* Its options without hyphens, ended by NULL. The last is the name of a file to be written, and
     * not in the head of fvi_subcommand_options_head. */
    const char *own[FVI_SUBCOMMAND_MOST + 1];
    const char *const *without; /* options of run that it has not, likewise; NULL: see with */
    char *method; /* "--method=M" where none is given; NULL: that of run */
    int operand;  /* so many words may be no options */
    const char *const *with; /* or those that it has, likewise, and no others */
    const char *flag;        /* its option that has no value, or NULL */
    const char *no_events;   /* why it has no --event, or NULL */
    char *const *presets;    /* words for run, where they are not given; ended by NULL */
    /* NULL, or one more word for run that the operands ask for, which is written to `text`, or no
     * letter: the words for run so far are given, too. */
    void (*more)(const struct fvi_subcommand_options *w, char *const *run, size_t size, char *text);
} fvi_own_command;

/* What the words say of that. */
typedef struct fvi_subcommand_options {
    const char *own[FVI_SUBCOMMAND_MOST]; /* texts, in that order, or NULL */
    const char *operand;           /* the first, or NULL */
    const char *all[FVI_OPERANDS_MOST];
    size_t operands;               /* of them */
    int flag;                      /* is the flag given? */
    int given[OPTIONS];            /* is this option of run? */
    char more[64];                 /* the word that the operands asked for */
} fvi_subcommand_options;

/* fvi_subcommand_options_parse -- sort the words of main behind the name of the command: its own
 * into w, which is all 0, those of run into o. Returns as fvi_options_parse, and o, all 0 before, is to
 * be freed in each case. */
int fvi_subcommand_options_parse(const fvi_own_command *command, int argc, char **argv,
                        fvi_subcommand_options *w, fvi_options *o, fvi_error *c);

/* fvi_subcommand_options_head -- the head of a table: the version, the options of run that the
 * command has, and its own that are given. */
void fvi_subcommand_options_head(FILE *out, const fvi_own_command *command,
                        const fvi_subcommand_options *w, const fvi_options *o);

#endif
