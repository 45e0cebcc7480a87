/* figures/fractional_derivative/fractional_derivative.c -- H 1: derivatives of a sine of orders between 0 and 1,
 * and the convergence of the Grünwald-Letnikov sum.
 *
 * - Block 0: t, D_-^alpha sin(t) from t = 0 on for five alpha, and sin(t + pi/4), which is the half derivative
 *   of a sine that has no beginning.
 * - Block 1: h and the error of the sum at t = 1, for three alpha, for sin and then for cos.
 * - Block 2: alpha, then for sin and for cos the predicted |error| / h and the slope that is fitted to the
 *   errors. */
#include <fvi/error.h>
#include <fvi/paper/fractional_derivative.h>
#include <fvi/paper/integration_by_parts.h>

#include <gsl/gsl_fit.h>
#include <gsl/gsl_math.h>
#include <stdio.h>
#include <stdlib.h>

enum { POINTS = 300, ORDERS = 3, STEPS = 9, N = 1024 };

static const double orders[ORDERS] = { 0.3, 0.6, 0.9 };

static double sine(double t, const void *phase)
{
    return sin(t + *(const double *)phase);
}

static double dsine(double t, const void *phase)
{
    return cos(t + *(const double *)phase);
}

static int carried(void)
{
    const double none = 0;
    const fvi_curve curve = { sine, dsine, &none };
    printf(
        "# t  D^alpha sin(t) for alpha = 0, 1/4, 1/2, 3/4, 1  sin(t + pi/4)\n");
    for (int k = 0; k <= POINTS; k++) {
        double t = 4 * M_PI * k / POINTS;
        printf("%.17g", t);
        for (int i = 0; i <= 4; i++) {
            double d = 0;
            int status =
                fvi_riemann_liouville(FVI_RETARDED, i / 4.0, 0, &curve, t, &d);
            if (status)
                return status;
            printf(" %.17g", d);
        }
        printf(" %.17g\n", sin(t + M_PI / 4));
    }
    printf("\n\n");
    return FVI_SUCCESS;
}

/* Compute (1.13), the limit for h -> 0 of (error of the sum) / h at t = 1. */
static int predicted(double alpha, const double *phase, double *limit)
{
    const double ahead = *phase + M_PI / 2; /* f'(t) = f(t + pi/2) */
    const fvi_curve velocity = { sine, dsine, &ahead };
    double d = 0;
    int status =
        fvi_riemann_liouville(FVI_RETARDED, alpha, 0, &velocity, 1, &d);
    *limit = -alpha / 2 * d + (1 - alpha) / 2 * sine(0, phase) / tgamma(-alpha);
    return status;
}

static int error_of_sum(double alpha, const double *phase, size_t M,
                        double *error)
{
    static double f[N + 1], D[N + 1];
    const fvi_curve curve = { sine, dsine, phase };
    double h = 1 / (double)M, d = 0;
    for (size_t k = 0; k <= M; k++)
        f[k] = sine((double)k * h, phase);
    int status = fvi_delta_minus(alpha, h, M, 1, f, D);
    if (!status)
        status = fvi_riemann_liouville(FVI_RETARDED, alpha, 0, &curve, 1, &d);
    *error = fabs(D[M] - d);
    return status;
}

int main(void)
{
    const double phase[2] = { 0, M_PI / 2 }; /* sin, cos */
    double h[STEPS], e[2 * ORDERS][STEPS], x[STEPS], y[STEPS], c[6];
    int status = carried();
    printf("# h  error for sin, alpha = 0.3, 0.6, 0.9; for cos, the same\n");
    for (size_t n = 0; n < STEPS && !status; n++) {
        size_t M = (size_t)N >> (STEPS - 1 - n);
        h[n] = 1 / (double)M;
        printf("%.17g", h[n]);
        for (size_t i = 0; i < 2 * ORDERS && !status; i++) {
            status = error_of_sum(orders[i % ORDERS], &phase[i / ORDERS], M,
                                  &e[i][n]);
            printf(" %.17g", e[i][n]);
        }
        printf("\n");
    }
    printf("\n\n# alpha  predicted |error|/h and fitted slope, for sin; for "
           "cos\n");
    for (size_t i = 0; i < ORDERS && !status; i++) {
        printf("%.17g", orders[i]);
        for (size_t j = 0; j < 2 && !status; j++) {
            double limit = 0;
            status = predicted(orders[i], &phase[j], &limit);
            for (size_t n = 0; n < STEPS; n++) {
                x[n] = log(h[n]);
                y[n] = log(e[i + j * ORDERS][n]);
            }
            gsl_fit_linear(x + 2, 1, y + 2, 1, STEPS - 2, c, c + 1, c + 2,
                           c + 3, c + 4, c + 5);
            printf(" %.17g %.17g", fabs(limit), c[1]);
        }
        printf("\n");
    }
    return status ? EXIT_FAILURE : EXIT_SUCCESS;
}
