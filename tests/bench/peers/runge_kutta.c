/* tests/bench/peers/runge_kutta.c -- Runge-Kutta methods of order 4 and 8, for alpha = 1/2. [H 18]
 *
 * x' = v, m v' = F - grad U(x) - rho v by Kutta's method of order 4, and by one of order 8 with 11 stages (G. J.
 * Cooper, J. H. Verner, SIAM J. Numer. Anal. 9 (1972)), in plain loops over steps of one length. Rows within a
 * step: the polynomial of degree 8 through x, v and v' at three nodes. */
#include "peers.h"

#include <stdlib.h>
#include <string.h>

PEER_SCALAR

enum { MOST_STAGES = 11 };

/* y = (x, v); z is a stage; k are the slopes; a node has x, v and v'; then 1/m and rho/m. */
typedef struct {
    const problem *p;
    const fvi_system *s;
    double h;
    double *y, *z, *k, *node[3], *inverse, *rate;
} solver;

/* Compute the slope at z, or at y. Only arguments of callbacks leave the registers. */
PEER_INLINE int slope(const solver *o, size_t d, double t, double *z, double *k)
{
    const fvi_system *s = o->s;
    double *const g = o->z + 2 * d;
    int status = s->potential.gradient(d, z, s->potential.params, g);
    for (size_t a = 0; a < d; a++) {
        k[a] = z[d + a];
        k[d + a] = -g[a] * o->inverse[a] - o->rate[a] * z[d + a];
    }
    if (s->force.value) {
        status |= s->force.value(t, d, s->force.params, g);
        for (size_t a = 0; a < d; a++)
            k[d + a] += g[a] * o->inverse[a];
    }
    return status;
}

/* Compute the slope of one stage at y + h (sum) and t + h c. */
#define STAGE(i, c, sum)                                                       \
    for (size_t j = 0; j < 2 * d; j++)                                         \
        z[j] = y[j] + h * (sum);                                               \
    status |= slope(o, d, t + h * (c), z, k + (i) * 2 * d)
#define K(i) k[(size_t)(i) * 2 * d + j]

PEER_INLINE int step4(const solver *o, size_t d, double t)
{
    const double h = o->h;
    double *const y = o->y, *const z = o->z, *const k = o->k;
    int status = FVI_SUCCESS;
    STAGE(1, 0.5, 0.5 * K(0));
    STAGE(2, 0.5, 0.5 * K(1));
    STAGE(3, 1, K(2));
    for (size_t j = 0; j < 2 * d; j++)
        y[j] += h / 6 * (K(0) + 2 * (K(1) + K(2)) + K(3));
    return status;
}

#define ROOT 4.58257569495584000659 /* the square root of 21 */
PEER_INLINE int step8(const solver *o, size_t d, double t)
{
    static const double r = ROOT, up = (7 + ROOT) / 14, down = (7 - ROOT) / 14;
    const double h = o->h;
    double *const y = o->y, *const z = o->z, *const k = o->k;
    int status = FVI_SUCCESS;
    STAGE(1, 0.5, K(0) / 2);
    STAGE(2, 0.5, (K(0) + K(1)) / 4);
    STAGE(3, up, K(0) / 7 + (-7 - 3 * r) / 98 * K(1) + (21 + 5 * r) / 49 * K(2));
    STAGE(4, up, (11 + r) / 84 * K(0) + (18 + 4 * r) / 63 * K(2)
                     + (21 - r) / 252 * K(3));
    STAGE(5, 0.5, (5 + r) / 48 * K(0) + (9 + r) / 36 * K(2)
                      + (-231 + 14 * r) / 360 * K(3) + (63 - 7 * r) / 80 * K(4));
    STAGE(6, down, (10 - r) / 42 * K(0) + (-432 + 92 * r) / 315 * K(2)
                       + (633 - 145 * r) / 90 * K(3)
                       + (-504 + 115 * r) / 70 * K(4) + (63 - 13 * r) / 35 * K(5));
    STAGE(7, down, K(0) / 14 + (14 - 3 * r) / 126 * K(4)
                       + (13 - 3 * r) / 63 * K(5) + K(6) / 9);
    STAGE(8, 0.5, K(0) / 32 + (91 - 21 * r) / 576 * K(4) + 11.0 / 72 * K(5)
                      + (-385 - 75 * r) / 1152 * K(6)
                      + (63 + 13 * r) / 128 * K(7));
    STAGE(9, up, K(0) / 14 + K(4) / 9 + (-733 - 147 * r) / 2205 * K(5)
                     + (515 + 111 * r) / 504 * K(6) + (-51 - 11 * r) / 56 * K(7)
                     + (132 + 28 * r) / 245 * K(8));
    STAGE(10, 1, (-42 + 7 * r) / 18 * K(4) + (-18 + 28 * r) / 45 * K(5)
                     + (-273 - 53 * r) / 72 * K(6) + (301 + 53 * r) / 72 * K(7)
                     + (28 - 28 * r) / 45 * K(8) + (49 - 7 * r) / 18 * K(9));
    for (size_t j = 0; j < 2 * d; j++)
        y[j] += h * (0.05 * (K(0) + K(10)) + 49.0 / 180 * (K(7) + K(9))
                     + 16.0 / 45 * K(8));
    return status;
}

