/* src/system/vectors.h -- Compile loops for several widths of vectors.
 *
 * A function that is marked FVI_VECTORS is compiled three times, for plain x86-64, AVX2 and AVX-512, and the loader
 * selects the version for the processor. All versions give the same digits, because -ffp-contract=off holds in all of
 * them and the code fixes the order of each sum.
 *
 * Only the loader of glibc can select a version. Including any header of the C library, here <stddef.h>, defines
 * __GLIBC__. A marked function must be static, and other files reach it through an ordinary function, because clang 14
 * gives the versions names that no other file knows. Under ThreadSanitizer there is only one version, because the
 * loader would call code that is not ready yet. */
#ifndef FVI_VECTORS_H
#define FVI_VECTORS_H

#include <stddef.h>
#include <stdint.h>

#if defined(__has_feature)
#if __has_feature(thread_sanitizer) /* how clang announces ThreadSanitizer */
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
