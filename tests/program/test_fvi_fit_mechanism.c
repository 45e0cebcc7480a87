/* tests/program/test_fvi_fit_mechanism.c -- The command `fvi fit` with a moving ground, Lagrangians, constraints,
 * forces of velocity and imposed coordinates.
 * Run alone: make test-fvi_fit_mechanism */
#define _GNU_SOURCE
#include "fit_rows.h"

/* A problem with its true numbers, another guess, and what is to come out. */
typedef struct {
    const char *problem, *truth, *guess, *fit, *columns;
    const char *names[3];
    double want[3];
} fitted;

static const fitted cases[] = {
    { "--ground '0.5*sin(2*t)' --x0 0 --p0 0", "--alpha 0.3 --rho 0.4", "--alpha 0.4 --rho 0.2", "alpha,rho", "x",
      { "alpha", "rho" }, { 0.3, 0.4 } },
    { "--ground 'k*sin(2*t)' --along 1,2 --potential 'x1^2+(x2-x1)^2' --x0 0 --p0 0 --rho 0.1", "--let k=0.5", "--let k=0.3",
      "k", "x1,x2", { "k" }, { 0.5 } },
    { "--potential 'k*x1^2/2+(x2-x1)^2' --force-on '1=-0.3*v1*abs(v1)' --x0 1,0 --p0 0,0.25",
      "--let k=2 --damper 'd=x2-x1 : power:0.5,0.3'", "--let k=1.5 --damper 'd=x2-x1 : power:0.3,0.2'",
      "k,d.rho,d.alpha", "x1,v2", { "k", "d.rho", "d.alpha" }, { 2, 0.5, 0.3 } },
    { "--lagrangian '(v1^2+v2^2)/2 - k*(sqrt(x1^2+x2^2)-1)^2 - x2' --x0 1.25,0 --p0 0.25,0.75",
      "--let k=2 --damper 's=sqrt(x1^2+x2^2) : power:0.4,0.3'", "--let k=1.8 --damper 's=sqrt(x1^2+x2^2) : power:0.3,0.2'",
      "k,s.rho,s.alpha", "x1,x2", { "k", "s.rho", "s.alpha" }, { 2, 0.4, 0.3 } },
    { "--lagrangian '(1.5+x^2)*v^2/2 - c*x^2/2' --x0 1 --p0 0.5", "--let c=2 --damper 'd=x : power:0.4,0.3'",
      "--let c=1.5 --damper 'd=x : power:0.3,0.3'", "c,d.rho,p0", "v", { "c", "d.rho", "p0" }, { 2, 0.4, 0.5 } },
    { "--lagrangian '(v1^2+v2^2)/2 - g*x2' --constraint '(x1^2+x2^2-1)/2' --x0 1,0 --p0 0,0.5",
      "--let g=1 --damper 's=sqrt((x1-1.5)^2+x2^2) : power:0.4,0.3'",
      "--let g=1.2 --damper 's=sqrt((x1-1.5)^2+x2^2) : power:0.3,0.2'", "g,s.rho,s.alpha", "x1,x2",
      { "g", "s.rho", "s.alpha" }, { 1, 0.4, 0.3 } },
    { "--potential 'k*(x2-x1)^2/2' --impose 'x1=0.3*sin(2*t)' --x0 0,0.25 --p0 0.6,0",
      "--let k=2 --damper 's=x2-x1 : power:0.4,0.3'", "--let k=1.5 --damper 's=x2-x1 : power:0.3,0.2'",
      "k,s.rho,s.alpha", "x2", { "k", "s.rho", "s.alpha" }, { 2, 0.4, 0.3 } },
};

