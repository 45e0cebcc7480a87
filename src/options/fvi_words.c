/* src/options/fvi_words.c -- From the words of a command line to values. */
#include "fvi_words.h"
#include "input/fvi_data.h"
#include "fvi_format_double.h"
#include "system/lines.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* ---- numbers ---- */

/* A finite number that ends at the end of the text or before `end`. What a number is, tables
 * and options ask the same function; the text stays, as its point is no comma. */
static int number(const char *text, char end, double *value, const char **rest)
{
    *rest = fvi_lines_decimal((char *)text, '.', value);
    return *rest && (**rest == '\0' || (end && **rest == end));
}

/* Is v of the range? See fvi_word_number. */
static int within(double v, double low, double high, const char *brackets)
{
    return (brackets[0] == '[' ? v >= low : v > low)
           && (brackets[1] == ']' ? v <= high : v < high);
}

int fvi_word_number(const char *name, const char *text, double low, double high,
                    const char *brackets, double *value, fvi_complaint c)
{
    const char *rest;
    double v;
    if (!number(text, '\0', &v, &rest))
        return fvi_refuse(c, "--%s: '%s' is not a finite decimal number", name,
                          text);
    if (!within(v, low, high, brackets))
        return fvi_refuse(c, "--%s: '%s' is outside %c%g, %g%c", name, text,
                          brackets[0], low, high, brackets[1]);
    *value = v;
    return 0;
}

int fvi_word_whole(const char *name, const char *text, size_t most,
                   size_t *value, fvi_complaint c)
{
    double v = 0; /* from 2^53 on it may be the neighbour of what was typed */
    int status = fvi_word_number(name, text, 1, fmin((double)most, 0x1p53 - 1),
                                 "[]", &v, c);
    if (!status && v != floor(v))
        return fvi_refuse(c, "--%s: '%s' is not a whole number", name, text);
    if (!status)
        *value = (size_t)v;
    return status;
}

/* ---- words ---- */

int fvi_word_once(const char *dashes, const char *name, const char **text,
                  const char *value, fvi_complaint c)
{
    if (*text && strcmp(*text, value) != 0)
        return fvi_refuse(c, "%s%s: given twice, as '%s' and as '%s'", dashes,
                          name, *text, value);
    *text = value;
    return 0;
}

int fvi_word_choice(const char *name, const char *text,
                    const char *const *words, size_t *which, fvi_complaint c)
{
    char known[320] = "", place[64];
    for (size_t i = 0; words[i]; i++) {
        if (strcasecmp(text, words[i]) == 0) {
            *which = i;
            return 0;
        }
        size_t end = strlen(known);
        snprintf(known + end, sizeof known - end, "%s%s", i ? ", " : "",
                 words[i]);
    }
    return fvi_refuse(c, "--%s: '%s' is none of %s%s", name, text, known,
                      fvi_word_hint(text, strlen(text), words, place));
}

/* "1,2,3" into at most d values; how many there are, or 0. */
static size_t numbers_of(const char *text, size_t d, double *values)
{
    const char *at = text;
    for (size_t n = 0;; at++) {
        double value;
        if (!number(at, ',', &value, &at))
            return 0;
        if (n < d)
            values[n] = value;
        n++;
        if (*at == '\0')
            return n;
    }
}

int fvi_word_list(const char *name, const char *text, double low, double high,
                  const char *brackets, size_t d, double *values,
                  fvi_complaint c)
{
    size_t n = 0;
    if (*text == '@') {
        int status = fvi_data_numbers(name, text + 1, d, values, &n, c);
        if (status)
            return status;
    } else {
        n = numbers_of(text, d, values);
        if (n == 0)
            return fvi_refuse(c, "--%s: '%s' is not a %sfinite decimal number%s",
                              name, text, d > 1 ? "list of " : "",
                              d > 1 ? "s" : "");
    }
    for (size_t j = 1; n == 1 && j < d; j++)
        values[j] = values[0];
    if (n != 1 && n != d)
        return fvi_refuse(c, "--%s: '%s' has %zu numbers, not %s%zu", name,
                          text, n, d > 1 ? "1 or " : "", d);
    char wrong[32];
    for (size_t j = 0; j < d; j++)
        if (!within(values[j], low, high, brackets)) {
            fvi_format_double(values[j], wrong);
            return fvi_refuse(c, "--%s: '%s' is outside %c%g, %g%c", name,
                              wrong, brackets[0], low, high, brackets[1]);
        }
    return 0;
}

