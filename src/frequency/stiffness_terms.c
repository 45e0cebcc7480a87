/* src/frequency/stiffness_terms.c -- Collect M, K and the dampings of a motion.  [H 30] */
#include "dynamic_stiffness.h"

#include <fvi/dampers.h>

#include "system/all_zero.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Add a term. It takes over the matrix `own`; if that is NULL, it uses the caller's `matrix`. */
static void add_term(fvi_response *r, const fvi_sparse *matrix,
                     const fvi_sparse *own, const fvi_kernel *kernel)
{
    fvi_stiffness_term *t = &r->term[r->terms++];
    *t = (fvi_stiffness_term){ .matrix = matrix, .kernel = kernel };
    if (own) {
        t->owned = *own;
        t->matrix = &t->owned;
    }
    double sum = 0;
    for (int e = 0; e < t->matrix->start[r->d]; e++)
        sum += t->matrix->entry[e] * t->matrix->entry[e];
    t->norm = sqrt(sum);
}

/* Add a matrix of triplets as a term. Refuse entries that are not finite. */
static int add_triplets(fvi_response *r, size_t count,
                        const fvi_triplet *triplets, const fvi_kernel *kernel,
                        fvi_error *error)
{
    fvi_sparse A;
    for (size_t e = 0; e < count; e++)
        if (!isfinite(triplets[e].entry))
            return fvi_fail(error, FVI_EBADFUNC, kernel ? "damper" : "potential", triplets[e].entry,
                            kernel ? "an elongation has no finite gradient" : "the Hessian is not finite");
    if (fvi_sparse_assemble(r->d, count, triplets, &A))
        return fvi_no_memory(error, NULL);
    add_term(r, NULL, &A, kernel);
    return FVI_SUCCESS;
}

static int add_diagonal(fvi_response *r, const double *diagonal,
                        const fvi_kernel *kernel, fvi_error *error)
{
    fvi_triplet *list = malloc(r->d * sizeof *list);
    if (!list)
        return fvi_no_memory(error, NULL);
    for (size_t i = 0; i < r->d; i++)
        list[i] = (fvi_triplet){ (int)i, (int)i, diagonal ? diagonal[i] : 0 };
    const int status = add_triplets(r, r->d, list, kernel, error);
    free(list);
    return status;
}

/* List the Hessian of the potential as triplets. H has `diagonals` diagonals, or all entries if that is 0. Zeros off
 * the diagonal are left out. */
static size_t list_hessian(size_t d, size_t diagonals, const double *H,
                           fvi_triplet *list)
{
    size_t n = 0;
    for (size_t i = 0; i < d; i++)
        for (size_t j = i; j < (diagonals ? i + diagonals : d) && j < d; j++) {
            const double entry =
                diagonals ? H[i * diagonals + j - i]
                          : (H[i * d + j] + H[j * d + i]) / 2;
            if (entry == 0 && i != j)
                continue;
            list[n++] = (fvi_triplet){ (int)i, (int)j, entry };
            if (i != j)
                list[n++] = (fvi_triplet){ (int)j, (int)i, entry };
        }
    return n;
}

static int add_hessian(fvi_response *r, const fvi_system *system,
                       const double *at, fvi_error *error)
{
    const size_t d = r->d, w = system->potential.diagonals;
    if (!system->potential.value)
        return add_diagonal(r, NULL, NULL, error);
    const size_t room = w ? d * w : d * d;
    double *H = malloc(room * sizeof *H);
    fvi_triplet *list = malloc(2 * room * sizeof *list);
    int status = H && list ? FVI_SUCCESS : fvi_no_memory(error, NULL);
    if (!status) {
        status = system->potential.hessian(d, at, system->potential.params, H);
        if (status)
            (void)fvi_fail(error, status, "potential", NAN, "it has no Hessian where it is to be linear");
    }
    if (!status)
        status =
            add_triplets(r, list_hessian(d, w, H, list), list, NULL, error);
    free(H);
    free(list);
    return status;
}

/* Write the gradient of an elongation at a place to g, d numbers. Refuse a gradient that changes with t, because the
 * motion would not have constant coefficients. To find that out, the gradient is computed at a second time. */
static int find_gradient(const fvi_elongation *of, size_t d, const double *at, double *g,
                         fvi_error *error)
{
    if (of->row) {
        memcpy(g, of->row, d * sizeof *g);
        return FVI_SUCCESS;
    }
    double *later = calloc(d, sizeof *later);
    if (!later)
        return fvi_no_memory(error, NULL);
    int status = of->gradient ? of->gradient(0, d, at, of->params, g) : FVI_EFAULT;
    if (status)
        (void)fvi_fail(error, status, "damper", NAN, "its elongation has no gradient where it is to be linear");
    else if (of->rate && !of->gradient(0.73, d, at, of->params, later)
             && memcmp(g, later, d * sizeof *g) != 0)
        status = fvi_fail(error, FVI_EUNSUP, "damper", NAN,
                          "the gradient of its elongation changes with t: there are no poles and no response");
    free(later);
    return status;
}

