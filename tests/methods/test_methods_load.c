/* tests/methods/test_methods_load.c -- The loads of the methods; their copies.
 * Run alone: make test-methods_load */
#include "methods_runs.h"
#include <fvi/adjoint.h>
#include "run/whole_run.h"
#include "error_control/step_search.h"
#include "system/larger.h"

#include <gsl/gsl_rng.h>

/* ---- loads ---- */

/* Does a run of 600 steps grow? What is stable and starts at 1, 1/4 stays below 100 as
 * long as the load is below 0.8; a mode above 1.25 grows by more than 1.05 a step. */
static int grows(const fvi_method *m, const fvi_run *run)
{
    double most = 0;
    fvi_stepper *s;
    ck_assert_int_eq(fvi_stepper_start(m, run, &s, NULL), FVI_SUCCESS);
    int status = FVI_SUCCESS;
    while (s->k < run->steps && !status && most < 1e6) {
        status = fvi_stepper_step(s);
        most = larger(most, fabs(s->x[0]));
    }
    fvi_stepper_free(s);
    ck_assert(status == FVI_SUCCESS || status == FVI_EOVRFLW);
    ck_assert_msg(status || most > 1e6 || most < 100, "%s alpha=%g: %g",
                  m->name, run->alpha, most);
    return status || most > 1e6;
}

/* 200 random linear runs of each method that has a load; those of a load near 1, where a
 * mode hardly grows, are left out. W is up to 100, with many stages up to 10^4. A method
 * whose load is always 0 never grows. */
START_TEST(eq_14_3_13_14_17_18_a_run_grows_if_its_load_is_above_1)
{
    gsl_rng *random = gsl_rng_alloc(gsl_rng_taus2);
    FOR_EACH(m)
    {
        size_t above = 0, below = 0;
        double most = 0;
        for (size_t i = 0; i < 200 && m->stability_number; i++) {
            double stiffness =
                       pow(10, (m->stages > 4 ? 5 : 3) * gsl_rng_uniform(random)
                                   - 1),
                   damping = pow(10, 3 * gsl_rng_uniform(random) - 1.5), load;
            const fvi_system system = {
                1,     &one, &damping, fvi_potential_harmonic(&stiffness),
                { 0 }, NULL, NULL
            };
            fvi_run run = fvi_run_default(&system, &start, &push, 1, 600);
            run.alpha =
                m->alpha_least
                + gsl_rng_uniform(random) * (m->alpha_most - m->alpha_least);
            if (m->takes_kappa)
                run.kappa = gsl_rng_uniform(random);
            ck_assert_int_eq(fvi_stability_number(m, &run, &load), FVI_SUCCESS);
            most = larger(most, load);
            if (load > 0.8 && load < 1.25)
                continue;
            ck_assert_msg(grows(m, &run) == (load > 1),
                          "%s alpha=%g kappa=%g c=%g rho=%g: load %g", m->name,
                          run.alpha, run.kappa, stiffness, damping, load);
            *(load > 1 ? &above : &below) += 1;
        }
        ck_assert_msg(!m->stability_number || most == 0 || (above >= 5 && below >= 5),
                      "%s: %zu, %zu", m->name, above, below);
    }
    gsl_rng_free(random);
}
END_TEST

/* h of load 1: shorter steps have a load of at most 1, longer ones more; or it is said
 * that there is no such h. */
START_TEST(eq_14_4_the_longest_step_parts_the_loads)
{
    const fvi_system system = spring();
    c = 30; /* at kappa = 1/4, so that each load has two terms */
    FOR_EACH(m)
    {
        fvi_run run = run_of(&system, middle(m));
        double h = 7, load, last = 0;
        run.kappa = 0.25;
        if (!m->stability_number)
            ck_assert_int_eq(fvi_stability_number(m, &run, &h), FVI_EUNSUP);
        int falls = 0;
        for (int n = 0; n < 400 && m->stability_number; n++, last = load) {
            run.h = exp2(n / 50. - 4);
            ck_assert_int_eq(fvi_stability_number(m, &run, &load), FVI_SUCCESS);
            falls |= load < last;
        }
        ck_assert_msg(!m->stability_number || falls == !m->stability_number_grows, "%s", m->name);
        const int is_safe = last == 0;
        last = 0;
        if (!m->stability_number_grows) {
            ck_assert_int_eq(fvi_stability_longest_step(m, &run, &h), FVI_EUNSUP);
            ck_assert(h == 7);
            continue;
        }
        ck_assert_int_eq(fvi_stability_longest_step(m, &run, &h), FVI_SUCCESS);
        ck_assert(!isinf(h) == !is_safe); /* then no step is too long */
        if (is_safe)
            continue;
        for (int n = -100; n <= 100; n++) {
            run.h = n == 0 ? h : h * (1 + 1e-11 * n) * exp2(n / 10);
            ck_assert_int_eq(fvi_stability_number(m, &run, &load), FVI_SUCCESS);
            ck_assert_msg((load > 1) == (n > 0) && load >= last,
                          "%s: load %.17g at %.17g h", m->name, load,
                          run.h / h);
            last = load;
        }
    }
}
END_TEST

