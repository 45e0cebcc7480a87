/* src/fvi/rheology.h -- Fits of a law of damping to measured moduli, creep or relaxation.                [H 24]
 *
 * A law is a sum of **elements**, such as a spring and a Zener element. Each element has numbers with names. */
#ifndef FVI_RHEOLOGY_H
#define FVI_RHEOLOGY_H

#include "damping_laws.h"
#include "error.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_element -- the kinds of elements, with the names of their numbers. Each is a term of a law (damping_laws.h):
 *
 *     spring       k                               a POWER of order 0
 *     viscous      rho                             a POWER of alpha = 1/2
 *     power        rho, alpha
 *     zener        rho, alpha, time
 *     maxwell      rho, time
 *     maxwell2     rho1, alpha1, rho2, alpha2      alpha1 >= alpha2
 *     davidson     rho, alpha, time
 *     distributed  rho, alpha, end
 *     havriliak    rho, alpha, time, beta          beta is the field end */
typedef enum {
    FVI_ELEMENT_SPRING,
    FVI_ELEMENT_VISCOUS,
    FVI_ELEMENT_POWER,
    FVI_ELEMENT_ZENER,
    FVI_ELEMENT_MAXWELL,
    FVI_ELEMENT_MAXWELL2,
    FVI_ELEMENT_DAVIDSON,
    FVI_ELEMENT_DISTRIBUTED,
    FVI_ELEMENT_HAVRILIAK
} fvi_element;

enum { FVI_ELEMENT_NUMBERS = 4 /* the largest number of numbers of an element */ };

/* The words of the kinds, in the order of fvi_element, are fvi_element_words (damping_laws.h). */

/* fvi_element_of -- Return the kind of a term. A FVI_KERNEL_POWER with alpha = 0 is a spring, one with alpha = 1/2 is
 * viscous. The term must not be a FVI_KERNEL_SYMBOL. */
fvi_element fvi_element_of(const fvi_kernel_term *term);

/* fvi_element_number -- Return the name of number i of a kind, i from 0; NULL if the kind has no such number.
 *
 *   field  output, or NULL: the field of fvi_kernel_term with this number, 0 rho, 1 alpha, 2 time, 3 end, as in
 *          fvi_free_parameter (records.h)
 *
 * For example, number 2 of FVI_ELEMENT_ZENER is "time", in the field 2. */
const char *fvi_element_number(fvi_element kind, size_t i, size_t *field);

/* fvi_element_number_typed -- Return the same for a term that was typed. If its two parts are exchanged
 * (fvi_pair_is_exchanged, parse.h), then rho1 has the field of rho2, and so on. */
const char *fvi_element_number_typed(fvi_element kind, size_t i, int is_exchanged, size_t *field);

/* fvi_material_test -- the measurement of a law C(s).                                   [(24.16), (24.17)]
 *
 *     MODULI      storage + i loss = C(i omega)
 *     CREEP       x(t) under a constant force F from t = 0 on: X(s) = F/(s C(s))
 *     RELAXATION  f(t) at an elongation z from t = 0 on: f(s) = z C(s)/s
 *
 * The model has no mass. So the specimen must have no inertia, or its effect must end before the first datum. */
typedef enum { FVI_MATERIAL_MODULI, FVI_MATERIAL_CREEP, FVI_MATERIAL_RELAXATION } fvi_material_test;

enum {
    FVI_MATERIAL_ELEMENTS = 6, /* the largest number of elements of a fitted law */
    FVI_MATERIAL_NUMBERS = FVI_ELEMENT_NUMBERS * FVI_MATERIAL_ELEMENTS
};

/* fvi_material_data -- the data of a fit, and the form of the law. All pointers belong to the caller.
 *
 *   test       the measurement
 *   n, at      number of data; the n frequencies omega (in radians per unit of time) or times: finite, > 0, in any
 *              order and spacing
 *   first      n numbers: storage, x or f
 *   second     n numbers: loss; read for moduli only
 *   unit, second_unit  the size of the error of each datum, up to the factor sigma: n numbers > 0 for `first` and for
 *              `second`. second_unit NULL: as unit. unit NULL: the error is proportional to the datum, for moduli to
 *              |C|
 *   sigma      the factor: the relative error, or 1 if the units are standard deviations; 0: unknown
 *   load       F or z, not 0; for moduli any number but 0, without effect
 *   elements, kind  the law: the number of elements, 1 to FVI_MATERIAL_ELEMENTS, and their kinds. Relaxation knows no
 *              viscous element
 *   starts     the largest number of searches, 2 to 10000; 20 are enough in general */
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

