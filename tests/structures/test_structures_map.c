/* tests/structures/test_structures_map.c -- A step of a small structure as one linear map.
 * Run alone: make test-structures_map */
#include "harness/saved.h"
#include "methods/lobatto_matrices.h"
#include "small.h"

enum { STEPS = 400 };

static const fvi_method *const stages[] = { &fvi_lobatto_d2, &fvi_lobatto_d3, &fvi_lobatto_d4, &fvi_lobatto_d5,
                                            &fvi_lobatto_d6, &fvi_lobatto_d7, &fvi_lobatto_d8 };

/* A run with its map and a copy without one, step by step: x and p, what the dampers gave, and at last the
 * velocities at the stages. All are of the size of 1. */
static double without_map(const fvi_run *run, const fvi_method *method, size_t dampers)
{
    fvi_stepper *fast, *plain;
    double worst = 0;
    OK(fvi_stepper_start(method, run, &fast, NULL));
    OK(fvi_stepper_keep_dampers(fast));
    OK(fvi_stepper_copy(fast, &plain));
    fvi_lobatto_matrices *with = fvi_lobatto_matrices_of(fast), *without = fvi_lobatto_matrices_of(plain);
    ck_assert(with->map.columns > 0 && without->map.columns == with->map.columns);
    without->map.columns = 0;
    const size_t d = run->system->d;
    for (size_t k = 0; k < run->steps; k++) {
        OK(fvi_stepper_step(fast));
        OK(fvi_stepper_step(plain));
        worst = larger(worst, larger(apart(d, fast->x, plain->x), apart(d, fast->p, plain->p)));
    }
    for (size_t j = 0; j < dampers; j++) {
        double J, same, work, same_work;
        OK(fvi_stepper_damper(fast, j, &J, &work));
        OK(fvi_stepper_damper(plain, j, &same, &same_work));
        worst = larger(worst, larger(fabs(J - same), fabs(work - same_work)));
    }
    with = fvi_lobatto_matrices_of(fast);
    worst = larger(worst, apart(with->s * d, with->V, without->V));
    fvi_stepper_free(fast);
    fvi_stepper_free(plain);
    return worst;
}

/* Random structures with and without a force. Both ways have the roundings of a step, 10 u of motions of the size of
 * 1 in each, which add up to 400 * 10 u = 4e-13 if none of them cancels. Seen: 5e-14. */
START_TEST(eq_27_14_the_map_of_a_step_is_the_step)
{
    uint64_t seed = 3;
    double worst = 0;
    for (int i = 0; i < 60; i++) {
        const size_t s = 2 + (size_t)i % 7;
        small of;
        make_small(&seed, s, &of);
        if (i % 3 == 0)
            of.system.force = (fvi_force){ .value = force_of_cosines };
        fvi_run run = run_of(&of.system, 0.5, 0.02 + 0.1 * draw(&seed), STEPS, of.x0, of.p0);
        worst = larger(worst, without_map(&run, stages[s - 2], of.dampers));
        drop_small(&of);
    }
    ck_assert_msg(worst > 0 && worst <= 4e-13, "%g", worst);
    seen_worst(worst, "map");
}
END_TEST

/* One matrix C and the three pasts of an alpha; Riemann and Liouville's wants C x0 = 0 above 1/2. */
START_TEST(eq_27_14_the_map_knows_every_past)
{
    double worst = 0;
    const double x0[D] = { 1, 0, -0.5, 0.2, 0.3 }, p0[D] = { 0, 0.3, 0.1, -1, 0.2 }, still[D] = { 0 };
    matrices m;
    make_consistent(D, &m);
    for (int past = 0; past < 3; past++)
        for (int a = 0; a <= 4; a++) {
            const int is_rl = past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE;
            fvi_run run = run_of(&m.system, a / 4., 0.1, STEPS, is_rl && a > 2 ? still : x0, p0);
            run.past = (fvi_initial_history)past;
            fvi_stepper *fast, *plain;
            OK(fvi_stepper_start(&fvi_lobatto_d6, &run, &fast, NULL));
            OK(fvi_stepper_copy(fast, &plain));
            ck_assert_uint_gt(fvi_lobatto_matrices_of(fast)->map.columns, 0);
            fvi_lobatto_matrices_of(plain)->map.columns = 0;
            while (fast->k < STEPS) {
                OK(fvi_stepper_step(fast));
                OK(fvi_stepper_step(plain));
                worst = larger(worst, apart(D, fast->x, plain->x));
            }
            fvi_stepper_free(fast);
            fvi_stepper_free(plain);
        }
    drop(&m);
    ck_assert_msg(worst > 0 && worst <= 4e-13, "%g", worst);
    seen_worst(worst, "pasts");
}
END_TEST

