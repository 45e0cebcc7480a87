/* tests/bench/precision_words.c -- Print the sentences that say who is ahead: precision.h. [H 18] */
#include "precision.h"

#include <gsl/gsl_math.h>
#include <stdio.h>
#include <string.h>

/* Write the decades of P at which the library, up to the side `of`, is ahead, or at which it is not: "1e-3 to
 * 1e-6, 1e-9". */
static int decades(const results *r, int P, side of, int ours, char *to,
                   size_t n)
{
    int found = 0, begin = 0;
    size_t at = 0;
    to[0] = 0;
    for (int k = 1; k <= DECADES + 1; k++) {
        const double q = k <= DECADES ? ratio(r, r->best[P], of, k) : NAN;
        const int is = ours ? q < 1 : q >= 1;
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

/* Print who is ahead on P, at which errors, and by how much at most. */
static void print_sentence(const results *r, int P)
{
    char mine[200], theirs[200];
    const int a = decades(r, P, OURS_EXACT, 1, mine, sizeof mine),
              b = decades(r, P, OURS_EXACT, 0, theirs, sizeof theirs);
    double least = GSL_POSINF, most = 0;
    int at = 1;
    for (int k = 1; k <= DECADES; k++) {
        const double q = ratio(r, r->best[P], OURS_EXACT, k);
        if (q > 0 && q < least)
            least = q;
        if (q > most && q < GSL_POSINF) {
            most = q;
            at = k;
        }
    }
    printf("- **P%d**, %s: ", P + 1, problem_number(P)->what);
    if (a + b == 0)
        printf("nobody has a digit.\n");
    else if (b == 0)
        printf(
            "ours is ahead at each of these errors that anybody reached, %s.\n",
            mine);
    else if (a == 0)
        printf(
            "a peer is ahead at each of these errors that anybody reached, %s",
            theirs);
    else
        printf("ours is ahead at %s, a peer at %s", mine, theirs);
    if (b && most > 1) {
        size_t who = 0;
        fastest(r, r->best[P], PEERS, PEERS, at, &who);
        printf(
            ";\n  most at 1e-%d, where ours takes %.3g times as long as %s.\n",
            at, most, r->all[who].name);
    } else if (b) {
        printf(".\n");
    }
}

/* Print which peers lead at some place, at how many places, and why. */
static void print_reasons(const results *r)
{
    int any = 0;
    for (size_t i = 0; i < r->count; i++) {
        int places = 0;
        for (int P = 0; P < PROBLEMS; P++)
            for (int k = 1; k <= DECADES; k++) {
                size_t who = r->count;
                const double q = ratio(r, r->best[P], OURS_EXACT, k);
                fastest(r, r->best[P], PEERS, PEERS, k, &who);
                places += q >= 1 && who == i;
            }
        if (!places)
            continue;
        if (!any++)
            printf("\nWhere a peer is ahead, it is one of these, and this is "
                   "why:\n\n");
        printf("- **%s**, %d: %s.\n", r->all[i].name, places,
               r->all[i].peer ? r->all[i].peer->why
                              : "a step costs next to nothing");
    }
}

/* Return the number of places at which the library, up to the side `of`, is ahead, or at which it is not. */
static int how_many(const results *r, side of, int ours)
{
    char none[200];
    int sum = 0;
    for (int P = 0; P < PROBLEMS; P++)
        sum += decades(r, P, of, ours, none, sizeof none);
    return sum;
}

/* Print where the library's methods with steps would be ahead. (If a motion is linear the library needs no
 * steps.) */
static void print_by_steps(const results *r)
{
    char theirs[200];
    int first = 1;
    printf("\nOf ours that step, the exact solution left out, the best is "
           "ahead at "
           "%d, a peer at %d:\n",
           how_many(r, OURS_THAT_STEP, 1), how_many(r, OURS_THAT_STEP, 0));
    for (int P = 0; P < PROBLEMS; P++)
        if (decades(r, P, OURS_THAT_STEP, 0, theirs, sizeof theirs)) {
            printf("%sP%d at %s", first ? "" : "; ", P + 1, theirs);
            first = 0;
        }
    printf(".\n");
}

/* Return the number of places at which the ratio is no further from 1 than the spread. */
static int undecided(const results *r, side of)
{
    int sum = 0;
    for (int P = 0; P < PROBLEMS; P++)
        for (int k = 1; k <= DECADES; k++) {
            const double q = ratio(r, r->best[P], of, k),
                         spread = spread_at(r, r->best[P], of, k);
            sum += q > 0 && q < spread && 1 < q * spread;
        }
    return sum;
}

void print_verdict(const results *r)
{
    const int a = how_many(r, OURS_EXACT, 1), b = how_many(r, OURS_EXACT, 0);
    printf("# who is ahead, in words\n#> verdict\n");
    if (b == 0)
        printf("Of %d places, eleven problems by thirteen errors as far as "
               "anybody reached "
               "them,\nours is ahead at all.\n\n",
               a);
    else
        printf("Of %d places, eleven problems by thirteen errors as far as "
               "anybody reached "
               "them,\nours is ahead at %d, **a peer at %d**.\n\n",
               a + b, a, b);
    for (int P = 0; P < PROBLEMS; P++)
        print_sentence(r, P);
    print_reasons(r);
    print_by_steps(r);
    printf("The two times differ by less than the spread at %d of all places, and at %d if "
           "only ours that\nstep count.\n",
           undecided(r, OURS_EXACT), undecided(r, OURS_THAT_STEP));
    printf("#< verdict\n\n\n");
}
