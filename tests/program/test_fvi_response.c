/* tests/program/test_fvi_response.c -- The commands fvi response and fvi poles.
 *                                         Run alone: make test-fvi_response */
#define _GNU_SOURCE
#include "folder.h"
#include "program.h"

#include <math.h>

/* The rows of out, behind its head; `width` numbers each. Returns how many. */
static size_t rows_of_table(size_t width, size_t most, double *v)
{
    size_t n = 0;
    for (char *line = out; *line; line = strchr(line, '\n') + 1) {
        if (*line == '#')
            continue;
        char *at = line;
        ck_assert_uint_lt(n, most);
        for (size_t i = 0; i < width; i++)
            v[n * width + i] = strtod(at, &at);
        ck_assert_int_eq(*at, '\n');
        n++;
    }
    return n;
}

/* Five storeys, K = 100 and C = 5 between some; the poles of the contract. */
static void building(void)
{
    const char *head = "%%MatrixMarket matrix coordinate real symmetric";
    char line[1500];
    snprintf(line, sizeof line,
             "rm -rf bld; mkdir -p bld; { echo '%s'; echo 5 5 5; for i in 1 2 3 4 5; do echo $i $i 1; "
             "done; } > bld/M.mtx; { echo '%s'; echo 5 5 9; for i in 1 2 3 4; do echo $i $i "
             "200; echo $((i+1)) $i -100; done; echo 5 5 100; } > bld/K.mtx; { echo '%s'; echo "
             "5 5 4; echo 1 1 5; echo 2 2 5; echo 3 3 5; echo 3 2 -5; } > bld/C.mtx",
             head, head, head);
    ck_assert_int_eq(shell(line), 0);
}

/* A prototype in another language printed these; last digits are its own. */
START_TEST(responses_are_those_of_the_contract)
{
    static const double want[3][5] = {
        { 0.5, 1.1885957530383924, -0.153322182630622, 1.198443805869729, -0.12828597836245137 },
        { 1, 2.938926261462365, -4.045084971874736, 4.999999999999999, -0.9424777960769378 },
        { 2, -0.3517248264027026, -0.03056890217005149, 0.35305072055994086, -3.054899083832134 }
    };
    double v[15];
    ck_assert_int_eq(fvi("response --alpha 0.3 --omega 0.5,1,2"), 0);
    ck_assert_ptr_nonnull(strstr(out, "\n# alpha = 0.3\n# rho = 0.2\n# mass = 1\n"
                                      "# potential = harmonic:1\n# of = receptance\n"
                                      "# at = 1\n# by = 1\n"
                                      "# omega\tre\tim\tabs\tphase\n0.5\t"));
    ck_assert_uint_eq(rows_of_table(5, 3, v), 3);
    for (size_t i = 0; i < 15; i++)
        ck_assert_near(v[i], want[i / 5][i % 5], 1e-12 * fabs(want[i / 5][i % 5]), "%zu", i);
    /* velocity and acceleration are i omega and -omega^2 times the place */
    double w[5];
    ck_assert_int_eq(fvi("response --alpha 0.3 --omega 2 --of mobility"), 0);
    ck_assert_uint_eq(rows_of_table(5, 1, w), 1);
    ck_assert_near(w[1], -2 * v[12], 1e-15, "mobility");
    ck_assert_int_eq(fvi("response --alpha 0.3 --omega 2 --of accelerance"), 0);
    ck_assert_uint_eq(rows_of_table(5, 1, w), 1);
    ck_assert_near(w[1], -4 * v[11], 1e-15, "accelerance");
    ck_assert_int_eq(fvi("response --alpha 0.3 --omega 2 --of ground"), 0);
    ck_assert_ptr_null(strstr(out, "# by"));
    ck_assert_uint_eq(rows_of_table(5, 1, w), 1);
    ck_assert_near(w[1], 1 + 4 * v[11], 1e-15, "ground");
}
END_TEST

