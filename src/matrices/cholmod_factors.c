/* src/matrices/cholmod_factors.c -- Factorise a sparse positive definite matrix by CHOLMOD (SuiteSparse).   [H 27] */
#define _GNU_SOURCE /* for initstate and RTLD_DEFAULT */
#include "factors.h"


#include <dlfcn.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <suitesparse/cholmod.h>

enum { FULL = 250 }; /* entries of L per column from which dense blocks are faster */

struct fvi_cholmod {
    cholmod_common common;
    cholmod_factor *L;
    cholmod_dense *x, *Y,
        *E; /* vectors for cholmod_solve2, kept from one solution to the next */
};

/* Return A in the form of CHOLMOD: the upper triangle of sorted columns. */
static cholmod_sparse view_as_cholmod(const fvi_sparse *A)
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

/* Analyse with the orders of AMD and METIS. METIS seeds rand() and draws from it. So rand() gets another state
 * meanwhile, and only one thread analyses at a time. Then every thread finds the same order, and the random numbers of
 * the caller are not disturbed. If METIS runs out of memory, it prints messages and leaks memory. So CHOLMOD first
 * tests whether there is twice the memory that METIS needs, and otherwise does without METIS. Without METIS a cube of
 * 20^3 joints, 48,000 unknowns, would need 2.5 times the operations. */
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
/* Choose an order of elimination. For bands and membranes AMD finds an order in which L has few entries. If L has many
 * entries, as for a frame in space, METIS may find a better order, and L is factorised by dense blocks. */
static void analyse_pattern(fvi_cholmod *c, cholmod_sparse *A)
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

/* Allocate the vectors of cholmod_solve2. CHOLMOD would use them before it tests whether their allocation has failed.
 * For one right-hand side Y has n numbers, and E has the length of the longest row of blocks. */
static void allocate_solution(fvi_cholmod *c)
{
    const size_t n = c->L->n, longest = c->L->maxesize;
    cholmod_ensure_dense(&c->x, n, 1, n, CHOLMOD_REAL, &c->common);
    cholmod_ensure_dense(&c->Y, n, 1, n, CHOLMOD_REAL, &c->common);
    if (c->L->is_super)
        cholmod_ensure_dense(&c->E, longest, 1, longest, CHOLMOD_REAL, &c->common);
}

/* Return a function of the OpenMP library that CHOLMOD uses, or NULL if there is none. */
static void *find_openmp(const char *name)
{
    return dlsym(RTLD_DEFAULT, name);
}

/* Factorise in this thread only. CHOLMOD would use four threads, which save no time here. In addition, a child of
 * fork() would wait for ever for the threads that OpenMP keeps for the parent. The limit of the caller is restored. */
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
    cholmod_sparse columns = view_as_cholmod(A);
    analyse_pattern(c, &columns);
    if (c->L)
        factorise_in_one_thread(c, &columns);
    if (c->L && c->common.status == CHOLMOD_OK)
        allocate_solution(c);
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
