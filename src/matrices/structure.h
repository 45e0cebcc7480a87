/* src/matrices/structure.h -- The data of a structure.               [H 27] */
#ifndef FVI_STRUCTURE_H
#define FVI_STRUCTURE_H

#include "factors.h"
#include "history_space.h"

struct fvi_structure {
    const fvi_sparse *M, *K, *C;
    double *mass, *damping; /* the diagonals of M and C, in one block */
    fvi_history_space B;
    fvi_factors *by_mass; /* factors of M, for energies */
    fvi_matrices matrices;
    fvi_mechanism mechanism; /* used with several dampers instead of C */
    fvi_sparse *outer;       /* row^T row for each damper along a row; else empty */
    fvi_history_space *space;
    fvi_damping_matrix *damper;
};

/* fvi_structure_term_count -- Return the number of matrices in m M + sum_j c_j C_j + k K, also of those that are NULL.
 * fvi_structure_term -- Return matrix l of this sum: M; C, which may be NULL, or the C_j of all dampers; K. */
size_t fvi_structure_term_count(const fvi_structure *s);
const fvi_sparse *fvi_structure_term(const fvi_structure *s, size_t l);

/* fvi_structure_damping_functions -- Return the functions of the matrix that has this history. */
fvi_damping_matrix fvi_structure_damping_functions(const fvi_history_space *B);

/* fvi_structure_add_complex -- Set the functions for complex equations, which methods with stages need. */
void fvi_structure_add_complex(fvi_structure *s);

/* fvi_structure_add_dampers -- Add the dampers of fvi_structure_alloc_dampers to a structure with M and K. */
int fvi_structure_add_dampers(fvi_structure *s, size_t count, const fvi_damper *damper,
                              fvi_error *error);

void fvi_structure_free_dampers(fvi_structure *s);

#endif
