/* tests/run/test_impulses.c -- Impulses of a force.
 * Run alone: make test-impulses */
#include <fvi/fvi.h>
#include "run/whole_run.h"
#include <fvi/methods.h>
#include <fvi/paper/algorithm_3.h>
#include "impulse_runs.h"
#include "system/larger.h"

#include <stdlib.h>

/* ---- steps of one length ---- */

/* Without forces x is right at every node, whatever the place within the step, to
 * rounding; p is J from the node after it on. */
START_TEST(eq_2_15_a_free_body_moves_right_after_the_step)
{
    static const double none = 0, rest = 0;
    for (size_t m = 0; fvi_methods[m]; m++)
        for (double at = 0; at <= 2; at += 0.0625) {
            hit.t = at;
            const fvi_system free_body = { .d = 1,
                                           .mass = &one,
                                           .damping = &none,
                                           .force = { .impulses = &hit,
                                                      .impulse_count = 1 } };
            const fvi_run run =
                fvi_run_default(&free_body, &rest, &rest, 0.25, 12);
            ck_assert_int_eq(fvi_trajectory(fvi_methods[m], &run, x, p, NULL),
                             FVI_SUCCESS);
            for (size_t k = 0; k <= 12; k++) {
                const double t = 0.25 * (double)k,
                             part = fvi_methods[m]->dense
                                        ? t >= at
                                        : 1 - larger(0, at - t) / 0.25;
                ck_assert_near(p[k], J * larger(0, part), 8 * U, "p %zu", k);
                ck_assert_near(x[k], J * larger(0, t - at), 64 * U,
                               "%s, T = %g, x %zu", fvi_methods[m]->name, at,
                               k);
            }
        }
}
END_TEST

/* The same numbers as those of a force J / h at this one node, since fvi takes F there. */
START_TEST(eq_2_15_at_a_node_it_is_a_force_of_one_node)
{
    for (double alpha = 0; alpha <= 1; alpha += 0.125) {
        const fvi_run run = hit_at(1.25, alpha, 40);
        fvi_stepper *s;
        ck_assert_int_eq(fvi_trajectory(&fvi_fractional, &run, x, p, NULL),
                         FVI_SUCCESS);
        spring.force = (fvi_force){ 0 };
        ck_assert_int_eq(fvi_stepper_start(&fvi_fractional, &run, &s,
                                           NULL), FVI_SUCCESS);
        for (size_t k = 1; k <= 40; k++) {
            ck_assert_int_eq(fvi_stepper_step(s), FVI_SUCCESS);
            if (k == 10)
                s->p[0] += run.h * (J / run.h);
            ck_assert_near(s->x[0], x[k], 64 * U, "x %zu", k);
            ck_assert_near(s->p[0], p[k], 64 * U, "p %zu", k);
        }
        fvi_stepper_free(s);
    }
}
END_TEST

/* At a node, of a step and of one half as long; the last is the order of x. */
START_TEST(eq_2_15_orders_at_a_node)
{
    static const struct {
        const fvi_method *method;
        double alpha, order, order_p;
    } all[] = {
        { &fvi_fractional, 0.3, 1, 1 },
        { &fvi_fractional, 0.8, 1, 0 },
        { &fvi_lagrange_dalembert, 0.5, 1, 1 },
        { &fvi_euler_explicit, 0.5, 1, 1 },
        { &fvi_euler_implicit, 0.5, 1, 1 },
        { &fvi_cq2_shifted, 0.3, 2, 2 },
        { &fvi_cq2_shifted, 0.5, 2, 2 },
        { &fvi_cq_bdf2, 0.1, 2, 2 },
        { &fvi_cq2_midpoint, 0.3, 2, 2 },
        { &fvi_lobatto_m2, 0.3, 2, 2 },
        { &fvi_lobatto_m3, 0.5, 4, 4 },
        { &fvi_lobatto_d3, 0.5, 4, 4 },
        { &fvi_lobatto_m4, 0.3, 2.4, 1.4 },
        { &fvi_lobatto_d4, 0.3, 2.4, 1.4 },
        { &fvi_lobatto_d4, 0.7, 1.6, 0.6 },
    };
    for (size_t i = 0; i < LEN(all); i++) {
        double coarse_p, fine_p;
        fvi_run run = hit_at(1.25, all[i].alpha, 160);
        const double coarse = error(all[i].method, &run, 1.25, &coarse_p);
        run = hit_at(1.25, all[i].alpha, 320);
        const double fine = error(all[i].method, &run, 1.25, &fine_p);
        const double order = log2(coarse / fine),
                     of_p = log2(coarse_p / fine_p);
        ck_assert_msg(fabs(order - all[i].order) < 0.08, "%s, alpha = %g: %g",
                      all[i].method->name, all[i].alpha, order);
        ck_assert_msg(all[i].order_p == 0 || fabs(of_p - all[i].order_p) < 0.12,
                      "%s, alpha = %g: %g of p", all[i].method->name,
                      all[i].alpha, of_p);
    }
}
END_TEST

