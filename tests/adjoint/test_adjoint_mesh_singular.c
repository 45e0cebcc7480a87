/* tests/adjoint/test_adjoint_mesh_singular.c -- H 23: derivatives with steps of any length, if the past makes the
 * start singular.
 * Run alone: make test-adjoint_mesh_singular */
#include "adjoint_meshes.h"
#include "variable_step/variable_step.h"
#include "system/larger.h"

#include <gsl/gsl_rng.h>

static const struct {
    fvi_initial_history past;
    double alpha, rho;
} cases[] = {
    { FVI_INITIAL_HISTORY_HELD, 0.55, 1 },
    { FVI_INITIAL_HISTORY_HELD, 0.7, 1 },
    { FVI_INITIAL_HISTORY_HELD, 0.75, 20 },
    { FVI_INITIAL_HISTORY_HELD, 0.95, 1 },
    { FVI_INITIAL_HISTORY_HELD, 0.7, 0.1 }, /* t1 > T */
    { FVI_INITIAL_HISTORY_HELD, 0.7, 0 },
    { FVI_INITIAL_HISTORY_HELD, 0.995, 40 }, /* falling powers, (22.23), */
    { FVI_INITIAL_HISTORY_HELD, 0.995, 3 },  /* and Euler's transformation */
    { FVI_INITIAL_HISTORY_HELD, 0.999, 0.5 },
    { FVI_INITIAL_HISTORY_HELD, 1, 1 },
    { FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE, 0, 1 },
    { FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE, 0.05, 1 },
    { FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE, 0.3, 1 },
    { FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE, 0.45, 1 },
    { FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE, 0.3, 0 },
    { FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE, 0.7, 1 },
    { FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE, 1, 1 },
};

static void chain_of(chain *c, size_t i, double g)
{
    chain_at(c, cases[i].past, cases[i].alpha, g, cases[i].rho);
    if (c->run.past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE && c->run.alpha > 0.5)
        memset(c->x0, 0, sizeof c->x0); /* no run begins elsewhere */
}

/* How the run begins: without a singular part, with one that lasts, that is handed over, as
 * falling powers, by Euler's transformation. */
enum { PLAIN, LASTING, HANDED_OVER, FALLING, TURNED, KINDS };

static int kind_of(chain *c)
{
    fvi_stepper *s;
    ck_assert_int_eq(fvi_stepper_start(&fvi_variable_step, &c->run, &s,
                                       NULL), FVI_SUCCESS);
    const fvi_singular *g = &((const fvi_variable_step_state *)s->method_state)->singular;
    const int kind = g->J == 0              ? PLAIN
                     : g->gap < 0           ? FALLING
                     : g->by_euler_transform            ? TURNED
                     : g->t1 < N * c->run.h ? HANDED_OVER
                                            : LASTING;
    fvi_stepper_free(s);
    return kind;
}

/* As without a singular start, bounds and all. Seen: 0.2 of it. */
START_TEST(eq_23_25_start_and_force_add_up_to_a_linear_motion)
{
    for (size_t i = 0; i < 2 * LEN(cases); i++) {
        chain c;
        chain_of(&c, i / 2, 0);
        c.run.step_error = i % 2 ? 1e-5 : 1e-12; /* six stages, or eight */
        const double off = off_linear(&c);
        if (i % 2)
            seen_worst(fabs(off), "six stages");
        else
            seen_worst(fabs(off), "eight stages");
        ck_assert_near(off, 0, 1e-12 + (i % 2 ? 1e-2 : 1e-4) * c.run.step_error,
                       "past %d alpha=%g", (int)c.run.past, c.run.alpha);
    }
}
END_TEST

/* Seen: 0.05 of it. */
START_TEST(eq_23_25_a_factor_of_all_forces_changes_no_position)
{
    for (size_t i = 0; i < LEN(cases); i++) {
        chain c;
        chain_of(&c, i, 0.5);
        const double off = off_scaled(&c);
        seen_worst(fabs(off), "off");
        ck_assert_near(off, 0, 1e-12, "past %d alpha=%g", (int)c.run.past,
                       c.run.alpha);
    }
}
END_TEST

