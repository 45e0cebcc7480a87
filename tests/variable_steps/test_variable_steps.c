/* tests/variable_steps/test_variable_steps.c -- H 22: the rule of the stages, and the modes.
 * Run alone: make test-variable_steps */
#include "harness/ulp.h"
#include "stages/variable_modes.h"
#include "stages/variable_table.h"

#include "variable_steps_ref.h"
#include "variable_steps_runs_ref.h"

/* Row by row of the references from column by column. */
static double entry(const fvi_square *M, size_t i, size_t l)
{
    return M->column[l][i];
}

static double largest(size_t n, const double *v)
{
    double max = 0;
    for (size_t i = 0; i < n; i++)
        max = larger(max, fabs(v[i]));
    return max;
}

/* ---- constants ---- */

/* Made by one script and held against another, which knows of no C. To the last bit. */
START_TEST(the_rule_is_lobattos)
{
    size_t ran = 0;
    ck_assert_ptr_null(fvi_variable(4));
    for (size_t r = 0; r < LEN(ref_rules); r++) {
        const size_t s = ref_rules[r].s;
        const fvi_variable_rule *rule = fvi_variable(s);
        if (!rule)
            continue;
        ran++;
        for (size_t i = 0; i < s; i++) {
            ck_assert_ulp(rule->c[i], ref_rules[r].c[i], 0, "c %zu", i);
            ck_assert_ulp(rule->b[i], ref_rules[r].b[i], 0, "b %zu", i);
            ck_assert(ref_inverses[r].s == s && ref_numerators[r].s == s);
            for (size_t l = 0; l < s; l++) {
                ck_assert_ulp(entry(&rule->inverse, i, l),
                              ref_inverses[r].want[i * s + l], 0, "A^-1");
                ck_assert_ulp(rule->numerator[i][l],
                              ref_numerators[r].n[i * s + l], 0, "n");
            }
        }
        for (size_t n = 0; n <= s; n++)
            ck_assert(rule->det[n] == ref_numerators[r].d[n]);
    }
    ck_assert_uint_eq(ran, 2);
}
END_TEST

/* A A^{-1} = 1; form M's matrix times A integrates twice: 1 to c^2/2, and its last row is
 * b (1 - c). Sums of s products below 60: 60 s u. Seen: 0.005 of that. */
START_TEST(eq_22_15_form_m_integrates_twice)
{
    for (size_t s = 6; s <= 8; s += 2) {
        const fvi_variable_rule *rule = fvi_variable(s);
        for (size_t i = 0; i < s; i++) {
            double twice[FVI_LANES] = { 0 }, all = 0;
            for (size_t l = 0; l < s; l++) {
                double one = 0;
                for (size_t n = 0; n < s; n++) {
                    one += entry(&rule->A, i, n) * entry(&rule->inverse, n, l);
                    twice[l] +=
                        entry(&rule->form_m, i, n) * entry(&rule->A, n, l);
                }
                ck_assert_near(one, i == l, 60 * (double)s * U, "A A^-1");
                all += twice[l];
                if (i + 1 == s)
                    ck_assert_near(twice[l], rule->b[l] * (1 - rule->c[l]),
                                   60 * (double)s * U, "last row");
            }
            ck_assert_near(all, rule->c[i] * rule->c[i] / 2, 60 * (double)s * U,
                           "row %zu", i);
        }
    }
}
END_TEST

//> powers
/* (22.2) by the projectors, whose entries are up to 30 (s = 6) and 220 (s = 8) times
 * those of the power: 4 s u times that, of the largest entry. Seen: 0.08 of that. */
START_TEST(eq_22_2_powers_by_projectors)
{
    size_t ran = 0;
    for (size_t r = 0; r < LEN(ref_powers); r++) {
        const size_t s = ref_powers[r].s;
        if (!fvi_variable(s))
            continue;
        ran++;
        fvi_square W;
        fvi_variable_present(fvi_variable(s), ref_powers[r].beta, &W);
        const double bound = 4 * (double)s * U * (s == 6 ? 30 : 220)
                             * largest(s * s, ref_powers[r].want);
        for (size_t i = 0; i < s; i++)
            for (size_t l = 0; l < s; l++)
                ck_assert_near(entry(&W, i, l), ref_powers[r].want[i * s + l],
                               bound, "s=%zu beta=%g (%zu,%zu)", s,
                               ref_powers[r].beta, i, l);
    }
    ck_assert_uint_ge(ran, 20);
}
END_TEST
//< powers

