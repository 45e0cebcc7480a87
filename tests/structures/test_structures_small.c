/* tests/structures/test_structures_small.c -- The equation of all stages of a small structure, as one matrix.
 * Run alone: make test-structures_small */
#include "small.h"
#include "stages/stage_solver.h"
#include "system/dense.h"

/* M, K and the C_j of a small structure, and the equation of all stages, entry by entry as it is defined, by long
 * doubles. */
typedef struct {
    long double E[FVI_STAGE_DENSE][FVI_STAGE_DENSE + 1]; /* the last column is h load */
    double M[MOST][MOST], K[MOST][MOST], C[3][MOST][MOST];
} equation;

static void read_matrices(const fvi_matrices *m, size_t d, equation *e)
{
    const double none[MOST] = { 0 };
    for (size_t q = 0; q < d; q++) {
        double unit[MOST] = { 0 }, column[MOST], z;
        unit[q] = 1;
        OK(m->inertia(d, unit, m->params, column));
        for (size_t p = 0; p < d; p++)
            e->M[p][q] = column[p];
        OK(m->stiffness(d, unit, m->params, column));
        for (size_t p = 0; p < d; p++)
            e->K[p][q] = column[p];
        for (size_t j = 0; j < m->damper_count; j++) {
            memset(column, 0, sizeof column);
            OK(m->damper[j].select_history(d, unit, none, m->damper[j].params, &z));
            OK(m->damper[j].apply_damping(d, -1, &z, m->damper[j].params, column));
            for (size_t p = 0; p < d; p++)
                e->C[j][p][q] = column[p];
        }
    }
}

static void fill(const fvi_matrices *m, size_t s, size_t d, double h, const double *const *W, const double *load,
                 equation *e)
{
    const fvi_lobatto_rule *rule = fvi_lobatto(s);
    double A[FVI_STAGES][FVI_STAGES];
    fvi_lobatto_table(rule, s, A);
    read_matrices(m, d, e);
    for (size_t row = 0; row < s * d; row++) {
        const size_t i = row / d, p = row % d;
        for (size_t column = 0; column < s * d; column++) {
            const size_t l = column / d, q = column % d;
            const long double inverse = rule->D[i][l] + (i + l == 0 ? 1 / (long double)rule->b[0] : 0);
            e->E[row][column] = inverse * e->M[p][q] + (long double)h * h * A[i][l] * e->K[p][q];
            for (size_t j = 0; j < m->damper_count; j++)
                if (W[j])
                    e->E[row][column] += (long double)h * W[j][i * s + l] * e->C[j][p][q];
        }
        e->E[row][s * d] = (long double)h * load[row];
    }
}

/* Gauss, with exchanges of rows. */
static void eliminate(size_t n, equation *e, double *x)
{
    for (size_t j = 0; j < n; j++) {
        size_t pivot = j;
        for (size_t i = j; i < n; i++)
            if (fabsl(e->E[i][j]) > fabsl(e->E[pivot][j]))
                pivot = i;
        for (size_t l = 0; l <= n; l++) {
            const long double kept = e->E[j][l];
            e->E[j][l] = e->E[pivot][l];
            e->E[pivot][l] = kept;
        }
        for (size_t i = 0; i < n; i++) {
            const long double factor = i == j ? 0 : e->E[i][j] / e->E[j][j];
            for (size_t l = j; l <= n; l++)
                e->E[i][l] -= factor * e->E[j][l];
        }
    }
    for (size_t i = 0; i < n; i++)
        x[i] = (double)(e->E[i][n] / e->E[i][i]);
}

