/* src/input/fvi_shared.h -- A potential from a shared object, or from a file of C. */
#ifndef FVI_SHARED_H
#define FVI_SHARED_H

#include "fvi_refuse.h"

/* fvi_shared_name -- nonzero if the text of --potential is such a file: it ends with .so or .c. */
int fvi_shared_name(const char *text);

/* fvi_shared_open -- load a shared object, or compile a file of C, that defines
 *
 *     const fvi_potential fvi_user_potential = { .value = ..., ... };
 *
 * and, if it likes, says in words what the codes mean that its functions return:
 *
 *     const char *fvi_user_error(int code);
 *
 *   library  output; close it with fvi_shared_close when U is no longer used
 *   U        output
 *
 * Returns 0; 2 if it cannot be loaded or compiled, or has no such potential. */
int fvi_shared_open(const char *text, void **library, fvi_potential *U,
                    fvi_error *c);

/* fvi_shared_error -- what fvi_user_error of the potential that is open says; NULL if it says
 * nothing of this code. */
const char *fvi_shared_error(int code);

/* fvi_shared_close -- NULL is allowed. */
void fvi_shared_close(void *library);

#endif
