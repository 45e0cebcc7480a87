/* src/problem/parse.c -- Parse numbers, lists and words. */
#include "words.h"
#include "data.h"
#include "system/lines.h"
#include "system/fail.h"
#include "system/larger.h"

#include <fvi/format_double.h>
#include <fvi/methods.h>

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

const char *const fvi_initial_history_words[] = { "held", "caputo", "rl",
                                                  NULL };
const char *const fvi_history_words[] = { "auto", "direct", "exponentials",
                                          NULL };

/* ---- numbers ---- */

/* Scan a number that ends at the end of the text or before `end`, and find where it ends. Tables and options use the
 * same function for numbers. It changes the text only for a decimal comma, so this text stays. */
static int scan_number(const char *text, char end, double *value, const char **rest)
{
    *rest = fvi_lines_decimal((char *)text, '.', value);
    return *rest && (**rest == '\0' || (end && **rest == end));
}

/* Return nonzero if v is in the range; see fvi_parse_number. */
static int is_within(double v, double low, double high, const char *brackets)
{
    return (brackets[0] == '[' ? v >= low : v > low)
           && (brackets[1] == ']' ? v <= high : v < high);
}

static int refuse_outside(const char *field, const char *text, double v,
                          double low, double high, const char *brackets,
                          fvi_error *error)
{
    return fvi_fail(error, FVI_EDOM, field, v, "'%s' is outside %c%g, %g%c",
                    text, brackets[0], low, high, brackets[1]);
}

int fvi_parse_number(const char *field, const char *text, double low,
                     double high, const char *brackets, double *value,
                     fvi_error *error)
{
    const char *rest;
    double v;
    if (!text || !brackets || !value)
        return fvi_fail(error, FVI_EFAULT, field, NAN, "null pointer");
    if (!scan_number(text, '\0', &v, &rest))
        return fvi_refuse(error, field, "'%s' is not a finite decimal number", text);
    if (!is_within(v, low, high, brackets))
        return refuse_outside(field, text, v, low, high, brackets, error);
    *value = v;
    return FVI_SUCCESS;
}

int fvi_parse_whole(const char *field, const char *text, size_t most,
                    size_t *value, fvi_error *error)
{
    double v = 0; /* the limit is below 2^53, because from there on v may be the neighbour of the typed number */
    int status = fvi_parse_number(field, text, 1,
                                  fmin((double)most, 0x1p53 - 1), "[]", &v,
                                  error);
    if (!status && v != floor(v))
        return fvi_fail(error, FVI_EDOM, field, v, "'%s' is not a whole number", text);
    if (!status)
        *value = (size_t)v;
    return status;
}

/* Scan "1,2,3" into at most d values. Return how many numbers there are, or 0 if the text is no list. */
static size_t scan_numbers(const char *text, size_t d, double *values)
{
    const char *at = text;
    for (size_t n = 0;; at++) {
        double value;
        if (!scan_number(at, ',', &value, &at))
            return 0;
        if (n < d)
            values[n] = value;
        n++;
        if (*at == '\0')
            return n;
    }
}

/* Refuse a number that is out of the range. */
static int check_range(const char *field, double low, double high, const char *brackets, size_t d,
                       const double *values, fvi_error *error)
{
    char wrong[32];
    for (size_t j = 0; j < d; j++)
        if (!is_within(values[j], low, high, brackets)) {
            fvi_format_double(values[j], wrong);
            return fvi_at_index(error, j, refuse_outside(field, wrong, values[j], low, high, brackets, error));
        }
    return FVI_SUCCESS;
}

int fvi_parse_numbers(const char *field, const char *text, double low,
                      double high, const char *brackets, size_t d,
                      double *values, fvi_error *error)
{
    size_t n = 0;
    if (!text || !brackets || !values)
        return fvi_fail(error, FVI_EFAULT, field, NAN, "null pointer");
    if (*text == '@') {
        double *all;
        const int status = fvi_data_numbers(field, text + 1, &n, &all, error);
        for (size_t j = 0; j < n && j < d; j++)
            values[j] = all[j];
        free(all);
        if (status)
            return status;
    } else {
        n = scan_numbers(text, d, values);
        if (n == 0)
            return fvi_refuse(error, field, "'%s' is not a %sfinite decimal number%s", text,
                            d > 1 ? "list of " : "", d > 1 ? "s" : "");
    }
    for (size_t j = 1; n == 1 && j < d; j++)
        values[j] = values[0];
    if (n != 1 && n != d)
        return fvi_fail(error, FVI_EINVAL, field, (double)n, "'%s' has %zu numbers, not %s%zu", text, n,
                        d > 1 ? "1 or " : "", d);
    return check_range(field, low, high, brackets, d, values, error);
}

int fvi_parse_list(const char *field, const char *text, double low, double high, const char *brackets,
                   size_t *count, double **values, fvi_error *error)
{
    if (!text || !brackets || !count || !values)
        return fvi_fail(error, FVI_EFAULT, field, NAN, "null pointer");
    *values = NULL;
    if (*text == '@') {
        const int status = fvi_data_numbers(field, text + 1, count, values, error);
        if (!status && *count == 0)
            return fvi_refuse(error, field, "'%s' has no numbers", text);
        return status ? status : check_range(field, low, high, brackets, *count, *values, error);
    }
    *count = 1;
    for (const char *at = text; *at; at++)
        *count += *at == ',';
    *values = malloc(*count * sizeof **values);
    return *values ? fvi_parse_numbers(field, text, low, high, brackets, *count, *values, error)
                   : fvi_no_memory(error, field);
}

