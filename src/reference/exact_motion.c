/* src/reference/exact_motion.c -- Compute the exact motion of a linear system.     [H 11] */
#include <fvi/dampers.h>
#include <fvi/exact_motion.h>

#include "exact_motion_check.h"
#include "exact_motion_state.h"

#include "system/arrays.h"
#include "system/lagrangian_point.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* ---- the right-hand side b(s), and Z(s)^-1 b(s) ----
 *
 * The transform of the motion satisfies Z(s) Y(s) = b(s) with Y = X - x_0/s and b = p_0 - K x_0/s + F. F is the
 * transform of the force, which is the same on every unknown. A constant force is a source of its own, with b = A/s. A
 * step of the force that ends at T is a constant force from 0 on minus a constant force from T on. */

/* Compute b(s) of one source. */
static void evaluate_right_hand_side(const fvi_exact_motion *o, source_kind which,
                                     double complex s, double complex *b)
{
    const double complex cosine = o->forcing == FVI_FORCING_COSINE && o->w != 0
                                      ? o->A * s / (s * s + o->w * o->w)
                                      : 0;
    for (size_t i = 0; i < o->d; i++)
        b[i] = which == BY_STEP ? o->A / s : o->p0[i] - o->spring_force[i] / s + cosine;
}

/* Replace b by Z(s)^-1 b. */
static int solve_stiffness(fvi_exact_motion *o, double complex s, double complex *b,
                           fvi_error *error)
{
    const double at[2] = { creal(s), cimag(s) };
    return fvi_response_solve(o->response, at, (double *)b, (double *)b, error);
}

/* ---- the poles of Y ---- */

/* Set pole k of Y and its residue v v^T b(s_k). Here v is the shape of the pole, so v v^T is the residue of Z^-1. */
static void set_pole_and_residue(fvi_exact_motion *o, source_kind which, size_t k)
{
    source *y = o->source + which;
    const double complex *v = (const double complex *)o->poles.shape + k * o->d;
    double complex product = 0;
    y->pole[k] = o->poles.pole[2 * k] + I * o->poles.pole[2 * k + 1];
    evaluate_right_hand_side(o, which, y->pole[k], o->room);
    for (size_t i = 0; i < o->d; i++)
        product += v[i] * o->room[i];
    for (size_t i = 0; i < o->d; i++)
        y->residue[k * o->d + i] = product * v[i];
}

/* Add the pole i w of the cosine A s / (s^2 + w^2), where Y has the residue Z(i w)^-1 A / 2. */
static int add_pole_of_cosine(fvi_exact_motion *o, source *y, fvi_error *error)
{
    double complex *residue = y->residue + y->count * o->d;
    y->pole[y->count++] = I * o->w;
    for (size_t i = 0; i < o->d; i++)
        residue[i] = o->A / 2;
    return solve_stiffness(o, I * o->w, residue, error);
}

/* Allocate a source, and compute its poles and residues. */
static int prepare_source(fvi_exact_motion *o, source_kind which, fvi_error *error)
{
    source *y = o->source + which;
    const size_t most = o->poles.count + 1; /* the poles of Z^-1, and that of the cosine */
    y->pole = calloc(most * (1 + o->d), sizeof *y->pole);
    y->node_value = calloc(FVI_PARABOLA_NODES * o->d, sizeof *y->node_value);
    if (!y->pole || !y->node_value)
        return fvi_no_memory(error, NULL);
    y->residue = y->pole + most;
    y->count = o->poles.count;
    for (size_t k = 0; k < o->poles.count; k++)
        set_pole_and_residue(o, which, k);
    return which == BY_START && o->forcing == FVI_FORCING_COSINE && o->w != 0
               ? add_pole_of_cosine(o, y, error)
               : FVI_SUCCESS;
}

/* ---- times ---- */

/* Return the largest power of 4 that is at most t. One parabola serves all times from there to FVI_PARABOLA_SPAN = 4
 * times that. */
