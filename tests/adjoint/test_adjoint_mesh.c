/* tests/adjoint/test_adjoint_mesh.c -- H 23: derivatives of runs with steps of any length.
 * Run alone: make test-adjoint_mesh */
#include "adjoint_meshes.h"
#include "run/whole_run.h"
#include "stages/variable_modes.h"
#include "system/larger.h"

/* H and dH/dbeta after three steps, the last one long, of modes that saw a rough v. */
static void read_modes(size_t stages, fvi_modes_kind kind, double beta,
                       double *H, double *rate)
{
    static const double lengths[] = { 0.03, 0.007, 0.2, 0.11 };
    fvi_modes *modes;
    ck_assert_int_eq(
        fvi_modes_alloc(fvi_variable(stages), kind, beta, 1, 1, 1e-3, &modes),
        FVI_SUCCESS);
    ck_assert_int_eq(fvi_modes_add_order(modes), FVI_SUCCESS);
    double last = 0;
    for (size_t n = 0; n < LEN(lengths); n++) {
        double v[FVI_LANES] = { 0 };
        fvi_modes_begin(modes, (fvi_length){ lengths[n], FVI_OFF_LATTICE });
        fvi_modes_history(modes, 0, H);
        fvi_modes_history_by_order(modes, 0, rate);
        for (size_t i = 0; i < stages; i++)
            v[i] = cos(3. * (double)(n * stages + i)) - (beta > 0 ? last : 0);
        fvi_modes_advance(modes, 0, v, last);
        last = cos(3. * (double)(n * stages + stages - 1));
    }
    fvi_modes_free(modes);
}

/* The second reading of the modes is the derivative of the first: difference quotients of
 * order 4, 1e-3 wide, to one side where beta ends. Terms of order 5, ln^5 sigma / 5 1e-12,
 * sigma up to 1e7 where the weights are some 1e3 of H's unit, and below 1e-11 in what is
 * read; rounding over 1e-3. Seen: 0.1 of it. */
START_TEST(eq_23_18_the_second_reading_is_the_derivative_of_the_first)
{
    static const double betas[] = { -1,   -1 + 1e-9, -0.97, -0.6, -0.1,
                                    0.05, 0.4,       0.9,   1 };
    static const fvi_modes_kind kinds[] = { FVI_MODES_FINE, FVI_MODES_MEDIUM,
                                            FVI_MODES_COARSE };
    static const double shares[] = { -25, 48, -36, 16, -3 };
    for (size_t i = 0; i < LEN(betas) * LEN(kinds) * 2; i++) {
        const double beta = betas[i / 2 % LEN(betas)],
                     to = beta == 1 || beta == -0.1 ? -1e-3 : 1e-3;
        const fvi_modes_kind kind = kinds[i / 2 / LEN(betas)];
        const size_t stages = i % 2 ? 6 : 8;
        double H[FVI_LANES], rate[FVI_LANES], none[FVI_LANES],
            sum[FVI_LANES] = { 0 }, size = 0;
        read_modes(stages, kind, beta, H, rate);
        for (size_t k = 0; k < LEN(shares); k++) {
            read_modes(stages, kind, beta + (double)k * to, H, none);
            for (size_t l = 0; l < stages; l++)
                sum[l] += shares[k] * H[l] / (12 * to);
        }
        for (size_t l = 0; l < stages; l++)
            size = larger(size, fabs(rate[l]));
        for (size_t l = 0; l < stages; l++)
            ck_assert_near(rate[l], sum[l], 1e-8 * larger(1, size),
                           "beta=%g kind %d stage %zu", beta, (int)kind, l);
    }
}
END_TEST

/* A linear system on a mesh: x_N and p_N are linear in x0, p0 and F. The memory is right to
 * 2e-14, some 50 steps round, and their equations are solved to 1e-5 of step_error, or 1e-3
 * where that is 1e-5: 1e-12, and ten times that. Seen: 0.1 of it. */
START_TEST(eq_23_16_start_and_force_add_up_to_a_linear_motion)
{
    for (size_t i = 0; i < 2 * LEN(mesh_cases); i++) {
        const size_t l = i / 2;
        chain c;
        chain_at(&c, mesh_cases[l].past, mesh_cases[l].alpha, 0, mesh_cases[l].rho);
        c.run.step_error = i % 2 ? 1e-5 : 1e-12; /* six stages, or eight */
        ck_assert_near(off_linear(&c), 0,
                       1e-12 + (i % 2 ? 1e-2 : 1e-4) * c.run.step_error,
                       "past %d alpha=%g", (int)c.run.past, c.run.alpha);
    }
}
END_TEST

