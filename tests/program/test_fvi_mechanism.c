/* tests/program/test_fvi_mechanism.c -- The program build/fvi: Lagrangians, dampers, constraints.
 * Run alone: make test-fvi_mechanism */
#define _GNU_SOURCE
#include <fvi/fvi.h>
#include "program.h"

#define ELASTIC                                                                \
    "run --lagrangian '(v1^2+v2^2)/2 - 2*(sqrt(x1^2+x2^2)-1)^2 - x2' "          \
    "--damper 'sqrt(x1^2+x2^2) : power:0.4,0.3' --x0 1.2,0 --h 0.1 --steps 40 "
#define ROD                                                                    \
    "run --lagrangian '(v1^2+v2^2)/2 - x2' --x0 1,0 --steps 40 "
#define RING "--constraint 'x1^2+x2^2-1' "

static const char *first_number_row(void)
{
    const char *at = out;
    while (*at == '#')
        at = strchr(at, '\n') + 1;
    return at;
}

static void ck_assert_rows_are_equal(const char *one, const char *other)
{
    ck_assert_msg(fvi(one) == 0, "%s: %s", one, err);
    char *want = strdup(first_number_row());
    ck_assert_msg(fvi(other) == 0, "%s: %s", other, err);
    ck_assert_msg(strcmp(first_number_row(), want) == 0, "%s: other rows",
                  other);
    free(want);
}

/* 40 steps of roundings of numbers below 4. Seen: 5e-15. */
static void ck_assert_rows_are_near(const char *one, const char *other,
                                    size_t width)
{
    double want[41 * 8];
    ck_assert_msg(fvi(one) == 0, "%s: %s", one, err);
    for (size_t k = 0; k <= 40; k++)
        for (size_t i = 0; i < width; i++)
            want[k * width + i] = cell(k, i);
    ck_assert_msg(fvi(other) == 0, "%s: %s", other, err);
    for (size_t k = 0; k <= 40; k++)
        for (size_t i = 0; i < width; i++)
            ck_assert_near(cell(k, i), want[k * width + i], 41 * 4 * U,
                           "%s: row %zu", other, k);
}

/* The last row of an independent program (tests/lagrangian/prototype_values.h). */
START_TEST(a_lagrangian_is_a_command)
{
    ck_assert_msg(fvi(ELASTIC "--v0 0.3,0.8") == 0, "%s", err);
    static const double want[] = { -0.5769877459681192, -1.149984679827903,
                                   -0.8587787050117233, 1.1714645807415434 };
    for (size_t i = 0; i < 4; i++)
        ck_assert_near(cell(40, i + 1), want[i], 1e-13, "%zu", i);
    ck_assert_ptr_nonnull(strstr(out, "# method = fvi-stable\n# lagrangian = "));
    ck_assert_ptr_nonnull(
        strstr(out, "# damper = sqrt(x1^2+x2^2) : power:0.4,0.3\n"));
    ck_assert_ptr_nonnull(strstr(out, "# v0 = 0.3,0.8\n"));
    ck_assert(!strstr(out, "# mass") && !strstr(out, "# rho")
              && !strstr(out, "# alpha") && !strstr(out, "# p0"));
    const double E = cell(0, 5);
    ck_assert_near(E, 0.445, 1e-16, "energy");
    ck_assert_rows_are_equal(ELASTIC "--v0 0.3,0.8", ELASTIC "--p0 0.3,0.8");
    ck_assert_rows_are_equal(
        "run --lagrangian 'm*v^2 - x^2/2' --let m=2 --x0 1 --v0 0.25",
        "run --lagrangian '2*v^2 - x^2/2' --x0 1 --p0 1");
}
END_TEST