/* A free row of five masses with springs of k = 10^4, which starts at x = 1000. The sums of K x_k are exact, because the
 * entries of K are k and 2 k, so the forces of a step are those of the springs, h k 10^-2 = 10. The product sums 45 such
 * terms. So 400 steps move the momentum by at most 400 * 45 * 10 u = 4e-11. A map of x_k itself would move it by
 * 400 h k 1000 u = 9e-8. Seen: 7e-14. */
START_TEST(eq_27_14_a_stiff_row_that_is_free_keeps_its_momentum)
{
    const double x0[D] = { 1000, 1000, 1000, 1000, 1000 }, p0[D] = { 0, 0, 0, 0, 1 };
    double row[D] = { 1, -1 }, worst = 0;
    fvi_kernel_term term = { FVI_KERNEL_POWER, 0.5, 0.3, 0, 0 };
    const fvi_kernel kernel = { 1, &term };
    const fvi_damper damper = { .of = fvi_elongation_row(row), .kernel = &kernel };
    fvi_triplet list[3 * D];
    fvi_sparse M, K;
    fvi_structure *structure;
    size_t count = 0;
    for (int i = 0; i < D; i++)
        for (int j = i > 0 ? i - 1 : 0; j <= i + 1 && j < D; j++)
            list[count++] = (fvi_triplet){ i, j, i != j ? -1e4 : i % (D - 1) ? 2e4 : 1e4 };
    OK(fvi_sparse_assemble(D, count, list, &K));
    diagonal(1, ones, &M);
    OK(fvi_structure_alloc_dampers(&M, &K, 1, &damper, &structure, NULL));
    const fvi_system system = fvi_structure_system(structure);
    const fvi_run run = run_of(&system, 0.5, 0.1, STEPS, x0, p0);
    for (size_t i = 0; i < LEN(stages); i++) {
        fvi_stepper *s;
        OK(fvi_stepper_start(stages[i], &run, &s, NULL));
        ck_assert_uint_gt(fvi_lobatto_matrices_of(s)->map.columns, 0);
        while (s->k < STEPS) {
            OK(fvi_stepper_step(s));
            worst = larger(worst, fabs(s->p[0] + s->p[1] + s->p[2] + s->p[3] + s->p[4] - 1));
        }
        fvi_stepper_free(s);
    }
    fvi_structure_free(structure);
    fvi_sparse_free(&M);
    fvi_sparse_free(&K);
    ck_assert_msg(worst > 0 && worst <= 4e-11, "%g", worst);
    seen_worst(worst, "momentum");
}
END_TEST

static int is_pushed;

static int push_or_not(double t, size_t d, void *params, double *F)
{
    force_of_cosines(t, d, params, F);
    for (size_t i = 0; i < d && !is_pushed; i++)
        F[i] = 0;
    return 0;
}

/* A force that comes in the middle of a run, and one that goes, beside a run without a map whose force always is there and
 * is zero in between. */
