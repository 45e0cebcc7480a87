/* tests/events/test_events_accuracy.c -- Events of a motion that is accurate to a wanted error. [H 22]
 * Run alone: make test-events_accuracy */
#include "ball.h"

#include "error_control/event_list.h"
#include "events_ref.h"

#include <math.h>
#include <string.h>

enum { MOST = 4096, ROWS = 41 };

/* What a call has told: rows and events, in the order in which they came. */
typedef struct {
    double x[ROWS], p[ROWS], last;
    size_t rows, events, most_events;
    fvi_event_time at[MOST];
    double place[MOST], momentum[MOST];
    fvi_report report;
    fvi_error error;
} told;

static int keep_row(size_t k, double t, const double *x, const double *p, void *params)
{
    told *to = params;
    (void)x, (void)p;
    ck_assert(k == to->rows++ && t >= to->last);
    to->last = t;
    return 0;
}

static int keep_event(const fvi_event_time *at, const double *x, const double *p, void *params)
{
    told *to = params;
    ck_assert(at->t >= to->last && to->events < MOST);
    to->last = at->t;
    to->place[to->events] = x[0];
    to->momentum[to->events] = p[0];
    to->at[to->events++] = *at;
    return to->events == to->most_events ? 77 : 0;
}

/* A ball that is let go at 1, to T. */
static int solve(const double *rho, double alpha, double T, size_t count, const fvi_event *events,
                 const fvi_solve_options *options, double tolerance, told *to)
{
    const fvi_problem problem = { .system = ball(rho),
                                  .x0 = &one,
                                  .p0 = &none,
                                  .T = T,
                                  .alpha = alpha,
                                  .events = events,
                                  .event_count = count };
    const fvi_accuracy accuracy = { .tolerance = tolerance };
    const fvi_outputs outputs = { .rows = ROWS, .x = to->x, .p = to->p, .row = keep_row,
                                  .event = keep_event, .params = to };
    to->rows = to->events = 0;
    to->last = 0;
    for (size_t k = 0; k < ROWS; k++)
        to->x[k] = NAN;
    return fvi_solve(&problem, options, &accuracy, &outputs, &to->report, &to->error);
}

/* Undamped, impact k at sqrt(2) (1 + 2 (e + ... + e^k)) and the hop behind it e^{2k} high: at rest behind the
 * first hop that is no higher than the tolerance. The largest speed is sqrt(2). Rows stand up to there.
 * Seen: 0.04 of the bound. */
START_TEST(a_ball_bounces_and_comes_to_rest_as_it_should)
{
    static told to;
    static const double restitution[] = { 0.3, 0.5, 0.8 };
    for (size_t i = 0; i < LEN(restitution); i++) {
        const double e = restitution[i];
        const fvi_event ground = impact(e);
        for (double tolerance = 1e-2; tolerance > 1e-12; tolerance /= 10) {
            OK(solve(&none, 0.5, 20, 1, &ground, NULL, tolerance, &to));
            ck_assert_ptr_eq(to.report.method, &fvi_variable_step);
            ck_assert(to.report.error <= tolerance && to.report.events == to.events);
            double t = sqrt(2), hop = 2 * e * sqrt(2), height = e * e;
            for (size_t k = 0; k < to.events; k++) {
                ck_assert_near(to.at[k].t, t, 1e-13 + tolerance / sqrt(2), "e %g, impact %zu", e, k);
                ck_assert_near(to.place[k], 0, 1e-14, "e %g, impact %zu", e, k);
                ck_assert_int_eq(to.at[k].at_rest, height <= tolerance);
                ck_assert_int_eq(to.at[k].at_rest, k + 1 == to.events);
                t += hop;
                hop *= e;
                height *= e * e;
            }
            const double end = to.at[to.events - 1].t;
            ck_assert(to.rows == to.report.rows && to.rows == (size_t)floor(end / 0.5) + 1);
            for (size_t k = 0; k < ROWS; k++)
                ck_assert_int_eq(isnan(to.x[k]), k >= to.rows);
        }
    }
}
END_TEST

/* Damped, against the exact impacts, as far as these are known, and against the run with steps that are right
 * to rounding. The largest speed is 1.3. Seen: 0.01 of the bound. */