/* What each of the old words means in the new ones. */
START_TEST(a_damper_on_each_coordinate_is_the_old_damping)
{
    static const char *const methods[] = { "fvi", "fvi-lobatto3", "fvi-lobatto4d" };
    for (size_t i = 0; i < LEN(methods); i++) {
        char one[300], other[300];
        snprintf(one, sizeof one, "run --alpha 0.3 --rho 0.4 --potential duffing:1,0.5 "
                                  "--steps 40 --method %s", methods[i]);
        snprintf(other, sizeof other,
                 "run --damper 'x : power:0.4,0.3' --potential duffing:1,0.5 "
                 "--steps 40 --method %s", methods[i]);
        ck_assert_rows_are_near(one, other, 4);
    }
    ck_assert_rows_are_near(
        "run --damping 'power:0.4,0.3 + spring:1' --steps 40 --method fvi-stable",
        "run --damper 'x : power:0.4,0.3 + spring:1' --steps 40 "
        "--method fvi-stable", 4);
    ck_assert_rows_are_near( /* a force of velocity does not replace the damping */
        "run --alpha 0.3 --rho 0.4 --potential duffing:1,0.5 --steps 40",
        "run --alpha 0.3 --rho 0.4 --potential duffing:1,0.5 --steps 40 "
        "--force-on '1=0*v'", 4);
    ck_assert_rows_are_near(
        "run --alpha 0.3 --rho 0.4 --potential 'x^2/2' --force 'sin(2*t)' --steps 40 "
        "--method fvi-lobatto3",
        "run --alpha 0.3 --rho 0.4 --potential 'x^2/2' --force-on '1=sin(2*t)' "
        "--steps 40 --method fvi-lobatto3", 4);
}
END_TEST

/* t in a potential; the dimension is the largest index. */
START_TEST(time_and_dimension_are_seen_in_the_texts)
{
    ck_assert_rows_are_equal(
        "run --potential '(1+0.5*cos(2*t))*x^2/2 + x^4/4' --damper 'x : "
        "power:0.2,0.3' --x0 0.5 --p0 0.3 --steps 40 --method fvi-lobatto3",
        "run --lagrangian 'v^2/2 - (1+0.5*cos(2*t))*x^2/2 - x^4/4' --damper 'x : "
        "power:0.2,0.3' --x0 0.5 --v0 0.3 --steps 40 --method fvi-lobatto3");
    ck_assert_near(cell(40, 1), -0.0911486892536883, 1e-13, "x40");
    ck_assert_rows_are_equal("run --potential 'x1^2/2 + x3^2' --steps 5",
                             "run --potential 'x1^2/2 + x3^2' --steps 5 "
                             "--dimension 3");
    ck_assert_rows_are_equal(
        "run --potential free --damper 'x2 - x1 : viscous:1' --steps 5",
        "run --potential free --dimension 2 --damper 'x2 - x1 : viscous:1' --steps 5");
    ck_assert_rows_are_equal(
        "run --potential 'x3^2' --damper 'x2 - x1 : viscous:1' --steps 5",
        "run --potential 'x3^2' --dimension 3 --damper 'x2 - x1 : viscous:1' --steps 5");
    ck_assert_int_eq(fvi("run --potential chain:3,1,0 --damper 'x2 - x1 : viscous:1'"), 0);
    ck_assert_refused_at("run --dimension 2 --potential 'x1^2/2 + x3^2'",
                         "fvi: --potential: 'x1^2/2 + x3^2': no such name\n"
                         "                            ^");
}
END_TEST

/* A springpot and a spring in series, with nothing between them, are Zener's law: 200 steps.
 * Seen: 1.5e-15. */
