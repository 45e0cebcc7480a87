/* src/fvi/batch.h -- Up to eight runs of one oscillator as one run.                          [H 28]
 *
 * A sweep, a picture of basins, or a fit makes many runs of one oscillator that differ in their start, in the amplitude
 * of a force or in a parameter of the potential. Up to eight of them can be the coordinates of one run, its **lanes**.
 * The lanes share the weights and modes of the memory, and each operation of a step is one vector instruction for all
 * of them:
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
 * The digits of a lane, x[l] and p[l], are those of its own run, whatever the other lanes are. Every function that
 * takes a run takes a batch, too: copies, archives, and the adjoint (adjoint.h). If the objective of an adjoint is a
 * sum over lanes, its derivatives by x0, p0, masses and dampings are those of each lane, and the derivative by alpha is
 * the sum over all lanes. */
#ifndef FVI_BATCH_H
#define FVI_BATCH_H

#include "trajectory.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* The largest number of runs in a batch. */
enum { FVI_BATCH_MOST = 8 };

typedef struct fvi_batch fvi_batch;

/* fvi_batch_refusal -- return the reason why these runs cannot go together by this method, or NULL if they can.
 *
 *   method  a method whose steps have one length, not fvi_variable_step
 *   count   1 to FVI_BATCH_MOST
 *   run     an array of `count` runs of one coordinate each. fvi_stepper_start must take each of them
 *
 * The runs must have the same h, steps, alpha or law, kappa, past, memory and tolerance. With stages they must also
 * have the same mass and damping, because the accuracy of their memory depends on them. Either all runs have a
 * potential or none has, either all potentials are quadratic or none is, either all Hessians are bands or none is
 * (`diagonals`), and either all runs have a force or none has. Parameters, functions, starts, masses and dampings may
 * differ. Matrices, mechanisms, events, impulses, potentials with `solve`, and runs that are batches themselves are
 * refused.
 *
 *     const char *reason = fvi_batch_refusal(&fvi_cq2_midpoint, 8, run);
 *     if (reason)
 *         fprintf(stderr, "one by one, because %s\n", reason);
 *
 * The text is in English and static. A null pointer and a wrong count are reasons, too. Cost O(count). */
const char *fvi_batch_refusal(const fvi_method *method, size_t count, const fvi_run *run);

/* fvi_batch_alloc -- make one run of up to eight runs.
 *
 *   method, count, run  as for fvi_batch_refusal. The array is copied. Everything that the runs point to (systems,
 *          starts, a law) must outlive the batch, and the params of potentials and forces must not change until it is
 *          freed
 *   batch  output; free it with fvi_batch_free
 *   error  output, or NULL: what is wrong
 *
 * Cost O(count). Returns FVI_SUCCESS; FVI_EFAULT if method, run or batch is NULL; FVI_EINVAL if count is out of range;
 * FVI_EUNSUP, with the text of fvi_batch_refusal, if the runs cannot go together; FVI_ENOMEM. On error *batch is
 * untouched. For an example see the head of this file. */
int fvi_batch_alloc(const fvi_method *method, size_t count, const fvi_run *run, fvi_batch **batch,
                    fvi_error *error);

/* fvi_batch_run -- return the run whose coordinate l is run number l. It belongs to the batch. Free its steppers before
 * the batch.
 *
 * A step fails if it fails in any lane. To find the lane, make the runs one by one.
 * Cost of a step of eight lanes by fvi_cq2_midpoint: that of two and a half steps of one run, or of three if U is a
 * pendulum, whose sines are computed one by one (figures/blocks/batch_bench.tsv). Functions of the caller are called
 * once for each lane. */
const fvi_run *fvi_batch_run(const fvi_batch *batch);

/* fvi_batch_free -- free a batch. NULL is allowed. */
void fvi_batch_free(fvi_batch *batch);

/* fvi_batch_trajectories -- write rows of many runs into arrays, and make eight runs at a time where they go together.
 *
 *   method, count, run  any number of runs, each as fvi_stepper_start takes it. Runs that stand one after another in
 *          the array and can go together (fvi_batch_refusal) do so. All others are made one by one, and so is each run
 *          of a group in which one run fails
 *   rows, row  the number of rows, and the steps at which they are: increasing numbers, none above `steps` of any run.
 *          row = NULL: row r is step r. No step is made after the last row
 *   x, p   outputs, owned by the caller: NULL, or an array for each run, which may be NULL. Component i of row r is at
 *          [r * d + i], so an array has rows * d numbers
 *   status  output: NULL, or count numbers: for each run FVI_SUCCESS or why it failed
 *
 * The digits are those of single runs, whatever goes together. If a run fails, its rows before the failure are written,
 * and the other runs go on. Cost: that of single runs, or of fvi_batch_run. For example, the last positions of 1600
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
