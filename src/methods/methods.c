/* src/methods/methods.c -- The table of the methods.  [Chapters 2, 9, 13 and 17] */
#include <fvi/methods.h>

#include <fvi/convolution_quadrature_methods.h>
#include <fvi/discrete_mechanics.h>
#include <fvi/fvi.h>
#include <fvi/lobatto.h>
#include <fvi/variable_steps.h>

#include <string.h>

const fvi_method *const fvi_methods[] = {
    &fvi_fractional,     &fvi_lagrange_dalembert,
    &fvi_euler_explicit, &fvi_euler_implicit,
    &fvi_shifted,        &fvi_bdf2,
    &fvi_lobatto2,       &fvi_lobatto3,
    &fvi_lobatto4,       &fvi_adaptive,
    &fvi_lobatto5,       &fvi_lobatto6,
    &fvi_lobatto7,       &fvi_lobatto8,
    &fvi_lobatto2d,      &fvi_lobatto3d,
    &fvi_lobatto4d,      &fvi_lobatto5d,
    &fvi_lobatto6d,      &fvi_lobatto7d,
    &fvi_lobatto8d,      &fvi_stable,
    NULL
};

const fvi_method *fvi_method_named(const char *name)
{
    for (size_t i = 0; name && fvi_methods[i]; i++)
        if (strcmp(name, fvi_methods[i]->name) == 0)
            return fvi_methods[i];
    return NULL;
}
