/* tests/program/two_storeys.h -- A two-storey frame on a springpot, shaken by sin 8t. */
#ifndef TWO_STOREYS_H
#define TWO_STOREYS_H

#include "program.h"

static const char two[] =
    "--potential 'k*x1^2/2+k*(x2-x1)^2/2' --let k=100 --dimension 2 --rho 5,0 "
    "--alpha 0.3 --x0 0 --p0 0 --force '-sin(8*t)' --method fvi-lobatto4 "
    "--h 0.02 --steps 500";

static inline int fvi_two(const char *command, const char *rest)
{
    char line[600];
    snprintf(line, sizeof line, "%s %s %s", command, two, rest);
    return fvi(line);
}

#endif
