/* tests/random/fuzz/random_states.h -- Damage the state of a run and continue the run. */
#ifndef RANDOM_STATES_H
#define RANDOM_STATES_H

#include <stddef.h>

/* random_state -- run the case for which the dice are seeded.
 *
 * The function saves a run, changes some numbers of the state that steps change, as in a file whose checksum
 * somebody made anew, and continues a run from this state. fvi_stepper_archive must refuse the state with
 * FVI_EINVAL and leave a run that can be reset; or the steps must end, with success or with a code. The
 * sanitizers check the rest. Returns NULL, or a description of the failure. *refused: the number of refused
 * states so far. */
const char *random_state(size_t *refused);

/* random_state_words -- the description of the last case. */
const char *random_state_words(void);

#endif
