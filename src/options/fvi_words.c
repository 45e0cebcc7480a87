/* src/options/fvi_words.c -- Read the words of the command line that only the program knows. */
#define _GNU_SOURCE /* for strndup */
#include "fvi_words.h"

#include <stdlib.h>
#include <string.h>

int fvi_is_one_of(const char *word, const char *const *words)
{
    while (*words && strcmp(*words, word) != 0)
        words++;
    return *words != NULL;
}

int fvi_word_once(const char *dashes, const char *name, const char **text,
                  const char *value, fvi_error *c)
{
    if (*text && strcmp(*text, value) != 0)
        return fvi_refuse(c, NULL, "%s%s: given twice, as '%s' and as '%s'", dashes, name, *text, value);
    *text = value;
    return 0;
}

const char *const fvi_column_names[] = { "t", "x", "p", "energy", "y", NULL };

/* Add a column that is an expression or another name. */
static int parse_typed_column(const char *at, size_t length,
                              fvi_user_parameters *parameters, fvi_columns *columns,
                              fvi_typed_columns *typed, fvi_error *c)
{
    char *item = strndup(at, length);
    const size_t first = fvi_typed_columns_count(typed);
    if (!item)
        return fvi_no_memory(c, NULL);
    const int status = fvi_parse_columns(item, parameters, typed, c);
    free(item);
    columns->first[columns->count] = first;
    columns->width[columns->count] = fvi_typed_columns_count(typed) - first;
    return status;
}

int fvi_word_columns(const char *text, fvi_user_parameters *parameters,
                     fvi_columns *columns, fvi_typed_columns *typed,
                     fvi_error *c)
{
    for (const char *at = text;; at++) {
        const size_t length = fvi_list_item(at);
        const fvi_column i = (fvi_column)fvi_scan_word(at, length, fvi_column_names);
        int status = 0;
        if (length == 0)
            return fvi_refuse(c, "columns", "'%s': a column is missing", text);
        if (columns->count == FVI_MOST_ITEMS)
            return fvi_refuse(c, "columns", "more than %d columns in the list", FVI_MOST_ITEMS);
        for (size_t n = 0; n < columns->count && i != FVI_COLUMN_TYPED; n++)
            if (columns->at[n] == i)
                return fvi_refuse(c, "columns", "'%s' names %s twice", text, fvi_column_names[i]);
        if (i == FVI_COLUMN_TYPED)
            status = parse_typed_column(at, length, parameters, columns, typed, c);
        if (status)
            return status;
        columns->at[columns->count++] = i;
        at += length;
        if (*at == '\0')
            return 0;
    }
}
