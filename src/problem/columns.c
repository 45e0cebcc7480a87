/* src/problem/columns.c -- Parse and compute the columns of a table. */
#define _GNU_SOURCE /* for strndup */
#include "columns_state.h"
#include "words.h"
#include "system/fail.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Refuse a damper whose name is that of an event, because event1.force would be the force of either. */
static int check_damper_names(const fvi_column_source *source, fvi_error *error)
{
    static const char event[] = "event";
    const size_t stem = sizeof event - 1;
    for (size_t j = 0; source->mechanism && j < source->mechanism->damper_count; j++) {
        const char *name = source->mechanism->damper[j].name;
        if (name && strncmp(name, event, stem) == 0
            && fvi_scan_index(name + stem, strlen(name + stem), source->events) < source->events)
            return fvi_at_index(error, j, fvi_refuse(error, "damper", "'%s' is the name of an event in columns, as in "
                                                     "%s.force: give the damper another one", name, name));
    }
    return FVI_SUCCESS;
}

int fvi_typed_columns_start(const fvi_column_source *source,
                            fvi_typed_columns **columns, fvi_error *error)
{
    const int status = check_damper_names(source, error);
    if (status)
        return status;
    fvi_typed_columns *c = calloc(1, sizeof *c);
    if (!c)
        return fvi_no_memory(error, NULL);
    c->source = source;
    *columns = c;
    return FVI_SUCCESS;
}

/* Free what a column owns, but not the column itself. */
static void free_column(fvi_typed_column *column)
{
    free(column->name);
    fvi_expression_free(column->expression);
}

void fvi_typed_columns_free(fvi_typed_columns *c)
{
    for (size_t i = 0; c && i < c->columns; i++)
        free_column(&c->column[i]);
    for (size_t i = 0; c && i < c->reductions; i++)
        free_column(&c->reduction[i].of);
    if (c) {
        free(c->quantity);
        free(c->value);
        free(c->column);
        free(c->reduction);
    }
    free(c);
}

/* ---- words ---- */

/* Return nonzero if the character may stand in the name of a quantity, such as d1.force. */
static int is_name_character(char letter)
{
    return isalnum((unsigned char)letter) || letter == '_' || letter == '.';
}

/* Return nonzero if the text is a single word, so that an error can only concern its name. */
static int is_one_word(const char *text, size_t length)
{
    for (size_t n = 0; n < length; n++)
        if (!is_name_character(text[n]))
            return 0;
    return length > 0 && !isdigit((unsigned char)*text) && *text != '.';
}

/* Check that a column may have this name: it is no coordinate, function, parameter, quantity or other column. */
static int check_name(const char *field, const char *name,
                      const fvi_user_parameters *parameters,
                      const fvi_typed_columns *c, fvi_error *error)
{
    fvi_quantity q;
    int is_all;
    if (!fvi_symbol_is_free(name, "x") || strchr(name, '.'))
        return fvi_refuse(error, field, "'%s' is not a name for a column", name);
    for (size_t i = 0; parameters && i < parameters->count; i++)
        if (strcmp(parameters->name[i], name) == 0)
            return fvi_refuse(error, field, "'%s' is a parameter of --let, too", name);
    if (fvi_find_quantity(c, name, strlen(name), &q, &is_all)
        || strcmp(name, "y") == 0)
        return fvi_refuse(error, field, q.kind == QUANTITY_COLUMN
                            ? "'%s' is given to two columns"
                            : "'%s' is a quantity's own name; take another",
                        name);
    return FVI_SUCCESS;
}

/* Parse the expression of a column. A single word that means several numbers is refused. */
static int parse_column_expression(const char *field, const char *text,
                                   fvi_user_parameters *parameters, fvi_typed_columns *c,
                                   fvi_expression **e, fvi_error *error)
{
    const fvi_name_finder finder = { fvi_find_or_add_quantity, c };
    fvi_quantity q;
    int is_all;
    const size_t length = strlen(text);
    if (is_one_word(text, length)
        && fvi_find_quantity(c, text, length, &q, &is_all) && is_all
        && fvi_quantity_width(c, &q) > 1)
        return fvi_refuse(error, field, "'%s' of which coordinate? %s1 to %s%zu", text, text,
                        text, fvi_quantity_width(c, &q));
    return fvi_parse_expression_of(field, &finder, text, parameters, e, error);
}

char *fvi_trimmed_copy(const char *text, size_t length)
{
    while (length > 0 && isspace((unsigned char)*text)) {
        text++;
        length--;
    }
    while (length > 0 && isspace((unsigned char)text[length - 1]))
        length--;
    char *copy = strndup(text, length);
    for (char *at = copy; at && *at; at++)
        *at = isspace((unsigned char)*at) ? ' ' : *at;
    return copy;
}

