/* src/program/fvi_gradient_complaint.h -- Why there is no gradient. */
#ifndef FVI_GRADIENT_COMPLAINT_H
#define FVI_GRADIENT_COMPLAINT_H

#include "fvi_gradient_answer.h"

/* fvi_gradient_note_reasons -- from 1 to 0 the reasons that the library gives are kept. */
void fvi_gradient_note_reasons(int on);

/* fvi_gradient_complain -- what the gradient failed of: the step, if the run alone fails, too; else
 * the library's reason for this code, or the code in words. Returns the exit code, 1. */
int fvi_gradient_complain(fvi_gradient_request *r, int status);

#endif