int fvi_scan_call(const char *text, const char *word, int count, double *p)
{
    size_t length = strlen(word);
    if (strncasecmp(text, word, length) != 0)
        return 0;
    text += length;
    for (int n = 0; n < count; n++)
        if (*text != (n ? ',' : ':')
            || !scan_number(text + 1, ',', &p[n], &text))
            return 0;
    return *text == '\0';
}

size_t fvi_scan_index(const char *digits, size_t length, size_t most)
{
    size_t i = 0;
    if (length == 0 || length > 9 || *digits == '0')
        return most;
    for (size_t n = 0; n < length; n++) {
        if (!isdigit((unsigned char)digits[n]))
            return most;
        i = 10 * i + (size_t)(digits[n] - '0');
    }
    return i <= most ? i - 1 : most;
}

/* ---- words ---- */

size_t fvi_scan_word(const char *text, size_t length, const char *const *words)
{
    size_t i = 0;
    while (words[i]
           && (strlen(words[i]) != length
               || strncasecmp(text, words[i], length) != 0))
        i++;
    return i;
}

int fvi_parse_word(const char *field, const char *text,
                   const char *const *words, size_t *which, fvi_error *error)
{
    char known[320] = "", place[64];
    if (!text || !words || !which)
        return fvi_fail(error, FVI_EFAULT, field, NAN, "null pointer");
    const size_t found = fvi_scan_word(text, strlen(text), words);
    if (words[found]) {
        *which = found;
        return FVI_SUCCESS;
    }
    for (size_t i = 0; words[i]; i++) {
        size_t end = strlen(known);
        snprintf(known + end, sizeof known - end, "%s%s", i ? ", " : "",
                 words[i]);
    }
    return fvi_refuse(error, field, "'%s' is none of %s%s", text,
                    known, fvi_word_hint(text, strlen(text), words, place));
}

/* ---- the nearest known word ---- */

enum { LONGEST = 31 /* longest word that is compared */ };

/* Return how many letters must be inserted, deleted, replaced or swapped with their neighbour to turn the first n
 * letters of a into b (the distance of Damerau and Levenshtein). Capitals count as small letters. */
static size_t edit_distance(const char *a, size_t n, const char *b)
{
    size_t rows[3][LONGEST + 1], *before = rows[0], *last = rows[1],
                                 *now = rows[2];
    const size_t m = strlen(b);
    for (size_t j = 0; j <= m; j++)
        last[j] = j;
    for (size_t i = 1; i <= n; i++) {
        now[0] = i;
        for (size_t j = 1; j <= m; j++) {
            const int x = tolower((unsigned char)a[i - 1]), y = b[j - 1];
            now[j] =
                smaller_count(last[j - 1] + (x != y), 1 + smaller_count(last[j], now[j - 1]));
            if (i > 1 && j > 1 && x == b[j - 2]
                && y == tolower((unsigned char)a[i - 2]))
                now[j] = smaller_count(now[j], before[j - 2] + 1);
        }
        size_t *oldest = before;
        before = last;
        last = now;
        now = oldest;
    }
    return last[m];
}

size_t fvi_list_item(const char *text)
{
    int depth = 0;
    size_t n = 0;
    for (; text[n] && !(text[n] == ',' && depth == 0); n++)
        depth += (text[n] == '(') - (text[n] == ')');
    return n;
}

const char *fvi_nearest_word(const char *text, size_t length,
                             const char *const *words)
{
    /* Allow one error in up to four letters, and one more for each three further letters. A word that was not typed to
     * the end counts as one error. Something of the word must be left. */
    size_t best = smaller_count(length, 2 + (length > 4) * (length - 2) / 3);
    const char *nearest = NULL;
    for (; *words && length <= LONGEST; words++) {
        size_t far = strlen(*words) > LONGEST ? best
                     : strncasecmp(text, *words, length) == 0
                         ? 1
                         : edit_distance(text, length, *words);
        if (far < best) {
            best = far;
            nearest = *words;
        }
    }
    return nearest;
}

const char *fvi_word_hint(const char *text, size_t length,
                          const char *const *words, char place[64])
{
    const char *nearest = fvi_nearest_word(text, length, words);
    place[0] = '\0';
    if (nearest)
        snprintf(place, 64, "; did you mean %s?", nearest);
    return place;
}

int fvi_parse_method(const char *text, const fvi_method **method,
                     fvi_error *error)
{
    enum { MOST_METHODS = 63 };
    const char *words[MOST_METHODS + 1] = { NULL }; /* ended by NULL */
    size_t which;
    for (size_t i = 0; i < MOST_METHODS && fvi_methods[i]; i++)
        words[i] = fvi_methods[i]->name;
    const int status = fvi_parse_word("method", text, words, &which, error);
    if (!status)
        *method = fvi_methods[which];
    return status;
}