/* Anywhere else: the error is at most C h^2 for all places within a step, since J is moved
 * by less than a step, and its moment not at all; a share left out is an error of order 1
 * or 0. */
START_TEST(eq_2_15_order_two_between_nodes)
{
    static const fvi_method *const all[] = { &fvi_cq2_shifted, &fvi_cq2_midpoint,
                                             &fvi_lobatto_m2, &fvi_lobatto_m4,
                                             &fvi_lobatto_d3 };
    for (size_t m = 0; m < LEN(all); m++) {
        double worst[2] = { 0 };
        for (size_t part = 0; part < 8; part++)
            for (size_t n = 0; n < 2; n++) {
                const size_t steps = n ? 320 : 80;
                const double at = 1.25 + 5.0 / (double)steps * (double)part / 8;
                const fvi_run run = hit_at(at, 0.3, steps);
                worst[n] = larger(worst[n], error(all[m], &run, at, NULL));
            }
        const double order = log2(worst[0] / worst[1]) / 2;
        ck_assert_msg(order > 1.9 && order < 2.1, "%s: %g", all[m]->name,
                      order);
    }
}
END_TEST

/* Three at a time, two of them between the same nodes, one at t = 0 and one at the end, on
 * two masses: as p0 + J, as the sum of two, as p_N + J. */
START_TEST(impulses_add_on_each_mass)
{
    enum { D = 2, N = 40 };
    static const double mass[D] = { 1, 2 }, damping[D] = { 0.3, 0.1 },
                        start[2 * D] = { 1, -0.5, 0.2, 0.4 },
                        chain[2] = { 1, 0.5 };
    static const double a[D] = { 0.5, -1 }, b[D] = { 0.25, 0.75 }, zero[D];
    const fvi_impulse many[] = { { 0, a }, { 1.03, a }, { 1.03, b }, { 4, b } };
    for (size_t m = 0; fvi_methods[m]; m++) {
        if (fvi_methods[m]->dense)
            continue;
        double all[2 * D * (N + 1)], sum[2 * D * (N + 1)], p0_a[D], ab[D];
        for (size_t i = 0; i < D; i++) {
            p0_a[i] = start[D + i] + a[i];
            ab[i] = a[i] + b[i];
        }
        fvi_system system = { .d = D,
                              .mass = mass,
                              .damping = damping,
                              .potential = fvi_potential_chain(chain),
                              .force = { .impulses = many,
                                         .impulse_count = 4 } };
        fvi_run run = fvi_run_default(&system, start, start + D, 0.1, N);
        ck_assert_int_eq(
            fvi_trajectory(fvi_methods[m], &run, all, all + D * (N + 1), NULL),
            FVI_SUCCESS);
        const fvi_impulse two[] = { { 0.5, zero }, { 1.03, ab } };
        system.force = (fvi_force){ .impulses = two, .impulse_count = 2 };
        run.p0 = p0_a;
        ck_assert_int_eq(
            fvi_trajectory(fvi_methods[m], &run, sum, sum + D * (N + 1), NULL),
            FVI_SUCCESS);
        for (size_t i = 0; i < D; i++)
            sum[D * (N + 1) + N * D + i] += b[i];
        for (size_t i = 0; i < 2 * D * (N + 1); i++)
            ck_assert_near(all[i], sum[i], 1e-13, "%s, number %zu",
                           fvi_methods[m]->name, i);
    }
}
END_TEST

/* ---- what goes on with them ---- */

static int last_x(size_t k, size_t d, const double *at, const double *momentum,
                  void *params, double *Jx, double *Jp)
{
    (void)d, (void)at, (void)momentum;
    Jx[0] += k == *(size_t *)params;
    if (Jp)
        Jp[0] += 0.5;
    return 0;
}

/* x_N + p_N / 2 by p0 and m, against a difference: its error is that of the third derivative,
 * 1e-8, and of the rounding, 1e-11 or so. */
