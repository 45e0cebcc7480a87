/* tests/bench/bench_batch.c -- H 28: eight runs of an oscillator together, and one after the other; and 1600 runs
 * by `fvi sweep`, in both ways.
 *
 * Prints a table in blocks in a quarter of a minute. The oscillator has two wells, a force and damping of the
 * order 0.6. The runs differ in their start, in the amplitude of the force and in the stiffness. The two ways
 * take turns, and each turn gives a ratio. The columns have the median, the least and the largest ratio. */
#define _POSIX_C_SOURCE 200809L /* clock_gettime, uname */
#include <fvi/fvi.h>
#include "bench.h"

#include <stdlib.h>
#include <sys/resource.h>

enum { RUNS = 64, STEPS = 1000, TURNS = 15, SWEEPS = 7 };

typedef struct {
    double x0, p0, mass, rho, cg[2], aw[2];
    fvi_expression *u, *f;
    fvi_system system;
} oscillator;

static void check(int status)
{
    if (status)
        exit(EXIT_FAILURE);
}

static void make(oscillator *o, size_t i, int from_text)
{
    static const char *const names[] = { "c", "k", "A", "w" };
    static const fvi_symbols of_x = { "x", 1, names, 2 }, of_t = { "t", 1, names + 2, 2 };
    *o = (oscillator){ .x0 = -1.5 + 3.0 * (double)i / RUNS,
                       .p0 = 1 - 2.0 * (double)(i * 7 % RUNS) / RUNS,
                       .mass = 1,
                       .rho = 0.2,
                       .cg = { -1, 1 + 0.01 * (double)i },
                       .aw = { 0.3 + 0.001 * (double)i, 1.2 } };
    o->system = (fvi_system){ .d = 1, .mass = &o->mass, .damping = &o->rho };
    if (!from_text) {
        o->system.potential = fvi_potential_duffing(o->cg);
        o->system.force = fvi_force_cosine(o->aw);
        return;
    }
    check(fvi_expression_parse("c*x^2/2 + k*x^4/4", &of_x, o->cg, &o->u, NULL));
    check(fvi_expression_parse("A*cos(w*t)", &of_t, o->aw, &o->f, NULL));
    o->system.potential = fvi_potential_expression(o->u);
    o->system.force = fvi_force_expression(o->f);
}

static void walk(const fvi_method *method, const fvi_run *run)
{
    fvi_stepper *s;
    check(fvi_stepper_start(method, run, &s, NULL));
    while (s->k < run->steps)
        check(fvi_stepper_step(s));
    fvi_stepper_free(s);
}

/* J is the last position, or the sum of the last positions of all lanes. */
static int last_place(size_t k, size_t d, const double *x, const double *p, void *params, double *Jx, double *Jp)
{
    (void)x, (void)p, (void)params, (void)Jp;
    for (size_t j = 0; j < d && k == STEPS; j++)
        Jx[j] += 1;
    return 0;
}

/* Compute the derivatives of J by starts, masses, dampings and the order: a run forwards and a run backwards. */
static void walk_back(const fvi_method *method, const fvi_run *run)
{
    static const fvi_objective J = { .slopes = last_place };
    double x0[8], p0[8], mass[8], damping[8], alpha;
    const fvi_sensitivities by = { .x0 = x0, .p0 = p0, .mass = mass, .damping = damping, .alpha = &alpha };
    check(fvi_adjoint(method, run, NULL, NULL, &J, &by));
}

/* Return the ns for a run and step, the start included. */
static double time_of(void (*go)(const fvi_method *, const fvi_run *), const fvi_method *method,
                      const fvi_run *run, size_t together)
{
    const double start = now();
    for (size_t i = 0; i < RUNS; i += together) {
        fvi_batch *batch;
        if (together == 1) {
            go(method, run + i);
            continue;
        }
        check(fvi_batch_alloc(method, together, run + i, &batch, NULL));
        go(method, fvi_batch_run(batch));
        fvi_batch_free(batch);
    }
    return 1e9 * (now() - start) / RUNS / (double)run->steps;
}

