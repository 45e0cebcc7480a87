/* src/error_control/search_bound.c -- Find steps that cannot pass over a pulse of the force. [H 18]
 *
 * Between nodes, a force differs from the polynomial through its values at the nodes by at most a factor times h^k
 * times a bound of its k-th derivative (18.8). The search halves the steps until all such differences together move no
 * coordinate farther than the wanted error. */
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
    CUTS = 8, /* a gap between two nodes is cut into so many parts */
    MOST_NODES = (1 << DOUBLINGS) * (FVI_STAGES - 1) + 1
};

typedef struct {
    const fvi_run *run;
    double h, T, error;
    size_t nodes;  /* of a step, one of its ends left out */
    fvi_node_factors factor;
    double *most;  /* what force.bound wrote, (ORDER + 1) d numbers */
    double hidden; /* how far x may move by the changes that were not seen so far */
} cover;

/* ---- how far a function can be from the polynomial through its nodes ---- */

static double within_range(double value, double low, double high)
{
    return value < low ? low : value > high ? high : value;
}

//> node-product
/* An upper bound of |(t - c_0) ... (t - c_{k-1})| for t between c_i and c_{i+1}. The gap is cut into parts. In each
 * part a factor is at most its value at the farther end. The product of the two factors of the gap itself is largest at
 * the point of the part that is closest to the middle of the gap. (18.8) */
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

/* The same for k of n nodes: `before` of them lie before the gap i, unless an end of the list is too close. */
static double product_around(size_t n, const double *c, size_t k, size_t i,
                             size_t before)
{
    const size_t first = i > before ? i - before : 0,
                 from = first + k > n ? n - k : first;
    return largest_node_product(k, c + from, i - from);
}

/* The bound for every t among n nodes, which are symmetric. For an odd number of nodes, the side with one node more is
 * the one with the smaller bound. Only gaps near an end are tried: a gap farther from the ends than k nodes and one
 * step is like a gap that is nearer. */
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
/* An upper bound of the distance between F_j and a polynomial through its nodes, over a time of `steps` steps h. It is
 * half of the range of F_j; or factor_k h^k |F^(k)| / k!, if that is less for some k. (18.8) */
static double hidden_force(const cover *o, size_t j, double steps)
{
    const size_t d = o->run->system->d;
    const int n = (int)within_range(log2(steps) + 0.5, 0, DOUBLINGS);
    const double nodes = (double)(o->nodes << n) + 1;
    double least = o->most[j], power = 1;
    for (int k = 1; k <= ORDER && k <= nodes; k++) {
        power *= o->h;
        const double rest = o->factor[n][k] * power * o->most[(size_t)k * d + j];
        if (rest < least) /* false for NaN, which is 0 times INFINITY */
            least = rest;
    }
    return least;
}
//< between

/* Add to o->hidden how far changes of the force between the times `from` and `to` may move x. The interval is halved as
 * long as it is longer than a step and its part is more than its share of the error. */
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
