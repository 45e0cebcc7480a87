/* src/adjoint/adjoint_dampers_numbers.c -- The adjoint run of several dampers: derivatives by the numbers of their
 * laws. [H 23, 27]
 *
 * The order of a law that is one power stands in four places: in the weights of its history, in the factor
 * h^(1 - 2 alpha), in the shift of fvi-shifted, and in the impulses of its past. The terms of any other law have
 * histories of their own (node_terms.h). */
#include "adjoint_dampers.h"

#include "system/dot.h"
#include "system/fail.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- the start ---- */

static int start_terms(fvi_adjoint_dampers *m, const fvi_method *method, fvi_adjoint_damper *a)
{
    const fvi_kernel *law = a->of.law;
    int status = FVI_SUCCESS;
    a->term = calloc(law->count, sizeof *a->term);
    if (!a->term)
        FVI_FAIL("no memory for the adjoint run", FVI_ENOMEM);
    for (; !status && a->terms < law->count; a->terms++) {
        fvi_node_term *t = a->term + a->terms;
        status = fvi_node_term_start(m->run, m->want, fvi_damping_quadrature(method),
                                     law->term + a->terms, a->of.matrix.history_size,
                                     &a->of.matrix, t);
        if (!status && a->impulse_unit != 0)
            status = fvi_node_term_start_impulses(t, m->run->h, m->want);
    }
    return status || a->impulse_unit == 0
               ? status
               : fvi_damping_multiply(&a->of.matrix, m->d, 1, m->v0, a->CA);
}

int fvi_adjoint_dampers_numbers_start(fvi_adjoint_dampers *m, const fvi_method *method,
                                      fvi_adjoint_damper *a)
{
    if (a->of.law)
        return start_terms(m, method, a);
    if (!m->want->orders)
        return FVI_SUCCESS;
    a->Ndot = calloc(a->of.matrix.history_size, sizeof *a->Ndot);
    if (!a->Ndot)
        FVI_FAIL("no memory for the adjoint run", FVI_ENOMEM);
    return fvi_order_filter_start(method->scheme, a->of.alpha, a->of.matrix.history_size,
                                  &a->filter);
}

/* ---- a node ---- */

int fvi_adjoint_dampers_multiply(fvi_adjoint_dampers *m, const fvi_adjoint_damper *a,
                                 const double *z, const double *v, double *sum)
{
    memset(m->column, 0, m->d * sizeof *m->column);
    const int status =
        a->of.matrix.apply_damping(m->d, -1, v, a->of.matrix.params, m->column);
    *sum += fvi_dot(m->d, z, m->column);
    return status;
}

int fvi_adjoint_dampers_numbers_sums(fvi_adjoint_dampers *m, fvi_adjoint_damper *a,
                                     const double *z, const double *rows)
{
    int status = FVI_SUCCESS;
    if (a->of.law || !m->want->orders)
        return status;
    if (rows && m->is_shifted) {
        const size_t d = m->d;
        for (size_t i = 0; i < d; i++)
            m->moved[i] = rows[d + i] - rows[i] - (a->has_drift ? m->run->h * m->v0[i] : 0);
        status = fvi_adjoint_dampers_multiply(m, a, m->moved, a->damping->H, &a->sum_by_theta);
    }
    return status ? status
                  : fvi_adjoint_dampers_multiply(
                      m, a, z,
                      fvi_order_filter_next(&a->filter, a->damping->H, a->damping->Hdot,
                                            a->Ndot),
                      &a->sum_by_order);
}

int fvi_adjoint_dampers_numbers_step(fvi_adjoint_dampers *m, fvi_adjoint_damper *a, size_t k,
                                     const double *rows)
{
    const fvi_damping_matrix *C = &a->of.matrix;
    const double h = m->run->h, *left = m->stepper->x;
    double *in = m->history_input, *change = in + C->history_size;
    int status = FVI_SUCCESS;
    if (a->terms == 0)
        return status;
    memset(in, 0, 2 * C->history_size * sizeof *in);
    status = C->select_history(m->d, m->multipliers.mean, m->zeros, C->params, in);
    if (!status)
        status = C->select_history(m->d, m->multipliers.change, m->zeros, C->params, change);
    fvi_adjoint_dampers_elongation(m, a, k + 1, rows + m->d, m->z);
    for (size_t i = 0; i < m->d; i++)
        m->z[i] *= h;
    const double at_left = fvi_dot(m->d, a->CA, left), at_right = fvi_dot(m->d, a->CA, m->right);
    for (size_t l = 0; !status && l < a->terms; l++) {
        status = fvi_node_term_accumulate(a->term + l, in, change, m->z, m->want,
                                          a->first + l);
        fvi_node_term_accumulate_impulses(a->term + l, k, at_left, at_right, m->want,
                                          a->first + l);
    }
    return status;
}

/* ---- the end ---- */

/* Write the derivatives by rho and by alpha of a power. The order is 2 alpha, and e falls by 2 dalpha. */
int fvi_adjoint_dampers_numbers_end(fvi_adjoint_dampers *m, fvi_adjoint_damper *a, double at)
{
    const fvi_sensitivities *want = m->want;
    const double log_h = log(m->run->h), rho = a->of.rho;
    const double *A = a->of.growth < 1 ? m->run->x0 : m->v0;
    int status = FVI_SUCCESS;
    if (a->of.law)
        return status;
    if (want->terms)
        want->terms[a->first] = -a->unit * a->sum - at;
    if (!want->orders)
        return status;
    memset(m->column, 0, m->d * sizeof *m->column);
    if (a->impulse_unit != 0)
        status = fvi_damping_multiply(&a->of.matrix, m->d, a->impulse_unit, a->impulse_sum_by_order,
                                      m->column);
    const double rate = fvi_dot(m->d, A, m->column);
    want->orders[a->first] =
        rho
        * (2 * (log_h * at + rate)
           - a->unit * (2 * a->sum_by_order - 2 * log_h * a->sum + a->sum_by_theta));
    return status;
}

void fvi_adjoint_dampers_numbers_stop(fvi_adjoint_damper *a)
{
    for (size_t l = 0; l < a->terms; l++)
        fvi_node_term_stop(a->term + l);
    fvi_order_filter_stop(&a->filter);
    free(a->term);
    free(a->Ndot);
}