int fvi_parse_column_item(const char *field, const char *text, size_t length,
                          fvi_user_parameters *parameters, fvi_typed_columns *c,
                          fvi_typed_column *column, fvi_error *error)
{
    const char *equals = memchr(text, '=', length);
    const char *begin = equals ? equals + 1 : text;
    char *right = fvi_trimmed_copy(begin, length - (size_t)(begin - text)),
         *name = fvi_trimmed_copy(text, equals ? (size_t)(equals - text) : length);
    *column = (fvi_typed_column){ .name = name, .is_given = equals != NULL };
    int status = right && name ? FVI_SUCCESS : fvi_no_memory(error, NULL);
    if (!status && equals)
        status = check_name(field, name, parameters, c, error);
    if (!status)
        status = parse_column_expression(field, right, parameters, c, &column->expression,
                            error);
    free(right);
    if (status) {
        free_column(column);
        *column = (fvi_typed_column){ NULL, NULL, 0 };
    }
    return status;
}

/* Append a column, which c owns from then on; on error it is freed. `list` is the whole list, for the message. */
static int add_column(fvi_typed_columns *c, fvi_typed_column column,
                      const char *list, fvi_error *error)
{
    for (size_t i = 0; i < c->columns; i++)
        if (strcmp(c->column[i].name, column.name) == 0) {
            fvi_refuse(error, "columns", "'%s' names %s twice", list, column.name);
            free_column(&column);
            return FVI_EINVAL;
        }
    fvi_typed_column *more =
        realloc(c->column, (c->columns + 1) * sizeof *more);
    if (!more) {
        free_column(&column);
        return fvi_no_memory(error, NULL);
    }
    c->column = more;
    c->column[c->columns++] = column;
    return FVI_SUCCESS;
}

/* Add a column for each number that a word means, as x1, x2, ... for x. If the user has chosen coordinates to be shown,
 * add only those. A name of more than 90 letters is cut. */
static int add_all_coordinates(const char *word, size_t length, fvi_quantity q,
                               const char *list, fvi_typed_columns *c, fvi_error *error)
{
    const int are_chosen =
        c->source->shown && q.kind != QUANTITY_MULTIPLIER
        && fvi_quantity_width(c, &q) == c->source->d;
    const size_t width =
        are_chosen ? c->source->shown_count : fvi_quantity_width(c, &q);
    int status = FVI_SUCCESS;
    for (size_t n = 0; n < width && !status; n++) {
        char name[120];
        fvi_typed_column column;
        snprintf(name, sizeof name, "%.*s%zu", length < 90 ? (int)length : 90,
                 word, 1 + (are_chosen ? c->source->shown[n] : n));
        status = fvi_parse_column_item("columns", name, strlen(name), NULL, c,
                                 &column, error);
        if (!status)
            status = add_column(c, column, list, error);
    }
    return status;
}

/* Add the columns of one item of the list: of a word, or of "NAME=EXPRESSION". */
static int add_item(const char *item, size_t length, const char *list,
                    fvi_user_parameters *parameters, fvi_typed_columns *c,
                    fvi_error *error)
{
    fvi_quantity q;
    fvi_typed_column column;
    int is_all;
    if (is_one_word(item, length)) {
        if (!fvi_find_quantity(c, item, length, &q, &is_all))
            return fvi_refuse_unknown_column(c, item, length, error);
        if (is_all)
            return add_all_coordinates(item, length, q, list, c, error);
    }
    const int status =
        fvi_parse_column_item("columns", item, length, parameters, c, &column, error);
    return status ? status : add_column(c, column, list, error);
}

int fvi_parse_columns(const char *text, fvi_user_parameters *parameters,
                      fvi_typed_columns *c, fvi_error *error)
{
    int status = FVI_SUCCESS;
    if (!text || !c)
        return fvi_fail(error, FVI_EFAULT, "columns", NAN, "null pointer");
    const char *item = text;
    while (item && !status) {
        const size_t length = fvi_list_item(item);
        status = add_item(item, length, text, parameters, c, error);
        item = item[length] ? item + length + 1 : NULL;
    }
    return status;
}

/* ---- values ---- */

unsigned fvi_typed_columns_wanted(const fvi_typed_columns *c)
{
    /* what an observer must compute; 0 for the other kinds, which a stepper has. The balance comes with the work */
    static const unsigned of_kind[] = {
        [QUANTITY_V] = FVI_OBSERVE_VELOCITY,
        [QUANTITY_A] = FVI_OBSERVE_ACCELERATION,
        [QUANTITY_APPLIED] = FVI_OBSERVE_APPLIED,
        [QUANTITY_ENERGY] = FVI_OBSERVE_ENERGY,
        [QUANTITY_WORK] = FVI_OBSERVE_WORK,
        [QUANTITY_BALANCE] = FVI_OBSERVE_WORK,
        [QUANTITY_FORCE] = FVI_OBSERVE_FORCE,
        [QUANTITY_IMPULSE] = FVI_OBSERVE_IMPULSE,
        [QUANTITY_DAMPER_WORK] = FVI_OBSERVE_WORK,
        [QUANTITY_MULTIPLIER] = FVI_OBSERVE_MULTIPLIER,
        [QUANTITY_REACTION] = FVI_OBSERVE_MULTIPLIER,
        [QUANTITY_CONTACT] = FVI_OBSERVE_CONTACT,
        [QUANTITY_COLUMN] = 0
    };
    unsigned wanted = 0;
    for (size_t n = 0; n < c->quantities; n++)
        wanted |= of_kind[c->quantity[n].kind];
    return wanted;
}

