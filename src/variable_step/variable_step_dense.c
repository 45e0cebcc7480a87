/* src/variable_step/variable_step_dense.c -- The motion between the ends of a step, and beyond the step. [H 22] */
#include "variable_structure.h"

#include "memory/history_kinds.h" /* FVI_VECTORS */
#include <fvi/error.h>

#include <stdlib.h>
#include <string.h>

/* ---- within a step, by powers of theta ---- */

/* The coefficients of P_n(2 theta - 1) = sum_k (-1)^{n+k} binom(n, k) binom(n + k, k) theta^k, column by column. The
 * largest numbers multiply the last Legendre coefficients, which are small in an accepted step. */
//> powers
static const fvi_square powers = { { { 1 },
                                     { -1, 2 },
                                     { 1, -6, 6 },
                                     { -1, 12, -30, 20 },
                                     { 1, -20, 90, -140, 70 },
                                     { -1, 30, -210, 560, -630, 252 },
                                     { 1, -42, 420, -1680, 3150, -2772, 924 },
                                     { -1, 56, -756, 4200, -11550, 16632,
                                       -12012, 3432 } } };
//< powers

void fvi_variable_step_powers(size_t s, const double *accel_legendre, double *g)
{
    fvi_square_apply(s, &powers, accel_legendre, g);
}

static const fvi_four integral[] = { { 1, 1. / 2, 1. / 3, 1. / 4 },
                                     { 1. / 5, 1. / 6, 1. / 7, 1. / 8 } },
                      double_integral[] = {
                          { 1. / 2, 1. / 6, 1. / 12, 1. / 20 },
                          { 1. / 30, 1. / 42, 1. / 56, 1. / 72 }
                      };

/* Compute w_k = first theta^k by_k. */
static inline __attribute__((always_inline)) void
weigh_powers(double first, double theta, const fvi_four by[2], fvi_four *w)
{
    const double square = theta * theta, cube = square * theta;
    const fvi_four low = { first, first * theta, first * square, first * cube },
                   high = low * (square * square);
    w[0] = low * by[0];
    w[1] = high * by[1];
}

void fvi_variable_step_once(double theta, double *w)
{
    weigh_powers(theta, theta, integral, (fvi_four *)w);
}

void fvi_variable_step_twice(double theta, double *w)
{
    weigh_powers(theta * theta, theta, double_integral, (fvi_four *)w);
}

/* Return sum_k w_k g_k. g has zeros behind the s-th number. */
static inline __attribute__((always_inline)) double weighted_sum(const fvi_four *w,
                                                                 const double *g)
{
    const fvi_four *x = (const fvi_four *)g, sum = w[0] * x[0] + w[1] * x[1];
    return (sum[0] + sum[2]) + (sum[1] + sum[3]);
}

/* Compute x = x_k + theta h v_k + the double integral of x''. */
FVI_VECTORS static void find_positions(const fvi_variable_step_state *o, double h,
                                       double theta, double *x)
{
    fvi_four w[2];
    weigh_powers(theta * theta, theta, double_integral, w);
    for (size_t j = 0; j < o->d; j++)
        x[j] = o->y0[j]
               + h
                     * (theta * o->v0[j]
                        + weighted_sum(w, o->powers + j * FVI_LANES));
}

/* Compute p = m v, with v = v_k + the integral of x''. */
FVI_VECTORS static void find_momenta(const fvi_variable_step_state *o, const double *mass,
                                     double theta, double *p)
{
    fvi_four w[2];
    weigh_powers(theta, theta, integral, w);
    for (size_t j = 0; j < o->d; j++)
        p[j] = (o->v0[j] + weighted_sum(w, o->powers + j * FVI_LANES)) * mass[j];
}

/* Compute p = M v for a system with matrices. */
static int momenta_of_matrices(const fvi_stepper *s, fvi_variable_step_state *o, double theta,
                               double *p)
{
    const fvi_matrices *m = s->run.system->matrices;
    find_momenta(o, o->structure->ones, theta, o->structure->Kv);
    return m->inertia(o->d, o->structure->Kv, m->params, p);
}

/* Convert x'' of the last step to powers of theta. */
static void make_powers(fvi_variable_step_state *o)
{
    for (size_t j = 0; j < o->d; j++)
        fvi_variable_step_powers(o->rule->s, o->accel_legendre0 + j * FVI_LANES,
                            o->powers + j * FVI_LANES);
    o->powers_known = 1;
}

