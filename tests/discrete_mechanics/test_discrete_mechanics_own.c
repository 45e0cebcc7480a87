/* tests/discrete_mechanics/test_discrete_mechanics_own.c -- H 2: a potential that solves the equation of a step
 * itself.
 * Run alone: make test-discrete_mechanics_own
 *
 * The potential is that of a membrane: SIDE x SIDE masses in a frame, each connected to its four neighbours. Its
 * Hessian is never written down. */
#include <fvi/convolution_quadrature_methods.h>
#include "run/whole_run.h"
#include <fvi/discrete_mechanics.h>
#include <fvi/stability.h>
#include "newton_solver.h"

#include <string.h>

enum { MOST = 40, STEPS = 40, OUT_OF_REACH = -7, TIRED = -9 };

/* Springs c r^2/2 + g r^4/4 between neighbours; how often each function was asked. */
typedef struct {
    size_t side;
    double c, g, rest; /* of r, what conjugate gradients leave */
    int answer;        /* of solve, if not 0 */
    size_t hessians, solutions;
} membrane;

static double at(const membrane *o, const double *x, size_t i, size_t j)
{
    const size_t n = o->side; /* i and j from 1 on, the frame at 0 and n + 1 */
    return i == 0 || j == 0 || i > n || j > n ? 0 : x[(i - 1) * n + j - 1];
}

/* The four springs at (i, j): the sum of f(r) w, w = r of v or 1. */
static double around(const membrane *o, const double *x, const double *v,
                     size_t i, size_t j, double (*f)(const membrane *, double))
{
    const size_t to[4][2] = {
        { i - 1, j }, { i + 1, j }, { i, j - 1 }, { i, j + 1 }
    };
    double sum = 0;
    for (size_t s = 0; s < 4; s++) {
        const double r = at(o, x, i, j) - at(o, x, to[s][0], to[s][1]);
        sum += f(o, r)
               * (v ? at(o, v, i, j) - at(o, v, to[s][0], to[s][1]) : 1);
    }
    return sum;
}

static double energy_of(const membrane *o, double r)
{
    return o->c * r * r / 2 + o->g * r * r * r * r / 4;
}

static double spring_force(const membrane *o, double r)
{
    return (o->c + o->g * r * r) * r;
}

static double stiffness(const membrane *o, double r)
{
    return o->c + 3 * o->g * r * r;
}

static int value(size_t d, const double *x, void *params, double *potential)
{
    const membrane *o = params;
    (void)d;
    *potential = 0;
    for (size_t i = 1; i <= o->side; i++)
        for (size_t j = 1; j <= o->side; j++)
            *potential += around(o, x, NULL, i, j, energy_of) / 2;
    return 0; /* but for half of the frame's: no test asks */
}

static int gradient(size_t d, const double *x, void *params, double *grad)
{
    const membrane *o = params;
    (void)d;
    for (size_t i = 1; i <= o->side; i++)
        for (size_t j = 1; j <= o->side; j++)
            *grad++ = around(o, x, NULL, i, j, spring_force);
    return 0;
}

static int hessian(size_t d, const double *x, void *params, double *H)
{
    membrane *o = params;
    double e[MOST * MOST] = { 0 };
    o->hessians++;
    if (d > 25)
        return OUT_OF_REACH;
    for (size_t c = 0; c < d; c++) {
        e[c] = 1;
        for (size_t i = 1, row = 0; i <= o->side; i++)
            for (size_t j = 1; j <= o->side; j++, row++)
                H[row * d + c] = around(o, x, e, i, j, stiffness);
        e[c] = 0;
    }
    return 0;
}

static double dot(size_t d, const double *x, const double *y)
{
    double sum = 0;
    for (size_t i = 0; i < d; i++)
        sum += x[i] * y[i];
    return sum;
}

