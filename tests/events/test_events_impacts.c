/* tests/events/test_events_impacts.c -- Impacts: balls that bounce, and walls that move.  [H 22]
 * Run alone: make test-events_impacts */
#include "ball.h"

#include "events_ref.h"

#include <math.h>

/* With the tolerance 1e-14 the errors are roundings: two ulps of x, at most 1, in each step, and an
 * error of x is twice one of t where the speed is 1/2. */
static double bound(const fvi_stepper *s)
{
    fvi_step_statistics counts;
    fvi_stepper_statistics(s, &counts);
    return 4 * (double)counts.steps * U;
}

/* A wall that is oblique and moves: x1 + 2 x2 = sin t. */
static int oblique(double t, size_t d, const double *x, const double *p,
                   void *params, double *z)
{
    (void)d, (void)p, (void)params;
    *z = x[0] + 2 * x[1] - sin(t);
    return 0;
}

static int oblique_normal(double t, size_t d, const double *x, void *params,
                          double *normal, double *rate)
{
    (void)d, (void)x, (void)params;
    normal[0] = 1;
    normal[1] = 2;
    *rate = -cos(t);
    return 0;
}

/* Exact by superposition. Seen: 0.024 of the bound. */
START_TEST(a_ball_bounces_when_and_where_it_should)
{
    const fvi_event floor = impact(0.8);
    for (size_t i = 0; i < LEN(ref_ball); i++) {
        const fvi_system system = ball(&ref_ball[i].rho);
        fvi_run run = fall(&system, 1, &floor, 5);
        run.alpha = ref_ball[i].alpha;
        run.step_error = 1e-14;
        fvi_stepper *s = started(&run);
        go(s);
        size_t n;
        const fvi_event_time *at = fvi_stepper_events(s, &n);
        ck_assert_uint_eq(n, (size_t)ref_ball[i].count);
        ck_assert(!fvi_stepper_is_over(s) && s->t == 5);
        const double times[] = { ref_ball[i].t0, ref_ball[i].t1, ref_ball[i].t2,
                                 ref_ball[i].t3 };
        for (size_t k = 0; k < n; k++) {
            ck_assert_near(at[k].t, times[k], bound(s), "alpha %g, impact %zu",
                           run.alpha, k);
            ck_assert(at[k].event == 0 && !at[k].at_rest);
        }
        ck_assert_near(s->x[0], ref_ball[i].x, bound(s), "alpha %g, x", run.alpha);
        ck_assert_near(s->p[0], ref_ball[i].v, 4 * bound(s), "alpha %g, v", run.alpha);
        fvi_stepper_free(s);
    }
}
END_TEST

/* Undamped, impact k is at sqrt(2) (1 + 2 (e + ... + e^k)), and all of them end before
 * sqrt(2) (1 + e) / (1 - e): then the ball is at rest. Roundings: 64 u for each bounce.
 * Seen: 0.03 of that. */
START_TEST(a_ball_comes_to_rest)
{
    const fvi_event floor = impact(0.5);
    const fvi_system system = ball(&none);
    fvi_run run = fall(&system, 1, &floor, 20);
    run.step_error = 1e-10;
    fvi_stepper *s = started(&run);
    go(s);
    size_t n;
    const fvi_event_time *at = fvi_stepper_events(s, &n);
    /* the first hop that is not higher than 1e-10: 4^-k <= 1e-10 */
    ck_assert_uint_eq(n, 17);
    double want = sqrt(2), hop = sqrt(2);
    for (size_t k = 0; k < n; k++) {
        ck_assert_near(at[k].t, want, 64 * (double)(k + 1) * U * want, "impact %zu", k);
        ck_assert_int_eq(at[k].at_rest, k + 1 == n);
        want += hop;
        hop /= 2;
    }
    ck_assert(fvi_stepper_is_over(s) && s->t == at[n - 1].t);
    ck_assert_near(s->x[0], 0, 4 * U, "where it rests");
    ck_assert_int_eq(fvi_stepper_step(s), FVI_EINVAL);
    fvi_stepper_free(s);
}
END_TEST

