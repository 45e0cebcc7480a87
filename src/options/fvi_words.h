/* src/options/fvi_words.h -- Words of the command line that only the program knows; all others
 * the library understands (fvi/parse.h). */
#ifndef FVI_WORDS_OF_PROGRAM_H
#define FVI_WORDS_OF_PROGRAM_H

#include "input/fvi_refuse.h"
#include <stddef.h>

/* The columns of a table, in the order of fvi_column_names. */
typedef enum {
    FVI_COLUMN_T,
    FVI_COLUMN_X,
    FVI_COLUMN_P,
    FVI_COLUMN_ENERGY,
    FVI_COLUMN_Y,
    FVI_ALL_COLUMNS /* so many there are */
} fvi_column;

extern const char *const fvi_column_names[]; /* ended by NULL */

/* Columns as they are printed, each at most once. */
typedef struct {
    size_t count;
    fvi_column at[FVI_ALL_COLUMNS];
} fvi_columns;

/* The value of an option, "-" or "--" and its name, into *text, which is NULL before: it may
 * be given again if it says the same. */
int fvi_word_once(const char *dashes, const char *name, const char **text,
                  const char *value, fvi_error *c);

/* Columns; count is zero before. */
int fvi_word_columns(const char *text, fvi_columns *columns, fvi_error *c);

#endif
