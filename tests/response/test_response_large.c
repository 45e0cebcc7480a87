/* tests/response/test_response_large.c -- Undamped modes and poles of large structures.  [H 30]
 * Run alone: make test-response_large */
#include "response_systems.h"

#include "frequency/undamped_modes.h"

#include "../../figures/structures/cantilever.h"

/* A ring of n masses moves freely: lambda_k = 4 sin^2(k pi / n), each but the first and the last
 * twice, the first 0. Up to 256 by full matrices, above by subspaces, which settle to 1e-9. */
START_TEST(free_structures_have_modes)
{
    static const size_t sizes[] = { 40, 400 };
    for (size_t l = 0; l < LEN(sizes); l++) {
        const size_t n = sizes[l], count = 7;
        fvi_triplet *list = malloc(4 * n * sizeof *list);
        size_t of_K = 0;
        double lambda[7], *v = malloc(count * n * sizeof *v);
        fvi_sparse M, K;
        for (size_t i = 0; i < n; i++)
            list[i] = (fvi_triplet){ (int)i, (int)i, 1 };
        OK(fvi_sparse_assemble(n, n, list, &M));
        for (size_t i = 0; i < n; i++) {
            const int a = (int)i, b = (int)((i + 1) % n);
            list[of_K++] = (fvi_triplet){ a, a, 1 };
            list[of_K++] = (fvi_triplet){ b, b, 1 };
            list[of_K++] = (fvi_triplet){ a, b, -1 };
            list[of_K++] = (fvi_triplet){ b, a, -1 };
        }
        OK(fvi_sparse_assemble(n, of_K, list, &K));
        OK(fvi_undamped_modes(&M, &K, count, lambda, v));
        for (size_t k = 0; k < count; k++) {
            const double omega = 2 * sin((double)((k + 1) / 2) * M_PI / (double)n);
            ck_assert_near(lambda[k], omega * omega, 1e-9 * (omega * omega + 1e-4),
                           "mode %zu of %zu", k, n);
        }
        for (size_t j = 0; j < count; j++)
            for (size_t k = 0; k <= j; k++) {
                double sum = 0;
                for (size_t i = 0; i < n; i++)
                    sum += v[j * n + i] * v[k * n + i];
                ck_assert_near(sum, j == k, 1e-9, "v_%zu v_%zu", j, k);
            }
        fvi_sparse_free(&M);
        fvi_sparse_free(&K);
        free(list);
        free(v);
    }
}
END_TEST

/* A chain of n equal masses with equal springpots: each mode is one oscillator, omega_k = 2 sin(k pi
 * / (2 n + 2)), and its pole is that of H 11. Of more than 64 masses only the modes that are asked for
 * are looked for, of more than 256 by subspace iteration. */
START_TEST(the_lowest_poles_of_long_chains)
{
    static const size_t lengths[] = { 30, 100, 1000 };
    for (size_t l = 0; l < LEN(lengths); l++) {
        const size_t n = lengths[l];
        double *mass = malloc(2 * n * sizeof *mass), *rho = mass + n;
        const double cg[2] = { 1, 0 };
        for (size_t i = 0; i < n; i++) {
            mass[i] = 1;
            rho[i] = 0.01;
        }
        const fvi_system system = { .d = n, .mass = mass, .damping = rho,
                                    .potential = fvi_potential_chain(cg) };
        const fvi_linear_motion motion = { .system = &system, .alpha = 0.3 };
        fvi_response *r = response_of(&motion);
        fvi_poles p = poles_of(r, 6);
        ck_assert_uint_eq(p.count, 6);
        ck_assert_uint_eq(p.expected, n);
        for (size_t k = 0; k < 6; k++) {
            const double omega = 2 * sin((double)(k + 1) * M_PI / (2.0 * (double)n + 2));
            const fvi_linear_oscillator one = { .m = 1, .c = omega * omega, .rho = 0.01,
                                                .alpha = 0.3 };
            double re, im;
            OK(fvi_exact_pole(&one, &re, &im, NULL));
            /* K's largest eigenvalue, 4, is rounded, and s^2 is as small as omega^2 */
            const double bound = 16 * U * 4 / hypot(re, im);
            ck_assert_near(p.pole[2 * k], re, bound, "re %zu of %zu", k, n);
            ck_assert_near(p.pole[2 * k + 1], im, bound, "im %zu of %zu", k, n);
        }
        fvi_poles_free(&p);
        fvi_response_free(r);
        free(mass);
    }
}
END_TEST

