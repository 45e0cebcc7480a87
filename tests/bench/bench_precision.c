/* tests/bench/bench_precision.c -- Chapter 18: run time against error. Prints tab separated
 * tables to be kept in figures/step_search/step_search.tsv, and the sentences of the chapter
 * that say who is ahead: `make bench`, some minutes.
 *
 * The error is the largest of |x_k - x(t_k)| over all coordinates and 80 times, evenly
 * between 0 and T, from the first on (or from t = 2 on, where that is said). A time is
 * processor time, the best of 9 runs (of 3, if they take more than 0.1 s), and holds
 * all that the problem, the steps or the tolerance decide. */
#define _POSIX_C_SOURCE 200809L /* clock_gettime, uname */
#include "bench.h"
#include "precision.h"

#include <gsl/gsl_math.h>
#include <stdlib.h>
#include <unistd.h>

static contender all[MOST_CONTENDERS];
static size_t count;
static timing best[PROBLEMS][MOST_CONTENDERS][DECADES + 1],
    late[PROBLEMS][MOST_CONTENDERS][DECADES + 1];

/* ---- the truth ---- */

static void find_truth(int P, double *truth)
{
    const problem *p = problem_number(P);
    double t[ROWS + 1];
    for (size_t k = 0; k <= ROWS; k++)
        t[k] = p->T * (double)k / ROWS;
    if (p->linear ? fvi_exact(p->linear, ROWS + 1, t, truth, NULL)
                  : reference(p, 16, p->panel, truth))
        exit(EXIT_FAILURE);
    printf("# P%d, %s: compared with %s\n", P + 1, p->what,
           p->linear ? "the exact solution of chapter 11"
                     : "collocation in long double, tests/bench/reference.c");
}

/* ---- tables ---- */

/* The fastest of ours, or of the peers, at decade k; NULL if none is as exact. */
static const timing *fastest(timing from[][DECADES + 1], int ours, int k,
                             size_t *who)
{
    const timing *least = NULL;
    for (size_t i = 0; i < count; i++)
        if (all[i].ours == ours && from[i][k].seconds > 0
            && (!least || from[i][k].seconds < least->seconds)) {
            least = &from[i][k];
            *who = i;
        }
    return least;
}

/* Ours over the best peer; 0 if no peer is as exact, infinite if we are not. */
static double ratio(timing from[][DECADES + 1], int k)
{
    size_t i;
    const timing *a = fastest(from, 1, k, &i), *b = fastest(from, 0, k, &i);
    return a ? b ? a->seconds / b->seconds : 0 : b ? GSL_POSINF : NAN;
}

static void write_number(char *to, size_t n, double x)
{
    if (x > 0 && x < GSL_POSINF)
        snprintf(to, n, "%.3g", x);
    else
        snprintf(to, n, "%s", x == 0 ? "ours alone" : x > 0 ? "peers alone" : "-");
}

/* Padded too, to be read as they are. */
static void print_fronts(int P)
{
    static const char row[] =
        "%-7s\t%-7s\t%-7s\t%-24s\t%-7s\t%-7s\t%-22s\t%-11s\t%s\n";
    printf("# P%d, %s: the fastest, by error\n#> fronts-%d\n", P + 1,
           problem_number(P)->what, P + 1);
    printf(row, "# error", "our ms", "spread", "ours", "peer ms", "spread", "peer",
           "ours / peer", "the same, t >= 2");
    for (int k = 1; k <= DECADES; k++) {
        char error[8], ms[2][16], spread[2][16], over[2][16];
        const char *names[2] = { "-", "-" };
        snprintf(error, sizeof error, "1e-%02d", k);
        for (int peers_ = 0; peers_ < 2; peers_++) {
            size_t who;
            const timing *t = fastest(best[P], !peers_, k, &who);
            write_number(ms[peers_], sizeof *ms, t ? 1e3 * t->seconds : NAN);
            write_number(spread[peers_], sizeof *spread, t ? t->spread : NAN);
            names[peers_] = t ? all[who].name : "-";
        }
        write_number(over[0], sizeof *over, ratio(best[P], k));
        write_number(over[1], sizeof *over, ratio(late[P], k));
        printf(row, error, ms[0], spread[0], names[0], ms[1], spread[1], names[1],
               over[0], over[1]);
    }
    printf("#< fronts-%d\n\n\n", P + 1);
}

/* Milliseconds of every method, by error. For the picture: the same in two columns. */
static void print_methods(int P)
{
    printf("# P%d: ms of each method, by error\n#> methods-%d\n# %-22s", P + 1,
           P + 1, "method");
    for (int k = 1; k <= DECADES; k++)
        printf("\t1e-%02d", k);
    printf("\n");
    for (size_t i = 0; i < count; i++) {
        if (best[P][i][1].seconds == 0)
            continue;
        printf("%-24s", all[i].name);
        for (int k = 1; k <= DECADES; k++)
            if (best[P][i][k].seconds > 0)
                printf("\t%.3g", 1e3 * best[P][i][k].seconds);
            else
                printf("\t-");
        printf("\n");
    }
    printf("#< methods-%d\n\n\n", P + 1);
}

