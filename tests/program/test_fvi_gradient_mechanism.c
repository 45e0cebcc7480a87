/* tests/program/test_fvi_gradient_mechanism.c -- The program build/fvi: gradients with dampers between points,
 * Lagrangians, constraints and a ground that moves.  Run alone: make test-fvi_gradient_mechanism */
#define _GNU_SOURCE
#include "gradient_rows.h"
#include "system/larger.h"

#include <string.h>

/* A row of the gradient against a difference of two runs, each with the number moved: `words` has one
 * %.17g for it. */
typedef struct {
    const char *words, *of, *row;
    double at;
} moved;

/* The last number of the last row. */
static double last_of(const char *words, double at, const char *column)
{
    char options[600], line[700];
    snprintf(options, sizeof options, words, at);
    snprintf(line, sizeof line, "run %s --columns %s", options, column);
    ck_assert_msg(fvi(line) == 0, "%s: %s", line, err);
    return cell(count_rows() - 1, 0);
}

/* Differences of 1e-5 are off by 1e-10 times a third derivative, and by rounding over 1e-5. */
static void ck_assert_row_is_difference(const moved *m)
{
    char options[600], line[700], column[20];
    const char *number = strchr(m->of, ':');
    snprintf(column, sizeof column, "%.*s%s", (int)strcspn(m->of, ":"), m->of,
             number ? number + 1 : "");
    const double after = last_of(m->words, m->at + 1e-5, column),
                 before = last_of(m->words, m->at - 1e-5, column),
                 want = (after - before) / 2e-5;
    snprintf(options, sizeof options, m->words, m->at);
    snprintf(line, sizeof line, "gradient %s --of %s", options, m->of);
    ck_assert_msg(fvi(line) == 0, "%s: %s", line, err);
    const double got = derivative(m->row);
    ck_assert_near(got, want, 1e-6 * larger(1, fabs(want)), "%.100s by %s", m->words, m->row);
}

#define SPRING "--lagrangian '(v1^2+v2^2)/2 - k*(sqrt(x1^2+x2^2)-1)^2 - x2' --x0 1.2,0 --p0 0.3,0.8 "
#define CART                                                                                       \
    "--lagrangian '1.5*v1^2+v1*v2*cos(x2)+v2^2/2+c*cos(x2)-x1^2/2' --force-on '2=-0.1*v2^3' "
#define FEW "--h 0.1 --steps 30 "

