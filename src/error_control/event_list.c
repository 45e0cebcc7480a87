/* src/error_control/event_list.c -- Lists of the events of a run, and the distance of two such lists. [H 22] */
#include "event_list.h"

#include "system/fail.h"
#include "system/larger.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static int make_room(fvi_event_list *list, size_t count, size_t d)
{
    if (count <= list->room)
        return FVI_SUCCESS;
    const size_t room = 2 * count + 16;
    fvi_event_time *at = realloc(list->at, room * sizeof *at);
    if (at)
        list->at = at;
    double *place = at ? realloc(list->place, 2 * d * room * sizeof *place) : NULL;
    if (!place)
        FVI_FAIL("no memory for the events", FVI_ENOMEM);
    list->place = place;
    list->room = room;
    return FVI_SUCCESS;
}

int fvi_event_list_add(fvi_event_list *list, const fvi_stepper *s)
{
    const size_t d = s->run.system->d;
    size_t happened;
    const fvi_event_time *at = fvi_stepper_events(s, &happened);
    const int status = make_room(list, happened, d);
    for (; !status && list->count < happened; list->count++) {
        double *place = list->place + 2 * d * list->count;
        list->at[list->count] = at[list->count];
        memcpy(place, s->x, d * sizeof *place);
        memcpy(place + d, s->p, d * sizeof *place);
    }
    return status;
}

void fvi_event_list_free(fvi_event_list *list)
{
    free(list->at);
    free(list->place);
    *list = (fvi_event_list){ 0 };
}

/* The index of the next time of this event in the list, from `from` on; list->count if there is none. */
static size_t next_time(const fvi_event_list *list, size_t from, size_t event)
{
    while (from < list->count && list->at[from].event != event)
        from++;
    return from;
}

/* The distance of two events that belong together; INFINITY if one is a rest or a lift-off and the other is not. The
 * times of lift-offs may differ, because an error of such a time moves the body by its square only, H 29. */
static double event_distance(const fvi_event_list *a, size_t i, const fvi_event_list *b, size_t j, size_t d,
                             double speed)
{
    double D = speed * fabs(a->at[i].t - b->at[j].t);
    if (!a->at[i].at_rest != !b->at[j].at_rest || !a->at[i].lifts_off != !b->at[j].lifts_off)
        return INFINITY;
    if (a->at[i].lifts_off)
        return 0;
    for (size_t n = 0; n < d; n++)
        D = larger(D, fabs(a->place[2 * d * i + n] - b->place[2 * d * j + n]));
    return D;
}

/* The time of the first event of the list that has no partner in the other list, or `before` if that is earlier. The
 * times of event e have partners before the index matched[e]. */
static double first_unmatched(const fvi_event_list *list, const size_t *matched, double before)
{
    for (size_t j = 0; j < list->count; j++)
        if (j >= matched[list->at[j].event])
            return smaller(before, list->at[j].t);
    return before;
}

int fvi_event_list_distance(const fvi_event_list *a, const fvi_event_list *b, size_t d, size_t count,
                            double speed, double end, double error, double *distance,
                            fvi_event_agreement *common)
{
    size_t *matched = calloc(count + 1, sizeof *matched); /* for each event, the index in b after its last partner */
    if (!matched)
        FVI_FAIL("no memory for the events", FVI_ENOMEM);
    *distance = 0;
    *common = (fvi_event_agreement){ 0 };
    double alone = INFINITY; /* the time of the first event without a partner */
    for (size_t i = 0; i < a->count; i++) {
        const size_t e = a->at[i].event, j = next_time(b, matched[e], e);
        const double D = j < b->count ? event_distance(a, i, b, j, d, speed) : INFINITY;
        if (!(D < INFINITY)) {
            alone = smaller(alone, a->at[i].t);
            continue;
        }
        matched[e] = j + 1;
        *distance = larger(*distance, D);
        if (a->at[i].t < alone) {
            common->agreed++;
            common->until = a->at[i].t;
        }
    }
    alone = first_unmatched(b, matched, alone);
    const int is_at_end = speed * (end - alone) <= error && end - alone <= 1e-3 * end;
    common->differ = alone < INFINITY && !is_at_end;
    if (common->differ)
        *distance = INFINITY;
    free(matched);
    return FVI_SUCCESS;
}
