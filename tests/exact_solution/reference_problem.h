/* tests/exact_solution/reference_problem.h -- The problem of a reference value. */
#ifndef REFERENCE_PROBLEM_H
#define REFERENCE_PROBLEM_H

#include "exact_solution_ref.h"

#include <fvi/fvi.h>

static inline fvi_linear_oscillator reference_problem(size_t i)
{
    return (fvi_linear_oscillator){ ref_solutions[i].m,
                                    ref_solutions[i].c,
                                    ref_solutions[i].rho,
                                    ref_solutions[i].alpha,
                                    (fvi_initial_history)ref_solutions[i].past,
                                    ref_solutions[i].x0,
                                    ref_solutions[i].v0,
                                    (fvi_forcing)ref_solutions[i].forcing,
                                    ref_solutions[i].A,
                                    ref_solutions[i].T,
                                    ref_solutions[i].w,
                                    NULL };
}

#endif
