/* src/system/quadratic.h -- Is the Hessian of a potential the same everywhere? */
#ifndef FVI_QUADRATIC_H
#define FVI_QUADRATIC_H

#include <fvi/system.h>

/* fvi_potential_is_quadratic -- does the potential say that it is quadratic? One that is not there says nothing. */
static inline int fvi_potential_is_quadratic(const fvi_potential *u)
{
    return u->quadratic && u->quadratic(u->params);
}

#endif
