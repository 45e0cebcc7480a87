/* src/program/fvi_checkpoint.h -- The state of a run in a file. */
#ifndef FVI_CHECKPOINT_H
#define FVI_CHECKPOINT_H

#include "words/fvi_option_list.h"

/* fvi_checkpoint_write -- the state of the stepper into the file o->checkpoint: complete, or
 * what was there stays. Returns 0; 1 after it has said what is wrong. */
int fvi_checkpoint_write(const fvi_options *o, fvi_stepper *s);

/* fvi_checkpoint_begin -- with --continue, go on from there; s has been started with the same
 * problem.
 *
 *   done  output: the step that was saved; rows up to there are printed. s stands there;
 *         or, if the memory depends on N and that is another one, at the start, as a line
 *         on standard error says
 *
 * Returns 0; 2 after it has said why not: the method cannot be saved, or the file is
 * damaged, or of another version, problem or machine; 1 if there is no memory. */
int fvi_checkpoint_begin(const fvi_options *o, fvi_stepper *s, size_t *done);

/* fvi_checkpoint_due -- nonzero ten seconds after it last was, or was first asked. */
int fvi_checkpoint_due(void);

/* fvi_checkpoint_watch -- SIGTERM, SIGINT and SIGHUP no longer end the program at once.
 * fvi_checkpoint_stopped: did one of them come? fvi_checkpoint_end: let it end then. */
void fvi_checkpoint_watch(void);
int fvi_checkpoint_stopped(void);
void fvi_checkpoint_end(void);

#endif
