/* tests/convergence/test_convergence_stages.c -- H 20: form D on graded meshes, Duffing's oscillator from
 * generic starts, and the bound of its errors in all stages.
 * Run alone: make test-convergence_stages */
#include "any_mesh.h"
#include "bound_of_stages.h"
#include "convergence_constants_ref.h"
#include "run/whole_run.h"
#include "series.h"
#include "system/seeded.h"

/* ---- motions ---- */

enum { MOST = 512, PLACES = 120 };

static const double ROOM = 0.1; /* around the path */

static double lengths[MOST], X[MOST * MOST_STAGES], V[MOST * MOST_STAGES];
static series motion;
static table hidden; /* of q = g(x) - f = -(x'' + r D^{2 alpha} x) */

static uint64_t state;

static double between(double low, double high)
{
    return fvi_seeded_uniform(&state, low, high);
}

static double duffing_force(double x, const void *of)
{
    const duffing *q = of;
    return q->c * x + q->g * x * x * x;
}

static double driven(double t, const void *of)
{
    const duffing *q = of;
    return q->A * cos(q->w * t);
}

static double rough_size;

static double rough(double t)
{
    (void)t;
    return rough_size;
}

static duffing some_duffing(size_t seed)
{
    state = 20 + seed;
    for (int i = 0; i < 8; i++)
        between(0, 1);
    return (duffing){ .past = FVI_INITIAL_HISTORY_CAPUTO,
                      .alpha = seed % 5 == 4 ? 0.5 : seed % 2 ? between(0.05, 0.45) : between(0.55, 0.9),
                      .rho = between(0.05, 0.5), .x0 = between(-1, 1), .v0 = between(-1, 1),
                      .c = between(0.3, 1), .g = between(0.1, 0.5), .A = between(-1, 1),
                      .w = between(0.5, 2) };
}

/* The coefficients of q: those of the second derivative and of the memory meet at the same exponents. */
static void expand_hidden(const duffing *q)
{
    const double gamma = motion.gamma;
    memset(hidden, 0, sizeof hidden);
    for (int i = -2; i + 2 < ROWS; i++)
        for (int j = 0; j < columns(i + 2, gamma, ROWS); j++) {
            const double e = i + 2 + j * gamma, bent = e * (e - 1) * motion.c[i + 2][j];
            double damped = 0;
            if (j > 0 && is_in_history(q, i + 2, j - 1)) {
                const double before = e - gamma;
                damped = q->rho * motion.c[i + 2][j - 1] * tgamma(before + 1) / tgamma(e - 1);
            }
            const double sum = bent + damped;
            if (i >= 0)
                hidden[i][j] = -sum;
            else /* what goes with t^-2 and t^-1 cancels */
                ck_assert_double_le(fabs(sum), 1e-12 * (fabs(bent) + fabs(damped)));
        }
}

/* t^(n - shift) times the n-th derivative of the sum of c_ij t^(i + j gamma), the largest |...| on (0, T],
 * and a hundredth more. */
static double largest_derivative(table c, size_t n, double shift, double T)
{
    const double gamma = motion.gamma;
    double most = 0;
    for (int place = 0; place <= PLACES; place++) {
        const double t = T * exp(-0.125 * place), along = pow(t, gamma);
        double sum = 0;
        for (int i = 0; i < ROWS; i++) {
            const int count = columns(i, gamma, ROWS);
            double power = pow(t, i - shift);
            for (int j = 0; j < count; j++, power *= along) {
                double e = i + j * gamma, factor = c[i][j];
                if (factor == 0)
                    continue;
                for (size_t l = 0; l < n; l++)
                    factor *= e - (double)l;
                sum += factor * power;
            }
        }
        most = larger(most, fabs(sum));
    }
    return 1.01 * most;
}

static stage_motion know(const duffing *q, size_t s, double T, double eps)
{
    const size_t from = q->alpha > 0.5 ? 2 : 1;
    stage_motion known = { .s = s, .alpha = q->alpha, .r = q->rho, .eps = eps };
    expand(q, &motion);
    expand_hidden(q);
    const double far = largest_derivative(motion.c, 0, 0, T) + ROOM;
    known.lipschitz = q->c + 3 * q->g * far * far; /* where stages are */
    for (size_t i = 0; i <= s; i++)
        known.A[i] = largest_derivative(motion.c, i + from, (double)from, T);
    for (size_t i = 1; i <= s; i++) {
        known.B[i] = largest_derivative(motion.c, i + 1, 2, T);
        known.H[i] = largest_derivative(hidden, i, 1, T);
    }
    return known;
}

