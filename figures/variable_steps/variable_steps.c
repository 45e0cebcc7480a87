/* figures/variable_steps/variable_steps.c -- H 22: the steps of a run, and the modes of its memory, on the same
 * ladder of lengths.
 *
 * The problem is that of Bagley and Torvik, x'' + x + D^{3/2} x = 8 for t <= 1, then 0, from rest, by
 * fvi_variable_step.
 * - Block 0: t and x of 400 rows, which lie between the ends of steps.
 * - Block 1, for each step: its number, its end, x there, its length, and 1 if the length is a rung of the
 *   ladder.
 * - Block 2, for each mode, those steps in which it is active: number of the step, 1 / sigma. */
#include <fvi/error.h>
#include <fvi/variable_steps.h>

#include "stages/variable_rule.h"
#include "system/larger.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { ROWS = 400, MOST = 200 };
static const double T = 20, TOP = 2e4; /* (22.12) */

static fvi_stepper *started(fvi_run *run)
{
    static const double one = 1, zero = 0, aT[] = { 8, 1 };
    static fvi_system system = { .d = 1, .mass = &one, .damping = &one };
    fvi_stepper *s;
    system.potential = fvi_potential_harmonic(&one);
    system.force = fvi_force_step(aT);
    *run = (fvi_run){ .system = &system,
                      .x0 = &zero,
                      .p0 = &zero,
                      .h = T / ROWS,
                      .steps = ROWS,
                      .alpha = 0.75,
                      .step_error = 1e-8 };
    if (fvi_stepper_start(&fvi_variable_step, run, &s, NULL))
        exit(EXIT_FAILURE);
    return s;
}

static void rows(void)
{
    fvi_run run;
    fvi_stepper *s = started(&run);
    printf("# t, x\n");
    for (size_t k = 0; k <= ROWS; k++) {
        double x, p;
        if (fvi_stepper_advance_to(s, (double)k * run.h, &x, &p))
            exit(EXIT_FAILURE);
        printf("%.6g %.6g\n", (double)k * run.h, x);
    }
    fvi_stepper_free(s);
}

/* Store the lengths of the steps in h, print a row for each step, and return their number. */
static size_t steps(double *h)
{
    fvi_run run;
    fvi_stepper *s = started(&run);
    size_t n = 0;
    printf("\n\n# step, its end, x there, its length, 1 on a rung\n");
    for (double t = 0; t < T && n < MOST; t = s->t) {
        if (fvi_stepper_step(s))
            exit(EXIT_FAILURE);
        h[n++] = s->t - t;
        const double k = log(h[n - 1]) / fvi_variable_spacing();
        printf("%zu %.6g %.6g %.6g %d\n", n, s->t, s->x[0], h[n - 1],
               fabs(k - round(k)) < 1e-9);
    }
    fvi_stepper_free(s);
    return n;
}

int main(void)
{
    double h[MOST], least = T;
    rows();
    const size_t n = steps(h);
    for (size_t k = 0; k < n; k++)
        least = smaller(least, h[k]);
    printf("\n\n# step, 1 / sigma of a mode that is awake\n");
    const double L = fvi_variable_spacing();
    for (double q = floor((-6.5 - log(T)) / L); exp(L * (q - 1)) * least < TOP;
         q++)
        for (size_t k = 0; k < n; k++)
            if (exp(L * (q - 1)) * h[k] < TOP) /* the modes up to the first one with sigma h above TOP */
                printf("%.1f %.6g\n%.1f %.6g\n\n", (double)k + 0.5, exp(-L * q),
                       (double)k + 1.5, exp(-L * q));
    return EXIT_SUCCESS;
}
