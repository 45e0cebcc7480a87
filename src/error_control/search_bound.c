/* src/error_control/search_bound.c -- Steps that pass over nothing of the force.  [H 18] */
#include "search_bound.h"

#include "stages/lobatto_weights.h"
#include "system/fail.h"
#include "system/larger.h"

#include <gsl/gsl_machine.h>
#include <math.h>
#include <stdlib.h>

enum {
    ORDER = FVI_BOUND_ORDER,
    DOUBLINGS = FVI_BOUND_DOUBLINGS,
    CUTS = 8, /* of a gap between two nodes */
    MOST_NODES = (1 << DOUBLINGS) * (FVI_STAGES - 1) + 1
};

typedef struct {
    const fvi_run *run;
    double h, T, error;
    size_t nodes;  /* of a step, one of its ends left out */
    fvi_node_factors factor;
    double *most;  /* bounds, (ORDER + 1) d numbers */
    double hidden; /* how far x may move by what was not seen so far */
} cover;

/* ---- how far a function is from the polynomial through its nodes ---- */

static double within_range(double value, double low, double high)
{
    return value < low ? low : value > high ? high : value;
}

//> node-product
/* max of |(t - c_0) ... (t - c_{k-1})| for t between c_i and c_{i+1}: this gap is cut into
 * parts, and in each of them a factor is at most what it is at the farther end. The two
 * factors of the gap are largest as near to its middle as the part comes.       (18.8) */
static double largest_node_product(size_t k, const double *c, size_t i)
{
    const double gap = c[i + 1] - c[i], middle = c[i] + gap / 2;
    double largest = 0;
    for (int cut = 0; cut < CUTS; cut++) {
        const double low = c[i] + gap * cut / CUTS,
                     high = c[i] + gap * (cut + 1) / CUTS,
                     best = within_range(middle, low, high);
        double product = (best - c[i]) * (c[i + 1] - best);
        for (size_t j = 0; j < k; j++)
            if (j != i && j != i + 1)
                product *= j < i ? high - c[j] : c[j] - low;
        largest = larger(largest, product);
    }
    return largest;
}
//< node-product

/* The same with k of n nodes, `before` of them before the gap i, as far as the ends let. */
static double product_around(size_t n, const double *c, size_t k, size_t i,
                             size_t before)
{
    const size_t first = i > before ? i - before : 0,
                 from = first + k > n ? n - k : first;
    return largest_node_product(k, c + from, i - from);
}

/* For every t among the nodes, which mirror each other. An odd number of them around t has
 * one more on the better side. A gap that is farther from the ends than k nodes and a step is
 * like one that is nearer. */
static double largest_of_gaps(size_t n, const double *c, size_t k, size_t period)
{
    const size_t half = n / 2, gaps = half < k + period ? half : k + period;
    double largest = 0;
    for (size_t i = 0; i < gaps; i++)
        largest = larger(largest,
                         smaller(product_around(n, c, k, i, (k - 2) / 2),
                                 product_around(n, c, k, i, (k - 1) / 2)));
    return largest;
}

static size_t nodes_of_step(size_t stages)
{
    return stages > 2 ? stages - 1 : 1;
}

void fvi_search_node_factors(size_t stages, fvi_node_factors factor)
{
    static const double ends[] = { 0, 1 };
    const double *c = stages > 2 ? fvi_lobatto(stages)->c : ends;
    const size_t nodes = nodes_of_step(stages);
    double node[MOST_NODES], widest = 0;
    for (size_t i = 0; i < nodes; i++)
        widest = larger(widest, c[i + 1] - c[i]);
    for (size_t n = 0; n <= DOUBLINGS; n++) {
        const size_t count = (nodes << n) + 1;
        for (size_t i = 0; i < count; i++)
            node[i] = (double)(i / nodes) + c[i % nodes];
        factor[n][1] = widest / 2;
        for (size_t k = 2; k <= ORDER && k <= count; k++)
            factor[n][k] = largest_of_gaps(count, node, k, nodes);
    }
}

/* ---- the force ---- */

//> between
/* How far F_j may be, in a time of so many steps h, from a polynomial that goes through
 * nodes: half of the range; or factor_k h^k |F^(k)| / k! by k of them.            (18.8) */
static double hidden_force(const cover *o, size_t j, double steps)
{
    const size_t d = o->run->system->d;
    const int n = (int)within_range(log2(steps) + 0.5, 0, DOUBLINGS);
    const double nodes = (double)(o->nodes << n) + 1;
    double least = o->most[j], power = 1;
    for (int k = 1; k <= ORDER && k <= nodes; k++) {
        power *= o->h;
        const double rest = o->factor[n][k] * power * o->most[(size_t)k * d + j];
        if (rest < least) /* 0 times INFINITY tells nothing */
            least = rest;
    }
    return least;
}
//< between

/* Adds to what is hidden what is so from one time to another: in halves, as long as they
 * have nodes and what is hidden there is more than their part of the error. */
static int add_hidden(cover *o, double from, double to)
{
    const fvi_system *system = o->run->system;
    const fvi_force *force = &system->force;
    const double in = 4 * GSL_DBL_EPSILON, length = to - from;
    int status = force->bound(from + in * larger(from, o->h), to - in * to,
                              ORDER, system->d, force->params, o->most);
    double away = 0;
    for (size_t j = 0; j < system->d && !status; j++)
        away = larger(away, hidden_force(o, j, length / o->h)
                                / system->mass[j]);
    away *= length * (o->T - from);
    const int is_small = away <= o->error * length / o->T;
    if (status || is_small || length <= o->h * (1 + 1e-9)) {
        o->hidden += away;
        return status;
    }
    const double middle = from + length / 2;
    status = add_hidden(o, from, middle);
    if (!status && o->hidden <= o->error)
        status = add_hidden(o, middle, to);
    return status;
}

int fvi_search_least_parts(const fvi_run *run, size_t stages, double error,
                           size_t most, size_t *parts)
{
    const double T = run->h * (double)run->steps;
    cover o = { .run = run,
                .T = T,
                .error = error,
                .nodes = nodes_of_step(stages) };
    *parts = 1;
    while (run->longest > 0 && *parts <= most
           && run->h / (double)*parts > run->longest)
        *parts *= 2;
    if (!run->system->force.bound)
        return FVI_SUCCESS;
    fvi_search_node_factors(stages, o.factor);
    o.most = malloc((ORDER + 1) * run->system->d * sizeof *o.most);
    if (!o.most)
        FVI_FAIL("no memory for the bounds", FVI_ENOMEM);
    int status = FVI_SUCCESS;
    for (; *parts <= most && !status; *parts *= 2) {
        o.h = run->h / (double)*parts;
        o.hidden = 0;
        for (size_t k = 0; k < run->steps && o.hidden <= error && !status; k++)
            status =
                add_hidden(&o, (double)k * run->h, (double)(k + 1) * run->h);
        if (o.hidden <= error)
            break;
    }
    free(o.most);
    return status;
}

int fvi_search_is_too_long(int status)
{
    return status == FVI_EOVRFLW || status == FVI_EMAXITER || status == FVI_ESING;
}

size_t fvi_search_agreed(size_t rows, size_t d, const double *x, const double *before, double error)
{
    size_t k = 0;
    while (k < rows && largest_difference(d, x + k * d, before + k * d) <= error)
        k++;
    return k;
}
