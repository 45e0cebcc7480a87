/* src/system/vectors.h -- Loops that are compiled for several widths of vectors.
 *
 * A function marked FVI_VECTORS is compiled for plain x86-64, AVX2 and AVX-512, and
 * the loader picks. -ffp-contract=off holds in all, and the order of the sums
 * is written down: the digits are the same. Only the loader of glibc can pick, and
 * any header of the C library says whether it is there. Such a function is static, and another one calls it
 * for other files: clang 14 gives the clones a name that no other file knows. Under ThreadSanitizer there
 * is one version, because the loader would call code that is not ready yet. */
#ifndef FVI_VECTORS_H
#define FVI_VECTORS_H

#include <stddef.h>
#include <stdint.h>

#if defined(__has_feature)
#if __has_feature(thread_sanitizer) /* clang's word for it */
#define FVI_THREADS_ARE_WATCHED
#endif
#elif defined(__SANITIZE_THREAD__)
#define FVI_THREADS_ARE_WATCHED
#endif
#if defined(__x86_64__) && defined(__GLIBC__)                                  \
    && !defined(FVI_THREADS_ARE_WATCHED)                                       \
    && ((defined(__clang__) && __clang_major__ >= 14)                          \
        || (!defined(__clang__) && defined(__GNUC__)))
#define FVI_VECTORS __attribute__((target_clones("default", "avx2", "avx512f")))
#else
#define FVI_VECTORS
#endif

#endif
