/* src/command_gradient/fvi_gradient_choice.c -- Find the rows of `fvi gradient` for which --by asks. */
#include "fvi_gradient_choice.h"

#include "fvi_gradient_rows.h"

#include <fvi/parse.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef fvi_gradient_request request;
typedef fvi_gradient_visitor visitor;

enum { LETTERS = FVI_GRADIENT_LETTERS };

/* Each of these names stands for the rows of all masses. */
static const char *const of_masses[] = { "x0", "p0", "mass", "rho", NULL };

/* Return nonzero if a word of --by, of this length, is the name of a row, or stands for the rows of all masses to which
 * this row belongs. */
static int is_name_of_row(const char *word, size_t length, const char *name)
{
    if (strncmp(word, name, length) != 0)
        return 0;
    for (int i = 0; of_masses[i]; i++)
        if (strlen(of_masses[i]) == length && strncmp(word, of_masses[i], length) == 0
            && name[length] == '_')
            return 1;
    return name[length] == '\0';
}

int fvi_gradient_has_row(const request *r, const char *name)
{
    const char *word = r->words.own[BY];
    while (word && *word) {
        const size_t length = strcspn(word, ",");
        if (is_name_of_row(word, length, name))
            return 1;
        word += length + (word[length] == ',');
    }
    return !r->words.own[BY];
}

/* All names of rows, and the arrays that contain a number that is asked for. */
enum { FIELDS = 10 };
typedef struct {
    char name[LETTERS];
    char reason[3 * LETTERS]; /* why there is no derivative, or empty */
} row;

typedef struct {
    request *r;
    row *row; /* freed by the caller */
    size_t count;
    struct {
        double **to;
        size_t size;
        int is_wanted;
    } field[FIELDS];
} choice;

static void add_row(void *to, const char *name, const double *by, const char *warning)
{
    choice *c = to;
    row *here = c->row + c->count++;
    snprintf(here->name, sizeof here->name, "%s", name);
    if (warning)
        snprintf(here->reason, sizeof here->reason, "%s", warning);
    else if (by && isnan(*by))
        snprintf(here->reason, sizeof here->reason, FVI_GRADIENT_NO_START, name);
    for (size_t i = 0; by && i < FIELDS; i++)
        if (*c->field[i].to && by >= *c->field[i].to && by < *c->field[i].to + c->field[i].size)
            c->field[i].is_wanted |= fvi_gradient_has_row(c->r, name);
}

static void count_row(void *to, const char *name, const double *by, const char *warning)
{
    (void)name, (void)by, (void)warning;
    ++*(size_t *)to;
}

/* Collect all rows, and mark the arrays in all->field that are wanted. */
static int add_rows(request *r, choice *all, fvi_error *c)
{
    size_t rows = 0;
    fvi_gradient_rows(r, &(visitor){ count_row, &rows });
    all->r = r;
    all->row = calloc(rows + 1, sizeof *all->row);
    if (!all->row)
        return fvi_no_memory(c, NULL);
    fvi_gradient_rows(r, &(visitor){ add_row, all });
    return 0;
}

/* Collect the names of --by that stand for all masses. Return their number. */
static size_t name_all_masses(const request *r, const char **known)
{
    const size_t count = !r->o.numbered                           ? 0
                         : !r->has_mass || r->system.matrices     ? 2
                         : r->terms || r->system.mechanism        ? 3
                                                                  : 4;
    for (size_t i = 0; i < count; i++)
        known[i] = of_masses[i];
    return count;
}

/* Refuse a word of this length if none of its rows has a derivative. The reason is that of the last of these rows. */
static int check_has_derivative(const choice *all, const char *word, size_t length, fvi_error *c)
{
    const char *reason = NULL;
    for (size_t i = 0; i < all->count; i++) {
        if (!is_name_of_row(word, length, all->row[i].name))
            continue;
        if (!*all->row[i].reason)
            return 0;
        reason = all->row[i].reason;
    }
    return reason ? fvi_refuse(c, "by", "'%.*s': %s", (int)length, word, reason) : 0;
}

int fvi_gradient_check_answer(request *r, fvi_error *c)
{
    choice all = { .count = 0 };
    if (!r->words.own[BY])
        return 0;
    for (size_t i = 0; i < FIELDS; i++) /* the derivatives are known by now, so no array has to be marked */
        all.field[i].to = &r->numbers;
    int status = add_rows(r, &all, c);
    for (const char *at = r->words.own[BY]; at && !status; at = strchr(at, ',')) {
        at += *at == ',';
        status = check_has_derivative(&all, at, strcspn(at, ","), c);
    }
    free(all.row);
    return status;
}

static int check_words(const request *r, const choice *all, fvi_error *c)
{
    const char **known = calloc(all->count + 5, sizeof *known);
    char word[LETTERS];
    int status = known ? 0 : fvi_no_memory(c, NULL);
    size_t which, n = known ? name_all_masses(r, known) : 0;
    for (size_t i = 0; known && i < all->count; i++)
        known[n++] = all->row[i].name;
    for (const char *at = r->words.own[BY]; at && !status;) {
        const size_t length = strcspn(at, ",");
        snprintf(word, sizeof word, "%.*s", (int)length, at);
        if (fvi_parse_word("by", word, known, &which, c)
            || check_has_derivative(all, at, length, c))
            status = 2;
        at = at[length] ? at + length + 1 : NULL;
    }
    free(known);
    return status;
}

int fvi_gradient_choose(request *r, fvi_error *c)
{
    const size_t d = r->o.d, terms = fvi_gradient_terms(r),
                 constants = r->system.matrices ? 1 : r->to.sensitivity.count;
    choice all = { .count = 0 };
    if (!r->words.own[BY])
        return 0;
    double **const to[] = { &r->to.x0,    &r->to.p0,     &r->to.mass,  &r->to.damping,
                            &r->to.alpha, &r->to.terms,  &r->to.orders, &r->to.times,
                            &r->to.ends,  &r->to.parameters };
    const size_t size[] = { d, d, d, d + fvi_gradient_dampers(r), 1, terms, terms, terms,
                            terms, constants };
    for (size_t i = 0; i < FIELDS; i++) {
        all.field[i].to = to[i];
        all.field[i].size = size[i];
    }
    int status = add_rows(r, &all, c);
    if (!status)
        status = check_words(r, &all, c);
    enum { TERMS = 5, TIMES = 7 }; /* the derivative by rho1 of two springpots in series also needs that by the time */
    all.field[TIMES].is_wanted |= all.field[TERMS].is_wanted && r->has_pairs;
    for (size_t i = 0; i < FIELDS; i++)
        if (!all.field[i].is_wanted)
            *to[i] = NULL;
    r->by_lets = 0;
    for (size_t j = 0; j < r->o.lets.count; j++)
        r->by_lets |= fvi_gradient_has_row(r, r->o.lets.name[j]);
    if (!r->by_lets)
        r->to.names = NULL;
    free(all.row);
    return status;
}
