/* tests/damping_laws/test_damping_laws_runs.c -- H 26: motions with a law.
 * Run alone: make test-damping_laws_runs */
#include <fvi/fvi.h>
#include "run/whole_run.h"
#include "harness/ulp.h"

#include "damping_laws_ref.h"

#include <stdlib.h>

static const double one = 1;

static double random_in(double low, double high)
{
    return low + (high - low) * rand() / (double)RAND_MAX;
}

/* x(T) of one mass with U = x^2/2 + g x^4/4, in `steps` steps. */
static double end_of(const fvi_method *method, const fvi_kernel *law, double g,
                     double x0, double p0, double force, double T, size_t steps)
{
    const double cg[] = { 1, g }, A[] = { force, 1e9 };
    const fvi_system system = {
        1, &one, &one, fvi_potential_duffing(cg), fvi_force_step(A), NULL, NULL
    };
    fvi_run run = fvi_run_default(&system, &x0, &p0, T / (double)steps, steps);
    run.law = law;
    run.alpha = 0.8; /* not read */
    double *x = malloc((steps + 1) * sizeof *x);
    ck_assert_int_eq(fvi_trajectory(method, &run, x, NULL, NULL), FVI_SUCCESS);
    const double last = x[steps];
    free(x);
    return last;
}

/* At t = 1 and t = 4, for eight laws and three starts, by 512 and 1024 steps a unit of
 * time. The errors of order 2 are within 10 % of a power, or below 1e-8. */
START_TEST(eq_26_9_motions)
{
    for (size_t i = 0; i < LEN(ref_motions); i++) {
        const fvi_kernel *law = &ref_laws[ref_motions[i].law];
        double error[2][2];
        for (int m = 0; m < 2; m++)
            for (int r = 0; r < 2; r++)
                error[m][r] = end_of(m ? &fvi_cq_bdf2 : &fvi_fractional, law, 0,
                                     ref_motions[i].x0, ref_motions[i].p0,
                                     ref_motions[i].force, ref_motions[i].t,
                                     (size_t)(512 * ref_motions[i].t) << r)
                              - ref_motions[i].x;
        const double one_ = log2(error[0][0] / error[0][1]),
                     two = log2(error[1][0] / error[1][1]);
        seen(one_, "order of fvi");
        ck_assert_near(one_, 1, 0.05, "fvi, row %zu", i);
        ck_assert_double_lt(fabs(error[0][1]), 4e-4);
        if (fabs(error[1][1]) > 1e-8) {
            seen(two, "order of bdf2");
            ck_assert_near(two, 2, 0.2, "bdf2, row %zu", i);
        }
        ck_assert_double_lt(fabs(error[1][1]), 1e-6);
    }
}
END_TEST

/* Nonlinear, from a start at rest nowhere: two methods, three steps each, no reference:
 * what a halved step changes falls by 2 and by 4. */
START_TEST(eq_26_9_orders_of_a_nonlinear_motion)
{
    for (size_t i = 0; i < LEN(ref_laws); i++)
        for (int m = 0; m < 2; m++) {
            double x[4];
            for (int r = 0; r < 4; r++)
                x[r] = end_of(m ? &fvi_cq_bdf2 : &fvi_fractional, &ref_laws[i],
                              0.5, 0.7, 0.4, 0.2, 3, (size_t)1000 << r);
            const double order = log2((x[1] - x[2]) / (x[2] - x[3]));
            seen(order, m ? "order of bdf2" : "order of fvi");
            ck_assert_near(order, m + 1, 0.1 * (m + 1), "law %zu, method %d", i,
                           m);
        }
}
END_TEST

/* A law of one power is the run that alpha gives: 500 steps of a bounded motion, to the
 * rounding of two ways to sum it. BDF2's is another past where 2 alpha > 1. */
