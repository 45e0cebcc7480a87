/* chapters/live/live.c -- What the figures of the book that move ask of the library,
 * beyond what the live page asks (play.c).
 *
 * Five arrays for numbers in and out; nothing is printed. What asks for
 * gradients, fits and controls is in inverse.c. */
#include "memory/history_tiled.h"
#include "memory/history_kinds.h"

#include <fvi/coefficients.h>
#include <fvi/error.h>
#include <fvi/exact_solution.h>
#include <fvi/paper/discrete_principle.h>
#include <fvi/paper/half_derivative.h>
#include <fvi/paper/integration_by_parts.h>
#include <math.h>

#define EXPORT(name) __attribute__((export_name(#name))) name

enum { ROOM = 8192, ARRAYS = 5 };

static double arrays[ARRAYS][ROOM];

double *EXPORT(live_array)(int which)
{
    return arrays[which];
}

/* Array 0: the weights w_n of that order, n < count <= ROOM. */
int EXPORT(live_weights)(double order, int count)
{
    return fvi_gl_weights(order, (size_t)count, arrays[0]);
}

/* The body of unit mass and spring, held at 1 and let go: array 0 gets n times from 0 to
 * T, array 1 the motion, array 2 the part of it that swings; if there is none, 0. */
int EXPORT(live_release)(double alpha, double rho, double T, int n)
{
    const fvi_linear_oscillator problem = {
        .m = 1, .c = 1, .rho = rho, .alpha = alpha, .past = FVI_INITIAL_HISTORY_HELD, .x0 = 1
    };
    for (int i = 0; i < n; i++) {
        arrays[0][i] = T * i / (n - 1);
        arrays[2][i] = 0;
    }
    fvi_exact_oscillation(&problem, (size_t)n, arrays[0], arrays[2], NULL,
                          NULL);
    return fvi_exact_at(&problem, (size_t)n, arrays[0], arrays[1], NULL, NULL);
}

/* Its pole, to array 3: re, im. Not 0 if there is none. */
int EXPORT(live_pole)(double alpha, double rho)
{
    const fvi_linear_oscillator problem = { .m = 1, .c = 1, .rho = rho, .alpha = alpha };
    return fvi_exact_pole(&problem, arrays[3], arrays[3] + 1, NULL);
}

/* The nodes of (12.6): array 0 gets s, array 1 c; returns how many. */
int EXPORT(live_nodes)(double order, double N, double tolerance)
{
    return (int)fvi_history_modes_nodes(order, N, tolerance, arrays[0], arrays[1],
                                       NULL);
}

/* Of N + 1 values in array 0, the retarded derivative to array 1, the advanced one to 2,
 * the retarded one twice to 3. */
int EXPORT(live_operators)(double alpha, double h, int N)
{
    const size_t last = (size_t)N;
    return fvi_delta_minus(alpha, h, last, 1, arrays[0], arrays[1])
           || fvi_delta_plus(alpha, h, last, 1, arrays[0], arrays[2])
           || fvi_delta_twice(alpha, h, last, 1, arrays[0], arrays[3]);
}

/* Array 1: the kernel t^-order / Gamma(1 - order) of Caputo's derivative, 0 <= order < 1, and
 * array 2: t^order / Gamma(1 + order), 0 <= order <= 2, what a springpot of that
 * order and of rho = 1 gives way under a force 1, at the times of array 0. */
void EXPORT(live_powers)(double order, int n)
{
    for (int i = 0; i < n; i++) {
        const double t = arrays[0][i];
        arrays[1][i] = order < 1 ? pow(t, -order) / tgamma(1 - order) : 0;
        arrays[2][i] = pow(t, order) / tgamma(1 + order);
    }
}

static double action(double alpha, double rho, double c, double h, int N, const double *x, const double *y)
{
    const double one = 1;
    const fvi_system system = { .d = 1, .mass = &one, .damping = &rho, .potential = fvi_potential_harmonic(&c) };
    const size_t last = (size_t)N;
    double S = 0;
    return fvi_discrete_action(&system, alpha, 0.5, h, last, 0, last, x, y, &S) ? NAN : S;
}

/* The action of two bodies of unit mass and spring, with N + 1 places each: x, array 0, was held
 * at its first place, and y, array 1, rests at its last. By (6.11) the damping adds what it adds
 * to the action of the distances from there. */
double EXPORT(live_action)(double alpha, double rho, double h, int N)
{
    const double *x = arrays[0], *y = arrays[1];
    double *z = arrays[2], *ahead = arrays[3];
    for (int k = 0; k <= N; k++) {
        z[k] = x[k] - x[0];
        ahead[k] = y[k] - y[N];
    }
    return action(alpha, 0, 1, h, N, x, y) + action(alpha, rho, 0, h, N, z, ahead)
           - action(alpha, 0, 0, h, N, z, ahead);
}