static double begin_of_window(double t)
{
    int exponent;
    frexp(t, &exponent); /* 2^(exponent - 1) <= t < 2^exponent */
    exponent--;
    const int is_odd = exponent & 1;
    return ldexp(1, exponent - is_odd);
}

/* Compute weight times Y at the nodes of the parabola that serves t, to y->node_value. If y->node_value belongs to this
 * parabola already, compute only o->rule, which the other source may have changed. */
static int evaluate_at_nodes(fvi_exact_motion *o, source_kind which, double t, fvi_error *error)
{
    source *y = o->source + which;
    const double window = begin_of_window(t);
    int status = FVI_SUCCESS;
    fvi_parabola_make(window, &o->rule);
    if (window == y->window)
        return status;
    y->window = 0; /* for no parabola, should a solution fail */
    for (size_t j = 0; !status && j < FVI_PARABOLA_NODES; j++) {
        double complex *value = y->node_value + j * o->d;
        evaluate_right_hand_side(o, which, o->rule.s[j], value);
        status = solve_stiffness(o, o->rule.s[j], value, error);
        for (size_t i = 0; i < o->d; i++)
            value[i] *= o->rule.weight[j];
    }
    if (!status)
        y->window = window;
    return status;
}

/* Add the exponential of a node or a pole s with the amplitude a, d numbers: x += Re(factor a), and v += Re(factor s
 * a). factor contains e^{s t}. */
static void add_exponential(const fvi_exact_motion *o, const double complex *a, double complex s,
                            double complex factor, const fvi_exact_sums *sums)
{
    const double complex factor_of_velocity = factor * s;
    for (size_t i = 0; i < o->d; i++) {
        if (sums->x)
            sums->x[i] += creal(factor * a[i]);
        if (sums->v)
            sums->v[i] += creal(factor_of_velocity * a[i]);
    }
    if (sums->force)
        fvi_exact_motion_add_dampers(o, a, s, factor, sums);
}

/* Add sign times the contribution of a source at t: the sum over the nodes of the parabola, and the part of each pole
 * that the nodes leave out. A pole counts twice because of its conjugate. */
static int add_source(fvi_exact_motion *o, source_kind which, double sign, double t,
                      const fvi_exact_sums *sums, fvi_error *error)
{
    const source *y = o->source + which;
    const int status = evaluate_at_nodes(o, which, t, error);
    if (status)
        return status;
    for (size_t j = 0; j < FVI_PARABOLA_NODES; j++)
        add_exponential(o, y->node_value + j * o->d, o->rule.s[j], sign * cexp(o->rule.s[j] * t), sums);
    for (size_t k = 0; k < y->count; k++) {
        const double complex s = y->pole[k],
                             part = fvi_parabola_left_out(&o->rule, s, NULL);
        if (part != 0)
            add_exponential(o, y->residue + k * o->d, s, 2 * sign * part * cexp(s * t), sums);
    }
    return status;
}

int fvi_exact_motion_sum(fvi_exact_motion *o, double t, const fvi_exact_sums *sums,
                         fvi_error *error)
{
    const size_t bytes = o->d * sizeof *sums->x;
    int status = FVI_SUCCESS;
    if (sums->x)
        memcpy(sums->x, o->x0, bytes);
    if (sums->v && t == 0)
        memcpy(sums->v, o->v0, bytes);
    if (t == 0)
        return status;
    if (sums->v)
        memset(sums->v, 0, bytes);
    status = add_source(o, BY_START, 1, t, sums, error);
    if (!status && o->source[BY_STEP].pole)
        status = add_source(o, BY_STEP, 1, t, sums, error);
    if (!status && o->forcing == FVI_FORCING_STEP && t > o->T)
        status = add_source(o, BY_STEP, -1, t - o->T, sums, error);
    return status;
}

