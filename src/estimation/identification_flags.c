/* src/estimation/identification_flags.c -- Test the residuals of a fit.                   [H 24] */
#include "identification_examine.h"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_math.h>

#define DEPENDENT 1e-4 /* a column is left out if its rest is shorter than this part of its length */

/* An orthonormal basis: first the columns of the Jacobian, then the columns of a test. */
typedef struct {
    gsl_matrix *Q;
    size_t count;
} basis;

/* Add a column after taking out its part along the columns before. That is done twice, because of rounding errors.
 * Return 0 if the rest is too short: then the parameters can imitate the column. */
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

/* Return the squared length of f along the columns from `first` on. */
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
/* (24.14): return the probability that noise alone has at least this much along k more columns, out of `left` = n - P
 * dimensions. `sum` is the sum of all squares. If `known`, the noise has the variance 1. */
static double tail_probability(double along, double sum, size_t k, size_t left, int known)
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

double fvi_estimation_neighbours(const fvi_estimation *fit, const gsl_vector *f)
{
    double pairs = 0;
    for (size_t k = 0; k < fvi_estimation_pieces(fit); k++) {
        const fvi_estimation_piece p = fvi_estimation_piece_at(fit, k);
        for (size_t i = p.first + 1; i < p.first + p.n; i++)
            pairs += gsl_vector_get(f, i - 1) * gsl_vector_get(f, i);
    }
    return pairs;
}

/* Return row i of L q, half the sum of both neighbours in the same piece. */
static double neighbour_mean(const gsl_vector *q, const fvi_estimation_piece *p, size_t i)
{
    return ((i > p->first ? gsl_vector_get(q, i - 1) : 0)
            + (i + 1 < p->first + p->n ? gsl_vector_get(q, i + 1) : 0))
           / 2;
}

//> neighbours
/* (24.13): r^T L r / r^T r for white noise from which the first `count` columns have been taken out. Its mean is tr(M
 * L) / f and its variance 2 (tr (M L)^2 - tr^2 (M L) / f) / (f (f + 2)), where M is the projection and f its rank.
 * Column l of Q^T L Q is added up piece by piece. */
static void neighbours_of_noise(const fvi_estimation *fit, const basis *b, double *mean, double *sd)
{
    const size_t P = b->count;
    const double f = (double)(b->Q->size1 - P);
    double trace = 0, square = 0, with[FVI_ESTIMATION_MOST][FVI_ESTIMATION_MOST] = { { 0 } };
    for (size_t m = 0; m < fvi_estimation_pieces(fit); m++) {
        const fvi_estimation_piece p = fvi_estimation_piece_at(fit, m);
        square += (double)(p.n - 1) / 2; /* trace of L L */
        for (size_t k = 0; k < P; k++) {
            gsl_vector_const_view q = gsl_matrix_const_column(b->Q, k);
            for (size_t i = p.first; i < p.first + p.n; i++) {
                const double Lq = neighbour_mean(&q.vector, &p, i);
                square -= 2 * gsl_pow_2(Lq);
                for (size_t l = 0; l < P; l++)
                    with[k][l] += gsl_matrix_get(b->Q, i, l) * Lq;
            }
        }
    }
    for (size_t k = 0; k < P; k++) {
        trace -= with[k][k];
        for (size_t l = 0; l < P; l++)
            square += gsl_pow_2(with[k][l]);
    }
    *mean = trace / f;
    *sd = sqrt(2 * (square - trace * trace / f) / (f * (f + 2)));
}
//< neighbours

static double probability_of_neighbours(const fvi_estimation *fit, const basis *b, double correlation)
{
    double mean, sd;
    neighbours_of_noise(fit, b, &mean, &sd);
    return gsl_cdf_ugaussian_Q((correlation - mean) / sd);
}

/* Return the number of smooth patterns of a piece: one and a half times the half waves that the motion has in this
 * time, and two, but at least 3 and at most a quarter of the rows. */
static size_t count_patterns(const fvi_estimation_piece *p)
{
    double w, A;
    if (p->n < 4)
        return 0;
    fvi_estimation_frequency(p->n, p->t, p->x, &w, &A);
    const double half_waves = w * (p->t[p->n - 1] - p->t[0]) / M_PI;
    const size_t wanted = (size_t)ceil(fmin(1.5 * half_waves, 1e6)) + 2;
    return GSL_MAX(3, GSL_MIN(wanted, p->n / 4));
}

void fvi_estimation_sensor_column(const fvi_estimation *fit, size_t which, size_t column,
                                  gsl_vector *v)
{
    const double last = fvi_estimation_last_time(fit);
    gsl_vector_set_zero(v);
    for (size_t r = 0; r < fvi_estimation_records(fit); r++) {
        const fvi_estimation_piece p = fvi_estimation_piece_of(fit, r, column);
        for (size_t i = 0; i < p.n; i++)
            gsl_vector_set(v, p.first + i, which == 0 ? 1 : p.t[i] / last);
    }
}

