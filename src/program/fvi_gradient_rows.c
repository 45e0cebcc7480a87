/* src/program/fvi_gradient_rows.c -- The rows of `fvi gradient`, by name. */
#include "fvi_gradient_rows.h"

#include <fvi/rheology.h>

#include <stdlib.h>
#include <string.h>

typedef fvi_gradient_request request;
typedef fvi_gradient_visitor visitor;

enum { LETTERS = 80 };

/* ---- all rows ---- */

/* Number i of an array; NULL if it is not asked for. */
static const double *at(const double *by, size_t i)
{
    return by ? by + i : NULL;
}

static void row(const visitor *v, const char *name, const char *number, const double *by)
{
    char whole[LETTERS];
    snprintf(whole, sizeof whole, "%s%s", name, number);
    v->visit(v->to, whole, by, NULL);
}

static void warn(const visitor *v, const char *name, const char *text, const char *about)
{
    char whole[3 * LETTERS];
    snprintf(whole, sizeof whole, text, about);
    v->visit(v->to, name, NULL, whole);
}

/* One for each mass: name, or name_1, name_2, ... */
static void rows_of_masses(const visitor *v, const request *r, const char *name, const double *by)
{
    for (size_t i = 0; i < r->o.d; i++) {
        char number[24] = "";
        if (r->o.numbered)
            snprintf(number, sizeof number, "_%zu", i + 1);
        row(v, name, number, at(by, i));
    }
}

/* Is coordinate i imposed? It starts as it is told. */
static int is_imposed(const request *r, size_t i)
{
    const fvi_constraints *c =
        r->system.mechanism ? r->system.mechanism->constraints : NULL;
    for (size_t l = 0; c && c->imposed && l < c->count; l++)
        if (c->imposed[l] == i + 1)
            return 1;
    return 0;
}

static void rows_of_start(const visitor *v, const request *r, const char *name, const double *by)
{
    for (size_t i = 0; i < r->o.d; i++) {
        char number[24] = "", whole[LETTERS];
        if (r->o.numbered)
            snprintf(number, sizeof number, "_%zu", i + 1);
        snprintf(whole, sizeof whole, "%s%s", name, number);
        if (is_imposed(r, i))
            warn(v, whole, "no derivative by %s: this coordinate is imposed", whole);
        else
            row(v, whole, "", at(by, i));
    }
}

/* By each number of one --damping, R without a letter. */
static void rows_of_term(const visitor *v, const request *r, size_t i)
{
    const fvi_kernel_kind kind = r->run.law->term[i].kind;
    const fvi_sensitivities *to = &r->to;
    char number[24] = "", name[LETTERS];
    if (r->terms > 1)
        snprintf(number, sizeof number, "_%zu", i + 1);
    snprintf(name, sizeof name, "damping%s", number);
    /* The kernel has rho = R1 and time = R1 / R2: by R1 alone both derivatives are needed. */
    const int lacks_time = kind == FVI_KERNEL_MAXWELL2 && !r->has_orders;
    if (kind == FVI_KERNEL_SYMBOL || !r->has_terms || lacks_time) {
        warn(v, name, "no derivatives by the numbers of %s", name);
        return;
    }
    row(v, name, "", at(to->terms, i));
    if (!r->has_orders && kind >= FVI_KERNEL_MAXWELL2)
        warn(v, name, "with stages no derivatives by A, T and B of %s", name);
    if (!r->has_orders)
        return;
    if (kind != FVI_KERNEL_MAXWELL)
        row(v, name, "_A", at(to->orders, i));
    if (kind == FVI_KERNEL_MAXWELL2)
        row(v, name, "_R2", at(to->times, i));
    if (kind == FVI_KERNEL_DISTRIBUTED || kind == FVI_KERNEL_MAXWELL2)
        row(v, name, "_B", at(to->ends, i));
    if (kind == FVI_KERNEL_MAXWELL || kind == FVI_KERNEL_ZENER || kind == FVI_KERNEL_DAVIDSON)
        row(v, name, "_T", at(to->times, i));
}

/* By a factor of the law of a damper, and by its numbers as `fvi fit` names them. `first` is the place of
 * its terms among all. */
