/* src/petsc/fvi_petsc.c -- A structure on many machines, by PETSc and MPI.  [Chapter 28]
 *
 *     mpirun -n RANKS fvi_petsc -system DIR -alpha A -h H -steps N [-x0 X] [-p0 P] [-o
 *     FILE]
 *
 * runs fvi-stable on M x'' + C D^{2 alpha} x + K x = 0 with the matrices M.mtx, K.mtx and
 * C.mtx of a folder, from x = X and p = P for all unknowns. Each rank has some of the
 * rows, and the library's stepper and memory for them: a memory never asks for another
 * unknown. Ranks exchange numbers in the products with M, K and C and in the conjugate
 * gradients, which are PETSc's and take its options (-pc_type icc, -ksp_monitor, ...).
 * FILE gets x and p at the end, as two vectors in PETSc's binary format (make petsc). */
#include <fvi/convolution_quadrature_methods.h>
#include <fvi/error.h>
#include <fvi/structures.h>
#include <fvi/trajectory.h>

#include <petscksp.h>
#include <petsctime.h>

_Static_assert(sizeof(PetscScalar) == sizeof(double), "PETSc of real doubles");

/* Where the library wants a code; PETSc has said what is wrong. */
#define TRY(call)                                                              \
    do {                                                                       \
        if (call)                                                              \
            return FVI_EBADFUNC;                                               \
    } while (0)

/* The rows of this rank, and two vectors without numbers of their own. */
typedef struct {
    PetscInt all, first, rows;
    Mat M, K, C;
    Vec x, y;
    double *room; /* `rows` numbers */
} share;

/* ---- what the library asks of matrices (system.h) ---- */

//> product
/* y = A x: each rank has its rows of all three, and gets from others what it lacks of x. */
static int product(const share *s, Mat A, const double *x, double *y)
{
    TRY(VecPlaceArray(s->x, x));
    TRY(VecPlaceArray(s->y, y));
    TRY(MatMult(A, s->x, s->y));
    TRY(VecResetArray(s->x));
    TRY(VecResetArray(s->y));
    return FVI_SUCCESS;
}
//< product

static int remember(size_t d, const double *x, const double *from,
                    const void *params, double *z)
{
    (void)params;
    for (size_t i = 0; i < d; i++)
        z[i] = x[i] - from[i];
    return FVI_SUCCESS;
}

static int damp(size_t d, double a, const double *z, const void *params,
                double *p)
{
    const share *s = params;
    const int status = product(s, s->C, z, s->room);
    for (size_t i = 0; i < d && !status; i++)
        p[i] -= a * s->room[i];
    return status;
}

static int stiffness(size_t d, const double *x, const void *params, double *y)
{
    (void)d;
    return product(params, ((const share *)params)->K, x, y);
}

typedef struct {
    share *s;
    KSP gradients;
} factors;

/* Nothing is factorised: m M + c C + k K, and a preconditioner of PETSc's. */
static int factorise(size_t d, double m, double c, double k, const void *params,
                     void **out)
{
    (void)d;
    share *s = (share *)params;
    factors *f = malloc(sizeof *f);
    Mat A;
    if (!f)
        return FVI_ENOMEM;
    *out = f;
    f->s = s;
    TRY(MatDuplicate(s->M, MAT_COPY_VALUES, &A));
    TRY(MatScale(A, m));
    if (c != 0)
        TRY(MatAXPY(A, c, s->C, DIFFERENT_NONZERO_PATTERN));
    if (k != 0)
        TRY(MatAXPY(A, k, s->K, DIFFERENT_NONZERO_PATTERN));
    TRY(KSPCreate(PETSC_COMM_WORLD, &f->gradients));
    TRY(KSPSetOperators(f->gradients, A, A));
    TRY(MatDestroy(&A)); /* the solver keeps it */
    PC jacobi;
    TRY(KSPSetType(f->gradients, KSPCG));
    TRY(KSPGetPC(f->gradients, &jacobi));
    TRY(PCSetType(jacobi, PCJACOBI));
    TRY(KSPSetTolerances(f->gradients, 1e-15, 1e-300, PETSC_DEFAULT, 10000));
    TRY(KSPSetFromOptions(f->gradients));
    return FVI_SUCCESS;
}

