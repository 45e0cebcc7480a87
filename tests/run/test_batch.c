/* tests/run/test_batch.c -- H 28: many small runs as one.       Run alone: make test-batch */
#include <fvi/fvi.h>
#include "harness/ulp.h"
#include "run/whole_run.h"

#include <stdlib.h>

enum { MANY = 1600, STEPS = 300 };

/* An oscillator and its run. */
typedef struct {
    double x0, p0, mass, rho, cg[2], aw[2];
    fvi_system system;
} oscillator;

/* Between a and b, anywhere. */
static double between(double a, double b)
{
    static uint64_t seed = 1;
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return a + (b - a) * ((double)(seed >> 11) * 0x1p-53);
}

static void fill(oscillator *o)
{
    *o = (oscillator){ .x0 = between(-1.5, 1.5),
                       .p0 = between(-1, 1),
                       .mass = 1,
                       .rho = 0.2,
                       .cg = { -1, between(0.5, 1.5) },
                       .aw = { between(0, 0.5), 1.2 } };
}

static fvi_run run_of(const oscillator *o, double alpha, size_t steps)
{
    fvi_run run = fvi_run_default(&o->system, &o->x0, &o->p0, 0.05, steps);
    run.alpha = alpha;
    return run;
}

static void put_together(oscillator *o, fvi_potential potential, fvi_force force)
{
    o->system = (fvi_system){ .d = 1, .mass = &o->mass, .damping = &o->rho, .potential = potential, .force = force };
}

/* x and p of each step, from one run; those of the other lanes are `stride` apart. */
static int single(const fvi_method *method, const fvi_run *run, size_t stride, double *x, double *p)
{
    fvi_stepper *s;
    int status = fvi_stepper_start(method, run, &s, NULL);
    for (size_t k = 0; !status && k <= run->steps; k++) {
        x[k * stride] = *s->x;
        p[k * stride] = *s->p;
        if (k < run->steps)
            status = fvi_stepper_step(s);
    }
    if (!status)
        fvi_stepper_free(s);
    return status;
}

/* Runs together, and each step of each lane is that of its own run, to the bit. */
static void compare(const fvi_method *method, size_t count, const fvi_run *run)
{
    const size_t steps = run->steps;
    double *x = calloc(2 * (steps + 1) * count, sizeof *x), *p = x + (steps + 1) * count;
    fvi_batch *batch;
    fvi_stepper *s;
    ck_assert_ptr_null(fvi_batch_refusal(method, count, run));
    for (size_t l = 0; l < count; l++)
        OK(single(method, run + l, count, x + l, p + l));
    OK(fvi_batch_alloc(method, count, run, &batch, NULL));
    ck_assert_uint_eq(fvi_batch_run(batch)->system->d, count);
    OK(fvi_stepper_start(method, fvi_batch_run(batch), &s, NULL));
    for (size_t k = 0; k <= steps; k++) {
        ck_assert_mem_eq(s->x, x + k * count, count * sizeof *x);
        ck_assert_mem_eq(s->p, p + k * count, count * sizeof *p);
        if (k < steps)
            OK(fvi_stepper_step(s));
    }
    fvi_stepper_free(s);
    fvi_batch_free(batch);
    free(x);
}

static const fvi_method *const methods[] = { &fvi_fractional,  &fvi_cq2_midpoint, &fvi_cq_bdf2,
                                             &fvi_cq2_shifted, &fvi_lobatto_m2,   &fvi_lobatto_m3 };

/* Groups of 8, and at the end of 1, 2, ..., 7. */
static void compare_all(const fvi_method *method, const fvi_run *run, size_t many)
{
    size_t at = 0;
    for (; at + 36 <= many; at += 8)
        compare(method, 8, run + at);
    for (size_t count = 1; count < 8; count++, at += count - 1)
        compare(method, count, run + at);
}

