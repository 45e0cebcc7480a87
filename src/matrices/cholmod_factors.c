/* src/matrices/cholmod_factors.c -- Factors by CHOLMOD.                [H 27]
 *
 * SuiteSparse's CHOLMOD is optional twice. Without its header, or with -DFVI_NO_CHOLMOD,
 * this file says that there is no CHOLMOD. With it, the library is loaded when the first
 * matrix asks for it, so that no program has to be linked with it; where it has gone, there
 * is none either. */
#define _GNU_SOURCE
#include "factors.h"

#include "system/fail.h"

#if defined(__has_include)
#if __has_include(<suitesparse/cholmod.h>) && !defined(FVI_NO_CHOLMOD)
#define FVI_HAS_CHOLMOD
#endif
#endif

#ifdef FVI_HAS_CHOLMOD

#include <dlfcn.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <suitesparse/cholmod.h>

#define TEXT_OF(x) #x
#define TEXT(x) TEXT_OF(x)

/* The functions that are used, as they came out of the library. */
static struct {
    int (*start)(cholmod_common *);
    cholmod_factor *(*analyze)(cholmod_sparse *, cholmod_common *);
    int (*factorize)(cholmod_sparse *, cholmod_factor *, cholmod_common *);
    int (*solve2)(int, cholmod_factor *, cholmod_dense *, cholmod_sparse *,
                  cholmod_dense **, cholmod_sparse **, cholmod_dense **,
                  cholmod_dense **, cholmod_common *);
    int (*free_factor)(cholmod_factor **, cholmod_common *);
    int (*free_dense)(cholmod_dense **, cholmod_common *);
    int (*finish)(cholmod_common *);
} cholmod;

static int is_there;

/* Called once in a process, whatever threads ask. */
static void load(void)
{
    void *library = dlopen("libcholmod.so." TEXT(CHOLMOD_MAIN_VERSION),
                           RTLD_NOW | RTLD_LOCAL);
    const struct {
        const char *name;
        void *place;
    } wanted[] = { { "cholmod_start", &cholmod.start },
                   { "cholmod_analyze", &cholmod.analyze },
                   { "cholmod_factorize", &cholmod.factorize },
                   { "cholmod_solve2", &cholmod.solve2 },
                   { "cholmod_free_factor", &cholmod.free_factor },
                   { "cholmod_free_dense", &cholmod.free_dense },
                   { "cholmod_finish", &cholmod.finish } };
    for (size_t i = 0; library && i < sizeof wanted / sizeof *wanted; i++) {
        void *found = dlsym(library, wanted[i].name);
        if (!found)
            return;
        memcpy(wanted[i].place, &found, sizeof found);
    }
    is_there = library != NULL;
}

int fvi_cholmod_is_there(void)
{
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, load);
    return is_there;
}

struct fvi_cholmod {
    cholmod_common common;
    cholmod_factor *L;
    cholmod_dense *x, *Y,
        *E; /* of solve2, kept from one solution to the next */
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

//> cholmod
int fvi_cholmod_alloc(const fvi_sparse *A, fvi_cholmod **result)
{
    fvi_cholmod *c = calloc(1, sizeof *c);
    if (!c)
        return FVI_ENOMEM;
    cholmod_common *common = &c->common;
    cholmod.start(common);
    common->print = 0;
    common->nmethods = 1;
    common->method[0].ordering = CHOLMOD_AMD;
    common->supernodal = CHOLMOD_SIMPLICIAL;
    common->final_ll = 1; /* L L^T: a pivot that is not positive is an error */
    cholmod_sparse columns = view(A);
    c->L = cholmod.analyze(&columns, common);
    if (c->L)
        cholmod.factorize(&columns, c->L, common);
    int status = common->status == CHOLMOD_NOT_POSDEF ? FVI_ESING
                 : !c->L || common->status < 0        ? FVI_ENOMEM
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
    if (!cholmod.solve2(CHOLMOD_A, c->L, &given, NULL, &c->x, NULL, &c->Y,
                        &c->E, &c->common))
        return FVI_ENOMEM;
    memcpy(r, c->x->x, n * sizeof *r);
    return FVI_SUCCESS;
}

void fvi_cholmod_free(fvi_cholmod *c)
{
    if (!c)
        return;
    cholmod.free_factor(&c->L, &c->common);
    cholmod.free_dense(&c->x, &c->common);
    cholmod.free_dense(&c->Y, &c->common);
    cholmod.free_dense(&c->E, &c->common);
    cholmod.finish(&c->common);
    free(c);
}

#else

int fvi_cholmod_is_there(void)
{
    return 0;
}

int fvi_cholmod_alloc(const fvi_sparse *A, fvi_cholmod **result)
{
    (void)A, (void)result;
    return FVI_EUNSUP;
}

int fvi_cholmod_solve(fvi_cholmod *c, double *r)
{
    (void)c, (void)r;
    return FVI_EUNSUP;
}

void fvi_cholmod_free(fvi_cholmod *c)
{
    (void)c;
}

#endif
