/* tests/course/test_body_01.c -- The Course, stage 01: a body that remembers. */
#define _POSIX_C_SOURCE 200809L
#include <stdio.h>
#include <unistd.h>

#ifndef STAGE
#define STAGE "course/body_01.c"
#endif
#include "stage.h"

/* The 18 lines print t, x and p: read them back from a file. 15 digits are printed, which
 * is 5e-16 of numbers below 1. */
START_TEST(eq_1c_the_rows_are_those_of_the_definition)
{
    FILE *rows = tmpfile();
    int screen = dup(1);
    fflush(stdout);
    ck_assert(rows != NULL && dup2(fileno(rows), 1) >= 0);
    body_main();
    fflush(stdout);
    dup2(screen, 1);
    rewind(rows);
    for (int n = 1; n <= 140; n++) {
        double t, place, momentum, bound = rounding_of_run(n, 0.16) + 5e-16;
        ck_assert_msg(fscanf(rows, "%lf %lf %lf", &t, &place, &momentum) == 3,
                      "row %d of what is printed is not three numbers, t, x and p", n);
        ck_assert_near(t, n * 0.1, 0.05, "time of row %d", n);
        ck_assert_near(place, ref_first[n].x, bound, "x of row %d", n);
        ck_assert_near(momentum, ref_first[n].p, bound, "p of row %d", n);
    }
    ck_assert_msg(fscanf(rows, "%*s") == EOF, "more is printed than 140 rows");
    fclose(rows);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("stage 01");
    ADD_CASE(suite, "a body that remembers", eq_1c_the_rows_are_those_of_the_definition);
    return run_suite(suite);
}
