/* src/run/impulses.h -- The impulses of a force, as steps of one length take them. [H 2] */
#ifndef FVI_IMPULSES_H
#define FVI_IMPULSES_H

#include <fvi/trajectory.h>

/* fvi_impulses_check -- check the impulses of a force in d coordinates. The error has the field "impulses" and the
 * index of the impulse. Cost O(n d) for n impulses.
 *
 * Returns FVI_SUCCESS; FVI_EFAULT if there are impulses but no array, or an impulse without J; FVI_EDOM if a number is
 * not finite, or a time is negative; FVI_EINVAL if a time is earlier than the time before it. */
int fvi_impulses_check(const fvi_force *force, size_t d, fvi_error *error);

/* fvi_impulses_add -- add the impulses' shares at node k to J, d numbers. An impulse between two nodes is divided
 * between them in proportion to its distance from each, (2.15). Cost O(log n) for n impulses, and O(d) for each impulse
 * within one step of the node. */
void fvi_impulses_add(const fvi_force *force, double h, size_t k, size_t d,
                      double *J);

/* fvi_impulses_act -- add the same shares to s->p. */
void fvi_impulses_act(fvi_stepper *s, size_t k);

#endif
