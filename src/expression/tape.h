/* src/expression/tape.h -- An expression as a list of operations.          [H 9]
 *
 * Each node works on nodes before it, so that one walk from the first to the last
 * evaluates it, with as many derivatives as are wanted. */
#ifndef FVI_TAPE_H
#define FVI_TAPE_H

#include <fvi/expression.h>

#include <complex.h>

/* The functions stand last, in the order of fvi_tape_functions. */
typedef enum {
    TAPE_NUMBER,
    TAPE_COORDINATE, /* number a, from 0 */
    TAPE_PARAMETER,  /* number a, from 0 */
    TAPE_ADD,
    TAPE_SUBTRACT,
    TAPE_MULTIPLY,
    TAPE_DIVIDE,
    TAPE_NEGATE,
    TAPE_WHOLE_POWER, /* a to the b, b >= 2 a number */
    TAPE_POWER,
    TAPE_FUNCTIONS,
    TAPE_SIN = TAPE_FUNCTIONS,
    TAPE_COS,
    TAPE_TAN,
    TAPE_ASIN,
    TAPE_ACOS,
    TAPE_ATAN,
    TAPE_SINH,
    TAPE_COSH,
    TAPE_TANH,
    TAPE_EXP,
    TAPE_LOG,
    TAPE_SQRT,
    TAPE_ABS,
    TAPE_SIGN,
    TAPE_MIN, /* from here on functions of two */
    TAPE_MAX
} fvi_operation;

extern const char *const fvi_tape_functions[]; /* ended by NULL */

/* degree: of the polynomial in the coordinates; 3 stands for all that is no polynomial
 * of degree 2. */
typedef struct {
    fvi_operation op;
    int degree;
    int a, b;
    double number;
} fvi_node;

/* A walk keeps four numbers for each node on the stack: 32 kilobytes, which the threads of
 * every C library have. */
enum { FVI_TAPE_LONGEST = 1024 };

/* What a text may speak of besides the names: the time, and before it velocities. */
typedef enum { TAPE_PLACE, TAPE_TIME, TAPE_VELOCITY } fvi_tape_state;

/* fvi_parse -- a text into nodes, children before their parents, the root last.
 *
 * finder may be NULL. Constants are worked out. Returns FVI_SUCCESS, FVI_EINVAL with *wrong filled, or
 * FVI_ENOMEM; *node, *count are to be freed by the caller if 0 is returned. */
int fvi_parse(const char *text, const fvi_symbols *names, fvi_tape_state state,
              const fvi_name_finder *finder, fvi_node **node, size_t *count,
              fvi_misprint *wrong);

/* fvi_tape_value -- of the last of n nodes.
 *
 *   x  coordinates     k  parameters */
double fvi_tape_value(const fvi_node *node, size_t n, const double *x,
                      const double *k);

/* fvi_tape_complex -- the same of one complex coordinate s, by principal branches; NaN where
 * abs, sign, min or max is asked for, which are not analytic. */
double complex fvi_tape_complex(const fvi_node *node, size_t n,
                                double complex s, const double *k);

/* What two of the names are held against: coordinates as they are numbered,
 * parameter j as -1 - j. */
typedef struct {
    double v, a, b, c; /* u, u_i, u_j, u_ij */
} fvi_jet;

/* fvi_tape_slope -- u, u_i. fvi_tape_second_derivative -- all four; the derivatives by i and j. */
fvi_jet fvi_tape_slope(const fvi_node *node, size_t n, const double *x,
                       const double *k, int i);
fvi_jet fvi_tape_second_derivative(const fvi_node *node, size_t n, const double *x,
                      const double *k, int i, int j);

#endif
