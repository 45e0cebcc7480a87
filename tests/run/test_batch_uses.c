/* tests/run/test_batch_uses.c -- H 28: copies, adjoints and rows of runs in a batch, and the conditions for a
 * batch.
 * Run alone: make test-batch_uses */
#include "batch_runs.h"
#include "harness/saved.h"

/* A copy half way, and a run from what was archived there, go on with the same bits, also where lanes have solvers
 * of their own. */
START_TEST(a_batch_is_copied_and_archived_as_any_run)
{
    static const fvi_method *const all[] = { &fvi_cq2_midpoint, &fvi_lobatto_m4 };
    oscillator o[8];
    fvi_run run[8];
    for (size_t m = 0; m < LEN(all); m++) {
        fvi_batch *batch;
        fvi_stepper *s, *copy, *again;
        fill_wells(8, o, run, 60);
        OK(fvi_batch_alloc(all[m], 8, run, &batch, NULL));
        OK(fvi_stepper_start(all[m], fvi_batch_run(batch), &s, NULL));
        while (s->k < 30)
            OK(fvi_stepper_step(s));
        OK(fvi_stepper_copy(s, &copy));
        OK(fvi_stepper_start(all[m], fvi_batch_run(batch), &again, NULL));
        save_and_restore(s, again);
        fvi_stepper *const three[] = { s, copy, again };
        for (size_t i = 0; i < LEN(three); i++) {
            while (three[i]->k < 60)
                OK(fvi_stepper_step(three[i]));
            ck_assert_mem_eq(s->x, three[i]->x, 8 * sizeof *s->x);
            ck_assert_mem_eq(s->p, three[i]->p, 8 * sizeof *s->p);
        }
        for (size_t i = 0; i < LEN(three); i++)
            fvi_stepper_free(three[i]);
        fvi_batch_free(batch);
    }
}
END_TEST

/* J is the sum of all last places. */
static int last_place(size_t k, size_t d, const double *x, const double *p, void *params, double *Jx, double *Jp)
{
    (void)x;
    (void)p;
    (void)Jp;
    for (size_t j = 0; j < d && k == *(const size_t *)params; j++)
        Jx[j] += 1;
    return 0;
}

/* The derivatives of a lane are those of its run, and that by alpha is the sum of all. They solve the same linear
 * equations; the histories of a batch and of a run are summed alike. */
START_TEST(the_adjoint_of_a_batch_is_that_of_its_runs)
{
    static const fvi_method *const all[] = { &fvi_fractional, &fvi_cq2_midpoint, &fvi_cq_bdf2, &fvi_lobatto_m3 };
    size_t steps = 80;
    const fvi_objective J = { .slopes = last_place, .params = &steps };
    oscillator o[8];
    fvi_run run[8];
    for (size_t m = 0; m < LEN(all); m++) {
        double together[4][8], alone[4][8], alpha, sum = 0, sizes = 0;
        fvi_batch *batch;
        fill_wells(8, o, run, steps);
        for (size_t l = 0; l < 8; l++) {
            double by_alpha;
            const fvi_sensitivities own = { .x0 = alone[0] + l, .p0 = alone[1] + l, .mass = alone[2] + l,
                                            .damping = alone[3] + l, .alpha = &by_alpha };
            OK(fvi_adjoint(all[m], run + l, NULL, NULL, &J, &own));
            sum += by_alpha;
            sizes += fabs(by_alpha);
        }
        const fvi_sensitivities of_all = { .x0 = together[0], .p0 = together[1], .mass = together[2],
                                           .damping = together[3], .alpha = &alpha };
        OK(fvi_batch_alloc(all[m], 8, run, &batch, NULL));
        OK(fvi_adjoint(all[m], fvi_batch_run(batch), NULL, NULL, &J, &of_all));
        for (size_t i = 0; i < 4; i++)
            for (size_t l = 0; l < 8; l++)
                ck_assert_near(together[i][l], alone[i][l], 80 * U * (1 + fabs(alone[i][l])),
                               "%s: sums of 80 terms, those of the masses in another order", all[m]->name);
        ck_assert_near(alpha, sum, 8 * 80 * U * sizes, "sums in another order");
        fvi_batch_free(batch);
    }
}
END_TEST

