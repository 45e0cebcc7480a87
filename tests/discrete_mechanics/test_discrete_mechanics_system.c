/* tests/discrete_mechanics/test_discrete_mechanics_system.c -- H 2: systems as data.
 * Run alone: make test-discrete_mechanics_system */
#include <fvi/error.h>
#include <fvi/system.h>
#include "harness/energy.h"
#include "harness/fvi_runs.h"
#include "harness/ulp.h"

#include "discrete_mechanics_ref.h"

#include <gsl/gsl_math.h>
#include <stdint.h>

static const double one[] = { 1, 1, 1 };

/* ---- values ---- */

/* The data of the springs are short binary fractions: every operation is exact,
 * 0 ulp. Of the pendulum: sin is within 1 ulp, 2 u, and g sin x has one rounding
 * more, so 3 u and half a unit of the reference: 4 ulp. In U, sin enters squared
 * (4 u), two products, two sums and g add 5 u: 10 ulp. Seen: 1. */
START_TEST(eq_2_1_potentials_and_their_derivatives)
{
    for (size_t r = 0; r < LEN(ref_potentials); r++) {
        const size_t d = ref_potentials[r].d;
        const double *x = ref_potentials[r].x;
        const fvi_potential u =
            potential(ref_potentials[r].kind, ref_potentials[r].cg);
        const int exact = ref_potentials[r].kind != PENDULUM;
        const fvi_system system = { d, one, one, u, { 0 }, NULL, NULL };
        double value, g[3], H[9];
        ck_assert_int_eq(fvi_potential_value(&system, x, &value), 0);
        ck_assert_int_eq(fvi_potential_gradient(&system, x, g), 0);
        ck_assert_int_eq(fvi_potential_hessian(&system, x, H), 0);
        ck_assert_ulp(value, ref_potentials[r].value, exact ? 0 : 10,
                      "U, row %zu", r);
        for (size_t i = 0; i < d; i++)
            ck_assert_ulp(g[i], ref_potentials[r].gradient[i], exact ? 0 : 4,
                          "gradient %zu, row %zu", i, r);
        for (size_t i = 0; i < d * d; i++)
            ck_assert_ulp(H[i], ref_potentials[r].hessian[i], exact ? 0 : 4,
                          "Hessian %zu, row %zu", i, r);
    }
}
END_TEST

static int is_quadratic(const fvi_potential *u)
{
    return u->quadratic && u->quadratic(u->params);
}

/* A promise of a constant Hessian is kept: it is made where g = 0, or where the
 * potential has no g, and nowhere else; and for the g of now, not for that of the
 * time when the potential was made. */
START_TEST(eq_2_1_quadratic_potentials_say_so)
{
    for (int kind = HARMONIC; kind <= PENDULUM; kind++) {
        double cg[] = { 2, 0 };
        const fvi_potential u = potential(kind, cg);
        ck_assert_int_eq(is_quadratic(&u),
                         kind == HARMONIC || kind == DUFFING || kind == CHAIN);
        cg[1] = 0x1p-1074;
        ck_assert_int_eq(is_quadratic(&u), kind == HARMONIC);
    }
}
END_TEST

/* Between two masses a spring pulls both, in opposite directions: in the sum over
 * all masses only the springs at the walls are left. */
START_TEST(eq_2_1_a_chain_pulls_only_at_its_walls)
{
    const double cg[] = { 1, 2 }, x[] = { 0.5, -1.25, 3, 0.75, 0.25 };
    const fvi_potential chain = fvi_potential_chain(cg);
    double g[5], sum = 0;
    ck_assert_int_eq(chain.gradient(5, x, chain.params, g), 0);
    for (size_t i = 0; i < 5; i++)
        sum += g[i]; /* exact: short binary fractions */
    ck_assert_double_eq(sum, (1 + 2 * 0.25) * 0.5 + (1 + 2 * 0.0625) * 0.25);
}
END_TEST

START_TEST(eq_2_1_forces)
{
    const double aT[] = { 8, 1 }, aw[] = { 3, 2 };
    const fvi_force step = fvi_force_step(aT), cosine = fvi_force_cosine(aw);
    const double at[] = { 0, 0.5, 1, 1 + 0x1p-52, -0x1p-1074, 7 };
    const double want[] = { 8, 8, 8, 0, 0, 0 };
    double F[2];
    for (size_t i = 0; i < LEN(at); i++) {
        step.value(at[i], 2, step.params, F);
        ck_assert(F[0] == want[i] && F[1] == want[i]);
        cosine.value(at[i], 2, cosine.params, F);
        ck_assert(F[0] == 3 * cos(2 * at[i]) && F[1] == F[0]);
    }
}
END_TEST

