/* tests/example/example.c -- The example of README.md: a system of one's own. */
#include <fvi/fvi.h>

#include <stdio.h>

//> example
/* Two masses, each tied to a wall and to the other; only the first is damped. */
int main(void)
{
    const double mass[] = { 1, 2 }, damping[] = { 0.3, 0 }, spring[] = { 1, 0 };
    const double x0[] = { 1, 0 }, p0[] = { 0, 0 };
    const fvi_system system = { .d = 2,
                                .mass = mass,
                                .damping = damping,
                                .potential = fvi_potential_chain(spring) };
    fvi_run run = fvi_run_default(&system, x0, p0, 0.01, 2000);
    run.alpha = 0.25; /* the rest is at rest until t = 0, kappa is 1/2 */
    fvi_stepper *s;
    if (fvi_start(&fvi_fractional, &run, &s) != 0)
        return 1;
    while (s->k < run.steps && fvi_step(s) == 0)
        if (s->k % 100 == 0)
            printf("%g %g %g\n", s->t, s->x[0], s->x[1]);
    fvi_stop(s);
    return 0;
}
//< example
