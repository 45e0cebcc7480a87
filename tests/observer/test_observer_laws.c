/* tests/observer/test_observer_laws.c -- Forces of laws in the first rows, also where a law relaxes within a step.
 * Run alone: make test-observer_laws */
#include "harness/ulp.h"

#include "kernel/kernel_responses.h"

#include <fvi/exact_motion.h>
#include <fvi/fvi.h>
#include <fvi/observer.h>

#include "observer_laws_ref.h"

#include <stdlib.h>

static const double one = 1, none = 0, stiffness = 2, h = 1.0 / 64;

/* Law i of the reference: one term, and a dashpot. */
typedef struct {
    fvi_kernel_term term[2];
    fvi_kernel kernel;
} law;

static void make_law(size_t i, law *to)
{
    to->term[0] = (fvi_kernel_term){ .kind = (fvi_kernel_kind)ref_laws[i].kind,
                                     .rho = ref_laws[i].rho,
                                     .alpha = ref_laws[i].alpha,
                                     .time = ref_laws[i].time,
                                     .end = ref_laws[i].end };
    to->term[1] = (fvi_kernel_term){ .kind = FVI_KERNEL_POWER, .rho = ref_laws[i].dashpot, .alpha = 0.5 };
    to->kernel = (fvi_kernel){ .count = ref_laws[i].dashpot > 0 ? 2 : 1, .term = to->term };
}

/* ---- what a law answers ---- */

/* Relative to each number, and of a jump that has died out to the jump itself: 1e-12; seen 4e-14. */
START_TEST(eq_26_21_the_answers_of_a_law)
{
    for (size_t i = 0; i < LEN(ref_responses); i++) {
        const double want[] = { ref_responses[i].G_1, ref_responses[i].G_2, ref_responses[i].G_3,
                                ref_responses[i].G_4 };
        double got[27 * FVI_KERNEL_RESPONSES];
        law of;
        make_law(ref_responses[i].law, &of);
        const size_t k = ref_responses[i].k;
        ck_assert_int_eq(fvi_kernel_responses(&of.kernel, h, k, got), 0);
        for (size_t m = 0; m < FVI_KERNEL_RESPONSES; m++) {
            const double e = fabs(got[FVI_KERNEL_RESPONSES * (k - 1) + m] - want[m])
                             / (fabs(want[m]) + (m == 0 ? fabs(got[0]) : 0));
            seen_worst(e, "off");
            ck_assert_msg(e <= 1e-12, "law %zu, row %zu, G_%zu: %g", ref_responses[i].law, k, m + 1, e);
        }
    }
}
END_TEST

/* rho s^o: rho t^(m - 1 - o) / Gamma(m - o). Of two powers side by side the integral is taken. */
START_TEST(the_answers_of_a_power_are_powers)
{
    for (double o = 0.1; o < 1.95; o += 0.2) {
        const fvi_kernel_term term = { .kind = FVI_KERNEL_POWER, .rho = 0.375, .alpha = o / 2 },
                              both[] = { term, term };
        const fvi_kernel of = { 2, both };
        double got[84 * FVI_KERNEL_RESPONSES];
        ck_assert_int_eq(fvi_kernel_responses(&of, h, 84, got), 0);
        for (size_t k = 1; k <= 84; k++)
            for (size_t m = 1; m <= FVI_KERNEL_RESPONSES; m++) {
                const double want = 0.75 * pow((double)k * h, (double)m - 1 - o) / tgamma((double)m - o),
                             e = fabs(got[FVI_KERNEL_RESPONSES * (k - 1) + m - 1] / want - 1);
                seen_worst(e, "off");
                ck_assert_msg(e <= 1e-12, "order %g, row %zu, G_%zu: %g", o, k, m, e);
            }
    }
}
END_TEST

