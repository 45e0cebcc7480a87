/* tests/program/test_fvi_own_codes.c -- The program build/fvi: each command that calls a potential of the user
 * reports its error code, in the command's own words.
 * Run alone: make test-fvi_own_codes */
#define _GNU_SOURCE
#include "program.h"

START_TEST(the_code_of_a_potential_of_ones_own_is_said)
{
    if (shell("command -v cc > /dev/null") != 0)
        return;
    write_file("my.c",
               "#include <fvi/system.h>\n"
               "static int value(size_t d, const double *x, void *p, double *U)"
               "{ (void)d, (void)p; *U = x[0] * x[0] / 2; return 0; }\n"
               "static int gradient(size_t d, const double *x, void *p, double "
               "*g) { (void)d, (void)p; *g = *x; return *x < 0.5 ? -7 : 0; }\n"
               "static int hessian(size_t d, const double *x, void *p, double "
               "*H) { (void)d, (void)p, (void)x; *H = 1; return 0; }\n"
               "const fvi_potential fvi_user_potential = { .value = value, "
               ".gradient = gradient, .hessian = hessian };\n"
               "#ifdef WORDS\n"
               "const char *fvi_user_error(int code);\n"
               "const char *fvi_user_error(int code)"
               "{ return code == -7 ? \"the beam\\nhas buckled\" : 0; }\n"
               "#endif\n");
    ck_assert_int_eq(shell(_i == 0 ? "cc -shared -fPIC -I\"$SOURCES\" my.c -o my.so"
                                   : "cc -DWORDS -shared -fPIC -I\"$SOURCES\" "
                                     "my.c -o my.so"),
                     0);
    ck_assert_int_eq(fvi("run --columns t,x -o data"), 0);
    static const char *const commands[] = {
        "run --potential my.so", "run --potential my.so --error 1e-3",
        "gradient --potential my.so --of x",
        "sweep --potential my.so --vary p0=0:0.1:2",
        "fit --potential my.so data"
    };
    for (size_t i = 0; i < LEN(commands); i++) {
        ck_assert_int_eq(fvi(commands[i]), 1);
        ck_assert_msg(
            strstr(err, _i == 0 ? "an error of the caller's own functions, code -7\n"
                                : "code -7: the beam?has buckled\n"),
            "%s: %s", commands[i], err);
    }
}
END_TEST

int main(void)
{
    char *sources = realpath("src", NULL);
    setenv("SOURCES", sources ? sources : "src", 1);
    free(sources);
    Suite *suite = suite_create("the program fvi: codes of one's own");
    ADD_LOOP(suite, the_code_of_a_potential_of_ones_own_is_said, 2); /* without words, and with */
    return run_suite_of_program(suite);
}
