/* tests/lagrangian/test_lagrangian_errors.c -- H 29: mechanisms that are refused, and the past of each damper.
 * Run alone: make test-lagrangian_errors */
#include "problems.h"
#include "run/whole_run.h"

#include <fvi/variable_steps.h>

#include <malloc.h>

static const double row[] = { 1 }, mass = 1, none = 0;
static const fvi_kernel_term power = { FVI_KERNEL_POWER, 0.4, 0.3, 0, 0 };
static const fvi_kernel kernel = { 1, &power }, no_terms = { 0, NULL };

static int at(double t, size_t d, const double *x, const double *v, void *params,
              double *L, double *Lx, double *Lv, double *Lxx, double *Lxv,
              double *Lvv)
{
    (void)t, (void)d, (void)x;
    for (int i = 0; i < 6; i++) { /* v^2 / 2 */
        double *const to[] = { L, Lx, Lv, Lxx, Lxv, Lvv };
        if (to[i])
            *to[i] = i == 0 ? *v * *v / 2 : i == 2 ? *v : i == 5;
    }
    return params ? *(int *)params : 0;
}

static int half(double t, size_t d, const double *x, void *params, double *g)
{
    (void)t, (void)d, (void)params;
    *g = *x / 2;
    return 0;
}

/* The run is refused with this code, and the error names the field. */
static void ck_assert_refused(const fvi_method *method, const fvi_mechanism *m,
                              const fvi_run *given, int code, const char *field)
{
    const fvi_system system = { .d = 1,
                                .mass = &mass,
                                .damping = &none,
                                .mechanism = m };
    const double x0 = 1, p0 = 0.5;
    fvi_run run = given ? *given : fvi_run_default(&system, &x0, &p0, 0.1, 10);
    run.system = &system;
    fvi_error error = { 0 };
    fvi_stepper *s = NULL;
    const int status = fvi_stepper_start(method, &run, &s, &error);
    ck_assert_msg(status == code, "%s: %d, not %d: %s", method->name, status,
                  code, error.text);
    ck_assert_str_eq(error.field, field);
    ck_assert(*error.text && !s);
}

START_TEST(a_mechanism_that_is_none_is_refused)
{
    fvi_damper damper = { .of = fvi_elongation_row(row), .kernel = &kernel };
    fvi_mechanism m = { .damper_count = 1, .damper = &damper };
    const fvi_method *const others[] = { &fvi_cq_bdf2, &fvi_cq2_shifted,
                                         &fvi_lagrange_dalembert };
    for (int i = 0; i < 3; i++)
        ck_assert_refused(others[i], &m, NULL, FVI_EUNSUP, "mechanism");
    damper.kernel = NULL;
    ck_assert_refused(&fvi_fractional, &m, NULL, FVI_EFAULT, "damper");
    damper.kernel = &no_terms;
    ck_assert_refused(&fvi_fractional, &m, NULL, FVI_EINVAL, "damper");
    damper.kernel = &kernel;
    damper.past = (fvi_initial_history)7;
    ck_assert_refused(&fvi_fractional, &m, NULL, FVI_EINVAL, "damper");
    damper.past = FVI_INITIAL_HISTORY_HELD;
    damper.of = (fvi_elongation){ .value = half };
    ck_assert_refused(&fvi_fractional, &m, NULL, FVI_EFAULT, "damper");
    damper.of = fvi_elongation_row(row);
    m.damper = NULL;
    ck_assert_refused(&fvi_fractional, &m, NULL, FVI_EFAULT, "mechanism");
    m.damper = &damper;
    const fvi_lagrangian nothing = { NULL, NULL };
    m.lagrangian = &nothing;
    ck_assert_refused(&fvi_fractional, &m, NULL, FVI_EFAULT, "mechanism");
    m.lagrangian = NULL;
    const double x0 = 1, p0 = 0.5;
    fvi_run run = fvi_run_default(NULL, &x0, &p0, 0.1, 10);
    run.law = &kernel;
    ck_assert_refused(&fvi_fractional, &m, &run, FVI_EINVAL, "law");
    const fvi_constraints c = { .count = 1, .value = half };
    m.constraints = &c;
    ck_assert_refused(&fvi_fractional, &m, NULL, FVI_EUNSUP, "constraint");
    ck_assert_refused(&fvi_lobatto_d3, &m, NULL, FVI_EFAULT, "constraint");
    ck_assert_refused(&fvi_variable_step, &m, NULL, FVI_EFAULT, "constraint");
    ck_assert_refused(&fvi_cq2_midpoint, &m, NULL, FVI_EFAULT, "constraint");
}
END_TEST

