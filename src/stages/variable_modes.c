/* src/stages/variable_modes.c -- The history of variable steps as a sum of modes. [H 22] */
#include "variable_modes.h"

#include "system/archive_pieces.h"
#include "system/fail.h"
#include "variable_loops.h"
#include "variable_table.h"
#include "variable_weights.h"

#include <gsl/gsl_math.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The range of the modes: every `every`-th point of the lattice, from sigma T = exp(-lowest) to mu = h
 * sigma >= highest. Beyond this range the six corrections of either end leave an error of 1e-14, or an error below that
 * of the spacing. (22.12) */
typedef struct {
    size_t every;
    double lowest, highest;
} range;
static const range ranges[] = { [FVI_MODES_FINE] = { 1, 6.5, 2e4 },
                                [FVI_MODES_MEDIUM] = { 1, 4.5, 1e4 },
                                [FVI_MODES_COARSE] = { 2, 4.5, 2e3 } };

/* The weights of the modes, or their derivatives by beta. weight = NULL: not allocated. */
typedef struct {
    double *weight,
        *closed;          /* Q numbers each; closed: the weights of this step, with the corrections of its upper end */
    double top[FVI_ENDS]; /* the corrections of the upper end: see fvi_mode_weights */
} reading;

struct fvi_modes {
    const fvi_variable_rule *rule;
    const fvi_mode_row *table;
    range range;
    size_t apart;           /* distance between the nodes of an end correction */
    double beta, longest;   /* longest: no step is longer */
    size_t d, Q;            /* number of coordinates; modes of each coordinate, a multiple of FVI_LANES */
    int first;              /* sigma_q = exp(L (first + every q)) */
    double highest_exponent; /* the last mode of a step h = exp(L k) is (highest_exponent - k) / every */
    size_t count, active;   /* number of modes that this step reads; number of modes that are up to date */
    fvi_length now, before; /* this step, and the last step that was taken */
    fvi_mode_row row;       /* the row of coefficients of this step */
    double *sigma;          /* Q decay rates */
    reading value, rate;    /* the derivatives own their numbers */
    double *y;              /* Q modes for each coordinate */
    fvi_last_step *last;    /* one for each coordinate */
    double *workspace;      /* workspace for rows off the lattice */
    int is_free;            /* nonzero if the decay rates are arbitrary; then all modes are active */
};

/* ---- step lengths, rows, inactive modes ---- */

int fvi_length_is_possible(fvi_length length, double longest)
{
    const double k = log(length.h) / fvi_variable_spacing();
    return length.h > 0 && length.h <= longest
           && (length.k == FVI_OFF_LATTICE || fabs(k - length.k) < 1e-6);
}

/* For a larger mu the powers of mu would overflow. There a falls like 1/mu. */
static const double MOST_MU = 1e30;

/* Correct a row that was computed with mu <= MOST_MU, so that mu = h sigma and a falls like 1/mu. Without this
 * correction the rounding errors of y, times a weight that may grow like sigma, would exceed the whole history. */
static void continue_row(const fvi_modes *m, double h, size_t from, size_t n, double *mu, double *a)
{
    for (size_t q = 0; q < n; q++) {
        const double more = h * m->sigma[from + q] / MOST_MU;
        for (size_t i = 0; more > 1 && i < m->rule->s; i++)
            a[i * n + q] /= more;
        mu[q] = more > 1 ? more * MOST_MU : mu[q];
    }
}

/* Return the row of the modes from, ..., to - 1 for a step of this length. It is a piece of the table, or it is
 * computed in m->workspace. */