/* E = 1/2 (3^2/2 + (-2)^2/4) + U; exact. A free particle has no U. */
START_TEST(eq_2_4_energy)
{
    const double mass[] = { 2, 4 }, none[] = { 0, 0 }, cg[] = { 1, 2 };
    const double x[] = { 1, -1 }, p[] = { 3, -2 };
    fvi_system system = {
        2, mass, none, fvi_potential_duffing(cg), { 0 }, NULL, NULL
    };
    ck_assert_double_eq(energy_of(&system, x, p), 2.75 + 2 * (0.5 + 0.5));
    system.potential = (fvi_potential){ 0 };
    ck_assert_double_eq(energy_of(&system, x, p), 2.75);
}
END_TEST

/* ---- identities ---- */

/* With no table and no sympy: along a line, the slope of U is the gradient, and
 * the slope of the gradient the Hessian. For a quartic, the quotient of five
 * points (-1, 8, -8, 1)/12 d is the derivative, exactly, so only rounding is
 * left: (8 + 8 + 1 + 1)/(12 d) values with at most 20 roundings each. */
START_TEST(eq_2_1_derivatives_by_differences)
{
    const double cg[] = { 1.5, 0.75 }, delta = 0.25;
    const double x[] = { 0.5, -1.25, 0.875 };
    const double weight[] = { 1, -8, 0, 8, -1 };
    for (int kind = HARMONIC; kind < PENDULUM; kind++) {
        if (kind == CUBIC) /* only one-dimensional, and not the library's */
            continue;
        const fvi_potential u = potential(kind, cg);
        const fvi_system system = { 3, one, one, u, { 0 }, NULL, NULL };
        double g[3], H[9];
        fvi_potential_gradient(&system, x, g);
        fvi_potential_hessian(&system, x, H);
        for (size_t i = 0; i < 3; i++) {
            double slope = 0, slopes[3] = { 0 }, size = 0;
            for (size_t j = 0; j < 5; j++) {
                double z[3], value, gz[3];
                memcpy(z, x, sizeof z);
                z[i] += ((double)j - 2) * delta;
                fvi_potential_gradient(&system, z, gz);
                fvi_potential_value(&system, z, &value);
                slope += weight[j] * value / (12 * delta);
                size = larger(size, value);
                for (size_t k = 0; k < 3; k++) {
                    slopes[k] += weight[j] * gz[k] / (12 * delta);
                    size = larger(size, fabs(gz[k]));
                }
            }
            const double bound = 20 * 18 / (12 * delta) * size * U;
            ck_assert_near(slope, g[i], bound, "U, kind %d", kind);
            for (size_t k = 0; k < 3; k++)
                ck_assert_near(slopes[k], H[3 * i + k], bound,
                               "gradient, kind %d", kind);
        }
    }
}
END_TEST

/* ---- errors ---- */

/* H_ij = 1 + (i + j)(i + j + 1)/2 + i, all of them different, in so many diagonals. */
static int band_hessian(size_t d, const double *x, void *params, double *H)
{
    const size_t m = *(size_t *)params;
    (void)x;
    for (size_t i = 0; i < d; i++)
        for (size_t k = 0; k < m && i + k < d; k++)
            H[i * m + k] = (double)(1 + (2 * i + k) * (2 * i + k + 1) / 2 + i);
    return 0;
}

/* Narrow, as wide as the matrix, and wider: a chain of one mass has two diagonals. */
START_TEST(eq_2_1_a_hessian_out_of_diagonals)
{
    enum { MOST = 6, WIDE = 15 };
    for (size_t d = 1; d <= MOST; d++)
        for (size_t m = 1; m <= WIDE; m++) {
            const fvi_potential u = { .hessian = band_hessian,
                                      .params = &m,
                                      .diagonals = m };
            const fvi_system system = { d, one, one, u, { 0 }, NULL, NULL };
            double H[MOST * WIDE];
            const size_t room = fvi_potential_hessian_size(&system);
            ck_assert_uint_eq(room, d * (m > d ? m : d));
            for (size_t i = 0; i < room; i++)
                H[i] = GSL_NAN; /* nothing of what was there is left */
            ck_assert_int_eq(fvi_potential_hessian(&system, one, H), 0);
            for (size_t i = 0; i < d; i++)
                for (size_t j = 0; j < d; j++) {
                    const size_t a = i < j ? i : j, b = i + j - a;
                    ck_assert_double_eq(
                        H[i * d + j],
                        b - a < m ? (double)(1 + (a + b) * (a + b + 1) / 2 + a)
                                  : 0);
                }
        }
    const fvi_system vast = { SIZE_MAX / 16, one, one, { 0 }, { 0 }, NULL, NULL };
    ck_assert_uint_eq(fvi_potential_hessian_size(&vast), SIZE_MAX / 64);
}
END_TEST