/* The start of this method is refused, and the error names the second of two dampers or coordinates. */
static void ck_assert_names_second(const fvi_method *method, const fvi_system *system, const char *field)
{
    const double x0[] = { 1, 2 }, p0[] = { 0, 0 };
    const fvi_run run = fvi_run_default(system, x0, p0, 0.1, 10);
    fvi_error error = { .index = 7 };
    fvi_stepper *s = NULL;
    const int status = fvi_stepper_start(method, &run, &s, &error);
    ck_assert_msg(status != FVI_SUCCESS && !s, "%s", method->name);
    ck_assert_str_eq(error.field, field);
    ck_assert_msg(error.index == 1, "%s: %zu, %s", method->name, error.index, error.text);
}

START_TEST(the_index_of_an_error_is_the_damper_or_the_coordinate)
{
    static const double first[] = { 1, 0 }, second[] = { 0, 1 }, masses[] = { 1, 1 }, one_mass[] = { 1, 0 },
                        nothing[] = { 0, 0 };
    static const fvi_kernel_term zener = { FVI_KERNEL_ZENER, 0.4, 0.3, 2, 0 };
    const fvi_kernel law = { 1, &zener };
    fvi_damper damper[] = { { .of = fvi_elongation_row(first), .kernel = &kernel },
                            { .of = fvi_elongation_row(second), .kernel = &law,
                              .past = FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE } };
    const fvi_mechanism m = { .damper_count = 2, .damper = damper };
    fvi_system system = { .d = 2, .mass = masses, .damping = nothing, .mechanism = &m };
    ck_assert_names_second(&fvi_cq2_midpoint, &system, "damper");
    ck_assert_names_second(&fvi_lobatto_d4, &system, "damper");
    ck_assert_names_second(&fvi_variable_step, &system, "damper");
    damper[1].past = FVI_INITIAL_HISTORY_HELD;
    system.mass = one_mass;
    ck_assert_names_second(&fvi_fractional, &system, "mass");
    ck_assert_names_second(&fvi_lobatto_m4, &system, "mass");
}
END_TEST

/* What a callback returns ends the call that asked; and what is not finite has its step. */
START_TEST(codes_of_callbacks_are_passed_on)
{
    int code = 77;
    const fvi_lagrangian L = { at, &code };
    const fvi_mechanism m = { .lagrangian = &L };
    const fvi_system system = { .d = 1, .mechanism = &m };
    const double x0 = 1, p0 = 0.5;
    const fvi_run run = fvi_run_default(&system, &x0, &p0, 0.1, 10);
    fvi_stepper *s;
    ck_assert_int_eq(fvi_stepper_start(&fvi_cq2_midpoint, &run, &s, NULL), 77);
    const fvi_method *const methods[] = { &fvi_fractional, &fvi_cq2_midpoint,
                                          &fvi_lobatto_m4, &fvi_lobatto_d4 };
    for (int i = 0; i < 4; i++) {
        code = 0;
        OK(fvi_stepper_start(methods[i], &run, &s, NULL));
        code = 78;
        ck_assert_int_eq(fvi_stepper_step(s), 78);
        fvi_stepper_free(s);
    }
    const mechanism_text text = { .name = "wall",
                                  .d = 1,
                                  .lagrangian = "v^2/2 - sqrt(x)",
                                  .x0 = { 0.01 },
                                  .v0 = { -5 } };
    mechanism_problem p;
    open_problem(&text, &p);
    const fvi_run into = run_of(&p, 0.1, 10);
    for (int i = 0; i < 4; i++) {
        OK(fvi_stepper_start(methods[i], &into, &s, NULL));
        const int status = fvi_stepper_step(s);
        ck_assert_msg(status == FVI_EMAXITER || status == FVI_EOVRFLW
                          || status == FVI_ESING,
                      "%s: %d", methods[i]->name, status);
        ck_assert_uint_eq(s->k, 0);
        fvi_stepper_free(s);
    }
    close_problem(&p);
}
END_TEST