/* 1600 motions between two wells. */
START_TEST(each_of_1600_runs_has_the_bits_of_its_own)
{
    static oscillator o[MANY];
    static fvi_run run[MANY];
    for (size_t i = 0; i < MANY; i++) {
        fill(o + i);
        put_together(o + i, fvi_potential_duffing(o[i].cg), fvi_force_cosine(o[i].aw));
        run[i] = run_of(o + i, 0.3, STEPS);
    }
    compare_all(methods[_i], run, MANY);
}
END_TEST

/* Texts with parameters, with each function and operation, and a coordinate that does not stand in them. */
START_TEST(texts_with_parameters_have_the_bits_of_their_own)
{
    static const struct {
        const char *potential, *force;
    } texts[] = {
        { "k*x^4/4 - x^2/2", "A*cos(1.2*t)" },
        { "k*(1 - cos(x)) + x^6/9 + x^7/5000 - x^3/7", "A*t/(1 + t^2) - 0.1" },
        { "cosh(k*x)/k + 0.1*tanh(x) + 0.2*atan(x)", "abs(sin(k*t))*A" },
        { "x^2*log(2 + k*x^2) + exp(-x^2)", "A*exp(-t)*sign(cos(t))" },
        { "sqrt(1 + k*x^2) + 0.3*sinh(x/20) - 0.1*sin(k*x)", "min(A, t) + max(0, A - t)" },
        { "(1.5 + x^2)^k + abs(x)^3.5 - 0.05*x", "(1 + t)^A" },
        { "0.1*asin(x/40) + 0.1*acos(x/50) + x^4 + tan(x/50)", "A" },
        { "k", "A*t" },
        { "-x", "0" },
        { "-k*x^2/2 + x^2*x^2/4", "-t" },
    };
    enum { GROUP = 64 };
    static const char *const names[] = { "k", "A" };
    static const fvi_symbols of_x = { "x", 1, names, 2 }, of_t = { "t", 1, names, 2 };
    static oscillator o[GROUP];
    fvi_expression *u[GROUP], *f[GROUP];
    fvi_run run[GROUP];
    for (size_t i = 0; i < GROUP; i++) {
        fill(o + i);
        double *values = o[i].cg; /* k and A */
        values[0] = between(0.5, 1.5);
        values[1] = between(-0.5, 0.5);
        OK(fvi_expression_parse(texts[_i].potential, &of_x, values, u + i, NULL));
        OK(fvi_expression_parse(texts[_i].force, &of_t, values, f + i, NULL));
        put_together(o + i, fvi_potential_expression(u[i]), fvi_force_expression(f[i]));
        run[i] = run_of(o + i, 0.3, 100);
    }
    for (size_t m = 0; m < LEN(methods); m++)
        compare_all(methods[m], run, GROUP);
    for (size_t i = 0; i < GROUP; i++) {
        fvi_expression_free(u[i]);
        fvi_expression_free(f[i]);
    }
}
END_TEST

/* Sums of a table, a step, a cosine and an expression, of which the tables and steps differ, too. */
START_TEST(typed_forces_have_the_values_of_their_own)
{
    static const char *const texts[] = { "step:1,2 + k*t", "step:0.5,1 + k*t", "step:-1,0.5 + k*t" };
    static const char *const sums[] = { "cosine:1,2 + k*t + 1", "cosine:1,3 + k*t + 1", "cosine:2,3 + k*t + 1" };
    double k[8];
    oscillator o[8];
    fvi_run run[8];
    fvi_user_parameters lets[8];
    fvi_typed_force *force[8];
    for (int sum = 0; sum < 2; sum++) {
        for (size_t l = 0; l < 8; l++) {
            char let[40];
            fill(o + l);
            snprintf(let, sizeof let, "k=%.17g", k[l] = between(0, 1));
            lets[l] = (fvi_user_parameters){ 0 };
            OK(fvi_parse_user_parameters(let, lets + l, NULL));
            OK(fvi_parse_force((sum ? sums : texts)[l % 3], 1, lets + l, 60, force + l, NULL));
            put_together(o + l, fvi_potential_duffing(o[l].cg), fvi_force_typed(force[l]));
            run[l] = run_of(o + l, 0.3, 60);
        }
        for (size_t m = 0; m < LEN(methods); m++)
            compare(methods[m], 8, run);
        for (size_t l = 0; l < 8; l++)
            fvi_typed_force_free(force[l]);
    }
}
END_TEST

