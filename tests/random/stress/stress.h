/* tests/random/stress/stress.h -- The functions that the families of `make stress` share. */
#ifndef STRESS_H
#define STRESS_H

#include <fvi/fvi.h>

#include <gsl/gsl_rng.h>

/* stress_case -- run one random case of a family. Returns the used share of its allowance: a value above 1 is a
 * failure. A value below 0 means that the case was refused for a good reason or has no truth; more than one
 * such case in a hundred is a failure. describe gets one line that describes the case. */
typedef double stress_case(gsl_rng *random, char *describe, size_t size);

stress_case stress_exact, stress_halves, stress_quadruple, stress_rounding,
    stress_weights;                       /* against the truth */
stress_case stress_adaptive, stress_pulses; /* --error keeps its promise */
stress_case stress_mechanisms;          /* different methods agree */
stress_case stress_scatter, stress_found, stress_coverage, stress_rheology; /* fits keep their promises */
stress_case stress_matching, stress_dissipation, stress_balance, stress_scaling,
    stress_overflow, stress_memories, stress_refusals;

/* Return a random number, uniform in [low, high], or log-uniform between positive low and high. */
double stress_uniform(gsl_rng *random, double low, double high);
double stress_decades(gsl_rng *random, double low, double high);

/* Return an order alpha in [0, 1]; half the time one of the difficult values. */
double stress_alpha(gsl_rng *random);

/* Return 0, 1/2, 1, or any number in between. */
double stress_kappa(gsl_rng *random);

/* Return max |a_k - b_k|, and max |a_k|, over n numbers. */
double stress_distance(size_t n, const double *a, const double *b);
double stress_size(size_t n, const double *a);

#endif
