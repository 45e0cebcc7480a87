/* src/adjoint/checkpointing.c -- Read a trajectory from its end, with checkpoints. [H 23] */
#include "checkpointing.h"

#include "methods/lobatto_matrices.h"
#include "methods/lobatto_stages.h"
#include "system/fail.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

struct fvi_checkpointing {
    size_t d, length; /* length: steps of a piece; all steps if the rows are the caller's */
    size_t piece;     /* the piece whose rows are there */
    size_t steps;     /* of the run */
    size_t per;       /* rows of a step: its end, and the stages that are kept before it */
    size_t first;    /* 1 if the first stage is kept, too, because it is not x_k */
    const double *x; /* the rows of the piece */
    double *rows, *p; /* rows: owned, or NULL if x is the caller's; p: p_N */
    size_t copies;    /* the copies of the stepper, one at the beginning of each piece but the last */
    fvi_stepper **at; /* a copy becomes NULL when it has been used */
};

void fvi_checkpointing_free(fvi_checkpointing *b)
{
    if (!b)
        return;
    for (size_t i = 0; i < b->copies; i++)
        fvi_stepper_free(b->at[i]);
    free(b->at);
    free(b->rows);
    free(b->p);
    free(b);
}

//> length
/* The length L of a piece. L steps need L rows, and the other pieces need N/L copies of the stepper, each as large as r
 * rows. The sum is least at L = sqrt(r N). If a copy is larger than the whole path, there is one piece. */
static size_t piece_length(const fvi_run *run)
{
    const size_t d = run->system->d;
    const fvi_run_damper of = fvi_run_damper_of(run, 0);
    const double bytes = (double)fvi_history_bytes(fvi_run_damper_bytes_order(&of), d,
                                                   run->steps, run->memory,
                                                   run->tolerance);
    const double rows = 32 + bytes / (double)(d * sizeof(double));
    const double L = ceil(sqrt(rows * (double)run->steps));
    return L < (double)run->steps ? (size_t)L : run->steps;
}
//< length

/* Keep the rows that the last step adds behind the row at `row`. For a structure these are the velocities of all stages
 * but the last one, which follows from x_{k+1}. */
static void store_rows(const fvi_checkpointing *b, const fvi_stepper *s, double *row)
{
    const size_t d = b->d;
    const fvi_lobatto_matrices *m = b->per > 1 ? fvi_lobatto_matrices_of(s) : NULL;
    const fvi_lobatto_stages *o = b->per > 1 ? s->method_state : NULL;
    if (m) {
        memcpy(row + d, m->V, (b->per - 1) * d * sizeof *row);
        memcpy(row + b->per * d, s->x, d * sizeof *row);
        return;
    }
    for (size_t i = 1; i < b->per; i++)
        for (size_t j = 0; j < d; j++)
            row[i * d + j] = row[j] + o->dX[(i - b->first) * d + j];
    memcpy(row + b->per * d, s->x, d * sizeof *row);
}

/* Run from the node of s to the end of its piece, and keep the rows. */
static int run_piece(fvi_checkpointing *b, fvi_stepper *s)
{
    const size_t first = s->k;
    const size_t last =
        b->steps - first > b->length ? first + b->length : b->steps;
    int status = FVI_SUCCESS;
    memcpy(b->rows, s->x, b->d * sizeof *b->rows);
    while (!status && s->k < last) {
        double *row = b->rows + (s->k - first) * b->per * b->d;
        status = fvi_stepper_step(s);
        if (!status)
            store_rows(b, s, row);
    }
    b->piece = first / b->length;
    return status;
}

/* Run all pieces, and copy the stepper at the beginning of each piece that will be run again. */
static int run_all(fvi_checkpointing *b, fvi_stepper *s)
{
    int status = FVI_SUCCESS;
    while (!status && s->k < b->steps) {
        if (b->steps - s->k > b->length) {
            status = fvi_stepper_copy(s, &b->at[b->copies]);
            b->copies += !status;
        }
        if (!status)
            status = run_piece(b, s);
    }
    memcpy(b->p, s->p, b->d * sizeof *b->p);
    return status;
}

static int make_path(const fvi_method *method, const fvi_run *run,
                     fvi_checkpointing *b)
{
    fvi_stepper *s;
    b->length = piece_length(run);
    const size_t pieces = (b->steps - 1) / b->length + 1;
    if (b->length >= SIZE_MAX / sizeof(double) / b->d / b->per)
        FVI_FAIL("steps must be addressable", FVI_EINVAL);
    b->rows = malloc((b->length * b->per + 1) * b->d * sizeof *b->rows);
    b->at = calloc(pieces, sizeof *b->at);
    if (!b->rows || !b->at)
        FVI_FAIL("no memory for the path", FVI_ENOMEM);
    b->x = b->rows;
    int status = fvi_stepper_start(method, run, &s, NULL);
    if (status)
        return status;
    status = run_all(b, s);
    fvi_stepper_free(s);
    return status;
}

int fvi_checkpointing_alloc(const fvi_method *method, const fvi_run *run,
                       const double *x, const double *p,
                       fvi_checkpointing **backward)
{
    const size_t d = run->system->d;
    fvi_checkpointing *b = calloc(1, sizeof *b);
    if (b)
        b->p = malloc(d * sizeof *b->p);
    if (!b || !b->p) {
        fvi_checkpointing_free(b);
        FVI_FAIL("no memory for the path", FVI_ENOMEM);
    }
    b->d = d;
    b->steps = b->length = run->steps;
    b->first = method->damped_inertia != 0;
    b->per = method->scheme == FVI_SCHEME_LOBATTO
                 ? (size_t)method->stages - 1 + b->first
                 : 1;
    b->x = x;
    if (x)
        memcpy(b->p, p, d * sizeof *p);
    int status = x ? FVI_SUCCESS : make_path(method, run, b);
    if (status)
        fvi_checkpointing_free(b);
    else
        *backward = b;
    return status;
}

const double *fvi_checkpointing_momentum(const fvi_checkpointing *b)
{
    return b->p;
}

/* Run the piece again that contains step k. It is not inlined, so that a step within the current piece saves no
 * registers for it. */
__attribute__((noinline)) static int run_earlier_piece(fvi_checkpointing *b, size_t k)
{
    const size_t piece = k / b->length;
    const int status = run_piece(b, b->at[piece]);
    fvi_stepper_free(b->at[piece]);
    b->at[piece] = NULL;
    return status;
}

int fvi_checkpointing_step(fvi_checkpointing *b, size_t k, const double **rows)
{
    const int status = k < b->piece * b->length ? run_earlier_piece(b, k) : FVI_SUCCESS;
    *rows = b->x + (k - b->piece * b->length) * b->per * b->d;
    return status;
}

size_t fvi_checkpointing_first(const fvi_checkpointing *b)
{
    return b->piece * b->length;
}
