/* src/program/fvi_options.h -- What the command line of build/fvi says. */
#ifndef FVI_OPTIONS_H
#define FVI_OPTIONS_H

#include "fvi_words.h"
#include <fvi/trajectory.h>

typedef enum {
    FVI_COMMAND_RUN,
    FVI_COMMAND_COEFFICIENTS,
    FVI_COMMAND_EXACT,
    FVI_COMMAND_METHODS,
    FVI_COMMAND_HELP,
    FVI_COMMAND_VERSION
} fvi_command;

/* The words of the command line, understood and in range. */
typedef struct {
    fvi_command command;
    fvi_command about; /* of what help speaks; HELP itself for the whole */
    const fvi_method *method;
    double alpha, rho, mass, kappa, h, tolerance;
    double error; /* 0: the step is h; else it is to be found */
    size_t steps, every, count, d;
    fvi_potential_kind potential;
    double spring[2]; /* its parameters */
    fvi_forcing force;
    double forcing[2]; /* its parameters */
    fvi_past past;
    int no_solution; /* 1: only the method that does what is printed runs it */
    fvi_memory_kind memory;
    fvi_columns columns;
    double *x0, *p0;      /* d numbers each, one block; fvi_options_free */
    const char *output;   /* points into argv, or NULL for standard output */
    const char *text[32]; /* each as it was given or by default, by index */
    char step[32];        /* the text of a step that follows from --time */
} fvi_options;

/* fvi_options_parse -- understand argv, or say what is wrong with it.
 *
 *   argc, argv  as main has them; getopt_long may permute nothing: it stops at
 *               the first word that is no option
 *   o           output; free it with fvi_options_free if 0 is returned
 *   complaint   output if the words are refused: one line without the newline,
 *               "--alpha: '1.5' is outside [0, 1]"
 *   size        of complaint
 *
 * Prints nothing and opens nothing. Returns 0; 2 if refused; 1 if there is no
 * memory. On error nothing is left to free. */
int fvi_options_parse(int argc, char **argv, fvi_options *o, char *complaint,
                      size_t size);
void fvi_options_free(fvi_options *o);

/* fvi_options_system -- the system that the words describe. It points into o,
 * and takes 2 d numbers of storage for masses and dampings. */
fvi_system fvi_options_system(const fvi_options *o, double *storage);

/* fvi_options_describe -- "name = value" of option number i of a command, in the
 * order of the manual. Returns 0 when there is no option i. */
int fvi_options_describe(const fvi_options *o, size_t i, const char **name,
                         const char **value);

#endif
