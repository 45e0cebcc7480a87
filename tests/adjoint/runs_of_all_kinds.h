/* tests/adjoint/runs_of_all_kinds.h -- Chains, and structures with several dampers, with all their numbers. */
#ifndef RUNS_OF_ALL_KINDS_H
#define RUNS_OF_ALL_KINDS_H

#include "adjoint_runs.h"
#include "chain_with_a_law.h"
#include "structures/structures_runs.h"

enum { N = 12, ROWS = 7 * N + 1 };

static inline void chain_at(chain *c, fvi_initial_history past, double alpha)
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
    connect_chain(c, 1. / 8, N);
    c->run.kappa = 0.3;
    c->run.alpha = alpha;
    c->run.past = past;
}

/* All derivatives, one behind the other. */
enum { OF_LAW = 4 * D + 3, NUMBERS_IN_ALL = OF_LAW + 4 * TERMS + ROWS * D };
static inline fvi_sensitivities into(double *all, const fvi_run *run)
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

static inline void make_damped(damped_structure *s, const double order[DAMPERS],
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

static inline void drop_damped(damped_structure *s)
{
    fvi_structure_free(s->structure);
    fvi_sparse_free(&s->m.M);
    fvi_sparse_free(&s->m.K);
    fvi_sparse_free(&s->C);
}

static const fvi_method *const methods[] = {
    &fvi_fractional, &fvi_cq2_shifted, &fvi_cq_bdf2,    &fvi_cq2_midpoint,
    &fvi_lobatto_m2, &fvi_lobatto_m3,  &fvi_lobatto_m4, &fvi_lobatto_m8,
    &fvi_lobatto_d2, &fvi_lobatto_d3,  &fvi_lobatto_d4, &fvi_lobatto_d8
};
/* Those that take matrices. */
static const fvi_method *const takers_of_matrices[] = { &fvi_fractional, &fvi_cq2_shifted, &fvi_cq_bdf2,
                                                        &fvi_cq2_midpoint, &fvi_lobatto_d2, &fvi_lobatto_d3,
                                                        &fvi_lobatto_d4, &fvi_lobatto_d8 };
static const fvi_initial_history pasts[] = { FVI_INITIAL_HISTORY_HELD,
                                             FVI_INITIAL_HISTORY_CAPUTO,
                                             FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE };

/* ---- a check of all of them ---- */

typedef void check_of_run(const fvi_method *method, const fvi_run *run);

/* Chains of seven orders and three pasts. At alpha = 1 nothing of this is known of methods with stages. */
static inline void check_chains(check_of_run *check)
{
    const double alphas[] = { 0, 0.05, 0.3, 0.5, 0.7, 0.95, 1 };
    for (size_t i = 0; i < LEN(methods) * LEN(alphas) * LEN(pasts); i++) {
        const fvi_method *method = methods[i % LEN(methods)];
        chain c;
        chain_at(&c, pasts[i / LEN(methods) / LEN(alphas)], alphas[i / LEN(methods) % LEN(alphas)]);
        if (c.run.alpha < 1 || !method->stages)
            check(method, &c.run);
    }
}

/* A law of four terms, of which fvi-shifted has no derivatives. */
static inline void check_chains_with_a_law(check_of_run *check)
{
    for (size_t i = 0; i < LEN(methods); i++) {
        chain c;
        chain_at(&c, FVI_INITIAL_HISTORY_HELD, 0.5);
        c.run.law = &c.law;
        if (methods[i] != &fvi_cq2_shifted)
            check(methods[i], &c.run);
    }
}

static const double start_x0[D] = { 1, -0.5, 0.25 }, start_p0[D] = { 0.5, -0.3, 0.2 };

/* M, C and K. With the past of Riemann and Liouville this x0 has no motion above the order 1. (19.2) */
static inline void check_structures(check_of_run *check)
{
    const double alphas[] = { 0.3, 0.5, 0.7 };
    matrices m;
    tridiagonal(D, 1, 0.2, &m.M);
    tridiagonal(D, 3, -1.4, &m.K);
    tridiagonal(D, 0.5, 0.15, &m.C);
    make(&m);
    for (size_t i = 0; i < LEN(takers_of_matrices) * LEN(alphas) * LEN(pasts); i++) {
        fvi_run run = run_of(&m.system, alphas[i / LEN(takers_of_matrices) % LEN(alphas)], 1. / 8, N, start_x0,
                             start_p0);
        run.past = pasts[i / LEN(takers_of_matrices) / LEN(alphas)];
        if (run.past != FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE || run.alpha < 0.5)
            check(takers_of_matrices[i % LEN(takers_of_matrices)], &run);
    }
    drop(&m);
}

/* Powers with two sets of pasts, and laws whose past is held. Stages have no derivatives by the numbers of a law
 * that grows faster than s, fvi none by another past, and fvi-shifted none with a law. */
static inline void check_damped_structures(check_of_run *check)
{
    const double orders[][DAMPERS] = { { 0.3, 0.05, 0.7 }, { 0, 0.4, 1 }, { 0.5, 0.2, 0.95 } };
    const fvi_initial_history past[][DAMPERS] = {
        { FVI_INITIAL_HISTORY_HELD, FVI_INITIAL_HISTORY_HELD, FVI_INITIAL_HISTORY_HELD },
        { FVI_INITIAL_HISTORY_CAPUTO, FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE, FVI_INITIAL_HISTORY_CAPUTO }
    };
    enum { POWERS_HELD, POWERS, LAWS, KINDS };
    for (size_t i = 0; i < LEN(takers_of_matrices) * LEN(orders) * KINDS; i++) {
        const fvi_method *method = takers_of_matrices[i % LEN(takers_of_matrices)];
        const size_t order = i / LEN(takers_of_matrices) % LEN(orders), kind = i / LEN(takers_of_matrices) / LEN(orders);
        damped_structure s;
        if ((method == &fvi_fractional && kind == POWERS) || (method == &fvi_cq2_shifted && kind == LAWS))
            continue;
        make_damped(&s, orders[order], past[kind == POWERS], kind == LAWS);
        if (kind == LAWS)
            s.term[1] = (fvi_kernel_term){ FVI_KERNEL_DAVIDSON, 0.3, 0.3, 0.5, 0 };
        if (method->stages && kind == LAWS)
            s.term[0].end = 0.45, s.term[2].alpha = 0.4;
        fvi_run run = run_of(&s.system, 0.5, 1. / 8, N, start_x0, start_p0);
        run.kappa = 0.3;
        check(method, &run);
        drop_damped(&s);
    }
}

#endif
