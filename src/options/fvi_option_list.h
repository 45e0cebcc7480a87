/* src/options/fvi_option_list.h -- List the options of the command line of build/fvi. */
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
    FVI_COMMAND_SWEEP, /* from here on the commands have options of their own */
    FVI_COMMAND_FIT,
    FVI_COMMAND_GRADIENT,
    FVI_COMMAND_RESPONSE,
    FVI_COMMAND_POLES
} fvi_command;

/* The formats of a table.
 * tsv: lines "# name = value", a line "# " with the names, rows with tabs between the numbers.
 * csv: a line with the names, rows with commas between the numbers, no head.
 * json: { "parameters": {...}, "columns": [...], "rows": [[...], ...] }. */
typedef enum { FVI_FORMAT_TSV, FVI_FORMAT_CSV, FVI_FORMAT_JSON } fvi_format;

extern const char *const fvi_format_names[]; /* in this order, ended by NULL */

/* The values of an option that may be given several times, and all values in one text. There are FVI_LISTS such
 * options, of which the first FVI_OF_MECHANISM describe a mechanism. Each has at most FVI_MOST_LISTED values. */
enum { FVI_LISTS = 7, FVI_OF_MECHANISM = 4, FVI_MOST_LISTED = 64 };
typedef struct {
    size_t count;
    const char *value[FVI_MOST_LISTED];
    char text[4096];
} fvi_option_values;

/* The options of the command line, interpreted and in range. */
typedef struct {
    fvi_command command;
    fvi_command about; /* the command that help describes; FVI_COMMAND_HELP for the whole program */
    const fvi_method *method;
    double alpha, kappa, h, tolerance;
    double time;  /* of --time; 0: not given */
    double error; /* of --error; 0: the step is h; otherwise the step is found from it */
    double step_error; /* of fvi-adaptive; 0: its preset */
    double longest; /* longest step; 0: no limit */
    size_t steps, every, count, d;
    size_t most_steps; /* for a method that chooses its steps; 0: see fvi_run */
    fvi_typed_potential potential;
    fvi_user_parameters lets; /* the parameters of the expressions */
    void *library;            /* the library with the user's potential, or NULL */
    fvi_potential user;       /* the user's potential */
    fvi_typed_force *force;   /* NULL: the force of the directory */
    fvi_directory *directory;   /* matrices instead of the lists below, or NULL */
    size_t *shown, shown_count; /* the coordinates whose x, p, y are columns, counted from 0 */
    fvi_typed_mechanism *mechanism; /* NULL if there is no mechanism */
    fvi_option_values list[FVI_LISTS]; /* --damper, --constraint, --impose, --force-on; --event; --let; --damping */
    fvi_typed_events *events; /* NULL if there are none */
    int method_is_preset;
    int potential_has_time; /* then the potential becomes a part of a Lagrangian */
    fvi_typed_damping damping; /* instead of alpha; then law.count > 0 */
    fvi_initial_history past;
    const char *no_solution; /* text of fvi_warning_of_initial_history, or NULL */
    fvi_history_kind memory;
    fvi_columns columns;
    fvi_ground *ground; /* NULL if the ground does not move */
    fvi_typed_columns *typed; /* the columns other than plain t, x, p, energy, y, and the reductions */
    fvi_column_source *column_source;
    double *typed_row; /* room for a row of the typed columns */
    int numbered; /* 1: the columns are named x1, ..., not x */
    fvi_format format;
    double *x0, *p0, *mass, *rho; /* d numbers each, in one block */
    const char *plot;             /* name of the picture's file; NULL: none */
    const char *snapshot;         /* name of the snapshot's file; NULL: none */
    const char *checkpoint;       /* name of the checkpoint's file; NULL: none */
    int resume;                   /* nonzero: go on from the checkpoint */
    const char *output;   /* points into argv, or NULL for standard output */
    const char *text[64]; /* value of each option, given or by default, by index */
    char step[32];  /* text of the step that follows from --time */
    char count_text[32]; /* text of the number of steps that follows from --h and --time */
    int steps_follow;    /* nonzero if the number of steps follows from them */
} fvi_options;

typedef enum {
    METHOD,
    ALPHA,
    ORDER, /* instead of ALPHA: 2 alpha */
    RHO,
    DAMPING,
    MASS,
    POTENTIAL,
    LAGRANGIAN, /* instead of POTENTIAL and MASS */
    DAMPER,     /* this option and the next four: see fvi_mechanism_options.h */
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
    V0, /* instead of P0 */
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
    FORMAT, /* from here on options that change no number; they are not in the head */
    MOST_STEPS,
    PLOT,
    SNAPSHOT,
    CHECKPOINT,
    CONTINUE, /* has no value */
    OUTPUT,   /* the last one, because it is -o */
    OPTIONS
} option_index;

/* An option: its name without hyphens, and its value if it is not given, or NULL. */
typedef struct {
    const char *name;
    int commands; /* bits for the commands that know it, see fvi_option_is_known */
    const char *preset;
} fvi_option;

extern const fvi_option fvi_option_list[OPTIONS];

/* fvi_option_is_known -- Return nonzero if i is an option of this command. With i = OPTIONS, return nonzero if the
 * command has any options. */
int fvi_option_is_known(fvi_command command, option_index i);

/* fvi_option_named -- Return the option of a word "--name" or "--name=value", with the name in full. OPTIONS if there
 * is none; also for -o. */
option_index fvi_option_named(const char *word);

/* fvi_value_is_missing -- Refuse the option `given`, as it was typed, if the next word is not its value: there is no
 * next word (NULL), or it is -o, or it begins with -- and a letter, as every long option does. A value that is spelt
 * like an option must follow =, and a file of such a name can be given as ./NAME. Return 0 if there is a value. */
int fvi_value_is_missing(const char *given, const char *next, fvi_error *c);

/* fvi_option_number -- Read the number of option i; see fvi_parse_number.
 * fvi_option_whole -- Read its whole number. It is at most half of SIZE_MAX, because numbers of rows are added and
 * doubled. */
int fvi_option_number(const fvi_options *o, option_index i, double low, double high, const char *brackets,
                      double *value, fvi_error *c);
int fvi_option_whole(const fvi_options *o, option_index i, size_t *value, fvi_error *c);

/* fvi_options_describe -- Find the name and the value of option number i of a command, in the order of the manual.
 * Return 0 if there is no option i. */
int fvi_options_describe(const fvi_options *o, size_t i, const char **name,
                         const char **value);

#endif
