/* tests/identification/test_identification_units.c -- H 24: a fit of the same data in another
 * unit finds the same, in that unit.
 * Run alone: make test-identification_units */
#include "identification_runs.h"

/* A spring in another unit, 1e-9 of the usual one: the box of the caller says so. */
static int nano_value(size_t d, const double *x, void *params, double *value)
{
    (void)d;
    *value = 1e9 * *(const double *)params * x[0] * x[0] / 2;
    return 0;
}

static int nano_gradient(size_t d, const double *x, void *params, double *g)
{
    (void)d;
    g[0] = 1e9 * *(const double *)params * x[0];
    return 0;
}

static int nano_hessian(size_t d, const double *x, void *params, double *H)
{
    (void)d, (void)x;
    H[0] = 1e9 * *(const double *)params;
    return 0;
}

/* Its estimate and sd are 1e-9 of the others, to the errors of both Jacobians (below). */
START_TEST(eq_24_3_a_constant_in_any_unit)
{
    const double low[] = { 0, 0.02, 0.1e-9 }, high[] = { 1, 2, 4e-9 };
    question q, nano;
    fvi_estimate f, g;
    ask(&q, ref_low, 3);
    q.fit.sigma = 1e-3;
    ck_assert_int_eq(fvi_estimate_multistart(&q.fit, NULL, &f), FVI_ETOL);
    ask(&nano, ref_low, 3);
    nano.constants[0] = 2.5e-9;
    nano.system.potential = (fvi_potential){ .value = nano_value,
                                             .gradient = nano_gradient,
                                             .hessian = nano_hessian,
                                             .params = nano.constants };
    nano.fit.sigma = 1e-3;
    nano.fit.low = low;
    nano.fit.high = high;
    ck_assert_int_eq(fvi_estimate_multistart(&nano.fit, NULL, &g), FVI_ETOL);
    ck_assert_near(1e9 * g.estimate[2], f.estimate[2], 1e-9, "c");
    ck_assert_near(1e9 * g.sd[2], f.sd[2], 2e-5 * f.sd[2], "sd");
}
END_TEST

/* Data in units of which not even the square is a double, up or down. The standard
 * deviation and the correlations of a start were infinite, or NaN, there. */
START_TEST(eq_24_3_a_start_in_any_unit)
{
    static const fvi_free_parameter which[] = { FVI_FREE_PARAMETER_ALPHA,
                                           FVI_FREE_PARAMETER_RHO, FVI_FREE_PARAMETER_X0,
                                           FVI_FREE_PARAMETER_P0 };
    fvi_estimate f[3];
    for (int i = 0; i < 3; i++) {
        const double unit = ldexp(1, 525 * (i == 1) - 525 * (i == 2));
        question q;
        ask(&q, ref_low, LEN(which));
        q.constants[0] = 1;
        q.fit.which = which;
        q.x0 *= unit;
        q.p0 *= unit;
        for (size_t k = 0; k < REF_POINTS; k++)
            q.x[k] = unit * (q.x[k] + 1e-3 * sin(37 * (double)k));
        ck_assert_int_eq(fvi_estimate_multistart(&q.fit, NULL, &f[i]), FVI_SUCCESS);
        for (size_t j = 0; j < LEN(which); j++) {
            const double of = j < 2 ? 1 : unit;
            ck_assert_near(f[i].estimate[j] / of, f[0].estimate[j], 1e-8,
                           "estimate %zu", j);
            ck_assert_near(f[i].sd[j] / of, f[0].sd[j], 1e-6 * f[0].sd[j],
                           "sd %zu", j);
            for (size_t k = 0; k < LEN(which); k++)
                ck_assert_near(f[i].correlation[j][k], f[0].correlation[j][k],
                               1e-6, "correlation %zu %zu", j, k);
        }
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("24 identification, units");
    ADD_CASE(suite, "units", eq_24_3_a_constant_in_any_unit, eq_24_3_a_start_in_any_unit);
    return run_suite(suite);
}
