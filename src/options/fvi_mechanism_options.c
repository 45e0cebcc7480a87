/* src/options/fvi_mechanism_options.c -- Read Lagrangians, dampers, constraints and events from the command line. */
#include "fvi_mechanism_options.h"
#include "fvi_problem.h"
#include "input/fvi_files.h"

#include <fvi/observer.h>
#include <fvi/variable_steps.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* The options whose values are lists, in the order of o->list. */
static const option_index listed[FVI_LISTS] = { DAMPER, CONSTRAINT, IMPOSE, FORCE_ON, EVENT, LET, DAMPING };

/* What stands between two values in the text of all of them. Parameters are a list, and laws are added. */
static const char *const between[FVI_LISTS] = { "; ", "; ", "; ", "; ", "; ", ",", " + " };

static size_t index_of_list(option_index i)
{
    size_t n = 0;
    while (n < FVI_LISTS && listed[n] != i)
        n++;
    return n;
}

int fvi_is_listed(option_index i)
{
    return index_of_list(i) < FVI_LISTS;
}

int fvi_list_option(fvi_options *o, option_index i, const char *value,
                    fvi_error *c)
{
    const size_t n = index_of_list(i);
    fvi_option_values *list = &o->list[n];
    const size_t used = strlen(list->text), room = sizeof list->text - used;
    const int length = snprintf(list->text + used, room, "%s%s",
                                used > 0 ? between[n] : "", value);
    if (list->count == FVI_MOST_LISTED || (size_t)length >= room)
        return fvi_refuse(c, fvi_option_list[i].name, "'%s': too many of them", value);
    list->value[list->count++] = value;
    o->text[i] = list->text;
    return 0;
}

/* ---- which words go together ---- */

static int has_massless(const fvi_options *o)
{
    for (size_t i = 0; o->mass && !o->directory && i < o->d; i++)
        if (o->mass[i] == 0)
            return 1;
    return 0;
}

/* Return nonzero if an event is a contact, because a body that rests on a surface is held there by a constraint. */
static int has_contacts(const fvi_options *o)
{
    const fvi_option_values *list = &o->list[FVI_OF_MECHANISM];
    for (size_t i = 0; i < list->count; i++)
        if (strstr(list->value[i], " contact:"))
            return 1;
    return 0;
}

/* Return nonzero if an option, or a mass of 0, asks for a mechanism. */
static int wants_mechanism(const fvi_options *o)
{
    for (size_t n = 0; n < FVI_OF_MECHANISM; n++)
        if (o->list[n].count > 0)
            return 1;
    return o->text[LAGRANGIAN] || has_massless(o) || o->potential_has_time
           || has_contacts(o);
}

int fvi_wants_stable(const fvi_options *o)
{
    return o->text[LAGRANGIAN] || o->text[CONSTRAINT] || o->text[IMPOSE]
           || has_massless(o);
}

int fvi_leaves_steps(const fvi_options *o)
{
    return (o->text[ERROR] || o->text[STEP_ERROR] || o->text[LONGEST] || o->text[EVENT])
           && !o->text[SYSTEM];
}

static int refuse_pair(const fvi_options *o, option_index a,
                       const option_index *others, fvi_error *c)
{
    for (; o->text[a] && *others != OPTIONS; others++)
        if (o->text[*others])
            return fvi_refuse(c, fvi_option_list[a].name, "not together with --%s", fvi_option_list[*others].name);
    return 0;
}

int fvi_check_mechanism_words(const fvi_options *o, fvi_error *c)
{
    static const option_index of_lagrangian[] = { POTENTIAL, MASS,  ALPHA,
                                                  ORDER,     RHO,   DAMPING,
                                                  DERIVATIVE, SYSTEM, OPTIONS },
                              of_damper[] = { ALPHA,   ORDER,      RHO,
                                              DAMPING, DERIVATIVE, OPTIONS },
                              of_start[] = { P0, SYSTEM, OPTIONS },
                              of_event[] = { SYSTEM, CHECKPOINT, OPTIONS },
                              of_directory[] = { CONSTRAINT, IMPOSE, FORCE_ON,
                                                 OPTIONS };
    int status = refuse_pair(o, LAGRANGIAN, of_lagrangian, c);
    if (!status)
        status = refuse_pair(o, DAMPER, of_damper, c);
    if (!status)
        status = refuse_pair(o, EVENT, of_event, c);
    if (!status)
        status = refuse_pair(o, V0, of_start, c);
    if (!status)
        status = refuse_pair(o, SYSTEM, of_directory, c);
    if (!status && o->text[LAGRANGIAN]
        && (!o->text[X0] || (!o->text[V0] && !o->text[P0])))
        status = fvi_refuse(c, "lagrangian", "a start is missing: --x0 X, and --v0 V or --p0 P");
    return status;
}

static size_t larger_count(size_t a, size_t b)
{
    return a > b ? a : b;
}

size_t fvi_mechanism_dimension(const fvi_options *o)
{
    const char *const texts[] = { o->text[LAGRANGIAN], o->list[0].text,
                                  o->list[1].text, o->list[2].text,
                                  o->list[3].text, o->text[POTENTIAL] }; /* an event adds no coordinate */
    size_t d = 0;
    if (o->text[POTENTIAL] && strncasecmp(o->text[POTENTIAL], "chain", 5) == 0)
        return 0; /* a chain states its own number of masses */
    for (size_t n = 0; n < sizeof texts / sizeof *texts; n++) {
        const size_t i = texts[n] ? fvi_largest_index(texts[n]) : 0;
        d = larger_count(i, d);
    }
    for (size_t i = 0; i < o->list[3].count; i++) { /* the coordinate before = in --force-on */
        const char *text = o->list[3].value[i];
        const size_t on = strtoul(text + strspn(text, " x"), NULL, 10);
        d = on > d && on <= 10000 ? on : d;
    }
    return d;
}

