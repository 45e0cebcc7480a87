/* src/command_gradient/fvi_gradient_answer.h -- What `fvi gradient` was asked, and what it prints. */
#ifndef FVI_GRADIENT_ANSWER_H
#define FVI_GRADIENT_ANSWER_H

#include <fvi/fvi.h>
#include "command_shared/fvi_subcommand_options.h"

/* Its own options, words.own[OF] and so on. */
enum { OF, BY, FORCES };

/* What the words say, and what comes out. */
typedef struct {
    fvi_subcommand_options words;
    fvi_options o;
    size_t of, i; /* 0, 1, 2: x, p, energy; the coordinate, from 0; 3, 4: see fvi_gradient_dampers.h */
    size_t of_dampers; /* how many forces all dampers have */
    fvi_system system;
    fvi_run run;
    size_t terms; /* of the law, whose numbers take the place of rho and alpha; 0 without one */
    double value; /* of what is differentiated */
    double *last; /* x and p of the last row */
    fvi_sensitivities to;
    size_t per;                     /* rows of the force in a step */
    double *numbers, *lets, *force; /* by each --let, by each F */
    int by_lets;                    /* some --let is asked for */
    fvi_mechanism_columns columns;  /* how dampers, constraints and forces of velocity speak of each */
    double names[FVI_MOST_USER_PARAMETERS];
    int is_tied[FVI_MOST_USER_PARAMETERS]; /* the start would have to follow it */
    int is_jumped[FVI_MOST_USER_PARAMETERS], ground_jumps; /* at a node, in form D: no derivative by it, or by masses */
    int has_mass, has_alpha, has_terms, has_orders, has_pairs; /* which rows there are; has_pairs: of two
                                                      * springpots in series */
    char unstable[FVI_WARNING_ROOM];    /* what is said of the step */
} fvi_gradient_request;

/* How many dampers; how many terms their laws have, or that of --damping. */
size_t fvi_gradient_dampers(const fvi_gradient_request *r);
size_t fvi_gradient_terms(const fvi_gradient_request *r);

/* How many numbers stand in `numbers`. */
size_t fvi_gradient_numbers(const fvi_gradient_request *r);

/* Is a --let asked for that stands in the force? */
int fvi_gradient_force_has_lets(const fvi_gradient_request *r);

/* Room for all numbers that a run of this kind has; and for those of the forces, where they are asked
 * for. Each returns the exit code. */
int fvi_gradient_make_room(fvi_gradient_request *r);
int fvi_gradient_make_room_of_forces(fvi_gradient_request *r);

/* The Lagrangian of the run, or NULL. */
const fvi_lagrangian *fvi_gradient_lagrangian(const fvi_gradient_request *r);

/* The numbers of two springpots in series, after the derivatives, become those of the words. */
void fvi_gradient_name_pairs(fvi_gradient_request *r);

/* The time of row k of the forces. */
double fvi_gradient_row_time(const fvi_gradient_request *r, size_t k);

/* The table; and that of --forces, if it is asked for. Each returns the exit code. */
int fvi_gradient_print_answer(const fvi_own_command *command,
                              const fvi_gradient_request *r);
int fvi_gradient_print_forces(const fvi_own_command *command,
                              const fvi_gradient_request *r);

#endif
