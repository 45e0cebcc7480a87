/* src/command_fit/fvi_fit_material.c -- Run the command `fvi fit --moduli`, `--creep` or `--relaxation`: find a law of
 * damping from measurements of a laboratory. */
#include "fvi_fit_material.h"

#include "command_shared/fvi_subcommand_options.h"
#include "input/fvi_files.h"
#include "output/fvi_complain.h"
#include "output/fvi_format.h"
#include "output/fvi_output.h"
#include <fvi/fvi.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LAW, WEIGHTS, SIGMA, STARTS, CURVE };
enum { DATA_COLUMNS = 5, LETTERS = 100 };

/* For each test: its option, the names that the columns of its files may have, and their names in a line '#' and in a
 * sentence. In the order of fvi_material_test. */
static const struct {
    const char *option;
    size_t columns;
    const char *names[3], *line, *sentence;
} tests[] = {
    { "moduli", 3, { "omega|w|f|frequency|hertz|hz", "storage|Gp|G'|E'|G1|E1", "loss|Gpp|G''|E''|G2|E2" },
      "omega storage loss", "omega, storage and loss" },
    { "creep", 2, { "t|time", "x|strain|creep" }, "t x", "t and x" },
    { "relaxation", 2, { "t|time", "f|force|stress|relaxation" }, "t f", "t and f" }
};
enum { TESTS = sizeof tests / sizeof *tests };

static const char *const of_run[] = { "o", NULL };

typedef struct {
    fvi_subcommand_options words;
    fvi_options o;
    fvi_material_data data;
    fvi_element kind[FVI_MATERIAL_ELEMENTS];
    char names[DATA_COLUMNS][LETTERS]; /* names of the columns, as fvi_parse_table_columns takes them */
    size_t columns;
    double *block; /* columns at, first, second, unit and second unit of all files, then the curve */
    double *curve;
} request;

/* Return the first test that is asked for, but for the test `other`; -1 if there is none. */
static int test_of(int argc, char **argv, int other)
{
    for (int i = 2; i < argc && strcmp(argv[i], "--") != 0; i++)
        for (int k = 0; k < TESTS; k++)
            if (k != other && strncmp(argv[i], "--", 2) == 0 && strcmp(argv[i] + 2, tests[k].option) == 0)
                return k;
    return -1;
}

int fvi_fit_is_material(int argc, char **argv)
{
    return test_of(argc, argv, -1) >= 0;
}

/* ---- what is asked for ---- */

static int interpret_law(request *r, fvi_error *c)
{
    if (!r->words.own[LAW])
        r->words.own[LAW] = "spring+power";
    r->data.kind = r->kind;
    for (const char *at = r->words.own[LAW]; at; r->data.elements++) {
        char word[LETTERS] = "";
        const size_t length = strcspn(at, "+");
        size_t which = 0;
        if (r->data.elements == FVI_MATERIAL_ELEMENTS)
            return fvi_refuse(c, "law", "more than %d elements", FVI_MATERIAL_ELEMENTS);
        snprintf(word, sizeof word, "%.*s", (int)length, at);
        if (fvi_parse_word("law", word, fvi_element_words, &which, c))
            return 2;
        r->kind[r->data.elements] = (fvi_element)which;
        at = at[length] ? at + length + 1 : NULL;
    }
    return 0;
}

/* Collect the names of the columns, followed by those of --weights. */
static int interpret_weights(request *r, fvi_error *c)
{
    const char *text = r->words.own[WEIGHTS] ? r->words.own[WEIGHTS] : "relative";
    const size_t data = tests[r->data.test].columns;
    r->words.own[WEIGHTS] = text;
    for (; r->columns < data; r->columns++)
        strcpy(r->names[r->columns], tests[r->data.test].names[r->columns]);
    if (strcmp(text, "relative") == 0 || strcmp(text, "absolute") == 0)
        return 0;
    for (const char *at = text; at; r->columns++) {
        const size_t length = strcspn(at, ",");
        if (r->columns == 2 * data - 1 || length == 0 || length >= LETTERS)
            return fvi_refuse(c, "weights", "'%s' is not relative, absolute or the name of %s", text,
                              data == 3 ? "one column, or two for storage and loss" : "a column");
        snprintf(r->names[r->columns], LETTERS, "%.*s", (int)length, at);
        at = at[length] ? at + length + 1 : NULL;
    }
    return 0;
}