/* Masses, dampings of which some are zero, pasts, orders, laws, memories; springs that are linear. */
START_TEST(every_memory_has_the_bits_of_its_own)
{
    static const double orders[] = { 0, 0.25, 0.5, 0.75, 1 };
    static const fvi_kernel_term terms[] = { { FVI_KERNEL_POWER, 0.3, 0.3, 0, 0 },
                                             { FVI_KERNEL_MAXWELL, 0.5, 0, 2, 0 } };
    static const fvi_kernel law = { 2, terms };
    const fvi_method *method = methods[_i];
    oscillator o[8];
    fvi_run run[8];
    for (size_t n = 0; n < LEN(orders) + 1; n++)
        for (int past = 0; past < 3; past++)
            for (int kind = 0; kind < 2; kind++) {
                const int has_law = n == LEN(orders), is_rl = past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE;
                if (has_law && (past != FVI_INITIAL_HISTORY_HELD || kind))
                    continue;
                for (size_t l = 0; l < 8; l++) {
                    fill(o + l);
                    o[l].cg[0] = 1;
                    o[l].cg[1] = kind ? 0 : o[l].cg[1];
                    if (!method->stages) {
                        o[l].mass = between(0.5, 2);
                        o[l].rho = l % 3 == 1 ? 0 : between(0.1, 1);
                    }
                    if (is_rl && !has_law && orders[n] > 0.5)
                        o[l].x0 = 0;
                    put_together(o + l, fvi_potential_duffing(o[l].cg), fvi_force_step(o[l].aw));
                    run[l] = run_of(o + l, has_law ? 0.5 : orders[n], 90);
                    run[l].law = has_law ? &law : NULL;
                    run[l].past = (fvi_initial_history)past;
                    run[l].memory = kind ? FVI_HISTORY_MODES : has_law ? FVI_HISTORY_AUTO : FVI_HISTORY_DIRECT;
                    run[l].kappa = 0.25;
                }
                compare(method, 8, run);
                compare(method, 3, run);
            }
}
END_TEST

/* Steps so long that Newton's method alone is lost in some lanes: they begin again as their own runs do, and
 * the others do not notice. Methods with several equations in a step solve each lane by itself. */
START_TEST(a_lane_that_is_lost_finds_its_own_way)
{
    static const fvi_method *const all[] = { &fvi_fractional, &fvi_cq2_midpoint, &fvi_lobatto_m3,
                                             &fvi_lobatto_m4, &fvi_lobatto_d3 };
    oscillator o[8];
    fvi_run run[8];
    for (size_t m = 0; m < LEN(all); m++)
        for (size_t turn = 0; turn < 12; turn++) {
            for (size_t l = 0; l < 8; l++) {
                fill(o + l);
                o[l].cg[0] = l % 2 ? -8 : 1;
                if (turn == 0 && l == 3) { /* m/h + h U''(0)/4 = 0 */
                    o[l].x0 = 0;
                    o[l].cg[0] = -4;
                }
                put_together(o + l, fvi_potential_duffing(o[l].cg), (fvi_force){ 0 });
                run[l] = run_of(o + l, 0.25, 40);
                run[l].h = all[m]->stages ? 0.1 : 1;
            }
            compare(all[m], 8, run);
        }
}
END_TEST

/* ---- functions of the caller's ---- */

static int calls;

static int wall_gradient(size_t d, const double *x, void *params, double *g)
{
    const double *k = params;
    ck_assert_uint_eq(d, 1);
    calls++;
    *g = *k * *x * *x * *x;
    return *x > 3 ? -7 : 0;
}

