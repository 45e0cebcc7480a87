/* src/adjoint_forces/adjoint_forces.h -- The dampers' forces in J: a run with walls. [H 23]
 *
 * Internal to the room. A damper pushes two things: the body, and the wall that holds its other end. Let the wall be a
 * body that can move, so heavy that it does not. Then its momentum is the impulse J of the damper, and a J that depends
 * on impulses is one that depends on momenta of a longer run, whose adjoint is known.
 *
 *     damper between z and y, y the wall:  p_y(t_k) = J(t_k)
 *     coordinates that are damped one by one:  a ghost y of each coordinate x, pushed by F - grad U(x + y) and not
 *     damped:  J(t_k) = p_0 - p_x(t_k) + p_y(t_k)                                            (23.33) */
#ifndef FVI_ADJOINT_FORCES_H
#define FVI_ADJOINT_FORCES_H

#include <fvi/adjoint.h>

/* A run whose masses, dampings and forces are below 1e130 moves no wall by a digit of its own numbers. The square of the
 * mass is a double. */
#define FVI_WALL_MASS 1e150

/* The run with its walls.
 *
 *   d, n       coordinates of the run, and numbers of its dampers as an observer tells them
 *   whole      coordinates with walls
 *   own, wall  the places of the coordinates, d, and of the walls, n; SIZE_MAX: that number has none, it is 0
 *   is_ghost   nonzero: the walls are ghosts of coordinates
 *   system, run  what is differentiated
 *   columns, sensitivity, lagrangian  how it depends on numbers, as fvi_sensitivities names them; 0 where it has none
 *   parts, stop  what only this kind of system has, and how it is given back */
typedef struct {
    size_t d, n, whole;
    size_t *own, *wall;
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

/* fvi_walls_places -- own, and no walls. FVI_SUCCESS or FVI_ENOMEM.
 * fvi_walls_allocate -- the arrays of whole coordinates: x0, p0, mass and damping of the run at their places, the walls at
 * rest. d, n, whole, own and wall are there. FVI_SUCCESS or FVI_ENOMEM.
 * fvi_walls_force -- the force of the run pushes the coordinates and their ghosts, no walls. FVI_SUCCESS or FVI_ENOMEM.
 * fvi_walls_free -- everything but `run`. */
int fvi_walls_places(fvi_walls *w, size_t d, size_t n, size_t whole);
int fvi_walls_allocate(fvi_walls *w, const fvi_run *run);
int fvi_walls_force(fvi_walls *w, const fvi_force *of);
void fvi_walls_free(fvi_walls *w);

/* The three kinds of runs with walls. Each returns FVI_SUCCESS or what failed; w is zeroed before the call, and freed
 * whatever it returns. */
int fvi_walls_of_chain(fvi_walls *w, const fvi_run *run, const fvi_sensitivities *want);
int fvi_walls_of_structure(fvi_walls *w, const fvi_run *run);
int fvi_walls_of_mechanism(fvi_walls *w, const fvi_run *run, const fvi_sensitivities *want);

#endif
