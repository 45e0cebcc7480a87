/* src/problem/typed_event.c -- Parse events, such as 'x1 : impact:0.8'. [H 22] */
#define _GNU_SOURCE /* for strndup */
#include "typed_mechanism.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* An event. z of an impact is an expression in x1, ..., xd, t, with exact derivatives. z of other events may also
 * contain v and p. */
typedef struct {
    fvi_typed_expression z;
    char *name;
    size_t d;
    const double *mass;
    const fvi_mechanism *mechanism; /* defines the velocities; or NULL */
    int knows_velocity, has_variable;
} typed_event;

struct fvi_typed_events {
    size_t count;
    typed_event *typed;
    fvi_event *events;
};

/* ---- z ---- */

/* Return the number of a variable x, x1, ..., v, ..., p, ..., t, from 0; -1 for an unknown name. */
static int find_name(const char *name, size_t length, void *params)
{
    typed_event *e = params;
    const size_t d = e->d, i = length == 1 && d == 1 ? 0 : fvi_scan_index(name + 1, length - 1, d);
    static const char kinds[] = "xvp";
    const char *kind = memchr(kinds, *name, 3);
    if (length == 1 && *name == 't') {
        e->has_variable = 1;
        return (int)(3 * d);
    }
    if (!kind || i >= d)
        return -1;
    e->knows_velocity |= *name == 'v';
    e->has_variable = 1;
    return (int)((size_t)(kind - kinds) * d + i);
}

enum { FEW = 16 };

/* Compute v from p. It is 0 for a coordinate without mass. */
static int velocity_of(const typed_event *e, double t, const double *x, const double *p,
                       double *v)
{
    const fvi_system system = { .d = e->d, .mass = e->mass, .mechanism = e->mechanism };
    memset(v, 0, e->d * sizeof *v);
    return e->knows_velocity ? fvi_velocity_of_momentum(&system, t, x, p, v) : FVI_SUCCESS;
}

/* x, v, p and t are copied to one array. It is on the stack if they are few, because runs in several threads may share
 * an event. */
static int value_of_state(double t, size_t d, const double *x, const double *p,
                          void *params, double *z)
{
    const typed_event *e = params;
    double small[3 * FEW + 1], *y = d > FEW ? malloc((3 * d + 1) * sizeof *y) : small;
    if (!y)
        return FVI_ENOMEM;
    memcpy(y, x, d * sizeof *x);
    memcpy(y + 2 * d, p, d * sizeof *p);
    y[3 * d] = t;
    const int status = velocity_of(e, t, x, p, y + d);
    if (!status)
        *z = fvi_expression_value(e->z.e, y);
    if (d > FEW)
        free(y);
    return status;
}

static int event_value(double t, size_t d, const double *x, const double *p,
                       void *params, double *z)
{
    (void)p;
    return fvi_text_value(t, d, x, &((typed_event *)params)->z, z);
}

static int event_gradient(double t, size_t d, const double *x, void *params,
                          double *normal, double *rate)
{
    return fvi_text_slopes(t, d, x, &((typed_event *)params)->z, normal, rate);
}

static int event_hessian(double t, size_t d, const double *x, double factor, void *params,
                         double *H)
{
    return fvi_text_hessian(t, d, x, factor, &((typed_event *)params)->z, H);
}

/* ---- texts ---- */

/* Parse impact:E, contact:E, stop or mark. */
static int parse_action(const char *text, fvi_event *event, fvi_error *error)
{
    static const char *const words[] = { "impact", "contact", "stop", "mark", NULL };
    static const fvi_event_action actions[] = { FVI_EVENT_IMPACT, FVI_EVENT_CONTACT,
                                                FVI_EVENT_STOP, FVI_EVENT_MARK };
    const size_t length = strcspn(text, ":"), which = fvi_scan_word(text, length, words);
    char place[64];
    if (!words[which])
        return fvi_refuse(error, "event", "'%s' is none of impact:E, contact:E, stop, mark%s", text,
                        fvi_word_hint(text, length, words, place));
    event->action = actions[which];
    if (fvi_event_has_wall(event) && text[length])
        return fvi_parse_number("event", text + length + 1, 0, 1, "[]",
                                &event->restitution, error);
    return !fvi_event_has_wall(event) && !text[length]
               ? FVI_SUCCESS
               : fvi_refuse(error, "event", "'%s' is not %s", text,
                          which == 0 ? "impact:E" : which == 1 ? "contact:E" : words[which]);
}

/* Return the first name of a coordinate, velocity or momentum with a number above d, and its *length; NULL if there is
 * none. */
static const char *beyond_dimension(const char *text, size_t d, size_t *length)
{
    for (const char *at = text; (at = strpbrk(at, "xvp")); at++) {
        const int is_inside = at > text && (isalnum((unsigned char)at[-1]) || at[-1] == '_');
        const size_t digits = strspn(at + 1, "0123456789");
        *length = 1 + digits;
        if (!is_inside && digits > 0 && !isalpha((unsigned char)at[*length]) && at[*length] != '_'
            && strtoul(at + 1, NULL, 10) > d)
            return at;
    }
    return NULL;
}

