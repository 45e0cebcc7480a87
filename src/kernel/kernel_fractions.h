/* src/kernel/kernel_fractions.h -- The kinds that are fractions of powers, and what other kinds share with them.  [H 26]
 *
 * This header is internal. */
#ifndef FVI_KERNEL_FRACTIONS_H
#define FVI_KERNEL_FRACTIONS_H

#include "kernel_classes.h"

/* The numbers of most kinds. `most` is the largest alpha. */
#define FVI_RHO { "rho", 0, FVI_RANGE_SIZE, INFINITY }
#define FVI_HALF_ORDER(most) { "alpha", 1, FVI_RANGE_ORDER, most }
#define FVI_TIME { "time", 2, FVI_RANGE_SIZE, INFINITY }

extern const fvi_kernel_class fvi_kernel_of_power, fvi_kernel_of_zener, fvi_kernel_of_maxwell, fvi_kernel_of_maxwell2;

/* fvi_power_at -- Return s^{2 a} = e^{2 a ln s}. Its angle is 2 a times the angle of s, so the result is exactly real
 * if the angle is 0. */
double complex fvi_power_at(double a, double modulus, double angle);

/* Members of the class of a POWER or of a ZENER. Another kind can use them as they are. */
int fvi_check_order(const fvi_kernel_term *t);
int fvi_check_order_and_time(const fvi_kernel_term *t);
double fvi_power_growth(const fvi_kernel_term *t);
double fvi_zener_growth(const fvi_kernel_term *t);
int fvi_power_fraction(const fvi_kernel_term *t, fvi_kernel_simple *f);
int fvi_zener_fraction(const fvi_kernel_term *t, fvi_kernel_simple *f);
fvi_kernel_side fvi_power_side(const fvi_kernel_term *t);

#endif
