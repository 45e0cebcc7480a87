/* tests/adjoint/test_adjoint_forces.c -- H 23: objectives J of the forces and impulses of dampers.
 * Run alone: make test-adjoint_forces */
#include "loss_of_forces.h"

#include "system/larger.h"

/* ---- systems of all kinds, against differences ---- */

enum { T = 3 /* coordinates */, ROWS = 25, MOST_NUMBERS = 9 };

/* Whatever a run is made of. A structure has a damper along a row and one by a matrix, a mechanism one along a row and one
 * along x_1 + x_2^2 / 2; a chain has the law of all terms. */
typedef struct {
    enum { CHAIN, STRUCTURE, MECHANISM } kind;
    double mass[T], rho[T], x0[T], p0[T], cg[2], factor[2]; /* of M and K */
    fvi_kernel_term term[3];
    fvi_initial_history past;
} numbers;

typedef struct {
    fvi_system system;
    fvi_run run;
    fvi_kernel law[2];
    fvi_damper damper[2];
    fvi_mechanism mechanism;
    fvi_sparse M, K, C;
    fvi_structure *structure;
} made;

static const double between[] = { -1, 0.5, 1 };

static int bent(double t, size_t d, const double *x, void *params, double *g)
{
    (void)t, (void)d, (void)params;
    *g = x[0] + x[1] * x[1] / 2;
    return 0;
}

static int bent_gradient(double t, size_t d, const double *x, void *params, double *G)
{
    (void)t, (void)d, (void)params;
    G[0] = 1;
    G[1] = x[1];
    G[2] = 0;
    return 0;
}

static int bent_hessian(double t, size_t d, const double *x, double factor, void *params, double *H)
{
    (void)t, (void)x, (void)params;
    H[d + 1] += factor;
    return 0;
}

static void make_structure(const numbers *n, made *m)
{
    const fvi_triplet inertia[] = { { 0, 0, 1.5 }, { 1, 1, 1 }, { 2, 2, 0.75 }, { 0, 1, 0.125 }, { 1, 0, 0.125 } },
                      stiff[] = { { 0, 0, 3 },  { 1, 1, 4 },  { 2, 2, 2 },  { 0, 1, -1 },
                                  { 1, 0, -1 }, { 1, 2, -2 }, { 2, 1, -2 } },
                      damp[] = { { 0, 0, 0.5 }, { 1, 1, 0.5 }, { 0, 1, -0.25 }, { 1, 0, -0.25 } };
    fvi_triplet scaled[7];
    for (size_t i = 0; i < 5; i++) {
        scaled[i] = inertia[i];
        scaled[i].entry *= n->factor[0];
    }
    ck_assert_int_eq(fvi_sparse_assemble(T, 5, scaled, &m->M), FVI_SUCCESS);
    for (size_t i = 0; i < 7; i++) {
        scaled[i] = stiff[i];
        scaled[i].entry *= n->factor[1];
    }
    ck_assert_int_eq(fvi_sparse_assemble(T, 7, scaled, &m->K), FVI_SUCCESS);
    ck_assert_int_eq(fvi_sparse_assemble(T, 4, damp, &m->C), FVI_SUCCESS);
    m->damper[1].matrix = &m->C;
    ck_assert_int_eq(fvi_structure_alloc_dampers(&m->M, &m->K, 2, m->damper, &m->structure, NULL), FVI_SUCCESS);
    m->system = fvi_structure_system(m->structure);
}

