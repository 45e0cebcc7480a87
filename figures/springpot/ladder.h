/* figures/springpot/ladder.h -- H 0: a ladder of springs and dashpots.
 *
 * Node j = 0, 1, ... stands at x_j, hangs from node j - 1 by a spring, and drags a dashpot
 * along a fixed rail. Node 0 is pulled by a force f and may carry a mass m and a spring c
 * of its own, to the rail:
 *
 *     m x_0'' + c_0 x_0' + c x_0 + k_0 (x_0 - x_1) = f,
 *     c_j x_j' = k_{j-1} (x_{j-1} - x_j) - k_j (x_j - x_{j+1}),    j > 0.              (0.3)
 *
 * Constants that grow or fade along the ladder give each order beta from 0 to 1, (0.5):
 *
 *     k_j = k (j + 1/2)^(1 - 2 beta),   c_j = eta j^(1 - 2 beta),
 *
 * c_0 is the integral of eta j^(1 - 2 beta) over the half rung from 0 to 1/2. The last
 * node is free: it must be so far away that it does not yet move. */
#ifndef LADDER_H
#define LADDER_H

#include <math.h>
#include <stddef.h>

enum { RUNGS = 600 };

typedef struct {
    double m, c; /* of node 0; 0 if there is none */
    double
        spring[RUNGS]; /* k_j, between nodes j and j + 1; the last one is 0 */
    double dashpot[RUNGS];
    double x[RUNGS], v; /* positions, and the velocity of node 0 */
} ladder;

/* A ladder of order beta, 0 < beta < 1, at rest at 0; k, eta > 0. */
static inline ladder ladder_of_order(double beta, double k, double eta)
{
    const double a = 1 - 2 * beta;
    ladder l = { 0 };
    l.dashpot[0] = eta * pow(0.5, a + 1) / (a + 1);
    for (size_t j = 0; j < RUNGS; j++) {
        l.spring[j] = j + 1 < RUNGS ? k * pow((double)j + 0.5, a) : 0;
        if (j > 0)
            l.dashpot[j] = eta * pow((double)j, a);
    }
    return l;
}

/* The rho of the springpot that it is for slow motions: (0.5). */
static inline double ladder_rho(double beta, double k, double eta)
{
    return pow(2, 1 - 2 * beta) * tgamma(1 - beta) / tgamma(beta)
           * pow(k, 1 - beta) * pow(eta, beta);
}

/* Stage y = from + h F(y), by elimination from the last node to the first: node j passes
 * to node j - 1 what it and all that hang from it ask for, (0.4) is the same in s. */
static inline void ladder_stage(const ladder *l, const double *from, double v,
                                double h, double f, double *y)
{
    //> elimination
    double weight[RUNGS],
        load[RUNGS]; /* of nodes j, j + 1, ...: weight y_j = load + k y_{j-1} */
    for (size_t j = RUNGS; j-- > 0;) {
        weight[j] = l->dashpot[j] / h + (j > 0 ? l->spring[j - 1] : 0);
        load[j] = l->dashpot[j] / h * from[j];
        if (j + 1 < RUNGS) {
            weight[j] += l->spring[j] * (1 - l->spring[j] / weight[j + 1]);
            load[j] += l->spring[j] * load[j + 1] / weight[j + 1];
        }
    }
    weight[0] += l->m / h / h + l->c;
    load[0] += l->m / h * (from[0] / h + v) + f;
    y[0] = load[0] / weight[0];
    for (size_t j = 1; j < RUNGS; j++)
        y[j] = (load[j] + l->spring[j - 1] * y[j - 1]) / weight[j];
    //< elimination
}

/* A step h under a force that is constant in it: Alexander's method, two stages, order 2,
 * which damps what is too fast for the step. */
static inline void ladder_step(ladder *l, double h, double f)
{
    const double g = 1 - sqrt(0.5), more = (1 - g) / g;
    double y[RUNGS], base[RUNGS];
    ladder_stage(l, l->x, l->v, g * h, f, y);
    const double v1 = (y[0] - l->x[0]) / (g * h);
    for (size_t j = 0; j < RUNGS; j++)
        base[j] = l->x[j] + more * (y[j] - l->x[j]);
    ladder_stage(l, base, l->v + more * (v1 - l->v), g * h, f, y);
    l->v = (y[0] - base[0]) / (g * h);
    for (size_t j = 0; j < RUNGS; j++)
        l->x[j] = y[j];
}

#endif
