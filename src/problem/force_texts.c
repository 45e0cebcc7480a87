/* src/problem/force_texts.c -- Parse the texts of forces, such as step:8,1 + file:F.csv. */
#define _GNU_SOURCE /* for strdup */
#include "typed_force.h"
#include "words.h"
#include <fvi/formulas.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* Read "F.csv", or "F.csv:TIME,VALUE" with the names of two columns, which the file must then have. */
static int read_columns(fvi_force_part *p, const char *field, const char *text, size_t *n, double **t, double **F,
                        fvi_error *error)
{
    const char *colon = strrchr(text, ':'),
               *comma = colon ? strchr(colon, ',') : NULL;
    if (!comma) {
        const char *const columns[] = { "t", strcmp(field, "ground") ? "F" : "ag" };
        p->file = strdup(text);
        return p->file ? fvi_parse_table(field, text, columns, n, t, F, error) : fvi_no_memory(error, field);
    }
    char *time = strndup(colon + 1, (size_t)(comma - colon - 1));
    p->file = strndup(text, (size_t)(colon - text));
    const char *const columns[] = { time, comma + 1 };
    const int status = time && p->file ? fvi_parse_named_table(field, p->file, columns, n, t, F, error)
                                       : fvi_no_memory(error, field);
    free(time);
    return status;
}

/* Read a table. It must reach from 0 to the end of the run, because nothing is extrapolated. */
static int read_file(fvi_force_part *p, const char *field, const char *text, double gain,
                     double last, fvi_error *error)
{
    size_t n;
    double *t, *F;
    const int status = read_columns(p, field, text, &n, &t, &F, error);
    if (status)
        return status;
    p->table = (fvi_force_rows){ n, 1, t, F };
    for (size_t i = 0; i < n; i++)
        F[i] *= gain;
    if (!fvi_all_finite(n, F))
        return fvi_fail(error, FVI_EDOM, field, gain, "a number of %s times its factor is not finite", p->file);
    if (t[0] > 0)
        return fvi_fail(error, FVI_EDOM, field, t[0], "%s begins at t = %g, the run at 0", p->file, t[0]);
    if (t[n - 1] < last * (1 - 1e-12))
        return fvi_fail(error, FVI_EDOM, field, t[n - 1], "%s ends at t = %g, the run at %g", p->file, t[n - 1], last);
    return FVI_SUCCESS;
}

/* Return where "file:" stands after a factor, as in "-9.81*file:g.csv"; NULL if it does not. */
static const char *file_behind_factor(const char *text, size_t length)
{
    for (const char *at = text; at + 6 <= text + length; at++)
        if (strncasecmp(at, "*file:", 6) == 0)
            return at + 1;
    return NULL;
}

/* Read a table with a factor, which is an expression of numbers only. */
static int read_scaled_file(fvi_force_part *p, const char *field, const char *text,
                            const char *file, double last, fvi_error *error)
{
    fvi_expression *e = NULL;
    char *factor = strndup(text, (size_t)(file - 1 - text));
    int status = factor ? fvi_parse_expression(field, NULL, 0, factor, NULL, &e,
                                               error)
                        : fvi_no_memory(error, field);
    free(factor);
    if (status)
        return status;
    const double gain = fvi_expression_value(e, NULL);
    fvi_expression_free(e);
    return read_file(p, field, file + 5, gain, last, error);
}

/* Take an impulse. One before the start or after the end of the run would have no effect, so it is refused. */
static int parse_impulse(fvi_force_part *p, const char *field, const char *text,
                         double last, fvi_error *error)
{
    p->is_impulse = 1;
    if (!(p->constants[1] >= 0 && p->constants[1] <= last * (1 + 1e-12)))
        return fvi_fail(error, FVI_EDOM, field, p->constants[1], "'%s' is not within the run, 0 <= T <= %g", text,
                        last);
    return FVI_SUCCESS;
}

/* Scan none, step:A,T or cosine:A,W. Return nonzero if the text is one of them. */
static int scan_ready_made(fvi_force_part *p, const char *text)
{
    p->kind = strcasecmp(text, "none") == 0             ? FVI_FORCING_NONE
              : fvi_scan_call(text, "step", 2, p->constants)   ? FVI_FORCING_STEP
                                                       : FVI_FORCING_COSINE;
    return p->kind != FVI_FORCING_COSINE
           || fvi_scan_call(text, "cosine", 2, p->constants);
}

/* Parse an expression in t. If it is one in x or v, the message names the option for such forces, because it is no
 * typing error. */
static int parse_expression(fvi_force_part *p, const char *field, const char *text,
                            fvi_user_parameters *parameters, fvi_error *error)
{
    fvi_error state = { 0 };
    const size_t d = fvi_largest_index(text);
    int status = fvi_parse_expression(field, "t", 1, text, parameters,
                                      &p->expression, error);
    if (status != FVI_EINVAL || d == 0
        || fvi_parse_state_expression(field, d, 1, text, parameters,
                                      &p->expression, &state))
        return status;
    fvi_expression_free(p->expression);
    p->expression = NULL;
    return fvi_refuse(error, field, "'%s': a force knows t alone; --force-on knows x and v", text);
}

