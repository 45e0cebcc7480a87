/* tests/bench/precision.h -- The runs of the benchmark, and what is printed of them.
 *                                                                       [H 18] */
#ifndef PRECISION_H
#define PRECISION_H

#include "peers/peers.h"

enum { DECADES = 13, MOST_CONTENDERS = 128 };

/* side -- whose a contender is. Where a motion is linear, ours has a way that takes no
 * step: the rows of the exact solution. What is said of ours is said without it, too. */
typedef enum { PEERS, OURS_THAT_STEP, OURS_EXACT } side;

/* contender -- one of ours, by a kind of memory, or a peer. */
typedef struct {
    char name[40];
    const fvi_method *method; /* NULL for a peer, and for the exact solution */
    fvi_history_kind kind;
    const peer *peer;
    side of;
} contender;

/* timing -- the least processor time of `runs` runs, in seconds, and their median over
 * it; 0 seconds: no run was as exact. Also: which run, and its error for t >= 2. */
typedef struct {
    double seconds, spread, tolerance;
    size_t N;
    int runs;
} timing;

/* gather -- every method of fvi_methods by the direct sum and by exponentials, the exact
 * solution by rows, and all peers; methods that know alpha = 1/2 alone are of the textbooks, and peers. Returns
 * how many. */
size_t gather(contender *all);

/* timed_run -- the rows of one run of a contender on p, with N steps and this tolerance, and
 * its seconds, > 0 if it went well. Returns its status. */
int timed_run(const contender *c, const problem *p, size_t N, double tolerance,
              double *rows, double *seconds);

/* trial -- one run of a sweep: whose, its error over all rows, and over those with t >= 2. */
typedef struct {
    size_t who;
    double error, late;
    timing is;
} trial;

/* results -- the fastest runs of all contenders on all problems, and all runs on the last one. */
enum { MOST_TRIALS = 1 << 15 };
typedef struct {
    size_t count, trials;
    contender all[MOST_CONTENDERS];
    timing best[PROBLEMS][MOST_CONTENDERS][DECADES + 1],
        late[PROBLEMS][MOST_CONTENDERS][DECADES + 1];
    trial tried[MOST_TRIALS];
} results;

/* sweep -- runs of contender i on problem P, with more and more steps, and tolerances
 * about the error that comes, into r->best[P][i][k], k = 1 ... DECADES: the fastest run whose error
 * over all rows is at most 10^-k; late[P][i][k] the same for the rows with t >= 2; and each of them
 * into r->tried. all[side][k]: the least time of a side so far: runs that are far from it are not
 * repeated, those ten times slower get no tolerance of their own, and fifty times slower ends the sweep.
 * *least: becomes the least error of its side. */
typedef double fronts[OURS_EXACT + 1][DECADES + 1];
void sweep(results *r, size_t i, int P, const double *truth, fronts all, double *least);

/* last_decade -- the largest k <= DECADES with error <= 10^-k, where a run of this error counts; 0 if
 * there is none, as for NaN. */
int last_decade(double error);

/* keep_if_faster -- the run into all places of a table that its error reaches and where it is the
 * fastest. */
void keep_if_faster(timing *all, double error, const timing *t);

/* compare_in_turn -- a processor may be fast for some seconds and slow for others, and the
 * sweeps are seconds apart. So all trials on problem P within twice the least time
 * of their side at some decade are timed again, in turn: one of each, then all once more.
 * Their times in r become those. */
void compare_in_turn(results *r, int P);

/* fastest -- the fastest of the sides `first` to `last` whose error is at most 10^-k, and
 * who it is; `from` is best[P] or late[P]. NULL if none is as exact. */
const timing *fastest(const results *r, const timing from[][DECADES + 1],
                      side first, side last, int k, size_t *who);

/* ratio -- the least time of ours, up to the side `ours`, over that of the peers; 0 if no
 * peer is as exact, infinite if ours is not, NaN if nobody is. */
double ratio(const results *r, const timing from[][DECADES + 1], side ours,
             int k);

/* spread_at -- the larger spread of the two times of that ratio. A ratio no further from 1 than
 * this is undecided. */
double spread_at(const results *r, const timing from[][DECADES + 1], side ours, int k);

/* Tables and sentences, each a region of the file that is printed. */
void print_verdict(const results *r);
void print_ratios(const results *r);
void print_places(const results *r);
void print_picture(const results *r);
void print_fronts(const results *r, int P);
void print_memory(const results *r);
void print_methods(const results *r, int P);

/* small_times -- what small and long runs of ours take, in seconds: 200 steps as a whole
 * process, 10^6 and 10^8 uniform steps. A slow spell of the processor may be longer than
 * 10^8 steps, so that each has a turn after every third problem: the least and the most of the
 * turns, each the best of 100, 5 and 1 runs; infinite if all runs of a turn failed. */
enum { SMALL = 3 };
typedef struct {
    int turns;
    double least[SMALL], most[SMALL];
} small_times;

/* time_small -- one turn more; `program` is build/fvi. */
void time_small(const char *program, small_times *s);
void print_small(const small_times *s);

#endif
