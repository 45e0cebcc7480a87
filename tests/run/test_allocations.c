/* tests/run/test_allocations.c -- Of all allocations within a call of the library one fails: the
 * call says FVI_ENOMEM, nothing ends the process, and no block is left.
 * Run alone: make test-allocations
 *
 * Where a sanitizer brings its own allocator nothing is tested. */
#include <fvi/adjoint.h>
#include <fvi/dampers.h>
#include <fvi/exact_motion.h>
#include <fvi/fvi.h>
#include <fvi/stability.h>
#include <fvi/structures.h>
#include "harness/ulp.h"
#include "run/whole_run.h"
#include "failing_allocator.h"

/* ---- calls ---- */

static double mass[] = { 1, 2, 1 }, rho[] = { 0.3, 0.2, 0.1 },
                    x0[] = { 1, 0, 0.5 }, p0[] = { 0.5, 0.1, 0 },
                    cg[] = { 1, 0.5 };

static fvi_run run_of(fvi_system *system, const fvi_kernel *law)
{
    *system = (fvi_system){ .d = 3,
                            .mass = mass,
                            .damping = rho,
                            .potential = fvi_potential_chain(cg) };
    fvi_run run = fvi_run_default(system, x0, p0, 0.1, 80);
    run.alpha = law ? 0.5 : 0.3;
    run.law = law;
    return run;
}

static int whole_life(const fvi_method *method, const fvi_kernel *law)
{
    fvi_system system;
    const fvi_run run = run_of(&system, law);
    fvi_stepper *s, *copy;
    int status = fvi_stepper_start(method, &run, &s, NULL);
    if (status)
        return status;
    for (size_t k = 0; k < 3 && !status; k++)
        status = fvi_stepper_step(s);
    if (!status)
        status = fvi_stepper_copy(s, &copy);
    if (!status) {
        status = fvi_stepper_step(copy);
        fvi_stepper_free(copy);
    }
    if (!status)
        status = fvi_stepper_reset(s);
    fvi_stepper_free(s);
    return status;
}

static int life(const fvi_method *method)
{
    return whole_life(method, NULL);
}

static int life_with_a_law(const fvi_method *method)
{
    static const fvi_kernel_term terms[] = {
        { .kind = FVI_KERNEL_DISTRIBUTED, .rho = 0.5, .alpha = 0.1, .end = 0.4 },
        { .kind = FVI_KERNEL_MAXWELL, .rho = 0.5, .alpha = 0.3, .time = 1 }
    };
    static const fvi_kernel law = { LEN(terms), terms };
    return whole_life(method, &law);
}

/* A mechanism of texts, from its parsing to the end of a run: a strut of two laws, whose start has a
 * velocity, and where the method takes it a rod. */
static int life_of_mechanism(const fvi_method *method)
{
    static const char *const dampers[] = {
        "sqrt(x1^2+x2^2) : power:0.4,0.7 + distributed:0.1,0.2,0.8",
        "x2 : zener:1,0.3,2"
    }, *const constraints[] = { "x1+x2-1" };
    const int takes = method->takes_mechanism
                      && (method->scheme == FVI_SCHEME_CQ2_MIDPOINT
                          || (method->stages && !method->damped_inertia));
    const fvi_mechanism_texts texts = {
        .lagrangian = "(v1^2+v2^2)/2 - x2",
        .dampers = 2,
        .damper = dampers,
        .constraints = takes ? 1 : 0,
        .constraint = constraints
    };
    fvi_typed_mechanism *typed;
    const double begin[] = { 1, 0 }, momenta[] = { 0.5, -0.5 };
    if (!method->takes_mechanism)
        return FVI_SUCCESS;
    int status = fvi_parse_mechanism(&texts, 2, NULL, &typed, NULL);
    if (status)
        return status;
    const fvi_system system = { .d = 2,
                                .mechanism = fvi_mechanism_typed(typed) };
    const fvi_run run = fvi_run_default(&system, begin, momenta, 0.1, 80);
    fvi_stepper *s = NULL, *copy = NULL;
    double E;
    status = fvi_stepper_start(method, &run, &s, NULL);
    for (size_t k = 0; k < 2 && !status; k++)
        status = fvi_stepper_step(s);
    if (!status)
        status = fvi_stepper_energy(s, &E);
    if (!status)
        status = fvi_stepper_copy(s, &copy);
    if (!status)
        status = fvi_stepper_step(copy);
    fvi_stepper_free(copy);
    fvi_stepper_free(s);
    fvi_typed_mechanism_free(typed);
    return status;
}