/* J = x_N */
static int last_position(size_t k, size_t d, const double *x, const double *p,
                         void *params, double *Jx, double *Jp)
{
    (void)k, (void)d, (void)x, (void)params, (void)Jp;
    if (p)
        Jx[0] = 1;
    return 0;
}

/* The equation of one body on a spring is solved at once, whatever step_error. What a run
 * gives is then linear in x0 and p0 up to rounding, also where its modes have few digits:
 * the derivatives are those of the same modes. What closes their upper end is made of the
 * last step alone, which forwards is another one than backwards: 1e-10 where modes are few,
 * and 1e-13 where they are not. With fine modes in place of the modes of the run the first
 * error was 1e-8. Seen: 0.19 of it. */
START_TEST(eq_23_16_the_derivatives_belong_to_the_modes_of_the_run)
{
    static const double alphas[] = { 0.05, 0.3, 0.7, 0.95 },
                        errors[] = { 1e-4, 1e-6, 1e-12 };
    for (size_t i = 0; i < LEN(alphas) * LEN(errors); i++) {
        double mass = 1.3, rho = 0.4, x0 = 1.1, p0 = 0.4, c = 1, by_x0, by_p0;
        double x[N + 1];
        const fvi_system system = { .d = 1,
                                    .mass = &mass,
                                    .damping = &rho,
                                    .potential = fvi_potential_harmonic(&c) };
        fvi_run run = fvi_run_default(&system, &x0, &p0, 0.3, N);
        run.alpha = alphas[i / LEN(errors)];
        run.past = FVI_INITIAL_HISTORY_CAPUTO;
        run.step_error = errors[i % LEN(errors)];
        const fvi_objective J = { .slopes = last_position, .params = NULL };
        const fvi_sensitivities want = { .x0 = &by_x0, .p0 = &by_p0 };
        ck_assert_int_eq(
            fvi_trajectory(&fvi_variable_step, &run, x, NULL, NULL),
            FVI_SUCCESS);
        ck_assert_int_eq(
            fvi_adjoint(&fvi_variable_step, &run, NULL, NULL, &J, &want),
            FVI_SUCCESS);
        const double off = by_x0 * x0 + by_p0 * p0 - x[N];
        const double allowed = run.step_error < 1e-7 ? 1e-13 : 1e-10;
        seen_worst(fabs(off) / allowed, "of the bound");
        ck_assert_near(off, 0, allowed, "alpha=%g step_error=%g", run.alpha,
                       run.step_error);
    }
}
END_TEST

/* Masses, dampings, springs, forces and momenta times one factor: the same x. Roundings as
 * above. Seen: 0.03 of it. */
START_TEST(eq_23_16_a_factor_of_all_forces_changes_no_position)
{
    for (size_t i = 0; i < LEN(mesh_cases); i++) {
        chain c;
        chain_at(&c, mesh_cases[i].past, mesh_cases[i].alpha, 0.5, mesh_cases[i].rho);
        ck_assert_near(off_scaled(&c), 0, 1e-12, "past %d alpha=%g",
                       (int)c.run.past, c.run.alpha);
    }
}
END_TEST

/* Both are derivatives of nearly the same motion; J has all rows. fvi-lobatto8d with these
 * N steps errs most in its first ones, where the motion is not smooth: 1e-8, for a
 * derivative of order 1; no bound. Seen: 7.6e-10. That by alpha, whose memory has a
 * logarithm there: 1e-7. Seen: 8.8e-9. */
START_TEST(eq_23_16_two_methods_have_the_same_derivatives)
{
    for (size_t i = 0; i < LEN(mesh_cases); i++) {
        chain c;
        chain_at(&c, mesh_cases[i].past, mesh_cases[i].alpha, 0.5, mesh_cases[i].rho);
        slopes *s = slopes_by(&c, 0);
        slopes *t = slopes_of(&c.run, N * 7 + 1);
        const fvi_objective J = { .slopes = to_sine, .params = &c.run };
        ck_assert_int_eq(
            fvi_adjoint(&fvi_lobatto_d8, &c.run, NULL, NULL, &J, &t->to),
            FVI_SUCCESS);
        seen_worst(fabs(*s->to.alpha - *t->to.alpha), "by alpha");
        ck_assert_near(*s->to.alpha, *t->to.alpha, 1e-7, "past %d alpha=%g",
                       (int)c.run.past, c.run.alpha);
        for (size_t j = 0; j < NUMBERS; j++) {
            if (s->all + j == s->to.alpha)
                continue;
            seen_worst(fabs(s->all[j] - t->all[j]), "difference");
            ck_assert_near(s->all[j], t->all[j], 1e-8,
                           "past %d alpha=%g, number %zu", (int)c.run.past,
                           c.run.alpha, j);
        }
        slopes_free(s);
        slopes_free(t);
    }
}
END_TEST

