/* tests/structures/test_structures_dampers.c -- Structures with several dampers.
 * Run alone: make test-structures_dampers */
#include "building_error.h"
#include "run/whole_run.h"

enum { N = 300 };

/* ---- one damper is C ---- */

/* The run of a structure with C, and the one of a structure with one damper: the same bits. */
static void ck_assert_same_bits(const fvi_method *method, const fvi_run *run,
                                const fvi_system *other)
{
    double x[(N + 1) * D], p[(N + 1) * D], X[(N + 1) * D], P[(N + 1) * D];
    fvi_run by_damper = *run;
    by_damper.system = other;
    by_damper.past = FVI_INITIAL_HISTORY_HELD; /* not read, as alpha and law are not */
    by_damper.law = NULL;
    by_damper.alpha = 0.5;
    OK(fvi_trajectory(method, run, x, p, NULL));
    OK(fvi_trajectory(method, &by_damper, X, P, NULL));
    ck_assert_msg(memcmp(x, X, sizeof x) == 0 && memcmp(p, P, sizeof p) == 0,
                  "%s alpha %g past %d", method->name, run->alpha, (int)run->past);
}

static const double x0[D] = { 1, 0, -0.5, 0.2, 0.3 }, p0[D] = { 0, 0.3, 0.1, -1, 0.2 },
                    mass[D] = { 1, 2, 0.5, 1.5, 1 };

/* By powers of all orders and all pasts, and by a fraction; C touches all unknowns, or the
 * differences of some. */
START_TEST(eq_27_11_one_damper_is_the_damping_matrix_to_the_bit)
{
    static const double alphas[] = { 0, 0.3, 0.5, 0.7, 1 };
    const fvi_kernel_term fraction = { FVI_KERNEL_ZENER, 0.5, 0.3, 2, 0 };
    const fvi_kernel zener = { 1, &fraction };
    for (size_t i = 0; i < LEN(takers) * (LEN(alphas) * 3 + 1) * 2; i++) {
        const size_t which = i / LEN(takers) / 2;
        const double alpha = alphas[which / 3 % LEN(alphas)];
        const fvi_kernel_term power = { FVI_KERNEL_POWER, 1, alpha, 0, 0 };
        const int is_law = which == LEN(alphas) * 3;
        const fvi_kernel kernel = is_law ? zener : (fvi_kernel){ 1, &power };
        matrices m;
        diagonal(1, mass, &m.M);
        tridiagonal(D, 4, -2, &m.K);
        if (i / LEN(takers) % 2)
            diagonal(0.1, ones, &m.C);
        else
            tridiagonal(D, 0.2, -0.1, &m.C);
        make(&m);
        fvi_run run = run_of(&m.system, alpha, 0.05, N, x0, p0);
        run.past = is_law ? FVI_INITIAL_HISTORY_HELD : (fvi_initial_history)(which % 3);
        run.law = is_law ? &kernel : NULL;
        const fvi_damper damper = { .matrix = &m.C, .kernel = &kernel, .past = run.past };
        fvi_structure *other;
        OK(fvi_structure_alloc_dampers(&m.M, &m.K, 1, &damper, &other, NULL));
        const fvi_system system = fvi_structure_system(other);
        if (run.past != FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE || alpha <= 0.5)
            ck_assert_same_bits(takers[i % LEN(takers)], &run, &system);
        fvi_structure_free(other);
        drop(&m);
    }
}
END_TEST

/* ---- the building ---- */

/* The highest mode has h w = 0.04 with the shorter step: its orders are seen to 0.1. Seen:
 * 0.90, 2.01, 2.00, 2.01. */
START_TEST(eq_27_11_the_building_to_the_order_of_each_method)
{
    building b;
    build(&b);
    for (size_t i = 0; i < LEN(takers); i++) {
        const double coarse = error_of(takers[i], &b, 1600),
                     fine = error_of(takers[i], &b, 3200),
                     order = log2(coarse / fine), want = i == 0 ? 1 : 2;
        ck_assert_msg(fabs(order - want) <= 0.1, "%s: %g, from %g", takers[i]->name, order,
                      fine);
        ck_assert_msg(fine <= (i == 0 ? 2e-2 : 2e-3), "%s: %g", takers[i]->name, fine);
        seen(order, "order of %s", takers[i]->name);
    }
    free_building(&b);
}
END_TEST

