/* src/system/sensitivity.c -- Derivatives of grad U by the parameters of the ready-made potentials. [H 23] */
#include <fvi/sensitivity.h>

#include <math.h>

/* Return the derivative of the spring force c r + g r^3 by c (j = 0) or by g (j = 1). */
static double differentiate_spring(size_t j, double r)
{
    return j == 0 ? r : r * r * r;
}

/* Serves the harmonic potential, too, which has only the parameter c. */
static int differentiate_duffing(size_t j, size_t d, const double *x, void *params, double *S)
{
    (void)params;
    for (size_t i = 0; i < d; i++)
        S[i] = differentiate_spring(j, x[i]);
    return 0;
}

/* Here grad U = g sin x. */
static int differentiate_pendulum(size_t j, size_t d, const double *x, void *params,
                                  double *S)
{
    (void)j, (void)params;
    for (size_t i = 0; i < d; i++)
        S[i] = sin(x[i]);
    return 0;
}

/* The force on mass i is the difference of the forces of its two springs. */
static int differentiate_chain(size_t j, size_t d, const double *x, void *params, double *S)
{
    (void)params;
    double left = differentiate_spring(j, x[0]);
    for (size_t i = 0; i < d; i++) {
        const double right = differentiate_spring(j, (i + 1 < d ? x[i + 1] : 0) - x[i]);
        S[i] = left - right;
        left = right;
    }
    return 0;
}

fvi_parameter_gradient fvi_parameter_gradient_of(const fvi_potential *u)
{
    const struct {
        fvi_potential potential;
        fvi_parameter_gradient sensitivity;
    } known[] = {
        { fvi_potential_harmonic(NULL), { 1, differentiate_duffing } },
        { fvi_potential_duffing(NULL), { 2, differentiate_duffing } },
        { fvi_potential_pendulum(NULL), { 1, differentiate_pendulum } },
        { fvi_potential_chain(NULL), { 2, differentiate_chain } },
    };
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (u->gradient == known[i].potential.gradient)
            return known[i].sensitivity;
    return (fvi_parameter_gradient){ 0 };
}
