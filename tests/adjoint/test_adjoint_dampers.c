/* tests/adjoint/test_adjoint_dampers.c -- H 23, 27: derivatives of structures with several dampers.
 * Run alone: make test-adjoint_dampers */
#include "../structures/building.h"
#include <fvi/adjoint.h>
#include "run/whole_run.h"
#include "system/larger.h"

enum { N = 60, DAMPERS = 3 };

/* J = sum_k w_k . x_k + q . p_N, w and q of no ratio to each other. */
static double weight(size_t k, size_t i)
{
    return cos(1.3 * (double)k + (double)i) / (1 + (double)i);
}

static double weight_of_momentum(size_t i)
{
    return 0.3 - 0.1 * (double)i;
}

static int slopes(size_t k, size_t d, const double *x, const double *p, void *params,
                  double *Jx, double *Jp)
{
    (void)x, (void)p, (void)params;
    for (size_t i = 0; i < d; i++) {
        Jx[i] = weight(k, i);
        if (Jp)
            Jp[i] = weight_of_momentum(i);
    }
    return 0;
}

static double value_of(const fvi_method *method, const fvi_run *run)
{
    double x[(N + 1) * D], p[(N + 1) * D], J = 0;
    OK(fvi_trajectory(method, run, x, p, NULL));
    for (size_t k = 0; k <= N; k++)
        for (size_t i = 0; i < D; i++)
            J += weight(k, i) * x[k * D + i];
    for (size_t i = 0; i < D; i++)
        J += weight_of_momentum(i) * p[N * D + i];
    return J;
}

/* F(t) = pulse at the step at hand, to be one node's force on one unknown. */
typedef struct {
    double t, size;
    size_t i;
} pulse;

static int push_at(double t, size_t d, void *params, double *F)
{
    const pulse *p = params;
    memset(F, 0, d * sizeof *F);
    F[p->i] = fabs(t - p->t) < 1e-6 ? p->size : 0;
    return 0;
}

/* The building; where fvi-shifted takes no law, the third damper is a power. */
static void make_building(building *b, const fvi_method *method, int has_push)
{
    build(b);
    if (method == &fvi_cq2_shifted)
        b->kernel[2].count = 1;
    if (!has_push) /* other pasts, and orders below 1 */
        b->term[1].alpha = 0.4;
    if (!has_push && method != &fvi_fractional)
        b->damper[1].past = FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE;
    b->damper[0].past = FVI_INITIAL_HISTORY_CAPUTO;
}

/* x_0 and p_0 act linearly, so differences of 1 are the derivatives but for rounding: 60 steps and
 * 300 terms of size 1. Seen: 5e-14. */
static void ck_assert_starts(const fvi_method *method, const fvi_run *run, double J,
                             const double *by_x0, const double *by_p0)
{
    for (size_t i = 0; i < 2 * D; i++) {
        double x[D], p[D];
        fvi_run other = *run;
        memcpy(x, run->x0, sizeof x);
        memcpy(p, run->p0, sizeof p);
        (i < D ? x : p)[i % D] += 1;
        other.x0 = x;
        other.p0 = p;
        const double want = value_of(method, &other) - J,
                     got = i < D ? by_x0[i] : by_p0[i - D];
        seen_worst(fabs(got - want), "by the start");
        ck_assert_near(got, want, 1e-11, "%s %s of %zu", method->name, i < D ? "x0" : "p0",
                       i % D);
    }
}

/* A matrix, or the terms of a kernel. */
typedef struct {
    fvi_sparse *A;
    fvi_kernel_term *term;
    size_t count;
} scaled;

static void scale(const scaled *of, double factor)
{
    for (size_t l = 0; l < of->count; l++)
        *(of->A ? of->A->entry + l : &of->term[l].rho) *= factor;
}

static double value_of_building(const fvi_method *method, building *b, const fvi_run *run)
{
    fvi_structure *s;
    OK(fvi_structure_alloc_dampers(&b->M, &b->K, DAMPERS, b->damper, &s, NULL));
    fvi_system system = fvi_structure_system(s);
    system.force = run->system->force;
    fvi_run other = *run;
    other.system = &system;
    const double J = value_of(method, &other);
    fvi_structure_free(s);
    return J;
}

/* Times 1 + e and 1 - e, e a power of 2: the difference is off by e^2 times a third derivative, and
 * by rounding over e. Seen: 4e-8. */
