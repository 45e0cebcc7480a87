/* tests/bench/variable.h -- Runs with steps of any length, for two benchmarks. [H 22] */
#ifndef BENCH_VARIABLE_H
#define BENCH_VARIABLE_H

#include <fvi/exact_solution.h>
#include <fvi/fvi.h>

enum { BENCH_ROWS = 400, BENCH_MASSES = 32, BENCH_STEPS = 100000 };

typedef struct {
    const char *name;
    fvi_system system;
    fvi_run run; /* all members but run.system and the tolerance */
    int linear;  /* then its exact solution: */
    fvi_linear_oscillator exact;
    double truth[(BENCH_ROWS + 1)
                 * BENCH_MASSES]; /* else the rows of a run with the tolerance 1e-14 */
    double fixed[8];              /* the numbers that system, run and force point to */
} bench_problem;

/* The problems of bench_variable_steps.c. */
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

/* Set up m x'' + rho D^{2 alpha} x + c x = 0 from x0, v0 to T, whose exact solution is known. bench_step and
 * bench_cosine add forces: A until T; A cos(w t). */
void bench_linear(bench_problem *P, const char *name, double alpha,
                  const double *m_rho_c_x0_v0, double T);
void bench_step(bench_problem *P, double A, double T);
void bench_cosine(bench_problem *P, double A, double w);

/* Compute the true rows. Call it when everything else is set. */
void bench_truth(bench_problem *P);

/* Compute the rows of a run, by dense output. v may be NULL. */
void bench_rows(const bench_problem *P, double tolerance, double *x, double *v);

/* Return a stepper at its start. The caller frees it. */
fvi_stepper *bench_start(const bench_problem *P, double tolerance);

/* Compute the steps of a run: their number, their ends, and x there if x is not NULL. */
fvi_step_statistics bench_steps(const bench_problem *P, double tolerance,
                                double *t, double *x);

/* Compute the largest errors at the ends of steps and in the rows, of which only every so many is taken. */
fvi_step_statistics bench_errors(const bench_problem *P, double tolerance,
                                 size_t every, double *ends, double *rows);

/* Return the least seconds of several runs, from fvi_stepper_start to fvi_stepper_free, without rows. */
double bench_seconds(const bench_problem *P, double tolerance);

/* Return the same divided by the seconds of GSL's rk8pd on SPRING, by its own steps, with the tolerance 1e-12.
 * Both are the least of many runs in turn, because a shared machine is not always equally fast. *rk8pd: its
 * seconds; rk8pd may be NULL. */
double bench_over_rk8pd(const bench_problem *P, double tolerance,
                        double *rk8pd);

/* Print the tables of 200 random problems beside those of the prototype: prototype_random.c. */
void prototype_random(void);
void prototype_two_runs(void);

/* End the program if status is not 0. */
void bench_need(int status);

#endif