/* J = x_N,1 + 0.3 p_N,3 */
static int end_of_chain(size_t k, size_t d, const double *x, const double *p,
                        void *params, double *Jx, double *Jp)
{
    (void)k, (void)x, (void)params;
    if (p) {
        Jx[0] = 1;
        Jp[d - 1] = 0.3;
    }
    return 0;
}

/* All that both methods have of a law that acts on a chain. */
static void slopes_by_law(const fvi_method *method, chain *c, double *by)
{
    const fvi_objective J = { .slopes = end_of_chain, .params = NULL };
    const fvi_sensitivities want = {
        .x0 = by,
        .p0 = by + D,
        .mass = by + 2 * D,
        .damping = by + 3 * D,
        .parameters = by + 4 * D,
        .terms = c->run.law->count == 1 ? by + 4 * D + 2 : NULL,
        .sensitivity = fvi_parameter_gradient_of(&c->system.potential)
    };
    ck_assert_int_eq(fvi_adjoint(method, &c->run, NULL, NULL, &J, &want),
                     FVI_SUCCESS);
}

/* A law on steps of any length, against fvi-lobatto8d with 1600 steps, another method with
 * other weights: both motions are smooth but at the start, and right to some 1e-13 of
 * numbers of order 1; no proof. Where a term grows faster than s the body starts at rest,
 * and there is no derivative by p0. Seen: 6.5e-14. */
START_TEST(eq_23_16_a_law_has_its_derivatives_on_a_mesh)
{
    static const fvi_kernel_term terms[][2] = {
        { { FVI_KERNEL_ZENER, 1, 0.3, 0.5, 0 } },
        { { FVI_KERNEL_ZENER, 1.5, 0.1, 0.05, 0 } },
        { { FVI_KERNEL_POWER, 1, 0.3, 0, 0 } },
        { { FVI_KERNEL_MAXWELL, 0.8, 0, 0.7, 0 } },
        { { FVI_KERNEL_POWER, 1, 0.2, 0, 0 }, { FVI_KERNEL_MAXWELL, 1, 0, 2, 0 } },
        { { FVI_KERNEL_POWER, 1, 0.7, 0, 0 } },
        { { FVI_KERNEL_POWER, 1, 0.2, 0, 0 }, { FVI_KERNEL_POWER, 0.5, 0.6, 0, 0 } },
    };
    static const size_t counts[] = { 1, 1, 1, 1, 2, 1, 2 };
    for (size_t i = 0; i < LEN(terms); i++) {
        const fvi_kernel law = { counts[i], terms[i] };
        const int is_still = fvi_kernel_growth(&law) > 1;
        double mesh[4 * D + 3] = { 0 }, stages[4 * D + 3] = { 0 };
        chain c;
        chain_at(&c, FVI_INITIAL_HISTORY_HELD, 0.9, 0.5, 1); /* alpha is not read */
        c.run.law = &law;
        c.run.step_error = 1e-13;
        c.run.h = 0.1;
        c.run.steps = 30;
        if (is_still)
            memset(c.p0, 0, sizeof c.p0);
        slopes_by_law(&fvi_variable_step, &c, mesh);
        c.run.h = 3. / 1600;
        c.run.steps = 1600;
        slopes_by_law(&fvi_lobatto_d8, &c, stages);
        for (size_t j = 0; j < LEN(mesh); j++) {
            if (is_still && j / D == 1 && c.rho[j % D] > 0) {
                ck_assert(isnan(mesh[j]));
                continue;
            }
            seen_worst(fabs(mesh[j] - stages[j]), "difference");
            ck_assert_near(mesh[j], stages[j], 1e-12, "law %zu, number %zu", i, j);
        }
    }
}
END_TEST

/* Impulses at the start, on the way, between rows and at the end: what J / m adds to v is
 * another number for another mass. Seen: 0.004 of it. */
