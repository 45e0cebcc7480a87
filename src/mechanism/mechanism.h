/* src/mechanism/mechanism.h -- Steps of a system with a mechanism.            [H 29]
 *
 * Internal: the methods start these steps in place of their own where the system has a
 * mechanism. */
#ifndef FVI_MECHANISM_H
#define FVI_MECHANISM_H

#include <fvi/dampers.h>

/* Order 1, (29.5); the node scheme, (29.6); stages, form M, (29.7), and form D, (29.8). */
typedef enum {
    FVI_MECHANISM_FIRST_ORDER,
    FVI_MECHANISM_NODES,
    FVI_MECHANISM_FORM_M,
    FVI_MECHANISM_FORM_D
} fvi_mechanism_form;

/* fvi_has_mechanism_steps -- has the system a mechanism that these steps take? With matrices it is
 * another matter. In the header: the live page has no such steps, and links none. */
static inline int fvi_has_mechanism_steps(const fvi_system *system)
{
    return system->mechanism && !system->matrices;
}

/* fvi_has_dampers_of_matrices -- has it several dampers, each with a matrix? */
static inline int fvi_has_dampers_of_matrices(const fvi_system *system)
{
    return system->matrices && system->mechanism;
}

/* fvi_mechanism_start -- as the start of a method; s->method becomes a copy of it with these steps.
 *
 *   stages  of forms M and D; not read else
 *
 * Returns what fvi_stepper_start does, and says in *error what is refused; error may be NULL. */
int fvi_mechanism_start(fvi_stepper *s, fvi_mechanism_form form, size_t stages);

/* fvi_mechanism_check -- is the mechanism of a system one that a method can take? Its fields and
 * numbers alone; what depends on the start is seen by fvi_mechanism_start. */
int fvi_mechanism_check(const fvi_method *method, const fvi_run *run,
                        fvi_error *error);

/* fvi_mechanism_bytes -- as fvi_run_bytes; of a mesh with the least number of stages, which the tolerance may raise. */
enum { FVI_MESH_STAGES = 6 };
double fvi_mechanism_bytes(const fvi_method *method, const fvi_run *run);

#endif
