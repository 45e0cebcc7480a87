/* src/adjoint_forces/adjoint_forces_numbers.c -- The derivatives of the forces of dampers by the numbers of a law,
 * through the coefficients of the first rows. [H 23] */
#include "adjoint_forces_start.h"

#include <fvi/dampers.h>

#include "kernel/kernel_classes.h"
#include "observer/observer_column.h"
#include "observer/observer_ramp.h"
#include "system/larger.h"
#include "system/one_sided.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* A run in which one number can be changed. */
typedef struct {
    const fvi_method *method;
    const fvi_run *of;
    const double *force;
    const fvi_force_shares *shares;
    double *impulse;  /* the impulses of all rows of the run */
    double *lead;     /* room, one number for each row */
    double *power;    /* the power of t with which each number begins (observer_column.h) */
    fvi_run run;
    fvi_system system;
    fvi_mechanism mechanism;
    fvi_damper *damper;
    fvi_kernel kernel;
    size_t changed;        /* the damper whose law is changed */
    fvi_kernel_term *term; /* the terms of this law */
} changed_run;

/* ---- the function that is differentiated ---- */

/* Add sum_k L_I rate lead_k over the numbers of the damper that is changed. */
static int sum_lead_derivatives(const changed_run *o, const fvi_stepper *s, const fvi_observer *observer, double *sum)
{
    const size_t n = o->shares->n, rows = o->run.steps;
    double *size = malloc(3 * n * sizeof *size);
    int status = size ? FVI_SUCCESS : FVI_ENOMEM;
    if (!status)
        fvi_observer_size(observer, size, size + n, size + 2 * n);
    for (size_t i = 0, of = SIZE_MAX; i < n && !status; i++) {
        size_t coordinate;
        const size_t j = fvi_observer_damper_of(observer, i, &coordinate);
        if (j != o->changed)
            continue;
        if (j != of)
            status = fvi_ramp_leads(s, j, rows, 1, o->lead);
        of = j;
        for (size_t k = 1; k <= rows && !status; k++)
            *sum += o->shares->impulse[k * n + i] * size[2 * n + i] * o->lead[k - 1];
    }
    free(size);
    return status;
}

/* The part of L that depends on the law while all impulses but those of the leads are fixed. */
static int evaluate(const changed_run *o, int has_start, double *L)
{
    fvi_stepper *s = NULL;
    fvi_observer *observer = NULL;
    *L = 0;
    int status = fvi_stepper_start(o->method, &o->run, &s, NULL);
    if (!status)
        status = fvi_observer_start(s, FVI_OBSERVE_FORCE | FVI_OBSERVE_OWN_STEPS, &observer, NULL);
    if (!status && o->force)
        status = fvi_observer_first_forces(observer, &o->run, o->power, has_start, o->force, o->impulse, L);
    if (!status)
        status = sum_lead_derivatives(o, s, observer, L);
    fvi_observer_free(observer);
    fvi_stepper_free(s);
    return status;
}

/* ---- difference quotients ---- */

/* The weights of a difference of order 6 for points on both sides of the number: central[i] for the number + i step,
 * and -central[i] for the number - i step. Points on one side have fvi_one_sided_weights. */
static const double central[] = { 0, 3. / 4, -3. / 20, 1. / 60 };

/* On which side of the number the seven points must lie so that no border lies between them: +1, -1, or 0 for both
 * sides. */
static int choose_side(double at, double step, const double *borders, size_t count)
{
    int side = 0;
    for (size_t i = 0; i < count; i++) {
        if (at == borders[i]) /* the derivative of the run is from below, too, except at the least order */
            side = i == 0 ? 1 : -1;
        else if (fabs(at - borders[i]) < 3.5 * step)
            side = at > borders[i] ? 1 : -1;
    }
    return side;
}