START_TEST(outputs_are_those_of_a_mechanism)
{
    const double x0 = 1, p0 = 0.5, rho = 0.2;
    const fvi_system plain = { .d = 1, .mass = &mass, .damping = &rho };
    const fvi_run run = fvi_run_default(&plain, &x0, &p0, 0.1, 10);
    fvi_stepper *s;
    double number;
    OK(fvi_stepper_start(&fvi_fractional, &run, &s, NULL));
    ck_assert_int_eq(fvi_stepper_velocity(s, &number), FVI_EUNSUP);
    ck_assert_int_eq(fvi_stepper_damper(s, 0, &number, NULL), FVI_EUNSUP);
    ck_assert_int_eq(fvi_stepper_multipliers(s, &number, NULL), FVI_EUNSUP);
    ck_assert_int_eq(fvi_stepper_velocity(NULL, &number), FVI_EFAULT);
    ck_assert_int_eq(fvi_stepper_velocity(s, NULL), FVI_EFAULT);
    ck_assert_int_eq(fvi_stepper_damper(NULL, 0, NULL, NULL), FVI_EFAULT);
    ck_assert_int_eq(fvi_stepper_multipliers(NULL, NULL, NULL), FVI_EFAULT);
    OK(fvi_stepper_energy(s, &number));
    ck_assert_double_eq(number, 0.125);
    fvi_stepper_free(s);
    mechanism_problem p;
    open_problem(&problems[ELASTIC], &p);
    s = stepper_at(&fvi_cq2_midpoint, &p, 0.1, 2, 0);
    ck_assert_int_eq(fvi_stepper_damper(s, 1, NULL, NULL), FVI_EINVAL);
    OK(fvi_stepper_damper(s, 0, &number, NULL));
    ck_assert_double_eq(number, 0);
    fvi_stepper_free(s);
    ck_assert_int_eq(fvi_system_check(&p.system, NULL), FVI_EUNSUP);
    close_problem(&p);
}
END_TEST

/* The pasts of a damper on a coordinate are those of a run without a mechanism. */
START_TEST(pasts_are_those_of_the_old_damping)
{
    static const fvi_initial_history pasts[] = {
        FVI_INITIAL_HISTORY_HELD, FVI_INITIAL_HISTORY_CAPUTO,
        FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE
    };
    static const double alphas[] = { 0.2, 0.5, 0.8 };
    const fvi_method *const methods[] = { &fvi_fractional, &fvi_lobatto_m2,
                                          &fvi_lobatto_m4, &fvi_lobatto_d3 };
    const double cg[] = { 1, 0.5 }, x0 = 1, p0 = 0.5, rho = 0.4;
    for (int i = 0; i < 3 * 3 * 4; i++) {
        const double alpha = alphas[i % 3];
        const fvi_initial_history past = pasts[i / 3 % 3];
        const fvi_method *method = methods[i / 9];
        if (past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE && alpha > 0.5
            && i / 9 > 0)
            continue;
        const fvi_kernel_term term = { FVI_KERNEL_POWER, rho, alpha, 0, 0 };
        const fvi_kernel law = { 1, &term };
        const fvi_damper damper = { .of = fvi_elongation_row(row),
                                    .kernel = &law,
                                    .past = past };
        const fvi_mechanism m = { .damper_count = 1, .damper = &damper };
        const fvi_potential spring = fvi_potential_duffing(cg);
        const fvi_system plain = { .d = 1, .mass = &mass, .damping = &rho,
                                   .potential = spring },
                         other = { .d = 1, .mass = &mass, .damping = &none,
                                   .potential = spring, .mechanism = &m };
        fvi_run run = fvi_run_default(&plain, &x0, &p0, 0.1, 60);
        double x[61], p[61], X[61], P[61];
        run.alpha = alpha;
        run.past = past;
        OK(fvi_trajectory(method, &run, x, p, NULL));
        run.system = &other;
        run.alpha = 0.5;
        run.past = FVI_INITIAL_HISTORY_HELD;
        OK(fvi_trajectory(method, &run, X, P, NULL));
        for (int k = 0; k <= 60; k++)
            ck_assert_msg(fabs(x[k] - X[k]) + fabs(p[k] - P[k]) <= 2e-13,
                          "%s, alpha %g, past %d, row %d: %g", method->name,
                          alpha, past, k, fabs(x[k] - X[k]));
    }
}
END_TEST

