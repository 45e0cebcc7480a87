/* tests/program/test_fvi_events.c -- The program build/fvi: --event.
 * Run alone: make test-fvi_events */
#define _GNU_SOURCE
#include <fvi/fvi.h>
#include "program.h"

#define BALL "run --potential x --p0 0 --rho 0.3 --alpha 0.3 --time 5 --steps 5 "
#define FLOOR "--event 'x : impact:0.8' "

/* By superposition of Mittag-Leffler functions (verify/events/events.py). */
START_TEST(a_bouncing_ball_is_a_command)
{
    ck_assert_msg(fvi(BALL FLOOR) == 0, "%s", err);
    ck_assert_ptr_nonnull(strstr(out, "# method = fvi-adaptive\n"));
    ck_assert_ptr_nonnull(strstr(out, "# event = x : impact:0.8\n"));
    ck_assert_near(cell(5, 1), 0.0748348695586245, 1e-13, "x(5)");
    const char *line = strstr(out, "\n# event at t = ");
    for (int i = 0; i < 2; i++) {
        static const double want[] = { 1.488362842713238, 3.559706909650378 };
        char *end;
        ck_assert_ptr_nonnull(line);
        ck_assert_near(strtod(line + 16, &end), want[i], 1e-13, "impact %d", i);
        ck_assert_msg(strncmp(end, " : x\n", 5) == 0, "%s", end);
        line = end + 4;
    }
    ck_assert_str_eq(line, "\n"); /* nothing behind them */
}
END_TEST

/* With contact:E the run goes on behind rest, and a plain potential, masses and --alpha do. The force is 1 - 2 sin t, and the
 * lines say what happens; a lift-off does not count. */
START_TEST(a_body_rests_and_lifts_off)
{
#define TABLE "run --potential x --x0 0 --p0 0 --alpha 0.3 --rho 0.2 --force '2*sin(t)' --event 'x : contact:0.5' --time 1.5 --steps 3 "
    ck_assert_msg(fvi(TABLE "--columns t,x,event1.force,event1.count,balance") == 0, "%s", err);
    for (size_t row = 0; row < 2; row++) {
        ck_assert_near(cell(row, 1), 0, 1e-15, "x");
        ck_assert_near(cell(row, 2), 1 - 2 * sin((double)row / 2), 1e-9, "force");
    }
    ck_assert_double_eq(cell(3, 2), 0);
    ck_assert_double_eq(cell(3, 3), 1);
    ck_assert_near(cell(3, 4), 0, 1e-12, "balance");
    ck_assert_ptr_nonnull(strstr(out, "\n# event at t = 0 : x : at rest\n# event at t = 0.52359877"));
    ck_assert_str_eq(strrchr(out, 'x'), "x : lifts off\n");
    ck_assert_int_eq(fvi(TABLE "--format json"), 0);
    ck_assert_ptr_nonnull(strstr(out, "\"event\": \"x\", \"at rest\": true},\n"));
    ck_assert_ptr_nonnull(strstr(out, "\"event\": \"x\", \"lifts off\": true}\n]}\n"));
    ck_assert_int_eq(fvi(TABLE "--event 'x : contact'"), 2);
    ck_assert_ptr_nonnull(strstr(err, "'contact' is not contact:E"));
    ck_assert_int_eq(fvi(TABLE "--event 'x+v : contact:0'"), 2);
    ck_assert_int_eq(fvi(TABLE "--event '1-2 : stop'"), 2);
    ck_assert_ptr_nonnull(strstr(err, "--event: '1-2' is a constant, which never passes 0"));
    ck_assert_int_eq(fvi(TABLE "--event 't-9 : stop'"), 0);
    ck_assert_int_eq(fvi(TABLE "--reduce 'max(event1.force)'"), 0);
    ck_assert_near(cell(0, 0), 1, 1e-9, "largest force");
#undef TABLE
}
END_TEST

