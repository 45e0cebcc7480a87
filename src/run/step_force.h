/* src/run/step_force.h -- The force F(t) of a step, which must be finite.               [H 2] */
#ifndef FVI_STEP_FORCE_H
#define FVI_STEP_FORCE_H

#include <fvi/trajectory.h>

#include <math.h>

/* fvi_many_are_finite -- Return 1 if all n numbers are finite, else 0, faster than fvi_all_finite for many numbers.
 * fvi_row_is_finite -- The same for any n, without a call if n is small. */
int fvi_many_are_finite(size_t n, const double *v);
static inline int fvi_row_is_finite(size_t n, const double *v)
{
    return n < 8 ? fvi_all_finite(n, v) : fvi_many_are_finite(n, v);
}

/* fvi_step_force -- Write F(t) to F, d numbers; zeros if there is no force. F is not checked. Return FVI_SUCCESS, or
 * the code of the force.
 * fvi_finite_step_force -- Do the same in a step, where F must be finite. Otherwise return FVI_EBADFUNC, and describe
 * in s->error which number of F is not finite, and when. */
int fvi_step_force(const fvi_stepper *s, double t, double *F);
int fvi_finite_step_force(const fvi_stepper *s, double t, double *F);

/* fvi_check_finite -- Check that n numbers which a function gave for the time t are finite. Return FVI_SUCCESS, or
 * FVI_EBADFUNC, and then describe the first other number in s->error, for example "the force on coordinate 2 is
 * infinite at t = 1":
 *
 *   field  the field of the error, "force"
 *   what   "the force"
 *   which  " on coordinate ", left out with the number if n = 1 */
int fvi_check_finite(const fvi_stepper *s, const char *field, const char *what, const char *which, double t, size_t n,
                     const double *v);

/* fvi_not_finite_in_words -- "infinite", or "not a number". */
static inline const char *fvi_not_finite_in_words(double v)
{
    return isnan(v) ? "not a number" : "infinite";
}

#endif