/* Two Horner sums of s + 1 terms, of which those of the numerators cancel where mu is
 * near 1, and a quotient: (22.8) to 4 s u of max(1, mu) a, or of the largest entry.
 * p: a sum of them. Seen: 0.13 of that. */
START_TEST(eq_22_8_coefficients_of_modes)
{
    size_t ran = 0;
    for (size_t r = 0; r < LEN(ref_stage_values); r++) {
        const size_t s = ref_stage_values[r].s;
        if (!fvi_variable(s))
            continue;
        ran++;
        const double *want = ref_stage_values[r].want;
        double mu[FVI_LANES], p[FVI_LANES], a[FVI_LANES * FVI_LANES];
        for (size_t l = 0; l < FVI_LANES; l++)
            mu[l] = ref_stage_values[r].mu;
        fvi_mode_row_make(fvi_variable(s), FVI_LANES, mu, p, a);
        for (size_t i = 0; i < s; i++)
            ck_assert_near(a[i * FVI_LANES + i % 8], want[i],
                           4 * (double)s * U * largest(s, want),
                           "s=%zu mu=%g i=%zu", s, mu[0], i);
        ck_assert_near(p[3], want[s], 4 * (double)s * U * smaller(1, mu[0]),
                       "s=%zu mu=%g p", s, mu[0]);
    }
    ck_assert_uint_ge(ran, 10);
}
END_TEST

/* The table is these coefficients, and one for all. */
START_TEST(one_table_for_a_process)
{
    const fvi_mode_row *t = fvi_mode_table(fvi_variable(8), 1),
                       *other = fvi_mode_table(fvi_variable(8), 2);
    ck_assert_ptr_eq(t, fvi_mode_table(fvi_variable(8), 1));
    ck_assert_ptr_ne(t, fvi_mode_table(fvi_variable(6), 1));
    ck_assert_ptr_ne(t, other);
    for (size_t j = 0; j < FVI_POINTS; j++) {
        const size_t at = j / 2 + j % 2 * FVI_POINTS / 2;
        ck_assert(other->mu[at] == t->mu[j] && other->p[at] == t->p[j]);
        ck_assert(other->a[7 * other->stride + at] == t->a[7 * t->stride + j]);
    }
    ck_assert(t->mu[-FVI_FIRST] == 1);
    double p[FVI_LANES], a[FVI_LANES * FVI_LANES];
    const size_t place = (size_t)(3 - FVI_FIRST);
    fvi_mode_row_make(fvi_variable(8), FVI_LANES, t->mu + place, p, a);
    for (size_t l = 0; l < FVI_LANES; l++) {
        ck_assert_ulp(t->mu[place + l], exp(0.26 * (double)(3 + l)), 1, "mu");
        ck_assert(t->p[place + l] == p[l]);
        for (size_t i = 0; i < 8; i++)
            ck_assert(t->a[i * t->stride + place + l] == a[i * FVI_LANES + l]);
    }
}
END_TEST

/* (22.11): six terms of which the first are up to 3 times the sum: 40 u of the largest.
 * Seen: 0.09 of that. */
START_TEST(eq_22_11_ends)
{
    for (size_t r = 0; r < LEN(ref_ends); r++) {
        double c[FVI_ENDS];
        const size_t every = ref_ends[r].L == fvi_variable_spacing() ? 1 : 2;
        ck_assert_uint_eq(fvi_variable_apart(every), ref_ends[r].apart);
        fvi_variable_ends(every, ref_ends[r].nu, c);
        for (size_t l = 0; l < FVI_ENDS; l++)
            ck_assert_near(c[l], ref_ends[r].want[l],
                           40 * U * largest(FVI_ENDS, ref_ends[r].want),
                           "nu=%g l=%zu", ref_ends[r].nu, l);
    }
}
END_TEST

/* ---- small matrices ---- */

/* M M^{-1} = 1 for a matrix that needs exchanges, to s^2 u |M| |M^{-1}|; a singular one is
 * said. Seen: 0.005 of that. */
