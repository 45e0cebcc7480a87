/* src/options/fvi_words.h -- Words of the command line that only the program knows; all others
 * the library understands (fvi/parse.h). */
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
    FVI_COLUMN_TYPED, /* an expression, or a name beside these */
    FVI_ALL_COLUMNS   /* so many there are */
} fvi_column;

extern const char *const fvi_column_names[]; /* ended by NULL */

/* Columns as they are printed. Each of the first five stands at most once; of what is typed, item
 * n has so many columns, from the first on, of those that are typed. */
enum { FVI_MOST_ITEMS = 64 };
typedef struct {
    size_t count;
    fvi_column at[FVI_MOST_ITEMS];
    size_t first[FVI_MOST_ITEMS], width[FVI_MOST_ITEMS];
} fvi_columns;

/* fvi_is_one_of -- is the word one of these, which NULL ends? */
int fvi_is_one_of(const char *word, const char *const *words);

/* The value of an option, "-" or "--" and its name, into *text, which is NULL before: it may
 * be given again if it says the same. */
int fvi_word_once(const char *dashes, const char *name, const char **text,
                  const char *value, fvi_error *c);

/* Columns; count is zero before, and `typed` has none. What is typed may use the parameters. */
int fvi_word_columns(const char *text, fvi_user_parameters *parameters,
                     fvi_columns *columns, fvi_typed_columns *typed,
                     fvi_error *c);

#endif
