/* tests/run/trajectories.c -- The runs of many_runs.h, a line each: what they
 * are computed with, their name, their status, x and p as hexadecimal numbers. */
#include "many_runs.h"

int main(void)
{
    static const char *const with[] = { "arithmetic", "linear algebra",
                                        "functions" };
    for (size_t i = 0; i < MANY; i++) {
        many_run r;
        many_run_of(i, &r);
        printf("%s\t%s\t%d\t", with[r.with], r.name, r.status);
        for (size_t j = 0; j < r.count; j++)
            printf(" %a", r.row[j]);
        putchar('\n');
    }
    return 0;
}
