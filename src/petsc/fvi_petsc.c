/* src/petsc/fvi_petsc.c -- A structure on many machines, by PETSc and MPI.  [H 28]
 *
 *     mpirun -n RANKS fvi_petsc -system DIR | -grid N[,N[,N]] [-damping C]
 *            -alpha A -h H -steps N [-x0 X] [-p0 P] [-o FILE]
 *            [-checkpoint FILE [-stop K] [-resume]]
 *
 * runs fvi-stable on M x'' + C D^{2 alpha} x + K x = F(t) from x = X and p = P for all
 * unknowns: with the matrices and forces of a folder, as `fvi run --system`, or on a grid
 * (petsc_share.h). If they are not given, P is 0, and X is 0 of a folder and 1 of a grid.
 * Each rank has some of the rows, and the library's stepper and memory for them: a memory
 * never asks for another unknown. Ranks exchange numbers in the products with M, K and C and
 * in the conjugate gradients, which are PETSc's and take its options
 * (-pc_type icc, -ksp_monitor, ...). FILE of -o gets x and p at the end, as two vectors in
 * PETSc's binary format, which petsc_vectors.py reads. -checkpoint writes the state where
 * the run ends, at step K if -stop says so; -resume begins there (make petsc). */
#include "petsc_share.h"

#include <fvi/convolution_quadrature_methods.h>
#include <fvi/error.h>

#include <petsctime.h>

typedef struct {
    char folder[PETSC_MAX_PATH_LEN], file[PETSC_MAX_PATH_LEN],
        checkpoint[PETSC_MAX_PATH_LEN];
    PetscReal alpha, h, x0, p0, damping;
    PetscInt steps, stop, lengths, n[3];
    PetscBool has_folder, has_grid, has_damping, writes, saves, stops, resumes;
} wishes;

static PetscErrorCode read_words(wishes *w)
{
    PetscFunctionBeginUser;
    PetscCall(PetscOptionsGetString(NULL, NULL, "-system", w->folder,
                                    sizeof w->folder, &w->has_folder));
    if (w->has_folder)
        w->x0 = 0; /* at rest, as `fvi run --system` */
    w->lengths = 3;
    PetscCall(PetscOptionsGetIntArray(NULL, NULL, "-grid", w->n, &w->lengths,
                                      &w->has_grid));
    PetscCall(PetscOptionsGetReal(NULL, NULL, "-damping", &w->damping,
                                  &w->has_damping));
    PetscCall(PetscOptionsGetString(NULL, NULL, "-o", w->file, sizeof w->file,
                                    &w->writes));
    PetscCall(PetscOptionsGetString(NULL, NULL, "-checkpoint", w->checkpoint,
                                    sizeof w->checkpoint, &w->saves));
    PetscCall(PetscOptionsGetBool(NULL, NULL, "-resume", &w->resumes, NULL));
    PetscCall(PetscOptionsGetReal(NULL, NULL, "-alpha", &w->alpha, NULL));
    PetscCall(PetscOptionsGetReal(NULL, NULL, "-h", &w->h, NULL));
    PetscCall(PetscOptionsGetReal(NULL, NULL, "-x0", &w->x0, NULL));
    PetscCall(PetscOptionsGetReal(NULL, NULL, "-p0", &w->p0, NULL));
    PetscCall(PetscOptionsGetInt(NULL, NULL, "-steps", &w->steps, NULL));
    PetscCall(PetscOptionsGetInt(NULL, NULL, "-stop", &w->stop, &w->stops));
    PetscFunctionReturn(0);
}

static PetscErrorCode ask(wishes *w)
{
    PetscFunctionBeginUser;
    *w = (wishes){ .alpha = 0.5,
                   .h = 0.1,
                   .x0 = 1,
                   .steps = 200,
                   .damping = 0.01,
                   .n = { 1, 1, 1 } };
    PetscCall(read_words(w));
    PetscCheck(w->has_folder != w->has_grid, PETSC_COMM_WORLD, PETSC_ERR_USER,
               "one of -system DIR and -grid N,N is wanted");
    PetscCheck(!w->has_grid
                   || (w->lengths >= 1 && w->n[0] >= 1 && w->n[1] >= 1
                       && w->n[2] >= 1),
               PETSC_COMM_WORLD, PETSC_ERR_USER, "-grid has a length below 1");
    PetscCheck(w->damping >= 0, PETSC_COMM_WORLD, PETSC_ERR_USER,
               "-damping is negative");
    PetscCheck(w->has_grid || !w->has_damping, PETSC_COMM_WORLD, PETSC_ERR_USER,
               "-damping is that of a grid; a folder has C.mtx");
    PetscCheck(w->steps >= 1, PETSC_COMM_WORLD, PETSC_ERR_USER,
               "-steps is less than 1");
    PetscCheck(w->saves || (!w->stops && !w->resumes), PETSC_COMM_WORLD,
               PETSC_ERR_USER, "-stop and -resume want -checkpoint FILE");
    w->stop = w->stops ? w->stop : w->steps;
    PetscCheck(w->stop >= 1 && w->stop <= w->steps, PETSC_COMM_WORLD,
               PETSC_ERR_USER, "-stop is not from 1 to the number of steps");
    PetscFunctionReturn(0);
}

/* From where the stepper is; what it took is said. */
static PetscErrorCode go_on(const share *s, const wishes *w,
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
static PetscErrorCode run(const share *s, const wishes *w, const double *mass,
                          const double *damping, const double *x0,
                          const double *p0)
{
    const fvi_matrices matrices = petsc_matrices(s);
    const fvi_system system = { .d = (size_t)s->rows,
                                .mass = mass,
                                .damping = damping,
                                .force = s->force,
                                .matrices = &matrices };
    fvi_run wish = fvi_run_default(&system, x0, p0, w->h, (size_t)w->steps);
    wish.alpha = w->alpha;
    fvi_stepper *stepper;
    PetscFunctionBeginUser;
    const int status = fvi_stepper_start(&fvi_cq2_midpoint, &wish, &stepper,
                                         NULL);
    PetscCheck(!status, PETSC_COMM_SELF, PETSC_ERR_USER, "%s",
               fvi_error_name(status));
    if (w->resumes)
        PetscCall(petsc_load(s, w->checkpoint, stepper));
    PetscCall(go_on(s, w, stepper));
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
    wishes w;
    double *room;
    PetscFunctionBeginUser;
    PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
    PetscCall(ask(&w));
    if (w.has_grid)
        PetscCall(petsc_of_grid(w.lengths, w.n, w.damping, &s));
    else
        PetscCall(petsc_of_files(w.folder, w.h * (double)w.steps, &s));
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
    PetscCall(PetscOptionsLeft(NULL)); /* names those that nobody asked for */
    PetscCall(PetscFree(room));
    PetscCall(petsc_forget(&s));
    PetscCall(PetscFinalize());
    return 0;
}
