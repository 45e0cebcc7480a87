/* src/newton/newton_lanes.c -- Solve the equations of several oscillators as lanes of a vector.  [H 28] */
#include "newton_lanes.h"

#include "newton_move.h"
#include "system/vectors.h"

#include <string.h>

enum { L = FVI_MOST_LANES, NEWTON_STEPS = 50, MOST_STAGES = 8 };

/* The equation of each lane and the state of its iteration. An active lane takes part in the next Newton step. A lost
 * lane needs more than Newton's method. A, s, x and r point to the arrays of the solver and of its caller, or to `room`
 * if there are fewer than L lanes. z is x + theta d. */
typedef struct {
    const double *A, *s, *x, *r;
    _Alignas(64) double d[L], z[L], g[L], size[L], active[L], lost[L];
    double room[4][L];
} lanes_at_work;

/* Give the missing lanes the equation d = 0. They are not active. */
static void pad_lanes(size_t count, lanes_at_work *w)
{
    const double **part[] = { &w->A, &w->s, &w->x, &w->r };
    for (size_t n = 0; n < 4; n++) {
        for (size_t l = 0; l < L; l++)
            w->room[n][l] = l < count ? (*part[n])[l] : n == 0 ? 1 : 0;
        *part[n] = w->room[n];
    }
}

/* Set the state of each lane before its first Newton step. */
FVI_VECTORS static void begin_lanes(lanes_at_work *restrict w, double theta, size_t count)
{
#pragma omp simd
    for (size_t l = 0; l < L; l++) {
        w->g[l] = 0;
        w->lost[l] = 0;
        w->size[l] = INFINITY;
        w->z[l] = w->x[l] + theta * w->d[l];
    }
    for (size_t l = 0; l < L; l++)
        w->active[l] = l < count;
}

static inline void begin(const fvi_newton *n, const double *x, const double *r, const double *d,
                         lanes_at_work *w)
{
    const size_t count = n->system->d;
    w->A = n->A;
    w->s = n->s;
    w->x = x;
    w->r = r;
    if (count == L) {
        memcpy(w->d, d, sizeof w->d);
    } else {
        memset(w->d, 0, sizeof w->d);
        memcpy(w->d, d, count * sizeof *d);
        pad_lanes(count, w);
    }
    begin_lanes(w, n->theta, count);
}

//> lanes
/* Take one Newton step in each active lane; g and H are U' and U'' at its z. A lane that has its solution keeps d, and
 * it keeps U' at the last point of its own iteration, as a single run does. Return the number of active lanes. */
FVI_VECTORS static double move_lanes(lanes_at_work *restrict w, double theta, const double *g,
                                     const double *H)
{
    const double *A = w->A, *s = w->s, *x = w->x, *r = w->r;
    double left = 0;
#pragma omp simd reduction(+ : left)
    for (size_t l = 0; l < L; l++) {
        const fvi_newton_move to =
            fvi_newton_move_of(A[l], s[l], theta, r[l], w->z[l], g[l], H[l], w->d[l], w->size[l]);
        const int moves = w->active[l] != 0,
                  fails = (to.J == 0) | (!to.is_enough & !(to.size < INFINITY));
        w->d[l] = moves ? to.d : w->d[l];
        w->z[l] = x[l] + theta * w->d[l];
        w->g[l] = moves ? g[l] : w->g[l];
        w->size[l] = moves ? to.size : w->size[l];
        w->lost[l] = (moves & fails) ? 1 : w->lost[l];
        w->active[l] = (moves & !fails & !to.is_enough) ? 1 : 0;
        left += w->active[l];
    }
    return left;
}
//< lanes

/* ---- lanes solved one by one ---- */

/* Solve the equation of lane l with the solver of a single run, including everything it does when
 * Newton's method fails. */
static int solve_one_lane(fvi_newton *n, size_t l, const double *x, const double *r, double *d,
                          double *g)
{
    const size_t dim = n->system->d, q = n->q;
    const fvi_system *own = fvi_lanes_of(n->system)->system[l];
    double rl[MOST_STAGES], dl[MOST_STAGES], gl[MOST_STAGES];
    int status = FVI_SUCCESS;
    if (!n->lane[l])
        status = q > 1 ? fvi_newton_stages_alloc(own, q, n->s + l * q * q, &n->lane[l])
                       : fvi_newton_alloc(own, n->A + l, n->s[l], n->theta, &n->lane[l]);
    if (status)
        return status;
    for (size_t i = 0; i < q; i++) {
        rl[i] = r[i * dim + l];
        dl[i] = d[i * dim + l];
    }
    status = fvi_newton_solve(n->lane[l], x + l, rl, dl, gl);
    for (size_t i = 0; i < q; i++) {
        d[i * dim + l] = dl[i];
        g[i * dim + l] = gl[i];
    }
    return status;
}

static int solve_each(fvi_newton *n, const double *x, const double *r, double *d, double *g)
{
    int status = FVI_SUCCESS;
    for (size_t l = 0; l < n->system->d && !status; l++)
        status = solve_one_lane(n, l, x, r, d, g);
    return status;
}

/* Copy `count` numbers. For all L lanes the size is constant, so the compiler moves whole vectors, and the next loop
 * reads whole vectors. */
static inline void copy_lanes(size_t count, const double *from, double *to)
{
    if (count == L)
        memcpy(to, from, L * sizeof *to);
    else
        memcpy(to, from, count * sizeof *to);
}

/* Solve each lane that has not converged by the solver of a single run, from the initial guess d. Copy the solutions of
 * the other lanes. */
static int solve_rest(fvi_newton *n, const lanes_at_work *w, const double *x, const double *r,
                      double *d, double *g)
{
    int status = FVI_SUCCESS;
    for (size_t l = 0; l < n->system->d && !status; l++) {
        if (w->active[l] != 0 || w->lost[l] != 0) {
            status = solve_one_lane(n, l, x, r, d, g);
            continue;
        }
        d[l] = w->d[l];
        g[l] = w->g[l];
    }
    return status;
}

int fvi_newton_by_lanes(fvi_newton *n, const double *x, const double *r, double *d, double *g)
{
    const size_t count = n->system->d;
    lanes_at_work w;
    double slope[L] = { 0 }, H[L] = { 0 }, left = (double)count, lost = 0;
    if (n->q > 1)
        return solve_each(n, x, r, d, g);
    begin(n, x, r, d, &w);
    for (int i = 0; i < NEWTON_STEPS && left > 0; i++) {
        n->callback_status = fvi_lanes_slopes(fvi_lanes_of(n->system), w.z, w.active, slope, H);
        if (n->callback_status)
            return n->callback_status;
        left = move_lanes(&w, n->theta, slope, H);
    }
    for (size_t l = 0; l < L; l++)
        lost += w.lost[l];
    if (left > 0 || lost > 0)
        return solve_rest(n, &w, x, r, d, g);
    copy_lanes(count, w.d, d);
    copy_lanes(count, w.g, g);
    return FVI_SUCCESS;
}