static fvi_mode_row row_of(fvi_modes *m, fvi_length length, size_t from,
                           size_t to)
{
    const long every = m->is_free ? 1 : (long)m->range.every, part = FVI_POINTS / every,
               j = (long)m->first + length.k - FVI_FIRST + every * (long)from;
    const size_t n = to - from;
    if (!m->is_free && length.k != FVI_OFF_LATTICE && j >= 0 && j / every + (long)n <= part) {
        const fvi_mode_row *t = m->table;
        const long place = j % every * part + j / every;
        return (fvi_mode_row){ t->mu + place, t->p + place, t->a + place,
                               t->stride };
    }
    double *mu = m->workspace, *p = mu + m->Q, *a = p + m->Q;
    for (size_t q = 0; q < n; q++)
        mu[q] = fmin(length.h * m->sigma[from + q], MOST_MU);
    fvi_mode_row_make(m->rule, n, mu, p, a);
    continue_row(m, length.h, from, n, mu, a);
    return (fvi_mode_row){ mu, p, a, n };
}

/* Activate the modes below mode `to`. An inactive mode depends on the last step only. Before that step y was at rest at
 * v_e, and z was 0; the error is 3e-6 of what these modes add to H. (22.13) */
static void activate_modes(fvi_modes *m, size_t to)
{
    if (m->active >= to)
        return;
    const fvi_mode_row row = row_of(m, m->before, m->active, to);
    for (size_t j = 0; j < m->d; j++) {
        double *y = m->y + j * m->Q;
        for (size_t q = m->active; q < to; q++)
            y[q] = m->last[j].before;
        fvi_loop_advance(m->rule->s, to - m->active, &row, &m->last[j],
                         y + m->active);
    }
    m->active = to;
}

void fvi_modes_activate_all(fvi_modes *m)
{
    activate_modes(m, m->Q);
    m->now = (fvi_length){ 0 }; /* its row may have been overwritten */
}

/* Add the corrections of the upper end (22.12) to the weights. They replace the modes above the last one that is
 * read. */
static void add_top_corrections(fvi_modes *m, const reading *r)
{
    memcpy(r->closed, r->weight, m->count * sizeof *r->closed);
    for (size_t l = 0; l < FVI_ENDS; l++)
        r->closed[m->count - 1 - m->apart * l] +=
            r->weight[m->count - 1] * m->value.top[l];
}

/* Add the derivatives of the corrections by beta. */
static void add_top_correction_rates(fvi_modes *m)
{
    add_top_corrections(m, &m->rate);
    for (size_t l = 0; l < FVI_ENDS; l++)
        m->rate.closed[m->count - 1 - m->apart * l] +=
            m->value.weight[m->count - 1] * m->rate.top[l];
}

void fvi_modes_begin(fvi_modes *m, fvi_length length)
{
    size_t q = m->apart * FVI_ENDS;
    if (length.h == m->now.h && m->now.k == length.k && m->count <= m->active)
        return;
    if (m->is_free) {
        m->now = length;
        m->row = row_of(m, length, 0, m->Q);
        return;
    }
    const double L = fvi_variable_spacing(),
                 h = length.k == FVI_OFF_LATTICE ? log(length.h) / L
                                                 : (double)length.k,
                 top = ceil((m->highest_exponent - h) / (double)m->range.every);
    if (top > (double)q)
        q = (size_t)top;
    q = q + 1 < m->Q ? q + 1 : m->Q;
    m->count = (q + FVI_LANES - 1) / FVI_LANES * FVI_LANES;
    m->now = length;
    activate_modes(m, m->count);
    m->row = row_of(m, length, 0, m->count);
    add_top_corrections(m, &m->value);
    if (m->rate.weight)
        add_top_correction_rates(m);
}

static void read_modes(const fvi_modes *m, const double *closed, size_t j,
                       double *H)
{
    fvi_loop_gather(m->rule->s, m->count, closed, m->y + j * m->Q, &m->row, H);
}

void fvi_modes_history(const fvi_modes *m, size_t j, double *H)
{
    read_modes(m, m->is_free ? m->value.weight : m->value.closed, j, H);
}

void fvi_modes_history_by_order(const fvi_modes *m, size_t j, double *H)
{
    read_modes(m, m->rate.closed, j, H);
}

