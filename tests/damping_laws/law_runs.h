/* tests/damping_laws/law_runs.h -- The laws of the references, and derivatives of runs with a
 * law, for the tests of H 26. */
#ifndef LAW_RUNS_H
#define LAW_RUNS_H

#include "damping_laws_ref.h"
#include "run/whole_run.h"

#include <fvi/fvi.h>
#include "harness/ulp.h"

#include <string.h>

enum {
    LAWS = LEN(ref_laws) + LEN(steep_laws),
    LAW_STEPS = 100, /* at most */
    LAW_NUMBERS = 8  /* x0, p0, m, rho, the factors of up to four terms */
};

static inline const fvi_kernel *law_of(size_t l)
{
    return l < LEN(ref_laws) ? &ref_laws[l] : &steep_laws[l - LEN(ref_laws)];
}

/* J = x at the end of the run, which params is. */
static inline int to_last(size_t k, size_t d, const double *x, const double *p,
                          void *params, double *Jx, double *Jp)
{
    const fvi_run *run = params;
    (void)d, (void)x, (void)p, (void)Jp;
    *Jx += k == run->steps;
    return 0;
}

/* x at the end of a Duffing oscillator of so many steps of 0.1, and its derivatives by
 * `at` if they are wanted. */
static inline double last_of(const fvi_method *method, const fvi_kernel *law,
                             size_t steps, const double *at, double *got)
{
    double x[LAW_STEPS + 1];
    const double spring[] = { 1, 1 };
    fvi_kernel_term term[LAW_NUMBERS - 4];
    for (size_t i = 0; i < law->count; i++) {
        term[i] = law->term[i];
        term[i].rho = at[4 + i];
    }
    const fvi_kernel moved = { law->count, term };
    const fvi_system system = { 1,      &at[2],
                                &at[3], fvi_potential_duffing(spring),
                                { 0 },  NULL, NULL };
    fvi_run run = fvi_run_default(&system, &at[0], &at[1], 0.1, steps);
    const fvi_objective J = { .slopes = to_last, .params = &run };
    run.law = &moved;
    run.alpha = 1; /* is not read */
    if (got) {
        fvi_sensitivities to = { .x0 = got,
                             .p0 = got + 1,
                             .mass = got + 2,
                             .damping = got + 3,
                             .terms = got + 4 };
        ck_assert_int_eq(fvi_adjoint(method, &run, NULL, NULL, &J, &to), 0);
    }
    ck_assert_int_eq(fvi_trajectory(method, &run, x, NULL, NULL), 0);
    return x[steps];
}

/* All of them to `bound`, against central differences of 1e-4. */
static inline void ck_assert_law_slopes(const fvi_method *method,
                                        const fvi_kernel *law, size_t steps,
                                        double bound)
{
    double at[LAW_NUMBERS] = { 1, 0.7, 1.25, 0.75 }, got[LAW_NUMBERS];
    ck_assert_uint_le(4 + law->count, LAW_NUMBERS);
    for (size_t i = 0; i < law->count; i++)
        at[4 + i] = law->term[i].rho;
    last_of(method, law, steps, at, got);
    for (size_t i = 0; i < 4 + law->count; i++) {
        double side[2];
        for (int j = 0; j < 2; j++) {
            double moved[LAW_NUMBERS];
            memcpy(moved, at, sizeof moved);
            moved[i] += j ? 1e-4 : -1e-4;
            side[j] = last_of(method, law, steps, moved, NULL);
        }
        ck_assert_near(got[i], (side[1] - side[0]) / 2e-4, bound,
                       "%s, %zu terms, the first of kind %d, alpha %g, by %zu",
                       method->name, law->count, (int)law->term[0].kind,
                       law->term[0].alpha, i);
    }
}

#endif
