/* src/inverse/mirror_stages.h -- The run that goes backwards through stages. [Chapter 23]
 *
 * Internal: what mirror.h is for the methods of form M of chapter 17. */
#ifndef FVI_MIRROR_STAGES_H
#define FVI_MIRROR_STAGES_H

#include <fvi/adjoint.h>
#include "memory/lobatto_memory.h"
#include "system/band.h"

/* Stage i of coordinate j stands at [j * s + i]. */
typedef struct {
    const fvi_run *run;
    const fvi_gradients *want;
    const fvi_lobatto_rule *rule;
    size_t s, d;
    double unit;                      /* h^(-beta) */
    double K[FVI_STAGES][FVI_STAGES]; /* D^T B D */
    double E[FVI_STAGES][FVI_STAGES]; /* D^T B P */
    double W[FVI_STAGES][FVI_STAGES]; /* W_0 */
    double *Lambda, *T, *past;        /* s d numbers each; past: of T, known */
    double *G, *column, *Q, *r;       /* s Hessians; d; d; (s - 1) d */
    double *kinetic, *sum, *plain, *pull; /* d numbers each, see fvi_mirror */
    double *block;                        /* these; owned */
    fvi_lobatto_memory *memory; /* NULL: nothing is damped, or alpha = 1/2 */
    int is_damped, is_pulled;
    fvi_past_pull fading;
    fvi_band J;
} fvi_mirror_stages;

/* As fvi_mirror_start, _step, _end and _stop; rows: the s positions of step k. */
int fvi_mirror_stages_start(size_t stages, const fvi_run *run,
                            const fvi_gradients *want, const double *Jp,
                            fvi_mirror_stages *m);
int fvi_mirror_stages_step(fvi_mirror_stages *m, size_t k, const double *rows,
                           const double *Jx);
int fvi_mirror_stages_end(fvi_mirror_stages *m, const double *Jx);
void fvi_mirror_stages_stop(fvi_mirror_stages *m);

#endif