static int wall_value(size_t d, const double *x, void *params, double *value)
{
    (void)d;
    *value = *(const double *)params * *x * *x * *x * *x / 4;
    return 0;
}

static int wall_hessian(size_t d, const double *x, void *params, double *H)
{
    (void)d;
    *H = 3 * *(const double *)params * *x * *x;
    return 0;
}

static int push(double t, size_t d, void *params, double *F)
{
    ck_assert_uint_eq(d, 1);
    *F = *(const double *)params * t;
    return 0;
}

static void make_walls(size_t diagonals, oscillator *o, fvi_run *run)
{
    for (size_t l = 0; l < 8; l++) {
        fill(o + l);
        const fvi_potential wall = { .value = wall_value,
                                     .gradient = wall_gradient,
                                     .hessian = wall_hessian,
                                     .params = o[l].cg + 1,
                                     .diagonals = diagonals };
        put_together(o + l, wall, (fvi_force){ .value = push, .params = o[l].aw });
        run[l] = run_of(o + l, 0.3, 60);
    }
}

/* They see one coordinate, and no point at which their own run does not ask. */
START_TEST(functions_of_the_caller_are_asked_as_by_their_own_runs)
{
    oscillator o[8];
    fvi_run run[8];
    for (size_t diagonals = 0; diagonals < 2; diagonals++)
        for (size_t m = 0; m < LEN(methods); m++) {
            make_walls(diagonals, o, run);
            compare(methods[m], 8, run);
        }
    make_walls(1, o, run);
    calls = 0;
    for (size_t l = 0; l < 8; l++) {
        double x[61], p[61];
        OK(single(&fvi_cq2_midpoint, run + l, 1, x, p));
    }
    const int of_singles = calls;
    fvi_batch *batch;
    fvi_stepper *s;
    OK(fvi_batch_alloc(&fvi_cq2_midpoint, 8, run, &batch, NULL));
    OK(fvi_stepper_start(&fvi_cq2_midpoint, fvi_batch_run(batch), &s, NULL));
    calls = 0;
    while (s->k < 60)
        OK(fvi_stepper_step(s));
    ck_assert_int_eq(calls, of_singles);
    double energy, one, sum = 0;
    OK(fvi_energy(fvi_batch_run(batch)->system, s->x, s->p, &energy));
    for (size_t l = 0; l < 8; l++) {
        OK(fvi_energy(&o[l].system, s->x + l, s->p + l, &one));
        sum += one;
    }
    ck_assert_near(energy, sum, 32 * U * fabs(sum), "24 terms, each rounded once or twice");
    fvi_stepper_free(s);
    fvi_batch_free(batch);
    *o[5].aw = 500; /* pushed to 3 */
    OK(fvi_batch_alloc(&fvi_cq2_midpoint, 8, run, &batch, NULL));
    OK(fvi_stepper_start(&fvi_cq2_midpoint, fvi_batch_run(batch), &s, NULL));
    int status = 0;
    while (s->k < 60 && !status)
        status = fvi_stepper_step(s);
    ck_assert_int_eq(status, -7);
    fvi_stepper_free(s);
    fvi_batch_free(batch);
}
END_TEST

/* ---- what takes a run ---- */

/* A copy half way goes on with the same bits, also where lanes have solvers of their own. */
START_TEST(a_batch_is_copied_as_any_run)
{
    static const fvi_method *const all[] = { &fvi_cq2_midpoint, &fvi_lobatto_m4 };
    oscillator o[8];
    fvi_run run[8];
    for (size_t m = 0; m < LEN(all); m++) {
        fvi_batch *batch;
        fvi_stepper *s, *copy;
        make_walls(1, o, run);
        OK(fvi_batch_alloc(all[m], 8, run, &batch, NULL));
        OK(fvi_stepper_start(all[m], fvi_batch_run(batch), &s, NULL));
        while (s->k < 30)
            OK(fvi_stepper_step(s));
        OK(fvi_stepper_copy(s, &copy));
        while (s->k < 60)
            OK(fvi_stepper_step(s));
        while (copy->k < 60)
            OK(fvi_stepper_step(copy));
        ck_assert_mem_eq(s->x, copy->x, 8 * sizeof *s->x);
        ck_assert_mem_eq(s->p, copy->p, 8 * sizeof *s->p);
        fvi_stepper_free(s);
        fvi_stepper_free(copy);
        fvi_batch_free(batch);
    }
}
END_TEST

