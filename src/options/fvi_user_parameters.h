/* src/options/fvi_user_parameters.h -- Parameters of expressions: --let k=3. */
#ifndef FVI_USER_PARAMETERS_H
#define FVI_USER_PARAMETERS_H

#include "fvi_words.h"

#include <fvi/expression.h>

enum { FVI_MOST_LETS = 64 };

/* Do not copy one that is in use: name points into names. */
typedef struct {
    size_t count;
    char text[1024];  /* "k=3,c=2*k", as it was given */
    char names[1024]; /* the same in pieces */
    const char *name[FVI_MOST_LETS];
    double value[FVI_MOST_LETS];
    unsigned char used[FVI_MOST_LETS]; /* bit 1: a potential speaks of it; 2: a
                                          force; 4: the value of another */
} fvi_user_parameters;

/* fvi_user_parameters_add -- one more "k=3", or several; understood by fvi_user_parameters_interpret.
 * Returns 0, or 2 if there is no room. */
int fvi_user_parameters_add(fvi_user_parameters *lets, const char *text, fvi_complaint c);

/* fvi_user_parameters_interpret -- lets->text. A value may be an expression of those before it. A
 * name that is taken, or appears twice with different values, is refused.
 * Returns 0; 2 if a word is refused; 1 if there is no memory. */
int fvi_user_parameters_interpret(fvi_user_parameters *lets, fvi_complaint c);

/* fvi_user_parameters_parse -- fvi_expression_parse of x, or x1, ..., xd, or of t, with these
 * parameters, of which it is noted which are used. Returns what that returns. */
int fvi_user_parameters_parse(fvi_user_parameters *lets, const char *variable, size_t d,
                   const char *text, fvi_expression **e, fvi_misprint *wrong);

/* fvi_user_parameters_are_used -- does an expression speak of each? Returns 0, or 2. */
int fvi_user_parameters_are_used(const fvi_user_parameters *lets, fvi_complaint c);

#endif