/* Rows of a run with these steps, rounded to seven digits, give back what was put in. */
START_TEST(fit_takes_what_a_run_takes)
{
    const fitted *f = &cases[_i];
    char line[900];
    snprintf(line, sizeof line, "run %s %s --method fvi-lobatto4 --h 0.05 --steps 160 --columns t,%s -o data.tsv", f->problem,
             f->truth, f->columns);
    ck_assert_msg(fvi(line) == 0, "%s: %s", line, err);
    snprintf(line, sizeof line, "fit %s %s --method fvi-lobatto4 --h 0.05 --starts 6 --fit %s --compare %s data.tsv", f->problem,
             f->guess, f->fit, f->columns);
    fvi(line);
    for (int n = 0; n < 3 && f->names[n]; n++) {
        double row[4];
        row_of(f->names[n], row);
        ck_assert_msg(fabs(row[0] - f->want[n]) <= 1e-5, "%s: %s = %.9g, not %g", line, f->names[n], row[0], f->want[n]);
    }
}
END_TEST

/* What the words of the problem have made of a number that would change. */
START_TEST(what_would_break_the_start_is_not_fitted)
{
    ck_assert_int_eq(fvi("run --steps 20 --potential chain:2,1,0 --columns t,x -o data.tsv"), 0);
    ck_assert_refused("fit data.tsv --compare x1,x2 --potential chain:2,1,0 --ground t --fit Mass",
                      "fvi: --fit: 'Mass': the ground pulls each mass by -m a_g, and would keep the old one");
    ck_assert_refused("fit data.tsv --compare x1,x2 --lagrangian '(v1^2+v2^2)/2' --x0 1 --p0 0 --fit mass",
                      "fvi: --fit: 'mass': the masses are those of the Lagrangian");
    ck_assert_refused("fit data.tsv --compare x1,x2 --potential '(x2-x1)^2' --impose 'x1=sin(t)' --x0 0 --p0 1,0 --fit p0_2",
                      "fvi: --fit: 'p0_2': with another one the start breaks a constraint");
    ck_assert_refused("fit 'data.tsv : force=t' --compare x1,x2 --potential chain:2,1,0 --ground t --fit c",
                      "fvi: --ground: not together with a force of its own of a record, which would take its place");
    ck_assert_refused("fit data.tsv --compare x1,x2 --lagrangian '(v1^2+v2^2)/2' --let l=1 --constraint 'x1^2+x2^2-l' --x0 1,0 "
                      "--p0 0,1 --fit l",
                      "fvi: --fit: 'l': with another one the start breaks a constraint");
}
END_TEST

/* A fit follows a coordinate without inertia by form D of the methods with stages, at the nodes of its
 * steps and between them; data are rounded to seven digits. */
START_TEST(fit_takes_a_coordinate_without_inertia)
{
    static const char *const steps[] = { "", "--h 0.05", "--h 0.03", "--method fvi-adaptive" };
    const char *body = "--mass 1,0 --potential 'x1^2/2+(x1-x2)^2' --x0 1,1 --p0 0.5,0";
    char line[900];
    snprintf(line, sizeof line, "run %s --damper 'd=x2 : power:1,0.3' --method fvi-lobatto4d --h 0.05 --steps 160 "
             "--columns t,x -o data.tsv", body);
    ck_assert_msg(fvi(line) == 0, "%s: %s", line, err);
    for (size_t i = 0; i < LEN(steps); i++) {
        double rho[4], alpha[4];
        snprintf(line, sizeof line, "fit %s --damper 'd=x2 : power:0.8,0.25' %s --starts 6 --fit d.rho,d.alpha --compare x1,x2 "
                 "data.tsv", body, steps[i]);
        fvi(line);
        row_of("d.rho", rho);
        row_of("d.alpha", alpha);
        ck_assert_msg(fabs(rho[0] - 1) <= 1e-5 && fabs(alpha[0] - 0.3) <= 1e-5, "%s: %.9g, %.9g", line, rho[0], alpha[0]);
    }
}
END_TEST

