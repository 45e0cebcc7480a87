/* tests/adjoint/test_adjoint_structure_mesh.c -- H 23, 27: gradients of structures by fvi-adaptive.
 *                                 Run alone: make test-adjoint_structure_mesh
 *
 * Steps of any length, and form D with eight stages on fine steps, solve the same equations to about 1e-12 here.
 * Each gradient is exact for the numbers of its own method, and a sum of a hundred rows. So the two agree to 1e-11
 * (seen: 4e-13). Other tests compare the gradients of form D with complex steps. */
#include "runs_of_all_kinds.h"
#include <fvi/adjoint.h>

enum { FINE = 40 }; /* steps of form D in one row */

/* sum_k a_k . x_k + b_k . p_k over the rows, of which a finer run has every FINE-th. */
typedef struct {
    size_t every;
    int has_momenta;
} rows;

static int all_rows(size_t k, size_t d, const double *x, const double *p, void *params, double *Jx, double *Jp)
{
    const rows *of = params;
    (void)x, (void)p;
    for (size_t i = 0; k % of->every == 0 && i < d; i++) {
        const double row = (double)(k / of->every);
        Jx[i] += cos(3 * row + 5 * (double)i + 1);
        if (Jp)
            Jp[i] += sin(2 * row + 7 * (double)i + 1) / 2;
    }
    return 0;
}

typedef struct {
    double x0[D], p0[D], mass, damping[DAMPERS], stiffness, alpha, force[(FINE * 7 * N + 1) * D];
    fvi_sensitivities want;
} answers;

static void ask(answers *a)
{
    memset(a, 0, sizeof *a);
    a->want = (fvi_sensitivities){ .x0 = a->x0,
                                   .p0 = a->p0,
                                   .mass = &a->mass,
                                   .damping = a->damping,
                                   .parameters = &a->stiffness,
                                   .force = a->force };
}

static void ck_assert_near_fine(const char *what, double got, double fine, double within)
{
    if (isnan(fine)) {
        ck_assert(isnan(got));
        return;
    }
    seen_worst(fabs(got - fine), "off");
    ck_assert_near(got, fine, within * larger(1, fabs(fine)), "%s", what);
}

/* The sum of the derivatives by all forces: by a constant force. */
static double by_constant_force(const answers *a, size_t rows_in_all)
{
    double sum = 0;
    for (size_t i = 0; i < rows_in_all * D; i++)
        sum += a->force[i];
    return sum;
}

static void ck_assert_same(fvi_run run, int has_momenta, size_t dampers, double within)
{
    const int by_alpha = !run.law && !run.system->mechanism && run.alpha > 0;
    static answers mesh, fine;
    rows one = { 1, has_momenta }, many = { FINE, has_momenta };
    const fvi_objective J = { .slopes = all_rows, .params = &one, .has_momenta = has_momenta },
                        J_of_fine = { .slopes = all_rows, .params = &many, .has_momenta = has_momenta };
    run.step_error = 1e-13;
    ask(&mesh);
    mesh.want.alpha = by_alpha ? &mesh.alpha : NULL;
    OK(fvi_adjoint(&fvi_variable_step, &run, NULL, NULL, &J, &mesh.want));
    run.step_error = 0;
    run.h /= FINE;
    run.steps *= FINE;
    ask(&fine);
    fine.want.alpha = by_alpha ? &fine.alpha : NULL;
    OK(fvi_adjoint(&fvi_lobatto_d8, &run, NULL, NULL, &J_of_fine, &fine.want));
    for (size_t i = 0; i < D; i++) {
        ck_assert_near_fine("x0", mesh.x0[i], fine.x0[i], within);
        ck_assert_near_fine("p0", mesh.p0[i], fine.p0[i], within);
    }
    for (size_t j = 0; j < dampers; j++)
        ck_assert_near_fine("damping", mesh.damping[j], fine.damping[j], within);
    seen_worst(fabs(mesh.alpha - fine.alpha), "by alpha");
    ck_assert_near(mesh.alpha, fine.alpha, 1e-9 * larger(1, fabs(fine.alpha)), "alpha %g", run.alpha);
    ck_assert_near_fine("mass", mesh.mass, fine.mass, within);
    ck_assert_near_fine("stiffness", mesh.stiffness, fine.stiffness, within);
    ck_assert_near_fine("force", by_constant_force(&mesh, N + 1), by_constant_force(&fine, FINE * 7 * N + 1),
                        within);
}