int fvi_fit_starts(const char **text, size_t most, size_t *starts, fvi_error *c)
{
    *text = *text ? *text : "20";
    const int status = fvi_parse_whole("starts", *text, most, starts, c);
    if (!status && *starts < 2)
        return fvi_refuse(c, "starts", "'%s' is less than 2: one start alone proves nothing", *text);
    return status;
}

static int interpret(request *r, fvi_error *c)
{
    fvi_subcommand_options *w = &r->words;
    int status = interpret_law(r, c);
    if (!status)
        status = interpret_weights(r, c);
    if (!status && w->own[SIGMA])
        status = fvi_parse_number("sigma", w->own[SIGMA], 0, INFINITY, "()", &r->data.sigma, c);
    if (!status)
        status = fvi_fit_starts(&w->own[STARTS], 10000, &r->data.starts, c);
    if (!status)
        status = fvi_check_second_file("curve", w->own[CURVE], r->o.output, c);
    if (!status && w->operands == 0)
        status = fvi_refuse(c, NULL, "DATA: a file with the columns %s is missing", tests[r->data.test].sentence);
    r->data.load = 1;
    return status;
}

/* ---- data ---- */

/* Refuse a file without names that has more columns than the test. An extra column is not skipped, because then the
 * first columns may not be what they seem. Return 0, or nonzero with the error filled in. */
static int check_width(const request *r, const char *file, fvi_error *c)
{
    const size_t count = tests[r->data.test].columns;
    const char *names[] = { r->names[0], r->names[1], r->names[count - 1], r->names[count - 1] };
    size_t which[FVI_COLUMNS_MOST], n;
    double *columns;
    fvi_error none;
    if (fvi_parse_table_columns("DATA", file, count + 1, names, 0, &n, &columns, which, &none))
        return 0;
    free(columns);
    return fvi_refuse(c, NULL, "DATA: '%s' has more than %zu columns, and no names: a line '# %s' would say which "
                      "are those of --%s", file, count, tests[r->data.test].line, tests[r->data.test].option);
}

/* Refuse a file that names columns of another test, because then its first columns are not what they seem. */
static int check_names(const request *r, const char *file, fvi_error *c)
{
    static const char *const of_moduli[] = { "omega|w|frequency|hertz|hz", "storage|Gp|G'|E'|G1|E1",
                                             "loss|Gpp|G''|E''|G2|E2" },
                            *const in_time[] = { "t|time", "x|strain|creep",
                                                 "force|stress|relaxation" };
    const int both = r->data.test == FVI_MATERIAL_MODULI;
    const char *own[] = { r->names[0], r->names[1], r->names[2] };
    for (size_t k = 0, count = 1; k < 4; k++) { /* k = 0: the columns of this test; k > 0: a column of another test */
        const char *const *names = k == 0 ? own : both ? in_time + k - 1 : of_moduli + k - 1;
        size_t which[FVI_COLUMNS_MOST], n;
        double *columns;
        fvi_error none;
        count = k > 0 ? 1 : tests[r->data.test].columns;
        if (fvi_parse_table_columns("DATA", file, count, names, 1, &n, &columns, which, &none))
            continue;
        free(columns);
        return k == 0 ? 0
                      : fvi_refuse(c, NULL, "DATA: '%s' has a column %.*s, and no %s: it is not of --%s",
                                   file, (int)strcspn(names[0], "|"), names[0], tests[r->data.test].sentence,
                                   tests[r->data.test].option);
    }
    return check_width(r, file, c);
}

/* Read the rows of one file, and add them after the rows of the files before. */
static int read_file(request *r, const char *file, fvi_error *c)
{
    const char *names[DATA_COLUMNS];
    size_t which[FVI_COLUMNS_MOST] = { 0 }, n;
    double *columns;
    if (check_names(r, file, c))
        return 2;
    const int must_be_named = r->columns > tests[r->data.test].columns    ? FVI_NAMES_NEEDED
                              : r->data.test == FVI_MATERIAL_MODULI ? FVI_FIRST_NAME_CHECKED
                                                                    : FVI_NAMES_OPTIONAL;
    for (size_t k = 0; k < r->columns; k++)
        names[k] = r->names[k];
    const int status = fvi_parse_table_columns("DATA", file, r->columns, names, must_be_named, &n,
                                         &columns, which, c);
    if (status)
        return status;
    double *more = realloc(r->block, DATA_COLUMNS * (r->data.n + n) * sizeof *more);
    if (!more) {
        free(columns);
        return fvi_no_memory(c, NULL);
    }
    r->block = more;
    const double unit = r->data.test == FVI_MATERIAL_MODULI && which[0] >= 2 ? 2 * M_PI : 1;
    for (size_t i = 0; i < n; i++) /* for now stored row by row */
        for (size_t k = 0; k < DATA_COLUMNS; k++)
            more[(r->data.n + i) * DATA_COLUMNS + k] =
                (k == 0 ? unit : 1) * (k < r->columns ? columns[k * n + i] : 1);
    r->data.n += n;
    free(columns);
    return 0;
}

