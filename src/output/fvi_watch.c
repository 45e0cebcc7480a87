/* src/output/fvi_watch.c -- A run that gets stiffer on its way. */
#include "fvi_watch.h"

#include <fvi/stability.h>
#include "fvi_output.h"

#include <stdint.h>
#include <stdio.h>

enum { FEW = 256, BETWEEN = 8 /* steps from one look to the next */ };

fvi_watch fvi_watch_begin(const fvi_options *o, const fvi_system *system,
                          int warned)
{
    const fvi_potential *u = &system->potential;
    const fvi_method *m = o->method;
    const int depends = m->stages > 0    ? !m->damped_inertia && o->d <= FEW
                        : m->takes_kappa ? o->kappa != 0.5
                                         : !m->implicit,
              worth = depends && !warned && m->load && u->hessian
                      && !(u->quadratic && u->quadratic(u->params));
    return (fvi_watch){ 0, worth ? 1 : SIZE_MAX };
}

void fvi_watch_step(fvi_watch *w, const fvi_stepper *s)
{
    double load = 0;
    if (s->k < w->next)
        return;
    w->next = s->k + (s->k < BETWEEN ? 1 : BETWEEN);
    if (fvi_stability_along(s->method, &s->run, s->x, &w->stiffest, &load)
        || load <= 1)
        return;
    w->next = SIZE_MAX;
    fvi_progress_clear(); /* which may stand on the same terminal */
    fprintf(stderr,
            "fvi: warning: this step is unstable where the run is at t = %.4g "
            "(load %.4g, above 1)\n",
            s->t, load);
}
