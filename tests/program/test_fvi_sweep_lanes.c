/* tests/program/test_fvi_sweep_lanes.c -- The program build/fvi: runs of a sweep that take their steps together.
 * Run alone: make test-fvi_sweep_lanes */
#define _GNU_SOURCE
#include "program.h"

/* The bytes of one by one, which are then in `out`. */
static void same_table(const char *words)
{
    static const char *const ways[] = { "--lanes 8 --jobs 1", "--lanes 3 --jobs 2", "--jobs 1" };
    char line[600];
    snprintf(line, sizeof line, "sweep %s --lanes 1", words);
    const int code = fvi(line);
    char *want = strdup(out);
    for (size_t i = 0; i < LEN(ways); i++) {
        snprintf(line, sizeof line, "sweep %s %s", words, ways[i]);
        ck_assert_int_eq(fvi(line), code);
        ck_assert_msg(strcmp(out, want) == 0, "%s", line);
    }
    free(want);
}

/* The grid of a picture of basins, and a smaller one by the other methods. */
START_TEST(a_thousand_and_six_hundred_rows_are_those_of_single_runs)
{
    static const char *const methods[] = { "fvi-stable", "fvi", "fvi-bdf2", "fvi-lobatto3", "euler-implicit" };
    char line[400];
    for (size_t i = 0; i < LEN(methods); i++) {
        snprintf(line, sizeof line,
                 "--vary x0=-1.5:1.5:%d --vary A=0:0.4:%d --potential 'x^4/4 - x^2/2' --force 'A*cos(1.2*t)' %s "
                 "--method %s --h 0.05 --steps 60 --columns x,energy",
                 i ? 9 : 40, i ? 9 : 40, strcmp(methods[i], "euler-implicit") ? "--alpha 0.3" : "", methods[i]);
        same_table(line);
        ck_assert_uint_eq(count_rows(), i ? 81 : 1600);
    }
}
END_TEST

/* What can be varied, printed and reduced. */
START_TEST(every_table_is_that_of_single_runs)
{
    static const char *const tables[] = {
        "--vary x0=-1:1:5 --vary p0=-1:1:5 --potential duffing:-1,1 --force cosine:0.3,1.2 --columns t,x,p,energy,y",
        "--vary x0=-1:1:5 --vary v0=-1:1:5 --force step:0.3,2 --rows --every 7 --columns 't,v,F,x^2+v,y'",
        "--vary x0=-1:1:5 --force step:0.3,2 --reduce 'absmax(x),peak(x),rms(v),mean(F),last(energy),min(F*v)'",
        "--vary rho=0:1:5 --vary mass=0.5:2:5 --method fvi-stable --alpha 0.7",
        "--vary rho=0:1:5 --vary mass=0.5:2:5 --method fvi-lobatto3 --alpha 0.7",
        "--vary alpha=0:1:5 --vary x0=-1:1:9 --potential pendulum:3",
        "--vary k=1:3:5 --vary steps=50,100 --potential 'k*x^4/4 - x^2/2' --vary kappa=0.5,1",
        "--vary k=0:3:5 --potential 'k*x^4/4 + x^2/2 + min(x^2, k)' --vary h=0.01:0.1:3",
        "--vary A=0:3:5 --vary x0=1,2 --force 'A*sin(t) + step:1,2 + A*t/10 + file:f.tsv + cosine:1,2'",
        "--vary A=0.2:0.4:5 --damping zener:1,0.3,2 --force 'A*t/10'",
        "--vary A=0.2:0.4:5 --damping 'symbol:A*s/(1 + s)'",
        "--vary x0=-1:1:9 --derivative rl --alpha 0.7",
        "--vary x0=-1:1:9 --vary v0=1,2 --ground '0.3*sin(t)' --columns x,ag",
        "--vary x0=-1:1:9 --potential free --force 0.3 --part 2/3",
        "--vary x0=-1e200:1e200:9 --potential duffing:1,1",
        ("--vary x0=-1:1:5 --vary p0=-1:1:5 --force cosine:0.3,1.2 --alpha 0.3 --rows --every 9 --columns "
         "t,v,a,F,d1.force,d1.impulse,a+x"),
        "--vary x0=-1:1:5 --vary p0=-1:1:5 --alpha 0.8 --method fvi-stable --columns a,d1.force,d1.impulse",
        "--vary rho=0:1:9 --vary mass=1,2 --order 0.6 --method fvi-bdf2 --columns a,d1.force",
        "--vary x0=-1:1:9 --damping zener:1,0.3,2 --method fvi-lobatto3 --rows --columns a,d1.force",
        "--vary T=0.1:2:9:log --potential '(2*pi/T)^2*x^2/2' --ground '0.3*sin(t)' --reduce 'absmax(a+ag)' --v0 0 --x0 0",
        "--vary k=1,2,3 --potential 'k*x^4' --force 'k*sin(t)' --v0 0 --reduce 'absmax(a),rms(d1.force),peak(a+x)'",
        "--vary x0=-2:1:9 --potential 'x^3' --steps 500 --method fvi-stable",
    };
    ck_assert_int_eq(shell("printf '# t F\\n0 0\\n1 1\\n2 0.5\\n60 0\\n' > f.tsv"), 0);
    for (size_t i = 0; i < LEN(tables); i++)
        same_table(tables[i]);
}
END_TEST

