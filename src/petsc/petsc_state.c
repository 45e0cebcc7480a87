/* src/petsc/petsc_state.c -- Write the results and the state of a run to files, and read the state. [H 28] */
#include "output/fvi_output.h"
#include "petsc_share.h"

#include <errno.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* PETSc would write a file with its options beside the result, which would forbid another number of ranks; it is left
 * out. */
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

/* A file has four parts: this head, a head for each of several dampers with its kernel, the pieces that
 * fvi_stepper_archive lists, and the checksum of everything before it. */
typedef struct {
    char mark[16];
    PetscInt ranks, rank, all, first;
    uint64_t steps;
    double h, alpha;
    double norms[3]; /* Frobenius norms of M, K and C */
} head;

/* The head of one of several dampers: its number, how many there are, the norm of its matrix, its past, and how many
 * terms its kernel has. After it come the kinds and numbers of these terms or, for a function, its values at some s. */
enum { VALUES = 8, KINDS_AND_NUMBERS = 5 };
typedef struct {
    uint64_t number, count, terms, past;
    double norm; /* Frobenius norm of C_j */
} damper_head;

typedef struct {
    fvi_archive archive; /* the first member, so that a pointer to it is also a pointer to the state */
    FILE *file;
    uint64_t sum;
    double *room; /* room for what is compared, `bytes` long */
    size_t bytes;
    char part[60]; /* the part that differs, while a file is compared */
} state;

/* The hash is FNV-1a with 64 bits. */
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
    memset(h, 0, sizeof *h); /* also the padding between the numbers */
    strcpy(h->mark, s->mechanism ? "fvi_petsc 2" : "fvi_petsc 1");
    h->ranks = ranks;
    h->rank = rank;
    h->all = s->all;
    h->first = s->first;
    h->steps = run->run.steps;
    h->h = run->run.h;
    h->alpha = s->mechanism ? 0 : run->run.alpha; /* dampers do not read alpha */
    for (int l = 0; l < 3; l++)
        if (A[l])
            PetscCall(MatNorm(A[l], NORM_FROBENIUS, &h->norms[l]));
    PetscFunctionReturn(0);
}

/* Make the heads of all dampers. All ranks must call it, because they compute the norms together. */
static PetscErrorCode make_damper_heads(const share *s, damper_head **heads)
{
    const size_t count = s->mechanism ? s->mechanism->damper_count : 0;
    PetscFunctionBeginUser;
    PetscCall(PetscCalloc1(count + 1, heads));
    for (size_t j = 0; j < count; j++) {
        const fvi_damper *damper = s->mechanism->damper + j;
        damper_head *h = *heads + j;
        *h = (damper_head){ .number = j + 1,
                            .count = count,
                            .terms = damper->kernel->count,
                            .past = damper->past };
        PetscCall(MatNorm(s->damper_matrices[j], NORM_FROBENIUS, &h->norm));
    }
    PetscFunctionReturn(0);
}

/* Archive the kinds and numbers of a kernel, and the values of a function, which has no numbers. */
static int serialize_kernel(const fvi_kernel *kernel, fvi_archive *v)
{
    int status = 0;
    for (size_t i = 0; !status && i < kernel->count; i++) {
        const fvi_kernel_term *t = kernel->term + i;
        double numbers[KINDS_AND_NUMBERS + VALUES] = { (double)t->kind, t->rho, t->alpha,
                                                       t->time, t->end };
        if (t->kind == FVI_KERNEL_SYMBOL)
            for (int l = 0; l < VALUES; l++)
                numbers[KINDS_AND_NUMBERS + l] = fvi_kernel_symbol(kernel, pow(7, l - 3));
        status = v->serialize(v, numbers, sizeof numbers, 1);
    }
    return status;
}

static int serialize_dampers(const share *s, damper_head *heads, state *f)
{
    int status = 0;
    for (size_t j = 0; s->mechanism && !status && j < s->mechanism->damper_count; j++) {
        snprintf(f->part, sizeof f->part, "another damper %zu", j + 1);
        status = f->archive.serialize(&f->archive, heads + j, sizeof *heads, 1);
        if (!status)
            status = serialize_kernel(s->mechanism->damper[j].kernel, &f->archive);
    }
    return status;
}

