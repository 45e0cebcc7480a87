/* src/command_response/fvi_linear.h -- What `fvi response` and `fvi poles` share: a linear motion. */
#ifndef FVI_LINEAR_H
#define FVI_LINEAR_H

#include "command_shared/fvi_subcommand_options.h"

#include <fvi/response.h>

/* The words of such a command, and what they describe. */
typedef struct {
    fvi_subcommand_options words;
    fvi_options o;
    fvi_system system;
    double *along;          /* how the unknowns move with the ground; NULL: all alike */
    fvi_response *response; /* NULL before fvi_linear_open */
    const char *warning;    /* of the head, or NULL */
} fvi_linear_request;

/* The options of run that say what is linear, and how a table is written; and the words that stand
 * for the others. */
#define FVI_LINEAR_OPTIONS                                                     \
    "alpha", "order", "rho", "damping", "damper", "mass", "potential", "let",  \
        "dimension", "system", "x0", "format", "o"
extern char *const fvi_linear_presets[];

/* fvi_linear_open -- the response of what the words describe. Returns 0, or 1 after it has said what
 * is wrong. It is warned of a place that is no equilibrium. */
int fvi_linear_open(fvi_linear_request *r);

/* fvi_linear_head -- the version, the options in `names`, ended by NULL, that have a text, but for x0; and
 * where the motion was made linear, if it was not. */
void fvi_linear_head(FILE *out, const fvi_linear_request *r,
                     const char *const *names);

/* fvi_linear_free -- give everything back; the options have been parsed. */
void fvi_linear_free(fvi_linear_request *r);

#endif