START_TEST(formats_have_a_place_for_events)
{
    ck_assert_int_eq(fvi(BALL FLOOR "--format json"), 0);
    ck_assert_ptr_nonnull(strstr(out, "]\n],\n\"events\": [\n {\"t\": 1.488362842713238, "
                                      "\"event\": \"x\"},\n {\"t\": 3.5597069096503"));
    ck_assert_ptr_nonnull(strstr(out, "\"event\": \"x\"}\n]}\n"));
    ck_assert_int_eq(fvi(BALL "--event 'x+9 : mark' --format json"), 0);
    ck_assert_ptr_nonnull(strstr(out, "],\n\"events\": [\n]}\n"));
    ck_assert_int_eq(fvi(BALL FLOOR "--format csv"), 0);
    ck_assert_ptr_null(strchr(out, '#'));
    ck_assert_ptr_nonnull(strstr(err, "fvi: event at t = 1.488362842713238 : x\n"));
    ck_assert_int_eq(fvi(BALL "--event '0\n+x : impact:0.8'"), 0);
    ck_assert_ptr_nonnull(strstr(out, "\n# event at t = 1.488362842713238 : 0 +x\n"));
}
END_TEST

/* sqrt(2) (1 + 1 + 1/2 + ...) is below 4 sqrt(2) - 1.4: row 4 is the last, of 20. A stop by a name of
 * --let, and one by p; a reduction over the motion until then. */
START_TEST(runs_end_at_events)
{
    ck_assert_int_eq(fvi("run --potential x --p0 0 --rho 0 --time 20 --steps 20 --event 'x : impact:0.5'"), 0);
    ck_assert_ptr_nonnull(strstr(out, "\n4\t"));
    ck_assert_ptr_null(strstr(out, "\n5\t"));
    const char *rest = strstr(out, " : x : at rest\n");
    ck_assert(rest && strcmp(rest, " : x : at rest\n") == 0);
    ck_assert_int_eq(fvi("run --potential x --p0 0 --rho 0 --time 5 --event 'x-c : stop' --let c=0.5 "
                         "--event 'p+0.5 : mark' --reduce 'min(x),last(t)'"), 0);
    ck_assert_near(cell(0, 0), 0.5, 1e-12, "min(x)");
    ck_assert_near(cell(0, 1), 1, 1e-12, "x = 1 - t^2/2");
    ck_assert_ptr_nonnull(strstr(out, " : p+0.5\n"));
    ck_assert_ptr_nonnull(strstr(out, " : x-c\n"));
}
END_TEST

/* Many coordinates: their own room. */
START_TEST(coordinates_have_numbers)
{
    ck_assert_int_eq(fvi("run --dimension 20 --event 'v20+0*x20+0*p1+0*t : mark' --event 'x20-t/9 : impact:1' --time 2 "
                         "--unknowns 20 --columns x"), 0);
    ck_assert_ptr_nonnull(strstr(out, " : v20+0*x20+0*p1+0*t\n"));
    ck_assert_ptr_nonnull(strstr(out, " : x20-t/9\n"));
}
END_TEST

/* A Lagrangian, a damper and a wall that moves: the method is fvi-adaptive, v is that of L_v = p, forces and the
 * balance are known, and the motion is that of a mass and a potential. */
START_TEST(a_lagrangian_has_events)
{
#define WORDS " --damper 'x : power:0.3,0.3' --x0 1 --time 5 --steps 5 --event 'x-0.1*sin(t) : impact:0.8' --event '2*v-p-1e-3 : mark' " \
              "--event 'v : mark' --columns t,x,p,d1.force,balance | grep -v '^# [a-z0-9]* ='"
    ck_assert_int_eq(fvi("run --mass 2 --potential 2*x --p0 0" WORDS), 0);
    ck_assert_ptr_nonnull(strstr(out, " : v\n"));
    ck_assert_ptr_null(strstr(out, " : 2*v-p-1e-3\n"));
    ck_assert_ptr_nonnull(strstr(out, " : x-0.1*sin(t)\n"));
    const char *last = strstr(out, "\n5\t");
    ck_assert_ptr_nonnull(last);
    const double x = strtod(last + 3, NULL);
    ck_assert_int_eq(fvi("run --lagrangian 'v^2-2*x' --v0 0" WORDS), 0);
    ck_assert_ptr_nonnull(last = strstr(out, "\n5\t"));
    ck_assert_double_eq_tol(strtod(last + 3, NULL), x, 1e-12);
}
END_TEST

/* The time of a first passing for each run: a stop, and the column t. A ball that falls from h with the weight g,
 * free, has t = sqrt(2 h / g), and the impacts of another lose no row. */
