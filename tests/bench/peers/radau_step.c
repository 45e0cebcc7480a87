/* tests/bench/peers/radau_step.c -- The equations of the stages: radau_step.h. [H 18] */
#include "radau_step.h"
#include "memory/history_kinds.h" /* FVI_VECTORS */
#include "system/larger.h"

#include <gsl/gsl_math.h>
#include <stdlib.h>
#include <string.h>

/* Invert the s by s matrix K into inverse, by Gauss and Jordan. */
static void invert(int s, double *K, double *inverse)
{
    for (int i = 0; i < s * s; i++)
        inverse[i] = i % (s + 1) == 0;
    for (int k = 0; k < s; k++) {
        int best = k;
        for (int i = k + 1; i < s; i++)
            if (fabs(K[i * s + k]) > fabs(K[best * s + k]))
                best = i;
        for (int j = 0; j < s && best != k; j++) {
            double t = K[k * s + j], r = inverse[k * s + j];
            K[k * s + j] = K[best * s + j];
            K[best * s + j] = t;
            inverse[k * s + j] = inverse[best * s + j];
            inverse[best * s + j] = r;
        }
        const double pivot = 1 / K[k * s + k];
        for (int j = 0; j < s; j++) {
            K[k * s + j] *= pivot;
            inverse[k * s + j] *= pivot;
        }
        for (int i = 0; i < s; i++) {
            const double f = K[i * s + k];
            for (int j = 0; j < s && i != k; j++) {
                K[i * s + j] -= f * K[k * s + j];
                inverse[i * s + j] -= f * inverse[k * s + j];
            }
        }
    }
}

/* Return the factors for steps of length h. They are made at the first call for this length. */
static const radau_factor *factor_of(radau_solver *o, double h)
{
    const int s = o->s;
    const size_t ss = (size_t)(s * s);
    const fvi_system *system = &o->p->system;
    for (int k = o->kept - 1; k >= 0; k--)
        if (o->factors[k].h == h)
            return &o->factors[k];
    radau_factor *f = &o->factors[o->kept < KEPT ? o->kept++ : KEPT - 1];
    f->h = h;
    if (!f->K)
        f->K = malloc(2 * o->kinds * ss * sizeof *f->K);
    if (!f->K)
        return NULL;
    f->inverse = f->K + o->kinds * ss;
    for (size_t a = 0; a < o->d; a++) {
        const double mass = system->mass[a] / h,
                     rho = system->damping[a] * pow(h, -o->beta);
        double J[S * S], *K = f->K + o->kind[a] * ss;
        if (a > 0 && o->kind[a] == o->kind[a - 1])
            continue;
        for (int i = 0; i < s; i++)
            for (int j = 0; j < s; j++) {
                K[i * s + j] = mass * o->m->M[i][j] + rho * o->W[i * s + j];
                J[i * s + j] = K[i * s + j] + o->curvature * h * o->m->A[i][j];
            }
        invert(s, J, f->inverse + o->kind[a] * ss);
    }
    return f;
}

/* out = K in for each of d coordinates, stage by stage. */
FVI_VECTORS static void mix(int s, size_t d, const double *restrict K,
                            const double *restrict in, double *restrict out)
{
    for (int i = 0; i < s; i++)
        OUTER_SIMD for (size_t a = 0; a < d; a++)
        {
            double sum = 0;
            for (int j = 0; j < s; j++)
                sum += K[i * s + j] * in[(size_t)j * d + a];
            out[(size_t)i * d + a] = sum;
        }
}

/* H <- H - F, which the iterations do not change. */
static int subtract_force(radau_solver *o, double t, double h)
{
    const size_t d = o->d;
    const fvi_force *force = &o->p->system.force;
    for (int i = 0; i < o->s && force->value; i++) {
        const int status =
            force->value(t + h * o->m->c[i], d, force->params, o->room);
        if (status)
            return status;
        for (size_t a = 0; a < d; a++)
            o->H[(size_t)i * d + a] -= o->room[a];
    }
    return FVI_SUCCESS;
}