START_TEST(a_damped_ball_bounces_as_it_should)
{
    static told to, fine;
    const fvi_event ground = impact(0.8);
    for (size_t i = 0; i < LEN(ref_ball); i++) {
        const double times[] = { ref_ball[i].t0, ref_ball[i].t1, ref_ball[i].t2, ref_ball[i].t3 };
        for (double tolerance = 1e-2; tolerance > 1e-12; tolerance /= 100) {
            OK(solve(&ref_ball[i].rho, ref_ball[i].alpha, 5, 1, &ground, NULL, tolerance, &to));
            ck_assert_uint_eq(to.events, (size_t)ref_ball[i].count);
            for (size_t k = 0; k < to.events; k++)
                ck_assert_near(to.at[k].t, times[k], 1e-13 + tolerance, "alpha %g, impact %zu",
                               ref_ball[i].alpha, k);
            ck_assert_near(to.x[ROWS - 1], ref_ball[i].x, 1e-13 + tolerance, "alpha %g, x", ref_ball[i].alpha);
        }
    }
    const double rho[] = { 0.3, 0.3, 0.1 }, alpha[] = { 0.3, 0.7, 0.5 };
    for (size_t i = 0; i < LEN(rho); i++) {
        const fvi_event with_rest = { .value = height, .gradient = upwards, .action = FVI_EVENT_IMPACT,
                                      .restitution = 0.5, .rest = 1e-7 };
        const fvi_solve_options finest = { .step_error = 1e-15 };
        OK(solve(rho + i, alpha[i], 20, 1, &with_rest, &finest, 0, &fine));
        for (double tolerance = 1e-3; tolerance > 1e-11; tolerance /= 10) {
            OK(solve(rho + i, alpha[i], 20, 1, &with_rest, NULL, tolerance, &to));
            ck_assert_uint_eq(to.events, fine.events);
            ck_assert(to.at[to.events - 1].at_rest && to.events > 8 && to.rows == fine.rows);
            for (size_t k = 0; k < to.events; k++)
                ck_assert_near(to.at[k].t, fine.at[k].t, 1e-12 + tolerance, "alpha %g, impact %zu", alpha[i], k);
        }
    }
}
END_TEST

static int speed(double t, size_t d, const double *x, const double *p, void *params, double *z)
{
    (void)t, (void)d, (void)x, (void)params;
    *z = p[0];
    return 0;
}

/* A mark, an impact and a stop, in the order of their times, with rows between them; where T is the time of an
 * impact itself it may be there or not. What the caller's function returns ends the call. */
START_TEST(events_stand_among_the_rows)
{
    static told to;
    double quarter = 0.25, end = 0.125;
    const fvi_event events[] = { impact(0.8), { .value = height, .params = &quarter, .direction = -1 },
                                 { .value = speed },
                                 { .value = height, .params = &end, .action = FVI_EVENT_STOP, .direction = 1 } };
    const double T = sqrt(2), v = 0.8 * T, at[] = { sqrt(1.5), T, T + v - sqrt(v * v - 0.25) };
    const size_t which[] = { 1, 0, 3 };
    OK(solve(&none, 0.5, 4, 4, events, NULL, 1e-9, &to));
    ck_assert(to.events == 3 && to.rows == (size_t)floor(at[2] / 0.1) + 1);
    for (size_t k = 0; k < 3; k++) {
        ck_assert_uint_eq(to.at[k].event, which[k]);
        ck_assert_near(to.at[k].t, at[k], 1e-9, "event %zu", k);
    }
    ck_assert_near(to.momentum[1], v, 1e-8, "behind the impact");
    ck_assert_near(to.place[2], 0.125, 1e-14, "where it stops");
    OK(solve(&none, 0.5, T, 1, events, NULL, 1e-9, &to));
    ck_assert_uint_le(to.events, 1);
    ck_assert_uint_eq(to.rows, ROWS);
    to.most_events = 2;
    ck_assert_int_eq(solve(&none, 0.5, 4, 4, events, NULL, 1e-9, &to), 77);
    const fvi_solve_options steps = { .h = 0.1 };
    ck_assert_int_eq(solve(&none, 0.5, 4, 4, events, &steps, 0, &to), 77);
    to.most_events = 0;
    OK(solve(&none, 0.5, 4, 4, events, &steps, 0, &to));
    ck_assert(to.events == 3 && to.rows == (size_t)floor(at[2] / 0.1) + 1);
    const fvi_solve_options other = { .method = &fvi_cq_bdf2 };
    ck_assert_int_eq(solve(&none, 0.5, 4, 4, events, &other, 1e-3, &to), FVI_EUNSUP);
    ck_assert_str_eq(to.error.text, "this method has no events; fvi-adaptive has");
}
END_TEST

/* A table that shakes: what an elastic ball does on it is chaotic, and after some impacts no two runs agree. */
static int above_table(double t, size_t d, const double *x, const double *p, void *params, double *z)
{
    (void)d, (void)p, (void)params;
    *z = x[0] - 0.3 * sin(3 * t);
    return 0;
}

static int table_normal(double t, size_t d, const double *x, void *params, double *normal, double *rate)
{
    (void)d, (void)x, (void)params;
    normal[0] = 1;
    *rate = -0.9 * cos(3 * t);
    return 0;
}