void fvi_modes_advance(fvi_modes *m, size_t j, const double *v, double ve)
{
    const size_t s = m->rule->s;
    fvi_last_step *last = &m->last[j];
    for (size_t i = 0; i < s; i++) {
        const double u = m->rule->b[s - 1 - i] * v[s - 1 - i];
        last->u[i] = m->beta <= 0 ? u : -u;
    }
    last->ds = m->beta <= 0 ? 0 : v[s - 1];
    last->before = m->beta <= 0 ? ve : 0;
    fvi_loop_advance(s, m->count, &m->row, last, m->y + j * m->Q);
    m->before = m->now;
    m->active = m->count;
}

/* ---- allocation ---- */

/* Return the number of doubles in the part of the block that a copy of the modes needs: sigma, weight, y and last. */
static size_t count_numbers(const fvi_modes *m)
{
    return (2 + m->d) * m->Q + m->d * sizeof *m->last / sizeof *m->y;
}

/* Allocate modes of these sizes at rest. Return NULL if memory is short. */
static fvi_modes *make_modes(fvi_modes sizes)
{
    fvi_modes *m = malloc(sizeof *m);
    const size_t count = count_numbers(&sizes) + (1 + 2 + sizes.rule->s) * sizes.Q;
    double *block = malloc(count * sizeof *block);
    if (!m || !block) {
        free(m);
        free(block);
        return NULL;
    }
    *m = sizes;
    m->sigma = block;
    m->value.weight = m->sigma + m->Q;
    m->rate.weight = NULL;
    m->y = m->value.weight + m->Q;
    m->last = (fvi_last_step *)(m->y + m->d * m->Q);
    m->value.closed = block + count_numbers(m);
    m->workspace = m->value.closed + m->Q;
    memset(m->y, 0, (count_numbers(m) - 2 * m->Q) * sizeof *m->y);
    return m;
}

static fvi_mode_ladder ladder_of(const fvi_modes *m)
{
    const size_t every = m->range.every, part = FVI_POINTS / every;
    const double *up = m->table->mu + -FVI_FIRST % every * part
                       + -FVI_FIRST / every; /* from exp(0) on */
    return (fvi_mode_ladder){ every, m->Q, m->first, m->beta, up };
}

int fvi_modes_alloc(const fvi_variable_rule *rule, fvi_modes_kind kind,
                    double beta, size_t d, double T, double least,
                    fvi_modes **modes)
{
    const range of = ranges[kind];
    const double L = fvi_variable_spacing(), fastest = of.highest / least;
    if (!isfinite(fastest))
        FVI_FAIL("the run is too short: the fastest decay rate of its memory would be above 1.8e308", FVI_EDOM);
    const int first = (int)floor((-of.lowest - log(T)) / L),
              last = (int)ceil(log(fastest) / L);
    const size_t most = (size_t)(last - first) / of.every + 1,
                 Q = most / FVI_LANES * FVI_LANES + FVI_LANES;
    fvi_modes *m = make_modes((fvi_modes){ .rule = rule,
                                           .table = fvi_mode_table(rule, of.every),
                                           .range = of,
                                           .apart = fvi_variable_apart(of.every),
                                           .beta = beta,
                                           .longest = T,
                                           .d = d,
                                           .Q = Q,
                                           .first = first,
                                           .highest_exponent = log(of.highest) / L - first,
                                           .active = Q });
    if (!m || !m->table) {
        fvi_modes_free(m);
        FVI_FAIL("no memory for the modes", FVI_ENOMEM);
    }
    const fvi_mode_ladder ladder = ladder_of(m);
    fvi_mode_weights(&ladder, m->sigma, m->value.weight, m->value.top);
    *modes = m;
    return FVI_SUCCESS;
}

int fvi_modes_of_rates(const fvi_variable_rule *rule, int rises, size_t d,
                       double T, size_t count, const double *rate,
                       const double *weight, fvi_modes **modes)
{
    const size_t Q = (count + FVI_LANES - 1) / FVI_LANES * FVI_LANES;
    fvi_modes *m = make_modes((fvi_modes){ .rule = rule,
                                           .beta = rises ? 0.5 : -0.5,
                                           .longest = T,
                                           .d = d,
                                           .Q = Q,
                                           .count = Q,
                                           .active = Q,
                                           .is_free = 1 });
    if (!m)
        FVI_FAIL("no memory for the modes", FVI_ENOMEM);
    for (size_t q = 0; q < Q; q++) {
        m->sigma[q] = q < count ? rate[q] : 1 / T;
        m->value.weight[q] = q < count ? weight[q] : 0;
    }
    *modes = m;
    return FVI_SUCCESS;
}

