/* src/run/impulses.h -- What hits the body, as steps of one length take it. [H 2] */
#ifndef FVI_IMPULSES_H
#define FVI_IMPULSES_H

#include <fvi/trajectory.h>

/* fvi_impulses_check -- FVI_SUCCESS; FVI_EFAULT if there are impulses and no array, or one
 * without J; FVI_EDOM if a number is not finite, or a time negative; FVI_EINVAL if the
 * times fall. Field "impulses", the index that of the impulse. Cost O(n d). */
int fvi_impulses_check(const fvi_force *force, size_t d, fvi_error *error);

/* fvi_impulses_add -- add to J, d numbers, what falls to node k of steps h, (2.15). Cost O(log n) of n
 * impulses, and O(d) for each within a step of the node. */
void fvi_impulses_add(const fvi_force *force, double h, size_t k, size_t d,
                      double *J);

/* fvi_impulses_act -- the same, added to p. */
void fvi_impulses_act(fvi_stepper *s, size_t k);

#endif
