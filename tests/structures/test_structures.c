/* tests/structures/test_structures.c -- H 27: runs with matrices.
 * Run alone: make test-structures */
#include "structures_runs.h"
#include "run/whole_run.h"
#include "system/larger.h"

/* ---- against the same system without matrices ---- */

enum { D = 6, N = 60 };

static const double mass[D] = { 1, 2, 0.5, 1.5, 1, 3 };

/* Of the dampings, all, or those of unknowns 1 and 4. */
static const double dampings[2][D] = { { 0.03, 0.02, 0.07, 0.01, 0.04, 0.05 },
                                       { 0, 0.03, 0, 0, 0.02, 0 } };

static void diagonal(const double *a, fvi_sparse *A)
{
    fvi_triplet list[D];
    size_t count = 0;
    for (int i = 0; i < D; i++)
        if (a[i] != 0)
            list[count++] = (fvi_triplet){ i, i, a[i] };
    OK(fvi_sparse_assemble(D, count, list, A));
}

static void force_at(double t, size_t d, double *F)
{
    for (size_t i = 0; i < d; i++)
        F[i] = cos(t + (double)i);
}

static int value(double t, size_t d, void *params, double *F)
{
    (void)params;
    force_at(t, d, F);
    return 0;
}

/* Both runs do the same operations but for sums over rows: u = 2^-53 for each term of a
 * step, N steps, each error growing at most like t; |x|, |p| < 4. Seen: 4.5e-15 of 1e-12. */
static void ck_assert_same_runs(const fvi_method *method, const fvi_run *given,
                                const fvi_system *other)
{
    double x[(N + 1) * D], p[(N + 1) * D], E[N + 1], X[(N + 1) * D],
        P[(N + 1) * D], F[N + 1];
    fvi_run run = *given;
    OK(fvi_trajectory(method, &run, x, p, E));
    run.system = other;
    OK(fvi_trajectory(method, &run, X, P, F));
    double worst = 0;
    for (size_t i = 0; i < (N + 1) * D; i++)
        worst = larger(worst, larger(fabs(x[i] - X[i]), fabs(p[i] - P[i])));
    for (size_t k = 0; k <= N; k++)
        worst = larger(worst, fabs(E[k] - F[k]) / 10);
    ck_assert_msg(worst <= 1e-12, "%s, alpha %g, kappa %g: %g", method->name,
                  run.alpha, run.kappa, worst);
    seen_worst(worst, "deviation");
}

START_TEST(eq_27_1_diagonal_matrices_are_masses_and_dampings)
{
    static const double alphas[] = { 0, 0.25, 0.5, 0.7, 1 };
    static const double kappas[] = { 0, 0.5, 1 };
    const double spring[] = { 2, 0 }, x0[D] = { 1, 0, -0.5, 0.2, 0, 0.3 },
                 p0[D] = { 0, 0.3, 0.1, 0, -1, 0.2 }, rest[D] = { 0 };
    for (size_t which = 0; which < 2; which++) {
        matrices m;
        diagonal(mass, &m.M);
        diagonal(dampings[which], &m.C);
        tridiagonal(D, 4, -2, &m.K);
        make(&m);
        ck_assert_uint_eq(m.system.matrices->damping.history_size, which ? 2 : D);
        m.system.force = (fvi_force){ .value = value };
        const fvi_system plain = { .d = D,
                                   .mass = mass,
                                   .damping = dampings[which],
                                   .potential = fvi_potential_chain(spring),
                                   .force = m.system.force };
        for (size_t i = 0; i < LEN(takers) * LEN(alphas) * LEN(kappas) * 3;
             i++) {
            const fvi_method *method = takers[i % LEN(takers)];
            const double alpha = alphas[i / LEN(takers) % LEN(alphas)];
            const fvi_initial_history past =
                (fvi_initial_history)(i / LEN(takers) / LEN(alphas) / LEN(kappas));
            const int zero = past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE && alpha > 0.5;
            fvi_run run = run_of(&plain, alpha, 0.1, N, zero ? rest : x0, p0);
            run.kappa = kappas[i / LEN(takers) / LEN(alphas) % LEN(kappas)];
            run.past = past;
            ck_assert_same_runs(method, &run, &m.system);
        }
        drop(&m);
    }
}
END_TEST

