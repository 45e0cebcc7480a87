/* tests/adjoint/test_adjoint_mechanism.c -- H 23, 29: derivatives of runs with dampers between points, a
 * Lagrangian, forces that depend on the velocity, and constraints.
 * Run alone: make test-adjoint_mechanism */
#include <fvi/fvi.h>

#include "harness/seen.h"
#include "harness/ulp.h"
#include "run/whole_run.h"
#include "system/larger.h"

#include "adjoint_mechanism_ref.h"

#include <check.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { D = 2, N = 5, DAMPERS = 3, TERMS = 2, NUMBERS = 4, MASSES = 0, CART = 1, ROD = 2 };

static const double h = 1. / 8;

/* J is linear: its slopes, which adjoint_mechanism.py has, too. */
static int slopes(size_t k, size_t d, const double *x, const double *p, void *params,
                  double *Jx, double *Jp)
{
    (void)x, (void)p, (void)params;
    for (size_t i = 0; i < d; i++) {
        Jx[i] += ((double)((7 * k + 3 * i) % 11) - 5) / 8;
        if (Jp)
            Jp[i] += ((double)((5 * k + 4 * i) % 7) - 3) / 8;
    }
    return 0;
}

/* ---- the systems ---- */

static int cosine(double t, size_t d, void *params, double *F)
{
    (void)params;
    for (size_t i = 0; i < d; i++)
        F[i] = (double)(i + 1) * cos(1.25 * t) / 5;
    return 0;
}

static int length(double t, size_t d, const double *x, void *params, double *g)
{
    (void)t, (void)d, (void)params;
    *g = hypot(x[0] + 2, x[1]);
    return 0;
}

static int length_gradient(double t, size_t d, const double *x, void *params, double *G)
{
    double r;
    length(t, d, x, params, &r);
    G[0] = (x[0] + 2) / r;
    G[1] = x[1] / r;
    return 0;
}

static int length_hessian(double t, size_t d, const double *x, double factor, void *params,
                          double *H)
{
    double r, G[D];
    length(t, d, x, params, &r);
    length_gradient(t, d, x, params, G);
    for (size_t i = 0; i < D * D; i++)
        H[i] += factor * ((i % 3 == 0) - G[i / D] * G[i % D]) / r;
    return 0;
}

/* 3 v1^2/2 + v1 v2 cos x2 + v2^2/2 + c cos x2 - x1^2/2 */
static int cart(double t, size_t d, const double *x, const double *v, void *params, double *L,
                double *Lx, double *Lv, double *Lxx, double *Lxv, double *Lvv)
{
    const double c = *(const double *)params, sine = sin(x[1]), cosine_ = cos(x[1]);
    (void)t, (void)d;
    if (L)
        *L = 1.5 * v[0] * v[0] + v[0] * v[1] * cosine_ + v[1] * v[1] / 2 + c * cosine_
             - x[0] * x[0] / 2;
    if (Lx)
        memcpy(Lx, (double[]){ -x[0], -v[0] * v[1] * sine - c * sine }, D * sizeof *Lx);
    if (Lv)
        memcpy(Lv, (double[]){ 3 * v[0] + v[1] * cosine_, v[0] * cosine_ + v[1] },
               D * sizeof *Lv);
    if (Lxx)
        memcpy(Lxx, (double[]){ -1, 0, 0, -v[0] * v[1] * cosine_ - c * cosine_ },
               D * D * sizeof *Lxx);
    if (Lxv)
        memcpy(Lxv, (double[]){ 0, 0, -v[1] * sine, -v[0] * sine }, D * D * sizeof *Lxv);
    if (Lvv)
        memcpy(Lvv, (double[]){ 3, cosine_, cosine_, 1 }, D * D * sizeof *Lvv);
    return 0;
}

static int cart_by(size_t j, double t, size_t d, const double *x, const double *v, void *params,
                   double *Sx, double *Sv)
{
    (void)j, (void)t, (void)d, (void)v, (void)params, (void)Sv;
    Sx[1] -= sin(x[1]);
    return 0;
}

