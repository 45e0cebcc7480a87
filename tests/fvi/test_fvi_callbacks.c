/* tests/fvi/test_fvi_callbacks.c -- Potentials and forces whose callbacks return an error.
 * Run alone: make test-fvi_callbacks */
#include <fvi/fvi.h>
#include "run/whole_run.h"
#include "error_control/step_search.h"
#include <fvi/paper/algorithm_3.h>
#include <fvi/paper/discrete_principle.h>
#include <fvi/paper/experiments.h>
#include <fvi/paper/legendre.h>
#include <fvi/paper/restricted_principle.h>
#include "harness/ulp.h"

#include <string.h>

enum { N = 3, D = 2 };

/* ---- Duffing springs and a cosine, which fail when they are told to ---- */

enum { VALUE, GRADIENT, HESSIAN, FORCE, KINDS };

typedef struct {
    double cg[2], aw[2];
    int kind, code;      /* who fails, and with what */
    size_t call;         /* the calls of that kind that go well before */
    size_t calls, after; /* of that kind, so far; of any, after the failure */
} patient;

static int fails(patient *a, int kind)
{
    a->after += a->calls > a->call;
    return a->kind == kind && a->calls++ == a->call ? a->code : 0;
}

static int value(size_t d, const double *x, void *params, double *U_)
{
    patient *a = params;
    int status = fails(a, VALUE);
    return status ? status
                  : fvi_potential_duffing(a->cg).value(d, x, a->cg, U_);
}

static int gradient(size_t d, const double *x, void *params, double *g)
{
    patient *a = params;
    int status = fails(a, GRADIENT);
    return status ? status
                  : fvi_potential_duffing(a->cg).gradient(d, x, a->cg, g);
}

static int hessian(size_t d, const double *x, void *params, double *H)
{
    patient *a = params;
    int status = fails(a, HESSIAN);
    return status ? status
                  : fvi_potential_duffing(a->cg).hessian(d, x, a->cg, H);
}

static int force(double t, size_t d, void *params, double *F)
{
    patient *a = params;
    int status = fails(a, FORCE);
    return status ? status : fvi_force_cosine(a->aw).value(t, d, a->aw, F);
}

static int is_linear(const void *params)
{
    return ((const patient *)params)->cg[1] == 0;
}

static const double ones[] = { 1, 1 }, none[] = { 0, 0 }, x0[] = { 1, -0.5 },
                    rho[] = { 0.5, 0 };

static fvi_system system_of(patient *a, size_t d)
{
    return (fvi_system){ d,
                         ones,
                         rho,
                         { value, gradient, hessian, a, is_linear, 1, NULL, NULL },
                         { .value = force, .params = a },
                         NULL, NULL };
}

static size_t told; /* calls of the error handler */

static void tell(const char *reason, const char *file, int line, int code)
{
    (void)reason, (void)file, (void)line, (void)code;
    told++;
}

/* Codes that nobody else has, and those at which Newton's method would try again. */
static const int codes[] = { -7, 12345, FVI_ESING, FVI_EMAXITER, FVI_EOVRFLW };

/* ---- runs ---- */

static const fvi_method *const methods[] = {
    &fvi_fractional,     &fvi_cq2_shifted,        &fvi_cq_bdf2,
    &fvi_lobatto_m2,       &fvi_lobatto_m3,       &fvi_lobatto_m4,
    &fvi_euler_explicit, &fvi_euler_implicit, &fvi_lagrange_dalembert,
    &fvi_midpoint_variational
};

/* The n-th call of one of the functions fails, for n = 0, 1, ... until a run does not
 * get so far: its code comes back, the rows before stand as in a run where nothing
 * failed, those from there on are untouched, and nothing is asked any more. */
static size_t fail_everywhere(const fvi_method *method, double g, int kind,
                              int code)
{
    enum { ROWS = (N + 1) * D };
    patient a = { { 1, g }, { 1, 2 }, kind, code, SIZE_MAX, 0, 0 };
    fvi_system system = system_of(&a, D);
    if (method == &fvi_midpoint_variational) {
        system.damping = none;
        system.force = (fvi_force){ 0 };
    }
    fvi_run run = fvi_run_default(&system, x0, ones, 0.125, N);
    run.kappa = 0.25;
    double want[2 * ROWS + N + 1], got[2 * ROWS + N + 1], left = 7;
    ck_assert_int_eq(
        fvi_trajectory(method, &run, want, want + ROWS, want + 2 * ROWS), 0);
    const size_t all = a.calls;
    for (a.call = 0; a.call < all; a.call++) {
        a.calls = a.after = told = 0;
        for (size_t i = 0; i < LEN(got); i++)
            got[i] = left;
        int status =
            fvi_trajectory(method, &run, got, got + ROWS, got + 2 * ROWS);
        ck_assert_msg(status == code, "%s, function %d, call %zu of %zu: %d",
                      method->name, kind, a.call, all, status);
        ck_assert_uint_eq(a.after, 0);
        ck_assert_uint_eq(told, 0);
        size_t rows = 0; /* that stand */
        while (rows <= N && got[2 * ROWS + rows] != left)
            rows++;
        ck_assert_uint_le(rows, N);
        for (size_t i = 0; i < ROWS; i++) {
            const size_t stand = rows + (kind == VALUE); /* x, p, then E */
            ck_assert(got[i] == (i < stand * D ? want[i] : left));
            ck_assert(got[ROWS + i] == (i < stand * D ? want[ROWS + i] : left));
        }
        for (size_t k = 0; k < rows; k++)
            ck_assert(got[2 * ROWS + k] == want[2 * ROWS + k]);
    }
    return all;
}

