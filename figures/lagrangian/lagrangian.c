/* figures/lagrangian/lagrangian.c -- H 29: an elastic pendulum without weight, on a springpot strut.
 *
 * Prints three blocks: t, x1, x2; t, E, J with the damper along the strut; t, E, J with two dampers along
 * the coordinates. J is the angular momentum, less its value at the start. */
#include <fvi/fvi.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { STEPS = 1200 };

static const char *const strut[] = { "sqrt(x1^2+x2^2) : power:0.1,0.3" };
static const char *const axes[] = { "x1 : power:0.1,0.3",
                                    "x2 : power:0.1,0.3" };

/* A row of the run: the path, or energy and angular momentum. */
static int print_row(const fvi_stepper *s, int path)
{
    double E = NAN;
    const double J = s->x[0] * s->p[1] - s->x[1] * s->p[0] - 0.96;
    const int status = fvi_stepper_energy(s, &E);
    if (path)
        printf("%.17g %.17g %.17g\n", s->t, s->x[0], s->x[1]);
    else
        printf("%.17g %.17g %.17g\n", s->t, E, J);
    return status;
}

static int block(size_t dampers, const char *const *damper, int path)
{
    const fvi_mechanism_texts texts = {
        .lagrangian = "(v1^2+v2^2)/2 - 2*(sqrt(x1^2+x2^2)-1)^2",
        .dampers = dampers,
        .damper = damper
    };
    fvi_typed_mechanism *typed;
    fvi_stepper *s = NULL;
    if (fvi_parse_mechanism(&texts, 2, NULL, &typed, NULL))
        return EXIT_FAILURE;
    const fvi_system system = { .d = 2,
                                .mechanism = fvi_mechanism_typed(typed) };
    const double x0[] = { 1.2, 0 }, p0[] = { 0.3, 0.8 };
    const fvi_run run = fvi_run_default(&system, x0, p0, 0.05, STEPS);
    int status = fvi_stepper_start(&fvi_lobatto_m4, &run, &s, NULL);
    for (size_t k = 0; !status && k <= STEPS; k++) {
        status = print_row(s, path);
        if (!status && k < STEPS)
            status = fvi_stepper_step(s);
    }
    fvi_stepper_free(s);
    fvi_typed_mechanism_free(typed);
    return status;
}

int main(void)
{
    printf("# t, x1, x2\n");
    if (block(1, strut, 1))
        return EXIT_FAILURE;
    printf("\n\n# t, E, J - J(0): the strut\n");
    if (block(1, strut, 0))
        return EXIT_FAILURE;
    printf("\n\n# t, E, J - J(0): dampers along the coordinates\n");
    return block(2, axes, 0);
}
