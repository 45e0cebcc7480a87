/* src/fvi/version.h -- Which library this is. */
#ifndef FVI_VERSION_H
#define FVI_VERSION_H

#define FVI_VERSION "0.3.0"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_version -- the version of the library that is linked, "0.3.0"; FVI_VERSION is
 * that of the headers. */
const char *fvi_version(void);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
