/* src/problem/columns_state.h -- What typed columns are made of. */
#ifndef FVI_COLUMNS_STATE_H
#define FVI_COLUMNS_STATE_H

#include <fvi/columns.h>

typedef enum {
    QUANTITY_TIME,
    QUANTITY_X,
    QUANTITY_P,
    QUANTITY_V,
    QUANTITY_A,
    QUANTITY_APPLIED,
    QUANTITY_ENERGY,
    QUANTITY_WORK,
    QUANTITY_BALANCE,
    QUANTITY_GROUND,
    QUANTITY_FORCE,   /* from here on of a damper */
    QUANTITY_IMPULSE,
    QUANTITY_DAMPER_WORK,
    QUANTITY_MULTIPLIER, /* of constraint i */
    QUANTITY_REACTION,   /* minus that */
    QUANTITY_EVENT_COUNT, /* of event i */
    QUANTITY_EVENT_LAST,
    QUANTITY_CONTACT,
    QUANTITY_COLUMN /* a column with a name, number i */
} fvi_quantity_kind;

/* One number: of coordinate i, or force i of damper j. */
typedef struct {
    fvi_quantity_kind kind;
    size_t j, i;
} fvi_quantity;

/* A column, or what a reduction looks at: an expression of the quantities. */
typedef struct {
    char *name;
    fvi_expression *expression;
    int is_given; /* was the name given, so that expressions may use it? */
} fvi_typed_column;

typedef enum {
    REDUCE_MIN,
    REDUCE_MAX,
    REDUCE_ABSMAX,
    REDUCE_MEAN,
    REDUCE_RMS,
    REDUCE_LAST,
    REDUCE_FIRST,
    REDUCE_PEAK,
    REDUCE_AT
} fvi_reduction_kind;

/* What is known of the steps so far: how many, the value looked for and its time, the integral, and
 * the last two values with their times. */
typedef struct {
    double count, best, time, integral, q[2], t[2];
} fvi_reduction_state;

typedef struct {
    fvi_typed_column of;
    fvi_reduction_kind kind;
    int wants_time;
    fvi_reduction_state state;
} fvi_reduction;

struct fvi_typed_columns {
    const fvi_column_source *source;
    size_t quantities, columns, reductions;
    fvi_quantity *quantity;
    double *value; /* of each quantity, at the row that was read last */
    fvi_typed_column *column;
    fvi_reduction *reduction;
};

/* fvi_column_quantity -- the number of a quantity by its name, -1 if there is none such, -2 without memory. It is new to the
 * columns, perhaps. columns is a fvi_typed_columns *: for fvi_name_finder. */
int fvi_column_quantity(const char *name, size_t length, void *columns);

/* fvi_column_find -- which quantity has this name; is_all: all numbers of its kind. Returns 0 if there is
 * none. fvi_column_width -- how many numbers of its kind there are; of a damper's kind, for this damper. */
int fvi_column_find(const fvi_typed_columns *c, const char *name,
                    size_t length, fvi_quantity *q, int *is_all);
size_t fvi_column_width(const fvi_typed_columns *c, const fvi_quantity *q);

/* fvi_column_unknown -- refuse a word of a list that is no name, with the nearest one. */
int fvi_column_unknown(const fvi_typed_columns *c, const char *word,
                       size_t length, fvi_error *error);

/* fvi_column_item -- "NAME=EXPRESSION", or the expression alone, length letters, as a column. */
int fvi_column_item(const char *field, const char *text, size_t length,
                    fvi_user_parameters *parameters, fvi_typed_columns *c,
                    fvi_typed_column *column, fvi_error *error);

#endif
