/* figures/course/course_orders.c -- Chapter 2: the weights of three orders, with the Course's letters. */
#include "../coefficients/coefficients_weights.c"
