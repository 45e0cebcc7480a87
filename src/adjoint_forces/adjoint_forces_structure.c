/* src/adjoint_forces/adjoint_forces_structure.c -- A structure whose dampers push walls. [H 23] */
#include "adjoint_forces.h"

#include <fvi/structures.h>

#include <stdint.h>
#include <stdlib.h>

/* The matrices with walls. Each of the `count` dampers has a matrix, or a row of `rows`. */
typedef struct {
    fvi_sparse M, K, *C;
    size_t count;
    double *rows;
    fvi_damper *damper;
    fvi_structure *structure;
} parts;

static void stop(void *params)
{
    parts *o = params;
    fvi_structure_free(o->structure);
    fvi_sparse_free(&o->M);
    fvi_sparse_free(&o->K);
    for (size_t j = 0; o->C && j < o->count; j++)
        fvi_sparse_free(&o->C[j]);
    free(o->C);
    free(o->rows);
    free(o->damper);
    free(o);
}

static size_t entries(const fvi_sparse *A)
{
    return A ? (size_t)A->start[A->n] : 0;
}

/* ---- the indices of the walls ---- */

/* For a damper with a matrix: one wall for each unknown that the matrix acts on. */
static size_t number_walls_of_matrix(const fvi_sparse *C, size_t d, size_t next, size_t *wall)
{
    for (size_t i = 0; i < d; i++)
        wall[i] = C && C->start[i + 1] > C->start[i] ? next++ : SIZE_MAX;
    return next;
}

static int number_walls(fvi_walls *w, const fvi_system *of)
{
    const fvi_mechanism *m = of->mechanism;
    const size_t d = of->d;
    size_t n = m ? 0 : d, next = d;
    for (size_t j = 0; m && j < m->damper_count; j++)
        n += m->damper[j].matrix ? d : 1;
    const int status = fvi_walls_places(w, d, n, d);
    if (status)
        return status;
    if (!m)
        next = number_walls_of_matrix(of->matrices->C, d, next, w->wall);
    size_t i = 0;
    for (size_t j = 0; m && j < m->damper_count; j++) {
        if (m->damper[j].matrix) {
            next = number_walls_of_matrix(m->damper[j].matrix, d, next, w->wall + i);
            i += d;
        } else {
            w->wall[i++] = next++;
        }
    }
    w->whole = next;
    return FVI_SUCCESS;
}

/* ---- matrices ---- */

/* Extend A to the walls, with `diagonal` for each wall. */
static int widen_matrix(const fvi_walls *w, const fvi_sparse *A, double diagonal, fvi_sparse *to)
{
    fvi_triplet *each = malloc((entries(A) + w->whole) * sizeof *each);
    size_t count = 0;
    if (!each)
        return FVI_ENOMEM;
    for (size_t j = 0; j < A->n; j++)
        for (int k = A->start[j]; k < A->start[j + 1]; k++)
            each[count++] = (fvi_triplet){ A->row[k], (int)j, A->entry[k] };
    for (size_t i = w->d; i < w->whole; i++)
        each[count++] = (fvi_triplet){ (int)i, (int)i, diagonal };
    const int status = fvi_sparse_assemble(w->whole, count, each, to);
    free(each);
    return status;
}

/* C between the unknowns and their walls: (C, -C; -C, C). */
static int connect_walls(const fvi_walls *w, const fvi_sparse *C, const size_t *wall, fvi_sparse *to)
{
    fvi_triplet *each = malloc((4 * entries(C) + 1) * sizeof *each);
    size_t count = 0;
    if (!each)
        return FVI_ENOMEM;
    for (size_t j = 0; j < C->n; j++)
        for (int k = C->start[j]; k < C->start[j + 1]; k++) {
            const int row = C->row[k], column = (int)j, row_wall = (int)wall[row], column_wall = (int)wall[j];
            each[count++] = (fvi_triplet){ row, column, C->entry[k] };
            each[count++] = (fvi_triplet){ row, column_wall, -C->entry[k] };
            each[count++] = (fvi_triplet){ row_wall, column, -C->entry[k] };
            each[count++] = (fvi_triplet){ row_wall, column_wall, C->entry[k] };
        }
    const int status = fvi_sparse_assemble(w->whole, count, each, to);
    free(each);
    return status;
}

static int connect_row(const fvi_walls *w, const double *row, size_t wall, double *to)
{
    for (size_t i = 0; i < w->d; i++)
        to[i] = row[i];
    to[wall] = -1;
    return FVI_SUCCESS;
}

static int connect_dampers(fvi_walls *w, const fvi_mechanism *m, parts *o)
{
    int status = FVI_SUCCESS;
    o->damper = calloc(m->damper_count, sizeof *o->damper);
    o->rows = calloc(m->damper_count * w->whole, sizeof *o->rows);
    if (!o->damper || !o->rows)
        return FVI_ENOMEM;
    for (size_t j = 0, i = 0; j < m->damper_count && !status; j++) {
        const fvi_damper *from = m->damper + j;
        double *row = o->rows + j * w->whole;
        o->damper[j] = *from;
        status = from->matrix ? connect_walls(w, from->matrix, w->wall + i, &o->C[j])
                              : connect_row(w, from->of.row, w->wall[i], row);
        if (from->matrix)
            o->damper[j].matrix = &o->C[j];
        else
            o->damper[j].of = fvi_elongation_row(row);
        i += from->matrix ? w->d : 1;
    }
    return status ? status : fvi_structure_alloc_dampers(&o->M, &o->K, m->damper_count, o->damper, &o->structure, NULL);
}

int fvi_walls_of_structure(fvi_walls *w, const fvi_run *run)
{
    const fvi_system *of = run->system;
    const fvi_matrices *matrices = of->matrices;
    int status = number_walls(w, of);
    if (status)
        return status;
    parts *o = w->parts = calloc(1, sizeof *o);
    if (!o)
        return FVI_ENOMEM;
    w->stop = stop;
    o->count = of->mechanism ? of->mechanism->damper_count : 1;
    o->C = calloc(o->count, sizeof *o->C);
    status = o->C ? widen_matrix(w, matrices->M, FVI_WALL_MASS, &o->M) : FVI_ENOMEM;
    if (!status)
        status = widen_matrix(w, matrices->K, 0, &o->K);
    if (!status && !of->mechanism && matrices->C)
        status = connect_walls(w, matrices->C, w->wall, &o->C[0]);
    if (!status)
        status = of->mechanism ? connect_dampers(w, of->mechanism, o)
                               : fvi_structure_alloc(&o->M, &o->K, matrices->C ? &o->C[0] : NULL, &o->structure, NULL);
    if (!status)
        status = fvi_walls_allocate(w, run);
    if (!status) {
        w->system = fvi_structure_system(o->structure);
        status = fvi_walls_force(w, &of->force);
    }
    return status;
}
