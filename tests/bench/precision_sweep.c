/* tests/bench/precision_sweep.c -- Make the runs of the benchmark: precision.h. [H 18] */
#define _POSIX_C_SOURCE 200809L /* clock_gettime, uname */
#include "precision.h"
#include "bench.h"
#include "system/larger.h"

#include <gsl/gsl_math.h>
#include <gsl/gsl_sort.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { RUNS = 4, FEW = 2, HOPELESS = 25, SLOW = 10 }; /* precision_turns.c times runs near the front again */
#define BATCH 2e-5 /* the shortest measurement in seconds */

size_t gather(contender *all)
{
    static const fvi_history_kind kinds[] = { FVI_HISTORY_MODES,
                                             FVI_HISTORY_DIRECT };
    size_t count = 0;
    for (size_t i = 0; fvi_methods[i]; i++)
        for (int k = 0; k < 2; k++) {
            const fvi_method *m = fvi_methods[i];
            const int has_memory = m->memories != 0,
                      peer_ = m->alpha_least == m->alpha_most;
            if (has_memory ? !fvi_method_takes_history(m, kinds[k]) : k > 0)
                continue;
            contender *c = &all[count++];
            *c = (contender){ .method = m,
                              .kind = kinds[k],
                              .of = peer_ ? PEERS : OURS_THAT_STEP };
            snprintf(c->name, sizeof c->name, "%s%s", m->name,
                     has_memory && k ? ", direct" : "");
        }
    all[count] = (contender){ .peer = &exact_by_rows, .of = OURS_EXACT };
    strcpy(all[count++].name, exact_by_rows.name);
    for (size_t i = 0; peers[i]; i++) {
        contender *c = &all[count++];
        *c = (contender){ .peer = peers[i] };
        snprintf(c->name, sizeof c->name, "%s", peers[i]->name);
    }
    return count;
}

/* Everything that depends on the problem is made within the measured time. */
static int run_once(const contender *c, const problem *p, size_t N,
                    double tolerance, double *rows)
{
    if (c->peer) {
        const task t = { p, N, tolerance };
        return c->peer->run(&t, rows);
    }
    fvi_run run = problem_run(p, N, c->kind, tolerance);
    run.step_error = tolerance; /* read by methods that choose their steps */
    fvi_stepper *s;
    int status = fvi_stepper_start(c->method, &run, &s, NULL);
    if (status)
        return status;
    double t[ROWS + 1];
    for (size_t k = 0; k <= ROWS; k++)
        t[k] = (double)(k * (N / ROWS)) * run.h;
    status = fvi_stepper_advance_through(s, ROWS + 1, t, rows, NULL);
    fvi_stepper_free(s);
    return status;
}

/* Reading the clock takes half a microsecond, and a run may take no more. So a short run is repeated within one
 * measurement, with everything that it makes. */
int timed_run(const contender *c, const problem *p, size_t N, double tolerance,
              double *rows, double *seconds)
{
    int status = FVI_SUCCESS, runs = 1;
    for (;;) {
        const double start = now();
        for (int i = 0; i < runs && !status; i++)
            status = run_once(c, p, N, tolerance, rows);
        *seconds = (now() - start) / runs;
        if (status || *seconds * runs > BATCH)
            return status;
        runs = *seconds > 0 ? (int)ceil(1.2 * BATCH / *seconds) : 2 * runs;
    }
}

static double error_from(const problem *p, double from, const double *rows,
                         const double *truth)
{
    const size_t d = p->system.d;
    double worst = 0;
    for (size_t k = 1; k <= ROWS; k++)
        for (size_t i = k * d; i < (k + 1) * d; i++) {
            const double e = fabs(rows[i] - truth[i]);
            if ((double)k * p->T / ROWS >= from && !(e <= worst))
                worst = e == e ? e : GSL_POSINF;
        }
    return worst;
}

void keep_if_faster(timing *all, double error, const timing *t)
{
    for (int k = 1; k <= DECADES; k++)
        if (error <= pow(10, -k)
            && (all[k].seconds == 0 || t->seconds < all[k].seconds))
            all[k] = *t;
}

int last_decade(double error)
{
    int k = 0;
    while (k < DECADES && error <= pow(10, -(k + 1)))
        k++;
    return k;
}

/* Return whether a run of this error and time is near the front at one of its decades. */
static int may_matter(double error, double seconds, const double *front)
{
    const int k = last_decade(error);
    return k >= 1 && (front[k] == 0 || seconds < 2 * front[k]);
}

/* Return whether a run is `times` times slower than the front of its own side or of the other side. If it is
 * HOPELESS, more steps will not help; if it is SLOW, no tolerance will help. */
