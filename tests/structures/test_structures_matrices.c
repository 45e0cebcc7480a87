/* tests/structures/test_structures_matrices.c -- Matrices: factors, the history of the damping.
 * Run alone: make test-structures_matrices */
#define _GNU_SOURCE /* RTLD_DEFAULT */
#include "structures_runs.h"

#include "matrices/factors.h"

#include <dlfcn.h>
#include <sys/wait.h>
#include <unistd.h>

/* ---- factors ---- */

/* The grid's Laplacian and a little more, on m^2 points: half bandwidth m, condition 500. */
static void grid(int m, double diagonal, fvi_sparse *A)
{
    fvi_triplet *list = malloc(5 * (size_t)(m * m) * sizeof *list);
    size_t count = 0;
    for (int i = 0; i < m * m; i++) {
        list[count++] = (fvi_triplet){ i, i, diagonal };
        if (i % m > 0)
            list[count++] = (fvi_triplet){ i, i - 1, -1 };
        if (i % m < m - 1)
            list[count++] = (fvi_triplet){ i, i + 1, -1 };
        if (i >= m)
            list[count++] = (fvi_triplet){ i, i - m, -1 };
        if (i < m * m - m)
            list[count++] = (fvi_triplet){ i, i + m, -1 };
    }
    OK(fvi_sparse_assemble((size_t)(m * m), count, list, A));
    free(list);
}

/* A spring of stiffness 1 between any two of n masses. On the diagonal n + 1 leaves the
 * least eigenvalue 1; the largest is then n + 1. */
static void all_to_all(int n, double diagonal, fvi_sparse *A)
{
    fvi_triplet *list = malloc((size_t)(n * n) * sizeof *list);
    for (int i = 0; i < n * n; i++)
        list[i] = (fvi_triplet){ i / n, i % n,
                                 i / n == i % n ? diagonal - 1 : -1 };
    OK(fvi_sparse_assemble((size_t)n, (size_t)(n * n), list, A));
    free(list);
}

/* Whatever the way: x comes back from A x to a few u times the condition, 500.
 * Seen: 0.004 of the bound. */
START_TEST(eq_27_3_every_way_solves_the_same_equations)
{
    enum { m = 12, n = m * m };
    static const fvi_factorisation ways[] = { FVI_BY_BAND, FVI_BY_CHOLMOD };
    for (size_t i = 0; i < LEN(ways); i++) {
        fvi_sparse A;
        fvi_factors *f;
        double x[n], r[n];
        grid(m, 4.02, &A);
        for (int l = 0; l < n; l++)
            x[l] = cos(7.0 * l);
        fvi_sparse_multiply(&A, x, r);
        OK(fvi_factors_alloc(ways[i], &A, &f));
        ck_assert_ptr_null(A.start); /* taken over */
        for (int twice = 0; twice < 2; twice++) {
            double y[n];
            memcpy(y, r, sizeof y);
            OK(fvi_factors_solve(f, y));
            for (int l = 0; l < n; l++)
                ck_assert_near(y[l], x[l], 500 * 8 * U, "way %zu", i);
        }
        fvi_factors_free(f);
    }
}
END_TEST

/* So many entries that CHOLMOD works by blocks: a solution, to a few u times the condition,
 * 601; a pivot that is not positive; and no draw from the caller's random numbers. */
START_TEST(eq_27_3_full_matrices_are_solved_by_blocks)
{
    enum { n = 600 };
    static double x[n], r[n];
    fvi_sparse A;
    fvi_factors *f;
    all_to_all(n, n + 1, &A);
    for (int l = 0; l < n; l++)
        x[l] = cos(7.0 * l);
    fvi_sparse_multiply(&A, x, r);
    srand(5);
    const int want = rand();
    srand(5);
    OK(fvi_factors_alloc(FVI_BY_CHOLMOD, &A, &f));
    ck_assert_int_eq(rand(), want);
    OK(fvi_factors_solve(f, r));
    for (int l = 0; l < n; l++)
        ck_assert_near(r[l], x[l], n * 8 * U, "%d", l);
    fvi_factors_free(f);
    all_to_all(n, n - 1, &A);
    ck_assert_int_eq(fvi_factors_alloc(FVI_BY_CHOLMOD, &A, &f), FVI_ESING);
}
END_TEST

/* The sweep reads a structure, and its processes factorise: libgomp would wait there for the
 * threads of the first. A caller that works with OpenMP himself finds his limit as it was. */
START_TEST(full_matrices_are_factorised_after_a_fork_too)
{
    int (*limit)(void) = NULL;
    fvi_sparse A;
    fvi_factors *f;
    *(void **)&limit = dlsym(RTLD_DEFAULT, "omp_get_max_active_levels");
    const int before = limit ? limit() : 0;
    all_to_all(600, 601, &A);
    OK(fvi_factors_alloc(FVI_BY_CHOLMOD, &A, &f));
    fvi_factors_free(f);
    ck_assert_int_eq(limit ? limit() : 0, before);
    const pid_t child = fork();
    ck_assert_int_ge(child, 0);
    all_to_all(600, 601, &A);
    if (child == 0) {
        alarm(60); /* it takes a tenth of a second */
        _exit(fvi_factors_alloc(FVI_BY_CHOLMOD, &A, &f));
    }
    fvi_sparse_free(&A);
    int state;
    ck_assert_int_eq(waitpid(child, &state, 0), child);
    ck_assert_int_eq(state, 0);
}
END_TEST

