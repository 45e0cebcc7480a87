/* tests/bench/peers/series.c -- Power series of a force along a motion. [H 18]
 *
 * The coefficients come from recurrences, by automatic differentiation (A. Jorba, M. Zou, Experiment. Math. 14
 * (2005)). */
#include "series.h"

#include <math.h>

static double harmonic(size_t n, const double *x, double *room,
                       const double *params)
{
    (void)room;
    return params[0] * x[n];
}

/* room: the coefficients of x^2 */
static double duffing(size_t n, const double *x, double *room,
                      const double *params)
{
    double square = 0, cube = 0;
    for (size_t i = 0; i <= n; i++)
        square += x[i] * x[n - i];
    room[n] = square;
    for (size_t i = 0; i <= n; i++)
        cube += room[i] * x[n - i];
    return params[0] * x[n] + params[1] * cube;
}

/* room: the coefficients of sin x and cos x; (sin x)' = x' cos x, (cos x)' = -x' sin x */
static double pendulum(size_t n, const double *x, double *room,
                       const double *params)
{
    double *sine = room, *cosine = room + SERIES_MOST + 1, up = 0, down = 0;
    for (size_t i = 1; i <= n; i++) {
        up += (double)i * x[i] * cosine[n - i];
        down -= (double)i * x[i] * sine[n - i];
    }
    sine[n] = n ? up / (double)n : sin(x[0]);
    cosine[n] = n ? down / (double)n : cos(x[0]);
    return params[0] * sine[n];
}

series_term series_of(const problem *p)
{
    const double any[2] = { 0, 0 };
    if (p->system.d != 1 || p->system.matrices)
        return NULL;
    const struct {
        fvi_potential is;
        series_term term;
    } known[] = { { fvi_potential_harmonic(any), harmonic },
                  { fvi_potential_duffing(any), duffing },
                  { fvi_potential_pendulum(any), pendulum } };
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (p->system.potential.gradient == known[i].is.gradient)
            return known[i].term;
    return NULL;
}
