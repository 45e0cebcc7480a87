/* src/expression/expression_terms.h -- What an expression is made of.       [H 9] */
#ifndef FVI_EXPRESSION_TERMS_H
#define FVI_EXPRESSION_TERMS_H

#include "tape.h"

#include <stddef.h>

/* A term is a tape of its own, so that coordinates that do not meet cost each other
 * nothing. */
typedef struct {
    fvi_node *node;
    size_t count;
    int *coordinate; /* that stand in it, without repetition */
    size_t coordinates;
} term;

struct fvi_expression {
    size_t d;
    const double *values;
    term *terms;
    size_t count, room;
    size_t reach; /* the largest distance of two coordinates of a term */
    int degree;
};

#endif
