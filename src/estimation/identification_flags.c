/* src/estimation/identification_flags.c -- What speaks against an answer: tests of what is left
 * over.                                                                [H 24] */
#include "identification_examine.h"

#include "system/fail.h"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_math.h>

#define DEPENDENT 1e-4 /* a column whose rest is shorter, of its length, is not asked about */

/* Columns of length 1, orthogonal to each other: those of the Jacobian, and behind them what is
 * asked for. */
typedef struct {
    gsl_matrix *Q;
    size_t count;
} basis;

/* Add a column, its part along those before taken out, twice as roundings stay else. Returns 0
 * where nothing is left of it: the parameters make up for it. */
static int add_column(basis *b, gsl_vector *v)
{
    const double length = gsl_blas_dnrm2(v);
    for (int twice = 0; twice < 2; twice++)
        for (size_t k = 0; k < b->count; k++) {
            gsl_vector_view q = gsl_matrix_column(b->Q, k);
            double along;
            gsl_blas_ddot(&q.vector, v, &along);
            gsl_blas_daxpy(-along, &q.vector, v);
        }
    const double rest = gsl_blas_dnrm2(v);
    if (!(rest > DEPENDENT * length) || b->count == b->Q->size2)
        return 0;
    gsl_vector_view q = gsl_matrix_column(b->Q, b->count++);
    gsl_vector_memcpy(&q.vector, v);
    gsl_vector_scale(&q.vector, 1 / rest);
    return 1;
}

/* The squares of f along the columns from `first` on. */
static double squares_along(const basis *b, size_t first, const gsl_vector *f)
{
    double sum = 0;
    for (size_t k = first; k < b->count; k++) {
        gsl_vector_const_view q = gsl_matrix_const_column(b->Q, k);
        double along;
        gsl_blas_ddot(&q.vector, f, &along);
        sum += along * along;
    }
    return sum;
}

//> score
/* (24.14): the probability that noise alone has so much along k more columns, of n - P left. sum:
 * of all squares; known: of noise 1. */
static double chance(double along, double sum, size_t k, size_t left, int known)
{
    if (k == 0 || left <= k || !(sum > 0))
        return 1;
    if (known)
        return gsl_cdf_chisq_Q(along, (double)k);
    const double rest = fmax(sum - along, 1e-12 * sum);
    return gsl_cdf_fdist_Q(along / (double)k / (rest / (double)(left - k)), (double)k,
                           (double)(left - k));
}
//< score

/* L q: the mean of both neighbours. */
static double neighbour_mean(const gsl_vector *q, size_t i)
{
    const size_t n = q->size;
    return ((i > 0 ? gsl_vector_get(q, i - 1) : 0)
            + (i + 1 < n ? gsl_vector_get(q, i + 1) : 0))
           / 2;
}

//> neighbours
/* (24.13): r^T L r / r^T r of white noise of which the first `count` columns have been taken out:
 * its mean is tr(M L) / f, its variance 2 (tr (M L)^2 - tr^2 (M L) / f) / (f (f + 2)), where M is
 * the projection and f its rank. */
static void neighbours_of_noise(const basis *b, double *mean, double *sd)
{
    const size_t n = b->Q->size1, P = b->count;
    const double f = (double)(n - P);
    double trace = 0, square = (double)(n - 1) / 2; /* of L L */
    for (size_t k = 0; k < P; k++) {
        gsl_vector_const_view q = gsl_matrix_const_column(b->Q, k);
        for (size_t i = 0; i < n; i++)
            square -= 2 * gsl_pow_2(neighbour_mean(&q.vector, i));
        for (size_t l = 0; l < P; l++) {
            gsl_vector_const_view o = gsl_matrix_const_column(b->Q, l);
            double with = 0;
            for (size_t i = 0; i < n; i++)
                with += gsl_vector_get(&o.vector, i) * neighbour_mean(&q.vector, i);
            trace -= k == l ? with : 0;
            square += with * with;
        }
    }
    *mean = trace / f;
    *sd = sqrt(2 * (square - trace * trace / f) / (f * (f + 2)));
}
//< neighbours

static double chance_of_neighbours(const basis *b, double correlation)
{
    double mean, sd;
    neighbours_of_noise(b, &mean, &sd);
    return gsl_cdf_ugaussian_Q((correlation - mean) / sd);
}