/* |v|^2/2 - c x2 */
static int fall(double t, size_t d, const double *x, const double *v, void *params, double *L,
                double *Lx, double *Lv, double *Lxx, double *Lxv, double *Lvv)
{
    const double c = *(const double *)params;
    (void)t, (void)d;
    if (L)
        *L = (v[0] * v[0] + v[1] * v[1]) / 2 - c * x[1];
    if (Lx)
        memcpy(Lx, (double[]){ 0, -c }, D * sizeof *Lx);
    if (Lv)
        memcpy(Lv, v, D * sizeof *Lv);
    for (size_t i = 0; i < D * D; i++) {
        if (Lxx)
            Lxx[i] = 0;
        if (Lxv)
            Lxv[i] = 0;
        if (Lvv)
            Lvv[i] = i % 3 == 0;
    }
    return 0;
}

static int fall_by(size_t j, double t, size_t d, const double *x, const double *v, void *params,
                   double *Sx, double *Sv)
{
    (void)j, (void)t, (void)d, (void)x, (void)v, (void)params, (void)Sv;
    Sx[1] -= 1;
    return 0;
}

/* v2 x1/4 and -v2^2/8 */
static int drag(double t, size_t d, const double *x, const double *v, void *params, double *F,
                double *Fx, double *Fv)
{
    (void)t, (void)d, (void)params;
    F[0] = v[1] * x[0] / 4;
    F[1] = -v[1] * v[1] / 8;
    if (Fx)
        memcpy(Fx, (double[]){ v[1] / 4, 0, 0, 0 }, D * D * sizeof *Fx);
    if (Fv)
        memcpy(Fv, (double[]){ 0, x[0] / 4, 0, -v[1] / 4 }, D * D * sizeof *Fv);
    return 0;
}

/* (x1^2 + x2^2 - 1)/2 */
static int on_circle(double t, size_t d, const double *x, void *params, double *c)
{
    (void)t, (void)d, (void)params;
    *c = (x[0] * x[0] + x[1] * x[1] - 1) / 2;
    return 0;
}

static int circle_gradient(double t, size_t d, const double *x, void *params, double *C,
                           double *ct)
{
    (void)t, (void)d, (void)params;
    memcpy(C, x, D * sizeof *C);
    if (ct)
        *ct = 0;
    return 0;
}

static int circle_hessian(double t, size_t d, const double *x, const double *factor,
                          void *params, double *H)
{
    (void)t, (void)d, (void)x, (void)params;
    H[0] += *factor;
    H[3] += *factor;
    return 0;
}

/* ---- a run of a row ---- */

typedef struct {
    fvi_kernel kernel[DAMPERS];
    fvi_damper damper[DAMPERS];
    fvi_lagrangian L;
    fvi_state_force F;
    fvi_constraints c;
    fvi_mechanism mechanism;
    fvi_system system;
    fvi_run run;
} problem;

static const double between[] = { -1, 1 }, alone[] = { 1, 0 }, none[D];

static void set_up(size_t i, problem *p)
{
    memset(p, 0, sizeof *p);
    for (size_t j = 0; j < DAMPERS; j++) {
        p->kernel[j] = (fvi_kernel){ ref_mechanisms[i].terms[j], ref_mechanisms[i].term[j] };
        p->damper[j] = (fvi_damper){ .kernel = p->kernel + j, .past = ref_mechanisms[i].past[j] };
    }
    p->damper[0].of = fvi_elongation_row(between);
    p->damper[1].of = (fvi_elongation){ .value = length,
                                        .gradient = length_gradient,
                                        .hessian = length_hessian };
    p->damper[2].of = fvi_elongation_row(alone);
    const int which = ref_mechanisms[i].system;
    p->L = (fvi_lagrangian){ which == CART ? cart : fall, (void *)ref_mechanisms[i].cg };
    p->F.at = drag;
    p->c = (fvi_constraints){ .count = 1,
                              .value = on_circle,
                              .gradient = circle_gradient,
                              .hessian = circle_hessian };
    p->mechanism = (fvi_mechanism){ .damper_count = DAMPERS,
                                    .damper = p->damper,
                                    .lagrangian = which != MASSES ? &p->L : NULL,
                                    .force_on = which == CART ? &p->F : NULL,
                                    .constraints = which == ROD ? &p->c : NULL };
    p->system = (fvi_system){ .d = D,
                              .mass = ref_mechanisms[i].mass,
                              .damping = none,
                              .potential = fvi_potential_duffing(ref_mechanisms[i].cg),
                              .force = { .value = cosine },
                              .mechanism = &p->mechanism };
    p->run = fvi_run_default(&p->system, ref_mechanisms[i].x0, ref_mechanisms[i].p0, h, N);
    p->run.kappa = ref_mechanisms[i].kappa;
}