/* Compute the acceleration of the ground at t, or 0 without one. Return FVI_SUCCESS or the code of the ground. */
static int evaluate_ground(const fvi_typed_columns *c, double t, double *value)
{
    const fvi_force *ground = c->source->ground;
    *value = 0;
    return ground->value ? ground->value(t, 1, ground->params, value) : FVI_SUCCESS;
}

/* Return the work of all dampers. Without a mechanism there is one. */
static double sum_damper_work(const fvi_typed_columns *c,
                              const fvi_observation *now)
{
    const size_t dampers =
        c->source->mechanism ? c->source->mechanism->damper_count : 1;
    double sum = 0;
    for (size_t j = 0; j < dampers; j++)
        sum += now->work[j];
    return sum;
}

/* Return where force i of damper j stands among the forces of all dampers. */
static size_t force_index(const fvi_typed_columns *c, fvi_quantity q)
{
    size_t index = q.i;
    for (size_t j = 0; j < q.j; j++) {
        const fvi_quantity of_damper = { .kind = q.kind, .j = j, .i = q.i };
        index += fvi_quantity_width(c, &of_damper);
    }
    return index;
}

/* Return how often event i has happened, or the time of the last one. A lift-off does not count. */
static double event_value(const fvi_observation *now, fvi_quantity q)
{
    double count = 0, last = 0;
    for (size_t n = 0; n < now->events; n++)
        if (now->event[n].event == q.i && !now->event[n].lifts_off) {
            count++;
            last = now->event[n].t;
        }
    return q.kind == QUANTITY_EVENT_COUNT ? count : last;
}

/* Return the value of a quantity, except of the ground and of another column: the ground may fail, and a column has its
 * value only after it has been computed. */
static double quantity_value(const fvi_typed_columns *c, fvi_quantity q, const fvi_observation *now)
{
    switch (q.kind) {
    case QUANTITY_TIME:
        return now->t;
    case QUANTITY_X:
        return now->x[q.i];
    case QUANTITY_P:
        return now->p[q.i];
    case QUANTITY_V:
        return now->v[q.i];
    case QUANTITY_A:
        return now->a[q.i];
    case QUANTITY_APPLIED:
        return now->F[q.i];
    case QUANTITY_ENERGY:
        return now->energy;
    case QUANTITY_WORK:
        return sum_damper_work(c, now);
    case QUANTITY_BALANCE:
        return now->balance;
    case QUANTITY_FORCE:
        return now->force[force_index(c, q)];
    case QUANTITY_IMPULSE:
        return now->impulse[force_index(c, q)];
    case QUANTITY_DAMPER_WORK:
        return now->work[q.j];
    case QUANTITY_MULTIPLIER:
        return now->multiplier[q.i];
    case QUANTITY_REACTION:
        return -now->multiplier[q.i];
    case QUANTITY_CONTACT:
        return now->contact ? now->contact[q.i] : 0;
    case QUANTITY_EVENT_COUNT:
    case QUANTITY_EVENT_LAST:
        return event_value(now, q);
    case QUANTITY_GROUND:
    case QUANTITY_COLUMN:
        break;
    }
    return NAN;
}

int fvi_typed_columns_values(fvi_typed_columns *c, const fvi_observation *now,
                             double *row)
{
    int status = FVI_SUCCESS;
    for (size_t n = 0; n < c->quantities && !status; n++) {
        const fvi_quantity q = c->quantity[n];
        if (q.kind == QUANTITY_GROUND)
            status = evaluate_ground(c, now->t, &c->value[n]);
        else if (q.kind != QUANTITY_COLUMN) /* filled in below, when its column is computed */
            c->value[n] = quantity_value(c, q, now);
    }
    for (size_t i = 0; i < c->columns && !status; i++) {
        row[i] = fvi_expression_value(c->column[i].expression, c->value);
        for (size_t n = 0; n < c->quantities; n++)
            if (c->quantity[n].kind == QUANTITY_COLUMN && c->quantity[n].i == i)
                c->value[n] = row[i];
    }
    return status;
}

size_t fvi_typed_columns_count(const fvi_typed_columns *c)
{
    return c->columns;
}

const char *fvi_typed_column_name(const fvi_typed_columns *c, size_t i)
{
    return c->column[i].name;
}
