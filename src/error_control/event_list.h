/* src/error_control/event_list.h -- Lists of the events of a run, and the distance of two such lists. [H 22] */
#ifndef FVI_EVENT_LIST_H
#define FVI_EVENT_LIST_H

#include <fvi/events.h>

/* The events of a run in their order, each with the position x at the event and the momentum p after it: 2 d numbers at
 * place[2 d i]. A zeroed list is empty. */
typedef struct {
    size_t count, room;
    fvi_event_time *at;
    double *place;
} fvi_event_list;

/* What two lists have in common: the first `agreed` events, the last of which is at the time `until`. differ is nonzero
 * if the lists differ after that. */
typedef struct {
    size_t agreed;
    double until;
    int differ;
} fvi_event_agreement;

/* fvi_event_list_add -- append the events that the stepper knows and the list does not. All of them must have happened
 * at s->t, so call this after each step. Returns FVI_SUCCESS or FVI_ENOMEM.
 * fvi_event_list_free -- free the arrays of the list, which is empty then. */
int fvi_event_list_add(fvi_event_list *list, const fvi_stepper *s);
void fvi_event_list_free(fvi_event_list *list);

/* fvi_event_list_distance -- how far the events of two runs are apart, as a length: the largest of |x - x'| and of
 * speed |t - t'| over all events.
 *
 * Time number n of an event in one list is compared with time number n of the same event in the other list. So two
 * different events that lie closer together than the error of the runs may stand in either order. For lift-offs neither
 * x nor t is compared.
 *
 *   count     how many events are watched, as in fvi_run
 *   speed     the largest speed of a coordinate
 *   end       the end of the runs. An event closer to it than `error` / speed, and than a thousandth of it, may stand
 *             in one list only
 *   distance  output; infinite if the lists differ
 *   common    output
 *
 * Returns FVI_SUCCESS or FVI_ENOMEM. Cost O(n count) for n events. */
int fvi_event_list_distance(const fvi_event_list *a, const fvi_event_list *b, size_t d, size_t count,
                            double speed, double end, double error, double *distance,
                            fvi_event_agreement *common);

#endif
