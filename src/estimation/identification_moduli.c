/* src/estimation/identification_moduli.c -- Find an order from storage and loss moduli.  [H 24] */
#include "identification_model.h"

#include "system/fail.h"
#include "system/larger.h"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_linalg.h>
#include <gsl/gsl_math.h>
#include <gsl/gsl_min.h>

#define DEPENDENT 1e-6 /* least singular value of J with columns of length 1 */
enum { SCAN = 100 };   /* orders that are tried first */

/* Use J = Q S V^T, with the columns scaled to length 1. Only their lengths depend on the unit of a parameter, and the
 * square of a length may be too large or too small for a double. On entry Q contains J. Jacobi's method needs no
 * memory from the heap; the other methods of GSL do not check whether they have got it. */
int fvi_estimation_errors(gsl_matrix *Q, double sd[],
                   double correlation[][FVI_ESTIMATION_MOST])
{
    const size_t P = Q->size2;
    double v[FVI_ESTIMATION_MOST * FVI_ESTIMATION_MOST], s[FVI_ESTIMATION_MOST], length[FVI_ESTIMATION_MOST],
        C[FVI_ESTIMATION_MOST][FVI_ESTIMATION_MOST];
    gsl_matrix_view V = gsl_matrix_view_array(v, P, P);
    gsl_vector_view S = gsl_vector_view_array(s, P);
    for (size_t j = 0; j < P; j++) {
        gsl_vector_view column = gsl_matrix_column(Q, j);
        length[j] = gsl_blas_dnrm2(&column.vector);
        if (!(length[j] > 0) || !isfinite(length[j]))
            return FVI_ESING;
        gsl_vector_scale(&column.vector, 1 / length[j]);
    }
    if (gsl_linalg_SV_decomp_jacobi(Q, &V.matrix, &S.vector)
        || !(s[P - 1] > DEPENDENT))
        return FVI_ESING;
    for (size_t i = 0; i < P; i++)
        for (size_t j = 0; j < P; j++) {
            C[i][j] = 0;
            for (size_t k = 0; k < P; k++)
                C[i][j] += v[i * P + k] * v[j * P + k] / (s[k] * s[k]);
        }
    for (size_t i = 0; i < P; i++) {
        sd[i] = sqrt(C[i][i]) / length[i];
        for (size_t j = 0; j < P; j++)
            correlation[i][j] = C[i][j] / sqrt(C[i][i] * C[j][j]);
    }
    return FVI_SUCCESS;
}

int fvi_estimate_is_finite(size_t P, const fvi_estimate *f)
{
    const double others[] = { f->quantile, f->sigma, f->chi2, f->probability,
                              f->neighbours };
    int is = fvi_all_finite(P, f->estimate) && fvi_all_finite(P, f->sd)
             && fvi_all_finite(sizeof others / sizeof *others, others);
    for (size_t j = 0; j < P; j++)
        is = is && fvi_all_finite(P, f->correlation[j]);
    return is;
}

/* ---- storage and loss ---- */

typedef struct {
    size_t n;
    const double *w, *storage, *loss;
    double rho, k, sum; /* best values for the last order */
} moduli;

/* Compute the derivatives of both moduli of row i by rho, divided by the size of the datum. k adds to storage only. */
static void row(const moduli *o, size_t i, double alpha, double *of_storage,
                double *of_loss, double *size)
{
    const double power = pow(o->w[i], 2 * alpha);
    *size = hypot(o->storage[i], o->loss[i]);
    *of_storage = power * cos(M_PI * alpha) / *size;
    *of_loss = power * sin(M_PI * alpha) / *size;
}

//> projection
/* For a given order both moduli are linear in rho and k. So solve two equations for them, and return the sum of
 * squares. */
static double projected_sum_of_squares(double alpha, void *params)
{
    moduli *o = params;
    double aa = 0, ab = 0, bb = 0, ay = 0, by = 0, a, b, size;
    for (size_t i = 0; i < o->n; i++) {
        row(o, i, alpha, &a, &b, &size);
        aa += a * a + b * b;
        ab += a / size;
        bb += 1 / (size * size);
        ay += (a * o->storage[i] + b * o->loss[i]) / size;
        by += o->storage[i] / (size * size);
    }
    o->rho = (ay * bb - by * ab) / (aa * bb - ab * ab);
    o->k = (by - ab * o->rho) / bb;
    o->sum = 0;
    for (size_t i = 0; i < o->n; i++) {
        row(o, i, alpha, &a, &b, &size);
        o->sum += gsl_pow_2(a * o->rho + (o->k - o->storage[i]) / size)
                  + gsl_pow_2(b * o->rho - o->loss[i] / size);
    }
    return o->sum;
}
//< projection

