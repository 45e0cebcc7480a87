/* src/adjoint_mechanism/adjoint_mechanism_constraints.c -- The adjoint of the projection onto the constraints. [H 23,
 * 29]
 *
 * At a node p becomes p - C^T w, so that the velocity of the new p satisfies C v + c_t = 0. Let b be the multiplier of
 * the new p, epsilon that of L_v(x, v) = p, and delta that of the hidden constraint. Then
 *
 *     L_vv epsilon = C^T delta,   C epsilon = -C b,   beta = b + epsilon.                 (23.30)
 *
 * If J depends on v itself, that derivative is added to C^T delta. */
#include "adjoint_mechanism.h"

#include "system/fail.h"
#include "system/lagrangian_point.h"

#include <string.h>

/* Refuse a constraint that moves: its c_t has derivatives by x, which no callback gives. For an imposed coordinate they
 * are 0. */
static int check_rates(const fvi_constraints *c, const double *ct)
{
    for (size_t l = 0; l < c->count; l++)
        if (ct[l] != 0 && !(c->imposed && c->imposed[l]))
            FVI_FAIL("no adjoint of a constraint that knows the time; of imposed coordinates there "
                     "is one",
                     FVI_EUNSUP);
    return FVI_SUCCESS;
}

/* Solve for epsilon and -delta, d + m numbers, with the matrix of the projection. */
static int solve(fvi_adjoint_mechanism *m, const double *C, const double *by_v, double *right)
{
    const fvi_mechanism_state *o = m->o;
    const size_t d = m->d, c = o->m, n = d + c;
    double *A = m->projection;
    memset(A, 0, n * n * sizeof *A);
    for (size_t i = 0; i < d; i++) {
        memcpy(A + i * n, o->Lvv + i * d, d * sizeof *A);
        for (size_t l = 0; l < c; l++)
            A[i * n + d + l] = A[(d + l) * n + i] = C[l * d + i];
        if (o->is_massless[i]) /* p does not determine its velocity, which stays what it is */
            A[i * n + i] = 1;
    }
    for (size_t i = 0; i < n; i++)
        right[i] = by_v && i < d && !o->is_massless[i] ? by_v[i] : 0;
    for (size_t l = 0; l < c; l++)
        for (size_t i = 0; i < d; i++)
            right[d + l] -= C[l * d + i] * m->beta[i];
    return fvi_solve_matrix(n, A, right, m->order);
}

/* g += Hess c (v) delta - w Hess c beta - L_vx^T epsilon. */
static int add_constraint_curvature(fvi_adjoint_mechanism *m, double t, const double *x, const double *v,
                                    const double *w, const double *right)
{
    const fvi_mechanism_state *o = m->o;
    const fvi_constraints *c = m->run->system->mechanism->constraints;
    const size_t d = m->d;
    double *H = m->room, *factor = m->factors;
    int status = FVI_SUCCESS;
    for (int part = 0; part < 2 && !status; part++) {
        const double *direction = part ? m->beta : v;
        for (size_t l = 0; l < o->m; l++)
            factor[l] = part ? -w[l] : -right[d + l];
        memset(H, 0, d * d * sizeof *H);
        if (o->m)
            status = c->hessian(t, d, x, factor, c->params, H);
        for (size_t i = 0; i < d * d; i++)
            m->g[i / d] += H[i] * direction[i % d];
    }
    for (size_t i = 0; i < d; i++)
        for (size_t j = 0; j < d; j++)
            m->g[j] -= o->Lxv[j * d + i] * right[i];
    return status;
}

int fvi_adjoint_mechanism_project(fvi_adjoint_mechanism *m, double t, const double *x,
                                  const double *v, const double *w, const double *by_v)
{
    fvi_mechanism_state *o = m->o;
    const fvi_constraints *c = m->run->system->mechanism->constraints;
    const size_t d = m->d;
    double *right = m->multiplier, *C = m->gradient, *ct = m->factors;
    if (o->m == 0 && !by_v)
        return FVI_SUCCESS;
    memcpy(o->X, x, d * sizeof *x);
    memcpy(o->V, v, d * sizeof *v);
    int status = fvi_mechanism_point(m->stepper, 0, t, 0);
    if (!status && o->m)
        status = c->gradient(t, d, x, c->params, C, ct);
    if (!status && o->m)
        status = check_rates(c, ct);
    if (!status)
        status = solve(m, C, by_v, right);
    for (size_t i = 0; i < d; i++) {
        m->beta[i] += right[i];
        m->tau[i] = -right[i]; /* the derivatives by masses and parameters through L_v there */
    }
    if (!status)
        status = add_constraint_curvature(m, t, x, v, w, right);
    if (!status && o->m)
        status = fvi_adjoint_mechanism_names_node(m, t, x, v, w, right + d);
    memset(m->phi, 0, d * sizeof *m->phi);
    return status ? status : fvi_adjoint_mechanism_point(m, 0, t, m->tau, m->phi);
}
