/* src/frequency/winding.h -- Count how often a function winds around 0.     [H 26, H 30] */
#ifndef FVI_WINDING_H
#define FVI_WINDING_H

/* A rectangle of ln s = u + i v. */
typedef struct {
    double u[2], v[2];
} fvi_log_box;

/* The argument of a function at s = e^(u + i v), up to whole turns; NaN if it has none. */
typedef double fvi_phase(const void *params, double u, double v);

/* fvi_winding -- Return how many more zeros than poles the function has in the box, by the argument principle.
 * [(26.11), (30.8)]
 *
 *   step  of ln s, from one evaluation of the function to the next; v < pi. A step is halved while the function
 *         turns by more than half a radian in one of its halves. Within a step it must turn by less than
 *         a whole turn. Steps in u are at most 12 (pi - v), because of zeros and poles at v = pi
 *
 * Return -1 if the phase does not settle, because a zero or a pole is on a side, or if the box is not finite. */
int fvi_winding(fvi_phase *phase, const void *params, double step,
                const fvi_log_box *b);

/* fvi_halve_box -- Cut a box across its longer side, where no zero is. The cut is not in the middle, where a zero may
 * be because of symmetry. Return how many more zeros than poles are in the first half, or -1. */
int fvi_halve_box(fvi_phase *phase, const void *params, double step, const fvi_log_box *b, fvi_log_box half[2]);

#endif