static void print_ratios(void)
{
    printf("# our time over that of the best peer, by error over all rows\n"
           "#> ratios\n# problem");
    for (int k = 1; k <= DECADES; k++)
        printf("\t1e-%02d", k);
    printf("\n");
    for (int P = 0; P < PROBLEMS; P++) {
        printf("P%-8d", P + 1);
        for (int k = 1; k <= DECADES; k++) {
            char over[16];
            write_number(over, sizeof over, ratio(best[P], k));
            printf("\t%s", over);
        }
        printf("\n");
    }
    printf("#< ratios\n\n\n");
}

/* ---- sentences ---- */

/* "1e-3 to 1e-6, 1e-9": the decades of P of which `ours` is true. */
static int decades(int P, int ours, char *to, size_t n)
{
    int found = 0, begin = 0;
    size_t at = 0;
    to[0] = 0;
    for (int k = 1; k <= DECADES + 1; k++) {
        const double r = k <= DECADES ? ratio(best[P], k) : NAN;
        const int is = ours ? r < 1 : r >= 1;
        found += is;
        if (is && !begin)
            begin = k;
        if (!is && begin) {
            at += (size_t)snprintf(to + at, n - at, "%s1e-%d", at ? ", " : "",
                                   begin);
            if (k - 1 > begin)
                at += (size_t)snprintf(to + at, n - at, " to 1e-%d", k - 1);
            begin = 0;
        }
    }
    return found;
}

/* Who is ahead on P, where, and by how much at most. */
static void print_sentence(int P)
{
    char mine[200], theirs[200];
    const int a = decades(P, 1, mine, sizeof mine),
              b = decades(P, 0, theirs, sizeof theirs);
    double least = GSL_POSINF, most = 0;
    int at = 1;
    for (int k = 1; k <= DECADES; k++) {
        const double r = ratio(best[P], k);
        if (r > 0 && r < least)
            least = r;
        if (r > most && r < GSL_POSINF) {
            most = r;
            at = k;
        }
    }
    printf("- **P%d**, %s: ", P + 1, problem_number(P)->what);
    if (a + b == 0)
        printf("nobody has a digit.\n");
    else if (b == 0)
        printf("ours is ahead at every error that anybody reached, %s.\n", mine);
    else if (a == 0)
        printf("a peer is ahead at every error that anybody reached, %s", theirs);
    else
        printf("ours is ahead at %s, a peer at %s", mine, theirs);
    if (b && most > 1) {
        size_t who = 0;
        fastest(best[P], 0, at, &who);
        printf(";\n  most at 1e-%d, where ours takes %.3g times as long as %s.\n", at,
               most, all[who].name);
    } else if (b) {
        printf(".\n");
    }
}

static void print_verdict(void)
{
    int a = 0, b = 0;
    char none[200];
    for (int P = 0; P < PROBLEMS; P++) {
        a += decades(P, 1, none, sizeof none);
        b += decades(P, 0, none, sizeof none);
    }
    printf("# who is ahead, in words\n#> verdict\n");
    if (b == 0)
        printf("Of %d places, eleven problems by thirteen errors as far as anybody reached "
               "them,\nours is ahead at all.\n\n", a);
    else
        printf("Of %d places, eleven problems by thirteen errors as far as anybody reached "
               "them,\nours is ahead at %d, **a peer at %d**.\n\n", a + b, a, b);
    for (int P = 0; P < PROBLEMS; P++)
        print_sentence(P);
    printf("#< verdict\n\n\n");
}

/* Our time at 1e-12 over rk8pd's on the oscillator without memory. */
static void print_memory(void)
{
    static const int with[] = { 0, 2, 3, 4, 8 };
    double oscillator = 0;
    for (size_t i = 0; i < count; i++)
        if (strncmp(all[i].name, "rk8pd", 5) == 0 && best[1][i][12].seconds > 0
            && (oscillator == 0 || best[1][i][12].seconds < oscillator))
            oscillator = best[1][i][12].seconds;
    printf("# what memory costs: our ms at 1e-12, and that over rk8pd's on P2\n"
           "#> memory\n# problem\tms\tover rk8pd\nrk8pd, P2\t%.3g\t1\n",
           1e3 * oscillator);
    for (size_t i = 0; i < sizeof with / sizeof *with; i++) {
        size_t who;
        const timing *t = fastest(best[with[i]], 1, 12, &who);
        if (t)
            printf("P%d       \t%.3g\t%.3g\n", with[i] + 1, 1e3 * t->seconds,
                   t->seconds / oscillator);
        else
            printf("P%d       \t-\t-\n", with[i] + 1);
    }
    printf("#< memory\n\n\n");
}

/* build/tests/bench_precision -> build/fvi */
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
    const int only = argc > 1 ? atoi(argv[1]) : 0; /* while something is tried */
    count = gather(all);
    describe();
    for (int P = 0; P < PROBLEMS; P++) {
        double front[2][DECADES + 1] = { { 0 } }; /* of the peers, of ours */
        if (only && only != P + 1)
            continue;
        find_truth(P, truth);
        for (size_t i = count; i-- > 0;)
            if (all[i].peer ? all[i].peer->takes(problem_number(P)) : 1)
                sweep(&all[i], P, truth, best[P][i], late[P][i],
                      front[all[i].ours]);
    }
    printf("\n\n");
    print_verdict();
    print_ratios();
    for (int P = 0; P < PROBLEMS; P++)
        print_fronts(P);
    print_memory();
    print_small(beside(argv[0]));
    for (int P = 0; P < PROBLEMS; P++)
        print_methods(P);
    if (isatty(STDERR_FILENO))
        fprintf(stderr, "\r%60s\r", "");
    return EXIT_SUCCESS;
}