START_TEST(rows_of_a_mechanism_are_differences_of_runs)
{
    static const moved rows[] = {
        { SPRING "--damper 'strut=sqrt(x1^2+x2^2) : power:0.4,0.3' " FEW "--let k=%.17g", "x:1", "k", 2 },
        { SPRING "--damper 'strut=sqrt(x1^2+x2^2) : power:0.4,0.3' " FEW "--let k=%.17g", "energy",
          "k", 2 },
        { SPRING "--let k=2 --damper 'strut=sqrt(x1^2+x2^2) : power:%.17g,0.3' " FEW, "p:2",
          "strut.rho", 0.4 },
        { SPRING "--let k=2 --damper 'strut=sqrt(x1^2+x2^2) : power:0.4,%.17g' " FEW
                 "--method fvi-lobatto3",
          "x:2", "strut.alpha", 0.3 },
        { SPRING "--let k=2 --damper 'strut=sqrt(x1^2+x2^2) : power:0.4,%.17g' " FEW, "energy",
          "strut.alpha", 0.7 },
        { SPRING "--let k=2 --damper 'sqrt(x1^2+x2^2) : viscous:0.2 + zener:0.4,0.3,%.17g' " FEW
                 "--method fvi-lobatto4d",
          "x:1", "d1.zener2.time", 0.5 },
        { CART "--let c=%.17g --x0 0.2,1.2 --p0 0.1,0.5 --damper 'x1 : power:0.3,0.3' " FEW,
          "energy", "c", 1 },
        { CART "--let c=1 --x0 0.2,1.2 --p0 %.17g,0.5 --damper 'x1 : power:0.3,0.7' " FEW, "x:2",
          "p0_1", 0.1 },
        { CART "--let c=1 --x0 0.2,%.17g --p0 0.1,0.5 --damper 'x1 : power:0.3,0.7' " FEW, "x:2",
          "x0_2", 1.2 },
        { "--mass 1,%.17g --potential chain:2,1,0.5 --damper 'x2-x1 : maxwell:1,0.4' " FEW, "x:1",
          "mass_2", 2 },
        { "--mass 1,2 --potential chain:2,1,0.5 --damper 'x2-x1 : maxwell:1,%.17g' " FEW
          "--method fvi-lobatto3d",
          "x:1", "d1.time", 0.4 },
        { CART "--let c=%.17g --impose 'x1=0.3*sin(2*t)' --x0 0,1.2 --v0 0.6,0 --damper 'x2-x1 : "
               "power:0.3,0.3' " FEW,
          "x:2", "c", 1 },
        { CART "--let c=1 --impose 'x1=0.3*sin(2*t)' --x0 0,1.2 --v0 0.6,0 --damper 'x2-x1 : "
               "power:0.3,%.17g' " FEW "--method fvi-lobatto3",
          "p:2", "d1.alpha", 0.3 },
        { "--lagrangian '(v1^2+v2^2)/2-g*x2' --constraint '(x1^2+x2^2-1)/2' --x0 0.6,-0.8 --p0 "
          "0.4,0.3 --damper 'sqrt((x1-1.5)^2+x2^2) : power:0.4,0.3' --let g=%.17g " FEW,
          "x:1", "g", 1 },
        { "--lagrangian '(v1^2+v2^2)/2+x1*x2*v1-g*x2' --constraint '(x1^2+x2^2-1)/2' --x0 0.6,-0.8 "
          "--v0 0.4,0.3 --method fvi-lobatto3 --let g=%.17g " FEW,
          "p:2", "g", 1 },
        { "--lagrangian '(v1^2+v2^2)/2+x1*x2*v1-g*x2' --constraint '(x1^2+x2^2-1)/2' --x0 0.6,-0.8 "
          "--v0 0.4,0.3 --method fvi-lobatto3d --let g=%.17g " FEW,
          "p:2", "g", 1 }, /* the slope L_xv is not 0, nor is the multiplier of the last row */
        { SPRING "--damper 'strut=sqrt(x1^2+x2^2) : power:0.4,0.3' --time 3 --steps 3 --method fvi-adaptive --step-error 1e-12 "
                 "--let k=%.17g", "energy", "k", 2 },
        { SPRING "--let k=2 --damper 'sqrt(x1^2+r*x2^2) : power:0.4,0.7' --time 3 --steps 3 --method fvi-adaptive --step-error 1e-12 "
                 "--let r=%.17g", "p:1", "r", 1 },
        /* names in an elongation, beside the Lagrangian, in a force of velocity, in an imposed place, in a constraint */
        { SPRING "--let k=%.17g --damper 'sqrt(x1^2+x2^2)+k*x1 : power:0.4,0.3' " FEW, "energy", "k", 2 },
        { "--mass 1,2 --potential chain:2,1,0.5 --let r=%.17g --damper 'x2-r*x1 : maxwell:1,0.4' " FEW, "x:1", "r", 2 },
        { "--force-on '1=mu*(1-x1^2)*v1' --let mu=%.17g --damper 'x1 : power:0.3,0.3' " FEW "--method fvi-lobatto3d", "x",
          "mu", 1 },
        { CART "--let c=1 --let a=%.17g --impose 'x1=a*(1-cos(2*t))' --x0 0,1.2 --v0 0,0 " FEW, "x:2", "a", 0.3 },
        { "--lagrangian '(v1^2+v2^2)/2-x2' --constraint 'x2-a*x1^2' --let a=%.17g --x0 0,0 --v0 0.7,0 --method "
          "fvi-lobatto4 " FEW, "x:1", "a", 0.5 },
    };
    for (size_t i = 0; i < LEN(rows); i++)
        ck_assert_row_is_difference(rows + i);
}
END_TEST

