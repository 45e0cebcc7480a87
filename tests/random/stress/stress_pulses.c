/* tests/random/stress/stress_pulses.c -- Forces with pulses that are shorter than a step. */
#include "stress.h"

#include "variable_steps/pulse_problems.h"

/* Runs with steps of any length keep the wanted error under a force with a pulse. */
double stress_pulses(gsl_rng *random, char *describe, size_t size)
{
    static pulse_problem q;
    draw_pulse(random, &q);
    const double used = used_by_pulse(&q, NULL);
    describe_pulse(&q, describe, size);
    return q.status ? 2 : used;
}