static void make(const numbers *n, made *m)
{
    static double aw[] = { 0.5, 2 };
    static const double none[T] = { 0 };
    memset(m, 0, sizeof *m);
    m->law[0] = (fvi_kernel){ n->kind == CHAIN ? 3 : 2, n->term };
    m->law[1] = (fvi_kernel){ 1, n->term + 2 };
    m->damper[0] = (fvi_damper){ .of.row = between, .kernel = &m->law[0] };
    m->damper[1] = (fvi_damper){ .of = { .value = bent, .gradient = bent_gradient, .hessian = bent_hessian },
                                 .kernel = &m->law[1],
                                 .past = n->past };
    m->mechanism = (fvi_mechanism){ .damper_count = 2, .damper = m->damper };
    m->system = (fvi_system){ .d = T, .mass = n->mass, .damping = n->kind == CHAIN ? n->rho : none };
    m->system.potential = fvi_potential_chain((void *)n->cg);
    if (n->kind == STRUCTURE)
        make_structure(n, m);
    if (n->kind == MECHANISM)
        m->system.mechanism = &m->mechanism;
    m->system.force = fvi_force_cosine(aw);
    m->run = fvi_run_default(&m->system, n->x0, n->p0, 1. / 16, ROWS);
    m->run.law = n->kind == CHAIN ? &m->law[0] : NULL;
}

static void unmake(made *m)
{
    fvi_structure_free(m->structure);
    fvi_sparse_free(&m->M);
    fvi_sparse_free(&m->K);
    fvi_sparse_free(&m->C);
}

static size_t count_of(const numbers *n)
{
    return n->kind == CHAIN ? T : n->kind == STRUCTURE ? 1 + T : 2;
}

static double loss(const fvi_method *method, const numbers *n, double *force, double *impulse)
{
    made m;
    make(n, &m);
    const double sum = loss_of_forces(method, &m.run, count_of(n), force, impulse);
    unmake(&m);
    return sum;
}

typedef struct {
    double x0[T], p0[T], mass[T], damping[T], parameters[2], terms[3], orders[3], times[3];
} all_slopes;

static void adjoint_of(const fvi_method *method, const numbers *n, all_slopes *to)
{
    double force[(ROWS + 1) * MOST_NUMBERS], impulse[(ROWS + 1) * MOST_NUMBERS];
    made m;
    loss(method, n, force, impulse);
    make(n, &m);
    const fvi_objective J = { .slopes = nothing };
    fvi_sensitivities want = { .x0 = to->x0,
                               .p0 = to->p0,
                               .mass = to->mass,
                               .damping = to->damping,
                               .parameters = to->parameters,
                               .terms = to->terms,
                               .orders = to->orders,
                               .times = to->times };
    want.sensitivity = fvi_parameter_gradient_of(&m.system.potential);
    ck_assert_int_eq(fvi_adjoint_forces(method, &m.run, &J, force, impulse, &want), FVI_SUCCESS);
    unmake(&m);
}

/* Central, of order 6. Roundings of the loss, 1e-13, are divided by 1/256, and the seventh derivative of an order counts
 * 256^-6 times: 1e-9 together. */
static double quotient(const fvi_method *method, numbers *n, double *number)
{
    static const double weights[] = { 0, 3. / 4, -3. / 20, 1. / 60 };
    const double at = *number, step = 1. / 256;
    double sum = 0;
    for (int i = 1; i <= 3; i++) {
        *number = at + i * step;
        sum += weights[i] * loss(method, n, NULL, NULL);
        *number = at - i * step;
        sum -= weights[i] * loss(method, n, NULL, NULL);
    }
    *number = at;
    return sum / step;
}

static void compare(const fvi_method *method, numbers *n, double *number, double got, const char *name, size_t i)
{
    const double want = quotient(method, n, number), unit = larger(1, fabs(want));
    seen_worst(fabs(got - want) / unit, "quotients");
    ck_assert_near(got, want, 1e-9 * unit, "%s kind %d by %s %zu", method->name, (int)n->kind, name, i);
}

