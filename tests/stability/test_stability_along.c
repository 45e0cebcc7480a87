/* tests/stability/test_stability_along.c -- H 14: the stability number along a run.
 * Run alone: make test-stability_along */
#include <fvi/fvi.h>
#include "run/whole_run.h"
#include "harness/ulp.h"

#include <gsl/gsl_math.h>

enum { D = 4 };
static const double m[D] = { 1, 2, 0.5, 3 }, rho[D] = { 0.1, 0, 1, 0.3 },
                    x0[D] = { 0 }, far[D] = { 1, -1, 2, 0.5 };
static double cg[] = { 1, 1 };
static int asked;

static int counted(size_t d, const double *x, void *params, double *H)
{
    asked++;
    return fvi_potential_chain(cg).hessian(d, x, params, H);
}

/* At x the load is that of a run which starts at x; it is asked for only where it is
 * stiffer than before, by 5 per cent at least; a chain in diagonals and the same in full
 * agree. */
START_TEST(eq_14_6_the_load_along_a_run)
{
    fvi_system system = { D, m, rho, fvi_potential_chain(cg), { 0 }, NULL, NULL };
    const fvi_method *const some[] = { &fvi_fractional, &fvi_lobatto_m2,
                                       &fvi_lobatto_m5, &fvi_cq2_midpoint };
    for (size_t i = 0; i < LEN(some); i++) {
        fvi_run run = fvi_run_default(&system, x0, x0, 0.5, 10);
        double stiffest = 0, load = 7, want = 0;
        run.kappa = 0;
        for (int turn = 0; turn < 2; turn++) {
            const double *x = turn ? far : x0;
            fvi_run here = run;
            here.x0 = x;
            ck_assert_int_eq(
                fvi_stability_along_run(some[i], &run, x, &stiffest, &load), 0);
            ck_assert_int_eq(fvi_stability_number(some[i], &here, &want), 0);
            ck_assert(load == want && (want > 0) == (some[i] != &fvi_cq2_midpoint));
        }
        /* row 1: (c + 3 g r^2) of the springs at 2 and 3 beside it, over m, twice */
        const double springs = 1 + 3 * 9, third = 1 + 3 * 2.25;
        ck_assert_near(stiffest, 2 * (springs + third) / 0.5, 200 * U, "row 3");
        for (size_t j = 0; j < 2; j++) { /* not stiffer: not asked */
            ck_assert_int_eq(fvi_stability_along_run(some[i], &run, j ? x0 : far,
                                                 &stiffest, &load),
                             0);
            ck_assert(load == 0);
        }
    }
    system.potential.hessian = counted;
    const fvi_run run = fvi_run_default(&system, x0, x0, 0.5, 10);
    double stiffest = 1e9, load = 7;
    ck_assert_int_eq(
        fvi_stability_along_run(&fvi_lobatto_m3, &run, far, &stiffest, &load), 0);
    ck_assert(asked == 1 && load == 0 && stiffest == 1e9);
}
END_TEST

/* A spring that hardens is pulled to x = 1.5, 1.6, ..., 2.5: small motions about x, those of
 * the spring c = 1 + 3 x^2, with two stages grow if and only if the load at x is above 1. */
START_TEST(eq_14_6_small_motions_grow_where_the_load_says_so)
{
    const double one = 1, damping = 0.05, pair[] = { 1, 1 };
    const fvi_system system = { 1,        &one,
                                &damping, fvi_potential_duffing(pair),
                                { 0 },    NULL, NULL };
    for (int i = -5; i <= 5; i++) {
        const double place = 2 + 0.1 * i, none = 0;
        /* the same spring, linear: c = 1 + 3 x^2 */
        const double c = 1 + 3 * place * place;
        const fvi_system linear = { 1,        &one,
                                    &damping, fvi_potential_harmonic(&c),
                                    { 0 },    NULL, NULL };
        fvi_run run = fvi_run_default(&system, &none, &none, 0.55, 2000);
        run.alpha = 0.3;
        double stiffest = 0, load = 0, x[2001];
        const double small = 1e-3;
        ck_assert_int_eq(
            fvi_stability_along_run(&fvi_lobatto_m2, &run, &place, &stiffest, &load),
            0);
        fvi_run about = run;
        about.system = &linear;
        about.x0 = &small;
        const int grows =
            fvi_trajectory(&fvi_lobatto_m2, &about, x, NULL, NULL) != 0
            || fabs(x[2000]) > 1;
        ck_assert_msg(grows == (load > 1), "%g: load %g, %g", place, load,
                      x[2000]);
    }
}
END_TEST

START_TEST(bad_questions_about_a_place_are_refused)
{
    const fvi_system system = {
        D, m, rho, fvi_potential_chain(cg), { 0 }, NULL, NULL
    };
    fvi_run run = fvi_run_default(&system, x0, x0, 0.5, 10);
    double stiffest = 3, load = 7;
    ck_assert_int_eq(fvi_stability_along_run(NULL, &run, x0, &stiffest, &load),
                     FVI_EFAULT);
    ck_assert_int_eq(
        fvi_stability_along_run(&fvi_lobatto_m2, NULL, x0, &stiffest, &load),
        FVI_EFAULT);
    ck_assert_int_eq(
        fvi_stability_along_run(&fvi_lobatto_m2, &run, NULL, &stiffest, &load),
        FVI_EFAULT);
    ck_assert_int_eq(fvi_stability_along_run(&fvi_lobatto_m2, &run, x0, NULL, &load),
                     FVI_EFAULT);
    ck_assert_int_eq(
        fvi_stability_along_run(&fvi_lobatto_m2, &run, x0, &stiffest, NULL),
        FVI_EFAULT);
    ck_assert_int_eq(
        fvi_stability_along_run(&fvi_variable_step, &run, far, &stiffest, &load),
        FVI_EUNSUP);
    run.h = -1;
    ck_assert_int_eq(
        fvi_stability_along_run(&fvi_lobatto_m2, &run, far, &stiffest, &load),
        FVI_EDOM);
    ck_assert(stiffest == 3 && load == 7);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("the load along a run");
    ADD_CASE(suite, "values", eq_14_6_the_load_along_a_run,
             eq_14_6_small_motions_grow_where_the_load_says_so);
    ADD_CASE(suite, "errors", bad_questions_about_a_place_are_refused);
    return run_suite(suite);
}
