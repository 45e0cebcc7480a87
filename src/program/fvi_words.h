/* src/program/fvi_words.h -- From the words of a command line to values. Each function
 * returns 0, or 2 after it has written a complaint that names the option. */
#ifndef FVI_WORDS_H
#define FVI_WORDS_H

#include <stddef.h>

typedef struct {
    char *text; /* one line, without the newline */
    size_t size;
} fvi_complaint;

/* Write the complaint, as printf would; control characters become '?'. */
__attribute__((format(printf, 2, 3))) int fvi_refuse(fvi_complaint c,
                                                     const char *format, ...);

/* A finite number between low and high. brackets is "[]", "(]", "[)" or "()":
 * a round one keeps its end out of the range. */
int fvi_word_number(const char *name, const char *text, double low, double high,
                    const char *brackets, double *value, fvi_complaint c);

/* A whole number from 1 to `most`, at most 2^53; "1e6" is one too. */
int fvi_word_whole(const char *name, const char *text, size_t most,
                   size_t *value, fvi_complaint c);

/* The word, of those ended by NULL, that is nearest to the first `length` letters
 * of text, if a slip of the finger leads from the one to the other; else NULL. */
const char *fvi_word_nearest(const char *text, size_t length,
                             const char *const *words);

/* Which of the words, ended by NULL. */
int fvi_word_choice(const char *name, const char *text,
                    const char *const *words, size_t *which, fvi_complaint c);

/* d numbers "1,2,3", or one that stands for all of them. */
int fvi_word_list(const char *name, const char *text, size_t d, double *values,
                  fvi_complaint c);

/* "word:p1,p2": nonzero if text is that word with exactly count numbers. */
int fvi_word_call(const char *text, const char *word, int count, double *p);

/* A potential: the first letter of its name, its dimension, its parameters. */
int fvi_word_potential(const char *text, char *name, size_t *d,
                       double spring[2], fvi_complaint c);

/* A force: n, s or c, and its parameters. */
int fvi_word_force(const char *text, char *name, double forcing[2],
                   fvi_complaint c);

/* The first letters of the columns, in order, each at most once; columns is
 * zeroed and has room for all five and an end. */
int fvi_word_columns(const char *text, char *columns, fvi_complaint c);

#endif