static void compare_all(const fvi_method *method, numbers *n)
{
    all_slopes by = { 0 };
    adjoint_of(method, n, &by);
    for (size_t i = 0; i < T; i++) {
        compare(method, n, &n->x0[i], by.x0[i], "x0", i);
        compare(method, n, &n->p0[i], by.p0[i], "p0", i);
        if (n->kind != STRUCTURE)
            compare(method, n, &n->mass[i], by.mass[i], "mass", i);
        if (n->kind == CHAIN)
            compare(method, n, &n->rho[i], by.damping[i], "rho", i);
        compare(method, n, &n->term[i].rho, by.terms[i], "a factor", i);
        if (n->term[i].kind != FVI_KERNEL_MAXWELL)
            compare(method, n, &n->term[i].alpha, by.orders[i], "an order", i);
        if (n->term[i].kind != FVI_KERNEL_POWER)
            compare(method, n, &n->term[i].time, by.times[i], "a time", i);
    }
    for (size_t i = 0; i < 2 && n->kind == STRUCTURE; i++)
        compare(method, n, &n->factor[i], i ? by.parameters[0] : by.mass[0], i ? "K" : "M", i);
    for (size_t i = 0; i < 2 && n->kind != STRUCTURE; i++)
        compare(method, n, &n->cg[i], by.parameters[i], "a parameter", i);
    if (n->kind != CHAIN) { /* a factor of the second damper is one of its only term */
        const double want = n->term[2].rho * by.terms[2];
        ck_assert_near(by.damping[1], want, 1e-9 * larger(1, fabs(want)), "a factor of a damper");
    }
}

static double uniform(unsigned *seed, double from, double to)
{
    *seed = *seed * 1664525u + 1013904223u;
    return from + (to - from) * (double)(*seed >> 8) / 16777216;
}

static numbers draw(unsigned *seed, int kind)
{
    numbers n = { .kind = kind, .factor = { 1, 1 } };
    for (size_t i = 0; i < T; i++) {
        n.mass[i] = uniform(seed, 0.5, 2);
        n.rho[i] = uniform(seed, 0.2, 1);
        n.x0[i] = uniform(seed, -1, 1);
        n.p0[i] = uniform(seed, -1, 1);
        n.term[i].rho = uniform(seed, 0.2, 1);
        n.term[i].alpha = uniform(seed, 0.1, 0.45);
        n.term[i].time = uniform(seed, 0.2, 1);
    }
    n.cg[0] = uniform(seed, 0.5, 2);
    n.cg[1] = uniform(seed, 0.2, 1);
    n.term[0].kind = FVI_KERNEL_ZENER;
    n.term[1].kind = uniform(seed, 0, 1) < 0.5 ? FVI_KERNEL_POWER : FVI_KERNEL_MAXWELL;
    n.term[2].kind = FVI_KERNEL_POWER;
    n.past = kind != MECHANISM || uniform(seed, 0, 1) < 0.5 ? FVI_INITIAL_HISTORY_HELD : FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE;
    return n;
}

/* Laws, structures and mechanisms with stages and without, two of each drawn at random, by every number that they have.
 * The quotients are right to 1e-9; seen: 4.4e-10 of a derivative, or of 1. */
START_TEST(eq_23_33_random_runs_with_walls)
{
    static const fvi_method *const methods[][5] = {
        { &fvi_fractional, &fvi_cq_bdf2, &fvi_cq2_midpoint, &fvi_lobatto_m3, &fvi_lobatto_d3 },
        { &fvi_fractional, &fvi_cq_bdf2, &fvi_cq2_midpoint, &fvi_lobatto_d2, &fvi_lobatto_d3 },
        { &fvi_fractional, &fvi_cq2_midpoint, &fvi_lobatto_m3, &fvi_lobatto_d2, &fvi_lobatto_d3 }
    };
    unsigned seed = 38;
    for (int kind = CHAIN; kind <= MECHANISM; kind++)
        for (size_t i = 0; i < LEN(methods[kind]); i++) {
            numbers n = draw(&seed, kind);
            compare_all(methods[kind][i], &n);
        }
}
END_TEST

/* ---- laws whose numbers leave little room ---- */

/* Derivatives of the forces of one body by the numbers of a law. */
static void by_law(const fvi_method *method, const fvi_kernel *law, double *terms, double *orders, double *ends)
{
    const double mass = 1, rho = 1, x0 = 1, p0 = 0.3;
    double c = 1, force[ROWS + 1];
    const fvi_system system = { .d = 1, .mass = &mass, .damping = &rho, .potential = fvi_potential_harmonic(&c) };
    fvi_run run = fvi_run_default(&system, &x0, &p0, 1. / 16, ROWS);
    const fvi_objective J = { .slopes = nothing };
    const fvi_sensitivities want = { .terms = terms, .orders = orders, .ends = ends };
    run.law = law;
    for (size_t k = 0; k <= ROWS; k++)
        force[k] = weight(k, 0, 0);
    ck_assert_int_eq(fvi_adjoint_forces(method, &run, &J, force, NULL, &want), FVI_SUCCESS);
}

