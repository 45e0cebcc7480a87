/* tests/run/many_runs.h -- Runs of every method, past, order and memory, to be
 * compared between compilers, processors and threads. */
#ifndef MANY_RUNS_H
#define MANY_RUNS_H

#include <fvi/fvi.h>

#include <stdio.h>
#include <string.h>

enum {
    STEPS = 96,
    KEPT = 4, /* rows: every STEPS / KEPT-th */
    MASSES = 3,
    PASTS = 3,
    ORDERS = 7,
    METHODS = 12,
    MANY = METHODS * PASTS * ORDERS
};

static const fvi_method *const many_methods[METHODS] = {
    &fvi_fractional,     &fvi_lagrange_dalembert, &fvi_euler_explicit,
    &fvi_euler_implicit, &fvi_cq2_shifted,            &fvi_cq_bdf2,
    &fvi_lobatto_m2,       &fvi_lobatto_m3,           &fvi_lobatto_m4,
    &fvi_lobatto_m6,       &fvi_lobatto_d4,          &fvi_cq2_midpoint
};
static const double many_orders[ORDERS] = { 0, 0.125, 0.25, 0.3, 0.5, 0.75, 1 };

/* What a run computes with, beside + - * / sqrt and fma, which IEEE 754 determines:
 * nothing; the LU factors of GSL as it was compiled; functions of the C library. */
enum { ARITHMETIC, LINEAR_ALGEBRA, FUNCTIONS };

typedef struct {
    int status;   /* of fvi_stepper_start or of the step that failed */
    int with;     /* ARITHMETIC, ... */
    size_t count; /* numbers in row */
    double row[KEPT * 2 * MASSES];
    char name[80];
} many_run;

/* ARITHMETIC and LINEAR_ALGEBRA: h is a power of two and alpha a multiple of 1/8, so
 * that pow(h, 1 - 2 alpha) is one too and any pow finds it (but alpha = 3/8, 5/8, 7/8
 * are not asked for); that of BDF2 is far from where rounding turns for multiples of
 * 1/4; the weights of the stages need no function for 0, 1/2 and 1. The force of (19.3)
 * needs gamma and pow, the exponentials exp, Fourier's transform sin and cos. */
static int many_needs(const fvi_run *run, const fvi_method *method,
                      int potential, int force)
{
    const double parts = method->stages         ? 2
                         : method == &fvi_cq_bdf2 ? 4
                                                : 8,
                 part = run->alpha * parts;
    const int has_history_force = (run->past == FVI_INITIAL_HISTORY_HELD && run->alpha > 0.5)
                     || (run->past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE
                         && run->alpha != 0.5);
    const int fast = run->memory != FVI_HISTORY_DIRECT && run->alpha > 0
                     && run->alpha != 0.5 && run->alpha < 1;
    if (has_history_force || fast || potential == 2 || force == 2
        || part != (double)(int)part)
        return FUNCTIONS;
    return method->stages ? LINEAR_ALGEBRA : ARITHMETIC;
}

/* The run of that number, 0 <= number < MANY, into r. Three masses; potentials, forces,
 * memories and kappa go round. */
static void many_run_of(size_t number, many_run *r)
{
    static const double mass[] = { 1, 2, 0.5 }, rho[] = { 0.5, 0.25, 1 },
                        x0[] = { 1, -0.5, 0.25 }, p0[] = { 0.5, 1, -1 },
                        cg[] = { 1, 0.5 }, at[] = { 1, 1.5 };
    const fvi_potential potentials[] = { fvi_potential_harmonic(cg),
                                         fvi_potential_duffing(cg),
                                         fvi_potential_pendulum(cg),
                                         fvi_potential_chain(cg) };
    const fvi_force forces[] = { { 0 },
                                 fvi_force_step(at),
                                 fvi_force_cosine(at) };
    const fvi_history_kind memories[] = { FVI_HISTORY_DIRECT, FVI_HISTORY_DIRECT,
                                         FVI_HISTORY_MODES };
    const fvi_method *method = many_methods[number / (PASTS * ORDERS)];
    const size_t turn = number % (PASTS * ORDERS) + number / (PASTS * ORDERS);
    const int potential = (int)(turn % 4), force = (int)(turn / 2 % 3);
    const fvi_system system = { MASSES,        mass, rho, potentials[potential],
                                forces[force], NULL, NULL };
    fvi_run run = fvi_run_default(&system, x0, p0, 0.0625, STEPS);
    run.alpha = method->alpha_least == method->alpha_most
                    ? method->alpha_least
                    : many_orders[number % ORDERS];
    run.past = (fvi_initial_history)(number / ORDERS % PASTS);
    run.memory = memories[method->stages ? turn % 3 : turn / 3 % 3];
    run.kappa = turn % 2 ? 0.5 : 0.25;

    memset(r, 0, sizeof *r);
    r->with = many_needs(&run, method, potential, force);
    snprintf(r->name, sizeof r->name,
             "%s past=%d alpha=%g U=%d F=%d memory=%d kappa=%g", method->name,
             (int)run.past, run.alpha, potential, force, (int)run.memory,
             run.kappa);
    fvi_stepper *s;
    r->status = fvi_stepper_start(method, &run, &s, NULL);
    if (r->status)
        return;
    while (!r->status && s->k < STEPS) {
        r->status = fvi_stepper_step(s);
        if (!r->status && s->k % (STEPS / KEPT) == 0) {
            memcpy(r->row + r->count, s->x, sizeof x0);
            memcpy(r->row + r->count + MASSES, s->p, sizeof p0);
            r->count += 2 * MASSES;
        }
    }
    fvi_stepper_free(s);
}

#endif