START_TEST(an_indefinite_matrix_has_no_factors)
{
    fvi_sparse A;
    fvi_factors *f;
    grid(6, 3, &A); /* its least eigenvalue is -0.6 */
    ck_assert_int_eq(fvi_factors_alloc(FVI_BY_BAND, &A, &f), FVI_ESING);
    grid(6, 3, &A);
    ck_assert_int_eq(fvi_factors_alloc(FVI_BY_CHOLMOD, &A, &f), FVI_ESING);
}
END_TEST

START_TEST(the_way_is_chosen_by_the_band)
{
    fvi_sparse A;
    tridiagonal(5, 2, 0, &A); /* zeros that stand there are no band of a sum */
    const fvi_sparse *const terms[] = { &A, NULL };
    const double a[] = { 1, 0 };
    fvi_sparse sum;
    OK(fvi_sparse_add(2, terms, a, &sum));
    ck_assert_int_eq(fvi_choose_factorisation(&sum), FVI_BY_DIAGONAL);
    fvi_sparse_free(&sum);
    fvi_sparse_free(&A);
    grid(8, 4, &A);
    ck_assert_int_eq(fvi_choose_factorisation(&A), FVI_BY_BAND);
    fvi_sparse_free(&A);
    grid(9, 4, &A);
    ck_assert_int_eq(fvi_choose_factorisation(&A), FVI_BY_CHOLMOD);
    fvi_sparse_free(&A);
}
END_TEST

/* M + K is diagonal here, but no M / h + s K of a run. */
START_TEST(the_way_of_a_sum_is_not_that_of_entries_that_cancel)
{
    fvi_sparse M, K;
    fvi_structure *s;
    tridiagonal(5, 4, 1, &M);
    tridiagonal(5, 2, -1, &K);
    OK(fvi_structure_alloc(&M, &K, NULL, &s, NULL));
    ck_assert_str_eq(fvi_structure_solver_name(s, 1, 0, 1), "band");
    fvi_structure_free(s);
    fvi_sparse_free(&M);
    fvi_sparse_free(&K);
}
END_TEST

/* ---- the history of the damping ---- */

/* A matrix from its lower triangle, row by row. */
static void dense(int n, const double *lower, fvi_sparse *A)
{
    fvi_triplet list[100];
    size_t count = 0;
    for (int i = 0; i < n; i++)
        for (int j = 0; j <= i; j++, lower++) {
            if (*lower == 0)
                continue;
            list[count++] = (fvi_triplet){ i, j, *lower };
            if (i != j)
                list[count++] = (fvi_triplet){ j, i, *lower };
        }
    OK(fvi_sparse_assemble((size_t)n, count, list, A));
}

/* All stages together, and each alone, to the bit. */
static void ck_assert_stages(const fvi_damping_matrix *f, size_t d)
{
    enum { STAGES = 8, MOST = 9 };
    double z[STAGES * MOST], together[STAGES * MOST], alone[STAGES * MOST];
    for (size_t s = 1; s <= STAGES; s++) {
        for (size_t i = 0; i < s * f->history_size; i++)
            z[i] = sin((double)(7 * i + 1));
        for (size_t i = 0; i < s * d; i++)
            together[i] = alone[i] = cos((double)i);
        OK(f->apply_damping_to_stages(d, s, 3, z, f->params, together));
        for (size_t i = 0; i < s; i++)
            OK(f->apply_damping(d, 3, z + i * f->history_size, f->params, alone + i * d));
        ck_assert_mem_eq(together, alone, s * d * sizeof *alone);
    }
}

/* S B^T x by the callbacks, against C x. */
static void ck_assert_damps(const matrices *m, size_t history_size)
{
    const fvi_damping_matrix *f = &m->system.matrices->damping;
    const size_t d = m->C.n;
    double x[9], zero[9] = { 0 }, z[9], p[9] = { 0 }, y[9];
    ck_assert_uint_eq(f->history_size, history_size);
    for (size_t i = 0; i < d; i++)
        x[i] = cos(3.0 * (double)i);
    fvi_sparse_multiply(&m->C, x, y);
    if (history_size > 0) {
        OK(f->select_history(d, x, zero, f->params, z));
        OK(f->apply_damping(d, 2, z, f->params, p));
        ck_assert_stages(f, d);
    }
    for (size_t i = 0; i < d; i++)
        ck_assert_near(p[i], -2 * y[i], 100 * U, "%zu of %zu", i, history_size);
}