START_TEST(eq_23_16_a_structure_on_its_mesh)
{
    const double alphas[] = { 0, 0.3, 0.5, 0.7 };
    matrices m;
    tridiagonal(D, 1, 0.2, &m.M);
    tridiagonal(D, 3, -1.4, &m.K);
    tridiagonal(D, 0.5, 0.15, &m.C);
    make(&m);
    for (size_t i = 0; i < LEN(alphas) * LEN(pasts) * 2; i++) {
        fvi_run run = run_of(&m.system, alphas[i % LEN(alphas)], 1. / 8, N, start_x0, start_p0);
        run.past = pasts[i / LEN(alphas) % LEN(pasts)];
        if (run.past != FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE || run.alpha < 0.5)
            ck_assert_same(run, i / LEN(alphas) / LEN(pasts) == 1, 1, 1e-11);
    }
    drop(&m);
}
END_TEST

/* With Riemann and Liouville's past a start at 0 stretches no damper, but a start beside it does, and its force is
 * without bound at t = 0. So the derivative by x0 needs first steps as short as a start beside 0 takes them. */
START_TEST(eq_23_16_a_start_at_0_has_the_derivative_of_a_stretched_one)
{
    static const double zeros[D];
    const double orders[DAMPERS] = { 0.3, 0.05, 0.4 };
    const fvi_initial_history past[DAMPERS] = { FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE, FVI_INITIAL_HISTORY_HELD,
                                                FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE };
    damped_structure several;
    matrices m;
    tridiagonal(D, 1, 0.2, &m.M);
    tridiagonal(D, 3, -1.4, &m.K);
    tridiagonal(D, 0.5, 0.15, &m.C);
    make(&m);
    fvi_run run = run_of(&m.system, 0.4, 1. / 8, N, zeros, start_p0);
    run.past = FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE;
    ck_assert_same(run, 0, 1, 1e-11);
    drop(&m);
    make_damped(&several, orders, past, 0);
    ck_assert_same(run_of(&several.system, 0.5, 1. / 8, N, zeros, start_p0), 0, DAMPERS, 1e-11);
    drop_damped(&several);
}
END_TEST

/* A law of one term, whose factor is asked for, and impulses at rows and between them, of which fine steps have the
 * second at a node, too. */
START_TEST(eq_23_16_a_law_and_impulses_on_a_mesh)
{
    const double J0[D] = { 0.2, 0, -0.1 }, J1[D] = { 0, 0.3, 0 };
    const fvi_impulse hits[] = { { 0.5, J0 }, { 0.8125, J1 } };
    const fvi_kernel_term terms[] = { { FVI_KERNEL_ZENER, 0.7, 0.3, 0.4, 0 }, { FVI_KERNEL_POWER, 0.6, 0.3, 0, 0 } };
    matrices m;
    tridiagonal(D, 1, 0.2, &m.M);
    tridiagonal(D, 3, -1.4, &m.K);
    tridiagonal(D, 0.5, 0.15, &m.C);
    make(&m);
    for (size_t i = 0; i < 2 * LEN(terms); i++) {
        const fvi_kernel law = { 1, terms + i / 2 };
        fvi_run run = run_of(&m.system, 0.5, 1. / 8, N, start_x0, start_p0);
        double factor, by_rho;
        rows one = { 1, 1 };
        const fvi_objective J = { .slopes = all_rows, .params = &one, .has_momenta = 1 };
        const fvi_sensitivities to = { .damping = &factor, .terms = &by_rho };
        m.system.force.impulses = i % 2 ? hits : NULL;
        m.system.force.impulse_count = i % 2 ? LEN(hits) : 0;
        run.law = &law;
        ck_assert_same(run, 1, 1, 1e-11);
        OK(fvi_adjoint(&fvi_variable_step, &run, NULL, NULL, &J, &to));
        ck_assert_near(by_rho * terms[i / 2].rho, factor, 1e-15 * fabs(factor), "rho");
    }
    drop(&m);
}
END_TEST

