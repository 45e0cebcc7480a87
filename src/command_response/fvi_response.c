/* src/command_response/fvi_response.c -- Run the command `fvi response`: print what a shaker test measures. */
#include "fvi_response.h"

#include "fvi_linear.h"
#include "input/fvi_files.h"
#include "options/fvi_range.h"
#include "output/fvi_complain.h"
#include "output/fvi_format.h"
#include "output/fvi_output.h"
#include "output/fvi_picture.h"

#include <gsl/gsl_math.h>
#include <math.h>
#include <stdlib.h>

static const char *const of_run[] = { FVI_LINEAR_OPTIONS, "plot", NULL };
static const fvi_own_command response = {
    .name = "response",
    .own = { "omega", "of", "at", "by", "along" },
    .with = of_run,
    .flag = "hertz",
    .presets = fvi_linear_presets
};
enum { OMEGA, OF, AT, BY, ALONG_GROUND };

/* In the order of fvi_response_kind; the last one belongs to a law alone. */
static const char *const kinds[] = { "receptance", "mobility", "accelerance",
                                     "ground",     "moduli",   NULL };
enum { MODULI = FVI_RESPONSE_GROUND + 1 };

typedef struct {
    fvi_linear_request linear;
    size_t of, at, by;
    fvi_range range;
} request;

/* ---- words ---- */

static int interpret_omega(request *r, fvi_error *c)
{
    const char *text = r->linear.words.own[OMEGA];
    if (!text)
        return fvi_refuse(c, NULL, "response: --omega A:B:N[:log] or a list is missing");
    const int status =
        fvi_word_range("omega", "A:B:N, A:B:N:log or a list of numbers", text,
                       text, 0, &r->range, c);
    if (!status && !r->range.list && !(r->range.from > 0 && r->range.to > 0))
        return fvi_refuse(c, "omega", "'%s': frequencies are above 0", text);
    return status;
}

/* Read --along, the direction in which the ground moves. */
static int interpret_along(request *r, fvi_error *c)
{
    const char *text = r->linear.words.own[ALONG_GROUND];
    const size_t d = r->linear.o.d;
    if (!text)
        return 0;
    if (r->of != FVI_RESPONSE_GROUND)
        return fvi_refuse(c, "along", "without --of ground nothing moves along it");
    r->linear.along = malloc(d * sizeof(double));
    if (!r->linear.along)
        return fvi_no_memory(c, NULL);
    return fvi_read_numbers("along", text, -INFINITY, INFINITY, "()", d,
                            r->linear.along, c);
}

/* Refuse options that do not concern a law, because --of moduli asks for nothing else. */
static int check_moduli(const request *r, fvi_error *c)
{
    static const option_index others[] = { MASS,   POTENTIAL, DIMENSION, SYSTEM,
                                           DAMPER, X0 };
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (r->linear.words.given[others[i]])
            return fvi_refuse(c, fvi_option_list[others[i]].name,
                              "not together with --of moduli, which are those of the damping alone");
    for (int i = AT; i <= ALONG_GROUND; i++)
        if (r->linear.words.own[i])
            return fvi_refuse(c, response.own[i], "not together with --of moduli");
    return 0;
}

static int interpret(request *r, fvi_error *c)
{
    const char *const *own = r->linear.words.own;
    const size_t d = r->linear.o.d;
    int status = interpret_omega(r, c);
    if (!status)
        status = fvi_parse_word("of", own[OF] ? own[OF] : kinds[0], kinds,
                                &r->of, c);
    if (status)
        return status;
    if (r->of == MODULI)
        return check_moduli(r, c);
    status = interpret_along(r, c);
    if (status)
        return status;
    if (r->of == FVI_RESPONSE_GROUND && own[BY])
        return fvi_refuse(c, "by", "not together with --of ground, which moves them all");
    status = fvi_parse_whole("at", own[AT] ? own[AT] : "1", d, &r->at, c);
    if (!status)
        status = fvi_parse_whole("by", own[BY] ? own[BY] : "1", d, &r->by, c);
    return status;
}

/* ---- rows ---- */

/* Compute the moduli of the law, or of the springpot of --alpha and --rho. */
static int find_moduli(const request *r, double omega, double row[2])
{
    const fvi_options *o = &r->linear.o;
    const fvi_kernel_term term = { FVI_KERNEL_POWER, o->rho[0], o->alpha, 0, 0 };
    const fvi_kernel power = { 1, &term };
    return fvi_kernel_moduli(o->text[DAMPING] ? &o->damping.law : &power, omega,
                             &row[0], &row[1]);
}

/* Compute the numbers after the frequency. Return 0, or 1 after a message. */
static int compute_row(const request *r, double f, double row[4])
{
    fvi_error error = { .text = "" };
    const double omega = r->linear.words.flag ? 2 * M_PI * f : f;
    int status;
    if (r->of == MODULI) {
        status = find_moduli(r, omega, row);
        return status ? fvi_complain(fvi_code_in_words(status)) : 0;
    }
    status = fvi_response_at(r->linear.response, (fvi_response_kind)r->of, 1,
                             &omega, r->at - 1, r->by - 1, row, &error);
    if (status)
        return fvi_complain_of(&error);
    row[2] = hypot(row[0], row[1]);
    row[3] = atan2(row[1], row[0]);
    return 0;
}