/* p does not say the velocity of a coordinate without mass, unless a constraint ties it to others. */
START_TEST(a_coordinate_without_mass_beside_a_constraint_has_a_gradient)
{
#define PAIR "--potential 'x1^2+(x1-x2)^2/2+x2^4' --mass 1.7,0 --h 0.05 --steps 3 "
#define THREE "--potential 'x1^2+(x1-x2)^2/2+x2^4+(x3-x2)^2' --mass 1.7,1,0 --h 0.05 --steps 3 "
    static const moved rows[] = {
        { PAIR "--method fvi-lobatto3d --impose 'x1=0.1*t^2' --damper 'x2 : viscous:0.47' --p0 0,0 --x0 0,%.17g",
          "x:2", "x0_2", -0.5 },
        { PAIR "--method fvi-lobatto2d --impose 'x2=0.1*t-0.5' --damper 'x2-x1 : power:0.47,0.7' "
               "--p0 0.3,0 --x0 %.17g,-0.5",
          "x:1", "x0_1", -0.2 },
        { PAIR "--method fvi-lobatto3d --damper 'x2+x1 : power:0.47,0.7' --x0 -0.2,-0.5 --p0 %.17g,0",
          "x:2", "p0_1", 0.3 },
        { THREE "--method fvi-lobatto3d --constraint 'x1-x3+0.6' --damper 'x2-x3 : power:0.47,0.7' "
                "--x0 -0.2,-0.5,0.4 --p0 0,%.17g,0",
          "x:3", "p0_2", 0.2 },
    };
#undef PAIR
#undef THREE
    for (size_t i = 0; i < LEN(rows); i++)
        ck_assert_row_is_difference(rows + i);
}
END_TEST

START_TEST(rows_where_the_ground_moves_are_differences_of_runs)
{
    static const moved rows[] = {
        { "--potential harmonic:4 --ground 'A*sin(2*t)' --let A=%.17g --rho 0.5 " FEW, "x", "A", 1 },
        { "--potential harmonic:4 --ground 'sin(2*t)' --mass %.17g --rho 0.5 " FEW, "x", "mass", 2 },
        { "--potential harmonic:4 --ground 'sin(2*t)' --mass %.17g --rho 0.5 " FEW
          "--method fvi-lobatto3",
          "energy", "mass", 2 },
        { "--potential chain:2,4,0 --ground 'sin(2*t)' --mass 1,%.17g --along 1,0.5 --rho 0.5 " FEW
          "--method fvi-stable --force 't*t'",
          "x:1", "mass_2", 2 },
        { "--potential chain:2,4,0 --ground 'sin(2*t)' --mass 1,2 --damper 'x1 : power:%.17g,0.3' " FEW,
          "x:2", "d1.rho", 0.7 },
    };
    for (size_t i = 0; i < LEN(rows); i++)
        ck_assert_row_is_difference(rows + i);
    ck_assert_int_eq(fvi("gradient --ground 'sin(2*t)' --method fvi-adaptive --steps 20"), 0);
    ck_assert_ptr_nonnull(strstr(out, "# warning = no derivative by mass: steps of any length"));
}
END_TEST