/* C = C_1 + C_2 with one kernel for both is one damper: the sums of both go to p one after
 * another. N steps, as eq_27_1. Seen: 1e-14 of 1e-12. */
START_TEST(eq_27_11_a_matrix_may_be_cut_in_two)
{
    const fvi_kernel_term power = { FVI_KERNEL_POWER, 0.3, 0.3, 0, 0 };
    const fvi_kernel kernel = { 1, &power };
    double worst = 0;
    for (size_t i = 0; i < LEN(takers); i++) {
        matrices m;
        fvi_sparse half;
        fvi_structure *one, *two;
        double x[(N + 1) * D], X[(N + 1) * D];
        diagonal(1, mass, &m.M);
        tridiagonal(D, 4, -2, &m.K);
        tridiagonal(D, 2, 1, &m.C);
        tridiagonal(D, 1, 0.5, &half);
        const fvi_damper whole = { .matrix = &m.C, .kernel = &kernel },
                         parts[2] = { { .matrix = &half, .kernel = &kernel },
                                      { .matrix = &half, .kernel = &kernel } };
        OK(fvi_structure_alloc_dampers(&m.M, &m.K, 1, &whole, &one, NULL));
        OK(fvi_structure_alloc_dampers(&m.M, &m.K, 2, parts, &two, NULL));
        m.system = fvi_structure_system(one);
        fvi_run run = run_of(&m.system, 0.5, 0.05, N, x0, p0);
        OK(fvi_trajectory(takers[i], &run, x, NULL, NULL));
        m.system = fvi_structure_system(two);
        OK(fvi_trajectory(takers[i], &run, X, NULL, NULL));
        for (size_t l = 0; l < LEN(x); l++)
            worst = larger(worst, fabs(x[l] - X[l]));
        m.structure = two;
        fvi_structure_free(one);
        fvi_sparse_free(&half);
        drop(&m);
    }
    ck_assert_msg(worst <= 1e-12, "%g", worst);
    seen_worst(worst, "cut in two");
}
END_TEST

/* ---- stability ---- */

/* max |x| of 20000 steps less than that of the start times 100? */
static int is_stable(const fvi_method *method, const fvi_run *run)
{
    fvi_stepper *s;
    double most = 0;
    int status = fvi_stepper_start(method, run, &s, NULL);
    while (!status && s->k < run->steps && most < 100) {
        status = fvi_stepper_step(s);
        for (size_t i = 0; i < D; i++)
            most = larger(most, fabs(s->x[i]));
    }
    fvi_stepper_free(s);
    return !status && most < 100;
}

/* Runs on both sides of the longest step, which is a bound from below within some percent. */
START_TEST(eq_27_9_the_longest_step_of_several_dampers)
{
    building b;
    build(&b);
    for (size_t i = 0; i < 2; i++) {
        const fvi_method *method = i ? &fvi_cq_bdf2 : &fvi_fractional;
        double h;
        fvi_run run = run_of(&b.system, 0.5, 0.1, 20000, shape, push);
        run.kappa = 1;
        OK(fvi_stability_longest_step(method, &run, &h));
        run.h = 0.97 * h;
        ck_assert_msg(is_stable(method, &run), "%s %g", method->name, h);
        run.h = 1.06 * h;
        ck_assert_msg(!is_stable(method, &run), "%s %g", method->name, h);
    }
    double load;
    fvi_run run = run_of(&b.system, 0.5, 10, 5000, shape, push);
    OK(fvi_stability_number(&fvi_cq2_midpoint, &run, &load));
    ck_assert(load == 0 && is_stable(&fvi_cq2_midpoint, &run));
    free_building(&b);
}
END_TEST

/* ---- what is refused ---- */

static int value(double t, size_t d, const double *x, void *params, double *g)
{
    (void)t, (void)d, (void)params;
    *g = *x * *x;
    return 0;
}

