/* tests/program/test_fvi_six.c -- Six mechanisms of the manual: the program prints the digits of the library and of
 * an independent program.
 * Run alone: make test-fvi_six */
#define _GNU_SOURCE
#include <fvi/fvi.h>
#include "program.h"

enum { MOST = 4 };

/* `want` at the last row, to `error`: of order 2 from the rows of a program with the same steps (its node
 * scheme), else from sums of 120 exponentials and Radau's method at 1e-11. */
typedef struct {
    const char *words; /* of the program but for the texts */
    const char *lagrangian, *damper[MOST], *constraint[MOST], *force, *event;
    size_t d, dampers, constraints;
    double x0[MOST], v0[MOST];
    const fvi_method *method;
    double h;
    size_t steps;
    double want[2 * MOST], error;
    double impacts[2];
} mechanism;

static mechanism six[] = {
    { .words = "--x0 1.2,0 --v0 0.3,0.8 --h 0.1 --steps 40 --method fvi-stable",
      .lagrangian = "(v1^2+v2^2)/2 - 2*(sqrt(x1^2+x2^2)-1)^2 - x2",
      .damper = { "sqrt(x1^2+x2^2) : power:0.4,0.3" },
      .d = 2, .dampers = 1, .x0 = { 1.2, 0 }, .v0 = { 0.3, 0.8 },
      .method = &fvi_cq2_midpoint, .h = 0.1, .steps = 40,
      .want = { -0.5769877459681192, -1.149984679827903, -0.8587787050117233, 1.1714645807415434 },
      .error = 1e-13 },
    { .words = "--x0 0.2,1.2 --v0 0,0.5 --method fvi-lobatto4 --h 0.1 --steps 40",
      .lagrangian = "3*v1^2/2 + v1*v2*cos(x2) + v2^2/2 + cos(x2) - x1^2/2",
      .damper = { "x1 : power:0.3,0.3", "x2 : viscous:0.1" },
      .d = 2, .dampers = 2, .x0 = { 0.2, 1.2 }, .v0 = { 0, 0.5 },
      .method = &fvi_lobatto_m4, .h = 0.1, .steps = 40,
      .want = { 0.127966315868, -0.687174193121, -1.168083274899, 0.048667414128 },
      .error = 3e-9 },
    { .words = "--x0 1,1.5 --v0 0,0.5 --method fvi-lobatto4 --h 0.1 --steps 40",
      .lagrangian = "v1^2 + v2^2/2 + v1*v2*cos(x1-x2) + 2*cos(x1) + cos(x2)",
      .damper = { "wall=x1 : power:0.2,0.3", "elbow=x2-x1 : power:0.3,0.25" },
      .d = 2, .dampers = 2, .x0 = { 1, 1.5 }, .v0 = { 0, 0.5 },
      .method = &fvi_lobatto_m4, .h = 0.1, .steps = 40,
      .want = { -0.883946635396, -0.825565360704, -1.115299534277, -0.850729765153 },
      .error = 2e-8 },
    { .words = "--x0 0.6143077933232609,0.3355978770229421,2.1388456575059656,1.2925640732248969 "
               "--v0 -0.335597877022942,0.614307793323261,0.053624452636355,-0.005760273350408 "
               "--method fvi-lobatto4 --h 0.025 --steps 160",
      .lagrangian = "(v1^2+v2^2)/2 + (v3^2+v4^2) - x2 - 2*x4",
      .damper = { "sqrt((x1-2)^2+x2^2) : power:0.5,0.3" },
      .constraint = { "x1^2+x2^2-0.7^2", "(x3-2)^2+x4^2-1.3^2", "(x1-x3)^2+(x2-x4)^2-1.8^2" },
      .d = 4, .dampers = 1, .constraints = 3,
      .x0 = { 0.6143077933232609, 0.3355978770229421, 2.1388456575059656, 1.2925640732248969 },
      .v0 = { -0.335597877022942, 0.614307793323261, 0.053624452636355, -0.005760273350408 },
      .method = &fvi_lobatto_m4, .h = 0.025, .steps = 160,
      .want = { -0.424597813759, -0.556521964123, 0.888658179658, 0.674477099952, -1.473208805161,
                1.123983019913, -0.329830559301, -0.543464699104 },
      .error = 1e-9 },
    { .words = "--x0 0.5 --v0 0.4 --method fvi-lobatto4 --h 0.1 --steps 60",
      .lagrangian = "v^2/2 - x^2/2", .force = "1=(1-x^2)*v",
      .damper = { "x : power:0.3,0.3" },
      .d = 1, .dampers = 1, .x0 = { 0.5 }, .v0 = { 0.4 },
      .method = &fvi_lobatto_m4, .h = 0.1, .steps = 60,
      .want = { 1.660268711808, 0.406587996447 },
      .error = 5e-8 },
    { .words = "--x0 1 --v0 0 --time 5 --steps 5",
      .lagrangian = "v^2/2 - x", .event = "x : impact:0.8",
      .damper = { "x : power:0.3,0.3" },
      .d = 1, .dampers = 1, .x0 = { 1 }, .v0 = { 0 },
      .method = &fvi_variable_step, .h = 1, .steps = 5,
      .want = { 0.07483486955863, -0.61511788407427 },
      .error = 1e-12,
      .impacts = { 1.488362842713238, 3.559706909650385 } },
};

