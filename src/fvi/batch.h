/* src/fvi/batch.h -- Many small runs as one.                          [H 28]
 *
 * A sweep, a picture of basins, or a fit makes many runs of one oscillator that differ in their
 * start, in the amplitude of a force or in a parameter of the potential. Up to eight of them can
 * be the coordinates of one run. They share the weights and modes of the memory, and each
 * operation of a step is one instruction for all of them:
 *
 *     fvi_batch *batch;
 *     fvi_stepper *s;
 *     if (fvi_batch_alloc(&fvi_cq2_midpoint, 8, run, &batch, &error) == FVI_SUCCESS
 *         && fvi_stepper_start(&fvi_cq2_midpoint, fvi_batch_run(batch), &s, &error) == FVI_SUCCESS) {
 *         while (s->k < s->run.steps && fvi_stepper_step(s) == FVI_SUCCESS)
 *             ;
 *         for (size_t l = 0; l < 8; l++)
 *             printf("%g %g\n", s->x[l], s->p[l]);
 *         fvi_stepper_free(s);
 *     }
 *     fvi_batch_free(batch);
 *
 * The digits of a lane, x[l] and p[l], are those of its own run, whichever the others are. What
 * takes a run takes a batch, too: copies, archives, and the adjoint (adjoint.h). For an
 * objective that is a sum over lanes, its derivatives by x0, p0, masses and dampings are those of each
 * lane, and the derivative by alpha is the sum over all lanes. */
#ifndef FVI_BATCH_H
#define FVI_BATCH_H

#include "trajectory.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* As many runs go together at most. */
enum { FVI_BATCH_MOST = 8 };

typedef struct fvi_batch fvi_batch;

/* fvi_batch_refusal -- why these runs cannot go together by this method; NULL if they can.
 *
 *   method  with steps of a given length
 *   count   1 to FVI_BATCH_MOST
 *   run     count runs of one coordinate each, which each fvi_stepper_start would take
 *
 * They must have the same h, steps, alpha or law, kappa, past, memory and tolerance; with stages
 * also the same mass and damping, on which the accuracy of their memory depends. Either all of them
 * have a potential or none has, either all potentials are quadratic or none is, and either all have a
 * force or none has. Their parameters, functions, starts, masses and dampings may differ. There are
 * no matrices, mechanisms, events or impulses. The text is in English, and lives as long as the program. Cost O(count). */
const char *fvi_batch_refusal(const fvi_method *method, size_t count, const fvi_run *run);

/* fvi_batch_alloc -- make one run of them.
 *
 *   method, count, run  as above. The array is copied; what the runs point to (systems, starts, a
 *          law) must outlive the batch. The params of potentials and forces may not change until then
 *   batch  output; give it back with fvi_batch_free
 *   error  output, or NULL: what is wrong
 *
 * Returns FVI_SUCCESS; FVI_EFAULT if a pointer is NULL; FVI_EINVAL if count is out of range;
 * FVI_EUNSUP with the text of fvi_batch_refusal; FVI_ENOMEM. On error *batch is untouched. */
int fvi_batch_alloc(const fvi_method *method, size_t count, const fvi_run *run, fvi_batch **batch,
                    fvi_error *error);

/* fvi_batch_run -- the run whose coordinate l is run number l; it belongs to the batch. Its steppers
 * must be freed before the batch is.
 *
 * A step fails if it fails in any lane. Which lane it was is not said: run them one by one.
 * Cost of a step of eight by fvi_cq2_midpoint: two and a half steps of one, or three if U is a pendulum, whose sines are
 * called for each lane (figures/blocks/batch_bench.tsv); functions of the caller are called for each lane. */
const fvi_run *fvi_batch_run(const fvi_batch *batch);

/* fvi_batch_free -- give it back. NULL is allowed. */
void fvi_batch_free(fvi_batch *batch);

/* fvi_batch_trajectories -- rows of many runs into arrays, eight runs at a time where they go together.
 *
 *   method, count, run  any number of runs as fvi_stepper_start takes them. Neighbours that go together
 *          (fvi_batch_refusal) do; others go one by one, and so do those of a group in which one fails
 *   rows, row  how many rows, and at which steps they are, increasing and not above `steps` of any run. NULL:
 *          row r is step r. No step is taken behind the last row
 *   x, p   NULL, or an array for each run, which may be NULL: rows d numbers, component i of row r at
 *          [r * d + i]; outputs
 *   status  NULL, or count numbers; output: what became of each run
 *
 * The digits are those of single runs, whatever goes together. The rows of a run that fails are those before the
 * failure; the other runs go on. Cost: that of single runs, or of fvi_batch_run. Example, the last places of 1600
 * runs of 500 steps:
 *
 *     static double end[1600];
 *     double *x[1600];
 *     const size_t last = 500;
 *     for (size_t i = 0; i < 1600; i++)
 *         x[i] = end + i;
 *     status = fvi_batch_trajectories(&fvi_cq2_midpoint, 1600, run, 1, &last, x, NULL, NULL);
 *
 * Returns FVI_SUCCESS; FVI_EFAULT if method or run is NULL; else the status of the first run that failed: what
 * fvi_stepper_start and fvi_stepper_advance_to return. */
int fvi_batch_trajectories(const fvi_method *method, size_t count, const fvi_run *run, size_t rows,
                           const size_t *row, double *const *x, double *const *p, int *status);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