static int print_rows(const request *r, FILE *out, FILE *plot)
{
    const fvi_format format = r->linear.o.format;
    const size_t width = r->of == MODULI ? 2 : 4;
    for (size_t i = 0; i < r->range.count && !ferror(out); i++) {
        double row[5] = { fvi_range_value(&r->range, i) };
        if (compute_row(r, row[0], row + 1))
            return 1;
        fvi_format_row(out, format, i, width + 1, row);
        if (plot)
            fvi_plot_row(plot, row[0], width, row + 1);
        fvi_progress(i + 1, r->range.count);
    }
    fvi_progress_clear();
    return 0;
}

/* ---- the table and the picture ---- */

static void print_head(const request *r, FILE *out)
{
    static const char *const of_law[] = { "alpha", "order", "rho", "damping",
                                          "let", NULL };
    static const char *const columns[2][5] = {
        { "omega", "re", "im", "abs", "phase" }, { "omega", "storage", "loss" }
    };
    const fvi_format format = r->linear.o.format;
    const int is_law = r->of == MODULI;
    const char *const *own = r->linear.words.own;
    fvi_linear_head(out, &r->linear, is_law ? of_law : of_run);
    fvi_format_parameter(out, format, "of", kinds[r->of]);
    if (!is_law)
        fvi_format_parameter(out, format, "at", own[AT] ? own[AT] : "1");
    if (own[ALONG_GROUND])
        fvi_format_parameter(out, format, "along", own[ALONG_GROUND]);
    if (r->of < FVI_RESPONSE_GROUND)
        fvi_format_parameter(out, format, "by", own[BY] ? own[BY] : "1");
    for (size_t i = 0; i < 5 && columns[is_law][i]; i++)
        fvi_format_name(out, format, i,
                        i == 0 && r->linear.words.flag ? "f"
                                                       : columns[is_law][i],
                        0);
    fvi_format_names_end(out, format);
}

/* Write the commands for one curve, the column `up` over the frequency. */
static void plot_over_frequency(FILE *g, const request *r, const char *name,
                                const char *up)
{
    fprintf(g, "set logscale x; set format x '10^{%%T}'; set xlabel '%s'\n",
            r->linear.words.flag ? "f" : "omega");
    fprintf(g, "set ylabel '%s'\nplot $rows using 1:%s\n", name, up);
}

/* Write the commands for three curves: two over the frequency (Bode plots), and one in the complex plane (a Nyquist
 * plot, or for moduli a Cole-Cole plot). */
static void script(FILE *g, const void *params)
{
    const request *r = params;
    const int is_law = r->of == MODULI;
    fprintf(g, "set style data lines\nunset key\nset multiplot\n"
               "do for [i=1:2] { set linetype i lw 1.5 }\n"
               "set size %s 0.5,1; set origin 0.5,0\n"
               "set xlabel '%s'; set ylabel '%s'\nplot $rows using 2:3\n",
            is_law ? "square" : "ratio -1", is_law ? "storage" : "re",
            is_law ? "loss" : "im");
    fputs("set lmargin 10\nset size noratio 0.5,0.5; set origin 0,0.5\n"
          "set logscale y; set format y '10^{%T}'\n", g);
    if (is_law) {
        fputs("set key top left\n", g);
        plot_over_frequency(g, r, "moduli",
                            "2 title 'storage', $rows using 1:3 title 'loss'");
        fputs("unset key\n", g);
    } else {
        plot_over_frequency(g, r, kinds[r->of], "4");
    }
    fputs("unset logscale y; set format y '%g'\n"
          "set size 0.5,0.5; set origin 0,0\n", g);
    if (!is_law)
        fputs("set yrange [-pi:pi]\n", g);
    plot_over_frequency(g, r, is_law ? "loss / storage" : "phase",
                        is_law ? "($3/$2)" : "5");
    fputs("unset multiplot\n", g);
}

static int compute_answer(request *r)
{
    const char *plot = r->linear.o.plot;
    if (r->of != MODULI && fvi_linear_open(&r->linear))
        return 1;
    FILE *rows = plot ? fvi_plot_begin() : NULL;
    if (plot && !rows)
        return 1;
    FILE *out = fvi_output_open(r->linear.o.output);
    int failed = out ? 0 : fvi_cannot_write(r->linear.o.output);
    if (out) {
        print_head(r, out);
        failed = print_rows(r, out, rows);
        if (!failed)
            fvi_format_end(out, r->linear.o.format);
        if (fvi_output_close(out, !failed) && !failed)
            failed = fvi_cannot_write(r->linear.o.output);
    }
    const fvi_picture picture = { plot, 900, 450, script, r };
    return fvi_picture_end(rows, &picture, !failed) || failed;
}

int fvi_command_response(int argc, char **argv)
{
    fvi_error error;
    request r = { .of = 0 };
    int status = fvi_subcommand_options_parse(&response, argc, argv,
                                              &r.linear.words, &r.linear.o,
                                              &error);
    if (!status)
        status = interpret(&r, &error);
    if (!status)
        status = fvi_check_output("-o", r.linear.o.output, &error);
    if (!status)
        status = fvi_check_output("--plot", r.linear.o.plot, &error);
    status = status ? fvi_refused(&error, response.name) : compute_answer(&r);
    free(r.range.list);
    fvi_linear_free(&r.linear);
    return status;
}
