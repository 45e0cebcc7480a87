/* src/sensitivity/adjoint_lobatto_terms.c -- The terms of a law, through stages. [H 23]
 *
 * The derivative by the factor of a term is that by rho with the weights of this term
 * alone: each has a memory of what goes backwards. With W = (Delta/h)^-1 C(Delta/h) of it
 * and u = W nu, those by time and order are -W (Delta/h) u and 2 L (u - time W (Delta/h) u),
 * L = ln(Delta/h): (23.21), memories one behind another. */
#include "adjoint_lobatto.h"

#include "methods/lobatto_stages.h"
#include "system/fail.h"

#include <math.h>
#include <stdlib.h>

/* One memory, and what it has given; s d numbers. */
typedef struct {
    fvi_lobatto_history *memory; /* NULL: not asked for */
    double *past;
} convolution;

/* Where the comment says "each", s d numbers. */
struct fvi_adjoint_lobatto_term {
    fvi_kernel_function unit; /* its term has rho = 1 */
    double rho;        /* of the law */
    convolution self, again, slopes[FVI_ADJOINT_SLOPES];
    fvi_adjoint_slope slope[FVI_ADJOINT_SLOPES];
    convolution log; /* Delta^beta at beta = 0; past: that of its rate */
    double *u, *rate, *left; /* each: W nu, (Delta/h) u, u - time W rate */
    double *before;           /* d numbers: the last of u of step k + 1 */
    double *room, *block;     /* each; all these and past; owned */
};

/* ---- the start ---- */

static int convolve(const fvi_adjoint_lobatto *m, const fvi_kernel *alone, convolution *c)
{
    const fvi_run *run = m->run;
    return fvi_lobatto_history_of_kernel(m->s, alone, run->h, m->d, run->steps,
                                     run->memory, fvi_lobatto_history_tolerance(run),
                                     &c->memory);
}

static int start_slopes(const fvi_adjoint_lobatto *m, fvi_adjoint_lobatto_term *t)
{
    const double *const wanted[] = { m->want->orders, m->want->times, m->want->ends };
    int status = FVI_SUCCESS;
    for (int by = 0; !status && by < FVI_ADJOINT_SLOPES; by++)
        if (wanted[by] && fvi_adjoint_slope_of(&t->unit.term, (fvi_slope_by)by, &t->slope[by]))
            status = convolve(m, &t->slope[by].kernel, &t->slopes[by]);
    return status;
}

/* Room for all that a term may need. */
static int make_room(const fvi_adjoint_lobatto *m, fvi_adjoint_lobatto_term *t)
{
    double **each[] = { &t->self.past,      &t->again.past,     &t->slopes[0].past,
                        &t->slopes[1].past, &t->slopes[2].past, &t->log.past,
                        &t->u,              &t->rate,           &t->left,
                        &t->room };
    const size_t rows = sizeof each / sizeof *each, n = m->s * m->d;
    t->block = calloc(rows * n + m->d, sizeof *t->block);
    if (!t->block)
        FVI_FAIL("no memory for the mirrored run", FVI_ENOMEM);
    for (size_t i = 0; i < rows; i++)
        *each[i] = t->block + i * n;
    t->before = t->block + rows * n;
    return FVI_SUCCESS;
}

static int start_one(const fvi_adjoint_lobatto *m, fvi_adjoint_lobatto_term *t)
{
    const fvi_run *run = m->run;
    const fvi_sensitivities *want = m->want;
    const fvi_kernel_term *term = &t->unit.term;
    const fvi_kernel alone = { 1, term };
    const int by_order = want->orders && fvi_adjoint_has_order(term);
    int status = make_room(m, t);
    if (!status)
        status = convolve(m, &alone, &t->self);
    if (!status && fvi_adjoint_is_fraction(term)
        && (want->times || (by_order && term->time > 0)))
        status = convolve(m, &alone, &t->again);
    if (!status && by_order)
        status = fvi_lobatto_history_alloc_by_order(
            m->s, 0, m->d, run->steps, run->memory, fvi_lobatto_history_tolerance(run),
            &t->log.memory);
    return status ? status : start_slopes(m, t);
}

int fvi_adjoint_terms_start(fvi_adjoint_lobatto *m)
{
    const fvi_kernel *law = m->run->law;
    int status = FVI_SUCCESS;
    if (!fvi_adjoint_kernel_is_wanted(m->want))
        return status;
    const size_t count = law->count;
    m->each = calloc(count, sizeof *m->each);
    if (!m->each)
        FVI_FAIL("no memory for the mirrored run", FVI_ENOMEM);
    for (; !status && m->terms < count; m->terms++) {
        fvi_adjoint_lobatto_term *t = &m->each[m->terms];
        fvi_adjoint_unit_term(&law->term[m->terms], &t->unit, &t->rho);
        status = start_one(m, t);
    }
    return status;
}

void fvi_adjoint_terms_stop(fvi_adjoint_lobatto *m)
{
    for (size_t l = 0; l < m->terms; l++) {
        fvi_adjoint_lobatto_term *t = &m->each[l];
        fvi_lobatto_history_free(t->self.memory);
        fvi_lobatto_history_free(t->again.memory);
        for (int by = 0; by < FVI_ADJOINT_SLOPES; by++)
            fvi_lobatto_history_free(t->slopes[by].memory);
        fvi_lobatto_history_free(t->log.memory);
        free(t->block);
    }
    free(m->each);
}

