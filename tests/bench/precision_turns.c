/* tests/bench/precision_turns.c -- The runs near the front, timed in turn: precision.h.
 *                                                                       [H 18] */
#include "precision.h"

#include <gsl/gsl_sort.h>
#include <stdlib.h>

enum { ROUNDS = 15, FEW = 3, NEAR = 2, MOST_RUNS = 1024 };
#define LONG 0.1 /* seconds; of such runs there are FEW */

/* One run of one contender, which may be the fastest at several decades. */
typedef struct {
    size_t who;
    timing is; /* N, tolerance, and what it took in the sweep */
    double seconds[ROUNDS];
} entrant;

static int is_same(const timing *a, const timing *b)
{
    return a->N == b->N && a->tolerance == b->tolerance;
}

static size_t enter(entrant *all, size_t count, size_t who, const timing *t)
{
    for (size_t i = 0; i < count; i++)
        if (all[i].who == who && is_same(&all[i].is, t))
            return count;
    if (count == MOST_RUNS)
        abort();
    all[count] = (entrant){ .who = who, .is = *t };
    return count + 1;
}

/* All that is within NEAR times the least of its side at a decade. */
static size_t gather_near(const results *r, const timing table[][DECADES + 1],
                          entrant *all, size_t count)
{
    for (int k = 1; k <= DECADES; k++)
        for (size_t i = 0, who; i < r->count; i++) {
            const timing *t = &table[i][k],
                         *least = fastest(r, table, r->all[i].of, r->all[i].of,
                                          k, &who);
            if (t->seconds > 0 && t->seconds <= NEAR * least->seconds)
                count = enter(all, count, i, t);
        }
    return count;
}

/* One turn: of two runs the faster, as the first finds the caches full of another's data. */
static double turn(const results *r, const entrant *e, const problem *p,
                   double *rows)
{
    double least = 0;
    for (int i = 0; i < 2; i++) {
        double seconds;
        timed_run(&r->all[e->who], p, e->is.N, e->is.tolerance, rows, &seconds);
        least = i && least < seconds ? least : seconds;
    }
    return least;
}

static void replace(timing table[][DECADES + 1], const entrant *e)
{
    for (int k = 1; k <= DECADES; k++) {
        timing *t = &table[e->who][k];
        if (t->seconds > 0 && is_same(t, &e->is))
            *t = e->is;
    }
}

void compare_in_turn(results *r, int P)
{
    static entrant all[MOST_RUNS];
    const problem *p = problem_number(P);
    double *rows = malloc((ROWS + 1) * p->system.d * sizeof(double));
    const results *found = r;
    size_t count = gather_near(found, found->best[P], all, 0);
    count = gather_near(found, found->late[P], all, count);
    if (!rows)
        exit(EXIT_FAILURE);
    for (int round = 0; round < ROUNDS; round++)
        for (entrant *e = all; e < all + count; e++)
            if (round < FEW || e->is.seconds < LONG) {
                e->seconds[round] = turn(r, e, p, rows);
                e->is.runs = round + 1;
            }
    for (entrant *e = all; e < all + count; e++) {
        const size_t runs = (size_t)e->is.runs;
        gsl_sort(e->seconds, 1, runs);
        e->is.seconds = e->seconds[0];
        e->is.spread = e->seconds[runs / 2] / e->seconds[0];
        replace(r->best[P], e);
        replace(r->late[P], e);
    }
    free(rows);
}
