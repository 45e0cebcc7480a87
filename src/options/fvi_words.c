/* src/options/fvi_words.c -- Words of the command line that only the program knows. */
#include "fvi_words.h"

#include <string.h>
#include <strings.h>

int fvi_word_once(const char *dashes, const char *name, const char **text,
                  const char *value, fvi_error *c)
{
    if (*text && strcmp(*text, value) != 0)
        return fvi_refuse(c, NULL, "%s%s: given twice, as '%s' and as '%s'", dashes,
                          name, *text, value);
    *text = value;
    return 0;
}

const char *const fvi_column_names[] = { "t", "x", "p", "energy", "y", NULL };

int fvi_word_columns(const char *text, fvi_columns *columns, fvi_error *c)
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
                              "columns", "'%.*s' in '%s' is none of "
                              "t, x, p, energy, y%s",
                              length < 40 ? (int)length : 40, at, text,
                              fvi_word_hint(at, length, known, place));
        for (size_t n = 0; n < columns->count; n++)
            if (columns->at[n] == (fvi_column)i)
                return fvi_refuse(c, "columns", "'%s' names %s twice", text,
                                  known[i]);
        columns->at[columns->count++] = (fvi_column)i;
        at += length;
        if (*at == '\0')
            return 0;
    }
}
