/* src/kernel/kernel_classes.h -- The kinds of kernels: range checks, symbols, growth.   [H 26]
 *
 * This header is internal. Only `check` checks anything, namely the numbers of a term. */
#ifndef FVI_KERNEL_CLASSES_H
#define FVI_KERNEL_CLASSES_H

#include <fvi/damping_laws.h>

#include <complex.h>

/* fvi_kernel_class -- The functions of one kind of kernel.
 *
 *   check   tests the numbers of a term; returns FVI_SUCCESS, FVI_EDOM or FVI_EFAULT
 *   symbol  returns C(s) for rho = 1 at s = modulus e^(i angle), and writes s C'(s) to *slope. slope may be NULL for
 *           the kind SYMBOL only
 *   growth  returns the exponent nu of |C(s)| ~ |s|^nu at infinity */
typedef struct {
    int (*check)(const fvi_kernel_term *t);
    double complex (*symbol)(const fvi_kernel_term *t, double modulus,
                             double angle, double complex *slope);
    double (*growth)(const fvi_kernel_term *t);
} fvi_kernel_class;

/* The classes, indexed by the kind of a term. */
enum { FVI_KERNEL_CLASSES = FVI_KERNEL_SYMBOL + 1 };
extern const fvi_kernel_class fvi_kernel_classes[FVI_KERNEL_CLASSES];

#endif
