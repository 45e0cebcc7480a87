/* src/command_fit/fvi_fit_records.c -- Read the data of `fvi fit`: several columns, several records. */
#define _GNU_SOURCE /* for strdup */
#include "fvi_fit_records.h"

#include "input/fvi_files.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

typedef fvi_fit_request request;

/* What was read for one record. The texts point into `operand`, which was split. */
struct fvi_fit_record {
    char *operand;
    const char *file, *x0_text, *p0_text, *force_text;
    double *block, *start; /* times and columns; x0 and p0 */
    fvi_measured measured[FVI_MEASURED_MOST];
    fvi_typed_force *typed;
    fvi_force force;
};

/* ---- the last time ---- */

/* Return the last time of one operand, or 0 if it cannot be read. The error is reported when the record is read. */
static double last_time_of(const char *operand)
{
    static const char *const names[] = { "t|time" };
    size_t n, which[FVI_COLUMNS_MOST];
    double *t, last = 0;
    struct stat about;
    const char *end = strstr(operand, " : ");
    char *file = strndup(operand, end ? (size_t)(end - operand) : strlen(operand));
    if (file && stat(file, &about) == 0 && S_ISREG(about.st_mode)
        && !fvi_parse_table_columns("DATA", file, 1, names, 0, &n, &t, which, NULL)) {
        last = t[n - 1];
        free(t);
    }
    free(file);
    return last;
}

/* Return the value of --h among the words, or 0. */
static double step_among(char *const *run)
{
    double h = 0;
    for (size_t i = 0; run[i]; i++)
        if (strncmp(run[i], "--h=", 4) == 0 || (strcmp(run[i], "--h") == 0 && run[i + 1]))
            fvi_parse_number("h", run[i][3] ? run[i] + 4 : run[i + 1], 0, INFINITY, "()", &h, NULL);
    return h;
}

void fvi_fit_time(const fvi_subcommand_options *w, char *const *run, size_t size, char *text)
{
    double last = 0;
    for (size_t k = 0; k < w->operands && (w->given[FORCE] || w->given[GROUND]); k++) {
        const double end = last_time_of(w->all[k]);
        if (!(end <= last)) /* this comparison keeps a NaN */
            last = end;
    }
    const double h = w->given[H] ? step_among(run) : 0, steps = h > 0 ? ceil(last / h - 1e-6) : 0;
    if (w->given[H] ? steps >= 1 && steps < 1e15 : last > 0)
        snprintf(text, size, h > 0 ? "--steps=%.0f" : "--time=%.17g", h > 0 ? steps : last);
}

/* ---- columns ---- */

int fvi_fit_columns(request *r, fvi_error *c)
{
    const char *text = r->words.own[COMPARE];
    while (text) {
        const size_t length = fvi_list_item(text), n = r->columns;
        char item[FVI_ERROR_ROOM];
        if (n == FVI_MEASURED_MOST)
            return fvi_refuse(c, "compare", "more than %d columns", FVI_MEASURED_MOST);
        if (length >= sizeof item)
            return fvi_refuse(c, "compare", "'%s' is too long", text);
        memcpy(item, text, length);
        item[length] = '\0';
        if (fvi_parse_sensor("compare", item, r->o.d, &r->o.lets, r->sensor[n], &r->shows[n], c))
            return 2;
        r->column[n] = r->sensor[n];
        for (size_t i = 0; i < n; i++)
            if (strcmp(r->sensor[i], r->sensor[n]) == 0) {
                r->columns++;
                return fvi_refuse(c, "compare", "'%s' stands twice", r->sensor[n]);
            }
        r->columns++;
        text = text[length] ? text + length + 1 : NULL;
    }
    return 0;
}

int fvi_fit_sigma(request *r, fvi_error *c)
{
    const size_t count = r->columns ? r->columns : 1;
    if (!r->words.own[SIGMA])
        return 0;
    const int status = fvi_read_numbers("sigma", r->words.own[SIGMA], 0, INFINITY, "()", count,
                                        r->sigma, c);
    r->fit.sigma = r->sigma[0];
    return status;
}

/* ---- records ---- */

/* Split "DATA : x0=1,0 : force=file:F.tsv" into its parts. */
static int split(struct fvi_fit_record *o, const char *operand, fvi_error *c)
{
    o->operand = strdup(operand);
    if (!o->operand)
        return fvi_no_memory(c, NULL);
    o->file = o->operand;
    for (char *at = strstr(o->operand, " : "); at;) {
        *at = '\0';
        char *word = at + 3;
        at = strstr(word, " : ");
        const char **text = strncmp(word, "x0=", 3) == 0       ? &o->x0_text
                            : strncmp(word, "p0=", 3) == 0     ? &o->p0_text
                            : strncmp(word, "force=", 6) == 0 ? &o->force_text
                                                               : NULL;
        if (!text || *text)
            return fvi_refuse(c, "DATA", "'%s': of its own a record has x0=, p0= and force=, each once", word);
        *text = strchr(word, '=') + 1;
    }
    return 0;
}

static int read_start(const request *r, struct fvi_fit_record *o, fvi_record *to, fvi_error *c)
{
    const size_t d = r->o.d;
    int status = 0;
    if (!o->x0_text && !o->p0_text)
        return 0;
    o->start = malloc(2 * d * sizeof *o->start);
    if (!o->start)
        return fvi_no_memory(c, NULL);
    if (o->x0_text) {
        status = fvi_read_numbers("DATA: x0", o->x0_text, -INFINITY, INFINITY, "()", d, o->start, c);
        to->x0 = o->start;
    }
    if (!status && o->p0_text) {
        status = fvi_read_numbers("DATA: p0", o->p0_text, -INFINITY, INFINITY, "()", d,
                                  o->start + d, c);
        to->p0 = o->start + d;
    }
    return status;
}

