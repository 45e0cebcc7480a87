/* tests/course/library_run.h -- The running body of the Course, by the library. */
#ifndef LIBRARY_RUN_H
#define LIBRARY_RUN_H
#include "run/whole_run.h"

/* The same run by the library. */
static const double *library_run(const fvi_method *method, double order, double middle, int N)
{
    static double rows[20001];
    const fvi_system system = { .d = 1,
                                .mass = &(double){ 1 },
                                .damping = &(double){ 0.5 },
                                .potential = fvi_potential_harmonic(&(double){ 1 }) };
    fvi_run settings = fvi_run_default(&system, &(double){ 1 }, &(double){ 0 }, 0.1, (size_t)N);
    settings.alpha = order;
    settings.kappa = middle;
    ck_assert_int_eq(fvi_trajectory(method, &settings, rows, NULL, NULL), FVI_SUCCESS);
    return rows;
}

#endif