START_TEST(eq_27_4_only_damped_unknowns_have_a_history)
{
    static const struct {
        double C[15];
        size_t history_size;
    } cases[] = {
        { { 0 }, 0 },
        /* two unknowns, rank 2 */
        { { 0, 0, 2, 0, 0, 0, 0, 1, 0, 3, 0, 0, 0, 0, 0 }, 2 },
        /* a damper between unknowns 2 and 4, one number */
        { { 0, 0, 2, 0, 0, 0, 0, -2, 0, 2, 0, 0, 0, 0, 0 }, 1 },
        /* b b^T with b = (1, 2, 0, -1, 3): one */
        { { 1, 2, 4, 0, 0, 0, -1, -2, 0, 1, 3, 6, 0, -3, 9 }, 1 },
        /* a chain of dampers to the ground at one end: rank 5, all */
        { { 2, -1, 2, 0, -1, 2, 0, 0, -1, 2, 0, 0, 0, -1, 1 }, 5 },
        /* one damper is 1e-16 of the other, which is no reason to forget it */
        { { 1, -1, 1, 0, 0, 1e-16, 0, 0, -1e-16, 1e-16 }, 2 },
    };
    for (size_t i = 0; i < LEN(cases); i++) {
        matrices m;
        tridiagonal(5, 2, 0.5, &m.M);
        tridiagonal(5, 2, -1, &m.K);
        dense(5, cases[i].C, &m.C);
        make(&m);
        ck_assert_damps(&m, cases[i].history_size);
        drop(&m);
    }
}
END_TEST

START_TEST(bad_matrices_are_refused_by_name)
{
    static const double lopsided[] = { 1, 0, 1 },
                        feeds[] = { 1, 0, -1e-16, 0, 0, 0 };
    fvi_sparse good, two, skew, less, holes, little, C;
    fvi_structure *s = NULL;
    char fault;
    tridiagonal(3, 2, -1, &good);
    tridiagonal(2, 2, -1, &two);
    tridiagonal(3, 1, -1, &less); /* 1 - sqrt 2 < 0 */
    tridiagonal(3, 0, 0, &holes);
    tridiagonal(3, 2, -1, &skew);
    skew.entry[1] = 1;
    dense(2, lopsided, &C);
    dense(3, feeds, &little);
#define REFUSED(M, K, C, code, name)                                           \
    ck_assert_int_eq(fvi_structure_alloc(M, K, C, &s, &fault), code);          \
    ck_assert_int_eq(fault, name)
    REFUSED(&less, &good, &good, FVI_ESING, 'M');
    REFUSED(&holes, &good, &good, FVI_EDOM, 'M');
    REFUSED(&skew, &good, &good, FVI_EDOM, 'M');
    REFUSED(&good, &skew, &good, FVI_EDOM, 'K');
    REFUSED(&good, &good, &skew, FVI_EDOM, 'C');
    REFUSED(&good, &good, &less, FVI_EDOM, 'C');
    REFUSED(&good, &good, &little, FVI_EDOM, 'C');
    REFUSED(&good, &two, &good, FVI_EINVAL, 'K');
    REFUSED(&good, &good, &two, FVI_EINVAL, 'C');
    REFUSED(NULL, &good, &good, FVI_EFAULT, 0);
    REFUSED(&good, NULL, &good, FVI_EFAULT, 0);
    ck_assert_ptr_null(s);
    OK(fvi_structure_alloc(&good, &less, NULL, &s,
                           NULL)); /* K may be anything */
    fvi_structure_free(s);
    fvi_sparse_free(&good);
    fvi_sparse_free(&two);
    fvi_sparse_free(&skew);
    fvi_sparse_free(&less);
    fvi_sparse_free(&holes);
    fvi_sparse_free(&little);
    fvi_sparse_free(&C);
}
END_TEST

/* More unknowns than are taken apart densely: 600. */
START_TEST(a_large_damping_is_checked_too)
{
    enum { n = 600 };
    static const double sides[] = { -1, -1.02 };
    for (size_t i = 0; i < LEN(sides); i++) {
        fvi_sparse M, K, C;
        fvi_structure *s;
        char fault;
        tridiagonal(n, 2, 0.5, &M);
        tridiagonal(n, 2, -1, &K);
        tridiagonal(n, 2, sides[i], &C);
        const int status = fvi_structure_alloc(&M, &K, &C, &s, &fault);
        ck_assert_int_eq(status, i ? FVI_EDOM : FVI_SUCCESS);
        ck_assert_int_eq(fault, i ? 'C' : 0);
        if (!status)
            fvi_structure_free(s);
        fvi_sparse_free(&M);
        fvi_sparse_free(&K);
        fvi_sparse_free(&C);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("structures: matrices");
    ADD_CASE(suite, "factors", eq_27_3_every_way_solves_the_same_equations,
             eq_27_3_full_matrices_are_solved_by_blocks,
             full_matrices_are_factorised_after_a_fork_too,
             an_indefinite_matrix_has_no_factors, the_way_is_chosen_by_the_band,
             the_way_of_a_sum_is_not_that_of_entries_that_cancel);
    ADD_CASE(
        suite, "damping", eq_27_4_only_damped_unknowns_have_a_history,
        bad_matrices_are_refused_by_name, a_large_damping_is_checked_too);
    return run_suite(suite);
}