START_TEST(eq_27_1_laws_of_damping_take_matrices)
{
    const double spring[] = { 2, 0 }, x0[D] = { 1, 0, -0.5, 0.2, 0, 0.3 },
                 p0[D] = { 0, 0.3, 0.1, 0, -1, 0.2 };
    const fvi_kernel_term terms[] = {
        { .kind = FVI_KERNEL_POWER, .rho = 0.5, .alpha = 0.3 },
        { .kind = FVI_KERNEL_MAXWELL, .rho = 0.2, .time = 2 }
    };
    const fvi_kernel law = { .count = 2, .term = terms };
    matrices m;
    diagonal(mass, &m.M);
    diagonal(dampings[0], &m.C);
    tridiagonal(D, 4, -2, &m.K);
    make(&m);
    const fvi_system plain = { .d = D,
                               .mass = mass,
                               .damping = dampings[0],
                               .potential = fvi_potential_chain(spring) };
    fvi_run run = run_of(&plain, 0.5, 0.1, N, x0, p0);
    run.law = &law;
    ck_assert_same_runs(&fvi_fractional, &run, &m.system);
    ck_assert_same_runs(&fvi_cq_bdf2, &run, &m.system);
    ck_assert_same_runs(&fvi_cq2_midpoint, &run, &m.system);
    drop(&m);
}
END_TEST

/* A fork goes on with the digits of the whole run, all state and factors its own. */
START_TEST(a_copy_of_a_run_with_matrices_goes_on_alike)
{
    const double x0[D] = { 1, 0, -0.5, 0.2, 0, 0.3 }, p0[D] = { 0 };
    matrices m;
    diagonal(dampings[0], &m.C);
    tridiagonal(D, 2, 0.5, &m.M);
    tridiagonal(D, 4, -2, &m.K);
    make(&m);
    for (size_t i = 0; i < LEN(takers); i++) {
        fvi_stepper *s, *fork;
        const fvi_run run = run_of(&m.system, 0.3, 0.1, N, x0, p0);
        OK(fvi_stepper_start(takers[i], &run, &s, NULL));
        while (s->k < N / 2)
            OK(fvi_stepper_step(s));
        OK(fvi_stepper_copy(s, &fork));
        while (s->k < N)
            OK(fvi_stepper_step(s));
        double x[D];
        memcpy(x, s->x, sizeof x);
        fvi_stepper_free(s);
        while (fork->k < N)
            OK(fvi_stepper_step(fork));
        ck_assert_int_eq(memcmp(x, fork->x, sizeof x), 0);
        fvi_stepper_free(fork);
    }
    drop(&m);
}
END_TEST

/* ---- modes ---- */

/* Each mode of C = rho K + sigma M moves like one oscillator. The bar's modes are sines, on
 * which tridiagonal matrices a, b are the numbers a + 2 b cos(theta). Rounding: as above,
 * with |K||x| up to h^2 lambda_max/4 times what is left of it. Seen: 2e-14 of 1e-12. */
START_TEST(eq_27_5_a_mode_of_the_bar_is_one_oscillator)
{
    enum { n = 24, STEPS = 200 };
    static const double alphas[] = { 0.25, 0.5, 0.8 };
    const double dx = 1.0 / (n + 1), sigma = 0.1;
    for (size_t i = 0; i < LEN(takers) * LEN(alphas) * 2; i++) {
        const int mode = i / LEN(takers) / LEN(alphas) ? 5 : 1;
        const fvi_method *method = takers[i % LEN(takers)];
        const double theta = 3.14159265358979324 * mode * dx,
                     mu = dx * (4 + 2 * cos(theta)) / 6,
                     k = (2 - 2 * cos(theta)) / dx,
                     rho = method == &fvi_cq2_midpoint ? 0.05 : 0.0005,
                     c = rho * k + sigma * mu,
                     h = method == &fvi_cq2_midpoint ? 0.05 : 0.002;
        matrices m;
        tridiagonal(n, dx * 4 / 6, dx / 6, &m.M);
        tridiagonal(n, 2 / dx, -1 / dx, &m.K);
        tridiagonal(n, rho * 2 / dx + sigma * dx * 4 / 6,
                    sigma * dx / 6 - rho / dx, &m.C);
        make(&m);
        double v[n], x0[n], p0[n], x[(STEPS + 1) * n], y[STEPS + 1],
            q0 = 0.3 * mu, one = 1, worst = 0;
        for (int j = 0; j < n; j++) {
            x0[j] = v[j] = sin(theta * (j + 1));
            p0[j] = q0 * v[j];
        }
        const fvi_system single = { .d = 1,
                                    .mass = &mu,
                                    .damping = &c,
                                    .potential = fvi_potential_harmonic(&k) };
        const fvi_run scalar =
            run_of(&single, alphas[i / LEN(takers) % LEN(alphas)], h, STEPS,
                   &one, &q0);
        fvi_run whole = scalar;
        whole.system = &m.system;
        whole.x0 = x0;
        whole.p0 = p0;
        OK(fvi_trajectory(method, &scalar, y, NULL, NULL));
        OK(fvi_trajectory(method, &whole, x, NULL, NULL));
        for (size_t l = 0; l < (STEPS + 1) * n; l++)
            worst = larger(worst, fabs(x[l] - y[l / n] * v[l % n]));
        ck_assert_msg(worst <= 1e-12, "%s, alpha %g: %g", method->name,
                      scalar.alpha, worst);
        seen_worst(worst, "bar");
        drop(&m);
    }
}
END_TEST

