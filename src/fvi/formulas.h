/* src/fvi/formulas.h -- The words of a problem, and the formulas that they stand for.
 *
 * For example, the word zener:R,A,T of a law of damping stands for the symbol R s^{2A}/(1 + T s^{2A}). The help of the
 * program and of Python prints these lists. */
#ifndef FVI_FORMULAS_H
#define FVI_FORMULAS_H

#include "damping_laws.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* Three more lists of formulas (fvi_formula, damping_laws.h), beside the one of the laws of damping: potentials, forces
 * and pasts. Each list ends with an entry whose form is NULL. */
extern const fvi_formula fvi_potential_formulas[], fvi_force_formulas[], fvi_past_formulas[];

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