static int read_force(request *r, struct fvi_fit_record *o, fvi_record *to, fvi_error *c)
{
    if (o->force_text && r->o.ground)
        return fvi_refuse(c, "ground", "not together with a force of its own of a record, which would take its place");
    if (!o->force_text)
        return 0;
    const int status = fvi_parse_force(o->force_text, r->o.d, &r->o.lets, to->t[to->n - 1],
                                       &o->typed, c);
    if (status)
        return status;
    const char *name;
    for (size_t i = 0; (name = fvi_typed_force_file(o->typed, i)); i++)
        fvi_mark_read("force", name);
    o->force = fvi_force_typed(o->typed);
    to->force = &o->force;
    return 0;
}

/* Read the times and the columns. Without --compare these are t and x, by name or as the first two columns; with it
 * they are found by name. */
static int read_columns(const request *r, struct fvi_fit_record *o, fvi_record *to, fvi_error *c)
{
    static const char *const t_and_x[] = { "t", "x" };
    const char *names[FVI_MEASURED_MOST + 1] = { "t|time" };
    size_t which[FVI_COLUMNS_MOST];
    double *x;
    if (!r->columns) {
        const int status = fvi_parse_table("DATA", o->file, t_and_x, &to->n, &o->block, &x, c);
        to->t = o->block;
        o->measured[0].x = x;
        return status;
    }
    for (size_t k = 0; k < r->columns; k++)
        names[k + 1] = r->column[k];
    const int status = fvi_parse_table_columns("DATA", o->file, r->columns + 1, names, 0, &to->n,
                                               &o->block, which, c);
    to->t = o->block;
    for (size_t k = 0; k < r->columns && !status; k++)
        o->measured[k].x = o->block + (k + 1) * to->n;
    for (size_t i = 1; i < to->n && !status; i++)
        if (!(to->t[i] > to->t[i - 1]))
            return fvi_refuse(c, "DATA", "%s: t does not increase from row %zu to row %zu", o->file, i, i + 1);
    return status;
}

int fvi_fit_check_outputs(const request *r, fvi_error *c)
{
    const int status = fvi_check_output("-o", r->o.output, c);
    return status ? status : fvi_check_output("--curve", r->words.own[CURVE], c);
}

static int read_record(request *r, size_t k, fvi_error *c)
{
    struct fvi_fit_record *o = r->read + k;
    fvi_record *to = r->record + k;
    int status = split(o, r->words.all[k], c);
    if (!status)
        fvi_mark_read("DATA", o->file);
    if (!status)
        status = fvi_fit_check_outputs(r, c);
    if (!status)
        status = read_columns(r, o, to, c);
    if (status)
        return status;
    for (size_t i = 0; i < (r->columns ? r->columns : 1); i++) {
        o->measured[i].sigma = r->sigma[i];
        o->measured[i].shows = r->shows[i];
    }
    to->measured = o->measured;
    r->points += to->n;
    if (to->t[0] < 0)
        return fvi_refuse(c, "DATA", "%s: t begins before 0, with %g", o->file, to->t[0]);
    status = read_start(r, o, to, c);
    return status ? status : read_force(r, o, to, c);
}

int fvi_fit_read(request *r, fvi_error *c)
{
    const size_t count = r->words.operands;
    if (count == 0)
        return fvi_refuse(c, NULL, "DATA: a file with the columns t and x is missing");
    r->record = calloc(count, sizeof *r->record);
    r->read = calloc(count, sizeof *r->read);
    if (!r->record || !r->read)
        return fvi_no_memory(c, NULL);
    int status = 0;
    for (size_t k = 0; k < count && !status; k++)
        status = read_record(r, k, c);
    if (status)
        return status;
    r->points *= r->columns ? r->columns : 1;
    if (r->points <= r->fit.parameters)
        return fvi_refuse(c, "DATA", "%s: %zu rows are not enough for %zu parameters",
                          r->read->file, r->points, r->fit.parameters);
    for (size_t k = 0; k < count; k++)
        if (r->fit.h > 0 && !(r->fit.h * FVI_FIT_MOST_EQUAL_STEPS >= r->record[k].t[r->record[k].n - 1]))
            return fvi_refuse(c, "h", "to t = %.10g steps of that length take %.3g equal steps, and a fit makes %d; "
                              "without --h fvi-adaptive chooses its own",
                              r->record[k].t[r->record[k].n - 1], r->record[k].t[r->record[k].n - 1] / r->fit.h,
                              FVI_FIT_MOST_EQUAL_STEPS);
    const fvi_record *first = r->record;
    const int is_plain = count == 1 && !r->columns && !first->x0 && !first->p0 && !first->force;
    if (is_plain) {
        r->fit.n = first->n;
        r->fit.t = first->t;
        r->fit.x = first->measured->x;
    } else {
        r->fit.records = count;
        r->fit.columns = r->columns ? r->columns : 1;
        r->fit.record = r->record;
    }
    return 0;
}

void fvi_fit_records_free(request *r)
{
    for (size_t k = 0; k < r->words.operands && r->read; k++) {
        free(r->read[k].operand);
        free(r->read[k].block);
        free(r->read[k].start);
        fvi_typed_force_free(r->read[k].typed);
    }
    for (size_t i = 0; i < r->columns; i++)
        fvi_expression_free(r->shows[i]);
    free(r->read);
    free(r->record);
}