static int is_behind(double error, double seconds, double (*all)[DECADES + 1], int times)
{
    const int k = last_decade(error);
    return k >= 1
           && ((all[PEERS][k] > 0 && seconds > times * all[PEERS][k])
               || (all[OURS_THAT_STEP][k] > 0 && seconds > times * all[OURS_THAT_STEP][k]));
}

/* The subject of a sweep, and the place of its runs. */
typedef struct {
    results *r;
    size_t who;
    const contender *c;
    const problem *p;
    const double *truth;
    double *rows;
    timing *best, *late;
    double *front, *least;
} place;

/* Make the runs of one point: one or two, and more of them if they may be near the front. Return the error. */
static double point(place *o, size_t N, double tolerance, double *seconds)
{
    double times[RUNS];
    int runs = 1;
    const int status = timed_run(o->c, o->p, N, tolerance, o->rows, seconds);
    times[0] = *seconds;
    if (status)
        return GSL_POSINF;
    const double error = error_from(o->p, 0, o->rows, o->truth),
                 after = error_from(o->p, 2, o->rows, o->truth);
    /* The first run may have made tables that are kept, in 10 ms or more. A second run shows this. */
    if (times[0] < 0.1) {
        timed_run(o->c, o->p, N, tolerance, o->rows, seconds);
        times[0] = smaller(times[0], *seconds);
    }
    if (may_matter(after, times[0], o->front))
        for (; runs < (times[0] > 0.1 ? FEW : RUNS); runs++)
            timed_run(o->c, o->p, N, tolerance, o->rows, &times[runs]);
    gsl_sort(times, 1, (size_t)runs);
    const timing t = { times[0], times[runs / 2] / times[0], tolerance, N,
                       runs };
    *o->least = smaller(*o->least, error);
    keep_if_faster(o->best, error, &t);
    keep_if_faster(o->late, after, &t);
    if (o->r->trials < MOST_TRIALS)
        o->r->tried[o->r->trials++] = (trial){ o->who, error, after, t };
    for (int k = 1; k <= DECADES; k++)
        if (error <= pow(10, -k)
            && (o->front[k] == 0 || t.seconds < o->front[k]))
            o->front[k] = t.seconds;
    *seconds = t.seconds;
    return error;
}

/* Return the next number of steps: for a peer the next one that it accepts, larger by a quarter to a half; for
 * the library twice as many. */
static size_t next(const contender *c, size_t N)
{
    if (!c->peer)
        return 2 * N;
    if (c->peer->any)
        return N < 32 ? N + 1 + N / 16 : (size_t)ceil((c->peer->tolerance ? 1.4 : 1.25) * (double)N);
    const size_t one = c->peer->fewest, n = N / one;
    return one * (n & (n - 1) ? (n / 3) * 4 : n > 1 ? n / 2 * 3 : 2);
}

void sweep(results *r, size_t i, int P, const double *truth, fronts all, double *least)
{
    const contender *c = &r->all[i];
    const problem *p = problem_number(P);
    const int by_steps = !c->peer || c->peer->fewest > 0,
              tunes = c->peer ? c->peer->tolerance
                              : c->method->memories != 0
                                    && c->kind == FVI_HISTORY_MODES;
    place o = { r,     i,
                c,     p,
                truth, malloc((ROWS + 1) * p->system.d * sizeof(double)),
                r->best[P][i], r->late[P][i],
                all[c->of], least };
    double before = GSL_POSINF, seconds = 0;
    size_t N = c->peer && by_steps ? c->peer->fewest : ROWS;
    int stalls = 0;
    if (!o.rows)
        exit(EXIT_FAILURE);
    for (int first = 1; N <= (size_t)1 << 21; first = 0, N = next(c, N)) {
        double error = GSL_POSINF, time;
        if (by_steps || !tunes)
            error = point(&o, N, 0, &seconds);
        /* tolerances near the error; in the first round all of them, because some methods depend on the
         * tolerance alone */
        const double most = first ? sqrt(0.1) : smaller(0.1, 30 * error),
                     lowest = by_steps ? larger(1e-14, error / 3e3) : 1e-15;
        if (tunes && (error < 1 || !by_steps) && !is_behind(error, seconds, all, SLOW)
            && seconds < p->seconds / (first ? 1 : 4))
            for (double t = most; t >= lowest; t /= first ? sqrt(10) : 10)
                point(&o, N, t, &time);
        if (isatty(STDERR_FILENO))
            fprintf(stderr, "\rP%d %-40s %10zu", P + 1, c->name, N);
        stalls = error < 0.1 && error > before / (c->peer ? 1.1 : 1.5) ? stalls + 1 : 0;
        if (!by_steps || stalls == 2 || error < 3e-15
            || is_behind(error, seconds, all, HOPELESS) || 2 * seconds > p->seconds)
            break;
        before = error;
    }
    free(o.rows);
}
