/* src/output/fvi_watch.h -- A run that gets stiffer on its way. */
#ifndef FVI_WATCH_H
#define FVI_WATCH_H

#include <fvi/trajectory.h>
#include "words/fvi_option_list.h"

typedef struct {
    double stiffest; /* so far, see fvi_stability_along */
    size_t next; /* the step of the next look; no look where it is SIZE_MAX */
} fvi_watch;

/* fvi_watch_begin -- before the first step. Nothing will be looked at if U is quadratic,
 * or the load does not depend on U, or modes would take d^3 operations, or `warned`: the
 * step is known to be unstable. */
fvi_watch fvi_watch_begin(const fvi_options *o, const fvi_system *system,
                          int warned);

/* fvi_watch_step -- after a step: look, after the first eight in every eighth, and say on standard error, once,
 * that small motions about the place of the run grow with such a step. (14.6) */
void fvi_watch_step(fvi_watch *w, const fvi_stepper *s);

#endif
