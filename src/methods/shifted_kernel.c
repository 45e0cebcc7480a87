/* src/methods/shifted_kernel.c -- The corrected symbol of a law for fvi-shifted.  [H 26] */
#include "shifted_kernel.h"

//> corrected
void fvi_shifted_symbol(double re, double im, void *params, double *E_re,
                        double *E_im)
{
    const fvi_shifted_kernel *k = params;
    const double complex s = re + I * im;
    const int is_far = k->h * cabs(s) > 100;
    double complex slope; /* s C'(s) */
    double complex E = fvi_kernel_at(k->law, s, is_far ? NULL : &slope);
    if (!is_far)
        E += k->h * s * (slope / 2 - k->theta * E);
    *E_re = creal(E);
    *E_im = cimag(E);
}
//< corrected