/* s has 0, 1, t, t^2/2, and s^2 has 0, 0, 1, t. */
START_TEST(whole_orders_answer_with_whole_powers)
{
    for (int order = 1; order <= 2; order++) {
        const fvi_kernel_term term = { .kind = FVI_KERNEL_POWER, .rho = 1, .alpha = order / 2.0 };
        const fvi_kernel of = { 1, &term };
        const double want[] = { 0, 0, 1, h, h * h / 2 };
        double got[FVI_KERNEL_RESPONSES];
        ck_assert_int_eq(fvi_kernel_responses(&of, h, 1, got), 0);
        for (size_t m = 0; m < FVI_KERNEL_RESPONSES; m++)
            ck_assert_msg(got[m] == want[m + 2 - (size_t)order], "order %d, G_%zu: %g", order, m + 1, got[m]);
    }
}
END_TEST

/* ---- forces of an oscillator ---- */

typedef enum { BY_ALPHA, BY_LAW, BY_DAMPER, BY_ELONGATION } damped_by; /* by an alpha: one power only */

/* z = x, as a function. */
static int stretch(double t, size_t d, const double *x, void *params, double *z)
{
    (void)t, (void)d, (void)params;
    *z = x[0];
    return 0;
}

static int stretch_gradient(double t, size_t d, const double *x, void *params, double *G)
{
    (void)t, (void)d, (void)x, (void)params;
    G[0] = 1;
    return 0;
}

static int stretch_hessian(double t, size_t d, const double *x, double lambda, void *params, double *H)
{
    (void)t, (void)d, (void)x, (void)lambda, (void)params, (void)H;
    return 0;
}

/* The forces of rows 0 to `rows` of a run with steps of `step`. 0: the method does not take the law. */
static int forces(const fvi_method *method, damped_by way, const fvi_kernel *kernel, fvi_initial_history past,
                  double x0, double v0, double step, size_t rows, double *force)
{
    const fvi_damper damper = { .of = { .row = way == BY_DAMPER ? &one : NULL,
                                        .value = stretch,
                                        .gradient = stretch_gradient,
                                        .hessian = stretch_hessian },
                                .kernel = kernel,
                                .past = past };
    const fvi_mechanism mechanism = { .damper = &damper, .damper_count = 1 };
    const fvi_system system = { .d = 1,
                                .mass = &one,
                                .damping = way == BY_ALPHA ? &kernel->term->rho
                                           : way == BY_LAW ? &one
                                                           : &none,
                                .potential = fvi_potential_harmonic(&stiffness),
                                .mechanism = way <= BY_LAW ? NULL : &mechanism };
    fvi_run run = fvi_run_default(&system, &x0, &v0, step, rows);
    fvi_stepper *s;
    fvi_observer *o;
    fvi_observation now;
    fvi_error error = { 0 };
    run.law = way == BY_LAW ? kernel : NULL;
    run.alpha = kernel->term->alpha;
    run.past = past;
    if (way > BY_LAW && !method->takes_mechanism)
        return 0;
    ck_assert_msg(fvi_stepper_start(method, &run, &s, &error) == 0, "%s: %s", method->name, error.text);
    ck_assert_msg(fvi_observer_start(s, FVI_OBSERVE_FORCE, &o, &error) == 0, "%s", error.text);
    for (size_t k = 0; k <= rows; k++) {
        ck_assert_int_eq(k > 0 ? fvi_observer_step(o, s) : 0, 0);
        ck_assert_int_eq(fvi_observer_read(o, s, (double)k * step, &now), 0);
        force[k] = now.force[0];
    }
    fvi_observer_free(o);
    fvi_stepper_free(s);
    return 1;
}

static int takes_laws(const fvi_method *method)
{
    return method->takes_laws && !method->dense;
}

/* Form D with two stages takes nearly nothing from a body at rest in its first step, and so row 1 tells little. */
static int is_told_little(const fvi_method *method, double v0, size_t k)
{
    return method == &fvi_lobatto_d2 && v0 == 0 && k == 1;
}

enum { ROWS = 13 };

/* The largest error of a row of law and start number i of the reference, relative to the largest force until then; i
 * goes to the next one. */
