/* tests/response/test_response_pole_count.c -- The number of poles. [H 30]
 * Run alone: make test-response_pole_count */
#include "response_systems.h"

#include "frequency/pole_boxes.h"
#include "frequency/pole_count.h"

/* n poles are found, and as many are expected. */
static void ck_assert_poles(const fvi_linear_motion *motion, size_t n)
{
    fvi_response *r = response_of(motion);
    fvi_poles p = poles_of(r, 0);
    ck_assert_uint_eq(p.count, n);
    ck_assert_uint_eq(p.expected, n);
    fvi_poles_free(&p);
    fvi_response_free(r);
}

/* ---- as many as unknowns ---- */

/* A system of 2 to 12 masses with 1 to 3 dampers; its laws have orders below 1, or powers above. */
static void random_system(uint64_t *seed, int above, linear_system *s)
{
    *s = (linear_system){ .d = 2 + (size_t)(11 * chance(seed)),
                          .dampers = 1 + (size_t)(3 * chance(seed)) };
    double k[MOST];
    for (size_t i = 0; i < s->d; i++) {
        s->mass[i] = exp(2 * chance(seed) - 1);
        k[i] = exp(4 * chance(seed) - 2);
    }
    springs(s, k);
    for (size_t j = 0; j < s->dampers; j++) {
        for (size_t i = 0; i < s->d; i++)
            s->row[j][i] = chance(seed) < 0.4 ? 2 * chance(seed) - 1 : 0;
        s->row[j][(size_t)((double)s->d * chance(seed))] = 1;
        const double a = 0.01 + 0.48 * chance(seed), b = a * chance(seed);
        const double rho = exp(6 * chance(seed) - 3), time = exp(4 * chance(seed) - 2);
        const fvi_kernel_kind kinds[] = { FVI_KERNEL_POWER, FVI_KERNEL_ZENER,
                                          FVI_KERNEL_MAXWELL2, FVI_KERNEL_DAVIDSON,
                                          FVI_KERNEL_DISTRIBUTED, FVI_KERNEL_HAVRILIAK };
        const fvi_kernel_kind kind = kinds[above ? 0 : (size_t)(6 * chance(seed))];
        s->term[j][0] = (fvi_kernel_term){ kind, rho, above ? 0.5 + a : a, time,
                                           kind == FVI_KERNEL_DISTRIBUTED ? 0.49 : b };
        s->kernel[j].count = 1;
        if (kind != FVI_KERNEL_DAVIDSON && !above && chance(seed) < 0.3) { /* beside it */
            s->term[j][1] = (fvi_kernel_term){ FVI_KERNEL_MAXWELL, rho * chance(seed), 0,
                                               time * chance(seed), 0 };
            s->kernel[j].count = 2;
        }
    }
    point_into(s);
}

static void check_poles(linear_system *s, int i)
{
    const fvi_linear_motion motion = { .system = &s->system };
    fvi_response *r = response_of(&motion);
    fvi_poles p = poles_of(r, 0);
    ck_assert_msg(p.count == s->d && p.expected == s->d, "%d: %zu of %zu, expected %zu", i,
                  p.count, s->d, p.expected);
    for (size_t k = 0; k < p.count; k++) {
        ck_assert_near(p.residual[k], 0, 1e-13, "%d, pole %zu", i, k);
        ck_assert(p.pole[2 * k] <= 0 && p.pole[2 * k + 1] > 0);
    }
    const double low = log(cabs(pole(&p, 0))), high = log(cabs(pole(&p, p.count - 1)));
    if (i % 5 == 0) {
        const size_t counted = fvi_poles_counted(r, low - 12, high + 12);
        ck_assert_msg(counted == s->d, "%d: counted %zu of %zu", i, counted, s->d);
    }
    fvi_poles_free(&p);
    fvi_response_free(r);
}

START_TEST(eq_30_7_there_are_as_many_poles_as_unknowns)
{
    uint64_t seed = 7;
    for (int i = 0; i < 300; i++) { /* of a larger search: 5000 of 5000 */
        linear_system s;
        random_system(&seed, i % 3 == 2, &s);
        check_poles(&s, i);
    }
}
END_TEST

/* A power below 1 and one above: the theorem is silent, and the poles are counted. A power of order 1
 * alone: counted; beside another in one law: by the theorem. Above 24 unknowns nothing is counted. */
