/* src/command_gradient/fvi_gradient_complaint.h -- Say why there is no gradient. */
#ifndef FVI_GRADIENT_COMPLAINT_H
#define FVI_GRADIENT_COMPLAINT_H

#include "fvi_gradient_answer.h"

/* fvi_gradient_note_reasons -- With on = 1, keep the reasons that the library gives to its error handler, for
 * fvi_gradient_complain. With on = 0, restore the previous handler. */
void fvi_gradient_note_reasons(int on);

/* fvi_gradient_complain -- Print why there is no gradient. If the run without derivatives fails, too, name the step at
 * which it fails. Else print the library's reason for this code, or the text of the code. Return 1. */
int fvi_gradient_complain(fvi_gradient_request *r, int status);

#endif
