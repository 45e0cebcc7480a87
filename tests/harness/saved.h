/* tests/harness/saved.h -- Save the state of a stepper (and of objects that belong to it) in memory, and restore
 * it in another one. */
#ifndef SAVED_H
#define SAVED_H

#include <check.h>
#include <fvi/archive.h>
#include <fvi/trajectory.h>

#include <stdlib.h>
#include <string.h>

typedef struct {
    fvi_archive archive; /* the first member, so that a pointer to it is a pointer to the saved_state */
    char *room;
    size_t at, size;
    int is_saved;
} saved_state;

static inline int pass_saved_piece(fvi_archive *archive, void *data, size_t bytes, int constant)
{
    saved_state *to = (saved_state *)archive;
    char *here = to->room + to->at;
    ck_assert_uint_le(to->at + bytes, to->size);
    to->at += bytes;
    if (bytes == 0) /* data may be NULL */
        return 0;
    if (!to->is_saved)
        memcpy(here, data, bytes);
    else if (constant)
        return memcmp(here, data, bytes) != 0;
    else
        memcpy(data, here, bytes);
    return 0;
}

/* begin_saving -- allocate memory for the following calls of archive functions. Free state.room at the end.
 * begin_restoring -- the following calls of archive functions read this memory. */
static inline saved_state begin_saving(void)
{
    enum { ROOM_OF_SAVED = 1 << 20 };
    const saved_state state = { .archive = { pass_saved_piece }, .room = malloc(ROOM_OF_SAVED), .size = ROOM_OF_SAVED };
    ck_assert_ptr_nonnull(state.room);
    return state;
}

static inline void begin_restoring(saved_state *state)
{
    state->is_saved = 1;
    state->at = 0;
}

static inline void save_and_restore(fvi_stepper *from, fvi_stepper *to)
{
    saved_state state = begin_saving();
    ck_assert_int_eq(fvi_stepper_archive(from, &state.archive), 0);
    const size_t size = state.at;
    begin_restoring(&state);
    ck_assert_int_eq(fvi_stepper_archive(to, &state.archive), 0);
    ck_assert_uint_eq(state.at, size);
    free(state.room);
}

#endif