START_TEST(a_sweep_has_events)
{
    ck_assert_int_eq(fvi("sweep --lagrangian 'v^2/2-g*x' --x0 2 --v0 0 --event 'x : stop' --vary g=1,4 --time 5 --steps 5 "
                         "--columns t,x,v | grep -v '^#'"), 0);
    double g, t, x, v;
    const char *row = out;
    for (int i = 0; i < 2; i++) {
        ck_assert_int_eq(sscanf(row, "%lf %lf %lf %lf", &g, &t, &x, &v), 4);
        ck_assert_double_eq_tol(t, sqrt(4 / g), 1e-12);
        ck_assert_double_eq_tol(x, 0, 1e-12);
        ck_assert_double_eq_tol(v, -sqrt(4 * g), 1e-11);
        row = strchr(row, '\n') + 1;
    }
    ck_assert_int_eq(fvi("sweep --potential x --rho 0 --x0 1 --p0 0 --event 'x : impact:1' --vary mass=1,4 --time 5 --steps 5 "
                         "--columns t,energy | grep -v '^#'"), 0);
    ck_assert_int_eq(sscanf(out, "%lf %lf %lf", &g, &t, &x), 3);
    ck_assert_double_eq(t, 5);
    ck_assert_double_eq_tol(x, 1, 1e-9);
}
END_TEST

/* All rows of runs that an event ends: up to it, and the row there; none twice where a row is there already. A
 * ball that falls from 2 with the weight g is at 0 at sqrt(4 / g). */
START_TEST(a_sweep_of_rows_has_events)
{
    ck_assert_int_eq(fvi("sweep --lagrangian 'v^2/2-g*x' --x0 2 --v0 0 --event 'x : stop' --event 'x-1 : mark' --vary g=1,4,0.1 "
                         "--time 4 --steps 8 --rows --every 2 --columns t,x,event1.count,event1.last,event2.count | grep -v '^#'"), 0);
    static const double g[] = { 1, 4, 0.1 }, rows[3][5] = { { 0, 1, 2 }, { 0, 1 }, { 0, 1, 2, 3, 4 } };
    static const size_t count[] = { 3, 2, 5 };
    const char *row = out;
    for (size_t i = 0; i < 3; i++)
        for (size_t k = 0; k < count[i]; k++) {
            double is_g, t, x, stops, last, marks;
            ck_assert_int_eq(sscanf(row, "%lf %lf %lf %lf %lf %lf", &is_g, &t, &x, &stops, &last, &marks), 6);
            ck_assert_double_eq_tol(is_g, g[i], 1e-15);
            ck_assert_double_eq_tol(t, rows[i][k], 1e-12);
            ck_assert_double_eq_tol(x, 2 - g[i] * t * t / 2, 1e-12);
            const int is_over = i < 2 && k + 1 == count[i];
            ck_assert_double_eq(stops, is_over);
            ck_assert_double_eq_tol(last, is_over ? sqrt(4 / g[i]) : 0, 1e-12);
            ck_assert_double_eq(marks, i < 2 && t > sqrt(2 / g[i]));
            row = strchr(row, '\n') + 1;
        }
    ck_assert_int_eq(*row, '\0');
    ck_assert_int_eq(fvi("sweep --lagrangian 'v^2/2-g*x' --x0 2 --v0 0 --event 'x : stop' --vary g=1.1,4.1 "
                         "--time 4 --steps 4 --rows --columns t,x --format json"), 0);
    ck_assert_int_eq(fvi("sweep --lagrangian 'v^2/2-g*x' --x0 2 --v0 0 --event 'x : stop' --vary g=1.1,4.1 "
                         "--time 4 --steps 4 --rows --every 3 --columns t | grep -v '^#'"), 0);
    const double ends[] = { 0, sqrt(4 / 1.1), 0, sqrt(4 / 4.1) };
    row = out;
    for (size_t k = 0; k < 4; k++) {
        double is_g, t;
        ck_assert_int_eq(sscanf(row, "%lf %lf", &is_g, &t), 2);
        ck_assert_double_eq_tol(t, ends[k], 1e-12);
        row = strchr(row, '\n') + 1;
    }
    ck_assert_int_eq(*row, '\0');
}
END_TEST

/* With a wanted error: the rows, the events and the columns are those of a run with fine steps, to that error;
 * a run that an event ends has the rows before it, and a sweep the row there. The largest speed is sqrt(2). */