/* How far both ways are from an elimination with long doubles, beside the largest entry of it; by a random load. */
static void find_errors(const fvi_matrices *m, size_t s, size_t d, double h, const double *const *W, uint64_t *seed,
                        double *by_pairs, double *as_one)
{
    static equation e;
    const size_t n = s * d;
    double load[FVI_STAGE_DENSE], x[FVI_STAGE_DENSE], y[FVI_STAGE_DENSE], exact[FVI_STAGE_DENSE], most = 0;
    fvi_stage_solver *pairs, *full;
    OK(fvi_stage_solver_alloc(m, d, s, h, W, FVI_STAGE_PAIRS, &pairs));
    OK(fvi_stage_solver_alloc(m, d, s, h, W, FVI_STAGE_AUTO, &full));
    for (size_t i = 0; i < n; i++)
        load[i] = draw(seed) - 0.5;
    OK(fvi_stage_solver_solve(pairs, load, x));
    OK(fvi_stage_solver_solve(full, load, y));
    fill(m, s, d, h, W, load, &e);
    eliminate(n, &e, exact);
    for (size_t i = 0; i < n; i++)
        most = larger(most, fabs(exact[i]));
    *by_pairs = larger(*by_pairs, apart(n, x, exact) / most);
    *as_one = larger(*as_one, apart(n, y, exact) / most);
    fvi_stage_solver_free(pairs);
    fvi_stage_solver_free(full);
}

/* Two hundred structures with steps from 1/1000 to 10 by both ways, beside an elimination with long doubles. One matrix
 * is right to u times the condition number of the equation. That of A is at most 42 and that of M at most 2.3, so short
 * steps have about 100; 4 n = 256 are allowed. By pairs the eigenvectors are in the way: their condition is 1570 for
 * 8 stages, and squared it is 2.5e6 u = 3e-10. Seen: 4e-15 as one matrix, 4e-12 by pairs. */
START_TEST(eq_27_14_pairs_and_one_matrix_beside_an_exact_elimination)
{
    uint64_t seed = 1;
    double by_pairs = 0, as_one = 0, W[3][FVI_STAGES * FVI_STAGES];
    for (int run = 0; run < 200; run++) {
        const size_t s = 2 + (size_t)run % 7;
        small of;
        make_small(&seed, s, &of);
        const double *each[3] = { W[0], W[1], NULL }; /* the third damper has no history */
        for (size_t j = 0; j < 2; j++)
            OK(fvi_lobatto_weights(s, 2 * draw(&seed) - 1, 1, W[j], NULL));
        const double h = pow(10, 4 * draw(&seed) - 3);
        find_errors(of.system.matrices, s, (size_t)of.d, h, each, &seed, &by_pairs, &as_one);
        drop_small(&of);
    }
    ck_assert_msg(by_pairs <= 3e-10, "by pairs: %g", by_pairs);
    ck_assert_msg(as_one <= FVI_STAGE_DENSE * 4 * U, "as one matrix: %g", as_one);
    seen_worst(by_pairs, "by pairs");
    seen_worst(as_one, "as one matrix");
}
END_TEST

/* Masses from 1e-16 to 1 between springs of 1, and one damper. The condition of A is at most 42 and that of K at most
 * 33. h W of the damper is up to 10 times h^2 K of its two rows. So with rows of one size the condition of the equation
 * is about 42 * 33 * 10, and 1e4 u = 1.1e-12 are allowed. In units of the masses alone some rows are 1e14 times others,
 * and the error is 4e-10. Seen: 6.3e-13. */
START_TEST(eq_27_14_one_matrix_with_light_masses)
{
    uint64_t seed = 5;
    double by_pairs = 0, as_one = 0, W[FVI_STAGES * FVI_STAGES];
    for (int run = 0; run < 200; run++) {
        const size_t s = 2 + (size_t)run % 7;
        small of = { .d = FVI_STAGE_DENSE / s < MOST ? (int)(FVI_STAGE_DENSE / s) : MOST - 1 };
        fvi_triplet mass[MOST];
        for (int i = 0; i < of.d; i++)
            mass[i] = (fvi_triplet){ i, i, pow(10, -16 * draw(&seed)) };
        OK(fvi_sparse_assemble((size_t)of.d, (size_t)of.d, mass, &of.M));
        tridiagonal(of.d, 2, -1, &of.K);
        make_dampers(&seed, &of);
        OK(fvi_structure_alloc_dampers(&of.M, &of.K, 1, of.damper, &of.structure, NULL));
        of.system = fvi_structure_system(of.structure);
        const double *each[] = { W };
        OK(fvi_lobatto_weights(s, 0.2, 1, W, NULL));
        find_errors(of.system.matrices, s, (size_t)of.d, 0.1, each, &seed, &by_pairs, &as_one);
        drop_small(&of);
    }
    ck_assert_msg(as_one > 0 && as_one <= 1e4 * U, "as one matrix: %g", as_one);
    seen_worst(as_one, "light masses");
}
END_TEST

