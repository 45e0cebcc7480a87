/* src/adjoint_forces/adjoint_forces.h -- Derivatives of a J of the forces of dampers: a run with walls. [H 23]
 *
 * Internal to the room. A damper pushes two things: the body, and the wall that holds its other end. Let the wall be a
 * second body, so heavy that it does not move. Then its momentum is the impulse I of the damper. So a J that depends on
 * impulses is a J that depends on momenta of a run with more coordinates, and fvi_adjoint knows its derivatives.
 *
 *     damper between z and y, y the wall:  p_y(t_k) = I(t_k)
 *     coordinates that are damped one by one:  a ghost y of each coordinate x, with the force F - grad U(x + y) and
 *     without damping:  I(t_k) = p_0 - p_x(t_k) + p_y(t_k)                                   (23.33) */
#ifndef FVI_ADJOINT_FORCES_H
#define FVI_ADJOINT_FORCES_H

#include <fvi/adjoint.h>

/* The mass of a wall. A run whose masses, dampings and forces are below 1e130 moves no wall by a digit of the run's own
 * numbers. The square of this mass is still a double. */
#define FVI_WALL_MASS 1e150

/* The run with its walls.
 *
 *   d, n         how many coordinates the run has, and how many numbers its dampers have in an observer
 *   whole        how many coordinates there are with the walls
 *   index, wall  the indices of the coordinates, d, and of the walls, n; SIZE_MAX: that number has no wall, and is 0
 *   is_ghost     nonzero: the walls are ghosts of coordinates
 *   system, run  the run that is differentiated
 *   columns, sensitivity, lagrangian  how it depends on numbers, as in fvi_sensitivities; 0 where it has none
 *   parts, stop  the data of one kind of system, and how to free them */
typedef struct {
    size_t d, n, whole;
    size_t *index, *wall;
    int is_ghost;
    double *numbers, *mass, *damping, *x0, *p0, *F;
    const fvi_force *force;
    fvi_impulse *impulses;
    fvi_system system;
    fvi_run run;
    fvi_mechanism_columns columns;
    fvi_parameter_gradient sensitivity;
    fvi_lagrangian_column *lagrangian;
    void *parts;
    void (*stop)(void *parts);
} fvi_walls;

/* fvi_walls_places -- allocate index and wall, and fill in index, without walls. Returns FVI_SUCCESS or FVI_ENOMEM.
 * fvi_walls_allocate -- allocate the arrays of all coordinates, and copy x0, p0, mass and damping of the run to their
 * indices; the walls are at rest. d, n, whole, index and wall are set before. Returns FVI_SUCCESS or FVI_ENOMEM.
 * fvi_walls_force -- let the force of the run act on the coordinates and their ghosts, and on no walls. Returns
 * FVI_SUCCESS or FVI_ENOMEM.
 * fvi_walls_free -- free everything but `run`. */
int fvi_walls_places(fvi_walls *w, size_t d, size_t n, size_t whole);
int fvi_walls_allocate(fvi_walls *w, const fvi_run *run);
int fvi_walls_force(fvi_walls *w, const fvi_force *of);
void fvi_walls_free(fvi_walls *w);

/* Make the run with walls of the three kinds of runs. Each returns FVI_SUCCESS or the code of what failed. *w is zeroed
 * before the call; free it with fvi_walls_free, also after an error. */
int fvi_walls_of_chain(fvi_walls *w, const fvi_run *run, const fvi_sensitivities *want);
int fvi_walls_of_structure(fvi_walls *w, const fvi_run *run);
int fvi_walls_of_mechanism(fvi_walls *w, const fvi_run *run, const fvi_sensitivities *want);

#endif
