/* tests/adjoint/test_adjoint_node_values.c -- H 23: methods without stages, compared with derivatives of 40 digits.
 * Run alone: make test-adjoint_node_values */
#include "adjoint_runs.h"

#include "adjoint_nodes_ref.h"
#include "system/larger.h"

enum { D = 5, N = 12, SLOPES = 26 };

/* Row i: its derivatives, in the order of the row. */
static void slopes_by(size_t i, fvi_history_kind memory, double *got)
{
    double aw[] = { 0.2, 1.25 };
    const fvi_system system = { .d = D,
                                .mass = ref_nodes[i].mass,
                                .damping = ref_nodes[i].rho,
                                .potential = fvi_potential_chain(
                                    (void *)ref_nodes[i].cg),
                                .force = fvi_force_cosine(aw) };
    fvi_run run =
        fvi_run_default(&system, ref_nodes[i].x0, ref_nodes[i].p0, 1. / 16, N);
    run.alpha = ref_nodes[i].alpha;
    run.past = ref_nodes[i].past;
    run.kappa = ref_nodes[i].kappa;
    run.memory = memory;
    slopes *s = slopes_of(&run, N + 1);
    const fvi_objective J = { .slopes = to_sine, .params = &run };
    ck_assert_int_eq(
        fvi_adjoint(ref_nodes[i].method, &run, NULL, NULL, &J, &s->to),
        FVI_SUCCESS);
    slopes_in_order(s, D, got);
    for (size_t j = 0; j < LEN(ref_node_forces); j++)
        got[23 + j] = s->force[ref_node_forces[j]];
    slopes_free(s);
}

/* Every derivative of five masses by four methods, three pasts, five orders and two
 * memories, of itself, or of 0.01 where that is more. A bound of rounding is not proved.
 * Seen: 4.7e-14. */
START_TEST(eq_23_6_every_derivative_of_a_chain_to_40_digits)
{
    static const fvi_history_kind kinds[] = { FVI_HISTORY_DIRECT,
                                             FVI_HISTORY_MODES };
    for (size_t i = 0; i < LEN(kinds) * LEN(ref_nodes); i++) {
        const size_t row = i / LEN(kinds);
        double got[SLOPES];
        slopes_by(row, kinds[i % LEN(kinds)], got);
        for (size_t j = 0; j < SLOPES; j++) {
            const double want = ref_nodes[row].want[j];
            ck_assert_int_eq(isnan(want), isnan(got[j]));
            if (isnan(want))
                continue;
            const double unit = larger(0.01, fabs(want));
            seen_worst(fabs(got[j] - want) / unit, "worst");
            ck_assert_near(got[j], want, 1e-12 * unit,
                           "%s past %d alpha=%g, derivative %zu",
                           ref_nodes[row].method->name,
                           (int)ref_nodes[row].past, ref_nodes[row].alpha, j);
        }
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("adjoint, values without stages");
    ADD_CASE(suite, "values", eq_23_6_every_derivative_of_a_chain_to_40_digits);
    return run_suite(suite);
}
