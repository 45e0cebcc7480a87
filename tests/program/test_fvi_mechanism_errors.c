/* tests/program/test_fvi_mechanism_errors.c -- The program build/fvi: the messages for wrong Lagrangians, dampers
 * and constraints.
 * Run alone: make test-fvi_mechanism_errors */
#define _GNU_SOURCE
#include "program.h"

#define ROD "run --lagrangian '(v1^2+v2^2)/2 - x2' --x0 1,0 --steps 40 "
#define RING "--constraint 'x1^2+x2^2-1' "

/* Every text that is wrong is shown, and what does not go together is said. */
START_TEST(wrong_words_are_refused)
{
    static const char *const cases[][2] = {
        { "run --lagrangian '(v1^2+v2^2/2' --x0 1 --v0 0",
          "fvi: --lagrangian: '(v1^2+v2^2/2': a ) is missing\n" },
        { "run --lagrangian 'v3^2' --dimension 2 --x0 1 --v0 0",
          "fvi: --lagrangian: 'v3^2': no such name\n                    ^" },
        { "run --lagrangian 'v^2/2' --x0 1", "fvi: --lagrangian: a start is missing" },
        { "run --lagrangian 'v^2/2' --v0 1", "fvi: --lagrangian: a start is missing" },
        { "run --lagrangian 'v^2/2' --x0 1 --v0 0 --mass 1",
          "fvi: --lagrangian: not together with --mass" },
        { "run --lagrangian 'v^2/2' --x0 1 --v0 0 --rho 1",
          "fvi: --lagrangian: not together with --rho" },
        { "run --lagrangian 'v^2/2' --x0 1 --v0 0 --p0 0",
          "fvi: --v0: not together with --p0" },
        { "run --lagrangian 'v^2/2' --x0 1 --v0 0 --method fvi-bdf2",
          "fvi: --method: 'fvi-bdf2' takes no Lagrangian" },
        { "run --lagrangian 'v^2/2' --x0 0 --v0 0 --step-error 1e-6 --method fvi-stable",
          "fvi: --step-error: '1e-6' is not for fvi-stable" },
        { "run --constraint x1 --x0 1 --v0 0 --error 1e-6",
          "fvi: --x0: it does not keep to the constraint 'x1'" },
        { "run --lagrangian 'x^2' --x0 1 --v0 0 --p0 1",
          "fvi: --v0: not together with --p0" },
        { "run --lagrangian 'x^2' --x0 1 --p0 1",
          "fvi: --p0: p1 is off by 1: this coordinate has no inertia" },
        { "run --lagrangian '(v1+v2)^2' --x0 1 --p0 1",
          "fvi: --lagrangian: its second derivatives by the velocities are a "
          "singular matrix" },
        { "run --damper 'x : power:1,0.3' --alpha 0.3",
          "fvi: --damper: not together with --alpha" },
        { "run --damper 'x:power:1,0.3'",
          "fvi: --damper: 'x:power:1,0.3' is not '[NAME=] G : LAW [: PAST]'" },
        { "run --damper 'x : powr:1,0.3'", "did you mean power?" },
        { "run --damper 'x : power:1,0.3 : heldd'", "did you mean held?" },
        { "run --damper 'x+z : power:1,0.3'",
          "fvi: --damper: 'x+z': no such name\n                  ^" },
        { "run --damper 'x+v : power:1,0.3'", "fvi: --damper: 'x+v': no such name" },
        { "run --damper 'a=x : viscous:1' --damper 'a=x : spring:1'",
          "fvi: --damper: 'a' is the name of two dampers" },
        { "run --damper 'd2=x : viscous:1' --damper 'x : spring:1'",
          "fvi: --damper: 'd2' is the name of two dampers: one without a name is called so by its place" },
        { "run --damper 'x : viscous:1' --damper 'd1=x : spring:1'",
          "fvi: --damper: 'd1' is the name of two dampers" },
        { "run --damper 'event1=x : viscous:1' --event 'x : mark' --columns t,event1.force",
          "fvi: --damper: 'event1' is the name of an event in columns, as in event1.force: give the damper another "
          "one\n" },
        { "run --damper 'x : distributed:1,0.2,0.9 : caputo'",
          "fvi: --damper: damper 1: above the order 1 only a power alone has Caputo's" },
        { "run --damper 'x : spring:1' --damper 'x : symbol:0.4*s^0.6/(1+2*s)' --method fvi-lobatto3d",
          "fvi: --damper: damper 2: the tail of its law is no sum of decaying modes; fvi and fvi-stable take it\n" },
        { "run --damper 'x : spring:1' --damper 'x : symbol:0.4*s^0.6/(1+2*s)' --memory exponentials",
          "fvi: --damper: damper 2: its law is no sum of exponentials with this step; the memory auto sums it all\n" },
        { "run --damper 'x : power:1,0.7 : rl' --method fvi-stable",
          "fvi: --damper: the past rl of damper 1 wants powers of order 1" },
        { "run --damper 'sqrt(x-1) : viscous:1' --x0 1",
          "fvi: --damper: the elongation of d1, or its slope, is not finite at x0" },
        { "run --damper 'k=sqrt(x-1) : viscous:1' --x0 1 --method fvi-adaptive",
          "fvi: --damper: the elongation of k, or its slope" },
        { "run --damper 'log(x) : viscous:1' --x0 0 --method fvi-stable",
          "fvi: --damper: the elongation of d1" },
        { "run --lagrangian '(v1^2+v2^2)/2' --x0 0,1 --v0 1,1 --impose 'x1=t' --impose 'x1=t'",
          "fvi: --impose: 'x1=t' is redundant" },
        { "run --force-on '2=v'", "fvi: --force-on: 'v': no such name" },
        { "run --force-on '0=v'", "fvi: --force-on: '0=v' is not I=F" },
        { "run --force-on 'v'", "fvi: --force-on: 'v' is not I=F" },
        { "run --force 'x*t'", "a force knows t alone; --force-on knows x and v" },
        { "run --impose 'y=t'", "fvi: --impose: 'y=t' is not xI=EXPRESSION" },
        { "run --impose 'x1=v1'", "fvi: --impose: 'v1': no such name" },
        { "run --impose 'x1=sqrt(t-1)' --x0 0 --v0 0",
          "fvi: --x0: the constraint 'x1=sqrt(t-1)' is not a number there" },
        { "run --impose 'x1=t' --x0 0 --v0 2",
          "fvi: --p0: p1 is off by 1: the velocity does not keep" },
        { "run --constraint 'x1' --method fvi",
          "fvi: --constraint: this method takes no constraints; fvi-stable, fvi-lobatto2 to 8, 2d" },
        { ROD RING "--v0 0.1,0", "fvi: --p0: p1 is off by 0.1: the velocity" },
        { "run --lagrangian '(v1^2+v2^2)/2' --x0 2,0 --v0 0 " RING,
          "fvi: --x0: it does not keep to the constraint 'x1^2+x2^2-1'" },
        { ROD RING "--constraint '2*x1^2+2*x2^2-2' --v0 0",
          "fvi: --constraint: '2*x1^2+2*x2^2-2' is redundant" },
        { "run --lagrangian '(v1^2+v2^2)/2' --x0 0 --v0 0 --constraint 'x1*x2'",
          "fvi: --constraint: 'x1*x2' has no gradient at x0" },
        { "run --mass 0 --rho 1 --alpha 0.3 --method fvi-bdf2 --p0 0",
          "fvi: --method: 'fvi-bdf2' takes no Lagrangian" },
        { "run --mass 0 --v0 5", "fvi: --v0: v1 is 5: this coordinate has no inertia" },
        { "run --mass 1,0 --potential '(x1-x2)^2' --v0 1", "fvi: --v0: v2 is 1: this coordinate has no inertia" },
        { "run --lagrangian 'v1^2-x2^2-x1*x2' --x0 0 --v0 1,-2", "fvi: --v0: v2 is -2: this coordinate has no inertia" },
        { "run --impose x2=2*t --dimension 2 --x0 0 --v0 1,2 --columns reaction1",
          "balance, y, multiplier1, reaction2, d2.force, nor an expression; did you mean reaction2?" },
        { "run --constraint x1-x2 --x0 1 --p0 0 --columns reaction1", "balance, y, multiplier1, " },
        { "fit --mass 0 data", "" },
        { "gradient --mass 0", "fvi: --mass: '0' is not for gradient" },
        { "gradient --lagrangian 'v^2'", "a start is missing" },
        { "run --lagrangian 'v^2' --x0 1 --v0 0 --let v=2", "fvi: --let: 'v' is a velocity in 'v^2'" },
    };
    for (size_t i = 0; i < LEN(cases); i++) {
        if (strcmp(cases[i][1], "") == 0)
            continue;
        ck_assert_msg(fvi(cases[i][0]) == 2, "%s: %s", cases[i][0], err);
        ck_assert_msg(strstr(err, cases[i][1]), "%s: %s", cases[i][0], err);
        ck_assert_str_eq(out, "");
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("fvi_mechanism_errors");
    ADD_CASE(suite, "mechanisms", wrong_words_are_refused);
    return run_suite_of_program(suite);
}