static int no_slopes(size_t k, size_t d, const double *x, const double *p, void *params,
                     double *Jx, double *Jp)
{
    (void)k, (void)d, (void)x, (void)params;
    *Jx = 1;
    if (p)
        *Jp = 1;
    return 0;
}

/* A structure with a damper along a row and one by a matrix, a law above the order 1 with a velocity at
 * the start: a run, its copy and its sums, the adjoint, the load, and once the exact motion. */
static int use_structure(const fvi_method *method, const fvi_system *system)
{
    fvi_run run = fvi_run_default(system, x0, p0, 0.1, 30);
    fvi_stepper *s = NULL, *copy = NULL;
    double number, by[3];
    int status = fvi_stepper_start(method, &run, &s, NULL);
    if (!status)
        status = fvi_stepper_keep_dampers(s);
    for (size_t k = 0; k < 2 && !status; k++)
        status = fvi_stepper_step(s);
    if (!status)
        status = fvi_stepper_copy(s, &copy);
    fvi_stepper_free(copy);
    fvi_stepper_free(s);
    if (!status)
        status = fvi_stability_number(method, &run, &number);
    const fvi_objective J = { .slopes = no_slopes };
    const fvi_sensitivities want = { .p0 = by };
    if (!status && method->scheme != FVI_SCHEME_CQ2_SHIFTED)
        status = fvi_adjoint(method, &run, NULL, NULL, &J, &want);
    const fvi_exact_problem problem = { .motion = { .system = system },
                                        .x0 = x0,
                                        .p0 = p0,
                                        .forcing = FVI_FORCING_STEP,
                                        .A = 1,
                                        .T = 1 };
    fvi_exact_motion *motion = NULL;
    number = 2;
    if (!status && method->scheme == FVI_SCHEME_FVI)
        status = fvi_exact_motion_alloc(&problem, &motion, NULL);
    if (!status && motion)
        status = fvi_exact_motion_at(motion, 1, &number, by, NULL, NULL);
    fvi_exact_motion_free(motion);
    return status;
}

/* The forces of dampers in J, which make a run with walls, and the number of a law. */
static int derivatives_of_forces(const fvi_method *method, const fvi_run *run, int has_alpha)
{
    double force[9 * 5], by_x0[3], by_alpha;
    const fvi_objective J = { .slopes = no_slopes };
    const fvi_sensitivities want = { .x0 = by_x0, .alpha = has_alpha ? &by_alpha : NULL };
    for (size_t i = 0; i < LEN(force); i++)
        force[i] = 1;
    return fvi_adjoint_forces(method, run, &J, force, force, &want);
}

static int life_of_walls(const fvi_method *method)
{
    static const double none[3], row[] = { -1, 1, 0 }, hit[] = { 0.1, 0.2, 0.3 };
    static const fvi_kernel_term zener = { .kind = FVI_KERNEL_ZENER, .rho = 0.5, .alpha = 0.4, .time = 0.3 };
    static const fvi_kernel law = { 1, &zener };
    static const fvi_impulse impulse = { 0.1, hit };
    static const fvi_triplet ones[] = { { 0, 0, 2 }, { 1, 1, 2 }, { 2, 2, 2 } };
    fvi_system system;
    fvi_sparse A;
    fvi_structure *structure;
    fvi_run run = run_of(&system, NULL);
    run.steps = 4;
    if (method != &fvi_cq2_midpoint && method != &fvi_lobatto_d2)
        return FVI_SUCCESS;
    system.force = (fvi_force){ .impulses = &impulse, .impulse_count = 1 };
    int status = derivatives_of_forces(method, &run, 1);
    fvi_damper dampers[] = { { .of = fvi_elongation_row(row), .kernel = &law }, { .kernel = &law } };
    const fvi_mechanism mechanism = { .damper = dampers, .damper_count = 1 };
    system.damping = none;
    system.mechanism = &mechanism;
    if (!status)
        status = derivatives_of_forces(method, &run, 0);
    if (!status)
        status = fvi_sparse_assemble(3, 3, ones, &A);
    if (status)
        return status;
    dampers[1].matrix = &A;
    status = fvi_structure_alloc_dampers(&A, &A, 2, dampers, &structure, NULL);
    if (!status) {
        system = fvi_structure_system(structure);
        status = derivatives_of_forces(method, &run, 0);
        fvi_structure_free(structure);
    }
    fvi_sparse_free(&A);
    return status;
}

