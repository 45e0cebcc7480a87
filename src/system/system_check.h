/* src/system/system_check.h -- Check a system, with or without matrices or a mechanism.   [H 2, 27] */
#ifndef FVI_SYSTEM_CHECK_H
#define FVI_SYSTEM_CHECK_H

#include <fvi/error.h>
#include <fvi/system.h>

/* fvi_system_check_any -- Check a system as fvi_system_check does, but accept matrices and a mechanism. In
 * addition, return FVI_EFAULT if a function of the matrices is missing, and FVI_EINVAL if there are both
 * matrices and a potential. */
int fvi_system_check_any(const fvi_system *system, fvi_error *error);

/* fvi_system_require, fvi_system_require_any -- Call fvi_system_check or fvi_system_check_any, for a function that
 * returns a code but has no fvi_error. The reason goes to the error handler. */
int fvi_system_require(const fvi_system *system);
int fvi_system_require_any(const fvi_system *system);

#endif