static const fvi_method *const methods_of_laws[] = { &fvi_fractional, &fvi_cq_bdf2, &fvi_cq2_midpoint, &fvi_lobatto_m3,
                                                     &fvi_lobatto_d3 };

/* A law rho times the integral of s^(2 a) over a from 0.3 to 0.305. Its derivative by the end of this interval is that by a
 * factor of s^0.61, times rho, and by the beginning it is that by a factor of -s^0.6. The last two terms have these
 * factors, which are 0. All are quotients, each to 1e-9. Seen: 1.3e-10. */
START_TEST(eq_23_32_orders_that_are_close)
{
    const fvi_kernel_term term[] = { { FVI_KERNEL_DISTRIBUTED, 0.7, 0.3, 0, 0.305 },
                                     { FVI_KERNEL_POWER, 0, 0.3, 0, 0 },
                                     { FVI_KERNEL_POWER, 0, 0.305, 0, 0 } };
    const fvi_kernel law = { 3, term };
    for (size_t i = 0; i < LEN(methods_of_laws); i++) {
        double terms[3], orders[3], ends[3];
        by_law(methods_of_laws[i], &law, terms, orders, ends);
        const double unit = fabs(terms[1]);
        seen_worst(larger(fabs(orders[0] + 0.7 * terms[1]), fabs(ends[0] - 0.7 * terms[2])) / unit, "close orders");
        ck_assert_near(orders[0], -0.7 * terms[1], 2e-9 * unit, "%s: the beginning", methods_of_laws[i]->name);
        ck_assert_near(ends[0], 0.7 * terms[2], 2e-9 * unit, "%s: the end", methods_of_laws[i]->name);
    }
}
END_TEST

/* Forces of a damper that does not slow the body are rho times those of rho = 1. At rho = 1e-8 it slows the body by about
 * this part, so the derivatives by rho there and at 1e-30 agree to 1e-7. */
START_TEST(eq_23_32_a_factor_that_is_tiny)
{
    for (size_t i = 0; i < LEN(methods_of_laws); i++) {
        double by[2];
        for (size_t j = 0; j < 2; j++) {
            const fvi_kernel_term term = { FVI_KERNEL_ZENER, j ? 1e-8 : 1e-30, 0.3, 0.4, 0 };
            const fvi_kernel law = { 1, &term };
            by_law(methods_of_laws[i], &law, by + j, NULL, NULL);
        }
        seen_worst(fabs(by[0] / by[1] - 1), "tiny factor");
        ck_assert_near(by[0], by[1], 1e-7 * fabs(by[1]), "%s", methods_of_laws[i]->name);
    }
}
END_TEST

/* Two terms of one order are one term, so the derivatives by their factors are the same, to 1e-9 of 1 each. */
START_TEST(eq_23_32_a_factor_that_is_a_millionth_of_its_law)
{
    const fvi_kernel_term term[] = { { FVI_KERNEL_POWER, 1, 0.3, 0, 0 }, { FVI_KERNEL_POWER, 1e-6, 0.3, 0, 0 } };
    const fvi_kernel law = { 2, term };
    for (size_t i = 0; i < LEN(methods_of_laws); i++) {
        double by[2];
        by_law(methods_of_laws[i], &law, by, NULL, NULL);
        seen_worst(fabs(by[0] - by[1]), "a millionth");
        ck_assert_near(by[0], by[1], 2e-9, "%s", methods_of_laws[i]->name);
    }
}
END_TEST

/* ---- impulses of the force, and what is refused ---- */

/* What hits the body at a node reaches no damper at once: with a mass of 1 and one step J is that of the run that starts
 * with the momentum behind the hit. */
