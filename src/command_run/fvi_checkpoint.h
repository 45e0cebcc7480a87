/* src/command_run/fvi_checkpoint.h -- Write the state of a run to a file, and go on from it. */
#ifndef FVI_CHECKPOINT_H
#define FVI_CHECKPOINT_H

#include "output/fvi_table.h"

#include <stdio.h>
#include <sys/types.h>

/* A part of the file that was read, in bytes. */
typedef struct {
    off_t begin, length;
} fvi_checkpoint_part;

typedef struct {
    char *head;  /* head of this run, from its files as they were when it began */
    FILE *saved; /* the file from which --continue goes on, or NULL */
    size_t done; /* number of steps at the time of the checkpoint; the rows up to there exist */
    /* Nonzero if the run begins again, because its memory depends on the number of steps, which has changed, or on the
     * build of the program. */
    int anew;
    fvi_checkpoint_part
        part[3]; /* the form of the table, its rows, the rows of the picture */
} fvi_checkpoint;

/* fvi_checkpoint_begin -- Read the head of this run and, with --continue, the saved state. s must have been started
 * with the same problem. Without --checkpoint nothing is done. Return 0. Return 2 after a message if the method cannot
 * be saved, if the file is damaged or belongs to another version, problem or machine, or if a file that the run reads
 * has changed. Return 1 after a message if there is no memory. Call fvi_checkpoint_free in each case. */
int fvi_checkpoint_begin(fvi_table *t, fvi_stepper *s,
                         fvi_checkpoint *c);
void fvi_checkpoint_free(fvi_checkpoint *c);

/* fvi_checkpoint_judge_rows -- Find the row with which the table goes on. The table is open and empty. Return 0, or 2
 * after a message if this table cannot follow the rows that were saved.
 * fvi_checkpoint_rows -- Copy the saved rows into the table, which has its head already. With them the table becomes
 * that of a run that was never stopped. Return 0, or 1 after a message. */
int fvi_checkpoint_judge_rows(const fvi_checkpoint *c, fvi_table *t);
int fvi_checkpoint_rows(const fvi_checkpoint *c, fvi_table *t);

/* fvi_checkpoint_write -- Write the state of the stepper to the file t->o->checkpoint, and the rows that will be in no
 * file before the table is complete. If that fails, the old file stays. Return 0, or 1 after a message. */
int fvi_checkpoint_write(const fvi_checkpoint *c, const fvi_table *t,
                         fvi_stepper *s);

/* fvi_checkpoint_due -- Return nonzero if ten seconds have passed since it last returned nonzero, or since the first
 * call. */
int fvi_checkpoint_due(void);

/* fvi_checkpoint_watch -- From now on the first SIGTERM, SIGINT or SIGHUP does not end the program at once, so that the
 * step can end and a checkpoint can be written. The second signal ends the program. The first one ends it, too, after a
 * second, if the program is writing rows and its reader does not read them.
 * fvi_checkpoint_in_rows -- Say whether the program is writing rows.
 * fvi_checkpoint_stopped -- Return nonzero if one of the signals has come.
 * fvi_checkpoint_unwatch -- From now on a signal ends the program again.
 * fvi_checkpoint_end -- If a signal has come, end the program by it. */
void fvi_checkpoint_watch(void);
void fvi_checkpoint_in_rows(int now);
int fvi_checkpoint_stopped(void);
void fvi_checkpoint_unwatch(void);
void fvi_checkpoint_end(void);

#endif
