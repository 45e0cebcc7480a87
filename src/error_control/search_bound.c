/* src/error_control/search_bound.c -- Steps that pass over nothing of the force.  [H 18] */
#include "search_bound.h"

#include "system/fail.h"
#include "system/larger.h"

#include <gsl/gsl_machine.h>
#include <math.h>
#include <stdlib.h>

enum { ORDER = FVI_BOUND_ORDER };

typedef struct {
    const fvi_run *run;
    double h, T, error;
    double *most;  /* bounds, (ORDER + 1) d numbers */
    double hidden; /* how far x may move by what was not seen so far */
} cover;

//> between
/* How far F_j may be, in a time that has so many nodes of steps h, from a polynomial that
 * goes through nodes: half of the range; or (k-1)!/4 h^k |F^(k)|/k! by k of them, whose
 * product of distances is nowhere larger.                                        (18.8) */
static double hidden_force(const double *most, size_t d, double nodes, double h)
{
    double least = most[0], factor = h / 2;
    for (int k = 1; k <= ORDER && k <= nodes; k++) {
        const double rest = factor * most[(size_t)k * d];
        if (rest < least) /* 0 times INFINITY tells nothing */
            least = rest;
        factor = k == 1 ? h * h / 4 : factor * h * k;
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
        away = larger(away, hidden_force(o->most + j, system->d,
                                         length / o->h + 1 + in, o->h)
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

int fvi_search_least_parts(const fvi_run *run, double error, size_t most,
                           size_t *parts)
{
    const double T = run->h * (double)run->steps;
    cover o = { .run = run, .T = T, .error = error };
    *parts = 1;
    while (run->longest > 0 && *parts <= most
           && run->h / (double)*parts > run->longest)
        *parts *= 2;
    if (!run->system->force.bound)
        return FVI_SUCCESS;
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
