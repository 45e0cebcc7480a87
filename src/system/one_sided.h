/* src/system/one_sided.h -- The weights of a difference quotient on one side of a number. */
#ifndef FVI_ONE_SIDED_H
#define FVI_ONE_SIDED_H

/* The sum of fvi_one_sided_weights[i] f(x + i h) / h over i = 0, ..., 6 is f'(x) with an error of order h^6. For h < 0
 * the points lie below x. */
static const double fvi_one_sided_weights[] = { -49. / 20, 6, -15. / 2, 20. / 3, -15. / 4, 6. / 5, -1. / 6 };

#endif