static double worst_row(const fvi_method *method, damped_by way, size_t *i)
{
    const size_t first = *i, number = ref_forces[first].law;
    const double x0 = ref_forces[first].x0, v0 = ref_forces[first].v0;
    double told[ROWS + 1] = { 0 }, largest = 0, worst = 0;
    law of;
    make_law(number, &of);
    const int taken = forces(method, way, &of.kernel, FVI_INITIAL_HISTORY_HELD, x0, v0, h, ROWS, told);
    for (; *i < LEN(ref_forces) && ref_forces[*i].law == number && ref_forces[*i].x0 == x0; ++*i) {
        largest = larger(largest, fabs(ref_forces[*i].force));
        const double e = fabs(told[ref_forces[*i].k] - ref_forces[*i].force) / largest;
        if (taken && !is_told_little(method, v0, ref_forces[*i].k) && !(e <= worst))
            worst = e;
    }
    return worst;
}

static int is_power(size_t number)
{
    return ref_laws[number].kind == FVI_KERNEL_POWER && ref_laws[number].dashpot == 0;
}

/* 2 h, or 1e-7 of a power above the order 1: those rows are taken by short steps. */
static double bound_of(const fvi_method *method, size_t number)
{
    const int is_above_1 = is_power(number) && ref_laws[number].alpha > 0.5;
    return (is_above_1 ? 1e-7 : 2 * h) + (method->highest == 1 ? 0.25 : 0);
}

/* 22 laws with relaxation times from h/10 to 100 h, and six powers. A line and a parabola are exact (13.20), and what
 * else z does within a step is a part 2 h of the force at most: the spring changes z'' by c h, and the damper by less.
 * Seen 0.5 of it, and up to 26 times the bound without (13.20). Of powers above the order 1 seen 0.01 of the bound, and
 * the force itself by (13.20). Of order 1 rows behind the third are differences, which are late by h/2: at row 4 of a
 * force that grows like t by an eighth, and twice as much of a law that rings; seen 0.49 of it. */
START_TEST(the_first_rows_of_a_law_are_right)
{
    for (size_t m = 0; fvi_methods[m]; m++)
        for (damped_by way = BY_ALPHA; way <= (fvi_methods[m]->stages > 4 ? BY_LAW : BY_ELONGATION); way++)
            for (size_t i = takes_laws(fvi_methods[m]) ? 0 : LEN(ref_forces); i < LEN(ref_forces);) {
                const size_t number = ref_forces[i].law, start = i;
                const double x0 = ref_forces[i].x0, bound = bound_of(fvi_methods[m], number),
                             e = worst_row(fvi_methods[m], way, &i);
                if (way == BY_ALPHA && !is_power(number))
                    continue;
                if (fvi_methods[m]->highest == 1)
                    seen_worst(e / bound, "of the bound, order 1");
                else if (is_power(number) && ref_laws[number].alpha > 0.5)
                    seen_worst(e / bound, "of the bound, above the order 1");
                else if (is_power(number))
                    seen_worst(e / bound, "of the bound, powers");
                else
                    seen_worst(e / bound, "of the bound");
                ck_assert_msg(e <= bound && i > start, "%s %d, law %zu, x0 %g: %g", fvi_methods[m]->name, (int)way,
                              number, x0, e);
            }
}
END_TEST

/* ---- the order, for a Maxwell element, by Taylor's series of its three equations ---- */

/* (x, v, f)' = (v, -c x - f, (rho v - f)/T), by halving the time 12 times and a series of 16 terms for each part. */
static double maxwell_force(double rho, double T, double x0, double v0, double t)
{
    double y[] = { x0, v0, 0 };
    const int parts = 4096;
    for (int n = 0; n < parts; n++) {
        double term[] = { y[0], y[1], y[2] };
        for (int i = 1; i <= 16; i++) {
            const double s = t / parts / i, x = term[0], v = term[1], f = term[2];
            term[0] = s * v;
            term[1] = s * (-stiffness * x - f);
            term[2] = s * (rho * v - f) / T;
            for (int j = 0; j < 3; j++)
                y[j] += term[j];
        }
    }
    return y[2];
}

enum { ORDER_ROWS = 28 };

