/* tests/random/fuzz/random_words.h -- The dice, and the words of a line. */
#ifndef RANDOM_WORDS_H
#define RANDOM_WORDS_H

#include <stddef.h>

#define LEN(array) (sizeof(array) / sizeof((array)[0]))

/* ---- dice ---- */

/* The state of case number n does not depend on those before it. */
void seed(unsigned long long s, size_t n);

/* One of 0, ..., n - 1. */
size_t dice(size_t n);

/* One of the n words of a list. */
const char *one_of(const char *const *list, size_t n);
#define ONE_OF(list) one_of(list, LEN(list))

/* ---- words ---- */

enum { WORD = 400, WORDS = 24 };

/* The line of this case, fvi first. */
extern char words[WORDS][WORD];
extern int count;

/* One word more; nothing if there are WORDS already. */
__attribute__((format(printf, 1, 2))) void add(const char *format, ...);

/* Some bytes of a word of WORD bytes changed, put in or left out. */
void spoil(char *word);

/* A count. How much work a run may be is bounded by these, which are not spoiled. */
const char *few(void);

/* Add the words of a whole line, mostly of one that is refused. */
void random_line(void);

#endif
