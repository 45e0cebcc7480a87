/* tests/bench/peers/radau_mesh.c -- Steps of one length, and steps that grow: radau_step.h. [H 18] */
#include "radau_step.h"
#include "system/larger.h"

size_t radau_uniform(const problem *p, size_t N, radau_step *mesh)
{
    for (size_t k = 0; k < N; k++)
        mesh[k] = (radau_step){ p->T / (double)N, 1 };
    return N;
}

/* Make the steps over the time `whole`. The first one is `first`; then they grow by e^{4 L} at most, as
 * t^{3/4}, up to `longest`. With `meets` the last steps leave the lattice so that they end exactly at the end;
 * else they go beyond it. Return their number, and add their sum to *t. */
static size_t grow(double whole, double first, double longest, double L,
                   int meets_end, size_t most, radau_step *mesh, double *t)
{
    size_t k = 0;
    double j = smaller(0, floor(log(first / longest) / L));
    for (*t = 0; k < most && *t < whole * (1 - 1e-12); k++) {
        double h = longest * exp(L * j);
        const double rest = whole - *t;
        const int off = meets_end && 2 * h > rest;
        if (off)
            h = h >= rest * 0.999 ? rest : rest / 2;
        mesh[k] = (radau_step){ h, !off };
        *t += h;
        j = larger(j, floor(smaller(smaller(0, j + 4), 0.75 * log(*t) / L)));
    }
    return k;
}

size_t radau_graded(const problem *p, double first, double *longest, double L,
                    size_t most, radau_step *mesh)
{
    double t;
    size_t k = 0,
           n = grow(p->T - p->jump, first, *longest, L, 0, most, mesh, &t);
    const double scale = (p->T - p->jump) / t;
    *longest *= scale;
    if (p->jump > 0) {
        k = grow(p->jump, first, *longest, L, 1, most / 2, mesh, &t);
        n = grow(p->T - p->jump, first, *longest / scale, L, 0, most - k,
                 mesh + k, &t);
    }
    for (size_t l = k; l < k + n; l++)
        mesh[l].h *= scale;
    return k + n;
}
