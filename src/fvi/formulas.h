/* src/fvi/formulas.h -- What the words of a problem stand for: zener:R,A,T is R s^{2A}/(1 + T s^{2A}). */
#ifndef FVI_FORMULAS_H
#define FVI_FORMULAS_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_formula -- a word with its numbers, as it is typed, and its formula.
 *
 * Each list ends with a form that is NULL. The laws stand in the order in which parsers know them. */
typedef struct {
    const char *form, *formula;
} fvi_formula;
extern const fvi_formula fvi_law_formulas[], fvi_potential_formulas[], fvi_force_formulas[], fvi_past_formulas[];

/* fvi_formulas_write -- all lists as a text, a line for each word, for a help.
 *
 *   text  output: at most size bytes with the '\0', as by snprintf; NULL if size is 0
 *
 * Returns the length of the whole text without the '\0'. */
size_t fvi_formulas_write(size_t size, char *text);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