/* A clamped beam of 8 and of 64 elements with C = K / 50: each mode is one oscillator with the damping
 * of its own stiffness. lambda is rounded by some u of the largest, 1e5 or 1e9. Another program gave
 * the first pole as well. Seen: 0.4 of the bound. */
START_TEST(poles_of_a_beam_are_those_of_its_modes)
{
    static const int elements[] = { 8, 64 };
    for (size_t l = 0; l < LEN(elements); l++) {
        fvi_sparse M, K, C;
        fvi_structure *structure;
        OK(cantilever(elements[l], 0.02, &M, &K, &C));
        OK(fvi_structure_alloc(&M, &K, &C, &structure, NULL));
        const fvi_system system = fvi_structure_system(structure);
        const fvi_linear_motion motion = { .system = &system, .alpha = 0.25 };
        fvi_response *r = response_of(&motion);
        fvi_poles p = poles_of(r, 4);
        double lambda[4], *v = malloc(4 * M.n * sizeof *v);
        OK(fvi_undamped_modes(&M, &K, 4, lambda, v));
        ck_assert_uint_eq(p.expected, M.n);
        for (size_t k = 0; k < 4; k++) {
            const fvi_linear_oscillator one = { .m = 1, .c = lambda[k], .rho = 0.02 * lambda[k],
                                                .alpha = 0.25 };
            double re, im;
            OK(fvi_exact_pole(&one, &re, &im, NULL));
            const double bound = 16 * U * 50 * pow(elements[l], 4) / hypot(re, im);
            ck_assert_near(p.pole[2 * k], re, bound, "re %zu of %d", k, elements[l]);
            ck_assert_near(p.pole[2 * k + 1], im, bound, "im %zu of %d", k, elements[l]);
        }
        if (elements[l] == 8) {
            ck_assert_near(p.pole[0], -0.046616901488211, 2e-11, "re");
            ck_assert_near(p.pole[1], 3.56264353738462, 2e-11, "im");
        }
        free(v);
        fvi_poles_free(&p);
        fvi_response_free(r);
        fvi_structure_free(structure);
        fvi_sparse_free(&M);
        fvi_sparse_free(&K);
        fvi_sparse_free(&C);
    }
}
END_TEST

/* Eighty bodies that know nothing of each other, with omega_i = 1 + i/10. The fifth has a damping of
 * order 1.6, which acts like a mass and brings its pole below the three lowest: it is among the four more
 * that are looked at. */
START_TEST(damping_may_bring_a_pole_below_others)
{
    enum { D = 80, DAMPED = 4, COUNT = 3 };
    static double mass[D], rho[D];
    const double c = 1;
    for (size_t i = 0; i < D; i++)
        mass[i] = pow(1 + 0.1 * (double)i, -2);
    rho[DAMPED] = 1.2;
    const fvi_system system = { .d = D, .mass = mass, .damping = rho,
                                .potential = fvi_potential_harmonic(&c) };
    const fvi_linear_motion motion = { .system = &system, .alpha = 0.8 };
    const fvi_linear_oscillator one = { .m = mass[DAMPED], .c = c, .rho = rho[DAMPED], .alpha = 0.8 };
    double re, im;
    OK(fvi_exact_pole(&one, &re, &im, NULL));
    ck_assert(hypot(re, im) < 1);
    fvi_response *r = response_of(&motion);
    fvi_poles p = poles_of(r, COUNT);
    ck_assert_uint_eq(p.count, COUNT);
    ck_assert_near(p.pole[0], re, 1e-13, "re");
    ck_assert_near(p.pole[1], im, 1e-13, "im");
    ck_assert_near(p.pole[3], 1, 1e-13, "the lowest without damping");
    fvi_poles_free(&p);
    fvi_response_free(r);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("response_large");
    ADD_CASE(suite, "large", free_structures_have_modes,
             the_lowest_poles_of_long_chains, damping_may_bring_a_pole_below_others,
             poles_of_a_beam_are_those_of_its_modes);
    return run_suite(suite);
}
