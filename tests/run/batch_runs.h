/* tests/run/batch_runs.h -- Oscillators whose runs go together, for the tests of batches. */
#ifndef BATCH_RUNS_H
#define BATCH_RUNS_H

#include <fvi/fvi.h>
#include "harness/ulp.h"
#include "run/whole_run.h"
#include "system/seeded.h"

#include <stdlib.h>

/* An oscillator and its run. */
typedef struct {
    double x0, p0, mass, rho, cg[2], aw[2];
    fvi_system system;
} oscillator;

/* Between a and b, anywhere. */
static inline double between(double a, double b)
{
    static uint64_t seed = 1;
    return fvi_seeded_uniform(&seed, a, b);
}

static inline void fill(oscillator *o)
{
    *o = (oscillator){ .x0 = between(-1.5, 1.5),
                       .p0 = between(-1, 1),
                       .mass = 1,
                       .rho = 0.2,
                       .cg = { -1, between(0.5, 1.5) },
                       .aw = { between(0, 0.5), 1.2 } };
}

static inline fvi_run run_of(const oscillator *o, double alpha, size_t steps)
{
    fvi_run run = fvi_run_default(&o->system, &o->x0, &o->p0, 0.05, steps);
    run.alpha = alpha;
    return run;
}

static inline void put_together(oscillator *o, fvi_potential potential, fvi_force force)
{
    o->system = (fvi_system){ .d = 1, .mass = &o->mass, .damping = &o->rho, .potential = potential, .force = force };
}

/* Two wells and a cosine: h is 0.05, alpha 0.3. */
static inline void fill_wells(size_t count, oscillator *o, fvi_run *run, size_t steps)
{
    for (size_t i = 0; i < count; i++) {
        fill(o + i);
        put_together(o + i, fvi_potential_duffing(o[i].cg), fvi_force_cosine(o[i].aw));
        run[i] = run_of(o + i, 0.3, steps);
    }
}

/* x and p of each step, from one run; those of the other lanes are `stride` apart. */
static inline int single(const fvi_method *method, const fvi_run *run, size_t stride, double *x, double *p)
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
static inline void compare(const fvi_method *method, size_t count, const fvi_run *run)
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

#endif