/* A jump at a row belongs half to either side; in form D the sides count differently, and there is no row. */
START_TEST(a_ground_may_jump_at_a_row)
{
    static const char *const methods[] = { "fvi", "fvi-bdf2", "fvi-stable", "fvi-shifted", "fvi-lobatto2", "fvi-lobatto4" },
                             *const jumps[] = { "--ground step:0.5,1", "--ground '0.5*sign(1-t)'" };
    for (size_t i = 0; i < LEN(jumps) * LEN(methods); i++) {
        char line[400], by_force[400];
        snprintf(line, sizeof line, "--potential harmonic:4 %s --mass %%.17g --rho 0.5 --alpha 0.3 --h 0.125 --steps 16 --method %s ",
                 jumps[i % 2], methods[i / 2]);
        ck_assert_row_is_difference((&(moved){ line, "x", "mass", 2 }));
        snprintf(by_force, sizeof by_force,
                 "--potential harmonic:4 --force 'A*sign(1-t)' --let A=%%.17g --rho 0.5 --alpha 0.3 --h 0.125 --steps 16 --method %s ",
                 methods[i / 2]);
        ck_assert_row_is_difference((&(moved){ by_force, "x", "A", 1 }));
    }
    const char *same = "gradient --h 0.125 --steps 16 --method fvi-lobatto4d";
    char line[200];
    snprintf(line, sizeof line, "%s --ground step:0.5,1", same);
    ck_assert_int_eq(fvi(line), 0);
    ck_assert_ptr_nonnull(strstr(out, "# warning = no derivative by mass: what acts jumps at a row"));
    ck_assert(!strstr(out, "\nmass\t"));
    snprintf(line, sizeof line, "%s --force 'A*sign(1-t)' --let A=1", same);
    ck_assert_int_eq(fvi(line), 0);
    ck_assert_ptr_nonnull(strstr(out, "# warning = no derivative by A: what acts jumps at a row"));
    snprintf(line, sizeof line, "%s --ground step:0.5,0.96", same); /* within a step: there is one */
    ck_assert_int_eq(fvi(line), 0);
    ck_assert_ptr_nonnull(strstr(out, "\nmass\t"));
}
END_TEST

START_TEST(what_a_mechanism_has_no_row_of_is_said)
{
    ck_assert_int_eq(fvi("gradient " CART "--let c=1 --impose 'x1=0.3*sin(2*t)' --x0 0,1.2 --v0 "
                         "0.6,0 --damper 'x2-r*x1 : power:0.3,0.3' --let r=1 " FEW),
                     0);
    ck_assert_ptr_nonnull(
        strstr(out, "# warning = no derivative by x0_1: this coordinate is imposed\n"));
    derivative("r");
    derivative("x0_2");
    ck_assert_int_eq(fvi("gradient --lagrangian '(v1^2+v2^2)/2-x2' --constraint 'x1^2+x2^2-l^2' --let l=1 --x0 1,0 --v0 0,1 "
                         FEW), 0);
    ck_assert_ptr_nonnull(strstr(out, "# warning = no derivative by l: by a constraint the start would have to follow it, or "));
    derivative("x0_1");
    ck_assert_int_eq(fvi("gradient --lagrangian '(v1^2+v2^2)/2-x2' --constraint 'x1^2+x2^2-l^2' --let l=1 --x0 1,0 --v0 0,1 "
                         "--by l " FEW), 2);
    ck_assert_ptr_nonnull(strstr(err, "fvi: --by: 'l': no derivative by l: by a constraint the start would"));
    ck_assert_int_eq(fvi("gradient --mass 1,0 --potential 'x1^2/2 + (x1-x2)^2' --damper 'x2 : "
                         "power:0.5,0.3' --method fvi-stable"),
                     2);
    ck_assert_ptr_nonnull(strstr(err, "--method: 'fvi-stable' has no gradient with a mass of 0"));
    ck_assert_int_eq(fvi("gradient --mass 1,0 --potential 'x1^2/2 + (x1-x2)^2' --damper 'x2 : "
                         "power:0.5,0.3' --x0 0 --p0 1,0 --method fvi-lobatto3d --of x:1"),
                     0);
    ck_assert_int_eq(fvi("gradient --damper 'x : power:0.3,0.7 + zener:0.3,0.3,1' --method "
                         "fvi-lobatto3"),
                     0);
    ck_assert_ptr_nonnull(strstr(out, "# warning = no derivative by d1.power1.rho: with stages a sum"));
}
END_TEST

