/* src/expression/expression_terms.h -- Define the terms of an expression.       [H 9] */
#ifndef FVI_EXPRESSION_TERMS_H
#define FVI_EXPRESSION_TERMS_H

#include "tape.h"

#include <stddef.h>

/* A term has a tape of its own, so coordinates of different terms have no common derivative to compute. */
typedef struct {
    fvi_node *node;
    size_t count;
    int *coordinate; /* the coordinates of the term, each once */
    size_t coordinates;
} term;

struct fvi_expression {
    size_t d;
    const double *values;
    term *terms;
    size_t count, room;
    size_t half_bandwidth; /* largest distance between two coordinates of a term */
    int degree;
};

#endif
