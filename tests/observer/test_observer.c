/* tests/observer/test_observer.c -- Velocities, accelerations, forces and work along a run.
 * Run alone: make test-observer */
#include "harness/saved.h"
#include "harness/ulp.h"
#include "run/whole_run.h"

#include "observer_ref.h"

#include <fvi/fvi.h>
#include <fvi/observer.h>

#include <stdlib.h>


enum {
    ALL = FVI_OBSERVE_VELOCITY | FVI_OBSERVE_ACCELERATION | FVI_OBSERVE_FORCE
          | FVI_OBSERVE_IMPULSE | FVI_OBSERVE_WORK | FVI_OBSERVE_ENERGY
          | FVI_OBSERVE_APPLIED
};

static const double mass = 1.25, rho = 0.375, x0 = 0.75, p0 = 0.625,
                    cg[] = { 1.5, 0.5 };

static int ramp(double t, size_t d, void *params, double *F)
{
    (void)params;
    for (size_t i = 0; i < d; i++)
        F[i] = 0.25 - 0.5 * t;
    return 0;
}

static fvi_system duffing(void)
{
    return (fvi_system){ .d = 1,
                         .mass = &mass,
                         .damping = &rho,
                         .potential = fvi_potential_duffing(cg),
                         .force = { .value = ramp } };
}

static const fvi_method *method_named(const char *name)
{
    size_t i = 0;
    while (strcmp(fvi_methods[i]->name, name) != 0)
        i++;
    return fvi_methods[i];
}

typedef struct {
    fvi_stepper *s;
    fvi_observer *o;
} observed;

static observed begin(const fvi_method *method, const fvi_run *run,
                      unsigned wanted)
{
    observed w;
    fvi_error error = { 0 };
    ck_assert_msg(fvi_stepper_start(method, run, &w.s, &error) == 0, "%s: %s",
                  method->name, error.text);
    ck_assert_msg(fvi_observer_start(w.s, wanted, &w.o, &error) == 0, "%s: %s",
                  method->name, error.text);
    return w;
}

static void end(observed w)
{
    fvi_observer_free(w.o);
    fvi_stepper_free(w.s);
}

static void go_to(observed w, size_t k)
{
    while (w.s->k < k)
        ck_assert_int_eq(fvi_observer_step(w.o, w.s), 0);
}

static fvi_observation read_at(observed w, double t)
{
    fvi_observation now;
    ck_assert_int_eq(fvi_observer_read(w.o, w.s, t, &now), 0);
    return now;
}

/* What is asked of an observation, in the order of the reference. */
enum { V, A, FORCE, IMPULSE, WORK, QUANTITIES };
static const char *const names[] = { "v", "a", "force", "impulse", "work" };

static void errors(const fvi_method *method, double alpha, double t, size_t N,
                   double *e)
{
    const fvi_system system = duffing();
    fvi_run run = fvi_run_default(&system, &x0, &p0, t / (double)N, N);
    size_t i = 0;
    while (ref_duffing[i].alpha != alpha || ref_duffing[i].t != t)
        i++;
    run.alpha = alpha;
    const observed w = begin(method, &run, ALL);
    go_to(w, N);
    const fvi_observation now = read_at(w, t);
    e[V] = fabs(now.v[0] - ref_duffing[i].v);
    e[A] = fabs(now.a[0] - ref_duffing[i].a);
    e[FORCE] = fabs(now.force[0] - ref_duffing[i].force);
    e[IMPULSE] = fabs(now.impulse[0] - ref_duffing[i].impulse);
    e[WORK] = fabs(now.work[0] - ref_duffing[i].work);
    end(w);
}

/* The order of p, by N and 4 N steps, within 0.4 for v, the impulse and the work. Force and a
 * have one digit more to lose: their differences are of a higher degree, up to 9, and not yet
 * negligible, so that their order may seem higher, up to that of the differences. */