/* Find the order: take the best one of a scan, then use Brent's method between its neighbours. */
static int best_order(moduli *o, double *alpha)
{
    gsl_function f = { projected_sum_of_squares, o };
    size_t best = 1;
    double least = GSL_POSINF;
    for (size_t i = 1; i < SCAN; i++)
        if (projected_sum_of_squares((double)i / SCAN, o) < least) {
            least = o->sum;
            best = i;
        }
    double low = ((double)best - 1) / SCAN, high = ((double)best + 1) / SCAN;
    gsl_min_fminimizer *s = gsl_min_fminimizer_alloc(gsl_min_fminimizer_brent);
    if (!s)
        FVI_FAIL("no memory for the order", FVI_ENOMEM);
    *alpha = (double)best / SCAN;
    low = larger(low, 1e-9);
    high = smaller(high, 1 - 1e-9);
    if (gsl_min_fminimizer_set(s, &f, *alpha, low, high) == GSL_SUCCESS)
        for (int i = 0; i < 100 && high - low > 1e-12; i++) {
            if (gsl_min_fminimizer_iterate(s))
                break;
            *alpha = gsl_min_fminimizer_x_minimum(s);
            low = gsl_min_fminimizer_x_lower(s);
            high = gsl_min_fminimizer_x_upper(s);
        }
    gsl_min_fminimizer_free(s);
    projected_sum_of_squares(*alpha, o);
    return FVI_SUCCESS;
}

/* Compute sd and correlations of alpha, rho and k by (24.3). */
static int errors_of(const moduli *o, double alpha, fvi_estimate *fitted)
{
    double a, b, size;
    double(*slopes)[3] = malloc(2 * o->n * sizeof *slopes);
    if (!slopes)
        FVI_FAIL("no memory for the errors", FVI_ENOMEM);
    for (size_t i = 0; i < o->n; i++) {
        row(o, i, alpha, &a, &b, &size);
        const double log_w = 2 * log(o->w[i]); /* for d/dalpha (iw)^(2 alpha) */
        slopes[2 * i][0] = o->rho * (log_w * a - M_PI * b);
        slopes[2 * i + 1][0] = o->rho * (log_w * b + M_PI * a);
        slopes[2 * i][1] = a;
        slopes[2 * i + 1][1] = b;
        slopes[2 * i][2] = 1 / size;
        slopes[2 * i + 1][2] = 0;
    }
    gsl_matrix_view J = gsl_matrix_view_array(*slopes, 2 * o->n, 3);
    const int status =
        fvi_estimation_errors(&J.matrix, fitted->sd, fitted->correlation);
    free(slopes);
    for (size_t j = 0; j < 3 && !status; j++)
        fitted->sd[j] *= fitted->sigma;
    return status || fvi_estimate_is_finite(3, fitted) ? status : FVI_EOVRFLW;
}

static int check(const moduli *o, const fvi_estimate *fitted)
{
    if (!o->w || !o->storage || !o->loss || !fitted)
        FVI_FAIL("a pointer of the moduli is NULL", FVI_EFAULT);
    if (o->n < 2)
        FVI_FAIL("an order takes two frequencies", FVI_EINVAL);
    for (size_t i = 0; i < o->n; i++)
        if (!(o->w[i] > 0) || !isfinite(o->w[i]) || !isfinite(o->storage[i])
            || !isfinite(o->loss[i]) || hypot(o->storage[i], o->loss[i]) == 0)
            FVI_FAIL("frequencies are > 0, moduli finite, not both 0", FVI_EDOM);
    return FVI_SUCCESS;
}

int fvi_estimate_moduli(size_t n, const double *w, const double *storage,
                   const double *loss, fvi_estimate *fitted)
{
    moduli o = { .n = n, .w = w, .storage = storage, .loss = loss };
    double alpha = 0.5;
    int status = check(&o, fitted);
    if (status)
        return status;
    const double freedom = 2 * (double)n - 3;
    fvi_quiet();
    status = best_order(&o, &alpha);
    if (!status) {
        *fitted =
            (fvi_estimate){ .estimate = { alpha, o.rho, o.k },
                          .sigma = sqrt(o.sum / freedom),
                          .chi2 = freedom,
                          .probability = 1,
                          .quantile = gsl_cdf_tdist_Pinv(0.975, freedom) };
        status = errors_of(&o, alpha, fitted);
    }
    fvi_loud();
    return status;
}
