/* src/system/fail.h -- Report the errors of library functions. */
#ifndef FVI_FAIL_H
#define FVI_FAIL_H

#include <fvi/error.h>

/* fvi_quiet, fvi_loud -- Switch GSL's error handler off, and on again. Put a call of GSL that may fail between both,
 * because GSL has one handler for the whole process, and its default handler aborts. Pairs may be nested, and pairs of
 * several threads may overlap. Calls that may fail are allocations, eigenvalues, roots, integrals and Cholesky
 * factorisations. Calls whose arguments the library has checked need no pair: views, sums, transforms, and solutions
 * with the LU factors of a few stages (lu.h). No call, inside or outside a pair, may allocate memory within: if such an
 * allocation fails, GSL goes on without the memory.
 *
 * Do not call gsl_matrix_alloc, gsl_eigen_symm_alloc or gsl_eigen_symmv_alloc. In GSL 2.7 they leak their first part if
 * the allocation of their second part fails. So the library's matrices are views of arrays that the library allocates.
 * Its workspaces for eigenvalues, whose fields GSL's header declares, lie in one such array. GSL hides the workspace of
 * gsl_multifit_nlinear, so identification_search.c checks first that there is enough memory for it. */
void fvi_quiet(void);
void fvi_loud(void);

/* fvi_tell_handler -- Call the error handler, if the program has set one. Return code. */
int fvi_tell_handler(const char *reason, const char *file, int line, int code);

/* fvi_at_index -- Store in the error which of several numbers, counted from 0, was refused. Return code. For example
 * `return fvi_at_index(error, i, fvi_fail(error, ...))`. */
static inline int fvi_at_index(fvi_error *error, size_t index, int code)
{
    if (error)
        error->index = index;
    return code;
}

/* fvi_interrupted -- Return what the caller's interrupter returns, or 0 if there is none. Loops that may take long call
 * this function. */
int fvi_interrupted(void);

#define FVI_FAIL(reason, code)                                                 \
    return fvi_tell_handler(reason, __FILE__, __LINE__, code)

#endif