START_TEST(moduli_are_those_of_the_contract)
{
    static const double want[3][3] = { { 0.01, 0.20826612885522217, 0.17181802225520681 },
                                       { 1, 1.2327174549361564, 0.394934617165994 },
                                       { 100, 1.906100470715174, 0.08580934651058353 } };
    double v[9], w[3];
    ck_assert_int_eq(fvi("response --of moduli --damping zener:3,0.25,1.5 --omega "
                         "0.01:100:3:log"), 0);
    ck_assert_ptr_nonnull(strstr(out, "\n# damping = zener:3,0.25,1.5\n# of = moduli\n"
                                      "# omega\tstorage\tloss\n0.01\t"));
    ck_assert_uint_eq(rows_of_table(3, 3, v), 3);
    for (size_t i = 0; i < 9; i++)
        ck_assert_near(v[i], want[i / 3][i % 3], 1e-12 * want[i / 3][i % 3], "%zu", i);
    ck_assert_int_eq(fvi("response --of moduli --alpha 0.25 --rho 3 --hertz --omega 2"), 0);
    ck_assert_ptr_nonnull(strstr(out, "\n# f\tstorage\tloss\n2\t"));
    ck_assert_uint_eq(rows_of_table(3, 1, w), 1);
    ck_assert_near(w[1], 3 * sqrt(2 * M_PI), 1e-14, "storage of sqrt(i omega)");
}
END_TEST

START_TEST(poles_are_those_of_the_contract)
{
    static const double want[5][4] = {
        { -0.057983384402680194, 2.891351334005471, 0.46026538066714295, 0.020050046413457843 },
        { -0.20396587711964204, 8.494842062183443, 1.3523857662876013, 0.024003637405010714 },
        { -0.632100396735179, 13.5626493384333, 2.1609057364903324, 0.046555433201887826 },
        { -0.2051120343577102, 17.002151336341463, 2.706173331560617, 0.012063009333122987 },
        { -0.9873861308474805, 19.812197881020637, 3.1571226971440542, 0.04977550717522434 }
    };
    double v[25], w[2][15];
    building();
    ck_assert_int_eq(fvi("poles --system bld --alpha 0.3"), 0);
    ck_assert_str_eq(err, "");
    ck_assert_ptr_nonnull(strstr(out, "\n# alpha = 0.3\n# system = bld\n# poles = 5 of 5\n"
                                      "# re\tim\tfrequency\tdamping\tresidual\n"));
    ck_assert_uint_eq(rows_of_table(5, 5, v), 5);
    for (size_t k = 0; k < 5; k++) {
        for (size_t i = 0; i < 4; i++)
            ck_assert_near(v[5 * k + i], want[k][i], 1e-12 * fabs(want[k][i]), "%zu %zu", k, i);
        ck_assert(v[5 * k + 4] < 1e-15);
    }
    ck_assert_int_eq(fvi("response --system bld --alpha 0.3 --at 5 --by 5 --omega 7.3"), 0);
    double h[5];
    ck_assert_uint_eq(rows_of_table(5, 1, h), 1);
    ck_assert_near(h[1], 0.0105922000152764, 1e-14, "re");
    ck_assert_near(h[2], -0.002537954736649039, 1e-14, "im");
    ck_assert_int_eq(fvi("poles --system bld --alpha 0.3 --count 1 --shapes"), 0);
    ck_assert_str_eq(err, "fvi: warning: these are 1 of 5 poles\n");
    ck_assert_ptr_nonnull(strstr(out, "residual\tre1\tim1\tre2\tim2\t"));
    ck_assert_uint_eq(rows_of_table(15, 1, w[0]), 1);
    ck_assert_near(w[0][0], want[0][0], 1e-12, "the lowest");
    ck_assert(hypot(w[0][13], w[0][14]) > hypot(w[0][5], w[0][6])); /* the roof moves most */
}
END_TEST

/* An overdamped mode has no pole that swings: the count says 0 of 0 (alpha = 1/2). */
START_TEST(what_does_not_swing_has_no_poles)
{
    ck_assert_int_eq(fvi("poles --rho 3"), 0);
    ck_assert_ptr_nonnull(strstr(out, "# poles = 0 of 0\n"));
    ck_assert_str_eq(err, "fvi: warning: what creeps or grows, e^{st} with a real s or with Re s > 0, "
                          "is no row\n");
    ck_assert_int_eq(fvi("response --rho 0 --omega 0.5,1"), 1);
    ck_assert_str_eq(err, "fvi: --omega: at omega = 1 the response is infinite: a mode without "
                          "damping\n");
}
END_TEST

/* s^2 - s/2 + 1 = 0 has the poles (1 +- i sqrt(15))/4: a swing that grows. It is no row, nor counted, alone or beside
 * another body with s^2 + 4 = 0, and the warning does not say that nothing swings. */