START_TEST(an_error_may_be_asked_for_with_events)
{
    ck_assert_msg(fvi(BALL FLOOR "--error 1e-9 --columns t,x,event1.count | grep -v '^# [a-z0-9]* ='") == 0, "%s", err);
    ck_assert_near(cell(5, 1), 0.0748348695586245, 1e-9, "x(5)");
    ck_assert_double_eq(cell(5, 2), 2);
    const char *line = strstr(out, "\n# event at t = ");
    ck_assert_ptr_nonnull(line);
    ck_assert_near(strtod(line + 16, NULL), 1.488362842713238, 1e-9, "the first impact");
    ck_assert_ptr_nonnull(strstr(line + 16, "\n# event at t = 3.55970690"));
    ck_assert_int_eq(fvi("run --potential x --p0 0 --rho 0 --time 20 --steps 20 --event 'x : impact:0.5' --error 1e-6 "
                         "--reduce 'last(t),min(x),last(event1.count)'"), 0);
    ck_assert_near(cell(0, 0), 4.237116415391265, 1e-6, "at rest"); /* sqrt(2) (3 - 2^-8) */
    ck_assert_double_eq(cell(0, 2), 10);
    ck_assert_ptr_nonnull(strstr(out, " : x : at rest\n"));
    ck_assert_int_eq(fvi("sweep --lagrangian 'v^2/2-g*x' --x0 2 --v0 0 --event 'x : stop' --vary g=1,4 --time 4 --steps 4 "
                         "--error 1e-8 --columns t,x,v,event1.count --rows | grep -v '^#'"), 0);
    static const double rows[2][4] = { { 0, 1, 2 }, { 0, 1 } };
    const char *row = out;
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 3 - i; k++) {
            double g, t, x, v, n;
            ck_assert_int_eq(sscanf(row, "%lf %lf %lf %lf %lf", &g, &t, &x, &v, &n), 5);
            ck_assert_double_eq_tol(t, rows[i][k], 1e-8);
            ck_assert_double_eq_tol(x, 2 - g * rows[i][k] * rows[i][k] / 2, 1e-7);
            ck_assert_double_eq_tol(v, -g * rows[i][k], 1e-7);
            ck_assert_double_eq(n, k == 2 - i);
            row = strchr(row, '\n') + 1;
        }
    ck_assert_int_eq(*row, '\0');
    ck_assert_int_eq(fvi("run --potential x --p0 0 --rho 0 --event 'x-0.3*sin(3*t) : impact:1' --error 1e-6 --time 400"), 1);
    ck_assert_str_eq(out, "");
    ck_assert_ptr_nonnull(strstr(err, "fvi: --error: 1e-06 is out of reach: no two runs have the same events; they agree on "));
}
END_TEST

/* How often, and when the last time: of rows between steps, in expressions, and reduced. The ball's impacts are at
 * 1.488 and 3.560. */
START_TEST(events_are_columns)
{
    ck_assert_int_eq(fvi("run --event 'x : impact:0.8' --event 'v : mark' --potential x --p0 0 --alpha 0.3 --rho 0.3 --time 5 "
                         "--steps 10 --columns 't,n=event1.count,event1.last,2*event2.count' | grep -v '^#'"), 0);
    for (size_t k = 0; k <= 10; k++) {
        const double t = (double)k / 2;
        ck_assert_double_eq(cell(k, 1), (t > 1.4883) + (t > 3.5597));
        ck_assert_double_eq_tol(cell(k, 2), t > 3.5597 ? 3.559706909650385 : t > 1.4883 ? 1.488362842713238 : 0, 1e-12);
        ck_assert_double_eq(cell(k, 3), 2 * ((t > 2.45) + (t > 4.3)));
    }
    ck_assert_int_eq(fvi("run --event 'x : impact:0.8' --potential x --p0 0 --alpha 0.3 --rho 0.3 --time 5 --steps 10 "
                         "--reduce 'last(event1.count),at(max(event1.count))' | grep -v '^#'"), 0);
    ck_assert_double_eq(cell(0, 0), 2);
    ck_assert_double_eq_tol(cell(0, 1), 3.559706909650385, 1e-12);
}
END_TEST

