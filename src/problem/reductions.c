/* src/problem/reductions.c -- Reduce a column over a run to one number: max(x), at(peak(v)). */
#include "columns_state.h"
#include "words.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* In the order of fvi_reduction_kind. */
static const char *const kinds[] = { "min",  "max",   "absmax", "mean", "rms",
                                     "last", "first", "peak",   "at",   NULL };

/* ---- words ---- */

/* Find the text between the parentheses of WHAT(...). Return nonzero if the last one ends the text. */
static int text_in_parentheses(const char *text, size_t length, size_t word,
                               const char **from, size_t *inner)
{
    int depth = 0;
    for (size_t n = word; n < length; n++) {
        depth += (text[n] == '(') - (text[n] == ')');
        if (depth == 0 && n + 1 < length)
            return 0; /* more text comes after it */
    }
    *from = text + word + 1;
    *inner = length - word - 2;
    return word < length && text[word] == '(' && text[length - 1] == ')';
}

static void trim(const char **text, size_t *length)
{
    for (; *length > 0 && **text == ' '; ++*text)
        --*length;
    while (*length > 0 && (*text)[*length - 1] == ' ')
        --*length;
}

static int refuse(const char *text, size_t length, fvi_error *error)
{
    char place[64] = "";
    const size_t word = strcspn(text, "(");
    const char *hint = kinds[fvi_scan_word(text, word, kinds)]
                           ? "" /* the word is right, and what follows is not */
                           : fvi_word_hint(text, word, kinds, place);
    return fvi_refuse(error, "reduce", "'%.*s' is not min, max, absmax, mean, rms, last, first or peak of an "
                      "expression, in parentheses, nor at(...) of one%s", length < 80 ? (int)length : 80, text, hint);
}

/* Parse a call such as "max(x2-x1)", without a name before it. */
static int parse_call(const char *text, size_t length,
                      fvi_user_parameters *parameters, fvi_typed_columns *c,
                      fvi_reduction *r, fvi_error *error)
{
    const char *from;
    size_t inner;
    trim(&text, &length);
    const char *open = memchr(text, '(', length);
    const size_t word = open ? (size_t)(open - text) : length;
    const fvi_reduction_kind kind =
        (fvi_reduction_kind)fvi_scan_word(text, word, kinds);
    if (!kinds[kind] || !text_in_parentheses(text, length, word, &from, &inner)
        || (kind == REDUCE_AT && r->wants_time))
        return refuse(text, length, error);
    if (kind == REDUCE_AT) {
        r->wants_time = 1;
        return parse_call(from, inner, parameters, c, r, error);
    }
    r->kind = kind;
    if (r->wants_time && (kind == REDUCE_MEAN || kind == REDUCE_RMS))
        return fvi_refuse(error, "reduce", "'%.*s' has no time of its own", length < 80 ? (int)length : 80, text);
    if (fvi_list_item(from) < inner || memchr(from, '=', inner))
        return fvi_refuse(error, "reduce", "'%.*s' takes one expression", length < 80 ? (int)length : 80, text);
    return fvi_parse_column_item("reduce", from, inner, parameters, c, &r->of, error);
}

static int add_reduction(fvi_typed_columns *c, fvi_reduction r,
                         fvi_error *error)
{
    fvi_reduction *more =
        realloc(c->reduction, (c->reductions + 1) * sizeof *more);
    if (!more)
        return fvi_no_memory(error, NULL);
    c->reduction = more;
    c->reduction[c->reductions++] = r;
    return FVI_SUCCESS;
}

/* Name the reduction: with the name that was given, or with its text. */
static int name_reduction(const char *text, size_t length, fvi_typed_columns *c,
                          fvi_reduction *r, fvi_error *error)
{
    free(r->of.name);
    r->of.name = fvi_trimmed_copy(text, length);
    if (!r->of.name)
        return fvi_no_memory(error, NULL);
    for (size_t i = 0; i < c->reductions; i++)
        if (strcmp(c->reduction[i].of.name, r->of.name) == 0)
            return fvi_refuse(error, "reduce", "'%s' is asked for twice", r->of.name);
    return FVI_SUCCESS;
}

static int parse_item(const char *at, size_t length,
                      fvi_user_parameters *parameters, fvi_typed_columns *c,
                      fvi_error *error)
{
    const char *equals = memchr(at, '=', strcspn(at, "(") < length
                                             ? strcspn(at, "(")
                                             : length),
               *call = equals ? equals + 1 : at;
    fvi_reduction r = { .kind = REDUCE_MIN };
    int status = parse_call(call, length - (size_t)(call - at), parameters, c,
                            &r, error);
    if (!status)
        status = name_reduction(at, equals ? (size_t)(equals - at) : length, c,
                                &r, error);
    if (!status && equals && !fvi_symbol_is_free(r.of.name, "x"))
        status = fvi_refuse(error, "reduce", "'%s' is not a name for a column", r.of.name);
    if (!status)
        status = add_reduction(c, r, error);
    if (status) {
        free(r.of.name);
        fvi_expression_free(r.of.expression);
    }
    return status;
}