/* J is the sum of all last places. */
static int last_place(size_t k, size_t d, const double *x, const double *p, void *params, double *Jx, double *Jp)
{
    (void)x;
    (void)p;
    (void)Jp;
    for (size_t j = 0; j < d && k == *(const size_t *)params; j++)
        Jx[j] += 1;
    return 0;
}

/* The derivatives of a lane are those of its run, and that by alpha is the sum of all. They solve the same linear
 * equations; the histories of a batch and of a run are summed alike. */
START_TEST(the_adjoint_of_a_batch_is_that_of_its_runs)
{
    static const fvi_method *const all[] = { &fvi_fractional, &fvi_cq2_midpoint, &fvi_cq_bdf2, &fvi_lobatto_m3 };
    size_t steps = 80;
    const fvi_objective J = { .slopes = last_place, .params = &steps };
    oscillator o[8];
    fvi_run run[8];
    for (size_t m = 0; m < LEN(all); m++) {
        double together[4][8], alone[4][8], alpha, sum = 0, sizes = 0;
        fvi_batch *batch;
        for (size_t l = 0; l < 8; l++) {
            double by_alpha;
            fill(o + l);
            put_together(o + l, fvi_potential_duffing(o[l].cg), fvi_force_cosine(o[l].aw));
            run[l] = run_of(o + l, 0.3, steps);
            const fvi_sensitivities own = { .x0 = alone[0] + l, .p0 = alone[1] + l, .mass = alone[2] + l,
                                            .damping = alone[3] + l, .alpha = &by_alpha };
            OK(fvi_adjoint(all[m], run + l, NULL, NULL, &J, &own));
            sum += by_alpha;
            sizes += fabs(by_alpha);
        }
        const fvi_sensitivities of_all = { .x0 = together[0], .p0 = together[1], .mass = together[2],
                                           .damping = together[3], .alpha = &alpha };
        OK(fvi_batch_alloc(all[m], 8, run, &batch, NULL));
        OK(fvi_adjoint(all[m], fvi_batch_run(batch), NULL, NULL, &J, &of_all));
for (size_t i = 0; i < 4; i++)
            for (size_t l = 0; l < 8; l++)
                ck_assert_near(together[i][l], alone[i][l], 80 * U * (1 + fabs(alone[i][l])),
                               "%s: sums of 80 terms, those of the masses in another order", all[m]->name);
        ck_assert_near(alpha, sum, 8 * 80 * U * sizes, "sums in another order");
        fvi_batch_free(batch);
    }
}
END_TEST

