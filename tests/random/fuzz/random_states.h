/* tests/random/fuzz/random_states.h -- States of runs that a stranger wrote. */
#ifndef RANDOM_STATES_H
#define RANDOM_STATES_H

#include <stddef.h>

/* random_state -- the case that the dice are seeded for: a run is saved, some numbers of
 * what steps change become others, as in a file with a checksum that somebody made anew,
 * and a run goes on from there. fvi_stepper_archive must refuse the state with FVI_EINVAL, and leave
 * a run that can be reset; or steps must end, well or with a code. The sanitizers see the
 * rest. Returns NULL, or what went wrong; *refused counts the states that were refused. */
const char *random_state(size_t *refused);

/* The words of the last case. */
const char *random_state_words(void);

#endif