START_TEST(what_is_wrong_is_said)
{
    static const char *const cases[][2] = {
        { "run --event x", "fvi: --event: 'x' is not 'Z : WHAT', with blanks around" },
        { "run --event 'x:mark'", "fvi: --event: 'x:mark' is not 'Z : WHAT'" },
        { "run --event 'x : bounce'", "'bounce' is none of impact:E, contact:E, stop, mark" },
        { "run --event 'x : imapct:1'", "did you mean impact?" },
        { "run --event 'x : impact'", "fvi: --event: 'impact' is not impact:E" },
        { "run --event 'x : impact:1.5'", "fvi: --event: '1.5' is outside [0, 1]" },
        { "run --event 'x : stop:3'", "fvi: --event: 'stop:3' is not stop" },
        { "run --event 'y : mark'", "fvi: --event: 'y': no such name\n               ^" },
        { "run --event 'x2 : mark' --dimension 1", "fvi: --event: 'x2': there is no x2; the coordinates are x alone\n" },
        { "run --event 'x2 : mark'", "fvi: --event: 'x2': there is no x2; the coordinates are x alone\n" },
        { "run --event '2*x1+p4_-v3 : stop' --potential 'x1^2+x2^2'", "there is no v3; the coordinates are x1 ... x2\n" },
        { "run --event 'x1-x3 : impact:1' --dimension 2", "'x1-x3': there is no x3; the coordinates are x1 ... x2\n" },
        { "run --event 'v : impact:1'", "Z of an impact is an expression in x and t alone" },
        { "run --event ' : mark'", "fvi: --event: ''" },
        { "run --event 'x : mark' --method fvi", "is not for fvi; fvi-adaptive has events" },
        { "run --event 'x : mark' --error 1e-3 --method fvi-bdf2", "is not for fvi-bdf2; fvi-adaptive has events" },
        { "run --event 'x : mark' --checkpoint f", "fvi: --event: not together with --checkpoint" },
        { "run --event 't-1 : impact:1'", "fvi: --event: 't-1': Z of an impact without x has no normal" },
        { "run --event '0.5 : impact:1'", "fvi: --event: '0.5': Z of an impact without x has no normal" },
        { "run --event 'k*t-1 : impact:1' --let k=2", "'k*t-1': Z of an impact without x" },
        { "run --event 'v : impact:1' --lagrangian 'v^2/2' --x0 1 --v0 0",
          "Z of an impact is an expression in x and t alone" },
        { "run --event 'x : mark' --lagrangian 'v^2/2' --x0 1 --v0 0 --method fvi-lobatto4d",
          "is not for fvi-lobatto4d; fvi-adaptive has events" },
        { "run --event 'x : mark' --columns t,y", "fvi: --event: column y needs every row" },
        { "run --event 'x : mark' --columns d1.force", "are not known with --event" },
        { "run --event 'x : mark' --columns balance", "are not known with --event" },
        { "run --event 'x : mark' --columns event2.count", "event1.count, event1.last, event1.force, d1.force, nor an expression" },
        { "run --event 'x : mark' --columns event1.cont", "did you mean event1.count?" },
        { "run --columns event1.count", "'event1.count' is none of t, x" },
        { "run --potential x --x0 0 --p0 -1 --event 'x+0 : impact:0.5'",
          "fvi: --event: 'x+0': starts at Z = 0 and moves into the wall" },
        { "gradient --event 'x : mark'", "fvi: --event: not an option of this command: no derivative goes through an event" },
        { "fit --event 'x : mark' d.tsv", "fvi: --event: not an option of this command: a fit follows derivatives, and none" },
        { "fit --design --event 'x : mark'", "a fit follows derivatives, and none goes through an event" },
        { "exact --event 'x : mark'", "not an option of this command" },
    };
    for (size_t i = 0; i < LEN(cases); i++) {
        ck_assert_msg(fvi(cases[i][0]) == 2, "%s: %s", cases[i][0], err);
        ck_assert_msg(strstr(err, cases[i][1]), "%s: %s", cases[i][0], err);
        ck_assert_str_eq(out, "");
    }
    ck_assert_int_eq(fvi("sweep --x0 0 --p0 -1 --event 'x : impact:1' --vary rho=0,1 -o none"), 1);
    ck_assert_str_eq(err, "fvi: with rho = 0: --event: 'x': starts at Z = 0 and moves into the wall\n");
    ck_assert_int_eq(fvi("run --event 't-1 : mark' --event 'x-sin(t) : impact:1' --steps 3"), 0);
    ck_assert_int_eq(fvi("run --event 'log(x-0.5) : mark'"), 1); /* NaN below */
    ck_assert_ptr_nonnull(strstr(err, "fvi: step "));
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("fvi_events");
    ADD_CASE(suite, "events", a_bouncing_ball_is_a_command, a_body_rests_and_lifts_off, a_lagrangian_has_events, a_sweep_has_events, formats_have_a_place_for_events,
             runs_end_at_events, coordinates_have_numbers, a_sweep_of_rows_has_events, events_are_columns, an_error_may_be_asked_for_with_events);
    ADD_CASE(suite, "words", what_is_wrong_is_said);
    return run_suite_of_program(suite);
}