/* Any number of runs: two of them change their step in between, one fails and takes nobody along. */
START_TEST(whole_trajectories_are_those_of_single_runs)
{
    enum { RUNS = 23, ROWS = 61 };
    static double got[2][RUNS][ROWS], want[2][RUNS][ROWS];
    oscillator o[RUNS];
    fvi_run run[RUNS];
    double *x[RUNS], *p[RUNS];
    int status[RUNS];
    for (size_t i = 0; i < RUNS; i++) {
        fill(o + i);
        put_together(o + i, fvi_potential_duffing(o[i].cg), fvi_force_cosine(o[i].aw));
        run[i] = run_of(o + i, 0.3, ROWS - 1);
        run[i].h = i < 11 ? 0.05 : 0.1;
        x[i] = i == 4 ? NULL : got[0][i];
        p[i] = i == 5 ? NULL : got[1][i];
        OK(single(&fvi_cq2_midpoint, run + i, 1, want[0][i], want[1][i]));
    }
    OK(fvi_batch_trajectories(&fvi_cq2_midpoint, RUNS, run, ROWS, NULL, x, p, status));
    for (size_t i = 0; i < RUNS; i++) {
        ck_assert_int_eq(status[i], 0);
        ck_assert(i == 4 || memcmp(got[0][i], want[0][i], sizeof *want[0]) == 0);
        ck_assert(i == 5 || memcmp(got[1][i], want[1][i], sizeof *want[1]) == 0);
    }
    static const size_t some[] = { 0, 7, 40 };
    OK(fvi_batch_trajectories(&fvi_cq2_midpoint, RUNS, run, LEN(some), some, x, p, NULL));
    for (size_t i = 0; i < RUNS; i++)
        for (size_t r = 0; r < LEN(some); r++) {
            ck_assert(i == 4 || got[0][i][r] == want[0][i][some[r]]);
            ck_assert(i == 5 || got[1][i][r] == want[1][i][some[r]]);
        }
    memset(got, 0, sizeof got);
    o[2].x0 = 1e200;
    const int code = fvi_batch_trajectories(&fvi_cq2_midpoint, RUNS, run, ROWS, NULL, x, NULL, status);
    ck_assert_int_ne(code, 0);
    for (size_t i = 0; i < RUNS; i++) {
        ck_assert_int_eq(status[i], i == 2 ? code : 0);
        ck_assert(i == 4 || i == 2 || memcmp(got[0][i], want[0][i], sizeof *want[0]) == 0);
    }
    /* Two coordinates, and a method that chooses its steps, go by themselves. */
    static const double two[] = { 1, 0.5 }, spring = 2;
    const fvi_system pair = { .d = 2, .mass = two, .damping = two, .potential = fvi_potential_harmonic(&spring) };
    const fvi_run both[] = { fvi_run_default(&pair, two, two, 0.1, 20), fvi_run_default(&pair, two, two, 0.2, 20) };
    const fvi_method *const choices[] = { &fvi_cq_bdf2, &fvi_variable_step };
    for (size_t m = 0; m < LEN(choices); m++) {
        double rows[2][6], own[2][42];
        double *to[] = { rows[0], rows[1] };
        OK(fvi_batch_trajectories(choices[m], 2, both, LEN(some) - 1, some, to, NULL, NULL));
        for (size_t i = 0; i < 2; i++) {
            OK(fvi_trajectory(choices[m], both + i, own[i], NULL, NULL));
            ck_assert_mem_eq(rows[i], own[i], 2 * sizeof **own);
            ck_assert_mem_eq(rows[i] + 2, own[i] + 2 * 7, 2 * sizeof **own);
        }
    }
    OK(fvi_batch_trajectories(&fvi_cq2_midpoint, 0, run, ROWS, NULL, NULL, NULL, NULL));
    ck_assert_int_eq(fvi_batch_trajectories(NULL, 1, run, ROWS, NULL, NULL, NULL, NULL), FVI_EFAULT);
    ck_assert_int_eq(fvi_batch_trajectories(&fvi_cq2_midpoint, 1, NULL, ROWS, NULL, NULL, NULL, NULL), FVI_EFAULT);
}
END_TEST

/* ---- what does not go together ---- */

