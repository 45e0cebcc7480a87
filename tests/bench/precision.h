/* tests/bench/precision.h -- Make the runs of the benchmark, and print the tables. [H 18] */
#ifndef PRECISION_H
#define PRECISION_H

#include "peers/peers.h"

enum { DECADES = 13, MOST_CONTENDERS = 128 };

/* side -- whether a contender is a peer or a method of the library. If a motion is linear, the library has a
 * method without steps: the exact solution in all rows. The sides tell both cases apart, so each statement
 * about the library is made with and without it. */
typedef enum { PEERS, OURS_THAT_STEP, OURS_EXACT } side;

/* contender -- a method of the library with a kind of memory, or a peer. */
typedef struct {
    char name[40];
    const fvi_method *method; /* NULL for a peer, and for the exact solution */
    fvi_history_kind kind;
    const peer *peer;
    side of;
} contender;

/* timing -- the least processor time of `runs` runs in seconds, and their median divided by it. 0 seconds: no
 * run was as exact. Also which run it was, and its error for t >= 2. */
typedef struct {
    double seconds, spread, tolerance;
    size_t N;
    int runs;
} timing;

/* gather -- list every method of fvi_methods with the direct sum and with exponentials, the exact solution in
 * all rows, and all peers. Methods that exist only for alpha = 1/2 are those of textbooks and count as peers.
 * Returns the number of contenders. */
size_t gather(contender *all);

/* timed_run -- compute the rows of one run of a contender on p with N steps and this tolerance, and its
 * seconds, which are > 0 if the run succeeded. Returns the status of the run. */
int timed_run(const contender *c, const problem *p, size_t N, double tolerance,
              double *rows, double *seconds);

/* trial -- one run of a sweep: its contender, its error over all rows, and its error over the rows with t >= 2. */
typedef struct {
    size_t who;
    double error, late;
    timing is;
} trial;

/* results -- the fastest runs of all contenders on all problems, and all runs on the last problem. */
enum { MOST_TRIALS = 1 << 15 };
typedef struct {
    size_t count, trials;
    contender all[MOST_CONTENDERS];
    timing best[PROBLEMS][MOST_CONTENDERS][DECADES + 1],
        late[PROBLEMS][MOST_CONTENDERS][DECADES + 1];
    trial tried[MOST_TRIALS];
} results;

/* sweep -- make runs of contender i on problem P, with more and more steps, and with tolerances near the error.
 *
 * r->best[P][i][k], k = 1 ... DECADES, becomes the fastest run whose error over all rows is at most 10^-k, and
 * late[P][i][k] the same for the rows with t >= 2. Each run is also recorded in r->tried. all[side][k] is the
 * least time of a side so far. Runs far from it are not repeated; runs ten times slower get no tolerances of
 * their own; runs fifty times slower end the sweep. *least becomes the least error of the side. */
typedef double fronts[OURS_EXACT + 1][DECADES + 1];
void sweep(results *r, size_t i, int P, const double *truth, fronts all, double *least);

/* last_decade -- return the largest k <= DECADES with error <= 10^-k. A run with this error counts up to this
 * decade. 0 if there is none, also for NaN. */
int last_decade(double error);

/* keep_if_faster -- enter the run at all places of a table that its error reaches and where it is the fastest. */
void keep_if_faster(timing *all, double error, const timing *t);

/* compare_in_turn -- time the fastest runs again, in turn.
 *
 * A processor may be fast for some seconds and slow for others, and the sweeps are seconds apart. So this
 * function times all trials on problem P again that are within twice the least time of their side at some
 * decade: one of each, then all once more, and so on. Their times in r become the new ones. */
void compare_in_turn(results *r, int P);

/* fastest -- the fastest timing of the sides `first` to `last` whose error is at most 10^-k, and its contender.
 * `from` is best[P] or late[P]. NULL if no run is as exact. */
const timing *fastest(const results *r, const timing from[][DECADES + 1],
                      side first, side last, int k, size_t *who);

/* ratio -- the least time of the library, up to the side `ours`, divided by that of the peers. 0 if no peer is
 * as exact, infinite if the library is not, NaN if neither is. */
double ratio(const results *r, const timing from[][DECADES + 1], side ours,
             int k);

/* spread_at -- the larger spread of the two times of this ratio. A ratio is undecided if it is no further from
 * 1. */
double spread_at(const results *r, const timing from[][DECADES + 1], side ours, int k);

/* Print tables and sentences, each as a region of the printed file. */
void print_verdict(const results *r);
void print_ratios(const results *r);
void print_places(const results *r);
void print_picture(const results *r);
void print_fronts(const results *r, int P);
void print_memory(const results *r);
void print_methods(const results *r, int P);

/* small_times -- the seconds of small and long runs of the library: 200 steps as a whole process, 10^6 and 10^8
 * uniform steps. A slow period of the processor may be longer than 10^8 steps. So each of them has a turn after
 * every third problem. The members are the least and the most of the turns; a turn is the best of 100, 5 and 1
 * runs. Infinite if all runs of a turn failed. */
enum { SMALL = 3 };
typedef struct {
    int turns;
    double least[SMALL], most[SMALL];
} small_times;

/* time_small -- take one more turn. `program` is build/fvi. */
void time_small(const char *program, small_times *s);
void print_small(const small_times *s);

#endif
