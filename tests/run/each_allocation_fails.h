/* tests/run/each_allocation_fails.h -- Of all allocations within a call of the library one fails: the call says
 * FVI_ENOMEM, nothing ends the process, and no block is left.
 *
 * For one file of a test. Where a sanitizer brings its own allocator nothing is tested. */
#ifndef EACH_ALLOCATION_FAILS_H
#define EACH_ALLOCATION_FAILS_H

#include <fvi/fvi.h>
#include "harness/ulp.h"
#include "failing_allocator.h"

/* A call for a method; of another status than 0 where the method does not take it. */
typedef struct {
    int (*make)(const fvi_method *method);
    int is_long;     /* not each of its allocations fails, but one of 8 of the later ones */
    int may_succeed; /* UMFPACK may ask for less, and go on */
} library_call;

static inline void fail_each_allocation(size_t count, const library_call *calls)
{
    size_t said = 0;
#ifdef OTHER_ALLOCATOR
    return;
#endif
    for (size_t c = 0; c < count; c++)
        for (size_t m = 0; fvi_methods[m]; m++) {
            failing = 0;
            if (calls[c].make(fvi_methods[m]))
                continue; /* not for this method */
            for (size_t n = 1;; n += calls[c].is_long ? 1 + n / 8 : 1) {
                made = 0;
                has_failed = 0;
                failing = n;
                const long before = alive;
                const int status = calls[c].make(fvi_methods[m]);
                const long left = alive - before;
                failing = 0;
                if (!has_failed)
                    break;
                ck_assert_msg(status == FVI_ENOMEM || (calls[c].may_succeed && !status), "call %zu of %s: %zu: %d", c,
                              fvi_methods[m]->name, n, status);
                ck_assert_msg(left == 0, "call %zu of %s: %zu: %ld blocks left", c, fvi_methods[m]->name, n, left);
                said++;
            }
        }
    ck_assert_uint_gt(said, 500);
}

/* ---- three masses ---- */

static double mass[] = { 1, 2, 1 }, rho[] = { 0.3, 0.2, 0.1 },
                    x0[] = { 1, 0, 0.5 }, p0[] = { 0.5, 0.1, 0 },
                    cg[] = { 1, 0.5 };

static fvi_run run_of(fvi_system *system, const fvi_kernel *law)
{
    *system = (fvi_system){ .d = 3,
                            .mass = mass,
                            .damping = rho,
                            .potential = fvi_potential_chain(cg) };
    fvi_run run = fvi_run_default(system, x0, p0, 0.1, 80);
    run.alpha = law ? 0.5 : 0.3;
    run.law = law;
    return run;
}

#endif