START_TEST(each_column_has_the_order_of_the_method)
{
    static const struct {
        const char *method;
        double alpha, order, differences;
        size_t N;
    } cases[] = {
        { "fvi", 0.3, 1, 1, 40 },
        { "fvi", 0.7, 1, 1, 80 },
        { "lda", 0.5, 1, 1, 80 },
        { "euler-implicit", 0.5, 1, 1, 40 },
        { "euler-explicit", 0.5, 1, 1, 80 },
        { "fvi-bdf2", 0.3, 2, 3, 40 },
        { "fvi-bdf2", 0.7, 2, 3, 40 },
        { "fvi-stable", 0.3, 2, 3, 40 },
        { "fvi-stable", 0.7, 2, 3, 40 },
        { "fvi-shifted", 0.3, 2, 3, 40 },
        { "fvi-shifted", 0.7, 2, 3, 40 },
        { "fvi-lobatto2", 0.5, 2, 3, 40 },
        { "fvi-lobatto3", 0.3, 3.4, 5, 40 },
        { "fvi-lobatto3", 0.5, 4, 5, 20 },
        { "fvi-lobatto3", 0.7, 2.6, 5, 40 },
        { "fvi-lobatto3d", 0.3, 4, 5, 20 },
        { "fvi-lobatto4", 0.3, 4.4, 7, 20 },
        { "fvi-lobatto4", 0.5, 6, 7, 10 },
        { "fvi-lobatto4", 0.7, 3.6, 7, 40 },
    };
    for (size_t i = 0; i < LEN(cases); i++) {
        const fvi_method *method = method_named(cases[i].method);
        double coarse[QUANTITIES], fine[QUANTITIES];
        errors(method, cases[i].alpha, 1, cases[i].N, coarse);
        errors(method, cases[i].alpha, 1, 4 * cases[i].N, fine);
        for (int q = 0; q < QUANTITIES; q++) {
            const double order = log2(coarse[q] / fine[q]) / 2,
                         more = q == A || q == FORCE
                                    ? cases[i].differences - cases[i].order + 0.6
                                    : 0.4;
            ck_assert_msg(order >= cases[i].order - 0.4
                              && order <= cases[i].order + more,
                          "%s, alpha = %g, %s: %.3g, %.3g: order %.2f, not %g",
                          cases[i].method, cases[i].alpha, names[q], coarse[q],
                          fine[q], order, cases[i].order);
        }
    }
}
END_TEST

/* fvi-adaptive has them all at once; a by the polynomial of its last step. Seen: 3e-14. */
START_TEST(a_method_with_steps_of_its_own_knows_them_too)
{
    for (size_t i = 0; i < LEN(ref_duffing); i++) {
        double e[QUANTITIES];
        errors(&fvi_variable_step, ref_duffing[i].alpha, ref_duffing[i].t, 8, e);
        for (int q = 0; q < QUANTITIES; q++)
            ck_assert_near(e[q], 0, q == A || q == FORCE ? 1e-9 : 1e-10,
                           "alpha = %g, t = %g, %s", ref_duffing[i].alpha,
                           ref_duffing[i].t, names[q]);
    }
}
END_TEST

/* At t = 0+ a damper's force is 0 below the order 1, rho v0 at 1, and infinite above it: there
 * the first row has its mean over the first step. (1.5)^3 of the spring makes a. */
START_TEST(the_force_at_the_start_is_its_limit)
{
    const fvi_system system = duffing();
    const double v0 = p0 / mass, spring_force = cg[0] * x0 + cg[1] * x0 * x0 * x0;
    static const char *const methods[] = { "fvi", "fvi-bdf2", "fvi-lobatto4",
                                           "fvi-lobatto3d", "fvi-adaptive" };
    for (size_t i = 0; i < LEN(methods); i++)
        for (int n = 0; n <= 10; n++) {
            fvi_run run = fvi_run_default(&system, &x0, &p0, 0.1, 10);
            run.alpha = n / 10.0;
            observed w = begin(method_named(methods[i]), &run, ALL);
            const fvi_observation now = read_at(w, 0);
            const double force = now.force[0];
            ck_assert_int_eq(now.is_mean, n > 5 && n < 10);
            ck_assert_near(now.a[0], (0.25 - spring_force - force) / mass, 8 * U * 2,
                           "%s %d", methods[i], n);
            if (n < 5)
                ck_assert(force == 0);
            if (n == 5)
                ck_assert_near(force, rho * v0, 2 * U, "%s", methods[i]);
            if (n == 10)
                ck_assert_near(force, rho * (0.25 - spring_force) / (mass + rho),
                               8 * U, "%s", methods[i]);
            go_to(w, 1);
            while (w.s->t < 0.1)
                ck_assert_int_eq(fvi_observer_step(w.o, w.s), 0);
            if (now.is_mean)
                ck_assert_near(force, read_at(w, 0.1).impulse[0] / 0.1,
                               64 * U, "%s %d", methods[i], n);
            end(w);
        }
}
END_TEST

