/* src/estimation/identification_search.c -- Search for a minimum from one start.          [H 24] */
#include "identification_search.h"

#include "identification_robust.h"

#include "system/fail.h"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_math.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define STEP 1e-7 /* relative step of a difference: with the memory the motion is smooth to 1e-13 */

typedef fvi_estimation_work search;

//> residuals
/* f_i = (x(t_i) - x_i) / scale. If the integrator fails, every f_i is a large number, so
 * that the search turns away. */
static void fill_residuals(search *o)
{
    fvi_estimation_model *m = &o->model;
    const int failed = fvi_estimation_model_run(m);
    for (size_t k = 0; k < fvi_estimation_pieces(m->fit); k++) {
        const fvi_estimation_piece p = fvi_estimation_piece_at(m->fit, k);
        const double scale = fvi_estimation_model_scale(m, &p);
        const size_t rows = fvi_estimation_model_rows(m, p.n);
        for (size_t i = 0; i < p.n; i++) {
            const double r = i < rows ? (m->motion[p.first + i] - p.x[i]) / scale : 0;
            o->last[p.first + i] = !failed && fabs(r) < m->hopeless
                                       ? fvi_estimation_loss(m->fit->huber, r)
                                       : m->hopeless;
        }
    }
}
//< residuals

int fvi_estimation_residuals(const gsl_vector *u, void *params, gsl_vector *f)
{
    search *o = params;
    fvi_estimation_model *m = &o->model;
    for (size_t j = 0; j < u->size; j++)
        fvi_estimation_model_set(m, j,
                          fvi_estimation_u_to_theta(m, j, gsl_vector_get(u, j)));
    fill_residuals(o);
    for (size_t i = 0; i < f->size; i++)
        gsl_vector_set(f, i, o->last[i]);
    return m->ended ? GSL_ENOMEM : GSL_SUCCESS;
}

double fvi_estimation_sum_here(search *o)
{
    double sum = 0;
    fill_residuals(o);
    for (size_t i = 0; i < o->fdf.n; i++)
        sum += gsl_pow_2(o->last[i]);
    return sum < gsl_pow_2(o->model.hopeless) ? sum : GSL_POSINF;
}

/* Compute the Jacobian from derivatives that are computed along with the run. Return 0 if they are not known. */
static int fill_jacobian_by_tangents(const gsl_vector *u, search *o, gsl_matrix *J)
{
    fvi_estimation_model *m = &o->model;
    const size_t P = u->size;
    for (size_t j = 0; j < P; j++)
        fvi_estimation_model_set(m, j,
                          fvi_estimation_u_to_theta(m, j, gsl_vector_get(u, j)));
    if (o->tangents && m->window < 1)
        memset(o->tangents, 0, J->size1 * P * sizeof *o->tangents);
    if (!o->tangents || fvi_estimation_model_tangents(m, o->tangents)
        || !fvi_all_finite(J->size1 * P, o->tangents))
        return 0;
    const double huber = m->fit->huber; /* only data of one piece have such derivatives */
    for (size_t j = 0; j < P; j++) {
        const double by =
            fvi_estimation_slope_of_theta(m, j, fvi_estimation_model_get(m, j)) / m->scale[0];
        for (size_t i = 0; i < J->size1; i++)
            gsl_matrix_set(J, i, j,
                           by * o->tangents[i * P + j] / fvi_estimation_stretch(huber, o->last[i]));
    }
    return 1;
}

//> slopes
/* Compute the Jacobian at the u of the last residuals, where GSL asks for it: by differences if the run has no
 * tangents. GSL's own steps are proportional to u. They are lost in rounding where u is almost 0: at alpha = 1/2, rho =
 * 1, p0 = 0. */
static int slopes(const gsl_vector *u, void *params, gsl_matrix *J)
{
    search *o = params;
    double there[FVI_ESTIMATION_MOST];
    gsl_vector_view v = gsl_vector_view_array(there, u->size);
    if (fill_jacobian_by_tangents(u, o, J))
        return GSL_SUCCESS;
    memcpy(o->base, o->last, J->size1 * sizeof *o->base);
    for (size_t j = 0; j < u->size; j++) {
        gsl_vector_view f = gsl_matrix_column(J, j);
        const double size = fmax(fabs(gsl_vector_get(u, j)), o->size[j]),
                     step = STEP * size;
        gsl_vector_memcpy(&v.vector, u);
        there[j] += step;
        fvi_estimation_residuals(&v.vector, o, &f.vector);
        for (size_t i = 0; i < J->size1; i++)
            gsl_vector_set(&f.vector, i, (o->last[i] - o->base[i]) / step);
    }
    memcpy(o->last, o->base, J->size1 * sizeof *o->last);
    return o->model.ended ? GSL_ENOMEM : GSL_SUCCESS;
}
//< slopes

