/* tests/adjoint/test_adjoint.c -- H 23: gradients of runs of one coordinate.
 * Run alone: make test-adjoint */
#include "adjoint_runs.h"
#include "run/whole_run.h"

#include "adjoint_ref.h"
#include "system/larger.h"

#include <gsl/gsl_math.h>

/* ---- one oscillator, against derivatives of 21 digits ---- */

/* Row i of ref_slopes, as it was run. */
typedef struct {
    double mass, rho, cg[2], aw[2], x0, p0;
    fvi_system system;
    fvi_run run;
} oscillator;

static oscillator *oscillator_of(size_t i, fvi_history_kind memory)
{
    oscillator *o = malloc(sizeof *o);
    ck_assert_ptr_nonnull(o);
    *o = (oscillator){ .mass = 1,
                       .rho = 0.375,
                       .cg = { 1, 0.5 },
                       .aw = { 0.25, 1 },
                       .p0 = 0.5,
                       .x0 = ref_slopes[i].x0 };
    o->system = (fvi_system){ 1,
                              &o->mass,
                              &o->rho,
                              fvi_potential_duffing(o->cg),
                              fvi_force_cosine(o->aw),
                              NULL, NULL };
    o->run = fvi_run_default(&o->system, &o->x0, &o->p0, ref_slopes[i].h,
                             ref_slopes[i].N);
    o->run.alpha = ref_slopes[i].alpha;
    o->run.kappa = ref_slopes[i].kappa;
    o->run.past = ref_slopes[i].past;
    o->run.memory = memory;
    return o;
}

/* (23.6): all derivatives of a row, with the path and without; the digits are the same.
 * No bound is proved for the roundings: N h of (h/u) ... Seen below. */
static void ck_assert_row(size_t i, fvi_history_kind memory, double tolerance)
{
    oscillator *o = oscillator_of(i, memory);
    const size_t N = o->run.steps;
    const fvi_method *method = ref_slopes[i].method;
    const fvi_objective J = { .slopes = to_sine, .params = &o->run };
    double *x = malloc(2 * (N + 1) * sizeof *x), *p = x + N + 1;
    ck_assert_ptr_nonnull(x);
    slopes *s = slopes_of(&o->run, N + 1), *again = slopes_of(&o->run, N + 1);
    ck_assert_int_eq(fvi_trajectory(method, &o->run, x, p, NULL), FVI_SUCCESS);
    ck_assert_int_eq(fvi_adjoint(method, &o->run, x, p + N, &J, &s->to),
                     FVI_SUCCESS);
    ck_assert_int_eq(fvi_adjoint(method, &o->run, NULL, NULL, &J, &again->to),
                     FVI_SUCCESS);
    const double want[] = { ref_slopes[i].by_x0,    ref_slopes[i].by_p0,
                            ref_slopes[i].by_mass,  ref_slopes[i].by_rho,
                            ref_slopes[i].by_alpha, ref_slopes[i].by_c,
                            ref_slopes[i].by_g,     ref_slopes[i].by_F };
    const double got[] = { *s->to.x0,           *s->to.p0,
                           *s->to.mass,         *s->to.damping,
                           *s->to.alpha,        s->to.parameters[0],
                           s->to.parameters[1], s->force[ref_slopes[i].force] };
    for (size_t j = 0; j < LEN(want); j++) {
        seen_worst(fabs(got[j] - want[j]) / larger(1, fabs(want[j])), "worst");
        if (isnan(want[j]))
            ck_assert_msg(isnan(got[j]), "row %zu", i);
        else
            ck_assert_near(got[j], want[j],
                           tolerance * larger(1, fabs(want[j])),
                           "%s past %d alpha=%g, derivative %zu", method->name,
                           (int)o->run.past, o->run.alpha, j);
    }
    ck_assert_int_eq(memcmp(s->all, again->all, sizeof s->all), 0);
    ck_assert_int_eq(memcmp(s->force, again->force, (N + 1) * sizeof *x), 0);
    slopes_free(s);
    slopes_free(again);
    free(x);
    free(o);
}

START_TEST(eq_23_6_every_derivative_of_2000_steps)
{
    size_t count = 0;
    for (size_t i = 0; i < LEN(ref_slopes); i++)
        if (ref_slopes[i].N == 2000) {
            ck_assert_row(i, FVI_HISTORY_DIRECT, 1e-12);
            ck_assert_row(i, FVI_HISTORY_MODES, 1e-12);
            count++;
        }
    ck_assert_uint_eq(count, 4);
}
END_TEST

START_TEST(eq_23_6_every_derivative_by_every_method_past_and_alpha)
{
    size_t count = 0;
    for (size_t i = 0; i < LEN(ref_slopes); i++)
        if (ref_slopes[i].N < 2000) {
            ck_assert_row(i, FVI_HISTORY_AUTO, 1e-12);
            ck_assert_row(i, FVI_HISTORY_MODES, 1e-12);
            ck_assert_row(i, FVI_HISTORY_DIRECT, 1e-12);
            count++;
        }
    ck_assert_uint_eq(count, 57);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("adjoint");
    ADD_CASE(suite, "values", eq_23_6_every_derivative_of_2000_steps,
             eq_23_6_every_derivative_by_every_method_past_and_alpha);
    return run_suite(suite);
}
