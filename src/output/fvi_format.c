/* src/output/fvi_format.c -- A table as text: tsv, csv, json. */
#include "fvi_format.h"

#include <fvi/version.h>
#include "words/fvi_shortest.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void fvi_print_number(FILE *out, const char *before, double v)
{
    char text[32];
    fputs(before, out);
    fwrite(text, 1, (size_t)fvi_shortest(v, text), out);
}

/* A text between quotes. */
static void print_quoted(FILE *out, const char *text)
{
    fputc('"', out);
    for (; *text; text++)
        if (*text == '"' || *text == '\\')
            fprintf(out, "\\%c", *text);
        else if ((unsigned char)*text < ' ')
            fprintf(out, "\\u%04x", (unsigned char)*text);
        else
            fputc(*text, out);
    fputc('"', out);
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
        for (const char *c = value; *c; c++) /* two lines become one */
            fputc((unsigned char)*c < ' ' ? ' ' : *c, out);
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
    fprintf(out, "%s%s", (i == 0 ? first : next)[format], word);
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

void fvi_format_end(FILE *out, fvi_format format)
{
    if (format == FVI_FORMAT_JSON)
        fputs("\n]}\n", out);
}