static int solve(size_t d, void *of, double *r)
{
    (void)d;
    factors *f = of;
    share *s = f->s;
    KSPConvergedReason reason;
    TRY(VecPlaceArray(s->x, r));
    TRY(KSPSolve(f->gradients, s->x, s->x));
    TRY(VecResetArray(s->x));
    TRY(KSPGetConvergedReason(f->gradients, &reason));
    return reason > 0                              ? FVI_SUCCESS
           : reason == KSP_DIVERGED_INDEFINITE_MAT ? FVI_ESING
                                                   : FVI_EMAXITER;
}

static void forget(void *of)
{
    factors *f = of;
    KSPDestroy(&f->gradients);
    free(f);
}

/* ---- files ---- */

/* Every rank reads the file and keeps its rows, which are columns, as A is symmetric. */
static PetscErrorCode read_matrix(const char *folder, const char *name,
                                  share *s, Mat *A)
{
    char file[PETSC_MAX_PATH_LEN];
    fvi_sparse all;
    fvi_misread wrong = { 0, "no memory" };
    PetscFunctionBeginUser;
    PetscCall(PetscSNPrintf(file, sizeof file, "%s/%s.mtx", folder, name));
    PetscCheck(!fvi_sparse_read(file, &all, &wrong), PETSC_COMM_SELF,
               PETSC_ERR_FILE_UNEXPECTED, "%s, line %zu: %s", file, wrong.line,
               wrong.reason);
    if (s->all == 0) {
        s->all = (PetscInt)all.n;
        s->rows = PETSC_DECIDE;
        PetscCall(PetscSplitOwnership(PETSC_COMM_WORLD, &s->rows, &s->all));
        PetscCallMPI(MPI_Exscan(&s->rows, &s->first, 1, MPIU_INT, MPI_SUM,
                                PETSC_COMM_WORLD));
    }
    PetscCheck(s->all == (PetscInt)all.n, PETSC_COMM_SELF, PETSC_ERR_ARG_SIZ,
               "%s is of another size than M", file);
    const int *start = all.start + s->first;
    const PetscInt count = start[s->rows] - start[0];
    PetscInt *begin, *column;
    PetscCall(PetscMalloc2(s->rows + 1, &begin, count, &column));
    for (PetscInt i = 0; i <= s->rows; i++)
        begin[i] = start[i] - start[0];
    for (PetscInt i = 0; i < count; i++)
        column[i] = all.row[start[0] + i];
    PetscCall(MatCreateMPIAIJWithArrays(PETSC_COMM_WORLD, s->rows, s->rows,
                                        s->all, s->all, begin, column,
                                        all.entry + start[0], A));
    PetscCall(PetscFree2(begin, column));
    fvi_sparse_free(&all);
    PetscFunctionReturn(0);
}

/* Without the file of PETSc's own options beside it, which would forbid other ranks. */
static PetscErrorCode write_vectors(const share *s, const char *file,
                                    const fvi_stepper *run)
{
    PetscViewer out;
    PetscFunctionBeginUser;
    PetscCall(PetscViewerCreate(PETSC_COMM_WORLD, &out));
    PetscCall(PetscViewerSetType(out, PETSCVIEWERBINARY));
    PetscCall(PetscViewerBinarySetSkipInfo(out, PETSC_TRUE));
    PetscCall(PetscViewerFileSetMode(out, FILE_MODE_WRITE));
    PetscCall(PetscViewerFileSetName(out, file));
    for (int i = 0; i < 2; i++) {
        PetscCall(VecPlaceArray(s->x, i == 0 ? run->x : run->p));
        PetscCall(VecView(s->x, out));
        PetscCall(VecResetArray(s->x));
    }
    PetscCall(PetscViewerDestroy(&out));
    PetscFunctionReturn(0);
}

/* ---- the run ---- */

typedef struct {
    char folder[PETSC_MAX_PATH_LEN], file[PETSC_MAX_PATH_LEN];
    PetscReal alpha, h, x0, p0;
    PetscInt steps;
    PetscBool writes; /* -o was given */
} wishes;