/* Flags of fvi_material: reasons to doubt the answer. STARTS, SINGULAR, NEIGHBOURS and CHI2 are grave: with one of them
 * do not believe the answer.
 *
 *   STARTS      fewer than two starts agree
 *   SINGULAR    the data do not determine all numbers together
 *   NEIGHBOURS  neighbouring residuals are correlated: the data have another law. Or the units are wrong: for example,
 *               the error of each modulus is proportional to this modulus, which is smaller than |C|. Then give units
 *   CHI2        with the given sigma, chi^2 has a probability below 1e-6
 *   ZERO        an element has the amplitude 0: the law does not need it
 *   BOUND       an order, an exponent or a time is at the end of the range that is searched
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

/* fvi_material -- the answer of a fit. The numbers of the elements stand one element after another, each in the order
 * of the names.
 *
 *   numbers      how many numbers the law has
 *   term         the law, one term for each element. Elements of one kind are in the order of their times, or of their
 *                orders if they have no time
 *   estimate, sd, lower, upper  of each number its estimate, its standard deviation, and its interval of 95 % by the
 *                profile of chi^2
 *   sigma        as given, or estimated
 *   chi2, probability, quantile, neighbours  as in fvi_estimate (identification.h)
 *   starts, agree  number of searches, and number of searches that led to this answer
 *   flags, grave  the flags that are set, and the grave flags among them */
typedef struct {
    size_t numbers;
    fvi_kernel_term term[FVI_MATERIAL_ELEMENTS];
    double estimate[FVI_MATERIAL_NUMBERS], sd[FVI_MATERIAL_NUMBERS],
        lower[FVI_MATERIAL_NUMBERS], upper[FVI_MATERIAL_NUMBERS];
    double sigma, chi2, probability, quantile, neighbours;
    size_t starts, agree;
    unsigned flags, grave;
} fvi_material;

/* fvi_material_fit -- Find the law of a given form that is nearest to the data, by least squares.
 *
 *   data      see above
 *   curve     NULL, or output: the model at the frequencies or times, n numbers; for moduli n storage moduli and then n
 *             loss moduli
 *   material  output
 *   error     output or NULL
 *
 * Moduli and relaxation are linear in the amplitudes. So the method of Levenberg and Marquardt, with Kaufman's Jacobian
 * and within bounds, searches only the half orders alpha, the exponents and the logarithms of the characteristic times.
 * For creep it searches all numbers. The starts are a Latin hypercube, the same in every call. The search ends when
 * three starts agree on the least sum of squares to a part in 10^6. All orders are 2 alpha <= 1, and all amplitudes are
 * >= 0.
 *
 *     static const fvi_element law[] = { FVI_ELEMENT_SPRING, FVI_ELEMENT_ZENER };
 *     const fvi_material_data data = { FVI_MATERIAL_MODULI, n, w, storage, loss, NULL, NULL, 0, 1,
 *                                      2, law, 20 };
 *     if (fvi_material_fit(&data, NULL, &material, &error) == FVI_SUCCESS && !material.grave)
 *         printf("%g %g\n", material.estimate[0], material.sd[0]);   // k of the spring
 *
 * Returns FVI_SUCCESS, whatever the flags are; FVI_EFAULT if a pointer is NULL; FVI_EINVAL for too few data, for
 * elements, kind and starts, and for a viscous element with relaxation; FVI_EDOM for a number out of range, and for a
 * datum of 0 without a unit; FVI_EBADFUNC if no start gives finite residuals; FVI_EOVRFLW if the curve of moduli is not
 * finite; FVI_ENOMEM. */
int fvi_material_fit(const fvi_material_data *data, double *curve, fvi_material *material,
                     fvi_error *error);

/* fvi_material_curve -- Compute the moduli C(i omega), the creep or the relaxation of a law.        [(24.16)]
 *
 *   test, load, n, at  as in fvi_material_data
 *   kernel             a law that has passed fvi_kernel_check; creep and relaxation need orders of at most 1
 *   first, second      outputs, n numbers each; second for moduli only
 *
 * Accuracy of creep and relaxation: a relative error of 1e-12 (seen 2e-13).
 * Returns FVI_SUCCESS; FVI_EFAULT if a pointer is NULL; FVI_EDOM if load is not finite, or a frequency or time is not
 * finite and > 0; for moduli what fvi_kernel_moduli returns. */
int fvi_material_curve(fvi_material_test test, const fvi_kernel *kernel, double load, size_t n,
                       const double *at, double *first, double *second, fvi_error *error);

/* fvi_material_flag_text -- Return 1 and write what a flag means for this answer; return 0 if the flag is not set.
 *
 *   data, material  the question and its answer
 *   flag            one flag
 *   size, text      room for FVI_WARNING_ROOM characters (warnings.h); untouched if the flag is not set */
int fvi_material_flag_text(const fvi_material_data *data, const fvi_material *material,
                           unsigned flag, size_t size, char *text);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