/* Write the rows between two of the last three nodes, z = -1, 0, 1. */
PEER_INLINE void write_rows(const solver *o, size_t d, size_t middle,
                              size_t from, size_t to, double *rows)
{
    const double h = o->h, T = o->p->T;
    double *const *n = o->node;
    for (size_t a = 0; a < d; a++) {
        const double x = n[1][a], v = h * n[1][d + a], q = h * h * n[1][2 * d + a] / 2,
                     S = (n[2][a] + n[0][a]) / 2 - x - q,
                     V = h * (n[2][d + a] - n[0][d + a]) / 2 - 2 * q,
                     A = h * h * (n[2][2 * d + a] + n[0][2 * d + a]) / 2 - 2 * q,
                     s = (n[2][a] - n[0][a]) / 2 - v,
                     w = h * (n[2][d + a] + n[0][d + a]) / 2 - v,
                     b = h * h * (n[2][2 * d + a] - n[0][2 * d + a]) / 2,
                     c8 = (A - 9 * V + 24 * S) / 8, c7 = (b - 7 * w + 15 * s) / 8,
                     c6 = (V - 4 * S) / 2 - 2 * c8, c5 = (w - 3 * s) / 2 - 2 * c7,
                     c4 = S - c6 - c8, c3 = s - c5 - c7;
        for (size_t r = from; r <= to; r++) {
            const double z = T * (double)r / (ROWS * h) - (double)middle;
            rows[r * d + a] =
                x + z * (v + z * (q + z * (c3 + z * (c4 + z * (c5 + z * (c6 + z * (c7 + z * c8)))))));
        }
    }
}

/* Store a new node: y, and its slope, the first of k. */
PEER_INLINE void keep(solver *o, size_t d)
{
    double *oldest = o->node[0];
    o->node[0] = o->node[1];
    o->node[1] = o->node[2];
    o->node[2] = oldest;
    memcpy(oldest, o->y, 2 * d * sizeof *oldest);
    memcpy(oldest + 2 * d, o->k + d, d * sizeof *oldest);
}

PEER_INLINE int walk(solver *o, size_t d, size_t N, int order, double *rows)
{
    const size_t every = N % ROWS ? 0 : N / ROWS;
    size_t row = 1;
    int status = FVI_SUCCESS;
    for (size_t n = 0; n <= N && !status; n++) {
        const double t = o->h * (double)n;
        memcpy(o->z, o->y, 2 * d * sizeof *o->z);
        status = slope(o, d, t, o->z, o->k);
        if (every && n % every == 0)
            memcpy(rows + n / every * d, o->y, d * sizeof *rows);
        if (!every)
            keep(o, d);
        const size_t to = n == N ? ROWS : n * ROWS / N;
        if (!every && n >= 2) {
            write_rows(o, d, n - 1, row, to, rows);
            row = to + 1;
        }
        if (n < N && !status)
            status = order == 4 ? step4(o, d, t) : step8(o, d, t);
    }
    return status ? FVI_EMAXITER : FVI_SUCCESS;
}

PEER_INLINE void begin(const solver *o, size_t d, double *rows)
{
    const problem *p = o->p;
    for (size_t a = 0; a < d; a++) {
        o->inverse[a] = 1 / p->system.mass[a];
        o->rate[a] = p->system.damping[a] * o->inverse[a];
        o->y[a] = rows[a] = p->x0[a];
        o->y[d + a] = p->p0[a] * o->inverse[a];
    }
}

/* Run one mass: all numbers in registers, the loops unrolled. */
static int run_one(const task *of, int order, double *rows)
{
    const problem *p = of->p;
    double y[2], z[3], k[2 * MOST_STAGES], node[9], inverse, rate;
    solver o = { p, &p->system, p->T / (double)of->N, y, z, k,
                 { node, node + 3, node + 6 }, &inverse, &rate };
    begin(&o, 1, rows);
    return order == 4 ? walk(&o, 1, of->N, 4, rows) : walk(&o, 1, of->N, 8, rows);
}

static int run(const task *of, int order, double *rows)
{
    const problem *p = of->p;
    const size_t d = p->system.d;
    if (d == 1)
        return run_one(of, order, rows);
    double *room = malloc((16 + 2 * MOST_STAGES) * d * sizeof *room);
    if (!room)
        return FVI_ENOMEM;
    solver o = { p, &p->system, p->T / (double)of->N, room, room + 2 * d,
                 room + 16 * d, { room + 5 * d, room + 8 * d, room + 11 * d },
                 room + 14 * d, room + 15 * d };
    begin(&o, d, rows);
    const int status = walk(&o, d, of->N, order, rows);
    free(room);
    return status;
}

static int run_4(const task *of, double *rows)
{
    return run(of, 4, rows);
}

static int run_8(const task *of, double *rows)
{
    return run(of, 8, rows);
}

static int takes(const problem *p)
{
    return p->alpha == 0.5 && p->system.potential.gradient
           && !p->system.matrices && p->jump == 0;
}

#define WHY "nothing is remembered, and a step is a few sums"
const peer peer_rk4 = { "RK4", "Kutta 1901", WHY, 0, 4, 1, takes, run_4 },
           peer_rk8 = { "RK8", "Cooper, Verner 1972", WHY, 0, 4, 1, takes, run_8 };
