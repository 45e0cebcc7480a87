/* tests/adjoint/test_adjoint_mesh_momenta.c -- H 23: objectives J of every momentum, with steps of any length.
 * Run alone: make test-adjoint_mesh_momenta */
#include "adjoint_meshes.h"
#include "run/whole_run.h"

/* As to_sine; and a share of each p_k, which lies within a step mostly. */
static int with_momenta(size_t k, size_t d, const double *x, const double *p,
                        void *params, double *Jx, double *Jp)
{
    for (size_t i = 0; k < N && i < d; i++)
        Jp[i] += cos((double)(3 * k + 5 * i + 1)) / 8;
    return to_sine(k, d, x, p, params, Jx, Jp);
}

/* (23.27), as above; p of fvi-lobatto8d errs by more than x in its first steps: 1e-6. */
START_TEST(eq_23_27_two_methods_have_the_same_derivatives_by_momenta)
{
    for (size_t i = 0; i < LEN(mesh_cases); i++) {
        chain c;
        chain_at(&c, mesh_cases[i].past, mesh_cases[i].alpha, 0.5, mesh_cases[i].rho);
        if (mesh_cases[i].alpha == 1 && mesh_cases[i].rho > 0)
            continue; /* refused */
        slopes *s = slopes_of(&c.run, N + 1), *t = slopes_of(&c.run, N * 7 + 1);
        const fvi_objective J = { .slopes = with_momenta,
                                  .params = &c.run,
                                  .has_momenta = 1 };
        ck_assert_int_eq(
            fvi_adjoint(&fvi_variable_step, &c.run, NULL, NULL, &J, &s->to),
            FVI_SUCCESS);
        ck_assert_int_eq(fvi_adjoint(&fvi_lobatto_d8, &c.run, NULL, NULL, &J, &t->to),
                         FVI_SUCCESS);
        for (size_t j = 0; j < NUMBERS; j++) {
            const int is_alpha = s->all + j == s->to.alpha;
            seen_worst(fabs(s->all[j] - t->all[j]), is_alpha ? "by alpha" : "difference");
            ck_assert_near(s->all[j], t->all[j], 1e-6,
                           "past %d alpha=%g, number %zu", (int)c.run.past,
                           c.run.alpha, j);
        }
        slopes_free(s);
        slopes_free(t);
    }
}
END_TEST

/* sum_k a_k . p_k, k < N, of a run on its mesh. */
static double momenta_of(chain *c)
{
    static double x[(N + 1) * D], p[(N + 1) * D];
    double J = 0;
    run_of(c, x, p);
    for (size_t k = 0; k < N; k++)
        for (size_t i = 0; i < D; i++)
            J += cos((double)(3 * k + 5 * i + 1)) / 8 * p[k * D + i];
    return J;
}

static int momenta_alone(size_t k, size_t d, const double *x, const double *p,
                         void *params, double *Jx, double *Jp)
{
    (void)x, (void)p, (void)params, (void)Jx;
    for (size_t i = 0; k < N && i < d; i++)
        Jp[i] += cos((double)(3 * k + 5 * i + 1)) / 8;
    return 0;
}

static double quotient_of_momenta(chain *c, double *number)
{
    const double was = *number, step = 1e-3;
    double J[2];
    for (size_t i = 0; i < 2; i++) {
        *number = was + (i ? step : -step);
        J[i] = momenta_of(c);
    }
    *number = was;
    return (J[1] - J[0]) / (2 * step);
}

/* Rows within the first steps, where the start is singular: 40 of them to t = 0.08. Quotients of order 2,
 * in so short a time nearly lines. Seen: 3e-9. */
START_TEST(eq_23_27_rows_with_a_singular_start)
{
    static const double alphas[] = { 0.15, 0.4, 0.6, 0.85 };
    for (size_t i = 0; i < LEN(alphas); i++) {
        chain c;
        chain_at(&c,
                 alphas[i] < 0.5 ? FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE
                                 : FVI_INITIAL_HISTORY_HELD,
                 alphas[i], 0.5, 1);
        c.run.h = 1. / 512;
        slopes *s = slopes_of(&c.run, N + 1);
        const fvi_objective J = { .slopes = momenta_alone, .has_momenta = 1 };
        s->to.alpha = NULL;
        ck_assert_int_eq(
            fvi_adjoint(&fvi_variable_step, &c.run, NULL, NULL, &J, &s->to), 0);
        for (size_t j = 0; j < D; j++) {
            double *const numbers[] = { &c.p0[j], &c.mass[j], &c.rho[j], &c.x0[j] };
            const double got[] = { s->to.p0[j], s->to.mass[j], s->to.damping[j],
                                   s->to.x0[j] };
            for (size_t n = 0; n < LEN(numbers); n++)
                if (numbers[n] != &c.rho[j] || c.rho[j] > 0) /* rho may not be negative */
                    ck_assert_near(got[n], quotient_of_momenta(&c, numbers[n]), 1e-7,
                                   "past %d alpha=%g, number %zu of %zu",
                                   (int)c.run.past, c.run.alpha, n, j);
        }
        slopes_free(s);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("adjoint, momenta on meshes");
    ADD_CASE(suite, "momenta",
             eq_23_27_two_methods_have_the_same_derivatives_by_momenta,
             eq_23_27_rows_with_a_singular_start);
    return run_suite(suite);
}
