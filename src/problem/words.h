/* src/problem/words.h -- What the parsers of potentials, dampings and forces share. */
#ifndef FVI_WORDS_H
#define FVI_WORDS_H

#include <fvi/parse.h>

/* "word:p1,p2": nonzero if text is that word with exactly count finite numbers. */
int fvi_scan_call(const char *text, const char *word, int count, double *p);

/* Which of the words, ended by NULL, are the first `length` letters of the text? Their number if
 * they are none. */
size_t fvi_scan_word(const char *text, size_t length, const char *const *words);

/* fvi_trimmed_copy -- a copy without the blanks at its ends; a tab or a new line becomes one blank, so that a name
 * stands in one line. Free it; NULL without memory. */
char *fvi_trimmed_copy(const char *text, size_t length);

/* fvi_parse_expression -- fvi_expression_parse of x, or x1, ..., xd, of t or of s, or, where variable is
 * NULL, of the parameters alone. It is noted which of them the text uses. A misprint is an error of
 * the field, with a caret; its index is the byte. parameters may be NULL. */
int fvi_parse_expression(const char *field, const char *variable, size_t d,
                         const char *text, fvi_user_parameters *parameters,
                         fvi_expression **e, fvi_error *error);

/* fvi_parse_state_expression -- the same of x1, ..., xd, then v1, ..., vd where velocities is not 0, then
 * t (fvi_expression_parse_state). */
int fvi_parse_state_expression(const char *field, size_t d, int velocities,
                               const char *text,
                               fvi_user_parameters *parameters,
                               fvi_expression **e, fvi_error *error);

/* fvi_parse_force_of -- fvi_parse_force as another field: "ground" is an acceleration. */
int fvi_parse_force_of(const char *field, const char *text, size_t d,
                       fvi_user_parameters *parameters, double last,
                       fvi_typed_force **force, fvi_error *error);

/* fvi_parse_expression_of -- the same with coordinates that the finder names (expression.h). */
int fvi_parse_expression_of(const char *field, const fvi_name_finder *finder,
                            const char *text, fvi_user_parameters *parameters,
                            fvi_expression **e, fvi_error *error);

#endif
