/* src/input/fvi_problem_words.h -- The words of the command line in a file: --problem FILE. */
#ifndef FVI_PROBLEM_WORDS_H
#define FVI_PROBLEM_WORDS_H

#include <fvi/error.h>

/* fvi_problem_words -- put the words of each --problem FILE behind the command in its place: a
 * line "alpha 0.3", or "alpha = 0.3", is --alpha=0.3. Empty lines and those that begin with # are
 * skipped.
 *
 *   argc, argv  in: those of main; out: the same, or a longer list, kept to the end of the process
 *
 * Returns 0; FVI_EINVAL with an error of the field "problem" for a file that cannot be read, has a
 * line that is no word, or names a file again; FVI_ENOMEM. */
int fvi_problem_words(int *argc, char ***argv, fvi_error *error);

/* fvi_word_is_option -- is the word "--name" or "--name=value"?
 * fvi_option_with_value -- is word *i, and then *value what stands behind =, or the next word, which *i counts; NULL
 * if there is none? The words are ended by NULL. */
int fvi_word_is_option(const char *word, const char *name);
int fvi_option_with_value(char *const *words, int *i, const char *name, const char **value);

#endif