START_TEST(dampers_that_are_none_are_refused_by_their_number)
{
    building b;
    build(&b);
    fvi_sparse small, negative;
    const fvi_triplet one = { 0, 0, 1 }, less = { 0, 0, -1 };
    OK(fvi_sparse_assemble(2, 1, &one, &small));
    OK(fvi_sparse_assemble(D, 1, &less, &negative));
    const double bad[D] = { 1, NAN };
    const struct {
        fvi_damper damper;
        int code;
    } wrong[] = {
        { { .of = { .value = value }, .kernel = b.kernel }, FVI_EUNSUP },
        { { .kernel = b.kernel }, FVI_EUNSUP },
        { { .matrix = &b.M }, FVI_EFAULT },
        { { .matrix = &small, .kernel = b.kernel }, FVI_EINVAL },
        { { .matrix = &negative, .kernel = b.kernel }, FVI_EDOM },
        { { .of = { .row = bad }, .kernel = b.kernel }, FVI_EDOM },
    };
    for (size_t i = 0; i < LEN(wrong); i++) {
        const fvi_damper two[] = { b.damper[0], wrong[i].damper };
        fvi_structure *s = NULL;
        fvi_error error = { 0 };
        ck_assert_int_eq(fvi_structure_alloc_dampers(&b.M, &b.K, 2, two, &s, &error),
                         wrong[i].code);
        ck_assert_msg(strcmp(error.field, "damper") == 0, "%zu: %s", i, error.field);
        ck_assert(!s && error.index == 1);
    }
    fvi_sparse_free(&small);
    fvi_sparse_free(&negative);
    free_building(&b);
}
END_TEST

START_TEST(a_run_with_several_dampers_has_no_law_and_no_past_of_its_own)
{
    building b;
    build(&b);
    fvi_stepper *s = NULL;
    fvi_error error;
    fvi_run run = run_of(&b.system, 0.5, 0.1, 10, shape, push);
    run.law = b.kernel;
    ck_assert_int_eq(fvi_stepper_start(&fvi_cq_bdf2, &run, &s, &error), FVI_EUNSUP);
    ck_assert_str_eq(error.field, "law");
    run.law = NULL;
    run.past = FVI_INITIAL_HISTORY_CAPUTO;
    ck_assert_int_eq(fvi_stepper_start(&fvi_cq_bdf2, &run, &s, &error), FVI_EUNSUP);
    ck_assert_str_eq(error.field, "past");
    run.past = FVI_INITIAL_HISTORY_HELD;
    b.term[1].alpha = 2;
    ck_assert_int_eq(fvi_stepper_start(&fvi_cq_bdf2, &run, &s, &error), FVI_EDOM);
    ck_assert_str_eq(error.text, "damper 2: its kernel is no law of damping: a number is out of its range");
    ck_assert_str_eq(error.field, "damper");
    b.term[1].alpha = 0.6875;
    b.damper[1].past = FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE; /* of an order above 1, */
    OK(fvi_stepper_start(&fvi_cq_bdf2, &run, &s, &error));    /* which the start does not stretch */
    fvi_stepper_free(s);
    s = NULL;
    run.x0 = mass; /* this one does */
    ck_assert_int_eq(fvi_stepper_start(&fvi_cq_bdf2, &run, &s, &error), FVI_EUNSUP);
    ck_assert_str_eq(error.field, "damper");
    ck_assert_uint_eq(error.index, 1);
    run.x0 = shape;
    b.damper[1].past = FVI_INITIAL_HISTORY_CAPUTO;
    OK(fvi_stepper_start(&fvi_cq_bdf2, &run, &s, &error));
    fvi_stepper_free(s);
    s = NULL;
    ck_assert_int_eq(fvi_stepper_start(&fvi_lobatto_m3, &run, &s, &error), FVI_EUNSUP);
    fvi_matrices alone = *b.system.matrices;
    alone.damper_count = 2; /* not those of the mechanism */
    b.system.matrices = &alone;
    ck_assert_int_eq(fvi_stepper_start(&fvi_cq_bdf2, &run, &s, &error), FVI_EINVAL);
    ck_assert_str_eq(error.field, "mechanism");
    ck_assert(!s);
    free_building(&b);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("structures_dampers");
    ADD_CASE(suite, "dampers", eq_27_11_one_damper_is_the_damping_matrix_to_the_bit,
             eq_27_11_a_matrix_may_be_cut_in_two,
             eq_27_11_the_building_to_the_order_of_each_method,
             eq_27_9_the_longest_step_of_several_dampers);
    ADD_CASE(suite, "refused", dampers_that_are_none_are_refused_by_their_number,
             a_run_with_several_dampers_has_no_law_and_no_past_of_its_own);
    return run_suite(suite);
}
