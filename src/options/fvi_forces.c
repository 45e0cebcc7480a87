/* src/options/fvi_forces.c -- Forces that are typed, or stand in a file. */
#define _GNU_SOURCE /* strdup */
#include "fvi_forces.h"

#include "input/fvi_data.h"
#include "input/fvi_polygon.h"
#include <fvi/error.h>
#include "system/larger.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* One of: an expression, a table of n rows, an impulse p[0] at p[1], a force of the
 * library's. */
typedef struct {
    fvi_expression *expression;
    size_t n;
    double *t, *F;
    int hits;
    fvi_forcing kind;
    double p[2];
} part;

struct fvi_forces {
    size_t count;
    part *parts;
    size_t jump_count; /* the ends of steps, then the rows of tables */
    double *jumps;
    size_t impulse_count; /* in the order of their times */
    fvi_impulse *impulses;
    double *J; /* d numbers each */
};

/* ---- values ---- */

static fvi_polygon rows_of(const part *p)
{
    return (fvi_polygon){ p->n, 1, p->t, p->F };
}

static fvi_force ready_made(const part *p)
{
    return p->kind == FVI_FORCING_STEP ? fvi_force_step(p->p)
                                       : fvi_force_cosine(p->p);
}

static int value_of(const part *p, double t, double *F)
{
    if (p->expression) {
        *F = fvi_expression_value(p->expression, &t);
        return 0;
    }
    if (p->t) {
        const fvi_polygon rows = rows_of(p);
        *F = fvi_polygon_value(&rows, t);
        return 0;
    }
    *F = 0;
    if (p->hits)
        return 0;
    const fvi_force force = ready_made(p);
    return force.value(t, 1, force.params, F);
}

static int bound_of(const part *p, double from, double to, size_t order,
                    double *most)
{
    memset(most, 0, (order + 1) * sizeof *most);
    if (p->t) {
        const fvi_polygon rows = rows_of(p);
        fvi_polygon_bound(&rows, from, to, order, 1, most);
        return 0;
    }
    if (p->hits)
        return 0;
    const fvi_force force = p->expression
                                ? fvi_force_expression(p->expression)
                                : ready_made(p);
    return force.bound(from, to, order, 1, force.params, most);
}

double fvi_forces_by_parameter(const fvi_forces *f, size_t j, double t)
{
    double sum = 0;
    for (size_t i = 0; i < f->count; i++) {
        double one = 0;
        if (f->parts[i].expression)
            fvi_expression_parameter_gradient(f->parts[i].expression, j, &t, &one,
                                        NULL);
        sum += one;
    }
    return sum;
}

static int force_value(double t, size_t d, void *params, double *F)
{
    const fvi_forces *f = params;
    double sum = 0;
    for (size_t i = 0; i < f->count; i++) {
        double one;
        int status = value_of(&f->parts[i], t, &one);
        if (status)
            return status;
        sum += one;
    }
    for (size_t i = 0; i < d; i++)
        F[i] = sum;
    return 0;
}

static int force_bound(double from, double to, size_t order, size_t d,
                       void *params, double *most)
{
    const fvi_forces *f = params;
    double one[FVI_BOUND_ORDER + 1], sum[FVI_BOUND_ORDER + 1] = { 0 };
    for (size_t i = 0; i < f->count; i++) {
        int status = bound_of(&f->parts[i], from, to, order, one);
        if (status)
            return status;
        for (size_t k = 0; k <= order; k++)
            sum[k] += one[k];
    }
    for (size_t k = 0; k <= order; k++)
        for (size_t i = 0; i < d; i++)
            most[k * d + i] = sum[k];
    return 0;
}

fvi_force fvi_forces_force(const fvi_forces *f)
{
    return (fvi_force){ .value = force_value,
                        .bound = force_bound,
                        .params = (void *)f,
                        .jumps = f->jumps,
                        .jump_count = f->jump_count,
                        .impulses = f->impulses,
                        .impulse_count = f->impulse_count };
}

double fvi_forces_jump(const fvi_forces *f, size_t i)
{
    for (size_t n = 0; n < f->count; n++)
        if ((f->parts[n].kind == FVI_FORCING_STEP || f->parts[n].hits)
            && i-- == 0)
            return f->parts[n].p[1];
    return NAN;
}

void fvi_forces_free(fvi_forces *f)
{
    for (size_t i = 0; f && i < f->count; i++) {
        fvi_expression_free(f->parts[i].expression);
        free(f->parts[i].t);
    }
    if (f) {
        free(f->parts);
        free(f->jumps);
        free(f->impulses);
        free(f->J);
    }
    free(f);
}

/* ---- words ---- */

/* A table from 0 to the end of the run: nothing is made up. */
static int read_file(part *p, const char *name, double last, fvi_complaint c)
{
    static const char *const columns[] = { "t", "F" };
    int status = fvi_data_table("force", name, columns, &p->n, &p->t, &p->F, c);
    if (status)
        return status;
    if (p->t[0] > 0)
        return fvi_refuse(c, "--force: %s begins at t = %g, the run at 0", name,
                          p->t[0]);
    if (p->t[p->n - 1] < last * (1 - 1e-12))
        return fvi_refuse(c, "--force: %s ends at t = %g, the run at %g", name,
                          p->t[p->n - 1], last);
    return 0;
}

static int read_expression(part *p, const char *text, fvi_user_parameters *lets,
                           fvi_complaint c)
{
    fvi_misprint wrong;
    int status = fvi_user_parameters_parse(lets, "t", 1, text, &p->expression, &wrong);
    if (status == FVI_ENOMEM) {
        fvi_refuse(c, "not enough memory");
        return 1;
    }
    return status ? fvi_refuse_at(c, "force", text, wrong) : 0;
}

