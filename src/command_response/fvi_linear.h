/* src/command_response/fvi_linear.h -- Open the linear motion for `fvi response` and `fvi poles`. */
#ifndef FVI_LINEAR_H
#define FVI_LINEAR_H

#include "command_shared/fvi_subcommand_options.h"

#include <fvi/response.h>

/* The options of such a command, and what they describe. */
typedef struct {
    fvi_subcommand_options words;
    fvi_options o;
    fvi_system system;
    double *along;          /* the motion of the unknowns with the ground; NULL: all move alike */
    fvi_response *response; /* NULL before fvi_linear_open */
    const char *warning;    /* warning for the head, or NULL */
} fvi_linear_request;

/* FVI_LINEAR_OPTIONS -- The options of `fvi run` that describe a linear motion and the form of a table.
 * fvi_linear_presets -- The options that replace the others. */
#define FVI_LINEAR_OPTIONS                                                     \
    "alpha", "order", "rho", "damping", "damper", "mass", "potential", "let",  \
        "dimension", "system", "x0", "format", "o"
extern char *const fvi_linear_presets[];

/* fvi_linear_open -- Make the response of the problem. Warn if the place x0 is no equilibrium. Return 0, or 1 after a
 * message. */
int fvi_linear_open(fvi_linear_request *r);

/* fvi_linear_head -- Print the version, and the options in `names` that have a value, except x0. `names` ends with
 * NULL. If the motion is not linear, also print the place x0 at which it was linearised. */
void fvi_linear_head(FILE *out, const fvi_linear_request *r,
                     const char *const *names);

/* fvi_linear_free -- Free everything. The options must have been parsed. */
void fvi_linear_free(fvi_linear_request *r);

#endif