/* Conjugate gradients; the matrix is positive definite. */
static int by_gradients(size_t d, const double *x, const double *a, double c,
                        void *params, double *r)
{
    membrane *o = params;
    double y[MOST * MOST] = { 0 }, p[MOST * MOST], Ap[MOST * MOST];
    double left = dot(d, r, r);
    const double enough = o->rest * o->rest * left;
    o->solutions++;
    if (o->answer)
        return o->answer;
    memcpy(p, r, d * sizeof *p);
    while (left > enough) {
        for (size_t i = 1, row = 0; i <= o->side; i++)
            for (size_t j = 1; j <= o->side; j++, row++)
                Ap[row] = a[row] * p[row] + c * around(o, x, p, i, j, stiffness);
        const double length = left / dot(d, p, Ap), before = left;
        for (size_t i = 0; i < d; i++) {
            y[i] += length * p[i];
            r[i] -= length * Ap[i];
        }
        left = dot(d, r, r);
        for (size_t i = 0; i < d; i++)
            p[i] = r[i] + left / before * p[i];
    }
    memcpy(r, y, d * sizeof *r);
    return 0;
}

static int is_linear(const void *params)
{
    return ((const membrane *)params)->g == 0;
}

static double mass[MOST * MOST], damping[MOST * MOST], x0[MOST * MOST],
    p0[MOST * MOST];

static fvi_system system_of(membrane *o, int own)
{
    for (size_t i = 0; i < o->side * o->side; i++) {
        mass[i] = 1 + 0.1 * (double)(i % 3);
        damping[i] = 0.2 + 0.1 * (double)(i % 4);
        x0[i] = cos(2. * (double)i);
        p0[i] = sin(3. * (double)i);
    }
    return (fvi_system){ .d = o->side * o->side,
                         .mass = mass,
                         .damping = damping,
                         .potential = { .value = value,
                                        .gradient = gradient,
                                        .hessian = hessian,
                                        .params = o,
                                        .quadratic = is_linear,
                                        .solve = own ? by_gradients : NULL } };
}

/* With the Hessian and without, every method that solves one equation a step, also when the
 * conjugate gradients of a nonlinear U stop at eight digits. The matrices have condition
 * numbers below 3 at this h, and 40 steps of a few rounding errors of numbers below 4
 * each, of which 25 come together, grow by less than 40^2/2: 2000 * 4 * 25 u. Seen: 1e-4
 * of it. */
START_TEST(eq_2_10_a_potential_solves_for_itself)
{
    static const fvi_method *const methods[] = {
        &fvi_fractional, &fvi_cq2_shifted, &fvi_cq_bdf2, &fvi_lagrange_dalembert,
        &fvi_euler_implicit
    };
    static double x[25 * (STEPS + 1)], want[25 * (STEPS + 1)];
    for (size_t m = 0; m < LEN(methods); m++)
        for (int kind = 0; kind < 3; kind++) {
            membrane o = { .side = 5,
                           .c = 1,
                           .g = kind ? 0.5 : 0,
                           .rest = kind == 2 ? 1e-8 : 1e-15 };
            fvi_system system = system_of(&o, 0);
            fvi_run run = fvi_run_default(&system, x0, p0, 0.125, STEPS);
            ck_assert_int_eq(fvi_trajectory(methods[m], &run, want, NULL, NULL),
                             0);
            ck_assert_uint_gt(o.hessians, 0);
            ck_assert_uint_eq(o.solutions, 0);
            o.hessians = 0;
            system = system_of(&o, 1);
            ck_assert_int_eq(fvi_trajectory(methods[m], &run, x, NULL, NULL),
                             0);
            ck_assert_uint_eq(o.hessians, 0);
            ck_assert_uint_ge(o.solutions, STEPS);
            for (size_t i = 0; i < LEN(x); i++)
                ck_assert_near(x[i], want[i], 2000 * 4 * 25 * U, "%s %d, %zu",
                               methods[m]->name, kind, i);
        }
}
END_TEST