typedef struct {
    double by[NUMBERS][DAMPERS * TERMS], damping[DAMPERS], x0[D], p0[D], mass[D], constants[2],
        force[(2 * N + 1) * D];
    fvi_sensitivities want;
} answers;

static void ask(const problem *p, int which, answers *a)
{
    memset(a, 0, sizeof *a);
    a->want = (fvi_sensitivities){ .x0 = a->x0,
                                   .p0 = a->p0,
                                   .mass = which == MASSES ? a->mass : NULL,
                                   .damping = a->damping,
                                   .terms = a->by[0],
                                   .orders = a->by[1],
                                   .times = a->by[2],
                                   .ends = a->by[3],
                                   .force = a->force,
                                   .parameters = a->constants };
    a->want.sensitivity = fvi_parameter_gradient_of(&p->system.potential);
    if (which == MASSES)
        return;
    a->want.sensitivity = (fvi_parameter_gradient){ .count = 1 };
    a->want.lagrangian = which == CART ? cart_by : fall_by;
}

static void ck_assert_number(double got, double want, const char *method, size_t row, size_t i)
{
    seen_worst(fabs(got - want) / larger(1, fabs(want)), "worst");
    ck_assert_near(got, want, 2e-12 * larger(1, fabs(want)), "%s row %zu number %zu", method, row,
                   i);
}

/* Steps solved to a few roundings, on which five steps act five times; weights of symbols on stages to some
 * 1e-13 of the largest. Seen: see below. */
START_TEST(eq_23_29_every_derivative_of_a_mechanism_to_40_digits)
{
    const fvi_objective J = { .slopes = slopes, .has_momenta = 1 };
    for (size_t i = 0; i < LEN(ref_mechanisms); i++) {
        const fvi_method *method = ref_mechanisms[i].method;
        const int which = ref_mechanisms[i].system;
        const double *want = ref_mechanisms[i].want, *x = ref_mechanisms[i].x0,
                     *push = ref_mechanisms[i].p0;
        problem p;
        answers a;
        set_up(i, &p);
        ask(&p, which, &a);
        ck_assert_int_eq(fvi_adjoint(method, &p.run, NULL, NULL, &J, &a.want), FVI_SUCCESS);
        for (size_t j = 0, first = 0; j < DAMPERS; first += ref_mechanisms[i].terms[j++]) {
            double factor = 0;
            for (size_t l = 0; l < ref_mechanisms[i].terms[j]; l++) {
                for (size_t n = 0; n < NUMBERS; n++)
                    ck_assert_number(a.by[n][first + l], want[8 * j + 4 * l + n], method->name, i,
                                     8 * j + 4 * l + n);
                factor += ref_mechanisms[i].term[j][l].rho * want[8 * j + 4 * l];
            }
            ck_assert_number(a.damping[j], factor, method->name, i, 100 + j);
        }
        if (which == ROD) {
            ck_assert_number(-x[1] * a.x0[0] + x[0] * a.x0[1] - push[1] * a.p0[0] + push[0] * a.p0[1],
                             want[24], method->name, i, 24);
            ck_assert_number(push[0] * a.p0[0] + push[1] * a.p0[1], want[25], method->name, i, 25);
        } else
            for (size_t l = 0; l < D; l++) {
                ck_assert_number(a.x0[l], want[24 + l], method->name, i, 24 + l);
                ck_assert_number(a.p0[l], want[26 + l], method->name, i, 26 + l);
                ck_assert_number(a.mass[l], want[28 + l], method->name, i, 28 + l);
            }
        ck_assert_number(a.constants[0], want[30], method->name, i, 30);
        ck_assert_number(a.constants[1], want[31], method->name, i, 31);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("adjoint, mechanisms");
    ADD_CASE(suite, "values", eq_23_29_every_derivative_of_a_mechanism_to_40_digits);
    return run_suite(suite);
}
