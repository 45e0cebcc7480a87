/* tests/lagrangian/saved.h -- An archive in memory: what is saved once is restored by the next call. */
#ifndef SAVED_H
#define SAVED_H

#include <fvi/archive.h>

#include <string.h>

typedef struct {
    fvi_archive archive;
    char *room;
    size_t at;
    int is_saved;
} saved;

static inline int serialize(fvi_archive *archive, void *data, size_t bytes, int constant)
{
    saved *to = (saved *)archive;
    char *here = to->room + to->at;
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

#endif