/* Laws: a dashpot counts at t = 0+, what relaxes does not. */
START_TEST(the_force_of_a_law_at_the_start_is_that_of_its_dashpots)
{
    const fvi_kernel_term terms[] = {
        { .kind = FVI_KERNEL_POWER, .rho = 0.5, .alpha = 0.5 },
        { .kind = FVI_KERNEL_ZENER, .rho = 2, .alpha = 0.3, .time = 0.5 }
    };
    const fvi_kernel law = { .term = terms, .count = 2 };
    const fvi_system system = duffing();
    fvi_run run = fvi_run_default(&system, &x0, &p0, 0.1, 10);
    run.law = &law;
    const observed w = begin(&fvi_cq_bdf2, &run, ALL);
    ck_assert_near(read_at(w, 0).force[0], 0.5 * rho * p0 / mass, 4 * U, "law");
    end(w);
}
END_TEST

/* fvi-stable on a quadratic potential: E + W is what it was, to rounding. The bound is 16 u for each of
 * 300 steps; seen 1e-15. */
START_TEST(the_balance_of_the_stable_method_is_exact)
{
    static const double m[] = { 1, 2 }, damping[] = { 0.3, 0 }, c = 2,
                        x[] = { 1, -0.5 }, p[] = { 0, 0.75 };
    const fvi_system system = { .d = 2,
                                .mass = m,
                                .damping = damping,
                                .potential = fvi_potential_harmonic(&c) };
    fvi_run run = fvi_run_default(&system, x, p, 0.3, 300);
    run.alpha = 0.35;
    const observed w = begin(&fvi_cq2_midpoint, &run, ALL);
    const double E0 = read_at(w, 0).energy;
    for (size_t k = 1; k <= 300; k++) {
        go_to(w, k);
        const fvi_observation now = read_at(w, w.s->t);
        ck_assert_near(now.balance, E0, 16 * U * (double)k * E0, "k = %zu", k);
        ck_assert(now.work[0] >= 0);
        ck_assert_near(now.impulse[1], 0, 64 * U * (double)k, "k = %zu", k);
    }
    ck_assert(read_at(w, w.s->t).work[0] > 0.5);
    end(w);
}
END_TEST

/* What hits the body gives J v, v the mean of before and after; the balance holds through it, and a
 * damper's impulse has no part of it. With the force of the ramp, order 2: the bounds are h^2. */
START_TEST(an_impulse_of_the_force_does_its_work)
{
    static const char *const methods[] = { "fvi-stable", "fvi-lobatto4",
                                           "fvi-adaptive" };
    const double J = 0.5;
    const fvi_impulse hits[] = { { 0, &J }, { 1, &J } };
    fvi_system system = duffing();
    system.force.impulses = hits;
    system.force.impulse_count = 2;
    double impulse[3];
    for (size_t i = 0; i < LEN(methods); i++) {
        fvi_run run = fvi_run_default(&system, &x0, &p0, 0.02, 100);
        run.alpha = 0.3;
        const observed w = begin(method_named(methods[i]), &run, ALL);
        const double E0 = read_at(w, 0).energy;
        ck_assert_near(E0 - cg[0] * x0 * x0 / 2 - cg[1] * x0 * x0 * x0 * x0 / 4,
                       (p0 + J) * (p0 + J) / (2 * mass), 8 * U, "the start");
        go_to(w, 100);
        const fvi_observation now = read_at(w, 2);
        ck_assert_near(now.balance, E0, 0.02 * 0.02, "%s", methods[i]);
        ck_assert(fabs(now.work_of_force) > 0.05);
        impulse[i] = now.impulse[0];
        end(w);
    }
    ck_assert_near(impulse[0], impulse[2], 0.02 * 0.02, "stable");
    ck_assert_near(impulse[1], impulse[2], 1e-4, "lobatto4");
}
END_TEST