/* ---- stability ---- */

/* A random symmetric matrix B^T B of three unknowns, of this rank, and `more` on the diagonal:
 * as triplets for both, full. */
static void random_matrix(unsigned *seed, int rank, double more, fvi_sparse *A)
{
    double B[3][3];
    fvi_triplet list[9];
    for (int i = 0; i < 9; i++) {
        *seed = *seed * 1664525u + 1013904223u;
        B[i / 3][i % 3] = (double)*seed * 0x1p-31 - 1;
    }
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            double sum = i == j ? more : 0;
            for (int l = 0; l < rank; l++)
                sum += B[l][i] * B[l][j];
            list[3 * i + j] = (fvi_triplet){ i, j, sum };
        }
    OK(fvi_sparse_assemble(3, 9, list, A));
}

static double largest(const double *x, size_t from, size_t to)
{
    double max = 0;
    for (size_t i = 3 * from; i < 3 * to; i++)
        max = larger(max, fabs(x[i]));
    return max;
}

/* Theorem 27.2: dampers of rank one that share no mode with M and K, steps up to a thousand
 * radians; and with a law in the place of the power, (26.15). A mode that grew by a
 * thousandth in each step would be e times as large in each quarter. Seen: 0.97, and by a
 * law 1.25: two modes that nearly alternate, and beat. */
START_TEST(eq_27_8_no_motion_of_fvi_stable_grows)
{
    enum { ALL = 4000 };
    static double x[3 * (ALL + 1)];
    const double x0[3] = { 1, 0, -1 }, p0[3] = { 0, 0.5, 0 };
    unsigned seed = 27;
    for (int i = 0; i < 60; i++) {
        static const double alphas[] = { 0.1, 0.25, 0.4, 0.6 };
        static const fvi_kernel_term terms[][2] = {
            { { FVI_KERNEL_POWER, 1, 0.2, 0, 0 }, { FVI_KERNEL_POWER, 1, 0.9, 0, 0 } },
            { { FVI_KERNEL_ZENER, 9, 0.3, 0.1, 0 }, { FVI_KERNEL_MAXWELL, 1, 0, 2, 0 } },
            { { FVI_KERNEL_ZENER, 1, 0.8, 5, 0 }, { FVI_KERNEL_POWER, 1, 0.5, 0, 0 } },
            { { FVI_KERNEL_DISTRIBUTED, 5, 0, 0, 1 }, { FVI_KERNEL_POWER, 0, 0, 0, 0 } }
        };
        const fvi_kernel law = { 2, terms[i % 4] };
        matrices m;
        random_matrix(&seed, 3, 0.5, &m.M);
        random_matrix(&seed, 3, 0.1, &m.K);
        random_matrix(&seed, 1, 0, &m.C);
        make(&m);
        ck_assert_uint_eq(m.system.matrices->damping.history_size, 1);
        fvi_run run = run_of(&m.system, alphas[i % 4],
                             pow(10, i / 4 % 5 - 1), ALL, x0, p0);
        for (int by_law = 0; by_law <= 1; by_law++) {
            run.law = by_law ? &law : NULL;
            OK(fvi_trajectory(&fvi_cq2_midpoint, &run, x, NULL, NULL));
            const double ratio =
                largest(x, 3 * ALL / 4, ALL) / largest(x, 0, ALL / 4);
            seen_worst(ratio, by_law ? "by a law" : "last quarter over first");
            ck_assert_msg(ratio < (by_law ? 1.5 : 1.05), "run %d, %d: %g", i,
                          by_law, ratio);
        }
        drop(&m);
    }
}
END_TEST