int fvi_exact_motion_at(fvi_exact_motion *o, size_t n, const double *t, double *x,
                        double *v, fvi_error *error)
{
    if (!o || !t || (!x && !v))
        return fvi_fail(error, FVI_EFAULT, NULL, NAN, "null pointer");
    for (size_t i = 0; i < n; i++) {
        if (!(isfinite(t[i]) && t[i] >= 0))
            return fvi_fail(error, FVI_EDOM, "t", t[i], "t is %g; it must be finite and not negative", t[i]);
        double *position = x ? x + i * o->d : NULL, *velocity = v ? v + i * o->d : NULL;
        const fvi_exact_sums sums = { .x = position, .v = velocity };
        const int status = fvi_exact_motion_sum(o, t[i], &sums, error);
        if (status)
            return status;
        if ((position && !fvi_all_finite(o->d, position)) || (velocity && !fvi_all_finite(o->d, velocity)))
            return fvi_fail(error, FVI_EOVRFLW, NULL, t[i], "the motion is not finite at t = %g", t[i]);
    }
    return FVI_SUCCESS;
}

/* ---- the start ---- */

/* Copy the problem, and compute K x_0 and M^-1 p_0. */
static int copy_problem(const fvi_exact_problem *p, fvi_exact_motion *o, fvi_error *error)
{
    const fvi_system *system = p->motion.system;
    const size_t d = o->d = system->d;
    o->system = *system;
    o->forcing = p->forcing;
    o->A = p->A;
    o->T = p->T;
    o->w = fabs(p->w);
    o->x0 = FVI_ARRAYS({ &o->x0, d }, { &o->p0, d }, { &o->v0, d }, { &o->spring_force, d });
    o->room = calloc(d, sizeof *o->room);
    if (!o->x0 || !o->room)
        return fvi_no_memory(error, NULL);
    memcpy(o->x0, p->x0, d * sizeof *o->x0);
    memcpy(o->p0, p->p0, d * sizeof *o->p0);
    const int status = fvi_potential_gradient(system, o->x0, o->spring_force);
    return status ? status : fvi_divide_by_mass(system, o->p0, o->v0);
}

/* Find all poles of Z^-1. Without them all there is no exact motion. */
static int find_poles(fvi_exact_motion *o, fvi_error *error)
{
    const int status = fvi_poles_find(o->response, 0, &o->poles, error);
    if (status)
        return status;
    if (o->poles.expected == SIZE_MAX)
        return fvi_fail(error, FVI_EUNSUP, NULL, NAN, "it is not known how many poles this system has");
    if (o->poles.count != o->poles.expected)
        return fvi_fail(error, FVI_EMAXITER, NULL, (double)o->poles.count, "%zu poles were found of %zu",
                        o->poles.count, o->poles.expected);
    return FVI_SUCCESS;
}

int fvi_exact_motion_alloc(const fvi_exact_problem *problem, fvi_exact_motion **motion,
                           fvi_error *error)
{
    if (!problem || !motion || !problem->x0 || !problem->p0)
        return fvi_fail(error, FVI_EFAULT, NULL, NAN, "null pointer");
    fvi_exact_motion *o = calloc(1, sizeof *o);
    if (!o)
        return fvi_no_memory(error, NULL);
    const int has_constant_force =
        problem->forcing == FVI_FORCING_STEP
        || (problem->forcing == FVI_FORCING_COSINE && problem->w == 0);
    int status = fvi_response_alloc(&problem->motion, &o->response, error);
    if (!status)
        status = fvi_exact_motion_check(problem, o->response, error);
    if (!status)
        status = copy_problem(problem, o, error);
    if (!status)
        status = find_poles(o, error);
    if (!status)
        status = prepare_source(o, BY_START, error);
    if (!status && has_constant_force)
        status = prepare_source(o, BY_STEP, error);
    if (status)
        fvi_exact_motion_free(o);
    else
        *motion = o;
    return status;
}

void fvi_exact_motion_free(fvi_exact_motion *o)
{
    if (!o)
        return;
    for (size_t j = 0; j < SOURCES; j++) {
        free(o->source[j].pole);
        free(o->source[j].node_value);
    }
    fvi_exact_motion_free_dampers(o);
    fvi_response_free(o->response);
    fvi_poles_free(&o->poles);
    free(o->x0);
    free(o->room);
    free(o);
}
