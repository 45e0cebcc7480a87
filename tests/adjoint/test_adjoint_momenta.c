/* tests/adjoint/test_adjoint_momenta.c -- H 23: objectives that know every momentum.
 *                                        Run alone: make test-adjoint_momenta
 *
 * A run that ends at t_k has the same steps as a longer one. So the derivatives of sum_k a_k . p_k
 * are the sum of those of a_k . p_k, the last momentum of a run of k steps, which other tests
 * compare with complex steps and with references. */
#include "adjoint_runs.h"
#include "structures/structures_runs.h"

enum { D = 3, N = 12, TERMS = 4, ROWS = 7 * N + 1 };

typedef struct {
    double x0[D], p0[D], mass[D], rho[D], cg[2], aw[2];
    fvi_kernel_term term[TERMS];
    fvi_kernel law;
    fvi_system system;
    fvi_run run;
} chain;

static void chain_at(chain *c, fvi_initial_history past, double alpha)
{
    *c = (chain){
        .x0 = { 1, -0.5, 0.25 },
        .p0 = { 0.5, -0.3, 0.2 },
        .mass = { 1, 1.5, 0.7 },
        .rho = { 0.4, 0, 0.3 },
        .cg = { 1, 0.5 },
        .aw = { 0.2, 1.3 },
        .term = { { FVI_KERNEL_POWER, 0.2, 0.3, 0, 0 },
                  { FVI_KERNEL_ZENER, 0.4, 0.35, 0.6, 0 },
                  { FVI_KERNEL_MAXWELL, 0.3, 0, 0.5, 0 },
                  { FVI_KERNEL_DISTRIBUTED, 0.2, 0.1, 0, 0.45 } },
    };
    if (past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE && alpha > 0.5)
        memset(c->x0, 0, sizeof c->x0);
    c->law = (fvi_kernel){ TERMS, c->term };
    c->system = (fvi_system){ .d = D,
                              .mass = c->mass,
                              .damping = c->rho,
                              .potential = fvi_potential_chain(c->cg),
                              .force = fvi_force_cosine(c->aw) };
    c->run = fvi_run_default(&c->system, c->x0, c->p0, 1. / 8, N);
    c->run.kappa = 0.3;
    c->run.alpha = alpha;
    c->run.past = past;
}

static double share(size_t k, size_t i)
{
    return cos((double)(3 * k + 5 * i + 1));
}

/* sum_k a_k . p_k */
static int all_momenta(size_t k, size_t d, const double *x, const double *p,
                       void *params, double *Jx, double *Jp)
{
    (void)x, (void)p, (void)params, (void)Jx;
    for (size_t i = 0; i < d; i++)
        Jp[i] += share(k, i);
    return 0;
}

/* a_k . p_k of a run of k steps */
static int last_momentum(size_t k, size_t d, const double *x, const double *p,
                         void *params, double *Jx, double *Jp)
{
    (void)x, (void)params, (void)Jx;
    for (size_t i = 0; p && i < d; i++)
        Jp[i] += share(k, i);
    return 0;
}

/* All derivatives, one behind the other. */
enum { OF_LAW = 4 * D + 3, NUMBERS_IN_ALL = OF_LAW + 4 * TERMS + ROWS * D };
static fvi_sensitivities into(double *all, const fvi_run *run)
{
    const int is_chain = !run->system->matrices, has_dampers = run->system->mechanism != NULL;
    fvi_sensitivities to = { .x0 = all,
                             .p0 = all + D,
                             .mass = all + 2 * D,
                             .damping = all + 3 * D,
                             .parameters = all + 4 * D,
                             .alpha = run->law || has_dampers ? NULL : all + 4 * D + 2,
                             .force = all + OF_LAW + 4 * TERMS };
    if (run->law || has_dampers) {
        to.terms = all + OF_LAW;
        to.orders = to.terms + TERMS;
        to.times = to.orders + TERMS;
        to.ends = to.times + TERMS;
    }
    if (is_chain)
        to.sensitivity = fvi_parameter_gradient_of(&run->system->potential);
    return to;
}