START_TEST(a_massless_node_makes_zeners_law)
{
#define NODE(METHOD)                                                           \
    "run --mass 1,0 --potential 'x1^2/2 + (x1-x2)^2' --damper 'x2 : "           \
    "power:0.5,0.3' --x0 0 --p0 1,0 --h 0.05 --steps 200 --method " METHOD
#define ZENER(METHOD)                                                          \
    "run --potential 'x^2/2' --damping zener:0.5,0.3,0.25 --x0 0 --p0 1 --h "    \
    "0.05 --steps 200 --method " METHOD
    static const char *const pairs[][2] = {
        { NODE("fvi-stable"), ZENER("fvi-stable") },
        { NODE("fvi-lobatto3d"), ZENER("fvi-lobatto3d") },
        { NODE("fvi-lobatto4d"), ZENER("fvi-lobatto4d") }
    };
    for (size_t i = 0; i < LEN(pairs); i++) {
        double x[201], p[201];
        ck_assert_msg(fvi(pairs[i][0]) == 0, "%s", err);
        for (size_t k = 0; k <= 200; k++) {
            x[k] = cell(k, 1);
            p[k] = cell(k, 3);
        }
        ck_assert_msg(fvi(pairs[i][1]) == 0, "%s", err);
        for (size_t k = 0; k <= 200; k++) {
            ck_assert_near(cell(k, 1), x[k], 1e-14, "x %zu", k);
            ck_assert_near(cell(k, 2), p[k], 1e-14, "p %zu", k);
        }
        if (i == 0)
            ck_assert_near(x[200], -0.18310218420059182, 1e-14, "x(10)");
    }
    ck_assert_rows_are_equal( /* the method with a mass of 0 */
        NODE("fvi-stable"),
        "run --mass 1,0 --potential 'x1^2/2 + (x1-x2)^2' --damper 'x2 : "
        "power:0.5,0.3' --x0 0 --p0 1,0 --h 0.05 --steps 200");
    ck_assert_refused_with(NODE("fvi-lobatto4"),
                           "fvi: --mass: coordinate 2 has no inertia, and no "
                           "damper of an order above 1 that this method could take: "
                           "fvi-stable and fvi-lobatto2d to 8d take it");
    ck_assert_refused_with(NODE("fvi"), "fvi: --mass: coordinate 2 has no inertia");
}
END_TEST

/* p tells nothing of the velocity of a coordinate without mass: with --error, too, it is that of a run. */
START_TEST(a_massless_node_has_a_velocity_with_an_error_too)
{
    const char *line = "run --mass 1,0 --potential 'x1^2/2 + (x1-x2)^2' --damper 'x2 : "
                       "power:0.5,0.3' --x0 1 --v0 0 --time 2 --steps 4 --error 1e-5 "
                       "--columns v,d1.force";
    double v[5][2];
    ck_assert_int_eq(fvi(line), 0);
    for (size_t k = 0; k <= 4; k++)
        for (size_t i = 0; i < 2; i++)
            v[k][i] = cell(k, i);
    ck_assert(v[4][1] < -0.1);
    char alone[300];
    snprintf(alone, sizeof alone, "%.*s", (int)(strlen(line) - strlen(",d1.force")), line);
    ck_assert_int_eq(fvi(alone), 0);
    for (size_t k = 0; k <= 4; k++)
        for (size_t i = 0; i < 2; i++)
            ck_assert(cell(k, i) == v[k][i]);
}
END_TEST

/* The multiplier of the recipe's cart, driven by hand, at t = 4: order 2, and 4 at least. Seen: 9.2e-5,
 * 9.2e-7. */