START_TEST(a_growing_swing_is_no_row)
{
    static const char *const asked[] = {
        "poles --damping symbol:-0.5*s",
        "poles --potential 'x1^2/2+2*x2^2' --damper 'x1 : symbol:-0.5*s'"
    };
    for (size_t i = 0; i < 2; i++) {
        double v[5];
        ck_assert_int_eq(fvi(asked[i]), 0);
        ck_assert_str_eq(err, "fvi: warning: what creeps or grows, e^{st} with a real s or with Re s > 0, "
                              "is no row\n");
        ck_assert_ptr_nonnull(strstr(out, i ? "# poles = 1 of 1\n" : "# poles = 0 of 0\n"));
        ck_assert_uint_eq(rows_of_table(5, i, v), i);
    }
    double v[5];
    ck_assert_uint_eq(rows_of_table(5, 1, v), 1);
    ck_assert_near(v[1], 2, 1e-14, "the other body");
}
END_TEST

/* A damper between two masses, and one that is curved: at (3, 4) a strut acts along (0.6, 0.8). */
START_TEST(dampers_act_between_points)
{
    double v[5], w[5];
    ck_assert_int_eq(fvi("response --potential 'x1^2/2+x2^2' --rho 0.5,0 --alpha 0.3 --omega 2 "
                         "--by 1 --at 1"), 0);
    ck_assert_uint_eq(rows_of_table(5, 1, v), 1);
    ck_assert_int_eq(fvi("response --potential 'x1^2/2+x2^2' --damper 'x1 : power:0.5,0.3' "
                         "--omega 2"), 0);
    ck_assert_ptr_nonnull(strstr(out, "# damper = x1 : power:0.5,0.3\n"));
    ck_assert_uint_eq(rows_of_table(5, 1, w), 1);
    for (size_t i = 1; i < 5; i++)
        ck_assert_near(w[i], v[i], 1e-15, "%zu", i);
    /* Z = diag(-1 + 4, -1 + 4) + 9 (0.6, 0.8) (0.6, 0.8)^T, a spring of 9 along the strut */
    ck_assert_int_eq(fvi("response --potential '2*(x1-3)^2+2*(x2-4)^2' --x0 3,4 --damper "
                         "'sqrt(x1^2+x2^2) : spring:9' --omega 1"), 0);
    ck_assert_uint_eq(rows_of_table(5, 1, w), 1);
    ck_assert_near(w[1], 0.36 / 12 + 0.64 / 3, 1e-15, "along and across");
    ck_assert_int_eq(fvi("poles --potential 'x1^2/2+(x2-x1)^2/2' --damper 'x2-x1 : "
                         "zener:1,0.3,1'"), 0);
    ck_assert_ptr_nonnull(strstr(out, "# poles = 2 of 2\n"));
    ck_assert_int_eq(fvi("response --of ground --potential 'x1^2/2+x2^2' --rho 0 --along 0,3 "
                         "--at 2 --omega 0.5"), 0);
    ck_assert_ptr_nonnull(strstr(out, "# at = 2\n# along = 0,3\n# omega"));
    ck_assert_uint_eq(rows_of_table(5, 1, w), 1);
    ck_assert_near(w[1], 3 / 0.875, 1e-14, "3 / (1 - omega^2 / 2)");
    building(); /* its C.mtx as the matrix of a damper */
    ck_assert_int_eq(fvi("poles --system bld --alpha 0.3 --count 1"), 0);
    ck_assert_uint_eq(rows_of_table(5, 1, v), 1);
    ck_assert_int_eq(shell("mv bld/C.mtx bld/C2.mtx"), 0);
    ck_assert_int_eq(fvi("poles --system bld --damper 'C2.mtx : power:1,0.3' --count 1"), 0);
    ck_assert_uint_eq(rows_of_table(5, 1, w), 1);
    ck_assert_near(w[0], v[0], 1e-14, "re");
}
END_TEST

/* A pendulum that stands is no oscillator, and at 1 it is no equilibrium. */
START_TEST(a_potential_is_linear_at_x0)
{
    double v[5];
    ck_assert_int_eq(fvi("poles --potential pendulum:4 --rho 0"), 0);
    ck_assert_ptr_nonnull(strstr(out, "# linear at x0 = 0\n"));
    ck_assert_uint_eq(rows_of_table(5, 1, v), 1);
    ck_assert_near(v[1], 2, 1e-15, "omega");
    ck_assert_int_eq(fvi("poles --potential pendulum:4 --rho 0 --x0 1"), 0);
    ck_assert_str_eq(err, "fvi: warning: the potential has a slope at x0: this is no "
                          "equilibrium\n");
    ck_assert_ptr_nonnull(strstr(out, "# warning = the potential has a slope"));
    ck_assert_int_eq(fvi("poles --potential harmonic:4 --rho 0 --x0 1"), 0);
    ck_assert_str_eq(err, "");
    ck_assert_ptr_null(strstr(out, "x0"));
}
END_TEST

