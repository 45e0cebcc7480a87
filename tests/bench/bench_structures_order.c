/* tests/bench/bench_structures_order.c -- H 27: the cost of a digit, by a method of order 2 and by methods of
 * high order.
 *
 * The systems are five storeys with three kinds of dampers up to t = 60, and a beam of 16 elements with C = K/100
 * up to t = 2 that is bent and let go. Prints the largest error of any unknown in 60 rows, compared with
 * fvi-adaptive with errors of 1e-14 for a step, and the processor time, the start of the run included. Then the
 * cost of an error of 1e-10, beside 1e-4 by fvi-stable; and a step of a membrane of 99,856 unknowns, with one
 * damper and with C = K/100. One minute. */
#define _POSIX_C_SOURCE 200809L /* clock_gettime, uname */
#include <fvi/fvi.h>
#include <fvi/structures.h>
#include "../../figures/structures/cantilever.h"
#include "bench.h"
#include "system/larger.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { ROWS = 60, FLOORS = 5, ELEMENTS = 16, SIDE = 316 };

/* A motion from x0 and p0, and its exact rows. */
typedef struct {
    fvi_system system;
    double T, *x0, *p0, *rows;
} motion;

static void ok(int status)
{
    if (status)
        exit(EXIT_FAILURE);
}

static double *numbers(size_t n)
{
    double *v = calloc(n, sizeof *v);
    ok(!v);
    return v;
}

/* ---- systems ---- */

/* Mass 1 and stiffness 100; a springpot below the first floor, a power of an order above 1 below the third
 * floor, a dashpot and a fraction below the fifth floor. */
static motion building(void)
{
    static fvi_kernel_term term[4] = { { FVI_KERNEL_POWER, 5, 0.3125, 0, 0 },
                                       { FVI_KERNEL_POWER, 1, 0.6875, 0, 0 },
                                       { FVI_KERNEL_POWER, 0.5, 0.5, 0, 0 },
                                       { FVI_KERNEL_ZENER, 3, 0.25, 2, 0 } };
    static fvi_kernel kernel[3] = { { 1, term }, { 1, term + 1 }, { 2, term + 2 } };
    static double row[3][FLOORS] = { { 1 }, { 0, -1, 1 }, { 0, 0, 0, -1, 1 } };
    static fvi_damper damper[3];
    static fvi_sparse M, K;
    fvi_triplet m[FLOORS], k[3 * FLOORS];
    fvi_structure *structure;
    size_t count = 0;
    for (int i = 0; i < FLOORS; i++) {
        m[i] = (fvi_triplet){ i, i, 1 };
        for (int j = i > 0 ? i - 1 : 0; j <= i + 1 && j < FLOORS; j++)
            k[count++] = (fvi_triplet){ i, j, i != j ? -100 : i < FLOORS - 1 ? 200 : 100 };
    }
    for (int j = 0; j < 3; j++)
        damper[j] = (fvi_damper){ .of = fvi_elongation_row(row[j]), .kernel = kernel + j };
    ok(fvi_sparse_assemble(FLOORS, FLOORS, m, &M));
    ok(fvi_sparse_assemble(FLOORS, count, k, &K));
    ok(fvi_structure_alloc_dampers(&M, &K, 3, damper, &structure, NULL));
    motion b = { fvi_structure_system(structure), 60, numbers(FLOORS), numbers(FLOORS), NULL };
    for (int i = 0; i < FLOORS; i++) {
        b.x0[i] = (i + 1) / 16.;
        b.p0[i] = i % 2 ? -0.25 : 0.5;
    }
    return b;
}

/* A beam that is bent by a load at its tip. */
static motion beam_of(void)
{
    static fvi_sparse M, K, C;
    fvi_structure *structure;
    ok(cantilever(ELEMENTS, 0.01, &M, &K, &C));
    ok(fvi_structure_alloc(&M, &K, &C, &structure, NULL));
    motion b = { fvi_structure_system(structure), 2, numbers(M.n), numbers(M.n), NULL };
    for (size_t e = 0; e < M.n / 2; e++) {
        const double y = (double)(e + 1) / ELEMENTS;
        b.x0[2 * e] = y * y * (3 - y) / 2;
        b.x0[2 * e + 1] = (3 * y - 1.5 * y * y) / ELEMENTS; /* slopes are times the length */
    }
    return b;
}

/* ---- errors ---- */

