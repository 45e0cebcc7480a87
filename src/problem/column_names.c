/* src/problem/column_names.c -- Find the quantity of a column by its name. */
#include "columns_state.h"
#include "words.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Plain names, in the order of fvi_quantity_kind: one number, or one for each coordinate. */
static const struct {
    const char *name;
    int is_vector;
} plain[] = { { "t", 0 },      { "x", 1 },    { "p", 1 },
              { "v", 1 },      { "a", 1 },    { "F", 1 },
              { "energy", 0 }, { "work", 0 }, { "balance", 0 },
              { "ag", 0 } };
enum { PLAIN = sizeof plain / sizeof *plain };

static const char *const of_damper[] = { "force", "impulse", "work" };

static int is_word(const char *name, size_t length, const char *word)
{
    return strlen(word) == length && strncmp(name, word, length) == 0;
}

static size_t damper_count(const fvi_typed_columns *c)
{
    return c->source->mechanism ? c->source->mechanism->damper_count : 1;
}

size_t fvi_quantity_width(const fvi_typed_columns *c, const fvi_quantity *q)
{
    const fvi_mechanism *m = c->source->mechanism;
    if (q->kind == QUANTITY_MULTIPLIER)
        return m->constraints->count;
    if (q->kind == QUANTITY_DAMPER_WORK || q->kind == QUANTITY_REACTION
        || q->kind == QUANTITY_EVENT_COUNT || q->kind == QUANTITY_EVENT_LAST
        || q->kind == QUANTITY_CONTACT)
        return 1;
    return (q->kind == QUANTITY_FORCE || q->kind == QUANTITY_IMPULSE) && m
                   && !(c->source->is_structure && m->damper[q->j].matrix)
               ? 1
               : c->source->d;
}

/* Find the damper whose name stands before the point. */
static int damper_named(const fvi_typed_columns *c, const char *name,
                        size_t length, size_t *j)
{
    for (*j = 0; *j < damper_count(c); ++*j) {
        const char *given = c->source->mechanism
                                ? c->source->mechanism->damper[*j].name
                                : NULL;
        char own[24];
        snprintf(own, sizeof own, "d%zu", *j + 1);
        if (is_word(name, length, given ? given : own))
            return 1;
    }
    return 0;
}

/* Find a name such as "d1.force" or "d1.force3". */
static int find_damper_quantity(const fvi_typed_columns *c, const char *name,
                                size_t length, fvi_quantity *q, int *is_all)
{
    const char *point = memchr(name, '.', length);
    if (!point || !damper_named(c, name, (size_t)(point - name), &q->j))
        return 0;
    const char *word = point + 1;
    const size_t left = length - (size_t)(word - name);
    for (size_t n = 0; n < 3; n++) {
        const size_t stem = strlen(of_damper[n]);
        if (left < stem || strncmp(word, of_damper[n], stem) != 0)
            continue;
        q->kind = (fvi_quantity_kind)(QUANTITY_FORCE + n);
        const size_t width = fvi_quantity_width(c, q);
        *is_all = left == stem && width > 1;
        q->i = left == stem ? 0 : fvi_scan_index(word + stem, left - stem, width);
        return q->i < width && (left == stem || q->kind != QUANTITY_DAMPER_WORK);
    }
    return 0;
}

/* Find "multiplier2", of a constraint, or "reaction3", of a coordinate that is prescribed. */
static int find_constraint_quantity(const fvi_typed_columns *c, const char *name,
                                    size_t length, fvi_quantity *q, int *is_all)
{
    static const char *const words[] = { "multiplier", "reaction" };
    const fvi_constraints *ties =
        c->source->mechanism ? c->source->mechanism->constraints : NULL;
    for (size_t n = 0; ties && n < 2; n++) {
        const size_t stem = strlen(words[n]), count = ties->count;
        if (length < stem || strncmp(name, words[n], stem) != 0)
            continue;
        q->kind = n ? QUANTITY_REACTION : QUANTITY_MULTIPLIER;
        *is_all = n == 0 && length == stem && count > 1;
        q->i = length == stem
                   ? 0
                   : fvi_scan_index(name + stem, length - stem, n ? c->source->d : count);
        if (n == 0)
            return q->i < count;
        const size_t coordinate = q->i + 1;
        for (q->i = 0; q->i < count && ties->imposed; q->i++)
            if (ties->imposed[q->i] == coordinate)
                return length > stem || c->source->d == 1;
        return 0;
    }
    return 0;
}

/* Find "event2.count", "event2.last" or "event2.force". */
static int find_event_quantity(const fvi_typed_columns *c, const char *name, size_t length,
                               fvi_quantity *q)
{
    static const char word[] = "event";
    const size_t stem = sizeof word - 1;
    const char *point = memchr(name, '.', length);
    if (!point || length < stem || strncmp(name, word, stem) != 0)
        return 0;
    const size_t before = (size_t)(point - name), left = length - before - 1;
    if (is_word(point + 1, left, "count"))
        q->kind = QUANTITY_EVENT_COUNT;
    else if (is_word(point + 1, left, "last"))
        q->kind = QUANTITY_EVENT_LAST;
    else if (is_word(point + 1, left, "force"))
        q->kind = QUANTITY_CONTACT;
    else
        return 0;
    q->i = fvi_scan_index(name + stem, before - stem, c->source->events);
    return q->i < c->source->events;
}