/* A copy, and what was saved, go on with the same digits. */
START_TEST(an_observer_is_copied_and_saved_with_its_run)
{
    static const char *const methods[] = { "fvi", "fvi-bdf2", "fvi-lobatto4",
                                           "fvi-lobatto4d", "fvi-adaptive" };
    const fvi_system system = duffing();
    for (size_t i = 0; i < LEN(methods); i++) {
        fvi_run run = fvi_run_default(&system, &x0, &p0, 0.1, 40);
        run.alpha = 0.3;
        const fvi_method *method = method_named(methods[i]);
        observed first = begin(method, &run, ALL), copy,
                 loaded = begin(method, &run, ALL);
        go_to(first, 20);
        saved_state file = begin_saving();
        ck_assert_int_eq(fvi_stepper_archive(first.s, &file.archive), 0);
        ck_assert_int_eq(fvi_observer_archive(first.o, &file.archive), 0);
        begin_restoring(&file);
        ck_assert_int_eq(fvi_stepper_archive(loaded.s, &file.archive), 0);
        ck_assert_int_eq(fvi_observer_archive(loaded.o, &file.archive), 0);
        free(file.room);
        ck_assert_int_eq(fvi_stepper_copy(first.s, &copy.s), 0);
        ck_assert_int_eq(fvi_observer_copy(first.o, &copy.o), 0);
        const observed all[] = { first, copy, loaded };
        double last[3][QUANTITIES];
        for (int n = 0; n < 3; n++) {
            go_to(all[n], 40);
            const fvi_observation now = read_at(all[n], 4);
            const double values[] = { now.v[0], now.a[0], now.force[0],
                                      now.impulse[0], now.work[0] };
            memcpy(last[n], values, sizeof values);
            for (int q = 0; q < QUANTITIES; q++)
                ck_assert_ulp(last[n][q], last[0][q], 0, "%s, %d, %s",
                              methods[i], n, names[q]);
            end(all[n]);
        }
    }
}
END_TEST

START_TEST(what_cannot_be_observed_is_refused)
{
    const fvi_system system = duffing();
    const fvi_run run = fvi_run_default(&system, &x0, &p0, 0.1, 4);
    observed w = begin(&fvi_cq_bdf2, &run, ALL);
    fvi_observation now;
    fvi_observer *o;
    fvi_error error;
    ck_assert_int_eq(fvi_observer_start(NULL, ALL, &o, &error), FVI_EFAULT);
    ck_assert_int_eq(fvi_observer_step(NULL, w.s), FVI_EFAULT);
    ck_assert_int_eq(fvi_observer_read(w.o, w.s, 0, NULL), FVI_EFAULT);
    go_to(w, 1);
    ck_assert_int_eq(fvi_observer_start(w.s, ALL, &o, &error), FVI_EINVAL);
    ck_assert_str_eq(error.field, "observer");
    ck_assert_int_eq(fvi_observer_read(w.o, w.s, 0, &now), FVI_EDOM);
    ck_assert_uint_eq(fvi_observer_dampers(w.o), 1);
    ck_assert_uint_eq(fvi_observer_width(w.o, 0), 1);
    ck_assert_uint_eq(fvi_observer_width(w.o, 1), 0);
    end(w);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("an observer of a run");
    ADD_CASE(suite, "orders", each_column_has_the_order_of_the_method,
             a_method_with_steps_of_its_own_knows_them_too);
    ADD_CASE(suite, "start", the_force_at_the_start_is_its_limit,
             the_force_of_a_law_at_the_start_is_that_of_its_dashpots);
    ADD_CASE(suite, "balance", the_balance_of_the_stable_method_is_exact,
             an_impulse_of_the_force_does_its_work);
    ADD_CASE(suite, "life", an_observer_is_copied_and_saved_with_its_run,
             what_cannot_be_observed_is_refused);
    return run_suite(suite);
}
