/* src/program/fvi_values.h -- From the words of the command line to values: the inside of
 * fvi_options.h. */
#ifndef FVI_VALUES_H
#define FVI_VALUES_H

#include "fvi_options.h"
#include "fvi_words.h"

typedef enum {
    METHOD,
    ALPHA,
    RHO,
    MASS,
    POTENTIAL,
    FORCE,
    DERIVATIVE,
    KAPPA,
    X0,
    P0,
    H,
    STEPS,
    TIME,
    ERROR,
    COLUMNS,
    EVERY,
    MEMORY,
    TOLERANCE,
    COUNT,
    OUTPUT,
    OPTIONS
} option_index;

/* The name of option i, without its hyphens. */
const char *fvi_option_name(option_index i);

/* Interpret o->text, presets filled in. Returns 0; 2 if a word is refused, 1 if there
 * is no memory, with the complaint written and nothing allocated. */
int fvi_options_interpret(fvi_options *o, fvi_complaint c);

#endif
