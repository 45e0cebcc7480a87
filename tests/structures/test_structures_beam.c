/* tests/structures/test_structures_beam.c -- H 27: a clamped beam, compared with its known properties.
 * Run alone: make test-structures_beam */
#include "structures_runs.h"
#include "run/whole_run.h"

#include "structures_ref.h"
#include "system/larger.h"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_eigen.h>

/* v^T K v, as a sum of squares over elements: exact to some units of roundoff. */
static double bending_energy(int n, const double *v)
{
    const double l = 1 / (double)n;
    double w = 0, s = 0, sum = 0;
    for (int e = 0; e < n; e++) {
        const double *right = v + 2 * e, bend = s - right[1],
                     shear = w - right[0] + (s + right[1]) / 2;
        sum += (12 * shear * shear + bend * bend) / (l * l * l);
        w = right[0];
        s = right[1];
    }
    return sum;
}

/* Inverse iteration: v, 1 at the tip, and its eigenvalue. */
static double lowest_mode(const matrices *m, double *v)
{
    const size_t d = m->M.n;
    const fvi_matrices *f = m->system.matrices;
    void *factors;
    double *y = malloc(d * sizeof *y), norm = 0;
    OK(f->factorise(d, 0, NULL, 1, f->params, &factors));
    for (size_t i = 0; i < d; i++)
        v[i] = 1;
    for (int k = 0; k < 30; k++) {
        fvi_sparse_multiply(&m->M, v, y);
        OK(f->solve(d, factors, y));
        for (size_t i = 0; i < d; i++)
            v[i] = y[i] / y[d - 2];
    }
    fvi_sparse_multiply(&m->M, v, y);
    for (size_t i = 0; i < d; i++)
        norm += v[i] * y[i];
    f->free_factors(factors);
    free(y);
    return bending_energy((int)d / 2, v) / norm;
}

START_TEST(eq_27_5_the_cantilevers_first_mode_is_one_oscillator)
{
    enum { n = 16, d = 2 * n, STEPS = 400 };
    const double tau = 0.05, alpha = 0.25;
    matrices m;
    OK(cantilever(n, tau, &m.M, &m.K, &m.C));
    make(&m);
    ck_assert_str_eq(fvi_structure_solver_name(m.structure, 1, 1, 1), "band");
    double v[d], p0[d] = { 0 }, x[(STEPS + 1) * d], y[STEPS + 1];
    const double lambda = lowest_mode(&m, v), c = tau * lambda, one = 1,
                 none = 0;
    const beam b = { n, tau, m.system.matrices };
    const fvi_matrices by_elements = beam_matrices(&b);
    fvi_system free_ = m.system;
    free_.matrices = &by_elements;
    const fvi_system single = { .d = 1,
                                .mass = &one,
                                .damping = &c,
                                .potential = fvi_potential_harmonic(&lambda) };
    const fvi_run scalar = run_of(&single, alpha, 0.02, STEPS, &one, &none);
    OK(fvi_trajectory(&fvi_cq2_midpoint, &scalar, y, NULL, NULL));
    for (int k = 0; k < 2; k++) {
        fvi_run whole = scalar;
        double worst = 0;
        whole.system = k ? &m.system : &free_;
        whole.x0 = v;
        whole.p0 = p0;
        OK(fvi_trajectory(&fvi_cq2_midpoint, &whole, x, NULL, NULL));
        for (size_t l = 0; l < (STEPS + 1) * d; l++)
            worst = larger(worst, fabs(x[l] - y[l / d] * v[l % d]));
        seen(worst, "%s", k ? "assembled" : "by elements");
        ck_assert(worst <= (k ? 1e-10 : 1e-13));
    }
    drop(&m);
}
END_TEST

/* ---- against the beam itself ---- */

/* (27.7): lambda_h = lambda (1 + lambda l^4/720 + O(lambda^2 l^8)), but for the rounding of
 * the eigenvector, to whose square it is exact. Seen: 0.4 of the bound. */
START_TEST(eq_27_7_elements_stiffen_a_mode_by_the_fourth_power_of_their_length)
{
    for (int n = 2; n <= 32; n *= 2) {
        matrices m;
        double v[2 * 32];
        OK(cantilever(n, 0, &m.M, &m.K, &m.C));
        make(&m);
        const double exact = ref_clamped[0].lambda, l = 1.0 / n,
                     extra = exact * l * l * l * l / 720,
                     found = lowest_mode(&m, v) / exact - 1;
        ck_assert_near(found, extra, extra * l * l + 1e-14, "%d elements", n);
        drop(&m);
    }
}
END_TEST

enum { n_few = 8, d_few = 2 * n_few };