/* The library's own reason, or what is wrong with the start, and not that the method has no such thing. */
/* With the past rl and an order above 1 only a start that does not stretch the damper has a motion. (19.2) */
START_TEST(a_place_that_would_stretch_a_damper_of_the_past_rl_has_no_row)
{
    static const struct {
        const char *words;
        int has[3];
    } runs[] = { { "--damper 'x1 : power:1,0.7 : rl' --x0 0,1,1 --method fvi-stable", { 0, 1, 1 } },
                 { "--damper 'x2-x1 : zener:1,0.3,2 : rl' --x0 0.3,0.3,1 --method fvi-lobatto4", { 0, 0, 1 } },
                 { "--damper 'x2-x1 : power:1,0.4 : rl' --x0 0.3,0.3,1 --method fvi-lobatto4", { 1, 1, 1 } },
                 { "--damper 'x1 : power:1,0.7 : rl' --x0 0,1,1 --method fvi", { 1, 1, 1 } } };
    for (size_t i = 0; i < LEN(runs); i++) {
        char line[300], said[90];
        snprintf(line, sizeof line, "gradient --dimension 3 %s --steps 20", runs[i].words);
        ck_assert_msg(fvi(line) == 0, "%s: %s", line, err);
        for (size_t k = 0; k < 3; k++) {
            snprintf(said, sizeof said, "# warning = no derivative by x0_%zu: other starts have no solution\n", k + 1);
            ck_assert_msg((strstr(out, said) == NULL) == runs[i].has[k], "%s: %s", line, out);
            snprintf(said, sizeof said, "\nx0_%zu\t", k + 1);
            ck_assert_msg((strstr(out, said) != NULL) == runs[i].has[k], "%s: %s", line, out);
        }
        ck_assert_ptr_nonnull(strstr(out, "\np0_1\t"));
    }
}
END_TEST

/* A sum of powers of the past rl is stretched at once, and each of them has a force, as so many dampers would. To
 * rounding of 20 steps; seen: 3e-15. */
START_TEST(several_powers_of_the_past_rl_are_as_many_dampers)
{
    static const char *const methods[] = { "fvi-stable", "fvi-lobatto4", "fvi-lobatto3d" };
    static const char *const dampers[] = { "--damper 'e=x : power:0.5,0.2 + viscous:0.4 + power:0.3,0.1 : rl'",
                                           "--damper 'a=x : power:0.5,0.2 : rl' --damper 'b=x : viscous:0.4 : rl' "
                                           "--damper 'c=x : power:0.3,0.1 : rl'" };
    static const char *const names[2][6] = {
        { "x0", "p0", "e.power1.rho", "e.power1.alpha", "e.viscous2.rho", "e.power3.alpha" },
        { "x0", "p0", "a.rho", "a.alpha", "b.rho", "c.alpha" }
    };
    for (size_t i = 0; i < LEN(methods); i++) {
        double want[LEN(names[0])];
        for (size_t l = 0; l < 2; l++) {
            char line[400];
            snprintf(line, sizeof line, "gradient --steps 20 --x0 0.7 --method %s %s", methods[i], dampers[l]);
            ck_assert_int_eq(fvi(line), 0);
            for (size_t j = 0; j < LEN(names[0]); j++) {
                if (l > 0)
                    ck_assert_near(derivative(names[l][j]), want[j], 1e-13, "%s, %s", methods[i], names[l][j]);
                want[j] = derivative(names[l][j]);
            }
        }
    }
}
END_TEST