START_TEST(a_power_is_the_run_that_alpha_gives)
{
    for (double alpha = 0; alpha <= 1; alpha += 0.125)
        for (int m = 0; m < 2; m++) {
            const fvi_kernel_term term = { FVI_KERNEL_POWER, 0.1, alpha, 0, 0 };
            const fvi_kernel law = { 1, &term };
            const double cg[] = { 1, 0.5 }, x0 = 0.7,
                         p0 = m && alpha > 0.5 ? 0 : 0.4, rho = 0.1;
            const fvi_potential spring = fvi_potential_duffing(cg);
            const fvi_system by_law = { 1, &one, &one, spring, { 0 }, NULL, NULL },
                             by_alpha = { 1, &one, &rho, spring, { 0 }, NULL, NULL };
            fvi_run run = fvi_run_default(&by_law, &x0, &p0, 0.02, 500);
            double x[2][501];
            run.law = &law;
            const fvi_method *method = m ? &fvi_cq_bdf2 : &fvi_fractional;
            ck_assert_int_eq(fvi_trajectory(method, &run, x[0], NULL, NULL),
                             FVI_SUCCESS);
            run.law = NULL;
            run.system = &by_alpha;
            run.alpha = alpha;
            ck_assert_int_eq(fvi_trajectory(method, &run, x[1], NULL, NULL),
                             FVI_SUCCESS);
            for (size_t k = 0; k <= 500; k++)
                ck_assert_near(x[0][k], x[1][k], 1e-12, "alpha %g, k = %zu",
                               alpha, k);
        }
}
END_TEST

/* A law whose terms are all nothing is no damping, and no 0/0. */
START_TEST(a_law_of_nothing_is_no_damping)
{
    const fvi_kernel_term none[] = { { FVI_KERNEL_POWER, 0, 0.3, 0, 0 },
                                  { FVI_KERNEL_MAXWELL, 0, 0, 1, 0 } };
    const fvi_kernel law = { 2, none };
    const double x0 = 1, p0 = 0.5, rho = 0;
    const fvi_history_kind how[] = { FVI_HISTORY_DIRECT,
                                    FVI_HISTORY_MODES };
    for (size_t m = 0; m < 2; m++)
        for (size_t i = 0; i < LEN(how); i++) {
            const fvi_method *method = m ? &fvi_cq_bdf2 : &fvi_fractional;
            const fvi_potential spring = fvi_potential_harmonic(&one);
            const fvi_system damped = { 1, &one, &one, spring, { 0 }, NULL, NULL },
                             free_ = { 1, &one, &rho, spring, { 0 }, NULL, NULL };
            fvi_run run = fvi_run_default(&damped, &x0, &p0, 0.1, 100);
            double x[2][101];
            run.law = &law;
            run.memory = how[i];
            ck_assert_int_eq(fvi_trajectory(method, &run, x[0], NULL, NULL),
                             FVI_SUCCESS);
            run.law = NULL;
            run.system = &free_;
            ck_assert_int_eq(fvi_trajectory(method, &run, x[1], NULL, NULL),
                             FVI_SUCCESS);
            for (size_t k = 0; k <= 100; k++)
                ck_assert_double_eq(x[0][k], x[1][k]);
        }
}
END_TEST

/* Masses that share a law, scaled by their rho; one that is not damped. Copies go on
 * with the same digits. */
START_TEST(a_chain_with_a_law_and_its_copy)
{
    const double mass[] = { 1, 2, 1 }, rho[] = { 1, 0, 0.5 }, cg[] = { 1, 0.2 };
    const double x0[] = { 1, 0, 0 }, p0[] = { 0, 0, 0.3 };
    const fvi_system system = { 3,     mass, rho, fvi_potential_chain(cg),
                                { 0 }, NULL, NULL };
    fvi_run run = fvi_run_default(&system, x0, p0, 0.05, 600);
    double x[2][601 * 3];
    run.law = &ref_laws[5];
    run.memory = FVI_HISTORY_DIRECT;
    ck_assert_int_eq(fvi_trajectory(&fvi_cq_bdf2, &run, x[0], NULL, NULL),
                     FVI_SUCCESS);
    run.memory = FVI_HISTORY_MODES;
    ck_assert_int_eq(fvi_trajectory(&fvi_cq_bdf2, &run, x[1], NULL, NULL),
                     FVI_SUCCESS);
    for (size_t i = 0; i < 601 * 3; i++)
        ck_assert_near(x[0][i], x[1][i], 1e-12, "number %zu", i);
    fvi_stepper *s, *fork;
    ck_assert_int_eq(fvi_stepper_start(&fvi_cq_bdf2, &run, &s,
                                       NULL), FVI_SUCCESS);
    while (s->k < 300)
        fvi_stepper_step(s);
    ck_assert_int_eq(fvi_stepper_copy(s, &fork), FVI_SUCCESS);
    fvi_stepper_free(s);
    while (fork->k < 600)
        fvi_stepper_step(fork);
    for (size_t i = 0; i < 3; i++)
        ck_assert_double_eq(fork->x[i], x[1][600 * 3 + i]);
    fvi_stepper_free(fork);
}
END_TEST