/* Of more rows than FVI_STAGE_DENSE both ways are pairs: to the last bit. */
START_TEST(a_wide_structure_is_solved_by_pairs)
{
    matrices m;
    make_consistent(17, &m);
    double W[16], load[4 * 17], x[4 * 17], y[4 * 17];
    const double *each[] = { W };
    OK(fvi_lobatto_weights(4, 0.5, 1, W, NULL));
    fvi_stage_solver *pairs, *automatic;
    OK(fvi_stage_solver_alloc(m.system.matrices, 17, 4, 0.1, each, FVI_STAGE_PAIRS, &pairs));
    OK(fvi_stage_solver_alloc(m.system.matrices, 17, 4, 0.1, each, FVI_STAGE_AUTO, &automatic));
    for (size_t i = 0; i < LEN(load); i++)
        load[i] = cos((double)i);
    OK(fvi_stage_solver_solve(pairs, load, x));
    OK(fvi_stage_solver_solve(automatic, load, y));
    ck_assert_mem_eq(x, y, sizeof x);
    fvi_stage_solver_free(pairs);
    fvi_stage_solver_free(automatic);
    drop(&m);
}
END_TEST

/* Inverses of random matrices, also of one whose first pivot is zero, against the product with the matrix. Without
 * exchanges 1/0 would come in. */
START_TEST(a_full_matrix_times_its_inverse_is_one)
{
    enum { N = 40 };
    uint64_t seed = 7;
    static double A[N * N], B[N * N];
    size_t order[N];
    double worst = 0;
    for (size_t n = 1; n <= N; n++) {
        for (size_t i = 0; i < n * n; i++)
            A[i] = B[i] = i % (n + 1) == 0 && n > 1 && i < n / 2 * n ? 0 : draw(&seed) - 0.5;
        OK(fvi_dense_invert(n, B, order));
        double most = 0;
        for (size_t i = 0; i < n * n; i++)
            most = larger(most, fabs(B[i]));
        for (size_t i = 0; i < n; i++)
            for (size_t j = 0; j < n; j++) {
                double sum = i == j ? -1 : 0;
                for (size_t l = 0; l < n; l++)
                    sum += A[i * n + l] * B[l * n + j];
                worst = larger(worst, fabs(sum) / (most * (double)n));
            }
    }
    ck_assert_msg(worst > 0 && worst <= 100 * U, "%g", worst);
    memset(A, 0, sizeof A);
    ck_assert_int_eq(fvi_dense_invert(3, A, order), FVI_ESING);
    seen_worst(worst, "inverse");
}
END_TEST

/* Rows of 8 to 80, even and odd columns: the sum of the even and of the odd products. */
START_TEST(a_product_sums_even_and_odd_columns)
{
    uint64_t seed = 9;
    static double A[80 * 9];
    double in[9], out[80];
    for (size_t rows = 8; rows <= 80; rows += 8)
        for (size_t columns = 1; columns <= 9; columns++) {
            for (size_t i = 0; i < rows * columns; i++)
                A[i] = draw(&seed) - 0.5;
            for (size_t j = 0; j < columns; j++)
                in[j] = draw(&seed) - 0.5;
            fvi_dense_multiply(rows, columns, A, in, out);
            for (size_t i = 0; i < rows; i++) {
                double sum[2] = { 0, 0 };
                for (size_t j = 0; j < columns; j++)
                    sum[j % 2] += A[j * rows + i] * in[j];
                ck_assert_double_eq(out[i], sum[0] + sum[1]);
            }
        }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("structures_small");
    ADD_CASE(suite, "a full matrix", eq_27_14_pairs_and_one_matrix_beside_an_exact_elimination,
             eq_27_14_one_matrix_with_light_masses,
             a_wide_structure_is_solved_by_pairs, a_full_matrix_times_its_inverse_is_one,
             a_product_sums_even_and_odd_columns);
    return run_suite(suite);
}
