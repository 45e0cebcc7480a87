/* src/output/fvi_format.c -- Write a table as text: tsv, csv or json. */
#include "fvi_format.h"

#include <fvi/version.h>
#include <fvi/format_double.h>

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

void fvi_print_number(FILE *out, const char *before, double v)
{
    char text[32];
    fputs(before, out);
    fwrite(text, 1, (size_t)fvi_format_double(v, text), out);
}

void fvi_print_estimate(FILE *out, double estimate, double sd, double lower, double upper)
{
    const double numbers[] = { estimate, sd, lower, upper };
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        fvi_print_number(out, "\t", numbers[i]);
    fputc('\n', out);
}

/* Return the length in bytes of the UTF-8 character at `at`, or 0 if there is no valid character. Surrogates, overlong
 * forms and codes above U+10FFFF are not valid. */
static size_t bytes_of_character(const char *at)
{
    static const uint32_t least[] = { 0, 0, 0x80, 0x800, 0x10000 };
    const unsigned char lead = (unsigned char)*at;
    const size_t n = lead < 0x80    ? 1
                     : lead >= 0xf8 ? 0
                     : lead >= 0xf0 ? 4
                     : lead >= 0xe0 ? 3
                     : lead >= 0xc0 ? 2
                                    : 0;
    uint32_t code = n < 2 ? lead : lead & (0x7fU >> n);
    for (size_t i = 1; i < n; i++) {
        const unsigned char next = (unsigned char)at[i];
        if ((next & 0xc0) != 0x80)
            return 0;
        code = code << 6 | (next & 0x3f);
    }
    return code < least[n] || code > 0x10ffff
                   || (code >= 0xd800 && code < 0xe000)
               ? 0
               : n;
}

/* Write a text between quotes. The name of a file may contain any bytes. A byte that does not belong to a UTF-8
 * character becomes U+FFFD. */
static void print_quoted(FILE *out, const char *text)
{
    fputc('"', out);
    for (size_t n; *text; text += n > 0 ? n : 1) {
        n = bytes_of_character(text);
        if (n == 0)
            fputs("\\ufffd", out);
        else if (*text == '"' || *text == '\\')
            fprintf(out, "\\%c", *text);
        else if ((unsigned char)*text < ' ')
            fprintf(out, "\\u%04x", (unsigned char)*text);
        else
            fwrite(text, 1, n, out);
    }
    fputc('"', out);
}

/* Write a text with each control character replaced by a blank, so that two lines become one. */
static void print_in_one_line(FILE *out, const char *text)
{
    for (; *text; text++)
        fputc((unsigned char)*text < ' ' ? ' ' : *text, out);
}

void fvi_format_begin(FILE *out, fvi_format format)
{
    if (format == FVI_FORMAT_TSV)
        fprintf(out, "# fvi " FVI_VERSION "\n");
    else if (format == FVI_FORMAT_JSON)
        fprintf(out, "{\"parameters\": {\n  \"fvi\": \"" FVI_VERSION "\"");
}

void fvi_format_parameter(FILE *out, fvi_format format, const char *name,
                          const char *value)
{
    char *end;
    if (format == FVI_FORMAT_TSV) {
        fprintf(out, "# %s = ", name);
        print_in_one_line(out, value);
        fputc('\n', out);
    }
    if (format != FVI_FORMAT_JSON)
        return;
    fprintf(out, ",\n  \"%s\": ", name);
    const double number = strtod(value, &end);
    if (end != value && *end == '\0' && isfinite(number))
        fvi_print_number(out, "", number);
    else
        print_quoted(out, value);
}

void fvi_format_name(FILE *out, fvi_format format, size_t i, const char *word,
                     size_t number)
{
    static const char *const first[] = { "# ", "", "\n },\n\"columns\": [\"" },
                             *const next[] = { "\t", ",", "\", \"" };
    const int is_quoted = format == FVI_FORMAT_CSV && strchr(word, ',');
    fprintf(out, is_quoted ? "%s\"%s\"" : "%s%s",
            (i == 0 ? first : next)[format], word);
    if (number > 0)
        fprintf(out, "%zu", number);
}

void fvi_format_names_end(FILE *out, fvi_format format)
{
    fputs(format == FVI_FORMAT_JSON ? "\"],\n\"rows\": [" : "\n", out);
}

void fvi_format_row(FILE *out, fvi_format format, size_t i, size_t width,
                    const double *row)
{
    const char *const parted[] = { "\t", ",", ", " };
    if (format == FVI_FORMAT_JSON)
        fputs(i == 0 ? "\n [" : ",\n [", out);
    for (size_t n = 0; n < width; n++) {
        if (n > 0)
            fputs(parted[format], out);
        fvi_print_number(out, "", row[n]);
    }
    fputs(format == FVI_FORMAT_JSON ? "]" : "\n", out);
}

void fvi_format_events_begin(FILE *out, fvi_format format)
{
    if (format == FVI_FORMAT_JSON)
        fputs("\n],\n\"events\": [", out);
}

void fvi_format_event(FILE *out, fvi_format format, size_t i, double t,
                      const char *name, const char *ending)
{
    const int is_json = format == FVI_FORMAT_JSON;
    FILE *to = format == FVI_FORMAT_CSV ? stderr : out;
    if (is_json)
        fputs(i == 0 ? "\n " : ",\n ", to);
    fvi_print_number(to, is_json                     ? "{\"t\": "
                         : format == FVI_FORMAT_CSV ? "fvi: event at t = "
                                                    : "# event at t = ", t);
    fputs(is_json ? ", \"event\": " : " : ", to);
    if (is_json)
        print_quoted(to, name);
    else
        print_in_one_line(to, name);
    if (ending)
        fprintf(to, is_json ? ", \"%s\": true" : " : %s", ending);
    fputs(is_json ? "}" : "\n", to);
}

void fvi_format_end(FILE *out, fvi_format format)
{
    if (format == FVI_FORMAT_JSON)
        fputs("\n]}\n", out);
}
