/* src/system/one_sided.h -- The weights of a difference quotient on one side of a number. */
#ifndef FVI_ONE_SIDED_H
#define FVI_ONE_SIDED_H

/* f'(x) = sum_{i=0}^{6} fvi_one_sided[i] f(x + i h) / h with an error of order h^6. With -h in place of h the points lie
 * below x. */
static const double fvi_one_sided[] = { -49. / 20, 6, -15. / 2, 20. / 3, -15. / 4, 6. / 5, -1. / 6 };

#endif