START_TEST(multipliers_and_reactions_are_columns)
{
#define DRIVEN(METHOD, STEPS)                                                  \
    "run --lagrangian '3*v1^2/2 + v1*v2*cos(x2) + v2^2/2 + cos(x2)' --impose "   \
    "'x1=0.3*sin(2*t)' --damper 'x1 : power:0.3,0.3' --damper 'x2 : "           \
    "power:0.2,0.3' --x0 0,1.2 --v0 0.6,0.5 --time 4 --steps " #STEPS            \
    " --columns t,reaction1,twice=multiplier1-reaction1 --method " METHOD
    static const char *const lines[] = { DRIVEN("fvi-stable", 160),
                                         DRIVEN("fvi-lobatto3", 80),
                                         DRIVEN("fvi-lobatto4", 80) };
    static const double most[] = { 2e-4, 2e-4, 2e-6 };
    for (size_t i = 0; i < 3; i++) {
        ck_assert_msg(fvi(lines[i]) == 0, "%s", err);
        const size_t last = i == 0 ? 160 : 80;
        ck_assert_near(cell(last, 1), -3.625949649242, most[i], "%zu", i);
        ck_assert_near(cell(last, 2), -2 * cell(last, 1), 1e-15, "%zu", i);
    }
    ck_assert_int_eq(fvi("run --lagrangian '(v1^2+v2^2)/2 - x2' --constraint "
                         "'(x1^2+x2^2-1)/2' --x0 0,-1 --v0 0 --steps 5 --columns "
                         "multiplier1"), 0);
    ck_assert_near(cell(5, 0), 1, 1e-12, "the weight of a pendulum at rest");
    ck_assert_refused_with("run --columns multiplier1",
                           "fvi: --columns: 'multiplier1' is none of t, x,");
    ck_assert_refused_with("run --potential 'x1^2+x2^2' --impose 'x2=1' --v0 0 "
                           "--columns reaction1",
                           "fvi: --columns: 'reaction1' is none of t, x, p, v, a, "
                           "F, energy, work, balance, y, multiplier1, reaction2");
}
END_TEST

/* The rod of a pendulum at its first nodes, where Lambda = (v^2 - x2) / 2 = (1 - 3 x2) / 2 by its energy: of
 * second order by every method, seen 0.54 h^2 at most; and where a coordinate without inertia stands by, from impulses
 * and short steps. There a run of one step has the mean at t = 0, which is that of its ends, seen 0.4 of 0.06 h^2. Else the
 * row at t = 0 is right. */
START_TEST(multipliers_of_the_first_nodes_are_of_second_order)
{
    const char *const alone = "--lagrangian '(v1^2+v2^2)/2-x2' --x0 1,0 --v0 0,1",
               *const beside = "--mass 1,1,0 --potential 'x2+x3^2' --damper 'x3 : viscous:1' --x0 1,0,0 --p0 0,1,0";
    const char *const methods[] = { "fvi-stable", "fvi-lobatto2", "fvi-lobatto4", "fvi-stable" };
    const double steps[] = { 0.1, 0.05, 0.025 };
    char line[300];
    for (size_t i = 0; i < 12; i++) {
        const double h = steps[i % 3];
        snprintf(line, sizeof line,
                 "run %s --constraint 'x1^2+x2^2-1' "
                 "--columns 'multiplier1-(1-3*x2)/2' --steps 3 --h %g --method %s", i < 9 ? alone : beside, h,
                 methods[i / 3]);
        ck_assert_int_eq(fvi(line), 0);
        for (size_t k = 0; k < 4; k++)
            ck_assert_near(cell(k, 0), 0, 0.6 * h * h, "%.150s, row %zu", line, k);
    }
    for (int i = 0; i < 2; i++) {
        snprintf(line, sizeof line, "run %s --constraint 'x1^2+x2^2-1' --columns multiplier1 --steps 1 --h 0.1 --method fvi-stable",
                 i == 0 ? alone : beside);
        ck_assert_int_eq(fvi(line), 0);
        ck_assert_near(cell(0, 0), i == 0 ? 0.5 : (0.5 + cell(1, 0)) / 2, i == 0 ? 1e-15 : 0.06 * 0.01, "%s", line);
    }
}
END_TEST

