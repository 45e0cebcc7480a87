/* tests/random/stress/stress_adaptive.c -- Runs with variable steps keep the wanted error. */
#include "stress.h"

#include "variable_steps/adaptive_problems.h"

/* Three of four problems are linear and are compared with the exact motion. The others are compared with a run
 * with the error 1e-13 of a step. The allowance is 1.2 of the wanted error. A run that is refused for a good
 * reason counts as a case without a truth. Seen, seeds 1 to 6: 1 of 1000 at most. */
double stress_adaptive(gsl_rng *random, char *describe, size_t size)
{
    static adaptive_problem q;
    const int linear = gsl_rng_uniform_int(random, 4) > 0;
    draw(random, linear, &q);
    const double used = used_by(&q, linear);
    describe_problem(&q, describe, size);
    return used;
}
