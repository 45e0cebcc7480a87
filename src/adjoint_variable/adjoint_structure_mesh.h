/* src/adjoint_variable/adjoint_structure_mesh.h -- A structure on its mesh, backwards.   [H 23, 27]
 *
 * Internal: for adjoint.c, and what adjoint_structure_mesh.c and its rows share. */
#ifndef FVI_ADJOINT_STRUCTURE_MESH_H
#define FVI_ADJOINT_STRUCTURE_MESH_H

#include "adjoint_variable.h"
#include "variable_step/variable_structure.h"

/* Of one damper; where the comment says "each", d numbers. */
typedef struct {
    fvi_run_damper of;
    fvi_mesh_matrix *to; /* NULL: it has no history */
    int has_line;        /* v0 is subtracted from the velocities that the history of the run sees */
    double sum;          /* sum of h b_i (V - line) . forces */
    double sum_by_order; /* the same with the derivative of the forces by 2 alpha, if alpha is wanted */
    double *plain;       /* each: sum of h b_i forces */
} fvi_adjoint_structure_mesh_damper;

typedef struct {
    const fvi_run *run;
    const fvi_objective *J;
    const fvi_sensitivities *want;
    fvi_recorded_steps path;
    const fvi_variable_rule *rule;
    size_t s, d, count, row; /* row: the next that is asked for its slopes */
    fvi_variable_step_state *o;
    struct fvi_mesh_structure *of;
    fvi_adjoint_structure_mesh_damper *each; /* owned */
    double *v0, *xi, *by_v, *by_x, *extra; /* d each; extra: by_v of the step behind, of v at its beginning */
    double *Jx, *Jp, *Jk, *product, *room, *moved;
    double *source, *V, *mu; /* s d: by V - v of stages in their order; V and mu in reverse order */
    double *y;               /* d: the history numbers of a damper, of one stage */
    fvi_square W0_rate;      /* dW0/dbeta, if alpha is wanted */
    double *rate;            /* s d: derivatives of forces by 2 alpha, history numbers */
    double *block;           /* all of these and of the dampers; owned */
    double by_M, by_K;
} fvi_adjoint_structure_mesh_run;

/* fvi_adjoint_structure_mesh -- as fvi_adjoint, of a structure by fvi_variable_step, which is run here. */
int fvi_adjoint_structure_mesh(const fvi_run *run, const fvi_objective *J, const fvi_sensitivities *want);

/* fvi_adjoint_structure_mesh_read_rows -- all rows in step n that are not at its beginning: to source, by_v
 * and by_x. At the last row lambda becomes J_p. */
int fvi_adjoint_structure_mesh_read_rows(fvi_adjoint_structure_mesh_run *m, size_t n);

#endif
