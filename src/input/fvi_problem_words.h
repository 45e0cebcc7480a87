/* src/input/fvi_problem_words.h -- Read options of the command line from a file: --problem FILE. */
#ifndef FVI_PROBLEM_WORDS_H
#define FVI_PROBLEM_WORDS_H

#include <fvi/error.h>

/* fvi_problem_words -- Replace each --problem FILE after the command by the options in the file. A line "alpha 0.3" or
 * "alpha = 0.3" becomes --alpha=0.3. Empty lines and lines that begin with # are skipped.
 *
 *   argc, argv  in: those of main; out: the same, or a longer list, which lives as long as the process
 *
 * Return 0; FVI_EINVAL with an error of the field "problem" if a file cannot be read, a line is no option, or a file
 * contains `problem` again; FVI_ENOMEM. */
int fvi_problem_words(int *argc, char ***argv, fvi_error *error);

/* fvi_word_is_option -- Return nonzero if the word is "--name" or "--name=value".
 * fvi_option_with_value -- Return nonzero if word *i is that option. Then *value is the text after =, or the next word,
 * to which *i is moved; NULL if there is no next word. The words end with NULL. */
int fvi_word_is_option(const char *word, const char *name);
int fvi_option_with_value(char *const *words, int *i, const char *name, const char **value);

#endif