/* Compute the rows of a run with `per` steps between two rows, or with steps of its own. Return the seconds. */
static double rows_of(const motion *m, const fvi_method *method, size_t per, double step_error, double *rows)
{
    const size_t d = m->system.d, parts = method->dense ? 1 : per;
    fvi_run run = fvi_run_default(&m->system, m->x0, m->p0, m->T / (double)(ROWS * parts), ROWS * parts);
    run.alpha = m->system.mechanism ? 0.5 : 0.25;
    run.step_error = step_error;
    fvi_stepper *s;
    const double begin = now();
    ok(fvi_stepper_start(method, &run, &s, NULL));
    for (size_t k = 1; k <= ROWS; k++)
        ok(fvi_stepper_advance_to(s, (double)(k * parts) * run.h, rows + (k - 1) * d, NULL));
    const double seconds = now() - begin;
    fvi_stepper_free(s);
    return seconds;
}

/* The time and the error of a run. */
typedef struct {
    const fvi_method *method;
    double seconds, error;
} point;

/* Measure a row of the table, with `per` steps between two rows or the tolerance of a step. The time is the
 * least of many, because most runs are short. */
static point measure(const motion *m, const fvi_method *method, size_t per, double step_error)
{
    enum { TIMES = 15 };
    const size_t count = ROWS * m->system.d;
    double *rows = numbers(count);
    point is = { method, INFINITY, 0 };
    for (int i = 0; i < TIMES; i++)
        is.seconds = smaller(is.seconds, rows_of(m, method, per, step_error, rows));
    for (size_t i = 0; i < count; i++)
        is.error = larger(is.error, fabs(rows[i] - m->rows[i]));
    if (is.error < 0.03)
        printf(method->dense ? "%s\t%.0e\t%.3g\t%.2g\n" : "%s\t%.3g\t%.3g\t%.2g\n", method->name,
               method->dense ? step_error : m->T / (double)(ROWS * per),
               1e3 * is.seconds, is.error);
    free(rows);
    return is;
}

static const fvi_method *const methods[] = { &fvi_cq2_midpoint, &fvi_lobatto_d3, &fvi_lobatto_d4, &fvi_lobatto_d6,
                                             &fvi_lobatto_d8 };

/* Keep the faster one of two runs with at most this error. */
static void keep(point *best, point is, double error)
{
    if (is.error <= error && (!best->method || is.seconds < best->seconds))
        *best = is;
}

/* Return the next number of steps between two rows: 1, 2, 3, 4, 6, 8, 12, ...; for the method of order 2, whose
 * error is regular, powers of 2 alone. */
static size_t more(size_t per, int is_stable)
{
    const size_t power = (per & (per - 1)) == 0;
    return is_stable || per == 1 ? 2 * per : power ? per / 2 * 3 : per / 3 * 4;
}

/* Return the time of fvi-stable at an error of 1e-4, between two measured runs. The number of its steps is
 * proportional to 1/sqrt(error). */
static double seconds_of_stable(point coarse, point fine)
{
    const double share = log(coarse.error / 1e-4) / log(coarse.error / fine.error);
    return coarse.seconds * pow(fine.seconds / coarse.seconds, share);
}

static void table(const char *name, motion m, double *four_digits, point *ten_digits)
{
    point last = { 0 };
    m.rows = numbers(ROWS * m.system.d);
    rows_of(&m, &fvi_variable_step, 1, 1e-14, m.rows);
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++) {
        printf("\n\n#> %s-%s\n# method\th\tms\tlargest error\n", name, methods[i]->name + 4);
        for (size_t per = 1; per <= (i ? 64 : 1024); per = more(per, i == 0)) {
            const point is = measure(&m, methods[i], per, 0);
            if (i == 0 && is.error <= 1e-4 && last.error > 1e-4)
                *four_digits = seconds_of_stable(last, is);
            keep(ten_digits, is, 1e-10);
            last = is;
            if (is.error < 1e-12)
                break;
        }
        printf("#< %s-%s\n", name, methods[i]->name + 4);
    }
    printf("\n\n#> %s-adaptive\n# method\tstep error\tms\tlargest error\n", name);
    for (double tolerance = 1e-3; tolerance > 1e-12; tolerance /= 10)
        keep(ten_digits, measure(&m, &fvi_variable_step, 1, tolerance), 1e-10);
    printf("#< %s-adaptive\n", name);
    free(m.rows);
}

