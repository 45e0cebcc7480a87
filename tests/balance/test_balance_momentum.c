/* tests/balance/test_balance_momentum.c -- H 21: momenta and energy.
 *                                Run alone: make test-balance_momentum */
#include "balance/balance_runs.h"
#include "balance/balance_ref.h"
#include "system/larger.h"

enum { D = 2, N = 60 };

/* D_k = h^(-order) sum w_n z_{k-n} and the sum of its sizes; order beta may be
 * negative. The weights in long double, by (4.2). */
static double derivative(double beta, double h, size_t k, const double *z,
                         size_t stride, double *size)
{
    long double w = 1, sum = 0, sizes = 0;
    for (size_t n = 0; n <= k; n++) {
        if (n > 0)
            w *= ((long double)n - 1 - (long double)beta) / (long double)n;
        sum += w * (long double)z[(k - n) * stride];
        sizes += fabsl(w * (long double)z[(k - n) * stride]);
    }
    *size = pow(h, -beta) * (double)sizes;
    return pow(h, -beta) * (double)sum;
}

/* What the memory of fvi acts on, for each past. */
static void acts_on(fvi_initial_history past, double alpha, double h, const double *v0,
                    const double *x, double *z)
{
    for (size_t k = 0; k <= N; k++)
        for (size_t i = 0; i < D; i++) {
            z[k * D + i] = x[k * D + i];
            if (past != FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE)
                z[k * D + i] -= x[i];
            if (past == FVI_INITIAL_HISTORY_CAPUTO && 2 * alpha > 1)
                z[k * D + i] -= (double)k * h * v0[i];
        }
}

static const fvi_initial_history pasts[] = { FVI_INITIAL_HISTORY_HELD, FVI_INITIAL_HISTORY_CAPUTO,
                                  FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE };

/* (21.7): angular momentum and the torque of the memory, isotropic damping or not.
 * One step of fvi rounds p by (k + 30) u times the sizes of what is added, of which
 * the memory's is a sum of k + 1, and of m x/h, as x + dx is rounded. Seen: 0.004 of it. */
START_TEST(eq_21_7_the_memory_turns_the_angular_momentum)
{
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    for (int run = 0; run < 90; run++) {
        const fvi_initial_history past = pasts[run % 3];
        const double alpha = between(random, 0.05, run % 3 == 2 ? 0.5 : 0.95);
        const double mass[] = { 1.5, 1.5 }, h = between(random, 0.02, 0.2);
        const double rho[] = { 0.6, run % 2 ? 0.6 : 0.1 };
        const fvi_system system = {
            .d = D, .mass = mass, .damping = rho, .potential = central
        };
        const fvi_balance_scheme s =
            scheme_of(0, &system, alpha, between(random, 0, 1), h);
        const double x0[] = { 1, -0.5 }, p0[] = { 0.5, 1 };
        const double v0[] = { p0[0] / 1.5, p0[1] / 1.5 };
        double x[D * (N + 1)], p[D * (N + 1)], z[D * (N + 1)], lost = 0;
        trajectory(0, &s, past, N, x0, p0, x, p);
        acts_on(past, alpha, h, v0, x, z);
        for (size_t k = 0; k < N; k++) {
            const double *a = x + k * D, *b = a + D, *P = p + k * D, *Q = P + D;
            double g[D], torque = 0, size = 0;
            central_gradient(D, b, NULL, g);
            for (size_t i = 0; i < D; i++) {
                double sizes, lever = i ? b[0] : -b[1];
                double f = h * rho[i]
                           * derivative(2 * alpha, h, k + 1, z + i, D, &sizes);
                torque -= f * lever;
                size += (fabs(P[i]) + h * rho[i] * sizes + 4 * h * fabs(g[i])
                         + mass[i] / h * (fabs(a[i]) + fabs(b[i])))
                        * (fabs(b[0]) + fabs(b[1]) + fabs(a[0]) + fabs(a[1]));
            }
            const double before = a[0] * P[1] - a[1] * P[0];
            const double after = b[0] * Q[1] - b[1] * Q[0];
            ck_assert_near(after - before, torque, ((double)k + 30) * U * size,
                           "run %d, k = %zu", run, k);
            lost = larger(lost, fabs(after - before));
        }
        ck_assert(lost > 1e-4); /* isotropic damping does not spare it */
    }
    gsl_rng_free(random);
}
END_TEST