static PetscErrorCode ask(wishes *w)
{
    PetscBool named;
    PetscFunctionBeginUser;
    *w = (wishes){ .alpha = 0.5, .h = 0.1, .x0 = 1, .steps = 200 };
    PetscCall(PetscOptionsGetString(NULL, NULL, "-system", w->folder,
                                    sizeof w->folder, &named));
    PetscCheck(named, PETSC_COMM_WORLD, PETSC_ERR_USER,
               "-system DIR is missing");
    PetscCall(PetscOptionsGetString(NULL, NULL, "-o", w->file, sizeof w->file,
                                    &w->writes));
    PetscCall(PetscOptionsGetReal(NULL, NULL, "-alpha", &w->alpha, NULL));
    PetscCall(PetscOptionsGetReal(NULL, NULL, "-h", &w->h, NULL));
    PetscCall(PetscOptionsGetReal(NULL, NULL, "-x0", &w->x0, NULL));
    PetscCall(PetscOptionsGetReal(NULL, NULL, "-p0", &w->p0, NULL));
    PetscCall(PetscOptionsGetInt(NULL, NULL, "-steps", &w->steps, NULL));
    PetscCheck(w->steps >= 1, PETSC_COMM_WORLD, PETSC_ERR_USER,
               "-steps is less than 1");
    PetscFunctionReturn(0);
}

//> run
static PetscErrorCode run(share *s, const wishes *w, double *mass,
                          double *damping, double *x0, double *p0)
{
    const fvi_matrices matrices = { .remembered = (size_t)s->rows,
                                    .remember = remember,
                                    .damp = damp,
                                    .stiffness = stiffness,
                                    .factorise = factorise,
                                    .solve = solve,
                                    .forget = forget,
                                    .params = s };
    const fvi_system system = { .d = (size_t)s->rows,
                                .mass = mass,
                                .damping = damping,
                                .matrices = &matrices };
    fvi_run wish = fvi_run_default(&system, x0, p0, w->h, (size_t)w->steps);
    wish.alpha = w->alpha;
    fvi_stepper *stepper;
    PetscLogDouble begin, end;
    PetscFunctionBeginUser;
    int status = fvi_start(&fvi_stable, &wish, &stepper);
    PetscCheck(!status, PETSC_COMM_SELF, PETSC_ERR_USER, "%s",
               fvi_strerror(status));
    PetscCall(PetscTime(&begin));
    while (!status && stepper->k < (size_t)w->steps)
        status = fvi_step(stepper);
    PetscCall(PetscTime(&end));
    PetscCheck(!status, PETSC_COMM_SELF, PETSC_ERR_USER, "step %zu: %s",
               stepper->k + 1, fvi_strerror(status));
    if (w->writes)
        PetscCall(write_vectors(s, w->file, stepper));
    int ranks;
    PetscCallMPI(MPI_Comm_size(PETSC_COMM_WORLD, &ranks));
    PetscCall(
        PetscPrintf(PETSC_COMM_WORLD,
                    "%d unknowns on %d ranks, %d steps: %.0f ns an unknown "
                    "and step on the wall\n",
                    (int)s->all, ranks, (int)w->steps,
                    1e9 * (end - begin) / w->steps / s->all));
    fvi_stop(stepper);
    PetscFunctionReturn(0);
}
//< run

int main(int argc, char **argv)
{
    static const char *const names[] = { "M", "K", "C" };
    share s = { 0 };
    wishes w;
    double *room;
    PetscFunctionBeginUser;
    PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
    PetscCall(ask(&w));
    Mat *const matrices[] = { &s.M, &s.K, &s.C };
    for (int i = 0; i < 3; i++)
        PetscCall(read_matrix(w.folder, names[i], &s, matrices[i]));
    PetscCall(
        VecCreateMPIWithArray(PETSC_COMM_WORLD, 1, s.rows, s.all, NULL, &s.x));
    PetscCall(VecDuplicate(s.x, &s.y));
    PetscCall(PetscMalloc1(5 * s.rows, &room));
    s.room = room;
    for (PetscInt i = 0; i < s.rows; i++) {
        room[3 * s.rows + i] = w.x0;
        room[4 * s.rows + i] = w.p0;
    }
    for (int i = 0; i < 2; i++) { /* the diagonals of M and C */
        PetscCall(VecPlaceArray(s.x, room + (i + 1) * s.rows));
        PetscCall(MatGetDiagonal(i == 0 ? s.M : s.C, s.x));
        PetscCall(VecResetArray(s.x));
    }
    PetscCall(run(&s, &w, room + s.rows, room + 2 * s.rows, room + 3 * s.rows,
                  room + 4 * s.rows));
    PetscCall(PetscOptionsLeft(NULL)); /* names those that nobody asked for */
    PetscCall(PetscFree(room));
    PetscCall(VecDestroy(&s.x));
    PetscCall(VecDestroy(&s.y));
    for (int i = 0; i < 3; i++)
        PetscCall(MatDestroy(matrices[i]));
    PetscCall(PetscFinalize());
    return 0;
}
