/* src/parameter_derivatives/potential_derivatives.c -- Hess U at the stages, and the derivatives by the parameters of
 * U. [H 23] */
#include "potential_derivatives.h"


int fvi_potential_evaluate_hessians(const fvi_system *system, size_t stages,
                                    const double *X, size_t size, double *G)
{
    const fvi_potential *u = &system->potential;
    int status = FVI_SUCCESS;
    for (size_t i = 0; size > 0 && !status && i < stages; i++)
        status = u->hessian(system->d, X + i * system->d, u->params, G + i * size);
    return status;
}

int fvi_potential_accumulate_parameters(const fvi_sensitivities *want,
                                        const fvi_system *system, size_t stages,
                                        double h, const double *b, const double *X,
                                        const double *Lambda, size_t stride,
                                        double *column)
{
    const fvi_parameter_gradient *by = &want->sensitivity;
    const size_t d = system->d;
    int status = FVI_SUCCESS;
    for (size_t i = 0; want->parameters && i < stages; i++)
        for (size_t p = 0; !status && p < by->count; p++) {
            status = by->column(p, d, X + i * d, system->potential.params, column);
            double sum = column[0] * Lambda[i];
            for (size_t j = 1; j < d; j++)
                sum += column[j] * Lambda[j * stride + i];
            want->parameters[p] -= (b ? h * b[i] : h) * sum;
        }
    return status;
}