/* (21.10): the momentum of two bodies in free space, unequal masses and dampings; with
 * no spring between them each is a free particle. z_0 is 0 but for Riemann and
 * Liouville, where the start leaves D_0 out. Step j adds (j + 20) u of its sizes.
 * Seen: 0.036 of it. */
//> dressed
START_TEST(eq_21_10_the_dressed_momentum_is_conserved)
{
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    for (int run = 0; run < 90; run++) {
        const fvi_initial_history past = pasts[run % 3];
        const double alpha = run < 3 ? 0.5 : between(random, 0, 1);
        const double mass[] = { 1, 3 }, rho[] = { 0.7, 0.2 }, h = 0.1;
        const fvi_system system = {
            .d = D, .mass = mass, .damping = rho, .potential = two_bodies
        };
        const fvi_balance_scheme s =
            scheme_of(0, &system, alpha, between(random, 0, 1), h);
        const double x0[] = { 1, -0.5 }, p0[] = { 0.5, 1 };
        const double v0[] = { p0[0], p0[1] / 3 };
        double x[D * (N + 1)], p[D * (N + 1)], z[D * (N + 1)], first = 0;
        double rounding = 0;
        trajectory(0, &s, past, N, x0, p0, x, p);
        acts_on(past, alpha, h, v0, x, z);
        for (size_t k = 0; k <= N; k++) {
            double dressed = 0, size, own = 0;
            for (size_t i = 0; i < D; i++) {
                dressed += p[k * D + i];
                dressed +=
                    rho[i] * derivative(2 * alpha - 1, h, k, z + i, D, &size);
                own += rho[i] * size;
                derivative(2 * alpha, h, k, z + i, D, &size);
                rounding += ((double)k + 20) * U
                            * (fabs(p[k * D + i]) + h * rho[i] * size
                               + h * (fabs(x[k * D]) + fabs(x[k * D + 1])) * 8);
            }
            if (k == 0)
                first =
                    p0[0] + p0[1]
                    + pow(h, 1 - 2 * alpha) * (rho[0] * z[0] + rho[1] * z[1]);
            ck_assert_near(dressed, first,
                           rounding + ((double)k + 20) * U * own,
                           "run %d, alpha = %g, k = %zu", run, alpha, k);
        }
    }
    gsl_rng_free(random);
}
END_TEST
//< dressed

/* (21.8): a solution that is turned solves the linearised equation, if the damping is
 * the same in all directions; paired with a backward variation it is constant. The
 * backward variation is made by its own recursion, the force of the memory summed as it
 * stands; Riemann-Liouville, so that the memory acts on x. Bound: (8 N + 200) u of the
 * sizes of the first form, times N. Seen: 0.00002 of it. */
