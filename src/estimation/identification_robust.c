/* src/estimation/identification_robust.c -- Fit data with wrong readings, and columns whose sigma is unknown. [H 24] */
#include "identification_robust.h"

#include "system/fail.h"
#include "system/larger.h"

#include <gsl/gsl_math.h>
#include <gsl/gsl_sort.h>
#include <gsl/gsl_statistics_double.h>
#include <stdlib.h>
#include <string.h>

enum { ROUNDS = 40 };
#define CHANGE_AT_END 1e-5 /* change of the logarithm of a unit at which the rounds end */
#define MEDIAN 1.4826 /* sigma of a normal distribution divided by the median of the absolute value */
#define LEAST 1e-9    /* least unit, as a part of the size of the data */

//> huber
/* (24.19): f^2 is the loss of r. */
double fvi_estimation_loss(double k, double r)
{
    const double size = fabs(r);
    return k == 0 || size <= k ? r : copysign(sqrt(k * (2 * size - k)), r);
}

double fvi_estimation_stretch(double k, double f)
{
    return k == 0 || fabs(f) <= k ? 1 : fabs(f) / k;
}

/* Return half the slope of the loss at f, which is r, or k with the sign of f. */
static double influence(double k, double f)
{
    return k == 0 || fabs(f) <= k ? f : copysign(k, f);
}

/* (24.20) */
void fvi_estimation_robust_units(double k, size_t P, const gsl_vector *f, double *of_sd,
                                 double *of_loss)
{
    double squares = 0, within = 0;
    *of_sd = *of_loss = 1;
    if (k == 0)
        return;
    for (size_t i = 0; i < f->size; i++) {
        const double each = gsl_vector_get(f, i);
        squares += gsl_pow_2(influence(k, each));
        within += fabs(each) <= k;
    }
    const double B = squares / (double)(f->size - P), A = within / (double)f->size;
    if (A > 0 && B > 0) {
        *of_sd = sqrt(B) / A;
        *of_loss = A / B;
    }
}
//< huber

void fvi_estimation_undo_loss(double k, gsl_vector *f, gsl_matrix *J)
{
    for (size_t i = 0; i < f->size && k > 0; i++) {
        const double stretch = fvi_estimation_stretch(k, gsl_vector_get(f, i));
        for (size_t j = 0; j < J->size2; j++)
            gsl_matrix_set(J, i, j, stretch * gsl_matrix_get(J, i, j));
        gsl_vector_set(f, i, influence(k, gsl_vector_get(f, i)));
    }
}

/* Return the unit of one column from the residuals of the last motion. r has room for all rows. */
static double unit_of(const fvi_estimation_model *m, size_t column, double *r)
{
    const fvi_estimation *fit = m->fit;
    size_t n = 0;
    double squares = 0;
    for (size_t k = 0; k < fvi_estimation_records(fit); k++) {
        const fvi_estimation_piece p = fvi_estimation_piece_of(fit, k, column);
        for (size_t i = 0; i < p.n; i++) {
            r[n] = fabs(m->motion[p.first + i] - p.x[i]);
            squares += r[n] * r[n];
            n++;
        }
    }
    gsl_sort(r, 1, n);
    const double unit = fit->huber > 0 ? MEDIAN * gsl_stats_median_from_sorted_data(r, 1, n)
                                       : sqrt(squares / (double)n),
                 size = fvi_estimation_size(fit, column);
    return fmax(unit, LEAST * (size > 0 ? size : 1));
}

int fvi_estimation_reweigh(fvi_estimation_work *o, fvi_estimation_place *at)
{
    fvi_estimation_model *m = &o->model;
    const size_t columns = fvi_estimation_columns(m->fit);
    double *r = malloc(o->fdf.n * sizeof *r), moved = 1;
    if (!r)
        FVI_FAIL("no memory for the residuals", FVI_ENOMEM);
    gsl_vector_const_view u = gsl_vector_const_view_array(at->u, o->fdf.p);
    for (int round = 0; round < ROUNDS && moved > CHANGE_AT_END; round++) {
        double scale[FVI_MEASURED_MOST] = { 0 };
        fvi_estimation_residuals(&u.vector, o, o->solver->f);
        moved = 0;
        for (size_t c = 0; c < columns; c++) {
            scale[c] = unit_of(m, c, r);
            moved = larger(moved, fabs(log(scale[c] / m->scale[c])));
        }
        fvi_estimation_model_rescale(m, scale);
        fvi_estimation_minimise(o, at, GSL_POSINF);
        if (!(at->sum < GSL_POSINF))
            break;
    }
    free(r);
    return FVI_SUCCESS;
}
