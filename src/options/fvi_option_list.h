/* src/options/fvi_option_list.h -- What the command line of build/fvi can say. */
#ifndef FVI_OPTION_LIST_H
#define FVI_OPTION_LIST_H

#include <fvi/expression.h>
#include <fvi/trajectory.h>
#include <fvi/directory.h>
#include <fvi/parse.h>
#include "fvi_words.h"

typedef enum {
    FVI_COMMAND_RUN,
    FVI_COMMAND_COEFFICIENTS,
    FVI_COMMAND_EXACT,
    FVI_COMMAND_METHODS,
    FVI_COMMAND_HELP,
    FVI_COMMAND_VERSION,
    FVI_COMMAND_SWEEP, /* from here on with words of its own */
    FVI_COMMAND_FIT,
    FVI_COMMAND_GRADIENT,
    FVI_COMMAND_RESPONSE,
    FVI_COMMAND_POLES
} fvi_command;

/* How a table is printed.
 * tsv: lines "# name = value", a line "# " with the names, rows parted by tabs.
 * csv: the names, rows parted by commas, no head.
 * json: { "parameters": {...}, "columns": [...], "rows": [[...], ...] }. */
typedef enum { FVI_FORMAT_TSV, FVI_FORMAT_CSV, FVI_FORMAT_JSON } fvi_format;

extern const char *const fvi_format_names[]; /* in this order, ended by NULL */

/* The values of an option that may be given several times, and all of them in one text. */
enum { FVI_LISTS = 5, FVI_OF_MECHANISM = 4, FVI_MOST_LISTED = 64 };
typedef struct {
    size_t count;
    const char *value[FVI_MOST_LISTED];
    char text[4096];
} fvi_option_values;

/* The words of the command line, understood and in range. */
typedef struct {
    fvi_command command;
    fvi_command about; /* of what help speaks; HELP itself for the whole */
    const fvi_method *method;
    double alpha, kappa, h, tolerance;
    double time;  /* of --time; 0: not given */
    double error; /* 0: the step is h; else it is to be found */
    double step_error; /* of fvi-adaptive; 0: its own */
    double longest; /* step; 0: no limit */
    size_t steps, every, count, d;
    size_t most_steps; /* of a method that chooses its own; 0: see fvi_run */
    fvi_typed_potential potential;
    fvi_user_parameters lets; /* those of the expressions */
    void *library;            /* where a potential of the user's stands, or NULL, */
    fvi_potential user;       /* and it */
    fvi_typed_force *force;   /* NULL: that of the directory */
    fvi_directory *directory;   /* of matrices instead of the lists, or NULL */
    size_t *shown, shown_count; /* which of x, p, y are columns, from 0 */
    fvi_typed_mechanism *mechanism; /* or NULL */
    fvi_option_values list[FVI_LISTS]; /* --damper, --constraint, --impose, --force-on; --event */
    fvi_typed_events *events; /* or NULL */
    int method_is_preset;
    int potential_has_time; /* then it becomes a part of a Lagrangian */
    fvi_typed_damping damping; /* instead of alpha, and then law.count > 0 */
    fvi_initial_history past;
    const char *no_solution; /* what fvi_warning_of_initial_history says, or NULL */
    fvi_history_kind memory;
    fvi_columns columns;
    fvi_ground *ground; /* or NULL */
    fvi_typed_columns *typed; /* those that are no plain t, x, p, energy, y; and reductions */
    fvi_column_source *column_source;
    double *typed_row; /* room for a row of them */
    int numbered; /* 1: the columns are x1, ..., not x */
    fvi_format format;
    double *x0, *p0, *mass, *rho; /* d numbers each, one block */
    const char *plot;             /* as output; NULL: none */
    const char *snapshot;         /* as output; NULL: none */
    const char *checkpoint;       /* as output; NULL: none */
    int resume;                   /* go on from there */
    const char *output;   /* points into argv, or NULL for standard output */
    const char *text[64]; /* each as it was given or by default, by index */
    char let_text[1024];     /* all --let, with commas between */
    char damping_text[4096]; /* all --damping, with " + " between */
    char step[32];  /* the text of a step that follows from --time */
    char count_text[32]; /* and of the number of steps that follows from both */
    int steps_follow;    /* does it? */
} fvi_options;

typedef enum {
    METHOD,
    ALPHA,
    ORDER, /* instead of it: 2 alpha */
    RHO,
    DAMPING,
    MASS,
    POTENTIAL,
    LAGRANGIAN, /* instead of it and of the masses */
    DAMPER,     /* this and the next four: fvi_mechanism_options.h */
    CONSTRAINT,
    IMPOSE,
    FORCE_ON,
    EVENT,
    LET,
    DIMENSION,
    SYSTEM,
    FORCE,
    GROUND,
    ALONG,
    DERIVATIVE,
    KAPPA,
    X0,
    P0,
    V0, /* instead of it */
    H,
    STEPS,
    TIME,
    ERROR,
    STEP_ERROR,
    LONGEST,
    COLUMNS,
    REDUCE,
    UNKNOWNS,
    EVERY,
    MEMORY,
    TOLERANCE,
    COUNT,
    FORMAT, /* from here on what does not change a number: not in the head */
    MOST_STEPS,
    PLOT,
    SNAPSHOT,
    CHECKPOINT,
    CONTINUE, /* has no value */
    OUTPUT,   /* the last, as it is -o */
    OPTIONS
} option_index;

/* An option: its name without hyphens, its value where it is not given, or NULL. */
typedef struct {
    const char *name;
    int commands; /* which of them know it, see fvi_option_is_known */
    const char *preset;
} fvi_option;

extern const fvi_option fvi_option_list[OPTIONS];

/* fvi_option_is_known -- is i an option of this command? With OPTIONS for i: has it
 * any? */
int fvi_option_is_known(fvi_command command, option_index i);

/* fvi_option_named -- that of a word "--name" or "--name=value", the name in full; OPTIONS
 * if there is none. -o is not so named. */
option_index fvi_option_named(const char *word);

/* fvi_value_is_missing -- refuse the option `given`, as it was typed, whose value was to be the next word: there is no
 * next word (NULL), or it is -o, or begins with -- and a letter, as every long option does. A value that is spelt so goes
 * behind =, and a file under ./ instead. Returns 0 if there is a value. */
int fvi_value_is_missing(const char *given, const char *next, fvi_error *c);

/* fvi_options_describe -- "name = value" of option number i of a command, in the
 * order of the manual. Returns 0 when there is no option i. */
int fvi_options_describe(const fvi_options *o, size_t i, const char **name,
                         const char **value);

#endif
