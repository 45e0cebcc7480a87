/* tests/example/observer.c -- The force of a damper, from C: the example of the page on reports. */
#include <fvi/fvi.h>
#include <fvi/observer.h>
#include <stdio.h>

//> example
/* A body on a spring and a springpot: print its position, its velocity, and the force of the springpot. */
int main(void)
{
    const double one = 1, rho = 0.4, p0 = 0.5;
    const fvi_system system = { .d = 1,
                                .mass = &one,
                                .damping = &rho,
                                .potential = fvi_potential_harmonic(&one) };
    fvi_run run = fvi_run_default(&system, &one, &p0, 0.1, 200);
    fvi_stepper *s;
    fvi_observer *o;
    fvi_observation now;
    run.alpha = 0.3;
    if (fvi_stepper_start(&fvi_lobatto_m4, &run, &s, NULL))
        return 1;
    int status = fvi_observer_start(s, FVI_OBSERVE_VELOCITY | FVI_OBSERVE_FORCE,
                                    &o, NULL);
    while (!status && s->k < run.steps) {
        status = fvi_observer_step(o, s);
        if (!status)
            status = fvi_observer_read(o, s, s->t, &now);
        if (!status)
            printf("%g\t%g\t%g\t%g\n", now.t, now.x[0], now.v[0], now.force[0]);
    }
    fvi_observer_free(o);
    fvi_stepper_free(s);
    return status;
}
//< example
