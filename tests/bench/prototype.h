/* tests/bench/prototype.h -- The measurements of the prototype of variable steps: its errors, its steps, its
 * microseconds on its machine. [H 22] */
#ifndef BENCH_PROTOTYPE_H
#define BENCH_PROTOTYPE_H

#include <stddef.h>

#define ITS_RK8PD 13.2 /* microseconds */

/* Constant steps, from 160 to 320 or until rounding. Problem 0 is the plate, 1 a cosine, 2 a start away from
 * zero. */
static const struct {
    int problem;
    char form;
    int s;
    double x, p;
} its_orders[] = {
    { 0, 'M', 3, 3.5, 2.6 }, { 0, 'M', 4, 4.5, 3.6 }, { 0, 'M', 5, 5.8, 4.8 },
    { 0, 'M', 6, 6.9, 5.7 }, { 0, 'D', 3, 4.0, 3.9 }, { 0, 'D', 4, 5.9, 5.9 },
    { 0, 'D', 5, 7.8, 7.9 }, { 0, 'D', 6, 9.0, 10. }, { 1, 'D', 3, 4.0, 4.0 },
    { 1, 'D', 4, 6.0, 5.4 }, { 1, 'D', 5, 7.4, 6.4 }, { 1, 'D', 6, 8.2, 7.4 },
    { 2, 'M', 3, 4.1, 3.4 }, { 2, 'M', 4, 5.3, 4.4 }, { 2, 'M', 5, 6.4, 5.4 },
    { 2, 'M', 6, 7.6, 6.5 }, { 2, 'D', 3, 4.0, 4.0 }, { 2, 'D', 4, 6.0, 6.0 },
    { 2, 'D', 5, 8.0, 8.0 }, { 2, 'D', 6, 9.9, 9.9 },
};

static const struct {
    char form;
    int s;
    size_t N;
    double error;
} its_uniform[] = { { 'D', 6, 80, 2.6e-12 },
                    { 'D', 7, 80, 2.4e-14 },
                    { 'M', 6, 160, 6.4e-13 },
                    { 'M', 4, 1280, 4.2e-13 } };

typedef enum { AT_ENDS, IN_ROWS, IN_80 } its_where;

/* Form, stages and tolerance of the prototype; 0 steps or microseconds: unknown. */
static const struct {
    int problem;
    const char *form;
    its_where where;
    double error;
    size_t steps;
    double time;
} its_runs[] = {
    { PLATE, "D6 1e-4", AT_ENDS, 3.3e-9, 27, 10.5 },
    { PLATE, "D6 1e-6", AT_ENDS, 6.0e-10, 36, 13.6 },
    { PLATE, "D6 1e-8", AT_ENDS, 1.1e-12, 59, 20 },
    { PLATE, "D6 1e-10", AT_ENDS, 1.3e-14, 101, 31 },
    { PLATE, "D6 1e-12", AT_ENDS, 6.7e-15, 184, 53 },
    { PLATE, "M6 1e-4", AT_ENDS, 8.4e-7, 26, 9 },
    { PLATE, "M6 1e-6", AT_ENDS, 6.8e-8, 38, 12 },
    { PLATE, "M6 1e-8", AT_ENDS, 5.5e-10, 64, 18 },
    { PLATE, "M6 1e-10", AT_ENDS, 6.8e-12, 112, 29 },
    { PLATE, "M6 1e-12", AT_ENDS, 1.7e-13, 211, 52 },
    { PLATE, "D8 1e-4", AT_ENDS, 7.4e-11, 25, 12.6 },
    { PLATE, "D8 1e-5", AT_ENDS, 2.6e-12, 29, 15 },
    { PLATE, "D8 1e-6", AT_ENDS, 1.6e-12, 32, 15.8 },
    { PLATE, "D8 1e-7", AT_ENDS, 1.2e-13, 36, 18 },
    { PLATE, "D8 1e-8", AT_ENDS, 3.7e-14, 42, 21 },
    { PLATE, "D8 1e-10", AT_ENDS, 2.6e-14, 62, 29 },
    { PLATE, "D8 1e-12", AT_ENDS, 2.0e-14, 93, 39 },
    { PLATE, "M8 1e-4", AT_ENDS, 1.8e-9, 25, 12 },
    { PLATE, "M8 1e-6", AT_ENDS, 1.3e-9, 31, 15 },
    { PLATE, "M8 1e-8", AT_ENDS, 9.1e-11, 43, 20 },
    { PLATE, "M8 1e-10", AT_ENDS, 2.5e-12, 64, 27 },
    { PLATE, "M8 1e-11", AT_ENDS, 2.4e-13, 76, 32 },
    { PLATE, "M8 1e-12", AT_ENDS, 4.2e-14, 95, 38 },
    { LATE, "D8 1e-10", AT_ENDS, 2.0e-14, 60, 28 },
    { LATE, "D8 1e-6", IN_ROWS, 2.1e-10, 0, 0 },
    { LATE, "D8 1e-8", IN_ROWS, 2.0e-11, 0, 0 },
    { LATE, "D8 1e-10", IN_ROWS, 3.2e-13, 60, 28 },
    { LATE, "D8 1e-12", IN_ROWS, 1.8e-14, 0, 0 },
    { LATE, "M8 1e-6", IN_ROWS, 4e-9, 0, 0 },
    { LATE, "M8 1e-8", IN_ROWS, 6e-10, 0, 0 },
    { LATE, "M8 1e-10", IN_ROWS, 7e-12, 0, 0 },
    { LATE, "M8 1e-12", IN_ROWS, 1e-13, 0, 0 },
    { SPRING, "M8", AT_ENDS, 3.0e-15, 0, 9.4 },
    { DUFFING, "D8 1e-7", AT_ENDS, 7e-11, 0, 131 },
    { DUFFING, "D8 1e-7", IN_ROWS, 1e-8, 0, 131 },
    { DUFFING, "D8 1e-9", AT_ENDS, 5e-14, 0, 175 },
    { DUFFING, "D8 1e-9", IN_ROWS, 4e-11, 0, 175 },
    { CHAIN, "M8 1e-10", IN_80, 4.9e-13, 24, 230 },
    { CHAIN, "D8 1e-10", IN_80, 4.7e-13, 24, 290 },
    { CHAIN, "M7 1e-12", IN_80, 1.4e-14, 0, 370 },
    { KICKED, "D8 1e-12", IN_ROWS, 4e-15, 0, 47 },
    { SLOW, "D8", AT_ENDS, 6e-14, 109, 55 },
    { SLOW_HIGH, "D8", AT_ENDS, 1e-13, 99, 50 },
    { SLOWER, "D8", AT_ENDS, 6e-14, 252, 0 },
    { SLOWER_HIGH, "D8", AT_ENDS, 1e-13, 104, 0 },
};

