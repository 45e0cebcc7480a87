/* tests/lagrangian/mechanisms.h -- Mechanisms of one line each, and their runs. */
#ifndef MECHANISMS_H
#define MECHANISMS_H

#include <fvi/fvi.h>

#include <check.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/seen.h"
#include "harness/ulp.h"

enum { MOST_TEXTS = 4, MOST_D = 8 };

/* A problem of section 11, in texts; v0 is its velocity. */
typedef struct {
    const char *name;
    size_t d;
    const char *lagrangian;
    const char *damper[MOST_TEXTS], *constraint[MOST_TEXTS], *imposed[MOST_TEXTS],
        *force_on[MOST_TEXTS];
    double x0[MOST_D], v0[MOST_D];
} mechanism_text;

typedef struct {
    fvi_typed_mechanism *typed;
    fvi_system system;
    double x0[MOST_D], p0[MOST_D];
} mechanism_problem;

static inline size_t count_of(const char *const *texts)
{
    size_t n = 0;
    while (n < MOST_TEXTS && texts[n])
        n++;
    return n;
}

static inline int parse_texts(const mechanism_text *t, fvi_typed_mechanism **m,
                              fvi_error *error)
{
    const fvi_mechanism_texts texts = { .lagrangian = t->lagrangian,
                                        .dampers = count_of(t->damper),
                                        .damper = t->damper,
                                        .constraints = count_of(t->constraint),
                                        .constraint = t->constraint,
                                        .imposed = count_of(t->imposed),
                                        .impose = t->imposed,
                                        .forces_on = count_of(t->force_on),
                                        .force_on = t->force_on };
    return fvi_parse_mechanism(&texts, t->d, NULL, m, error);
}

static inline void open_problem(const mechanism_text *t, mechanism_problem *p)
{
    fvi_error error = { 0 };
    ck_assert_msg(parse_texts(t, &p->typed, &error) == 0, "%s: %s", t->name,
                  error.text);
    p->system = (fvi_system){ .d = t->d,
                              .mechanism = fvi_mechanism_typed(p->typed) };
    memcpy(p->x0, t->x0, sizeof p->x0);
    ck_assert_int_eq(
        fvi_momentum_of_velocity(&p->system, 0, t->x0, t->v0, p->p0), 0);
}

static inline void close_problem(mechanism_problem *p)
{
    fvi_typed_mechanism_free(p->typed);
}

static inline fvi_run run_of(const mechanism_problem *p, double h, size_t steps)
{
    return fvi_run_default(&p->system, p->x0, p->p0, h, steps);
}

/* The stepper at k = `at` of a run of `steps` steps of h; an error ends the test. */
static inline fvi_stepper *stepper_at(const fvi_method *method,
                                      const mechanism_problem *p, double h,
                                      size_t steps, size_t at)
{
    const fvi_run run = run_of(p, h, steps);
    fvi_error error = { 0 };
    fvi_stepper *s;
    const int status = fvi_stepper_start(method, &run, &s, &error);
    ck_assert_msg(status == 0, "%s: %d %s: %s", method->name, status,
                  error.field ? error.field : "", error.text);
    while (s->k < at) {
        const int code = fvi_stepper_step(s);
        ck_assert_msg(code == 0, "%s: step %zu: %s", method->name, s->k + 1,
                      fvi_error_name(code));
    }
    return s;
}

#endif