START_TEST(systems_that_cannot_move_are_refused)
{
    const double c = 1;
    const double bad_mass[] = { 0, -1, GSL_NAN, GSL_POSINF };
    const double bad_damping[] = { -0x1p-1074, GSL_NAN, GSL_POSINF };
    const fvi_system good = { 2,     one, one, fvi_potential_harmonic(&c),
                              { 0 }, NULL, NULL };
    fvi_system s = good;
    ck_assert_int_eq(fvi_system_check(&good, NULL), FVI_SUCCESS);
    ck_assert_int_eq(fvi_system_check(NULL, NULL), FVI_EFAULT);
    s.mass = NULL;
    ck_assert_int_eq(fvi_system_check(&s, NULL), FVI_EFAULT);
    s = good, s.damping = NULL;
    ck_assert_int_eq(fvi_system_check(&s, NULL), FVI_EFAULT);
    s = good, s.d = 0;
    ck_assert_int_eq(fvi_system_check(&s, NULL), FVI_EINVAL);
    s.d = SIZE_MAX / 2; /* before a mass is read */
    ck_assert_int_eq(fvi_system_check(&s, NULL), FVI_EINVAL);
    s = good, s.potential.value = NULL;
    ck_assert_int_eq(fvi_system_check(&s, NULL), FVI_EINVAL);
    s = good, s.potential.gradient = NULL;
    ck_assert_int_eq(fvi_system_check(&s, NULL), FVI_EINVAL);
    s = good, s.potential.hessian = NULL;
    ck_assert_int_eq(fvi_system_check(&s, NULL), FVI_EINVAL);
    s = good, s.potential = (fvi_potential){ 0 };
    ck_assert_int_eq(fvi_system_check(&s, NULL), FVI_SUCCESS);
    for (size_t i = 0; i < LEN(bad_mass); i++) {
        const double mass[] = { 1, bad_mass[i] }; /* the second one, too */
        s = good, s.mass = mass;
        ck_assert_int_eq(fvi_system_check(&s, NULL), FVI_EDOM);
    }
    for (size_t i = 0; i < LEN(bad_damping); i++) {
        const double damping[] = { 0, bad_damping[i] };
        s = good, s.damping = damping;
        ck_assert_int_eq(fvi_system_check(&s, NULL), FVI_EDOM);
    }
}
END_TEST

/* What gathers the largest error of a run must not pass over a NaN, wherever it stands. */
START_TEST(a_nan_is_the_larger_and_the_smaller)
{
    const double numbers[] = { 1, -2, 5, 3 };
    double most = 0, least = 9;
    for (size_t i = 0; i < LEN(numbers); i++) {
        most = larger(most, numbers[i]);
        least = smaller(least, numbers[i]);
    }
    ck_assert(most == 5 && least == -2);
    for (size_t bad = 0; bad < LEN(numbers); bad++) {
        most = 0, least = 9;
        for (size_t i = 0; i < LEN(numbers); i++) {
            most = larger(most, i == bad ? (double)NAN : numbers[i]);
            least = smaller(least, i == bad ? (double)NAN : numbers[i]);
        }
        ck_assert(isnan(most) && isnan(least));
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("02 systems");
    ADD_CASE(suite, "values", eq_2_1_potentials_and_their_derivatives,
             eq_2_1_quadratic_potentials_say_so,
             eq_2_1_a_chain_pulls_only_at_its_walls, eq_2_1_forces,
             eq_2_4_energy);
    ADD_CASE(suite, "identities", eq_2_1_derivatives_by_differences,
             eq_2_1_a_hessian_out_of_diagonals);
    ADD_CASE(suite, "errors", systems_that_cannot_move_are_refused);
    ADD_CASE(suite, "largest", a_nan_is_the_larger_and_the_smaller);
    return run_suite(suite);
}
