/* tests/identification/test_identification_moduli.c -- H 24: an order from storage and loss moduli.
 * Run alone: make test-identification_moduli */
#include "identification_runs.h"
#include "system/larger.h"

#include <complex.h>

enum { N = 20 };

/* k + rho (i w)^(2 alpha), from w = 0.1 to 10, as complex numbers have it. */
static void moduli(double alpha, double rho, double k, double *w,
                   double *storage, double *loss)
{
    for (int i = 0; i < N; i++) {
        w[i] = 0.1 * pow(100, (double)i / (N - 1));
        const double complex G = k + rho * cpow(I * w[i], 2 * alpha);
        storage[i] = creal(G);
        loss[i] = cimag(G);
    }
}

/* Near the minimum the sum of squares differs by its second order, so that alpha is had to
 * the root of rounding: about 1e-8. Seen: 1e-9. */
START_TEST(eq_24_9_exact_moduli_give_the_order_back)
{
    double w[N], storage[N], loss[N];
    for (int i = 1; i < 20; i++) {
        const double alpha = 0.05 * i + 0.0037; /* not one that is scanned */
        fvi_estimate f;
        moduli(alpha, 0.7, 1.3, w, storage, loss);
        ck_assert_int_eq(fvi_estimate_moduli(N, w, storage, loss, &f), FVI_SUCCESS);
        const double error = larger(
            fabs(f.estimate[0] - alpha),
            larger(fabs(f.estimate[1] - 0.7), fabs(f.estimate[2] - 1.3)));
        seen(error, "error");
        ck_assert_msg(error < 1e-6, "alpha %g: %g", alpha, error);
    }
}
END_TEST

/* The scatter of 400 estimates, relative noise of 1 %, over the mean of their sd: 1 within
 * four of its standard deviations, 4 / sqrt(2 * 400). */
START_TEST(eq_24_9_moduli_scatter_as_they_say)
{
    enum { SETS = 400 };
    const double truth[] = { 0.35, 0.7, 1.3 };
    double w[N], storage[N], loss[N], square[3] = { 0 }, sd[3] = { 0 };
    gsl_rng *r = gsl_rng_alloc(gsl_rng_mt19937);
    for (int set = 0; set < SETS; set++) {
        fvi_estimate f;
        moduli(truth[0], truth[1], truth[2], w, storage, loss);
        for (int i = 0; i < N; i++) {
            const double size = hypot(storage[i], loss[i]);
            storage[i] += gsl_ran_gaussian(r, 0.01 * size);
            loss[i] += gsl_ran_gaussian(r, 0.01 * size);
        }
        ck_assert_int_eq(fvi_estimate_moduli(N, w, storage, loss, &f), FVI_SUCCESS);
        for (int j = 0; j < 3; j++) {
            square[j] += gsl_pow_2(f.estimate[j] - truth[j]) / SETS;
            sd[j] += f.sd[j] / SETS;
        }
    }
    for (int j = 0; j < 3; j++) {
        const double ratio = sqrt(square[j]) / sd[j];
        seen(ratio, "scatter over sd");
        ck_assert_msg(fabs(ratio - 1) < 4 / sqrt(2. * SETS), "%d: %g", j,
                      ratio);
    }
    gsl_rng_free(r);
}
END_TEST

START_TEST(moduli_refuse_what_is_no_data)
{
    double w[N], storage[N], loss[N];
    fvi_estimate f;
    moduli(0.3, 0.7, 1.3, w, storage, loss);
    fvi_set_error_handler(handler);
    ck_assert_int_eq(fvi_estimate_moduli(N, NULL, storage, loss, &f), FVI_EFAULT);
    ck_assert_int_eq(fvi_estimate_moduli(N, w, NULL, loss, &f), FVI_EFAULT);
    ck_assert_int_eq(fvi_estimate_moduli(N, w, storage, NULL, &f), FVI_EFAULT);
    ck_assert_int_eq(fvi_estimate_moduli(N, w, storage, loss, NULL), FVI_EFAULT);
    ck_assert_int_eq(fvi_estimate_moduli(1, w, storage, loss, &f), FVI_EINVAL);
    w[3] = 0;
    ck_assert_int_eq(fvi_estimate_moduli(N, w, storage, loss, &f), FVI_EDOM);
    ck_assert_int_eq(handled, 6);
    for (int i = 0; i < N; i++) { /* one frequency */
        w[i] = 1;
        storage[i] = 1;
        loss[i] = 0.5;
    }
    ck_assert_int_eq(fvi_estimate_moduli(N, w, storage, loss, &f), FVI_ESING);
    ck_assert_int_eq(handled, 6);
    fvi_set_error_handler(NULL);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("an order from storage and loss");
    ADD_CASE(suite, "values", eq_24_9_exact_moduli_give_the_order_back,
             eq_24_9_moduli_scatter_as_they_say);
    ADD_CASE(suite, "errors", moduli_refuse_what_is_no_data);
    return run_suite(suite);
}
