/* tests/bench/bench_precision.c -- H 18: run time against error.
 *
 * Prints tab separated tables, which are kept in figures/step_search/step_search.tsv, and the sentences of the
 * chapter that say who is ahead: `make bench`, some minutes.
 *
 * The error is the largest |x_k - x(t_k)| over all coordinates and 80 times, evenly spaced in (0, T] (or those
 * with t >= 2, where the table says so). Each time is processor time. It includes everything that depends on the
 * problem, the steps or the tolerance. Runs near the front take turns, and the time is the best of 15 turns (5 if
 * a run takes more than 2 ms, 3 above 0.1 s). The time of another run is the best of at most 4 in a row. */
#define _POSIX_C_SOURCE 200809L /* clock_gettime, uname */
#include "bench.h"
#include "precision.h"

#include <gsl/gsl_math.h>
#include <stdlib.h>
#include <unistd.h>

static results r;
static small_times small;

static void find_truth(int P, double *truth)
{
    const problem *p = problem_number(P);
    double t[ROWS + 1];
    for (size_t k = 0; k <= ROWS; k++)
        t[k] = p->T * (double)k / ROWS;
    if (p->linear ? fvi_exact_at(p->linear, ROWS + 1, t, truth, NULL, NULL)
                  : reference(p, 16, p->panel, truth))
        exit(EXIT_FAILURE);
    printf("# P%d, %s: compared with %s\n", P + 1, p->what,
           p->linear ? "the exact solution of H 11"
                     : "collocation in long double, tests/bench/reference.c");
}

/* Print the load by other programs, so that a table that was made beside other work says so. */
static void print_load(void)
{
    double load = 0;
    FILE *file = fopen("/proc/loadavg", "r");
    if (file && fscanf(file, "%lf", &load) == 1)
        printf("# load when it began: %.1f, of other programs\n", load);
    if (file)
        fclose(file);
}

/* Return the path of build/fvi for build/tests/bench_precision. */
static const char *beside(const char *own)
{
    static char path[4096];
    const char *slash = strrchr(own, '/');
    snprintf(path, sizeof path, "%.*s/../fvi", slash ? (int)(slash - own) : 1,
             slash ? own : ".");
    return path;
}

int main(int argc, char **argv)
{
    static double truth[(ROWS + 1) * 1000];
    const int only =
        argc > 1 ? atoi(argv[1]) : 0; /* one problem alone, for trials */
    r.count = gather(r.all);
    describe();
    print_load();
    for (int P = 0; P < PROBLEMS; P++) {
        fronts front = { { 0 } };
        double least[OURS_EXACT + 1] = { GSL_POSINF, GSL_POSINF, GSL_POSINF };
        if (only && only != P + 1)
            continue;
        find_truth(P, truth);
        r.trials = 0;
        for (size_t j = 0; j < 2 * r.count; j++) { /* contenders that may be the fastest go first */
            const size_t i = j % r.count;
            const contender *c = &r.all[i];
            const int is_fast = c->peer || c->method->dense;
            if ((j < r.count) == is_fast && (!c->peer || c->peer->takes(problem_number(P))))
                sweep(&r, i, P, truth, front, &least[c->of]);
        }
        compare_in_turn(&r, P);
        for (size_t i = 0; i < r.count; i++)
            if (r.all[i].peer && r.all[i].peer->takes(problem_number(P))
                && r.best[P][i][1].seconds == 0)
                printf("# P%d: %s has not one digit\n", P + 1, r.all[i].name);
        printf(
            "# P%d: the least errors, of ours that step %.1e, of peers %.1e\n",
            P + 1, least[OURS_THAT_STEP], least[PEERS]);
        if (P % 3 == 0)
            time_small(beside(argv[0]), &small);
    }
    printf("\n\n");
    print_verdict(&r);
    print_ratios(&r);
    print_places(&r);
    print_picture(&r);
    for (int P = 0; P < PROBLEMS; P++)
        print_fronts(&r, P);
    print_memory(&r);
    print_small(&small);
    for (int P = 0; P < PROBLEMS; P++)
        print_methods(&r, P);
    if (isatty(STDERR_FILENO))
        fprintf(stderr, "\r%60s\r", "");
    return EXIT_SUCCESS;
}
