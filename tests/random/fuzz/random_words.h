/* tests/random/fuzz/random_words.h -- Random numbers, and the words of a random command line. */
#ifndef RANDOM_WORDS_H
#define RANDOM_WORDS_H

#include <stddef.h>

#define LEN(array) (sizeof(array) / sizeof((array)[0]))

/* ---- dice ---- */

/* seed -- set the dice for case number n of the seed s. They do not depend on earlier cases. */
void seed(unsigned long long s, size_t n);

/* dice -- return one of 0, ..., n - 1. */
size_t dice(size_t n);

/* one_of -- return one of the n words of a list. */
const char *one_of(const char *const *list, size_t n);
#define ONE_OF(list) one_of(list, LEN(list))

/* ---- words ---- */

enum { WORD = 400, WORDS = 24 };

/* The command line of this case; its first word is fvi. */
extern char words[WORDS][WORD];
extern int count;

/* add -- append a word; do nothing if there are WORDS words already. */
__attribute__((format(printf, 1, 2))) void add(const char *format, ...);

/* spoil -- change, insert or remove some bytes of a word of WORD bytes. */
void spoil(char *word);

/* few -- return a count. The counts bound the work of a run, so they are never spoiled. */
const char *few(void);

/* random_line -- add the words of a whole command line. Most lines are refused. */
void random_line(void);

#endif
