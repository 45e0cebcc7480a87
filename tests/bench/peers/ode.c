/* tests/bench/peers/ode.c -- Solvers of ordinary differential equations, for alpha = 1/2. [H 18]
 *
 * Then x' = v, m v' = F - grad U(x) - rho v is an ordinary differential equation. GSL's rk8pd (P. J. Prince, J.
 * R. Dormand, J. Comput. Appl. Math. 7 (1981)) solves it with its step control, and with steps of one length. The
 * Radau IIA methods are in radau.c; Euler's methods are methods of the library. */
#include "peers.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <stdlib.h>
#include <string.h>

/* Compute the slopes f of y = (x, v). */
static int slope(double t, const double y[], double f[], void *params)
{
    const problem *p = params;
    const fvi_system *s = &p->system;
    const size_t d = s->d;
    int status = fvi_potential_gradient(s, y, f);
    for (size_t a = 0; a < d; a++)
        f[d + a] = -(f[a] + s->damping[a] * y[d + a]) / s->mass[a];
    if (!status && s->force.value) {
        status = s->force.value(t, d, s->force.params, f);
        for (size_t a = 0; a < d; a++)
            f[d + a] += f[a] / s->mass[a];
    }
    memcpy(f, y + d, d * sizeof *f);
    return status;
}

static void begin(const problem *p, double *y, double *rows)
{
    const size_t d = p->system.d;
    for (size_t a = 0; a < d; a++) {
        y[a] = rows[a] = p->x0[a];
        y[d + a] = p->p0[a] / p->system.mass[a];
    }
}

static int run_controlled(const task *of, double *rows)
{
    const problem *p = of->p;
    const size_t d = p->system.d;
    double *y = malloc(2 * d * sizeof *y);
    gsl_odeiv2_system system = { slope, NULL, 2 * d, (void *)(size_t)p };
    gsl_odeiv2_driver *driver = gsl_odeiv2_driver_alloc_y_new(
        &system, gsl_odeiv2_step_rk8pd, 0.1, of->tolerance, 0);
    int status = y && driver ? GSL_SUCCESS : GSL_ENOMEM;
    double t = 0;
    if (!status)
        begin(p, y, rows);
    for (size_t k = 1; k <= ROWS && !status; k++) {
        status =
            gsl_odeiv2_driver_apply(driver, &t, p->T * (double)k / ROWS, y);
        memcpy(rows + k * d, y, d * sizeof *y);
    }
    gsl_odeiv2_driver_free(driver);
    free(y);
    return status;
}

/* Make N steps of one length by a stepper of GSL, which keeps the last slope for the next step. */
static int run_uniform(const task *of, double *rows)
{
    const problem *p = of->p;
    const size_t d = p->system.d, every = of->N / ROWS;
    const double h = p->T / (double)of->N;
    double *y = malloc(8 * d * sizeof *y), *error = y + 2 * d,
           *before = y + 4 * d, *after = y + 6 * d;
    gsl_odeiv2_system system = { slope, NULL, 2 * d, (void *)(size_t)p };
    gsl_odeiv2_step *step = gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, 2 * d);
    int status = y && step ? GSL_SUCCESS : GSL_ENOMEM;
    if (!status) {
        begin(p, y, rows);
        status = slope(0, y, before, system.params);
    }
    for (size_t k = 0; k < of->N && !status; k++) {
        status = gsl_odeiv2_step_apply(step, h * (double)k, h, y, error, before,
                                       after, &system);
        memcpy(before, after, 2 * d * sizeof *y);
        if ((k + 1) % every == 0)
            memcpy(rows + (k + 1) / every * d, y, d * sizeof *y);
    }
    gsl_odeiv2_step_free(step);
    free(y);
    return status;
}

static int half(const problem *p)
{
    return p->alpha == 0.5;
}

static const char why[] = "nothing is remembered, so the problem is an "
                          "ordinary differential equation";
const peer peer_rk8pd = { "rk8pd", "Prince, Dormand 1981; GSL",
                          why,     1,
                          0,       0,
                          half,    run_controlled },
           peer_rk8pd_uniform = { "rk8pd, uniform",
                                  "Prince, Dormand 1981; GSL",
                                  why,
                                  0,
                                  ROWS,
                                  0,
                                  half,
                                  run_uniform };
