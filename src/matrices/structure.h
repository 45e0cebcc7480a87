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

/* fvi_structure_factorise -- Factorise a_0 A_0 + a_1 A_1 + ... Codes and *factors are those of factorise in
 * fvi_matrices. */
int fvi_structure_factorise(size_t count, const fvi_sparse *const *terms, const double *a,
                            void **factors);

/* fvi_structure_terms -- Return an array of M, C_1, C_2, ..., K, and write their factors m, c_1, c_2, ..., k to *a.
 * Both are in one block, which the caller frees. Return NULL if memory is short. */
const fvi_sparse **fvi_structure_terms(const fvi_structure *s, double m, const double *c,
                                       double k, double **a);

/* fvi_structure_dampings -- Return the number of damping matrices: one for each damper, or 1 for C.
 * fvi_structure_damping -- Return the matrix of damper j. */
size_t fvi_structure_dampings(const fvi_structure *s);
const fvi_sparse *fvi_structure_damping(const fvi_structure *s, size_t j);

/* fvi_structure_add_complex -- Set the functions for complex equations, which methods with stages need. */
void fvi_structure_add_complex(fvi_structure *s);

/* fvi_structure_add_dampers -- Add the dampers of fvi_structure_alloc_dampers to a structure with M and K. */
int fvi_structure_add_dampers(fvi_structure *s, size_t count, const fvi_damper *damper,
                              fvi_error *error);

void fvi_structure_free_dampers(fvi_structure *s);

#endif
