/* tests/bench/precision_tables.c -- Print the tables of the benchmark: precision.h. [H 18] */
#include "precision.h"
#include "system/larger.h"

#include <gsl/gsl_math.h>
#include <stdio.h>
#include <string.h>

const timing *fastest(const results *r, const timing from[][DECADES + 1],
                      side first, side last, int k, size_t *who)
{
    const timing *least = NULL;
    for (size_t i = 0; i < r->count; i++)
        if (r->all[i].of >= first && r->all[i].of <= last
            && from[i][k].seconds > 0
            && (!least || from[i][k].seconds < least->seconds)) {
            least = &from[i][k];
            *who = i;
        }
    return least;
}

double ratio(const results *r, const timing from[][DECADES + 1], side ours,
             int k)
{
    size_t i;
    const timing *a = fastest(r, from, OURS_THAT_STEP, ours, k, &i),
                 *b = fastest(r, from, PEERS, PEERS, k, &i);
    return a ? b ? a->seconds / b->seconds : 0 : b ? GSL_POSINF : NAN;
}

static void write_number(char *to, size_t n, double x)
{
    if (x > 0 && x < GSL_POSINF)
        snprintf(to, n, "%.3g", x);
    else
        snprintf(to, n, "%s",
                 x == 0  ? "ours alone"
                 : x > 0 ? "peers alone"
                         : "-");
}

/* The columns are padded so that the file can be read as it is. */
void print_fronts(const results *r, int P)
{
    static const char row[] =
        "%-7s\t%-7s\t%-7s\t%-24s\t%-7s\t%-7s\t%-22s\t%-11s\t%-11s\t%s\n";
    printf("# P%d, %s: the fastest, by error\n#> fronts-%d\n", P + 1,
           problem_number(P)->what, P + 1);
    printf(row, "# error", "our ms", "spread", "ours", "peer ms", "spread",
           "peer", "ours / peer", "by steps", "t >= 2");
    for (int k = 1; k <= DECADES; k++) {
        char error[8], ms[2][16], spread[2][16], over[3][16];
        const char *names[2] = { "-", "-" };
        snprintf(error, sizeof error, "1e-%02d", k);
        for (int peers_ = 0; peers_ < 2; peers_++) {
            size_t who;
            const timing *t =
                fastest(r, r->best[P], peers_ ? PEERS : OURS_THAT_STEP,
                        peers_ ? PEERS : OURS_EXACT, k, &who);
            write_number(ms[peers_], sizeof *ms, t ? 1e3 * t->seconds : NAN);
            write_number(spread[peers_], sizeof *spread, t ? t->spread : NAN);
            names[peers_] = t ? r->all[who].name : "-";
        }
        write_number(over[0], sizeof *over,
                     ratio(r, r->best[P], OURS_EXACT, k));
        write_number(over[1], sizeof *over,
                     ratio(r, r->best[P], OURS_THAT_STEP, k));
        write_number(over[2], sizeof *over,
                     ratio(r, r->late[P], OURS_EXACT, k));
        printf(row, error, ms[0], spread[0], names[0], ms[1], spread[1],
               names[1], over[0], over[1], over[2]);
    }
    printf("#< fronts-%d\n\n\n", P + 1);
}

double spread_at(const results *r, const timing from[][DECADES + 1], side ours, int k)
{
    size_t i;
    const timing *a = fastest(r, from, OURS_THAT_STEP, ours, k, &i),
                 *b = fastest(r, from, PEERS, PEERS, k, &i);
    return a && b ? larger(a->spread, b->spread) : 1;
}

/* Print the ratio of a side at a place, the spread, and the name with the least time in `width` letters; "even"
 * if the ratio is no further from 1 than the spread. */
static void print_place(const results *r, int P, side ours, int k, int width)
{
    size_t mine = 0, theirs = 0;
    const timing *a = fastest(r, r->best[P], OURS_THAT_STEP, ours, k, &mine),
                 *b = fastest(r, r->best[P], PEERS, PEERS, k, &theirs);
    const double q = ratio(r, r->best[P], ours, k),
                 spread = spread_at(r, r->best[P], ours, k);
    char over[16];
    write_number(over, sizeof over, q);
    printf("\t%-11s\t%-5.3g\t%-*s", over, spread, width,
           !a && !b                           ? "-"
           : q > 0 && q < spread && 1 < q * spread ? "even"
           : a && (!b || q < 1)               ? r->all[mine].name
                                              : r->all[theirs].name);
}

