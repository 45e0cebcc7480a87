/* src/input/fvi_compile.h -- Compile a C file to a shared object. */
#ifndef FVI_COMPILE_H
#define FVI_COMPILE_H

#include <stddef.h>

/* fvi_compile -- Compile a C file with $CC, or cc, and load it. The headers of this program are found. The compiler
 * works in a temporary folder under $TMPDIR, which is removed before this function returns. A signal waits until then.
 * $CC may consist of several words, as in "ccache gcc -m64", but not of words in quotes.
 *
 *   file     a path that begins with a slash or a dot, so that it is not taken for an option
 *   library  output: the handle of dlopen, or NULL
 *   why      output: what was wrong, in one line of at most size bytes
 *
 * Return 0, or 1. */
int fvi_compile(const char *file, void **library, size_t size, char *why);

#endif