START_TEST(eq_23_33_an_impulse_of_the_force_is_none_of_a_damper)
{
    const double mass[] = { 1, 2 }, rho[] = { 0.4, 0.3 }, x0[] = { 1, -1 }, p0[] = { 0.2, 0.1 }, hit[] = { 0.5, -0.25 },
                 p_hit[] = { 0.7, -0.15 };
    double c = 1.5, by[2][4] = { { 0 } }, force[2 * (ROWS + 1)];
    const fvi_impulse impulses[] = { { .t = 0, .J = hit } };
    fvi_system system = { .d = 2, .mass = mass, .damping = rho, .potential = fvi_potential_harmonic(&c) };
    for (size_t i = 0; i < LEN(force); i++)
        force[i] = weight(i, i, 1);
    for (size_t i = 0; i < 2; i++) {
        system.force.impulses = i ? NULL : impulses;
        system.force.impulse_count = i ? 0 : 1;
        fvi_run run = fvi_run_default(&system, x0, i ? p_hit : p0, 0.1, ROWS);
        run.alpha = 0.3;
        const fvi_objective J = { .slopes = nothing };
        const fvi_sensitivities want = { .x0 = by[i], .p0 = by[i] + 2 };
        ck_assert_int_eq(fvi_adjoint_forces(&fvi_lobatto_m3, &run, &J, force, force, &want), FVI_SUCCESS);
    }
    for (size_t i = 0; i < 4; i++)
        ck_assert_near(by[0][i], by[1][i], 1e-12 * larger(1, fabs(by[1][i])), "derivative %zu", i);
}
END_TEST

START_TEST(what_has_no_derivatives_of_forces_is_refused)
{
    const double one = 1, zero = 0;
    double c = 1, by, force[ROWS + 1] = { 0 };
    const fvi_system system = { .d = 1, .mass = &one, .damping = &one, .potential = fvi_potential_harmonic(&c) };
    fvi_run run = fvi_run_default(&system, &one, &zero, 0.1, ROWS);
    const fvi_objective J = { .slopes = nothing };
    const fvi_sensitivities want = { .x0 = &by };
    const fvi_event event = { 0 };
    ck_assert_int_eq(fvi_adjoint_forces(NULL, &run, &J, force, NULL, &want), FVI_EFAULT);
    ck_assert_int_eq(fvi_adjoint_forces(&fvi_fractional, &run, NULL, force, NULL, &want), FVI_EFAULT);
    ck_assert_int_eq(fvi_adjoint_forces(&fvi_fractional, &run, &J, force, NULL, NULL), FVI_EFAULT);
    ck_assert_int_eq(fvi_adjoint_forces(&fvi_variable_step, &run, &J, force, NULL, &want), FVI_EUNSUP);
    run.alpha = 1;
    ck_assert_int_eq(fvi_adjoint_forces(&fvi_fractional, &run, &J, force, NULL, &want), FVI_EUNSUP);
    run.alpha = 0.3;
    run.events = &event;
    run.event_count = 1;
    ck_assert_int_eq(fvi_adjoint_forces(&fvi_fractional, &run, &J, force, NULL, &want), FVI_EUNSUP);
    run.event_count = 0;
    ck_assert_int_eq(fvi_adjoint_forces(&fvi_fractional, &run, &J, NULL, NULL, &want), FVI_SUCCESS);
    ck_assert_double_eq(by, 0);

    const fvi_matrices functions = { 0 };
    const fvi_system without_entries = { .d = 1, .mass = &one, .damping = &zero, .matrices = &functions };
    run.system = &without_entries;
    ck_assert_int_eq(fvi_adjoint_forces(&fvi_fractional, &run, &J, force, NULL, &want), FVI_EUNSUP);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("adjoint of forces");
    ADD_CASE(suite, "laws", eq_23_32_orders_that_are_close, eq_23_32_a_factor_that_is_tiny,
             eq_23_32_a_factor_that_is_a_millionth_of_its_law);
    ADD_CASE(suite, "walls", eq_23_33_random_runs_with_walls, eq_23_33_an_impulse_of_the_force_is_none_of_a_damper);
    ADD_CASE(suite, "refused", what_has_no_derivatives_of_forces_is_refused);
    return run_suite(suite);
}
