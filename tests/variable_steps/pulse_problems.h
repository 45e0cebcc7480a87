/* tests/variable_steps/pulse_problems.h -- Random pulses that steps could pass over: how
 * much of the wanted error is used. */
#ifndef PULSE_PROBLEMS_H
#define PULSE_PROBLEMS_H

#include "adaptive_problems.h"
#include "run/whole_run.h"
#include "error_control/variable_step_search.h"
#include "error_control/step_search.h"

enum { PULSE_ROWS = 20, PULSE_TIMES = 2 * 40 + 1, PULSE_TEXT = 200 };

typedef struct {
    double width, centre, impulse, alpha, error, x0, p0;
    char text[PULSE_TEXT];
    double want[PULSE_ROWS + 1], x[PULSE_ROWS + 1];
    int status;
    double estimate;
} pulse_problem;

static const double pulse_end = 20, pulse_mass = 1, pulse_rho = 0.2,
                    pulse_spring = 1;

/* A width between 1e-6 and 1e-1, at any time; at rest, or moving; alone, or beside a force
 * that everybody sees. */
static inline void draw_pulse(gsl_rng *r, pulse_problem *q)
{
    static const double orders[] = { 0, 0.1, 0.3, 0.5, 0.6, 0.75, 0.9, 1 };
    static const char *const shapes[] = {
        "%.17g*exp(-((t-%.17g)/%.17g)^2)",
        "%.17g/cosh((t-%.17g)/%.17g)^2",
        "%.17g/(1+((t-%.17g)/%.17g)^2)",
        "%.17g*exp(-((t-%.17g)/%.17g)^2)*cos(3*t)",
        "cos(t)+%.17g/(1+((t-%.17g)/%.17g)^2)^2",
        "%.17g*(1-tanh((t-%.17g)/%.17g)^2)*(2+sin(t))",
    };
    const int moving = (int)gsl_rng_uniform_int(r, 2);
    *q = (pulse_problem){ .width = decades(r, 1e-6, 1e-1),
                          .centre = between(r, 0.3, pulse_end - 0.3),
                          .impulse = decades(r, 1e-4, 10),
                          .alpha = orders[gsl_rng_uniform_int(r, 8)],
                          .error = decades(r, 1e-9, 1e-4) };
    q->x0 = moving ? between(r, -1, 1) : 0;
    q->p0 = moving ? between(r, -1, 1) : 0;
    snprintf(q->text, sizeof q->text, shapes[gsl_rng_uniform_int(r, 6)],
             q->impulse / q->width, q->centre, q->width);
}

/* The truth: a finer run whose steps must end close to the pulse on both sides, and ever
 * farther apart away from it. */
static inline int pulse_truth(pulse_problem *q, fvi_system system, fvi_run run)
{
    double times[PULSE_TIMES] = { q->centre };
    size_t n = 1;
    for (double away = 0.4 * q->width; away < pulse_end; away *= 3) {
        times[n++] = q->centre - away;
        times[n++] = q->centre + away;
    }
    system.force.jumps = times;
    system.force.jump_count = n;
    system.force.bound = NULL;
    run.system = &system;
    run.step_error = q->error / 1000;
    return fvi_trajectory(&fvi_variable_step, &run, q->want, NULL, NULL);
}

/* The error of the rows over what is wanted. method: NULL for steps of any length. */
static inline double used_by_pulse(pulse_problem *q, const fvi_method *method)
{
    static const fvi_symbols names = { "t", 1, NULL, 0 };
    fvi_expression *e;
    if (fvi_expression_parse(q->text, &names, NULL, &e, NULL))
        return GSL_NAN;
    const fvi_system system = { .d = 1,
                                .mass = &pulse_mass,
                                .damping = &pulse_rho,
                                .potential =
                                    fvi_potential_harmonic(&pulse_spring),
                                .force = fvi_force_expression(e) };
    fvi_run run = fvi_run_default(&system, &q->x0, &q->p0,
                                  pulse_end / PULSE_ROWS, PULSE_ROWS);
    run.alpha = q->alpha;
    /* t is rounded: a pulse is moved by that, and its height at each time */
    q->error = larger(q->error, 1e-13 * q->impulse / q->width);
    double worst = 0;
    int status = pulse_truth(q, system, run);
    if (method) {
        fvi_step_found found = { 0 };
        q->status = fvi_step_search(method, &run, q->error, 1 << 20, q->x, NULL,
                                    &found);
        q->estimate = found.estimate;
    } else {
        fvi_variable_step_found found = { 0 };
        q->status = fvi_variable_step_search(&run, 0, NULL, q->error, 1 << 22, q->x, NULL,
                                        &found);
        q->estimate = found.estimate;
    }
    for (size_t k = 0; k <= PULSE_ROWS && !q->status; k++)
        worst = larger(worst, fabs(q->x[k] - q->want[k]));
    fvi_expression_free(e);
    return status ? GSL_NAN : worst / q->error;
}

static inline void describe_pulse(const pulse_problem *q, char *text,
                                  size_t size)
{
    snprintf(text, size,
             "F = %s, alpha = %g, x0 = %.17g, p0 = %.17g, error %g: status %d, "
             "estimate %g",
             q->text, q->alpha, q->x0, q->p0, q->error, q->status, q->estimate);
}

#endif