/* C(D) acts on g. The part that is linear in x - at is grad g grad g^T.              (30.1) */
static int add_elongation(fvi_response *r, const fvi_damper *damper,
                          const double *at, fvi_error *error)
{
    const size_t d = r->d;
    double *g = calloc(d, sizeof *g);
    int status = g ? find_gradient(&damper->of, d, at, g, error) : fvi_no_memory(error, NULL);
    size_t used = 0, n = 0;
    for (size_t i = 0; !status && i < d; i++)
        used += g[i] != 0;
    fvi_triplet *list = malloc((used * used + 1) * sizeof *list);
    for (size_t i = 0; !status && list && i < d; i++)
        for (size_t j = 0; j < d && g[i] != 0; j++)
            if (g[j] != 0)
                list[n++] = (fvi_triplet){ (int)i, (int)j, g[i] * g[j] };
    if (!status)
        status = list ? add_triplets(r, n, list, damper->kernel, error)
                      : fvi_no_memory(error, NULL);
    free(list);
    if (status)
        free(g);
    else
        r->term[r->terms - 1].gradient = g;
    return status;
}

static int add_dampers(fvi_response *r, const fvi_mechanism *mechanism,
                       const double *at, fvi_error *error)
{
    int status = FVI_SUCCESS;
    for (size_t j = 0; !status && mechanism && j < mechanism->damper_count;
         j++) {
        const fvi_damper *damper = &mechanism->damper[j];
        status = fvi_kernel_check(damper->kernel);
        if (status)
            return fvi_fail(error, status, "damper", NAN, "the kernel of damper %zu is no law", j + 1);
        if (damper->matrix && damper->matrix->n != r->d)
            return fvi_refuse(error, "damper", "the matrix of damper %zu is of another size", j + 1);
        if (damper->matrix)
            add_term(r, damper->matrix, NULL, damper->kernel);
        else
            status = add_elongation(r, damper, at, error);
        if (status && error)
            error->index = j;
    }
    return status;
}

/* Add the system's own damping, with alpha or with the law. */
static int add_damping(fvi_response *r, const fvi_linear_motion *motion,
                       fvi_error *error)
{
    const fvi_system *system = motion->system;
    const int none = system->matrices ? !system->matrices->C
                                      : fvi_all_zero(r->d, system->damping);
    if (none)
        return FVI_SUCCESS;
    if (!motion->law && !(motion->alpha >= 0 && motion->alpha <= 1))
        return fvi_fail(error, FVI_EDOM, "alpha", motion->alpha, "alpha is %g; it must be in [0, 1]", motion->alpha);
    const int status = motion->law ? fvi_kernel_check(motion->law) : 0;
    if (status)
        return fvi_fail(error, status, "law", NAN, "the law is none");
    r->power = (fvi_kernel_term){ FVI_KERNEL_POWER, 1, motion->alpha, 0, 0 };
    r->powers = (fvi_kernel){ 1, &r->power };
    const fvi_kernel *kernel = motion->law ? motion->law : &r->powers;
    if (!system->matrices)
        return add_diagonal(r, system->damping, kernel, error);
    add_term(r, system->matrices->C, NULL, kernel);
    return FVI_SUCCESS;
}

int fvi_stiffness_build(const fvi_linear_motion *motion, fvi_response *r,
                        fvi_error *error)
{
    const fvi_system *system = motion->system;
    const fvi_matrices *matrices = system->matrices;
    const fvi_mechanism *mechanism = system->mechanism;
    const size_t dampers = mechanism ? mechanism->damper_count : 0;
    double *origin = calloc(r->d, sizeof *origin);
    const double *at = motion->at ? motion->at : origin;
    r->term = calloc(dampers + 3, sizeof *r->term);
    int status = origin && r->term ? FVI_SUCCESS : fvi_no_memory(error, NULL);
    if (!status && matrices && !(matrices->M && matrices->K))
        status = fvi_fail(error, FVI_EUNSUP, "matrices", NAN, "these matrices do not say their entries");
    if (!status && matrices) {
        add_term(r, matrices->M, NULL, NULL);
        add_term(r, matrices->K, NULL, NULL);
    } else if (!status) {
        status = add_diagonal(r, system->mass, NULL, error);
        if (!status)
            status = add_hessian(r, system, at, error);
    }
    if (!status)
        status = add_damping(r, motion, error);
    if (!status)
        status = add_dampers(r, mechanism, at, error);
    if (!status && fvi_stiffness_find_pattern(r))
        status = fvi_no_memory(error, NULL);
    free(origin);
    return status;
}