int fvi_modes_add_order(fvi_modes *m)
{
    const fvi_mode_ladder ladder = ladder_of(m);
    reading *rate = &m->rate;
    rate->weight = malloc(2 * m->Q * sizeof *rate->weight);
    if (!rate->weight)
        FVI_FAIL("no memory for the rates", FVI_ENOMEM);
    rate->closed = rate->weight + m->Q;
    fvi_mode_weights_by_order(&ladder, rate->weight, rate->top);
    return FVI_SUCCESS;
}

int fvi_modes_copy(const fvi_modes *from, fvi_modes **to)
{
    fvi_modes *m = make_modes(*from);
    if (!m)
        FVI_FAIL("no memory for the modes", FVI_ENOMEM);
    memcpy(m->sigma, from->sigma, count_numbers(m) * sizeof *m->sigma);
    m->now = (fvi_length){ 0 }; /* its row may point into the workspace of the other modes */
    *to = m;
    return FVI_SUCCESS;
}

int fvi_modes_archive(fvi_modes *m, fvi_archive *v)
{
    const int status = FVI_SERIALIZE(v, FVI_CONSTANT(m->Q), FVI_CONSTANTS(m->sigma, 2 * m->Q),
                                     FVI_STATES(m->y, m->d * m->Q), FVI_STATES(m->last, m->d), FVI_STATE(m->active),
                                     FVI_STATE(m->before.h), FVI_STATE(m->before.k));
    m->now = (fvi_length){ 0 };
    if (status)
        return status;
    if (m->active > m->Q || m->active % FVI_LANES != 0
        || !(m->active == m->Q || fvi_length_is_possible(m->before, m->longest)))
        FVI_FAIL("not a state of these modes", FVI_EINVAL);
    return FVI_SUCCESS;
}

void fvi_modes_free(fvi_modes *m)
{
    if (!m)
        return;
    free(m->rate.weight);
    free(m->sigma);
    free(m);
}

size_t fvi_modes_count(const fvi_modes *m)
{
    return m->Q;
}

double fvi_modes_decay(const fvi_modes *m, size_t q)
{
    return m->sigma[q];
}

void fvi_modes_add(fvi_modes *m, size_t j, size_t q, double more)
{
    m->y[j * m->Q + q] += more;
}

/* Return more w with w = y / sigma or w = (v_e - z) / sigma. In the first case `more` is already divided by sigma. */
static double accumulated_term(const fvi_modes *m, size_t j, const double *more, double ve,
                               size_t q)
{
    const double y = m->y[j * m->Q + q];
    return more[q] * (m->beta <= 0 ? y : (ve - y) / m->sigma[q]);
}

double fvi_modes_accumulate(const fvi_modes *m, size_t j, const double *more,
                      double ve, double *rate)
{
    double sum = 0, slope = 0;
    for (size_t q = 0; q < m->Q; q++) {
        const double w = accumulated_term(m, j, more, ve, q);
        sum += m->value.weight[q] * w;
        slope += rate ? m->rate.weight[q] * w : 0;
    }
    for (size_t l = 0; l < FVI_ENDS; l++) { /* (22.12) */
        const double w = accumulated_term(m, j, more, ve, m->Q - 1 - m->apart * l);
        sum += m->value.weight[m->Q - 1] * m->value.top[l] * w;
        slope += rate ? (m->rate.weight[m->Q - 1] * m->value.top[l]
                         + m->value.weight[m->Q - 1] * m->rate.top[l])
                            * w
                      : 0;
    }
    if (rate)
        *rate = slope;
    return sum;
}
