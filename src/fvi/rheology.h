/* src/fvi/rheology.h -- Laws of damping from what laboratories measure.    [H 24]
 *
 * A law is a sum of elements, such as a spring and zener's. Each has numbers with names. */
#ifndef FVI_RHEOLOGY_H
#define FVI_RHEOLOGY_H

#include "damping_laws.h"
#include "error.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_element -- the kinds of terms of a law as people know them, with their numbers:
 *
 *     spring       k                               a POWER of order 0
 *     viscous      rho                             a POWER of alpha = 1/2
 *     power        rho, alpha
 *     zener        rho, alpha, time
 *     maxwell      rho, time
 *     maxwell2     rho1, alpha1, rho2, alpha2      alpha1 >= alpha2
 *     davidson     rho, alpha, time
 *     distributed  rho, alpha, end */
typedef enum {
    FVI_ELEMENT_SPRING,
    FVI_ELEMENT_VISCOUS,
    FVI_ELEMENT_POWER,
    FVI_ELEMENT_ZENER,
    FVI_ELEMENT_MAXWELL,
    FVI_ELEMENT_MAXWELL2,
    FVI_ELEMENT_DAVIDSON,
    FVI_ELEMENT_DISTRIBUTED
} fvi_element;

enum { FVI_ELEMENT_NUMBERS = 4 /* at most */ };

/* fvi_element_words -- "spring" and so on, in the order of the kinds, ended by NULL. */
extern const char *const fvi_element_words[];

/* fvi_element_of -- the kind of a term; of a POWER with alpha = 0 or 1/2 a spring or a dashpot.
 * Not for a SYMBOL. */
fvi_element fvi_element_of(const fvi_kernel_term *term);

/* fvi_element_number -- the name of number i of a kind, NULL where it has not so many; and in
 * *field, which may be NULL, where a fvi_kernel_term has it: 0 rho, 1 alpha, 2 time, 3 end, as in
 * fvi_free_parameter. */
const char *fvi_element_number(fvi_element kind, size_t i, size_t *field);

/* fvi_element_number_typed -- the same of a term that was typed: if its parts are exchanged
 * (fvi_pair_is_exchanged, parse.h), rho1 stands where rho2 would, and so on. */
const char *fvi_element_number_typed(fvi_element kind, size_t i, int is_exchanged, size_t *field);

/* fvi_material_test -- what a laboratory measures of a law C(s).          [(24.16), (24.17)]
 *
 *     MODULI      storage + i loss = C(i omega)
 *     CREEP       x(t) under a constant force F from t = 0 on: X(s) = F/(s C(s))
 *     RELAXATION  f(t) at an elongation z from t = 0 on: f(s) = z C(s)/s
 *
 * No mass moves: what is moved has none, or it is over before the first datum. */
typedef enum { FVI_MATERIAL_MODULI, FVI_MATERIAL_CREEP, FVI_MATERIAL_RELAXATION } fvi_material_test;

enum {
    FVI_MATERIAL_ELEMENTS = 6, /* at most, of a law that is fitted */
    FVI_MATERIAL_NUMBERS = FVI_ELEMENT_NUMBERS * FVI_MATERIAL_ELEMENTS
};

/* fvi_material_data -- a question: what was measured, and which law it may be.
 *
 *   n, at      frequencies omega, or times, n of them, finite, > 0, in any order and spacing
 *   first      n numbers: storage, x or f
 *   second     n numbers: loss; not read of creep and relaxation
 *   unit, second_unit  NULL: the error of a datum is in proportion to it, to |C| of moduli; or n
 *              numbers > 0 each, to which it is in proportion; second_unit NULL: as unit
 *   sigma      the factor of that: the relative error, or 1 where the units are standard
 *              deviations; 0: unknown
 *   load       F or z, not 0
 *   elements, kind  the law: a sum of so many elements, 1 to FVI_MATERIAL_ELEMENTS
 *   starts     how many searches at most, >= 2; 20 will do */
typedef struct {
    fvi_material_test test;
    size_t n;
    const double *at, *first, *second;
    const double *unit, *second_unit;
    double sigma, load;
    size_t elements;
    const fvi_element *kind;
    size_t starts;
} fvi_material_data;

