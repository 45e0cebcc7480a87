/* src/fvi/parse_words.h -- Numbers, words, tables and parameters as they are typed.
 *
 * What all parsers of parse.h are made of; what they return stands there. */
#ifndef FVI_PARSE_WORDS_H
#define FVI_PARSE_WORDS_H

#include "error.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* ---- numbers and words ---- */

/* fvi_parse_number -- a finite decimal number between low and high, as in a table: not 0x10, inf
 * or nan. brackets is "[]", "(]", "[)" or "()": a round one keeps its end out of the range. */
int fvi_parse_number(const char *field, const char *text, double low,
                     double high, const char *brackets, double *value,
                     fvi_error *error);

/* fvi_parse_whole -- a whole number from 1 to `most`, below 2^53; "1e6" is one too. */
int fvi_parse_whole(const char *field, const char *text, size_t most,
                    size_t *value, fvi_error *error);

/* fvi_parse_numbers -- d numbers "1,2,3", or one that stands for all of them; or "@file" with
 * these numbers, separated by commas, spaces or lines. The range as of fvi_parse_number; the
 * error's index says which number is out of it. After an error the values are of no use. */
int fvi_parse_numbers(const char *field, const char *text, double low,
                      double high, const char *brackets, size_t d,
                      double *values, fvi_error *error);

/* fvi_parse_word -- which of the words, ended by NULL. */
int fvi_parse_word(const char *field, const char *text,
                   const char *const *words, size_t *which, fvi_error *error);

/* fvi_list_item -- how long the first item of a list is: commas within parentheses part nothing, as
 * those of max(x1,x2). */
size_t fvi_list_item(const char *text);

/* fvi_nearest_word -- the word, of those ended by NULL, that is nearest to the first `length`
 * letters of text, if a slip of the finger leads from the one to the other; else NULL. */
const char *fvi_nearest_word(const char *text, size_t length,
                             const char *const *words);

/* fvi_word_hint -- "; did you mean x?", written to place, for a text that is none of the words;
 * empty if none is near. Returns place. */
const char *fvi_word_hint(const char *text, size_t length,
                          const char *const *words, char place[64]);

/* The words of fvi_initial_history, held, caputo and rl, and of fvi_history_kind, auto, direct and
 * exponentials, each in the order of its numbers and ended by NULL: for fvi_parse_word. */
extern const char *const fvi_initial_history_words[];
extern const char *const fvi_history_words[];

/* fvi_parse_table -- two columns of a file of rows, all of as many numbers, separated by ';',
 * by ',' or by blanks and tabs; '#' begins a comment.
 *
 *   names   of the columns. A line of words above the numbers in which both stand says which these
 *           are, also behind #, if it has as many words as the first row has numbers; one without #
 *           that has not is refused. If there is none, or NULL stands for names, the first two
 *   n       output: rows, at least one
 *   t, v    output: n numbers each, one block, free(*t). t increases
 *
 * A fault in the file is said with its line and column. */
int fvi_parse_table(const char *field, const char *file,
                    const char *const names[2], size_t *n, double **t,
                    double **v, fvi_error *error);

/* fvi_parse_named_table -- the same, refused if no line above the numbers has both names. */
int fvi_parse_named_table(const char *field, const char *file,
                          const char *const names[2], size_t *n, double **t,
                          double **v, fvi_error *error);

/* fvi_parse_table_columns -- the same of `count` columns, at most FVI_COLUMNS_MOST, in any order of the
 * rows.
 *
 *   names    of each column one or several, "omega|w|frequency"
 *   must_be_named  nonzero: a file in which no line names them all is refused; else the first
 *            `count` stand for them
 *   columns  output: count columns of n numbers each, one block, free(*columns)
 *   which    output: which of its names each column had, from 0; 0 where none stood there */
enum { FVI_COLUMNS_MOST = 9 };
int fvi_parse_table_columns(const char *field, const char *file, size_t count,
                      const char *const *names, int must_be_named, size_t *n,
                      double **columns, size_t *which, fvi_error *error);

/* ---- parameters of expressions ---- */

/* fvi_user_parameters -- names and values that expressions may use; begin with a zeroed one. Do
 * not copy one that is in use: name points into names. A value may be changed while no run goes on.
 *
 *   used  for each, who speaks of it: FVI_USED_BY_POTENTIAL, FVI_USED_BY_FORCE,
 *         FVI_USED_BY_PARAMETER, FVI_USED_BY_DAMPING, FVI_USED_BY_COLUMN, added; of a
 *         Lagrangian _POTENTIAL, and _MECHANISM of an elongation, a constraint, an imposed
 *         coordinate and a force of velocity; of a constraint and an imposed coordinate _CONSTRAINT, too
 *   terms      how many terms of laws were read, and
 *   exchanged  of which of them, a bit each, the parts are exchanged, see fvi_pair_is_exchanged */
enum {
    FVI_MOST_EXCHANGED = 4096,
    FVI_MOST_USER_PARAMETERS = 64,
    FVI_USED_BY_POTENTIAL = 1,
    FVI_USED_BY_FORCE = 2,
    FVI_USED_BY_PARAMETER = 4,
    FVI_USED_BY_DAMPING = 8,
    FVI_USED_BY_COLUMN = 16,
    FVI_USED_BY_MECHANISM = 32,
    FVI_USED_BY_CONSTRAINT = 64
};
typedef struct {
    size_t count;
    const char *name[FVI_MOST_USER_PARAMETERS];
    double value[FVI_MOST_USER_PARAMETERS];
    unsigned char used[FVI_MOST_USER_PARAMETERS];
    char names[1024];
    size_t terms;
    unsigned char exchanged[FVI_MOST_EXCHANGED / 8];
} fvi_user_parameters;

/* fvi_user_parameters_set -- one more name with a finite value; again with the same value is
 * allowed. Refused: a name that is taken, is no name, or is one too many. */
int fvi_user_parameters_set(fvi_user_parameters *parameters, const char *name,
                            double value, fvi_error *error);

/* fvi_parse_user_parameters -- "k=3,c=2*k": a value may be an expression of the names before
 * it. */
int fvi_parse_user_parameters(const char *text,
                              fvi_user_parameters *parameters,
                              fvi_error *error);

/* fvi_user_parameters_are_used -- refuse one that no expression speaks of. */
int fvi_user_parameters_are_used(const fvi_user_parameters *parameters,
                                 fvi_error *error);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