static int by_size(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(size_t n, double *v)
{
    qsort(v, n, sizeof *v, by_size);
    return v[n / 2];
}

static void row(const fvi_method *method, int from_text, int is_adjoint)
{
    static oscillator o[RUNS];
    fvi_run run[RUNS];
    double alone[TURNS], together[TURNS], ratio[TURNS];
    for (size_t i = 0; i < RUNS; i++) {
        make(o + i, i, from_text);
        run[i] = fvi_run_default(&o[i].system, &o[i].x0, &o[i].p0, 0.05, STEPS);
        run[i].alpha = 0.3;
    }
    for (size_t turn = 0; turn < TURNS; turn++) {
        alone[turn] = time_of(is_adjoint ? walk_back : walk, method, run, 1);
        together[turn] = time_of(is_adjoint ? walk_back : walk, method, run, 8);
        ratio[turn] = alone[turn] / together[turn];
    }
    const double middle = median(TURNS, ratio);
    printf("%s%s, %s\t%.0f\t%.0f\t%.1f\t%.1f\t%.1f\n", is_adjoint ? "adjoint of " : "", method->name, from_text ? "texts" : "ready-made",
           median(TURNS, alone), median(TURNS, together), middle, ratio[0], ratio[TURNS - 1]);
    fflush(stdout);
    for (size_t i = 0; i < RUNS; i++) {
        fvi_expression_free(o[i].u);
        fvi_expression_free(o[i].f);
    }
}

/* ---- the program ---- */

/* Return the processor time in seconds of all processes of the program so far. */
static double children(void)
{
    struct rusage r;
    getrusage(RUSAGE_CHILDREN, &r);
    return (double)(r.ru_utime.tv_sec + r.ru_stime.tv_sec)
           + 1e-6 * (double)(r.ru_utime.tv_usec + r.ru_stime.tv_usec);
}

static double sweep(const char *words, int steps, int lanes)
{
    char line[400];
    const double start = children();
    snprintf(line, sizeof line,
             "build/fvi sweep --vary x0=-1.5:1.5:40 --vary A=0.1:0.4:40 %s --alpha 0.3 --method fvi-stable --h 0.05 "
             "--steps %d --columns x,p --jobs 1 --lanes %d >/dev/null 2>&1",
             words, steps, lanes);
    check(system(line));
    return children() - start;
}

static void sweep_row(const char *name, const char *words, int steps)
{
    double alone[SWEEPS], together[SWEEPS], ratio[SWEEPS];
    for (size_t turn = 0; turn < SWEEPS; turn++) {
        alone[turn] = sweep(words, steps, 1);
        together[turn] = sweep(words, steps, 8);
        ratio[turn] = alone[turn] / together[turn];
    }
    const double middle = median(SWEEPS, ratio);
    printf("%s, %d steps\t%.2f\t%.2f\t%.1f\t%.1f\t%.1f\n", name, steps, median(SWEEPS, alone),
           median(SWEEPS, together), middle, ratio[0], ratio[SWEEPS - 1]);
    fflush(stdout);
}

int main(void)
{
    static const fvi_method *const methods[] = { &fvi_fractional, &fvi_cq2_midpoint, &fvi_cq_bdf2, &fvi_lobatto_m2,
                                                 &fvi_lobatto_m3, &fvi_lobatto_m4 };
    describe();
    printf("# eight runs together, ns a run and step of %d, the start included\n#> runs\n"
           "# method, potential and force\tone by one\ttogether\ttimes as fast\tleast\tlargest\n", STEPS);
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++)
        for (int from_text = 0; from_text < 2; from_text++)
            row(methods[i], from_text, 0);
    for (int from_text = 0; from_text < 2; from_text++)
        row(&fvi_cq2_midpoint, from_text, 1);
    printf("#< runs\n\n\n# fvi sweep, 1600 runs of fvi-stable in one process, seconds\n#> sweep\n"
           "# potential and force\tone by one\ttogether\ttimes as fast\tleast\tlargest\n");
    for (int steps = 200; steps <= 2000; steps *= 10) {
        sweep_row("texts", "--potential 'x^4/4 - x^2/2' --force 'A*cos(1.2*t)'", steps);
        sweep_row("ready-made", "--potential duffing:-1,1 --force 'cosine:0.3,1.2 + A'", steps);
    }
    sweep_row("pendulum", "--potential pendulum:1 --force 'cosine:0.3,1.2 + A'", 2000);
    printf("#< sweep\n\n\n");
    return EXIT_SUCCESS;
}