/* What speaks against an answer. Grave are STARTS, SINGULAR, NEIGHBOURS and CHI2.
 *
 *   STARTS      fewer than two starts agree
 *   SINGULAR    the data do not determine all numbers together
 *   NEIGHBOURS  neighbouring residuals are alike: it is another law
 *   CHI2        with the given sigma chi^2 has a probability below 1e-6
 *   ZERO        an element has the amplitude 0: it is not needed
 *   BOUND       an order or a time is at the end of what is asked for
 *   OPEN        an interval has no end */
enum {
    FVI_MATERIAL_STARTS = 1,
    FVI_MATERIAL_SINGULAR = 2,
    FVI_MATERIAL_NEIGHBOURS = 4,
    FVI_MATERIAL_CHI2 = 8,
    FVI_MATERIAL_ZERO = 16,
    FVI_MATERIAL_BOUND = 32,
    FVI_MATERIAL_OPEN = 64
};

/* fvi_material -- the answer. Numbers stand element after element, each in the order of its
 * names.
 *
 *   term         the law; with elements of one kind in the order of their times, or orders
 *   estimate, sd, lower, upper  of each number; the interval of 95 % is that of the profile
 *   sigma        as given, or estimated; chi2, probability, quantile, neighbours as in fvi_estimate
 *   starts, agree  searches that were made, and those that led here
 *   flags, grave as above */
typedef struct {
    size_t numbers;
    fvi_kernel_term term[FVI_MATERIAL_ELEMENTS];
    double estimate[FVI_MATERIAL_NUMBERS], sd[FVI_MATERIAL_NUMBERS],
        lower[FVI_MATERIAL_NUMBERS], upper[FVI_MATERIAL_NUMBERS];
    double sigma, chi2, probability, quantile, neighbours;
    size_t starts, agree;
    unsigned flags, grave;
} fvi_material;

/* fvi_material_fit -- the law that is nearest to the data.
 *
 *   curve     NULL, or output: the model at the data, n numbers, of moduli n storage and then n
 *             loss
 *   material  output
 *   error     output or NULL
 *
 * Moduli and relaxation are linear in the amplitudes, so that only half orders and logarithms of
 * characteristic times are searched, by Levenberg and Marquardt with Kaufman's Jacobian, within
 * bounds; creep is searched in all numbers. The starts are a Latin hypercube, the same each time,
 * and end when three agree on the least sum to a part in 10^6. Orders are 2 alpha <= 1.
 *
 *     static const fvi_element law[] = { FVI_ELEMENT_SPRING, FVI_ELEMENT_ZENER };
 *     const fvi_material_data data = { FVI_MATERIAL_MODULI, n, w, storage, loss, NULL, NULL, 0, 1,
 *                                      2, law, 20 };
 *     if (fvi_material_fit(&data, NULL, &material, &error) == FVI_SUCCESS && !material.grave) ...
 *
 * Returns FVI_SUCCESS, whatever the flags are; FVI_EFAULT if a pointer is NULL; FVI_EINVAL for n,
 * elements, kind and starts; FVI_EDOM for a number out of range; FVI_EBADFUNC if no start gives
 * finite residuals; FVI_ENOMEM. */
int fvi_material_fit(const fvi_material_data *data, double *curve, fvi_material *material,
                     fvi_error *error);

/* fvi_material_curve -- C(i omega), creep or relaxation of a law.        [(24.16)]
 *
 *   test, load, n, at  as above       kernel  has passed fvi_kernel_check, and is overdamped:
 *                                     orders are at most 1
 *   first, second      outputs; second of moduli alone
 *
 * Accuracy of creep and relaxation: 1e-12 relative (seen 2e-13). Returns FVI_SUCCESS; FVI_EFAULT;
 * FVI_EDOM; FVI_ENOMEM. */
int fvi_material_curve(fvi_material_test test, const fvi_kernel *kernel, double load, size_t n,
                       const double *at, double *first, double *second, fvi_error *error);

/* fvi_material_flag_text -- 1 and what a flag says, or 0 if it is not up; as
 * fvi_estimate_flag_text. */
int fvi_material_flag_text(const fvi_material_data *data, const fvi_material *material,
                           unsigned flag, size_t size, char *text);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
