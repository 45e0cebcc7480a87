/* src/fvi/formulas.h -- The words of a problem, and the formulas that they stand for.
 *
 * For example, the word zener:R,A,T of a law of damping stands for the symbol R s^{2A}/(1 + T s^{2A}). The help of the
 * program and of Python prints these lists. */
#ifndef FVI_FORMULAS_H
#define FVI_FORMULAS_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_formula -- one word with its numbers, as a user types it, and its formula.
 *
 *   form     "zener:R,A,T"
 *   formula  "R s^{2A}/(1 + T s^{2A})"; may contain '\n'
 *
 * There are four lists: laws of damping, potentials, forces and pasts. Each list ends with an entry whose form is NULL.
 * The laws stand in the order in which the parser knows them (parse_words.h). */
typedef struct {
    const char *form, *formula;
} fvi_formula;
extern const fvi_formula fvi_law_formulas[], fvi_potential_formulas[], fvi_force_formulas[], fvi_past_formulas[];

/* fvi_formulas_write -- write all four lists as one text, for a help.
 *
 *   text  output: at most `size` bytes with the '\0', as snprintf writes them; may be NULL if size is 0
 *
 *     char text[4000];
 *     if (fvi_formulas_write(sizeof text, text) < sizeof text)
 *         fputs(text, stdout);
 *
 * Returns the length of the whole text without the '\0', also where `size` is smaller. Each word begins a line. */
size_t fvi_formulas_write(size_t size, char *text);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