/* The reason is that of the method, and not a search that found no motion. */
START_TEST(a_coordinate_without_inertia_is_refused_with_its_reason)
{
    static const char *const fits[][2] = {
        { "--p0 0.5,0 --fit d.rho --method fvi-lobatto4", "fvi: --mass: coordinate 2 has no inertia, and no damper of an order above 1" },
        { "--p0 0.5,0.25 --fit d.rho", "fvi: --p0: p2 is off by 0.25: this coordinate has no inertia" },
        { "--p0 0.5,0 --fit mass", "fvi: --fit: 'mass': a coordinate without inertia has no other mass, and no momentum" },
        { "--p0 0.5,0 --fit p0_2", "fvi: --fit: 'p0_2': a coordinate without inertia has no other mass, and no momentum" },
    };
    char line[900];
    ck_assert_int_eq(fvi("run --steps 20 --potential chain:2,1,0 --columns t,x -o data.tsv"), 0);
    for (size_t i = 0; i < LEN(fits); i++) {
        snprintf(line, sizeof line, "fit --mass 1,0 --potential 'x1^2/2+(x1-x2)^2' --x0 1,1 --damper 'd=x2 : power:1,0.3' "
                 "--compare x1,x2 data.tsv %s", fits[i][0]);
        ck_assert_refused_with(line, fits[i][1]);
    }
}
END_TEST

/* The standard deviations of a plan are those of a fit of such data: both are square roots of the
 * inverse of one matrix. Without noise the fit ends at the truth, rounded to seven digits; seen: 4e-5. */
START_TEST(a_plan_takes_a_mechanism)
{
    const char *body = "--let c=2 --lagrangian '(1.5+x^2)*v^2/2-c*x^2/2' --x0 1 --p0 0.5 --damper 'd=x : power:0.4,0.3'",
               *names[] = { "c", "d.rho", "d.alpha" };
    char line[900];
    double planned[3][4], found[4];
    snprintf(line, sizeof line, "fit --design %s --sigma 0.02 --fit c,d.rho,d.alpha --h 0.05 --steps 160", body);
    ck_assert_msg(fvi(line) == 0, "%s: %s", line, err);
    for (size_t j = 0; j < LEN(names); j++)
        row_of(names[j], planned[j]);
    snprintf(line, sizeof line, "run %s --method fvi-lobatto4 --h 0.05 --steps 160 --columns t,x -o data.tsv", body);
    ck_assert_msg(fvi(line) == 0, "%s: %s", line, err);
    snprintf(line, sizeof line, "fit %s --sigma 0.02 --fit c,d.rho,d.alpha --starts 2 data.tsv", body);
    fvi(line);
    for (size_t j = 0; j < LEN(names); j++) {
        row_of(names[j], found);
        ck_assert_msg(fabs(planned[j][1] / found[1] - 1) <= 1e-3, "%s: %g, %g", names[j], planned[j][1], found[1]);
    }
    ck_assert_refused("fit --design --potential '(x1-x2)^2' --damper 'd=x2-x1 : viscous:1' --sigma 0.02 --fit d.rho",
                      "fvi: --potential: '(x1-x2)^2' has 2 masses: --design plans a test of one column, x of one mass");
    ck_assert_refused("fit --design --mass 0 --potential 'x^2' --damper 'd=x : power:1,0.3' --p0 0.5 --sigma 0.02 --fit d.rho",
                      "fvi: --p0: p1 is off by 0.5: this coordinate has no inertia");
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("the program fvi: fits of mechanisms");
    TCase *loop = tcase_create("recovers");
    tcase_set_timeout(loop, 120);
    tcase_add_loop_test(loop, fit_takes_what_a_run_takes, 0, (int)LEN(cases));
    suite_add_tcase(suite, loop);
    ADD_CASE(suite, "refused", what_would_break_the_start_is_not_fitted,
             a_coordinate_without_inertia_is_refused_with_its_reason);
    ADD_CASE(suite, "without inertia", fit_takes_a_coordinate_without_inertia);
    ADD_CASE(suite, "plans", a_plan_takes_a_mechanism);
    return run_suite_of_program(suite);
}
