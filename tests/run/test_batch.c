/* tests/run/test_batch.c -- H 28: each step of a batch agrees with the steps of its runs, to the bit.
 * Run alone: make test-batch */
#include "batch_runs.h"

enum { MANY = 1600, STEPS = 300 };

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
    fill_wells(MANY, o, run, STEPS);
    compare_all(methods[_i], run, MANY);
}
END_TEST

/* Pendulums and harmonic springs, of which each lane has its own. */
START_TEST(ready_made_potentials_have_the_bits_of_their_own)
{
    enum { GROUP = 64 };
    fvi_potential (*const ready[])(const double *) = { fvi_potential_pendulum, fvi_potential_harmonic };
    static oscillator o[GROUP];
    fvi_run run[GROUP];
    for (size_t u = 0; u < LEN(ready); u++) {
        for (size_t i = 0; i < GROUP; i++) {
            fill(o + i);
            o[i].cg[0] = between(0.5, 20);
            o[i].cg[1] = NAN; /* of one number nobody reads a second */
            o[i].aw[1] = between(1, 2);
            put_together(o + i, ready[u](o[i].cg), fvi_force_cosine(o[i].aw));
            run[i] = run_of(o + i, 0.3, 100);
        }
        compare_all(methods[_i], run, GROUP);
    }
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

int main(void)
{
    Suite *suite = suite_create("runs together");
    ADD_LOOP(suite, each_of_1600_runs_has_the_bits_of_its_own, LEN(methods));
    ADD_LOOP(suite, ready_made_potentials_have_the_bits_of_their_own, LEN(methods));
    ADD_LOOP(suite, texts_with_parameters_have_the_bits_of_their_own, 10);
    ADD_LOOP(suite, every_memory_has_the_bits_of_its_own, LEN(methods));
    ADD_CASE(suite, "lanes", typed_forces_have_the_values_of_their_own, a_lane_that_is_lost_finds_its_own_way,
             functions_of_the_caller_are_asked_as_by_their_own_runs);
    return run_suite(suite);
}
