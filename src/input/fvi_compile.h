/* src/input/fvi_compile.h -- A file of C becomes a shared object. */
#ifndef FVI_COMPILE_H
#define FVI_COMPILE_H

#include <stddef.h>

/* fvi_compile -- by $CC, or cc, with the headers of this program, in a folder of its own
 * under $TMPDIR that is gone when this returns; a signal that comes meanwhile waits so
 * long. $CC may be several words, "ccache gcc -m64", none of them in
 * quotes.
 *
 *   file     a path that begins with a slash or a dot: not an option of the compiler
 *   library  output: as dlopen gives it, or NULL
 *   why      output, room for size: what was wrong, one line
 *
 * Returns 0, or 1. */
int fvi_compile(const char *file, void **library, size_t size, char *why);

#endif