START_TEST(eq_21_8_a_turned_solution_pairs_with_a_backward_variation)
{
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    for (int run = 0; run < 60; run++) {
        const double mass[] = { 1, 1 }, rho[] = { 0.5, run % 4 ? 0.5 : 0.1 };
        const fvi_system system = {
            .d = D, .mass = mass, .damping = rho, .potential = central
        };
        const double h = 0.1, alpha = between(random, 0.05, 0.5);
        const fvi_balance_scheme s =
            scheme_of(0, &system, alpha, 1, h); /* explicit */
        const double x0[] = { 1, -0.5 }, p0[] = { 0.5, 1 };
        double x[D * (N + 1)], u[D * (N + 1)], v[D * (N + 1)], t[MOST + 3];
        double C[N], size = 0, far = 0;
        trajectory(0, &s, FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE, N, x0, p0, x, NULL);
        memory_of(&s, N, t);
        for (size_t k = 0; k <= N; k++) {
            u[k * D] = -x[k * D + 1];
            u[k * D + 1] = x[k * D];
        }
        for (size_t j = 0; j < 2 * D; j++)
            v[(N - 1) * D + j] = between(random, -1, 1);
        for (size_t k = N - 1; k > 0; k--) { /* kappa = 1: U'' at x_k only */
            double H[4];
            central_hessian(D, x + k * D, NULL, H);
            for (size_t i = 0; i < D; i++) {
                double a = 2 * v[k * D + i] - v[(k + 1) * D + i];
                a -=
                    h * h * (H[2 * i] * v[k * D] + H[2 * i + 1] * v[k * D + 1]);
                for (size_t j = k; j <= N; j++)
                    a -= h * rho[i] * t[j - k + 1] * v[j * D + i];
                v[(k - 1) * D + i] = a;
            }
        }
        ck_assert_int_eq(fvi_green_form(&s, N, x, u, v, C), FVI_SUCCESS);
        for (size_t n = 0; n <= N; n++)
            for (size_t i = 0; i < D; i++)
                size = larger(size, fabs(u[n * D + i]) + fabs(v[n * D + i]));
        for (size_t n = 1; n < N; n++)
            far = larger(far, fabs(C[n] - C[0]));
        const double bound = (8 * N + 200) * U * N * size * size
                             * (4 / h + 2 * pow(h, 1 - 2 * alpha));
        if (run % 4) {
            seen_worst(far / bound, "of the bound");
            ck_assert_msg(far <= bound, "run %d: %g of the bound", run,
                          far / bound);
        } else
            ck_assert(far > 1e-3); /* the damping has directions of its own */
    }
    gsl_rng_free(random);
}
END_TEST

/* (12.15), (12.16): the energies of numbers that solve nothing, springs 2, h = 1/4, all
 * of them short binary fractions. Tolerance 0. */
START_TEST(eq_12_16_the_energies_without_rounding)
{
    const double mass[] = { 1, 2 }, damping[] = { 0.5, 1.5 },
                 spring[] = { 2, 0 };
    const fvi_system system = { .d = D,
                                .mass = mass,
                                .damping = damping,
                                .potential = fvi_potential_chain(spring) };
    for (size_t i = 0; i < LEN(ref_energies); i++) {
        const fvi_balance_scheme s = {
            &system, ref_energies[i].alpha,   ref_energies[i].kappa,
            0.25,    ref_energies[i].weights, ref_energies[i].theta
        };
        double E[5], hat[5];
        ck_assert_int_eq(fvi_scheme_energy(&s, 5, ref_x, E, hat), FVI_SUCCESS);
        for (size_t n = 0; n < 5; n++) {
            ck_assert_near(E[n], ref_energies[i].E[n], 0, "row %zu, n = %zu", i,
                           n);
            ck_assert_near(hat[n], ref_energies[i].hat[n], 0,
                           "row %zu, n = %zu", i, n);
        }
    }
}
END_TEST

/* A run for the energy: two masses on a chain, x_0 != 0; for 2 alpha > 1 without
 * velocity. Steps short and long. */
typedef struct {
    double mass[D], rho[D], spring[2], x[D * (N + 1)], E[N], hat[N];
    fvi_system system;
    fvi_balance_scheme scheme;
    size_t steps; /* before x leaves 1e150 */
} energy_run;

static void run_energy(gsl_rng *random, int method, energy_run *a)
{
    const double alpha = between(random, 0.02, 1), x0[] = { 1, -0.5 };
    const double p0[] = { 2 * alpha > 1 ? 0 : 1, 2 * alpha > 1 ? 0 : -1 };
    a->mass[0] = between(random, 0.5, 2), a->mass[1] = 1;
    a->rho[0] = between(random, 0, 2), a->rho[1] = between(random, 0, 2);
    a->spring[0] = between(random, 0.1, 2), a->spring[1] = 0;
    a->system = (fvi_system){ .d = D,
                              .mass = a->mass,
                              .damping = a->rho,
                              .potential = fvi_potential_chain(a->spring) };
    a->scheme = scheme_of(method, &a->system, alpha, between(random, 0, 1),
                          between(random, 0.1, 1.5));
    trajectory(method, &a->scheme, FVI_INITIAL_HISTORY_HELD, N, x0, p0, a->x, NULL);
    for (a->steps = 0; a->steps < N; a->steps++)
        if (!(fabs(a->x[a->steps * D + D]) < 1e100))
            break;
    ck_assert_int_eq(
        fvi_scheme_energy(&a->scheme, a->steps, a->x, a->E, a->hat),
        FVI_SUCCESS);
}

