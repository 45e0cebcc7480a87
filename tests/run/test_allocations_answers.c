/* tests/run/test_allocations_answers.c -- Loads, warnings, controls, moduli, responses and poles in which one
 * allocation fails.
 * Run alone: make test-allocations_answers */
#include <fvi/stability.h>
#include "each_allocation_fails.h"

static int load(const fvi_method *method)
{
    fvi_system system;
    const fvi_run run = run_of(&system, NULL);
    double growth;
    return fvi_stability_number(method, &run, &growth);
}

/* U = (x_1 + ... + x_d)^2 / 2: each mass pulls at each, so the Hessian is full. */
static int sum_gradient(size_t d, const double *x, void *params, double *g)
{
    double sum = 0;
    (void)params;
    for (size_t i = 0; i < d; i++)
        sum += x[i];
    for (size_t i = 0; i < d; i++)
        g[i] = sum;
    return 0;
}

static int sum_value(size_t d, const double *x, void *params, double *value)
{
    double sum = 0;
    (void)params;
    for (size_t i = 0; i < d; i++)
        sum += x[i];
    *value = sum * sum / 2;
    return 0;
}

static int sum_hessian(size_t d, const double *x, void *params, double *H)
{
    (void)x, (void)params;
    for (size_t i = 0; i < d * d; i++)
        H[i] = 1;
    return 0;
}

static int load_of_full(const fvi_method *method)
{
    fvi_system system;
    fvi_run run = run_of(&system, NULL);
    double growth;
    system.potential = (fvi_potential){ .value = sum_value,
                                        .gradient = sum_gradient,
                                        .hessian = sum_hessian };
    run.kappa = 1;
    return fvi_stability_number(method, &run, &growth);
}

/* Of an unstable step, of a place where it is one, and of a tolerance that only the modes of a law would read. */
static int warnings(const fvi_method *method)
{
    static const double far[] = { 9, -9, 9 };
    static const fvi_kernel_term zener = { .kind = FVI_KERNEL_ZENER, .rho = 1, .alpha = 0.3, .time = 1 };
    static const fvi_kernel law = { 1, &zener };
    char text[FVI_WARNING_ROOM];
    fvi_system system;
    fvi_run run = run_of(&system, NULL);
    run.kappa = 1;
    run.h = 9;
    fvi_watch watch = { 0, 1 };
    const int at_start =
                  fvi_warning_of_step(method, &run, sizeof text, text),
              along = fvi_warning_along(&watch, method, &run, 1, far,
                                        sizeof text, text);
    run.law = &law;
    run.tolerance = 1e-6;
    const int of_memory = fvi_warning_of_memory(method, &run, sizeof text, text);
    return at_start < 0 || along < 0 || of_memory < 0       ? FVI_ENOMEM
           : at_start == 1 && along == 1 && of_memory == 0 ? 0
                                                           : -1;
}

static int control(const fvi_method *method)
{
    enum { N = 20 };
    fvi_system system;
    fvi_run run = run_of(&system, NULL);
    double u[3 * (N + 1)];
    fvi_control_result found;
    run.steps = N;
    return fvi_control_solve(method, &run, x0, p0, u, &found);
}

static int moduli(const fvi_method *method)
{
    double w[10], storage[10], loss[10];
    fvi_estimate fitted;
    (void)method;
    for (size_t i = 0; i < LEN(w); i++) {
        w[i] = 1 + (double)i;
        storage[i] = 2 + 0.1 * (double)i;
        loss[i] = 0.5 + 0.2 * (double)i;
    }
    return fvi_estimate_moduli(LEN(w), w, storage, loss, &fitted);
}

/* Responses and poles of one oscillator and of chains, by dense and by sparse factors. */
static int linear(const fvi_method *method)
{
    static const size_t sizes[] = { 1, 5, 257 };
    static double masses[300], dampings[300];
    static const double spring[2] = { 1, 0 }, omega = 0.7;
    int status = FVI_SUCCESS;
    if (method != fvi_methods[0])
        return -1; /* it is of none */
    for (size_t i = 0; i < LEN(masses); i++) {
        masses[i] = 1;
        dampings[i] = i % 2 ? 0.1 : 0;
    }
    dampings[0] = 0.5;
    for (size_t l = 0; !status && l < LEN(sizes); l++) {
        const fvi_system system = { .d = sizes[l],
                                    .mass = masses, .damping = dampings,
                                    .potential = fvi_potential_chain(spring) };
        const fvi_linear_motion motion = { .system = &system, .alpha = 0.3 };
        fvi_response *response = NULL;
        fvi_poles poles = { 0 };
        double H[2];
        status = fvi_response_alloc(&motion, &response, NULL);
        if (!status)
            status = fvi_response_at(response, FVI_RESPONSE_GROUND, 1, &omega, 0, 0, H, NULL);
        if (!status)
            status = fvi_poles_find(response, l < 2 ? 0 : 1, &poles, NULL);
        fvi_poles_free(&poles);
        fvi_response_free(response);
    }
    return status;
}

START_TEST(an_answer_without_memory_says_so)
{
    static const library_call calls[] = { { .make = load },
                                          { .make = load_of_full },
                                          { .make = warnings },
                                          { .make = control },
                                          { .make = moduli },
                                          { .make = linear, .is_long = 1, .may_succeed = 1 } };
    fail_each_allocation(LEN(calls), calls);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("allocations that fail: answers");
    ADD_CASE(suite, "errors", an_answer_without_memory_says_so);
    return run_suite(suite);
}
