/* src/expression/tape.h -- Represent an expression as a list of operations.          [H 9]
 *
 * The operands of a node are nodes before it. So one walk from the first node to the last evaluates the expression,
 * with as many derivatives as are needed. */
#ifndef FVI_TAPE_H
#define FVI_TAPE_H

#include <fvi/expression.h>

#include <complex.h>

/* The functions come last, in the order of fvi_tape_functions. */
typedef enum {
    TAPE_NUMBER,
    TAPE_COORDINATE, /* coordinate number a, from 0 */
    TAPE_PARAMETER,  /* parameter number a, from 0 */
    TAPE_ADD,
    TAPE_SUBTRACT,
    TAPE_MULTIPLY,
    TAPE_DIVIDE,
    TAPE_NEGATE,
    TAPE_WHOLE_POWER, /* a to the power `number`, which is whole and >= 2 */
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
    TAPE_MIN, /* from here on functions of two arguments */
    TAPE_MAX
} fvi_operation;

extern const char *const fvi_tape_functions[]; /* ended by NULL */

/* A node. a and b are the numbers of its operands, both the same for one operand. degree is that of the polynomial in
 * the coordinates; 3 stands for everything that is no polynomial of degree 2 or less. */
typedef struct {
    fvi_operation op;
    int degree;
    int a, b;
    double number;
} fvi_node;

/* A walk keeps four numbers for each node on the stack. That is 32 kilobytes, which the threads of every C library
 * have. */
enum { FVI_TAPE_LONGEST = 1024 };

/* What a text may contain besides the names: nothing, the time, or velocities and the time. */
typedef enum { TAPE_PLACE, TAPE_TIME, TAPE_VELOCITY } fvi_tape_state;

/* fvi_parse -- Parse a text into nodes. Children come before their parents, and the root is the last node.
 *
 * finder may be NULL. Operations on constants are carried out. Return FVI_SUCCESS; FVI_EINVAL with *wrong filled in;
 * FVI_ENOMEM. After FVI_SUCCESS the caller frees *node, which has *count nodes. */
int fvi_parse(const char *text, const fvi_symbols *names, fvi_tape_state state,
              const fvi_name_finder *finder, fvi_node **node, size_t *count,
              fvi_misprint *wrong);

/* fvi_tape_value -- Return the value of the last of n nodes.
 *
 *   x  coordinates     k  parameters */
double fvi_tape_value(const fvi_node *node, size_t n, const double *x,
                      const double *k);

/* fvi_tape_complex -- Return the value for one complex coordinate s, with principal branches. NaN if the text contains
 * abs, sign, min or max, which are not analytic. */
double complex fvi_tape_complex(const fvi_node *node, size_t n,
                                double complex s, const double *k);

/* A value and its derivatives by i and j. i and j are numbers of coordinates, or -1 - j for parameter number j. */
typedef struct {
    double v, a, b, c; /* u, u_i, u_j, u_ij */
} fvi_jet;

/* fvi_tape_slope -- Return u and u_i.
 * fvi_tape_second_derivative -- Return all four. */
fvi_jet fvi_tape_slope(const fvi_node *node, size_t n, const double *x,
                       const double *k, int i);
fvi_jet fvi_tape_second_derivative(const fvi_node *node, size_t n, const double *x,
                      const double *k, int i, int j);

#endif
