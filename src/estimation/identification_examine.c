/* src/estimation/identification_examine.c -- Examine whether the answer of a fit can be believed.   [H 24] */
#include "identification_examine.h"
#include "identification_robust.h"

#include "system/fail.h"
#include "system/larger.h"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The least probabilities of the five tests: neighbours, offset, drift, pattern, no motion. A flag of the first four is
 * raised if noise alone makes such residuals with a smaller probability. These four add up to 0.023, so one of about
 * forty right models is flagged. An offset and a drift have the largest shares because they are the hardest to see:
 * neighbours and patterns that come from a fault are mostly far beyond chance. The last flag is raised unless the
 * probability is smaller. */
static const double least_probability[] = { 0.002, 0.010, 0.008, 0.003, 0.01 };

#define GRAVE 1e-4 /* an answer is not believed if noise alone makes such residuals with a smaller probability */
#define EXACT 1e-6 /* of the size of the data: residuals below that are errors of the method, not noise */
#define NEAR 6     /* in chi^2, beyond what the interval allows: a minimum up to there is nearly as good */
#define MOVED 0.02 /* in standard deviations: half a step may move an estimate by so much */
#define LOWER 1e-6 /* of chi^2: a minimum that is lower by this is another one */

/* ---- residuals ---- */

/* (24.4): add to swayed by how many standard deviations `size` sigma of a column of the sensor move each parameter. */
static void add_parameter_shifts(const fvi_estimation_model *m, const fvi_estimate *fitted,
                                 const gsl_matrix *J, const gsl_vector *column, double size,
                                 double *swayed)
{
    const size_t P = m->fit->parameters;
    for (size_t j = 0; j < P; j++) {
        double sum;
        gsl_vector_const_view by = gsl_matrix_const_column(J, j);
        gsl_blas_ddot(&by.vector, column, &sum);
        sum *= size * fvi_estimation_model_unit(m, fitted) * fitted->sd[j]
               / fvi_estimation_slope_of_theta(m, j, fitted->estimate[j]);
        for (size_t i = 0; i < P; i++)
            swayed[i] += fitted->correlation[i][j] * sum;
    }
}

static int is_fitted(const fvi_estimation *fit, fvi_free_parameter base, size_t column)
{
    for (size_t j = 0; j < fit->parameters; j++) {
        const size_t index = fvi_free_parameter_index(fit->which[j]);
        if (fvi_free_parameter_base(fit->which[j]) == base && (index == 0 || index == column + 1))
            return 1;
    }
    return 0;
}

/* Find the largest offset and drift of a sensor that the tests may overlook, and what they do to the parameters. The
 * column is that for which they do most. An offset or a drift that is fitted is left out. */
static void fill_unseen(const fvi_estimation_model *m, const fvi_estimate *fitted,
                        const gsl_matrix *J, gsl_matrix *room, gsl_vector *v,
                        fvi_examination *e)
{
    static const fvi_free_parameter of[] = { FVI_FREE_PARAMETER_OFFSET,
                                             FVI_FREE_PARAMETER_DRIFT };
    const size_t P = m->fit->parameters;
    const double z = gsl_cdf_ugaussian_Qinv(least_probability[1] / 2);
    for (size_t which = 0; which < 2; which++)
        for (size_t c = 0; c < fvi_estimation_columns(m->fit); c++) {
            double swayed[FVI_ESTIMATION_MOST] = { 0 };
            if (is_fitted(m->fit, of[which], c))
                continue;
            const double unseen =
                z / fvi_estimation_length_unseen(m->fit, which, c, J, room, v);
            fvi_estimation_sensor_column(m->fit, which, c, v);
            add_parameter_shifts(m, fitted, J, v, unseen, swayed);
            if (e->unseen[which] > 0
                && !(largest_abs(P, swayed) > largest_abs(P, e->swayed[which])))
                continue;
            e->unseen[which] = unseen;
            e->unseen_column[which] = c;
            memcpy(e->swayed[which], swayed, sizeof swayed);
        }
}

/* Room for residuals, a column, their Jacobian and a basis, in one block. */
typedef struct {
    double *block;
    gsl_vector_view f, v;
    gsl_matrix_view J, room;
} workspace;

static int workspace_alloc(const fvi_estimation *fit, workspace *w)
{
    const size_t n = fvi_estimation_rows(fit), P = fit->parameters,
                 columns = fvi_estimation_test_columns(fit);
    w->block = malloc(n * (2 + P + columns) * sizeof *w->block);
    if (!w->block)
        FVI_FAIL("no memory for the residuals", FVI_ENOMEM);
    w->f = gsl_vector_view_array(w->block, n);
    w->v = gsl_vector_view_array(w->block + n, n);
    w->J = gsl_matrix_view_array(w->block + 2 * n, n, P);
    w->room = gsl_matrix_view_array(w->block + (2 + P) * n, n, columns);
    return FVI_SUCCESS;
}

/* Compute residuals and Jacobian at u. For a robust fit compute the influences instead of the residuals, because they,
 * too, are what the parameters do not explain. Return FVI_SUCCESS or the code that ended the model. */
