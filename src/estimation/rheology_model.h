/* src/estimation/rheology_model.h -- Compute a law, and what a test measures of it, from its numbers. [H 24]
 *
 * This header is internal; nothing is checked. Each element is an amplitude c_n times a shape phi_n(s; u). The numbers
 * u are half orders, exponents and logarithms of characteristic times. z is (ln c, u). */
#ifndef FVI_RHEOLOGY_MODEL_H
#define FVI_RHEOLOGY_MODEL_H

#include <fvi/rheology.h>

#include "kernel/kernel_classes.h"

#include <complex.h>

enum {
    FVI_ELEMENT_SHAPE = 3, /* most numbers u of an element */
    FVI_LAW_SHAPE = FVI_ELEMENT_SHAPE * FVI_MATERIAL_ELEMENTS,
    FVI_LAW_MOST = FVI_LAW_SHAPE + FVI_MATERIAL_ELEMENTS /* most numbers z */
};

/* Return the element of word i of a law (kernel_classes.h), and the word of element i. */
fvi_element fvi_element_of_word(size_t i);

/* fvi_element_numbers -- Return the numbers of an element's kind of kernel. A spring and a dashpot are a POWER, but
 * have only its first number.
 * fvi_element_has_time -- Return `has_time` of this kind (kernel_classes.h). */
const fvi_kernel_number *fvi_element_numbers(fvi_element kind);
int fvi_element_has_time(fvi_element kind);

/* Return the term of a kernel with these numbers, in the order of fvi_element_number. For two springpots in series the
 * first one has the higher order. */
fvi_kernel_term fvi_element_term(fvi_element kind, const double *number);

/* Return how many numbers u an element has, and write their ranges. A u of the range SIZE is the logarithm of a
 * time. */
size_t fvi_element_shape(fvi_element kind, fvi_kernel_range ranges[FVI_ELEMENT_SHAPE]);

/* Compute phi at s, and its derivatives by u. L = ln s. */
void fvi_element_at(fvi_element kind, double complex s, double complex L, const double *u,
                    double complex *phi, double complex d[FVI_ELEMENT_SHAPE]);

/* fvi_element_public -- Compute the numbers that have names, and their derivatives by (ln c, u). A size is given by its
 * logarithm, an order or an exponent as it is.
 * fvi_element_most -- Return the largest value of number i that is an order or an exponent; INFINITY if it is a
 * size. */
void fvi_element_public(fvi_element kind, double ln_c, const double *u,
                        double value[FVI_ELEMENT_NUMBERS],
                        double slope[FVI_ELEMENT_NUMBERS][1 + FVI_ELEMENT_SHAPE]);
double fvi_element_most(fvi_element kind, size_t i);

/* Solve the P equations A x = b with Cholesky's factors. b becomes x, and A is overwritten. Return 0 if a pivot is not
 * above `least` times its diagonal, else 1. */
int fvi_rheology_solve(size_t P, double least, double A[][FVI_LAW_MOST], double *b);

/* What is measured, at which s, and how; and room for a search. Residuals are (model - data) / unit. */
typedef struct {
    const fvi_material_data *data;
    size_t rows;        /* number of residuals: 2 n for moduli, n otherwise */
    size_t nodes;       /* number of s at which the law is evaluated */
    double complex *s, *log_s;  /* nodes, and their logarithms */
    double complex *weight; /* for creep and relaxation: weights of time i from [i * FVI_PARABOLA_NODES] on */
    size_t *first;      /* first node of time i */
    double *unit, *y;   /* units of the residuals; data divided by them */
    size_t elements, shapes; /* number of amplitudes; number of u */
    size_t at[FVI_MATERIAL_ELEMENTS + 1]; /* first u of each element; then `shapes` */
    double low[FVI_LAW_SHAPE], high[FVI_LAW_SHAPE]; /* bounds of u */
    double begin[FVI_LAW_SHAPE], end[FVI_LAW_SHAPE]; /* box of the starts */
    double scale[FVI_LAW_SHAPE];
    double complex *phi, *value; /* room: (1 + SHAPE) * elements * nodes; nodes */
    double *columns;             /* room: rows times (elements + shapes) */
    double *r, *trial;           /* room for a search: residuals, and those of a trial; rows each */
    void *block;
} fvi_rheology;

/* fvi_rheology_alloc -- Allocate and fill everything that does not depend on z. Return FVI_SUCCESS or FVI_ENOMEM.
 * fvi_rheology_free -- Free the memory, also after an error. */
int fvi_rheology_alloc(const fvi_material_data *data, fvi_rheology *o);
void fvi_rheology_free(fvi_rheology *o);

/* fvi_rheology_column -- Return column j, `rows` numbers: column n < elements of amplitude n, elements + j of u_j.
 * fvi_rheology_products -- Compute A = J^T J, where the columns of J are the P columns from `first` on. */
double *fvi_rheology_column(const fvi_rheology *o, size_t j);
void fvi_rheology_products(const fvi_rheology *o, size_t first, size_t P, double A[][FVI_LAW_MOST]);

/* fvi_rheology_project -- Find the best amplitudes for u that are not negative, the residuals with them and, if
 * with_slopes, Kaufman's Jacobian in the columns of u. Only for moduli and relaxation, which are linear in the
 * amplitudes. Return the sum of squares. */
double fvi_rheology_project(fvi_rheology *o, const double *u, double *c, double *r, int with_slopes);

/* fvi_rheology_residuals -- Compute the residuals and, if with_slopes, their Jacobian by z in all columns. Return the
 * sum of squares. */
double fvi_rheology_residuals(fvi_rheology *o, const double *z, double *r, int with_slopes);

#endif