static double heap(void)
{
#ifdef __GLIBC__
    const struct mallinfo2 info = mallinfo2();
    return (double)(info.uordblks + info.hblkhd);
#else
    return 0;
#endif
}

/* The memory that a run surely takes is not more than it takes, and half of it where there are many coordinates:
 * on a mesh, with its six or eight stages, too. Where malloc does not count (sanitizers), no one can tell. */
START_TEST(bytes_of_a_mechanism_are_those_that_it_takes)
{
    enum { MOST = 128 };
    static const fvi_method *const methods[] = { &fvi_variable_step, &fvi_cq2_midpoint, &fvi_lobatto_d4,
                                                 &fvi_lobatto_m3 };
    static double m[MOST], still[MOST], x0[MOST], between[MOST][MOST];
    const double c = 1;
    for (size_t i = 0; i < MOST; i++) {
        m[i] = 1;
        x0[i] = 0.125 * (double)(i % 3);
    }
    for (size_t i = 0; i < 4 * LEN(methods); i++) {
        const size_t d = i % 2 ? MOST : 4, count = i / 2 % 2 ? 16 : 1;
        const fvi_method *method = methods[i / 4];
        fvi_damper damper[16];
        for (size_t j = 0; j < count; j++) {
            memset(between[j], 0, sizeof between[j]);
            between[j][j % d] = 1;
            between[j][(j + 1) % d] = -1;
            damper[j] = (fvi_damper){ .of = fvi_elongation_row(between[j]), .kernel = &kernel };
        }
        const fvi_mechanism mechanism = { .damper = damper, .damper_count = count };
        const fvi_system system = { .d = d,
                                    .mass = m,
                                    .damping = still,
                                    .potential = fvi_potential_harmonic(&c),
                                    .mechanism = &mechanism };
        const fvi_run run = fvi_run_default(&system, x0, still, 0.1, 1000);
        fvi_stepper *s;
        const double before = heap(), said = fvi_run_bytes(method, &run);
        OK(fvi_stepper_start(method, &run, &s, NULL));
        const double taken = heap() - before;
        fvi_stepper_free(s);
        if (heap() > 0)
            ck_assert_msg(said <= taken && said >= taken * (d == MOST ? 0.5 : 0.05),
                          "%s, %zu coordinates, %zu dampers: said %g, taken %g", method->name, d, count, said, taken);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("lagrangian: errors");
    ADD_CASE(suite, "errors", a_mechanism_that_is_none_is_refused,
             the_index_of_an_error_is_the_damper_or_the_coordinate,
             codes_of_callbacks_are_passed_on, outputs_are_those_of_a_mechanism,
             pasts_are_those_of_the_old_damping, bytes_of_a_mechanism_are_those_that_it_takes);
    return run_suite(suite);
}
