/* src/system/system_check.h -- Is it a system, with matrices or without?   [H 2, 27] */
#ifndef FVI_SYSTEM_CHECK_H
#define FVI_SYSTEM_CHECK_H

#include <fvi/error.h>
#include <fvi/system.h>

/* fvi_system_check_any -- as fvi_system_check, but matrices are welcome: FVI_EFAULT if one of
 * their functions is missing, FVI_EINVAL if there is a potential, too. */
int fvi_system_check_any(const fvi_system *system, fvi_error *error);

/* fvi_system_require, fvi_system_require_any -- as fvi_system_check and fvi_system_check_any, for a function that
 * returns a code and no fvi_error: the reason goes to the error handler. */
int fvi_system_require(const fvi_system *system);
int fvi_system_require_any(const fvi_system *system);

#endif