static void rows_of_damper(const visitor *v, const request *r, size_t j, size_t first)
{
    const fvi_damper *damper = r->system.mechanism->damper + j;
    const fvi_kernel *law = damper->kernel;
    const double *const fields[] = { r->to.terms, r->to.orders, r->to.times, r->to.ends };
    char name[LETTERS / 2];
    snprintf(name, sizeof name, "d%zu", j + 1);
    if (damper->name)
        snprintf(name, sizeof name, "%s", damper->name);
    row(v, name, ".factor", at(r->to.damping, j));
    for (size_t i = 0; i < law->count; i++) {
        char part[LETTERS / 2] = ".", whole[LETTERS];
        const char *number;
        if (law->term[i].kind == FVI_KERNEL_SYMBOL || !r->has_terms || !r->has_orders) {
            warn(v, name, "no derivatives by the numbers of the law of %s", name);
            return;
        }
        const fvi_element kind = fvi_element_of(law->term + i);
        if (law->count > 1)
            snprintf(part, sizeof part, ".%s%zu.", fvi_element_words[kind], i + 1);
        snprintf(whole, sizeof whole, "%s%s", name, part);
        for (size_t l = 0, field; (number = fvi_element_number(kind, l, &field)); l++)
            row(v, whole, number, at(fields[field], first + i));
    }
}

static void rows_of_dampers(const visitor *v, const request *r)
{
    const fvi_mechanism *of = r->system.mechanism;
    for (size_t j = 0, first = 0; of && j < of->damper_count;
         first += of->damper[j++].kernel->count)
        rows_of_damper(v, r, j, first);
}

/* By one factor of each matrix. */
static void rows_of_matrices(const visitor *v, const request *r)
{
    const fvi_mechanism *of = r->system.mechanism;
    if (r->has_mass)
        row(v, "mass", "", r->to.mass);
    else
        warn(v, "mass", "no derivative by mass: steps of any length ask for the ground between the "
             "rows", "");
    for (size_t i = 0; i < r->terms; i++)
        rows_of_term(v, r, i);
    rows_of_dampers(v, r);
    if (r->terms == 0 && !of) {
        row(v, "rho", "", r->to.damping);
        row(v, "alpha", "", r->to.alpha);
    }
    row(v, "c", "", r->to.parameters);
}

static void rows_of_masses_and_potential(const visitor *v, const request *r)
{
    static const char *const c_and_g[] = { "c", "g" };
    if (r->has_mass)
        rows_of_masses(v, r, "mass", r->to.mass);
    else if (!r->o.text[LAGRANGIAN])
        warn(v, "mass", "no derivative by mass: %s",
             r->o.ground ? "steps of any length ask for the ground between the rows"
                         : "the potential knows the time");
    for (size_t i = 0; i < r->terms; i++)
        rows_of_term(v, r, i);
    rows_of_dampers(v, r);
    if (r->terms == 0 && !r->system.mechanism)
        rows_of_masses(v, r, "rho", r->to.damping);
    if (r->has_alpha)
        row(v, "alpha", "", r->to.alpha);
    else if (r->terms == 0 && !r->system.mechanism)
        warn(v, "alpha", "no derivative by alpha: %s",
             r->o.method->scheme == FVI_SCHEME_VARIABLE_STEP
                 ? "there x has a logarithm at 0, for which these steps are not made"
                 : "p of this method jumps at 1");
    const int pendulum = r->o.potential.kind == FVI_POTENTIAL_PENDULUM;
    for (size_t j = 0; !r->to.lagrangian && !r->o.potential.expression && j < r->to.sensitivity.count; j++)
        row(v, pendulum ? "g" : c_and_g[j], "", at(r->to.parameters, j));
}

