/* src/input/fvi_refuse.h -- What is wrong with what was typed, in one line. What can refuse
 * returns 0, or 2 after it has written a complaint that names the option. */
#ifndef FVI_REFUSE_H
#define FVI_REFUSE_H

#include <fvi/expression.h>
#include <stddef.h>

enum { FVI_COMPLAINT = 400 /* bytes that are enough for a complaint */ };

typedef struct {
    char *text; /* one line, two with a caret, without the newline */
    size_t size;
} fvi_complaint;

/* Write the complaint, as printf would; control characters become '?', and of what is
 * too long for its place the middle becomes "...". */
__attribute__((format(printf, 2, 3))) int fvi_refuse(fvi_complaint c,
                                                     const char *format, ...);

/* Refuse a misprint in the text of --name: what is wrong, and in a second line, which
 * is not ended, a caret below the place, when the complaint is printed behind "fvi: ". */
int fvi_refuse_at(fvi_complaint c, const char *name, const char *text,
                  fvi_misprint wrong);

/* The word, of those ended by NULL, that is nearest to the first `length` letters
 * of text, if a slip of the finger leads from the one to the other; else NULL. */
const char *fvi_word_nearest(const char *text, size_t length,
                             const char *const *words);

/* "; did you mean x?", in the place of a complaint, for what is none of the words; empty
 * if none is near. Returns place. */
const char *fvi_word_hint(const char *text, size_t length,
                          const char *const *words, char place[64]);

/* Refuse an option that is none of these, "--apha=1" of "alpha": with the nearest one, if
 * one is near. */
int fvi_refuse_option(fvi_complaint c, const char *given,
                      const char *const *names);

#endif