/* Two oscillators together, one of which Newton's method alone does not bring to an end: it has a solver of its own. */
static int life_of_batch(const fvi_method *method)
{
    static const double well[] = { -4, 1 }, aw[] = { 1, 2 }, one = 1, still = 0;
    const fvi_system system = { .d = 1, .mass = &one, .damping = &one, .potential = fvi_potential_duffing(well),
                                .force = fvi_force_cosine(aw) };
    const double h = method->stages ? 0.01 : 1;
    const fvi_run run[] = { fvi_run_default(&system, &one, &one, h, 4), fvi_run_default(&system, &still, &one, h, 4) };
    fvi_batch *batch;
    fvi_stepper *s = NULL, *copy = NULL;
    const int is_asked = method == &fvi_cq2_midpoint || method == &fvi_lobatto_m4;
    if (!is_asked || fvi_batch_refusal(method, 2, run))
        return FVI_SUCCESS;
    int status = fvi_batch_alloc(method, 2, run, &batch, NULL);
    if (status)
        return status;
    status = fvi_stepper_start(method, fvi_batch_run(batch), &s, NULL);
    while (!status && s->k < 2)
        status = fvi_stepper_step(s);
    if (!status)
        status = fvi_stepper_copy(s, &copy);
    if (!status)
        status = fvi_stepper_step(copy);
    fvi_stepper_free(copy);
    fvi_stepper_free(s);
    fvi_batch_free(batch);
    return status;
}

static int life_of_structure(const fvi_method *method)
{
    static const fvi_triplet ones[] = { { 0, 0, 2 }, { 1, 1, 2 }, { 2, 2, 2 } };
    static const double row[] = { -1, 1, 0 };
    static const fvi_kernel_term terms[] = {
        { .kind = FVI_KERNEL_DISTRIBUTED, .rho = 0.5, .alpha = 0.1, .end = 0.8 },
        { .kind = FVI_KERNEL_POWER, .rho = 0.5, .alpha = 0.7 }
    };
    static const fvi_kernel law = { 1, terms }, power = { 1, terms + 1 };
    fvi_sparse A;
    if (!method->takes_matrices)
        return FVI_SUCCESS;
    int status = fvi_sparse_assemble(3, 3, ones, &A);
    if (status)
        return status;
    const fvi_damper dampers[] = { { .of = fvi_elongation_row(row), .kernel = &law },
                                   { .matrix = &A, .kernel = &power } };
    fvi_structure *structure;
    status = fvi_structure_alloc_dampers(&A, &A, 2, dampers, &structure, NULL);
    if (!status) {
        const fvi_system system = fvi_structure_system(structure);
        status = use_structure(method, &system);
        fvi_structure_free(structure);
    }
    fvi_sparse_free(&A);
    return status;
}

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

/* Of an unstable step, and of a place where it is one. */
static int warnings(const fvi_method *method)
{
    static const double far[] = { 9, -9, 9 };
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
    return at_start < 0 || along < 0      ? FVI_ENOMEM
           : at_start == 1 && along == 1 ? 0
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

typedef int call(const fvi_method *method);

START_TEST(a_call_without_memory_says_so)
{
    call *const calls[] = { life, life_with_a_law, life_of_mechanism,
                            life_of_structure, life_of_walls, life_of_batch, load, load_of_full, warnings, control, moduli, linear };
    size_t said = 0;
#ifdef OTHER_ALLOCATOR
    return;
#endif
    for (size_t c = 0; c < LEN(calls); c++)
        for (size_t m = 0; fvi_methods[m]; m++) {
            failing = 0;
            if (calls[c](fvi_methods[m]))
                continue; /* not for this method */
            for (size_t n = 1;; n += calls[c] == linear || calls[c] == life_of_walls ? 1 + n / 8 : 1) {
                made = 0;
                has_failed = 0;
                failing = n;
                const long before = alive;
                const int status = calls[c](fvi_methods[m]);
                const long left = alive - before;
                failing = 0;
                if (!has_failed)
                    break;
                /* UMFPACK may ask for less, and go on */
                ck_assert_msg(status == FVI_ENOMEM || (calls[c] == linear && !status),
                              "call %zu of %s: %zu: %d", c, fvi_methods[m]->name, n, status);
                ck_assert_msg(left == 0, "call %zu of %s: %zu: %ld blocks left",
                              c, fvi_methods[m]->name, n, left);
                said++;
            }
        }
    ck_assert_uint_gt(said, 500);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("allocations that fail");
    ADD_CASE(suite, "errors", a_call_without_memory_says_so);
    return run_suite(suite);
}