void print_places(const results *r)
{
    printf("# all places: our time over that of the best peer, the larger spread of the "
           "two, who is the fastest; then the same for ours that step\n#> places\n"
           "# place \t%-11s\t%-5s\t%-24s\t%-11s\t%-5s\t%s\n",
           "ours / peer", "spread", "winner", "by steps", "spread", "winner");
    for (int P = 0; P < PROBLEMS; P++)
        for (int k = 1; k <= DECADES; k++) {
            char place[16];
            snprintf(place, sizeof place, "P%d 1e-%d", P + 1, k);
            printf("%-8s", place);
            print_place(r, P, OURS_EXACT, k, 24);
            print_place(r, P, OURS_THAT_STEP, k, 0);
            printf("\n");
        }
    printf("#< places\n\n\n");
}

/* Print the milliseconds of every method, by error. */
void print_methods(const results *r, int P)
{
    printf("# P%d: ms of each method, by error (-: not reached, or "
           "given up at fifty times the least)\n#> methods-%d\n# %-22s",
           P + 1, P + 1, "method");
    for (int k = 1; k <= DECADES; k++)
        printf("\t1e-%02d", k);
    printf("\n");
    for (size_t i = 0; i < r->count; i++) {
        if (r->best[P][i][1].seconds == 0)
            continue;
        printf("%-24s", r->all[i].name);
        for (int k = 1; k <= DECADES; k++)
            if (r->best[P][i][k].seconds > 0)
                printf("\t%.3g", 1e3 * r->best[P][i][k].seconds);
            else
                printf("\t-");
        printf("\n");
    }
    printf("#< methods-%d\n\n\n", P + 1);
}

static void print_side(const results *r, side ours, const char *what,
                       const char *region)
{
    printf("# %s over that of the best peer, by error over all rows\n"
           "#> %s\n# problem",
           what, region);
    for (int k = 1; k <= DECADES; k++)
        printf("\t1e-%02d", k);
    printf("\n");
    for (int P = 0; P < PROBLEMS; P++) {
        printf("P%-8d", P + 1);
        for (int k = 1; k <= DECADES; k++) {
            char over[16];
            write_number(over, sizeof over, ratio(r, r->best[P], ours, k));
            printf("\t%s", over);
        }
        printf("\n");
    }
    printf("#< %s\n\n\n", region);
}

void print_ratios(const results *r)
{
    print_side(r, OURS_EXACT, "our time", "ratios");
    print_side(r, OURS_THAT_STEP, "the time of ours that step", "ratios-steps");
}

/* Print the ratios to the peers for the library, and for its methods that take steps, in six digits, because
 * 0.9996 is no tie. For the picture 1e-9 means that only the library is as exact, and 1e9 that only peers are. */
void print_picture(const results *r)
{
    printf("# picture:\n# decade\tproblem\tours over peer\tby steps\n");
    for (int P = 0; P < PROBLEMS; P++)
        for (int k = 1; k <= DECADES; k++) {
            const double q = ratio(r, r->best[P], OURS_EXACT, k),
                         steps = ratio(r, r->best[P], OURS_THAT_STEP, k);
            if (q == q)
                printf("%d\t%d\t%.6g\t%.6g\n", k, P + 1,
                       smaller(larger(q, 1e-9), 1e9),
                       smaller(larger(steps, 1e-9), 1e9));
        }
    printf("\n\n");
}

/* Print the library's time at 1e-12, by steps, divided by rk8pd's on the oscillator without memory. */
void print_memory(const results *r)
{
    static const int with[] = { 0, 2, 3, 4, 8 };
    double oscillator = 0;
    for (size_t i = 0; i < r->count; i++)
        if (strncmp(r->all[i].name, "rk8pd", 5) == 0
            && r->best[1][i][12].seconds > 0
            && (oscillator == 0 || r->best[1][i][12].seconds < oscillator))
            oscillator = r->best[1][i][12].seconds;
    printf("# what memory costs: our ms at 1e-12, and that over rk8pd's on P2\n"
           "#> memory\n# problem\tms\tover rk8pd\nrk8pd, P2\t%.3g\t1\n",
           1e3 * oscillator);
    for (size_t i = 0; i < sizeof with / sizeof *with; i++) {
        size_t who;
        const timing *t = fastest(r, r->best[with[i]], OURS_THAT_STEP,
                                  OURS_THAT_STEP, 12, &who);
        if (t)
            printf("P%d       \t%.3g\t%.3g\n", with[i] + 1, 1e3 * t->seconds,
                   t->seconds / oscillator);
        else
            printf("P%d       \t-\t-\n", with[i] + 1);
    }
    printf("#< memory\n\n\n");
}
