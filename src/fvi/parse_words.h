/* src/fvi/parse_words.h -- Parsers of numbers, words, tables and parameters: the parts of which the parsers of
 * parse.h are made.
 *
 *     double mass;
 *     if (fvi_parse_number("mass", "2.5", 0, INFINITY, "()", &mass, &error))
 *         fprintf(stderr, "%s: %s\n", error.field, error.text);
 *
 * Every function with an argument `error` returns FVI_SUCCESS; FVI_EINVAL for a text that it does not understand;
 * FVI_EDOM for a number that is out of its range; FVI_ENOMEM; or FVI_EFAULT if a pointer that must be there is NULL. It
 * describes the error in *error, which may be NULL; the argument `field` becomes the field of the error (error.h).
 * Unless the comment of a function says otherwise, its output is untouched after an error. */
#ifndef FVI_PARSE_WORDS_H
#define FVI_PARSE_WORDS_H

#include "error.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* ---- numbers and words ---- */

/* fvi_parse_number -- Parse a finite decimal number between low and high. 0x10, inf and nan are no such numbers.
 *
 *   brackets  "[]", "(]", "[)" or "()"; a round bracket excludes its end from the range
 *   value     output */
int fvi_parse_number(const char *field, const char *text, double low,
                     double high, const char *brackets, double *value,
                     fvi_error *error);

/* fvi_parse_whole -- Parse a whole number from 1 to `most`, below 2^53. "1e6" is a whole number, too. */
int fvi_parse_whole(const char *field, const char *text, size_t most,
                    size_t *value, fvi_error *error);

/* fvi_parse_numbers -- Parse d numbers, each in the range of fvi_parse_number.
 *
 *   text    "1,2,3"; one number, which then stands for all d numbers; or "@file", the name of a file with these
 *           numbers, separated by commas, spaces or line ends
 *   values  output, d numbers; after an error they hold no result
 *
 * error->index says which number is out of the range, from 0. */
int fvi_parse_numbers(const char *field, const char *text, double low,
                      double high, const char *brackets, size_t d,
                      double *values, fvi_error *error);

/* fvi_parse_list -- Parse a list of any length in the same way: "1,2,3", or all numbers of "@file". The file is read
 * once, so it may be a pipe.
 *
 *   count, values  outputs: how many numbers there are, and the numbers. Free them with free, also after an error
 *
 * Returns FVI_SUCCESS; FVI_EFAULT if a pointer is NULL, with no output; FVI_EINVAL for a text or a file that is no
 * list; FVI_EDOM for a number that is out of the range; FVI_ENOMEM. */
int fvi_parse_list(const char *field, const char *text, double low, double high, const char *brackets,
                   size_t *count, double **values, fvi_error *error);

/* fvi_parse_word -- Find the text among `words`, an array that ends with NULL. Its place, from 0, goes to *which. */
int fvi_parse_word(const char *field, const char *text,
                   const char *const *words, size_t *which, fvi_error *error);

/* fvi_scan_word -- Return which of the words, ended by NULL, the first `length` letters of the text are, from 0.
 * Capitals count as small letters. Return the number of words if they are none of them. Nothing is reported.
 *
 *     const char *const words[] = { "held", "caputo", NULL };
 *     fvi_scan_word("Held:1", 4, words); // 0 */
size_t fvi_scan_word(const char *text, size_t length, const char *const *words);

/* fvi_list_item -- Return the length of the first item of a list with commas. A comma within parentheses, as in
 * max(x1,x2), does not separate items. */
size_t fvi_list_item(const char *text);

/* fvi_nearest_word -- Return the word of `words` (ended by NULL) that is nearest to the first `length` letters of the
 * text, if a typing error leads from the word to the text; else NULL. Up to four letters one letter may be added, left
 * out, changed or swapped with its neighbour; longer texts may have more such errors. A beginning of a word is near to
 * the word, too. */
const char *fvi_nearest_word(const char *text, size_t length,
                             const char *const *words);

/* fvi_word_hint -- Write the hint "; did you mean x?" to `place` and return `place`. x is the word of
 * fvi_nearest_word; the hint is empty if there is none. */
const char *fvi_word_hint(const char *text, size_t length,
                          const char *const *words, char place[64]);

/* fvi_initial_history_words, fvi_history_words -- word lists for fvi_parse_word, ended by NULL: held, caputo, rl for
 * fvi_initial_history (past.h), and auto, direct, exponentials for fvi_history_kind (memory.h). The place of a word is
 * the number of the enumeration. */
