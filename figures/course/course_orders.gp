# figures/course/course_orders.gp -- Chapter 2: figures/coefficients/coefficients_weights.gp, with the letters of the
# Course.
# Input: figures/course/course_orders.c. Output: figures/course/course_orders.svg.
weight = "w_n"; order = "β"; law = "lines: a constant times n^{−1−β}"
load 'figures/coefficients/coefficients_weights.gp'
