/* src/fvi/rheology.h -- Laws of damping from what laboratories measure.    [H 24]
 *
 * A law is a sum of elements, such as a spring and zener's. Each has numbers with names. */
#ifndef FVI_RHEOLOGY_H
#define FVI_RHEOLOGY_H

#include "damping_laws.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_element -- the kinds of terms of a law as people know them, with their numbers:
 *
 *     spring       k                               a POWER of order 0
 *     viscous      rho                             a POWER of alpha = 1/2
 *     power        rho, alpha
 *     zener        rho, alpha, time
 *     maxwell      rho, time
 *     maxwell2     rho1, alpha1, rho2, alpha2      alpha1 >= alpha2
 *     davidson     rho, alpha, time
 *     distributed  rho, alpha, end */
typedef enum {
    FVI_ELEMENT_SPRING,
    FVI_ELEMENT_VISCOUS,
    FVI_ELEMENT_POWER,
    FVI_ELEMENT_ZENER,
    FVI_ELEMENT_MAXWELL,
    FVI_ELEMENT_MAXWELL2,
    FVI_ELEMENT_DAVIDSON,
    FVI_ELEMENT_DISTRIBUTED
} fvi_element;

enum { FVI_ELEMENT_NUMBERS = 4 /* at most */ };

/* fvi_element_words -- "spring" and so on, in the order of the kinds, ended by NULL. */
extern const char *const fvi_element_words[];

/* fvi_element_of -- the kind of a term; of a POWER with alpha = 0 or 1/2 a spring or a dashpot.
 * Not for a SYMBOL. */
fvi_element fvi_element_of(const fvi_kernel_term *term);

/* fvi_element_number -- the name of number i of a kind, NULL where it has not so many; and in
 * *field, which may be NULL, where a fvi_kernel_term has it: 0 rho, 1 alpha, 2 time, 3 end, as in
 * fvi_free_parameter. */
const char *fvi_element_number(fvi_element kind, size_t i, size_t *field);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
