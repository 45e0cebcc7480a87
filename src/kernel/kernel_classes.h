/* src/kernel/kernel_classes.h -- Kinds of kernels: ranges, symbols, growth.   [H 26]
 *
 * Internal; nothing is checked but the numbers of a term. */
#ifndef FVI_KERNEL_CLASSES_H
#define FVI_KERNEL_CLASSES_H

#include <fvi/damping_laws.h>

#include <complex.h>

/* All that the library knows of a kind of kernel. The symbols are those of rho = 1; slope is
 * s times the derivative, and may be NULL of a SYMBOL. */
typedef struct {
    int (*check)(const fvi_kernel_term *t);
    double complex (*symbol)(const fvi_kernel_term *t, double modulus,
                             double angle, double complex *slope);
    double (*growth)(const fvi_kernel_term *t);
} fvi_kernel_class;

/* By the kind of a term. */
enum { FVI_KERNEL_CLASSES = FVI_KERNEL_SYMBOL + 1 };
extern const fvi_kernel_class fvi_kernel_classes[FVI_KERNEL_CLASSES];

#endif