/* The command line; the last row of what it prints is x and p. */
static void run_program(const mechanism *m)
{
    char line[2000];
    int used = snprintf(line, sizeof line, "run --lagrangian '%s' --columns x,p %s", m->lagrangian, m->words);
    for (size_t j = 0; j < m->dampers; j++)
        used += snprintf(line + used, sizeof line - (size_t)used, " --damper '%s'", m->damper[j]);
    for (size_t j = 0; j < m->constraints; j++)
        used += snprintf(line + used, sizeof line - (size_t)used, " --constraint '%s'", m->constraint[j]);
    if (m->force)
        used += snprintf(line + used, sizeof line - (size_t)used, " --force-on '%s'", m->force);
    if (m->event)
        used += snprintf(line + used, sizeof line - (size_t)used, " --event '%s'", m->event);
    ck_assert_int_lt(used, (int)sizeof line);
    ck_assert_msg(fvi(line) == 0, "%s: %s", line, err);
}

/* The same by functions. */
static fvi_stepper *run_library(const mechanism *m, fvi_typed_mechanism **typed, fvi_typed_events **events,
                                fvi_system *system)
{
    const fvi_mechanism_texts texts = { .lagrangian = m->lagrangian,
                                        .dampers = m->dampers,
                                        .damper = m->damper,
                                        .constraints = m->constraints,
                                        .constraint = m->constraint,
                                        .forces_on = m->force != NULL,
                                        .force_on = &m->force };
    static const double ones[MOST] = { 1, 1, 1, 1 };
    static double p0[MOST];
    fvi_stepper *s;
    ck_assert_int_eq(fvi_parse_mechanism(&texts, m->d, NULL, typed, NULL), 0);
    *system = (fvi_system){ .d = m->d, .mechanism = fvi_mechanism_typed(*typed) };
    ck_assert_int_eq(fvi_momentum_of_velocity(system, 0, m->x0, m->v0, p0), 0);
    fvi_run run = fvi_run_default(system, m->x0, p0, m->h, m->steps);
    *events = NULL;
    if (m->event)
        ck_assert_int_eq(fvi_parse_events(1, &m->event, m->d, ones, NULL, events, NULL), 0);
    fvi_typed_events_of(*events, system->mechanism);
    run.events = fvi_events_typed(*events, &run.event_count);
    ck_assert_int_eq(fvi_stepper_start(m->method, &run, &s, NULL), 0);
    while (s->k < m->steps)
        ck_assert_int_eq(fvi_stepper_step(s), 0);
    return s;
}

START_TEST(six_mechanisms_have_the_same_digits_everywhere)
{
    mechanism *m = six + _i;
    fvi_typed_mechanism *typed;
    fvi_typed_events *events;
    fvi_system system;
    run_program(m);
    fvi_stepper *s = run_library(m, &typed, &events, &system);
    for (size_t i = 0; i < 2 * m->d; i++) {
        const double got = cell(m->steps, i), mine = i < m->d ? s->x[i] : s->p[i - m->d];
        ck_assert_ulp(got, mine, 0, "mechanism %d, column %zu", _i, i);
        ck_assert_near(got, m->want[i], m->error, "mechanism %d, column %zu", _i, i);
    }
    size_t n;
    const fvi_event_time *at = fvi_stepper_events(s, &n);
    ck_assert_uint_eq(n, m->event ? 2 : 0);
    for (size_t i = 0; i < n; i++)
        ck_assert_near(at[i].t, m->impacts[i], 1e-12, "impact %zu", i);
    fvi_stepper_free(s);
    fvi_typed_events_free(events);
    fvi_typed_mechanism_free(typed);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("the program fvi: six mechanisms");
    ADD_LOOP(suite, six_mechanisms_have_the_same_digits_everywhere, LEN(six));
    return run_suite_of_program(suite);
}
