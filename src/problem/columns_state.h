/* src/problem/columns_state.h -- Hold the columns of a table, their quantities and the reductions. */
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
    QUANTITY_FORCE,   /* this one and the next two belong to a damper */
    QUANTITY_IMPULSE,
    QUANTITY_DAMPER_WORK,
    QUANTITY_MULTIPLIER, /* of constraint i */
    QUANTITY_REACTION,   /* minus the multiplier of the constraint */
    QUANTITY_EVENT_COUNT, /* this one and the next two belong to event i */
    QUANTITY_EVENT_LAST,
    QUANTITY_CONTACT,
    QUANTITY_COLUMN /* column i, which has a name of its own */
} fvi_quantity_kind;

/* One number of a kind: that of coordinate, constraint, event or column i, or of force i of damper j. All indices count
 * from 0. */
typedef struct {
    fvi_quantity_kind kind;
    size_t j, i;
} fvi_quantity;

/* A column, or the argument of a reduction: an expression of the quantities. */
typedef struct {
    char *name;
    fvi_expression *expression;
    int is_given; /* nonzero if the user gave the name, so that expressions may use it */
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

/* The state of a reduction after the steps so far: their number, the value that it looks for and its time, the
 * integral, and the last two values with their times. */
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
    const fvi_column_source *source; /* what the columns are about; owned by the caller */
    size_t quantities, columns, reductions; /* how many there are of the next arrays */
    fvi_quantity *quantity;      /* those that an expression contains, each once */
    double *value;               /* value of each quantity, at the row that was read last */
    fvi_typed_column *column;    /* in the order of the table */
    fvi_reduction *reduction;
};

/* fvi_find_or_add_quantity -- Return the number of the quantity with this name. If it is new, it is added to the
 * columns. Return -1 if there is no such quantity, -2 without memory. `columns` is a fvi_typed_columns *. The function
 * is for fvi_name_finder. */
int fvi_find_or_add_quantity(const char *name, size_t length, void *columns);

/* fvi_find_quantity -- Find the quantity with this name. *is_all becomes nonzero if the name means all numbers of its
 * kind. Return 0 if there is none, else 1.
 * fvi_quantity_width -- Return how many numbers there are of its kind; for a damper, how many this damper has. */
int fvi_find_quantity(const fvi_typed_columns *c, const char *name,
                      size_t length, fvi_quantity *q, int *is_all);
size_t fvi_quantity_width(const fvi_typed_columns *c, const fvi_quantity *q);

/* fvi_refuse_unknown_column -- Refuse a word of a list that is no name. The message proposes the nearest name. Return
 * FVI_EINVAL. */
int fvi_refuse_unknown_column(const fvi_typed_columns *c, const char *word,
                              size_t length, fvi_error *error);

/* fvi_parse_column_item -- Parse "NAME=EXPRESSION", or an expression alone, of `length` letters, as a column. The
 * caller owns the column's name and expression. Return FVI_SUCCESS, or an error code with the error filled in. */
int fvi_parse_column_item(const char *field, const char *text, size_t length,
                          fvi_user_parameters *parameters, fvi_typed_columns *c,
                          fvi_typed_column *column, fvi_error *error);

#endif