//> minimise
/* Search downhill from at->u. Of the driver's answers only "not there yet" is used, because a false minimum is reached
 * with success, and a good one may be left with a complaint about the last digits. A search is given up if 60
 * iterations at the pace of the last ten would end above `below`. */
void fvi_estimation_minimise(search *o, fvi_estimation_place *at, double below)
{
    enum { TEN = 10, TENS = 6 };
    const size_t P = o->fdf.p;
    gsl_vector_view u = gsl_vector_view_array(at->u, P);
    double before = GSL_POSINF;
    int info = 0, goes_on = 1;
    at->sum = GSL_POSINF;
    at->gave_up = 0;
    if (gsl_multifit_nlinear_init(&u.vector, &o->fdf, o->solver))
        return;
    for (int left = TENS - 1; goes_on && left >= 0; left--) {
        goes_on = gsl_multifit_nlinear_driver(TEN, o->fine, 1e-10, 0, NULL,
                                              NULL, &info, o->solver)
                      == GSL_EMAXITER
                  && info == 0;
        gsl_blas_ddot(o->solver->f, o->solver->f, &at->sum);
        if (goes_on && !(at->sum * pow(at->sum / before, left) <= below)) {
            at->gave_up = 1;
            break;
        }
        before = at->sum;
    }
    gsl_vector_memcpy(&u.vector, gsl_multifit_nlinear_position(o->solver));
    if (!(at->sum < gsl_pow_2(o->model.hopeless)) || !fvi_all_finite(P, at->u))
        at->sum = GSL_POSINF;
}
//< minimise

/* ---- ready, and done ---- */

/* Set the size of each u. For a start or a constant it is 1/16 of the box. If there are two boxes, the smaller size is
 * taken, because the unit of a constant is the caller's, and the caller's box may be wide. */
static void set_sizes(search *o, const fvi_estimation *fit, const double *low,
                      const double *high)
{
    for (size_t j = 0; j < fit->parameters; j++) {
        const double size = fvi_estimation_kind_of(fit, j) != FVI_ESTIMATION_NUMBER
                                ? 0.25 /* size of a logit and of a logarithm */
                                : (high[j] - low[j]) / 16;
        o->size[j] = o->size[j] > 0 ? fmin(o->size[j], size) : size;
    }
}

/* If there is too little memory, GSL 2.7 loses the part of the solver that it already has. So the solver is made only
 * if all of it fits at once: two matrices of n times p numbers, at most ten vectors of n, and the round-up of some
 * thirty blocks. volatile: a compiler may remove an allocation that is freed unused. */
static int can_allocate_solver(size_t n, size_t p)
{
    void *volatile room = malloc((2 * p + 10) * n * sizeof(double) + ((size_t)1 << 18));
    const int there = room != NULL;
    free(room);
    return there;
}

static int search_alloc(search *o, const fvi_estimation *fit)
{
    const gsl_multifit_nlinear_parameters how =
        gsl_multifit_nlinear_default_parameters();
    const size_t n = fvi_estimation_rows(fit);
    double *motion = malloc(n * sizeof *motion);
    const int status = fvi_estimation_model_init(&o->model, fit, motion);
    o->fdf = (gsl_multifit_nlinear_fdf){ .f = fvi_estimation_residuals,
                                         .df = slopes,
                                         .n = n,
                                         .p = fit->parameters,
                                         .params = o };
    o->last = calloc(2 * n, sizeof *o->last);
    o->base = o->last ? o->last + n : NULL;
    o->found = calloc(fit->starts, sizeof *o->found);
    const int rides = fvi_estimation_model_has_tangents(&o->model);
    o->tangents =
        rides ? malloc(n * fit->parameters * sizeof *o->tangents) : NULL;
    if (can_allocate_solver(n, fit->parameters))
        o->solver = gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &how,
                                               n, fit->parameters);
    if (status || !motion || !o->last || !o->found || !o->solver || (rides && !o->tangents))
        FVI_FAIL("no memory for the fit", FVI_ENOMEM);
    return FVI_SUCCESS;
}

int fvi_estimation_work_alloc(search *o, const fvi_estimation *fit, double *low, double *high)
{
    *o = (search){ .fine = 0 };
    int status = fvi_estimate_box(fit, low, high);
    if (status)
        return status;
    o->believed =
        fvi_estimation_knows_sigma(fit) && fit->huber == 0
            ? gsl_cdf_chisq_Pinv(0.99, (double)(fvi_estimation_rows(fit) - fit->parameters))
            : 0;
    set_sizes(o, fit, low, high);
    if (fit->low) {
        memcpy(low, fit->low, fit->parameters * sizeof *low);
        memcpy(high, fit->high, fit->parameters * sizeof *high);
        set_sizes(o, fit, low, high);
    }
    return search_alloc(o, fit);
}

void fvi_estimation_work_free(search *o)
{
    gsl_multifit_nlinear_free(o->solver);
    free(o->found);
    free(o->last);
    free(o->tangents);
    free(o->model.motion);
    fvi_estimation_model_clear(&o->model);
}
