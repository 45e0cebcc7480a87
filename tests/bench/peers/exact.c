/* tests/bench/peers/exact.c -- The exact solution of linear problems with one mass, and Podlubny's matrix method.
 * [H 18]
 *
 * The exact solution of H 11 (residues and a contour integral) needs no steps. Time by time it is a peer; in all
 * rows together it is the library's. The matrix method is (10.9) (I. Podlubny, Fract. Calc. Appl. Anal. 3
 * (2000)). */
#include "peers.h"

#include <fvi/paper/experiments.h>
#include <stdlib.h>

static int linear(const problem *p)
{
    return p->linear != NULL;
}

static int run_exact(const task *of, double *rows)
{
    double t[ROWS + 1];
    for (size_t k = 0; k <= ROWS; k++)
        t[k] = of->p->T * (double)k / ROWS;
    return fvi_exact_at(of->p->linear, ROWS + 1, t, rows, NULL, NULL);
}

/* Compute all rows from one contour or a few, with the wanted error, (11.15). */
static int run_rows(const task *of, double *rows)
{
    return fvi_exact_grid(of->p->linear, of->p->T / ROWS, ROWS, of->tolerance,
                          rows, NULL, NULL);
}

/* The problem starts from rest, and the order of its damping is above 1. */
static int from_rest(const problem *p)
{
    return p->linear && p->alpha > 0.5 && p->linear->x0 == 0
           && p->linear->v0 == 0;
}

static int run_matrix(const task *of, double *rows)
{
    const problem *p = of->p;
    const fvi_linear_oscillator *l = p->linear;
    double *x = malloc((of->N + 1) * sizeof *x);
    int status =
        x ? fvi_matrix_method(l->m, l->rho, l->c, l->alpha, p->system.force,
                              p->T / (double)of->N, of->N, x)
          : FVI_ENOMEM;
    for (size_t k = 0; k <= ROWS && !status; k++)
        rows[k] = x[k * (of->N / ROWS)];
    free(x);
    return status;
}

const peer peer_exact = { "exact solution",
                          "H 11",
                          "a linear motion need not be stepped to",
                          0,
                          0,
                          0,
                          linear,
                          run_exact },
           exact_by_rows = { "exact solution by rows",
                             "H 11",
                             "a linear motion need not be stepped to",
                             1,
                             0,
                             0,
                             linear,
                             run_rows },
           peer_matrix = { "matrix method",
                           "Podlubny 2000",
                           "its matrix is triangular",
                           0,
                           ROWS,
                           0,
                           from_rest,
                           run_matrix };
