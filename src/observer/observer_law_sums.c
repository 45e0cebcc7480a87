/* src/observer/observer_law_sums.c -- The impulses that the steps of a method give for a jump, a line and a parabola.
 * [H 13] */
#include "observer_law.h"

#include "observer_ramp.h"

#include <fvi/dampers.h>

#include <string.h>

/* Bodies so heavy that no damper slows them down. The first one starts with the velocity 1, the second one falls with
 * the acceleration 1, and the third one rests at 1. So they move along x_1 = t, x_2 = t^2/2 and x_3 = 1. */
#define HEAVY 1e150
static const double mass[] = { HEAVY, HEAVY, HEAVY }, start[] = { 0, 0, 1 }, momentum[] = { HEAVY, 0, 0 };

static int potential(size_t d, const double *x, void *params, double *value)
{
    (void)d, (void)params;
    *value = -HEAVY * x[1];
    return 0;
}

static int gradient(size_t d, const double *x, void *params, double *grad)
{
    (void)x, (void)params;
    for (size_t i = 0; i < d; i++)
        grad[i] = i == 1 ? -HEAVY : 0;
    return 0;
}

static int hessian(size_t d, const double *x, void *params, double *H)
{
    (void)x, (void)params;
    memset(H, 0, d * sizeof *H);
    return 0;
}

static int is_quadratic(const void *params)
{
    (void)params;
    return 1;
}

static const fvi_potential fall = {
    .value = potential, .gradient = gradient, .hessian = hessian, .quadratic = is_quadratic, .diagonals = 1
};

/* For methods whose steps keep the impulse of each damper. */
static int sum_by_dampers(const fvi_stepper *of, const fvi_summed_damper *summed, size_t rows, fvi_law_row *row)
{
    const fvi_kernel power = { .count = 1, .term = &summed->power }, *law = summed->law ? summed->law : &power;
    static const double line[] = { 1, 0, 0 }, parabola[] = { 0, 1, 0 }, jump[] = { 0, 0, 1 }, none[] = { 0, 0, 0 };
    const fvi_initial_history held = FVI_INITIAL_HISTORY_HELD, rl = FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE;
    const fvi_damper damper[] = { { .of.row = line, .kernel = law, .past = held },
                                  { .of.row = parabola, .kernel = law, .past = held },
                                  { .of.row = jump, .kernel = law, .past = rl } };
    const int takes_jump = of->method->scheme == FVI_SCHEME_FVI && fvi_kernel_growth(law) <= 1;
    const size_t d = takes_jump ? 3 : 2;
    const fvi_mechanism mechanism = { .damper = damper, .damper_count = d };
    const fvi_system system = {
        .d = d, .mass = mass, .damping = none, .potential = fall, .mechanism = &mechanism
    };
    fvi_run run = fvi_run_default(&system, start, momentum, of->run.h, rows);
    fvi_stepper *s;
    double work;
    run.kappa = of->run.kappa;
    int status = fvi_stepper_start(of->method, &run, &s, NULL);
    if (status)
        return status;
    for (size_t k = 0; k < rows && !status; k++, row++) {
        status = fvi_stepper_step(s);
        if (!status)
            status = fvi_stepper_damper(s, 0, &row->summed[FVI_LINE], &work);
        if (!status)
            status = fvi_stepper_damper(s, 1, &row->summed[FVI_PARABOLA], &work);
        if (!status && takes_jump)
            status = fvi_stepper_damper(s, 2, &row->summed[FVI_JUMP], &work);
    }
    fvi_stepper_free(s);
    return status;
}

/* For convolution quadrature of order 2, without a mechanism. The observer corrects the impulse of the line (13.18), so
 * it is the exact one. */
static int sum_by_quadrature(const fvi_stepper *of, const fvi_summed_damper *summed, size_t rows, fvi_law_row *row)
{
    const double rho = summed->law ? 1 : summed->power.rho, damping[] = { rho, rho };
    const fvi_system system = { .d = 2, .mass = mass, .damping = damping, .potential = fall };
    fvi_run run = fvi_run_default(&system, start, momentum, of->run.h, rows);
    fvi_stepper *s;
    double J[] = { 0, 0 };
    run.law = summed->law;
    run.alpha = summed->power.alpha;
    run.kappa = of->run.kappa;
    int status = fvi_stepper_start(fvi_ramp_method(of), &run, &s, NULL);
    if (status)
        return status;
    for (size_t k = 0; k < rows && !status; k++, row++) {
        status = fvi_ramp_step_prescribed(s, J);
        row->summed[FVI_LINE] = row->exact[FVI_LINE + 1];
        row->uncorrected_line = J[0];
        row->summed[FVI_PARABOLA] = J[1];
    }
    fvi_stepper_free(s);
    return status;
}

int fvi_law_sums(const fvi_stepper *s, const fvi_summed_damper *of, size_t rows, fvi_law_row *first)
{
    return (fvi_ramp_method(s) ? sum_by_quadrature : sum_by_dampers)(s, of, rows, first);
}