static double by_factor(const fvi_method *method, building *b, const fvi_run *run,
                        scaled of)
{
    const double e = 0x1p-13;
    double J[2];
    for (int side = 0; side < 2; side++) {
        scale(&of, side ? 1 + e : 1 - e);
        J[side] = value_of_building(method, b, run);
        scale(&of, 1 / (side ? 1 + e : 1 - e));
    }
    return (J[1] - J[0]) / (2 * e);
}

START_TEST(eq_23_19_every_derivative_of_several_dampers)
{
    for (size_t n = 0; n < 2 * LEN(takers); n++) {
        const fvi_method *method = takers[n / 2];
        const fvi_objective J = { .slopes = slopes };
        double x0[D], p0[D], mass, stiffness, damping[DAMPERS], force[(N + 1) * D];
        const fvi_sensitivities want = { .x0 = x0,
                                         .p0 = p0,
                                         .mass = &mass,
                                         .damping = damping,
                                         .force = force,
                                         .parameters = &stiffness };
        building b;
        make_building(&b, method, n % 2);
        pulse hit = { 0.1, 0, 2 };
        b.system.force = (fvi_force){ .value = push_at, .params = &hit };
        fvi_run run = run_of(&b.system, 0.5, 0.02, N, shape, push);
        run.kappa = 0.7;
        OK(fvi_adjoint(method, &run, NULL, NULL, &J, &want));
        const double value = value_of(method, &run);
        ck_assert_starts(method, &run, value, x0, p0);
        const struct {
            double got;
            scaled of;
        } factors[] = { { mass, { &b.M, NULL, (size_t)b.M.start[D] } },
                        { stiffness, { &b.K, NULL, (size_t)b.K.start[D] } },
                        { damping[0], { NULL, b.term, 1 } },
                        { damping[1], { NULL, b.term + 1, 1 } },
                        { damping[2], { NULL, b.term + 2, b.kernel[2].count } } };
        for (size_t l = 0; l < LEN(factors); l++) {
            const double by = by_factor(method, &b, &run, factors[l].of);
            seen_worst(fabs(factors[l].got - by), "by factors");
            ck_assert_near(factors[l].got, by, 1e-6 * larger(1, fabs(by)), "%s factor %zu",
                           method->name, l);
        }
        hit.size = 1;
        ck_assert_near(value_of(method, &run) - value, force[5 * D + 2], 1e-12, "%s force",
                       method->name);
        free_building(&b);
    }
}
END_TEST

START_TEST(what_several_dampers_have_no_derivative_by_is_refused)
{
    building b;
    double x0[D], terms[4] = { 0 };
    build(&b);
    const fvi_run run = run_of(&b.system, 0.5, 0.02, N, shape, push);
    const fvi_objective J = { .slopes = slopes };
    const fvi_sensitivities start = { .x0 = x0 }, by_alpha = { .alpha = terms },
                            by_terms = { .terms = terms }; /* four in all */
    ck_assert_int_eq(fvi_adjoint(&fvi_cq_bdf2, &run, NULL, NULL, &J, &by_alpha),
                     FVI_EINVAL);
    OK(fvi_adjoint(&fvi_cq_bdf2, &run, NULL, NULL, &J, &by_terms));
    ck_assert_int_eq(fvi_adjoint(&fvi_cq2_shifted, &run, NULL, NULL, &J, &start),
                     FVI_EUNSUP); /* of a law */
    b.term[1].alpha = 0.4;
    b.damper[1].past = FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE;
    ck_assert_int_eq(fvi_adjoint(&fvi_fractional, &run, NULL, NULL, &J, &start),
                     FVI_EUNSUP);
    OK(fvi_adjoint(&fvi_cq_bdf2, &run, NULL, NULL, &J, &start));
    b.term[2].kind = FVI_KERNEL_POWER; /* with stages no numbers of a sum that grows faster than s */
    b.term[2].alpha = 0.7;
    b.term[2].time = 0;
    OK(fvi_adjoint(&fvi_lobatto_d3, &run, NULL, NULL, &J, &start));
    ck_assert_int_eq(fvi_adjoint(&fvi_lobatto_d3, &run, NULL, NULL, &J, &by_terms), FVI_EUNSUP);
    free_building(&b);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("adjoint_dampers");
    ADD_CASE(suite, "dampers", eq_23_19_every_derivative_of_several_dampers,
             what_several_dampers_have_no_derivative_by_is_refused);
    return run_suite(suite);
}