/* Any number of runs: two of them change their step in between, one fails and takes nobody along. */
START_TEST(whole_trajectories_are_those_of_single_runs)
{
    enum { RUNS = 23, ROWS = 61 };
    static double got[2][RUNS][ROWS], want[2][RUNS][ROWS];
    oscillator o[RUNS];
    fvi_run run[RUNS];
    double *x[RUNS], *p[RUNS];
    int status[RUNS];
    fill_wells(RUNS, o, run, ROWS - 1);
    for (size_t i = 0; i < RUNS; i++) {
        run[i].h = i < 11 ? 0.05 : 0.1;
        x[i] = i == 4 ? NULL : got[0][i];
        p[i] = i == 5 ? NULL : got[1][i];
        OK(single(&fvi_cq2_midpoint, run + i, 1, want[0][i], want[1][i]));
    }
    OK(fvi_batch_trajectories(&fvi_cq2_midpoint, RUNS, run, ROWS, NULL, x, p, status));
    for (size_t i = 0; i < RUNS; i++) {
        ck_assert_int_eq(status[i], 0);
        ck_assert(i == 4 || memcmp(got[0][i], want[0][i], sizeof *want[0]) == 0);
        ck_assert(i == 5 || memcmp(got[1][i], want[1][i], sizeof *want[1]) == 0);
    }
    static const size_t some[] = { 0, 7, 40 };
    OK(fvi_batch_trajectories(&fvi_cq2_midpoint, RUNS, run, LEN(some), some, x, p, NULL));
    for (size_t i = 0; i < RUNS; i++)
        for (size_t r = 0; r < LEN(some); r++) {
            ck_assert(i == 4 || got[0][i][r] == want[0][i][some[r]]);
            ck_assert(i == 5 || got[1][i][r] == want[1][i][some[r]]);
        }
    memset(got, 0, sizeof got);
    o[2].x0 = 1e200;
    const int code = fvi_batch_trajectories(&fvi_cq2_midpoint, RUNS, run, ROWS, NULL, x, NULL, status);
    ck_assert_int_ne(code, 0);
    for (size_t i = 0; i < RUNS; i++) {
        ck_assert_int_eq(status[i], i == 2 ? code : 0);
        ck_assert(i == 4 || i == 2 || memcmp(got[0][i], want[0][i], sizeof *want[0]) == 0);
    }
    /* Two coordinates, and a method that chooses its steps, go by themselves. */
    static const double two[] = { 1, 0.5 }, spring = 2;
    const fvi_system pair = { .d = 2, .mass = two, .damping = two, .potential = fvi_potential_harmonic(&spring) };
    const fvi_run both[] = { fvi_run_default(&pair, two, two, 0.1, 20), fvi_run_default(&pair, two, two, 0.2, 20) };
    const fvi_method *const choices[] = { &fvi_cq_bdf2, &fvi_variable_step };
    for (size_t m = 0; m < LEN(choices); m++) {
        double rows[2][6], own[2][42];
        double *to[] = { rows[0], rows[1] };
        OK(fvi_batch_trajectories(choices[m], 2, both, LEN(some) - 1, some, to, NULL, NULL));
        for (size_t i = 0; i < 2; i++) {
            OK(fvi_trajectory(choices[m], both + i, own[i], NULL, NULL));
            ck_assert_mem_eq(rows[i], own[i], 2 * sizeof **own);
            ck_assert_mem_eq(rows[i] + 2, own[i] + 2 * 7, 2 * sizeof **own);
        }
    }
    OK(fvi_batch_trajectories(&fvi_cq2_midpoint, 0, run, ROWS, NULL, NULL, NULL, NULL));
    ck_assert_int_eq(fvi_batch_trajectories(NULL, 1, run, ROWS, NULL, NULL, NULL, NULL), FVI_EFAULT);
    ck_assert_int_eq(fvi_batch_trajectories(&fvi_cq2_midpoint, 1, NULL, ROWS, NULL, NULL, NULL, NULL), FVI_EFAULT);
}
END_TEST

