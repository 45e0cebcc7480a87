/* src/petsc/petsc_state.c -- What a run leaves in files.                 [H 28] */
#include "output/fvi_output.h"
#include "petsc_share.h"

#include <stdint.h>
#include <stdio.h>
#include <string.h>

/* Without the file of PETSc's own options beside it, which would forbid other ranks. */
PetscErrorCode petsc_write(const share *s, const char *file,
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

/* ---- the state ---- */

/* A file is a head, the pieces that fvi_stepper_archive shows, and the sum of all before. */
typedef struct {
    char mark[16];
    PetscInt ranks, rank, all, first;
    uint64_t steps;
    double h, alpha;
    double norms[3]; /* Frobenius, of M, K and C */
} head;

typedef struct {
    fvi_archive archive; /* the first: a pointer to it is one to this */
    FILE *file;
    uint64_t sum;
    double *room; /* what is compared, `bytes` of it */
    size_t bytes;
} state;

/* FNV-1a. */
static void add_to_sum(state *f, const void *data, size_t bytes)
{
    const unsigned char *at = data;
    for (size_t i = 0; i < bytes; i++)
        f->sum = (f->sum ^ at[i]) * 0x100000001b3u;
}

static int save_piece(fvi_archive *v, void *data, size_t bytes, int constant)
{
    state *f = (state *)v;
    (void)constant;
    add_to_sum(f, data, bytes);
    return fwrite(data, 1, bytes, f->file) == bytes ? 0 : -1;
}

static int load_piece(fvi_archive *v, void *data, size_t bytes, int constant)
{
    state *f = (state *)v;
    void *to = data;
    if (constant && f->bytes < bytes) {
        free(f->room);
        f->room = malloc(bytes);
        f->bytes = f->room ? bytes : 0;
    }
    if (constant)
        to = f->room;
    if (!to || fread(to, 1, bytes, f->file) != bytes)
        return -1;
    add_to_sum(f, to, bytes);
    return constant && memcmp(to, data, bytes) != 0 ? -1 : 0;
}

static PetscErrorCode make_head(const share *s, const fvi_stepper *run, head *h)
{
    const Mat A[] = { s->M, s->K, s->C };
    PetscMPIInt ranks, rank;
    PetscFunctionBeginUser;
    PetscCallMPI(MPI_Comm_size(PETSC_COMM_WORLD, &ranks));
    PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
    memset(h, 0, sizeof *h); /* what lies between the numbers, too */
    strcpy(h->mark, "fvi_petsc 1");
    h->ranks = ranks;
    h->rank = rank;
    h->all = s->all;
    h->first = s->first;
    h->steps = run->run.steps;
    h->h = run->run.h;
    h->alpha = run->run.alpha;
    for (int l = 0; l < 3; l++)
        if (A[l])
            PetscCall(MatNorm(A[l], NORM_FROBENIUS, &h->norms[l]));
    PetscFunctionReturn(0);
}

/* The file of a rank, written but not yet under its name; NULL if that fails. */
static FILE *write_state(const char *name, head *h, fvi_stepper *run)
{
    state f = { .archive = { save_piece },
                .file = fvi_output_open_file(name) };
    if (!f.file)
        return NULL;
    if (save_piece(&f.archive, h, sizeof *h, 0) == 0
        && fvi_stepper_archive(run, &f.archive) == 0
        && fwrite(&f.sum, sizeof f.sum, 1, f.file) == 1 && fflush(f.file) == 0)
        return f.file;
    fvi_output_close(f.file, 0);
    return NULL;
}

/* Is the last number of the file the sum of all before? The file is at its start then. */
static int is_whole(FILE *file)
{
    state f = { .file = file };
    unsigned char part[4096];
    uint64_t sum;
    long left = fseek(file, 0, SEEK_END) ? -1 : ftell(file);
    rewind(file);
    left -= (long)sizeof sum;
    for (size_t n; left > 0; left -= (long)n) {
        n = left < (long)sizeof part ? (size_t)left : sizeof part;
        if (fread(part, 1, n, file) != n)
            return 0;
        add_to_sum(&f, part, n);
    }
    return left == 0 && fread(&sum, sizeof sum, 1, file) == 1 && sum == f.sum
           && fseek(file, 0, SEEK_SET) == 0;
}

/* Zero if all goes well. The run is changed only by a file that is whole. */
static int load(const char *name, head *h, fvi_stepper *run)
{
    state f = { .archive = { load_piece }, .file = fopen(name, "rb") };
    uint64_t sum;
    if (!f.file)
        return 1;
    const int failed = !is_whole(f.file)
                       || load_piece(&f.archive, h, sizeof *h, 1)
                       || fvi_stepper_archive(run, &f.archive)
                       || fread(&sum, sizeof sum, 1, f.file) != 1
                       || fgetc(f.file) != EOF;
    fclose(f.file);
    free(f.room);
    return failed;
}

PetscErrorCode petsc_save(const share *s, const char *file, fvi_stepper *run)
{
    char name[PETSC_MAX_PATH_LEN];
    head h;
    PetscFunctionBeginUser;
    PetscCall(make_head(s, run, &h));
    PetscCall(PetscSNPrintf(name, sizeof name, "%s.%d", file, (int)h.rank));
    FILE *written = write_state(name, &h, run);
    PetscCheck(written, PETSC_COMM_SELF, PETSC_ERR_FILE_WRITE,
               "%s cannot be written", name);
    PetscCallMPI(MPI_Barrier(PETSC_COMM_WORLD));
    PetscCheck(fvi_output_close(written, 1) == 0, PETSC_COMM_SELF,
               PETSC_ERR_FILE_WRITE, "%s cannot be written", name);
    PetscFunctionReturn(0);
}

/* Ranks that were ended between two files may have left steps that differ. */
PetscErrorCode petsc_load(const share *s, const char *file, fvi_stepper *run)
{
    char name[PETSC_MAX_PATH_LEN];
    head h;
    PetscFunctionBeginUser;
    PetscCall(make_head(s, run, &h));
    PetscCall(PetscSNPrintf(name, sizeof name, "%s.%d", file, (int)h.rank));
    PetscCheck(!load(name, &h, run), PETSC_COMM_SELF, PETSC_ERR_FILE_UNEXPECTED,
               "%s is not the state of such a run", name);
    PetscInt k[2] = { (PetscInt)run->k, -(PetscInt)run->k }, most[2];
    PetscCallMPI(
        MPI_Allreduce(k, most, 2, MPIU_INT, MPI_MAX, PETSC_COMM_WORLD));
    PetscCheck(most[0] == -most[1], PETSC_COMM_WORLD, PETSC_ERR_FILE_UNEXPECTED,
               "%s.*: not all of one step", file);
    PetscFunctionReturn(0);
}