/* The tolerance is 1e-12, with eight stages: form M with a force and Caputo's past, form D with Riemann and
 * Liouville's past. */
static const struct {
    int singular;
    double alpha, error;
    size_t steps;
} its_alphas[] = {
    { 0, 0.001, 6e-14, 0 },  { 0, 0.1, 1e-14, 0 },
    { 0, 0.25, 7e-15, 0 },   { 0, 0.4, 5e-15, 0 },
    { 0, 0.49, 2e-15, 0 },   { 0, 0.499999, 2e-15, 0 },
    { 0, 0.5, 3e-15, 0 },    { 0, 0.500001, 1e-14, 0 },
    { 0, 0.51, 5e-15, 0 },   { 0, 0.6, 5e-15, 0 },
    { 0, 0.75, 2e-14, 0 },   { 0, 0.9, 1.5e-14, 0 },
    { 0, 0.99, 4e-14, 0 },   { 0, 0.9999, 4e-14, 0 },
    { 1, 0.02, 7e-15, 0 },   { 1, 0.05, 9e-15, 0 },
    { 1, 0.2, 4e-15, 0 },    { 1, 0.3, 4e-15, 0 },
    { 1, 0.4, 8e-15, 0 },    { 1, 0.45, 9e-15, 0 },
    { 1, 0.49, 1e-14, 0 },   { 1, 0.499, 9e-15, 0 },
    { 1, 0.51, 8e-16, 0 },   { 1, 0.6, 1e-15, 0 },
    { 1, 0.75, 4e-15, 0 },   { 1, 0.9, 1.4e-14, 0 },
    { 1, 0.95, 1.5e-14, 0 },
};

/* m, rho, c, x0, v0; a cosine of frequency w. */
static const struct {
    const char *name;
    double alpha, of[5], w, T, tolerance, error;
    size_t steps;
    double ms;
} its_long[] = {
    { "driven, T = 20000",
      0.3,
      { 1, 0.1, 1, 0, 0 },
      0.5,
      2e4,
      1e-11,
      3e-12,
      43646,
      18 },
    { "a fast spring",
      0.3,
      { 1, 1e-6, 1e8, 1, 0 },
      0,
      2,
      1e-9,
      1.2e-8,
      23233,
      0 },
    { "strong damping", 0.2, { 1, 1e6, 1, 1, 0 }, 0, 20, 1e-11, 0, 32, 0 },
};

#endif
