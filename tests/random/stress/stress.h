/* tests/random/stress/stress.h -- What the families of `make stress` share. */
#ifndef STRESS_H
#define STRESS_H

#include <fvi/fvi.h>

#include <gsl/gsl_rng.h>

/* One random case of a family. Returns how much of its allowance was used: above
 * 1 is a failure; below 0 it says nothing, refused for a reason or without a truth, and
 * more than one such case in a hundred is a failure. describe gets one line that says
 * what the case was. */
typedef double stress_case(gsl_rng *random, char *describe, size_t size);

stress_case stress_exact, stress_halves, stress_quadruple, stress_rounding,
    stress_weights;                       /* the truth */
stress_case stress_adaptive, stress_pulses; /* what --error promises */
stress_case stress_mechanisms;          /* methods against each other */
stress_case stress_scatter, stress_found, stress_coverage, stress_rheology; /* what a fit promises */
stress_case stress_matching, stress_dissipation, stress_balance, stress_scaling,
    stress_overflow, stress_memories, stress_refusals;

/* Uniform in [low, high]; log-uniform between positive low and high. */
double stress_uniform(gsl_rng *random, double low, double high);
double stress_decades(gsl_rng *random, double low, double high);

/* An order alpha in [0, 1]: half the time a value that is likely to hurt. */
double stress_alpha(gsl_rng *random);

/* 0, 1/2, 1, or anything between. */
double stress_kappa(gsl_rng *random);

/* max |a_k - b_k| and max |a_k| over n numbers. */
double stress_distance(size_t n, const double *a, const double *b);
double stress_size(size_t n, const double *a);

#endif