/* The step that a wanted error needs: against the reference of 8 digits. */
START_TEST(an_error_can_be_asked_for)
{
    ck_assert_msg(fvi("run --lagrangian '(v1^2+v2^2)/2 - 2*(sqrt(x1^2+x2^2)-1)^2 - x2' "
                      "--damper 'sqrt(x1^2+x2^2) : power:0.4,0.3' --x0 1.2,0 --v0 "
                      "0.3,0.8 --error 1e-7 --time 4 --steps 4 --method fvi-lobatto4")
                      == 0, "%s", err);
    ck_assert_near(cell(4, 1), -0.58082993, 1.1e-7, "x");
    ck_assert_near(cell(4, 2), -1.14370341, 1.1e-7, "y");
    ck_assert_int_eq(fvi("run --lagrangian 'v^2/2 - x^2/2' --x0 1 --v0 0 --error 1e-3 "
                         "--time 4 --steps 4"), 0);
    ck_assert_ptr_nonnull(strstr(out, "# method = fvi-adaptive\n"));
    ck_assert_near(cell(4, 1), cos(4), 1e-3, "cos");
    ck_assert_int_eq(fvi("run --lagrangian '(v1^2+v2^2)/2-x2' --constraint 'x1^2+x2^2-1' --x0 1,0 "
                         "--v0 0,0 --error 1e-3 --time 1 --steps 4"), 0);
    ck_assert_ptr_nonnull(strstr(out, "# method = fvi-adaptive\n"));
    ck_assert_near(cell(4, 1) * cell(4, 1) + cell(4, 2) * cell(4, 2), 1, 1e-12, "the rod");
}
END_TEST

/* Where the inertia of a Lagrangian vanishes on the way there is a warning with the time. */
START_TEST(an_inertia_that_vanishes_is_warned_of)
{
    static const char *const words[] = { "--h 0.01 --steps 60", "--time 0.6 --steps 60 --step-error 1e-6",
                                         "--time 0.6 --steps 60 --error 1e-2" };
    for (int i = 0; i < 3; i++) {
        char line[200];
        snprintf(line, sizeof line, "run --lagrangian 'v^4/12-x^2/2' --x0 1 --v0 1 %s", words[i]);
        ck_assert_msg(fvi(line) == 0, "%s: %s", line, err);
        ck_assert_msg(strstr(err, "is nearly singular at t = 0.2"), "%s: %s", line, err);
    }
    ck_assert_int_eq(fvi("run --lagrangian 'v^2/2-x^2/2' --x0 1 --v0 1"), 0);
    ck_assert_str_eq(err, "");
}
END_TEST

/* A run that was saved goes on with the same digits. */
START_TEST(a_checkpoint_goes_on)
{
    ck_assert_int_eq(fvi(ELASTIC "--v0 0.3,0.8 --format csv -o whole.csv"), 0);
    ck_assert_int_eq(
        fvi("run --lagrangian '(v1^2+v2^2)/2 - 2*(sqrt(x1^2+x2^2)-1)^2 - x2' "
            "--damper 'sqrt(x1^2+x2^2) : power:0.4,0.3' --x0 1.2,0 --v0 0.3,0.8 "
            "--h 0.1 --steps 20 --memory direct --checkpoint c -o part.tsv"), 0);
    ck_assert_int_eq(
        fvi("run --lagrangian '(v1^2+v2^2)/2 - 2*(sqrt(x1^2+x2^2)-1)^2 - x2' "
            "--damper 'sqrt(x1^2+x2^2) : power:0.4,0.3' --x0 1.2,0 --v0 0.3,0.8 "
            "--h 0.1 --steps 40 --memory direct --checkpoint c --continue"), 0);
    const double x = cell(40, 1);
    ck_assert_int_eq(fvi(ELASTIC "--v0 0.3,0.8 --memory direct"), 0);
    ck_assert(cell(40, 1) == x);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("fvi_mechanism");
    ADD_CASE(suite, "mechanisms", a_lagrangian_is_a_command,
             a_damper_on_each_coordinate_is_the_old_damping,
             time_and_dimension_are_seen_in_the_texts,
             a_massless_node_makes_zeners_law,
             a_massless_node_has_a_velocity_with_an_error_too, an_inertia_that_vanishes_is_warned_of,
             multipliers_and_reactions_are_columns,
             multipliers_of_the_first_nodes_are_of_second_order, an_error_can_be_asked_for, a_checkpoint_goes_on);
    return run_suite_of_program(suite);
}
