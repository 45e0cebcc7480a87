/* src/command_gradient/fvi_gradient_complaint.h -- Why there is no gradient. */
#ifndef FVI_GRADIENT_COMPLAINT_H
#define FVI_GRADIENT_COMPLAINT_H

#include "fvi_gradient_answer.h"

/* fvi_gradient_note_reasons -- with 1: keep the reasons that the library gives its error handler, for
 * fvi_gradient_complain. With 0: the handler from before comes back. */
void fvi_gradient_note_reasons(int on);

/* fvi_gradient_complain -- say why there is no gradient: the step, if the run alone fails, too; else
 * the library's reason for this code, or the code in words. Returns the exit code, 1. */
int fvi_gradient_complain(fvi_gradient_request *r, int status);

#endif
