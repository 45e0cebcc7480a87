/* tests/example/moving.c -- The example of README.md as it was in version 0.2, with today's names. */
#include <fvi/fvi.h>

#include <stdio.h>

//> trajectory
/* The function fvi_trajectory of version 0.2: write a whole run into arrays, each of which may be NULL.
 * The energy of a row is the energy at the end of the last step up to the row. */
static int fvi_trajectory(const fvi_method *method, const fvi_run *run, double *x,
                          double *p, double *energy)
{
    const size_t d = run->system->d;
    fvi_stepper *s;
    int status = fvi_stepper_start(method, run, &s, NULL);
    if (status)
        return status;
    for (size_t k = 0; !status && k <= run->steps; k++) {
        status = fvi_stepper_advance_to(s, (double)k * run->h, x ? x + k * d : NULL,
                                        p ? p + k * d : NULL);
        if (!status && energy)
            status = fvi_stepper_energy(s, energy + k);
    }
    fvi_stepper_free(s);
    return status;
}
//< trajectory

int main(void)
{
    const double one = 1, spring[] = { 1, 0.5 }, rho = 0.4, p0 = 0.5;
    const fvi_system system = { .d = 1,
                                .mass = &one,
                                .damping = &rho,
                                .potential = fvi_potential_duffing(spring) };
    fvi_run run = fvi_run_default(&system, &one, &p0, 0.1, 200);
    run.alpha = 0.3; /* the body is at rest until t = 0 */
    double x[201];
    const int status = fvi_trajectory(&fvi_lobatto_m3, &run, x, NULL, NULL);
    for (size_t k = 0; status == 0 && k <= 200; k++)
        printf("%.17g\t%.17g\n", (double)k * run.h, x[k]);
    return status;
}