START_TEST(what_a_mesh_of_a_structure_has_no_derivative_by)
{
    double number[TERMS];
    rows one = { 1, 0 };
    const fvi_objective J = { .slopes = all_rows, .params = &one };
    const fvi_sensitivities by_alpha = { .alpha = number }, by_orders = { .orders = number };
    const double orders[DAMPERS] = { 0.3, 0.05, 0.4 };
    const fvi_initial_history past[DAMPERS] = { FVI_INITIAL_HISTORY_HELD, FVI_INITIAL_HISTORY_HELD,
                                                FVI_INITIAL_HISTORY_HELD };
    damped_structure s;
    matrices m;
    tridiagonal(D, 1, 0.2, &m.M);
    tridiagonal(D, 3, -1.4, &m.K);
    tridiagonal(D, 0.5, 0.15, &m.C);
    make(&m);
    make_damped(&s, orders, past, 0);
    const fvi_run run = run_of(&m.system, 0, 1. / 8, N, start_x0, start_p0), several = run_of(&s.system, 0.5, 1. / 8, N, start_x0, start_p0);
    ck_assert_int_eq(fvi_adjoint(&fvi_variable_step, &run, NULL, NULL, &J, &by_alpha), FVI_EUNSUP);
    ck_assert_int_eq(fvi_adjoint(&fvi_variable_step, &several, NULL, NULL, &J, &by_orders), FVI_EUNSUP);
    drop(&m);
    drop_damped(&s);
}
END_TEST

START_TEST(eq_23_16_several_dampers_on_a_mesh)
{
    const double orders[][DAMPERS] = { { 0.3, 0.05, 0.7 }, { 0, 0.4, 0.2 }, { 0.5, 0.2, 0.8 } };
    const fvi_initial_history past[][DAMPERS] = {
        { FVI_INITIAL_HISTORY_HELD, FVI_INITIAL_HISTORY_HELD, FVI_INITIAL_HISTORY_HELD },
        { FVI_INITIAL_HISTORY_CAPUTO, FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE, FVI_INITIAL_HISTORY_CAPUTO }
    };
    for (size_t i = 0; i < LEN(orders) * LEN(past) * 2; i++) {
        const size_t which_past = i / LEN(orders) % LEN(past), has_laws = i / LEN(orders) / LEN(past);
        damped_structure s;
        make_damped(&s, orders[i % LEN(orders)], past[which_past], has_laws && !which_past);
        if (has_laws && !which_past) { /* a mesh takes no two springpots in series */
            s.term[0] = (fvi_kernel_term){ FVI_KERNEL_ZENER, 0.5, 0.3, 0.4, 0 };
            s.kernel[2].count = 2;
        }
        fvi_run run = run_of(&s.system, 0.5, 1. / 8, N, start_x0, start_p0);
        ck_assert_same(run, 1, DAMPERS, 1e-11);
        drop_damped(&s);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("adjoint, structures on a mesh");
    ADD_CASE(suite, "mesh", eq_23_16_a_structure_on_its_mesh, eq_23_16_several_dampers_on_a_mesh,
             eq_23_16_a_start_at_0_has_the_derivative_of_a_stretched_one,
             eq_23_16_a_law_and_impulses_on_a_mesh, what_a_mesh_of_a_structure_has_no_derivative_by);
    return run_suite(suite);
}