extern const char *const fvi_initial_history_words[];
extern const char *const fvi_history_words[];

/* fvi_parse_table -- Read two columns of a file. All rows have the same number of numbers, separated by ';', by ',' or
 * by blanks and tabs. '#' starts a comment.
 *
 *   names   the names of the two columns, or NULL. A line of words above the numbers names the columns, also after '#',
 *           if it has as many words as the first row has numbers. If such a line has both names, it says which columns
 *           they are. A line without '#' that has another number of words is refused. If no line has both names, or if
 *           names is NULL, the first two columns are read
 *   n       output: the number of rows, at least 1
 *   t, v    output: n numbers each in one block; free it with free(*t). t increases
 *
 * The text of an error has the line and the column in the file. */
int fvi_parse_table(const char *field, const char *file,
                    const char *const names[2], size_t *n, double **t,
                    double **v, fvi_error *error);

/* fvi_parse_named_table -- Read two columns of a file as fvi_parse_table, but refuse a file in which no line above the
 * numbers has both names. */
int fvi_parse_named_table(const char *field, const char *file,
                          const char *const names[2], size_t *n, double **t,
                          double **v, fvi_error *error);

/* fvi_parse_table_columns -- Read `count` columns of a file, at most FVI_COLUMNS_MOST. The first column need not
 * increase.
 *
 *   names    one text for each column: one name, or several names as "omega|w|frequency"
 *   must_be_named  FVI_NAMES_NEEDED, 1: a file in which no line names all columns is refused. FVI_NAMES_OPTIONAL, 0:
 *            the first `count` columns of such a file are read. FVI_FIRST_NAME_CHECKED: they are read, but a line of
 *            words above the numbers, of as many words as there are columns, must name the first column; for a column
 *            whose unit depends on its name
 *   n        output: the number of rows
 *   columns  output: count columns of n numbers each, column after column in one block; free it with free(*columns)
 *   which    output, count numbers: which of its names each column has in the file, from 0; 0 if the file has no names
 *   */
enum { FVI_COLUMNS_MOST = 9 };
enum { FVI_NAMES_OPTIONAL, FVI_NAMES_NEEDED, FVI_FIRST_NAME_CHECKED };
int fvi_parse_table_columns(const char *field, const char *file, size_t count,
                      const char *const *names, int must_be_named, size_t *n,
                      double **columns, size_t *which, fvi_error *error);

/* ---- parameters of expressions ---- */

/* fvi_user_parameters -- names and values that expressions may use. Start with a zeroed struct. Do not copy a struct in
 * use, because `name` points into `names`. The caller may change a value while no run is in progress.
 *
 *   count      number of parameters
 *   name, value  the name and the value of each parameter
 *   used       for each parameter, the kinds of expressions that use it, a sum of bits: FVI_USED_BY_POTENTIAL (a
 *              potential or a Lagrangian), _FORCE, _PARAMETER (the value of another parameter), _DAMPING, _COLUMN,
 *              _MECHANISM (an elongation, a constraint, an imposed coordinate, or a force of velocity), and _CONSTRAINT
 *              (a constraint or an imposed coordinate)
 *   names      the characters of all names
 *   terms      number of terms of laws that were parsed with these parameters
 *   exchanged  one bit for each of these terms: its two parts are exchanged (fvi_pair_is_exchanged, parse.h) */
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

/* fvi_user_parameters_set -- Add a name with a finite value. To add a name again with the same value is allowed.
 *
 * FVI_EINVAL for a name that has another value already, for a text that is not a name, and for more than
 * FVI_MOST_USER_PARAMETERS names; FVI_EDOM for a value that is not finite. */
int fvi_user_parameters_set(fvi_user_parameters *parameters, const char *name,
                            double value, fvi_error *error);

/* fvi_parse_user_parameters -- Parse a list such as "k=3,c=2*k", and add its parameters. A value may be an expression
 * of the names before it. */
int fvi_parse_user_parameters(const char *text,
                              fvi_user_parameters *parameters,
                              fvi_error *error);

/* fvi_user_parameters_are_used -- Return FVI_EINVAL if a parameter is in no expression, else FVI_SUCCESS. */
int fvi_user_parameters_are_used(const fvi_user_parameters *parameters,
                                 fvi_error *error);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
