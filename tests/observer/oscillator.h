/* tests/observer/oscillator.h -- The forces that an oscillator with one damper tells, and the laws of the reference. */
#ifndef OBSERVER_OSCILLATOR_H
#define OBSERVER_OSCILLATOR_H

#include "harness/ulp.h"

#include <fvi/fvi.h>
#include <fvi/observer.h>

#include "observer_laws_ref.h"

static const double one = 1, none = 0, stiffness = 2, h = 1.0 / 64;

/* Law i of the reference: one term, and a dashpot. */
typedef struct {
    fvi_kernel_term term[2];
    fvi_kernel kernel;
} law;

static inline void make_law(size_t i, law *to)
{
    to->term[0] = (fvi_kernel_term){ .kind = (fvi_kernel_kind)ref_laws[i].kind,
                                     .rho = ref_laws[i].rho,
                                     .alpha = ref_laws[i].alpha,
                                     .time = ref_laws[i].time,
                                     .end = ref_laws[i].end };
    to->term[1] = (fvi_kernel_term){ .kind = FVI_KERNEL_POWER, .rho = ref_laws[i].dashpot, .alpha = 0.5 };
    to->kernel = (fvi_kernel){ .count = ref_laws[i].dashpot > 0 ? 2 : 1, .term = to->term };
}

typedef enum { BY_ALPHA, BY_LAW, BY_DAMPER, BY_ELONGATION } damped_by; /* by an alpha: one power only */

/* z = x, as a function. */
static inline int stretch(double t, size_t d, const double *x, void *params, double *z)
{
    (void)t, (void)d, (void)params;
    *z = x[0];
    return 0;
}

static inline int stretch_gradient(double t, size_t d, const double *x, void *params, double *G)
{
    (void)t, (void)d, (void)x, (void)params;
    G[0] = 1;
    return 0;
}

static inline int stretch_hessian(double t, size_t d, const double *x, double lambda, void *params, double *H)
{
    (void)t, (void)d, (void)x, (void)lambda, (void)params, (void)H;
    return 0;
}

/* The forces of all rows of a run with one damper of one force. */
static inline void tell_forces(const fvi_method *method, const fvi_run *run, double *force)
{
    fvi_stepper *s;
    fvi_observer *o;
    fvi_observation now;
    fvi_error error = { 0 };
    ck_assert_msg(fvi_stepper_start(method, run, &s, &error) == 0, "%s: %s", method->name, error.text);
    ck_assert_msg(fvi_observer_start(s, FVI_OBSERVE_FORCE, &o, &error) == 0, "%s", error.text);
    for (size_t k = 0; k <= run->steps; k++) {
        ck_assert_int_eq(k > 0 ? fvi_observer_step(o, s) : 0, 0);
        ck_assert_int_eq(fvi_observer_read(o, s, (double)k * run->h, &now), 0);
        force[k] = now.force[0];
    }
    fvi_observer_free(o);
    fvi_stepper_free(s);
}

/* The forces of rows 0 to `rows` of a run with steps of `step`. 0: the method does not take the law. */
static inline int forces(const fvi_method *method, damped_by way, const fvi_kernel *kernel, fvi_initial_history past,
                         double x0, double v0, double step, size_t rows, double *force)
{
    const fvi_damper damper = { .of = { .row = way == BY_DAMPER ? &one : NULL,
                                        .value = stretch,
                                        .gradient = stretch_gradient,
                                        .hessian = stretch_hessian },
                                .kernel = kernel,
                                .past = past };
    const fvi_mechanism mechanism = { .damper = &damper, .damper_count = 1 };
    const fvi_system system = { .d = 1,
                                .mass = &one,
                                .damping = way == BY_ALPHA ? &kernel->term->rho
                                           : way == BY_LAW ? &one
                                                           : &none,
                                .potential = fvi_potential_harmonic(&stiffness),
                                .mechanism = way <= BY_LAW ? NULL : &mechanism };
    fvi_run run = fvi_run_default(&system, &x0, &v0, step, rows);
    run.law = way == BY_LAW ? kernel : NULL;
    run.alpha = kernel->term->alpha;
    run.past = past;
    if (way > BY_LAW && !method->takes_mechanism)
        return 0;
    tell_forces(method, &run, force);
    return 1;
}

static inline int takes_laws(const fvi_method *method)
{
    return method->takes_laws && !method->dense;
}

enum { ROWS = 13 };

#endif
