/* src/error_control/event_list.h -- The events of two runs, compared as lists.     [H 22] */
#ifndef FVI_EVENT_LIST_H
#define FVI_EVENT_LIST_H

#include <fvi/events.h>

/* The events of a run, in their order, each with the place x and the momentum p behind it: 2 d numbers at
 * [2 d i]. Zeroed it is empty. */
typedef struct {
    size_t count, room;
    fvi_event_time *at;
    double *place;
} fvi_event_list;

/* What two lists have in common: so many events, the last of them at the time `until`; nonzero if they differ
 * behind it. */
typedef struct {
    size_t agreed;
    double until;
    int differ;
} fvi_event_agreement;

/* fvi_event_list_add -- the events that the stepper knows and the list does not. They all are at s->t, so this
 * is called after each step. FVI_ENOMEM.
 * fvi_event_list_free -- its arrays; it is empty then. */
int fvi_event_list_add(fvi_event_list *list, const fvi_stepper *s);
void fvi_event_list_free(fvi_event_list *list);

/* fvi_event_list_distance -- how far the events of two runs are apart, as a length: the largest of |x - x'|
 * at an event and of speed |t - t'|.
 *
 * The n-th time of an event in one list belongs to its n-th time in the other. So two different events that are nearer
 * to each other than the two runs may stand in either order. Of lift-offs neither x nor t is compared.
 *
 *   count   how many events are watched, as fvi_run has it
 *   speed   the largest speed of a coordinate
 *   end     of the runs. What is nearer to it than `error` / speed may stand in one list only
 *   common  output
 *
 * Returns FVI_SUCCESS, or FVI_ENOMEM. *distance is infinite where the lists differ. Cost O(n count). */
int fvi_event_list_distance(const fvi_event_list *a, const fvi_event_list *b, size_t d, size_t count,
                            double speed, double end, double error, double *distance,
                            fvi_event_agreement *common);

#endif
