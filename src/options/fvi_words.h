/* src/options/fvi_words.h -- From the words of a command line to values. Each function
 * returns 0, or 2 after it has written a complaint that names the option. */
#ifndef FVI_WORDS_H
#define FVI_WORDS_H

#include "input/fvi_refuse.h"
#include <fvi/exact_solution.h>
#include <stddef.h>

/* The potentials, in the order of their words in fvi_word_potential. */
typedef enum {
    FVI_POTENTIAL_HARMONIC,
    FVI_POTENTIAL_DUFFING,
    FVI_POTENTIAL_PENDULUM,
    FVI_POTENTIAL_FREE,
    FVI_POTENTIAL_CHAIN,
    FVI_POTENTIAL_EXPRESSION,
    FVI_POTENTIAL_SHARED
} fvi_potential_kind;

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
                  const char *value, fvi_complaint c);

/* A finite decimal number between low and high, as in a table: not 0x10, inf or nan. brackets is "[]", "(]", "[)" or "()":
 * a round one keeps its end out of the range. */
int fvi_word_number(const char *name, const char *text, double low, double high,
                    const char *brackets, double *value, fvi_complaint c);

/* A whole number from 1 to `most`, below 2^53; "1e6" is one too. */
int fvi_word_whole(const char *name, const char *text, size_t most,
                   size_t *value, fvi_complaint c);

/* Which of the words, ended by NULL. */
int fvi_word_choice(const char *name, const char *text,
                    const char *const *words, size_t *which, fvi_complaint c);

/* d numbers "1,2,3", or one that stands for all of them; or "@file" with these numbers,
 * parted by commas, spaces or lines. Between low and high, see fvi_word_number. */
int fvi_word_list(const char *name, const char *text, double low, double high,
                  const char *brackets, size_t d, double *values,
                  fvi_complaint c);

/* "word:p1,p2": nonzero if text is that word with exactly count numbers. */
int fvi_word_call(const char *text, const char *word, int count, double *p);

/* A potential: its kind, its parameters; its dimension if it is a chain. What has none of
 * these words before a colon, or at all, is FVI_POTENTIAL_EXPRESSION. */
int fvi_word_potential(const char *text, fvi_potential_kind *kind, size_t *d,
                       double spring[2], fvi_complaint c);

/* The word for a potential that was perhaps meant, as fvi_word_nearest. */
const char *fvi_word_near_potential(const char *text);

/* A force: nonzero if it is none, step:A,T or cosine:A,W, and which. */
int fvi_word_force(const char *text, fvi_forcing *kind, double forcing[2]);

/* Columns; count is zero before. */
int fvi_word_columns(const char *text, fvi_columns *columns, fvi_complaint c);

#endif