START_TEST(eq_30_7_laws_on_both_sides_are_counted)
{
    linear_system s;
    make_system(2, &s);
    s.term[1][0].alpha = 0.25;
    const fvi_linear_motion motion = { .system = &s.system };
    fvi_response *r = response_of(&motion);
    ck_assert_int_eq(fvi_poles_by_theorem(r, 1), 0);
    ck_assert_poles(&motion, 2);
    s.term[0][0].alpha = 0.5;
    ck_assert_int_eq(fvi_poles_by_theorem(r, 1), 0);
    s.term[0][1] = s.term[1][0];
    s.kernel[0].count = 2;
    ck_assert_int_eq(fvi_poles_by_theorem(r, 1), 1);
    ck_assert_int_eq(fvi_poles_by_theorem(r, 0), 0);
    fvi_response_free(r);
}
END_TEST

/* Two springpots in series, of the orders 2 alpha and 2 end: their symbol has poles of its own if 2 (alpha - end) > 1,
 * and then nothing is counted. */
START_TEST(eq_30_7_springpots_in_series_are_counted_if_their_symbol_has_no_poles)
{
    linear_system s;
    make_system(2, &s);
    s.term[1][0] = (fvi_kernel_term){ FVI_KERNEL_MAXWELL2, 1, 0.7, 2, 0.3 };
    const fvi_linear_motion motion = { .system = &s.system };
    fvi_response *r = response_of(&motion);
    ck_assert_int_eq(fvi_poles_by_theorem(r, 1), 0);
    ck_assert_poles(&motion, 2);
    fvi_response_free(r);
    s.term[1][0].alpha = 0.9;
    r = response_of(&motion);
    ck_assert_uint_eq(fvi_poles_counted(r, -5, 5), SIZE_MAX);
    fvi_response_free(r);
}
END_TEST

/* ---- fewer ---- */

/* A mode that creeps back has no pole that oscillates, and the count says so. Each of these four masses
 * is an oscillator of its own, with m = 1, k = 4 and a dashpot c_i. It is overdamped from c = 4 on. */
START_TEST(eq_30_8_overdamped_modes_are_not_counted)
{
    linear_system s = { .d = 4, .dampers = 3, .mass = { 1, 1, 1, 1 } };
    for (size_t i = 0; i < 4; i++)
        s.K[i * 4 + i] = 4;
    const double c[3] = { 1, 5, 3.9 };
    for (size_t j = 0; j < 3; j++) {
        s.row[j][j] = 1;
        s.term[j][0] = (fvi_kernel_term){ FVI_KERNEL_POWER, c[j], 0.5, 0, 0 };
        s.kernel[j].count = 1;
    }
    point_into(&s);
    const fvi_linear_motion motion = { .system = &s.system };
    fvi_response *r = response_of(&motion);
    fvi_poles p = poles_of(r, 0);
    ck_assert_uint_eq(p.count, 3);
    ck_assert_uint_eq(p.expected, 3);
    for (size_t k = 0; k < 3; k++)
        ck_assert_near(cabs(pole(&p, k)), 2, 1e-14, "|s| of %zu", k);
    fvi_poles_free(&p);
    p = poles_of(r, 2);
    ck_assert_uint_eq(p.count, 2);
    ck_assert_uint_eq(p.expected, 3);
    fvi_poles_free(&p);
    fvi_response_free(r);
}
END_TEST

/* A free body with a springpot to the ground: m s^2 + rho s^(2 alpha) = 0 has a pole at the angle
 * pi / (2 - 2 alpha) if 2 alpha < 1, and none else. Beside it a mass on a spring. */
START_TEST(a_free_body_swings_on_its_springpot)
{
    linear_system s = { .d = 2, .dampers = 1, .mass = { 2, 1 } };
    s.K[3] = 9;
    s.row[0][0] = 1;
    s.term[0][0] = (fvi_kernel_term){ FVI_KERNEL_POWER, 3, 0.25, 0, 0 };
    s.kernel[0].count = 1;
    point_into(&s);
    const fvi_linear_motion motion = { .system = &s.system };
    fvi_response *r = response_of(&motion);
    fvi_poles p = poles_of(r, 0);
    ck_assert_uint_eq(p.count, 2);
    ck_assert_uint_eq(p.expected, 2);
    const double complex want = pow(1.5, 1 / 1.5) * cexp(I * M_PI / 1.5);
    ck_assert_near(cabs(pole(&p, 0) - want), 0, 1e-14, "the free body");
    ck_assert_near(cabs(pole(&p, 1) - 3 * I), 0, 1e-14, "the other");
    fvi_poles_free(&p);
    fvi_response_free(r);
    s.term[0][0].alpha = 0.75;
    ck_assert_poles(&motion, 1);
}
END_TEST