/* All modes of M and K, each with v^T M v = 1. */
static void all_modes(const matrices *m, double lambda[d_few],
                      double v[d_few][d_few])
{
    gsl_matrix *K = gsl_matrix_calloc(d_few, d_few),
               *M = gsl_matrix_calloc(d_few, d_few),
               *V = gsl_matrix_alloc(d_few, d_few);
    gsl_vector *values = gsl_vector_alloc(d_few);
    gsl_eigen_gensymmv_workspace *w = gsl_eigen_gensymmv_alloc(d_few);
    for (size_t j = 0; j < d_few; j++) {
        for (int e = m->M.start[j]; e < m->M.start[j + 1]; e++)
            gsl_matrix_set(M, (size_t)m->M.row[e], j, m->M.entry[e]);
        for (int e = m->K.start[j]; e < m->K.start[j + 1]; e++)
            gsl_matrix_set(K, (size_t)m->K.row[e], j, m->K.entry[e]);
    }
    OK(gsl_eigen_gensymmv(K, M, values, V, w));
    for (size_t j = 0; j < d_few; j++) {
        double Mv[d_few], norm = 0;
        lambda[j] = gsl_vector_get(values, j);
        for (size_t i = 0; i < d_few; i++)
            v[j][i] = gsl_matrix_get(V, i, j);
        fvi_sparse_multiply(&m->M, v[j], Mv);
        for (size_t i = 0; i < d_few; i++)
            norm += v[j][i] * Mv[i];
        for (size_t i = 0; i < d_few; i++)
            v[j][i] /= sqrt(norm);
    }
    gsl_eigen_gensymmv_free(w);
    gsl_vector_free(values);
    gsl_matrix_free(K);
    gsl_matrix_free(M);
    gsl_matrix_free(V);
}

/* x0 = K^-1 (force 1 at the tip). */
static void bent(const matrices *m, double *x0)
{
    const fvi_matrices *f = m->system.matrices;
    void *factors;
    memset(x0, 0, d_few * sizeof *x0);
    x0[d_few - 2] = 1;
    OK(f->factorise(d_few, 0, NULL, 1, f->params, &factors));
    OK(f->solve(d_few, factors, x0));
    f->free_factors(factors);
}

/* The tip at t: the sum of its modes, each an oscillator that fvi_exact_at knows. */
static double tip_at(const matrices *m, const double *x0, double tau,
                     double alpha, double t)
{
    double lambda[d_few], v[d_few][d_few], Mx[d_few], sum = 0;
    all_modes(m, lambda, v);
    fvi_sparse_multiply(&m->M, x0, Mx);
    for (size_t j = 0; j < d_few; j++) {
        double share = 0, x;
        const fvi_linear_oscillator mode = { .m = 1,
                                  .c = lambda[j],
                                  .rho = tau * lambda[j],
                                  .alpha = alpha,
                                  .x0 = 1 };
        for (size_t i = 0; i < d_few; i++)
            share += v[j][i] * Mx[i];
        OK(fvi_exact_at(&mode, 1, &t, &x, NULL, NULL));
        sum += share * x * v[j][d_few - 2];
    }
    return sum;
}

/* The tip, 1/3 at first, let go: order 2 against the modes. Each halving of h makes the error
 * four times smaller, to a tenth. Seen: 3.9 to 4.1. */
START_TEST(eq_27_5_the_tip_is_the_sum_of_exact_modes_to_order_two)
{
    static const double alphas[] = { 0.1, 0.25, 0.4, 0.75 };
    const double tau = 0.05, t = 2;
    matrices m;
    OK(cantilever(n_few, tau, &m.M, &m.K, &m.C));
    make(&m);
    double x0[d_few], p0[d_few] = { 0 };
    bent(&m, x0);
    ck_assert_near(x0[d_few - 2], 1.0 / 3, 1e-11, "static");
    for (size_t i = 0; i < LEN(alphas); i++) {
        const double want = tip_at(&m, x0, tau, alphas[i], t);
        double error[3];
        for (int k = 0; k < 3; k++) {
            const size_t steps = (size_t)800 << k;
            fvi_stepper *s;
            const fvi_run run =
                run_of(&m.system, alphas[i], t / (double)steps, steps, x0, p0);
            OK(fvi_stepper_start(&fvi_cq2_midpoint, &run, &s, NULL));
            while (s->k < steps)
                OK(fvi_stepper_step(s));
            error[k] = s->x[d_few - 2] - want;
            fvi_stepper_free(s);
        }
        for (int k = 0; k < 2; k++) {
            seen(error[k] / error[k + 1], "ratio %g", alphas[i]);
            ck_assert_msg(fabs(error[k] / error[k + 1] - 4) < 0.4,
                          "alpha %g: %g, %g, %g", alphas[i], error[0], error[1],
                          error[2]);
        }
        seen(fabs(error[2]), "error %g", alphas[i]);
    }
    drop(&m);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("structures: a beam");
    ADD_CASE(
        suite, "modes", eq_27_5_the_cantilevers_first_mode_is_one_oscillator,
        eq_27_7_elements_stiffen_a_mode_by_the_fourth_power_of_their_length,
        eq_27_5_the_tip_is_the_sum_of_exact_modes_to_order_two);
    return run_suite(suite);
}
