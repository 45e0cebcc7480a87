/* src/estimation/rheology_model.h -- A law as a function of its numbers, and what a test measures
 * of it.                                                               [H 24]
 *
 * Internal: nothing is checked. Each element is an amplitude c_n times a shape phi_n(s; u). The
 * numbers u are half orders and logarithms of characteristic times, and z is (ln c, u). */
#ifndef FVI_RHEOLOGY_MODEL_H
#define FVI_RHEOLOGY_MODEL_H

#include <fvi/rheology.h>

#include <complex.h>

enum {
    FVI_ELEMENT_SHAPE = 3, /* numbers u of an element, at most */
    FVI_LAW_SHAPE = FVI_ELEMENT_SHAPE * FVI_MATERIAL_ELEMENTS,
    FVI_LAW_MOST = FVI_LAW_SHAPE + FVI_MATERIAL_ELEMENTS /* numbers z */
};

/* A term of a kernel with the numbers of fvi_element_number. Of two springpots in series the first has the higher
 * order. */
fvi_kernel_term fvi_element_term(fvi_element kind, const double *number);

/* The numbers u: how many, and of which kind: orders, or logarithms of times. */
size_t fvi_element_shape(fvi_element kind, const char **kinds);

/* phi at s, and its derivatives by u; L = ln s. */
void fvi_element_at(fvi_element kind, double complex s, double complex L, const double *u,
                    double complex *phi, double complex d[FVI_ELEMENT_SHAPE]);

/* The numbers of an element by their names: ln of what is a size, an order as it is; and their
 * derivatives by (ln c, u). */
void fvi_element_public(fvi_element kind, double ln_c, const double *u,
                        double value[FVI_ELEMENT_NUMBERS],
                        double slope[FVI_ELEMENT_NUMBERS][1 + FVI_ELEMENT_SHAPE]);
int fvi_element_is_order(fvi_element kind, size_t i);

/* A = J^T J of `rows` rows of P numbers. */
void fvi_rheology_products(size_t rows, size_t P, const double *J, double A[][FVI_LAW_MOST]);

/* Solve A x = b of P equations by Cholesky's factors; b becomes x, A is lost. 0 where a pivot is not above `least` of
 * its diagonal. */
int fvi_rheology_solve(size_t P, double least, double A[][FVI_LAW_MOST], double *b);

/* What is measured, at which s, and how. Residuals are (model - data) over `unit`. */
typedef struct {
    const fvi_material_data *data;
    size_t rows;        /* residuals: 2 n of moduli, n else */
    size_t nodes;       /* s at which the law is asked */
    double complex *s, *log_s;  /* nodes, and their logarithms */
    double complex *weight; /* of creep and relaxation: of time i at [i * FVI_PARABOLA_NODES] */
    size_t *first;      /* of time i: its first node */
    double *unit, *y;   /* of a residual; the data over it */
    size_t elements, shapes; /* amplitudes, numbers u */
    size_t at[FVI_MATERIAL_ELEMENTS]; /* where the u of an element begin */
    double low[FVI_LAW_SHAPE], high[FVI_LAW_SHAPE]; /* bounds of u */
    double begin[FVI_LAW_SHAPE], end[FVI_LAW_SHAPE]; /* the box of the starts */
    double scale[FVI_LAW_SHAPE];
    double complex *phi, *value; /* room: (1 + SHAPE) elements nodes; nodes */
    double *columns;             /* room: rows by elements and by u */
    void *block;
} fvi_rheology;

int fvi_rheology_alloc(const fvi_material_data *data, fvi_rheology *o);
void fvi_rheology_free(fvi_rheology *o);

/* The best amplitudes for u that are not negative, residuals with them, Kaufman's Jacobian (rows
 * by shapes, row by row; NULL is allowed). For moduli and relaxation, which are linear in them.
 * Returns the sum of squares. */
double fvi_rheology_project(fvi_rheology *o, const double *u, double *c, double *r, double *J);

/* Residuals and their Jacobian by z, rows by elements + shapes. Returns the sum of squares. */
double fvi_rheology_residuals(fvi_rheology *o, const double *z, double *r, double *J);

#endif