/* With --lanes a line says how the runs were made; without it, or a terminal, there is none. */
START_TEST(a_line_says_how_the_runs_were_made)
{
    static const struct {
        const char *words, *line;
    } lines[] = {
        { "--vary x0=1:2:9 --lanes 8", "fvi: 9 runs: 8 in groups of up to 8 that take their steps together, the others one by one\n" },
        { "--vary x0=1:2:9 --lanes 3", "fvi: 9 runs: 9 in groups of up to 3 that take their steps together\n" },
        { "--vary x0=1:2:9 --lanes 1", "fvi: 9 runs: one by one\n" },
        { "--vary x0=1:2:9 --lanes 8 --jobs 3", "fvi: 9 runs: 8 in groups of up to 8 that take their steps together, the others one by one\n" },
        { "--vary alpha=0:1:5 --vary x0=1:2:8 --lanes 8", "fvi: 40 runs: 40 in groups of up to 8 that take their steps together\n" },
        { "--vary x0=1:2:8 --vary alpha=0:1:5 --lanes 8", "fvi: 40 runs: 40 in groups of up to 8 that take their steps together\n" },
        { "--vary x0=1:2:8 --method fvi-adaptive --lanes 8", "fvi: 8 runs: one by one: the method chooses its steps\n" },
        { "--vary x0=1:2:8 --error 1e-4 --lanes 8", "fvi: 8 runs: one by one: each has steps of its own\n" },
        { "--vary x0=1:2:8 --dimension 2 --lanes 8", "fvi: 8 runs: one by one: a run has more than one coordinate\n" },
        { "--vary x0=1:2:8 --columns a,work --lanes 8", "fvi: 8 runs: one by one: the columns have work\n" },
        { "--vary p0=-1:1:17 --columns a --lanes 8", "fvi: 17 runs: 16 in groups of up to 8 that take their steps together, the others one by one\n" },
        { "--vary x0=1:2:8 --damper '-x1 : viscous:0.3' --lanes 8", "fvi: 8 runs: one by one: a system has a Lagrangian, constraints or dampers between points\n" },
        { "--vary rho=0.1:1:5 --method fvi-lobatto3 --lanes 8", "fvi: 5 runs: one by one: with stages the masses and the dampings must be the same\n" },
        { "--vary rho=0.1:1:5 --vary x0=1:2:3 --method fvi-lobatto3 --lanes 8", "fvi: 15 runs: 15 in groups of up to 8 that take their steps together\n" },
        { "--vary alpha=0:1:5 --lanes 8", "fvi: 5 runs: one by one: the memories differ\n" },
        { "--vary A=1:2:5 --damping 'symbol:A*s/(1 + s)' --lanes 8", "fvi: 5 runs: one by one: the memories differ\n" },
        { "--vary h=0.1,0.2 --lanes 8", "fvi: 2 runs: one by one: the steps differ\n" },
        { "--vary x0=0,1 --columns a --lanes 8", "fvi: 2 runs: one by one: a start or a damping is 0, and the columns have forces\n" },
        { "--vary x0=1:2:8 --force impulse:1,1 --lanes 8", "fvi: 8 runs: one by one: there are events or impulses\n" },
        { "--vary x0=1 --lanes 8", "fvi: 1 run: one by one\n" },
        { "--vary x0=1:2:9", "" },
    };
    char line[300];
    for (size_t i = 0; i < LEN(lines); i++) {
        snprintf(line, sizeof line, "sweep --steps 20 %s", lines[i].words);
        ck_assert_int_eq(fvi(line), 0);
        ck_assert_str_eq(err, lines[i].line);
    }
    ck_assert_refused("sweep --vary x0=1:2:8 --lanes 9", "fvi: --lanes: '9' is outside [1, 8]");
    ck_assert_refused("sweep --vary x0=1:2:8 --lanes", "fvi: --lanes: a value is missing");
    ck_assert_refused("sweep --vary x0=1:2:8 --lanes 2 --lanes 3", "fvi: --lanes: given twice, as '2' and as '3'");
}
END_TEST

/* A run that fails is named as by itself, whichever its neighbours are. */
START_TEST(a_run_that_fails_is_named_as_by_itself)
{
    ck_assert_int_eq(fvi("sweep --vary c=1,2,1e300,3 --potential 'c*x^4' --x0 1e3 --steps 20 --lanes 1"), 1);
    char *text = strdup(strchr(err, '\n') + 1);
    ck_assert_ptr_nonnull(strstr(text, "fvi: with c = 1e+300: "));
    ck_assert_int_eq(fvi("sweep --vary c=1,2,1e300,3 --potential 'c*x^4' --x0 1e3 --steps 20 --lanes 4"), 1);
    ck_assert_str_eq(strchr(err, '\n') + 1, text);
    free(text);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("sweeps together");
    ADD_CASE(suite, "tables", a_thousand_and_six_hundred_rows_are_those_of_single_runs,
             every_table_is_that_of_single_runs);
    ADD_CASE(suite, "words", a_line_says_how_the_runs_were_made, a_run_that_fails_is_named_as_by_itself);
    return run_suite_of_program(suite);
}
