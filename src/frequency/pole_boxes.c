/* src/frequency/pole_boxes.c -- Find poles that no undamped mode leads to.       [H 30] */
#include "pole_boxes.h"

#include "pole_count.h"
#include "system/fail.h"

#include <math.h>
#include <stdlib.h>

#define LEAST_BOX 1e-9 /* sum of two sides, of ln s */

/* Return how many poles of the list are in the box. */
static size_t count_known(const fvi_pole_list *list, const fvi_log_box *b)
{
    size_t count = 0;
    for (size_t k = 0; k < list->count; k++) {
        const double u = log(cabs(list->candidate[k].s)), v = carg(list->candidate[k].s);
        count += u > b->u[0] && u < b->u[1] && v > b->v[0] && v < b->v[1];
    }
    return count;
}

/* Return nonzero if v is no sum of the q orthonormal vectors of `basis`. Then the part of v that is orthogonal to them,
 * with length 1, becomes vector q. */
static int extends_basis(size_t d, size_t q, double complex *basis, const double complex *v)
{
    double complex *w = basis + q * d;
    double whole = 0, left = 0;
    for (size_t i = 0; i < d; i++) {
        w[i] = v[i];
        whole += creal(v[i] * conj(v[i]));
    }
    for (size_t k = 0; k < q; k++) {
        double complex part = 0;
        for (size_t i = 0; i < d; i++)
            part += conj(basis[k * d + i]) * w[i];
        for (size_t i = 0; i < d; i++)
            w[i] -= part * basis[k * d + i];
    }
    for (size_t i = 0; i < d; i++)
        left += creal(w[i] * conj(w[i]));
    for (size_t i = 0; i < d; i++)
        w[i] /= sqrt(left);
    return left > 1e-6 * whole;
}

/* Return 1 if the pole p is new: no pole of the list is close to it, or its shape is no sum of their shapes. Return 0
 * if it is not, and -1 if there is no memory. */
static int is_new_pole(size_t d, const fvi_pole_list *list, const fvi_pole_candidate *p)
{
    double complex *basis = malloc((list->count + 1) * d * sizeof *basis);
    size_t q = 0;
    for (size_t k = 0; basis && k < list->count; k++)
        if (fvi_pole_is_close(&list->candidate[k], p))
            q += (size_t)extends_basis(d, q, basis, list->candidate[k].v);
    const int is_new = basis ? extends_basis(d, q, basis, p->v) : -1;
    free(basis);
    return is_new;
}

/* Start Newton's method in the middle of the box. A pole that is new goes into the list, wherever it is. */
static int try_middle(fvi_response *r, const fvi_log_box *b, fvi_pole_list *list)
{
    fvi_pole_candidate *p = &list->candidate[list->count];
    p->s = cexp((b->u[0] + b->u[1]) / 2 + I * (b->v[0] + b->v[1]) / 2);
    const int status = fvi_pole_newton_from(r, p, &list->seed);
    if (status || !fvi_pole_is_found(p, FVI_NEARLY_REAL))
        return status;
    const int is_new = is_new_pole(r->d, list, p);
    list->count += is_new > 0;
    return is_new < 0 ? FVI_ENOMEM : FVI_SUCCESS;
}

int fvi_poles_in_box(fvi_response *r, const fvi_log_box *b, size_t n, fvi_pole_list *list)
{
    if (count_known(list, b) >= n || list->count == list->room)
        return FVI_SUCCESS;
    int status = try_middle(r, b, list);
    if (status || count_known(list, b) >= n || b->u[1] - b->u[0] + b->v[1] - b->v[0] < LEAST_BOX)
        return status;
    fvi_log_box half[2];
    const int first = fvi_halve_box(fvi_poles_phase, r, fvi_poles_step(r), b, half);
    status = fvi_interrupted();
    if (status || first < 0 || (size_t)first > n)
        return status;
    status = fvi_poles_in_box(r, &half[0], (size_t)first, list);
    return status ? status : fvi_poles_in_box(r, &half[1], n - (size_t)first, list);
}
