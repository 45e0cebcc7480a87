/* src/program/fvi_solver_libraries.c -- Open CHOLMOD and UMFPACK when they are first called.
 *
 * These libraries load a dozen others, and opening all of them takes longer than a short run. So the program defines
 * functions with the names of their functions, which find the real ones. If a library cannot be opened, the program
 * ends with a message that names it, as it would have at the start.              [H 27, 30] */
#define _GNU_SOURCE /* for RTLD_GLOBAL */
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <suitesparse/cholmod.h>
#include <suitesparse/umfpack.h>

#define TEXT_OF(version) #version
#define TEXT(version) TEXT_OF(version)
#define CHOLMOD "libcholmod.so." TEXT(CHOLMOD_MAIN_VERSION)
#define UMFPACK "libumfpack.so." TEXT(UMFPACK_MAIN_VERSION)

/* Return the function of a library. RTLD_GLOBAL is needed because cholmod_factors.c looks for the functions of OpenMP
 * that CHOLMOD loads. */
static void *find_function(const char *library, const char *name)
{
    void *const opened = dlopen(library, RTLD_LAZY | RTLD_GLOBAL),
               *const found = opened ? dlsym(opened, name) : NULL;
    if (!found) {
        fprintf(stderr, "fvi: %s\n", dlerror());
        exit(EXIT_FAILURE);
    }
    return found;
}

/* Define a function with the name and type of the library's function. If several threads call it first at the same
 * time, they find the same function. */
#define FORWARD(library, type, name, takes, call)                              \
    type name takes                                                            \
    {                                                                          \
        static void *_Atomic kept;                                             \
        void *now = kept;                                                      \
        if (!now)                                                              \
            kept = now = find_function(library, #name);                                 \
        type(*function) takes;                                                 \
        *(void **)&function = now;                                             \
        call;                                                                  \
    }

FORWARD(CHOLMOD, int, cholmod_start, (cholmod_common * c), return function(c))
FORWARD(CHOLMOD, int, cholmod_finish, (cholmod_common * c), return function(c))
FORWARD(CHOLMOD, cholmod_factor *, cholmod_analyze,
        (cholmod_sparse * A, cholmod_common *c), return function(A, c))
FORWARD(CHOLMOD, int, cholmod_factorize,
        (cholmod_sparse * A, cholmod_factor *L, cholmod_common *c), return function(A, L, c))
FORWARD(CHOLMOD, int, cholmod_solve2,
        (int what, cholmod_factor *L, cholmod_dense *b, cholmod_sparse *b_set,
         cholmod_dense **x, cholmod_sparse **x_set, cholmod_dense **y,
         cholmod_dense **e, cholmod_common *c),
        return function(what, L, b, b_set, x, x_set, y, e, c))
FORWARD(CHOLMOD, cholmod_dense *, cholmod_ensure_dense,
        (cholmod_dense * *x, size_t rows, size_t columns, size_t leading,
         int type, cholmod_common *c),
        return function(x, rows, columns, leading, type, c))
FORWARD(CHOLMOD, int, cholmod_free_dense, (cholmod_dense * *x, cholmod_common *c),
        return function(x, c))
FORWARD(CHOLMOD, int, cholmod_free_factor,
        (cholmod_factor * *L, cholmod_common *c), return function(L, c))

FORWARD(UMFPACK, void, umfpack_zi_defaults, (double control[UMFPACK_CONTROL]),
        function(control))
FORWARD(UMFPACK, int, umfpack_zi_symbolic,
        (int rows, int columns, const int start[], const int row[],
         const double re[], const double im[], void **symbolic,
         const double control[UMFPACK_CONTROL], double info[UMFPACK_INFO]),
        return function(rows, columns, start, row, re, im, symbolic, control, info))
FORWARD(UMFPACK, int, umfpack_zi_numeric,
        (const int start[], const int row[], const double re[],
         const double im[], void *symbolic, void **numeric,
         const double control[UMFPACK_CONTROL], double info[UMFPACK_INFO]),
        return function(start, row, re, im, symbolic, numeric, control, info))
FORWARD(UMFPACK, int, umfpack_zi_wsolve,
        (int what, const int start[], const int row[], const double re[],
         const double im[], double x_re[], double x_im[], const double b_re[],
         const double b_im[], void *numeric,
         const double control[UMFPACK_CONTROL], double info[UMFPACK_INFO],
         int index[], double room[]),
        return function(what, start, row, re, im, x_re, x_im, b_re, b_im, numeric, control,
         info, index, room))
FORWARD(UMFPACK, void, umfpack_zi_free_symbolic, (void **symbolic), function(symbolic))
FORWARD(UMFPACK, void, umfpack_zi_free_numeric, (void **numeric), function(numeric))
