/* tests/bench/variable.h -- Runs with steps of any length, for two benchmarks. [H 22] */
#ifndef BENCH_VARIABLE_H
#define BENCH_VARIABLE_H

#include <fvi/exact_solution.h>
#include <fvi/fvi.h>

enum { BENCH_ROWS = 400, BENCH_MASSES = 32, BENCH_STEPS = 100000 };

typedef struct {
    const char *name;
    fvi_system system;
    fvi_run run; /* but for run.system and the tolerance */
    int linear;  /* then its exact solution: */
    fvi_linear_oscillator exact;
    double truth[(BENCH_ROWS + 1)
                 * BENCH_MASSES]; /* else that of a run with 1e-14 */
    double fixed[8];              /* what system, run and force point to */
} bench_problem;

/* What bench_variable_steps.c says of each. */
enum {
    PLATE,
    LATE,
    SPRING,
    DUFFING,
    CHAIN,
    KICKED,
    SLOW,
    SLOW_HIGH,
    SLOWER,
    SLOWER_HIGH,
    BENCH_PROBLEMS
};
void bench_problems(bench_problem *all);

/* m x'' + rho D^{2 alpha} x + c x = 0 from x0, v0 to T, its exact solution known. Forces are
 * added by bench_step and bench_cosine: A until T; A cos(w t). */
void bench_linear(bench_problem *P, const char *name, double alpha,
                  const double *m_rho_c_x0_v0, double T);
void bench_step(bench_problem *P, double A, double T);
void bench_cosine(bench_problem *P, double A, double w);

/* The truth in the rows, once all else is set. */
void bench_truth(bench_problem *P);

/* Its rows, by dense output; v may be NULL. */
void bench_rows(const bench_problem *P, double tolerance, double *x, double *v);

/* A stepper at its start, to be stopped. */
fvi_stepper *bench_start(const bench_problem *P, double tolerance);

/* Its steps: how many, their ends, and x there if it is asked for. */
fvi_step_statistics bench_steps(const bench_problem *P, double tolerance,
                                double *t, double *x);

/* The largest errors at the ends of its steps and in every so many of the rows. */
fvi_step_statistics bench_errors(const bench_problem *P, double tolerance,
                                 size_t every, double *ends, double *rows);

/* The least seconds of several runs, from fvi_stepper_start to fvi_stepper_free, without rows. */
double bench_seconds(const bench_problem *P, double tolerance);

/* The same over those of GSL's rk8pd on SPRING, by its own steps, with the tolerance 1e-12:
 * both the least of many runs by turns, as a machine that others share is not always as
 * fast. rk8pd may be NULL: its seconds. */
double bench_over_rk8pd(const bench_problem *P, double tolerance,
                        double *rk8pd);

/* Tables of 200 random problems beside the prototype's: prototype_random.c. */
void prototype_random(void);
void prototype_two_runs(void);

/* Ends the program if status is not 0. */
void bench_need(int status);

#endif