/* Nodes of a graded mesh, moved by up to a third of a step; for grade 0, steps whose lengths differ by factors up
 * to 1000, in any order. */
static void some_mesh(size_t N, double T, double grade)
{
    if (grade == 0) {
        double sum = 0;
        for (size_t k = 0; k < N; k++)
            sum += lengths[k] = exp(between(-6.9, 0));
        for (size_t k = 0; k < N; k++)
            lengths[k] *= T / sum;
        return;
    }
    graded(T, N, grade, lengths);
    for (size_t k = 0; k + 1 < N; k++) {
        const double move = between(0, 1. / 3) * smaller(lengths[k], lengths[k + 1]);
        lengths[k] += move;
        lengths[k + 1] -= move;
    }
}

/* The bound itself: each of its constants counts, though no run comes near enough to it to tell. Of the script, by
 * quadrature. Seen: 3e-12. */
START_TEST(eq_20_25_constants)
{
    for (size_t r = 0; r < LEN(ref_bounds); r++) {
        stage_motion known = { .s = ref_bounds[r].s, .alpha = ref_bounds[r].alpha, .r = ref_bounds[r].r,
                               .lipschitz = ref_bounds[r].lipschitz, .eps = ref_bounds[r].eps };
        for (size_t i = 0; i <= known.s; i++) {
            known.A[i] = 1 + (double)i / 4;
            known.B[i] = 0.5 + (double)i / 8;
            known.H[i] = 0.75 + (double)i / 2;
        }
        const stage_bound bound = bound_of_stages(&known, LEN(ref_steps), ref_steps);
        seen(larger(fabs(bound.E / ref_bounds[r].E - 1), fabs(bound.X / ref_bounds[r].X - 1)), "of the bounds");
        ck_assert_near(bound.lambda, ref_bounds[r].lambda, 1e-10 * ref_bounds[r].lambda, "lambda, row %zu", r);
        ck_assert_near(bound.E, ref_bounds[r].E, 1e-10 * ref_bounds[r].E, "E, row %zu", r);
        ck_assert_near(bound.X, ref_bounds[r].X, 1e-10 * ref_bounds[r].X, "X, row %zu", r);
    }
}
END_TEST

//> stages
/* The errors of all stages on this mesh, in units of (20.25); they have to be at most 1. */
static void measure(const duffing *q, const stage_motion *known, size_t N, const stage_bound *bound,
                    double near[2])
{
    const size_t s = known->s;
    const body of = { q->alpha, q->rho, q->x0, q->v0, duffing_force, driven, q, known->eps > 0 ? rough : NULL };
    const stages rule = stages_of(s);
    double t = 0, weight = 1;
    near[0] = near[1] = 0;
    run_on_mesh(&of, s, N, lengths, X, V);
    for (size_t k = 0; k < N; k++) {
        for (size_t i = 0; i < s; i++) {
            double at_x, at_v;
            at(&motion, t + rule.c[i] * lengths[k], &at_x, &at_v);
            const double off_x = fabs(X[k * s + i] - at_x), off_v = fabs(V[k * s + i] - at_v);
            ck_assert_double_le(off_x, weight * bound->X);
            ck_assert_double_le(off_v, weight * bound->E);
            near[0] = larger(near[0], off_x / (weight * bound->X));
            near[1] = larger(near[1], off_v / (weight * bound->E));
        }
        t += lengths[k];
        weight *= 1 + bound->lambda * lengths[k];
    }
}

/* Duffing's oscillators to t = 1/2 on meshes of any grade, and on wild ones. Where (20.25) speaks of the mesh, no
 * stage is off by more. Seen: up to 0.14 of the bound with two stages, 0.09 with three, 0.05 with four, and 0.11 where errors
 * of the modes rule. */
