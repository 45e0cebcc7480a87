/* src/methods/methods.c -- The table of the methods.  [H 2, 9, 13 and 17] */
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
    &fvi_cq2_shifted,        &fvi_cq_bdf2,
    &fvi_lobatto_m2,       &fvi_lobatto_m3,
    &fvi_lobatto_m4,       &fvi_variable_step,
    &fvi_lobatto_m5,       &fvi_lobatto_m6,
    &fvi_lobatto_m7,       &fvi_lobatto_m8,
    &fvi_lobatto_d2,      &fvi_lobatto_d3,
    &fvi_lobatto_d4,      &fvi_lobatto_d5,
    &fvi_lobatto_d6,      &fvi_lobatto_d7,
    &fvi_lobatto_d8,      &fvi_cq2_midpoint,
    NULL
};

const fvi_method *fvi_method_find(const char *name)
{
    for (size_t i = 0; name && fvi_methods[i]; i++)
        if (strcmp(name, fvi_methods[i]->name) == 0)
            return fvi_methods[i];
    return NULL;
}
