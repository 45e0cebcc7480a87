/* src/program/fvi_fit_names.c -- What `fvi fit --fit` may ask for, by name. */
#include "fvi_fit_answer.h"

#include <stdio.h>
#include <string.h>

typedef fvi_fit_request request;

/* The names and what they mean. */
enum { MOST_NAMES = FVI_MOST_USER_PARAMETERS + 4 * FVI_MOST_TERMS + 8, LETTERS = 40 };
typedef struct {
    size_t count;
    char name[MOST_NAMES][LETTERS];
    fvi_free_parameter which[MOST_NAMES];
} dictionary;

static void add(dictionary *d, const char *name, size_t which)
{
    if (d->count == MOST_NAMES)
        return;
    snprintf(d->name[d->count], LETTERS, "%s", name);
    d->which[d->count++] = (fvi_free_parameter)which;
}

/* The constants of a potential by their names, NULL where there are no more: c, g, or
 * those of --let. */
static const char *constant_name(const fvi_options *o, size_t i)
{
    static const char *const c_and_g[] = { "c", "g", NULL };
    switch (o->potential.kind) {
    case FVI_POTENTIAL_HARMONIC:
        return i == 0 ? "c" : NULL;
    case FVI_POTENTIAL_PENDULUM:
        return i == 0 ? "g" : NULL;
    case FVI_POTENTIAL_FREE:
        return NULL;
    case FVI_POTENTIAL_EXPRESSION:
        return i < o->lets.count ? o->lets.name[i] : NULL;
    default:
        return c_and_g[i];
    }
}

/* d1.rho, d1.alpha; d1.zener2.alpha of the second term of a sum. */
static void add_law(dictionary *d, const fvi_kernel *law)
{
    for (size_t term = 0; term < law->count; term++) {
        if (law->term[term].kind == FVI_KERNEL_SYMBOL)
            return; /* its numbers are those of --let */
        const fvi_element kind = fvi_element_of(&law->term[term]);
        char place[LETTERS] = "d1", name[2 * LETTERS];
        const char *number;
        if (law->count > 1)
            snprintf(place, sizeof place, "d1.%s%zu", fvi_element_words[kind], term + 1);
        for (size_t i = 0, field; (number = fvi_element_number(kind, i, &field)); i++) {
            snprintf(name, sizeof name, "%s.%s", place, number);
            add(d, name, FVI_FREE_PARAMETER_LAW + 4 * term + field);
        }
    }
}

static void fill(dictionary *d, const fvi_options *o)
{
    d->count = 0;
    if (o->text[DAMPING])
        add_law(d, &o->damping.law);
    else {
        add(d, "alpha", FVI_FREE_PARAMETER_ALPHA);
        add(d, "rho", FVI_FREE_PARAMETER_RHO);
    }
    add(d, "mass", FVI_FREE_PARAMETER_MASS);
    add(d, "x0", FVI_FREE_PARAMETER_X0);
    add(d, "p0", FVI_FREE_PARAMETER_P0);
    add(d, "offset", FVI_FREE_PARAMETER_OFFSET);
    add(d, "drift", FVI_FREE_PARAMETER_DRIFT);
    for (size_t i = 0; constant_name(o, i); i++)
        add(d, constant_name(o, i), FVI_FREE_PARAMETER_CONSTANT + i);
}

static int parameter_named(const request *r, const dictionary *d, const char *name,
                           fvi_free_parameter *which, fvi_error *c)
{
    const char *known[MOST_NAMES + 1] = { NULL };
    size_t found = 0;
    for (size_t i = 0; i < d->count; i++)
        known[i] = d->name[i];
    if (r->o.text[DAMPING] && (strcmp(name, "alpha") == 0 || strcmp(name, "rho") == 0))
        return fvi_refuse(c, "fit", "'%s': with --damping the numbers are those of the law, %s and "
                                    "so on",
                          name, d->name[0]);
    const int status = fvi_parse_word("fit", name, known, &found, c);
    *which = d->which[found];
    return status;
}

/* What a parameter must be, beside known. */
static int check(const request *r, size_t n, fvi_error *c)
{
    const fvi_free_parameter which = r->which[n];
    for (size_t i = 0; i < n; i++)
        if (r->which[i] == which)
            return fvi_refuse(c, "fit", "'%s' stands twice", r->name[n]);
    if (which == FVI_FREE_PARAMETER_ALPHA
        && r->o.method->alpha_least == r->o.method->alpha_most)
        return fvi_refuse(c, "fit", "'alpha' is %g for %s, and no other",
                          r->o.method->alpha_least, r->o.method->name);
    const size_t constant = (size_t)which - FVI_FREE_PARAMETER_CONSTANT;
    if (which >= FVI_FREE_PARAMETER_CONSTANT && r->o.potential.expression
        && r->o.lets.used[constant] & FVI_USED_BY_PARAMETER)
        return fvi_refuse(c, "fit",
                          "another --let was made of '%s', and would stay as it is; write it out "
                          "in the expressions",
                          r->name[n]);
    return 0;
}

/* Without --fit: all numbers of the law. */
static const char *preset(request *r, const dictionary *d)
{
    size_t length = 0;
    if (!r->o.text[DAMPING] || d->which[0] < FVI_FREE_PARAMETER_LAW)
        return "alpha,rho";
    for (size_t i = 0; i < FVI_ESTIMATION_MOST && d->which[i] >= FVI_FREE_PARAMETER_LAW
                       && length < sizeof r->preset;
         i++)
        length += (size_t)snprintf(r->preset + length, sizeof r->preset - length, "%s%s",
                                   i ? "," : "", d->name[i]);
    return r->preset;
}

int fvi_fit_names(request *r, fvi_error *c)
{
    dictionary d;
    fill(&d, &r->o);
    const char *text = r->words.own[FIT] ? r->words.own[FIT] : preset(r, &d);
    if (strlen(text) >= sizeof r->names)
        return fvi_refuse(c, "fit", "'%s' is too long", text);
    strcpy(r->names, text);
    r->words.own[FIT] = text;
    for (char *at = r->names; at; r->fit.parameters++) {
        const size_t n = r->fit.parameters;
        char *comma = strchr(at, ',');
        if (comma)
            *comma++ = '\0';
        if (n == FVI_ESTIMATION_MOST)
            return fvi_refuse(c, "fit", "more than %d parameters", FVI_ESTIMATION_MOST);
        r->name[n] = at;
        if (parameter_named(r, &d, at, &r->which[n], c) || check(r, n, c))
            return 2;
        at = comma;
    }
    return 0;
}