/* If the text contains such a name, replace the parser's error. Return status. */
static int refuse_coordinate(const typed_event *e, int status, fvi_error *error)
{
    size_t length;
    const char *name = status == FVI_EINVAL ? beyond_dimension(e->name, e->d, &length) : NULL;
    char all[64] = "x alone";
    if (e->d > 1)
        snprintf(all, sizeof all, "x1 ... x%zu", e->d);
    return name ? fvi_fail(error, status, "event", NAN, "'%s': there is no %.*s; the coordinates are %s",
                           e->name, (int)length, name, all)
                : status;
}

/* Parse z from the text e->name. */
static int parse_value(typed_event *e, fvi_event *event,
                       fvi_user_parameters *parameters, fvi_error *error)
{
    const fvi_name_finder finder = { find_name, e };
    fvi_expression *of_state = NULL;
    int status = fvi_parse_expression_of("event", &finder, e->name, parameters,
                                         &of_state, error);
    if (!status && !e->has_variable && !fvi_event_has_wall(event)) {
        fvi_expression_free(of_state);
        return fvi_refuse(error, "event", "'%s' is a constant, which never passes 0", e->name);
    }
    if (status || !fvi_event_has_wall(event)) {
        e->z.e = of_state;
        event->value = value_of_state;
        return status;
    }
    fvi_expression_free(of_state);
    if (fvi_largest_index(e->name) == 0)
        return fvi_refuse(error, "event", "'%s': Z of an impact without x has no normal along which a momentum could "
                          "jump; stop and mark need none", e->name);
    event->value = event_value;
    event->gradient = event_gradient;
    event->hessian = event_hessian;
    status = fvi_parse_state_expression("event", e->d, 0, e->name, parameters, &e->z.e, error);
    return status != FVI_EINVAL
               ? status
               : fvi_fail(error, status, "event", NAN,
                          "'%s': Z of an impact is an expression in x and t alone", e->name);
}

/* Return the last colon with blanks on both sides; NULL if there is none. */
static const char *last_separator(const char *text)
{
    const char *last = NULL;
    for (const char *at = text; (at = strstr(at, " : ")); at++)
        last = at;
    return last;
}

static int parse_event(const char *text, typed_event *e, fvi_event *event,
                       fvi_user_parameters *parameters, fvi_error *error)
{
    const char *colon = last_separator(text), *end = colon;
    if (!colon)
        return fvi_refuse(error, "event", "'%s' is not 'Z : WHAT', with blanks around the colon", text);
    while (end > text && end[-1] == ' ')
        end--;
    text += strspn(text, " ");
    e->name = strndup(text, end > text ? (size_t)(end - text) : 0);
    if (!e->name)
        return fvi_no_memory(error, "event");
    *event = (fvi_event){ .params = e };
    const int status = parse_action(colon + 3 + strspn(colon + 3, " "), event, error);
    return status ? status : refuse_coordinate(e, parse_value(e, event, parameters, error), error);
}

int fvi_parse_events(size_t count, const char *const *texts, size_t d,
                     const double *mass, fvi_user_parameters *parameters,
                     fvi_typed_events **events, fvi_error *error)
{
    if (!texts || !mass || !events)
        return fvi_fail(error, FVI_EFAULT, "event", NAN, "null pointer");
    fvi_typed_events *new = calloc(1, sizeof *new);
    if (!new)
        return fvi_no_memory(error, "event");
    new->typed = calloc(count + 1, sizeof *new->typed);
    new->events = calloc(count + 1, sizeof *new->events);
    int status = new->typed && new->events ? FVI_SUCCESS : fvi_no_memory(error, "event");
    for (size_t i = 0; !status && i < count; i++) {
        new->typed[i] = (typed_event){ .d = d, .mass = mass };
        new->count = i + 1;
        status = parse_event(texts[i], &new->typed[i], &new->events[i], parameters, error);
    }
    if (status)
        fvi_typed_events_free(new);
    else
        *events = new;
    return status;
}

void fvi_typed_events_of(fvi_typed_events *events, const fvi_mechanism *mechanism)
{
    for (size_t i = 0; events && i < events->count; i++)
        events->typed[i].mechanism = mechanism;
}

const fvi_event *fvi_events_typed(const fvi_typed_events *events, size_t *count)
{
    *count = events ? events->count : 0;
    return events ? events->events : NULL;
}

const char *fvi_typed_event_name(const fvi_typed_events *events, size_t i)
{
    return events->typed[i].name;
}

void fvi_typed_events_free(fvi_typed_events *events)
{
    if (!events)
        return;
    for (size_t i = 0; i < events->count; i++) {
        fvi_expression_free(events->typed[i].z.e);
        free(events->typed[i].name);
    }
    free(events->typed);
    free(events->events);
    free(events);
}
