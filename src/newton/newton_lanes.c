/* src/newton/newton_lanes.c -- The equations of several oscillators at once.   [H 28] */
#include "newton_lanes.h"

#include "newton_move.h"
#include "system/vectors.h"

#include <stdint.h>
#include <string.h>

enum { L = FVI_MOST_LANES, NEWTON_STEPS = 50, MOST_STAGES = 8 };

/* The equation of each lane, and how far it has come. A lane that is active takes part in the
 * next step; one that is lost needs more than Newton's method. A and s point to those of the solver, or
 * where lanes are missing to `room`. */
typedef struct {
    const double *A, *s;
    double x[L], r[L], d[L], size[L], g[L], active[L], lost[L], z[L]; /* z = x + theta d */
    double room[2][L];
} lanes_at_work;

/* A vector at once where all lanes are there: the next loop reads vectors. */
static inline void take(size_t count, const double *from, double *to)
{
    if (count == L)
        memcpy(to, from, L * sizeof *to);
    else
        memcpy(to, from, count * sizeof *to);
}

/* Lanes that are missing have the equation d = 0, and are not active. */
static void pad(const fvi_newton *n, size_t count, lanes_at_work *w)
{
    memset(w->x, 0, sizeof w->x);
    memset(w->r, 0, sizeof w->r);
    memset(w->d, 0, sizeof w->d);
    for (size_t l = 0; l < L; l++) {
        w->room[0][l] = l < count ? n->A[l] : 1;
        w->room[1][l] = l < count ? n->s[l] : 0;
    }
    w->A = w->room[0];
    w->s = w->room[1];
}

static inline void begin(const fvi_newton *n, const double *x, const double *r, const double *d,
                         lanes_at_work *w)
{
    static const double present[2 * L] = { 1, 1, 1, 1, 1, 1, 1, 1 };
    const size_t count = n->system->d;
    w->A = n->A;
    w->s = n->s;
    if (count < L)
        pad(n, count, w);
    take(count, x, w->x);
    take(count, r, w->r);
    take(count, d, w->d);
    memcpy(w->active, present + L - count, sizeof w->active);
    memset(w->lost, 0, sizeof w->lost);
#pragma omp simd
    for (size_t l = 0; l < L; l++) {
        w->size[l] = INFINITY;
        w->z[l] = w->x[l] + n->theta * w->d[l];
    }
}

//> lanes
/* One step of each lane that is active; g and H are U' and U'' at its z. A lane that has its
 * solution keeps d, and U' at the last point that it asked for, as a run of its own does. */
FVI_VECTORS static void move_lanes(lanes_at_work *restrict w, double theta, const double *g,
                                   const double *H)
{
    const double *A = w->A, *s = w->s;
#pragma omp simd
    for (size_t l = 0; l < L; l++) {
        const fvi_newton_move to = fvi_newton_move_of(A[l], s[l], theta, w->r[l], w->z[l], g[l], H[l],
                                                      w->d[l], w->size[l]);
        const int moves = w->active[l] != 0,
                  fails = (to.J == 0) | (!to.is_enough & !(to.size < INFINITY));
        w->d[l] = moves ? to.d : w->d[l];
        w->z[l] = w->x[l] + theta * w->d[l];
        w->g[l] = moves ? g[l] : w->g[l];
        w->size[l] = moves ? to.size : w->size[l];
        w->lost[l] = (moves & fails) ? 1 : w->lost[l];
        w->active[l] = (moves & !fails & !to.is_enough) ? 1 : 0;
    }
}
//< lanes

/* Is a flag 1, and not 0, whose bits are all zero? To join words takes less time than to add numbers. */
static inline int is_any(const double *flag)
{
    uint64_t bits[L], any = 0;
    memcpy(bits, flag, sizeof bits);
    for (size_t l = 0; l < L; l++)
        any |= bits[l];
    return any != 0;
}

/* ---- lanes by themselves ---- */

/* The solver that the run of lane l would have, with all that it does where Newton's method
 * loses its way. */
static int solve_alone(fvi_newton *n, size_t l, const double *x, const double *r, double *d,
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
        status = solve_alone(n, l, x, r, d, g);
    return status;
}

/* Those that Newton's method has not brought to an end begin again, from d as it was. */
static int solve_rest(fvi_newton *n, const lanes_at_work *w, const double *x, const double *r,
                      double *d, double *g)
{
    int status = FVI_SUCCESS;
    for (size_t l = 0; l < n->system->d && !status; l++) {
        if (w->active[l] != 0 || w->lost[l] != 0) {
            status = solve_alone(n, l, x, r, d, g);
            continue;
        }
        d[l] = w->d[l];
        g[l] = w->g[l];
    }
    return status;
}

int fvi_newton_by_lanes(fvi_newton *n, const double *x, const double *r, double *d, double *g)
{
    const fvi_lanes *lanes = fvi_lanes_of(n->system);
    lanes_at_work w;
    double slope[L] = { 0 }, H[L] = { 0 };
    if (n->q > 1)
        return solve_each(n, x, r, d, g);
    begin(n, x, r, d, &w);
    for (int i = 0; i < NEWTON_STEPS && is_any(w.active); i++) {
        n->callback_status = fvi_lanes_slopes(lanes, w.z, w.active, slope, H);
        if (n->callback_status)
            return n->callback_status;
        move_lanes(&w, n->theta, slope, H);
    }
    if (is_any(w.active) || is_any(w.lost))
        return solve_rest(n, &w, x, r, d, g);
    take(n->system->d, w.d, d);
    take(n->system->d, w.g, g);
    return FVI_SUCCESS;
}