/* The derivative by a damping that is zero, to one side: order 3. */
static double to_one_side(chain *c, double *number)
{
    static const double share[] = { -11, 18, -9, 2 };
    const double step = 1e-4;
    double sum = 0;
    for (size_t i = 0; i < LEN(share); i++) {
        *number = (double)i * step;
        sum += share[i] * value_of(c) / (6 * step);
    }
    *number = 0;
    return sum;
}

/* J of all rows against quotients of runs on steps of their own, 1e-8 off as said there. That
 * by alpha takes 1e-3 of its distance from 0 or 1, as J bends over that; next to 1 it would
 * be off by 1e-5 if steps changed as they may, and they hardly do. Seen: 0.005 of it. */
START_TEST(eq_23_25_differences_of_runs_with_a_singular_start)
{
    int kinds[KINDS] = { 0 };
    for (size_t i = 0; i < LEN(cases); i++) {
        chain c;
        chain_of(&c, i, 0.5);
        kinds[kind_of(&c)]++;
        const int inner = c.run.alpha > 0 && c.run.alpha < 1;
        slopes *s = slopes_of(&c.run, N + 1);
        const fvi_objective J = { .slopes = to_sine, .params = &c.run };
        double *numbers[] = { c.x0, c.p0, c.mass, c.rho };
        s->to.alpha = inner ? s->to.alpha : NULL;
        ck_assert_int_eq(
            fvi_adjoint(&fvi_variable_step, &c.run, NULL, NULL, &J, &s->to),
            FVI_SUCCESS);
        for (size_t l = 0; l < 4 * D; l++) {
            double *number = numbers[l / D] + l % D;
            const double got = s->all[l / D * MOST + l % D];
            if (l < D && c.run.past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE
                && c.run.alpha > 0.5) {
                ck_assert_msg(isnan(got) == (c.rho[l] > 0), "case %zu x0", i);
                continue;
            }
            const double want = l >= 3 * D && *number == 0
                                    ? to_one_side(&c, number)
                                    : quotient(&c, number);
            seen_worst(fabs(got - want), "off");
            ck_assert_near(got, want, 1e-6, "past %d alpha=%g, number %zu",
                           (int)c.run.past, c.run.alpha, l);
        }
        if (inner) {
            const double far = smaller(c.run.alpha, 1 - c.run.alpha),
                         want = quotient_by(&c, &c.run.alpha, 1e-3 * far);
            seen_worst(fabs(*s->to.alpha - want), "by alpha");
            ck_assert_near(*s->to.alpha, want, 1e-6, "past %d alpha=%g",
                           (int)c.run.past, c.run.alpha);
        }
        slopes_free(s);
    }
    for (size_t i = 0; i < KINDS; i++)
        ck_assert_int_gt(kinds[i], 0);
}
END_TEST

/* A = 0 of one body, the most damped one, or of all: the derivative of a singular part that is 0.
 * Seen: 1e-4 of it. */
START_TEST(eq_23_25_a_derivative_by_A_where_A_is_0)
{
    for (size_t i = 0; i < 8; i++) {
        const int held = i % 2, all = i / 2 % 2;
        chain c;
        chain_at(&c, held ? FVI_INITIAL_HISTORY_HELD : FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE,
                 held ? 0.7 : 0.3, 0.5, 1);
        double *A = held ? c.p0 : c.x0;
        c.rho[0] = i < 4 ? 0.4 : 30;
        memset(A, 0, (all ? D : 1) * sizeof *A);
        slopes *s = slopes_by(&c, 0);
        for (size_t j = 0; j < D; j++) {
            const double got = held ? s->to.p0[j] : s->to.x0[j],
                         want = quotient(&c, A + j);
            seen_worst(fabs(got - want), "off");
            ck_assert_near(got, want, 1e-6, "run %zu, body %zu", i, j);
        }
        slopes_free(s);
    }
}
END_TEST

/* ---- random ---- */

static double between(gsl_rng *random, double least, double most)
{
    return least + (most - least) * gsl_rng_uniform(random);
}