/* Three masses in a ring move freely, but for springpots to the ground: two modes are
 * oscillators, s^2 + 0.3 + 0.1 s^(3/2) = 0. The third is s^(1/2) = -0.1, which has no
 * solution. Its lambda is 0 but for rounding, and must not become the start of a pole. */
START_TEST(a_free_ring_has_two_poles)
{
    linear_system s = { .d = 3, .dampers = 3, .mass = { 1, 1, 1 } };
    for (size_t i = 0; i < 3; i++) {
        for (size_t j = 0; j < 3; j++)
            s.K[i * 3 + j] = i == j ? 0.2 : -0.1;
        s.row[i][i] = 1;
        s.term[i][0] = (fvi_kernel_term){ FVI_KERNEL_POWER, 0.1, 0.75, 0, 0 };
        s.kernel[i].count = 1;
    }
    point_into(&s);
    const fvi_linear_motion motion = { .system = &s.system };
    ck_assert_poles(&motion, 2);
}
END_TEST

/* The lambda of a free chain is 0 but for rounding errors, which are those of the largest lambda. A light mass makes that
 * lambda large, far above |K| / |M|. A damper between two masses does not act on the free motion. */
START_TEST(free_chains_of_unequal_masses_have_one_pole_less_than_masses)
{
    uint64_t seed = 7;
    for (int chain = 0; chain < 100; chain++) {
        linear_system s = { .d = 3 + (size_t)(4 * chance(&seed)), .dampers = 1, .row = { { -1, 1 } } };
        double k[MOST] = { 0 };
        for (size_t i = 0; i < s.d; i++) {
            s.mass[i] = pow(10, 3.5 * chance(&seed) - 3);
            k[i] = i > 0 ? pow(10, 2 * chance(&seed) - 1) : 0;
        }
        springs(&s, k);
        s.term[0][0] = (fvi_kernel_term){ FVI_KERNEL_ZENER, 0.1, 0.3, 2, 0 };
        s.kernel[0].count = 1;
        point_into(&s);
        const fvi_linear_motion motion = { .system = &s.system };
        ck_assert_poles(&motion, s.d - 1);
    }
}
END_TEST

/* Two free masses of 1 on a springpot between them, with no spring: 2 rho s^b = -s^2 has one solution for b < 1. No
 * undamped mode has its shape. */
START_TEST(free_bodies_without_springs_are_counted)
{
    linear_system s = { .d = 2, .dampers = 1, .mass = { 1, 1 }, .row = { { -1, 1 } } };
    s.term[0][0] = (fvi_kernel_term){ FVI_KERNEL_POWER, 3, 0.3, 0, 0 };
    s.kernel[0].count = 1;
    point_into(&s);
    const fvi_linear_motion motion = { .system = &s.system };
    ck_assert_poles(&motion, 1);
}
END_TEST

/* Two equal and separate pairs: a mass on a spring, and a free mass on a strong springpot to it. */
static void make_two_pairs(linear_system *s)
{
    *s = (linear_system){ .d = 4, .dampers = 2, .mass = { 1, 1, 1, 1 }, .row = { { -1, 1 }, { 0, 0, -1, 1 } } };
    s->K[0] = s->K[10] = 1.18;
    for (size_t j = 0; j < 2; j++) {
        s->term[j][0] = (fvi_kernel_term){ FVI_KERNEL_POWER, 7.83, 0.4, 0, 0 };
        s->kernel[j].count = 1;
    }
    point_into(s);
}

/* Of two undamped modes, i and 0, the springpot makes poles far from them. No path leads there. Each pole has two
 * shapes. */