static int differentiate(const changed_run *o, double *number, double step, int side, int has_start, double *to)
{
    const double at = *number;
    double sum = 0;
    int status = FVI_SUCCESS;
    for (int i = side ? 0 : -3; i <= (side ? 6 : 3) && !status; i++) {
        const double weight = side ? side * fvi_one_sided_weights[i] : i < 0 ? -central[-i] : central[i];
        double L = 0;
        *number = at + (side ? side : 1) * i * step;
        if (weight != 0)
            status = evaluate(o, has_start, &L);
        sum += weight * L / step;
    }
    *number = at;
    *to += sum;
    return status;
}

/* Differentiate by alpha or end, which are half of an order of s, or an exponent. At whole orders the first rows change
 * their form. If the kernel is a fraction of powers or a range of orders, the force at t = 0 does not depend on the
 * order, or it jumps there. For other kernels has_start is nonzero, and this force is differentiated, too. Each
 * derivative of h^(2 alpha) multiplies it by 2 log h, so a short h needs a short step in alpha. No point is as far away
 * as the other order of the term, whose distance is the gap. */
static int differentiate_by_order(const changed_run *o, double *number, double gap, int has_start, double *to)
{
    static const double borders[] = { 0, 0.5, 1 };
    enum { COUNT = sizeof borders / sizeof *borders };
    const double step = smaller(gap / 7, 1. / 256 / larger(1, fabs(log(o->run.h)) / log(16)));
    return differentiate(o, number, step, choose_side(*number, step, borders, COUNT), has_start, to);
}

/* Differentiate by a time, which is not negative. */
static int differentiate_by_time(const changed_run *o, double *number, double *to)
{
    const double step = *number > 0 ? *number / 64 : 1. / 256;
    return differentiate(o, number, step, *number == 0, 1, to);
}

/* Differentiate by the factor of a term, which is not negative. The first rows see the law at s = 1/h. Let `whole` be
 * the factor with which the term alone would be as large there as the whole law. For a term that is a small part of the
 * law the step is a part of `whole`, because a step of its own size would be lost in the rounding errors of L. If the
 * term is the whole law, and is not two springpots in series, L is affine in the factor. Then every step is right. */
static int differentiate_by_factor(const changed_run *o, fvi_kernel_term *term, double *to)
{
    fvi_kernel_term unit = *term;
    const fvi_kernel alone = { 1, &unit };
    unit.rho = 1;
    const double whole = fvi_kernel_symbol(&o->kernel, 1 / o->run.h) / fvi_kernel_symbol(&alone, 1 / o->run.h);
    const int is_affine = o->kernel.count == 1 && term->kind != FVI_KERNEL_MAXWELL2,
              is_lost = whole == 0 || (is_affine && term->rho < 1e-9);
    const double step = is_lost ? 1. / 256 : larger(term->rho / 64, whole / 256);
    return differentiate(o, &term->rho, step, term->rho < 3.5 * step, 1, to);
}

static int differentiate_by_term(const changed_run *o, size_t l, size_t to, const fvi_sensitivities *want)
{
    fvi_kernel_term *term = o->term + l;
    double *const fields[] = { &term->rho, &term->alpha, &term->time, &term->end },
           *const wanted[] = { want->terms, want->orders, want->times, want->ends };
    const fvi_kernel_number *end = fvi_kernel_number_of(term, 3);
    const double gap = end && end->range == FVI_RANGE_ORDER ? fabs(term->end - term->alpha) : INFINITY;
    int status = want->terms ? differentiate_by_factor(o, term, want->terms + to) : FVI_SUCCESS;
    for (size_t field = 1; field < FVI_KERNEL_FIELDS && !status; field++) {
        const fvi_kernel_number *number = fvi_kernel_number_of(term, field);
        if (!number || !wanted[field])
            continue;
        status = number->range == FVI_RANGE_SIZE
                     ? differentiate_by_time(o, fields[field], wanted[field] + to)
                     : differentiate_by_order(o, fields[field], gap, fvi_kernel_is_general(term), wanted[field] + to);
    }
    return status;
}

/* ---- the law that is changed ---- */

