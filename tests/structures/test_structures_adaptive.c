/* tests/structures/test_structures_adaptive.c -- H 27: steps of any length with matrices.
 * Run alone: make test-structures_adaptive */
#include "building.h"
#include "structures_ref.h"
#include "system/larger.h"

enum { ROWS = 6 };

static const double mass[D] = { 1, 2, 0.5, 1.5, 1 }, zeros[D] = { 0 },
                    x0[D] = { 1, 0, -0.5, 0.2, 0.3 }, p0[D] = { 0, 0.3, 0.1, -1, 0.2 },
                    dampings[D] = { 0.3, 0.2, 0.7, 0.1, 0.5 };

static int value(double t, size_t d, void *params, double *F)
{
    (void)params;
    for (size_t i = 0; i < d; i++)
        F[i] = cos(t + (double)i);
    return 0;
}

/* x of all rows. */
static void rows_of(const fvi_run *run, double *x, double *p)
{
    fvi_stepper *s;
    fvi_error error = { 0 };
    const int status = fvi_stepper_start(&fvi_variable_step, run, &s, &error);
    ck_assert_msg(status == FVI_SUCCESS, "%s: %s", error.field, error.text);
    for (size_t k = 0; k < ROWS; k++)
        OK(fvi_stepper_advance_to(s, (double)(k + 1) * run->h, x + k * D, p + k * D));
    fvi_stepper_free(s);
}

/* ---- the exact motion ---- */

/* Between the ends of steps and at the end, against 35 digits. One damper has the order 11/8, and the start a
 * velocity, so steps begin short. The estimate is of the size of a step's error, and those of many steps hardly add
 * up. Seen: 0.13 of the tolerance, or less. */
START_TEST(eq_27_14_the_building_by_steps_of_its_own_to_the_tolerance)
{
    building b;
    build(&b);
    for (double tolerance = 1e-4; tolerance > 1e-13; tolerance /= 10) {
        fvi_run run = run_of(&b.system, 0.5, 0.7, 9, shape, push);
        run.step_error = tolerance;
        fvi_stepper *s;
        double worst = 0;
        OK(fvi_stepper_start(&fvi_variable_step, &run, &s, NULL));
        for (size_t k = 0; k < 3; k++) {
            double x[D], p[D];
            OK(fvi_stepper_advance_to(s, ref_building[k].t, x, p));
            for (size_t i = 0; i < D; i++)
                worst = larger(worst, larger(fabs(x[i] - ref_building[k].x[i]),
                                             fabs(p[i] - ref_building[k].v[i]) / 10));
        }
        ck_assert_msg(worst <= tolerance + 1e-14, "%g: %g", tolerance, worst);
        seen(worst / (tolerance + 1e-14), "error of %g", tolerance);
        fvi_stepper_free(s);
    }
    free_building(&b);
}
END_TEST

/* ---- beside masses and dampings ---- */

/* The same motion as masses and a chain, whose steps are others: both to 1e-10 a step. All pasts, and a law.
 * Seen: 8.5e-13 of 1e-10. */
START_TEST(eq_27_14_diagonal_matrices_by_steps_of_their_own)
{
    static const double alphas[] = { 0, 0.25, 0.5, 0.7 };
    const double spring[] = { 2, 0 };
    const fvi_kernel_term terms[] = { { FVI_KERNEL_POWER, 0.5, 0.3, 0, 0 },
                                      { FVI_KERNEL_MAXWELL, 0.2, 0, 2, 0 } };
    const fvi_kernel law = { 2, terms };
    matrices m;
    double worst = 0;
    diagonal(1, mass, &m.M);
    diagonal(1, dampings, &m.C);
    tridiagonal(D, 4, -2, &m.K);
    make(&m);
    m.system.force = (fvi_force){ .value = value };
    const fvi_system plain = { .d = D,
                               .mass = mass,
                               .damping = dampings,
                               .potential = fvi_potential_chain(spring),
                               .force = m.system.force };
    for (size_t i = 0; i <= LEN(alphas) * 3; i++) {
        const int is_law = i == LEN(alphas) * 3;
        const double alpha = is_law ? 0.5 : alphas[i % LEN(alphas)];
        const fvi_initial_history past =
            is_law ? FVI_INITIAL_HISTORY_HELD : (fvi_initial_history)(i / LEN(alphas));
        const int zero = past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE && alpha > 0.5;
        double x[2][ROWS * D], p[2][ROWS * D];
        fvi_run run = run_of(&plain, alpha, 1, ROWS, zero ? zeros : x0, p0);
        run.past = past;
        run.law = is_law ? &law : NULL;
        run.step_error = 1e-10;
        rows_of(&run, x[0], p[0]);
        run.system = &m.system;
        rows_of(&run, x[1], p[1]);
        double e = 0;
        for (size_t j = 0; j < ROWS * D; j++)
            e = larger(e, larger(fabs(x[0][j] - x[1][j]), fabs(p[0][j] - p[1][j]) / 10));
        ck_assert_msg(e <= 1e-10, "alpha %g past %d: %g", alpha, (int)past, e);
        worst = larger(worst, e);
    }
    seen_worst(worst, "deviation");
    drop(&m);
}
END_TEST

