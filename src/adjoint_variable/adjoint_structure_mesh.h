/* src/adjoint_variable/adjoint_structure_mesh.h -- The adjoint run of a structure on its mesh. [H 23, 27]
 *
 * Internal: for adjoint.c, and for adjoint_structure_mesh.c and adjoint_structure_mesh_rows.c. */
#ifndef FVI_ADJOINT_STRUCTURE_MESH_H
#define FVI_ADJOINT_STRUCTURE_MESH_H

#include "adjoint_variable.h"
#include "variable_step/variable_structure.h"

/* One damper; "each" means that an array has d numbers. */
typedef struct {
    fvi_run_damper of;
    fvi_mesh_matrix *to; /* the damper in the state of the stepper; NULL: its matrix is zero */
    int has_line;        /* v0 is subtracted from the velocities for the history of the run */
    double sum;          /* sum of h b_i (V - line) . force of the adjoint run */
    double sum_by_order; /* the same with the derivative of the force by 2 alpha, if alpha is wanted */
    double *plain;       /* each: sum of h b_i times the force */
} fvi_adjoint_structure_mesh_damper;

typedef struct {
    const fvi_run *run;
    const fvi_objective *J;
    const fvi_sensitivities *want;
    fvi_recorded_steps path;
    const fvi_variable_rule *rule;
    size_t s, d, count, row; /* row: the next row that J's slopes are asked for */
    fvi_variable_step_state *o;
    struct fvi_mesh_structure *of;
    fvi_adjoint_structure_mesh_damper *each; /* owned */
    double *v0, *xi, *by_v, *by_x, *extra; /* d each: xi of (23.16); the derivatives through the rows of a step by v and
                                              x at its beginning; by_v of the step after this one */
    double *Jx, *Jp, *Jk, *product, *room, *moved;
    double *source, *V, *mu; /* s d each: the derivatives through the rows by V - v, stages in order; V and the
                                multipliers mu in reverse order */
    double *y;               /* d: the numbers of the history of a damper, of one stage */
    fvi_square W0_rate;      /* dW0/dbeta, if alpha is wanted */
    double *rate;            /* s d: the derivatives of forces by 2 alpha, before S */
    double *block;           /* the memory of all these arrays and of those of the dampers; owned */
    double by_M, by_K;
} fvi_adjoint_structure_mesh_run;

/* fvi_adjoint_structure_mesh -- as fvi_adjoint, for a structure by fvi_variable_step. The run is made here. */
int fvi_adjoint_structure_mesh(const fvi_run *run, const fvi_objective *J, const fvi_sensitivities *want);

/* fvi_adjoint_structure_mesh_read_rows -- read the rows in step n that are not at its beginning. Write the derivatives
 * of J through them to source, by_v and by_x. At the last row lambda becomes J_p. Returns what the slopes of J and the
 * functions of the matrices return. */
int fvi_adjoint_structure_mesh_read_rows(fvi_adjoint_structure_mesh_run *m, size_t n);

#endif