/* Write half wave number k over the rows of a piece. */
static void pattern_column(const fvi_estimation_piece *p, size_t k, gsl_vector *v)
{
    gsl_vector_set_zero(v);
    for (size_t i = 0; i < p->n; i++)
        gsl_vector_set(v, p->first + i,
                       cos(M_PI * (double)k * ((double)i + 0.5) / (double)p->n));
}

double fvi_estimation_length_unseen(const fvi_estimation *fit, size_t which, size_t column,
                                    const gsl_matrix *J, gsl_matrix *room, gsl_vector *v)
{
    basis b = { room, 0 };
    double along;
    for (size_t j = 0; j < J->size2; j++) {
        gsl_vector_const_view of_j = gsl_matrix_const_column(J, j);
        gsl_vector_memcpy(v, &of_j.vector);
        add_column(&b, v);
    }
    fvi_estimation_sensor_column(fit, which, column, v);
    if (!add_column(&b, v))
        return 0;
    fvi_estimation_sensor_column(fit, which, column, v);
    gsl_vector_view q = gsl_matrix_column(room, b.count - 1);
    gsl_blas_ddot(&q.vector, v, &along);
    return fabs(along);
}

/* (24.15): return the probability for a constant in each piece instead of the motion. A fit may have tried many
 * frequencies, so the result is multiplied by the number of rows. */
static double probability_of_no_motion(const fvi_estimation_model *m, double sum, int known)
{
    const fvi_estimation *fit = m->fit;
    const size_t n = fvi_estimation_rows(fit), pieces = fvi_estimation_pieces(fit);
    double still = 0;
    for (size_t k = 0; k < pieces; k++) {
        const fvi_estimation_piece p = fvi_estimation_piece_at(fit, k);
        const double scale = fvi_estimation_model_scale(m, &p);
        double mean = 0;
        for (size_t i = 0; i < p.n; i++)
            mean += p.x[i] / (double)p.n;
        for (size_t i = 0; i < p.n; i++)
            still += gsl_pow_2((p.x[i] - mean) / scale);
    }
    if (still <= sum)
        return 1;
    return fmin(1, (double)n
                       * tail_probability(still - sum, still, fit->parameters, n - pieces, known));
}

/* Return the probability of what f has along the offsets, or the drifts, of all columns. */
static double probability_of_sensors(const fvi_estimation *fit, size_t which, basis *b,
                                     const gsl_vector *f, double sum, size_t left, int known,
                                     gsl_vector *v)
{
    const size_t first = b->count;
    for (size_t c = 0; c < fvi_estimation_columns(fit); c++) {
        fvi_estimation_sensor_column(fit, which, c, v);
        add_column(b, v);
    }
    return tail_probability(squares_along(b, first, f), sum, b->count - first, left, known);
}

static double probability_of_patterns(const fvi_estimation *fit, basis *b, const gsl_vector *f,
                                      double sum, size_t left, int known, gsl_vector *v)
{
    const size_t first = b->count;
    for (size_t m = 0; m < fvi_estimation_pieces(fit); m++) {
        const fvi_estimation_piece p = fvi_estimation_piece_at(fit, m);
        const size_t smooth = count_patterns(&p);
        for (size_t k = 0; k < smooth && b->count < b->Q->size2; k++) {
            pattern_column(&p, k + 1, v);
            add_column(b, v);
        }
    }
    return tail_probability(squares_along(b, first, f), sum, b->count - first, left, known);
}

void fvi_estimation_tests(const fvi_estimation_model *m, const gsl_vector *f,
                          gsl_matrix *J, gsl_matrix *room, gsl_vector *v,
                          fvi_examination *e)
{
    const fvi_estimation *fit = m->fit;
    const int known = fvi_estimation_knows_sigma(fit) && fit->huber == 0;
    basis b = { room, 0 };
    double sum;
    gsl_blas_ddot(f, f, &sum);
    for (size_t j = 0; j < J->size2; j++) {
        gsl_vector_view column = gsl_matrix_column(J, j);
        add_column(&b, &column.vector);
    }
    const size_t left = f->size - b.count;
    e->probability[0] = sum > 0 ? probability_of_neighbours(fit, &b, fvi_estimation_neighbours(fit, f) / sum) : 1;
    for (size_t which = 0; which < 2; which++)
        e->probability[1 + which] =
            probability_of_sensors(fit, which, &b, f, sum, left, known, v);
    e->probability[3] = probability_of_patterns(fit, &b, f, sum, left, known, v);
    e->probability[4] = probability_of_no_motion(m, sum, known);
}

size_t fvi_estimation_test_columns(const fvi_estimation *fit)
{
    size_t columns = fit->parameters + 2 * fvi_estimation_columns(fit);
    for (size_t k = 0; k < fvi_estimation_pieces(fit); k++) {
        const fvi_estimation_piece p = fvi_estimation_piece_at(fit, k);
        columns += count_patterns(&p);
    }
    return GSL_MIN(columns, fvi_estimation_rows(fit));
}