/* ---- wide matrices ---- */

enum { WIDE = 24, TIMES = 4 };

/* A chain whose bodies are numbered by sevens: its matrices are wider than a band. */
static void shuffled(double a, double b, fvi_sparse *A)
{
    fvi_triplet list[3 * WIDE];
    size_t count = 0;
    for (int i = 0; i < WIDE; i++)
        for (int j = i > 0 ? i - 1 : 0; j <= i + 1 && j < WIDE; j++)
            list[count++] = (fvi_triplet){ 7 * i % WIDE, 7 * j % WIDE, i == j ? a : b };
    OK(fvi_sparse_assemble(WIDE, count, list, A));
}

/* A step force on all unknowns jumps at 1.25; M is consistent, C couples its unknowns, and a second damper joins
 * two of them. Eight stages, each step a 64th, and steps of any length, beside the exact motion by its poles, which
 * is right to 1e-12 of |x| < 4. Their factors are UMFPACK's. Seen: 3.7e-14 of 4e-12. */
START_TEST(eq_27_14_wide_matrices_beside_the_exact_motion)
{
    const double aT[] = { 1, 1.25 }, jump = 1.25, t[TIMES] = { 0.5, 1.25, 2, 3 };
    const fvi_kernel_term terms[] = { { FVI_KERNEL_POWER, 1, 0.3, 0, 0 },
                                      { FVI_KERNEL_ZENER, 2, 0.2, 0.5, 0 } };
    const fvi_kernel kernels[] = { { 1, terms }, { 1, terms + 1 } };
    double row[WIDE] = { [3] = 1, [20] = -1 }, x[WIDE], p[WIDE] = { 0 }, exact[TIMES * WIDE];
    fvi_sparse M, K, C;
    fvi_structure *structure;
    fvi_exact_motion *motion;
    shuffled(1, 0.2, &M);
    shuffled(8, -4, &K);
    shuffled(0.4, -0.2, &C);
    for (size_t i = 0; i < WIDE; i++)
        x[i] = cos((double)i);
    const fvi_damper dampers[] = { { .matrix = &C, .kernel = kernels },
                                   { .of = fvi_elongation_row(row), .kernel = kernels + 1 } };
    OK(fvi_structure_alloc_dampers(&M, &K, 2, dampers, &structure, NULL));
    ck_assert_str_eq(fvi_structure_solver_name(structure, 1, 1, 1), "CHOLMOD");
    fvi_system system = fvi_structure_system(structure);
    const fvi_exact_problem problem = { .motion = { .system = &system },
                                        .x0 = x,
                                        .p0 = p,
                                        .forcing = FVI_FORCING_STEP,
                                        .A = 1,
                                        .T = 1.25 };
    OK(fvi_exact_motion_alloc(&problem, &motion, NULL));
    OK(fvi_exact_motion_at(motion, TIMES, t, exact, NULL, NULL));
    fvi_exact_motion_free(motion);
    system.force = fvi_force_step(aT);
    system.force.jumps = &jump;
    system.force.jump_count = 1;
    const fvi_method *const two[] = { &fvi_lobatto_d8, &fvi_variable_step };
    for (size_t i = 0; i < 2; i++) {
        fvi_stepper *s;
        double worst = 0, at[WIDE];
        fvi_run run = run_of(&system, 0.5, 1. / 64, 192, x, p);
        run.step_error = 1e-11;
        OK(fvi_stepper_start(two[i], &run, &s, NULL));
        for (size_t k = 0; k < TIMES; k++) {
            OK(fvi_stepper_advance_to(s, t[k], at, NULL));
            for (size_t j = 0; j < WIDE; j++)
                worst = larger(worst, fabs(at[j] - exact[k * WIDE + j]));
        }
        ck_assert_msg(worst <= 4e-12, "%s: %g", two[i]->name, worst);
        seen(worst, "wide, %s", two[i]->name);
        fvi_stepper_free(s);
    }
    fvi_structure_free(structure);
    fvi_sparse_free(&M);
    fvi_sparse_free(&K);
    fvi_sparse_free(&C);
}
END_TEST