static void tables(void)
{
    static const char *const name[] = { "building", "beam" };
    const motion of[] = { building(), beam_of() };
    double four[2] = { 0 };
    point ten[2] = { { 0 } };
    for (int i = 0; i < 2; i++)
        table(name[i], of[i], &four[i], &ten[i]);
    printf("\n\n#> digits\n# of what\tms to 1e-4, fvi-stable\tms to 1e-10\tby\tshare\n");
    for (int i = 0; i < 2; i++)
        printf("%s\t%.3g\t%.3g\t%s\t%.2g\n", name[i], 1e3 * four[i], 1e3 * ten[i].seconds, ten[i].method->name,
               ten[i].seconds / four[i]);
    printf("#< digits\n");
}

/* ---- a step of many unknowns ---- */

static void membrane(fvi_sparse *M, fvi_sparse *K, fvi_sparse *C)
{
    const int n = SIDE, d = n * n;
    const double k = (n + 1.) * (n + 1.);
    fvi_triplet *t = malloc(5 * (size_t)d * sizeof *t), *next = t;
    ok(!t);
    for (int i = 0; i < d; i++) {
        *next++ = (fvi_triplet){ i, i, 4 * k };
        const int beside[] = { i % n > 0 ? i - 1 : -1, i % n < n - 1 ? i + 1 : -1, i - n, i + n };
        for (int j = 0; j < 4; j++)
            if (beside[j] >= 0 && beside[j] < d)
                *next++ = (fvi_triplet){ i, beside[j], -k };
    }
    const size_t count = (size_t)(next - t);
    ok(fvi_sparse_assemble((size_t)d, count, t, K));
    for (size_t l = 0; l < count; l++)
        t[l].entry /= 100;
    ok(fvi_sparse_assemble((size_t)d, count, t, C));
    for (int i = 0; i < d; i++)
        t[i] = (fvi_triplet){ i, i, 1 };
    ok(fvi_sparse_assemble((size_t)d, (size_t)d, t, M));
    free(t);
}

/* Return the seconds of one step, and of the start. The memory of fvi-stable works in blocks of 32 steps and
 * reaches its full cost after 64 steps; that of stages reaches it after four steps. */
static double step_of(const fvi_system *system, const fvi_method *method, double *start)
{
    enum { TIMES = 3 };
    const int before = method->stages ? 6 : 64, steps = method->stages ? 6 : 32;
    const size_t d = system->d;
    double *x0 = numbers(2 * d), least = INFINITY;
    for (size_t i = 0; i < d; i++)
        x0[i] = sin(0.01 * (double)i);
    fvi_run run = fvi_run_default(system, x0, x0 + d, 1. / SIDE, 400);
    run.alpha = system->mechanism ? 0.5 : 0.25;
    fvi_stepper *s;
    const double begin = now();
    ok(fvi_stepper_start(method, &run, &s, NULL));
    *start = now() - begin;
    for (int i = 0; i < before; i++)
        ok(fvi_stepper_step(s));
    for (int i = 0; i < TIMES; i++) {
        const double from = now();
        for (int l = 0; l < steps; l++)
            ok(fvi_stepper_step(s));
        least = smaller(least, (now() - from) / steps);
    }
    fvi_stepper_free(s);
    free(x0);
    return least;
}

static void table_of_steps(void)
{
    fvi_sparse M, K, C;
    membrane(&M, &K, &C);
    const fvi_kernel_term springpot = { FVI_KERNEL_POWER, 1, 0.25, 0, 0 };
    const fvi_kernel kernel = { 1, &springpot };
    double *row = numbers(M.n);
    row[M.n / 2] = 1;
    const fvi_damper damper = { .of = fvi_elongation_row(row), .kernel = &kernel };
    fvi_structure *structure[2];
    ok(fvi_structure_alloc_dampers(&M, &K, 1, &damper, &structure[0], NULL));
    ok(fvi_structure_alloc(&M, &K, &C, &structure[1], NULL));
    printf("\n\n#> step\n# method\ts to the start\tms a step, one damper\tby that of order 2\tms a step, C = K/100\tby that "
           "of order 2\n");
    double base[2] = { 0 };
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++) {
        double start, seconds[2];
        for (int j = 0; j < 2; j++) {
            const fvi_system system = fvi_structure_system(structure[j]);
            seconds[j] = step_of(&system, methods[i], &start);
            base[j] = i ? base[j] : seconds[j];
        }
        printf("%s\t%.2g\t%.3g\t%.2g\t%.3g\t%.2g\n", methods[i]->name, start, 1e3 * seconds[0], seconds[0] / base[0],
               1e3 * seconds[1], seconds[1] / base[1]);
        fflush(stdout);
    }
    printf("#< step\n");
}

int main(void)
{
    describe();
    tables();
    table_of_steps();
    return EXIT_SUCCESS;
}