START_TEST(eq_30_8_poles_that_are_counted_are_found)
{
    linear_system s;
    make_two_pairs(&s);
    const fvi_linear_motion motion = { .system = &s.system };
    fvi_response *r = response_of(&motion);
    fvi_poles p = poles_of(r, 0);
    ck_assert_uint_eq(p.count, 4);
    for (size_t k = 0; k < 4; k++) { /* det of one pair: (s^2 + c + 1.18) (s^2 + c) - c^2 */
        const double complex z = pole(&p, k), c = 7.83 * cpow(z, 0.8),
                             det = z * z * (z * z + 2 * c) + 1.18 * (z * z + c);
        ck_assert_near(cabs(det) / (1 + pow(cabs(z), 4)), 0, 1e-13, "%zu", k);
        ck_assert(k % 2 == 1 || cabs(pole(&p, k) - pole(&p, k + 1)) < 1e-12 * cabs(z));
    }
    ck_assert_double_gt(cabs(pole(&p, 2)), 5 * cabs(pole(&p, 0)));
    fvi_poles_free(&p);
    fvi_response_free(r);
}
END_TEST

/* In a box whose count is too high, Newton's method finds a sum of both shapes, which is no third one. */
START_TEST(eq_30_8_a_pole_with_two_shapes_is_not_found_three_times)
{
    linear_system s;
    make_two_pairs(&s);
    const fvi_linear_motion motion = { .system = &s.system };
    fvi_response *r = response_of(&motion);
    fvi_poles p = poles_of(r, 2);
    double complex v[3][4];
    fvi_pole_candidate candidate[3] = { { pole(&p, 0), v[0], 0, 0 }, { pole(&p, 1), v[1], 0, 0 }, { .v = v[2] } };
    memcpy(v, p.shape, 2 * sizeof *v);
    const double u = log(cabs(pole(&p, 0))), angle = carg(pole(&p, 0));
    const fvi_log_box box = { { u - 0.1, u + 0.12 }, { angle - 0.01, angle + 0.02 } };
    fvi_pole_list list = { .count = 2, .room = 3, .seed = 1, .candidate = candidate };
    OK(fvi_poles_in_box(r, &box, 3, &list));
    ck_assert_uint_eq(list.count, 2);
    fvi_poles_free(&p);
    fvi_response_free(r);
}
END_TEST

/* A Maxwell element is for fast motions a spring of 1e12: two masses swing at 1.4e6, more than e^12 times the undamped
 * frequency of 1.4, and these poles are counted and found. */
START_TEST(eq_30_8_poles_far_above_all_undamped_frequencies_are_counted)
{
    linear_system s = { .d = 2, .dampers = 1, .mass = { 1, 1 }, .row = { { -1, 1 } } };
    const double k[] = { 0, 1 };
    springs(&s, k);
    s.term[0][0] = (fvi_kernel_term){ FVI_KERNEL_MAXWELL, 1e10, 0, 0.01, 0 };
    s.kernel[0].count = 1;
    point_into(&s);
    const fvi_linear_motion motion = { .system = &s.system };
    ck_assert_poles(&motion, 1);
}
END_TEST

/* ---- near the negative axis ---- */

/* One body without a spring, with a springpot of order b and a dashpot, so strong that s = e^(3.1 i) is a pole:
 * s^2 + rho s^b + c s = 0. Its imaginary part gives rho / c. Beside it, with a spring, a power and a Maxwell element in
 * parallel, which have two poles: one swings, and the other is nearly real. */
START_TEST(eq_26_11_poles_of_one_body_that_are_nearly_real_are_found)
{
    const double b = 0.4, angle = 3.1, rho = sin(angle) / sin((1 - b) * angle);
    const double c = -(cos(2 * angle) + rho * cos(b * angle)) / cos(angle);
    linear_system s = { .d = 1, .dampers = 1, .mass = { 1 }, .row = { { 1 } } };
    s.term[0][0] = (fvi_kernel_term){ FVI_KERNEL_POWER, rho, b / 2, 0, 0 };
    s.term[0][1] = (fvi_kernel_term){ FVI_KERNEL_POWER, c, 0.5, 0, 0 };
    s.kernel[0].count = 2;
    point_into(&s);
    const fvi_linear_motion motion = { .system = &s.system };
    fvi_response *r = response_of(&motion);
    fvi_poles p = poles_of(r, 0);
    ck_assert_uint_eq(p.count, 1);
    ck_assert_near(cabs(pole(&p, 0) - cexp(I * angle)), 0, 1e-13, "the pole");
    fvi_poles_free(&p);
    fvi_response_free(r);
    s.K[0] = 2;
    s.term[0][0] = (fvi_kernel_term){ FVI_KERNEL_POWER, 2, 0.8, 0, 0 };
    s.term[0][1] = (fvi_kernel_term){ FVI_KERNEL_MAXWELL, 2, 0, 0.6, 0 };
    ck_assert_poles(&motion, 2);
}
END_TEST

