/* tests/bench/precision_turns.c -- Time the runs near the front again, in turn: precision.h. [H 18] */
#include "precision.h"

#include <gsl/gsl_sort.h>
#include <stdlib.h>

enum { ROUNDS = 15, SOME = 5, FEW = 3, NEAR = 2, MOST_RUNS = 4096 };
#define LONG 0.1    /* in seconds; such runs have FEW turns */
#define MEDIUM 2e-3 /* such runs have SOME turns */

static int rounds_of(double seconds)
{
    return seconds > LONG ? FEW : seconds > MEDIUM ? SOME : ROUNDS;
}

/* One run of one contender, which may be the fastest at several decades. */
typedef struct {
    const trial *of;
    timing is; /* N, the tolerance, and its time */
    double seconds[ROUNDS];
} entrant;

static int is_same(const timing *a, const timing *b)
{
    return a->N == b->N && a->tolerance == b->tolerance;
}

/* Return whether a run with this error is within NEAR times the least time of its side, at the last decade that
 * it reaches. */
static int is_near(const results *r, const timing table[][DECADES + 1], const trial *t,
                   double error)
{
    size_t who;
    const int k = last_decade(error);
    const side of = r->all[t->who].of;
    const timing *least = k >= 1 ? fastest(r, table, of, of, k, &who) : NULL;
    return least && t->is.seconds <= NEAR * least->seconds;
}

static size_t gather_near(const results *r, int P, entrant *all)
{
    size_t count = 0;
    for (const trial *t = r->tried; t < r->tried + r->trials; t++) {
        if (!is_near(r, r->best[P], t, t->error) && !is_near(r, r->late[P], t, t->late))
            continue;
        if (count == MOST_RUNS)
            abort();
        all[count++] = (entrant){ .of = t, .is = t->is };
    }
    return count;
}

/* Take one turn. Of two short runs the faster one counts, because the first one finds the data of another run
 * in the caches. */
static double turn(const results *r, const entrant *e, const problem *p,
                   double *rows)
{
    double least = 0;
    for (int i = 0; i < (e->is.seconds > MEDIUM ? 1 : 2); i++) {
        double seconds;
        timed_run(&r->all[e->of->who], p, e->is.N, e->is.tolerance, rows, &seconds);
        least = i && least < seconds ? least : seconds;
    }
    return least;
}

/* Replace the old time by the new one. */
static void replace(timing *table, const entrant *e)
{
    for (int k = 1; k <= DECADES; k++)
        if (table[k].seconds > 0 && is_same(&table[k], &e->is))
            table[k] = e->is;
}

void compare_in_turn(results *r, int P)
{
    static entrant all[MOST_RUNS];
    const problem *p = problem_number(P);
    double *rows = malloc((ROWS + 1) * p->system.d * sizeof(double));
    const size_t count = gather_near(r, P, all);
    if (!rows)
        exit(EXIT_FAILURE);
    for (int round = 0; round < ROUNDS; round++)
        for (entrant *e = all; e < all + count; e++)
            if (round < rounds_of(e->is.seconds)) {
                e->seconds[round] = turn(r, e, p, rows);
                e->is.runs = round + 1;
            }
    for (entrant *e = all; e < all + count; e++) {
        const size_t runs = (size_t)e->is.runs;
        gsl_sort(e->seconds, 1, runs);
        e->is.seconds = e->seconds[0];
        e->is.spread = e->seconds[runs / 2] / e->seconds[0];
        replace(r->best[P][e->of->who], e);
        replace(r->late[P][e->of->who], e);
    }
    for (entrant *e = all; e < all + count; e++) {
        keep_if_faster(r->best[P][e->of->who], e->of->error, &e->is);
        keep_if_faster(r->late[P][e->of->who], e->of->late, &e->is);
    }
    free(rows);
}
