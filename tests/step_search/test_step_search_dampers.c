/* tests/step_search/test_step_search_dampers.c -- H 18: dampers between points and of matrices have their own
 * orders.
 * Run alone: make test-step_search_dampers */
#include "step_search_runs.h"

#include <fvi/structures.h>
#include <string.h>

enum { COUNT = 5, WIDE = 9 };

/* One body with one damper, between points (bodies = 0) or so many alike of matrices, driven from rest; the
 * error of what is found against the exact motion, or infinity. */
static double error_of_damper(int bodies, const fvi_method *method, double alpha, double w,
                              double T, double error, fvi_step_found *found)
{
    const fvi_linear_oscillator q = { .m = 1, .c = 1, .rho = 0.5, .alpha = alpha, .A = 1, .w = w,
                                      .forcing = FVI_FORCING_COSINE };
    static const double one = 1, none[WIDE], stiffness = 1;
    double row[WIDE][WIDE] = { { 0 } };
    const int size = bodies > 0 ? bodies : 1;
    const double cosine[2] = { 1, w };
    const fvi_kernel_term term = { FVI_KERNEL_POWER, 0.5, alpha, 0, 0 };
    const fvi_kernel kernel = { 1, &term };
    fvi_damper damper[WIDE];
    const fvi_mechanism mechanism = { .damper_count = 1, .damper = damper };
    fvi_triplet entries[WIDE];
    for (int i = 0; i < size; i++) {
        row[i][i] = 1;
        damper[i] = (fvi_damper){ .of = fvi_elongation_row(row[i]), .kernel = &kernel };
        entries[i] = (fvi_triplet){ i, i, 1 };
    }
    fvi_sparse M;
    fvi_structure *structure = NULL;
    ck_assert_int_eq(fvi_sparse_assemble((size_t)size, (size_t)size, entries, &M), 0);
    ck_assert_int_eq(fvi_structure_alloc_dampers(&M, &M, (size_t)size, damper, &structure, NULL), 0);
    fvi_system system = { 1,     &one, none, fvi_potential_harmonic(&stiffness),
                          { 0 }, NULL, &mechanism };
    if (bodies > 0)
        system = fvi_structure_system(structure);
    system.force = fvi_force_cosine(cosine);
    fvi_run run = fvi_run_default(&system, none, none, T / COUNT, COUNT);
    double all[(COUNT + 1) * WIDE], x[COUNT + 1];
    const int status = fvi_step_search(method, &run, error, 1 << 20, all, NULL, found);
    for (int k = 0; k <= COUNT; k++)
        x[k] = all[k * size];
    fvi_structure_free(structure);
    fvi_sparse_free(&M);
    return status ? GSL_POSINF : true_error(&q, run.h, COUNT, x);
}

/* Those of stages are lower than 2 s - 2, as for one damping of this order. */
START_TEST(eq_18_5_the_order_is_that_of_the_dampers)
{
    static const fvi_method *const methods[] = { &fvi_lobatto_d3, &fvi_lobatto_d6, &fvi_lobatto_d8 };
    static const double alphas[] = { 0.6, 0.75, 0.95 };
    for (size_t i = 0; i < LEN(methods) * LEN(alphas) * 2 * 2; i++) {
        const fvi_method *method = methods[i % LEN(methods)];
        const double alpha = alphas[i / LEN(methods) % LEN(alphas)],
                     T = i / LEN(methods) / LEN(alphas) / 2 ? 200 : 50;
        const int is_matrix = (int)(i / LEN(methods) / LEN(alphas) % 2);
        fvi_step_found found;
        const double off = error_of_damper(is_matrix, method, alpha, 3, T, 1e-5, &found);
        ck_assert_msg(off <= 1e-5, "%s alpha %g T %g matrix %d: %g", method->name, alpha, T,
                      is_matrix, off);
    }
}
END_TEST

/* The damping does not ask for shorter steps where the differences are rounding: near the order 2 its
 * load falls with no step. Nor is the estimate far below what eight stages of matrices can do, which lose digits where
 * there are more than 64 equations. */
START_TEST(eq_18_6_rounding_is_seen_beside_a_damping_that_is_nearly_a_mass)
{
    static const fvi_method *const methods[] = { &fvi_lobatto_d4, &fvi_lobatto_d6, &fvi_lobatto_d8 };
    static const double alphas[] = { 0.9, 0.99, 1 };
    for (size_t i = 0; i < LEN(methods) * LEN(alphas) * 2; i++) {
        const fvi_method *method = methods[i % LEN(methods)];
        const double alpha = alphas[i / LEN(methods) % LEN(alphas)],
                     w = i / LEN(methods) / LEN(alphas) ? 3 : 1, T = w == 3 ? 50 : 5;
        fvi_step_found found;
        const int bodies = method == &fvi_lobatto_d8 ? WIDE : 1;
        const double off = error_of_damper(bodies, method, alpha, w, T, 1e-6, &found);
        ck_assert_msg(isfinite(off) && off <= 2 * found.estimate + 1e-13, "%s alpha %g T %g: %g of %g", method->name,
                      alpha, T, off, found.estimate);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("the search for a step: dampers");
    ADD_CASE(suite, "dampers", eq_18_5_the_order_is_that_of_the_dampers,
             eq_18_6_rounding_is_seen_beside_a_damping_that_is_nearly_a_mass);
    return run_suite(suite);
}