/* (26.10): three percent below the longest stable step a motion stays
 * bounded, three percent above it grows. A light mass, no spring: what a step can do is
 * up to the law alone. */
START_TEST(eq_26_10_the_longest_step)
{
    size_t ran = 0;
    for (size_t i = 0; i < LEN(ref_laws); i++)
        for (int m = 0; m < 2; m++) {
            const fvi_method *method = m ? &fvi_cq_bdf2 : &fvi_fractional;
            const double mass = 1e-3, x0 = 0, p0 = 1e-3;
            const fvi_system system = { 1, &mass, &one, { 0 }, { 0 }, NULL, NULL };
            fvi_run run = fvi_run_default(&system, &x0, &p0, 1, 1);
            double h, last[2] = { 0 };
            run.law = &ref_laws[i];
            ck_assert_int_eq(fvi_stability_longest_step(method, &run, &h), FVI_SUCCESS);
            for (int above = 0; above < 2; above++) {
                static double x[4001];
                run.h = h * (above ? 1.03 : 0.97);
                run.steps = 4000;
                const int status = fvi_trajectory(method, &run, x, NULL, NULL);
                ck_assert(status == FVI_SUCCESS
                          || (above && status == FVI_EOVRFLW));
                last[above] = status ? INFINITY : fabs(x[4000] - x[3999]);
            }
            ck_assert_double_lt(last[0], h);
            ck_assert_double_gt(last[1], 1e6 * h);
            ran++;
        }
    ck_assert_uint_eq(ran, 2 * LEN(ref_laws));
}
END_TEST

/* A spring and two random terms, held, let go with a velocity where the law allows it. */
static double most_energy(const fvi_method *method, const fvi_kernel *law)
{
    enum { STEPS = 300 };
    double x[STEPS + 1], first = 0, worst = 0, scale = 0;
    const double c = pow(10, random_in(-2, 2)), h = pow(10, random_in(-2, 0.5)),
                 p0 = fvi_kernel_growth(law) <= 1 ? random_in(-1, 1) : 0;
    const fvi_system system = { 1,     &one, &one, fvi_potential_harmonic(&c),
                                { 0 }, NULL, NULL };
    fvi_run run = fvi_run_default(&system, &one, &p0, h, STEPS);
    run.law = law;
    run.memory = FVI_HISTORY_DIRECT;
    if (fvi_trajectory(method, &run, x, NULL, NULL))
        return 0; /* a long step overflows */
    const double s = (method == &fvi_cq_bdf2 ? 4 : 2) / h;
    for (size_t k = 0; k < STEPS; k++) {
        const double d = x[k + 1] - x[k], middle = (x[k] + x[k + 1]) / 2,
                     E = d * d / (2 * h * h) + c * middle * middle / 2,
                     hat = fvi_kernel_symbol(law, s) * d * d / 8;
        if (isinf(E + hat))
            break; /* so does the square of a motion that grew long enough */
        first = k ? first : E;
        scale = larger(scale, E + hat);
        worst = larger(worst, (E - hat - first) / scale);
    }
    return worst;
}

/* The corollary: no energy but for some roundings of 300 steps, stable or not. */
START_TEST(eq_26_10_no_law_gains_energy)
{
    srand(7);
    for (int i = 0; i < 200; i++) {
        fvi_kernel_term term[2];
        for (int j = 0; j < 2; j++) {
            const double alpha = random_in(0.01, 0.99);
            term[j] = (fvi_kernel_term){ (fvi_kernel_kind)(rand() % 4),
                                      pow(10, random_in(-2, 1)), alpha,
                                      pow(10, random_in(-2, 2)),
                                      random_in(alpha + 0.001, 1) };
        }
        const fvi_kernel law = { 2, term };
        const double most = larger(most_energy(&fvi_fractional, &law),
                                   most_energy(&fvi_cq_bdf2, &law));
        ck_assert_double_le(most, 300 * 0x1p-52);
    }
}
END_TEST

