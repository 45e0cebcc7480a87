/* src/observer/observer_column.c -- The forces of an observer as linear functions of impulses and of the start.
 * [H 23] */
#include "observer_column.h"

#include "observer_state.h"

#include <math.h>

size_t fvi_observer_numbers(const fvi_observer *o)
{
    size_t sum = 0;
    for (size_t j = 0; j < o->dampers; j++)
        sum += fvi_observer_width(o, j);
    return sum;
}

static size_t largest_entry(const double *row, size_t d)
{
    size_t at = 0;
    for (size_t i = 1; i < d; i++)
        at = fabs(row[i]) > fabs(row[at]) ? i : at;
    return at;
}

size_t fvi_observer_damper_of(const fvi_observer *o, size_t i, size_t *coordinate)
{
    size_t j = 0;
    while (i >= fvi_observer_width(o, j))
        i -= fvi_observer_width(o, j++);
    const double *row = fvi_observer_row(o, j);
    *coordinate = o->has_mechanism ? 0 : row ? largest_entry(row, o->d) : i;
    return j;
}

/* The index of number i among the tracked forces. *unit: the force there if the number is 1. */
static size_t place_among_tracked(const fvi_observer *o, size_t i, double *unit)
{
    size_t at;
    const size_t j = fvi_observer_damper_of(o, i, &at);
    const double *row = fvi_observer_row(o, j);
    *unit = row ? row[at] : 1;
    return o->has_mechanism ? j : j * o->d + at;
}

void fvi_observer_size(const fvi_observer *o, double *jump, double *line, double *rate)
{
    for (size_t i = 0; i < fvi_observer_numbers(o); i++) {
        double unit;
        const size_t at = place_among_tracked(o, i, &unit);
        jump[i] = unit == 0 ? 0 : o->jump[at] / unit;
        line[i] = unit == 0 ? 0 : o->line[at] / unit;
        rate[i] = unit == 0 ? 0 : o->rate[at] / unit;
    }
}

/* Set all impulses of force j to 0. */
static void clear_impulses(fvi_observer *o, size_t j)
{
    for (size_t i = 0; i < o->degree; i++)
        o->latest[i * o->tracked + j] = 0;
    o->impulse[j] = 0;
}

/* Set the impulse of force j `back` rows ago to 1, and its other impulses to 0. */
static void set_unit_impulse(fvi_observer *o, size_t j, size_t back)
{
    clear_impulses(o, j);
    o->impulse[j] = back == 0;
    if (back < o->degree)
        o->latest[back * o->tracked + j] = 1;
    if (back > 0)
        o->latest[(back - 1) * o->tracked + j] = -1;
}

/* Set the impulses of force j up to row k to those of one number. */
static void set_impulse_rows(fvi_observer *o, size_t j, size_t k, const double *impulse, size_t stride, double unit)
{
    o->impulse[j] = unit * impulse[k * stride];
    for (size_t i = 0; i < o->degree; i++)
        o->latest[i * o->tracked + j] = i < k ? unit * (impulse[(k - i) * stride] - impulse[(k - i - 1) * stride]) : 0;
}

static void set_start(fvi_observer *o, size_t j, double jump, double line)
{
    o->jump[j] = jump;
    o->line[j] = line;
}

/* Add the derivatives through the first row, t = 0, for number i. */
static void transpose_start(const fvi_observer *o, const fvi_run *run, size_t i, size_t at, double w, double *impulse,
                            double *jump, double *line)
{
    size_t coordinate;
    const size_t j = fvi_observer_damper_of(o, i, &coordinate);
    const double by_jump = o->is_jumping[at] != 0 ? fvi_observer_begin_force(run, j, 1, 0) : 0,
                 by_line = fvi_observer_begin_force(run, j, o->is_jumping[at] != 0, 1) - by_jump;
    if (!isfinite(by_jump) || (o->is_moving[at] != 0 && !isfinite(by_line))) {
        impulse[fvi_observer_numbers(o) + i] += w / run->h;
        return;
    }
    *jump += w * by_jump;
    *line += isfinite(by_line) ? w * by_line : 0;
}

int fvi_observer_transpose(fvi_observer *o, const fvi_run *run, const double *w, double *impulse, double *jump,
                           double *line)
{
    const size_t n = fvi_observer_numbers(o), first = fvi_observer_first_rows(o);
    for (size_t i = 0; i < n; i++) {
        double unit;
        const size_t j = place_among_tracked(o, i, &unit);
        jump[i] = line[i] = 0;
        transpose_start(o, run, i, j, w[i], impulse, &jump[i], &line[i]);
        for (size_t k = 1; k <= run->steps; k++) {
            const double of = w[k * n + i];
            set_start(o, j, 0, 0);
            for (size_t back = 0; of != 0 && back < k && back <= o->degree; back++) {
                set_unit_impulse(o, j, back);
                impulse[(k - back) * n + i] += of * fvi_observer_slope(o, j, k, run->h);
            }
            if (of == 0 || k > first)
                continue;
            clear_impulses(o, j);
            set_start(o, j, 1, 0);
            jump[i] += o->is_jumping[j] != 0 ? of * fvi_observer_slope(o, j, k, run->h) : 0;
            set_start(o, j, 0, 1);
            line[i] += of * fvi_observer_slope(o, j, k, run->h);
        }
    }
    return FVI_SUCCESS;
}

void fvi_observer_powers(const fvi_observer *o, double *power)
{
    for (size_t i = 0; i < fvi_observer_numbers(o); i++) {
        size_t coordinate;
        double unit;
        const size_t j = place_among_tracked(o, i, &unit);
        const double growth = o->growth[fvi_observer_damper_of(o, i, &coordinate)];
        power[i] = fvi_observer_is_compared(o, j) ? NAN : o->exponent[j] + growth;
    }
}

int fvi_observer_first_forces(fvi_observer *o, const fvi_run *run, const double *power, int has_start, const double *w,
                              const double *impulse, double *sum)
{
    const size_t n = fvi_observer_numbers(o), first = fvi_observer_first_rows(o);
    size_t *const law_of = o->law_rows.law_of;
    *sum = 0;
    for (size_t i = 0; i < n; i++) {
        double unit;
        size_t coordinate;
        const size_t j = place_among_tracked(o, i, &unit), damper = fvi_observer_damper_of(o, i, &coordinate);
        const double start = fvi_observer_begin_force(run, damper, o->jump[j], o->line[j]) / unit;
        *sum += has_start && isfinite(start) ? w[i] * start : 0; /* an infinite one is a mean over the next row */
        if (!isnan(power[i])) { /* as in the run of the impulses, even if the changed law would be compared */
            o->exponent[j] = power[i] - o->growth[damper];
            o->law_rows.law_of = NULL;
        }
        for (size_t k = 1; unit != 0 && k <= run->steps && k <= first; k++) {
            set_impulse_rows(o, j, k, impulse + i, n, unit);
            *sum += w[k * n + i] * fvi_observer_slope(o, j, k, run->h) / unit;
        }
        o->law_rows.law_of = law_of;
    }
    return FVI_SUCCESS;
}