int fvi_parse_reductions(const char *text, fvi_user_parameters *parameters,
                         fvi_typed_columns *c, fvi_error *error)
{
    int status = FVI_SUCCESS;
    if (!text || !c)
        return fvi_fail(error, FVI_EFAULT, "reduce", NAN, "null pointer");
    for (const char *at = text; at && !status;) {
        const size_t length = fvi_list_item(at);
        status = parse_item(at, length, parameters, c, error);
        at = at[length] ? at + length + 1 : NULL;
    }
    return status;
}

size_t fvi_reductions_count(const fvi_typed_columns *c)
{
    return c->reductions;
}

const char *fvi_reduction_name(const fvi_typed_columns *c, size_t i)
{
    return c->reduction[i].of.name;
}

/* ---- sums ---- */

static void set_best(fvi_reduction_state *s, double value, double t)
{
    s->best = value;
    s->time = t;
}

/* If the middle one of the last two values and q is the largest, replace it by the top of the parabola through the
 * three. */
static void refine_peak(fvi_reduction_state *s, double t, double q)
{
    const double sign = s->q[1] < 0 ? -1 : 1, u0 = sign * s->q[0],
                 u1 = sign * s->q[1], u2 = sign * q;
    if (!(u1 >= u0 && u1 >= u2))
        return;
    const double slope = (u1 - u0) / (s->t[1] - s->t[0]),
                 bend = ((u2 - u1) / (t - s->t[1]) - slope) / (t - s->t[0]);
    if (!(bend < 0))
        return;
    const double top = (s->t[0] + s->t[1]) / 2 - slope / (2 * bend),
                 value = u0 + slope * (top - s->t[0])
                         + bend * (top - s->t[0]) * (top - s->t[1]);
    if (value > s->best)
        set_best(s, value, top);
}

static void add_value(fvi_reduction *r, double t, double q)
{
    fvi_reduction_state *s = &r->state;
    const int is_first = s->count == 0;
    const double f = r->kind == REDUCE_RMS ? q * q : q,
                 before = r->kind == REDUCE_RMS ? s->q[1] * s->q[1] : s->q[1];
    if (!is_first)
        s->integral += (t - s->t[1]) * (f + before) / 2;
    if (is_first || r->kind == REDUCE_LAST
        || (r->kind == REDUCE_MIN && q < s->best)
        || (r->kind == REDUCE_MAX && q > s->best))
        set_best(s, q, t);
    if ((r->kind == REDUCE_ABSMAX || r->kind == REDUCE_PEAK)
        && (is_first || fabs(q) > s->best))
        set_best(s, fabs(q), t);
    if (r->kind == REDUCE_PEAK && s->count >= 2)
        refine_peak(s, t, q);
    s->q[0] = s->q[1];
    s->t[0] = s->t[1];
    s->q[1] = q;
    s->t[1] = t;
    s->count++;
}

int fvi_reductions_add(fvi_typed_columns *c, double t)
{
    for (size_t i = 0; i < c->reductions; i++) {
        fvi_reduction *r = &c->reduction[i];
        const double q = fvi_expression_value(r->of.expression, c->value);
        if (!isfinite(q))
            return FVI_EOVRFLW;
        if (r->state.count == 0 || t > r->state.t[1])
            add_value(r, t, q);
    }
    return FVI_SUCCESS;
}

void fvi_reductions_values(const fvi_typed_columns *c, double *values)
{
    for (size_t i = 0; i < c->reductions; i++) {
        const fvi_reduction *r = &c->reduction[i];
        const fvi_reduction_state *s = &r->state;
        const double length = s->t[1] - s->time,
                     mean = length > 0 ? s->integral / length : s->best;
        values[i] = r->wants_time             ? s->time
                    : r->kind == REDUCE_MEAN ? mean
                    : r->kind == REDUCE_RMS
                        ? (length > 0 ? sqrt(mean) : fabs(s->best))
                        : s->best;
    }
}

int fvi_reductions_archive(fvi_typed_columns *c, fvi_archive *archive)
{
    int status = FVI_SUCCESS;
    for (size_t i = 0; i < c->reductions && !status; i++)
        status = archive->serialize(archive, &c->reduction[i].state,
                                    sizeof c->reduction[i].state, 0);
    return status;
}
