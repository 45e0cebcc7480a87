/* tests/bench/peers/radau_one.c -- The equations of the stages of one mass: radau_step.h. [H 18]
 *
 * The number of stages is known when this is compiled, so that all loops are unrolled. */
#include "radau_step.h"
#include "system/larger.h"

#include <math.h>

PEER_SCALAR

/* J = L U in place, without exchanges of rows: K and A do not need them. */
PEER_INLINE void decompose(int s, double *J)
{
    for (int k = 0; k < s; k++) {
        J[k * s + k] = 1 / J[k * s + k];
        for (int i = k + 1; i < s; i++) {
            const double f = J[i * s + k] * J[k * s + k];
            J[i * s + k] = f;
            for (int j = k + 1; j < s; j++)
                J[i * s + j] -= f * J[k * s + j];
        }
    }
}

PEER_INLINE void substitute(int s, const double *J, double *r)
{
    for (int i = 1; i < s; i++)
        for (int j = 0; j < i; j++)
            r[i] -= J[i * s + j] * r[j];
    for (int i = s - 1; i >= 0; i--) {
        for (int j = i + 1; j < s; j++)
            r[i] -= J[i * s + j] * r[j];
        r[i] *= J[i * s + i];
    }
}

/* D <- D - J^{-1} (K D + H + U'(X)), X = x + h (c v + A D), until the change of D satisfies the tolerance. J is
 * computed at the guess. */
PEER_INLINE int solve(radau_solver *o, int s, double h, const radau_factor *f)
{
    const fvi_potential *U = &o->p->system.potential;
    double J[S * S], base[S], D[S], r[S], before = INFINITY;
    const double x = o->x[0], v = h * o->v[0];
    for (int i = 0; i < s; i++) {
        base[i] = x + v * o->m->c[i];
        D[i] = o->D[i];
    }
    for (int k = 0; k < 100; k++) {
        double moved = 0, largest = 1e-30;
        int status = FVI_SUCCESS;
        for (int i = 0; i < s; i++) {
            double X = 0, g, curvature;
            r[i] = o->H[i];
            for (int j = 0; j < s; j++) {
                X += o->A[i * s + j] * D[j];
                r[i] += f->K[i * s + j] * D[j];
            }
            X = base[i] + h * X;
            status |= U->gradient(1, &X, U->params, &g);
            r[i] += g;
            if (k == 0) {
                status |= U->hessian(1, &X, U->params, &curvature);
                for (int j = 0; j < s; j++)
                    J[i * s + j] = f->K[i * s + j] + curvature * h * o->A[i * s + j];
            }
        }
        if (status)
            return status;
        if (k == 0)
            decompose(s, J);
        substitute(s, J, r);
        for (int i = 0; i < s; i++) {
            D[i] -= r[i];
            moved = larger(moved, fabs(r[i]));
            largest = larger(largest, fabs(D[i]));
        }
        moved /= largest;
        if (moved <= o->stop || (moved < 1e-13 && moved >= before)) {
            for (int i = 0; i < s; i++)
                o->D[i] = D[i];
            return FVI_SUCCESS;
        }
        if (!(moved < 1e10) || (k > 5 && moved > 2 * before))
            break;
        before = moved;
    }
    return FVI_EMAXITER;
}

int radau_solve_one(radau_solver *o, double h, const radau_factor *f)
{
    switch (o->s) {
    case 2: return solve(o, 2, h, f);
    case 3: return solve(o, 3, h, f);
    case 5: return solve(o, 5, h, f);
    default: return solve(o, o->s, h, f);
    }
}