/* Parse one part of a sum: a word with a colon, or an expression. */
static int parse_part(fvi_force_part *p, const char *field, const char *text,
                      fvi_user_parameters *parameters, double last,
                      fvi_error *error)
{
    static const char *const words[] = { "none",    "step", "cosine",
                                         "impulse", "file", NULL };
    const size_t length = strcspn(text, ":"),
                 word = fvi_scan_word(text, length, words);
    if (length == 4 && text[length] && strncasecmp(text, "file", 4) == 0)
        return read_file(p, field, text + 5, 1, last, error);
    const char *file = file_behind_factor(text, strlen(text));
    if (file)
        return read_scaled_file(p, field, text, file, last, error);
    if (scan_ready_made(p, text))
        return p->kind == FVI_FORCING_STEP && p->constants[1] < 0
                   ? fvi_fail(error, FVI_EDOM, field, p->constants[1], "'%s' ends before it begins", text)
                   : FVI_SUCCESS;
    p->kind = FVI_FORCING_NONE;
    if (fvi_scan_call(text, "impulse", 2, p->constants))
        return parse_impulse(p, field, text, last, error);
    if (words[word])
        return fvi_refuse(error, field, "'%s' is not %s", text, word ? fvi_force_formulas[word - 1].form : words[0]);
    char place[64];
    fvi_word_hint(text, length, words, place);
    if (text[length] || *place)
        return fvi_refuse(error, field, "'%s' is none of none, step:A,T, cosine:A,W, impulse:J,T, file:F.tsv%s", text,
                          place);
    return parse_expression(p, field, text, parameters, error);
}

/* Return nonzero if a word with a colon begins here, or a factor before one. */
static int is_call(const char *at)
{
    const size_t letters = strspn(at, "abcdefghijklmnopqrstuvwxyz"
                                      "ABCDEFGHIJKLMNOPQRSTUVWXYZ");
    const char *next = strstr(at, " + ");
    return (letters > 0 && at[letters] == ':')
           || file_behind_factor(at, next ? (size_t)(next - at) : strlen(at));
}

/* Return the end of the part that begins at `at`: before a " + " if this part, or the next one, is a word with a colon.
 * What stands between two such words is a single expression. */
static const char *end_of_part(const char *at)
{
    const int called = is_call(at);
    for (const char *plus = at; (plus = strstr(plus, " + ")); plus += 3)
        if (called || is_call(plus + 3 + strspn(plus + 3, " ")))
            return plus;
    return at + strlen(at);
}

/* Collect the times at which the sum is not smooth. Return 0 or FVI_ENOMEM. */
static int collect_jumps(fvi_typed_force *f)
{
    size_t room = 0;
    for (size_t i = 0; i < f->count; i++)
        room += 1 + f->parts[i].table.n;
    f->jumps = malloc(room * sizeof *f->jumps);
    if (!f->jumps)
        return FVI_ENOMEM;
    for (double t; !isnan(t = fvi_typed_force_jump(f, f->jump_count));)
        f->jumps[f->jump_count++] = t;
    for (size_t i = 0; i < f->count; i++)
        for (size_t k = 0; k < f->parts[i].table.n; k++)
            f->jumps[f->jump_count++] = f->parts[i].table.t[k];
    return 0;
}

static int compare_times(const void *a, const void *b)
{
    const fvi_impulse *x = a, *y = b;
    return (x->t > y->t) - (x->t < y->t);
}

/* Collect the impulses, each on all d masses, in the order of their times. Return 0 or FVI_ENOMEM. */
static int collect_impulses(fvi_typed_force *f, size_t d)
{
    size_t n = 0;
    for (size_t i = 0; i < f->count; i++)
        n += f->parts[i].is_impulse != 0;
    if (n == 0)
        return 0;
    f->impulses = malloc(n * sizeof *f->impulses);
    f->J = malloc(n * d * sizeof *f->J);
    if (!f->impulses || !f->J)
        return FVI_ENOMEM;
    for (size_t i = 0; i < f->count; i++) {
        if (!f->parts[i].is_impulse)
            continue;
        double *J = f->J + f->impulse_count * d;
        for (size_t j = 0; j < d; j++)
            J[j] = f->parts[i].constants[0];
        f->impulses[f->impulse_count++] =
            (fvi_impulse){ .t = f->parts[i].constants[1], .J = J };
    }
    qsort(f->impulses, n, sizeof *f->impulses, compare_times);
    return 0;
}

/* Add a part to the sum. `word` has room for its text. */
static int add_part(fvi_typed_force *f, const char *field, char *word,
                    const char *at, size_t length,
                    fvi_user_parameters *parameters, double last,
                    fvi_error *error)
{
    fvi_force_part *parts = realloc(f->parts, (f->count + 1) * sizeof *parts);
    if (!parts)
        return fvi_no_memory(error, field);
    f->parts = parts;
    parts[f->count] = (fvi_force_part){ .kind = FVI_FORCING_NONE };
    memcpy(word, at, length);
    word[length] = '\0';
    return parse_part(&parts[f->count++], field, word, parameters, last, error);
}

int fvi_parse_force(const char *text, size_t d, fvi_user_parameters *parameters,
                    double last, fvi_typed_force **force, fvi_error *error)
{
    return fvi_parse_force_of("force", text, d, parameters, last, force, error);
}

int fvi_parse_force_of(const char *field, const char *text, size_t d,
                       fvi_user_parameters *parameters, double last,
                       fvi_typed_force **force, fvi_error *error)
{
    if (!text || !force)
        return fvi_fail(error, FVI_EFAULT, field, NAN, "null pointer");
    char *word = malloc(strlen(text) + 1);
    fvi_typed_force *new = calloc(1, sizeof *new);
    int status = word && new ? FVI_SUCCESS : fvi_no_memory(error, field);
    for (const char *at = text, *end; !status; at = end + 3) {
        at += strspn(at, " ");
        end = end_of_part(at);
        status = add_part(new, field, word, at, (size_t)(end - at), parameters, last,
                          error);
        if (*end == '\0')
            break;
    }
    if (!status && (collect_jumps(new) || collect_impulses(new, d)))
        status = fvi_no_memory(error, field);
    free(word);
    if (status) {
        fvi_typed_force_free(new);
        return status;
    }
    fvi_typed_force_finish(new);
    *force = new;
    return FVI_SUCCESS;
}
