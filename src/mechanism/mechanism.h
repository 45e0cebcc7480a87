/* src/mechanism/mechanism.h -- Take the steps of a system with a mechanism.            [H 29]
 *
 * This header is internal. If the system has a mechanism, the methods start these steps instead of their own. */
#ifndef FVI_MECHANISM_H
#define FVI_MECHANISM_H

#include <fvi/dampers.h>

/* The schemes: order 1, (29.5); the node scheme, (29.6); stages in form M, (29.7), and in form D, (29.8). */
typedef enum {
    FVI_MECHANISM_FIRST_ORDER,
    FVI_MECHANISM_NODES,
    FVI_MECHANISM_FORM_M,
    FVI_MECHANISM_FORM_D
} fvi_mechanism_form;

/* fvi_has_mechanism_steps -- Return nonzero if the system has a mechanism and no matrices, so that these steps apply.
 * The function is in the header, because the live page does not link these steps. */
static inline int fvi_has_mechanism_steps(const fvi_system *system)
{
    return system->mechanism && !system->matrices;
}

/* fvi_has_dampers_of_matrices -- Return nonzero if the system has matrices and several dampers, each with a matrix. */
static inline int fvi_has_dampers_of_matrices(const fvi_system *system)
{
    return system->matrices && system->mechanism;
}

/* fvi_mechanism_start -- Start a run with these steps. It serves as the member `start` of a method. s->method becomes a
 * copy of the method with these steps.
 *
 *   stages  number of stages in forms M and D; not used by the other schemes
 *
 * Return the codes of fvi_stepper_start. s->error, which may be NULL, says what is refused. */
int fvi_mechanism_start(fvi_stepper *s, fvi_mechanism_form form, size_t stages);

/* fvi_mechanism_check -- Check whether a method can take the mechanism of a system. The function checks the fields and
 * their numbers; fvi_mechanism_start checks what depends on the start. Return FVI_SUCCESS; FVI_EFAULT, FVI_EINVAL,
 * FVI_EUNSUP, or the code of fvi_kernel_check. */
int fvi_mechanism_check(const fvi_method *method, const fvi_run *run,
                        fvi_error *error);

/* fvi_mechanism_bytes -- Return the memory of a run as fvi_run_bytes does. For variable steps the smallest number of
 * stages is counted; the tolerance may need more. */
enum { FVI_MESH_STAGES = 6 };
double fvi_mechanism_bytes(const fvi_method *method, const fvi_run *run);

#endif