/* A membrane whose Hessian nobody could want: 1600 masses, 20 MB in full. It swings in
 * its first mode, sin sin, as one mass on the spring 8 sin^2(pi/82). Rounding as above, and
 * what conjugate gradients leave, 1e-15 a step. */
START_TEST(eq_2_10_a_membrane_swings_in_its_mode)
{
    static double x[MOST * MOST * (STEPS + 1)];
    membrane o = { .side = MOST, .c = 1, .rest = 1e-15 };
    fvi_system system = system_of(&o, 1);
    const double half = sin(M_PI / 2 / (MOST + 1)), spring = 8 * half * half;
    const double begin[] = { 1 }, still[] = { 0 }, rho[] = { 0.3 };
    double want[STEPS + 1];
    for (size_t i = 0; i < MOST * MOST; i++) {
        mass[i] = 1;
        damping[i] = 0.3;
        x0[i] = sin(M_PI * (double)(i / MOST + 1) / (MOST + 1))
                * sin(M_PI * (double)(i % MOST + 1) / (MOST + 1));
        p0[i] = 0;
    }
    fvi_run run = fvi_run_default(&system, x0, p0, 0.5, STEPS);
    run.alpha = 0.3;
    ck_assert_int_eq(fvi_trajectory(&fvi_fractional, &run, x, NULL, NULL), 0);
    ck_assert_uint_eq(o.hessians, 0);
    const fvi_system scalar = { .d = 1,
                                .mass = one,
                                .damping = rho,
                                .potential = fvi_potential_harmonic(&spring) };
    run.system = &scalar;
    run.x0 = begin;
    run.p0 = still;
    ck_assert_int_eq(fvi_trajectory(&fvi_fractional, &run, want, NULL, NULL),
                     0);
    for (size_t k = 0; k <= STEPS; k++)
        for (size_t i = 0; i < MOST * MOST; i++)
            ck_assert_near(x[k * MOST * MOST + i], x0[i] * want[k], 2000 * 25 * U,
                           "k %zu, %zu", k, i);
}
END_TEST

/* What solve returns comes back, linear or not; and who needs the Hessian says so. A fork
 * of a run goes on as the run does. */
START_TEST(eq_2_10_what_its_own_solution_returns)
{
    for (int linear = 0; linear < 2; linear++) {
        membrane o = { .side = 6, .c = 1, .g = linear ? 0 : 1, .rest = 1e-15 };
        const fvi_system system = system_of(&o, 1);
        fvi_run run = fvi_run_default(&system, x0, p0, 0.125, STEPS);
        fvi_stepper *s, *fork;
        ck_assert_int_eq(fvi_stepper_start(&fvi_fractional, &run, &s, NULL), 0);
        ck_assert_int_eq(fvi_stepper_step(s), 0);
        ck_assert_int_eq(fvi_stepper_copy(s, &fork), 0);
        ck_assert_int_eq(fvi_stepper_step(s), 0);
        ck_assert_int_eq(fvi_stepper_step(fork), 0);
        ck_assert(memcmp(s->x, fork->x, 36 * sizeof *s->x) == 0);
        o.answer = TIRED;
        o.solutions = 0;
        ck_assert_int_eq(fvi_stepper_step(s), TIRED);
        ck_assert_uint_eq(o.solutions, 1); /* and it is left in peace */
        o.answer = FVI_ESING;
        ck_assert_int_eq(fvi_stepper_step(fork), FVI_ESING);
        fvi_stepper_free(s);
        fvi_stepper_free(fork);
        o.answer = 0;
        double load = 7;
        run.kappa = 0.25;
        ck_assert_int_eq(fvi_stability_number(&fvi_fractional, &run, &load),
                         OUT_OF_REACH);
        ck_assert_double_eq(load, 7);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("02 a potential that solves for itself");
    ADD_CASE(suite, "own", eq_2_10_a_potential_solves_for_itself,
             eq_2_10_a_membrane_swings_in_its_mode,
             eq_2_10_what_its_own_solution_returns);
    return run_suite(suite);
}