/* A ball that starts on a floor at x = 1, where a short step changes no digit of x, lies there, too. */
START_TEST(a_ball_starts_on_a_floor_that_is_not_at_0)
{
    double floor_at = 1;
    fvi_event floor = impact(0);
    floor.params = &floor_at;
    const fvi_system system = ball(&none);
    const fvi_run run = fall(&system, 1, &floor, 3);
    size_t n;
    fvi_stepper *s = started(&run);
    go(s);
    const fvi_event_time *at = fvi_stepper_events(s, &n);
    ck_assert_uint_eq(n, 1);
    ck_assert(at[0].at_rest && fvi_stepper_is_over(s));
    ck_assert_near(s->t, 0, 1.5e-7, "at once"); /* as t^2/2 is below 8 eps 3^2/2 */
    fvi_stepper_free(s);
}
END_TEST

/* On the floor from the start, a ball lies there for any e, thrown up it lands after 2 p, also where the first
 * step is longer than that, and thrown down it is refused. */
START_TEST(a_ball_starts_on_the_floor)
{
    static const double zero = 0, up = 0.1, down = -1, restitution[] = { 0, 0.5, 1 };
    const fvi_system system = ball(&none);
    for (size_t i = 0; i < LEN(restitution); i++) {
        const fvi_event floor = impact(restitution[i]);
        fvi_run run = fall(&system, 1, &floor, 3);
        size_t n;
        run.x0 = &zero;
        fvi_stepper *s = started(&run);
        go(s);
        const fvi_event_time *at = fvi_stepper_events(s, &n);
        ck_assert_uint_eq(n, 1);
        ck_assert(at[0].at_rest && fvi_stepper_is_over(s));
        /* t^2/2 is below the rounding of the z that the first trials have seen, 8 eps 3^2/2 */
        ck_assert_near(s->t, 0, 1.5e-7, "at once");
        ck_assert_near(s->x[0], 0, 1e-14, "where it lies");
        fvi_stepper_free(s);
        run.p0 = &up;
        s = started(&run);
        go(s);
        at = fvi_stepper_events(s, &n);
        ck_assert_uint_ge(n, 1);
        ck_assert_near(at[0].t, 0.2, 64 * U, "it lands");
        fvi_stepper_free(s);
        run.p0 = &down;
        fvi_error error = { 0 };
        ck_assert_int_eq(fvi_stepper_start(&fvi_variable_step, &run, &s, &error), FVI_EINVAL);
        ck_assert_str_eq(error.text, "event 0: starts at Z = 0 and moves into the wall");
    }
}
END_TEST

/* Elastic, the energy stays; e = 0 is at rest at once; damped ones come to rest, too. */
START_TEST(elastic_and_plastic_impacts)
{
    const double rho[] = { 0.3, 0.3, 3 }, alpha[] = { 0.3, 0.7, 0.3 };
    const fvi_event elastic = impact(1), plastic = impact(0), half = impact(0.5);
    const fvi_system free_ball = ball(&none);
    fvi_run run = fall(&free_ball, 1, &elastic, 40);
    fvi_stepper *s = started(&run);
    size_t n;
    go(s);
    fvi_stepper_events(s, &n);
    ck_assert_uint_eq(n, 14); /* sqrt(2) (2 k - 1) < 40 */
    ck_assert_near(s->x[0] + s->p[0] * s->p[0] / 2, 1, 1e-12, "energy");
    fvi_stepper_free(s);
    run.events = &plastic;
    s = started(&run);
    go(s);
    const fvi_event_time *at = fvi_stepper_events(s, &n);
    ck_assert(n == 1 && at[0].at_rest);
    ck_assert_double_eq(s->p[0], 0);
    fvi_stepper_free(s);
    for (size_t i = 0; i < LEN(rho); i++) {
        const fvi_system system = ball(&rho[i]);
        run = fall(&system, 1, &half, 50);
        run.alpha = alpha[i];
        s = started(&run);
        go(s);
        at = fvi_stepper_events(s, &n);
        ck_assert_msg(n > 8 && n < 30 && at[n - 1].at_rest, "rho %g: %zu", rho[i], n);
        fvi_stepper_free(s);
    }
}
END_TEST

/* p -> p - (1 + e) n (n v + rate) / (n M^-1 n), two masses on Duffing's springs, from what the
 * dense output has just before. Also the order: with the tolerance the errors of all times fall;
 * the run with 1e-14 stands for the exact one. */
