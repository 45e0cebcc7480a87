/* src/petsc/fvi_petsc.c -- Run a structure on many machines with PETSc and MPI.  [H 28]
 *
 *     mpirun -n RANKS fvi_petsc -system DIR | -grid N[,N[,N]]
 *            [-alpha A [-damping C] | -damper_1 'G : LAW [: PAST]' [-damper_2 ...]]
 *            -h H -steps N [-x0 X] [-p0 P] [-o FILE]
 *            [-checkpoint FILE [-stop K] [-resume]]
 *
 * The program runs fvi-stable on M x'' + C D^{2 alpha} x + K x = F(t) from x = X and p = P for all unknowns. Matrices
 * and forces are those of a folder, as for `fvi run --system`, or those of a grid (petsc_share.h). The preset of P is
 * 0. The preset of X is 0 for a folder and 1 for a grid.
 *
 * Several dampers, each with its own matrix, law and past, have the numbers 1, 2, ... in the names of their options,
 * because PETSc keeps only the last of several options with the same name. The texts are those of `fvi run --damper`.
 * For a folder, G is a file or a row like x5-x4; for a grid it is M or K. PETSc takes a word that begins with - and a
 * letter for an option, so write x4-x5 or (-x5+x4).
 *
 * Each rank has some of the rows, and the library's stepper and memory for them, because a memory never needs another
 * unknown. Ranks exchange numbers in the products with M, K and C and in the conjugate gradients, which belong to PETSc
 * and take its options (-pc_type icc, -ksp_monitor, ...). The file of -o gets x and p at the end, as two vectors in
 * PETSc's binary format, which petsc_vectors.py reads. -checkpoint writes the state where the run ends, which is step K
 * with -stop. -resume begins there (make petsc). */
#include "petsc_options.h"
#include "petsc_share.h"

#include <fvi/convolution_quadrature_methods.h>
#include <fvi/error.h>

#include <petsctime.h>

/* Step on from the present state of the stepper, and print how long that took. */
static PetscErrorCode continue_run(const share *s, const petsc_options *w,
                                   fvi_stepper *stepper)
{
    PetscLogDouble begin, end;
    PetscMPIInt ranks;
    int status = 0;
    const size_t first = stepper->k;
    PetscFunctionBeginUser;
    PetscCheck(first < (size_t)w->stop, PETSC_COMM_WORLD, PETSC_ERR_USER,
               "step %zu has been reached before", first);
    PetscCall(PetscTime(&begin));
    while (!status && stepper->k < (size_t)w->stop)
        status = fvi_stepper_step(stepper);
    PetscCall(PetscTime(&end));
    PetscCheck(!status, PETSC_COMM_SELF, PETSC_ERR_USER, "step %zu: %s",
               stepper->k + 1, fvi_error_name(status));
    PetscCallMPI(MPI_Comm_size(PETSC_COMM_WORLD, &ranks));
    PetscCall(PetscPrintf(PETSC_COMM_WORLD,
                          "%d unknowns on %d ranks, %d steps: %.0f ns an "
                          "unknown and step on the wall\n",
                          (int)s->all, ranks, (int)(w->stop - (PetscInt)first),
                          1e9 * (end - begin) / (double)(stepper->k - first)
                              / s->all));
    PetscFunctionReturn(0);
}

//> run
static PetscErrorCode run(const share *s, const petsc_options *w, const double *mass,
                          const double *damping, const double *x0,
                          const double *p0)
{
    const fvi_matrices matrices = petsc_matrices(s);
    const fvi_system system = { .d = (size_t)s->rows,
                                .mass = mass,
                                .damping = damping,
                                .force = s->force,
                                .matrices = &matrices,
                                .mechanism = s->mechanism };
    fvi_run wish = fvi_run_default(&system, x0, p0, w->h, (size_t)w->steps);
    wish.alpha = w->alpha;
    fvi_stepper *stepper;
    fvi_error error = { 0 };
    PetscFunctionBeginUser;
    const int status = fvi_stepper_start(&fvi_cq2_midpoint, &wish, &stepper,
                                         &error);
    error.code = status;
    if (status)
        PetscCall(petsc_refuse(&error));
    if (w->resumes)
        PetscCall(petsc_load(s, w->checkpoint, stepper));
    PetscCall(continue_run(s, w, stepper));
    if (w->saves)
        PetscCall(petsc_save(s, w->checkpoint, stepper));
    if (w->writes)
        PetscCall(petsc_write(s, w->file, stepper));
    fvi_stepper_free(stepper);
    PetscFunctionReturn(0);
}
//< run

int main(int argc, char **argv)
{
    share s = { 0 };
    petsc_options w;
    double *room;
    PetscFunctionBeginUser;
    PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
    PetscCall(petsc_read_options(&w));
    if (w.has_grid)
        PetscCall(petsc_of_grid(w.lengths, w.n, w.damping, w.dampers, w.damper, &s));
    else
        PetscCall(petsc_of_files(w.folder, w.h * (double)w.steps, w.dampers, w.damper, &s));
    PetscCall(VecDuplicate(s.x, &s.y));
    PetscCall(PetscCalloc1(5 * s.rows, &room));
    s.room = room;
    for (PetscInt i = 0; i < s.rows; i++) {
        room[3 * s.rows + i] = w.x0;
        room[4 * s.rows + i] = w.p0;
    }
    for (int i = 0; i < (s.C ? 2 : 1); i++) { /* the diagonals of M and C */
        PetscCall(VecPlaceArray(s.x, room + (i + 1) * s.rows));
        PetscCall(MatGetDiagonal(i == 0 ? s.M : s.C, s.x));
        PetscCall(VecResetArray(s.x));
    }
    PetscCall(run(&s, &w, room + s.rows, room + 2 * s.rows, room + 3 * s.rows,
                  room + 4 * s.rows));
    PetscCall(PetscOptionsLeft(NULL)); /* names the options that nobody has read */
    PetscCall(PetscFree(room));
    PetscCall(petsc_free_share(&s));
    PetscCall(petsc_free_options(&w));
    PetscCall(PetscFinalize());
    return 0;
}
