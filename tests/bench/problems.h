/* tests/bench/problems.h -- The eleven problems of the benchmark.       [H 18] */
#ifndef PROBLEMS_H
#define PROBLEMS_H

#include <fvi/fvi.h>

enum { ROWS = 80, PROBLEMS = 11 };

/* problem -- a problem, and its properties.
 *
 *   what     a description in words
 *   T        the rows are at k T / ROWS, k = 0, ..., ROWS
 *   jump     the time at which the force jumps, 0 if it does not jump
 *   linear   the problem for the exact solution (H 11), if d = 1 and U is quadratic; else NULL
 *   panel    the longest panel that reference() needs
 *   seconds  a run longer than this is not tried again with more steps */
typedef struct {
    const char *what;
    fvi_system system;
    const double *x0, *p0;
    double T, alpha;
    fvi_initial_history past;
    double jump;
    const fvi_linear_oscillator *linear;
    double panel, seconds;
} problem;

/* problem_number -- return problem number P; P1 is number 0. The first call sets up all problems. */
const problem *problem_number(int P);

/* problem_run -- return the run with N steps, with a kind of memory and its tolerance. */
fvi_run problem_run(const problem *p, size_t N, fvi_history_kind memory,
                    double tolerance);

/* reference -- collocation on graded panels, in long double, for the pasts of Caputo.
 *
 *     m (v - v0) + rho J^{2-beta} (v - s v0) = J (F - grad U(x)),    x = x0 + J v,
 *
 * beta = 2 alpha, s = 1 if beta > 1 and else 0. v is a polynomial of degree `nodes` - 1
 * on each panel; the panels double in length from 0 and from the jump on until they have
 * the length `panel`; J^{2-beta} is summed over all of the past, with nothing left
 * out. A panel is solved by Picard's iteration. (H. Brunner, Collocation Methods for
 * Volterra Integral and Related Functional Equations, Cambridge 2004.)
 *
 *   p      the problem; alpha < 1
 *   nodes  4 to 20 Gauss nodes a panel
 *   panel  the longest panel, short enough for Picard's iteration
 *   rows   output, (ROWS + 1) d positions
 *
 * Returns FVI_SUCCESS; FVI_ENOMEM; FVI_EMAXITER if an iteration does not end; what a
 * callback returned. */
int reference(const problem *p, int nodes, double panel, double *rows);

#endif
