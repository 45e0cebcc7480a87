/* src/matrices/structure.h -- What a structure is made of.               [H 27] */
#ifndef FVI_STRUCTURE_H
#define FVI_STRUCTURE_H

#include "factors.h"
#include "history_space.h"

struct fvi_structure {
    const fvi_sparse *M, *K, *C;
    double *mass, *damping; /* the diagonals, one block */
    fvi_history_space B;
    fvi_factors *by_mass; /* for energies */
    fvi_matrices matrices;
    fvi_mechanism mechanism; /* several dampers instead of C, and of each: */
    fvi_sparse *outer;       /* row^T row, of one along a row; else empty */
    fvi_history_space *space;
    fvi_damping_matrix *damper;
};

/* fvi_structure_factorise -- the factors of a_0 A_0 + a_1 A_1 + ..., as factorise of fvi_matrices. */
int fvi_structure_factorise(size_t count, const fvi_sparse *const *terms, const double *a,
                            void **factors);

/* fvi_structure_terms -- M, C_1, C_2, ..., K, and in *a m, c_1, c_2, ..., k: one block, which the
 * caller frees. NULL: no memory. */
const fvi_sparse **fvi_structure_terms(const fvi_structure *s, double m, const double *c,
                                       double k, double **a);

/* fvi_structure_dampings -- how many matrices damp it: those of the dampers, or C alone: 1.
 * fvi_structure_damping -- that of damper j. */
size_t fvi_structure_dampings(const fvi_structure *s);
const fvi_sparse *fvi_structure_damping(const fvi_structure *s, size_t j);

/* fvi_structure_add_complex -- the equations with complex numbers, of methods with stages. */
void fvi_structure_add_complex(fvi_structure *s);

/* fvi_structure_add_dampers -- what fvi_structure_alloc_dampers has besides M and K. */
int fvi_structure_add_dampers(fvi_structure *s, size_t count, const fvi_damper *damper,
                              fvi_error *error);

void fvi_structure_free_dampers(fvi_structure *s);

#endif
