/* src/command_run/fvi_checkpoint.h -- The state of a run in a file. */
#ifndef FVI_CHECKPOINT_H
#define FVI_CHECKPOINT_H

#include "output/fvi_table.h"

#include <stdio.h>
#include <sys/types.h>

/* A piece of the file that was read. */
typedef struct {
    off_t begin, length;
} fvi_checkpoint_part;

typedef struct {
    char *head;  /* of this run, as its files were when it began */
    FILE *saved; /* what --continue goes on from, or NULL */
    size_t done; /* the step that was saved; rows up to there exist */
    int anew; /* the memory depends on N, which is another one: s is at its start */
    fvi_checkpoint_part
        part[3]; /* the form of the table, its rows, those drawn */
} fvi_checkpoint;

/* fvi_checkpoint_begin -- with --continue, go on from there; s has been started with the same
 * problem. Nothing is done without --checkpoint. Returns 0; 2 after it has said why not:
 * the method cannot be saved, or the file is damaged, or of another version, problem or
 * machine, or a file that the run reads has changed; 1 if there is no memory. c is to be
 * freed in each case. */
int fvi_checkpoint_begin(fvi_table *t, fvi_stepper *s,
                         fvi_checkpoint *c);
void fvi_checkpoint_free(fvi_checkpoint *c);

/* fvi_checkpoint_judge_rows -- with which row does the table, which is open and empty, go on?
 * Returns 0; 2 after it has said why rows cannot follow those before.
 * fvi_checkpoint_rows: into the table, which has its head now, the rows that were saved as they
 * stood in no file, so that it becomes that of a run that was never stopped. Returns 0; 1
 * after it has said what is wrong. */
int fvi_checkpoint_judge_rows(const fvi_checkpoint *c, fvi_table *t);
int fvi_checkpoint_rows(const fvi_checkpoint *c, fvi_table *t);

/* fvi_checkpoint_write -- the state of the stepper, and the rows that are in no file before the
 * table is whole, into the file t->o->checkpoint: complete, or what was there stays. Returns
 * 0; 1 after it has said what is wrong. */
int fvi_checkpoint_write(const fvi_checkpoint *c, const fvi_table *t,
                         fvi_stepper *s);

/* fvi_checkpoint_due -- nonzero ten seconds after it last was, or was first asked. */
int fvi_checkpoint_due(void);

/* fvi_checkpoint_watch -- the first of SIGTERM, SIGINT and SIGHUP no longer ends the program at
 * once, the second does, and so does the first, a second later, where the program waits for
 * a reader of its rows: fvi_checkpoint_in_rows says that it writes them, or no longer.
 * fvi_checkpoint_stopped: did one of them come? fvi_checkpoint_unwatch: the next one ends
 * the program again. fvi_checkpoint_end: let the one that came end it. */
void fvi_checkpoint_watch(void);
void fvi_checkpoint_in_rows(int now);
int fvi_checkpoint_stopped(void);
void fvi_checkpoint_unwatch(void);
void fvi_checkpoint_end(void);

#endif