/* (27.9) against all eigenvalues, from below; and runs on both sides of it. A load of 1.1 lets
 * the alternating mode grow by some percent a step. */
START_TEST(eq_27_9_the_load_of_matrices)
{
    enum { ALL = 1500 };
    static double x[3 * (ALL + 1)];
    const double x0[3] = { 1, 0.3, -1 }, p0[3] = { 0, 0.5, 0 };
    static const fvi_method *const methods[] = { &fvi_fractional, &fvi_cq_bdf2,
                                                 &fvi_cq2_shifted };
    unsigned seed = 7;
    for (int i = 0; i < 30; i++) {
        const fvi_method *method = methods[i % 3];
        matrices m;
        random_matrix(&seed, 3, 0.5, &m.M);
        random_matrix(&seed, 3, 0.1, &m.K);
        random_matrix(&seed, 3, 0.1, &m.C);
        make(&m);
        fvi_run run = run_of(&m.system, 0.3, 0.1, ALL, x0, p0);
        run.kappa = i % 2 ? 0.5 : 0;
        double load = 0, low = 1e-3, high = 1e3;
        while (high / low > 1.0001) {
            run.h = sqrt(low * high);
            OK(fvi_stability_number(method, &run, &load));
            *(load < 1 ? &low : &high) = run.h;
        }
        double h = 0; /* the same: log2 h to 2^-12, and the 1.0001 of above */
        OK(fvi_stability_longest_step(method, &run, &h));
        ck_assert_near(log2(h / low), 0,
                       0x1p-12 * larger(1, fabs(log2(low))) + log2(1.0001),
                       "run %d", i);
        for (int above = 0; above < 2; above++) {
            run.h = low * (above ? 1.1 : 0.95);
            const int status = fvi_trajectory(method, &run, x, NULL, NULL);
            const double end = largest(x, ALL / 2, ALL),
                         begin = largest(x, 0, ALL / 2);
            ck_assert_msg(above ? status != 0 || end > 1e3 * begin
                                : status == 0 && end < begin,
                          "run %d, %d: %g, %g", i, above, begin, end);
        }
        drop(&m);
    }
}
END_TEST

START_TEST(loads_that_are_not_known_are_refused)
{
    const double one[3] = { 1, 1, 1 };
    unsigned seed = 7;
    double load = 7;
    matrices m;
    random_matrix(&seed, 3, 0.5, &m.M);
    random_matrix(&seed, 3, 0.1, &m.K);
    random_matrix(&seed, 3, 0.1, &m.C);
    make(&m);
    fvi_run run = run_of(&m.system, 0.7, 0.1, 9, one, one);
    run.kappa = 0;
    ck_assert_int_eq(fvi_stability_number(&fvi_cq2_shifted, &run, &load), FVI_EUNSUP);
    ck_assert_int_eq(fvi_stability_number(&fvi_lobatto_m2, &run, &load),
                     FVI_EUNSUP);
    ck_assert(load == 7);
    OK(fvi_stability_number(&fvi_cq2_midpoint, &run, &load));
    ck_assert(load == 0);
    double h = 7;
    ck_assert_int_eq(fvi_stability_longest_step(&fvi_cq2_shifted, &run, &h), FVI_EUNSUP);
    ck_assert_int_eq(fvi_stability_longest_step(&fvi_lobatto_m4, &run, &h), FVI_EUNSUP);
    fvi_stepper *s = NULL;
    ck_assert_int_eq(fvi_stepper_start(&fvi_lobatto_m4, &run, &s,
                                       NULL), FVI_EUNSUP);
    ck_assert(h == 7 && !s);
    drop(&m);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("structures");
    ADD_CASE(suite, "no matrices",
             eq_27_1_diagonal_matrices_are_masses_and_dampings,
             eq_27_1_laws_of_damping_take_matrices,
             a_copy_of_a_run_with_matrices_goes_on_alike);
    ADD_CASE(suite, "modes", eq_27_5_a_mode_of_the_bar_is_one_oscillator,
             eq_27_8_no_motion_of_fvi_stable_grows,
             eq_27_9_the_load_of_matrices,
             loads_that_are_not_known_are_refused);
    return run_suite(suite);
}