/* Differentiate by the terms of a law; a changed copy takes the place of the law. A SYMBOL has no numbers to change. */
static int differentiate_by_law(changed_run *o, const fvi_kernel *law, const fvi_kernel **place, size_t first,
                                const fvi_sensitivities *want)
{
    if (law->term->kind == FVI_KERNEL_SYMBOL)
        return FVI_SUCCESS;
    o->term = malloc(law->count * sizeof *o->term);
    if (!o->term)
        return FVI_ENOMEM;
    memcpy(o->term, law->term, law->count * sizeof *o->term);
    o->kernel = (fvi_kernel){ law->count, o->term };
    *place = &o->kernel;
    int status = FVI_SUCCESS;
    for (size_t l = 0; l < law->count && !status; l++)
        status = differentiate_by_term(o, l, first + l, want);
    free(o->term);
    *place = law;
    return status;
}

static int differentiate_by_laws(changed_run *o, const fvi_sensitivities *want)
{
    const fvi_mechanism *m = o->of->system->mechanism;
    int status = FVI_SUCCESS;
    if (!m)
        return differentiate_by_law(o, o->of->law, &o->run.law, 0, want);
    o->damper = malloc((m->damper_count + 1) * sizeof *o->damper);
    if (!o->damper)
        return FVI_ENOMEM;
    memcpy(o->damper, m->damper, m->damper_count * sizeof *o->damper);
    o->mechanism = *m;
    o->mechanism.damper = o->damper;
    o->system = *o->of->system;
    o->system.mechanism = &o->mechanism;
    o->run.system = &o->system;
    for (size_t j = 0, first = 0; j < m->damper_count && !status; first += m->damper[j++].kernel->count) {
        o->changed = j;
        status = differentiate_by_law(o, m->damper[j].kernel, &o->damper[j].kernel, first, want);
    }
    free(o->damper);
    return status;
}

/* ---- the run without a change ---- */

/* Write the impulses of all rows, and the powers with which they begin. */
static int impulses_of_run(changed_run *o, fvi_stepper *s)
{
    const size_t n = o->shares->n;
    fvi_observer *sums = NULL;
    fvi_observation now;
    int status = fvi_observer_start(s, FVI_OBSERVE_IMPULSE | FVI_OBSERVE_FORCE | FVI_OBSERVE_OWN_STEPS, &sums, NULL);
    if (!status)
        fvi_observer_powers(sums, o->power);
    for (size_t k = 1; k <= o->of->steps && !status; k++) {
        status = fvi_observer_step(sums, s);
        if (!status)
            status = fvi_observer_read(sums, s, s->t, &now);
        if (!status)
            memcpy(o->impulse + k * n, now.impulse, n * sizeof *o->impulse);
    }
    fvi_observer_free(sums);
    return status;
}

static int begin(changed_run *o)
{
    const size_t rows = (o->of->steps + 1) * o->shares->n;
    fvi_stepper *s = NULL;
    o->impulse = calloc(rows + o->shares->n + o->of->steps + 1, sizeof *o->impulse);
    if (!o->impulse)
        return FVI_ENOMEM;
    o->power = o->impulse + rows;
    o->lead = o->power + o->shares->n;
    int status = o->force ? fvi_stepper_start(o->method, o->of, &s, NULL) : FVI_SUCCESS;
    if (!status && o->force)
        status = impulses_of_run(o, s);
    fvi_stepper_free(s);
    return status;
}

int fvi_force_numbers(const fvi_method *method, const fvi_run *run, const double *force, const fvi_force_shares *shares,
                      const fvi_sensitivities *want)
{
    if (!want->alpha && !want->terms && !want->orders && !want->times && !want->ends)
        return FVI_SUCCESS;
    changed_run o = { .method = method, .of = run, .force = force, .shares = shares, .run = *run };
    int status = begin(&o);
    if (!status && want->alpha)
        status = differentiate_by_order(&o, &o.run.alpha, INFINITY, 0, want->alpha);
    else if (!status)
        status = differentiate_by_laws(&o, want);
    free(o.impulse);
    return status;
}
