/* src/command_response/fvi_poles.c -- Run the command `fvi poles`: print frequencies, damping ratios and shapes. */
#include "fvi_response.h"

#include "fvi_linear.h"
#include "output/fvi_complain.h"
#include "output/fvi_format.h"
#include "output/fvi_output.h"

#include <fvi/warnings.h>

#include <gsl/gsl_math.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>

static const char *const of_run[] = { FVI_LINEAR_OPTIONS, NULL };
static const fvi_own_command command = {
    .name = "poles",
    .own = { "count" },
    .with = of_run,
    .flag = "shapes",
    .presets = fvi_linear_presets
};

typedef struct {
    fvi_linear_request linear;
    size_t count; /* 0: all */
    fvi_poles poles;
} request;

static int interpret(request *r, fvi_error *c)
{
    const char *text = r->linear.words.own[0];
    const size_t d = r->linear.o.d;
    const int status =
        text ? fvi_parse_whole("count", text, d, &r->count, c) : 0;
    if (!status && (r->count ? r->count : d) > FVI_MOST_POLES)
        return fvi_refuse(c, "count", "at most %d of %zu poles are looked for; say how many of the lowest",
                          FVI_MOST_POLES, d);
    return status;
}

/* Write, for example, "5 of 5", or "3 of ?" if the number of poles is not known. */
static void count_in_words(const fvi_poles *p, size_t size, char *text)
{
    if (p->expected == SIZE_MAX)
        snprintf(text, size, "%zu of ?", p->count);
    else
        snprintf(text, size, "%zu of %zu", p->count, p->expected);
}

/* Round to one digit, because the number is nothing but rounding errors. */
static double round_to_one_digit(double v)
{
    char text[32];
    snprintf(text, sizeof text, "%.1g", v);
    return strtod(text, NULL);
}

static void print_names(const request *r, FILE *out)
{
    static const char *const names[] = { "re", "im", "frequency", "damping",
                                         "residual" };
    const fvi_format format = r->linear.o.format;
    size_t n = 0;
    for (; n < sizeof names / sizeof *names; n++)
        fvi_format_name(out, format, n, names[n], 0);
    for (size_t i = 0; r->linear.words.flag && i < r->poles.d; i++) {
        fvi_format_name(out, format, n++, "re", i + 1);
        fvi_format_name(out, format, n++, "im", i + 1);
    }
    fvi_format_names_end(out, format);
}

static int print_rows(const request *r, FILE *out)
{
    const fvi_poles *p = &r->poles;
    const size_t width = 5 + (r->linear.words.flag ? 2 * p->d : 0);
    double *row = malloc(width * sizeof *row);
    if (!row)
        return fvi_complain("not enough memory");
    for (size_t k = 0; k < p->count && !ferror(out); k++) {
        const double re = p->pole[2 * k], im = p->pole[2 * k + 1],
                     size = hypot(re, im);
        row[0] = re;
        row[1] = im;
        row[2] = size / (2 * M_PI);
        row[3] = -re / size + 0.0; /* + 0.0 turns -0 into 0 */
        row[4] = round_to_one_digit(p->residual[k]);
        for (size_t i = 5; i < width; i++)
            row[i] = p->shape[2 * p->d * k + i - 5];
        fvi_format_row(out, r->linear.o.format, k, width, row);
    }
    free(row);
    return 0;
}

static int print(const request *r, const char *found)
{
    const fvi_format format = r->linear.o.format;
    FILE *out = fvi_output_open(r->linear.o.output);
    if (!out)
        return fvi_cannot_write(r->linear.o.output);
    fvi_linear_head(out, &r->linear, of_run);
    fvi_format_parameter(out, format, "poles", found);
    print_names(r, out);
    int failed = print_rows(r, out);
    if (!failed)
        fvi_format_end(out, format);
    if (fvi_output_close(out, !failed) && !failed)
        failed = fvi_cannot_write(r->linear.o.output);
    return failed;
}

static int compute_answer(request *r)
{
    char found[64], warning[FVI_WARNING_ROOM];
    fvi_error error;
    if (fvi_linear_open(&r->linear))
        return 1;
    if (fvi_poles_find(r->linear.response, r->count, &r->poles, &error))
        return fvi_complain_of(&error);
    count_in_words(&r->poles, sizeof found, found);
    if (fvi_response_warning_of_poles(&r->poles, sizeof warning, warning))
        fvi_warn(warning);
    const int failed = print(r, found);
    fvi_poles_free(&r->poles);
    return failed;
}

int fvi_command_poles(int argc, char **argv)
{
    fvi_error error;
    request r = { .count = 0 };
    int status = fvi_subcommand_options_parse(&command, argc, argv,
                                              &r.linear.words, &r.linear.o,
                                              &error);
    if (!status)
        status = interpret(&r, &error);
    status = status ? fvi_refused(&error, command.name) : compute_answer(&r);
    fvi_linear_free(&r.linear);
    return status;
}
