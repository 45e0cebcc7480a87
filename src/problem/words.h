/* src/problem/words.h -- Declare what the parsers of potentials, dampings and forces share. */
#ifndef FVI_WORDS_H
#define FVI_WORDS_H

#include <fvi/parse.h>

/* fvi_scan_call -- Return nonzero if the text is "word:p1,p2" with exactly `count` finite numbers, and fill in p. */
int fvi_scan_call(const char *text, const char *word, int count, double *p);

/* fvi_trimmed_copy -- Return a copy without the blanks at its ends. A tab or a newline becomes a blank, so that a name
 * stands in one line. The caller frees it. NULL without memory. */
char *fvi_trimmed_copy(const char *text, size_t length);

/* fvi_scan_index -- Return the number of `length` digits, as in x12 behind the x, counted from 0. Return `most` if they
 * are no number from 1 to `most`. */
size_t fvi_scan_index(const char *digits, size_t length, size_t most);

/* fvi_parse_expression -- Call fvi_expression_parse for an expression in x, or x1, ..., xd, in t or in s. If `variable`
 * is NULL, it contains only parameters. Note which of them the text uses; parameters may be NULL. A misprint is an
 * error of the field with a caret; its index is the byte. Return a code as all parsers do (fvi/parse.h). */
int fvi_parse_expression(const char *field, const char *variable, size_t d,
                         const char *text, fvi_user_parameters *parameters,
                         fvi_expression **e, fvi_error *error);

/* fvi_parse_state_expression -- Do the same for an expression in x1, ..., xd, then v1, ..., vd if velocities is
 * nonzero, then t (fvi_expression_parse_state). */
int fvi_parse_state_expression(const char *field, size_t d, int velocities,
                               const char *text,
                               fvi_user_parameters *parameters,
                               fvi_expression **e, fvi_error *error);

/* fvi_parse_force_of -- Do what fvi_parse_force does, for another field: "ground" is an acceleration. */
int fvi_parse_force_of(const char *field, const char *text, size_t d,
                       fvi_user_parameters *parameters, double last,
                       fvi_typed_force **force, fvi_error *error);

/* fvi_parse_expression_of -- Parse an expression whose variables the finder knows (expression.h). */
int fvi_parse_expression_of(const char *field, const fvi_name_finder *finder,
                            const char *text, fvi_user_parameters *parameters,
                            fvi_expression **e, fvi_error *error);

#endif
