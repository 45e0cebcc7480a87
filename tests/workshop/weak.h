/* tests/workshop/weak.h -- The names of my.c, weak: what is missing has the address 0. And
 * the problem that all of a check's runs begin from. */
#ifndef WEAK_H
#define WEAK_H

#include "my.h"

#include "harness/ulp.h"

#include <stdlib.h>

#pragma weak m
#pragma weak c
#pragma weak cubic
#pragma weak rho
#pragma weak x0
#pragma weak p0
#pragma weak kappa
#pragma weak alpha
#pragma weak caputo
#pragma weak fast
#pragma weak second
#pragma weak grad
#pragma weak hess
#pragma weak solve
#pragma weak integrate
#pragma weak exact
#pragma weak weights
#pragma weak delta

#define NEED(name)                                                             \
    ck_assert_msg((const void *)(uintptr_t)&name != NULL,                      \
                  "there is no " #name " in my.c")

/* Every test sets all of the problem; what is not there yet is left out. */
typedef struct {
    double m, c, cubic, rho, x0, p0, kappa, alpha;
    int caputo, fast, second;
} problem;

static const problem paper = { 1, 1, 0, 0.2, 1, 0.5, 0.5, 0.5, 0, 0, 0 };

static void set(problem s)
{
    NEED(m), NEED(c), NEED(cubic), NEED(rho), NEED(x0), NEED(p0), NEED(kappa);
    m = s.m, c = s.c, cubic = s.cubic, rho = s.rho;
    x0 = s.x0, p0 = s.p0, kappa = s.kappa;
    if (&alpha != NULL)
        alpha = s.alpha;
    if (&caputo != NULL)
        caputo = s.caputo;
    if (&fast != NULL)
        fast = s.fast;
    if (&second != NULL)
        second = s.second;
}

static double *room(int count)
{
    double *x = malloc((size_t)count * sizeof *x);
    ck_assert_ptr_nonnull(x);
    return x;
}

#endif