static double worst_of_maxwell(const fvi_method *method, double T, double x0, double v0, double step)
{
    const fvi_kernel_term term = { .kind = FVI_KERNEL_MAXWELL, .rho = 0.75, .time = T };
    const fvi_kernel of = { 1, &term };
    double told[ORDER_ROWS + 1], worst = 0;
    forces(method, BY_LAW, &of, FVI_INITIAL_HISTORY_HELD, x0, v0, step, ORDER_ROWS, told);
    for (size_t k = 0; k <= ORDER_ROWS; k++) {
        const double e = fabs(told[k] - maxwell_force(0.75, T, x0, v0, (double)k * step));
        if (!is_told_little(method, v0, k) && !(e <= worst))
            worst = e;
    }
    return worst;
}

/* Rows 0 to 28 for steps of T/8 and T/32: the order of the method, at most 3, because row 1 compares z
 * with a parabola. Margin 0.4; seen 0.15 of it. */
START_TEST(the_first_rows_have_the_order_of_the_method)
{
    static const double start[][2] = { { 0, 1 }, { 1, 0 }, { 0.5, 0.75 } };
    for (size_t m = 0; fvi_methods[m]; m++)
        for (size_t i = 0; i < LEN(start) && takes_laws(fvi_methods[m]); i++) {
            const fvi_method *method = fvi_methods[m];
            const double T = 0.5, coarse = worst_of_maxwell(method, T, start[i][0], start[i][1], T / 8),
                         fine = worst_of_maxwell(method, T, start[i][0], start[i][1], T / 32),
                         order = log2(coarse / fine) / 2, least = smaller(method->lowest, 3);
            seen_worst((least - order) / 0.4, "of the margin");
            ck_assert_msg(order >= least - 0.4, "%s, start %zu: %g, %g, order %g", method->name, i, coarse, fine, order);
        }
}
END_TEST

/* ---- a jump ---- */

/* A past that jumps, with a law: by fvi. Rows 1 to 3, relative to the largest force until then: h, as for a start
 * without a jump; seen 0.96 of it. */
START_TEST(the_first_rows_behind_a_jump_are_right)
{
    double largest = 0;
    for (damped_by way = BY_DAMPER; way <= BY_ELONGATION; way++)
        for (size_t i = 0; i < LEN(ref_jumps); i++) {
            const size_t k = ref_jumps[i].k;
            double told[4];
            law of;
            make_law(ref_jumps[i].law, &of);
            forces(&fvi_fractional, way, &of.kernel, FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE, ref_jumps[i].x0,
                   ref_jumps[i].v0, h, 3, told);
            largest = larger(k > 1 ? largest : 0, fabs(ref_jumps[i].force));
            const double e = fabs(told[k] - ref_jumps[i].force) / largest;
            seen_worst(e / h, "of the bound");
            ck_assert_msg(e <= h, "law %zu, v0 %g, row %zu: %g", ref_jumps[i].law, ref_jumps[i].v0, k, e);
        }
}
END_TEST

/* A past that jumps, with a power: by all methods, relative to the force itself. Short steps take these rows; seen 0.01
 * of 1e-7. By fvi they take rows 1 to 3. Row 1 was off by 0.1 for the order 0.8 with a start velocity. */
START_TEST(the_first_rows_behind_a_jump_of_a_power_are_right)
{
    for (size_t m = 0; fvi_methods[m]; m++)
        for (damped_by way = BY_ALPHA; way <= BY_DAMPER && takes_laws(fvi_methods[m]); way++)
            for (size_t i = 0; i < LEN(ref_jumps_of_powers) && way != BY_LAW; i++) {
                const size_t k = ref_jumps_of_powers[i].k;
                double told[ROWS + 1];
                law of;
                make_law(ref_jumps_of_powers[i].law, &of);
                if ((fvi_methods[m]->highest == 1 && k > 3)
                    || !forces(fvi_methods[m], way, &of.kernel, FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE, 0.5,
                               ref_jumps_of_powers[i].v0, h, ROWS, told))
                    continue;
                const double e = fabs(told[k] / ref_jumps_of_powers[i].force - 1);
                seen_worst(e / 1e-7, "of the bound");
                ck_assert_msg(e <= 1e-7, "%s %d, law %zu, v0 %g, row %zu: %g", fvi_methods[m]->name, (int)way,
                              ref_jumps_of_powers[i].law, ref_jumps_of_powers[i].v0, k, e);
            }
}
END_TEST