START_TEST(squares_are_inverted_with_exchanges)
{
    fvi_square M = { { { 0 } } }, K, none = { { { 0 } } };
    for (size_t l = 0; l < 8; l++)
        for (size_t i = 0; i < 8; i++)
            M.column[l][i] = i + l == 7 ? 0 : cos((double)(3 * i * i + 5 * l));
    K = M;
    ck_assert_int_eq(fvi_square_invert(8, &K), 0);
    for (size_t l = 0; l < 8; l++) {
        double image[FVI_LANES];
        fvi_square_apply(8, &M, K.column[l], image);
        for (size_t i = 0; i < 8; i++)
            ck_assert_near(image[i], i == l,
                           64 * U * 8 * largest(64, K.column[0]), "%zu %zu", i,
                           l);
    }
    ck_assert_int_ne(fvi_square_invert(8, &none), 0);
}
END_TEST

/* ---- the past ---- */

/* The length e^{0.26 k} of a step of ref_mesh, or one off the lattice. */
static fvi_length length_of(double h)
{
    const double k = round(log(h) / fvi_variable_spacing());
    const int on = fabs(exp(fvi_variable_spacing() * k) - h) <= 4 * U * h;
    return (fvi_length){ h, on ? (int)k : FVI_OFF_LATTICE };
}

//> mesh
/* Y = DD^beta v on a mesh that grows, falls by 17.5 and leaves the lattice once, by the
 * present W0 v and the modes' H, against the power of the whole matrix: (22.10) to
 * (22.13). 2e-14 of the largest |Y| for the ends of the modes, 3e-10 and 1e-7 for fewer;
 * 4 s u 220 |W0| |v| h^-beta of the present. Seen: 0.22 of the bound. */
START_TEST(eq_22_10_history_is_the_power_of_the_matrix)
{
    size_t ran = 0;
    const double part[] = { 2e-14, 3e-10, 1e-7 }; /* of each kind */
    for (size_t way = 0; way < 3 * LEN(ref_mesh); way++) {
        const fvi_modes_kind kind = (fvi_modes_kind)(way % 3);
        const size_t r = way / 3, s = ref_mesh[r].s;
        const double beta = 2 * ref_mesh[r].alpha - 1, *h = ref_mesh[r].h;
        const fvi_variable_rule *rule = fvi_variable(s);
        if (!rule)
            continue;
        ran++;
        double T = 0, least = h[0], ve = 1;
        for (size_t k = 0; k < 10; k++) {
            T += h[k];
            least = smaller(least, h[k]);
        }
        fvi_modes *m, *copy;
        fvi_square W;
        ck_assert_int_eq(fvi_modes_alloc(rule, kind, beta, 2, T, least, &m), 0);
        fvi_variable_present(rule, beta, &W);
        for (size_t k = 0; k < 10; k++) {
            const double *v = ref_mesh[r].v + k * s, *Y = ref_mesh[r].Y + k * s;
            double given[FVI_LANES] = { 0 }, now[FVI_LANES], H[FVI_LANES];
            for (size_t i = 0; i < s; i++)
                given[i] = v[i] - (beta > 0 ? ve : 0);
            fvi_modes_begin(m, (fvi_length){ h[k] / 7, FVI_OFF_LATTICE });
            fvi_modes_begin(m, length_of(h[k])); /* a trial leaves no trace */
            fvi_modes_history(m, 1, H);
            fvi_square_apply(s, &W, given, now);
            const double size = pow(h[k], -beta);
            for (size_t i = 0; i < s; i++)
                ck_assert_near(size * now[i] + H[i], Y[i],
                               part[kind]
                                       * largest(10 * s, ref_mesh[r].Y)
                                   + 4 * (double)s * U * 220 * size
                                         * largest(64, W.column[0])
                                         * largest(s, given),
                               "s=%zu alpha=%g kind %d step %zu stage %zu", s,
                               ref_mesh[r].alpha, (int)kind, k, i);
            for (size_t j = 0; j < 2; j++)
                fvi_modes_advance(m, j, given, ve);
            ve = v[s - 1];
            ck_assert_int_eq(fvi_modes_copy(m, &copy), 0);
            fvi_modes_free(m);
            m = copy;
        }
        fvi_modes_free(m);
    }
    ck_assert_uint_ge(ran, 20);
}
END_TEST
//< mesh

int main(void)
{
    Suite *suite = suite_create("variable_steps: the rule and the modes");
    ADD_CASE(suite, "rule", the_rule_is_lobattos,
             eq_22_15_form_m_integrates_twice, eq_22_2_powers_by_projectors,
             eq_22_8_coefficients_of_modes, one_table_for_a_process,
             eq_22_11_ends, squares_are_inverted_with_exchanges);
    ADD_CASE(suite, "past", eq_22_10_history_is_the_power_of_the_matrix);
    return run_suite(suite);
}
