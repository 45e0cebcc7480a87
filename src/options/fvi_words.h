/* src/options/fvi_words.h -- Read the words of the command line that only the program knows. The library reads all
 * other words (fvi/parse.h). */
#ifndef FVI_WORDS_OF_PROGRAM_H
#define FVI_WORDS_OF_PROGRAM_H

#include "input/fvi_refuse.h"
#include <fvi/columns.h>
#include <stddef.h>

/* The columns of a table, in the order of fvi_column_names. */
typedef enum {
    FVI_COLUMN_T,
    FVI_COLUMN_X,
    FVI_COLUMN_P,
    FVI_COLUMN_ENERGY,
    FVI_COLUMN_Y,
    FVI_COLUMN_TYPED, /* an expression, or a name other than these five */
    FVI_ALL_COLUMNS   /* number of kinds */
} fvi_column;

extern const char *const fvi_column_names[]; /* ended by NULL */

/* The columns in the order in which they are printed. Each plain column appears at most once. Item n, if it is typed,
 * stands for width[n] of the typed columns, from first[n] on. */
enum { FVI_MOST_ITEMS = 64 };
typedef struct {
    size_t count;
    fvi_column at[FVI_MOST_ITEMS];
    size_t first[FVI_MOST_ITEMS], width[FVI_MOST_ITEMS];
} fvi_columns;

/* fvi_is_one_of -- Return nonzero if the word is in the list, which ends with NULL. */
int fvi_is_one_of(const char *word, const char *const *words);

/* fvi_word_once -- Store the value of an option in *text, which is NULL before. `dashes` and `name` are for the
 * complaint. The option may be given again if its value is the same. Return 0, or a code of fvi/error.h with the error
 * filled in. */
int fvi_word_once(const char *dashes, const char *name, const char **text,
                  const char *value, fvi_error *c);

/* fvi_word_columns -- Read a list of columns. columns->count is 0 before, and `typed` has no columns. Expressions may
 * use the parameters. Return as fvi_word_once. */
int fvi_word_columns(const char *text, fvi_user_parameters *parameters,
                     fvi_columns *columns, fvi_typed_columns *typed,
                     fvi_error *c);

#endif