/* ---- values ---- */

const fvi_option_values *fvi_dampers_typed(const fvi_options *o)
{
    return &o->list[0];
}

int fvi_potential_in_time(fvi_options *o, size_t d)
{
    const char *text = o->text[POTENTIAL];
    const size_t most = fvi_largest_index(text);
    if (o->text[DIMENSION] && most > d)
        return 0;
    d = larger_count(most, d);
    const fvi_mechanism_texts texts = { .constraints = 1, .constraint = &text };
    fvi_typed_mechanism *m = NULL;
    if (d == 0 || fvi_parse_mechanism(&texts, d, &o->lets, &m, NULL))
        return 0;
    fvi_typed_mechanism_free(m);
    o->potential.kind = FVI_POTENTIAL_FREE;
    o->potential_has_time = 1;
    o->d = d;
    o->numbered = d > 1;
    return 1;
}

/* Return L = sum m v^2/2 - U(x, t) as a text, with the masses in digits that read back to the same double. The caller
 * frees it. NULL if there is no memory. */
static char *lagrangian_of_potential(const fvi_options *o)
{
    const size_t size = strlen(o->text[POTENTIAL]) + 60 * o->d + 8;
    char *text = malloc(size);
    size_t used = 0;
    for (size_t i = 0; text && i < o->d; i++)
        used += (size_t)snprintf(text + used, size - used, "%.17g*v%zu^2/2+",
                                 o->mass[i], i + 1);
    if (text)
        snprintf(text + used - 1, size - used + 1, "-(%s)", o->text[POTENTIAL]);
    return text;
}

int fvi_problem_mechanism(fvi_options *o, fvi_error *c)
{
    char **made = NULL, *in_time = NULL;
    if (!wants_mechanism(o) || o->directory) /* a folder has its own dampers */
        return 0;
    if (o->potential_has_time && !(in_time = lagrangian_of_potential(o)))
        return fvi_no_memory(c, NULL);
    fvi_mechanism_texts texts = { .lagrangian = in_time ? in_time
                                                        : o->text[LAGRANGIAN],
                                  .dampers = o->list[0].count,
                                  .damper = o->list[0].value,
                                  .constraints = o->list[1].count,
                                  .constraint = o->list[1].value,
                                  .imposed = o->list[2].count,
                                  .impose = o->list[2].value,
                                  .forces_on = o->list[3].count,
                                  .force_on = o->list[3].value };
    int status = 0;
    if (!o->text[DAMPER] && !o->text[LAGRANGIAN]) {
        status = fvi_damper_texts(o->d, o->rho, o->alpha, o->text[DAMPING],
                                  o->text[DERIVATIVE], &texts.dampers, &made, c);
        texts.damper = (const char *const *)made;
        for (size_t i = 0; i < o->d; i++)
            o->rho[i] = 0; /* rho is now in the dampers */
    }
    if (!status)
        status = fvi_parse_mechanism(&texts, o->d, &o->lets, &o->mechanism, c);
    free(made);
    free(in_time);
    return status;
}

int fvi_problem_events(fvi_options *o, fvi_error *c)
{
    const fvi_option_values *list = &o->list[FVI_OF_MECHANISM];
    const int status = o->text[EVENT] ? fvi_parse_events(list->count, list->value, o->d, o->mass,
                                                         &o->lets, &o->events, c)
                                      : 0;
    if (!status && o->mechanism)
        fvi_typed_events_of(o->events, fvi_mechanism_typed(o->mechanism));
    return status;
}

int fvi_check_events(const fvi_options *o, fvi_error *c)
{
    const unsigned sums = FVI_OBSERVE_FORCE | FVI_OBSERVE_IMPULSE | FVI_OBSERVE_WORK;
    const char *columns = o->text[o->text[REDUCE] ? REDUCE : COLUMNS];
    if (!o->text[EVENT])
        return 0;
    if (o->method != &fvi_variable_step)
        return fvi_refuse(c, "event", "'%s' is not for %s; fvi-adaptive has events", o->text[EVENT], o->method->name);
    if (fvi_kernel_growth(&o->damping.law) > 1 && o->text[DAMPING]
        && strstr(o->text[EVENT], " impact:"))
        return fvi_refuse(c, "event", "'%s': fvi-adaptive takes no impact with a law "
                          "that grows faster than s", o->text[EVENT]);
    for (size_t i = 0; i < o->columns.count; i++)
        if (o->columns.at[i] == FVI_COLUMN_Y)
            return fvi_refuse(c, "event", "column y needs every row");
    return fvi_typed_columns_wanted(o->typed) & sums && !o->mechanism
               ? fvi_refuse(c, "columns", "'%s': a damper's force, impulse and work, and the "
                            "balance, are not known with --event", columns)
               : 0;
}

int fvi_problem_velocity(fvi_options *o, fvi_error *c)
{
    if (!o->text[V0])
        return 0;
    double *v = malloc(o->d * sizeof *v);
    if (!v)
        return fvi_no_memory(c, NULL);
    int status = fvi_read_numbers("v0", o->text[V0], -INFINITY, INFINITY, "()",
                                  o->d, v, c);
    const fvi_system system = fvi_options_system(o);
    if (!status)
        status = fvi_momentum_of_velocity(&system, 0, o->x0, v, o->p0);
    for (size_t i = 0; i < o->d && !status; i++)
        if (!isfinite(o->p0[i]))
            status = fvi_refuse(c, "v0", "'%s': the momentum at x0 is not finite", o->text[V0]);
    if (!status)
        status = fvi_check_start_velocity(&system, o->x0, v, o->p0, c);
    free(v);
    return status;
}