/* ---- a point without mass ---- */

static int spring(size_t d, const double *x, void *params, double *value)
{
    (void)d, (void)params;
    *value = (x[0] - x[1]) * (x[0] - x[1]) / 2;
    return 0;
}

static int spring_gradient(size_t d, const double *x, void *params, double *grad)
{
    (void)d, (void)params;
    grad[0] = x[0] - x[1];
    grad[1] = -grad[0];
    return 0;
}

static int spring_hessian(size_t d, const double *x, void *params, double *H)
{
    (void)d, (void)x, (void)params;
    H[0] = H[3] = 1;
    H[1] = H[2] = -1;
    return 0;
}

/* A mass at 1 pulls at a point without mass at 0, which a law holds, so it starts out of balance. v, a and the force,
 * relative to each number, for laws with a relaxation and for powers: 1e-6, since a is the second derivative of what
 * short steps know to 1e-10; seen 0.01 of it. By the steps of the run v was off by 0.4, and a by more than itself. */
START_TEST(the_first_rows_of_a_point_without_mass_are_right)
{
    static const double mass[] = { 1, 0 }, zeros[] = { 0, 0 }, x0[] = { 1, 0 }, row[] = { 0, 1 };
    static const fvi_method *const methods[] = { &fvi_cq2_midpoint, &fvi_lobatto_d2, &fvi_lobatto_d3, &fvi_lobatto_d4 };
    const fvi_potential potential = { .value = spring, .gradient = spring_gradient, .hessian = spring_hessian };
    for (size_t m = 0; m < LEN(methods); m++)
        for (size_t i = 0; i < LEN(ref_massless); i++) {
            law of;
            fvi_stepper *s;
            fvi_observer *o;
            fvi_observation now;
            fvi_error error = { 0 };
            make_law(ref_massless[i].law, &of);
            const fvi_damper damper = { .of.row = row, .kernel = &of.kernel };
            const fvi_mechanism mechanism = { .damper = &damper, .damper_count = 1 };
            const fvi_system system = {
                .d = 2, .mass = mass, .damping = zeros, .potential = potential, .mechanism = &mechanism
            };
            const fvi_run run = fvi_run_default(&system, x0, zeros, h, ROWS);
            ck_assert_msg(fvi_stepper_start(methods[m], &run, &s, &error) == 0, "%s", error.text);
            ck_assert_int_eq(fvi_observer_start(s, FVI_OBSERVE_FORCE | FVI_OBSERVE_VELOCITY | FVI_OBSERVE_ACCELERATION,
                                                &o, NULL), 0);
            while (s->k < ref_massless[i].k)
                ck_assert_int_eq(fvi_observer_step(o, s), 0);
            ck_assert_int_eq(fvi_observer_read(o, s, s->t, &now), 0);
            const double told[] = { now.v[1], now.a[1], now.force[0] },
                         want[] = { ref_massless[i].v, ref_massless[i].a, ref_massless[i].force };
            for (size_t n = 0; n < LEN(told); n++) {
                const double e = fabs(told[n] / want[n] - 1);
                seen_worst(e / 1e-6, "of the bound");
                ck_assert_msg(e <= 1e-6, "%s, law %zu, row %zu, %zu: %g, %g", methods[m]->name, ref_massless[i].law,
                              ref_massless[i].k, n, told[n], want[n]);
            }
            fvi_observer_free(o);
            fvi_stepper_free(s);
        }
}
END_TEST

/* A Zener element meets a jump with rho/T, at once. */
START_TEST(the_force_of_a_jump_at_the_start_is_that_of_a_spring)
{
    law of;
    double told[2];
    make_law(5, &of);
    forces(&fvi_fractional, BY_DAMPER, &of.kernel, FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE, 0.5, 0.75, h, 1, told);
    ck_assert_near(told[0], 0.5 * of.term->rho / of.term->time, 4 * U * told[0], "rho/T");
}
END_TEST

