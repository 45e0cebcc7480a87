/* src/frequency/winding.h -- How often a function winds around 0.     [H 26, H 30] */
#ifndef FVI_WINDING_H
#define FVI_WINDING_H

/* A rectangle of ln s = u + i v. */
typedef struct {
    double u[2], v[2];
} fvi_log_box;

/* The argument of a function, by whole turns, at s = e^(u + i v); NaN where it has none. */
typedef double fvi_phase(const void *params, double u, double v);

/* fvi_winding -- how many more zeros than poles the function has in the box, by the argument
 * principle.                                                          [(26.11), (30.8)]
 *
 *   step  of ln s, from one evaluation of the function to the next; where it turns by more than half
 *         a radian, pieces are halved. Within a step it must turn by less than a whole turn
 *
 * Returns that number; -1 if the phase does not settle, where a zero or a pole is on a side, or if
 * the box is not finite. */
int fvi_winding(fvi_phase *phase, const void *params, double step,
                const fvi_log_box *b);

#endif
