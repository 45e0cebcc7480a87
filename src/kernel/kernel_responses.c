/* src/kernel/kernel_responses.c -- Compute the responses of a law to a jump, a line and a parabola. [H 26] */
#include "kernel_responses.h"

#include "kernel_impulses_state.h"
#include "kernel_terms.h"

#include <math.h>
#include <string.h>

/* The nodes of the parabola, followed by the poles of C off the cut. */
typedef struct {
    size_t count;
    double complex s[NODES + MOST_POLES], weight[NODES + MOST_POLES];
} inverse;

static void evaluate(const inverse *of, double t, double *response)
{
    memset(response, 0, FVI_KERNEL_RESPONSES * sizeof *response);
    for (size_t j = 0; j < of->count; j++) {
        double complex term = of->weight[j] * cexp(of->s[j] * t);
        for (size_t m = 0; m < FVI_KERNEL_RESPONSES; m++)
            response[m] += creal(term /= of->s[j]);
    }
}

/* Compute the responses of rho s^o: rho t^(m - 1 - o) / Gamma(m - o). They are 0 where Gamma has a pole. */
static void evaluate_power(const fvi_kernel_term *of, double t, double *response)
{
    const double o = 2 * of->alpha;
    for (int m = 1; m <= FVI_KERNEL_RESPONSES; m++)
        response[m - 1] = m == o || m == o - 1 ? 0 : of->rho * pow(t, m - 1 - o) / tgamma(m - o);
}

int fvi_kernel_responses(const fvi_kernel *law, double h, size_t count, double *response)
{
    fvi_impulses_of_kernel *o;
    inverse now = { 0 };
    if (fvi_kernel_is_power(law)) {
        for (size_t k = 1; k <= count; k++, response += FVI_KERNEL_RESPONSES)
            evaluate_power(law->term, (double)k * h, response);
        return FVI_SUCCESS;
    }
    const int status = fvi_impulses_of_kernel_alloc(law, h, &o);
    if (status)
        return status;
    for (size_t k = 1, last = 0; k <= count; k++, response += FVI_KERNEL_RESPONSES) {
        if (k > last) {
            now.count = fvi_inverse_nodes(o, (double)k * h, now.s, now.weight);
            last = SPAN * k;
        }
        evaluate(&now, (double)k * h, response);
    }
    fvi_impulses_of_kernel_free(o);
    return FVI_SUCCESS;
}
