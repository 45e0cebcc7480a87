/* src/kernel/kernel_classes.h -- The kinds of kernels: all that the library knows of a kind.   [H 26]
 *
 * This header is internal. kernel_classes.c describes each kind in one place. The parser, the help, the names in fits,
 * gradients and Python, the elements of a material, the weights, the modes, the derivatives and the count of poles read
 * this description. A member that is left out is derived from the symbol, as said below. Only `check` checks
 * anything. */
#ifndef FVI_KERNEL_CLASSES_H
#define FVI_KERNEL_CLASSES_H

#include "kernel_general.h"
#include "kernel_impulses.h"

/* A number of a kernel. Its letter stands in fvi_law_formulas.
 *
 *   name   its name in a fit and in Python, as "alpha"
 *   field  its field in fvi_kernel_term: 0 rho, 1 alpha, 2 time, 3 end
 *   range  SIZE: a positive number; ORDER: half of an order of s; EXPONENT: a number above 0 that is no order
 *   most   the largest ORDER or EXPONENT, a finite number; INFINITY for a SIZE */
typedef enum { FVI_RANGE_SIZE, FVI_RANGE_ORDER, FVI_RANGE_EXPONENT } fvi_kernel_range;
typedef struct {
    const char *name;
    size_t field;
    fvi_kernel_range range;
    double most;
} fvi_kernel_number;

enum { FVI_KERNEL_FIELDS = 4 };

/* Where the symbol lies at s = -r + i0, for all r > 0. */
typedef enum {
    FVI_SIDE_ANYWHERE = 16,   /* not known */
    FVI_SIDE_ON_THE_LINE = 0, /* real and not negative */
    FVI_SIDE_ABOVE = 1,       /* above the real line */
    FVI_SIDE_BELOW = 2,
    FVI_SIDE_ABOVE_OR_ON = 4, /* above for some r, real and not negative for the others */
    FVI_SIDE_NEGATIVE = 8     /* real, and negative for some r */
} fvi_kernel_side;

/* A kind.
 *
 *   number    its numbers, in the order in which they are typed
 *   check     tests the numbers of a term, but not rho; returns FVI_SUCCESS, FVI_EDOM or FVI_EFAULT. The symbol must
 *             then be analytic except for s <= 0, or `fraction` must hold
 *   symbol    returns C(s) for rho = 1 at s = modulus e^(i angle), and writes s C'(s) to *slope. slope may be NULL for
 *             the kind SYMBOL only
 *   growth    returns the exponent nu of |C(s)| ~ |s|^nu at infinity; NULL: as `fraction` has it, or estimated from the
 *             symbol
 *   fraction  writes a term that is one fraction of powers, and returns 1; returns 0 for a term that is none. NULL: no
 *             term is. A term that is no fraction is called general: its weights come from Cauchy's integral
 *   modes     appends the modes of a general term, as fvi_kernel_modes_of, and need not check the list; NULL: they come
 *             from the symbol on the cut. Such modes are compared with the symbol before they are used
 *   by        returns the derivative of C(s) for rho = 1 by the number in a field; NULL: by differences of the symbol,
 *             which must then have values a little outside the ranges of its numbers, too
 *   side      returns where a term with rho > 0 lies that is no fraction; NULL: not known
 *   has_time  nonzero: `time` is a time. 0: it is a time to the power 2 alpha. Not read for MAXWELL2, whose time has
 *             another unit */
typedef struct {
    fvi_kernel_number number[FVI_KERNEL_FIELDS];
    int (*check)(const fvi_kernel_term *t);
    double complex (*symbol)(const fvi_kernel_term *t, double modulus, double angle, double complex *slope);
    double (*growth)(const fvi_kernel_term *t);
    int (*fraction)(const fvi_kernel_term *t, fvi_kernel_simple *simple);
    int (*modes)(const fvi_kernel_term *t, double slowest, double delta, fvi_kernel_modes *modes);
    double complex (*by)(const fvi_kernel_term *t, double complex s, size_t field);
    fvi_kernel_side (*side)(const fvi_kernel_term *t);
    int has_time;
} fvi_kernel_class;

/* The numbers of most kinds. `most` is the largest alpha. */
#define FVI_RHO { "rho", 0, FVI_RANGE_SIZE, INFINITY }
#define FVI_HALF_ORDER(most) { "alpha", 1, FVI_RANGE_ORDER, most }
#define FVI_TIME { "time", 2, FVI_RANGE_SIZE, INFINITY }

/* The kinds of kernel_fractions.c, and what other kinds can use of them.
 *
 * fvi_power_at -- Return s^{2 a} = e^{2 a ln s} at s = modulus e^(i angle). Its angle is 2 a times the angle of s, so
 * the result is exactly real if the angle is 0.
 * fvi_check_order, fvi_check_order_and_time -- Check that alpha is in [0, 1], and that time is finite and not negative.
 * fvi_power_fraction, fvi_zener_fraction -- Write the fraction of a POWER and of a ZENER, and return 1.
 * fvi_fraction_growth, fvi_fraction_side -- Return the growth and the side of a fraction of powers. */
extern const fvi_kernel_class fvi_kernel_of_power, fvi_kernel_of_zener, fvi_kernel_of_maxwell, fvi_kernel_of_maxwell2;
double complex fvi_power_at(double a, double modulus, double angle);
int fvi_check_order(const fvi_kernel_term *t);
int fvi_check_order_and_time(const fvi_kernel_term *t);
int fvi_power_fraction(const fvi_kernel_term *t, fvi_kernel_simple *f);
int fvi_zener_fraction(const fvi_kernel_term *t, fvi_kernel_simple *f);
double fvi_fraction_growth(const fvi_kernel_simple *f);
fvi_kernel_side fvi_fraction_side(const fvi_kernel_simple *f);

/* The classes, indexed by the kind of a term. */
extern const fvi_kernel_class *const fvi_kernel_classes[];
extern const size_t fvi_kernel_class_count;

/* A word of a law, as zener. The words stand in the order of fvi_law_formulas, where a word and its numbers have the
 * form "zener:R,A,T".
 *
 *   kind   the kind of the term
 *   range  what a complaint says of its numbers
 *   first  the name of its first number; NULL: as the kind has it
 *   alpha  for a word of fewer numbers than its kind: its alpha */
typedef struct {
    fvi_kernel_kind kind;
    const char *range, *first;
    double alpha;
} fvi_kernel_word;
extern const fvi_kernel_word fvi_kernel_words[];
extern const size_t fvi_kernel_word_count;

/* fvi_kernel_word_numbers -- Return how many numbers word i has. */
size_t fvi_kernel_word_numbers(size_t i);

/* fvi_symbol_by_differences -- Return the derivative of the symbol of a term at s by the number in a field, from
 * differences of the symbol. Accuracy: 1e-11 of |C| and of the derivative (seen 1e-12).
 * fvi_kernel_derivative_symbol -- Return the symbol of the derivative of a term with rho = 1 by its alpha, time or end;
 * NULL if the term has no such number. */
double complex fvi_symbol_by_differences(const fvi_kernel_term *term, double complex s, size_t field);
fvi_symbol_function *fvi_kernel_derivative_symbol(const fvi_kernel_term *term, fvi_slope_by by);

/* fvi_kernel_number_of -- Return the number that stands in a field of a term; NULL if its kind has none. */
const fvi_kernel_number *fvi_kernel_number_of(const fvi_kernel_term *t, size_t field);

#endif
