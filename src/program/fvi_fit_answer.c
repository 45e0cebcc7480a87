/* src/program/fvi_fit_answer.c -- What `fvi fit` prints. */
#include "fvi_fit_answer.h"

#include "output/fvi_complain.h"
#include "output/fvi_format.h"
#include "output/fvi_output.h"

typedef fvi_fit_request request;

/* What the reader must know before he believes it; to the table and to standard error. */
static void warn(FILE *out, const char *text)
{
    fvi_warn(text);
    fprintf(out, "# warning = %s\n", text);
}

/* Pairs that the data can hardly tell apart; how many there are. */
static int warn_alike(FILE *out, const request *r, const fvi_estimate *f)
{
    char text[FVI_WARNING_ROOM];
    int pairs = 0;
    for (size_t i = 0; i < r->fit.parameters; i++)
        for (size_t j = 0; j < i; j++)
            if (fvi_estimate_warning_of_pair(f, j, i, r->name[j], r->name[i],
                                        sizeof text, text)) {
                warn(out, text);
                pairs++;
            }
    return pairs;
}

static void warnings(FILE *out, const request *r, const fvi_estimate *f)
{
    char text[FVI_WARNING_ROOM];
    const char *past = fvi_estimate_warning_of_initial_history(&r->fit, f);
    if (past)
        warn(out, past);
    if (fvi_estimate_warning_of_model(&r->fit, f, sizeof text, text))
        warn(out, text);
    if (fvi_estimate_warning_of_step(&r->fit, f, sizeof text, text))
        warn(out, text);
}

/* How far each can really go while the others make up for it. */
static void print_profiles(FILE *out, const request *r, const fvi_estimate *f)
{
    for (size_t j = 0; j < r->fit.parameters; j++) {
        double low, high;
        const int status = fvi_estimate_profile(&r->fit, f, j, &low, &high);
        if (status == FVI_EMAXITER)
            warn(out, "on the way along a profile the fit became better: try "
                      "more --starts");
        if (status)
            return;
        fprintf(out, "# profile %s", r->name[j]);
        fvi_print_number(out, " = ", low);
        fvi_print_number(out, " ", high);
        fputs(" (95 %)\n", out);
    }
}

void fvi_fit_print_answer(FILE *out, const request *r, const fvi_estimate *f)
{
    fprintf(out, "# data = %s\n# name\testimate\tsd\tlower\tupper\n",
            r->words.operand);
    for (size_t j = 0; j < r->fit.parameters; j++) {
        const double reach = f->quantile * f->sd[j];
        fputs(r->name[j], out);
        fvi_print_number(out, "\t", f->estimate[j]);
        fvi_print_number(out, "\t", f->sd[j]);
        fvi_print_number(out, "\t", f->estimate[j] - reach);
        fvi_print_number(out, "\t", f->estimate[j] + reach);
        fputc('\n', out);
    }
    fvi_print_number(out, "# chi2 = ", f->chi2);
    if (r->fit.sigma > 0)
        fprintf(out, "\n# probability = %.3g", f->probability);
    else
        fvi_print_number(out, "\n# estimated sigma = ", f->sigma);
    fprintf(out, "\n# points = %zu\n# starts = %zu, %zu agree", r->fit.n,
            r->fit.starts, f->agree);
    fvi_print_number(out, "\n# step = ", f->h);
    for (size_t j = 0; j < r->fit.parameters; j++)
        for (size_t i = 0; i < j; i++) {
            fprintf(out, "\n# correlation %s %s", r->name[i], r->name[j]);
            fvi_print_number(out, " = ", f->correlation[i][j]);
        }
    fputc('\n', out);
    if (warn_alike(out, r, f))
        print_profiles(out, r, f);
    warnings(out, r, f);
}

int fvi_fit_print_curve(const request *r)
{
    if (!r->words.own[CURVE])
        return 0;
    FILE *out = fvi_output_open(r->words.own[CURVE]);
    if (!out)
        return fvi_cannot_write(r->words.own[CURVE]);
    fprintf(out, "# t\tdata\tfit\tresidual\n");
    for (size_t i = 0; i < r->fit.n; i++)
        fvi_format_row(
            out, FVI_FORMAT_TSV, i, 4,
            (double[]){ r->t[i], r->x[i], r->curve[i], r->x[i] - r->curve[i] });
    return fvi_output_close(out, 1) ? fvi_cannot_write(r->words.own[CURVE]) : 0;
}

int fvi_fit_complain(int status, const request *r, const fvi_estimate *f)
{
    char text[FVI_WARNING_ROOM];
    return fvi_complain(fvi_estimate_reason(status, &r->fit, f, r->words.own[FIT],
                                       "--", sizeof text, text)
                            ? text
                        : status == FVI_ENOMEM ? "not enough memory"
                                               : fvi_code_in_words(status));
}
