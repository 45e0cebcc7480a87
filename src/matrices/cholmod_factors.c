/* src/matrices/cholmod_factors.c -- Factors by CHOLMOD, of SuiteSparse.   [H 27] */
#define _GNU_SOURCE /* initstate, RTLD_DEFAULT */
#include "factors.h"


#include <dlfcn.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <suitesparse/cholmod.h>

enum { FULL = 250 }; /* entries of L in a column, from which on blocks are faster */

struct fvi_cholmod {
    cholmod_common common;
    cholmod_factor *L;
    cholmod_dense *x, *Y,
        *E; /* of cholmod_solve2, kept from one solution to the next */
};

/* A as CHOLMOD sees it: the upper triangle of columns in order. */
static cholmod_sparse view(const fvi_sparse *A)
{
    return (cholmod_sparse){ .nrow = A->n,
                             .ncol = A->n,
                             .nzmax = (size_t)A->start[A->n],
                             .p = A->start,
                             .i = A->row,
                             .x = A->entry,
                             .stype = 1,
                             .itype = CHOLMOD_INT,
                             .xtype = CHOLMOD_REAL,
                             .dtype = CHOLMOD_DOUBLE,
                             .sorted = 1,
                             .packed = 1 };
}

/* METIS seeds rand() and draws from it. So rand() gets another state meanwhile, and one
 * thread orders at a time: every thread finds the same order, and the caller's own random
 * numbers go on as if nothing had been drawn. Where memory runs out METIS prints, and loses some.
 * So CHOLMOD first looks whether there is twice as much as METIS needs, and does without. Without
 * METIS a cube of 20^3 joints, 48,000 unknowns, would take 2.5 times the operations. */
static void analyse_by_metis_too(fvi_cholmod *c, cholmod_sparse *A)
{
    static pthread_mutex_t one_at_a_time = PTHREAD_MUTEX_INITIALIZER;
    static char state[128];
    pthread_mutex_lock(&one_at_a_time);
    char *const of_caller = initstate(1, state, sizeof state);
    c->common.nmethods = 2;
    c->common.metis_memory = 2;
    c->common.method[1].ordering = CHOLMOD_METIS;
    c->L = cholmod_analyze(A, &c->common);
    setstate(of_caller);
    pthread_mutex_unlock(&one_at_a_time);
}

//> cholmod
/* AMD finds an order for bands and membranes in which L has few entries. If L has many, as
 * for a frame in space, METIS may find a better order, and L is factorised by dense blocks. */
static void analyse(fvi_cholmod *c, cholmod_sparse *A)
{
    cholmod_common *common = &c->common;
    common->nmethods = 1;
    common->method[0].ordering = CHOLMOD_AMD;
    common->supernodal = CHOLMOD_SIMPLICIAL;
    common->final_ll = 1; /* L L^T: a pivot that is not positive is an error */
    c->L = cholmod_analyze(A, common);
    if (!c->L || common->lnz <= FULL * (double)A->nrow)
        return;
    cholmod_free_factor(&c->L, common);
    common->supernodal = CHOLMOD_SUPERNODAL;
    analyse_by_metis_too(c, A);
}

/* The vectors of cholmod_solve2, which looks at them before it looks whether it got them. For one
 * right hand side Y has n numbers, and E those of the longest row of blocks. */
static void make_room_to_solve(fvi_cholmod *c)
{
    const size_t n = c->L->n, longest = c->L->maxesize;
    cholmod_ensure_dense(&c->x, n, 1, n, CHOLMOD_REAL, &c->common);
    cholmod_ensure_dense(&c->Y, n, 1, n, CHOLMOD_REAL, &c->common);
    if (c->L->is_super)
        cholmod_ensure_dense(&c->E, longest, 1, longest, CHOLMOD_REAL, &c->common);
}

/* A function of the OpenMP with which CHOLMOD was built, NULL if it has none. */
static void *find_openmp(const char *name)
{
    return dlsym(RTLD_DEFAULT, name);
}

/* In this thread alone. CHOLMOD asks for four, which gain no time here; and a child of fork()
 * would wait for ever for those that OpenMP keeps for the parent. The caller's limit comes back. */
static void factorise_in_one_thread(fvi_cholmod *c, cholmod_sparse *A)
{
    int (*limit)(void) = NULL;
    void (*set_limit)(int) = NULL;
    *(void **)&limit = find_openmp("omp_get_max_active_levels");
    *(void **)&set_limit = find_openmp("omp_set_max_active_levels");
    const int of_caller = limit && set_limit ? limit() : 0;
    if (limit && set_limit)
        set_limit(0); /* no parallel region has a second thread */
    cholmod_factorize(A, c->L, &c->common);
    if (limit && set_limit)
        set_limit(of_caller);
}

int fvi_cholmod_alloc(const fvi_sparse *A, fvi_cholmod **result)
{
    fvi_cholmod *c = calloc(1, sizeof *c);
    if (!c)
        return FVI_ENOMEM;
    cholmod_start(&c->common);
    c->common.print = 0;
    cholmod_sparse columns = view(A);
    analyse(c, &columns);
    if (c->L)
        factorise_in_one_thread(c, &columns);
    if (c->L && c->common.status == CHOLMOD_OK)
        make_room_to_solve(c);
    int status = c->common.status == CHOLMOD_NOT_POSDEF ? FVI_ESING
                 : !c->L || c->common.status < 0        ? FVI_ENOMEM
                                                        : FVI_SUCCESS;
    if (status)
        fvi_cholmod_free(c);
    else
        *result = c;
    return status;
}
//< cholmod

int fvi_cholmod_solve(fvi_cholmod *c, double *r)
{
    const size_t n = c->L->n;
    cholmod_dense given = { .nrow = n,
                            .ncol = 1,
                            .nzmax = n,
                            .d = n,
                            .x = r,
                            .xtype = CHOLMOD_REAL,
                            .dtype = CHOLMOD_DOUBLE };
    if (!cholmod_solve2(CHOLMOD_A, c->L, &given, NULL, &c->x, NULL, &c->Y,
                        &c->E, &c->common))
        return FVI_ENOMEM;
    memcpy(r, c->x->x, n * sizeof *r);
    return FVI_SUCCESS;
}

void fvi_cholmod_free(fvi_cholmod *c)
{
    if (!c)
        return;
    cholmod_free_factor(&c->L, &c->common);
    cholmod_free_dense(&c->x, &c->common);
    cholmod_free_dense(&c->Y, &c->common);
    cholmod_free_dense(&c->E, &c->common);
    cholmod_finish(&c->common);
    free(c);
}