/* Rearrange the rows into columns. Without --weights of its own the second unit is the first one. */
static int set_columns(request *r, fvi_error *c)
{
    const size_t n = r->data.n, data = tests[r->data.test].columns;
    double *all = malloc((DATA_COLUMNS + 2) * n * sizeof *all);
    if (!all)
        return fvi_no_memory(c, NULL);
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < DATA_COLUMNS; k++)
            all[k * n + i] = r->block[i * DATA_COLUMNS + k];
    free(r->block);
    r->block = all;
    r->curve = all + DATA_COLUMNS * n;
    r->data.at = all;
    r->data.first = all + n;
    r->data.second = all + 2 * n;
    if (strcmp(r->words.own[WEIGHTS], "relative") != 0)
        r->data.unit = all + data * n;
    if (r->columns == 5)
        r->data.second_unit = all + 4 * n;
    return 0;
}

static int read_data(request *r, fvi_error *c)
{
    for (size_t i = 0; i < r->words.operands; i++)
        fvi_mark_read("DATA", r->words.all[i]);
    int status = fvi_check_output("-o", r->o.output, c);
    if (!status)
        status = fvi_check_output("--curve", r->words.own[CURVE], c);
    for (size_t i = 0; !status && i < r->words.operands; i++)
        status = read_file(r, r->words.all[i], c);
    return status ? status : set_columns(r, c);
}

/* ---- the answer ---- */

/* Print the law as --damping takes it, for example "spring:1 + zener:3,0.25,1.5". */
static void print_law(FILE *out, const request *r, const fvi_material *m)
{
    size_t j = 0;
    fputs("# damping = ", out);
    for (size_t n = 0; n < r->data.elements; n++) {
        fprintf(out, "%s%s", n ? " + " : "", fvi_element_words[r->kind[n]]);
        for (size_t i = 0; fvi_element_number(r->kind[n], i, NULL); i++)
            fvi_print_number(out, i ? "," : ":", m->estimate[j++]);
    }
    fputc('\n', out);
}

static void print_rows(FILE *out, const request *r, const fvi_material *m)
{
    size_t j = 0;
    fputs("# name\testimate\tsd\tlower\tupper\n", out);
    for (size_t n = 0; n < r->data.elements; n++) {
        const char *name;
        for (size_t i = 0; (name = fvi_element_number(r->kind[n], i, NULL)); i++, j++) {
            fprintf(out, "%s%zu.%s", fvi_element_words[r->kind[n]], n + 1, name);
            fvi_print_estimate(out, m->estimate[j], m->sd[j], m->lower[j], m->upper[j]);
        }
    }
}

static void print_answer(FILE *out, const request *r, const fvi_material *m)
{
    fvi_format_begin(out, FVI_FORMAT_TSV);
    for (size_t i = 0; i < r->words.operands; i++)
        fvi_format_parameter(out, FVI_FORMAT_TSV, tests[r->data.test].option, r->words.all[i]);
    fvi_format_parameter(out, FVI_FORMAT_TSV, "law", r->words.own[LAW]);
    fvi_format_parameter(out, FVI_FORMAT_TSV, "weights", r->words.own[WEIGHTS]);
    if (r->words.own[SIGMA])
        fvi_format_parameter(out, FVI_FORMAT_TSV, "sigma", r->words.own[SIGMA]);
    print_rows(out, r, m);
    if (r->data.sigma > 0) {
        fvi_print_number(out, "# chi2 = ", m->chi2);
        fprintf(out, "\n# probability = %.3g", m->probability);
    } else
        fvi_print_number(out, "# estimated sigma = ", m->sigma);
    fprintf(out, "\n# points = %zu\n# starts = %zu, %zu agree\n# neighbours = %.2f\n", r->data.n,
            m->starts, m->agree, m->neighbours);
    print_law(out, r, m);
}

void fvi_fit_note(FILE *out, const char *kind, const char *text)
{
    fvi_warn(text);
    if (out)
        fprintf(out, "# %s = %s\n", kind, text);
}