int fvi_word_call(const char *text, const char *word, int count, double *p)
{
    size_t length = strlen(word);
    if (strncasecmp(text, word, length) != 0)
        return 0;
    text += length;
    for (int n = 0; n < count; n++)
        if (*text != (n ? ',' : ':') || !number(text + 1, ',', &p[n], &text))
            return 0;
    return *text == '\0';
}

/* In the order of fvi_potential_kind. */
static const char *const potentials[] = { "harmonic", "duffing", "pendulum",
                                          "free",     "chain",   NULL };

const char *fvi_word_near_potential(const char *text)
{
    return fvi_word_nearest(text, strcspn(text, ":"), potentials);
}

int fvi_word_potential(const char *text, fvi_potential_kind *kind, size_t *d,
                       double spring[2], fvi_complaint c)
{
    static const char *const forms[] = { "harmonic:C", "duffing:C,G",
                                         "pendulum:G", "free", "chain:D,C,G" };
    static const int parameters[] = { 1, 2, 1, 0, 3 };
    const size_t length = strcspn(text, ":");
    double p[3] = { 0 };
    size_t i = 0;
    while (potentials[i]
           && (strlen(potentials[i]) != length
               || strncasecmp(text, potentials[i], length) != 0))
        i++;
    *kind = potentials[i] ? (fvi_potential_kind)i : FVI_POTENTIAL_EXPRESSION;
    char place[64];
    if (!potentials[i] && text[length])
        return fvi_refuse(c,
                          "--potential: '%s' is none of harmonic:C, "
                          "duffing:C,G, pendulum:G, free, chain:D,C,G%s",
                          text, fvi_word_hint(text, length, potentials, place));
    spring[0] = 1; /* a harmonic one without a number */
    if (!potentials[i] || (i == FVI_POTENTIAL_HARMONIC && !text[length]))
        return 0;
    if (!fvi_word_call(text, potentials[i], parameters[i], p))
        return fvi_refuse(c, "--potential: '%s' is not %s", text, forms[i]);
    const int chain = *kind == FVI_POTENTIAL_CHAIN;
    if (chain && !(p[0] >= 1 && p[0] <= 1000000 && p[0] == floor(p[0])))
        return fvi_refuse(
            c, "--potential: a chain has 1 to 1000000 masses, not '%s'", text);
    if (chain)
        *d = (size_t)p[0];
    memcpy(spring, chain ? p + 1 : p, 2 * sizeof *spring);
    return 0;
}

int fvi_word_force(const char *text, fvi_forcing *kind, double forcing[2])
{
    if (strcasecmp(text, "none") == 0)
        *kind = FVI_FORCING_NONE;
    else if (fvi_word_call(text, "step", 2, forcing))
        *kind = FVI_FORCING_STEP;
    else if (fvi_word_call(text, "cosine", 2, forcing))
        *kind = FVI_FORCING_COSINE;
    else
        return 0;
    return 1;
}

const char *const fvi_column_names[] = { "t", "x", "p", "energy", "y", NULL };

int fvi_word_columns(const char *text, fvi_columns *columns, fvi_complaint c)
{
    const char *const *known = fvi_column_names;
    const char *at = text;
    char place[64];
    for (;; at++) {
        size_t length = strcspn(at, ","), i = 0;
        while (i < FVI_ALL_COLUMNS
               && (strlen(known[i]) != length
                   || strncasecmp(at, known[i], length)))
            i++;
        if (i == FVI_ALL_COLUMNS)
            return fvi_refuse(c,
                              "--columns: '%.*s' in '%s' is none of "
                              "t, x, p, energy, y%s",
                              length < 40 ? (int)length : 40, at, text,
                              fvi_word_hint(at, length, known, place));
        for (size_t n = 0; n < columns->count; n++)
            if (columns->at[n] == (fvi_column)i)
                return fvi_refuse(c, "--columns: '%s' names %s twice", text,
                                  known[i]);
        columns->at[columns->count++] = (fvi_column)i;
        at += length;
        if (*at == '\0')
            return 0;
    }
}
