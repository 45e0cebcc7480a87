/* src/observer/lobatto_within.c -- x and p at a time within the last step of a method with stages. [H 17] */
#include <fvi/lobatto.h>

#include <fvi/error.h>
#include <fvi/lagrangian.h>

#include "mechanism/mechanism_state.h"
#include "methods/lobatto_matrices.h"
#include "methods/lobatto_stages.h"
#include "system/lagrange_polynomial.h"

#include <stdlib.h>

/* l_i'(theta) */
static double slope_of_polynomial(const fvi_lobatto_rule *rule, size_t count, size_t i, double theta)
{
    double sum = 0;
    for (size_t n = 0; n < count; n++) {
        double product = n == i ? 0 : 1 / (rule->c[i] - rule->c[n]); /* the factor that is differentiated */
        for (size_t m = 0; m < count; m++)
            if (m != i && m != n)
                product *= (theta - rule->c[m]) / (rule->c[i] - rule->c[m]);
        sum += product;
    }
    return sum;
}

/* The factor of stage i in the path at theta, or with `slope` in its derivative by t. */
static double stage_weight(const fvi_lobatto_rule *rule, size_t count, size_t i, double theta, double h,
                           int slope)
{
    return slope ? slope_of_polynomial(rule, count, i, theta) / h
                 : fvi_lagrange_polynomial(count, rule->c, i, theta);
}

/* Write x_{k+1} + sum_i l_i(theta) (X_i - X_s), which at theta = 1 is x_{k+1} to the bit; with `slope` its derivative
 * by t. `stages` has the positions of the stages, or their differences from x_k. */
static void write_path_of_stages(const fvi_stepper *s, const fvi_lobatto_rule *rule, size_t count, const double *stages,
                                 double theta, int slope, double *x)
{
    const size_t d = s->run.system->d;
    const double *last = stages + (count - 1) * d;
    for (size_t j = 0; j < d; j++)
        x[j] = slope ? 0 : s->x[j];
    for (size_t i = 0; i + 1 < count; i++) {
        const double share = stage_weight(rule, count, i, theta, s->run.h, slope);
        for (size_t j = 0; j < d; j++)
            x[j] += share * (stages[i * d + j] - last[j]);
    }
}

/* The same where the velocities of the stages are known: X_i - X_s = h sum_m (A_im - A_sm) V_m. */
static void write_path_of_matrices(const fvi_stepper *s, const fvi_lobatto_matrices *o, double theta,
                                   int slope, double *x)
{
    double A[FVI_STAGES][FVI_STAGES];
    fvi_lobatto_table(o->rule, o->s, A);
    for (size_t j = 0; j < o->d; j++)
        x[j] = slope ? 0 : s->x[j];
    for (size_t m = 0; m < o->s; m++) {
        double share = 0;
        for (size_t i = 0; i + 1 < o->s; i++)
            share += stage_weight(o->rule, o->s, i, theta, s->run.h, slope) * (A[i][m] - A[o->s - 1][m]);
        for (size_t j = 0; j < o->d; j++)
            x[j] += s->run.h * share * o->V[m * o->d + j];
    }
}

/* Write the path at t, or its slope. */
static int write_path(const fvi_stepper *s, double t, int slope, double *x)
{
    if (s->method->stages == 0)
        return FVI_EUNSUP;
    const double h = s->run.h, theta = 1 + (t - s->t) / h;
    if (s->k == 0 || !(theta >= -1e-9 && theta <= 1 + 1e-9))
        return FVI_EDOM;
    const fvi_mechanism_state *mechanism = fvi_mechanism_of(s);
    const fvi_lobatto_matrices *matrices = fvi_lobatto_matrices_of(s);
    if (matrices) {
        write_path_of_matrices(s, matrices, theta, slope, x);
    } else if (mechanism) {
        write_path_of_stages(s, mechanism->rule, mechanism->s, mechanism->X, theta, slope, x);
    } else {
        const fvi_lobatto_stages *o = s->method_state;
        write_path_of_stages(s, o->rule, o->s, o->dX, theta, slope, x);
    }
    return FVI_SUCCESS;
}

int fvi_lobatto_within(const fvi_stepper *s, double t, double *x)
{
    return s && x ? write_path(s, t, 0, x) : FVI_EFAULT;
}

int fvi_lobatto_momentum_within(const fvi_stepper *s, double t, double *p)
{
    if (!s || !p)
        return FVI_EFAULT;
    const fvi_system *system = s->run.system;
    double *x = malloc(2 * system->d * sizeof *x);
    if (!x)
        return FVI_ENOMEM;
    double *v = x + system->d;
    int status = write_path(s, t, 0, x);
    if (!status)
        status = write_path(s, t, 1, v);
    if (!status)
        status = system->matrices
                     ? system->matrices->inertia(system->d, v, system->matrices->params, p)
                     : fvi_momentum_of_velocity(system, t, x, v, p);
    free(x);
    return status;
}