static int evaluate(fvi_estimation_work *o, const double *u, workspace *w)
{
    gsl_vector_const_view at = gsl_vector_const_view_array(u, o->fdf.p);
    fvi_estimation_residuals(&at.vector, o, &w->f.vector);
    o->fdf.df(&at.vector, o, &w->J.matrix);
    fvi_estimation_undo_loss(o->model.fit->huber, &w->f.vector, &w->J.matrix);
    return o->model.ended;
}

/* Return nonzero if the residuals are nothing but the error of the method. */
static int is_exact(const fvi_estimation_work *o, const fvi_estimate *fitted)
{
    return !fvi_estimation_knows_sigma(o->model.fit)
           && !(fitted->sigma > EXACT * fvi_estimation_size(o->model.fit, 0));
}

/* Test the residuals at u, the estimates, by (24.13) to (24.15). */
static int test_residuals(fvi_estimation_work *o, const fvi_estimate *fitted,
                          const double *u, fvi_examination *e)
{
    workspace w;
    int status = workspace_alloc(o->model.fit, &w);
    if (status)
        return status;
    status = evaluate(o, u, &w);
    if (!status && is_exact(o, fitted)) {
        e->probability[4] = 0;
    } else if (!status) {
        fill_unseen(&o->model, fitted, &w.J.matrix, &w.room.matrix, &w.v.vector, e);
        fvi_estimation_tests(&o->model, &w.f.vector, &w.J.matrix,
                             &w.room.matrix, &w.v.vector, e);
    }
    free(w.block);
    return status;
}

/* Set the intervals estimate -+ quantile sd. They are taken in the unbounded parameters u, so that no end leaves the
 * possible range. */
static void tangent_intervals(const fvi_estimation_model *m, const fvi_estimate *fitted,
                              fvi_examination *e)
{
    for (size_t j = 0; j < m->fit->parameters; j++) {
        const double theta = fitted->estimate[j],
                     u = fvi_estimation_theta_to_u(m, j, theta),
                     reach = fitted->quantile * fitted->sd[j]
                             / fvi_estimation_slope_of_theta(m, j, theta);
        e->lower[j] = fvi_estimation_u_to_theta(m, j, u - reach);
        e->upper[j] = fvi_estimation_u_to_theta(m, j, u + reach);
    }
}

int fvi_estimation_predict_errors(fvi_estimation_work *o, const double *u, fvi_estimate *planned,
                           fvi_examination *e)
{
    workspace w;
    const size_t P = o->fdf.p;
    int status = workspace_alloc(o->model.fit, &w);
    if (status)
        return status;
    status = evaluate(o, u, &w);
    if (!status) { /* fvi_estimation_errors overwrites its matrix, and fill_unseen needs J */
        gsl_matrix_view J = gsl_matrix_submatrix(&w.room.matrix, 0, 0, w.J.matrix.size1, P);
        gsl_matrix_memcpy(&J.matrix, &w.J.matrix);
        status = fvi_estimation_errors(&J.matrix, planned->sd, planned->correlation);
    }
    for (size_t j = 0; j < P && !status; j++)
        planned->sd[j] *= fvi_estimation_slope_of_theta(&o->model, j, planned->estimate[j]);
    if (!status) {
        tangent_intervals(&o->model, planned, e);
        fill_unseen(&o->model, planned, &w.J.matrix, &w.room.matrix, &w.v.vector, e);
    }
    free(w.block);
    return status;
}

/* ---- other minima ---- */

static int is_inside(const fvi_examination *e, size_t P, const double *theta)
{
    for (size_t j = 0; j < P; j++)
        if (!(theta[j] >= e->lower[j] && theta[j] <= e->upper[j]))
            return 0;
    return 1;
}

/* Search from the other places to their minima, with the step of the answer, and raise the flags VALLEYS and BETTER. */
static void search_other_minima(fvi_estimation_work *o, const fvi_estimate *fitted,
                                fvi_examination *e)
{
    const size_t P = o->fdf.p;
    const double unit =
                     gsl_pow_2(fvi_estimation_model_unit(&o->model, fitted)) * fitted->loss_unit,
                 near = fitted->chi2 + gsl_pow_2(fitted->quantile) + NEAR;
    for (size_t i = 0; i < fitted->others; i++) {
        fvi_estimation_place at;
        double theta[FVI_ESTIMATION_MOST];
        for (size_t j = 0; j < P; j++)
            at.u[j] = fvi_estimation_theta_to_u(&o->model, j, fitted->other[i][j]);
        fvi_estimation_minimise(o, &at, GSL_POSINF);
        for (size_t j = 0; j < P; j++)
            theta[j] = fvi_estimation_u_to_theta(&o->model, j, at.u[j]);
        const double chi2 = at.sum * unit;
        if (chi2 < fitted->chi2 - LOWER * fmax(1, fitted->chi2))
            e->flags |= FVI_FLAG_BETTER;
        if (!(chi2 < near) || is_inside(e, P, theta))
            continue;
        e->flags |= FVI_FLAG_VALLEYS;
        e->chi2 = smaller(e->chi2, chi2);
    }
}