START_TEST(eq_23_16_impulses_are_divided_by_the_mass)
{
    static const double J0[D] = { 0.4, 0, -0.3 }, J1[D] = { -0.2, 0.5, 0.1 };
    const fvi_impulse impulses[] = {
        { 0, J1 }, { 1.3, J0 }, { 3, J1 }, { 5, J0 }
    };
    for (size_t i = 0; i < LEN(mesh_cases); i++) {
        chain c;
        chain_at(&c, mesh_cases[i].past, mesh_cases[i].alpha, 0.5, mesh_cases[i].rho);
        c.system.force.impulses = impulses;
        c.system.force.impulse_count = LEN(impulses);
        fvi_stepper *refused;
        const int status = fvi_stepper_start(&fvi_variable_step, &c.run, &refused,
                                             NULL);
        ck_assert(status == FVI_SUCCESS
                  || (status == FVI_EUNSUP && c.run.alpha == 0.95));
        if (status)
            continue;
        fvi_stepper_free(refused);
        slopes *s = slopes_by(&c, 0);
        for (size_t j = 0; j < D; j++) {
            ck_assert_near(s->to.mass[j], quotient(&c, &c.mass[j]), 1e-6,
                           "past %d alpha=%g, mass %zu", (int)c.run.past,
                           c.run.alpha, j);
            if (c.rho[j] > 0)
                ck_assert_near(s->to.damping[j], quotient(&c, &c.rho[j]), 1e-6,
                               "past %d alpha=%g, damping %zu", (int)c.run.past,
                               c.run.alpha, j);
            ck_assert_near(s->to.p0[j], quotient(&c, &c.p0[j]), 1e-6,
                           "past %d alpha=%g, p0 %zu", (int)c.run.past,
                           c.run.alpha, j);
        }
        slopes_free(s);
    }
}
END_TEST

START_TEST(a_mesh_refuses_what_it_has_no_derivative_of)
{
    chain c;
    double number, x[(N + 1) * D] = { 0 };
    const fvi_objective J = { .slopes = ends, .params = NULL };
    const fvi_sensitivities by_alpha = { .alpha = &number }, none = { .x0 = NULL };
    chain_at(&c, FVI_INITIAL_HISTORY_HELD, 0.3, 0, 1);
    ck_assert_int_eq(fvi_adjoint(&fvi_variable_step, &c.run, x, x, &J, &none),
                     FVI_EUNSUP);
    static const fvi_kernel_term two[2] = { { FVI_KERNEL_POWER, 1, 0.2, 0, 0 },
                                            { FVI_KERNEL_POWER, 1, 0.3, 0, 0 } };
    const fvi_kernel law = { 2, two };
    double numbers[2];
    const fvi_sensitivities by_terms = { .terms = numbers },
                        by_orders = { .orders = numbers };
    c.run.law = &law;
    ck_assert_int_eq(
        fvi_adjoint(&fvi_variable_step, &c.run, NULL, NULL, &J, &by_terms),
        FVI_EUNSUP);
    ck_assert_int_eq(
        fvi_adjoint(&fvi_variable_step, &c.run, NULL, NULL, &J, &by_orders),
        FVI_EUNSUP);
    c.run.law = NULL;
    c.run.alpha = 1; /* a singular start */
    ck_assert_int_eq(fvi_adjoint(&fvi_variable_step, &c.run, NULL, NULL, &J, &none),
                     FVI_SUCCESS);
    ck_assert_int_eq(
        fvi_adjoint(&fvi_variable_step, &c.run, NULL, NULL, &J, &by_alpha),
        FVI_EUNSUP);
    c.run.past = FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE;
    c.run.alpha = 0;
    ck_assert_int_eq(
        fvi_adjoint(&fvi_variable_step, &c.run, NULL, NULL, &J, &by_alpha),
        FVI_EUNSUP);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("adjoint, meshes");
    ADD_CASE(suite, "rates",
             eq_23_18_the_second_reading_is_the_derivative_of_the_first);
    ADD_CASE(suite, "identities",
             eq_23_16_start_and_force_add_up_to_a_linear_motion,
             eq_23_16_the_derivatives_belong_to_the_modes_of_the_run,
             eq_23_16_a_factor_of_all_forces_changes_no_position,
             eq_23_16_two_methods_have_the_same_derivatives,
             eq_23_16_a_law_has_its_derivatives_on_a_mesh,
             eq_23_16_impulses_are_divided_by_the_mass);
    ADD_CASE(suite, "errors", a_mesh_refuses_what_it_has_no_derivative_of);
    return run_suite(suite);
}