/* Dampings over three decades, a body in four without, one in four at rest. */
static void draw(gsl_rng *random, chain *c)
{
    const int held = gsl_rng_uniform(random) < 0.6;
    const double alpha =
        held ? between(random, 0.52, 0.98) : between(random, 0.03, 0.48);
    chain_at(c, held ? FVI_INITIAL_HISTORY_HELD : FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE, alpha, 0.5,
             1);
    for (size_t j = 0; j < D; j++) {
        const int damped = gsl_rng_uniform(random) < 0.75,
                  moves = gsl_rng_uniform(random) < 0.75;
        c->mass[j] = between(random, 0.5, 2);
        c->rho[j] = damped ? pow(10, between(random, -2, 1)) : 0;
        c->x0[j] = held || moves ? between(random, -1, 1) : 0;
        c->p0[j] = !held || moves ? between(random, -1, 1) : 0;
    }
}

static void go(chain *c, const chain *from, const double *along, double by)
{
    double *to[] = { c->x0, c->p0, c->mass, c->rho };
    const double *at[] = { from->x0, from->p0, from->mass, from->rho };
    for (size_t l = 0; l < 4 * D; l++)
        to[l / D][l % D] = at[l / D][l % D] + by * along[l];
    c->run.alpha = from->run.alpha + by * along[4 * D];
}

/* Along a random direction of all numbers, positive dampings by parts of themselves: as
 * above. Seen: 0.04 of it. */
START_TEST(eq_23_25_random_runs_with_a_singular_start)
{
    static const double share[] = { 1, -8, 8, -1 }, at[] = { -2, -1, 1, 2 };
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    int kinds[KINDS] = { 0 };
    gsl_rng_set(random, 2320);
    for (size_t i = 0; i < 40; i++) {
        chain c;
        double along[4 * D + 1], want = 0, got;
        draw(random, &c);
        const chain from = c;
        kinds[kind_of(&c)]++;
        for (size_t l = 0; l <= 4 * D; l++)
            along[l] =
                between(random, -1, 1)
                * (l < 3 * D ? 1
                   : l < 4 * D
                       ? from.rho[l - 3 * D]
                       : smaller(fabs(from.run.alpha - 0.5),
                                 smaller(from.run.alpha, 1 - from.run.alpha)));
        slopes *s = slopes_by(&c, 0);
        got = along[4 * D] * *s->to.alpha;
        for (size_t l = 0; l < 4 * D; l++)
            got += along[l] * s->all[l / D * MOST + l % D];
        slopes_free(s);
        for (size_t l = 0; l < LEN(at); l++) {
            const double step = 1e-3;
            go(&c, &from, along, at[l] * step);
            want += share[l] * value_of(&c) / (12 * step);
        }
        seen_worst(fabs(got - want), "off");
        ck_assert_near(got, want, 1e-6, "run %zu past %d alpha=%g", i,
                       (int)c.run.past, from.run.alpha);
        go(&c, &from, along, 0);
        ck_assert_near(off_scaled(&c), 0, 1e-11, "run %zu", i);
    }
    gsl_rng_free(random);
    ck_assert(kinds[PLAIN] > 0 && kinds[HANDED_OVER] > 10
              && kinds[LASTING] > 3);
}
END_TEST

/* Where the damping is all, m and the potential hardly matter: the derivatives by p0 are as
 * 1/rho. From rho = 1e40 on G has one falling power, behind which no force is left, and psi has
 * a pole in that force: GSL's handler would end the process there. */
START_TEST(eq_22_23_one_falling_power_leaves_no_force)
{
    double before = 0;
    for (double rho = 1e30; rho < 1e101; rho *= 1e10) {
        chain c;
        chain_at(&c, FVI_INITIAL_HISTORY_HELD, 0.8, 0.5, rho);
        c.rho[2] = c.rho[1];
        slopes *s = slopes_by(&c, 0);
        const double got = rho * s->to.p0[0];
        ck_assert(isfinite(*s->to.alpha) && isfinite(s->to.damping[0]));
        if (before != 0)
            ck_assert_near(got / before, 1, 1e-10, "rho %g", rho);
        before = got;
        slopes_free(s);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("adjoint, singular starts on meshes");
    ADD_CASE(suite, "identities",
             eq_23_25_start_and_force_add_up_to_a_linear_motion,
             eq_23_25_a_factor_of_all_forces_changes_no_position,
             eq_22_23_one_falling_power_leaves_no_force);
    ADD_CASE(suite, "quotients", eq_23_25_differences_of_runs_with_a_singular_start,
             eq_23_25_a_derivative_by_A_where_A_is_0,
             eq_23_25_random_runs_with_a_singular_start);
    return run_suite(suite);
}
