/* tests/run/test_allocations.c -- Runs, batches and gradients in which one allocation fails.
 * Run alone: make test-allocations */
#include <fvi/adjoint.h>
#include <fvi/dampers.h>
#include <fvi/exact_motion.h>
#include <fvi/stability.h>
#include <fvi/structures.h>
#include "each_allocation_fails.h"

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

/* A distributed law has the most modes, so it takes the most time. Methods with five stages or more do without it: they
 * run the same code as the methods with four. */
static int life_of_structure(const fvi_method *method)
{
    static const fvi_triplet ones[] = { { 0, 0, 2 }, { 1, 1, 2 }, { 2, 2, 2 } };
    static const double row[] = { -1, 1, 0 };
    static const fvi_kernel_term terms[] = {
        { .kind = FVI_KERNEL_DISTRIBUTED, .rho = 0.5, .alpha = 0.1, .end = 0.8 },
        { .kind = FVI_KERNEL_MAXWELL2, .rho = 0.5, .alpha = 0.9, .time = 1, .end = 0.7 },
        { .kind = FVI_KERNEL_POWER, .rho = 0.5, .alpha = 0.7 }
    };
    const int is_distributed = method->stages <= 4;
    const fvi_kernel law = { 1, is_distributed ? terms : terms + 1 }, power = { 1, terms + 2 };
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

START_TEST(a_call_without_memory_says_so)
{
    static const library_call calls[] = { { .make = life },
                                          { .make = life_with_a_law },
                                          { .make = life_of_mechanism },
                                          { .make = life_of_structure },
                                          { .make = life_of_walls, .is_long = 1 },
                                          { .make = life_of_batch } };
    fail_each_allocation(LEN(calls), calls);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("allocations that fail");
    ADD_CASE(suite, "errors", a_call_without_memory_says_so);
    return run_suite(suite);
}