START_TEST(why_a_mechanism_has_no_gradient_is_said)
{
    static const char *const words[][2] = {
        { "--lagrangian '(v1^2+v2^2)/2-x2' --constraint 'x1^2+x2^2-1-t' --x0 0,-1 --v0 2,-0.5 " FEW,
          "fvi: no adjoint of a constraint that knows the time" },
        { "--lagrangian 'v1^2/2-x1^2/2' --damper 'x1 : power:1,0.3 : rl' --x0 0 --v0 1 --step-error 1e-8 " FEW,
          "fvi: steps of any length have no adjoint of a damper with the past rl" },
        { "--lagrangian '(v1^2+v2^2)/2-x2' --constraint 'x1^2+x2^2-1' --x0 0,-0.9 --v0 2,0 " FEW,
          "fvi: --x0: it does not keep to the constraint" },
    };
    for (size_t i = 0; i < LEN(words); i++) {
        char line[400];
        snprintf(line, sizeof line, "gradient %s", words[i][0]);
        ck_assert_int_eq(fvi(line), 1);
        ck_assert_msg(strstr(err, words[i][1]) != NULL, "%s: %s", line, err);
    }
}
END_TEST

/* The energy of a run with a mass of 0, by differences of runs; the kinetic energy of that coordinate is none, so that there is
 * no row for its mass. */
START_TEST(an_energy_without_inertia_has_derivatives)
{
#define LIGHT "--mass 1,0 --potential 'x1^2/2+(x2-x1)^2' --damper 'x2 : power:0.5,0.3' --p0 0,0 --time 2 --steps 40 "
    static const char *const methods[] = { "fvi-lobatto4d", "fvi-adaptive" };
    double energy[2];
    char words[300];
    for (int i = 0; i < 2; i++) {
        for (int k = 0; k < 2; k++) {
            snprintf(words, sizeof words, "run " LIGHT "--method %s --x0 %s,0.5 --columns energy --every 40", methods[i],
                     k ? "1.001" : "0.999");
            ck_assert_int_eq(fvi(words), 0);
            energy[k] = cell(1, 0);
        }
        snprintf(words, sizeof words, "gradient " LIGHT "--method %s --x0 1,0.5", methods[i]);
        ck_assert_int_eq(fvi(words), 0);
        ck_assert_near(derivative("x0_1"), (energy[1] - energy[0]) / 0.002, 1e-8, "x0_1"); /* quadratic: to roundings / 0.002 */
        derivative("mass_1");
        ck_assert_ptr_nonnull(strstr(out, "# warning = no derivative by mass_2: the energy does not know the velocity"));
        snprintf(words, sizeof words, "gradient " LIGHT "--method %s --x0 1,0.5 --of x:1", methods[i]);
        ck_assert_int_eq(fvi(words), 0);
        derivative("mass_2");
    }
#undef LIGHT
}
END_TEST

/* With the past rl above the order 1 no other start of an elongation has a motion: c moves it, and b does not. */
START_TEST(a_name_must_not_stretch_a_damper_of_the_origin)
{
    ck_assert_int_eq(fvi("gradient --of x --method fvi-lobatto4d --potential 'x^2/2' --damper 'b*(x-c) : power:0.5,0.7 : rl' "
                         "--let c=1 --let b=1 --x0 1 --p0 0 --time 2 --steps 64"), 0);
    ck_assert_ptr_nonnull(strstr(out, "# warning = no derivative by c: by a constraint the start would have to follow it, or by a "
                                      "damper of the past rl that must not be stretched\n"));
    ck_assert_near(derivative("b"), 0.5368174, 1e-6, "b"); /* differences of runs: (-0.05654656659 + 0.05665393007)/2e-4 */
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("the program fvi: gradients of mechanisms");
    ADD_CASE(suite, "gradient", rows_of_a_mechanism_are_differences_of_runs,
             a_coordinate_without_mass_beside_a_constraint_has_a_gradient,
             several_powers_of_the_past_rl_are_as_many_dampers,
             rows_where_the_ground_moves_are_differences_of_runs, a_ground_may_jump_at_a_row,
             what_a_mechanism_has_no_row_of_is_said, a_place_that_would_stretch_a_damper_of_the_past_rl_has_no_row,
             why_a_mechanism_has_no_gradient_is_said, an_energy_without_inertia_has_derivatives,
             a_name_must_not_stretch_a_damper_of_the_origin);
    return run_suite_of_program(suite);
}
