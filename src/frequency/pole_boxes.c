/* src/frequency/pole_boxes.c -- Find poles that no undamped mode leads to.       [H 30] */
#include "pole_boxes.h"

#include "pole_count.h"
#include "system/fail.h"

#include <math.h>

#define LEAST_BOX 1e-9 /* sum of two sides, of ln s */

/* Return how many poles of the list are in the box. */
static size_t count_known(const fvi_pole_list *list, const fvi_log_box *b)
{
    size_t count = 0;
    for (size_t k = 0; k < list->count; k++) {
        const double u = log(cabs(list->candidate[k].s)), v = carg(list->candidate[k].s);
        count += u > b->u[0] && u < b->u[1] && v > b->v[0] && v < b->v[1];
    }
    return count;
}

/* Start Newton's method in the middle of the box. A pole that is new goes into the list, wherever it is. */
static int try_middle(fvi_response *r, const fvi_log_box *b, fvi_pole_list *list)
{
    fvi_pole_candidate *p = &list->candidate[list->count];
    p->s = cexp((b->u[0] + b->u[1]) / 2 + I * (b->v[0] + b->v[1]) / 2);
    const int status = fvi_pole_newton_from(r, p);
    int is_new = !status && fvi_pole_is_found(p, FVI_NEARLY_REAL);
    for (size_t k = 0; is_new && k < list->count; k++)
        is_new = !fvi_pole_is_same(r->d, &list->candidate[k], p);
    list->count += (size_t)is_new;
    return status;
}

int fvi_poles_in_box(fvi_response *r, const fvi_log_box *b, size_t n, fvi_pole_list *list)
{
    if (count_known(list, b) >= n || list->count == list->room)
        return FVI_SUCCESS;
    int status = try_middle(r, b, list);
    if (status || count_known(list, b) >= n || b->u[1] - b->u[0] + b->v[1] - b->v[0] < LEAST_BOX)
        return status;
    fvi_log_box half[2];
    const int first = fvi_halve_box(fvi_poles_phase, r, fvi_poles_step(r), b, half);
    status = fvi_interrupted();
    if (status || first < 0 || (size_t)first > n)
        return status;
    status = fvi_poles_in_box(r, &half[0], (size_t)first, list);
    return status ? status : fvi_poles_in_box(r, &half[1], n - (size_t)first, list);
}