START_TEST(events_of_a_chaotic_motion_are_refused)
{
    static told to;
    const fvi_event table = { .value = above_table, .gradient = table_normal, .action = FVI_EVENT_IMPACT,
                              .restitution = 1 };
    ck_assert_int_eq(solve(&none, 0.5, 400, 1, &table, NULL, 1e-6, &to), FVI_ETOL);
    ck_assert(to.rows == 0 && to.events == 0 && to.report.events_differ && isinf(to.report.error));
    ck_assert(to.report.agreed > 5 && to.report.agreed_until > 5 && to.report.agreed_until < 400);
    ck_assert_msg(strstr(to.error.text, "no two runs have the same events") != NULL, "%s", to.error.text);
    OK(solve(&none, 0.5, 5, 1, &table, NULL, 1e-6, &to)); /* a short time is another matter */
    ck_assert_uint_gt(to.events, 1);
}
END_TEST

START_TEST(a_height_of_rest_is_checked)
{
    static told to;
    fvi_event ground = impact(0.5);
    ground.rest = -1;
    ck_assert_int_eq(solve(&none, 0.5, 5, 1, &ground, NULL, 1e-6, &to), FVI_EDOM);
    ck_assert_str_eq(to.error.field, "events");
    ground.rest = NAN;
    ck_assert_int_eq(solve(&none, 0.5, 5, 1, &ground, NULL, 1e-6, &to), FVI_EDOM);
    ground.rest = 0.1; /* 0.25 is above it, 0.0625 is not */
    OK(solve(&none, 0.5, 5, 1, &ground, NULL, 1e-6, &to));
    ck_assert_uint_eq(to.events, 2);
    ck_assert(to.at[1].at_rest);
}
END_TEST

/* Two lists, with 2 as the largest speed, an error of 0.01 and the end 10: how far they are apart. */
static double apart(size_t n, fvi_event_time *a, size_t m, fvi_event_time *b, fvi_event_agreement *common)
{
    double places[] = { 0, 1, 2, 3, 4, 5, 6, 7 }, others[] = { 0.25, 1, 2, 3, 4, 5, 6, 7 }, distance;
    const fvi_event_list list = { .count = n, .at = a, .place = places },
                         other = { .count = m, .at = b, .place = others };
    OK(fvi_event_list_distance(&list, &other, 1, 2, 2, 10, 0.01, &distance, common));
    return distance;
}

START_TEST(lists_of_events_are_compared)
{
    fvi_event_time a[] = { { 1, 0, 0, 0 }, { 2, 1, 0, 0 }, { 3, 0, 0, 0 } }, b[] = { { 1, 0, 0, 0 }, { 2, 1, 0, 0 }, { 3.5, 0, 0, 0 } };
    fvi_event_agreement common;
    ck_assert_double_eq(apart(2, a, 2, b, &common), 0.25); /* of the places */
    ck_assert_double_eq(apart(3, a, 3, b, &common), 1);    /* of the times */
    ck_assert(common.agreed == 3 && common.until == 3 && !common.differ);
    ck_assert(isinf(apart(3, a, 2, b, &common)) && common.differ && common.agreed == 2 && common.until == 2);
    ck_assert(isinf(apart(2, a, 3, b, &common)) && common.differ && common.agreed == 2);
    b[1].event = 0;
    ck_assert(isinf(apart(3, a, 3, b, &common)) && common.agreed == 1 && common.until == 1);
    b[1].event = 1;
    b[1].at_rest = 1;
    ck_assert(isinf(apart(2, a, 2, b, &common)) && common.agreed == 1);
    fvi_event_time c[] = { { 2.001, 1, 0, 0 }, { 2, 0, 0, 0 } }, d[] = { { 2, 0, 0, 0 }, { 2.001, 1, 0, 0 } };
    ck_assert_double_eq(apart(2, c, 2, d, &common), 2); /* in another order: 4 is compared with 2 */
    a[2].t = 9.999; /* at the end one run may have it and the other not */
    b[1].at_rest = 0;
    ck_assert_double_eq(apart(3, a, 2, b, &common), 0.25);
    ck_assert_double_eq(apart(2, b, 3, a, &common), 0.25);
    ck_assert(!common.differ && common.agreed == 2);
    a[2].t = 9.99;
    ck_assert(isinf(apart(3, a, 2, b, &common)));
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("events_accuracy");
    ADD_CASE(suite, "right to an error", a_ball_bounces_and_comes_to_rest_as_it_should,
             a_damped_ball_bounces_as_it_should, events_stand_among_the_rows);
    ADD_CASE(suite, "lists", lists_of_events_are_compared);
    ADD_CASE(suite, "refused", events_of_a_chaotic_motion_are_refused, a_height_of_rest_is_checked);
    return run_suite(suite);
}