static void print_flags(FILE *out, const request *r, const fvi_material *m)
{
    char text[FVI_WARNING_ROOM];
    for (unsigned flag = 1; flag <= m->flags; flag *= 2)
        if (fvi_material_flag_text(&r->data, m, flag, sizeof text, text))
            fvi_fit_note(out, "flag", text);
}

static int print_curve(const request *r)
{
    const size_t n = r->data.n, both = r->data.test == FVI_MATERIAL_MODULI;
    if (!r->words.own[CURVE])
        return 0;
    FILE *out = fvi_output_open(r->words.own[CURVE]);
    if (!out)
        return fvi_cannot_write(r->words.own[CURVE]);
    fputs(both ? "# omega\tstorage\tloss\tstorage_fit\tloss_fit\n" : "# t\tdata\tfit\tresidual\n",
          out);
    for (size_t i = 0; i < n; i++) {
        const double first = r->data.first[i], *curve = r->curve;
        if (both)
            fvi_format_row(out, FVI_FORMAT_TSV, i, 5,
                           (double[]){ r->data.at[i], first, r->data.second[i], curve[i],
                                       curve[n + i] });
        else
            fvi_format_row(out, FVI_FORMAT_TSV, i, 4,
                           (double[]){ r->data.at[i], first, curve[i], first - curve[i] });
    }
    return fvi_output_close(out, 1) ? fvi_cannot_write(r->words.own[CURVE]) : 0;
}

int fvi_fit_tell_unwritten(const char *output, const char *curve)
{
    if (output || curve)
        fprintf(stderr, "fvi: the answer is not believed, and nothing is written into %s%s%s\n", output ? output : "",
                output && curve ? " and " : "", curve ? curve : "");
    return 1;
}

/* Print the answer. As in a fit of a motion, an answer that is not believed goes to standard output only. Return an
 * exit code. */
static int print(const request *r, const fvi_material *m)
{
    if (m->grave && r->o.output) {
        print_flags(NULL, r, m);
        return fvi_fit_tell_unwritten(r->o.output, r->words.own[CURVE]);
    }
    FILE *out = fvi_output_open(r->o.output);
    if (!out)
        return fvi_cannot_write(r->o.output);
    print_answer(out, r, m);
    print_flags(out, r, m);
    if (fvi_output_close(out, 1))
        return fvi_cannot_write(r->o.output);
    return m->grave ? fvi_fit_tell_unwritten(NULL, r->words.own[CURVE]) : print_curve(r);
}

/* ---- the command ---- */

/* Fit the data. If the library refuses a number of the data, the error names DATA and its column. Return 0, or a code
 * with the error filled in. */
static int fit_data(const request *r, fvi_material *m, fvi_error *c)
{
    const char *const fields[][2] = { { "at", r->data.test == FVI_MATERIAL_MODULI ? "omega " : "t " },
                                      { "data", "" },
                                      { "unit", "an error " } };
    fvi_error of_data;
    const int status = fvi_material_fit(&r->data, r->curve, m, &of_data);
    if (!status)
        return 0;
    for (size_t i = 0; i < 3; i++)
        if (of_data.field && strcmp(of_data.field, fields[i][0]) == 0)
            return fvi_refuse(c, "DATA", "%s: %s%s", r->words.all[0], fields[i][1], of_data.text);
    *c = of_data;
    return status;
}

int fvi_fit_material(int argc, char **argv)
{
    const int test = test_of(argc, argv, -1), second = test_of(argc, argv, test);
    const fvi_own_command command = { .name = "fit",
                                      .own = { "law", "weights", "sigma", "starts", "curve" },
                                      .with = of_run,
                                      .operand = FVI_OPERANDS_MOST,
                                      .flag = tests[test].option };
    fvi_error error, *c = &error;
    fvi_material m;
    request r = { .data = { .test = (fvi_material_test)test } };
    int status = second < 0 ? fvi_subcommand_options_parse(&command, argc, argv, &r.words, &r.o, c)
                            : fvi_refuse(c, tests[second].option, "not together with --%s", tests[test].option);
    if (!status)
        status = interpret(&r, c);
    if (!status)
        status = read_data(&r, c);
    if (!status)
        status = fit_data(&r, &m, c);
    status = status ? fvi_refused(&error, "fit") : print(&r, &m);
    fvi_options_free(&r.o);
    free(r.block);
    return status;
}