/* Add the singular part of a start to x and p. */
static void add_singular(const fvi_variable_step_state *o, const double *mass,
                         double t, double *x, double *p)
{
    for (size_t j = 0; j < o->d; j++) {
        double G, slope;
        fvi_singular_at(&o->singular, j, t, &G, &slope, NULL);
        if (x)
            x[j] += G;
        if (p)
            p[j] += mass[j] * slope;
    }
}

/* Project p of a mechanism at theta, so that its velocity keeps to the constraints. */
static int project_momentum(const fvi_stepper *s, double t, double theta, double *p)
{
    const fvi_variable_step_state *o = s->method_state;
    double *x = malloc(2 * o->d * sizeof *x);
    if (!x)
        return FVI_ENOMEM;
    find_positions(o, s->t - o->t0, theta, x);
    memcpy(x + o->d, o->v, o->d * sizeof *x);
    const int status = fvi_mesh_project_within(s, t, x, p, x + o->d);
    free(x);
    return status;
}

//> dense
/* Compute x and p at a time within the last step: x'' is integrated twice, and once. (22.18) */
int fvi_variable_step_dense(const fvi_stepper *s, double t, double *x, double *p)
{
    fvi_variable_step_state *o = s->method_state;
    const double h = s->t - o->t0, theta = (t - o->t0) / h;
    if (!(h > 0 && theta >= 0 && theta <= 1))
        return FVI_EDOM;
    if (!o->powers_known)
        make_powers(o);
    if (x)
        find_positions(o, h, theta, x);
    if (p && o->mechanism) {
        fvi_mesh_momentum(s, o, theta, 0, p);
        return s->mechanism->last_m ? project_momentum(s, t, theta, p) : FVI_SUCCESS;
    }
    if (p && o->structure)
        return momenta_of_matrices(s, o, theta, p);
    if (p)
        find_momenta(o, s->run.system->mass, theta, p);
    if (fvi_singular_is(o, o->t0) && t > 0)
        add_singular(o, s->run.system->mass, t, x, p);
    return FVI_SUCCESS;
}
//< dense

/* Compute sum_k first_i theta_i^k by_k g_k for eight rows of one mass, in the order of `product`. It computes all eight
 * sums, even if fewer are wanted, because the compiler makes one vector of a loop of known length. */
FVI_VECTORS static void sums_of_eight_rows(const double *restrict g, const double *restrict by,
                                           const double *restrict first,
                                           const double *restrict theta, double *restrict sum)
{
#pragma omp simd
    for (int i = 0; i < 8; i++) {
        const double square = theta[i] * theta[i], cube = square * theta[i],
                     four = square * square, one = first[i] * theta[i],
                     two = first[i] * square, three = first[i] * cube;
        const double a = first[i] * by[0] * g[0] + first[i] * four * by[4] * g[4],
                     b = one * by[1] * g[1] + one * four * by[5] * g[5],
                     c = two * by[2] * g[2] + two * four * by[6] * g[6],
                     d = three * by[3] * g[3] + three * four * by[7] * g[7];
        sum[i] = (a + c) + (b + d);
    }
}

/* Compute at most eight rows of one mass, with the operations of `find_positions` and `find_momenta`. */
static void rows_of_one_mass(const fvi_stepper *s, size_t count, const double *t, double *x,
                             double *p)
{
    const fvi_variable_step_state *o = s->method_state;
    const double h = s->t - o->t0, y = o->y0[0], v = o->v0[0],
                 mass = s->run.system->mass[0];
    double theta[8] = { 0 }, square[8] = { 0 }, sum[8];
    for (size_t i = 0; i < count; i++) {
        theta[i] = (t[i] - o->t0) / h;
        square[i] = theta[i] * theta[i];
    }
    if (x)
        sums_of_eight_rows(o->powers, (const double *)double_integral, square, theta, sum);
    for (size_t i = 0; i < count && x; i++)
        x[i] = y + h * (theta[i] * v + sum[i]);
    if (p)
        sums_of_eight_rows(o->powers, (const double *)integral, theta, theta, sum);
    for (size_t i = 0; i < count && p; i++)
        p[i] = (v + sum[i]) * mass;
}