START_TEST(an_oblique_wall_that_moves)
{
    const double masses[] = { 1, 2.5 }, rho[] = { 0.2, 0.1 }, x0[] = { 1, 0.5 },
                 p0[] = { 0, -0.4 }, cg[] = { 1, 0.7 };
    const fvi_event wall = { .value = oblique,
                             .gradient = oblique_normal,
                             .action = FVI_EVENT_IMPACT,
                             .restitution = 0.7 };
    const fvi_system system = { .d = 2,
                                .mass = masses,
                                .damping = rho,
                                .potential = fvi_potential_duffing(cg) };
    double times[4][64], before = 0;
    const double tolerance[] = { 1e-14, 1e-5, 1e-7, 1e-9 };
    size_t n;
    for (size_t i = 0; i < 4; i++) {
        fvi_run run = fvi_run_default(&system, x0, p0, 1, 9);
        run.alpha = 0.35;
        run.events = &wall;
        run.event_count = 1;
        run.step_error = tolerance[i];
        fvi_stepper *s = started(&run);
        size_t known = 0;
        while (s->k < 9 && !fvi_stepper_is_over(s)) {
            ck_assert_int_eq(fvi_stepper_step(s), FVI_SUCCESS);
            const fvi_event_time *at = fvi_stepper_events(s, &n);
            if (n == known)
                continue;
            double x[2], p[2], z;
            const double t = s->t - 1e-12, v0 = 1 / masses[0] + 4 / masses[1];
            ck_assert_int_eq(fvi_stepper_advance_to(s, t, x, p), FVI_SUCCESS);
            const double along =
                p[0] / masses[0] + 2 * p[1] / masses[1] - cos(s->t), J = -1.7 * along / v0;
            /* p changes by forces < 10 in 1e-12 */
            ck_assert_near(s->p[0] - p[0], J, 1e-10, "p1");
            ck_assert_near(s->p[1] - p[1], 2 * J, 1e-10, "p2");
            oblique(s->t, 2, s->x, s->p, NULL, &z);
            ck_assert_near(z, 0, 16 * U, "z, %g", tolerance[i]); /* seen: 3 u */
            times[i][n - 1] = at[n - 1].t;
            known = n;
        }
        ck_assert_uint_ge(n, 3);
        const double error = fabs(times[i][2] - times[0][2]);
        ck_assert_msg(error <= 10 * tolerance[i], "%g: %g", tolerance[i], error);
        ck_assert_msg(i < 2 || error < before / 4, "%g: %g, %g before", tolerance[i], error, before);
        before = i > 0 ? error : 0;
        fvi_stepper_free(s);
    }
}
END_TEST

/* A wall that comes ever faster: z = x - t^2/10. */
static int coming(double t, size_t d, const double *x, const double *p,
                  void *params, double *z)
{
    (void)d, (void)p, (void)params;
    *z = x[0] - t * t / 10;
    return 0;
}

static int coming_normal(double t, size_t d, const double *x, void *params,
                         double *normal, double *rate)
{
    (void)d, (void)x, (void)params;
    *normal = 1;
    *rate = -t / 5;
    return 0;
}

/* A free body at 1 is met at sqrt(10). With e = 0 the wall carries it from then on, by its own
 * acceleration alone: it is at rest there. With e = 1 it leaves with twice the wall's velocity. */
START_TEST(a_wall_that_carries_a_body)
{
    fvi_event wall = { .value = coming, .gradient = coming_normal, .action = FVI_EVENT_IMPACT };
    const fvi_system system = { .d = 1, .mass = &mass, .damping = &none };
    const fvi_run run = fall(&system, 1, &wall, 4);
    size_t n;
    for (int elastic = 0; elastic < 2; elastic++) {
        wall.restitution = elastic;
        fvi_stepper *s = started(&run);
        go(s);
        const fvi_event_time *at = fvi_stepper_events(s, &n);
        ck_assert_uint_eq(n, 1);
        ck_assert_near(at[0].t, sqrt(10), 64 * U, "met");
        ck_assert_int_eq(at[0].at_rest, !elastic);
        ck_assert_near(s->p[0], (1 + elastic) * sqrt(10) / 5, 64 * U, "velocity");
        fvi_stepper_free(s);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("impacts");
    ADD_CASE(suite, "a ball", a_ball_bounces_when_and_where_it_should, a_ball_comes_to_rest,
             a_ball_starts_on_the_floor, a_ball_starts_on_a_floor_that_is_not_at_0,
             elastic_and_plastic_impacts);
    ADD_CASE(suite, "walls", an_oblique_wall_that_moves, a_wall_that_carries_a_body);
    return run_suite(suite);
}
