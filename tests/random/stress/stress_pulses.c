/* tests/random/stress/stress_pulses.c -- Pulses of a force between the steps. */
#include "stress.h"

#include "variable_steps/pulse_problems.h"

/* A wanted error, by steps of any length, under a force with a pulse. */
double stress_pulses(gsl_rng *random, char *describe, size_t size)
{
    static pulse_problem q;
    draw_pulse(random, &q);
    const double used = used_by_pulse(&q, NULL);
    describe_pulse(&q, describe, size);
    return q.status ? 2 : used;
}