static void ck_assert_sum(const fvi_method *method, const fvi_run *run)
{
    static double all[NUMBERS_IN_ALL], one[NUMBERS_IN_ALL], sum[NUMBERS_IN_ALL];
    const fvi_objective momenta = { .slopes = all_momenta, .has_momenta = 1 },
                        last = { .slopes = last_momentum };
    double largest = 0;
    memset(all, 0, sizeof all);
    memset(sum, 0, sizeof sum);
    for (size_t i = 0; i < D; i++) /* p_0 is p0 */
        sum[D + i] = share(0, i);
    fvi_sensitivities to = into(all, run);
    ck_assert_int_eq(fvi_adjoint(method, run, NULL, NULL, &momenta, &to), 0);
    for (size_t k = 1; k <= N; k++) {
        fvi_run shorter = *run;
        shorter.steps = k;
        memset(one, 0, sizeof one);
        to = into(one, run);
        ck_assert_int_eq(fvi_adjoint(method, &shorter, NULL, NULL, &last, &to), 0);
        for (size_t i = 0; i < NUMBERS_IN_ALL; i++)
            sum[i] += one[i];
    }
    for (size_t i = 0; i < NUMBERS_IN_ALL; i++)
        largest = isnan(sum[i]) ? largest : larger(largest, fabs(sum[i])); /* (19.2) */
    /* N sums of N terms, each to 8 u; of eight stages what adjoint.h says. Seen: 3e-15, 4e-13 */
    const double bound = method->stages == 8 ? 1e-12 : N * N * 8 * U;
    for (size_t i = 0; i < NUMBERS_IN_ALL; i++)
        if (isnan(sum[i]))
            ck_assert(isnan(all[i]));
        else
            ck_assert_near(all[i], sum[i], bound * largest,
                           "%s, past %d, alpha %g, number %zu", method->name,
                           (int)run->past, run->alpha, i);
}

static const fvi_method *const methods[] = {
    &fvi_fractional, &fvi_cq2_shifted, &fvi_cq_bdf2,    &fvi_cq2_midpoint,
    &fvi_lobatto_m2, &fvi_lobatto_m3,  &fvi_lobatto_m4, &fvi_lobatto_m8,
    &fvi_lobatto_d2, &fvi_lobatto_d3,  &fvi_lobatto_d4, &fvi_lobatto_d8
};
static const fvi_initial_history pasts[] = { FVI_INITIAL_HISTORY_HELD,
                                             FVI_INITIAL_HISTORY_CAPUTO,
                                             FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE };

START_TEST(eq_23_27_is_a_sum_of_shorter_runs)
{
    const double alphas[] = { 0, 0.05, 0.3, 0.5, 0.7, 0.95, 1 };
    for (size_t i = 0; i < LEN(methods) * LEN(alphas) * LEN(pasts); i++) {
        const fvi_method *method = methods[i % LEN(methods)];
        chain c;
        chain_at(&c, pasts[i / LEN(methods) / LEN(alphas)],
                 alphas[i / LEN(methods) % LEN(alphas)]);
        if (c.run.alpha == 1 && method->stages)
            continue; /* form M is refused, and has no derivative by alpha */
        ck_assert_sum(method, &c.run);
    }
}
END_TEST

START_TEST(eq_23_27_is_a_sum_with_a_law_too)
{
    for (size_t i = 0; i < LEN(methods); i++) {
        chain c;
        chain_at(&c, FVI_INITIAL_HISTORY_HELD, 0.5);
        c.run.law = &c.law;
        if (methods[i] != &fvi_cq2_shifted)
            ck_assert_sum(methods[i], &c.run);
    }
}
END_TEST

START_TEST(eq_23_27_is_a_sum_with_matrices_too)
{
    const double alphas[] = { 0.3, 0.5, 0.7 }, x0[D] = { 1, -0.5, 0.25 },
                 p0[D] = { 0.5, -0.3, 0.2 };
    matrices m;
    tridiagonal(D, 1, 0.2, &m.M);
    tridiagonal(D, 3, -1.4, &m.K);
    tridiagonal(D, 0.5, 0.15, &m.C);
    make(&m);
    for (size_t i = 0; i < 4 * LEN(alphas) * LEN(pasts); i++) {
        fvi_run run = run_of(&m.system, alphas[i / 4 % LEN(alphas)], 1. / 8, N, x0, p0);
        run.past = pasts[i / 4 / LEN(alphas)];
        if (run.past != FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE || run.alpha < 0.5)
            ck_assert_sum(methods[i % 4], &run);
    }
    drop(&m);
}
END_TEST

/* Three dampers, two along rows and one of a matrix, with four terms in all. */
enum { DAMPERS = 3 };
typedef struct {
    matrices m; /* without C */
    fvi_sparse C;
    double row[2][D];
    fvi_kernel_term term[TERMS];
    fvi_kernel kernel[DAMPERS];
    fvi_damper damper[DAMPERS];
    fvi_structure *structure;
    fvi_system system;
} damped_structure;

