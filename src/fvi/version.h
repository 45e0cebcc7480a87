/* src/fvi/version.h -- The version of the library. */
#ifndef FVI_VERSION_H
#define FVI_VERSION_H

#define FVI_VERSION "0.3.0"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_version -- Return the version of the linked library, for example "0.3.0". FVI_VERSION is the version of the
 * headers. */
const char *fvi_version(void);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