START_TEST(a_callback_that_fails_ends_the_run_with_its_code)
{
    fvi_error_handler *before = fvi_set_error_handler(tell);
    for (size_t m = 0; m < LEN(methods); m++)
        for (int kind = VALUE; kind < KINDS; kind++)
            for (size_t c = 0; c < LEN(codes); c++)
                for (int g = 0; g <= 1; g++) {
                    const size_t calls =
                        fail_everywhere(methods[m], g, kind, codes[c]);
                    if (kind == VALUE)
                        ck_assert_uint_eq(calls, N + 1);
                    if (kind == GRADIENT
                        || (kind == FORCE && methods[m] != &fvi_midpoint_variational))
                        ck_assert_uint_ge(calls, N);
                    if (kind == HESSIAN && g == 1
                        && methods[m] != &fvi_euler_explicit
                        && methods[m] != &fvi_lobatto_m2)
                        ck_assert_uint_ge(calls, N);
                }
    fvi_set_error_handler(before);
}
END_TEST

/* grad U = sign(x), with a flat Hessian: Newton's method jumps to and fro. */
static int sign(size_t d, const double *x, void *params, double *g)
{
    (void)d;
    g[0] = x[0] >= 0 ? 1 : -1;
    return fails(params, GRADIENT);
}

static int flat(size_t d, const double *x, void *params, double *H)
{
    (void)d, (void)x, (void)params;
    H[0] = 0;
    return 0;
}

/* Fifty steps of Newton's method, then the descent: the 200th gradient is its. */
START_TEST(a_callback_that_fails_where_newton_loses_its_way)
{
    const double at = -0.5;
    patient a = { { 0, 0 }, { 0, 0 }, GRADIENT, -7, SIZE_MAX, 0, 0 };
    const fvi_system system = { 1,     ones,
                                ones,  { value, sign, flat, &a, NULL, 0, NULL, NULL },
                                { 0 }, NULL, NULL };
    fvi_run run = fvi_run_default(&system, &at, ones, 1, N);
    run.alpha = 0.3;
    ck_assert_int_eq(fvi_trajectory(&fvi_fractional, &run, NULL, NULL, NULL),
                     FVI_EMAXITER);
    ck_assert_uint_gt(a.calls, 200);
    a.calls = 0;
    a.call = 199;
    ck_assert_int_eq(fvi_trajectory(&fvi_fractional, &run, NULL, NULL, NULL),
                     -7);
    ck_assert_uint_eq(a.calls, 200);
}
END_TEST

/* ---- everything else that asks ---- */

static int load(const fvi_system *s)
{
    fvi_run run = fvi_run_default(s, x0, ones, 0.125, N);
    double out;
    run.kappa = 0.25;
    return fvi_stability_number(&fvi_fractional, &run, &out);
}

static int longest(const fvi_system *s)
{
    fvi_run run = fvi_run_default(s, x0, ones, 0.125, N);
    double out;
    run.kappa = 0.25;
    return fvi_stability_longest_step(&fvi_fractional, &run, &out);
}

static int load_of_stages(const fvi_system *s)
{
    const fvi_run run = fvi_run_default(s, x0, ones, 0.125, N);
    double out;
    return fvi_stability_lobatto(3, &run, &out);
}

static int lagrangian(const fvi_system *s)
{
    double out;
    return fvi_discrete_lagrangian(s, 0.5, 0.125, x0, ones, &out);
}

static int slopes(const fvi_system *s)
{
    double D1[D], D2[D];
    return fvi_discrete_slopes(s, 0.5, 0.125, x0, ones, D1, D2);
}

static int matched(const fvi_system *s)
{
    double p[D];
    return fvi_legendre_minus(s, 0.5, 0.125, x0, ones, p);
}