START_TEST(runs_that_differ_do_not_go_together)
{
    static const double two[] = { 1, 1 }, J = 1;
    static const fvi_impulse impulse = { 1, &J };
    static const fvi_kernel_term term = { FVI_KERNEL_MAXWELL, 1, 0, 1, 0 }, other = { FVI_KERNEL_MAXWELL, 1, 0, 2, 0 };
    static const fvi_kernel law = { 1, &term }, another = { 1, &other };
    oscillator o[2];
    fvi_run run[2];
    for (int bad = 0; bad < 17; bad++) {
        const fvi_method *method = bad == 0 ? &fvi_variable_step : bad == 1 ? &fvi_lobatto_m2 : &fvi_cq2_shifted;
        for (size_t l = 0; l < 2; l++) {
            fill(o + l);
            put_together(o + l, fvi_potential_duffing(o[l].cg), fvi_force_cosine(o[l].aw));
            run[l] = run_of(o + l, 0.3, 10);
        }
        fvi_run *r = run + 1;
        fvi_system *s = &o[1].system;
        o[1].rho = bad == 1 ? 0.3 : 0.2;
        r->h = bad == 2 ? 0.1 : r->h;
        r->steps = bad == 3 ? 11 : r->steps;
        r->alpha = bad == 4 ? 0.4 : r->alpha;
        r->kappa = bad == 5 ? 1 : r->kappa;
        r->past = bad == 6 ? FVI_INITIAL_HISTORY_CAPUTO : r->past;
        r->memory = bad == 7 ? FVI_HISTORY_DIRECT : r->memory;
        r->tolerance = bad == 8 ? 1e-9 : r->tolerance;
        run[0].law = bad == 9 || bad == 10 ? &law : NULL;
        r->law = bad == 9 ? NULL : bad == 10 ? &another : r->law;
        o[1].cg[1] = bad == 11 ? 0 : o[1].cg[1]; /* quadratic */
        if (bad == 12)
            s->potential = (fvi_potential){ 0 };
        if (bad == 13)
            s->force = (fvi_force){ 0 };
        if (bad == 14)
            *s = (fvi_system){ .d = 2, .mass = two, .damping = two };
        s->force.impulses = &impulse;
        s->force.impulse_count = bad == 15;
        r->x0 = bad == 16 ? NULL : r->x0;
        fvi_batch *batch = NULL;
        fvi_error error;
        ck_assert_msg(fvi_batch_refusal(method, 2, run) != NULL, "%d", bad);
        ck_assert_int_eq(fvi_batch_alloc(method, 2, run, &batch, &error), FVI_EUNSUP);
        ck_assert_ptr_null(batch);
        ck_assert_ptr_nonnull(strstr(error.text, fvi_batch_refusal(method, 2, run)));
    }
    fvi_batch *batch = NULL;
    ck_assert_int_eq(fvi_batch_alloc(NULL, 2, run, &batch, NULL), FVI_EFAULT);
    ck_assert_int_eq(fvi_batch_alloc(&fvi_cq_bdf2, 2, NULL, &batch, NULL), FVI_EFAULT);
    ck_assert_int_eq(fvi_batch_alloc(&fvi_cq_bdf2, 2, run, NULL, NULL), FVI_EFAULT);
    ck_assert_int_eq(fvi_batch_alloc(&fvi_cq_bdf2, 0, run, &batch, NULL), FVI_EINVAL);
    ck_assert_int_eq(fvi_batch_alloc(&fvi_cq_bdf2, 9, run, &batch, NULL), FVI_EINVAL);
    ck_assert_ptr_nonnull(fvi_batch_refusal(&fvi_cq_bdf2, 9, run));
    fvi_batch_free(NULL);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("runs together");
    ADD_LOOP(suite, each_of_1600_runs_has_the_bits_of_its_own, LEN(methods));
    ADD_LOOP(suite, texts_with_parameters_have_the_bits_of_their_own, 10);
    ADD_LOOP(suite, every_memory_has_the_bits_of_its_own, LEN(methods));
    ADD_CASE(suite, "lanes", typed_forces_have_the_values_of_their_own, a_lane_that_is_lost_finds_its_own_way,
             functions_of_the_caller_are_asked_as_by_their_own_runs);
    ADD_CASE(suite, "uses", a_batch_is_copied_as_any_run, whole_trajectories_are_those_of_single_runs, the_adjoint_of_a_batch_is_that_of_its_runs,
             runs_that_differ_do_not_go_together);
    return run_suite(suite);
}