/* ---- what does not go together ---- */

START_TEST(runs_that_differ_do_not_go_together)
{
    static const double two[] = { 1, 1 }, J = 1;
    static const fvi_impulse impulse = { 1, &J };
    static const fvi_kernel_term term = { FVI_KERNEL_MAXWELL, 1, 0, 1, 0 }, other = { FVI_KERNEL_MAXWELL, 1, 0, 2, 0 };
    static const fvi_kernel law = { 1, &term }, another = { 1, &other };
    oscillator o[2];
    fvi_run run[2];
    for (int bad = 0; bad < 17; bad++) {
        const fvi_method *method = bad == 0 ? &fvi_variable_step : bad == 1 ? &fvi_lobatto_m2 : &fvi_cq2_shifted;
        fill_wells(2, o, run, 10);
        fvi_run *r = run + 1;
        fvi_system *s = &o[1].system;
        o[1].rho = bad == 1 ? 0.3 : 0.2;
        r->h = bad == 2 ? 0.1 : r->h;
        r->steps = bad == 3 ? 11 : r->steps;
        r->alpha = bad == 4 ? 0.4 : r->alpha;
        r->kappa = bad == 5 ? 1 : r->kappa;
        r->past = bad == 6 ? FVI_INITIAL_HISTORY_CAPUTO : r->past;
        r->memory = bad == 7 ? FVI_HISTORY_DIRECT : r->memory;
        r->tolerance = bad == 8 ? 1e-9 : r->tolerance;
        run[0].law = bad == 9 || bad == 10 ? &law : NULL;
        r->law = bad == 9 ? NULL : bad == 10 ? &another : r->law;
        o[1].cg[1] = bad == 11 ? 0 : o[1].cg[1]; /* quadratic */
        if (bad == 12)
            s->potential = (fvi_potential){ 0 };
        if (bad == 13)
            s->force = (fvi_force){ 0 };
        if (bad == 14)
            *s = (fvi_system){ .d = 2, .mass = two, .damping = two };
        s->force.impulses = &impulse;
        s->force.impulse_count = bad == 15;
        r->x0 = bad == 16 ? NULL : r->x0;
        fvi_batch *batch = NULL;
        fvi_error error;
        ck_assert_msg(fvi_batch_refusal(method, 2, run) != NULL, "%d", bad);
        ck_assert_int_eq(fvi_batch_alloc(method, 2, run, &batch, &error), FVI_EUNSUP);
        ck_assert_ptr_null(batch);
        ck_assert_ptr_nonnull(strstr(error.text, fvi_batch_refusal(method, 2, run)));
    }
    fvi_batch *batch = NULL;
    ck_assert_int_eq(fvi_batch_alloc(NULL, 2, run, &batch, NULL), FVI_EFAULT);
    ck_assert_int_eq(fvi_batch_alloc(&fvi_cq_bdf2, 2, NULL, &batch, NULL), FVI_EFAULT);
    ck_assert_int_eq(fvi_batch_alloc(&fvi_cq_bdf2, 2, run, NULL, NULL), FVI_EFAULT);
    ck_assert_int_eq(fvi_batch_alloc(&fvi_cq_bdf2, 0, run, &batch, NULL), FVI_EINVAL);
    ck_assert_int_eq(fvi_batch_alloc(&fvi_cq_bdf2, 9, run, &batch, NULL), FVI_EINVAL);
    ck_assert_ptr_nonnull(fvi_batch_refusal(&fvi_cq_bdf2, 9, run));
    fvi_batch_free(NULL);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("uses of runs together");
    ADD_CASE(suite, "uses", a_batch_is_copied_and_archived_as_any_run, the_adjoint_of_a_batch_is_that_of_its_runs,
             whole_trajectories_are_those_of_single_runs, runs_that_differ_do_not_go_together);
    return run_suite(suite);
}
