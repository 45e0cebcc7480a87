/* figures/structures/frame.h -- H 27: a frame on moving ground, for the scenes of two buildings.
 *
 * Before this file, define `h`, the step of the record in seconds, and STEPS. */
#ifndef FRAME_H
#define FRAME_H

#include <fvi/fvi.h>
#include "system/larger.h"
#include <math.h>
#include <stdint.h>
#include <stdlib.h>

static void fail(int status)
{
    if (status)
        exit(EXIT_FAILURE);
}

/* ---- the ground ---- */

/* Return a random number, uniform in [-1, 1], by a linear congruential generator of 64 bits with a fixed seed. */
static double noise(void)
{
    static uint64_t state = 20;
    state = 6364136223846793005u * state + 1442695040888963407u;
    return (double)(int64_t)state * 0x1p-63;
}

/* Compute the acceleration of the ground at the steps: white noise through a damped oscillator, times an envelope. */
static void shake(double *ground)
{
    const double w = 2 * 3.14159265358979324 * 2.5, zeta = 0.6;
    double y = 0, v = 0;
    for (int k = 0; k <= STEPS; k++) {
        const double t = k * h, envelope = t / 4 * exp(1 - t / 4);
        v += h * (-2 * zeta * w * v - w * w * y) + 0.6 * sqrt(h) * noise();
        y += h * v;
        ground[k] = envelope * (2 * zeta * w * v + w * w * y);
    }
}

/* The force -m a(t) on every floor, m = 1. a is linear between two steps of the record. */
static int load(double t, size_t d, void *params, double *F)
{
    const double *ground = params, at = smaller(larger(t / h, 0), STEPS - 1e-9);
    const int k = (int)at;
    for (size_t i = 0; i < d; i++)
        F[i] = -(ground[k] + (at - k) * (ground[k + 1] - ground[k]));
    return 0;
}

/* ---- the building ---- */

//> springs
/* Append a spring or a damper of this size between the floors a and b to the list of entries; -1 is the ground. */
static void add(fvi_triplet *list, size_t *count, int a, int b, double size)
{
    const int ends[] = { a, b };
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++)
            if (ends[i] >= 0 && ends[j] >= 0)
                list[(*count)++] =
                    (fvi_triplet){ ends[i], ends[j], i == j ? size : -size };
}
//< springs

#endif