/* ---- impulses ---- */

/* M is consistent, and the impulse comes at a time that no row knows: beside eight stages, which have a node
 * there. Seen: 2.7e-14 of 1e-11. */
START_TEST(an_impulse_of_a_structure_ends_a_step)
{
    matrices m;
    make_consistent(D, &m);
    const fvi_impulse hit = { 1.3, p0 };
    m.system.force.impulses = &hit;
    m.system.force.impulse_count = 1;
    fvi_run run = run_of(&m.system, 0.25, 0.65, ROWS, x0, zeros);
    run.step_error = 1e-11;
    double x[ROWS * D], p[ROWS * D], worst = 0;
    rows_of(&run, x, p);
    fvi_stepper *s;
    run = run_of(&m.system, 0.25, 0.65 / 32, 32 * ROWS, x0, zeros);
    OK(fvi_stepper_start(&fvi_lobatto_d8, &run, &s, NULL));
    for (size_t k = 0; k < ROWS; k++) {
        while (s->k < 32 * (k + 1))
            OK(fvi_stepper_step(s));
        for (size_t i = 0; i < D && k >= 3; i++) /* behind the first steps after it, which 8d takes too long */
            worst = larger(worst, fabs(s->x[i] - x[k * D + i]));
    }
    fvi_stepper_free(s);
    ck_assert_msg(worst <= 1e-11, "%g", worst);
    seen(worst, "struck");
    drop(&m);
}
END_TEST

/* M is consistent. A kick from rest gives the momentum p0, and the motion of a start with p0. */
START_TEST(a_kick_of_a_structure_is_a_start_with_its_momentum)
{
    matrices m;
    make_consistent(D, &m);
    fvi_run run = run_of(&m.system, 0.25, 0.65, ROWS, x0, p0);
    run.step_error = 1e-11;
    double x[ROWS * D], p[ROWS * D], at[D], worst = 0;
    rows_of(&run, x, p);
    run.p0 = zeros;
    fvi_stepper *s;
    OK(fvi_stepper_start(&fvi_variable_step, &run, &s, NULL));
    OK(fvi_stepper_kick(s, p0));
    for (size_t k = 0; k < ROWS; k++) {
        OK(fvi_stepper_advance_to(s, (double)(k + 1) * run.h, at, NULL));
        for (size_t i = 0; i < D; i++)
            worst = larger(worst, fabs(at[i] - x[k * D + i]));
    }
    fvi_stepper_free(s);
    ck_assert_msg(worst <= 1e-13, "%g", worst);
    seen(worst, "kicked");
    drop(&m);
}
END_TEST

/* ---- refusals ---- */

START_TEST(what_steps_of_any_length_do_not_take_of_matrices)
{
    building b;
    build(&b);
    fvi_stepper *s = NULL;
    fvi_error error = { 0 };
    fvi_run run = run_of(&b.system, 0.5, 0.1, ROWS, shape, push);
    b.term[1].alpha = 1;
    ck_assert_int_eq(fvi_stepper_start(&fvi_variable_step, &run, &s, &error), FVI_EUNSUP);
    ck_assert_str_eq(error.field, "damper");
    ck_assert_uint_eq(error.index, 1);
    b.term[1].alpha = 0.6875;
    fvi_matrices incomplete = *b.system.matrices;
    incomplete.solve_complex = NULL;
    fvi_system system = b.system;
    system.matrices = &incomplete;
    run.system = &system;
    ck_assert_int_eq(fvi_stepper_start(&fvi_variable_step, &run, &s, &error), FVI_EUNSUP);
    ck_assert_str_eq(error.field, "matrices");
    ck_assert(!s);
    free_building(&b);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("structures_adaptive");
    ADD_CASE(suite, "motions", eq_27_14_the_building_by_steps_of_its_own_to_the_tolerance,
             eq_27_14_diagonal_matrices_by_steps_of_their_own,
             eq_27_14_wide_matrices_beside_the_exact_motion,
             an_impulse_of_a_structure_ends_a_step,
             a_kick_of_a_structure_is_a_start_with_its_momentum);
    ADD_CASE(suite, "refusals", what_steps_of_any_length_do_not_take_of_matrices);
    return run_suite(suite);
}