int fvi_find_quantity(const fvi_typed_columns *c, const char *name,
                    size_t length, fvi_quantity *q, int *is_all)
{
    const size_t d = c->source->d;
    *q = (fvi_quantity){ .kind = QUANTITY_TIME };
    *is_all = 0;
    for (size_t i = 0; i < c->columns; i++)
        if (c->column[i].is_given && is_word(name, length, c->column[i].name)) {
            *q = (fvi_quantity){ .kind = QUANTITY_COLUMN, .i = i };
            return 1;
        }
    for (size_t n = 0; n < PLAIN; n++) {
        const size_t stem = strlen(plain[n].name);
        if (n == QUANTITY_GROUND && !c->source->ground)
            continue;
        q->kind = (fvi_quantity_kind)n;
        if (is_word(name, length, plain[n].name)) {
            *is_all = plain[n].is_vector && (d > 1 || c->source->is_numbered);
            return 1;
        }
        if (plain[n].is_vector && length > stem
            && strncmp(name, plain[n].name, stem) == 0
            && (q->i = fvi_scan_index(name + stem, length - stem, d)) < d)
            return 1;
    }
    return find_constraint_quantity(c, name, length, q, is_all)
           || find_damper_quantity(c, name, length, q, is_all) || find_event_quantity(c, name, length, q);
}

/* ---- for expressions ---- */

static int add_quantity(fvi_typed_columns *c, fvi_quantity q)
{
    for (size_t n = 0; n < c->quantities; n++)
        if (c->quantity[n].kind == q.kind && c->quantity[n].i == q.i
            && c->quantity[n].j == q.j)
            return (int)n;
    fvi_quantity *more =
        realloc(c->quantity, (c->quantities + 1) * sizeof *more);
    if (more)
        c->quantity = more;
    double *values = realloc(c->value, (c->quantities + 1) * sizeof *values);
    if (values)
        c->value = values;
    if (!more || !values)
        return -2;
    c->quantity[c->quantities] = q;
    return (int)c->quantities++;
}

int fvi_find_or_add_quantity(const char *name, size_t length, void *columns)
{
    fvi_typed_columns *c = columns;
    fvi_quantity q;
    int is_all;
    if (!fvi_find_quantity(c, name, length, &q, &is_all)
        || (is_all && fvi_quantity_width(c, &q) > 1))
        return -1;
    return add_quantity(c, q);
}

/* ---- what is wrong with a name ---- */

/* Collect all names, so that the message can propose the nearest one. */
int fvi_refuse_unknown_column(const fvi_typed_columns *c, const char *word,
                       size_t length, fvi_error *error)
{
    enum { DAMPERS = 20 };
    const char *names[PLAIN + 6 + 3 * DAMPERS + 1];
    char own[3 * DAMPERS][80], place[64], damper[24], reaction[32] = "";
    size_t n = 0;
    for (; n < PLAIN; n++)
        names[n] = plain[n].name;
    if (!c->source->ground)
        n--;
    names[n++] = "y";
    const fvi_constraints *ties = c->source->mechanism ? c->source->mechanism->constraints : NULL;
    char of_ties[48] = "";
    if (ties) {
        names[n++] = "multiplier1";
        snprintf(of_ties, sizeof of_ties, ", multiplier1");
    }
    for (size_t i = 0; ties && ties->imposed && i < ties->count && !*reaction; i++)
        if (ties->imposed[i]) { /* the first coordinate that is prescribed; another has no reaction */
            snprintf(reaction, sizeof reaction, "reaction%zu", ties->imposed[i]);
            snprintf(of_ties, sizeof of_ties, ", multiplier1, %s", reaction);
            names[n++] = reaction;
        }
    if (c->source->events) {
        names[n++] = "event1.count";
        names[n++] = "event1.last";
        names[n++] = "event1.force";
    }
    for (size_t j = 0; j < damper_count(c) && j < DAMPERS; j++)
        for (size_t k = 0; k < 3; k++, n++) {
            const char *given = c->source->mechanism
                                    ? c->source->mechanism->damper[j].name
                                    : NULL;
            snprintf(damper, sizeof damper, "d%zu", j + 1);
            snprintf(own[3 * j + k], sizeof own[0], "%.60s.%s",
                     given ? given : damper, of_damper[k]);
            names[n] = own[3 * j + k];
        }
    names[n] = NULL;
    return fvi_refuse(error, "columns",
                      "'%.*s' is none of t, x, p, v, a, F, energy, work, balance, y%s%s%s, %s, nor an expression%s",
                      length < 40 ? (int)length : 40, word, c->source->ground ? ", ag" : "",
                      of_ties,
                      c->source->events ? ", event1.count, event1.last, event1.force" : "",
                      damper_count(c) > 0 ? names[n - 3] : "DAMPER.force", fvi_word_hint(word, length, names, place));
}