/* The rounding of one step's balance: N + 60 u of what is squared in it.
 * Seen: 0.003 of it. */
static double balance_rounding(const energy_run *a, size_t k)
{
    double most = 0, sum = 0;
    const double h = a->scheme.h;
    for (size_t i = 0; i < (k + 2) * D; i++)
        most = larger(most, fabs(a->x[i] - a->x[i % D]) + fabs(a->x[i % D]));
    for (size_t i = 0; i < D; i++)
        sum += 4 * a->mass[i] / (h * h) + 4 * a->spring[0]
               + 8 * pow(4, 2 * a->scheme.alpha) * a->rho[i]
                     * pow(h, -2 * a->scheme.alpha);
    return (N + 60) * U * sum * most * most;
}

/* (21.11): what a step changes is the work on the mean displacement, all three
 * schemes. */
START_TEST(eq_21_11_the_work_is_done_on_the_mean_displacement)
{
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    for (int i = 0; i < 300; i++) {
        energy_run a;
        double t[MOST + 3];
        run_energy(random, i % 3, &a);
        memory_of(&a.scheme, N, t);
        for (size_t k = 1; k < a.steps; k++) {
            double work = 0;
            for (size_t l = 0; l < D; l++) {
                double X = 0, *x = a.x + l;
                for (size_t j = 0; j <= k + 1; j++)
                    X += t[k + 1 - j] * (x[j * D] - x[0]);
                work += (x[k * D + D] - x[k * D - D]) / 2 * a.rho[l] * X
                        / a.scheme.h;
            }
            ck_assert_near(a.E[k] - a.E[k - 1], -work, balance_rounding(&a, k),
                           "run %d, k = %zu", i, k);
        }
    }
    gsl_rng_free(random);
}
END_TEST

/* (21.12): hat never exceeds the start, stable or not. */
//> falls
START_TEST(eq_21_12_no_scheme_gains_from_its_memory)
{
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    double grown = 0;
    for (int i = 0; i < 1500; i++) {
        energy_run a;
        double start, rounding = 0;
        run_energy(random, i % 3, &a);
        start = a.E[0];
        for (size_t l = 0; l < D; l++)
            start += a.scheme.theta / 2 * a.rho[l]
                     * pow(a.scheme.h, -2 * a.scheme.alpha)
                     * (a.x[D + l] - a.x[l]) * (a.x[D + l] - a.x[l]);
        for (size_t k = 0; k < a.steps; k++) {
            rounding += balance_rounding(&a, k);
            ck_assert_msg(a.hat[k] <= start + rounding, "run %d, k = %zu: %g",
                          i, k, a.hat[k] - start);
            grown = larger(grown, a.E[k] / start);
        }
    }
    ck_assert(grown > 1e10); /* some of them are unstable */
    gsl_rng_free(random);
}
END_TEST
//< falls

int main(void)
{
    Suite *suite = suite_create("balance: momenta and energy");
    ADD_CASE(suite, "Noether", eq_21_7_the_memory_turns_the_angular_momentum,
             eq_21_8_a_turned_solution_pairs_with_a_backward_variation,
             eq_21_10_the_dressed_momentum_is_conserved);
    ADD_CASE(suite, "energy", eq_12_16_the_energies_without_rounding,
             eq_21_11_the_work_is_done_on_the_mean_displacement,
             eq_21_12_no_scheme_gains_from_its_memory);
    return run_suite(suite);
}
