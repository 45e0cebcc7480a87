/* src/system/fail.h -- How a function of the library fails. */
#ifndef FVI_FAIL_H
#define FVI_FAIL_H

#include <fvi/error.h>

/* fvi_quiet, fvi_loud -- around calls of GSL's that may fail: GSL's own handler, which
 * is one for the process and aborts, is off in between. Pairs may be nested, and may
 * overlap in several threads. Allocations, eigenvalues, roots, integrals and
 * Cholesky's factors may fail. Views, sums, transforms and what is solved with the LU
 * factors of a few stages (lu.h), whose arguments are checked, stand bare. None of
 * them may ask for memory within: where there is none, GSL goes on without.
 *
 * Of GSL 2.7 gsl_matrix_alloc, gsl_eigen_symm_alloc and gsl_eigen_symmv_alloc do not free
 * the first half where there is no memory for the second. So matrices are views of arrays
 * of ours, and the workspaces, whose fields GSL's header declares, stand in one array.
 * That of gsl_multifit_nlinear is GSL's secret: identification_search.c asks first whether there is
 * room for it. */
void fvi_quiet(void);
void fvi_loud(void);

/* Tell the handler, if there is one; returns code. */
int fvi_tell_handler(const char *reason, const char *file, int line, int code);

/* The error is of number `index`, from 0, of several; returns code: `return fvi_at_index(error, i, fvi_fail(error, ...))`. */
static inline int fvi_at_index(fvi_error *error, size_t index, int code)
{
    if (error)
        error->index = index;
    return code;
}

/* What the caller's interrupter says, 0 if there is none: a loop that may last asks. */
int fvi_interrupted(void);

#define FVI_FAIL(reason, code)                                                 \
    return fvi_tell_handler(reason, __FILE__, __LINE__, code)

#endif