/* The symbol of the second damper has a pole at s = -1.255, and det Z has a zero beside it, at the angle 3.1367. The
 * phase along the side of the box turns by a whole turn in 0.02 of ln s. verify/response/response.py counts four
 * zeros. */
START_TEST(eq_30_8_a_zero_beside_the_pole_of_a_damper_is_counted)
{
    linear_system s = { .d = 3, .dampers = 3, .mass = { 1, 1, 1 }, .row = { { 1 }, { -1, 1 }, { 0, -1, 1 } } };
    const double k[] = { 0, 1, 1 };
    springs(&s, k);
    s.K[8] += 1.71;
    s.term[0][0] = (fvi_kernel_term){ FVI_KERNEL_POWER, 0.813, 0.7, 0, 0 };
    s.term[1][0] = (fvi_kernel_term){ FVI_KERNEL_MAXWELL, 0.0357, 0, 0.797, 0 };
    s.term[2][0] = (fvi_kernel_term){ FVI_KERNEL_MAXWELL, 0.156, 0, 88.2, 0 };
    for (size_t j = 0; j < 3; j++)
        s.kernel[j].count = 1;
    point_into(&s);
    const fvi_linear_motion motion = { .system = &s.system };
    fvi_response *r = response_of(&motion);
    ck_assert_uint_eq(fvi_poles_counted(r, -13, 13), 4);
    fvi_response_free(r);
}
END_TEST

/* Two masses move freely together, but for a damper of order 1.2 on one of them. Near s = 0 its force is lost beside
 * that of the spring, but Z(0) is no pole. */
START_TEST(a_free_motion_with_a_damper_above_order_1_has_no_pole_at_0)
{
    linear_system s = { .d = 2, .dampers = 1, .mass = { 1, 1 }, .row = { { 1 } } };
    const double k[] = { 0, 0.0416 };
    springs(&s, k);
    s.term[0][0] = (fvi_kernel_term){ FVI_KERNEL_POWER, 0.688, 0.6, 0, 0 };
    s.kernel[0].count = 1;
    point_into(&s);
    const fvi_linear_motion motion = { .system = &s.system };
    ck_assert_poles(&motion, 1); /* at s = 1e-261 squares are 0 */
    s.dampers = 2;
    s.row[1][0] = -1, s.row[1][1] = 1;
    s.K[0] = s.K[3] = 1, s.K[1] = s.K[2] = -1;
    s.term[0][0] = (fvi_kernel_term){ FVI_KERNEL_POWER, 11.1, 0.7, 0, 0 };
    s.term[1][0] = (fvi_kernel_term){ FVI_KERNEL_POWER, 2.67, 0.5, 0, 0 };
    s.term[1][1] = (fvi_kernel_term){ FVI_KERNEL_POWER, 0.361, 0.4, 0, 0 };
    s.kernel[1].count = 2;
    point_into(&s);
    ck_assert_poles(&motion, 0); /* at s = 1e-31 the damper's force is less than a rounding error of the spring's */
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("response_pole_count");
    ADD_CASE(suite, "theorem", eq_30_7_there_are_as_many_poles_as_unknowns,
             eq_30_7_laws_on_both_sides_are_counted,
             eq_30_7_springpots_in_series_are_counted_if_their_symbol_has_no_poles);
    ADD_CASE(suite, "fewer", eq_30_8_overdamped_modes_are_not_counted,
             a_free_body_swings_on_its_springpot, a_free_ring_has_two_poles,
             free_chains_of_unequal_masses_have_one_pole_less_than_masses,
             free_bodies_without_springs_are_counted, eq_30_8_poles_that_are_counted_are_found,
             eq_30_8_a_pole_with_two_shapes_is_not_found_three_times,
             eq_30_8_poles_far_above_all_undamped_frequencies_are_counted);
    ADD_CASE(suite, "near the axis", eq_26_11_poles_of_one_body_that_are_nearly_real_are_found,
             eq_30_8_a_zero_beside_the_pole_of_a_damper_is_counted,
             a_free_motion_with_a_damper_above_order_1_has_no_pole_at_0);
    return run_suite(suite);
}
