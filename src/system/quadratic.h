/* src/system/quadratic.h -- Test whether the Hessian of a potential is constant. */
#ifndef FVI_QUADRATIC_H
#define FVI_QUADRATIC_H

#include <fvi/system.h>

/* fvi_potential_is_quadratic -- Return nonzero if the potential promises that it is quadratic. Return 0 if
 * there is no potential. */
static inline int fvi_potential_is_quadratic(const fvi_potential *u)
{
    return u->quadratic && u->quadratic(u->params);
}

#endif