/* Five storeys with two springpots and a dashpot, as an expression and as a folder: the numbers of an
 * independent program (numpy, and Newton's method from undamped modes). */
START_TEST(dampers_have_responses_and_poles)
{
    static const char *const systems[] = {
        "--potential '50*(x1^2+(x2-x1)^2+(x3-x2)^2+(x4-x3)^2+(x5-x4)^2)'", "--system five"
    };
    const char *dampers = "--damper 'x1 : power:5,0.3' --damper 'x3-x2 : power:5,0.3' --damper "
                          "'top=x5-x4 : viscous:0.5' --format csv";
    const double H15[] = { -0.012953502980915, 0.00313766431038746 },
                 poles[5][2] = { { -0.0586151330215504, 2.89129638312316 },
                                 { -0.245567205704625, 8.49000945216913 },
                                 { -0.794065924497041, 13.5511138945064 },
                                 { -0.441631589977201, 16.985362449663 },
                                 { -1.04674624387992, 19.8370919043472 } };
    ck_assert_int_eq(shell("mkdir -p five"), 0);
    write_file("five/M.mtx", HEAD "5 5 5\n1 1 1\n2 2 1\n3 3 1\n4 4 1\n5 5 1\n");
    write_file("five/K.mtx", HEAD "5 5 9\n1 1 200\n2 2 200\n3 3 200\n4 4 200\n5 5 100\n"
                                  "2 1 -100\n3 2 -100\n4 3 -100\n5 4 -100\n");
    for (size_t i = 0; i < LEN(systems); i++) {
        char line[500], *at;
        snprintf(line, sizeof line, "response %s %s --omega 7.3 --at 1 --by 5", systems[i],
                 dampers);
        ck_assert_int_eq(fvi(line), 0);
        at = strstr(out, "7.3,") + 4;
        for (int part = 0; part < 2; part++, at++)
            ck_assert_near(strtod(at, &at), H15[part], 1e-14, "%s", systems[i]);
        snprintf(line, sizeof line, "poles %s %s", systems[i], dampers);
        ck_assert_int_eq(fvi(line), 0);
        at = strchr(out, '\n');
        for (int k = 0; k < 5; k++, at = strchr(at + 1, '\n'))
            for (char *number = at, part = 0; part < 2; part++, number++)
                ck_assert_near(strtod(number, &number), poles[k][(int)part], 1e-12,
                               "%s pole %d", systems[i], k);
    }
}
END_TEST

/* What changes with t is not made linear, and what does not swing is not passed over in silence. */
START_TEST(no_question_is_answered_in_part)
{
    const char *const asked[] = { "poles", "response --omega 1" };
    char line[200];
    for (int i = 0; i < 2; i++) {
        snprintf(line, sizeof line, "%s --damper 'x*(1+sin(t)) : viscous:0.2'", asked[i]);
        ck_assert_int_eq(fvi(line), 1);
        ck_assert_str_eq(err, "fvi: --damper: the gradient of its elongation changes with t: there "
                              "are no poles and no response\n");
        snprintf(line, sizeof line, "%s --potential 'log(x)'", asked[i]);
        ck_assert_int_eq(fvi(line), 1);
        ck_assert_str_eq(err, "fvi: --potential: the Hessian is not finite\n");
        snprintf(line, sizeof line, "%s --damper 'x+sin(t) : viscous:0.2'", asked[i]);
        ck_assert_int_eq(fvi(line), 0);
    }
    const char *const no_swing[] = { "--potential 'cos(x)'", "--rho 5", "--potential free" };
    for (int i = 0; i < 3; i++) {
        snprintf(line, sizeof line, "poles %s", no_swing[i]);
        ck_assert_int_eq(fvi(line), 0);
        ck_assert_ptr_nonnull(strstr(err, "fvi: warning: what creeps or grows, e^{st} with a real s "
                                          "or with Re s > 0, is no row\n"));
    }
    ck_assert_int_eq(fvi("poles --alpha 0.3"), 0);
    ck_assert_str_eq(err, "");
}
END_TEST