START_TEST(who_does_not_know_laws_says_so)
{
    const fvi_kernel_term bad = { FVI_KERNEL_POWER, -1, 0.3, 0, 0 };
    const double x0 = 1, p0 = 0;
    const fvi_system system = { 1, &one, &one, { 0 }, { 0 }, NULL, NULL };
    fvi_run run = fvi_run_default(&system, &x0, &p0, 0.1, 10);
    double x[11] = { 7 };
    run.law = &ref_laws[0];
    size_t know = 0;
    for (size_t i = 0; fvi_methods[i]; i++) {
        know += fvi_methods[i]->takes_laws != 0;
        ck_assert_int_eq(fvi_trajectory(fvi_methods[i], &run, x, NULL, NULL),
                         fvi_methods[i]->takes_laws ? FVI_SUCCESS : FVI_EUNSUP);
    }
    ck_assert_uint_eq(know, 19); /* fvi, three of order 2, both forms, fvi-adaptive */
    x[0] = 7;
    run.past = FVI_INITIAL_HISTORY_CAPUTO; /* of orders up to 1 it is held */
    run.alpha = 0.9;                       /* not read */
    double held[11], caputo[11];
    for (size_t i = 0; i < LEN(ref_laws); i++) {
        run.law = &ref_laws[i];
        const int status =
            fvi_trajectory(&fvi_fractional, &run, caputo, NULL, NULL);
        const int steep = fvi_kernel_growth(run.law) > 1;
        ck_assert_int_eq(status, steep ? FVI_EUNSUP : FVI_SUCCESS);
        run.past = FVI_INITIAL_HISTORY_HELD;
        fvi_trajectory(&fvi_fractional, &run, held, NULL, NULL);
        ck_assert(steep || memcmp(held, caputo, sizeof held) == 0);
        run.past = FVI_INITIAL_HISTORY_CAPUTO;
    }
    run.alpha = 0.5;
    run.law = &ref_laws[5];
    x[0] = 7;
    ck_assert_int_eq(fvi_trajectory(&fvi_cq_bdf2, &run, x, NULL, NULL),
                     FVI_EUNSUP);
    run.past = FVI_INITIAL_HISTORY_HELD;
    run.law = &(fvi_kernel){ 1, &bad };
    ck_assert_int_eq(fvi_trajectory(&fvi_cq_bdf2, &run, x, NULL, NULL), FVI_EDOM);
    const double undamped = 0; /* the law is bad even where nobody uses it */
    run.system = &(fvi_system){ 1, &one, &undamped, { 0 }, { 0 }, NULL, NULL };
    ck_assert_int_eq(fvi_trajectory(&fvi_cq_bdf2, &run, x, NULL, NULL), FVI_EDOM);
    run.system = &system;
    ck_assert_double_eq(x[0], 7);
    double load = 7;
    run.law = &ref_laws[0];
    ck_assert_int_eq(fvi_stability_number(&fvi_euler_explicit, &run, &load), FVI_EUNSUP);
    ck_assert_double_eq(load, 7);
}
END_TEST

/* With a law nobody reads alpha, be it 1, where stages take no impulse on a power, or no number:
 * every method, its stability and its copy give the same digits. */
START_TEST(alpha_is_not_read_where_there_is_a_law)
{
    const double J = 0.3, alphas[] = { 0.5, 1, NAN };
    const fvi_impulse hit = { 0.7, &J };
    fvi_system system = { 1, &one, &one, fvi_potential_harmonic(&one), { 0 }, NULL, NULL };
    system.force.impulse_count = 1;
    system.force.impulses = &hit;
    size_t ran = 0;
    for (const fvi_method *const *m = fvi_methods; *m; m++) {
        fvi_run run = fvi_run_default(&system, &one, &one, 0.1, 20);
        double x[3][21], load[3] = { 0 };
        if (!(*m)->takes_laws)
            continue;
        run.law = &ref_laws[0];
        for (size_t i = 0; i < LEN(alphas); i++) {
            run.alpha = alphas[i];
            ck_assert_int_eq(fvi_trajectory(*m, &run, x[i], NULL, NULL), FVI_SUCCESS);
            if ((*m)->stability_number)
                ck_assert_int_eq(fvi_stability_number(*m, &run, &load[i]), FVI_SUCCESS);
            ck_assert_mem_eq(x[i], x[0], sizeof x[0]);
            ck_assert_double_eq(load[i], load[0]);
        }
        ran++;
    }
    ck_assert_uint_eq(ran, 19);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("damping_laws_runs");
    ADD_CASE(suite, "motions", eq_26_9_motions,
             eq_26_9_orders_of_a_nonlinear_motion,
             alpha_is_not_read_where_there_is_a_law,
             a_power_is_the_run_that_alpha_gives,
             a_law_of_nothing_is_no_damping, a_chain_with_a_law_and_its_copy,
             eq_26_10_the_longest_step, eq_26_10_no_law_gains_energy);
    ADD_CASE(suite, "refusals", who_does_not_know_laws_says_so);
    return run_suite(suite);
}