/* Compute X, and G = -grad U(X) - H, from D = V - v. */
static int evaluate_forces(radau_solver *o, double h)
{
    const size_t d = o->d;
    const fvi_system *system = &o->p->system;
    mix(o->s, d, o->A, o->D, o->X);
    for (int i = 0; i < o->s; i++) {
        double *X = o->X + (size_t)i * d, *G = o->G + (size_t)i * d;
        for (size_t a = 0; a < d; a++)
            X[a] = o->x[a] + h * (o->m->c[i] * o->v[a] + X[a]);
        const int status = fvi_potential_gradient(system, X, o->room);
        if (status)
            return status;
        for (size_t a = 0; a < d; a++)
            G[a] = -o->room[a] - o->H[(size_t)i * d + a];
    }
    return FVI_SUCCESS;
}

/* H <- rho (H + h^{-beta} M^beta 1 v for beta <= 0, and the initial history force of Riemann and Liouville). */
static void known(radau_solver *o, double t, double h)
{
    const double power = o->beta > 0 ? 0 : pow(h, -o->beta),
                 order = 2 * o->p->alpha;
    for (int i = 0; i < o->s; i++) {
        double row = 0, fades = 0;
        for (int j = 0; j < o->s; j++)
            row += power * o->W[i * o->s + j];
        if (o->p->past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE)
            fades = pow(t + h * o->m->c[i], -order) / tgamma(1 - order);
        for (size_t a = 0; a < o->d; a++) {
            double *H = &o->H[(size_t)i * o->d + a];
            *H = o->p->system.damping[a]
                 * (*H + row * o->v[a] + fades * o->p->x0[a]);
        }
    }
}

/* Make one step of the fixed-point iteration D <- K^{-1} G. Return the change of D, divided by its size. */
static double iterate(radau_solver *o, const radau_factor *f)
{
    const size_t d = o->d, n = (size_t)o->s * d;
    double moved = 0, largest = 0;
    if (o->kinds == 1)
        mix(o->s, d, f->inverse, o->G, o->V);
    for (size_t a = 0; a < d && o->kinds > 1; a++) {
        const double *K = f->inverse + o->kind[a] * (size_t)(o->s * o->s);
        for (int i = 0; i < o->s; i++) {
            double sum = 0;
            for (int j = 0; j < o->s; j++)
                sum += K[i * o->s + j] * o->G[(size_t)j * d + a];
            o->V[(size_t)i * d + a] = sum;
        }
    }
    for (size_t i = 0; i < n; i++) {
        moved = larger(moved, fabs(o->V[i] - o->D[i]));
        largest = larger(largest, fabs(o->V[i]));
    }
    memcpy(o->D, o->V, n * sizeof *o->D);
    return moved / larger(largest, 1e-30);
}

int radau_solve(radau_solver *o, double t, double h)
{
    known(o, t, h);
    const radau_factor *f = factor_of(o, h);
    const int linear = o->curvature != 0;
    double moved = 1, before = GSL_POSINF;
    if (!f)
        return FVI_ENOMEM;
    int status = subtract_force(o, t, h);
    if (status)
        return status;
    if (o->d == 1 && !linear)
        return radau_solve_one(o, h, f);
    if (linear)
        memset(o->D, 0, (size_t)o->s * sizeof *o->D);
    for (int i = 0; i < 100; i++) {
        status = evaluate_forces(o, h);
        if (status)
            return status;
        moved = iterate(o, f);
        if (linear || moved <= o->stop || (moved < 1e-13 && moved >= before))
            return FVI_SUCCESS;
        if (!(moved < 1e10) || (i > 5 && moved > 2 * before))
            break;
        before = moved;
    }
    return FVI_EMAXITER;
}
