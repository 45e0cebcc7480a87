/* tests/run/test_allocations_libraries.c -- Failed allocations in GSL and CHOLMOD.
 * Run alone: make test-allocations_libraries
 *
 * If GSL cannot get more memory, it does not free the memory that it has; and CHOLMOD reads memory that it did not
 * get. The library calls both in ways in which neither happens.
 *
 * Under a sanitizer that has its own allocator nothing is tested. */
#include <fvi/fvi.h>
#include "failing_allocator.h"
#include "harness/ulp.h"
#include "matrices/factors.h"
#include "run/whole_run.h"

/* The order of an oscillator's damping, from so many places of its own motion. */
static int fit(void)
{
    enum { N = 400 };
    static const fvi_free_parameter alpha = FVI_FREE_PARAMETER_ALPHA;
    static double t[N], x[N + 1];
    static const double mass = 1, rho = 0.3, c = 1, x0 = 1, p0 = 0.5;
    const fvi_system system = { .d = 1,
                                .mass = &mass,
                                .damping = &rho,
                                .potential = fvi_potential_harmonic(&c) };
    fvi_run run = fvi_run_default(&system, &x0, &p0, 0.1, N);
    run.alpha = 0.3;
    const int status = fvi_trajectory(&fvi_fractional, &run, x, NULL, NULL);
    for (size_t i = 0; i < N; i++)
        t[i] = run.h * (double)(i + 1);
    const fvi_estimation question = { .method = &fvi_fractional,
                                      .run = &run,
                                      .parameters = 1,
                                      .which = &alpha,
                                      .n = N,
                                      .t = t,
                                      .x = x + 1,
                                      .h = run.h,
                                      .starts = 2 };
    fvi_estimate fitted;
    return status ? status : fvi_estimate_multistart(&question, NULL, &fitted);
}

/* GSL's solver of least squares is made where all of it has room, or not at all. */
START_TEST(a_fit_in_any_room_loses_none)
{
    size_t said = 0;
#ifdef OTHER_ALLOCATOR
    return;
#endif
    ck_assert_int_eq(fit(), FVI_SUCCESS);
    for (size_t room = 1 << 10;; room += 1 << 11) {
        const long before = alive;
        has_failed = 0;
        budget = used + room;
        const int status = fit();
        budget = 0;
        ck_assert_msg(alive == before, "%zu bytes: %ld blocks left", room, alive - before);
        if (!has_failed)
            break;
        ck_assert_msg(status == FVI_ENOMEM, "%zu bytes: %d", room, status);
        said++;
    }
    ck_assert_uint_gt(said, 100);
}
END_TEST

/* CHOLMOD looks at the vectors of a solution before it looks whether it got them. So it has
 * them from the start: here of blocks, n = 600 springs from each mass to each. */
START_TEST(a_solution_by_blocks_allocates_nothing)
{
    enum { n = 600 };
    static double r[n];
    fvi_triplet *list = malloc(n * n * sizeof *list);
    fvi_sparse A;
    fvi_factors *f;
    for (int i = 0; i < n * n; i++)
        list[i] = (fvi_triplet){ i / n, i % n, i / n == i % n ? n : -1 };
    ck_assert_int_eq(fvi_sparse_assemble(n, n * n, list, &A), FVI_SUCCESS);
    free(list);
    ck_assert_int_eq(fvi_factors_alloc(FVI_BY_CHOLMOD, &A, &f), FVI_SUCCESS);
    for (int solution = 0; solution < 2; solution++) {
        made = 0;
        const int status = fvi_factors_solve(f, r);
        const size_t allocated = made;
        ck_assert_int_eq(status, FVI_SUCCESS);
        ck_assert_uint_eq(allocated, 0);
    }
    fvi_factors_free(f);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("allocations of libraries");
    ADD_CASE(suite, "GSL, CHOLMOD", a_fit_in_any_room_loses_none, a_solution_by_blocks_allocates_nothing);
    return run_suite(suite);
}
