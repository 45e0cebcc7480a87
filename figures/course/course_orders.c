/* figures/course/course_orders.c -- Chapter 2: the weights of three orders, as coefficients_weights.c prints them. */
#include "../coefficients/coefficients_weights.c"
