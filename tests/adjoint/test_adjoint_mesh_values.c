/* tests/adjoint/test_adjoint_mesh_values.c -- H 23: derivatives with steps of any length, compared with derivatives
 * of 40 digits.
 * Run alone: make test-adjoint_mesh_values */
#include "adjoint_runs.h"

#include "adjoint_mesh_ref.h"
#include "system/larger.h"

enum { D = 5, ROWS = 4, STEPS = LEN(ref_mesh_ends), SLOPES = 26 };

static fvi_impulse impulses[LEN(ref_mesh_impulses)];

/* The force does not jump where it says so: steps end there. */
static void run_of(size_t i, fvi_system *system, fvi_run *run, double *aw)
{
    const double *x0 = ref_meshes[i].x0;
    double size = 0;
    for (size_t j = 0; j < D; j++)
        size = larger(size, fabs(x0[j]));
    *system = (fvi_system){ .d = D,
                            .mass = ref_meshes[i].mass,
                            .damping = ref_meshes[i].rho,
                            .potential =
                                fvi_potential_chain((void *)ref_meshes[i].cg),
                            .force = fvi_force_cosine(aw) };
    system->force.jumps = ref_mesh_ends;
    system->force.jump_count = STEPS;
    for (size_t k = 0; k < LEN(impulses); k++)
        impulses[k] =
            (fvi_impulse){ ref_mesh_impulses[k].t, ref_mesh_impulses[k].J };
    if (ref_meshes[i].alpha <= 0.5) {
        system->force.impulses = impulses;
        system->force.impulse_count = LEN(impulses);
    }
    *run = fvi_run_default(system, x0, ref_meshes[i].p0,
                           ref_mesh_ends[STEPS - 1] / ROWS, ROWS);
    run->alpha = ref_meshes[i].alpha;
    run->past = ref_meshes[i].past;
    run->step_error = 9e-8 * size; /* the modes are right to 2e-14 */
}

/* The method's own steps are those of the reference: each but the last ends at one of its
 * ends, and there are as many. */
START_TEST(eq_23_16_the_steps_of_the_values)
{
    for (size_t i = 0; i < LEN(ref_meshes); i++) {
        double aw[] = { 0.2, 1.25 };
        fvi_system system;
        fvi_run run;
        fvi_stepper *s;
        fvi_step_statistics counts;
        run_of(i, &system, &run, aw);
        ck_assert_int_eq(fvi_stepper_start(&fvi_variable_step, &run, &s,
                                           NULL), FVI_SUCCESS);
        for (size_t n = 0; n < STEPS; n++) {
            ck_assert_int_eq(fvi_stepper_step(s), FVI_SUCCESS);
            ck_assert_double_eq(s->t, ref_mesh_ends[n]);
        }
        ck_assert_int_eq(fvi_stepper_statistics(s, &counts), FVI_SUCCESS);
        ck_assert_uint_eq(counts.steps, STEPS);
        ck_assert_int_eq(counts.stages, 8);
        ck_assert_int_eq(counts.form, 'D');
        fvi_stepper_free(s);
    }
}
END_TEST

static void slopes_by(size_t i, double *got)
{
    double aw[] = { 0.2, 1.25 };
    fvi_system system;
    fvi_run run;
    run_of(i, &system, &run, aw);
    slopes *s = slopes_of(&run, ROWS + 1);
    const fvi_objective J = { .slopes = to_sine, .params = &run };
    ck_assert_int_eq(fvi_adjoint(&fvi_variable_step, &run, NULL, NULL, &J, &s->to),
                     FVI_SUCCESS);
    slopes_in_order(s, D, got);
    got[23] = s->force[0];
    got[24] = s->force[2 * D + 2];
    got[25] = s->force[ROWS * D + D - 1];
    slopes_free(s);
}

/* (23.16), (23.18): every derivative of five masses, that by alpha, too, of itself, or of
 * 0.01 where that is more. The equations of the steps are solved to 1e-5 of step_error,
 * 1e-12, which is 1e-10 of 0.01. Seen: 3e-11. */
START_TEST(eq_23_18_every_derivative_of_a_chain_on_its_mesh)
{
    for (size_t i = 0; i < LEN(ref_meshes); i++) {
        double got[SLOPES];
        slopes_by(i, got);
        for (size_t j = 0; j < SLOPES; j++) {
            const double want = ref_meshes[i].want[j],
                         unit = larger(0.01, fabs(want));
            seen_worst(fabs(got[j] - want) / unit, "worst");
            if (j == 22)
                seen_worst(fabs(got[j] - want) / unit, "by alpha");
            ck_assert_near(got[j], want, 1e-10 * unit,
                           "past %d alpha=%g, derivative %zu",
                           (int)ref_meshes[i].past, ref_meshes[i].alpha, j);
        }
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("adjoint, values on meshes");
    ADD_CASE(suite, "values", eq_23_16_the_steps_of_the_values,
             eq_23_18_every_derivative_of_a_chain_on_its_mesh);
    return run_suite(suite);
}