/* Smooth patterns: as many half waves over the rows as the motion has in this time, and half as
 * many more. */
static size_t patterns(const fvi_estimation *fit)
{
    double w, A;
    fvi_estimation_frequency(fit->n, fit->t, fit->x, &w, &A);
    const double half_waves = w * (fit->t[fit->n - 1] - fit->t[0]) / M_PI;
    const size_t wanted = (size_t)ceil(fmin(1.5 * half_waves, 1e6)) + 2;
    return GSL_MAX(3, GSL_MIN(wanted, fit->n / 4));
}

void fvi_estimation_sensor_column(const fvi_estimation *fit, size_t which, gsl_vector *v)
{
    for (size_t i = 0; i < v->size; i++)
        gsl_vector_set(v, i, which == 0 ? 1 : fit->t[i] / fit->t[fit->n - 1]);
}

/* Half wave number k over the rows. */
static void pattern_column(size_t k, gsl_vector *v)
{
    const double n = (double)v->size;
    for (size_t i = 0; i < v->size; i++)
        gsl_vector_set(v, i, cos(M_PI * (double)k * ((double)i + 0.5) / n));
}

double fvi_estimation_length_unseen(const fvi_estimation *fit, size_t which, const gsl_matrix *J,
                                    gsl_matrix *room, gsl_vector *v)
{
    basis b = { room, 0 };
    double along;
    for (size_t j = 0; j < J->size2; j++) {
        gsl_vector_const_view column = gsl_matrix_const_column(J, j);
        gsl_vector_memcpy(v, &column.vector);
        add_column(&b, v);
    }
    fvi_estimation_sensor_column(fit, which, v);
    if (!add_column(&b, v))
        return 0;
    fvi_estimation_sensor_column(fit, which, v);
    gsl_vector_view q = gsl_matrix_column(room, b.count - 1);
    gsl_blas_ddot(&q.vector, v, &along);
    return fabs(along);
}

/* (24.15): the same of a constant instead of the motion. So many frequencies may have been tried
 * that the best of n is asked for. */
static double chance_of_no_motion(const fvi_estimation *fit, double scale, double sum,
                                  int known)
{
    const size_t n = fit->n, P = fit->parameters;
    double mean = 0, still = 0;
    for (size_t i = 0; i < n; i++)
        mean += fit->x[i] / (double)n;
    for (size_t i = 0; i < n; i++)
        still += gsl_pow_2((fit->x[i] - mean) / scale);
    if (still <= sum)
        return 1;
    return fmin(1, (double)n * chance(still - sum, still, P, n - 1, known));
}

void fvi_estimation_tests(const fvi_estimation *fit, double scale, const gsl_vector *f,
                          gsl_matrix *J, gsl_matrix *room, gsl_vector *v,
                          fvi_examination *e)
{
    const size_t n = f->size, P = J->size2, smooth = patterns(fit);
    const int known = fit->sigma > 0;
    basis b = { room, 0 };
    double sum, pairs = 0;
    gsl_blas_ddot(f, f, &sum);
    for (size_t i = 1; i < n; i++)
        pairs += gsl_vector_get(f, i - 1) * gsl_vector_get(f, i);
    for (size_t j = 0; j < P; j++) {
        gsl_vector_view column = gsl_matrix_column(J, j);
        add_column(&b, &column.vector);
    }
    const size_t left = n - b.count;
    e->probability[0] = sum > 0 ? chance_of_neighbours(&b, pairs / sum) : 1;
    for (size_t which = 0, first = b.count; which < 2; which++, first = b.count) {
        fvi_estimation_sensor_column(fit, which, v);
        const int is_new = add_column(&b, v);
        e->probability[1 + which] =
            is_new ? chance(squares_along(&b, first, f), sum, 1, left, known) : 1;
    }
    const size_t first = b.count;
    for (size_t k = 0; k < smooth && b.count < room->size2; k++) {
        pattern_column(k + 1, v);
        add_column(&b, v);
    }
    e->probability[3] =
        chance(squares_along(&b, first, f), sum, b.count - first, left, known);
    e->probability[4] = chance_of_no_motion(fit, scale, sum, known);
}

size_t fvi_estimation_test_columns(const fvi_estimation *fit)
{
    return GSL_MIN(fit->parameters + 2 + patterns(fit), fit->n);
}