void fvi_gradient_rows(const request *r, const visitor *v)
{
    rows_of_start(v, r, "x0", r->to.x0);
    rows_of_start(v, r, "p0", r->to.p0);
    if (r->system.matrices)
        rows_of_matrices(v, r);
    else
        rows_of_masses_and_potential(v, r);
    for (size_t j = 0; j < r->o.lets.count; j++)
        if (r->o.lets.used[j] & FVI_USED_BY_DAMPING)
            warn(v, r->o.lets.name[j], "no derivative by %s, of which the law speaks",
                 r->o.lets.name[j]);
        else if (r->o.lets.used[j] & FVI_USED_BY_MECHANISM)
            warn(v, r->o.lets.name[j], "no derivative by %s, of which a damper, a constraint or a "
                 "force of velocity speaks",
                 r->o.lets.name[j]);
        else
            row(v, r->o.lets.name[j], "", r->lets + j);
}

/* ---- those that are asked for ---- */

/* Is the word of --by, of so many letters, this name, or the name of all masses? */
static int names_row(const char *word, size_t length, const char *name)
{
    static const char *const of_masses[] = { "x0", "p0", "mass", "rho", NULL };
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
        if (names_row(word, length, name))
            return 1;
        word += length + (word[length] == ',');
    }
    return !r->words.own[BY];
}

/* All names, and which arrays have a number that is asked for. */
enum { FIELDS = 10, MOST = 1024 };
typedef struct {
    request *r;
    char name[MOST][LETTERS];
    size_t count;
    struct {
        double **to;
        size_t size;
        int is_wanted;
    } field[FIELDS];
} choice;

static void note(void *to, const char *name, const double *by, const char *warning)
{
    choice *c = to;
    (void)warning;
    if (c->count < MOST)
        snprintf(c->name[c->count++], LETTERS, "%s", name);
    for (size_t i = 0; by && i < FIELDS; i++)
        if (*c->field[i].to && by >= *c->field[i].to && by < *c->field[i].to + c->field[i].size)
            c->field[i].is_wanted |= fvi_gradient_has_row(c->r, name);
}

static int check_words(const request *r, const choice *all, fvi_error *c)
{
    const char *known[MOST + 5] = { "x0", "p0", "mass", "rho" };
    char word[LETTERS];
    size_t which, n = !r->o.numbered ? 0 : !r->has_mass || r->system.matrices ? 2 : r->terms || r->system.mechanism ? 3 : 4;
    for (size_t i = 0; i < all->count; i++)
        known[n++] = all->name[i];
    for (const char *at = r->words.own[BY];;) {
        const size_t length = strcspn(at, ",");
        snprintf(word, sizeof word, "%.*s", (int)length, at);
        if (fvi_parse_word("by", word, known, &which, c))
            return 2;
        if (!at[length])
            return 0;
        at += length + 1;
    }
}

int fvi_gradient_choose(request *r, fvi_error *c)
{
    const size_t d = r->o.d, terms = fvi_gradient_terms(r),
                 constants = r->system.matrices ? 1 : r->to.sensitivity.count;
    choice *all = calloc(1, sizeof *all);
    if (!r->words.own[BY]) {
        free(all);
        return 0;
    }
    if (!all)
        return fvi_fail(c, FVI_ENOMEM, NULL, 0, "not enough memory");
    all->r = r;
    double **const to[] = { &r->to.x0,    &r->to.p0,     &r->to.mass,  &r->to.damping,
                            &r->to.alpha, &r->to.terms,  &r->to.orders, &r->to.times,
                            &r->to.ends,  &r->to.parameters };
    const size_t size[] = { d, d, d, d + fvi_gradient_dampers(r), 1, terms, terms, terms,
                            terms, constants };
    for (size_t i = 0; i < FIELDS; i++) {
        all->field[i].to = to[i];
        all->field[i].size = size[i];
    }
    fvi_gradient_rows(r, &(visitor){ note, all });
    const int status = check_words(r, all, c);
    enum { TERMS = 5, TIMES = 7 }; /* rho1 of two springpots in series stands in the time, too */
    all->field[TIMES].is_wanted |= all->field[TERMS].is_wanted && r->has_pairs;
    for (size_t i = 0; i < FIELDS; i++)
        if (!all->field[i].is_wanted)
            *to[i] = NULL;
    r->by_lets = 0;
    for (size_t j = 0; j < r->o.lets.count; j++)
        r->by_lets |= fvi_gradient_has_row(r, r->o.lets.name[j]);
    free(all);
    return status;
}
