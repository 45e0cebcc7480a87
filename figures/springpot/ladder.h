/* figures/springpot/ladder.h -- H 0: a ladder of springs and dashpots.
 *
 * Node j = 0, 1, ... is at x_j. A spring connects it to node j - 1, and a dashpot connects it to a fixed rail.
 * A force f acts on node 0, which may also carry a mass m and a spring c to the rail:
 *
 *     m x_0'' + c_0 x_0' + c x_0 + k_0 (x_0 - x_1) = f,
 *     c_j x_j' = k_{j-1} (x_{j-1} - x_j) - k_j (x_j - x_{j+1}),    j > 0.              (0.3)
 *
 * Constants that grow or decay along the ladder give each order beta from 0 to 1, (0.5):
 *
 *     k_j = k (j + 1/2)^(1 - 2 beta),   c_j = eta j^(1 - 2 beta),
 *
 * where c_0 is the integral of eta j^(1 - 2 beta) over the half rung from 0 to 1/2. The last node has no
 * further spring. The ladder must be so long that the last node does not move during the run. */
#ifndef LADDER_H
#define LADDER_H

#include <math.h>
#include <stddef.h>

enum { RUNGS = 600 };

typedef struct {
    double m, c; /* the mass and the spring of node 0; 0 if there is none */
    double
        spring[RUNGS]; /* k_j, between nodes j and j + 1; the last one is 0 */
    double dashpot[RUNGS];
    double x[RUNGS], v; /* positions, and the velocity of node 0 */
} ladder;

/* Return a ladder of order beta, 0 < beta < 1, at rest at 0; k, eta > 0. */
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

/* Return the rho of the springpot that the ladder becomes for slow motions, (0.5). */
static inline double ladder_rho(double beta, double k, double eta)
{
    return pow(2, 1 - 2 * beta) * tgamma(1 - beta) / tgamma(beta)
           * pow(k, 1 - beta) * pow(eta, beta);
}

/* Solve the stage y = from + h F(y). Elimination runs from the last node to the first: seen from node j - 1, all nodes
 * from j on are one spring with one load. (0.4) is the same elimination for the Laplace transforms. */
static inline void ladder_stage(const ladder *l, const double *from, double v,
                                double h, double f, double *y)
{
    //> elimination
    double weight[RUNGS],
        load[RUNGS]; /* weight y_j = load + k_{j-1} y_{j-1}, after the elimination of all nodes behind j */
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

/* Make a step h under a force f that is constant during the step, by Alexander's method. It has two stages and order 2,
 * and it damps those parts of the motion that are too fast for the step. */
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
