/* src/input/fvi_shared.h -- Load a potential from a shared object or from a C file. */
#ifndef FVI_SHARED_H
#define FVI_SHARED_H

#include "fvi_refuse.h"

/* fvi_shared_name -- Return nonzero if the text of --potential ends with .so or .c. */
int fvi_shared_name(const char *text);

/* fvi_shared_open -- Load a shared object, or compile and load a C file, that defines
 *
 *     const fvi_potential fvi_user_potential = { .value = ..., ... };
 *
 * It may also define a function that explains the codes that its functions return:
 *
 *     const char *fvi_user_error(int code);
 *
 *   library  output; close it with fvi_shared_close when U is no longer used
 *   U        output
 *
 * Return 0; a code of fvi/error.h with the error filled in if the file cannot be loaded or compiled, or has no such
 * potential. */
int fvi_shared_open(const char *text, void **library, fvi_potential *U,
                    fvi_error *c);

/* fvi_shared_error -- Return the text of fvi_user_error of the open potential for this code, or NULL if there is
 * none. */
const char *fvi_shared_error(int code);

/* fvi_shared_close -- Close the library; NULL is allowed. */
void fvi_shared_close(void *library);

#endif