/* A Hessian that is not finite at any h is an error, no step of length 0. */
START_TEST(a_load_that_overflows_at_every_step_is_reported)
{
    const fvi_system system = spring();
    fvi_run run = run_of(&system, 0.3);
    double h = 7;
    c = GSL_POSINF;
    run.kappa = 0;
    ck_assert_int_eq(fvi_stability_longest_step(&fvi_fractional, &run, &h),
                     FVI_EOVRFLW);
    ck_assert(h == 7);
    c = 1;
}
END_TEST

/* ---- copies ---- */

/* Nothing tells a method from a copy under another name and at another address. */
START_TEST(a_copied_method_is_as_good)
{
    const fvi_system system = pendulum();
    FOR_EACH(m)
    {
        fvi_method copy = *m;
        copy.name = "copy";
        fvi_run run = run_of(&system, middle(m));
        double x[2][STEPS + 1], p[2][STEPS + 1], v[2] = { 0, 0 };
        fvi_step_found found[2] = { { 0 } };
        run.past = FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE;
        for (size_t j = 0; j < 2; j++) {
            const fvi_method *which = j ? &copy : m;
            ck_assert_int_eq(fvi_trajectory(which, &run, x[j], p[j], NULL),
                             FVI_SUCCESS);
            ck_assert_int_eq(fvi_lobatto_correct_momenta(which, &run, x[j], p[j]),
                             m->stages >= 2 && m->stages <= 4
                                     && !m->damped_inertia
                                 ? FVI_SUCCESS
                                 : FVI_EINVAL);
        }
        ck_assert(memcmp(x[0], x[1], sizeof x[0]) == 0
                  && memcmp(p[0], p[1], sizeof p[0]) == 0);
        ck_assert_int_eq(fvi_stability_number(m, &run, v),
                         fvi_stability_number(&copy, &run, v + 1));
        ck_assert(v[0] == v[1]);
        ck_assert_int_eq(fvi_stability_longest_step(m, &run, v),
                         fvi_stability_longest_step(&copy, &run, v + 1));
        ck_assert(v[0] == v[1]);
        ck_assert_ptr_eq(fvi_step_search_other(m, &run),
                         fvi_step_search_other(&copy, &run));
        ck_assert_int_eq(
            fvi_step_search(m, &run, 1e-2, 4096, x[0], p[0], found),
            fvi_step_search(&copy, &run, 1e-2, 4096, x[1], p[1], found + 1));
        ck_assert(memcmp(found, found + 1, sizeof *found) == 0);
    }
}
END_TEST

static int last_x(size_t k, size_t d, const double *x, const double *p, void *params, double *Jx, double *Jp)
{
    (void)d, (void)x, (void)p, (void)params, (void)Jp;
    Jx[0] = k == STEPS;
    return 0;
}

static int step_of_its_own(fvi_stepper *s)
{
    s->x[0] += s->run.h * s->p[0];
    return FVI_SUCCESS;
}

/* A copy has the derivatives of its method. A method that says the same of its equations, and steps in another way,
 * has none. */
START_TEST(a_copied_method_has_derivatives_and_a_step_of_its_own_has_none)
{
    const fvi_system system = pendulum();
    double x0[2];
    const fvi_objective J = { .slopes = last_x };
    FOR_EACH(m)
    {
        const int has_adjoint = m->scheme != FVI_SCHEME_CLASSICAL;
        fvi_run run = run_of(&system, middle(m));
        fvi_method copy = *m;
        copy.name = "copy";
        for (size_t j = 0; j < 2; j++) {
            const fvi_sensitivities want = { .x0 = x0 + j };
            ck_assert_int_eq(fvi_adjoint(j ? &copy : m, &run, NULL, NULL, &J, &want),
                             has_adjoint ? FVI_SUCCESS : FVI_EUNSUP);
        }
        ck_assert(!has_adjoint || (x0[0] == x0[1] && x0[0] != 0));
        copy.step = step_of_its_own;
        const fvi_sensitivities want = { .x0 = x0 };
        ck_assert_int_eq(fvi_adjoint(&copy, &run, NULL, NULL, &J, &want), FVI_EUNSUP);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("methods: loads and copies");
    ADD_CASE(suite, "loads",
             eq_14_3_13_14_17_18_a_run_grows_if_its_load_is_above_1,
             eq_14_4_the_longest_step_parts_the_loads,
             a_load_that_overflows_at_every_step_is_reported);
    ADD_CASE(suite, "copies", a_copied_method_is_as_good,
             a_copied_method_has_derivatives_and_a_step_of_its_own_has_none);
    return run_suite(suite);
}
