/* src/methods/lobatto_matrices_map.c -- Take a step of a small structure by one linear map.     [H 27] */
#include "lobatto_matrices.h"

#include "newton/linearised.h"
#include "system/arrays.h"
#include "system/dense.h"
#include "system/fail.h"

#include <stdlib.h>
#include <string.h>

enum { MAX_STAGE_UNKNOWNS = 128, /* largest number of stages times unknowns */
       MAX_ENTRIES = 1 << 15, /* largest number of entries of the map, a quarter of a megabyte */
       STEPS_PER_COLUMN = 2 /* smallest number of steps for each column */ };

/* ---- input and output of the map ---- */

typedef enum { GATHER, SCATTER, COUNT } direction;

/* Copy `count` numbers from `at` to row[*next] (GATHER) or back (SCATTER), and advance *next. */
static void copy_numbers(direction way, double *at, size_t count, double *row, size_t *next)
{
    if (way == GATHER)
        memcpy(row + *next, at, count * sizeof *at);
    if (way == SCATTER)
        memcpy(at, row + *next, count * sizeof *at);
    *next += count;
}

/* Copy the input of fvi_lobatto_matrices_solve that may change from step to step. Return its length. */
static size_t copy_input(fvi_lobatto_matrices *o, direction way, double *row)
{
    size_t next = 0;
    copy_numbers(way, o->Kx, o->d, row, &next);
    copy_numbers(way, o->Kv, o->d, row, &next);
    if (o->map.has_force)
        copy_numbers(way, o->F, o->s * o->d, row, &next);
    for (size_t j = 0; j < o->dampers; j++) {
        fvi_stage_damper *a = o->each + j;
        copy_numbers(way, a->z, a->r, row, &next);
        copy_numbers(way, a->Y, o->s * a->r, row, &next);
        if (a->past.size)
            copy_numbers(way, a->impulse, o->s, row, &next);
    }
    return next;
}

static size_t copy_output(fvi_lobatto_matrices *o, direction way, double *row)
{
    size_t next = 0;
    copy_numbers(way, o->mean, o->d, row, &next);
    copy_numbers(way, o->dv, o->d, row, &next);
    copy_numbers(way, o->dp, o->d, row, &next);
    for (size_t j = 0; j < o->dampers; j++)
        copy_numbers(way, o->each[j].slope, o->s * o->each[j].r, row, &next);
    return next;
}

static size_t copy_late_output(fvi_lobatto_matrices *o, direction way, double *row)
{
    size_t next = 0;
    copy_numbers(way, o->V, o->s * o->d, row, &next);
    for (size_t j = 0; j < o->dampers; j++)
        copy_numbers(way, o->each[j].force, o->s * o->each[j].r, row, &next);
    return next;
}

/* ---- the map ---- */

static int allocate(size_t d, fvi_step_map *m)
{
    const size_t rows = m->rows > m->late_rows ? m->rows : m->late_rows;
    m->map = FVI_ARRAYS({ &m->map, m->rows * m->columns }, { &m->late, m->late_rows * m->columns },
                        { &m->in, m->columns }, { &m->out, rows }, { &m->v, d });
    if (!m->map)
        FVI_FAIL("no memory for the map of a step", FVI_ENOMEM);
    return FVI_SUCCESS;
}

//> columns
/* Compute the columns: column j is the output of a step without the map for unit vector j. */
static int find_columns(const fvi_stepper *s, fvi_lobatto_matrices *o, double *saved)
{
    fvi_step_map *m = &o->map;
    int status = FVI_SUCCESS;
    copy_input(o, GATHER, saved);
    for (size_t j = 0; !status && j < m->columns; j++) {
        m->in[j] = 1;
        copy_input(o, SCATTER, m->in);
        status = fvi_lobatto_matrices_solve(s, o);
        copy_output(o, GATHER, m->map + j * m->rows);
        copy_late_output(o, GATHER, m->late + j * m->late_rows);
        m->in[j] = 0;
    }
    copy_input(o, SCATTER, saved);
    return status;
}
//< columns

int fvi_step_map_start(fvi_stepper *s, fvi_lobatto_matrices *o)
{
    fvi_step_map m = { .has_force = o->map.has_force = s->run.system->force.value != NULL };
    m.columns = copy_input(o, COUNT, NULL);
    m.rows = fvi_dense_rows(copy_output(o, COUNT, NULL));
    m.late_rows = fvi_dense_rows(copy_late_output(o, COUNT, NULL));
    if (o->s * o->d > MAX_STAGE_UNKNOWNS || m.rows * m.columns > MAX_ENTRIES
        || s->run.steps / STEPS_PER_COLUMN < m.columns || fvi_linearised_of(s->run.system))
        return FVI_SUCCESS;
    double *saved = malloc(m.columns * sizeof *saved);
    int status = saved ? allocate(o->d, &m) : FVI_ENOMEM;
    if (!status) {
        o->map = m;
        status = find_columns(s, o, saved);
    }
    free(saved);
    if (status == FVI_ENOMEM)
        FVI_FAIL("no memory for the map of a step", FVI_ENOMEM);
    return status;
}

int fvi_step_map_apply(fvi_stepper *s, fvi_lobatto_matrices *o)
{
    fvi_step_map *m = &o->map;
    m->is_late = m->columns > 0 && (m->has_force || !s->run.system->force.value);
    if (!m->is_late)
        return 0;
    copy_input(o, GATHER, m->in);
    memcpy(m->v, o->v, o->d * sizeof *m->v);
    fvi_dense_multiply(m->rows, m->columns, m->map, m->in, m->out);
    copy_output(o, SCATTER, m->out);
    return 1;
}

void fvi_step_map_finish(fvi_lobatto_matrices *o)
{
    fvi_step_map *m = &o->map;
    if (!m->is_late)
        return;
    fvi_dense_multiply(m->late_rows, m->columns, m->late, m->in, m->out);
    copy_late_output(o, SCATTER, m->out);
    for (size_t i = 0; i < o->s; i++)
        for (size_t j = 0; j < o->d; j++)
            o->V[i * o->d + j] += m->v[j];
    m->is_late = 0;
}

int fvi_step_map_copy(size_t d, const fvi_step_map *from, fvi_step_map *to)
{
    if (from->columns == 0)
        return FVI_SUCCESS;
    *to = *from;
    const int status = allocate(d, to);
    if (status)
        to->columns = 0;
    else
        memcpy(to->map, from->map, (from->rows + from->late_rows) * from->columns * sizeof *to->map);
    return status;
}

void fvi_step_map_stop(fvi_step_map *map)
{
    free(map->map);
}
