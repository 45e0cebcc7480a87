/* src/run/events.c -- Check the events of a run. [H 22] */
#include "system/fail.h"
#include <fvi/events.h>

#include <fvi/error.h>

#include <math.h>

static int refuse(int code, size_t i, double value, const char *reason,
                  fvi_error *error)
{
    return fvi_at_index(error, i, fvi_fail(error, code, "events", value, "event %zu: %s", i, reason));
}

int fvi_events_check(const fvi_method *method, const fvi_run *run,
                     fvi_error *error)
{
    if (!run->events)
        return fvi_fail(error, FVI_EFAULT, "events", NAN, "events is a null pointer");
    if (method->scheme != FVI_SCHEME_VARIABLE_STEP)
        return fvi_fail(error, FVI_EUNSUP, "events", NAN, "this method has no events; fvi-adaptive has");
    if (run->system->matrices)
        return fvi_fail(error, FVI_EUNSUP, "events", NAN, "a system with matrices has no events");
    for (size_t i = 0; i < run->event_count; i++) {
        const fvi_event *e = &run->events[i];
        if (e->action != FVI_EVENT_MARK && e->action != FVI_EVENT_STOP
            && e->action != FVI_EVENT_IMPACT && e->action != FVI_EVENT_CONTACT)
            return refuse(FVI_EINVAL, i, e->action, "unknown action", error);
        const int hits = fvi_event_has_wall(e);
        if (e->action == FVI_EVENT_CONTACT && !run->system->mechanism)
            return refuse(FVI_EUNSUP, i, e->action,
                          "a contact needs a system with a mechanism, which may be an empty one",
                          error);
        if (!e->value || (hits && !e->gradient))
            return refuse(FVI_EFAULT, i, NAN,
                          !e->value ? "it needs its value"
                          : e->action == FVI_EVENT_IMPACT ? "an impact needs its gradient"
                                                          : "a contact needs its gradient",
                          error);
        if (hits && !(e->restitution >= 0 && e->restitution <= 1))
            return refuse(FVI_EDOM, i, e->restitution,
                          "the restitution must be in [0, 1]", error);
        if (hits && !(e->rest >= 0 && isfinite(e->rest)))
            return refuse(FVI_EDOM, i, e->rest, "the height of rest must be finite and not negative",
                          error);
    }
    return FVI_SUCCESS;
}
