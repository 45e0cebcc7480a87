/* src/command_fit/fvi_fit_answer.c -- Print the answer of `fvi fit`. */
#include "fvi_fit_answer.h"

#include "fvi_fit_material.h"
#include "output/fvi_complain.h"
#include "output/fvi_format.h"
#include "output/fvi_output.h"

typedef fvi_fit_request request;

/* Warn of pairs of parameters that the data can hardly tell apart. */
static void warn_of_correlations(FILE *out, const request *r, const fvi_estimate *f)
{
    char text[FVI_WARNING_ROOM];
    for (size_t i = 0; i < r->fit.parameters; i++)
        for (size_t j = 0; j < i; j++)
            if (fvi_estimate_warning_of_pair(f, j, i, r->name[j], r->name[i],
                                        sizeof text, text))
                fvi_fit_note(out, "warning", text);
}

/* Warn of an offset or a drift of the sensor that the residuals would not show. */
static void warn_of_unseen(FILE *out, const request *r, const fvi_estimate *f,
                           const fvi_examination *e)
{
    char text[FVI_WARNING_ROOM];
    for (size_t which = 0; which < 2; which++)
        if (fvi_estimate_warning_of_unseen(&r->fit, f, e, which, r->name, sizeof text, text))
            fvi_fit_note(out, "warning", text);
}

void fvi_fit_print_flags(FILE *out, const request *r, const fvi_estimate *f, const fvi_examination *e)
{
    char text[FVI_WARNING_ROOM];
    for (unsigned flag = 1; flag <= e->flags; flag *= 2)
        if (fvi_estimate_flag_text(&r->fit, f, e, flag, r->name, sizeof text, text))
            fvi_fit_note(out, "flag", text);
}

static void print_rows(FILE *out, const request *r, const fvi_estimate *f,
                       const fvi_examination *e)
{
    fputs("# name\testimate\tsd\tlower\tupper\n", out);
    for (size_t j = 0; j < r->fit.parameters; j++) {
        fputs(r->name[j], out);
        fvi_print_estimate(out, f->estimate[j], f->sd[j], e->lower[j], e->upper[j]);
    }
}

static void print_correlations(FILE *out, const request *r, const fvi_estimate *f)
{
    for (size_t j = 0; j < r->fit.parameters; j++)
        for (size_t i = 0; i < j; i++) {
            fprintf(out, "\n# correlation %s %s", r->name[i], r->name[j]);
            fvi_print_number(out, " = ", f->correlation[i][j]);
        }
    fputc('\n', out);
}

void fvi_fit_print_plan(FILE *out, const request *r, const fvi_estimate *f,
                        const fvi_examination *e)
{
    print_rows(out, r, f, e);
    fprintf(out, "# points = %zu", r->fit.n);
    fvi_print_number(out, "\n# step = ", f->h);
    print_correlations(out, r, f);
    warn_of_correlations(out, r, f);
    warn_of_unseen(out, r, f, e);
}

static void print_sigmas(FILE *out, const request *r, const fvi_estimate *f)
{
    if (r->words.own[SIGMA])
        fprintf(out, "\n# probability = %.3g", f->probability);
    else if (!r->columns)
        fvi_print_number(out, "\n# estimated sigma = ", f->sigma);
    for (size_t k = 0; k < r->columns && !r->words.own[SIGMA]; k++) {
        fprintf(out, "\n# estimated sigma of %s", r->column[k]);
        fvi_print_number(out, " = ", f->column_sigma[k]);
    }
    if (r->fit.huber > 0)
        fprintf(out, "\n# intervals = by the profile of Huber's loss with k = %s, scaled by the "
                     "scatter of the residuals",
                r->words.own[HUBER]);
}

void fvi_fit_print_answer(FILE *out, const request *r, const fvi_estimate *f,
                          const fvi_examination *e)
{
    const char *past = fvi_estimate_warning_of_initial_history(&r->fit, f);
    for (size_t k = 0; k < r->words.operands; k++)
        fprintf(out, "# data = %s\n", r->words.all[k]);
    print_rows(out, r, f, e);
    fvi_print_number(out, "# chi2 = ", f->chi2);
    print_sigmas(out, r, f);
    fprintf(out, "\n# points = %zu\n# starts = %zu, %zu agree", r->points,
            r->fit.starts, f->agree);
    fvi_print_number(out, "\n# step = ", f->h);
    print_correlations(out, r, f);
    warn_of_correlations(out, r, f);
    warn_of_unseen(out, r, f, e);
    if (past)
        fvi_fit_note(out, "warning", past);
    fvi_fit_print_flags(out, r, f, e);
}

/* Print a row for each time: the record (if there are several), t, and for each column the data, the fit and the
 * residual. */
static void print_curve(FILE *out, const request *r)
{
    const size_t columns = r->columns ? r->columns : 1, is_one = r->words.operands == 1;
    const double *curve = r->curve;
    fputs(is_one ? "# t" : "# record\tt", out);
    for (size_t k = 0; k < r->columns; k++)
        fprintf(out, "\t%s\t%s_fit\t%s_residual", r->column[k], r->column[k], r->column[k]);
    fputs(r->columns ? "\n" : "\tdata\tfit\tresidual\n", out);
    for (size_t m = 0; m < r->words.operands; m++) {
        const fvi_record *o = r->record + m;
        for (size_t i = 0; i < o->n; i++) {
            double row[2 + 3 * FVI_MEASURED_MOST] = { (double)(m + 1), o->t[i] }, *at = row + 2;
            for (size_t k = 0; k < columns; k++) {
                *at++ = o->measured[k].x[i];
                *at++ = curve[k * o->n + i];
                *at++ = o->measured[k].x[i] - curve[k * o->n + i];
            }
            fvi_format_row(out, FVI_FORMAT_TSV, i, (size_t)(at - row) - is_one, row + is_one);
        }
        curve += columns * o->n;
    }
}

int fvi_fit_print_curve(const request *r)
{
    if (!r->words.own[CURVE])
        return 0;
    FILE *out = fvi_output_open(r->words.own[CURVE]);
    if (!out)
        return fvi_cannot_write(r->words.own[CURVE]);
    print_curve(out, r);
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
