/* src/observer/lobatto_within.c -- Where is the body within the last step of a method with stages? [H 17] */
#include <fvi/lobatto.h>

#include <fvi/error.h>

#include "mechanism/mechanism_state.h"
#include "methods/lobatto_matrices.h"
#include "methods/lobatto_stages.h"

#include <math.h>

/* x_{k+1} + sum_i l_i(theta) (X_i - X_s): at theta = 1 it is x_{k+1} to the bit. `stages` has the places,
 * or what they differ by from x_k. */
static void put_place(const fvi_stepper *s, const fvi_lobatto_rule *rule, size_t count, const double *stages,
                      double theta, double *x)
{
    const size_t d = s->run.system->d;
    const double *last = stages + (count - 1) * d;
    for (size_t j = 0; j < d; j++)
        x[j] = s->x[j];
    for (size_t i = 0; i + 1 < count; i++) {
        const double share = fvi_lobatto_polynomial(rule, count, i, theta);
        for (size_t j = 0; j < d; j++)
            x[j] += share * (stages[i * d + j] - last[j]);
    }
}

/* The same where the velocities of the stages are known: X_i - X_s = h sum_m (A_im - A_sm) V_m. */
static void put_place_of_matrices(const fvi_stepper *s, const fvi_lobatto_matrices *o, double theta, double *x)
{
    double A[FVI_STAGES][FVI_STAGES];
    fvi_lobatto_table(o->rule, o->s, A);
    for (size_t j = 0; j < o->d; j++)
        x[j] = s->x[j];
    for (size_t m = 0; m < o->s; m++) {
        double share = 0;
        for (size_t i = 0; i + 1 < o->s; i++)
            share += fvi_lobatto_polynomial(o->rule, o->s, i, theta) * (A[i][m] - A[o->s - 1][m]);
        for (size_t j = 0; j < o->d; j++)
            x[j] += s->run.h * share * o->V[m * o->d + j];
    }
}

int fvi_lobatto_within(const fvi_stepper *s, double t, double *x)
{
    if (!s || !x)
        return FVI_EFAULT;
    if (s->method->stages == 0)
        return FVI_EUNSUP;
    const double h = s->run.h, theta = 1 + (t - s->t) / h;
    if (s->k == 0 || !(theta >= -1e-9 && theta <= 1 + 1e-9))
        return FVI_EDOM;
    const fvi_mechanism_state *mechanism = fvi_mechanism_of(s);
    const fvi_lobatto_matrices *matrices = fvi_lobatto_matrices_of(s);
    if (matrices) {
        put_place_of_matrices(s, matrices, theta, x);
    } else if (mechanism) {
        put_place(s, mechanism->rule, mechanism->s, mechanism->X, theta, x);
    } else {
        const fvi_lobatto_stages *o = s->method_state;
        put_place(s, o->rule, o->s, o->dX, theta, x);
    }
    return FVI_SUCCESS;
}