static int inverse(const fvi_system *s)
{
    double y[D];
    return fvi_legendre_inverse(s, 0.5, 0.125, x0, ones, y);
}

static int stationary(const fvi_system *s)
{
    static const double x[(N + 1) * D] = { 1 }, y[(N + 1) * D] = { 0, 1 };
    double dx[(N + 1) * D], dy[(N + 1) * D];
    return fvi_discrete_action_gradient(s, 0.3, 0.5, 0.125, N, 0, N, x, y, dx,
                                        dy);
}

static int discrete_action(const fvi_system *s)
{
    static const double x[(N + 1) * D] = { 1 }, y[(N + 1) * D] = { 0, 1 };
    double S;
    return fvi_discrete_action(s, 0.3, 0.5, 0.125, N, 0, N, x, y, &S);
}

static const double exponent = 1, coefficient = 0.5;
static const fvi_powers line = { 1, &exponent, &coefficient };

static int action(const fvi_system *s)
{
    double out;
    return fvi_action(s, 0.3, 1, &line, &line, &out);
}

static int variation(const fvi_system *s)
{
    double out;
    return fvi_action_variation(s, 0.3, 1, &line, &line, &line, &line, &out);
}

static int printed(const fvi_system *s)
{
    double x[N + 1];
    return fvi_algorithm_3(s, 0.3, 0.5, 0.125, N, 1, 1, x);
}

static int matrix(const fvi_system *s)
{
    double x[N + 1];
    return fvi_matrix_method(1, 1, 1, 0.3, s->force, 0.125, N, x);
}

static int full_matrix(const fvi_system *s)
{
    double x[N + 1];
    return fvi_matrix_method_simple(1, 1, 1, 0.3, s->force, 0.125, N, x);
}

/* Of a search only codes that are none of the library's: see step_search.h. */
static int search(const fvi_system *s)
{
    const fvi_run run = fvi_run_default(s, x0, ones, 0.125, N);
    double x[(N + 1) * D];
    fvi_step_found found;
    return fvi_step_search(&fvi_cq2_shifted, &run, 1e-2, 4096, x, NULL, &found);
}

START_TEST(what_a_callback_returns_comes_back_from_every_function)
{
    const struct {
        int (*ask)(const fvi_system *system);
        size_t d;
        int kind, codes;
    } all[] = {
        { load, D, HESSIAN, 5 },           { longest, D, HESSIAN, 5 },
        { load_of_stages, D, HESSIAN, 5 }, { lagrangian, D, VALUE, 5 },
        { slopes, D, GRADIENT, 5 },        { matched, D, GRADIENT, 5 },
        { inverse, D, GRADIENT, 5 },       { inverse, D, HESSIAN, 5 },
        { stationary, D, GRADIENT, 5 },    { discrete_action, D, VALUE, 5 },
        { action, 1, VALUE, 5 },           { variation, 1, GRADIENT, 5 },
        { printed, 1, GRADIENT, 5 },       { printed, 1, FORCE, 5 },
        { matrix, 1, FORCE, 5 },           { full_matrix, 1, FORCE, 5 },
        { search, D, GRADIENT, 2 },        { search, D, HESSIAN, 2 },
        { search, D, FORCE, 2 },
    };
    for (size_t i = 0; i < LEN(all); i++)
        for (int c = 0; c < all[i].codes; c++) {
            patient a = { { 1, 1 }, { 1, 2 }, all[i].kind, codes[c], SIZE_MAX,
                          0,        0 };
            const fvi_system system = system_of(&a, all[i].d);
            ck_assert_int_eq(all[i].ask(&system), 0);
            const size_t calls = a.calls;
            ck_assert_uint_ge(calls, 1);
            for (a.call = 0; a.call < calls; a.call += 1 + calls / 64) {
                a.calls = a.after = 0;
                const int status = all[i].ask(&system);
                ck_assert_msg(status == codes[c], "row %zu, call %zu: %d", i,
                              a.call, status);
                ck_assert_uint_eq(a.after, 0);
            }
        }
}
END_TEST

/* The params are the caller's to write: here they count. */
START_TEST(a_code_of_too_long_a_step_lets_a_search_go_on)
{
    patient a = { { 1, 1 }, { 1, 2 }, GRADIENT, FVI_EOVRFLW, 20, 0, 0 };
    const fvi_system system = system_of(&a, D);
    ck_assert_int_eq(search(&system), 0);
    ck_assert_uint_gt(a.calls, 21);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("09 callbacks");
    ADD_CASE(suite, "callbacks",
             a_callback_that_fails_ends_the_run_with_its_code,
             a_callback_that_fails_where_newton_loses_its_way,
             what_a_callback_returns_comes_back_from_every_function,
             a_code_of_too_long_a_step_lets_a_search_go_on);
    return run_suite(suite);
}
