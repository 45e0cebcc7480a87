/* src/options/fvi_laws.h -- Laws of damping: --damping zener:1,0.3,2. */
#ifndef FVI_LAWS_H
#define FVI_LAWS_H

#include <fvi/damping_laws.h>
#include "fvi_words.h"

enum { FVI_MOST_TERMS = 64 };

/* Do not copy one that is in use: law points into it. */
typedef struct {
    fvi_kernel law;
    fvi_kernel_term term[FVI_MOST_TERMS];
    char text[4096]; /* "power:1,0.3 + maxwell:2,5" */
} fvi_laws;

/* fvi_laws_add -- more terms, with " + " between them: viscous:R  spring:K  power:R,A
 * zener:R,A,T  maxwell:R,T  maxwell2:R1,A,R2,B  distributed:R,A,B.
 * Returns 0, or 2 if one is none, a number is out of range, or there is no room. */
int fvi_laws_add(fvi_laws *laws, const char *text, fvi_complaint c);

#endif