/* ---- random runs of two bodies with four dampers ---- */

enum { DAMPERS = 4, BODIES = 2, RUNS = 120, RANDOM_ROWS = 12 };

typedef struct {
    fvi_kernel_term term[DAMPERS];
    fvi_kernel kernel[DAMPERS];
    fvi_damper damper[DAMPERS];
    double x0[BODIES], p0[BODIES];
} random_run;

static double uniform(double from, double to)
{
    return from + (to - from) * rand() / RAND_MAX;
}

/* Powers up to the order 2 most_alpha; of all but the last damper also two of them side by side. */
static void make_powers(random_run *o, double most_alpha)
{
    for (size_t j = 0; j + 1 < DAMPERS; j++)
        o->kernel[j].count = 1 + (size_t)(rand() % 2);
    for (size_t j = 0; j < DAMPERS; j++)
        o->term[j] = (fvi_kernel_term){ .kind = FVI_KERNEL_POWER,
                                        .rho = uniform(0.1, 1),
                                        .alpha = uniform(0.05, most_alpha) };
}

/* T from h/10 to 100 h. The last damper has the law of the first one, so that laws are told apart by their numbers. */
static void make_random_run(random_run *o)
{
    static const double rows[DAMPERS][BODIES] = { { 1, 0 }, { -1, 1 }, { 0, 1 }, { 0.5, 0.5 } };
    for (size_t j = 0; j < DAMPERS; j++) {
        const double T = h * pow(10, uniform(-1, 2)), alpha = uniform(0.05, 0.5), fast = uniform(0, 1);
        o->term[j] = (fvi_kernel_term){ .kind = fast < 0.5   ? FVI_KERNEL_ZENER
                                                : fast < 0.7 ? FVI_KERNEL_MAXWELL
                                                : fast < 0.8 ? FVI_KERNEL_DAVIDSON
                                                : fast < 0.9 ? FVI_KERNEL_DISTRIBUTED
                                                             : FVI_KERNEL_MAXWELL2,
                                        .rho = uniform(0.1, 1),
                                        .alpha = alpha,
                                        .time = fast < 0.5 ? pow(T, 2 * alpha) : T,
                                        .end = fast < 0.9 ? alpha + 0.1 : alpha / 2 };
        if (j == DAMPERS - 1)
            o->term[j] = o->term[0];
        o->kernel[j] = (fvi_kernel){ 1, &o->term[j] };
        o->damper[j] = (fvi_damper){ .of.row = rows[j],
                                     .kernel = &o->kernel[j],
                                     .past = FVI_INITIAL_HISTORY_HELD };
    }
    for (size_t j = 0; j < BODIES; j++) {
        o->x0[j] = uniform(-1, 1);
        o->p0[j] = rand() % 3 == 0 ? 0 : uniform(-1, 1);
    }
}