/* ---- intervals ---- */

static int profiles(const fvi_estimation *fit, const fvi_estimate *fitted,
                    fvi_examination *e)
{
    for (size_t j = 0; j < fit->parameters; j++) {
        const int status =
            fvi_estimate_profile(fit, fitted, j, &e->lower[j], &e->upper[j]);
        if (status == FVI_EMAXITER)
            e->flags |= FVI_FLAG_BETTER;
        else if (status)
            return status;
    }
    return FVI_SUCCESS;
}

int fvi_estimation_is_open(const fvi_estimation *fit, const fvi_examination *e, size_t j)
{
    double low, high;
    fvi_estimation_range(fit, j, &low, &high);
    return e->lower[j] <= low && e->upper[j] >= high;
}

/* Raise the flags that follow from the numbers of an examination. VALLEYS and BETTER have been raised before. */
static void raise_flags(const fvi_estimation *fit, const fvi_estimate *fitted,
                        fvi_examination *e)
{
    static const unsigned of_tests[] = { FVI_FLAG_NEIGHBOURS, FVI_FLAG_OFFSET,
                                         FVI_FLAG_DRIFT, FVI_FLAG_PATTERN };
    for (size_t i = 0; i < 4; i++)
        if (e->probability[i] < least_probability[i]) {
            e->flags |= of_tests[i];
            e->grave |= e->probability[i] < GRAVE ? of_tests[i] : 0;
        }
    if (!(e->probability[4] < least_probability[4]))
        e->flags |= FVI_FLAG_NO_MOTION;
    if (fit->h == 0 && !(fitted->bias <= MOVED))
        e->flags |= fitted->bias > 1 ? FVI_FLAG_BIASED : FVI_FLAG_STEP;
    for (size_t j = 0; j < fit->parameters && !(e->flags & FVI_FLAG_NO_MOTION); j++)
        if (fvi_estimation_is_open(fit, e, j))
            e->flags |= FVI_FLAG_OPEN;
    e->grave |= e->flags
                & (FVI_FLAG_NO_MOTION | FVI_FLAG_VALLEYS | FVI_FLAG_BETTER | FVI_FLAG_BIASED);
}

/* ---- the whole ---- */

/* Set each interval to the whole possible range, because nothing is known of a motion that was not seen. */
static void set_whole_ranges(const fvi_estimation *fit, fvi_examination *e)
{
    for (size_t j = 0; j < fit->parameters; j++)
        fvi_estimation_range(fit, j, &e->lower[j], &e->upper[j]);
}

static int examine(fvi_estimation_work *o, const fvi_estimate *fitted, fvi_examination *e)
{
    const fvi_estimation *fit = o->model.fit;
    double u[FVI_ESTIMATION_MOST];
    for (size_t j = 0; j < fit->parameters; j++)
        u[j] = fvi_estimation_theta_to_u(&o->model, j, fitted->estimate[j]);
    o->fine = 1e-6;
    fvi_estimation_model_weigh(&o->model, fitted);
    fvi_estimation_model_set_step(&o->model, fitted->h);
    int status = test_residuals(o, fitted, u, e);
    if (!status && !(e->probability[4] < least_probability[4])) {
        set_whole_ranges(fit, e);
    } else if (!status && is_exact(o, fitted)) {
        tangent_intervals(&o->model, fitted, e); /* a profile would be one of rounding errors */
    } else if (!status) {
        status = profiles(fit, fitted, e);
        if (!status)
            search_other_minima(o, fitted, e);
    }
    return status;
}

/* Return nonzero for the answer of a fit. Its sigma is 0 if the model repeats the data to the last digit, and then the
 * deviations are 0, too. */
static int is_answer(size_t parameters, const fvi_estimate *fitted)
{
    int is_exact_answer = fitted->sigma == 0;
    for (size_t j = 0; j < parameters; j++)
        is_exact_answer &= fitted->sd[j] == 0;
    return fitted->h > 0 && (fitted->sigma > 0 || is_exact_answer) && fvi_estimate_is_finite(parameters, fitted);
}

int fvi_estimate_examine(const fvi_estimation *fit, const fvi_estimate *fitted,
                         fvi_examination *examined)
{
    fvi_estimation_work o;
    double low[FVI_ESTIMATION_MOST], high[FVI_ESTIMATION_MOST];
    int status = fvi_estimation_check(fit);
    if (status)
        return status;
    if (!fitted || !examined)
        FVI_FAIL("a pointer of the examination is NULL", FVI_EFAULT);
    if (!is_answer(fit->parameters, fitted))
        FVI_FAIL("an examination needs the answer of a fit", FVI_EDOM);
    fvi_examination e = { .probability = { 1, 1, 1, 1, 1 }, .chi2 = GSL_POSINF };
    fvi_quiet();
    status = fvi_estimation_work_alloc(&o, fit, low, high);
    if (!status)
        status = examine(&o, fitted, &e);
    fvi_estimation_work_free(&o);
    fvi_loud();
    if (!status) {
        raise_flags(fit, fitted, &e);
        *examined = e;
    }
    return status;
}