START_TEST(gradients_know_impulses)
{
    size_t N = 40;
    const double duffing[] = { 2, 0.5 }, small = 1e-4;
    const fvi_objective end = { .slopes = last_x, .params = &N };
    for (size_t m = 0; fvi_methods[m]; m++) {
        if (fvi_methods[m]->scheme == FVI_SCHEME_CLASSICAL)
            continue;
        fvi_run run = hit_at(1.2837, 0.3, N);
        double mass = 1, start = p0, by_p0, by_mass, slopes[2];
        spring.mass = &mass;
        spring.potential = fvi_potential_duffing(duffing);
        run.p0 = &start;
        const fvi_sensitivities by = { .p0 = &by_p0, .mass = &by_mass };
        ck_assert_int_eq(
            fvi_adjoint(fvi_methods[m], &run, NULL, NULL, &end, &by),
            FVI_SUCCESS);
        for (int i = 0; i < 2; i++) {
            double *change = i ? &mass : &start, at = *change, J_[2];
            for (int side = 0; side < 2; side++) {
                *change = at + (side ? small : -small);
                ck_assert_int_eq(
                    fvi_trajectory(fvi_methods[m], &run, x, p, NULL),
                    FVI_SUCCESS);
                J_[side] = x[N] + p[N] / 2;
            }
            *change = at;
            slopes[i] = (J_[1] - J_[0]) / (2 * small);
        }
        ck_assert_near(by_p0, slopes[0], 1e-7, "%s", fvi_methods[m]->name);
        ck_assert_near(by_mass, slopes[1], 1e-7, "%s", fvi_methods[m]->name);
    }
}
END_TEST

/* A force that brings the body to rest takes into account that it will be hit. */
START_TEST(a_control_knows_impulses)
{
    fvi_run run = hit_at(1.2837, 0.3, 40);
    double u[41] = { 0 }, rest = 0;
    fvi_control_result found;
    ck_assert_int_eq(
        fvi_control_solve(&fvi_fractional, &run, &rest, &rest, u, &found),
        FVI_SUCCESS);
    ck_assert(fabs(found.miss) < 1e-12);
    fvi_stepper *s;
    ck_assert_int_eq(fvi_stepper_start(&fvi_fractional, &run, &s,
                                       NULL), FVI_SUCCESS);
    for (size_t k = 1; k <= 40; k++) {
        ck_assert_int_eq(fvi_stepper_step(s), FVI_SUCCESS);
        s->p[0] += run.h * u[k];
    }
    ck_assert_near(s->x[0], 0, 1e-12, "x at the end");
    ck_assert_near(s->p[0], 0, 1e-12, "p at the end");
    fvi_stepper_free(s);
}
END_TEST

/* ---- errors ---- */

START_TEST(impulses_that_cannot_be)
{
    fvi_run run = hit_at(1, 0.3, 40);
    fvi_stepper *s;
    const double infinite = INFINITY, none = 0;
    const fvi_impulse falling[] = { { 1, &J }, { 0.5, &J } },
                      early = { -0.5, &J }, never = { NAN, &J },
                      nothing = { 1, NULL }, endless = { 1, &infinite };
    const struct {
        fvi_force force;
        int status;
    } all[] = {
        { { .impulse_count = 1 }, FVI_EFAULT },
        { { .impulses = &nothing, .impulse_count = 1 }, FVI_EFAULT },
        { { .impulses = &early, .impulse_count = 1 }, FVI_EDOM },
        { { .impulses = &never, .impulse_count = 1 }, FVI_EDOM },
        { { .impulses = &endless, .impulse_count = 1 }, FVI_EDOM },
        { { .impulses = falling, .impulse_count = 2 }, FVI_EINVAL },
    };
    for (size_t i = 0; i < LEN(all); i++) {
        spring.force = all[i].force;
        ck_assert_int_eq(fvi_stepper_start(&fvi_fractional, &run, &s,
                                           NULL), all[i].status);
    }
    run = hit_at(1, 1, 40);
    ck_assert_int_eq(fvi_stepper_start(&fvi_lobatto_m3, &run, &s,
                                       NULL), FVI_EUNSUP);
    ck_assert_int_eq(fvi_stepper_start(&fvi_fractional, &run, &s,
                                       NULL), FVI_SUCCESS);
    fvi_stepper_free(s);
    ck_assert_int_eq(fvi_algorithm_3(&spring, 0.3, 0.5, 0.1, 40, x0, p0, x),
                     FVI_EUNSUP);
    spring.damping = &none;
    ck_assert_int_eq(fvi_stepper_start(&fvi_midpoint_variational, &run, &s,
                                       NULL), FVI_EINVAL);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("impulses");
    ADD_CASE(suite, "steps of one length",
             eq_2_15_a_free_body_moves_right_after_the_step,
             eq_2_15_at_a_node_it_is_a_force_of_one_node,
             eq_2_15_orders_at_a_node, eq_2_15_order_two_between_nodes,
             impulses_add_on_each_mass);
    ADD_CASE(suite, "derivatives", gradients_know_impulses,
             a_control_knows_impulses);
    ADD_CASE(suite, "errors", impulses_that_cannot_be);
    return run_suite(suite);
}