START_TEST(eq_20_25_no_stage_is_off_by_more)
{
    const double T = 0.5;
    size_t allowed = 0;
    double most[5] = { 0 }, of_eps = 0, least = 1;
    for (size_t seed = 0; seed < 24; seed++) {
        const duffing q = some_duffing(seed);
        const size_t s = 2 + seed % 3;
        const double eps = seed % 4 == 3 ? 0.05 : 0;
        const stage_motion known = know(&q, s, T, eps);
        rough_size = eps;
        for (size_t N = 8; N <= 64; N *= 2) {
            double near[2], w = 1;
            some_mesh(N, T, N == 16 ? 0 : between(1, 2 * (double)s / (1 + memory_order(q.alpha))));
            const stage_bound bound = bound_of_stages(&known, N, lengths);
            for (size_t k = 0; k < N; k++)
                w *= 1 + bound.lambda * lengths[k];
            if (!(w * bound.X <= ROOM))
                continue;
            allowed++;
            measure(&q, &known, N, &bound, near);
            least = smaller(least, smaller(near[0], near[1]));
            double *of = eps > 0 ? &of_eps : &most[s];
            *of = larger(*of, smaller(near[0], near[1]));
        }
    }
    seen((double)allowed, "meshes");
    for (size_t s = 2; s <= 4; s++) {
        seen(most[s], "of the bound, s=%zu", s);
        ck_assert_double_ge(most[s], 0.04);
    }
    seen(of_eps, "of the bound with errors of the modes");
    seen(least, "least of the bound");
    ck_assert_uint_ge(allowed, 60);
    ck_assert_double_ge(of_eps, 0.1);
}
END_TEST

/* On meshes of the grade 1.2 s/(1 + theta) the bound falls with the order s, to 0.1. Seen: 0.01. */
START_TEST(eq_20_25_order_of_the_stages)
{
    const double T = 0.5;
    double bound_off = 0;
    for (size_t seed = 0; seed < 6; seed++) {
        const duffing q = some_duffing(seed);
        const size_t s = 2 + seed % 3;
        const stage_motion known = know(&q, s, T, 0);
        double before = 0;
        for (size_t N = 128; N <= 256; N *= 2) {
            graded(T, N, 1.2 * (double)s / (1 + memory_order(q.alpha)), lengths);
            const double now = bound_of_stages(&known, N, lengths).E;
            bound_off = larger(bound_off, before > 0 ? (double)s - log2(before / now) : 0);
            before = now;
        }
    }
    seen(bound_off, "order of the bound off");
    ck_assert_double_le(bound_off, 0.1);
}
END_TEST
//< stages

static int force(double t, size_t d, void *params, double *F)
{
    for (size_t i = 0; i < d; i++)
        F[i] = driven(t, params);
    return FVI_SUCCESS;
}

/* With equal steps the run on a mesh is that of form D in the library: nodes agree to 1e-12, in 24 steps. */
START_TEST(equal_steps_are_form_d)
{
    const fvi_method *const form_d[] = { &fvi_lobatto_d2, &fvi_lobatto_d3, &fvi_lobatto_d4, &fvi_lobatto_d5,
                                         &fvi_lobatto_d6, &fvi_lobatto_d7, &fvi_lobatto_d8 };
    enum { N = 24 };
    const double one = 1;
    for (size_t seed = 0; seed < 14; seed++) {
        const duffing q = some_duffing(seed);
        const size_t s = 2 + seed % 7;
        const double cg[] = { q.c, q.g };
        const fvi_system system = { .d = 1, .mass = &one, .damping = &q.rho,
                                    .potential = fvi_potential_duffing(cg),
                                    .force = { .value = force, .params = (void *)&q } };
        const body of = { q.alpha, q.rho, q.x0, q.v0, duffing_force, driven, &q, NULL };
        double x[N + 1], p[N + 1];
        fvi_run run = fvi_run_default(&system, &q.x0, &q.v0, 0.125, N);
        run.alpha = q.alpha;
        run.past = FVI_INITIAL_HISTORY_CAPUTO;
        OK(fvi_trajectory(form_d[s - 2], &run, x, p, NULL));
        for (size_t k = 0; k < N; k++)
            lengths[k] = run.h;
        run_on_mesh(&of, s, N, lengths, X, V);
        for (size_t n = 1; n <= N; n++) {
            ck_assert_near(X[n * s - 1], x[n], 1e-12, "s=%zu alpha=%g x_%zu", s, q.alpha, n);
            ck_assert_near(V[n * s - 1], p[n], 1e-12, "s=%zu alpha=%g p_%zu", s, q.alpha, n);
        }
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("20 convergence, form D on any mesh");
    ADD_CASE(suite, "mesh", equal_steps_are_form_d);
    ADD_CASE(suite, "bound", eq_20_25_no_stage_is_off_by_more, eq_20_25_order_of_the_stages,
             eq_20_25_constants);
    return run_suite(suite);
}