/* ---- a step ---- */

/* out = past + now in, of coordinate j. */
static void through(const fvi_adjoint_lobatto *m, size_t j, const double *now,
                    const double *past, const double *in, double *out)
{
    const size_t s = m->s;
    for (size_t i = 0; i < s; i++) {
        double sum = past[j * s + i];
        for (size_t c = 0; c < s; c++)
            sum += now[i * s + c] * in[c];
        out[i] = sum;
    }
}

/* (Delta/h) u, by the two coefficients of (17.5). */
static void differentiate(const fvi_adjoint_lobatto *m, const double *u,
                          double before, double *out)
{
    const fvi_lobatto_rule *rule = m->rule;
    for (size_t i = 0; i < m->s; i++) {
        double sum = i == 0 ? (u[0] - before) / rule->b[0] : 0;
        for (size_t c = 0; c < m->s; c++)
            sum += rule->D[i][c] * u[c];
        out[i] = sum / m->run->h;
    }
}

/* What the velocities meet in T, times b. */
static double dot(const fvi_adjoint_lobatto *m, const double *v, const double *T)
{
    double sum = 0;
    for (size_t i = 0; i < m->s; i++)
        sum += m->rule->b[i] * v[m->s - 1 - i] * T[i];
    return sum;
}

//> stage-term
/* Coordinate j of one term, which is number l; nu = P Lambda. (23.21) */
static void accumulate_term(fvi_adjoint_lobatto *m, size_t l, size_t j, const double *nu,
                 const double *v)
{
    fvi_adjoint_lobatto_term *t = &m->each[l];
    const fvi_sensitivities *want = m->want;
    const size_t s = m->s;
    const double weight = m->run->h * m->run->system->damping[j],
                 scaled = weight * t->rho;
    double *u = t->u + j * s, *rate = t->rate + j * s,
           *left = t->left + j * s, T[FVI_STAGES] = { 0 };
    const double *W = fvi_lobatto_history_now(t->self.memory);
    through(m, j, W, t->self.past, nu, u);
    if (want->terms)
        want->terms[l] -= weight * dot(m, v, u);
    if (t->again.memory) {
        differentiate(m, u, t->before[j], rate);
        through(m, j, W, t->again.past, rate, T);
    }
    if (t->again.memory && want->times)
        want->times[l] += scaled * dot(m, v, T);
    for (size_t i = 0; i < s; i++)
        left[i] = u[i] - t->unit.term.time * T[i];
    if (!t->log.memory)
        return;
    through(m, j, fvi_lobatto_history_now_by_order(t->log.memory), t->log.past, left,
            T);
    want->orders[l] -=
        2 * scaled * (dot(m, v, T) - log(m->run->h) * dot(m, v, left));
}
//< stage-term

static void accumulate_slopes(fvi_adjoint_lobatto *m, size_t l, size_t j,
                              const double *nu, const double *v)
{
    const fvi_adjoint_lobatto_term *t = &m->each[l];
    double *const to[] = { m->want->orders, m->want->times, m->want->ends };
    const double weight = m->run->h * m->run->system->damping[j] * t->rho;
    for (int by = 0; by < FVI_ADJOINT_SLOPES; by++) {
        const convolution *c = t->slopes + by;
        double T[FVI_STAGES];
        if (!c->memory)
            continue;
        through(m, j, fvi_lobatto_history_now(c->memory), c->past, nu, T);
        to[by][l] -= t->slope[by].sign * weight * dot(m, v, T);
    }
}

void fvi_adjoint_terms_accumulate(fvi_adjoint_lobatto *m, size_t j, const double *v)
{
    double nu[FVI_STAGES];
    for (size_t i = 0; i < m->s; i++)
        nu[i] = m->Lambda[j * m->s + m->s - 1 - i];
    for (size_t l = 0; l < m->terms; l++) {
        accumulate_term(m, l, j, nu, v);
        accumulate_slopes(m, l, j, nu, v);
    }
}

static int push(convolution *c, const double *in)
{
    return c->memory ? fvi_lobatto_history_push(c->memory, in, c->past)
                     : FVI_SUCCESS;
}

int fvi_adjoint_terms_update_history(fvi_adjoint_lobatto *m)
{
    int status = FVI_SUCCESS;
    for (size_t l = 0; !status && l < m->terms; l++) {
        fvi_adjoint_lobatto_term *t = &m->each[l];
        status = push(&t->self, m->reversed);
        for (int by = 0; !status && by < FVI_ADJOINT_SLOPES; by++)
            status = push(&t->slopes[by], m->reversed);
        if (!status)
            status = push(&t->again, t->rate);
        if (!status && t->log.memory)
            status = fvi_lobatto_history_push_by_order(t->log.memory, t->left,
                                                  t->room, t->log.past);
        for (size_t j = 0; j < m->d; j++)
            t->before[j] = t->u[j * m->s + m->s - 1];
    }
    return status;
}