static void make_damped(damped_structure *s, const double order[DAMPERS],
                        const fvi_initial_history past[DAMPERS], int has_laws)
{
    *s = (damped_structure){
        .row = { { 1, -1, 0 }, { 0.3, 0, 0.8 } },
        .term = { { FVI_KERNEL_POWER, 0.4, order[0], 0, 0 },
                  { FVI_KERNEL_POWER, 0.3, order[1], 0, 0 },
                  { FVI_KERNEL_POWER, 0.5, order[2], 0, 0 },
                  { FVI_KERNEL_ZENER, 0.4, 0.35, 0.6, 0 } },
    };
    if (has_laws)
        s->term[0] = (fvi_kernel_term){ FVI_KERNEL_MAXWELL2, 0.5, 0.7, 0.4, 0.6 };
    tridiagonal(D, 1, 0.2, &s->m.M);
    tridiagonal(D, 3, -1.4, &s->m.K);
    tridiagonal(D, 0.5, 0.15, &s->C);
    for (size_t j = 0; j < DAMPERS; j++) {
        s->kernel[j] = (fvi_kernel){ j == 2 && has_laws ? 2 : 1, s->term + j };
        s->damper[j] = (fvi_damper){ .kernel = s->kernel + j, .past = past[j] };
        if (j < 2)
            s->damper[j].of = fvi_elongation_row(s->row[j]);
        else
            s->damper[j].matrix = &s->C;
    }
    OK(fvi_structure_alloc_dampers(&s->m.M, &s->m.K, DAMPERS, s->damper, &s->structure, NULL));
    s->system = fvi_structure_system(s->structure);
}

static void drop_damped(damped_structure *s)
{
    fvi_structure_free(s->structure);
    fvi_sparse_free(&s->m.M);
    fvi_sparse_free(&s->m.K);
    fvi_sparse_free(&s->C);
}

START_TEST(eq_23_27_is_a_sum_with_several_dampers_too)
{
    const double x0[D] = { 1, -0.5, 0.25 }, p0[D] = { 0.5, -0.3, 0.2 },
                 orders[][DAMPERS] = { { 0.3, 0.05, 0.7 }, { 0, 0.4, 1 }, { 0.5, 0.2, 0.95 } };
    const fvi_initial_history past[][DAMPERS] = {
        { FVI_INITIAL_HISTORY_HELD, FVI_INITIAL_HISTORY_HELD, FVI_INITIAL_HISTORY_HELD },
        { FVI_INITIAL_HISTORY_CAPUTO, FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE, FVI_INITIAL_HISTORY_CAPUTO }
    };
    for (size_t i = 0; i < 4 * LEN(orders) * LEN(past) * 2; i++) {
        const fvi_method *method = methods[i % 4];
        const size_t pull = i / 4 / LEN(orders) % LEN(past), has_laws = i / 4 / LEN(orders) / LEN(past);
        damped_structure s;
        if ((method == &fvi_fractional && pull) || (method == &fvi_cq2_shifted && has_laws))
            continue; /* refused */
        make_damped(&s, orders[i / 4 % LEN(orders)], past[pull], has_laws && !pull);
        fvi_run run = run_of(&s.system, 0.5, 1. / 8, N, x0, p0);
        run.kappa = 0.3;
        ck_assert_sum(method, &run);
        drop_damped(&s);
    }
}
END_TEST

/* Where alpha = 1 makes rho a mass, p_k is not m v_k. */
START_TEST(momenta_at_alpha_1_are_refused_where_rho_is_a_mass)
{
    const fvi_objective momenta = { .slopes = all_momenta, .has_momenta = 1 };
    double x0[D];
    const fvi_sensitivities to = { .x0 = x0 };
    chain c;
    chain_at(&c, FVI_INITIAL_HISTORY_CAPUTO, 1);
    ck_assert_int_eq(fvi_adjoint(&fvi_lobatto_m3, &c.run, NULL, NULL, &momenta, &to),
                     FVI_EUNSUP);
    ck_assert_int_eq(fvi_adjoint(&fvi_variable_step, &c.run, NULL, NULL, &momenta, &to),
                     FVI_EUNSUP);
    memset(c.rho, 0, sizeof c.rho);
    ck_assert_int_eq(fvi_adjoint(&fvi_lobatto_m3, &c.run, NULL, NULL, &momenta, &to), 0);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("adjoint, every momentum");
    ADD_CASE(suite, "sums", eq_23_27_is_a_sum_of_shorter_runs,
             eq_23_27_is_a_sum_with_a_law_too, eq_23_27_is_a_sum_with_matrices_too, eq_23_27_is_a_sum_with_several_dampers_too,
             momenta_at_alpha_1_are_refused_where_rho_is_a_mass);
    return run_suite(suite);
}