/* Archive everything except the checksum. */
static int serialize(const share *s, head *h, damper_head *dampers, fvi_stepper *run, state *f)
{
    snprintf(f->part, sizeof f->part, "other matrices, numbers or ranks");
    int status = f->archive.serialize(&f->archive, h, sizeof *h, 1);
    if (!status)
        status = serialize_dampers(s, dampers, f);
    if (status)
        return status;
    snprintf(f->part, sizeof f->part, "another start, or another kernel");
    return fvi_stepper_archive(run, &f->archive);
}

/* Write the file of a rank, without giving it its name. Return NULL if that fails. */
static FILE *write_state(const char *name, const share *s, head *h, damper_head *dampers,
                         fvi_stepper *run)
{
    state f = { .archive = { save_piece },
                .file = fvi_output_open_file(name) };
    if (!f.file)
        return NULL;
    if (serialize(s, h, dampers, run, &f) == 0
        && fwrite(&f.sum, sizeof f.sum, 1, f.file) == 1 && fflush(f.file) == 0)
        return f.file;
    fvi_output_close(f.file, 0);
    return NULL;
}

/* Return nonzero if the last number of the file is the checksum of everything before it. The file is then at its
 * beginning. */
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

/* Load a file. `why` becomes "" or the reason why that is not possible. The run changes only if the file is whole. */
static void load(const char *name, const share *s, head *h, damper_head *dampers,
                 fvi_stepper *run, char *why, size_t size)
{
    state f = { .archive = { load_piece }, .file = fopen(name, "rb") };
    uint64_t sum;
    snprintf(why, size, "%s", f.file ? "" : strerror(errno));
    if (!f.file)
        return;
    if (!is_whole(f.file))
        snprintf(why, size, "it is not whole");
    else if (serialize(s, h, dampers, run, &f) || fread(&sum, sizeof sum, 1, f.file) != 1
             || fgetc(f.file) != EOF)
        snprintf(why, size, "it is of %s", f.part);
    fclose(f.file);
    free(f.room);
}

PetscErrorCode petsc_save(const share *s, const char *file, fvi_stepper *run)
{
    char name[PETSC_MAX_PATH_LEN];
    head h;
    damper_head *dampers;
    PetscFunctionBeginUser;
    PetscCall(make_head(s, run, &h));
    PetscCall(make_damper_heads(s, &dampers));
    PetscCall(PetscSNPrintf(name, sizeof name, "%s.%d", file, (int)h.rank));
    FILE *written = write_state(name, s, &h, dampers, run);
    PetscCall(PetscFree(dampers));
    PetscCheck(written, PETSC_COMM_SELF, PETSC_ERR_FILE_WRITE,
               "%s cannot be written", name);
    PetscCallMPI(MPI_Barrier(PETSC_COMM_WORLD));
    PetscCheck(fvi_output_close(written, 1) == 0, PETSC_COMM_SELF,
               PETSC_ERR_FILE_WRITE, "%s cannot be written", name);
    PetscFunctionReturn(0);
}

/* If ranks were ended while they renamed their files, the files may be of different steps, which is refused. */
PetscErrorCode petsc_load(const share *s, const char *file, fvi_stepper *run)
{
    char name[PETSC_MAX_PATH_LEN], why[100];
    head h;
    damper_head *dampers;
    PetscFunctionBeginUser;
    PetscCall(make_head(s, run, &h));
    PetscCall(make_damper_heads(s, &dampers));
    PetscCall(PetscSNPrintf(name, sizeof name, "%s.%d", file, (int)h.rank));
    load(name, s, &h, dampers, run, why, sizeof why);
    PetscCall(PetscFree(dampers));
    PetscCheck(!*why, PETSC_COMM_SELF, PETSC_ERR_FILE_UNEXPECTED,
               "%s is not the state of such a run: %s", name, why);
    PetscInt k[2] = { (PetscInt)run->k, -(PetscInt)run->k }, most[2];
    PetscCallMPI(
        MPI_Allreduce(k, most, 2, MPIU_INT, MPI_MAX, PETSC_COMM_WORLD));
    PetscCheck(most[0] == -most[1], PETSC_COMM_WORLD, PETSC_ERR_FILE_UNEXPECTED,
               "%s.*: not all of one step", file);
    PetscFunctionReturn(0);
}