/* The worst error of a force in rows 1 to 12, relative to the largest force until then. */
static double worst_of_random_run(const fvi_method *method, const random_run *of)
{
    static const double mass[] = { 1, 1.5 }, zeros[] = { 0, 0 };
    const fvi_mechanism mechanism = { .damper = of->damper, .damper_count = DAMPERS };
    const fvi_system system = { .d = BODIES,
                                .mass = mass,
                                .damping = zeros,
                                .potential = fvi_potential_harmonic(&stiffness),
                                .mechanism = &mechanism };
    const fvi_run run = fvi_run_default(&system, of->x0, of->p0, h, RANDOM_ROWS);
    const fvi_exact_problem problem = { .motion = { .system = &system }, .x0 = of->x0, .p0 = of->p0 };
    double exact[DAMPERS], x[BODIES], v[BODIES], worst = 0, largest = 0;
    const fvi_exact_outputs out = { .x = x, .v = v, .force = exact };
    fvi_stepper *s;
    fvi_observer *first, *o;
    fvi_observation now;
    fvi_exact_motion *motion;
    fvi_error error = { 0 };
    ck_assert_msg(fvi_exact_motion_alloc(&problem, &motion, &error) == 0, "%s", error.text);
    const int status = fvi_stepper_start(method, &run, &s, NULL);
    if (status == FVI_EUNSUP) { /* the tail of a law has no modes: a few runs */
        fvi_exact_motion_free(motion);
        return 0;
    }
    ck_assert_int_eq(status, 0);
    ck_assert_int_eq(fvi_observer_start(s, FVI_OBSERVE_FORCE, &first, NULL), 0);
    ck_assert_int_eq(fvi_observer_copy(first, &o), 0); /* which knows the laws, too */
    fvi_observer_free(first);
    for (size_t k = 1; k <= RANDOM_ROWS; k++) {
        ck_assert_int_eq(fvi_observer_step(o, s), 0);
        ck_assert_int_eq(fvi_observer_read(o, s, (double)k * h, &now), 0);
        ck_assert_int_eq(fvi_exact_motion_forces_at(motion, (double)k * h, h, &out, NULL), 0);
        for (size_t j = 0; j < DAMPERS; j++)
            largest = larger(largest, fabs(exact[j]));
        for (size_t j = 0; j < DAMPERS; j++)
            if (!(fabs(now.force[j] - exact[j]) <= worst * largest))
                worst = fabs(now.force[j] - exact[j]) / largest;
    }
    fvi_observer_free(o);
    fvi_stepper_free(s);
    fvi_exact_motion_free(motion);
    return worst;
}

/* Springs and dampers change z'' within a step by (2 + 4 rho) h at most, of the largest of all forces: 6 h; seen 0.62
 * of it. */
START_TEST(random_laws_are_right_in_their_first_rows)
{
    static const fvi_method *const methods[] = { &fvi_cq2_midpoint, &fvi_lobatto_m2, &fvi_lobatto_m3,
                                                 &fvi_lobatto_m4,   &fvi_lobatto_m8, &fvi_lobatto_d3 };
    srand(13);
    for (int n = 0; n < RUNS; n++) {
        random_run of;
        make_random_run(&of);
        const double e = worst_of_random_run(methods[n % 6], &of);
        seen_worst(e / (6 * h), "of the bound");
        ck_assert_msg(e <= 6 * h, "run %d, %s: %g", n, methods[n % 6]->name, e);
    }
}
END_TEST

/* The same of powers, up to the order 1; seen 0.02 of 6 h. With one above it short steps take all rows: 1e-7; seen 0.8 of
 * it, for an order of 1.95. */
START_TEST(random_powers_are_right_in_their_first_rows)
{
    static const fvi_method *const methods[] = { &fvi_cq2_midpoint, &fvi_lobatto_m2, &fvi_lobatto_m3,
                                                 &fvi_lobatto_m4,   &fvi_lobatto_m8, &fvi_lobatto_d3 };
    srand(17);
    for (int n = 0; n < RUNS; n++) {
        random_run of;
        make_random_run(&of);
        make_powers(&of, n % 2 ? 0.5 : 0.98);
        double largest = 0;
        for (size_t j = 0; j < DAMPERS; j++)
            largest = larger(largest, of.term[j].alpha);
        const double e = worst_of_random_run(methods[n % 6], &of), bound = largest > 0.5 ? 1e-7 : 6 * h;
        if (largest > 0.5)
            seen_worst(e / bound, "of the bound, above the order 1");
        else
            seen_worst(e / bound, "of the bound");
        ck_assert_msg(e <= bound, "run %d, %s: %g", n, methods[n % 6]->name, e);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("the first rows of laws");
    ADD_CASE(suite, "laws", eq_26_21_the_answers_of_a_law, the_answers_of_a_power_are_powers,
             whole_orders_answer_with_whole_powers, the_first_rows_of_a_law_are_right, the_first_rows_have_the_order_of_the_method,
             the_first_rows_behind_a_jump_are_right, the_first_rows_behind_a_jump_of_a_power_are_right,
             the_first_rows_of_a_point_without_mass_are_right, the_force_of_a_jump_at_the_start_is_that_of_a_spring,
             random_laws_are_right_in_their_first_rows, random_powers_are_right_in_their_first_rows);
    return run_suite(suite);
}