START_TEST(bad_questions_are_bad_use)
{
    static const char *const bad[][2] = {
        { "response", "response: --omega A:B:N[:log] or a list is missing" },
        { "response --omega 1:2", "--omega: '1:2' is not A:B:N, A:B:N:log or a list of numbers" },
        { "response --omega 0:2:3", "--omega: '0:2:3': frequencies are above 0" },
        { "response --omega 1,,2", "--omega: " },
        { "response --omega -1", "--omega: '-1' is outside (0, inf)" },
        { "response --omega 1 --of mobilty", "--of: 'mobilty' is none of receptance, mobility, "
                                             "accelerance, ground, moduli; did you mean mobility?" },
        { "response --omega 1 --at 2", "--at: '2' is outside [1, 1]" },
        { "response --omega 1 --by 0", "--by: '0' is outside [1, 1]" },
        { "response --omega 1 --of ground --by 1", "--by: not together with --of ground" },
        { "response --omega 1 --along 1", "--along: without --of ground" },
        { "response --omega 1 --of ground --along 1,2", "--along: '1,2'" },
        { "response --omega 1 --of moduli --mass 2", "--mass: not together with --of moduli" },
        { "response --omega 1 --of moduli --at 1", "--at: not together with --of moduli" },
        { "response --omega 1 --of moduli --damper 'x : viscous:1'",
          "--damper: not together with --of moduli" },
        { "poles --damper 'x : viscous:1' --rho 1", "--damper: not together with --rho" },
        { "response --omega 1 --steps 3", "--steps: not an option of this command" },
        { "response --omega 1 --hert", "--hert: no such option; did you mean --hertz?" },
        { "response --omega 1 --omega 2", "--omega: given twice" },
        { "response --omega", "--omega: a value is missing" },
        { "poles --count 2", "--count: '2' is outside [1, 1]" },
        { "poles --potential chain:600,1,0", "--count: at most 500 of 600 poles" },
        { "poles --plot x.svg", "--plot: not an option of this command" },
        { "poles --damping zener:1,0.3,2 --alpha 0.3", "--damping: not together with --alpha" },
    };
    for (size_t i = 0; i < LEN(bad); i++) {
        ck_assert_msg(fvi(bad[i][0]) == 2, "%s", bad[i][0]);
        ck_assert_str_eq(out, "");
        ck_assert_msg(strncmp(err, "fvi: ", 5) == 0
                          && strncmp(err + 5, bad[i][1], strlen(bad[i][1])) == 0,
                      "%s: %s", bad[i][0], err);
    }
}
END_TEST

/* All formats hold the same numbers; a picture is drawn, or nothing is written. */
START_TEST(tables_have_formats_and_pictures)
{
    ck_assert_int_eq(fvi("poles --alpha 0.3 --format csv"), 0);
    ck_assert(strncmp(out, "re,im,frequency,damping,residual\n", 33) == 0);
    ck_assert_int_eq(fvi("poles --alpha 0.3 --format json"), 0);
    ck_assert_ptr_nonnull(strstr(out, "\"poles\": \"1 of 1\""));
    ck_assert_int_eq(fvi("response --alpha 0.3 --omega 1 -o r.tsv"), 0);
    ck_assert(exists("r.tsv"));
    if (system("gnuplot --version > /dev/null 2>&1") != 0)
        return;
    ck_assert_int_eq(fvi("response --alpha 0.3 --omega 0.1:10:50:log --plot b.svg"), 0);
    ck_assert_int_eq(shell("grep -c '<path' b.svg"), 0);
    ck_assert_int_eq(fvi("response --of moduli --omega 0.1:10:50:log --plot c.svg"), 0);
    ck_assert_int_eq(shell("grep -q storage c.svg && ! grep -q storage b.svg"), 0);
    ck_assert_int_eq(fvi("response --rho 0 --omega 0.5,1 --plot d.svg"), 1);
    ck_assert(!exists("d.svg"));
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("the program fvi: response and poles");
    ADD_CASE(suite, "numbers", responses_are_those_of_the_contract,
             moduli_are_those_of_the_contract, poles_are_those_of_the_contract,
             what_does_not_swing_has_no_poles, a_growing_swing_is_no_row, dampers_act_between_points,
             a_potential_is_linear_at_x0, dampers_have_responses_and_poles);
    ADD_CASE(suite, "words", no_question_is_answered_in_part, bad_questions_are_bad_use,
             tables_have_formats_and_pictures);
    return run_suite_of_program(suite);
}
