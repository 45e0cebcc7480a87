/* src/input/fvi_refuse.c -- What is wrong with what was typed, in one line. */
#include "fvi_refuse.h"

#include <ctype.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* What was typed may be long, and what is wrong with it stands at the end: the middle
 * gives way. */
static void leave_out_the_middle(fvi_complaint c, size_t length,
                                 const char *format, va_list arguments)
{
    const size_t end = c.size / 2; /* so much of the end, its '\0' included */
    char *whole = malloc(length + 1);
    if (whole && c.size > 8) {
        vsnprintf(whole, length + 1, format, arguments);
        memcpy(c.text + c.size - end - 3, "...", 3);
        memcpy(c.text + c.size - end, whole + length + 1 - end, end);
    }
    free(whole);
}

int fvi_refuse(fvi_complaint c, const char *format, ...)
{
    va_list arguments, again;
    va_start(arguments, format);
    va_copy(again, arguments);
    const int length = vsnprintf(c.text, c.size, format, arguments);
    if (length > 0 && (size_t)length >= c.size)
        leave_out_the_middle(c, (size_t)length, format, again);
    va_end(again);
    va_end(arguments);
    for (char *t = c.text; *t; t++) /* one line, whatever was typed */
        if ((unsigned char)*t < ' ')
            *t = '?';
    return 2;
}

enum { BEFORE = 5, SHOWN = 60, AHEAD = 40 };

/* "--potential: 'x^^2': a number, a name or ( is wanted here", and a caret below the place
 * when "fvi: " stands before; of a long text what is around it. */
int fvi_refuse_at(fvi_complaint c, const char *name, const char *text,
                  fvi_misprint wrong)
{
    const size_t length = strlen(text);
    const size_t from =
        length > SHOWN && wrong.at > AHEAD ? wrong.at - AHEAD : 0;
    const char *front = from > 0 ? "..." : "",
               *back = length - from > SHOWN ? "..." : "";
    fvi_refuse(c, "--%s: '%s%.*s%s': %s", name, front, SHOWN, text + from, back,
               wrong.reason);
    const size_t end = strlen(c.text), left = strlen(name) + strlen(front);
    const size_t column = BEFORE + strlen("--: '") + left + wrong.at - from;
    if (length > 0 && end + column + 3 < c.size)
        snprintf(c.text + end, c.size - end, "\n%*s^", (int)column, "");
    return 2;
}

/* ---- the nearest known word ---- */

enum { LONGEST = 31 /* letters of a word that is compared */ };

static size_t least(size_t a, size_t b)
{
    return a < b ? a : b;
}

/* How many letters have to be put in, left out, changed or swapped with their
 * neighbour to make b of the first n letters of a; capitals count as small ones. */
static size_t distance(const char *a, size_t n, const char *b)
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
                least(last[j - 1] + (x != y), 1 + least(last[j], now[j - 1]));
            if (i > 1 && j > 1 && x == b[j - 2]
                && y == tolower((unsigned char)a[i - 2]))
                now[j] = least(now[j], before[j - 2] + 1);
        }
        size_t *oldest = before;
        before = last;
        last = now;
        now = oldest;
    }
    return last[m];
}

const char *fvi_word_nearest(const char *text, size_t length,
                             const char *const *words)
{
    /* One slip in up to four letters; a beginning is one, too. Something of the
     * word must be left. */
    size_t best = least(length, 2 + (length > 4) * (length - 2) / 3);
    const char *nearest = NULL;
    for (; *words && length <= LONGEST; words++) {
        size_t far = strlen(*words) > LONGEST ? best
                     : strncasecmp(text, *words, length) == 0
                         ? 1
                         : distance(text, length, *words);
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
    const char *nearest = fvi_word_nearest(text, length, words);
    place[0] = '\0';
    if (nearest)
        snprintf(place, 64, "; did you mean %s?", nearest);
    return place;
}

int fvi_refuse_option(fvi_complaint c, const char *given,
                      const char *const *names)
{
    const char *word = given + strspn(given, "-"),
               *nearest = fvi_word_nearest(word, strcspn(word, "="), names);
    return fvi_refuse(c, "%s: no such option%s%s%s", given,
                      nearest ? "; did you mean --" : "",
                      nearest ? nearest : "", nearest ? "?" : "");
}
