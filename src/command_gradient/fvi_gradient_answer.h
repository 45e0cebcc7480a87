/* src/command_gradient/fvi_gradient_answer.h -- Hold what `fvi gradient` was asked, and print its answer. */
#ifndef FVI_GRADIENT_ANSWER_H
#define FVI_GRADIENT_ANSWER_H

#include <fvi/fvi.h>
#include "command_shared/fvi_subcommand_options.h"

/* Indices of its own options, as in words.own[OF]. */
enum { OF, BY, FORCES };

/* The options of a gradient, and its results. */
typedef struct {
    fvi_subcommand_options words;
    fvi_options o;
    /* `of` is 0, 1 or 2 for x, p or energy, and i is the coordinate, from 0. For 3 and 4 see fvi_gradient_dampers.h. */
    size_t of, i;
    size_t of_dampers; /* number of forces of all dampers */
    fvi_system system;
    fvi_run run;
    size_t terms; /* number of terms of the law, whose parameters replace rho and alpha; 0 without a law */
    double value; /* value of what is differentiated */
    double *last; /* x and p of the last row */
    fvi_sensitivities to;
    size_t per;                     /* rows of the force in each step */
    double *numbers, *lets, *force; /* all derivatives; those by each --let; those by each number of the force */
    int by_lets;                    /* nonzero if the derivative by some --let is asked for */
    fvi_mechanism_columns columns;  /* how dampers, constraints and forces of velocity depend on each --let */
    double names[FVI_MOST_USER_PARAMETERS];
    int is_tied[FVI_MOST_USER_PARAMETERS]; /* nonzero for a --let that the start would have to follow */
    /* Nonzero if the force or the ground jumps at a node in form D. Then there is no derivative by this --let, or by
     * masses. */
    int is_jumped[FVI_MOST_USER_PARAMETERS], ground_jumps;
    /* Nonzero if there are such rows. has_pairs: nonzero if there are two springpots in series. */
    int has_mass, has_alpha, has_terms, has_orders, has_pairs;
    char unstable[FVI_WARNING_ROOM];    /* warning of the step */
} fvi_gradient_request;

/* Return the number of dampers; the number of terms of all their laws, or of the law of --damping. */
size_t fvi_gradient_dampers(const fvi_gradient_request *r);
size_t fvi_gradient_terms(const fvi_gradient_request *r);

/* Return the length of `numbers`. */
size_t fvi_gradient_numbers(const fvi_gradient_request *r);

/* Return nonzero if a --let that is asked for stands in the force. */
int fvi_gradient_force_has_lets(const fvi_gradient_request *r);

/* Allocate the arrays for all derivatives that a run of this kind has; and those for the derivatives by the force, if
 * they are needed. Each returns an exit code. */
int fvi_gradient_make_room(fvi_gradient_request *r);
int fvi_gradient_make_room_of_forces(fvi_gradient_request *r);

/* Return the Lagrangian of the run, or NULL. */
const fvi_lagrangian *fvi_gradient_lagrangian(const fvi_gradient_request *r);

/* After the run, convert the derivatives by the fields of two springpots in series into those by the parameters that
 * the user has typed. */
void fvi_gradient_name_pairs(fvi_gradient_request *r);

/* Return the time of row k of the force. */
double fvi_gradient_row_time(const fvi_gradient_request *r, size_t k);

/* Print the table, and the table of --forces if it is asked for. Each returns an exit code. */
int fvi_gradient_print_answer(const fvi_own_command *command,
                              const fvi_gradient_request *r);
int fvi_gradient_print_forces(const fvi_own_command *command,
                              const fvi_gradient_request *r);

#endif
