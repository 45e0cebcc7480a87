/* src/fvi/visit.h -- What the steps of a run change, piece by piece.     [Chapter 2] */
#ifndef FVI_VISIT_H
#define FVI_VISIT_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* fvi_visitor -- who is shown the pieces. A user of the library fills it in, perhaps as
 * the first field of a struct with more:
 *
 *   visit  is called for each piece, always in the same order. constant == 0: what steps
 *          change; the visitor may read it, to save a run, or write what was saved.
 *          constant != 0: what steps do not change, and what must be the same in a run
 *          that goes on with the other pieces. Returns 0, or a code that ends the visit */
typedef struct fvi_visitor fvi_visitor;
struct fvi_visitor {
    int (*visit)(fvi_visitor *visitor, void *data, size_t bytes, int constant);
};

#ifdef __cplusplus
}
#endif

#endif