START_TEST(a_force_may_come_and_go)
{
    double worst = 0;
    for (int comes = 0; comes < 2; comes++) {
        building b;
        build(&b);
        fvi_system always = b.system;
        always.force.value = push_or_not;
        b.system.force.value = comes ? NULL : force_of_cosines;
        const fvi_run run = run_of(&b.system, 0.5, 0.1, STEPS, shape, push),
                      same = run_of(&always, 0.5, 0.1, STEPS, shape, push);
        fvi_stepper *fast, *plain;
        OK(fvi_stepper_start(&fvi_lobatto_d8, &run, &fast, NULL));
        OK(fvi_stepper_start(&fvi_lobatto_d8, &same, &plain, NULL));
        ck_assert_uint_gt(fvi_lobatto_matrices_of(fast)->map.columns, 0);
        fvi_lobatto_matrices_of(plain)->map.columns = 0;
        while (fast->k < STEPS) {
            is_pushed = comes == (fast->k >= STEPS / 2);
            b.system.force.value = is_pushed ? force_of_cosines : NULL;
            OK(fvi_stepper_step(fast));
            OK(fvi_stepper_step(plain));
            worst = larger(worst, larger(apart(D, fast->x, plain->x), apart(D, fast->p, plain->p)));
        }
        const fvi_lobatto_matrices *with = fvi_lobatto_matrices_of(fast);
        worst = larger(worst, apart(with->s * D, with->V, fvi_lobatto_matrices_of(plain)->V));
        fvi_stepper_free(fast);
        fvi_stepper_free(plain);
        free_building(&b);
    }
    ck_assert_msg(worst > 0 && worst <= 4e-13, "%g", worst);
    seen_worst(worst, "force");
}
END_TEST

/* A copy in the middle and a state from an archive go on to the last bit, the path within the last step included. */
START_TEST(a_map_goes_with_a_copy_and_an_archive)
{
    building b;
    build(&b);
    const fvi_run run = run_of(&b.system, 0.5, 0.1, STEPS, shape, push);
    fvi_stepper *s, *copy, *restored;
    OK(fvi_stepper_start(&fvi_lobatto_d8, &run, &s, NULL));
    OK(fvi_stepper_start(&fvi_lobatto_d8, &run, &restored, NULL));
    while (s->k < STEPS / 2)
        OK(fvi_stepper_step(s));
    OK(fvi_stepper_copy(s, &copy));
    save_and_restore(s, restored);
    double x[D], y[D], z[D];
    OK(fvi_lobatto_within(s, s->t - 0.03, x));
    OK(fvi_lobatto_within(copy, s->t - 0.03, y));
    OK(fvi_lobatto_within(restored, s->t - 0.03, z));
    ck_assert(memcmp(x, y, sizeof x) == 0 && memcmp(x, z, sizeof x) == 0);
    while (s->k < STEPS) {
        OK(fvi_stepper_step(s));
        OK(fvi_stepper_step(copy));
        OK(fvi_stepper_step(restored));
    }
    ck_assert(memcmp(s->x, copy->x, sizeof x) == 0 && memcmp(s->x, restored->x, sizeof x) == 0);
    ck_assert(memcmp(s->p, copy->p, sizeof x) == 0 && memcmp(s->p, restored->p, sizeof x) == 0);
    OK(fvi_lobatto_within(s, s->t - 0.03, x));
    OK(fvi_lobatto_within(copy, s->t - 0.03, y));
    ck_assert(memcmp(x, y, sizeof x) == 0);
    fvi_stepper_free(s);
    fvi_stepper_free(copy);
    fvi_stepper_free(restored);
    free_building(&b);
}
END_TEST

/* A map has to pay: no run of few steps, and none of many unknowns, has one. */
START_TEST(a_map_is_made_where_it_pays)
{
    building b;
    build(&b);
    matrices wide;
    make_consistent(40, &wide);
    double zero[40] = { 0 };
    const fvi_run runs[] = { run_of(&b.system, 0.5, 0.1, 60, shape, push), run_of(&b.system, 0.5, 0.1, STEPS, shape, push),
                             run_of(&wide.system, 0.25, 0.1, 10 * STEPS, zero, zero) };
    for (size_t i = 0; i < LEN(runs); i++) {
        fvi_stepper *s;
        OK(fvi_stepper_start(&fvi_lobatto_d8, &runs[i], &s, NULL));
        ck_assert_int_eq(fvi_lobatto_matrices_of(s)->map.columns > 0, i == 1);
        fvi_stepper_free(s);
    }
    drop(&wide);
    free_building(&b);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("structures_map");
    ADD_CASE(suite, "a step as one map", eq_27_14_the_map_of_a_step_is_the_step, eq_27_14_the_map_knows_every_past,
             eq_27_14_a_stiff_row_that_is_free_keeps_its_momentum, a_force_may_come_and_go,
             a_map_goes_with_a_copy_and_an_archive, a_map_is_made_where_it_pays);
    return run_suite(suite);
}