/* One that comes when the run is over, or has not begun, would be ignored. */
static int read_impulse(part *p, const char *text, double last, fvi_complaint c)
{
    p->hits = 1;
    if (!(p->p[1] >= 0 && p->p[1] <= last * (1 + 1e-12)))
        return fvi_refuse(c, "--force: '%s' is not within the run, 0 <= T <= %g",
                          text, last);
    return 0;
}

/* One part: a word with a colon, or an expression. */
static int read_part(part *p, const char *text, fvi_user_parameters *lets,
                     double last, fvi_complaint c)
{
    static const char *const words[] = { "none",    "step", "cosine",
                                         "impulse", "file", NULL };
    static const char *const forms[] = { "none", "step:A,T", "cosine:A,W",
                                         "impulse:J,T", "file:F.tsv" };
    const size_t length = strcspn(text, ":");
    if (length == 4 && text[length] && strncasecmp(text, "file", 4) == 0)
        return read_file(p, text + 5, last, c);
    if (fvi_word_force(text, &p->kind, p->p))
        return p->kind == FVI_FORCING_STEP && p->p[1] < 0
                   ? fvi_refuse(c, "--force: '%s' ends before it begins", text)
                   : 0;
    if (fvi_word_call(text, "impulse", 2, p->p))
        return read_impulse(p, text, last, c);
    for (size_t i = 0; words[i]; i++)
        if (strlen(words[i]) == length
            && strncasecmp(words[i], text, length) == 0)
            return fvi_refuse(c, "--force: '%s' is not %s", text, forms[i]);
    char place[64];
    fvi_word_hint(text, length, words, place);
    if (text[length] || *place)
        return fvi_refuse(c,
                          "--force: '%s' is none of none, step:A,T, "
                          "cosine:A,W, impulse:J,T, file:F.tsv%s",
                          text, place);
    return read_expression(p, text, lets, c);
}

/* Does a word with a colon begin here? */
static int is_call(const char *at)
{
    const size_t letters = strspn(at, "abcdefghijklmnopqrstuvwxyz"
                                      "ABCDEFGHIJKLMNOPQRSTUVWXYZ");
    return letters > 0 && at[letters] == ':';
}

/* Where the part ends that begins at `at`: before a " + " if that part, or the next one, is
 * a word with a colon; what stands between two of them is one expression. */
static const char *end_of_part(const char *at)
{
    const int called = is_call(at);
    for (const char *plus = at; (plus = strstr(plus, " + ")); plus += 3)
        if (called || is_call(plus + 3 + strspn(plus + 3, " ")))
            return plus;
    return at + strlen(at);
}

/* Where the sum is not smooth. Returns 0, or 1 if there is no memory. */
static int collect_jumps(fvi_forces *f)
{
    size_t room = 0;
    for (size_t i = 0; i < f->count; i++)
        room += f->parts[i].t ? f->parts[i].n : 1;
    f->jumps = malloc(room * sizeof *f->jumps);
    if (!f->jumps)
        return 1;
    for (double t; !isnan(t = fvi_forces_jump(f, f->jump_count));)
        f->jumps[f->jump_count++] = t;
    for (size_t i = 0; i < f->count; i++)
        for (size_t k = 0; f->parts[i].t && k < f->parts[i].n; k++)
            f->jumps[f->jump_count++] = f->parts[i].t[k];
    return 0;
}

static int by_time(const void *a, const void *b)
{
    const fvi_impulse *x = a, *y = b;
    return (x->t > y->t) - (x->t < y->t);
}

/* Each on all d masses. Returns 0, or 1 if there is no memory. */
static int collect_impulses(fvi_forces *f, size_t d)
{
    size_t n = 0;
    for (size_t i = 0; i < f->count; i++)
        n += f->parts[i].hits != 0;
    if (n == 0)
        return 0;
    f->impulses = malloc(n * sizeof *f->impulses);
    f->J = malloc(n * d * sizeof *f->J);
    if (!f->impulses || !f->J)
        return 1;
    for (size_t i = 0; i < f->count; i++) {
        if (!f->parts[i].hits)
            continue;
        double *J = f->J + f->impulse_count * d;
        for (size_t j = 0; j < d; j++)
            J[j] = f->parts[i].p[0];
        f->impulses[f->impulse_count++] =
            (fvi_impulse){ .t = f->parts[i].p[1], .J = J };
    }
    qsort(f->impulses, n, sizeof *f->impulses, by_time);
    return 0;
}

int fvi_forces_parse(const char *text, size_t d, fvi_user_parameters *lets, double last,
                     fvi_forces **f, fvi_complaint c)
{
    char *copy = strdup(text);
    fvi_forces *new = calloc(1, sizeof *new);
    int status = copy && new ? 0 : 1;
    for (const char *at = text, *end; !status; at = end + 3) {
        at += strspn(at, " ");
        end = end_of_part(at);
        part *parts =
            realloc(new->parts, (new->count + 1) * sizeof *new->parts);
        if (!parts) {
            status = 1;
            break;
        }
        new->parts = parts;
        parts[new->count] = (part){ .kind = FVI_FORCING_NONE };
        char *word = memcpy(copy, at, (size_t)(end - at));
        word[end - at] = '\0';
        status = read_part(&parts[new->count++], word, lets, last, c);
        if (*end == '\0')
            break;
    }
    if (!status)
        status = collect_jumps(new);
    if (!status)
        status = collect_impulses(new, d);
    if (status == 1)
        fvi_refuse(c, "not enough memory");
    free(copy);
    if (status)
        fvi_forces_free(new);
    else
        *f = new;
    return status;
}