int fvi_variable_step_rows(const fvi_stepper *s, size_t count, const double *t, double *x,
                           double *p)
{
    fvi_variable_step_state *o = s->method_state;
    const int is_plain = o->d == 1 && !o->mechanism && !o->structure
                         && !fvi_singular_is(o, o->t0) && s->t > o->t0
                         && t[0] >= o->t0 && t[count - 1] <= s->t;
    int status = FVI_SUCCESS;
    for (size_t i = 0; i < count && !is_plain && !status; i++)
        status = fvi_variable_step_dense(s, t[i], x ? x + i * o->d : NULL,
                                         p ? p + i * o->d : NULL);
    if (is_plain && !o->powers_known)
        make_powers(o);
    for (size_t i = 0; i < count && is_plain; i += 8)
        rows_of_one_mass(s, count - i < 8 ? count - i : 8, t + i, x ? x + i : NULL,
                         p ? p + i : NULL);
    return status;
}

void fvi_variable_step_within(const fvi_stepper *s, const fvi_variable_step_state *o,
                              double theta, double *x, double *p)
{
    const double h = o->length.h, t = o->t + theta * h;
    double by_x[FVI_LANES], by_v[FVI_LANES], g[FVI_LANES];
    fvi_variable_step_twice(theta, by_x);
    fvi_variable_step_once(theta, by_v);
    for (size_t j = 0; j < o->d; j++) {
        fvi_variable_step_powers(o->rule->s, o->accel_legendre + j * FVI_LANES, g);
        x[j] = o->y[j]
               + h * (theta * o->v[j] + weighted_sum((const fvi_four *)by_x, g));
        if (!o->mechanism)
            p[j] = s->run.system->mass[j]
                   * (o->v[j] + weighted_sum((const fvi_four *)by_v, g));
    }
    if (o->mechanism)
        fvi_mesh_momentum(s, o, theta, 1, p);
    if (fvi_singular_is(o, o->t) && t > 0)
        add_singular(o, s->run.system->mass, t, x, p);
}

int fvi_variable_step_acceleration(const fvi_stepper *s, double t, double *a)
{
    fvi_variable_step_state *o = s->method_state;
    const double h = s->t - o->t0, theta = (t - o->t0) / h;
    if (!(h > 0 && theta >= 0 && theta <= 1))
        return FVI_EDOM;
    if (!o->powers_known)
        make_powers(o);
    for (size_t j = 0; j < o->d; j++) {
        const double *g = o->powers + j * FVI_LANES;
        double sum = 0;
        for (size_t n = FVI_LANES; n-- > 0;)
            sum = sum * theta + g[n];
        a[j] = sum / h;
        if (fvi_singular_is(o, o->t0) && t > 0)
            a[j] += fvi_singular_acceleration(&o->singular, j, t);
    }
    return FVI_SUCCESS;
}

/* ---- beyond a step, by Legendre's polynomials, because powers would lose digits there ---- */

/* The factors of the recurrence, as a table, so that no row waits for a division. */
#define UP(n) ((2.0 * (n) + 1) / ((n) + 1))
#define DOWN(n) ((n) / ((n) + 1.0))
#define HALF(n) (1 / (4.0 * (n) + 2))
#define EACH(f)                                                                \
    {                                                                          \
        f(0), f(1), f(2), f(3), f(4), f(5), f(6), f(7)                         \
    }
static const double up[FVI_LANES] = EACH(UP), down[FVI_LANES] = EACH(DOWN),
                    half[FVI_LANES] = EACH(HALF);

/* Compute the integrals of P_n(2 u - 1), n < s, from 0 to four numbers theta: R_n(theta_i) at column[n][i]. */
//> legendre
FVI_VECTORS static void integrate(size_t s, const double *theta,
                                  double (*column)[FVI_LANES])
{
    const fvi_four u = { theta[0], theta[1], theta[2], theta[3] };
    fvi_four P[FVI_LANES + 1], x = 2 * u - 1;
    P[0] = (fvi_four){ 1, 1, 1, 1 };
    P[1] = x;
    *(fvi_four *)column[0] = u;
    for (size_t n = 1; n < s; n++) {
        P[n + 1] = up[n] * x * P[n] - down[n] * P[n - 1];
        *(fvi_four *)column[n] = half[n] * (P[n + 1] - P[n - 1]);
    }
}
//< legendre

void fvi_variable_step_shapes(size_t s, const double *theta, fvi_square *R)
{
    for (size_t i = 0; i < s; i += 4)
        integrate(s, theta + i, (double(*)[FVI_LANES])(R->column[0] + i));
}
